mod closed;
mod energy;
mod second;

use super::*;
use crate::ode::NODES;
use crate::rod::balance::cross;
use crate::rod::{Shearable, Slender};
use num_dual::Dual64;
use second::{LOAD, Second};

const LENGTH: f64 = 1.2;
const TENSIONS: [f64; 2] = [1.5, 0.8];

/// Offset (y, z) and slope of two tendons: one winds, one runs straight.
fn routes(s: f64) -> [[f64; 4]; 2] {
    let (sin, cos) = (2.0 * s).sin_cos();
    [[0.1 * cos, 0.02 + 0.12 * sin, -0.2 * sin, 0.24 * cos], [-0.05, 0.08, 0.0, 0.0]]
}

/// A tendon along `route`, at the stages of `steps` steps over `length`.
fn channel(tendon: usize, length: f64, steps: usize, route: impl Fn(f64) -> [f64; 4]) -> Channel {
    let place = |i: usize| (i / NODES.len()) as f64 + NODES[i % NODES.len()];
    let samples = (0..steps * NODES.len())
        .map(|i| {
            let [y, z, dy, dz] = route(place(i) * length / steps as f64);
            ChannelSample { offset: [y, z], slope: [dy, dz] }
        })
        .collect();
    Channel { tendon, samples }
}

fn channels(steps: usize) -> Vec<Channel> {
    vec![
        channel(0, LENGTH, steps, |s| routes(s)[0]),
        Channel { tendon: 1, samples: vec![ChannelSample { offset: [-0.05, 0.08], slope: [0.0; 2] }] },
    ]
}

fn laws() -> Vec<LawTable> {
    let mut compliance = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            compliance[i][j] = 0.05 / (1.0 + (i + j) as f64) + if i == j { 0.3 } else { 0.0 };
        }
    }
    let slender = |stretch| Slender { k0: [0.3, -0.5, 0.8], stretch, bend: [1.3, 1.0, 0.4] };
    vec![
        LawTable::Slender(vec![slender(0.0)]),
        LawTable::Slender(vec![slender(0.02)]),
        LawTable::Shearable(vec![Shearable {
            k0: [0.0, 0.2, -0.1],
            shear: [0.01, 0.03, 0.02],
            bend: [1.3, 1.0, 0.4],
        }]),
        LawTable::Coupled(vec![Coupled { k0: [0.1, 0.0, -0.4], compliance }]),
    ]
}

fn piece(laws: &LawTable, steps: usize) -> Piece {
    let [dead_force, dead_moment] = LOAD;
    let loads = vec![LoadSample { dead_force, dead_moment, ..LoadSample::default() }];
    Piece { length: LENGTH, steps, laws: laws.clone(), loads, foundation: None }
}

fn start<const W: usize>() -> RodState<W> {
    let norm = 30.0_f64.sqrt();
    RodState {
        rotation: [1.0 / norm, 2.0 / norm, -3.0 / norm, 4.0 / norm],
        position: [0.3, -2.0, 1.0],
        force: [0.7, -1.1, 0.4],
        moment: [-0.2, 0.5, 0.9],
        d: [[0.0; W]; 12],
    }
}

/// Start and tensions with a lane each: 1..=12 the start, 13 and 14 the tensions.
fn laned() -> (RodState<16>, [Tension<16>; 2]) {
    let mut state = start();
    for i in 0..12 {
        state.d[i][1 + i] = 1.0;
    }
    let mut tensions = [[0.0; 16]; 2];
    for i in 0..2 {
        tensions[i][0] = TENSIONS[i];
        tensions[i][13 + i] = 1.0;
    }
    (state, tensions)
}

fn second(laws: &LawTable, steps: usize) -> Second {
    let Coupled { k0, compliance } = coupled(laws, 0, 0);
    Second { compliance, k0, length: LENGTH, steps, load: 0.8, channels: routes }
}

#[test]
fn derivative_lanes_agree_with_dual_numbers() {
    const STEPS: usize = 24;
    for table in laws() {
        let (mut state, tensions) = laned();
        let mut lengths = [[0.0; 16]; 2];
        advance_tendons(&piece(&table, STEPS), &channels(STEPS), &tensions, 0.8, &mut state, &mut lengths);
        let base: RodState<1> = start();
        let q = base.rotation;
        for column in 0..14 {
            let e = |i: usize| if i == column { 1.0 } else { 0.0 };
            let mut y = [Dual64::from(0.0); 16];
            // A small global turning δ moves the quaternion by ½ (0, δ) q.
            let dq = [
                -0.5 * (e(0) * q[1] + e(1) * q[2] + e(2) * q[3]),
                0.5 * (e(0) * q[0] + e(1) * q[3] - e(2) * q[2]),
                0.5 * (e(1) * q[0] + e(2) * q[1] - e(0) * q[3]),
                0.5 * (e(2) * q[0] + e(0) * q[2] - e(1) * q[1]),
            ];
            for i in 0..4 {
                y[i] = Dual64::new(q[i], dq[i]);
            }
            for i in 0..3 {
                y[4 + i] = Dual64::new(base.position[i], e(3 + i));
                y[7 + i] = Dual64::new(base.force[i], e(6 + i));
                y[10 + i] = Dual64::new(base.moment[i], e(9 + i));
            }
            let t = [Dual64::new(TENSIONS[0], e(12)), Dual64::new(TENSIONS[1], e(13))];
            let end = second(&table, STEPS).propagate(y, &t);
            let (q, d): ([f64; 4], [f64; 4]) =
                (std::array::from_fn(|i| end[i].re), std::array::from_fn(|i| end[i].eps));
            let two = 2.0 / q.iter().map(|v| v * v).sum::<f64>();
            let theta = [
                two * (q[0] * d[1] - q[1] * d[0] - (d[2] * q[3] - d[3] * q[2])),
                two * (q[0] * d[2] - q[2] * d[0] - (d[3] * q[1] - d[1] * q[3])),
                two * (q[0] * d[3] - q[3] * d[0] - (d[1] * q[2] - d[2] * q[1])),
            ];
            for row in 0..14 {
                let expected = if row < 3 { theta[row] } else { end[1 + row].eps };
                let got = if row < 12 { state.d[row][1 + column] } else { lengths[row - 12][1 + column] };
                assert!(
                    (got - expected).abs() < 1e-10,
                    "{table:?}: row {row} column {column}: {got} against {expected}"
                );
            }
            for i in 0..3 {
                assert!((state.position[i] - end[4 + i].re).abs() < 1e-12);
                assert!((state.moment[i] - end[10 + i].re).abs() < 1e-12);
            }
            assert!((lengths[0][0] - end[13].re).abs() < 1e-12);
            assert!((lengths[1][0] - end[14].re).abs() < 1e-12);
        }
        assert!((state.position[0] - base.position[0]).abs() > 0.01, "the piece must lead somewhere");
    }
}

#[test]
fn both_builds_and_fewer_lanes_give_equal_bits() {
    for table in laws() {
        let (mut wide, tensions) = laned();
        let (mut plain, mut narrow) = (wide, start::<1>());
        let (mut a, mut b, mut c) = ([[0.0; 16]; 2], [[0.0; 16]; 2], [[0.0; 1]; 2]);
        let piece = piece(&table, 3);
        advance_tendons(&piece, &channels(3), &tensions, 0.8, &mut wide, &mut a);
        run(&piece, &channels(3), &tensions, 0.8, &mut plain, &mut b);
        advance_tendons(&piece, &channels(3), &TENSIONS.map(|t| [t]), 0.8, &mut narrow, &mut c);
        assert_eq!((wide.d, wide.rotation, a), (plain.d, plain.rotation, b));
        assert_eq!((wide.position, wide.moment, a[0][0]), (narrow.position, narrow.moment, c[0][0]));
    }
}

#[test]
fn slack_tendons_leave_the_plain_rod() {
    for table in laws() {
        let (mut plain, mut tendoned) = (laned().0, laned().0);
        let mut lengths = [[0.0; 16]; 2];
        let piece = piece(&table, 4);
        crate::rod::advance(&piece, 0.8, &mut plain);
        advance_tendons(&piece, &channels(4), &[[0.0; 16]; 2], 0.8, &mut tendoned, &mut lengths);
        for row in 0..12 {
            for l in 1..13 {
                assert!((plain.d[row][l] - tendoned.d[row][l]).abs() < 1e-14);
            }
        }
        assert!(lengths[0][0] > 1.0);
    }
}

/// Tensions far beyond what the rod bears without coiling up: the search for the strain still ends.
#[test]
fn the_strain_is_found_at_any_tension() {
    for table in laws() {
        for tension in [1e-9, 10.0, 1e3] {
            let law = coupled(&table, 0, 0);
            if law.compliance[0][0] * tension > 0.8 {
                continue; // It would shrink the axis to nothing.
            }
            let tendons =
                routes(0.3).map(|c| (ChannelSample { offset: [c[0], c[1]], slope: [c[2], c[3]] }, tension));
            let total = [[0.3, -0.2, 0.1], [0.5, 0.2, -0.7]];
            let [n, m] = rod_share(&law, &total, &tendons);
            let (nu, k) = law.strain(&n, &m);
            // What the tendons, placed by that strain, leave to the rod.
            let mut left = total;
            for c in routes(0.3) {
                let d = [0.0, c[0], c[1]];
                let turned = cross(&k, &d);
                let w = [nu[0] + turned[0], nu[1] + turned[1] + c[2], nu[2] + turned[2] + c[3]];
                let pull = w.map(|x| tension * x / norm(&w));
                let moment = cross(&d, &pull);
                for i in 0..3 {
                    left[0][i] -= pull[i];
                    left[1][i] -= moment[i];
                }
            }
            for i in 0..3 {
                let scale = 1e-13 * (1.0 + tension);
                let error = (left[0][i] - n[i]).abs().max((left[1][i] - m[i]).abs());
                assert!(error < scale, "{tension}: {left:?} against {n:?}, {m:?}");
            }
        }
    }
}
