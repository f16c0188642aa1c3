//! Tip forces that turn with the tip. Their equilibrium is unique and known without any iteration.

use crate::build::{SHEARABLE, Stiffness, cantilever, load_tip, unit_cantilever};
use crate::measure::{Units, largest_deviation, largest_distance, solve};
use crate::{Case, Estimate, Row};
use flexura_model::{Curve, LoadFrame, Model};
use flexura_spatial::{Pose, Vector3, Wrench, exp};
use flexura_testkit::elastica::Elastica;
use flexura_testkit::ivp::{FollowerSolution, follower_end};
use flexura_testkit::rod::Rod;
use std::f64::consts::FRAC_PI_2;

pub const CASES: [Case; 2] = [
    Case {
        id: "follower_planar",
        title: "Follower tip force on a straight cantilever, PL²/EI = 1, 5, 13, 20",
        citation: "elliptic integrals, the tip's angle to the force being known (compare B. S. Shvartsman, \
                   *J. Sound Vib.* 304 (2007) 969)",
        needed: "1e-8 L",
        run: planar,
        closed_form: Some(planar_estimates),
    },
    Case {
        id: "follower_spatial",
        title: "Follower tip force and moment on a curved, stretching and shearing rod in space",
        citation: "integration from the tip, where pose and wrench are given, by extrapolation of order 12 \
                   (Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., 1993, II.9)",
        needed: "1e-8 L",
        run: spatial,
        closed_form: Some(spatial_estimates),
    },
];

const LOADS: [f64; 4] = [1.0, 5.0, 13.0, 20.0];
const STEPS: usize = 160;

fn planar_model(load: f64) -> Model {
    unit_cantilever(Vector3::new(0.0, load, 0.0), Vector3::zeros(), LoadFrame::Local)
}

fn planar_exact(shape: &Elastica, load: f64, s: f64) -> (Pose, Wrench) {
    let station = shape.at(s);
    let [x, y] = station.position;
    let direction = shape.force_direction();
    let force = Vector3::new(direction.cos(), direction.sin(), 0.0) * load;
    let pose = Pose::new(exp(&Vector3::new(0.0, 0.0, station.angle)), Vector3::new(x, y, 0.0));
    (pose, Wrench::new(force, Vector3::new(0.0, 0.0, station.curvature)))
}

fn planar() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for load in LOADS {
        let solution = solve(&planar_model(load), 1e-9)?;
        let shape = Elastica::follower(load, FRAC_PI_2);
        let off = largest_distance(&solution.beams[0], &|s| planar_exact(&shape, load, s).0.position);
        rows.push(
            Row::vanishing(format!("whole shape, /L, PL²/EI = {load}"), off, 1e-8)
                .with_estimate(solution.error_estimate),
        );
    }
    Ok(rows)
}

fn planar_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let units = Units { length: 1.0, stiffness: Stiffness::unit().softest() };
    LOADS
        .iter()
        .map(|&load| {
            let solution = solve(&planar_model(load), tolerance)?;
            let shape = Elastica::follower(load, FRAC_PI_2);
            let exact = |s| planar_exact(&shape, load, s);
            Ok(Estimate {
                what: format!("PL²/EI = {load}"),
                error: largest_deviation(&solution.beams[0], &units, &exact),
                estimate: solution.error_estimate,
            })
        })
        .collect()
}

const STIFFNESS: Stiffness = Stiffness { ea: 400.0, ga: 150.0, gj: 0.77, ei2: 1.0, ei3: 1.0 };

/// A helix of two thirds of a turn; weak and strong wrenches in the end's own axes.
fn wrenches() -> [Wrench; 2] {
    let wrench = Wrench::new(Vector3::new(-0.5, 1.0, 0.8), Vector3::new(0.3, 0.0, -0.4));
    [wrench, wrench * 4.0]
}

fn helix() -> Curve {
    Curve::Helix { radius: 0.5, pitch: 1.2, turns: 0.65 }
}

fn spatial_model(wrench: &Wrench) -> Model {
    let mut model = cantilever(STIFFNESS.section(), helix(), SHEARABLE, Pose::identity());
    load_tip(&mut model, wrench.force, wrench.moment, LoadFrame::Local);
    model
}

fn spatial_reference(wrench: &Wrench) -> (Rod, FollowerSolution) {
    let rise = 1.2 / std::f64::consts::TAU;
    let slant = 0.5_f64.hypot(rise);
    let rest = Vector3::new(rise, 0.0, 0.5) / slant.powi(2);
    let length = 0.65 * std::f64::consts::TAU * slant;
    let rod = Rod::uniform(length, STIFFNESS.compliance(), rest);
    let reference = follower_end(&rod, wrench, STEPS);
    (rod, reference)
}

/// Deviation at the tip and, by the wrench at the clamp, of everything that leads to it.
fn spatial_solve(wrench: &Wrench, tolerance: f64) -> Result<(f64, f64), String> {
    let solution = solve(&spatial_model(wrench), tolerance)?;
    let (rod, reference) = spatial_reference(wrench);
    let units = Units { length: rod.length, stiffness: STIFFNESS.softest() };
    // The reference's places are every 160th of the length, our samples every 40th.
    let exact = |s: f64| {
        let pose = reference.poses[(s / rod.length * STEPS as f64).round() as usize].1;
        let lever = pose.position;
        (pose, Wrench::new(reference.root.force, reference.root.moment - lever.cross(&reference.root.force)))
    };
    Ok((largest_deviation(&solution.beams[0], &units, &exact), solution.error_estimate))
}

fn spatial() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (wrench, name) in wrenches().iter().zip(["weak", "strong"]) {
        let (off, estimate) = spatial_solve(wrench, 1e-9)?;
        let row = Row::vanishing(format!("all poses and wrenches, scaled, {name} wrench"), off, 1e-8);
        rows.push(row.with_estimate(estimate));
    }
    Ok(rows)
}

fn spatial_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    wrenches()
        .iter()
        .zip(["weak", "strong"])
        .map(|(wrench, name)| {
            let (error, estimate) = spatial_solve(wrench, tolerance)?;
            Ok(Estimate { what: format!("{name} wrench"), error, estimate })
        })
        .collect()
}
