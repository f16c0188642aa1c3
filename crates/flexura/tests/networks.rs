//! Lattices: large enough for the sparse factorisation, small enough to be checked by statics.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::spatial::Vector3;
use flexura::{Options, check, solve};

fn lattice(file: &str, overrides: &[(&str, &str)]) -> Model {
    let path = format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR"));
    let overrides: Vec<_> = overrides.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    Document::read(path).unwrap().model(&overrides).unwrap()
}

fn solved(model: &Model) -> Solution {
    let options = Options { tolerance: 1e-10, samples: 5, ..Options::default() };
    let solution = solve(model, &options, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    solution
}

/// Sum of the loads, and of what the clamps on the ground exert, with moments about the origin.
fn balance(model: &Model, solution: &Solution) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (mut force, mut moment, mut size) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for load in &model.loads {
        let flexura::model::LoadTarget::Body { body, .. } = load.target else { panic!("loads on nodes") };
        force += load.force;
        moment += solution.bodies[body.0].position.cross(&load.force);
        size += load.force.norm();
    }
    for (beam, result) in model.beams.iter().zip(&solution.beams) {
        if beam.name.starts_with("first") {
            let start = &result.samples[0];
            // The part before s = 0 is the ground: it feels +F, and exerts -F.
            force -= start.wrench.force;
            moment -= start.wrench.moment + start.pose.position.cross(&start.wrench.force);
        }
    }
    (force, moment, size)
}

#[test]
fn the_clamps_of_a_lattice_carry_what_pushes_it() {
    for (file, overrides) in [
        ("lattice.toml", &[("n", "9"), ("push", "30 mN")][..]),
        ("lattice_3d.toml", &[("n", "3"), ("push", "100 mN")][..]),
    ] {
        let model = lattice(file, overrides);
        let solution = solved(&model);
        let (force, moment, size) = balance(&model, &solution);
        assert!(force.norm() < 1e-9 * size, "{file}: {force}");
        assert!(moment.norm() < 1e-9 * size * 0.1, "{file}: {moment}");
    }
}

/// Clapeyron: under small loads the strain energy is half the work of the loads.
#[test]
fn a_lattice_stores_half_the_work_of_small_loads() {
    let model = lattice("lattice.toml", &[("n", "8"), ("push", "1 uN")]);
    let solution = solved(&model);
    let work: f64 = model
        .loads
        .iter()
        .map(|load| {
            let flexura::model::LoadTarget::Body { body, .. } = load.target else { panic!("loads on nodes") };
            load.force.dot(&(solution.bodies[body.0].position - model[body].pose.position))
        })
        .sum();
    assert!((solution.energy - 0.5 * work).abs() < 1e-6 * work, "{} against {}", solution.energy, 0.5 * work);
}

/// A node that nothing holds, in a network too large for a dense decomposition.
#[test]
fn a_loose_node_in_a_large_lattice_is_named() {
    let mut model = lattice("lattice.toml", &[("n", "10")]);
    let mut loose = model.bodies[0].clone();
    loose.name = "stray".to_owned();
    model.bodies.push(loose);
    let error = check(&model).unwrap_err();
    assert_eq!(error.path, "body.stray", "{}", error.message);
    assert!(error.message.contains("body.stray") && !error.message.contains("node_"), "{}", error.message);
}
