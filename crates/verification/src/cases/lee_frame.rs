//! Lee's frame: its load and the way of the point under it both turn back.

use crate::file::File;
use crate::path::{Path, counted, crossings, folds};
use crate::{Case, Row};
use flexura_testkit::snaps::{LoadedFrame, lees_frame};

pub const CASES: [Case; 1] = [Case {
    id: "lee_frame",
    title: "Lee's frame with its snap-back (`lee_frame.toml`): both folds of the load, 1.85567 and -0.94144; with the \
            point under the load led down instead, both folds of its way, 61.003 and 50.746",
    citation: "Taylor series along column and beam (`testkit/src/snaps.rs`); S. L. Lee, F. S. Manuel and E. C. Rossow, \
               *J. Eng. Mech. Div. ASCE* 94 (1968) EM2, 521",
    needed: "1e-8 of EI/L², L, 1",
    run,
    closed_form: None,
}];

const LENGTH: f64 = 120.0;
/// EI/L².
const UNIT: f64 = 1440.0 / (LENGTH * LENGTH);

/// The frame with its beam in two parts, joined by a body that is led down where the load was.
fn led(text: &str) -> Result<String, String> {
    let (head, _) = text.split_once("[beam.beam]").ok_or("no beam")?;
    let head = head.replace("load = 1\n", "drop = 0\n");
    Ok(head
        + r#"
[body.point]
at = ["length/5", "length", 0]

[beam.near]
section = "bar"
length = "length/5"
start = { body = "corner", hold = "clamp" }
end = { body = "point", hold = "clamp" }

[beam.far]
section = "bar"
length = "4*length/5"
start = { body = "point", hold = "clamp" }
end = { body = "ground", hold = "revolute", axis = [0, 0, 1] }

[joint.press]
kind = "planar"
parent = { body = "ground", at = ["length/5", "length", 0] }
child = "point"
axis = [0, 0, 1]
y = { coordinate = "-drop" }

[output]
load = "-joint.press.effort.y"
right = "joint.press.x"
angle = "joint.press.angle"
"#)
}

fn rows_of(what: &str, wanted: &LoadedFrame, [load, down, right, angle]: [f64; 4]) -> [Row; 4] {
    [
        Row::scaled(format!("{what}: load"), wanted.load, load, UNIT, 1e-8),
        Row::scaled("down", wanted.down, down, LENGTH, 1e-8),
        Row::scaled("to the right", wanted.right, right, LENGTH, 1e-8),
        Row::absolute("angle", wanted.angle, angle, 1e-8),
    ]
}

fn run() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/lee_frame.toml");
    let wanted = lees_frame().map_err(|error| format!("{error:?}"))?;
    let mut rows = Vec::new();
    let path = Path { start: Some(0.0), ..Path::of("load", [-1.5, 2.5]) };
    let followed = File::new(text)?.trace(&[], &path, 1e-10)?;
    let branch = followed.first()?;
    let found = folds(branch);
    let [first, second] = found[..] else { return Err(format!("{} folds of the load", found.len())) };
    for (wanted, point) in wanted.load.iter().zip([first, second]) {
        let [down, right, angle] = ["down", "right", "angle"].map(|name| followed.number(point, name));
        rows.extend(rows_of("fold of the load", wanted, [point.parameter, down, right, angle]));
    }
    rows.push(Row::vanishing("branch points", crossings(branch).len() as f64, 0.0));
    rows.push(counted(branch, &[0, 1, 0]));
    let followed = File::new(&led(text)?)?.trace(&[], &Path::of("drop", [0.0, 75.0]), 1e-10)?;
    let branch = followed.first()?;
    let found = folds(branch);
    let [first, second] = found[..] else { return Err(format!("{} folds of the way", found.len())) };
    for (wanted, point) in wanted.down.iter().zip([first, second]) {
        let [load, right, angle] = ["load", "right", "angle"].map(|name| followed.number(point, name));
        rows.extend(rows_of("fold of the way", wanted, [load, point.parameter, right, angle]));
    }
    rows.push(counted(branch, &[0, 1, 0]));
    Ok(rows)
}
