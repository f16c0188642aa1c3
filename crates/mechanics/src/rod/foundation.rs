//! An elastic foundation along a rod: it pushes back what has left its place.
//!
//! With p_0(s) the place that the axis has in the undeformed mechanism and d unit vectors fixed in space, the foundation
//! exerts on the rod, per undeformed length,
//!
//! ```text
//! q = -K (p - p_0) - Σ f(u) d        u = d·(p - p_0)
//! ```
//!
//! K = Σ k d dᵀ holds all that is linear. The force has the energy ½ (p - p_0)·K (p - p_0) + Σ ∫ f du, so it is conservative. (E. Winkler,
//! *Die Lehre von der Elasticitaet und Festigkeit*, 1867; S. Timoshenko, *Strength of Materials*, part II, 3rd ed. (1956), ch. 1.)

use super::balance::{Lanes, Matrix, add, apply, apply_lanes, cross_lanes, sub};
use super::propagate::localised;
use crate::ode::STAGES;
use flexura_expression::Function;

/// The foundation at one place of a rod.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FoundationSample {
    /// p_0, global.
    pub rest: [f64; 3],
    /// K, global axes: force per length and displacement.
    pub stiffness: [[f64; 3]; 3],
}

/// A law f(u) along one direction, in the units of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Resistance {
    /// f in N/m of u in m.
    pub force: Function,
    /// Metres to a unit of length.
    pub length: f64,
    /// Units of force per length to an N/m.
    pub unit: f64,
}

impl Resistance {
    /// f and df/du at a displacement, in the solver's units.
    pub fn at(&self, u: f64) -> [f64; 2] {
        let [value, slope, ..] = self.force.jet(u * self.length);
        [value * self.unit, slope * self.unit * self.length]
    }
}

/// What acts along one piece of a rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// One for every stage of every step.
    pub samples: Vec<FoundationSample>,
    /// Laws that are not linear, each with its direction d at every stage of every step, global.
    pub resistances: Vec<(Resistance, Vec<[f64; 3]>)>,
}

impl Foundation {
    /// q at the axis position `p` with its changes, both global.
    #[inline(always)]
    fn force<const W: usize>(&self, index: usize, p: &[f64; 3], dp: &Lanes<W>) -> ([f64; 3], Lanes<W>) {
        let sample = &self.samples[index];
        let w: [f64; 3] = std::array::from_fn(|i| p[i] - sample.rest[i]);
        let pushed = apply_lanes(&sample.stiffness, dp);
        let mut q = apply(&sample.stiffness, &w).map(|v| -v);
        let mut dq = sub(&[[0.0; W]; 3], &pushed);
        for (law, directions) in &self.resistances {
            let d = &directions[index];
            let [force, slope] = law.at(d[0] * w[0] + d[1] * w[1] + d[2] * w[2]);
            for i in 0..3 {
                q[i] -= force * d[i];
                for l in 1..W {
                    dq[i][l] -= slope * d[i] * (d[0] * dp[0][l] + d[1] * dp[1][l] + d[2] * dp[2][l]);
                }
            }
        }
        (q, dq)
    }
}

/// A piece's foundation together with where the piece starts.
pub(super) struct Footing<'a, const W: usize> {
    pub foundation: &'a Foundation,
    pub r0: Matrix,
    /// Turning of the piece's start.
    pub dtheta: Lanes<W>,
    /// Position of the piece's start, and its changes.
    pub start: ([f64; 3], Lanes<W>),
}

impl<const W: usize> Footing<'_, W> {
    /// q in the piece's start frame, with its changes there, at the axis position `local` in that frame.
    #[inline(always)]
    pub fn force(&self, step: usize, stage: usize, local: &Lanes<W>) -> Lanes<W> {
        let arm = apply(&self.r0, &[local[0][0], local[1][0], local[2][0]]);
        let p = std::array::from_fn(|i| self.start.0[i] + arm[i]);
        // δp = δp0 + δθ0 × (R0 p) + R0 δp.
        let carried = sub(&apply_lanes(&self.r0, local), &cross_lanes(&arm, &self.dtheta));
        let dp = add(&self.start.1, &carried);
        let (q, dq) = self.foundation.force(step * STAGES + stage, &p, &dp);
        localised(&self.r0, &q, &dq, &self.dtheta)
    }
}

#[cfg(test)]
mod tests;
