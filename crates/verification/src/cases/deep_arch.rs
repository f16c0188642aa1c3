//! The deep clamped-hinged arch of DaDeppo and Schmidt: its greatest load, led down and under a given load.

use crate::file::File;
use crate::path::{Path, counted, crossings, folds};
use crate::{Case, Row};
use flexura_testkit::arches;
use flexura_testkit::planar::{self, Beam, Body, End, Mechanism};
use std::f64::consts::PI;

pub const CASES: [Case; 2] = [
    Case {
        id: "deep_arch",
        title: "Clamped-hinged arch of 215°, R = 100, EI = 1e6, led down at its crown (`deep_arch.toml`): greatest load \
            8.973464 EI/R² at 1.137 R; load and sway on both sides of it",
        citation: "D. DaDeppo and R. Schmidt, *J. Appl. Mech.* 42 (1975) 893; and Taylor series along both halves, closed by \
               Newton's method",
        needed: "1e-4 of the limit load, 1e-3 R; 1e-8 against the second method",
        run,
        closed_form: None,
    },
    Case {
        id: "deep_arch_fold",
        title: "The same arch, stiff across its plane, under a given load: the greatest load 8.973089970 EI/R² at 1.137320631 R \
                as a fold, one direction unstable past it; led down, the same load is met there",
        citation: "Taylor series along both halves, the crown's height leading (`testkit/src/arches.rs`). 8.973464, as above, \
                   has four digits right, 8.97 and 1.14 are what DaDeppo and Schmidt print",
        needed: "1e-8 of EI/R² and R",
        run: fold,
        closed_form: None,
    },
];

const TEXT: &str = include_str!("../../../../models/deep_arch.toml");
const R: f64 = 100.0;
const EI: f64 = 1e6;
const UNIT: f64 = EI / (R * R);

/// The load that holds the crown `drop` down, and how far it sways.
fn reference(drop: f64) -> Result<(f64, f64), String> {
    let half: f64 = 107.5 * PI / 180.0;
    let arch = |start: End, end: End| Beam {
        length: R * half,
        bending: EI,
        stretch: 0.0,
        curvature: 1.0 / R,
        start,
        end,
    };
    let (x, y) = (R * half.sin(), R * half.cos());
    let right = arch(End::clamp(None, [x, y, PI - half]), End::clamp(Some(0), [0.0, 0.0, PI]));
    let hinge = End { body: None, place: [-x, y, PI + half], hinged: true };
    let left = arch(End::clamp(Some(0), [0.0, 0.0, PI]), hinge);
    let at = |fraction: f64| Mechanism {
        beams: vec![right, left],
        bodies: vec![Body {
            rest: [0.0, R, 0.0],
            held: [None, Some(R - drop * fraction), None],
            load: [0.0; 3],
        }],
    };
    let found = planar::solve(&at, 40).map_err(|error| format!("{error:?}"))?;
    Ok((-found.reactions[0][1], found.poses[0][0]))
}

fn run() -> Result<Vec<Row>, String> {
    let file = File::new(TEXT)?;
    let load = |drop: f64| file.solve(&[("drop", drop)], 1e-10).map(|answer| answer.number("load"));
    // The greatest load: parabolas through three points, each around the last one's top.
    let (mut centre, mut width, mut greatest) = (113.7, 1.0, f64::NAN);
    for _ in 0..3 {
        let (a, b, c) = (load(centre - width)?, load(centre)?, load(centre + width)?);
        let (slope, bend) = ((c - a) / (2.0 * width), (a - 2.0 * b + c) / (width * width));
        greatest = b - 0.5 * slope * slope / bend;
        centre -= slope / bend;
        width *= 0.1;
    }
    let mut rows = vec![
        Row::relative("greatest load R²/EI", 8.973464, greatest / UNIT, 1e-4),
        Row::absolute("crown displacement there, R", 1.137, centre / R, 1e-3),
    ];
    for drop in [50.0, 100.0, 113.7, 118.0] {
        let (wanted, sway) = reference(drop)?;
        let answer = file.solve(&[("drop", drop)], 1e-10)?;
        rows.push(Row::scaled(format!("load at {drop}"), wanted, answer.number("load"), UNIT, 1e-8));
        rows.push(Row::scaled(format!("sway at {drop}"), sway, answer.number("sway"), R, 1e-8));
    }
    Ok(rows)
}

/// The arch under a given load, which does not hold it in its plane; so that it stays there, it is stiff across it.
fn loaded() -> Result<String, String> {
    let (head, _) = TEXT.split_once("[joint.press]").ok_or("no press")?;
    let head = head
        .replace("drop = 50 ", "push = 0 ")
        .replace("GJ = \"EI\"", "GJ = \"100*EI\"")
        .replace("EI2 = \"EI\"", "EI2 = \"100*EI\"");
    Ok(head
        + r#"
[load.crown]
body = "crown"
force = [0, "-push", 0]

[output]
down = "radius - body.crown.position.y"
sway = "body.crown.position.x"
"#)
}

fn fold() -> Result<Vec<Row>, String> {
    let wanted = arches::deep_arch().map_err(|error| format!("{error:?}"))?;
    let path = Path { until: Some(("down", 1.18 * R)), ..Path::of("push", [0.0, 10.0 * UNIT]) };
    let followed = File::new(&loaded()?)?.trace(&[], &path, 1e-10)?;
    let branch = followed.first()?;
    let found = folds(branch);
    let [fold] = found[..] else { return Err(format!("{} folds", found.len())) };
    let down = followed.number(fold, "down");
    let mut rows = vec![
        Row::scaled("greatest load R²/EI", wanted.load * UNIT, fold.parameter, UNIT, 1e-8),
        Row::absolute("crown displacement there, R", wanted.drop, down / R, 1e-8),
        Row::absolute("sway there, R", wanted.sway, followed.number(fold, "sway") / R, 1e-8),
        Row::absolute("load as printed", 8.97, fold.parameter / UNIT, 5e-3),
        Row::absolute("crown displacement as printed", 1.14, down / R, 5e-3),
        Row::vanishing("branch points", crossings(branch).len() as f64, 0.0),
        counted(branch, &[0, 1]),
    ];
    // Led down to there, the same load holds it.
    let path = Path { steps: 20, ..Path::of("drop", [0.0, wanted.drop * R]) };
    let led = File::new(TEXT)?.trace(&[], &path, 1e-10)?;
    let load = led.first()?.points.last().map_or(f64::NAN, |end| led.number(end, "load_ratio"));
    rows.push(Row::absolute("load when led to there R²/EI", wanted.load, load, 1e-8));
    Ok(rows)
}
