//! Newton's method kept away from solutions that are known.
//!
//! With M(x) = Π (‖x - x_k‖⁻² + 1), the system M(x) r(x) = 0 has the solutions of r = 0 but for the x_k, where it
//! blows up (P. E. Farrell, Á. Birkisson, S. W. Funke, SIAM J. Sci. Comput. 37 (2015) A2026-A2045). Its Newton step is
//! the plain one, d, times one number: `τ = 1 / (1 - ∇(ln M)·d)`.

use crate::{Breakdown, NewtonEnd, NewtonOptions, System};

/// Longest step: turning in radians, and the system's own measure, in which large multipliers are common.
const LONGEST_TURN: f64 = 0.5;
const LONGEST: f64 = 10.0;

/// From the present state to a solution that is none of `known` (stored states of the same layout).
pub fn converge_deflated(system: &mut impl System, known: &[Vec<f64>], options: &NewtonOptions) -> NewtonEnd {
    let n = system.unknowns();
    let (mut step, mut apart) = (vec![0.0; n], vec![0.0; n]);
    let mut here = Vec::new();
    let mut before = f64::INFINITY;
    for _ in 0..options.iterations {
        if let Err(breakdown) = system.linearise() {
            return NewtonEnd::Broken(breakdown);
        }
        system.newton_step(&mut step);
        let size = system.size(&step);
        if !size.is_finite() {
            return NewtonEnd::Broken(Breakdown::NotFinite);
        }
        if size <= options.tolerance {
            system.retract(&step);
            return NewtonEnd::Converged { correction: size, contraction: size / before };
        }
        before = size;
        system.store(&mut here);
        let mut slope = 0.0;
        for state in known {
            system.difference(state, &here, &mut apart);
            let square = system.product(&apart, &apart);
            let towards = system.product(&apart, &step);
            // ∇ ln(1/q + 1) with q = ‖x - x_k‖² is -2 (x - x_k) / (q² (1/q + 1)).
            slope -= 2.0 * towards / (square * (1.0 + square));
        }
        let mut factor = 1.0 / (1.0 - slope);
        if !factor.is_finite() {
            return NewtonEnd::Broken(Breakdown::NotFinite);
        }
        factor = factor.signum() * factor.abs().min(LONGEST / size).min(LONGEST_TURN / system.turning(&step));
        step.iter_mut().for_each(|s| *s *= factor);
        system.retract(&step);
    }
    NewtonEnd::IterationLimit
}

#[cfg(test)]
mod tests;
