//! Traces that cover nothing, that run into something, and what is said along them.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchEnd, Status};
use support::{run, traced};

const COLUMN: &str = "format = 1\n[parameter]\npush = 0\nlength = 1\n[section.s]\nshape = \"stiffness\"\nEA = 1e6\nGJ = 1\nEI2 = 2\nEI3 = 1\n\
     [beam.column]\nsection = \"s\"\nlength = \"length\"\nstart = { body = \"ground\", hold = \"clamp\" }\n\
     [load.head]\nbeam = \"column\"\nat = 1\nforce = [\"-push\", 0, 0]\n";

fn study(keys: &str) -> String {
    format!("{COLUMN}[study.path]\nkind = \"trace\"\n{keys}\n")
}

/// As many points as are allowed lead a small part of the way, however short the steps.
#[test]
fn a_path_that_gets_nowhere_is_not_converged() {
    for steps in [200_000_000, 1_000_000_000] {
        let text = study(&format!("parameter = \"push\"\nrange = [0, 1]\nsteps = {steps}\nmost_points = 40"));
        let found = run(&text, &[], 1e-8);
        assert_eq!(found.trace.status, Status::IterationLimit, "{steps}: {:?}", found.trace.reason);
    }
}

#[test]
fn a_length_that_is_traced_through_nothing_is_said_to_be_positive() {
    let found = run(&study("parameter = \"length\"\nrange = [1, -1]"), &[], 1e-8);
    let BranchEnd::Stalled(why) = &found.trace.branches[0].ends[1] else {
        panic!("{:?}", found.trace.branches[0].ends)
    };
    assert!(why.contains("positive"), "{why}");
}

/// A wheel on the ground that is pressed on, then lifted: its contact pulls from where the load changes sign, 1.3.
#[test]
fn a_contact_that_pulls_is_told_along_a_trace() {
    let text = "format = 1\n[parameter]\nlift = -2\n[body.wheel]\nat = [0, 0.02, 0]\n[joint.roll]\nkind = \"rolling\"\nparent = \"ground\"\n\
         child = \"wheel\"\nchild_curve = { kind = \"circle\", radius = 0.02 }\nparent_curve = { kind = \"line\", normal = [0, 1] }\n\
         stiffness = 1\n[load.up]\nbody = \"wheel\"\nforce = [0.1, \"lift - 1.3\", 0]\n[study.path]\nkind = \"trace\"\nparameter = \"lift\"\nsteps = 40\n";
    let found = traced(&format!("{text}range = [-2, 4]\n"), &[], 1e-8);
    let said: Vec<_> = found.trace.warnings.iter().filter(|warning| warning.contains("lift off")).collect();
    assert_eq!(said.len(), 1, "{:?}", found.trace.warnings);
    let at: f64 = said[0].split("lift = ").nth(1).unwrap().split(':').next().unwrap().trim().parse().unwrap();
    assert!((1.3..=1.5).contains(&at), "{}", said[0]);
    let found = traced(&format!("{text}range = [-2, 1.2]\n"), &[], 1e-8);
    assert!(found.trace.warnings.is_empty(), "{:?}", found.trace.warnings);
}
