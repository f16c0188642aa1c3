//! Sliding surfaces against closed forms, and what must hold of every contact.

use super::law::{Host, turning};
use super::samples::*;
use super::*;
use crate::joint::Joint;
use flexura_geometry::SurfaceError;
use flexura_geometry::dual::vector::{rates, sum};
use flexura_model::{RevolutionProfile, Surface, SurfaceMotion, Surfaces};
use flexura_spatial::exp;

const SLIDING: SurfaceMotion = SurfaceMotion::Sliding;

fn pairs() -> Vec<(Surface, Surface, bool)> {
    vec![
        (ellipsoid(), other(), false),
        (ellipsoid(), wide(), true),
        (ellipsoid(), Surface::Plane, false),
        (Surface::Plane, ellipsoid(), false),
        (ellipsoid(), cylinder(), false),
        (cylinder(), ellipsoid(), false),
        (pear(), other(), false),
        (ellipsoid(), pear(), false),
        (heights(), wide(), true),
        (ellipsoid(), heights(), false),
    ]
}

/// Configurations around home.
fn around(joint: &Joint) -> Vec<Configuration> {
    let step = |i: usize| [0.3, -0.5, 0.2, 0.4, -0.3].map(|x| x * (1.0 - 0.7 * i as f64));
    (0..4).map(|i| joint.moved(&joint.home(), &step(i))).collect()
}

#[test]
fn points_meet_and_normals_oppose() {
    for (child, parent, concave) in pairs() {
        let joint = sample(child, parent, concave, SLIDING, 0.7);
        let sense = if concave { -1.0 } else { 1.0 };
        let [own, other] = joint.surfaces().unwrap();
        for at in around(&joint) {
            let (pose, contact) = (joint.pose(&at), joint.contact(&at).unwrap());
            let place = pose.position * 0.7 + pose.rotation * contact.points[0];
            assert!((place - contact.points[1]).norm() < 1e-14);
            let outwards = Vector3::from(own.normal(&contact.points[0].into()));
            assert!((pose.rotation * outwards + contact.normal).norm() < 1e-14);
            let outwards = Vector3::from(other.normal(&contact.points[1].into()));
            assert!((outwards * sense - contact.normal).norm() < 1e-14);
            assert!(contact.fits && contact.direction.norm() == 0.0);
            for (surface, point) in [(own, contact.points[0]), (other, contact.points[1])] {
                assert!(surface.value(&point.into()).abs() < 1e-14);
            }
            // Beside the contact the child is outside the parent, or within its hollow.
            let normal = own.normal(&contact.points[0].into());
            let [t1, t2] = tangents(&normal);
            for i in 0..12 {
                let (sin, cos) = (0.5 * f64::from(i)).sin_cos();
                let beside =
                    sum(&contact.points[0].into(), &sum(&scaled(0.05 * cos, &t1), &scaled(0.05 * sin, &t2)));
                let beside = own.along(&beside, &normal).unwrap();
                let seen = pose.position * 0.7 + pose.rotation * Vector3::from(beside);
                assert!(sense * other.value(&seen.into()) > 1e-5);
            }
        }
    }
}

/// Two balls: p = (r_B + σ r_A) n, whatever R is; turning about the contact leaves p where it is.
#[test]
fn balls_touch_at_the_sum_of_their_radii() {
    for (concave, radius, distance) in [(false, 1.3, 2.0), (true, 2.0, 1.3)] {
        let joint = sample(axes(0.7, 0.7, 0.7), axes(radius, radius, radius), concave, SLIDING, 1.0);
        let home = joint.pose(&joint.home());
        let towards = Vector3::new(1.0, 0.4, 0.6).normalize();
        assert!((home.position - towards * distance).norm() < 1e-14);
        assert!(joint.contact(&joint.home()).unwrap().radii[0].is_some_and(|r| (r - 0.7).abs() < 1e-14));
        let parent = joint.contact(&joint.home()).unwrap().radii[1].unwrap();
        assert!((parent - if concave { -radius } else { radius }).abs() < 1e-14);
        for at in around(&joint) {
            let [u, v] = [3, 4].map(|i| joint.coordinates(&at)[i]);
            let n = Vector3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
            assert!((joint.pose(&at).position - n * distance).norm() < 1e-14);
            for i in 0..3 {
                assert!(joint.subspace(&at, i).linear.norm() < 1e-14);
            }
            for i in 3..5 {
                assert!((joint.subspace(&at, i).linear.norm() - distance / radius).abs() < 1e-14);
            }
        }
    }
}

/// A force along the normal at the contact does no work on any of the five motions.
#[test]
fn the_normal_force_does_no_work() {
    for (child, parent, concave) in pairs() {
        let joint = sample(child, parent, concave, SLIDING, 0.7);
        for at in around(&joint) {
            let contact = joint.contact(&at).unwrap();
            let arm = contact.points[1] / 0.7 - joint.pose(&at).position;
            for i in 0..5 {
                let column = joint.subspace(&at, i);
                let work =
                    column.linear.dot(&contact.normal) + column.angular.dot(&arm.cross(&contact.normal));
                assert!(work.abs() < 1e-13, "{i} {work}");
            }
        }
    }
}

/// The formulas of the columns against the dual derivative of the position.
#[test]
fn columns_are_the_dual_derivatives_of_the_position() {
    for (child, parent, concave) in pairs() {
        let rounded = !matches!(child, Surface::Plane | Surface::Cylinder { .. });
        let law = TouchingLaw::new(&described(child.clone(), parent.clone(), concave, SLIDING)).unwrap();
        assert_eq!(law.host == Host::Parent, rounded);
        let joint = sample(child, parent, concave, SLIDING, 1.0);
        for at in around(&joint) {
            let (rotation, host) = (rows(&Touching::rotation(&at)), [at[3], at[4], at[5]]);
            let own = tangents(&law.hosting().normal(&host));
            for i in 0..5 {
                let (omega, velocity) = if i < 3 { (law::axis(i), [0.0; 3]) } else { ([0.0; 3], own[i - 3]) };
                let place = law.place(&turning(&rotation, &omega), &moving(&host, &velocity)).unwrap();
                let column = Vector3::from(law.column(&rotation, &host, i).unwrap());
                assert!((rates(&place.position()) - column).norm() < 1e-12, "{i}");
            }
        }
    }
}

/// From a rough pose: the orientation is kept, and what was missing is along the normal; no other contact is nearer.
#[test]
fn the_nearest_contact_is_found() {
    for (child, parent, concave) in pairs() {
        let joint = sample(child, parent, concave, SLIDING, 0.7);
        for at in around(&joint) {
            let normal = joint.contact(&at).unwrap().normal;
            for gap in [-0.05, 0.3] {
                let mut wanted = joint.pose(&at);
                wanted.position += normal * gap;
                let found = joint.nearest(&wanted);
                let apart = (0..7).map(|i| (found[i] - at[i]).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-12, "{gap}: {found:?} {at:?}");
            }
        }
    }
}

#[test]
fn sizes_and_units_do_not_matter() {
    let small = |x: f64, y: f64, z: f64| axes(1e-3 * x, 1e-3 * y, 1e-3 * z);
    let offset =
        |size: f64| Pose::new(exp(&Vector3::new(0.3, -0.2, 0.1)), Vector3::new(2.2, 0.9, 1.3) * size);
    let one = made(described(axes(1.1, 0.8, 1.5), axes(1.6, 1.2, 0.9), false, SLIDING), 1.0, &offset(1.0));
    let other =
        made(described(small(1.1, 0.8, 1.5), small(1.6, 1.2, 0.9), false, SLIDING), 2e-2, &offset(1e-3));
    let (one, other) = (one.unwrap(), other.unwrap());
    let wanted = one.coordinates(&one.home());
    let (a, b) = (one.configuration(&wanted), other.configuration(&wanted));
    assert!((0..5).all(|i| (other.coordinates(&other.home())[i] - wanted[i]).abs() < 1e-12));
    let scale = 1e-3 / 2e-2;
    assert!((one.pose(&a).position * scale - other.pose(&b).position).norm() < 1e-14);
    for i in 0..5 {
        let (p, q) = (one.subspace(&a, i), other.subspace(&b, i));
        let own = if i < 3 { scale } else { 1.0 };
        assert!((p.linear * own - q.linear).norm() < 1e-13);
        for j in 0..5 {
            let (p, q) = (one.subspace_change(&a, i, j), other.subspace_change(&b, i, j));
            let factor = own * if j < 3 { 1.0 } else { 1.0 / scale };
            assert!((p.linear * factor - q.linear).norm() < 1e-11 * (1.0 + q.linear.norm()));
        }
    }
}

/// A step past the horizon lands on the nearest place instead; at a pole, where longitude means nothing, free coordinates stay finite.
#[test]
fn long_steps_and_poles_are_survived() {
    let above = Pose::translation(Vector3::new(0.0, 0.0, 4.0));
    let joint = made(described(ellipsoid(), other(), false, SLIDING), 1.0, &above).unwrap();
    let home = joint.home();
    assert_eq!(home, [0.0, 0.0, 0.0, 0.0, 0.0, 0.9, 0.0]);
    assert!((joint.pose(&home).position - Vector3::new(0.0, 0.0, 2.4)).norm() < 1e-15);
    let far = joint.moved(&home, &[0.0, 0.0, 0.0, 5.0, -3.0]);
    assert!(joint.surfaces().unwrap()[1].value(&[far[3], far[4], far[5]]).abs() < 1e-13);
    assert!(joint.pose(&far).position.iter().all(|x| x.is_finite()));
    let (value, tangent) = joint.generalised(&home, &[1.0, 2.0, 3.0, 0.0, 0.0, 0.0], &[0.0; 6]);
    assert!(value.iter().chain(tangent.iter().flatten()).all(|x| x.is_finite()));
}

/// Where a profile ends there is no pose.
#[test]
fn a_surface_ends_with_its_profile() {
    let profile = RevolutionProfile::Points(vec![[-0.5, 0.9], [0.0, 1.0], [0.5, 0.9]]);
    let barrel = Surface::Revolution { profile };
    let beside = Pose::translation(Vector3::new(4.0, 0.0, 0.0));
    let joint = made(described(axes(0.5, 0.5, 0.5), barrel, false, SLIDING), 1.0, &beside).unwrap();
    assert!((joint.pose(&joint.home()).position - Vector3::new(1.5, 0.0, 0.0)).norm() < 1e-14);
    let place = |z: f64| joint.configuration(&[0.0, 0.0, 0.0, 0.3, z]);
    assert!(joint.contact(&place(0.49)).is_some() && joint.pose(&place(0.49)).position.x.is_finite());
    assert!(joint.contact(&place(0.51)).is_none() && joint.pose(&place(0.51)).position.x.is_nan());
    assert!(joint.subspace(&place(0.51), 0).linear.x.is_nan());
}

#[test]
fn nonsense_is_refused() {
    let offset = Pose::translation(Vector3::new(0.2, 0.1, 4.0));
    let error = |surfaces: Surfaces| made(surfaces, 1.0, &offset).unwrap_err();
    let on = |child, parent, concave| error(described(child, parent, concave, SLIDING));
    let flat = || axes(1.0, -1.0, 1.0);
    let source = SurfaceError::Axis { axis: "y", value: -1.0 };
    assert_eq!(on(flat(), Surface::Plane, false), ContactError::Surface { which: "child", source });
    assert_eq!(on(ellipsoid(), flat(), false), ContactError::Surface { which: "parent", source });
    assert_eq!(on(cylinder(), Surface::Plane, false), ContactError::NoneRounded);
    // A ball in a hollow that is narrower: 1/0.8 - 1/0.5.
    let tight = on(axes(0.8, 0.8, 0.8), axes(0.5, 0.5, 0.5), true);
    assert!(matches!(tight, ContactError::Cuts { curvature } if (curvature + 0.75).abs() < 1e-12), "{tight}");
    // A waist that no plane touches from outside without cutting into it.
    let profile = RevolutionProfile::Points(vec![[-0.5, 1.1], [0.0, 1.0], [0.5, 1.1]]);
    let waist = || Surface::Revolution { profile: profile.clone() };
    assert_eq!(on(Surface::Plane, waist(), false), ContactError::NoneRounded);
    let loose = sample(axes(0.1, 0.1, 0.1), waist(), false, SLIDING, 1.0);
    assert!(loose.contact(&loose.home()).unwrap().fits);
}
