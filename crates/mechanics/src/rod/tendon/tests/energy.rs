//! Clamped rods with a force on the free end: energy against cable lengths.

use super::*;
use nalgebra::{DMatrix, Matrix3, Vector3};

const TIP: [f64; 3] = [0.2, -0.5, 0.3];
const STEPS: usize = 24;

/// The clamp's moment that leaves the tip without moment, with its derivatives along both tensions, and
/// there the tip, the lengths and all their lanes (1..=3 the moment, 4 and 5 the tensions).
fn clamped(table: &LawTable, tensions: [f64; 2]) -> (Vector3<f64>, RodState<8>, [[f64; 8]; 2]) {
    let piece =
        Piece { length: LENGTH, steps: STEPS, laws: table.clone(), loads: Vec::new(), foundation: None };
    let channels = channels(STEPS);
    let mut moment = Vector3::zeros();
    for _ in 0..20 {
        let mut state: RodState<8> = RodState::origin();
        state.force = TIP;
        state.moment = moment.into();
        for i in 0..3 {
            state.d[9 + i][1 + i] = 1.0;
        }
        let mut t = [[0.0; 8]; 2];
        for i in 0..2 {
            t[i][0] = tensions[i];
            t[i][4 + i] = 1.0;
        }
        let mut lengths = [[0.0; 8]; 2];
        advance_tendons(&piece, &channels, &t, 1.0, &mut state, &mut lengths);
        let jacobian = Matrix3::from_fn(|i, j| state.d[9 + i][1 + j]);
        let step = jacobian.lu().solve(&Vector3::from(state.moment)).unwrap();
        if step.norm() < 1e-14 {
            return (moment, state, lengths);
        }
        moment -= step;
    }
    panic!("no equilibrium")
}

/// Elastic energy, tip and cable lengths of the equilibrium.
fn energy(table: &LawTable, tensions: [f64; 2]) -> (f64, Vector3<f64>, [f64; 2]) {
    let (moment, state, lengths) = clamped(table, tensions);
    let mut y = [0.0; 16];
    y[0] = 1.0;
    y[7..10].copy_from_slice(&TIP);
    y[10..13].copy_from_slice(moment.as_slice());
    let plain = Second { load: 0.0, ..second(table, STEPS) };
    let end = plain.propagate(y.map(Dual64::from), &tensions.map(Dual64::from)).map(|y| y.re);
    assert!((end[4] - state.position[0]).abs() < 1e-11);
    (end[15], Vector3::from(state.position), [lengths[0][0], lengths[1][0]])
}

/// ∂/∂T_j by a central difference of order eight.
fn derivative(f: impl Fn([f64; 2]) -> f64, j: usize) -> f64 {
    let h = 0.02;
    let at = |x: f64| {
        let mut t = TENSIONS;
        t[j] += x;
        f(t)
    };
    [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0]
        .iter()
        .enumerate()
        .map(|(i, weight)| {
            let x = h * (i as f64 + 1.0);
            weight * (at(x) - at(-x)) / h
        })
        .sum()
}

/// At equilibrium Π = E - F·p + Σ T ℓ is stationary in the shape, so dΠ/dT_j = ℓ_j; and what the cables
/// and the tip's force do in a change is stored: dE = F·dp - Σ T dℓ.
#[test]
fn the_energy_changes_by_the_work_of_the_cables() {
    for table in laws() {
        let (_, _, lengths) = energy(&table, TENSIONS);
        let work = |t: [f64; 2]| {
            let (e, tip, l) = energy(&table, t);
            e - tip.dot(&Vector3::from(TIP)) + t[0] * l[0] + t[1] * l[1]
        };
        for j in 0..2 {
            let slope = derivative(work, j);
            assert!((slope - lengths[j]).abs() < 1e-9, "{table:?}: {slope} against {}", lengths[j]);
            let stored = derivative(|t| energy(&table, t).0, j);
            let done = derivative(
                |t| {
                    let (_, tip, l) = energy(&table, t);
                    tip.dot(&Vector3::from(TIP)) - TENSIONS[0] * l[0] - TENSIONS[1] * l[1]
                },
                j,
            );
            assert!((stored - done).abs() < 1e-9, "{stored} against {done}");
        }
    }
}

/// ∂ℓ_i/∂T_j from the lanes, with the clamp's moment eliminated: symmetric, negative definite, and the derivative of
/// the lengths (Maxwell and Betti).
#[test]
fn cables_are_reciprocal() {
    for table in laws() {
        let (_, state, lengths) = clamped(&table, TENSIONS);
        let jacobian = DMatrix::from_fn(3, 3, |i, j| state.d[9 + i][1 + j]);
        let along = DMatrix::from_fn(3, 2, |i, j| state.d[9 + i][4 + j]);
        let moment = -jacobian.lu().solve(&along).unwrap();
        let flexibility: [[f64; 2]; 2] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                lengths[i][4 + j] + (0..3).map(|l| lengths[i][1 + l] * moment[(l, j)]).sum::<f64>()
            })
        });
        let [[a, b], [c, d]] = flexibility;
        assert!((b - c).abs() < 1e-12, "{flexibility:?}");
        assert!(a < 0.0 && a * d > b * c && b.abs() > 1e-4, "{flexibility:?}");
        for i in 0..2 {
            for j in 0..2 {
                let expected = derivative(|t| energy(&table, t).2[i], j);
                assert!((flexibility[i][j] - expected).abs() < 1e-9);
            }
        }
    }
}
