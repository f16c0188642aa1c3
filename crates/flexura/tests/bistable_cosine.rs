//! The cosine beam of bistable switches (J. Qiu, J. H. Lang and A. H. Slocum, *J. Microelectromech. Syst.* 13 (2004) 137): where both of its
//! halves give way, and the branches on which one or both are bent, against curves of one half by collocation.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchOrigin, Crossing};
use flexura::spatial::{Pose, Vector3};
use flexura_testkit::collocation::{self, Mesh, Tip};
use flexura_testkit::ivp::rest_poses;
use flexura_testkit::rod::Rod;
use support::{crossings, traced};

const PI: f64 = std::f64::consts::PI;
const H: f64 = 60e-6;
const SPAN: f64 = 3e-3;
const YOUNG: f64 = 169e9;
const WIDTH: f64 = 10e-6;
const HEIGHT: f64 = 480e-6;

/// dy/dx of the rest shape y = h (1 - cos 2πx/L)/2.
fn rise(x: f64) -> f64 {
    PI * H / SPAN * (2.0 * PI * x / SPAN).sin()
}

/// Arc length from the clamp to x, by Simpson's rule.
fn arc(x: f64) -> f64 {
    let n = 40;
    let rate = |i: usize| 1.0_f64.hypot(rise(x * i as f64 / n as f64));
    let inner: f64 = (1..n).map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * rate(i)).sum();
    x / (3.0 * n as f64) * (rate(0) + inner + rate(n))
}

/// The rest curvature at arc length s.
fn curvature(s: f64) -> f64 {
    let mut x = s;
    for _ in 0..4 {
        x -= (arc(x) - s) / 1.0_f64.hypot(rise(x));
    }
    let bent = 2.0 * (PI / SPAN).powi(2) * H * (2.0 * PI * x / SPAN).cos();
    bent / (1.0 + rise(x).powi(2)).powf(1.5)
}

/// One half whose middle is pushed down by `drop` where a transverse load of `aside` N/m chooses the side to which it bends.
fn half(drop: f64, aside: f64) -> collocation::Solution {
    let (area, inertia) = (WIDTH * HEIGHT, HEIGHT * WIDTH.powi(3) / 12.0);
    let stiff = 1.0 / (YOUNG * inertia);
    let rod = Rod {
        length: arc(0.5 * SPAN),
        compliance: [1.0 / (YOUNG * area), 0.0, 0.0, stiff, stiff, stiff],
        rest: Box::new(|s| Vector3::new(0.0, 0.0, curvature(s))),
        load: Box::new(move |_| Vector3::new(0.0, aside, 0.0)),
        reaction: None,
    };
    let rest = rest_poses(&rod, 200).last().unwrap().1;
    let tip =
        |part: f64| Tip::Pose(Pose::new(rest.rotation, rest.position + Vector3::new(0.0, -drop * part, 0.0)));
    let steps = (drop / 0.6e-6).ceil() as usize;
    collocation::solve(&rod, &Pose::identity(), &tip, steps, Mesh { elements: 1, degree: 22 }).unwrap()
}

fn force(drop: f64, aside: f64) -> f64 {
    -half(drop, aside).tip().force.y
}

/// The same without that load, by what it is with little of it.
fn bent(drop: f64) -> f64 {
    2.0 * force(drop, ASIDE) - force(drop, 2.0 * ASIDE)
}

/// N/m: enough to choose a side, and little enough that forces change in proportion.
const ASIDE: f64 = 0.005;

#[test]
fn both_halves_of_a_cosine_beam_give_way_at_its_first_snap_force_and_bend_each_for_itself() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/models/cosine_beam_of_two_halves.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let text = text.replace("\"2.2*h\"]", "\"30 um\"]\nbranches = 12");
    let found = traced(&text, &[], 1e-8);
    let trunk = &found.trace.branches[0];
    assert_eq!(crossings(trunk).len(), 1);
    let (at, crossing) = crossings(trunk)[0];
    assert_eq!(crossing, Crossing::Multiple(2));

    let (straight, bent_down) = (force(30e-6, 0.0), bent(30e-6));
    let mut ends = Vec::new();
    for branch in found.trace.branches.iter().filter(|b| matches!(b.origin, BranchOrigin::Switched { .. })) {
        for point in [branch.points.first().unwrap(), branch.points.last().unwrap()] {
            assert!((point.parameter - 30e-6).abs() < 1e-15);
            ends.push((found.value(point, "force"), point.unstable_directions));
        }
    }
    let one = ends.iter().filter(|(force, unstable)| {
        (force - straight - bent_down).abs() < 2e-6 * straight && *unstable == Some(1)
    });
    let both = ends.iter().filter(|(force, unstable)| {
        (force - 2.0 * bent_down).abs() < 2e-6 * straight && *unstable == Some(0)
    });
    assert_eq!((ends.len(), one.count(), both.count()), (8, 4, 4), "{ends:?} {straight} {bent_down}");

    // What a small load does to the middle of a half grows without bound as the branch point is approached: its inverse ends there.
    let drops = [8.5e-6, 9.5e-6, 10.5e-6, 11.4e-6];
    let stiffness = drops.map(|drop| {
        let middle = half(drop, 1e-5).at(0.5 * arc(0.5 * SPAN)).pose().position.y;
        1e-5 / (middle - 0.5 * (H - drop))
    });
    // The cubic through all four.
    let left = |drop: f64| -> f64 {
        let others = |i: usize| (0..4).filter(move |j| *j != i);
        let weight =
            |i: usize| -> f64 { others(i).map(|j| (drop - drops[j]) / (drops[i] - drops[j])).product() };
        (0..4).map(|i| stiffness[i] * weight(i)).sum()
    };
    let critical = flexura_testkit::roots::root(left, 11e-6, 13e-6).unwrap();
    assert!((at - critical).abs() < 1e-4 * critical, "{at} {critical}");
    let snap = found.trace.branches[0].points.iter().find(|point| point.parameter == at).unwrap();
    // At the point itself the equations are singular: by a cubic through its neighbours.
    let beside = |part: f64| force(at + part * 0.3e-6, 0.0);
    let exact = (9.0 * (beside(-1.0) + beside(1.0)) - beside(-3.0) - beside(3.0)) / 8.0;
    assert!((found.value(snap, "force") - exact).abs() < 2e-6 * exact, "{exact}");
}
