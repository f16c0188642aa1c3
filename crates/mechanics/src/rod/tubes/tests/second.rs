//! The same tubes written a second time: global axes, dual numbers, every tube's moment on its own, and the
//! elastic energy as a component of the state.

use super::*;
use crate::rod::propagate::tests::dual::{ROWS, cross, matrix, times, transposed};
use num_dual::{Dual64, DualNum};

type D = Dual64;

/// q, p, F, M, θ of tubes 2 to 4, m of tubes 2 to 4, elastic energy.
pub type Full = [D; 20];

fn rate(piece: &TubePiece, load: f64, step: usize, stage: usize, y: &Full) -> Full {
    let r = matrix(&[y[0], y[1], y[2], y[3]]);
    let (force, moment) = ([y[7], y[8], y[9]], [y[10], y[11], y[12]]);
    let m = times(&transposed(&r), &moment);
    let zero = D::from(0.0);
    let tubes: Vec<(usize, &Tube)> = std::iter::once((0, &piece.first))
        .chain(piece.others.iter().enumerate().filter_map(|(i, t)| t.as_ref().map(|t| (i + 1, t))))
        .collect();
    // Every tube's rest curvature in the first tube's axes.
    let rest: Vec<[D; 3]> = tubes
        .iter()
        .map(|(i, tube)| {
            let u = if tube.rest.len() == 1 { tube.rest[0] } else { tube.rest[step * ode::STAGES + stage] };
            let (s, c) = if *i == 0 { (zero, D::from(1.0)) } else { y[12 + i].sin_cos() };
            [D::from(u[0]), c * u[1] - s * u[2], s * u[1] + c * u[2]]
        })
        .collect();
    let stiffness: f64 = tubes.iter().map(|(_, t)| t.bending).sum();
    let torques: f64 = 0.0;
    let others = tubes.iter().filter(|(i, _)| *i > 0).fold(D::from(torques), |sum, (i, _)| sum + y[15 + i]);
    let first = m[0] - others;
    let common: [D; 2] = std::array::from_fn(|c| {
        tubes.iter().zip(&rest).fold(m[1 + c], |sum, ((_, t), u)| sum + u[1 + c] * t.bending) / stiffness
    });
    let k = [rest[0][0] + first / piece.first.torsion, common[0], common[1]];
    let mut out = [zero; 20];
    let (w, v) = (y[0], [y[1], y[2], y[3]]);
    let vk = cross(&v, &k);
    let along = [r[0][0], r[1][0], r[2][0]];
    let arm = cross(&along, &force);
    let sample = piece.loads.first().copied().unwrap_or_default();
    out[0] = (v[0] * k[0] + v[1] * k[1] + v[2] * k[2]) * -0.5;
    for i in 0..3 {
        out[1 + i] = (w * k[i] + vk[i]) * 0.5;
        out[4 + i] = along[i];
        out[7 + i] = D::from(-load * sample.dead_force[i]);
        out[10 + i] = -arm[i] - load * sample.dead_moment[i];
    }
    for ((i, tube), u) in tubes.iter().zip(&rest) {
        let torque = if *i == 0 { first } else { y[15 + i] };
        let own = [torque, (k[1] - u[1]) * tube.bending, (k[2] - u[2]) * tube.bending];
        if *i > 0 {
            out[12 + i] = u[0] + torque / tube.torsion - k[0];
            // The tube's own moment changes along e1 only because e1 turns.
            let e1 = [D::from(1.0), zero, zero];
            let turn = cross(&k, &e1);
            out[15 + i] = own[0] * turn[0] + own[1] * turn[1] + own[2] * turn[2];
        }
        out[19] += (own[1] * own[1] + own[2] * own[2]) * (0.5 / tube.bending)
            + torque * torque * (0.5 / tube.torsion);
    }
    out
}

/// The state at the end of the piece.
pub fn propagate(piece: &TubePiece, load: f64, start: Full) -> Full {
    let h = piece.length / piece.steps as f64;
    let mut y = start;
    for step in 0..piece.steps {
        let mut rates: Vec<Full> = Vec::new();
        let mut at = y;
        for (stage, row) in ROWS.iter().enumerate() {
            rates.push(rate(piece, load, step, stage, &at));
            at = std::array::from_fn(|i| row.iter().fold(y[i], |sum, (j, c)| sum + rates[*j][i] * (c * h)));
        }
        y = at;
    }
    y
}
