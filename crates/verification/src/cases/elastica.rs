//! The planar cantilever under a transverse dead force.

use crate::build::{Stiffness, unit_cantilever};
use crate::measure::{Units, largest_deviation, largest_distance, solve, tip};
use crate::{Case, Estimate, Row};
use flexura_model::LoadFrame;
use flexura_spatial::{Pose, Vector3, Wrench, exp};
use flexura_testkit::elastica::Elastica;
use std::f64::consts::{FRAC_PI_2, PI};

pub const CASES: [Case; 3] = [
    Case {
        id: "elastica",
        title: "Planar cantilever, dead tip force PL²/EI = 1, 2, 5, 10, 50",
        citation: "elliptic integrals (Love, *A Treatise on the Mathematical Theory of Elasticity*, 4th ed., \
                   1927, §§262-263)",
        needed: "1e-9 L",
        run,
        closed_form: Some(estimates),
    },
    Case {
        id: "elastica_mattiasson",
        title: "Planar cantilever, dead tip force PL²/EI = 1, 2, 5, 10",
        citation: "K. Mattiasson, *Int. J. Numer. Meth. Eng.* 17 (1981) 145, as printed",
        needed: "all printed digits",
        run: printed,
        closed_form: None,
    },
    Case {
        id: "elastica_push",
        title: "Round column pushed past its Euler load, 0.05 to 0.0001 rad off its axis, PL²/EI = 4 to 60",
        citation: "elliptic integrals, the equilibrium that bows with the push and not against it",
        needed: "1e-9 L",
        run: pushed,
        closed_form: None,
    },
];

const LOADS: [f64; 5] = [1.0, 2.0, 5.0, 10.0, 50.0];

fn model(load: f64) -> flexura_model::Model {
    unit_cantilever(Vector3::new(0.0, load, 0.0), Vector3::zeros(), LoadFrame::Global)
}

/// Pose and internal wrench of the closed form, clamped along x, bent towards y.
fn exact(shape: &Elastica, force: Vector3<f64>, s: f64) -> (Pose, Wrench) {
    let station = shape.at(s);
    let [x, y] = station.position;
    let pose = Pose::new(exp(&Vector3::new(0.0, 0.0, station.angle)), Vector3::new(x, y, 0.0));
    (pose, Wrench::new(force, Vector3::new(0.0, 0.0, station.curvature)))
}

fn run() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for load in LOADS {
        let solution = solve(&model(load), 1e-10)?;
        let beam = &solution.beams[0];
        let shape = Elastica::dead(load, FRAC_PI_2);
        let (end, found) = (shape.tip(), tip(beam)?);
        let row = |what: &str, reference, ours| {
            Row::absolute(format!("{what}, PL²/EI = {load}"), reference, ours, 1e-9)
                .with_estimate(solution.error_estimate)
        };
        rows.push(row("u/L", 1.0 - end.position[0], 1.0 - found.pose.position.x));
        rows.push(row("w/L", end.position[1], found.pose.position.y));
        rows.push(row("tip slope, rad", end.angle, found.pose.rotation.angle()));
        let off = largest_distance(beam, &|s| {
            let [x, y] = shape.at(s).position;
            Vector3::new(x, y, 0.0)
        });
        rows.push(row("whole shape, /L", 0.0, off));
    }
    Ok(rows)
}

/// The equilibrium that is reached from rest; others, against the push's lean, are unstable.
fn pushed() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for lean in [0.05, 0.01, 1e-3, 1e-4] {
        let angle = PI - lean;
        for load in [4.0, 8.0, 15.0, 25.0, 60.0] {
            let force = Vector3::new(angle.cos(), angle.sin(), 0.0) * load;
            let solution = solve(&unit_cantilever(force, Vector3::zeros(), LoadFrame::Global), 1e-10)?;
            let shape = Elastica::dead(load, angle);
            let off = largest_distance(&solution.beams[0], &|s| exact(&shape, force, s).0.position);
            rows.push(
                Row::vanishing(format!("whole shape, /L, PL²/EI = {load}, {lean} rad off"), off, 1e-9)
                    .with_estimate(solution.error_estimate),
            );
        }
    }
    Ok(rows)
}

fn printed() -> Result<Vec<Row>, String> {
    let table =
        [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (5.0, 0.71379, 0.38763), (10.0, 0.81061, 0.55500)];
    let mut rows = Vec::new();
    for (load, w, u) in table {
        // As a user would, with the default tolerance.
        let solution = solve(&model(load), 1e-8)?;
        let found = tip(&solution.beams[0])?.pose.position;
        rows.push(Row::absolute(format!("w/L, PL²/EI = {load}"), w, found.y, 5e-6));
        rows.push(Row::absolute(format!("u/L, PL²/EI = {load}"), u, 1.0 - found.x, 5e-6));
    }
    Ok(rows)
}

fn estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let units = Units { length: 1.0, stiffness: Stiffness::unit().softest() };
    LOADS
        .iter()
        .map(|&load| {
            let solution = solve(&model(load), tolerance)?;
            let shape = Elastica::dead(load, FRAC_PI_2);
            let force = Vector3::new(0.0, load, 0.0);
            Ok(Estimate {
                what: format!("PL²/EI = {load}"),
                error: largest_deviation(&solution.beams[0], &units, &|s| exact(&shape, force, s)),
                estimate: solution.error_estimate,
            })
        })
        .collect()
}
