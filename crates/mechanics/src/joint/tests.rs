//! One suite that every kind of joint must pass.

use super::*;
use flexura_spatial::{Vector3, log};

fn joint(kind: JointKind) -> Joint {
    let (axis, second_axis) = (Vector3::new(2.0, -1.0, 2.0) / 3.0, Vector3::new(2.0, 2.0, -1.0) / 3.0);
    let law = JointLaw { second_axis, ..JointLaw::free(kind, axis) };
    Joint::new(&law, 1.0, &Pose::identity()).unwrap()
}

fn coordinates(kind: JointKind) -> Vec<f64> {
    [0.4, -0.7, 0.2, 0.5, 0.3, -0.6][..kind.freedoms()].to_vec()
}

fn subspace_is_the_derivative_of_the_pose(kind: JointKind) {
    let joint = joint(kind);
    let at = joint.configuration(&coordinates(kind));
    let h = 1e-4;
    for i in 0..joint.freedoms() {
        let moved = |x: f64| {
            let mut step = [0.0; MAX_FREEDOMS];
            step[i] = x;
            joint.pose(&joint.moved(&at, &step))
        };
        let (plus, minus) = (moved(h), moved(-h));
        let turning = log(&(plus.rotation * minus.rotation.inverse())) / (2.0 * h);
        let shift = (plus.position - minus.position) / (2.0 * h);
        let column = joint.subspace(&at, i);
        assert!((turning - column.angular).norm() < 1e-8, "{kind:?}");
        assert!((shift - column.linear).norm() < 1e-8, "{kind:?}");
    }
}

fn subspace_changes_as_it_says(kind: JointKind) {
    let joint = joint(kind);
    let at = joint.configuration(&coordinates(kind));
    let h = 1e-5;
    for i in 0..joint.freedoms() {
        for j in 0..joint.freedoms() {
            let column = |x: f64| {
                let mut step = [0.0; MAX_FREEDOMS];
                step[j] = x;
                joint.subspace(&joint.moved(&at, &step), i)
            };
            let (plus, minus) = (column(h), column(-h));
            let change = joint.subspace_change(&at, i, j);
            assert!(((plus.angular - minus.angular) / (2.0 * h) - change.angular).norm() < 1e-8, "{kind:?}");
            assert!(((plus.linear - minus.linear) / (2.0 * h) - change.linear).norm() < 1e-8, "{kind:?}");
        }
    }
}

fn coordinates_come_back(kind: JointKind) {
    let joint = joint(kind);
    let wanted = coordinates(kind);
    let at = joint.configuration(&wanted);
    assert!(
        joint.coordinates(&at)[..kind.freedoms()].iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-14)
    );
    let nearest = joint.nearest(&joint.pose(&at));
    assert!(nearest.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-14), "{kind:?}");
    let step = joint.step(&joint.home(), &at);
    let reached = joint.moved(&joint.home(), &step);
    assert!(reached.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-14), "{kind:?}");
}

/// Efforts of springs to a rest value have the energy ½ Σ k (q - rest)²; its slope and curvature along H are
/// minus the generalised force and its tangent.
fn generalised_force_is_the_slope_of_the_energy(kind: JointKind) {
    let joint = joint(kind);
    let at = joint.configuration(&coordinates(kind));
    let (k, rest) = ([2.0, 0.7, 1.3, 0.9, 1.7, 0.4], [0.1, -0.2, 0.5, 0.3, 0.2, -0.1]);
    let force_at = |c: &Configuration| {
        let q = joint.coordinates(c);
        let tau = std::array::from_fn(|i| -k[i] * (q[i] - rest[i]));
        joint.generalised(c, &tau, &k.map(|k| -k))
    };
    let energy = |c: &Configuration| {
        let q = joint.coordinates(c);
        (0..joint.freedoms()).map(|i| 0.5 * k[i] * (q[i] - rest[i]).powi(2)).sum::<f64>()
    };
    let (force, tangent) = force_at(&at);
    let h = 1e-5;
    for j in 0..joint.freedoms() {
        let moved = |x: f64| {
            let mut step = [0.0; MAX_FREEDOMS];
            step[j] = x;
            joint.moved(&at, &step)
        };
        let slope = (energy(&moved(h)) - energy(&moved(-h))) / (2.0 * h);
        assert!((slope + force[j]).abs() < 1e-8, "{kind:?}: {slope} {force:?}");
        for i in 0..joint.freedoms() {
            let central = (force_at(&moved(h)).0[i] - force_at(&moved(-h)).0[i]) / (2.0 * h);
            assert!((central - tangent[i][j]).abs() < 1e-8, "{kind:?} {i} {j}");
        }
    }
}

fn home_is_the_identity(kind: JointKind) {
    let pose = joint(kind).pose(&joint(kind).home());
    assert!(pose.position.norm() == 0.0 && pose.rotation.angle() == 0.0);
}

macro_rules! conformance {
    ($($name:ident => $kind:expr),*) => {$(
        mod $name {
            use super::*;
            #[test]
            fn subspace_is_the_derivative_of_the_pose() { super::subspace_is_the_derivative_of_the_pose($kind) }
            #[test]
            fn subspace_changes_as_it_says() { super::subspace_changes_as_it_says($kind) }
            #[test]
            fn coordinates_come_back() { super::coordinates_come_back($kind) }
            #[test]
            fn generalised_force_is_the_slope_of_the_energy() {
                super::generalised_force_is_the_slope_of_the_energy($kind)
            }
            #[test]
            fn home_is_the_identity() { super::home_is_the_identity($kind) }
        }
    )*};
}

conformance!(
    weld => JointKind::Weld,
    revolute => JointKind::Revolute,
    prismatic => JointKind::Prismatic,
    cylindrical => JointKind::Cylindrical,
    universal => JointKind::Universal,
    spherical => JointKind::Spherical,
    planar => JointKind::Planar,
    free => JointKind::Free
);
