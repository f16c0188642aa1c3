//! Properties that every rest shape has.

mod support;

use flexura_geometry::RestShape;
use flexura_model::{Curve, SectionFrame};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use support::{minimising, mismatch};

fn turn() -> impl Strategy<Value = UnitQuaternion<f64>> {
    (-3.0..3.0, -3.0..3.0, -3.0..3.0)
        .prop_map(|(x, y, z)| UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z)))
}

/// Points along a random smooth curve, none of them close to the next.
fn points() -> impl Strategy<Value = Vec<Vector3<f64>>> {
    prop::collection::vec((0.3..1.0, -0.6..0.6, -0.6..0.6), 1..9).prop_map(|steps| {
        let mut points = vec![Vector3::zeros()];
        for (x, y, z) in steps {
            let last = points[points.len() - 1];
            points.push(last + Vector3::new(x, y, z));
        }
        points
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn rotating_and_moving_the_points_changes_nothing(points in points(), turn in turn()) {
        let start = Vector3::new(0.1, 0.2, 1.0);
        let frame = |start| SectionFrame::RotationMinimising { start: Some(start), twist: None };
        let moved = points.iter().map(|p| turn * p + Vector3::new(3.0, -1.0, 2.0)).collect();
        let here = RestShape::new(&Curve::Points { points }, &frame(start)).unwrap();
        let there = RestShape::new(&Curve::Points { points: moved }, &frame(turn * start)).unwrap();
        prop_assert!((here.length() - there.length()).abs() < 1e-13 * here.length());
        for i in 0..=10 {
            let s = here.length() * f64::from(i) / 10.0;
            let (a, b) = (here.curvature(s), there.curvature(s));
            prop_assert!((a - b).norm() < 1e-11 * (1.0 + a.norm()), "{} {}", a, b);
            prop_assert!((here.pose(s).position - there.pose(s).position).norm() < 1e-12);
        }
    }

    #[test]
    fn scaling_the_points_scales_lengths_and_curvatures(points in points(), scale in 1e-6..1e6f64) {
        let scaled = points.iter().map(|p| p * scale).collect();
        let here = RestShape::new(&Curve::Points { points }, &minimising()).unwrap();
        let there = RestShape::new(&Curve::Points { points: scaled }, &minimising()).unwrap();
        prop_assert!((there.length() / scale - here.length()).abs() < 1e-13 * here.length());
        for i in 0..=10 {
            let s = here.length() * f64::from(i) / 10.0;
            let (a, b) = (here.curvature(s), there.curvature(s * scale) * scale);
            prop_assert!((a - b).norm() < 1e-10 * (1.0 + a.norm()), "{} {}", a, b);
        }
    }

    #[test]
    fn curvatures_integrate_back_to_the_curve(points in points()) {
        let shape = RestShape::new(&Curve::Points { points }, &minimising()).unwrap();
        // Sharp bends between close points need the reference integrator to be this fine.
        let (distance, angle) = mismatch(&shape, 12_000);
        prop_assert!(distance < 1e-10 && angle < 1e-9, "{} {}", distance, angle);
    }

    #[test]
    fn helices_of_any_proportion_integrate_back(
        radius in 0.1..10.0, pitch in -20.0..20.0f64, turns in 0.1..5.0,
    ) {
        let curve = Curve::Helix { radius, pitch, turns };
        let shape = RestShape::new(&curve, &SectionFrame::Natural).unwrap();
        let (distance, angle) = mismatch(&shape, 1500);
        prop_assert!(distance < 1e-12 && angle < 1e-11, "{} {}", distance, angle);
    }
}

#[test]
fn a_rest_shape_may_be_shared_between_threads() {
    fn shareable<T: Send + Sync + Clone>() {}
    shareable::<RestShape>();
}
