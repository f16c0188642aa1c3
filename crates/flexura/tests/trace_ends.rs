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

/// A weight on a cable of given length, lifted: the cable would have to push from where the load changes sign, 1.3.
#[test]
fn a_cable_that_would_have_to_push_is_told_along_a_trace() {
    let text = "format = 1\n[parameter]\nlift = -2\n[body.weight]\nat = [0, 0, 0]\n[joint.rail]\nkind = \"prismatic\"\naxis = [0, 1, 0]\n\
         parent = \"ground\"\nchild = \"weight\"\nstiffness = 1\n[cable.c]\nlength = 1\n\
         route = [{ body = \"ground\", at = [0, 1, 0] }, { body = \"weight\", at = [0, 0, 0] }]\n\
         [load.up]\nbody = \"weight\"\nforce = [0, \"lift - 1.3\", 0]\n[study.path]\nkind = \"trace\"\nparameter = \"lift\"\nsteps = 40\n";
    let found = traced(&format!("{text}range = [-2, 4]\n"), &[], 1e-8);
    let said: Vec<_> = found
        .trace
        .warnings
        .iter()
        .filter(|warning| warning.contains("cable.c would have to push"))
        .collect();
    assert_eq!(said.len(), 1, "{:?}", found.trace.warnings);
    let at: f64 = said[0].split("lift = ").nth(1).unwrap().split(':').next().unwrap().trim().parse().unwrap();
    assert!((1.3..=1.5).contains(&at), "{}", said[0]);
    let found = traced(&format!("{text}range = [-2, 1.2]\n"), &[], 1e-8);
    assert!(found.trace.warnings.is_empty(), "{:?}", found.trace.warnings);
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

/// A slider on a spring of 1 N/m that a second one of 50 N/m catches after 0.2 m: x = f up to there, and x = (f + 10)/51 beyond.
#[test]
fn a_path_is_led_round_the_corner_where_a_spring_becomes_taut() {
    let text = "format = 1\n[parameter]\nf = 0\n[body.b]\n[joint.way]\nkind = \"prismatic\"\nparent = \"ground\"\nchild = \"b\"\naxis = [1, 0, 0]\n\
         effort = \"f\"\nstiffness = 1\n\
         [spring.rope]\nfrom = { body = \"ground\", at = [-1, 0, 0] }\nto = { body = \"b\" }\nstiffness = 50\nrest_length = 1.2\ntension_only = true\n\
         [study.path]\nkind = \"trace\"\nparameter = \"f\"\nrange = [0, 2]\n[output]\nx = \"joint.way.coordinate\"\n";
    let found = run(text, &[], 1e-8);
    assert_eq!(found.trace.status, Status::Converged, "{:?}", found.trace.reason);
    let points = &found.trace.branches[0].points;
    for point in points {
        let x = point.solution.as_ref().map(|solution| solution.bodies[0].position.x);
        let f = point.parameter;
        let wanted = if f < 0.2 { f } else { (f + 10.0) / 51.0 };
        assert!(x.is_none_or(|x| (x - wanted).abs() < 1e-7), "{f}: {x:?}");
    }
    assert!((points.last().unwrap().parameter - 2.0).abs() < 1e-12);
    assert!(points.len() < 120, "{}", points.len());
}

/// Beyond the corner there is no equilibrium near: `solve` and the path say the same.
#[test]
fn a_path_that_turns_back_where_a_spring_goes_slack_says_so() {
    let text = include_str!("from_rest/spring_goes_slack.toml");
    let text = format!("{text}\n[study.path]\nkind = \"trace\"\nparameter = \"f\"\nrange = [0, 1]\n");
    let found = run(&text, &[], 1e-8);
    let BranchEnd::Stalled(why) = &found.trace.branches[0].ends[1] else {
        panic!("{:?}", found.trace.branches[0].ends)
    };
    assert!(why.contains("spring.k0 is between taut and slack"), "{why}");
    let last = found.trace.branches[0].points.last().unwrap().parameter;
    assert!((last - 0.0423).abs() < 1e-4, "{last}");
}
