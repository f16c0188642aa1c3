mod robot;
mod second;
mod shapes;

use super::*;
use crate::ode::NODES;
use crate::rod::balance::cross;
use crate::rod::{LawTable, Piece, Slender};
use num_dual::Dual64;

const LENGTH: f64 = 1.1;

/// Three tubes, the second slot empty; `uniform` or with rest curvatures that vary.
fn piece(steps: usize, uniform: bool, loaded: bool) -> TubePiece {
    let rest = |u: [f64; 3]| match uniform {
        true => vec![u],
        false => (0..steps * NODES.len())
            .map(|i| {
                let s = ((i / NODES.len()) as f64 + NODES[i % NODES.len()]) * LENGTH / steps as f64;
                [u[0] + 0.3 * s, u[1] * (1.0 + s * s), u[2] - 0.5 * s.sin()]
            })
            .collect(),
    };
    let load =
        LoadSample { dead_force: [0.1, -0.6, 0.4], dead_moment: [0.2, 0.1, -0.3], ..LoadSample::default() };
    TubePiece {
        length: LENGTH,
        steps,
        first: Tube { bending: 1.0, torsion: 0.8, rest: rest([0.2, 0.9, -0.4]) },
        others: [
            Some(Tube { bending: 1.9, torsion: 1.4, rest: rest([0.0, 0.7, 0.3]) }),
            None,
            Some(Tube { bending: 3.1, torsion: 2.6, rest: rest([-0.1, 0.0, 0.6]) }),
        ],
        loads: if loaded { vec![load] } else { Vec::new() },
    }
}

fn start<const W: usize>() -> TubeState<W> {
    let norm = 30.0_f64.sqrt();
    let mut state =
        TubeState { rod: RodState::origin(), angle: [[0.0; W]; OTHERS], torque: [[0.0; W]; OTHERS] };
    state.rod.rotation = [1.0 / norm, 2.0 / norm, -3.0 / norm, 4.0 / norm];
    state.rod.position = [0.3, -2.0, 1.0];
    state.rod.force = [0.7, -1.1, 0.4];
    state.rod.moment = [-0.2, 0.5, 0.9];
    for (i, (angle, torque)) in [(1.3, 0.2), (0.0, 0.0), (-2.1, -0.3)].into_iter().enumerate() {
        state.angle[i][0] = angle;
        state.torque[i][0] = torque;
    }
    state
}

/// The start with a lane for each of its 12 + 3 + 3 numbers.
fn laned() -> TubeState<20> {
    let mut state = start();
    for i in 0..12 {
        state.rod.d[i][1 + i] = 1.0;
    }
    for i in 0..3 {
        state.angle[i][13 + i] = 1.0;
        state.torque[i][16 + i] = 1.0;
    }
    state
}

#[test]
fn derivative_lanes_agree_with_dual_numbers() {
    const STEPS: usize = 24;
    for (uniform, loaded) in [(true, false), (false, false), (false, true)] {
        let piece = piece(STEPS, uniform, loaded);
        let mut lanes = laned();
        advance_tubes(&piece, 0.8, &mut lanes);
        let base: TubeState<1> = start();
        let q = base.rod.rotation;
        for column in 0..18 {
            let e = |i: usize| if i == column { 1.0 } else { 0.0 };
            let mut y = [Dual64::from(0.0); 20];
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
                y[4 + i] = Dual64::new(base.rod.position[i], e(3 + i));
                y[7 + i] = Dual64::new(base.rod.force[i], e(6 + i));
                y[10 + i] = Dual64::new(base.rod.moment[i], e(9 + i));
                y[13 + i] = Dual64::new(base.angle[i][0], e(12 + i));
                y[16 + i] = Dual64::new(base.torque[i][0], e(15 + i));
            }
            let end = second::propagate(&piece, 0.8, y);
            let (q, d): ([f64; 4], [f64; 4]) =
                (std::array::from_fn(|i| end[i].re), std::array::from_fn(|i| end[i].eps));
            let two = 2.0 / q.iter().map(|v| v * v).sum::<f64>();
            let theta = [
                two * (q[0] * d[1] - q[1] * d[0] - (d[2] * q[3] - d[3] * q[2])),
                two * (q[0] * d[2] - q[2] * d[0] - (d[3] * q[1] - d[1] * q[3])),
                two * (q[0] * d[3] - q[3] * d[0] - (d[1] * q[2] - d[2] * q[1])),
            ];
            for row in 0..18 {
                let expected = if row < 3 { theta[row] } else { end[1 + row].eps };
                let got = match row {
                    0..12 => lanes.rod.d[row],
                    12..15 => lanes.angle[row - 12],
                    _ => lanes.torque[row - 15],
                }[1 + column];
                assert!(
                    (got - expected).abs() < 1e-10,
                    "uniform {uniform} loaded {loaded}: row {row} column {column}: {got} against {expected}"
                );
            }
            for i in 0..3 {
                assert!((lanes.rod.position[i] - end[4 + i].re).abs() < 1e-12);
                assert!((lanes.angle[i][0] - end[13 + i].re).abs() < 1e-12);
                assert!((lanes.torque[i][0] - end[16 + i].re).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn both_builds_and_fewer_lanes_give_equal_bits() {
    let piece = piece(3, false, true);
    let (mut wide, mut plain, mut narrow) = (laned(), laned(), start::<1>());
    advance_tubes(&piece, 0.8, &mut wide);
    run(&piece, 0.8, &mut plain);
    advance_tubes(&piece, 0.8, &mut narrow);
    assert_eq!((wide.rod.d, wide.angle, wide.torque), (plain.rod.d, plain.angle, plain.torque));
    assert_eq!((wide.rod.position, wide.angle[0][0]), (narrow.rod.position, narrow.angle[0][0]));
}

#[test]
fn one_tube_alone_is_a_plain_rod() {
    for loaded in [false, true] {
        let several = piece(16, true, loaded);
        let Tube { bending, torsion, rest } = several.first.clone();
        let law = Slender { k0: rest[0], stretch: 0.0, bend: [1.0 / torsion, 1.0 / bending, 1.0 / bending] };
        let rod = Piece {
            length: LENGTH,
            steps: 16,
            laws: LawTable::Slender(vec![law]),
            loads: several.loads.clone(),
            foundation: None,
        };
        let (mut tube, mut plain) = (laned(), laned().rod);
        advance_tubes(&TubePiece { others: [const { None }; OTHERS], ..several }, 0.8, &mut tube);
        crate::rod::advance(&rod, 0.8, &mut plain);
        for i in 0..3 {
            assert!((tube.rod.position[i] - plain.position[i]).abs() < 1e-13);
            assert!((tube.rod.moment[i] - plain.moment[i]).abs() < 1e-13);
        }
        for row in 0..12 {
            for l in 1..13 {
                assert!((tube.rod.d[row][l] - plain.d[row][l]).abs() < 1e-13);
            }
        }
        assert_eq!(tube.angle, laned().angle);
    }
}

/// H = F·e1 + M·k + Σ m_i θ_i' - W, from the state alone.
fn hamiltonian(piece: &TubePiece, state: &TubeState<1>) -> f64 {
    let (r, _) = rotation(&state.rod.rotation);
    let back = |a: &[f64; 3]| apply_transposed(&r, a);
    let (n, m) = (back(&state.rod.force), back(&state.rod.moment));
    let first = state.first_torque()[0];
    let mut tubes = vec![(&piece.first, 0.0, first)];
    for (i, tube) in piece.others.iter().enumerate() {
        tubes.extend(tube.iter().map(|t| (t, state.angle[i][0], state.torque[i][0])));
    }
    let turned = |t: &Tube, angle: f64| {
        let ([_, y, z], (s, c)) = (t.rest[0], angle.sin_cos());
        [c * y - s * z, s * y + c * z]
    };
    let stiffness: f64 = tubes.iter().map(|(t, ..)| t.bending).sum();
    let mut k = [m[1], m[2]];
    for (t, angle, _) in &tubes {
        let a = turned(t, *angle);
        k[0] += t.bending * a[0];
        k[1] += t.bending * a[1];
    }
    let k = k.map(|k| k / stiffness);
    // Each tube's own twist takes its torque: M_1 k_1 + Σ m_i θ_i' is the sum of m_i times that twist.
    let mut h = n[0] + m[1] * k[0] + m[2] * k[1];
    for (t, angle, torque) in &tubes {
        let a = turned(t, *angle);
        h += torque * (t.rest[0][0] + torque / t.torsion)
            - 0.5 * torque * torque / t.torsion
            - 0.5 * t.bending * ((k[0] - a[0]).powi(2) + (k[1] - a[1]).powi(2));
    }
    h
}

#[test]
fn the_hamiltonian_is_constant_and_so_is_the_wrench() {
    let piece = piece(24, true, false);
    let before: TubeState<1> = start();
    let mut after = before;
    advance_tubes(&piece, 1.0, &mut after);
    let (a, b) = (hamiltonian(&piece, &before), hamiltonian(&piece, &after));
    assert!((a - b).abs() < 1e-13 && a.abs() > 0.1, "{a} and {b}");
    assert!((before.angle[0][0] - after.angle[0][0]).abs() > 0.1, "something must turn");
    for i in 0..3 {
        let about = |s: &TubeState<1>| s.rod.moment[i] + cross(&s.rod.position, &s.rod.force)[i];
        assert!((about(&before) - about(&after)).abs() < 1e-13);
    }
}

#[test]
fn the_moments_of_the_tubes_sum_to_the_whole_and_bend_them_alike() {
    let piece = piece(1, true, false);
    let state: TubeState<1> = start();
    let tubes = std::array::from_fn(|i| {
        let tube = if i == 0 { Some(&piece.first) } else { piece.others[i - 1].as_ref() };
        tube.map(|t| (t.bending, t.rest[0]))
    });
    let moments = state.moments(&tubes);
    let mut whole = [0.0; 3];
    let mut curvatures = Vec::new();
    for (i, m) in moments.iter().enumerate() {
        let Some((bending, u)) = tubes[i] else { continue };
        let (s, c) = if i == 0 { (0.0, 1.0) } else { state.angle[i - 1][0].sin_cos() };
        let k = [u[1] + m[1] / bending, u[2] + m[2] / bending];
        curvatures.push([c * k[0] - s * k[1], s * k[0] + c * k[1]]);
        whole[0] += m[0];
        whole[1] += c * m[1] - s * m[2];
        whole[2] += s * m[1] + c * m[2];
    }
    let (r, _) = rotation(&state.rod.rotation);
    let expected = apply_transposed(&r, &state.rod.moment);
    for i in 0..3 {
        assert!((whole[i] - expected[i]).abs() < 1e-14);
    }
    for k in &curvatures[1..] {
        assert!((k[0] - curvatures[0][0]).abs() + (k[1] - curvatures[0][1]).abs() < 1e-14);
    }
}
