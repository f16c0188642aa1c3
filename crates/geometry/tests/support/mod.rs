//! An integrator that shares nothing with the library: three-stage Gauss collocation for the quaternion
//! q' = ½ q (0, k) and the position p' = R e1.

#![allow(dead_code)]

use flexura_expression::Function;
use flexura_geometry::RestShape;
use flexura_model::{Curve, SectionFrame};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Position and orientation at the ends of `steps` equal steps from 0 to `to`, start included.
pub fn integrate(
    k: impl Fn(f64) -> Vector3<f64>,
    to: f64,
    steps: usize,
) -> Vec<(f64, Vector3<f64>, UnitQuaternion<f64>)> {
    let r = 15f64.sqrt();
    let c = [0.5 - r / 10.0, 0.5, 0.5 + r / 10.0];
    let a = [
        [5.0 / 36.0, 2.0 / 9.0 - r / 15.0, 5.0 / 36.0 - r / 30.0],
        [5.0 / 36.0 + r / 24.0, 2.0 / 9.0, 5.0 / 36.0 - r / 24.0],
        [5.0 / 36.0 + r / 30.0, 2.0 / 9.0 + r / 15.0, 5.0 / 36.0],
    ];
    let b = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];
    let h = to / steps as f64;
    let rate = |q: Quaternion<f64>, k: Vector3<f64>| q * Quaternion::from_imag(k) * 0.5;
    let tangent = |q: Quaternion<f64>| (q * Quaternion::from_imag(Vector3::x()) * q.conjugate()).imag();
    let (mut q, mut p) = (Quaternion::identity(), Vector3::zeros());
    let mut path = vec![(0.0, p, UnitQuaternion::identity())];
    for n in 0..steps {
        let s = n as f64 * h;
        let ks = c.map(|c| k(s + c * h));
        let mut slopes = ks.map(|k| rate(q, k));
        for _ in 0..12 {
            let stage: [Quaternion<f64>; 3] = std::array::from_fn(|i| {
                q + (slopes[0] * a[i][0] + slopes[1] * a[i][1] + slopes[2] * a[i][2]) * h
            });
            slopes = std::array::from_fn(|i| rate(stage[i], ks[i]));
        }
        for i in 0..3 {
            let stage = q + (slopes[0] * a[i][0] + slopes[1] * a[i][1] + slopes[2] * a[i][2]) * h;
            p += tangent(stage) * (b[i] * h);
        }
        q += (slopes[0] * b[0] + slopes[1] * b[1] + slopes[2] * b[2]) * h;
        path.push((s + h, p, UnitQuaternion::from_quaternion(q)));
    }
    path
}

/// The largest distance, relative to the length, and the largest angle between the shape's own poses and
/// the integral of its curvatures.
pub fn mismatch(shape: &RestShape, steps: usize) -> (f64, f64) {
    // Integrate piece by piece, so that a kink never lies inside a step.
    let mut ends = shape.breaks().to_vec();
    ends.push(shape.length());
    let (mut from, mut start) = (0.0, (Vector3::zeros(), UnitQuaternion::identity()));
    let (mut worst, mut worst_angle) = (0.0f64, 0.0f64);
    for end in ends {
        let pieces = ((steps as f64 * (end - from) / shape.length()).ceil() as usize).max(4);
        let path = integrate(|s| shape.curvature(from + s), end - from, pieces);
        for (s, p, q) in &path {
            let pose = shape.pose(from + s);
            worst = worst.max((pose.position - (start.0 + start.1 * p)).norm() / shape.length());
            worst_angle = worst_angle.max(pose.rotation.angle_to(&(start.1 * q)));
        }
        let (_, p, q) = path[path.len() - 1];
        start = (start.0 + start.1 * p, start.1 * q);
        from = end;
    }
    (worst, worst_angle)
}

/// A parametric curve from three expressions in t.
pub fn parametric(expressions: [&str; 3], range: [f64; 2]) -> Curve {
    let position = expressions.map(|text| Function::parse(text, "t").expect("a good expression"));
    Curve::Parametric { position, range }
}

/// The shape, or the test fails.
pub fn shape(curve: &Curve, frame: SectionFrame) -> RestShape {
    RestShape::new(curve, &frame).expect("a good curve")
}

/// Rotation-minimising from the default start, without twist.
pub fn minimising() -> SectionFrame {
    SectionFrame::RotationMinimising { start: None, twist: None }
}
