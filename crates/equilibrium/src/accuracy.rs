//! Newton to the end, on a mesh that gives the wanted accuracy, with an estimate that can be believed.
//!
//! At the converged state the residual is evaluated once more with every step halved. The Newton correction
//! that it asks for is, to first order, the discretisation error of the state; taking it leaves the error of
//! the halved mesh, 2⁸ times smaller in the limit. The estimate reported is the correction divided by
//! [`GAIN`], far less than that limit, so that it also holds where the limit is not yet reached, plus what
//! round-off may have done.

use crate::mesh::Stretch;
use crate::shooting::{Acting, carry_through, jump, pose_of};
use crate::system::Equilibrium;
use flexura_mechanics::ode::{STAGES, WEIGHTS};
use flexura_mechanics::rod::Piece;
use flexura_nonlinear::{Breakdown, NewtonEnd, NewtonOptions, System, converge};
use flexura_spatial::{Pose, Vector3, log};

/// By how much halving the steps is trusted to reduce the error, at least.
const GAIN: f64 = 32.0;
/// Corrections on one mesh; more would chase round-off.
const POLISHES: usize = 10;
/// Refinements before the wanted accuracy is given up.
const REFINEMENTS: usize = 12;

/// How finely everything is integrated.
#[derive(Clone, Debug)]
pub struct Mesh {
    spans: Vec<crate::mesh::SpanMesh>,
    tubes: Vec<Vec<usize>>,
    known: Vec<Vector3<f64>>,
    accuracy: f64,
}

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

/// Where a segment ended, and how far the last correction was expected to turn and move that end.
struct ExpectedEnd {
    pose: Pose,
    turn: Vector3<f64>,
    shift: Vector3<f64>,
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
    /// From a state near the solution at the present load to the solution, to `tolerance`. Newton does not start
    /// where its first correction would be larger than `nearest`.
    pub fn finish(&mut self, tolerance: f64, nearest: f64) -> Finish {
        // The first mesh may err by what halving its steps will mend, and Newton by as much: the correction on
        // the halved mesh takes both away.
        self.restep(tolerance * GAIN, false);
        let law_error = self.meshes.iter().map(|mesh| mesh.cut.law_error).fold(0.0, f64::max);
        self.set_weights(true);
        let mut step = vec![0.0; self.unknowns()];
        let mut best = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let tolerance_here = (0.3 * GAIN * tolerance).max(self.floor());
            let newton = NewtonOptions { tolerance: tolerance_here, iterations: 60, nearest };
            let mut rate = match converge(self, &newton) {
                NewtonEnd::Converged { contraction, .. } => contraction,
                end => return Finish::Failed(end),
            };
            let expected = self.expected_ends();
            self.multiply_steps(2.0);
            let mut moved = match self.correct(&mut step) {
                Ok(size) => size.max(self.end_change(&expected)),
                Err(breakdown) => return Finish::Failed(NewtonEnd::Broken(breakdown)),
            };
            let floor = self.floor() + 1e-16 * self.total_steps() as f64;
            // What Newton still leaves is polished away on the same mesh.
            let mut left = rate * moved;
            for _ in 0..POLISHES {
                if left <= 0.1 * tolerance.max(floor) {
                    break;
                }
                let size = match self.correct(&mut step) {
                    Ok(size) => size,
                    Err(breakdown) => return Finish::Failed(NewtonEnd::Broken(breakdown)),
                };
                rate = (size / moved).min(1.0);
                moved = moved.max(size);
                left = rate * size;
            }
            let error = moved / GAIN + left + floor + law_error;
            if error <= tolerance {
                return Finish::Done { error };
            }
            if moved > 0.5 * best {
                return Finish::AccuracyLimit { error: error.max(moved) };
            }
            best = moved;
            self.refine(error / tolerance);
        }
        Finish::AccuracyLimit { error: best }
    }

    /// More steps, and where they are needed, for an error that is `excess` times what it may be.
    fn refine(&mut self, excess: f64) {
        let enough = |excess: f64| 0.65 * excess.powf(0.125);
        if self.meshes.iter().map(|mesh| mesh.stretches().count()).sum::<usize>() == 1 {
            self.multiply_steps(enough(excess).clamp(1.0, 8.0));
            return;
        }
        let defects = self.stretch_defects();
        let count = defects.iter().flatten().count() as f64;
        let mean = defects.iter().flatten().sum::<f64>() / count;
        for ((span, mesh), defects) in self.lowered.spans.iter().zip(&mut self.meshes).zip(&defects) {
            // Each stretch may err by an equal part. Where it errs less the steps stay as they were before they were halved.
            mesh.multiply(&self.lowered.beams[span.beam], span, |i, present| {
                let share = if mean > 0.0 { defects[i] / mean } else { 1.0 };
                let least = if share >= 1.0 { 1.0 } else { 0.5 };
                (present as f64 * enough(excess * share).clamp(least, 8.0)).ceil() as usize
            });
        }
        self.multiply_tube_steps(enough(excess).clamp(1.0, 8.0));
        self.sum_known_forces();
    }

    /// For every stretch of every span, by how much its end moves and turns if it has half as many steps.
    fn stretch_defects(&self) -> Vec<Vec<f64>> {
        let mut all = Vec::with_capacity(self.meshes.len());
        for (index, (span, mesh)) in self.lowered.spans.iter().zip(&self.meshes).enumerate() {
            let law = &self.lowered.beams[span.beam];
            let shorter = law.scale.length / law.length;
            let pulls = self.pulls(index);
            let acting = Acting { jumps: &span.jumps, load: self.load, pulls: &pulls };
            let mut defects = Vec::new();
            for (k, segment) in mesh.segments.iter().enumerate() {
                let mut state = self.segment_start(index, k);
                for stretch in segment {
                    let mut coarse = state;
                    let half = stretch.piece.steps.div_ceil(2);
                    carry_through(
                        &Stretch::new(law, span, stretch.s, half, Vec::new()),
                        &acting,
                        &mut coarse,
                    );
                    carry_through(stretch, &acting, &mut state);
                    let (fine, coarse) = (pose_of(&state), pose_of(&coarse));
                    let turned = log(&(fine.rotation * coarse.rotation.inverse())).norm();
                    defects.push(turned + (fine.position - coarse.position).norm() * shorter);
                    stretch.jumps.iter().for_each(|&j| jump(&span.jumps[j], self.load, &mut state));
                }
            }
            all.push(defects);
        }
        all
    }

    /// One simplified Newton correction on the present mesh; its size.
    fn correct(&mut self, step: &mut [f64]) -> Result<f64, Breakdown> {
        self.residual()?;
        self.newton_step(step);
        let size = self.size(step);
        if !size.is_finite() {
            return Err(Breakdown::NotFinite);
        }
        self.retract(step);
        Ok(size)
    }

    /// Where the segments would end after the last correction, by the tangent at hand.
    fn expected_ends(&self) -> Vec<Vec<ExpectedEnd>> {
        let step = &self.last_step;
        let mut all = Vec::with_capacity(self.ends.len());
        for (span, ends) in self.ends.iter().enumerate() {
            let mut expected = Vec::with_capacity(ends.len());
            for (k, end) in ends.iter().enumerate() {
                let (mut turn, mut shift) = (Vector3::zeros(), Vector3::zeros());
                let mut add = |column: usize, unknown: usize| {
                    turn += crate::assembly::rows(&end.columns[column], 0) * step[unknown];
                    shift += crate::assembly::rows(&end.columns[column], 3) * step[unknown];
                };
                if k == 0 {
                    self.head_unknowns(span, add);
                } else {
                    let first = self.layout.spans[span].inner[k - 1].unknown;
                    (0..12).for_each(|i| add(i, first + i));
                }
                expected.push(ExpectedEnd { pose: pose_of(&end.state), turn, shift });
            }
            all.push(expected);
        }
        for tip in &self.tips {
            let (mut turn, mut shift) = (Vector3::zeros(), Vector3::zeros());
            for (unknown, column) in &tip.columns {
                turn += crate::assembly::rows(column, 0) * step[*unknown];
                shift += crate::assembly::rows(column, 3) * step[*unknown];
            }
            all.push(vec![ExpectedEnd { pose: tip.pose.unwrap_or(Pose::identity()), turn, shift }]);
        }
        all
    }

    /// The largest scaled difference of the segment ends from where they were expected.
    fn end_change(&self, expected: &[Vec<ExpectedEnd>]) -> f64 {
        let mut largest = 0.0_f64;
        for ((span, old), new) in self.lowered.spans.iter().zip(expected).zip(&self.ends) {
            let law = &self.lowered.beams[span.beam];
            let shorter = law.scale.length / law.length;
            for (before, end) in old.iter().zip(new) {
                let now = pose_of(&end.state);
                let turned = log(&(now.rotation * before.pose.rotation.inverse())) - before.turn;
                let moved = now.position - before.pose.position - before.shift;
                largest = largest.max(turned.norm()).max(moved.norm() * shorter);
            }
        }
        for ((tip, before), nest) in
            self.tips.iter().zip(expected.iter().skip(self.ends.len()).flatten()).zip(&self.lowered.nests)
        {
            let now = tip.pose.unwrap_or(Pose::identity());
            let turned = log(&(now.rotation * before.pose.rotation.inverse())) - before.turn;
            let moved = now.position - before.pose.position - before.shift;
            largest = largest.max(turned.norm()).max(moved.norm() / nest.tip());
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

    /// Position of the far end of the last span, m.
    pub fn tip(&mut self) -> Vector3<f64> {
        if self.residual().is_err() {
            return Vector3::repeat(f64::NAN);
        }
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

impl Equilibrium {
    /// The correction that steps half as long ask for at a converged state; the state and the mesh stay. The tangent must be
    /// that of the state.
    ///
    /// # Errors
    /// The residual has no sound numbers.
    pub fn mesh_correction(&mut self, step: &mut [f64]) -> Result<(), Breakdown> {
        let (meshes, tubes) = (self.meshes.clone(), self.tube_steps.clone());
        let known = self.known_force.clone();
        self.multiply_steps(2.0);
        let outcome = self.residual();
        self.newton_step(step);
        self.meshes = meshes;
        self.tube_steps = tubes;
        self.known_force = known;
        outcome
    }

    /// The present mesh, to be put back by [`Equilibrium::set_mesh`] at the same parameters.
    pub fn mesh(&self) -> Mesh {
        Mesh {
            spans: self.meshes.clone(),
            tubes: self.tube_steps.clone(),
            known: self.known_force.clone(),
            accuracy: self.accuracy,
        }
    }

    /// Puts a mesh of the same segments back.
    pub fn set_mesh(&mut self, mesh: Mesh) {
        (self.meshes, self.tube_steps, self.known_force, self.accuracy) =
            (mesh.spans, mesh.tubes, mesh.known, mesh.accuracy);
    }

    /// Makes all integration steps half as long, which improves the accuracy by about 2⁸.
    pub fn halve_steps(&mut self) {
        self.multiply_steps(2.0);
        self.accuracy /= 256.0;
    }

    /// The accuracy that the mesh is made for.
    pub fn mesh_accuracy(&self) -> f64 {
        self.accuracy
    }

    /// Measures unknowns for the last digits: wrenches against the largest that their beam carries.
    pub fn weigh(&mut self) {
        self.set_weights(true);
    }

    /// Measures wrenches against EI/L² and EI/L, as on the way to the full load.
    pub fn weigh_for_the_way(&mut self) {
        self.set_weights(false);
    }
}
