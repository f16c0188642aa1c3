//! Newton's method at a fixed load, with a step rule that cannot accept a worse point.
//!
//! The natural monotonicity test (P. Deuflhard, *Newton Methods for Nonlinear Problems*, section 3.3): a step
//! is accepted only if the simplified Newton correction after it, -J⁻¹ r(x + α d) with the old J, is shorter
//! than the step was. It does not depend on how equations are scaled. Where the contraction is fast the
//! old factorisation serves on, so that most iterations cost a residual only.

use crate::{Breakdown, System};

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct NewtonOptions {
    /// Size of the last correction.
    pub tolerance: f64,
    /// Most corrections.
    pub iterations: usize,
    /// Size of the first correction beyond which the start counts as far from any solution.
    pub nearest: f64,
}

/// How it ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NewtonEnd {
    /// The last correction was below the tolerance; it has been applied.
    Converged {
        /// Size of that correction.
        correction: f64,
        /// How much the last correction was smaller than the one before: what the next would be smaller by.
        contraction: f64,
    },
    /// The first correction was larger than allowed; the state is untouched.
    Far,
    /// No step along the Newton direction leads to a better point.
    NoDescent,
    /// Too many corrections.
    IterationLimit,
    /// The system has done more work than it may.
    Exhausted,
    /// The residual or tangent could not be had.
    Broken(Breakdown),
}

/// Contraction up to which the old factorisation is used on.
const FAST: f64 = 0.1;
/// Smallest step factor.
const SMALLEST: f64 = 1.0 / 256.0;

/// Brings the state of `system` to a solution. On failure the state is the best that was reached.
pub fn converge(system: &mut impl System, options: &NewtonOptions) -> NewtonEnd {
    let n = system.unknowns();
    let (mut step, mut next) = (vec![0.0; n], vec![0.0; n]);
    let mut kept = Vec::new();
    let mut rate = 0.0_f64;
    // Where the start is near, the tangent of the last solution often serves for the first steps.
    let mut fresh = !(options.nearest.is_finite() && system.has_tangent());
    if let Err(breakdown) = if fresh { system.linearise() } else { system.residual() } {
        return NewtonEnd::Broken(breakdown);
    }
    system.newton_step(&mut step);
    let mut size = system.size(&step);
    if size > options.nearest {
        return NewtonEnd::Far;
    }
    let mut factor = 1.0;
    for _ in 0..options.iterations {
        if !size.is_finite() {
            return NewtonEnd::Broken(Breakdown::NotFinite);
        }
        if size <= options.tolerance {
            system.retract(&step);
            return NewtonEnd::Converged { correction: size, contraction: rate };
        }
        if system.is_exhausted() {
            return NewtonEnd::Exhausted;
        }
        system.store(&mut kept);
        loop {
            for (to, from) in next.iter_mut().zip(&step) {
                *to = factor * from;
            }
            system.retract(&next);
            let after = match system.residual() {
                Ok(()) => {
                    system.newton_step(&mut next);
                    system.size(&next)
                }
                Err(_) => f64::INFINITY,
            };
            if after <= (1.0 - 0.25 * factor) * size {
                let contraction = after / size;
                rate = contraction;
                if factor == 1.0 && (contraction < FAST || after <= options.tolerance) {
                    std::mem::swap(&mut step, &mut next);
                    size = after;
                    fresh = false;
                } else {
                    if let Err(breakdown) = system.linearise() {
                        return NewtonEnd::Broken(breakdown);
                    }
                    system.newton_step(&mut step);
                    size = system.size(&step);
                    fresh = true;
                    factor = (2.0 * factor).min(1.0);
                }
                break;
            }
            system.restore(&kept);
            if !fresh {
                // The old tangent has served its time; renew it before any shortening.
                if let Err(breakdown) = system.linearise() {
                    return NewtonEnd::Broken(breakdown);
                }
                system.newton_step(&mut step);
                size = system.size(&step);
                fresh = true;
                break;
            }
            factor *= 0.5;
            if factor < SMALLEST {
                return NewtonEnd::NoDescent;
            }
        }
    }
    NewtonEnd::IterationLimit
}
