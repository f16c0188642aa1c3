//! What holds the mechanism at rest: its own stiffness, or only what its loads will bring.

use crate::diagnose::{LARGEST_DENSE, null_space_of};
use crate::error::ProblemError;
use crate::system::Equilibrium;
use flexura_nonlinear::{BLOCK, Breakdown, System};
use nalgebra::DMatrix;
use std::sync::Arc;

/// How the unloaded mechanism stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Footing {
    /// On its own stiffness.
    Firm,
    /// Something can move without resistance; the error names it.
    Mobile(ProblemError),
    /// Nothing can move, but forces in it cannot be told apart, as in straight beams side by side that do not stretch.
    Stiff(ProblemError),
}

/// Motion by a unit force on a node, nondimensional, from which the tangent is looked at more closely.
const SUSPICIOUS: f64 = 1e7;
/// Compliance of a beam, in its own units, below which there is only round-off.
const NOISE: f64 = 1e-11;
/// Part of a null vector from which something counts as moved by it.
const MOVED: f64 = 1e-6;
/// Force, beside the loads and EI/L², from which forces count as growing beyond all bounds.
const BOUNDLESS: f64 = 1e5;
/// Cost of one entry in the factorisation of a dense tangent, beside an integration step.
const ENTRY: f64 = 1e-2;
/// Unknowns that a row of a sparse tangent meets in its factorisation, about.
const ROW: f64 = 200.0;

impl Equilibrium {
    /// Looks whether the unloaded mechanism is held. The state is that of rest afterwards.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn footing(&mut self) -> Result<Footing, ProblemError> {
        self.rest();
        self.set_load(0.0);
        if let Some(error) = self.undetermined() {
            return Ok(Footing::Stiff(error));
        }
        let null = match self.linearise() {
            Ok(()) if !self.is_suspicious() => return Ok(Footing::Firm),
            Ok(()) => self.scaled_null_space(),
            Err(Breakdown::Singular) if self.find_slack() => return Ok(Footing::Firm),
            Err(Breakdown::Singular) => self.null_space(),
            // Whoever asked for the end is heard by the study.
            Err(Breakdown::Interrupted) => return Ok(Footing::Firm),
            Err(Breakdown::NotFinite) => {
                return Err(ProblemError::new(
                    "model",
                    "gives numbers that are not finite at rest",
                    "look for stiffnesses or lengths that are many orders of magnitude apart",
                ));
            }
        };
        self.factorised = false;
        let regular = null.is_empty() && self.linearise().is_ok();
        if regular {
            return Ok(Footing::Firm);
        }
        let error = self.explain_singular(&null);
        let moves = null.iter().any(|v| self.motions().any(|unknown| v[unknown].abs() > MOVED));
        Ok(if moves { Footing::Mobile(error) } else { Footing::Stiff(error) })
    }

    /// Beams between two holds whose length nothing at rest relates to their force: straight ones that do not stretch. What stands in
    /// their rows is round-off, and an elimination does not see that.
    fn undetermined(&mut self) -> Option<ProblemError> {
        let may = |this: &Self, i: usize| {
            let span = &this.lowered.spans[i];
            let law = &this.lowered.beams[span.beam];
            span.end.is_some() && law.yields() * law.wrench_unit[0] < NOISE
        };
        if !(0..self.lowered.spans.len()).any(|i| may(self, i)) || self.evaluate(true).is_err() {
            return None;
        }
        let mut largest = vec![0.0_f64; self.layout.interface];
        self.tangent.for_each(|i, _, value| largest[i] = largest[i].max(value.abs()));
        let names: Vec<String> = (0..self.lowered.spans.len())
            .filter(|i| may(self, *i))
            .filter(|i| {
                let law = &self.lowered.beams[self.lowered.spans[*i].beam];
                let row = self.layout.spans[*i].wrench.unknown;
                largest[row..row + 6].iter().any(|value| value * law.wrench_unit[0] < NOISE)
            })
            .map(|i| format!("beam.{}", self.model.beams[self.lowered.spans[i].beam].name))
            .collect();
        let first = names.first()?.clone();
        Some(ProblemError::new(
            first,
            format!("over-constrained loop; the forces cannot be told apart of: {}", names.join(", ")),
            "free one of the joints, or let a beam of the loop stretch and bend",
        ))
    }

    /// Unknowns that are motions of nodes or coordinates.
    fn motions(&self) -> impl Iterator<Item = usize> {
        let nodes = self.layout.nodes.iter().map(|slot| (slot.unknown, 6));
        let coordinates = self.coordinate_slots().map(|(_, slot)| (slot.unknown, slot.count));
        nodes.chain(coordinates).flat_map(|(first, count)| first..first + count)
    }

    /// Does the factorised tangent let a node or coordinate go very far under a force of one? Round-off can hide that nothing
    /// holds it at all.
    fn is_suspicious(&mut self) -> bool {
        let motions: Vec<usize> = self.motions().collect();
        if motions.is_empty() {
            return false;
        }
        let kept = self.r.clone();
        self.r.fill(0.0);
        self.gaps.iter_mut().flatten().for_each(|gap| *gap = [0.0; BLOCK]);
        for (k, unknown) in motions.iter().enumerate() {
            // Numbers without a pattern, between a half and one in size.
            let wave = (2.4 * k as f64 + 0.7).sin();
            self.r[*unknown] = wave.signum() * (0.5 + 0.5 * wave.abs());
        }
        let mut step = vec![0.0; self.layout.unknowns];
        self.newton_step(&mut step);
        self.counts.newton_steps -= 1;
        self.r = kept;
        let largest = motions.iter().map(|unknown| step[*unknown].abs()).fold(0.0, f64::max);
        largest.is_nan() || largest > SUSPICIOUS
    }

    /// The null space of the tangent at the present state with rows and columns brought to one size, so that stiff parts do
    /// not hide what is loose beside them.
    pub(crate) fn scaled_null_space(&mut self) -> Vec<Vec<f64>> {
        let n = self.layout.interface;
        if n > LARGEST_DENSE {
            return self.null_space();
        }
        let _ = self.evaluate(true);
        let mut matrix = DMatrix::zeros(n, n);
        self.tangent.for_each(|i, j, value| matrix[(i, j)] += value);
        let mut scales = vec![1.0; n];
        for _ in 0..3 {
            for i in 0..n {
                let largest = matrix.row(i).amax();
                if largest > 0.0 {
                    matrix.row_mut(i).scale_mut(1.0 / largest);
                }
            }
            for (j, scale) in scales.iter_mut().enumerate() {
                let largest = matrix.column(j).amax();
                if largest > 0.0 {
                    matrix.column_mut(j).scale_mut(1.0 / largest);
                    *scale /= largest;
                }
            }
        }
        let mut null = null_space_of(matrix);
        for vector in &mut null {
            vector.iter_mut().zip(&scales).for_each(|(v, s)| *v *= s);
            let largest = vector.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            vector.iter_mut().for_each(|v| *v /= largest);
        }
        null
    }

    /// Moves every node and coordinate a little, up to `size` in L or radians, without a pattern.
    pub fn nudge(&mut self, size: f64) {
        let mut step = vec![0.0; self.layout.unknowns];
        for (k, unknown) in self.motions().enumerate() {
            step[unknown] = size * (3.7 * k as f64 + 1.3).sin();
        }
        self.retract(&step);
    }

    /// The largest motion of a node or coordinate in a step.
    pub fn moved_by(&self, step: &[f64]) -> f64 {
        self.motions().map(|unknown| step[unknown].abs()).fold(0.0, f64::max)
    }

    /// What nothing holds in the present state, under the present load; None where everything is held.
    pub fn loose_here(&mut self) -> Option<ProblemError> {
        let null = self.scaled_null_space();
        self.factorised = false;
        (!null.is_empty()).then(|| self.explain_singular(&null))
    }

    /// Cost of a factorisation, in integration steps.
    pub(crate) fn cost_of_factorising(&self) -> f64 {
        let n = self.layout.interface as f64;
        ENTRY * n * n.min(ROW) * n.min(ROW) / 30.0
    }

    /// Lets Newton's method and the way to the full load end where so much more work has been done, in integration steps of one
    /// state.
    pub fn allow_effort(&mut self, most: f64) {
        self.effort = (0.0, most);
    }

    /// Number of spans between nodes.
    pub fn spans(&self) -> usize {
        self.lowered.spans.len()
    }

    /// Gives all beams a compliance in stretching besides their own: 1 lets EI/L² of the softest stretch it by its length.
    /// The state stays.
    pub fn soften(&mut self, compliance: f64) {
        self.softening = compliance;
        for law in &mut self.lowered.beams {
            let law = Arc::make_mut(law);
            law.soften(compliance / (law.wrench_unit[0] * law.scale.force));
        }
        let counts: Vec<usize> = self.meshes.iter().map(|mesh| mesh.segments.len()).collect();
        self.remesh(&counts);
    }

    /// Is a stretch of a beam held at both ends?
    pub fn has_closed_spans(&self) -> bool {
        self.lowered.spans.iter().any(|span| span.end.is_some())
    }

    /// Is a beam among the parts?
    pub fn has_beams(&self) -> bool {
        !self.lowered.spans.is_empty()
    }

    /// The largest force or moment that is out of balance on a node or coordinate at the present state, nondimensional.
    ///
    /// # Errors
    /// The state has no sound numbers.
    pub fn unbalance(&mut self) -> Result<f64, Breakdown> {
        self.residual()?;
        Ok(self.motions().map(|unknown| self.r[unknown].abs()).fold(0.0, f64::max))
    }

    /// The largest force that a span carries, in EI/L² of its stiffest section.
    pub fn largest_force(&self) -> f64 {
        let each = self.courses.iter().enumerate();
        each.map(|(index, course)| course.most.force / self.span_strength(index)).fold(0.0, f64::max)
    }

    /// Have forces at the present state grown far beyond the loads?
    pub fn is_boundless(&mut self) -> bool {
        // What is known of forces may be that of a state that was refused.
        if self.residual().is_err() {
            return false;
        }
        let most = BOUNDLESS * (1.0 + self.given_force);
        (0..self.lowered.spans.len()).any(|index| {
            let law = &self.lowered.beams[self.lowered.spans[index].beam];
            let force = self.courses[index].most.force;
            let strain = force * law.yields();
            // A thin wire may carry that much, as long as it does not stretch out of all proportion.
            force / self.span_strength(index) > most && (strain == 0.0 || strain > 0.5)
        })
    }

    /// Of what stands in `courses` before anything is raised, and of the nodes.
    pub(crate) fn sum_of_loads(&self) -> f64 {
        let size = |load: &flexura_mechanics::load::PointLoad| {
            load.dead.force.norm()
                + load.follower.force.norm()
                + load.dead.moment.norm()
                + load.follower.moment.norm()
        };
        let nodes = self.lowered.nodes.iter().flat_map(|node| &node.loads).map(|(_, load, _)| size(load));
        let spans = self.courses.iter().map(|course| course.most);
        let spans = spans.map(|most| most.force + most.moment + most.tendons);
        let unit = self.lowered.spans.iter().map(|span| self.lowered.beams[span.beam].wrench_unit[0]);
        (nodes.sum::<f64>() + spans.sum::<f64>()) / unit.fold(f64::INFINITY, f64::min).min(1.0)
    }

    /// The largest scaled distance of nodes from where they are at rest: shift over L.
    pub fn gone(&self) -> f64 {
        let each = self.lowered.nodes.iter().zip(&self.layout.nodes);
        each.map(|(node, slot)| {
            (crate::system::read_pose(&self.x, slot.state).position - node.initial.position).norm()
        })
        .fold(0.0, f64::max)
    }
}
