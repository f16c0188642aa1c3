//! The cantilever that a tip moment rolls up into a ring, up to five times, from the straight beam.

use crate::build::{Stiffness, unit_cantilever};
use crate::measure::{Units, largest_deviation, largest_distance, solve};
use crate::{Case, Estimate, Row};
use flexura_model::{LoadFrame, Model};
use flexura_spatial::{Pose, Vector3, Wrench, exp};
use flexura_testkit::roll_up::roll_up;
use std::f64::consts::TAU;

pub const CASES: [Case; 1] = [Case {
    id: "roll_up",
    title: "Roll-up by a tip moment, one to five full turns, from the straight beam",
    citation: "x = (EI/M) sin(Ms/EI), y = (EI/M)(1 - cos(Ms/EI)) (compare K. J. Bathe and S. Bolourchi, \
               *Int. J. Numer. Meth. Eng.* 14 (1979) 961)",
    needed: "1e-9 L",
    run,
    closed_form: Some(estimates),
}];

fn model(turns: u32) -> Model {
    let moment = Vector3::new(0.0, 0.0, TAU * f64::from(turns));
    unit_cantilever(Vector3::zeros(), moment, LoadFrame::Global)
}

fn exact(turns: u32, s: f64) -> (Pose, Wrench) {
    let moment = TAU * f64::from(turns);
    let ([x, y], angle) = roll_up(moment, s);
    let pose = Pose::new(exp(&Vector3::new(0.0, 0.0, angle)), Vector3::new(x, y, 0.0));
    (pose, Wrench::new(Vector3::zeros(), Vector3::new(0.0, 0.0, moment)))
}

fn run() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for turns in 1..=5 {
        let solution = solve(&model(turns), 1e-10)?;
        let off = largest_distance(&solution.beams[0], &|s| exact(turns, s).0.position);
        rows.push(
            Row::vanishing(format!("whole shape, /L, {turns} turns"), off, 1e-9)
                .with_estimate(solution.error_estimate),
        );
    }
    Ok(rows)
}

fn estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let units = Units { length: 1.0, stiffness: Stiffness::unit().softest() };
    (1..=5)
        .map(|turns| {
            let solution = solve(&model(turns), tolerance)?;
            Ok(Estimate {
                what: format!("{turns} turns"),
                error: largest_deviation(&solution.beams[0], &units, &|s| exact(turns, s)),
                estimate: solution.error_estimate,
            })
        })
        .collect()
}
