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

use super::balance::{Lanes, Matrix, add, apply, apply_lanes, cross, cross_lanes, section_wrench, sub};
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
    /// What a spinning frame does, in proportion to the load.
    pub spin: Option<Spinning>,
}

/// Centrifugal force and moment per undeformed length in a frame that turns at a rate of 1 about a line:
///
/// ```text
/// q = -m a × (a × (p - c))        q_M = -a × (J a)        J = R diag(j) Rᵀ
/// ```
///
/// with the energy -½ m |a × (p - c)|² - ½ a·J a.
#[derive(Clone, Debug, PartialEq)]
pub struct Spinning {
    /// a, unit vector along the line, global.
    pub axis: [f64; 3],
    /// c, a point of it.
    pub through: [f64; 3],
    /// m and j times the square of the rate; one for every stage of every step, or one for all.
    pub inertia: Vec<(f64, [f64; 3])>,
}

impl Spinning {
    fn at(&self, index: usize) -> &(f64, [f64; 3]) {
        &self.inertia[if self.inertia.len() == 1 { 0 } else { index }]
    }
}

impl Foundation {
    /// q at the axis position `p` with its changes, both global.
    #[inline(always)]
    fn force<const W: usize>(
        &self,
        index: usize,
        p: &[f64; 3],
        dp: &Lanes<W>,
        load: f64,
    ) -> ([f64; 3], Lanes<W>) {
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
        if let Some(spin) = &self.spin {
            let (mass, a) = (load * spin.at(index).0, &spin.axis);
            let arm: [f64; 3] = std::array::from_fn(|i| p[i] - spin.through[i]);
            let along = a[0] * arm[0] + a[1] * arm[1] + a[2] * arm[2];
            for i in 0..3 {
                q[i] += mass * (arm[i] - along * a[i]);
                for l in 1..W {
                    let moved = a[0] * dp[0][l] + a[1] * dp[1][l] + a[2] * dp[2][l];
                    dq[i][l] += mass * (dp[i][l] - moved * a[i]);
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
    /// Load factor of what spins.
    pub load: f64,
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
        let (q, dq) = self.foundation.force(step * STAGES + stage, &p, &dp, self.load);
        localised(&self.r0, &q, &dq, &self.dtheta)
    }

    /// q_M of what spins, in the piece's start frame with its changes there, at a section of orientation `q` in that frame.
    #[inline(always)]
    pub fn moment(&self, step: usize, stage: usize, q: &[[f64; W]; 4]) -> Option<Lanes<W>> {
        let spin = self.foundation.spin.as_ref()?;
        let (_, rotary) = spin.at(step * STAGES + stage);
        if self.load == 0.0 || rotary[0] == rotary[1] && rotary[1] == rotary[2] {
            return None;
        }
        let local = localised(&self.r0, &spin.axis, &[[0.0; W]; 3], &self.dtheta);
        let section = section_wrench(q, &local, &local);
        let (a, da) = (section.value[0], &section.change[0]);
        let turned: [f64; 3] = std::array::from_fn(|i| rotary[i] * a[i]);
        let mut changed = *da;
        for (row, j) in changed.iter_mut().zip(rotary) {
            row.iter_mut().for_each(|value| *value *= j);
        }
        // m = J a × a in the section's axes; R m changes by R (δm + δφ × m).
        let m = cross(&turned, &a);
        let dm = sub(&cross_lanes(&turned, da), &cross_lanes(&a, &changed));
        let carried = sub(&dm, &cross_lanes(&m, &section.dphi));
        let (value, change) = (apply(&section.r, &m), apply_lanes(&section.r, &carried));
        let mut out = [[0.0; W]; 3];
        for i in 0..3 {
            for l in 1..W {
                out[i][l] = self.load * change[i][l];
            }
            out[i][0] = self.load * value[i];
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests;
