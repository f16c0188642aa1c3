//! Rolling surfaces against closed forms, planar rolling, and what rolling means.

use super::samples::*;
use super::*;
use crate::joint::Joint;
use flexura_model::{
    Boundary, BoundaryCurve, Contact, JointKind, JointLaw, RevolutionProfile, Rolling, RollingCoordinate,
    Slide, Surface, SurfaceMotion, Surfaces,
};
use flexura_spatial::{exp, log};
use std::f64::consts::{FRAC_PI_2, PI};

fn rolling(x: f64, y: f64, z: f64) -> SurfaceMotion {
    SurfaceMotion::Rolling { about: Vector3::new(x, y, z) }
}

fn osculating(x: f64, y: f64, z: f64) -> SurfaceMotion {
    SurfaceMotion::Osculating { about: Vector3::new(x, y, z) }
}

fn ball(radius: f64) -> Surface {
    axes(radius, radius, radius)
}

fn above(height: f64) -> Pose {
    Pose::translation(Vector3::new(0.0, 0.0, height))
}

fn at(joint: &Joint, q: f64) -> (Pose, Configuration) {
    let configuration = joint.configuration(&[q]);
    (joint.pose(&configuration), configuration)
}

/// The coracoid and keel of the thesis (Table 4.1), turned by 15 degrees about y, in whose plane both sections are ellipses: the
/// child's centre from Simpson's rule for both arcs and bisection for where they are equal and the normals oppose.
#[test]
fn an_ellipsoid_on_an_ellipsoid_after_fifteen_degrees() {
    for motion in [rolling(0.0, 1.0, 0.0), osculating(0.0, 1.0, 0.0)] {
        let surfaces = described(axes(9.2e-3, 3.1e-3, 2.3e-3), axes(10.2e-3, 4.1e-3, 1.9e-3), false, motion);
        let joint = made(surfaces, 1e-3, &above(4.2e-3)).unwrap();
        let (pose, _) = at(&joint, PI / 12.0);
        let expected = Vector3::new(0.680_657_917_2, 0.0, 4.814_013_338_0);
        assert!((pose.position - expected).norm() < 1e-9, "{}", pose.position);
    }
}

/// Sections of ellipsoids across an axis roll as ellipses in their plane do.
#[test]
fn principal_sections_roll_as_in_the_plane() {
    let ellipse = |a: f64, b: f64| Boundary {
        curve: BoundaryCurve::Ellipse { semi_axes: [a, b], range: None },
        outside: None,
    };
    for concave in [false, true] {
        // In the plane across y, with x along z, so that its y is along x.
        let ([a, b], [c, d], height) =
            if concave { ([1.0, 0.7], [2.5, 3.0], -1.5) } else { ([1.0, 1.7], [1.2, 0.9], 2.2) };
        let mut law = JointLaw::free(JointKind::Rolling(RollingCoordinate::Angle), Vector3::y());
        law.second_axis = Vector3::z();
        let start = if concave { [PI, PI] } else { [PI, 0.0] };
        law.contact = Some(Box::new(Contact::Rolling(Rolling {
            child: ellipse(a, b),
            parent: ellipse(c, d),
            concave,
            start: Some(start),
            slide: Slide::None,
            close: true,
        })));
        let planar = Joint::new(&law, 1.0, &above(height)).unwrap();
        for motion in [rolling(0.0, 2.0, 0.0), osculating(0.0, 1.0, 0.0)] {
            let surfaces =
                described(axes(b, 0.8, a), axes(d, if concave { 4.0 } else { 0.6 }, c), concave, motion);
            let spatial = made(surfaces, 1.0, &above(height)).unwrap();
            for q in [-3.0, -1.1, -0.2, 0.3, 0.9, 2.4, PI] {
                let (ours, configuration) = at(&spatial, q);
                let (expected, other) = at(&planar, q);
                assert!((ours.position - expected.position).norm() < 1e-12, "{concave} {q}");
                assert!(log(&(ours.rotation * expected.rotation.inverse())).norm() < 1e-12, "{concave} {q}");
                let [ours, expected] =
                    [spatial.contact(&configuration).unwrap(), planar.contact(&other).unwrap()];
                assert!((ours.travel[0] - expected.travel[0]).abs() < 1e-12 && ours.travel[1] == 0.0);
                assert!((ours.rates[0] - expected.rates[0]).abs() < 1e-12);
                assert!((ours.direction - expected.direction).norm() < 1e-12);
                assert!((ours.normal - expected.normal).norm() < 1e-12);
                for i in 0..2 {
                    assert!((ours.radii[i].unwrap() - expected.radii[i].unwrap()).abs() < 1e-11);
                }
            }
        }
    }
}

/// A ball of radius r on one of radius ρ, about an axis that is not across the normal. With κ = r σ/(ρ + σ r) the normal goes
/// round the axis, n' = κ a × n, and ω with it: R = exp(κ q a) exp(q (ω_0 - κ a)).
#[test]
fn a_ball_on_a_ball_goes_round_the_axis() {
    let (r, axis) = (0.7, Vector3::new(0.0, 0.6, 0.8));
    for (concave, rho, sense) in [(false, 1.3, 1.0), (true, 2.0, -1.0)] {
        let start = Vector3::new(0.2, -0.5, 0.6).normalize();
        let distance = rho + sense * r;
        let offset = Pose::translation(start * distance);
        for motion in [rolling(0.0, 1.2, 1.6), osculating(0.0, 0.6, 0.8)] {
            let joint = made(described(ball(r), ball(rho), concave, motion), 1.0, &offset).unwrap();
            let kappa = sense * r / distance;
            let omega = axis - start * axis.dot(&start);
            for q in [-3.0, -0.4, 1.3, 3.1] {
                let (pose, configuration) = at(&joint, q);
                let n = exp(&(axis * (kappa * q))) * start;
                assert!((pose.position - n * distance).norm() < 1e-12);
                let rotation = exp(&(axis * (kappa * q))) * exp(&((omega - axis * kappa) * q));
                assert!(log(&(pose.rotation * rotation.inverse())).norm() < 1e-12);
                let contact = joint.contact(&configuration).unwrap();
                assert!((contact.travel[0] - rho * kappa.abs() * omega.norm() * q).abs() < 1e-12);
                assert!(
                    (contact.radii[0].unwrap() - r).abs() + (contact.radii[1].unwrap() - sense * rho).abs()
                        < 1e-12
                );
            }
        }
    }
}

/// What rolling means, on bodies without symmetry: no slip, no spin, the axis' part across the normal, the contact kept, and
/// equal arcs.
#[test]
fn rolling_neither_slips_nor_spins() {
    let about = Vector3::new(0.3, 1.0, -0.4).normalize();
    for (child, parent, concave) in [
        (ellipsoid(), other(), false),
        (ellipsoid(), wide(), true),
        (pear(), heights(), false),
        (cylinder(), ellipsoid(), false),
        (ellipsoid(), Surface::Plane, false),
    ] {
        for motion in [rolling(0.3, 1.0, -0.4), osculating(0.3, 1.0, -0.4)] {
            let joint = sample(child.clone(), parent.clone(), concave, motion, 0.7);
            assert_eq!(joint.range(), Some([-PI, PI]));
            let [own, other] = joint.surfaces().unwrap();
            for q in [-2.3, -0.9, 0.0, 0.8, 1.7, 3.0] {
                let (pose, configuration) = at(&joint, q);
                let contact = joint.contact(&configuration).unwrap();
                let arm = pose.rotation * contact.points[0];
                assert!((pose.position * 0.7 + arm - contact.points[1]).norm() < 1e-13);
                let outwards = Vector3::from(own.normal(&contact.points[0].into()));
                assert!((pose.rotation * outwards + contact.normal).norm() < 1e-13);
                assert!(own.value(&contact.points[0].into()).abs() < 1e-13);
                assert!(other.value(&contact.points[1].into()).abs() < 1e-13);
                let column = joint.subspace(&configuration, 0);
                let slip = column.linear * 0.7 + column.angular.cross(&arm);
                assert!(slip.norm() < 1e-13 && column.angular.dot(&contact.normal).abs() < 1e-13);
                let across = about - contact.normal * about.dot(&contact.normal);
                match motion {
                    SurfaceMotion::Osculating { .. } => {
                        assert!((column.angular - across).dot(&across).abs() < 1e-13);
                        assert!(contact.direction.dot(&about).abs() < 1e-13);
                    }
                    _ => assert!((column.angular - across).norm() < 1e-13),
                }
                // Both bodies' points travel by the same arc, in the same direction.
                let (h, places) = (1e-3, |x: f64| joint.contact(&joint.configuration(&[q + x])).unwrap());
                let slope = |f: &dyn Fn(f64) -> Vector3<f64>| {
                    ((f(h) - f(-h)) * 8.0 - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)
                };
                let on_parent = slope(&|x| places(x).points[1]);
                let on_child = pose.rotation * slope(&|x| places(x).points[0]);
                let way = contact.direction * contact.rates[0];
                assert!((on_parent - way).norm() < 1e-8 && (on_child - way).norm() < 1e-8);
                let travel = slope(&|x| Vector3::x() * places(x).travel[0]).x;
                assert!((travel - contact.rates[0]).abs() < 1e-8 && contact.fits);
            }
        }
    }
}

/// A ball that is rolled round a triangle on a plane comes back turned, by the product of its three turnings.
#[test]
fn a_loop_on_a_plane_leaves_a_turn() {
    let r = 0.4;
    let corners = [[0.0, 0.0], [1.1, 0.2], [0.3, 0.9], [0.0, 0.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
    let mut pose = above(r);
    let mut expected = pose.rotation;
    for leg in corners.windows(2) {
        let way = leg[1] - leg[0];
        let turn = Vector3::z().cross(&way) / r;
        let about = turn.normalize();
        let mut surfaces = described(ball(r), Surface::Plane, false, SurfaceMotion::Rolling { about });
        surfaces.range = [0.0, turn.norm()];
        let joint = made(surfaces, 1.0, &pose).unwrap();
        pose = at(&joint, turn.norm()).0;
        expected = exp(&turn) * expected;
        assert!((pose.position - leg[1] - Vector3::z() * r).norm() < 1e-12);
        assert!(log(&(pose.rotation * expected.inverse())).norm() < 1e-12);
    }
    assert!(log(&pose.rotation).norm() > 0.5);
}

/// A longer range makes other panels, but not another motion; and from any pose of it the motion goes on.
#[test]
fn a_motion_does_not_depend_on_where_it_starts() {
    let short = |range: [f64; 2], offset: &Pose| {
        let mut surfaces = described(ellipsoid(), other(), false, rolling(0.3, 1.0, -0.4));
        surfaces.range = range;
        made(surfaces, 1.0, offset).unwrap()
    };
    let offset = Pose::new(exp(&Vector3::new(0.3, -0.2, 0.1)), Vector3::new(2.2, 0.9, 1.3));
    let (long, other) = (short([-PI, PI], &offset), short([-0.31, 0.47], &offset));
    assert_eq!(other.range(), Some([-0.31, 0.47]));
    let (middle, _) = at(&long, 0.47);
    let next = short([-0.6, 0.5], &middle);
    for (joint, shift, q) in
        [(&other, 0.0, 0.47), (&other, 0.0, -0.31), (&next, 0.47, 0.4), (&next, 0.47, -0.6)]
    {
        let (here, there) = (at(joint, q).0, at(&long, q + shift).0);
        assert!((here.position - there.position).norm() < 1e-12);
        assert!(log(&(here.rotation * there.rotation.inverse())).norm() < 1e-12);
    }
    assert!(
        at(&other, 0.4701).0.position.x.is_nan() && other.contact(&other.configuration(&[0.48])).is_none()
    );
}

/// The motion ends with a profile, and where a hollow becomes too narrow.
#[test]
fn a_motion_ends_with_the_surface() {
    let points = (-6..=6).map(|i| f64::from(i) / 10.0).map(|z| [z, (2.0 - z * z).sqrt()]);
    let profile = RevolutionProfile::Points(points.collect());
    // A piece of a ball of radius √2, on which a ball of 1 goes along a meridian: θ = q κ.
    let piece = Surface::Revolution { profile };
    let offset = Pose::translation(Vector3::new(4.0, 0.0, 0.0));
    let joint = made(described(ball(1.0), piece, false, rolling(0.0, 1.0, 0.0)), 1.0, &offset).unwrap();
    let kappa = 1.0 / (1.0 + 2.0_f64.sqrt());
    let end = (0.6 / 2.0_f64.sqrt()).asin() / kappa;
    let [from, to] = joint.range().unwrap();
    assert!((from + end).abs() < 1e-8 && (to - end).abs() < 1e-8, "{from} {to} {end}");
    // An ellipse 2.5 by 1.2 is as narrow as a ball of 1 where its radius of curvature is 1.
    let hollow = axes(2.5, 3.0, 1.2);
    let joint = made(described(ball(1.0), hollow, true, rolling(0.0, 1.0, 0.0)), 1.0, &above(-0.2)).unwrap();
    let [from, to] = joint.range().unwrap();
    assert!((from + to).abs() < 1e-7 && to < FRAC_PI_2 * 3.0, "{from} {to}");
    for q in [from, to] {
        let contact = joint.contact(&joint.configuration(&[q])).unwrap();
        assert!((contact.radii[1].unwrap() + 1.0).abs() < 1e-3, "{contact:?}");
    }
}

#[test]
fn nonsense_is_refused() {
    let error = |change: &dyn Fn(&mut Surfaces)| {
        let mut surfaces = described(ellipsoid(), other(), false, rolling(0.0, 1.0, 0.0));
        change(&mut surfaces);
        made(surfaces, 1.0, &above(4.0)).unwrap_err()
    };
    assert_eq!(error(&|s| s.motion = rolling(0.0, 0.0, 0.0)), ContactError::NoAxis);
    assert_eq!(error(&|s| s.motion = osculating(f64::NAN, 0.0, 0.0)), ContactError::NoAxis);
    assert_eq!(error(&|s| s.motion = rolling(0.0, 0.0, 1.0)), ContactError::AxisAlongNormal);
    for [from, to] in [[0.1, 1.0], [-1.0, -0.5], [0.0, 0.0], [-1.0, f64::INFINITY]] {
        assert_eq!(error(&|s| s.range = [from, to]), ContactError::RollingRange { from, to });
    }
    assert_eq!(error(&|s| (s.child, s.parent) = (cylinder(), Surface::Plane)), ContactError::NoneRounded);
}
