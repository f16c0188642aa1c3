//! Branches that hang together with nothing: found once each, and followed to the ends of the range.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchEnd, BranchOrigin, Crossing, PointKind, Solution};
use support::{bundled, crossings, traced};

fn same(a: &Solution, b: &Solution) -> bool {
    a.beams[0].samples.iter().zip(&b.beams[0].samples).all(|(p, q)| {
        (p.pose.position - q.pose.position).norm() < 1e-7 && p.pose.rotation.angle_to(&q.pose.rotation) < 1e-5
    })
}

#[test]
fn no_branch_is_found_twice_and_none_ends_on_its_way() {
    let text = bundled(
        "strip_on_slope.toml",
        "parameter = \"push\"\nrange = [0, 25]\nguesses = 10\nbranches = true",
    );
    let found = traced(&text, &[], 1e-8);
    let branches = &found.trace.branches;
    for branch in branches {
        assert!(
            branch.ends.iter().all(|end| matches!(end, BranchEnd::Range | BranchEnd::Start)),
            "{:?}",
            branch.ends
        );
    }
    let ends: Vec<_> = branches
        .iter()
        .enumerate()
        .flat_map(|(i, branch)| [(i, &branch.points[0]), (i, &branch.points[branch.points.len() - 1])])
        .collect();
    for (k, (i, a)) in ends.iter().enumerate() {
        for (j, b) in &ends[k + 1..] {
            let (p, q) = (a.solution.as_ref().unwrap(), b.solution.as_ref().unwrap());
            assert!(
                (a.parameter - b.parameter).abs() > 1e-9 || !same(p, q),
                "branches {i} and {j} have the same end at {}",
                a.parameter
            );
        }
    }
    // The wanted bow's branch with its fold (Table 5.2 of the strip on a slope), and the folds of mirror images alike.
    let folds: Vec<f64> = found.points().filter(|p| p.kind == PointKind::Fold).map(|p| p.parameter).collect();
    assert!(folds.iter().any(|push| (push - 17.476_120_897_3).abs() < 1e-7), "{folds:?}");
    for point in found.points().filter(|point| matches!(point.kind, PointKind::Fold | PointKind::Branch(_))) {
        assert!(
            point.error_estimate <= 1e-8,
            "{:?} at {}: {:e}",
            point.kind,
            point.parameter,
            point.error_estimate
        );
    }
}

/// Led away, an imperfection shows the branch whose fold is known.
#[test]
fn an_imperfection_led_to_zero_ends_on_the_other_branch() {
    let text = bundled(
        "strip_on_slope.toml",
        "parameter = \"push\"\nrange = [0, 25]\nimperfection = { parameter = \"slope\", from = \"120 deg\" }",
    );
    let found = traced(&text, &[], 1e-8);
    let branch =
        found.trace.branches.iter().find(|branch| branch.origin == BranchOrigin::Imperfection).unwrap();
    let folds: Vec<f64> =
        branch.points.iter().filter(|p| p.kind == PointKind::Fold).map(|p| p.parameter).collect();
    assert_eq!(folds.len(), 1);
    assert!((folds[0] - 17.476_120_897_3).abs() < 1e-7);
}

/// Both arms of a pitchfork are mirror images, to round-off; the branch that is left stays on its axis.
#[test]
fn arms_are_mirror_images_and_the_straight_branch_stays_straight() {
    let text =
        bundled("euler_clamped_clamped.toml", "parameter = \"push\"\nrange = [0, 60]\nbranches = true");
    let found = traced(&text, &[], 1e-9);
    let [straight, arms] = &found.trace.branches[..] else { panic!("{}", found.trace.branches.len()) };
    for point in &straight.points {
        assert!(found.value(point, "middle").abs() < 1e-14, "{point:?}");
        let critical = 4.0 * std::f64::consts::PI.powi(2);
        if (point.parameter - critical).abs() > 1e-6 {
            assert_eq!(point.unstable_directions, Some(usize::from(point.parameter > critical)));
        }
    }
    assert_eq!(crossings(straight).len(), 1);
    assert_eq!(crossings(arms)[0].1, Crossing::SupercriticalPitchfork);
    let count = arms.points.len();
    assert_eq!(count % 2, 1);
    for (a, b) in arms.points.iter().zip(arms.points.iter().rev()) {
        assert!((a.parameter - b.parameter).abs() < 1e-9 * 60.0);
        assert!((found.value(a, "middle") + found.value(b, "middle")).abs() < 1e-9);
        assert_eq!(a.unstable_directions, b.unstable_directions);
        assert!((a.arc + b.arc - arms.points[count - 1].arc).abs() < 1e-8);
    }
}
