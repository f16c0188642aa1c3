//! The state at rest, and the mesh and layout that follow from how hard the spans are loaded.

use crate::beam::{BeamLaw, graded};
use crate::course::{Course, Level, Mark};
use crate::extract::GAUSS;
use crate::layout::Layout;
use crate::lower::{Lowered, RopeLaw, Span};
use crate::mesh::{Cutter, SpanMesh, Stretch};
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

    /// Cuts every span into at least this many segments, whatever the loads; for benches and tests.
    pub fn force_segments(&mut self, count: Option<usize>) {
        self.forced_segments = count;
        self.rest();
    }

    /// Accuracy of the mesh while the load is raised, if better than what the solver would choose.
    pub fn refine_path(&mut self, accuracy: f64) {
        self.finest_path = accuracy;
    }

    /// Puts the mechanism at rest: unloaded, every body where the model puts it.
    pub fn rest(&mut self) {
        self.load = 0.0;
        self.counts = Counts::default();
        self.accuracy = self.path_accuracy().min(self.finest_path);
        let first_time = self.meshes.is_empty();
        let forced = self.forced_segments.unwrap_or(1);
        // Along a stiff foundation what a start changes grows even at rest.
        self.courses = vec![Course::default(); self.lowered.spans.len()];
        let counts: Vec<usize> = self
            .cutters()
            .map(|mut cutter| if cutter.span.undivided { 1 } else { cutter.segments().max(forced) })
            .collect();
        self.courses = self.lowered.spans.iter().map(|span| self.expected_course(span)).collect();
        self.expected.clone_from(&self.courses);
        self.given_force = self.sum_of_loads();
        // Where a law varies, segments ended where an earlier state had it.
        let even = |span: &Span| span.is_even(&self.lowered.beams[span.beam]);
        let fits =
            !first_time
                && counts.iter().zip(&self.meshes).zip(&self.lowered.spans).all(|((count, mesh), span)| {
                    *count == mesh.segments.len() && (*count == 1 || even(span))
                });
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
    fn expected_course(&self, span: &Span) -> Course {
        let mut level = Level::default();
        let law = &self.lowered.beams[span.beam];
        for j in &span.jumps {
            level.force += j.load.dead.force.norm() + j.load.follower.force.norm();
            level.moment = level.moment.max((j.load.dead.moment + j.load.follower.moment).norm());
        }
        if law.is_loaded() {
            level.force += self.distributed_force(span).last().map_or(0.0, |(_, sum)| *sum);
        }
        if law.spins() {
            let rest = span.s.map(|s| self.lowered.rest_pose(span.beam, s).position);
            let through = law.spin().map_or(Vector3::zeros(), |spin| spin.through / law.scale.length);
            let arm = rest.iter().map(|place| (place - through).norm()).fold(0.0, f64::max);
            let length = (span.s[1] - span.s[0]) / law.scale.length;
            level.force += law.outward_slope(0.5 * (span.s[0] + span.s[1])) * arm * length;
        }
        for channel in &span.channels {
            if let RopeLaw::Tension(tension) = self.lowered.ropes[span.tendons[channel.tendon]].law {
                level.tendons += tension * channel.reach;
            }
        }
        let mut marks = Vec::new();
        if span.determinate && !span.is_even(law) {
            // The force at a place is at most the sum of what acts beyond.
            let total = level.force;
            let before = |s: f64| {
                let jumps = span.jumps.iter().filter(|j| j.s < s);
                jumps.map(|j| j.load.dead.force.norm()).sum::<f64>()
            };
            let mark = |(s, sum): &(f64, f64)| Mark {
                s: *s,
                force: (total - sum - before(*s)).max(1e-12 * total),
                moment: level.moment,
            };
            marks = self.distributed_force(span).iter().map(mark).collect();
        }
        Course { most: level, marks }
    }

    /// Arc lengths (m), increasing, and the sum of the sizes of distributed forces up to there.
    fn distributed_force(&self, span: &Span) -> Vec<(f64, f64)> {
        let law = &self.lowered.beams[span.beam];
        if span.is_even(law) && law.breaks().is_empty() {
            let piece = law.piece(span.s[0], span.s[1], 1);
            let size = |q: &[f64; 3]| Vector3::from(*q).norm() * piece.length;
            let total = piece.loads.iter().map(|l| size(&l.dead_force) + size(&l.section_force));
            return vec![(span.s[0], 0.0), (span.s[1], total.fold(0.0, f64::max))];
        }
        let mut sum = 0.0;
        let mut sums = vec![(span.s[0], 0.0)];
        let places = span.inside(law);
        for pair in places.windows(2) {
            for [a, b] in graded(pair[0], pair[1], if places.len() > 12 { 2 } else { 20 }) {
                for (node, weight) in GAUSS {
                    let load = law.scaled_load(a + (b - a) * node);
                    let size = |q: &[f64; 3]| Vector3::from(*q).norm();
                    let density = size(&load.dead_force) + size(&load.section_force);
                    sum += weight * (b - a) / law.scale.length * density;
                }
                sums.push((b, sum));
            }
        }
        sums
    }

    /// What cuts each span.
    pub(crate) fn cutters(&mut self) -> impl Iterator<Item = Cutter<'_>> {
        let (lowered, accuracy) = (&self.lowered, self.accuracy);
        let spans = lowered.spans.iter().zip(&mut self.looks).zip(&self.courses);
        spans.map(move |((span, looks), course)| Cutter {
            law: &lowered.beams[span.beam],
            span,
            looks,
            course,
            accuracy,
        })
    }

    /// The same together with the meshes.
    fn meshed_cutters(&mut self) -> impl Iterator<Item = (Cutter<'_>, &mut SpanMesh)> {
        let (lowered, accuracy) = (&self.lowered, self.accuracy);
        let spans = lowered.spans.iter().zip(&mut self.looks).zip(&self.courses).zip(&mut self.meshes);
        spans.map(move |(((span, looks), course), mesh)| {
            (Cutter { law: &lowered.beams[span.beam], span, looks, course, accuracy }, mesh)
        })
    }

    pub(crate) fn remesh(&mut self, counts: &[usize]) {
        let accuracy = self.accuracy;
        self.effort.0 += self.total_steps() as f64 * REMESHED;
        self.meshes = self.cutters().zip(counts).map(|(mut cutter, count)| cutter.build(*count)).collect();
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
        self.meshed_cutters().for_each(|(mut cutter, mesh)| cutter.restep(mesh, grow));
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
            mesh.multiply(law, span, |_, present| {
                ((present as f64 * factor).ceil() as usize).max(present + 1)
            });
        }
        self.multiply_tube_steps(factor);
        self.sum_known_forces();
    }

    pub(crate) fn multiply_tube_steps(&mut self, factor: f64) {
        for steps in self.tube_steps.iter_mut().flatten() {
            *steps = ((*steps as f64 * factor).ceil() as usize).max(*steps + 1);
        }
    }

    pub(crate) fn total_steps(&self) -> usize {
        let tubes: usize = self.tube_steps.iter().flatten().sum();
        self.meshes.iter().map(SpanMesh::steps).sum::<usize>() + tubes
    }

    /// Sums the known forces anew, as the mesh or the loads have changed.
    pub(crate) fn sum_known_forces(&mut self) {
        self.known_force = known_forces(&self.lowered, &self.meshes);
    }

    /// The state at the start of a segment, behind what jumps there.
    pub(crate) fn segment_start(&self, span: usize, segment: usize) -> Plain {
        if segment > 0 {
            return self.inner_state(self.layout.spans[span].inner[segment - 1].state);
        }
        let mut head = self.head_state(span);
        for &j in &self.meshes[span].first_jumps {
            jump(&self.lowered.spans[span].jumps[j], self.load, &mut head);
        }
        head
    }

    /// The state at arc length `s` of a span, starting from the segment that holds it.
    pub(crate) fn state_at(&self, span: usize, s: f64) -> Plain {
        let mesh = &self.meshes[span];
        let segment = (0..mesh.segments.len()).rev().find(|&k| mesh.start_of(k) <= s).unwrap_or(0);
        let jumps = &self.lowered.spans[span].jumps;
        let mut state = self.segment_start(span, segment);
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
    fn wanted_segments(&mut self) -> Vec<usize> {
        self.meshed_cutters()
            .map(|(mut cutter, mesh)| {
                let (wanted, present) = (cutter.segments(), mesh.segments.len());
                // A little more than needed, so that a growing force does not cut again at every step.
                if wanted > present { (wanted * 3).div_ceil(2) } else { present }
            })
            .collect()
    }

    /// Have forces grown so that the spans should be cut into more segments, which changes the layout of the state?
    pub fn wants_segments(&mut self) -> bool {
        self.wanted_segments().iter().zip(&self.meshes).any(|(c, m)| *c != m.segments.len())
    }

    /// Have forces grown so that the mesh should have more steps?
    pub fn wants_steps(&mut self) -> bool {
        self.meshed_cutters().any(|(mut cutter, mesh)| cutter.wants_steps(mesh))
    }

    /// ∫√(F/EI) ds along a span under a fraction of the load.
    pub(crate) fn span_phase(&self, index: usize, load: f64) -> f64 {
        let (span, expected, course) =
            (&self.lowered.spans[index], &self.expected[index], &self.courses[index]);
        let law = &self.lowered.beams[span.beam];
        let now = |force: f64| if self.load > 1e-3 { force / self.load } else { 0.0 };
        let part = |s: [f64; 2], force: f64, soft: f64| {
            (force * load * soft).sqrt() * ((s[1] - s[0]) / law.scale.length)
        };
        if span.is_even(law) {
            return part(span.s, expected.most.force.max(now(course.most.force)), law.soft());
        }
        let each = self.meshes[index].stretches().map(|stretch| {
            let force = expected.over(stretch.s).force.max(now(course.over(stretch.s).force));
            part(stretch.s, force, stretch.look.soft)
        });
        each.sum()
    }

    /// ∫M/EI ds along a span under the full load, as far as it is expected.
    pub(crate) fn span_turning(&self, index: usize) -> f64 {
        let (span, expected) = (&self.lowered.spans[index], &self.expected[index]);
        let law = &self.lowered.beams[span.beam];
        let part = |s: [f64; 2], level: &Level, soft: f64| {
            (level.moment + level.tendons) * soft * ((s[1] - s[0]) / law.scale.length)
        };
        if span.is_even(law) {
            return part(span.s, &expected.most, law.soft());
        }
        let each = self.meshes[index].stretches();
        each.map(|stretch| part(stretch.s, &expected.over(stretch.s), stretch.look.soft)).sum()
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
