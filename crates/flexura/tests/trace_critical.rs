//! Curves of critical points against single traces, and the work of a path, exact.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchEnd, PointKind};
use support::{bundled, crossings, traced};

#[test]
fn a_curve_of_folds_is_made_of_the_folds_of_single_paths() {
    let range =
        "parameter = \"push\"\nrange = [0, 25]\nimperfection = { parameter = \"slope\", from = \"120 deg\" }";
    let curve = "critical = { parameter = \"weight\", range = [0.4, 1.6] }";
    let found = traced(&bundled("strip_on_slope.toml", &format!("{range}\n{curve}")), &[], 1e-8);
    let critical = found.trace.critical.as_ref().unwrap();
    assert_eq!(critical.kind, PointKind::Fold);
    assert_eq!(critical.ends, [BranchEnd::Range, BranchEnd::Range]);
    let count = critical.points.len();
    for (weight, point) in [&critical.points[0], &critical.points[count / 3], &critical.points[count - 1]] {
        let value = format!("{weight:e}");
        let single = traced(&bundled("strip_on_slope.toml", range), &[("weight", &value)], 1e-9);
        let folds: Vec<f64> =
            single.points().filter(|p| p.kind == PointKind::Fold).map(|p| p.parameter).collect();
        assert_eq!(folds.len(), 1);
        assert!((folds[0] - point.parameter).abs() < 1e-6, "{weight}: {} {}", folds[0], point.parameter);
    }
    // Table 5.2 of the strip on a slope, level ground.
    let (weight, last) = &critical.points[count - 1];
    assert!(
        (weight - 1.6).abs() < 1e-9 && (last.parameter - 18.3031).abs() < 1e-4,
        "{weight} {}",
        last.parameter
    );
}

#[test]
fn a_curve_of_pitchforks_is_made_of_the_pitchforks_of_single_paths() {
    let range = "parameter = \"push\"\nrange = [0, 25]";
    let curve = "critical = { parameter = \"weight\", range = [0.8, 1.6] }";
    let upright = ("slope", "90 deg");
    let text = bundled("strip_on_slope.toml", &format!("{range}\n{curve}"));
    let found = traced(&text, &[upright, ("weight", "1.1")], 1e-8);
    let critical = found.trace.critical.as_ref().unwrap();
    assert!(matches!(critical.kind, PointKind::Branch(_)));
    // The values of the table at both ends.
    let first = &critical.points[0];
    assert!((first.1.parameter - 15.599_394_277).abs() < 1e-6, "{}", first.1.parameter);
    let last = &critical.points[critical.points.len() - 1];
    assert!((last.1.parameter - 15.197_576_774).abs() < 1e-6, "{}", last.1.parameter);
    for (weight, point) in critical.points.iter().step_by(7) {
        let value = format!("{weight:e}");
        let single = traced(&bundled("strip_on_slope.toml", range), &[upright, ("weight", &value)], 1e-9);
        let met = crossings(&single.trace.branches[0]);
        assert!((met[0].0 - point.parameter).abs() < 1e-6, "{weight}: {} {}", met[0].0, point.parameter);
    }
}

/// What one path costs: a change that makes it work more shows here. The tangent is made again where a fold may be near.
#[test]
fn a_quiet_path_makes_one_tangent_a_point() {
    let text = bundled("strip_on_slope.toml", "parameter = \"push\"\nrange = [0, 25]\nsteps = 90");
    let work = traced(&text, &[], 1e-8).trace.work;
    let counts = (work.points, work.refused, work.factorisations, work.residuals, work.inertias);
    assert_eq!(counts, (105, 0, 137, 392, 106));
}

#[test]
fn a_snap_and_its_folds_take_no_more_work_than_they_did() {
    let text = bundled("lee_frame.toml", "parameter = \"load\"\nrange = [-2, 2.5]\nstart = 0");
    let work = traced(&text, &[], 1e-8).trace.work;
    assert!(work.points <= 110 && work.refused <= 2, "{work:?}");
    assert!(work.factorisations <= 320 && work.residuals <= 650 && work.inertias <= 120, "{work:?}");
}
