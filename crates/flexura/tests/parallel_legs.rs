//! Straight legs side by side, clamped to the ground and to a plate: where they do not stretch, their forces cannot be told
//! apart at rest, and under load they can.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};
use std::fmt::Write;

/// Six steel rods of 1 m and 2 mm in diameter on a circle of 0.1 m. `stiffer` multiplies EA; None: they do not stretch.
fn solved(stiffer: Option<f64>, part: f64) -> Solution {
    let ea = 628_318.530_7 * stiffer.unwrap_or(1.0);
    let mut text = format!(
        r#"
format = 1
[section.rod]
shape = "stiffness"
EA = {ea:e}
GJ = 0.1208
EI2 = 0.15708
EI3 = 0.15708
[body.plate]
at = [0, 0, 1]
[load.push]
body = "plate"
force = [{}, {}, {}]
"#,
        part,
        0.6 * part,
        -2.0 * part
    );
    for i in 0..6 {
        let (y, x) = (i as f64 * std::f64::consts::PI / 3.0).sin_cos();
        let end = |body: &str| {
            let at = format!("at = [{:?}, {:?}, 0]", 0.1 * x, 0.1 * y);
            let up = "rotation = { axis = [0, 1, 0], angle = \"-90 deg\" }";
            format!("{{ body = \"{body}\", {at}, {up}, hold = \"clamp\" }}")
        };
        let (start, end) = (end("ground"), end("plate"));
        let extension = stiffer.is_some();
        writeln!(
            text,
            "[beam.leg{i}]\nsection = \"rod\"\nlength = 1\nextension = {extension}\nstart = {start}\nend = {end}"
        )
        .unwrap();
    }
    let model = Document::parse(&text, "legs.toml").unwrap_or_else(|r| panic!("{r}")).model(&[]).unwrap();
    solve(&model, &Options::default(), &mut |_| {}).unwrap_or_else(|error| panic!("{error}"))
}

/// The limit of ever stiffer legs is that of legs that do not stretch, on a path of its own, and no way gets longer.
#[test]
fn stiffer_legs_take_no_more_steps_and_lead_to_legs_that_do_not_stretch() {
    let rigid = solved(None, 1.0);
    assert_eq!(rigid.status, Status::Converged, "{:?}", rigid.reason);
    let mut apart = Vec::new();
    for stiffer in [1.0, 1e2, 1e4, 1e6] {
        let solution = solved(Some(stiffer), 1.0);
        assert_eq!(solution.status, Status::Converged, "EA x {stiffer}: {:?}", solution.reason);
        assert!(solution.work.load_steps < 200, "EA x {stiffer}: {} steps", solution.work.load_steps);
        apart.push((solution.bodies[0].position - rigid.bodies[0].position).norm());
    }
    // The difference goes like 1/EA.
    assert!(apart[0] > 1e-6 && apart[1] < 0.02 * apart[0] && apart[2] < 1e-3 * apart[1] + 1e-8, "{apart:?}");
}

/// Six legs share the side load: by linear theory of guided beams (12 EI/L³ each, softened by the share N of the weight, -6 N/(5 L)
/// each) the plate moves by F/(72 EI/L³ - 6 P/(5 L)), to the order (P L²/EI)² of the share.
#[test]
fn small_loads_move_the_plate_as_guided_beams_do() {
    for stiffer in [None, Some(1.0), Some(1e4)] {
        let solution = solved(stiffer, 3e-2);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let moved = solution.bodies[0].position.x;
        let wanted = 3e-2 / (72.0 * 0.15708 - 1.2 * 6e-2);
        assert!((moved - wanted).abs() < 1e-3 * wanted, "{stiffer:?}: {moved}, not {wanted}");
    }
}
