//! Closed forms, and the limit of many point guides.

use super::*;
use crate::rod::advance;
use flexura_spatial::{Matrix3, Pose, UnitQuaternion, Vector3, exp};

fn free_start<const W: usize>() -> RodState<W> {
    RodState::origin()
}

/// With no wrench on the whole section, w = (1 + ε - k3 y) e1, so u = e1, n = -T e1, m = T y e3: an arc.
#[test]
fn a_straight_tendon_bends_its_rod_into_an_arc() {
    let (tension, y, length) = (2.5, 0.07, 3.0);
    for (stretch, k0) in [(0.0, 0.0), (0.01, 0.0), (0.0, 0.4)] {
        let law = Slender { k0: [0.0, 0.0, k0], stretch, bend: [1.0, 2.0, 5.0] };
        let piece = Piece {
            length,
            steps: 16,
            laws: LawTable::Slender(vec![law]),
            loads: Vec::new(),
            foundation: None,
        };
        let channel =
            Channel { tendon: 0, samples: vec![ChannelSample { offset: [y, 0.0], slope: [0.0; 2] }] };
        let (mut state, mut lengths) = (free_start::<1>(), [[0.0]]);
        advance_tendons(&piece, &[channel], &[[tension]], 1.0, &mut state, &mut lengths);
        let kappa = k0 + 5.0 * tension * y;
        let nu = 1.0 - stretch * tension;
        let arc = [(kappa * length).sin() * nu / kappa, (1.0 - (kappa * length).cos()) * nu / kappa, 0.0];
        for i in 0..3 {
            assert!((state.position[i] - arc[i]).abs() < 1e-12, "{:?} against {arc:?}", state.position);
        }
        assert!((lengths[0][0] - (nu - kappa * y) * length).abs() < 1e-13);
    }
}

/// A tendon that winds at the rate ω around a straight rod with equal bending stiffnesses: in axes that turn
/// with it everything is the same at every s, so the rod is a helix whose k solves three equations
/// k = C (-d × T u) with u along e1 + (k + ω e1) × d, solved here by repetition.
#[test]
fn a_winding_tendon_bends_its_rod_into_a_helix() {
    let (tension, radius, omega, length) = (4.0, 0.08, 5.0, 2.0);
    let (twist, bend) = (1.7, 1.1);
    let d = Vector3::new(0.0, radius, 0.0);
    let mut k = Vector3::zeros();
    for _ in 0..300 {
        let w = Vector3::x() + (k + Vector3::x() * omega).cross(&d);
        k = Matrix3::from_diagonal(&Vector3::new(twist, bend, bend)) * -d.cross(&w.normalize()) * tension;
    }
    assert!(k.norm() > 0.2, "the test must bend something: {k}");
    // Axes that turn with the tendon: curvature k + ω e1.
    let whole = k + Vector3::x() * omega;
    let turning = exp(&(whole * length));
    let rate = whole.norm();
    let axis = whole / rate;
    // ∫ exp(s hat(whole)) e1 ds by Rodrigues' formula.
    let angle = rate * length;
    let x = Vector3::x();
    let end = x * (angle.sin() / rate)
        + axis.cross(&x) * ((1.0 - angle.cos()) / rate)
        + axis * axis.dot(&x) * (length - angle.sin() / rate);
    let stretch = (Vector3::x() + whole.cross(&d)).norm() * length;

    let steps = 40;
    let law = |k0: f64| {
        LawTable::Slender(vec![Slender { k0: [k0, 0.0, 0.0], stretch: 0.0, bend: [twist, bend, bend] }])
    };
    let winding = channel(0, length, steps, |s| {
        let (sin, cos) = (omega * s).sin_cos();
        [radius * cos, radius * sin, -radius * omega * sin, radius * omega * cos]
    });
    let straight =
        Channel { tendon: 0, samples: vec![ChannelSample { offset: [radius, 0.0], slope: [0.0; 2] }] };
    for (k0, channel, unwind) in [(0.0, winding, omega * length), (omega, straight, 0.0)] {
        let piece = Piece { length, steps, laws: law(k0), loads: Vec::new(), foundation: None };
        let (mut state, mut lengths) = (free_start::<1>(), [[0.0]]);
        advance_tendons(&piece, &[channel], &[[tension]], 1.0, &mut state, &mut lengths);
        assert!((Vector3::from(state.position) - end).norm() < 1e-12, "{:?} against {end}", state.position);
        let expected = Pose::new(turning * exp(&(Vector3::x() * -unwind)), end);
        let [w, i, j, k] = state.rotation;
        let found = UnitQuaternion::from_quaternion(flexura_spatial::Quaternion::new(w, i, j, k));
        assert!(found.angle_to(&expected.rotation) < 1e-11);
        assert!((lengths[0][0] - stretch).abs() < 1e-12);
    }
}

/// A cable through `count` frictionless eyes, straight between them. Between two eyes the cable is outside:
/// it takes T u along a fixed line from the wrench of the whole, and the rest is the rod's.
fn through_guides(
    law: &LawTable,
    count: usize,
    tension: f64,
    total: [Vector3<f64>; 2],
) -> (RodState<1>, f64) {
    let h = LENGTH / count as f64;
    let mut state: RodState<1> = free_start();
    let [force, about_origin] = total;
    let mut length = 0.0;
    let eye = |state: &RodState<1>, s: f64| {
        let [y, z, ..] = routes(s)[0];
        let [w, i, j, k] = state.rotation;
        let q = UnitQuaternion::from_quaternion(flexura_spatial::Quaternion::new(w, i, j, k));
        Vector3::from(state.position) + q * Vector3::new(0.0, y, z)
    };
    for i in 0..count {
        let (s, next) = (i as f64 * h, (i + 1) as f64 * h);
        let from = eye(&state, s);
        let p = Vector3::from(state.position);
        let mut to = from + Vector3::x() * h;
        if i > 0 {
            let [w, i, j, k] = state.rotation;
            to = from
                + UnitQuaternion::from_quaternion(flexura_spatial::Quaternion::new(w, i, j, k))
                    * Vector3::x()
                    * h;
        }
        let mut end = state;
        for _ in 0..60 {
            end = state;
            let pull = (to - from).normalize() * tension;
            end.force = (force - pull).into();
            end.moment = (about_origin - p.cross(&force) - (from - p).cross(&pull)).into();
            let piece = Piece { length: h, steps: 1, laws: law.clone(), loads: Vec::new(), foundation: None };
            advance(&piece, 1.0, &mut end);
            to = eye(&end, next);
        }
        length += (to - from).norm();
        state = end;
    }
    (state, length)
}

#[test]
fn many_point_guides_converge_to_the_channel_with_order_two() {
    let tension = 1.5;
    let total = [Vector3::new(0.2, -0.5, 0.3), Vector3::new(-0.1, 0.3, 0.2)];
    for law in laws() {
        let steps = 24;
        let piece = Piece { length: LENGTH, steps, laws: law.clone(), loads: Vec::new(), foundation: None };
        let mut state: RodState<1> = free_start();
        state.force = total[0].into();
        state.moment = total[1].into();
        let mut lengths = [[0.0]];
        let winding = channel(0, LENGTH, steps, |s| routes(s)[0]);
        advance_tendons(&piece, &[winding], &[[tension]], 1.0, &mut state, &mut lengths);
        let error = |count: usize| {
            let (found, length) = through_guides(&law, count, tension, total);
            let gap = Vector3::from(found.position) - Vector3::from(state.position);
            let turn: f64 = found.rotation.iter().zip(&state.rotation).map(|(a, b)| (a - b).powi(2)).sum();
            [gap.norm(), turn.sqrt(), (length - lengths[0][0]).abs()]
        };
        let (coarse, fine) = (error(32), error(64));
        for i in 0..3 {
            let order = (coarse[i] / fine[i]).log2();
            assert!((order - 2.0).abs() < 0.1, "{law:?}: order {order}, {coarse:?} and {fine:?}");
        }
        assert!(fine[0] < 1e-3, "{fine:?}");
    }
}
