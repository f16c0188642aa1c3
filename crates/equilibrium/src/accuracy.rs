//! Newton to the end, on a mesh that gives the wanted accuracy, with an estimate that can be believed.
//!
//! At the converged state the residual is evaluated once more with every step halved. The Newton correction
//! that it asks for is, to first order, the discretisation error of the state; taking it leaves the error of
//! the halved mesh, 2⁸ times smaller in the limit. The estimate reported is the correction divided by
//! [`GAIN`], far less than that limit, so that it also holds where the limit is not yet reached, plus what
//! round-off may have done.

use crate::shooting::{SegmentEnd, pose_of};
use crate::system::Equilibrium;
use flexura_mechanics::ode::{STAGES, WEIGHTS};
use flexura_mechanics::rod::Piece;
use flexura_nonlinear::{Breakdown, NewtonEnd, NewtonOptions, System, converge};
use flexura_spatial::{Vector3, log};

/// By how much halving the steps is trusted to reduce the error, at least.
const GAIN: f64 = 32.0;
/// Refinements before the wanted accuracy is given up.
const REFINEMENTS: usize = 12;

/// How the last phase ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// To the wanted accuracy.
    Done {
        /// Estimated largest error.
        error: f64,
    },
    /// Newton converged, but refining no longer reduces the error.
    AccuracyLimit {
        /// Estimated largest error.
        error: f64,
    },
    /// Newton did not converge.
    Failed(NewtonEnd),
}

/// The integral of the dead force over a piece, with the stepper's own weights.
pub(crate) fn dead_force(piece: &Piece) -> Vector3<f64> {
    let sample = |i: usize| Vector3::from(piece.loads[i].dead_force);
    match piece.loads.len() {
        0 => Vector3::zeros(),
        1 => sample(0) * piece.length,
        n => {
            let h = piece.length / piece.steps as f64;
            (0..n).map(|i| sample(i) * (h * WEIGHTS[i % STAGES])).sum()
        }
    }
}

impl Equilibrium {
    /// From a state near the solution at the present load to the solution, to `tolerance`.
    pub fn finish(&mut self, tolerance: f64) -> Finish {
        // The first mesh may err by what halving its steps will mend.
        self.restep(tolerance * GAIN, false);
        let mut step = vec![0.0; self.unknowns()];
        let mut best = f64::INFINITY;
        let mut before: Vec<Vec<SegmentEnd>> = Vec::new();
        for _ in 0..REFINEMENTS {
            let newton = NewtonOptions { tolerance: (0.1 * tolerance).max(self.floor()), iterations: 60 };
            match converge(self, &newton) {
                NewtonEnd::Converged { .. } => {}
                // On a fine mesh with huge loads the last digits may wander; what is left is round-off.
                end => return Finish::Failed(end),
            }
            if let Err(breakdown) = self.residual() {
                return Finish::Failed(NewtonEnd::Broken(breakdown));
            }
            before.clone_from(&self.ends);
            self.multiply_steps(2.0);
            if let Err(breakdown) = self.residual() {
                return Finish::Failed(NewtonEnd::Broken(breakdown));
            }
            self.newton_step(&mut step);
            let moved = self.size(&step).max(self.end_change(&before));
            if !moved.is_finite() {
                return Finish::Failed(NewtonEnd::Broken(Breakdown::NotFinite));
            }
            self.retract(&step);
            let error = moved / GAIN + self.floor() + 1e-16 * self.total_steps() as f64;
            if error <= tolerance {
                return Finish::Done { error };
            }
            if moved > 0.5 * best {
                return Finish::AccuracyLimit { error: error.max(moved) };
            }
            best = moved;
            self.multiply_steps((1.3 * (error / tolerance).powf(0.125) * 0.5).max(0.0).clamp(1.0, 8.0));
        }
        Finish::AccuracyLimit { error: best }
    }

    /// The largest scaled change of the segment ends against what they were.
    fn end_change(&self, before: &[Vec<SegmentEnd>]) -> f64 {
        let mut largest = 0.0_f64;
        for ((span, old), new) in self.lowered.spans.iter().zip(before).zip(&self.ends) {
            let law = &self.lowered.beams[span.beam];
            let shorter = law.scale.length / law.length;
            for (a, b) in old.iter().zip(new) {
                let (a, b) = (pose_of(&a.state), pose_of(&b.state));
                largest = largest
                    .max(log(&(a.rotation * b.rotation.inverse())).norm())
                    .max((a.position - b.position).norm() * shorter);
            }
        }
        largest
    }

    /// The largest scaled residual at the present state.
    pub fn residual_size(&mut self) -> f64 {
        if self.residual().is_err() {
            return f64::INFINITY;
        }
        let gaps = self.gaps.iter().flatten().flatten();
        let inner: Vec<usize> =
            self.layout.spans.iter().filter_map(|s| s.inner.last().map(|i| i.unknown)).collect();
        let own = self.r.iter().enumerate().filter(|(i, _)| !inner.iter().any(|u| (*u..u + 12).contains(i)));
        own.map(|(_, r)| r.abs()).chain(gaps.map(|g| g.abs())).fold(0.0, f64::max)
    }

    /// Position of the far end of the last span at the last evaluation, m.
    pub fn tip(&self) -> Vector3<f64> {
        let last = self.ends.last().and_then(|ends| ends.last());
        last.map_or(Vector3::zeros(), |end| pose_of(&end.state).position * self.lowered.scale.length)
    }

    /// Integration steps of the present mesh, over all beams.
    pub fn integration_steps(&self) -> usize {
        self.total_steps()
    }

    /// Shooting segments of the present mesh, over all beams.
    pub fn segments(&self) -> usize {
        self.meshes.iter().map(|m| m.segments.len()).sum()
    }

    /// The load fraction that the state belongs to.
    pub fn load_fraction(&self) -> f64 {
        self.load
    }
}
