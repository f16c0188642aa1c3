//! What a trace finds does not depend on its tolerance, its direction, its steps, or what was traced before.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchEnd, Crossing};
use support::{Run, bundled, crossings, traced};

const LEE: &str = "parameter = \"load\"\nrange = [-2, 2.5]\nstart = 0";
const SNAP: &str = "parameter = \"travel\"\nrange = [\"0 mm\", \"8 mm\"]";

#[test]
fn a_drive_arrives_at_every_tolerance() {
    let text = bundled("bistable_beam.toml", SNAP);
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11] {
        let found = traced(&text, &[], tolerance);
        assert_eq!(found.trace.branches[0].ends, [BranchEnd::Start, BranchEnd::Range], "{tolerance:e}");
        let met = crossings(&found.trace.branches[0]);
        assert_eq!(met.len(), 2, "{tolerance:e}: {met:?}");
        for ((travel, crossing), wanted) in met.iter().zip([285.871_118_15e-6, 5.524_115_414e-3]) {
            assert!((travel - wanted).abs() < 1e-13, "{tolerance:e}: {travel}");
            assert_eq!(*crossing, Crossing::SupercriticalPitchfork);
        }
    }
}

/// Parameter and outputs at every fold, in the order of the parameter.
fn folds(run: &Run) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = run
        .folds(0)
        .iter()
        .map(|point| {
            let outputs = point.outputs.iter().flatten().flatten();
            std::iter::once(point.parameter).chain(outputs.copied()).collect()
        })
        .collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

#[test]
fn folds_are_the_same_at_every_tolerance_and_with_other_steps() {
    let text = bundled("lee_frame.toml", LEE);
    let best = folds(&traced(&text, &[], 1e-11));
    assert_eq!(best.len(), 2);
    for (tolerance, steps) in [(1e-7, 40), (1e-8, 40), (1e-9, 25), (1e-9, 160), (1e-10, 77)] {
        let found = folds(&traced(&format!("{text}steps = {steps}\n"), &[], tolerance));
        assert_eq!(found.len(), 2, "{tolerance:e}");
        for (found, best) in found.iter().flatten().zip(best.iter().flatten()) {
            assert!(
                (found - best).abs() <= 30.0 * tolerance * (1.0 + best.abs()),
                "{tolerance:e}: {found} {best}"
            );
        }
    }
}

#[test]
fn a_path_is_the_same_from_its_other_end() {
    let forth = traced(&bundled("lee_frame.toml", LEE), &[], 1e-9);
    // The end on the far side of both folds: from there, another start of the same path.
    let last = forth.trace.branches[0].points.last().unwrap();
    assert!((last.parameter - 2.5).abs() < 1e-12);
    let text = bundled("lee_frame.toml", "parameter = \"load\"\nrange = [2.5, -2]\nstart = 0");
    let back = traced(&text, &[], 1e-9);
    for (a, b) in folds(&forth).iter().flatten().zip(folds(&back).iter().flatten()) {
        assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "{a} {b}");
    }
    let (a, b) = (&forth.trace.branches[0].points, &back.trace.branches[0].points);
    let ends = |points: &[flexura::solution::TracePoint]| {
        let mut ends = [points[0].outputs.clone(), points[points.len() - 1].outputs.clone()];
        ends.sort_by(|a, b| a[0].as_ref().unwrap()[0].total_cmp(&b[0].as_ref().unwrap()[0]));
        ends
    };
    for (a, b) in ends(a).iter().flatten().zip(ends(b).iter().flatten()) {
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() < 1e-7 * (1.0 + b.abs()), "{a} {b}");
        }
    }
}

/// The estimate bounds the difference between a loose and a tight trace, in the nondimensional measure of the solver: outputs here
/// are lengths in L or forces in EI/L², give or take the factor of the output.
#[test]
fn errors_stay_below_their_estimates() {
    let text = bundled("lee_frame.toml", LEE);
    let (loose, tight) = (traced(&text, &[], 1e-6), traced(&text, &[], 1e-12));
    for (a, b) in loose.folds(0).iter().zip(tight.folds(0)) {
        assert!(
            a.error_estimate <= 1e-6 && b.error_estimate <= 1e-11,
            "{:e} {:e}",
            a.error_estimate,
            b.error_estimate
        );
        let error = (a.parameter - b.parameter).abs() / b.parameter.abs();
        assert!(error <= 10.0 * a.error_estimate + 1e-11, "{error:e} for {:e}", a.error_estimate);
    }
    let text = bundled("strip_on_slope.toml", "parameter = \"push\"\nrange = [0, 25]");
    let (loose, tight) = (traced(&text, &[], 1e-7), traced(&text, &[], 1e-12));
    let last = |run: &Run| {
        let point = run.trace.branches[0].points.last().unwrap().clone();
        (run.value(&point, "w"), point.error_estimate)
    };
    let ((a, estimate), (b, _)) = (last(&loose), last(&tight));
    assert!((a - b).abs() <= estimate, "{:e} for {estimate:e}", (a - b).abs());
}

#[test]
fn a_trace_leaves_nothing_behind_for_the_next() {
    let text = bundled("strip_on_slope.toml", "parameter = \"push\"\nrange = [0, 25]\nsteps = 20");
    let alone = traced(&text, &[], 1e-8);
    traced(&text, &[("weight", "1.6"), ("slope", "90 deg")], 1e-6);
    let again = traced(&text, &[], 1e-8);
    assert_eq!(alone.trace.work, again.trace.work);
    for (a, b) in alone.points().zip(again.points()) {
        assert_eq!(a.parameter.to_bits(), b.parameter.to_bits());
        assert_eq!(a.outputs, b.outputs);
    }
}
