//! The tripod of `wing.toml`: balance of the shoulder and of the whole, and birds of other sizes.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::spatial::Vector3;
use flexura::{Options, solve};

fn solved(values: &[(&str, &str)]) -> Solution {
    let text = include_str!("../../../models/wing.toml");
    let overrides: Vec<(String, String)> =
        values.iter().map(|(name, value)| ((*name).to_string(), (*value).to_string())).collect();
    let model = Document::parse(text, "wing.toml").and_then(|document| document.model(&overrides));
    let model = model.unwrap_or_else(|report| panic!("{report}"));
    let options = Options { samples: 401, tolerance: 1e-11, ..Options::default() };
    let solution =
        solve(&model, &options, &mut |_| {}).unwrap_or_else(|e| panic!("{}: {}", e.path, e.message));
    assert_eq!(solution.status, Status::Converged, "{values:?}: {:?}", solution.reason);
    solution
}

const PULLED: &[(&str, &str)] = &[];
const TWISTED: &[(&str, &str)] = &[("pull", "0 mm"), ("twist", "90 deg")];

/// Clavicle, contact and ligaments hold the shoulder: their forces, and their moments about its origin, vanish together.
#[test]
fn the_shoulder_is_in_balance() {
    for case in [PULLED, TWISTED] {
        let solution = solved(case);
        let shoulder = &solution.bodies[0];
        let (mut force, mut moment, mut size) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        let mut add = |f: Vector3<f64>, m: Vector3<f64>, at: Vector3<f64>| {
            force += f;
            moment += m + (at - shoulder.position).cross(&f);
            size += f.norm();
        };
        let contact = solution.joints[0].contact.unwrap();
        add(solution.joints[0].wrench.force, Vector3::zeros(), contact.point);
        assert!(contact.friction.norm() < 1e-9, "{}", contact.friction.norm());
        let end = solution.beams[0].samples.last().unwrap();
        add(-end.wrench.force, -end.wrench.moment, end.pose.position);
        for ligament in &solution.springs {
            let along = (ligament.ends[1] - ligament.ends[0]).normalize();
            add(along * ligament.tension, Vector3::zeros(), ligament.ends[0]);
        }
        assert!(size > 1.0, "{size}");
        assert!(force.norm() < 1e-9 * size, "{force}");
        assert!(moment.norm() < 1e-9 * size * 0.04, "{moment}");
    }
}

/// What the ground exerts, by the keel, the clavicle's root, the meat and the manipulator, adds up to nothing.
#[test]
fn the_whole_is_in_balance() {
    for case in [PULLED, TWISTED] {
        let solution = solved(case);
        let root = solution.beams[0].samples.first().unwrap();
        let sum = solution.joints[0].wrench.force + solution.joints[1].wrench.force - root.wrench.force
            + solution.beams[0].foundation_force;
        assert!(sum.norm() < 1e-9, "{sum}");
    }
}

/// All lengths 1.1 times as large and the pull too: the same strains, 1.21 times the forces, 1.1 times the motions.
#[test]
fn a_larger_bird_needs_more_force() {
    for twisted in [false, true] {
        let case = if twisted { TWISTED } else { PULLED };
        let (small, large) = (solved(case), solved(&[case, &[("size", "1.1")]].concat()));
        for (a, b) in small.springs.iter().zip(&large.springs) {
            assert!((1.21 * a.tension - b.tension).abs() < 1e-9);
        }
        let contact = |s: &Solution| s.joints[0].contact.unwrap().force;
        assert!((1.21 * contact(&small) - contact(&large)).abs() < 1e-9);
        assert!((small.bodies[0].position * 1.1 - large.bodies[0].position).norm() < 1e-11);
    }
}

/// The pull tensions all three ligaments; the twist winds them about the humerus's axis.
#[test]
fn pull_and_twist_move_the_shoulder() {
    let (pulled, twisted) = (solved(PULLED), solved(TWISTED));
    for spring in &pulled.springs {
        assert!(spring.tension > 1.0, "{}", spring.tension);
    }
    assert!(twisted.springs.iter().any(|spring| spring.tension > 0.0));
    assert_eq!((pulled.stable, twisted.stable), (Some(true), Some(true)));
}
