//! The state at rest, and the mesh and layout that follow from how hard the spans are loaded.

use crate::beam::BeamLaw;
use crate::layout::Layout;
use crate::lower::{Lowered, RopeLaw, Span};
use crate::mesh::{Level, SpanMesh, Stretch};
use crate::shooting::{Acting, Plain, SegmentEnd, carry_plain, carry_through, jump};
use crate::system::{Counts, Equilibrium, write_pose};
use flexura_mechanics::joint::MAX_CONFIGURATION;
use flexura_nonlinear::{BLOCK, Chain};
use flexura_spatial::Vector3;

/// What a step costs to be made anew, beside carrying a state along it.
const REMESHED: f64 = 10.0;
/// Accuracy of the mesh on the way to the full load where only positions depend on it.
const LOOSE: f64 = 1e-4;
/// The same where a closure error turns into force.
const SNUG: f64 = 1e-7;

impl Equilibrium {
    /// Accuracy of the mesh while the load is raised.
    pub(crate) fn path_accuracy(&self) -> f64 {
        let closed = self.lowered.spans.iter().any(|span| span.end.is_some());
        if closed { SNUG } else { LOOSE }
    }

    /// Puts the mechanism at rest: unloaded, every body where the model puts it.
    pub fn rest(&mut self) {
        self.load = 0.0;
        self.counts = Counts::default();
        self.accuracy = self.path_accuracy().min(self.finest_path);
        let first_time = self.meshes.is_empty();
        self.levels = self.lowered.spans.iter().map(|span| self.expected_level(span)).collect();
        self.expected.clone_from(&self.levels);
        let forced = self.forced_segments.unwrap_or(1);
        // Along a stiff foundation what a start changes grows even at rest.
        let unloaded = |span: &Span| Level::default().segments(&self.lowered.beams[span.beam], span);
        let count = |span| unloaded(span).max(forced);
        let counts: Vec<usize> =
            self.lowered.spans.iter().map(|span| if span.undivided { 1 } else { count(span) }).collect();
        let fits = !first_time && counts.iter().zip(&self.meshes).all(|(c, m)| *c == m.segments.len());
        if fits {
            self.restep(self.accuracy, false);
            self.set_weights(false);
        } else {
            self.remesh(&counts);
        }
        self.x.clear();
        self.x.resize(self.layout.state, 0.0);
        for (node, slot) in self.lowered.nodes.iter().zip(&self.layout.nodes) {
            write_pose(&mut self.x, slot.state, &node.initial);
        }
        for (span, slots) in self.lowered.spans.iter().zip(&self.layout.spans) {
            copy(&mut self.x, slots.start.state, &span.start.coordinates.initial, 0, MAX_CONFIGURATION);
            if let Some(end) = &span.end {
                copy(&mut self.x, slots.end.state, &end.coordinates.initial, 0, MAX_CONFIGURATION);
            }
        }
        for (joint, slots) in self.lowered.joints.iter().zip(&self.layout.joints) {
            copy(&mut self.x, slots.coordinates.state, &joint.coordinates.initial, 0, MAX_CONFIGURATION);
        }
        for i in 0..self.lowered.spans.len() {
            let beam = self.lowered.spans[i].beam;
            for k in 0..self.layout.spans[i].inner.len() {
                let s = self.meshes[i].start_of(k + 1);
                let local = self.lowered.scale.pose_in(&self.lowered.beams[beam].shape.pose(s));
                let pose = self.lowered.beam_rest[beam] * local;
                let at = self.layout.spans[i].inner[k].state;
                write_pose(&mut self.x, at, &pose);
            }
        }
    }

    /// What the given loads lead one to expect along a span.
    fn expected_level(&self, span: &Span) -> Level {
        let mut level = Level::default();
        let law = &self.lowered.beams[span.beam];
        for j in &span.jumps {
            level.force += j.load.dead.force.norm() + j.load.follower.force.norm();
            level.moment = level.moment.max((j.load.dead.moment + j.load.follower.moment).norm());
        }
        if law.is_loaded() {
            let piece = law.piece(span.s[0], span.s[1], 1);
            let total = |q: &[f64; 3]| Vector3::from(*q).norm() * piece.length;
            level.force += piece
                .loads
                .iter()
                .map(|l| total(&l.dead_force) + total(&l.section_force))
                .fold(0.0, f64::max);
        }
        for channel in &span.channels {
            if let RopeLaw::Tension(tension) = self.lowered.ropes[span.tendons[channel.tendon]].law {
                level.tendons += tension * channel.reach;
            }
        }
        level
    }

    pub(crate) fn remesh(&mut self, counts: &[usize]) {
        let accuracy = self.accuracy;
        self.effort.0 += self.total_steps() as f64 * REMESHED;
        self.meshes = self
            .lowered
            .spans
            .iter()
            .zip(counts)
            .zip(&self.levels)
            .map(|((span, &count), level)| {
                let law = &self.lowered.beams[span.beam];
                SpanMesh::build(law, span, count, |s| level.steps(law, span, s, accuracy))
            })
            .collect();
        self.layout = Layout::new(&self.lowered, &self.meshes);
        self.ends = self.meshes.iter().map(|m| vec![SegmentEnd::new(); m.segments.len()]).collect();
        self.chains = vec![Chain::default(); self.meshes.len()];
        self.gaps = self.meshes.iter().map(|m| vec![[0.0; BLOCK]; m.segments.len() - 1]).collect();
        self.r = vec![0.0; self.layout.interface];
        self.tube_steps = self.lowered.nests.iter().map(|nest| nest.steps(accuracy)).collect();
        self.tips = vec![crate::tubes::Tip::default(); self.lowered.nests.len()];
        self.factorised = false;
        let blocks = self.layout.blocks(&self.lowered);
        self.tangent.arrange(self.layout.interface, &blocks);
        self.set_weights(false);
        self.sum_known_forces();
    }

    /// Adapts the number of steps to the present levels; never fewer than now if `grow`.
    pub(crate) fn restep(&mut self, accuracy: f64, grow: bool) {
        self.accuracy = accuracy;
        for ((span, mesh), level) in self.lowered.spans.iter().zip(&mut self.meshes).zip(&self.levels) {
            let law: &BeamLaw = &self.lowered.beams[span.beam];
            mesh.restep(law, span, |s, present| {
                let wanted = level.steps(law, span, s, accuracy);
                if grow { wanted.max(present) } else { wanted }
            });
        }
        for (nest, steps) in self.lowered.nests.iter().zip(&mut self.tube_steps) {
            for (present, wanted) in steps.iter_mut().zip(nest.steps(accuracy)) {
                *present = if grow { wanted.max(*present) } else { wanted };
            }
        }
        self.sum_known_forces();
    }

    /// Multiplies the number of steps of every stretch.
    pub(crate) fn multiply_steps(&mut self, factor: f64) {
        for (span, mesh) in self.lowered.spans.iter().zip(&mut self.meshes) {
            let law: &BeamLaw = &self.lowered.beams[span.beam];
            mesh.restep(law, span, |_, present| ((present as f64 * factor).ceil() as usize).max(present + 1));
        }
        for steps in self.tube_steps.iter_mut().flatten() {
            *steps = ((*steps as f64 * factor).ceil() as usize).max(*steps + 1);
        }
        self.sum_known_forces();
    }

    pub(crate) fn total_steps(&self) -> usize {
        let tubes: usize = self.tube_steps.iter().flatten().sum();
        self.meshes.iter().map(SpanMesh::steps).sum::<usize>() + tubes
    }

    /// Sums the known forces anew, as the mesh or the loads have changed.
    pub(crate) fn sum_known_forces(&mut self) {
        self.known_force = known_forces(&self.lowered, &self.meshes);
    }

    /// The state at arc length `s` of a span, starting from the segment that holds it.
    pub(crate) fn state_at(&self, span: usize, s: f64) -> Plain {
        let mesh = &self.meshes[span];
        let segment = (0..mesh.segments.len()).rev().find(|&k| mesh.start_of(k) <= s).unwrap_or(0);
        let jumps = &self.lowered.spans[span].jumps;
        let mut state = if segment == 0 {
            let mut head = self.head_state(span);
            for &j in &mesh.first_jumps {
                jump(&jumps[j], self.load, &mut head);
            }
            head
        } else {
            self.inner_state(self.layout.spans[span].inner[segment - 1].state)
        };
        let description = &self.lowered.spans[span];
        let law = &self.lowered.beams[description.beam];
        let pulls = self.pulls(span);
        let acting = Acting { jumps, load: self.load, pulls: &pulls };
        for stretch in &mesh.segments[segment] {
            if stretch.s[1] <= s {
                carry_plain(std::slice::from_ref(stretch), &acting, &mut state);
            } else {
                let part = (s - stretch.s[0]) / (stretch.s[1] - stretch.s[0]);
                if part > 0.0 {
                    let steps = ((stretch.piece.steps as f64 * part).ceil() as usize).max(1);
                    let part = Stretch::new(law, description, [stretch.s[0], s], steps, Vec::new());
                    carry_through(&part, &acting, &mut state);
                }
                break;
            }
        }
        state
    }

    /// How many segments the spans should have.
    fn wanted_segments(&self) -> Vec<usize> {
        self.lowered
            .spans
            .iter()
            .zip(&self.levels)
            .zip(&self.meshes)
            .map(|((span, level), mesh)| {
                let wanted = level.segments(&self.lowered.beams[span.beam], span);
                let present = mesh.segments.len();
                // A little more than needed, so that a growing force does not cut again at every step.
                if wanted > present { (wanted * 3).div_ceil(2) } else { present }
            })
            .collect()
    }

    /// Have forces grown so that the spans should be cut into more segments, which changes the layout of the state?
    pub fn wants_segments(&self) -> bool {
        self.wanted_segments().iter().zip(&self.meshes).any(|(c, m)| *c != m.segments.len())
    }

    /// Have forces grown so that the mesh should have more steps?
    pub fn wants_steps(&self) -> bool {
        self.lowered.spans.iter().zip(&self.meshes).zip(&self.levels).any(|((span, mesh), level)| {
            let law = &self.lowered.beams[span.beam];
            mesh.stretches().any(|s| level.steps(law, span, s.s, self.accuracy) > s.piece.steps)
        })
    }

    /// Makes a mesh of this accuracy.
    pub fn set_mesh_accuracy(&mut self, accuracy: f64) {
        self.restep(accuracy, false);
    }

    /// Cuts the spans as another problem of the same model has them cut; the state stays.
    pub fn take_segments_of(&mut self, other: &Self) {
        let counts: Vec<usize> = other.meshes.iter().map(|mesh| mesh.segments.len()).collect();
        self.cut(&counts);
    }

    /// New segments where forces have grown; true if the state's layout changed.
    pub(crate) fn resegment(&mut self) -> bool {
        let counts = self.wanted_segments();
        if counts.iter().zip(&self.meshes).all(|(c, m)| *c == m.segments.len()) {
            return false;
        }
        self.cut(&counts);
        true
    }

    fn cut(&mut self, counts: &[usize]) {
        let old = self.clone();
        self.remesh(counts);
        self.x = vec![0.0; self.layout.state];
        for (to, from) in self.layout.nodes.iter().zip(&old.layout.nodes) {
            self.x[to.state..to.state + 7].copy_from_slice(&old.x[from.state..from.state + 7]);
        }
        for (to, from) in self.layout.joints.iter().zip(&old.layout.joints) {
            copy(&mut self.x, to.coordinates.state, &old.x, from.coordinates.state, MAX_CONFIGURATION);
            copy(&mut self.x, to.wrench.state, &old.x, from.wrench.state, 6);
        }
        let numbers = |layout: &Layout| -> Vec<usize> {
            layout.gears.iter().chain(layout.ropes.iter().flatten()).map(|slot| slot.state).collect()
        };
        for (to, from) in numbers(&self.layout).into_iter().zip(numbers(&old.layout)) {
            self.x[to] = old.x[from];
        }
        for (to, from) in self.layout.nests.iter().zip(&old.layout.nests) {
            copy(&mut self.x, to.state, &old.x, from.state, to.count);
        }
        for i in 0..self.layout.spans.len() {
            let (to, from) = (&self.layout.spans[i], &old.layout.spans[i]);
            copy(&mut self.x, to.start.state, &old.x, from.start.state, MAX_CONFIGURATION);
            copy(&mut self.x, to.wrench.state, &old.x, from.wrench.state, 6);
            if self.lowered.spans[i].end.is_some() {
                copy(&mut self.x, to.end.state, &old.x, from.end.state, MAX_CONFIGURATION);
            }
            for k in 0..to.inner.len() {
                let state = old.state_at(i, self.meshes[i].start_of(k + 1));
                let at = self.layout.spans[i].inner[k].state;
                self.x[at..at + 4].copy_from_slice(&state.rotation);
                self.x[at + 4..at + 7].copy_from_slice(&state.position);
                self.x[at + 7..at + 10].copy_from_slice(&state.force);
                self.x[at + 10..at + 13].copy_from_slice(&state.moment);
            }
        }
    }
}

/// The internal force at the start of determinate spans: the sum of the dead forces beyond. Distributed
/// force is summed with the stepper's own weights, so that it is what the stepper would find.
pub(crate) fn known_forces(lowered: &Lowered, meshes: &[SpanMesh]) -> Vec<Vector3<f64>> {
    let of_span = |(span, mesh): (&Span, &SpanMesh)| {
        let mut sum = Vector3::zeros();
        if span.determinate {
            for j in &span.jumps {
                sum += j.load.dead.force;
            }
            for stretch in mesh.stretches() {
                sum += crate::accuracy::dead_force(&stretch.piece);
            }
        }
        sum
    };
    lowered.spans.iter().zip(meshes).map(of_span).collect()
}

fn copy(to: &mut [f64], at: usize, from: &[f64], start: usize, count: usize) {
    to[at..at + count].copy_from_slice(&from[start..start + count]);
}
