//! Paths of loops that are held more often than needed: reading off the wrenches of least norm must not disturb the way on.

mod support;

use support::{bundled, traced};

#[test]
fn a_rigid_four_bar_is_followed_by_its_crank() {
    let text = bundled("rigid_four_bar.toml", "parameter = \"crank\"\nrange = [\"0 deg\", \"60 deg\"]");
    let run = traced(&text, &[], 1e-10);
    let points = &run.trace.branches[0].points;
    let end = points.last().map(|point| point.parameter);
    assert!(end.is_some_and(|end| (end - 60f64.to_radians()).abs() < 1e-12), "{end:?}");
    // A smooth motion needs no small steps.
    assert!(points.len() < 80, "{} points", points.len());
}
