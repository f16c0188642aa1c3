//! One suite that every kind of joint must pass.

use super::*;
use flexura_model::{JointLaw, Surface, SurfaceMotion};
use flexura_spatial::{Vector3, log};
use touching::samples::{cylinder, ellipsoid, heights, other, pear, sample, wide};

const ROLLING: SurfaceMotion = SurfaceMotion::Rolling { about: Vector3::new(0.3, 1.0, -0.4) };
const OSCULATING: SurfaceMotion = SurfaceMotion::Osculating { about: Vector3::new(0.3, 1.0, -0.4) };

/// A joint, and coordinates at which it is looked at.
struct Case {
    joint: Joint,
    wanted: Vec<f64>,
}

impl From<JointKind> for Case {
    fn from(kind: JointKind) -> Self {
        let (axis, second_axis) = (Vector3::new(2.0, -1.0, 2.0) / 3.0, Vector3::new(2.0, 2.0, -1.0) / 3.0);
        let law = JointLaw { second_axis, ..JointLaw::free(kind, axis) };
        let joint = Joint::new(&law, 1.0, &Pose::identity()).unwrap();
        Case { joint, wanted: [0.4, -0.7, 0.2, 0.5, 0.3, -0.6][..kind.freedoms()].to_vec() }
    }
}

/// Two surfaces, with lengths in units of 0.7 m.
fn surfaces(child: Surface, parent: Surface, concave: bool, motion: SurfaceMotion) -> Case {
    let joint = sample(child, parent, concave, motion, 0.7);
    // In view of home: the inverse of the retraction does not see the far side of a body.
    let home = joint.coordinates(&joint.home());
    let way = [0.4, -0.7, 0.2, 0.5, 0.3];
    let wanted = (0..joint.freedoms()).map(|i| home[i] + way[i]).collect();
    Case { joint, wanted }
}

fn subspace_is_the_derivative_of_the_pose(Case { joint, wanted }: Case) {
    let kind = joint.kind;
    let at = joint.configuration(&wanted);
    for i in 0..joint.freedoms() {
        let central = |h: f64| {
            let [plus, minus] = [h, -h].map(|x| {
                let mut step = [0.0; MAX_FREEDOMS];
                step[i] = x;
                joint.pose(&joint.moved(&at, &step))
            });
            let turning = log(&(plus.rotation * minus.rotation.inverse())) / (2.0 * h);
            (turning, (plus.position - minus.position) / (2.0 * h))
        };
        // Richardson's extrapolation: the error of fourth order.
        let (once, twice) = (central(1e-3), central(2e-3));
        let turning = (once.0 * 4.0 - twice.0) / 3.0;
        let shift = (once.1 * 4.0 - twice.1) / 3.0;
        let column = joint.subspace(&at, i);
        assert!((turning - column.angular).norm() < 1e-8, "{kind:?}");
        assert!((shift - column.linear).norm() < 1e-8, "{kind:?}");
    }
}

fn subspace_changes_as_it_says(Case { joint, wanted }: Case) {
    let kind = joint.kind;
    let at = joint.configuration(&wanted);
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

fn coordinates_come_back(Case { joint, wanted }: Case) {
    let kind = joint.kind;
    let at = joint.configuration(&wanted);
    assert!(
        joint.coordinates(&at)[..kind.freedoms()].iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-14)
    );
    let nearest = joint.nearest(&joint.pose(&at));
    assert!(nearest.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-14), "{kind:?}");
    let step = joint.step(&joint.home(), &at);
    let reached = joint.moved(&joint.home(), &step);
    assert!(reached.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-14), "{kind:?}: {reached:?} {at:?}");
}

/// Efforts of springs to a rest value have the energy ½ Σ k (q - rest)²; its slope and curvature along H are
/// minus the generalised force and its tangent.
fn generalised_force_is_the_slope_of_the_energy(Case { joint, wanted }: Case) {
    let kind = joint.kind;
    let at = joint.configuration(&wanted);
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

fn home_is_the_identity(Case { joint, .. }: Case) {
    let pose = joint.pose(&joint.home());
    assert!(pose.position.norm() == 0.0 && pose.rotation.angle() == 0.0);
}

macro_rules! conformance {
    ($($name:ident => $case:expr $(, $more:ident)?);*) => {$(
        mod $name {
            use super::*;
            #[test]
            fn subspace_is_the_derivative_of_the_pose() { super::subspace_is_the_derivative_of_the_pose($case.into()) }
            #[test]
            fn subspace_changes_as_it_says() { super::subspace_changes_as_it_says($case.into()) }
            #[test]
            fn coordinates_come_back() { super::coordinates_come_back($case.into()) }
            #[test]
            fn generalised_force_is_the_slope_of_the_energy() {
                super::generalised_force_is_the_slope_of_the_energy($case.into())
            }
            $($more!($case);)?
        }
    )*};
}

/// Joints without boundaries start where F and M coincide.
macro_rules! from_the_identity {
    ($case:expr) => {
        #[test]
        fn home_is_the_identity() {
            super::home_is_the_identity($case.into())
        }
    };
}

conformance!(
    weld => JointKind::Weld, from_the_identity;
    revolute => JointKind::Revolute, from_the_identity;
    prismatic => JointKind::Prismatic, from_the_identity;
    cylindrical => JointKind::Cylindrical, from_the_identity;
    universal => JointKind::Universal, from_the_identity;
    spherical => JointKind::Spherical, from_the_identity;
    planar => JointKind::Planar, from_the_identity;
    free => JointKind::Free, from_the_identity;
    ellipsoid_on_ellipsoid => surfaces(ellipsoid(), other(), false, SurfaceMotion::Sliding);
    ellipsoid_in_a_hollow => surfaces(ellipsoid(), wide(), true, SurfaceMotion::Sliding);
    ellipsoid_on_a_plane => surfaces(ellipsoid(), Surface::Plane, false, SurfaceMotion::Sliding);
    ellipsoid_on_a_cylinder => surfaces(ellipsoid(), cylinder(), false, SurfaceMotion::Sliding);
    plane_on_an_ellipsoid => surfaces(Surface::Plane, ellipsoid(), false, SurfaceMotion::Sliding);
    cylinder_on_an_ellipsoid => surfaces(cylinder(), ellipsoid(), false, SurfaceMotion::Sliding);
    pear_on_an_ellipsoid => surfaces(pear(), other(), false, SurfaceMotion::Sliding);
    ellipsoid_on_a_pear => surfaces(ellipsoid(), pear(), false, SurfaceMotion::Sliding);
    heights_on_an_ellipsoid => surfaces(heights(), other(), false, SurfaceMotion::Sliding);
    ellipsoid_on_heights => surfaces(ellipsoid(), heights(), false, SurfaceMotion::Sliding);
    ellipsoid_rolls_on_ellipsoid => surfaces(ellipsoid(), other(), false, ROLLING);
    ellipsoid_rolls_in_a_hollow => surfaces(ellipsoid(), wide(), true, ROLLING);
    cylinder_rolls_on_an_ellipsoid => surfaces(cylinder(), ellipsoid(), false, ROLLING);
    pear_rolls_on_heights => surfaces(pear(), heights(), false, ROLLING);
    ellipsoid_rolls_osculating => surfaces(ellipsoid(), other(), false, OSCULATING);
    pear_rolls_on_a_plane_osculating => surfaces(pear(), Surface::Plane, false, OSCULATING)
);
