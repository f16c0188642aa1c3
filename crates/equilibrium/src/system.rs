//! The prepared problem, and what `nonlinear` needs to solve it.

use crate::coordinates::Coordinates;
use crate::course::Course;
use crate::error::ProblemError;
use crate::layout::{CoordinateSlot, Layout, PoseSlot};
use crate::look::Looks;
use crate::lower::{self, Lowered};
use crate::mesh::SpanMesh;
use crate::shooting::{Plain, SegmentEnd};
use flexura_mechanics::joint::Configuration;
use flexura_model::{BeamPoint, JointKind, LoadId, LoadTarget, Model};
use flexura_nonlinear::{BLOCK, Breakdown, Chain, Interrupt, Lift, Matrix, System};
use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, exp, log};

/// A model made ready to be solved, again and again, from rest or from where it stands.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    pub(crate) model: Model,
    /// Places on beams that have a node because their motion is asked for.
    pub(crate) probes: Vec<BeamPoint>,
    /// Places on beams that are sampled besides those that outputs ask for.
    pub(crate) watched: Vec<BeamPoint>,
    pub(crate) lowered: Lowered,
    pub(crate) meshes: Vec<SpanMesh>,
    pub(crate) layout: Layout,
    pub(crate) x: Vec<f64>,
    pub(crate) load: f64,
    /// Accuracy that the mesh is made for.
    pub(crate) accuracy: f64,
    /// Internal force at the start of each determinate span at full load.
    pub(crate) known_force: Vec<Vector3<f64>>,
    pub(crate) tangent: Matrix,
    pub(crate) chains: Vec<Chain>,
    /// Is the tangent factorised, in the present layout?
    pub(crate) factorised: bool,
    /// An entry that is lifted in tangents, and by how much it was in the last one.
    pub(crate) lift: Option<Lift>,
    pub(crate) lifted_by: f64,
    /// The second variation.
    pub(crate) second: crate::stability::Second,
    /// An earlier tangent, factorised.
    kept: (Matrix, Vec<Chain>),
    pub(crate) gaps: Vec<Vec<[f64; BLOCK]>>,
    /// Residual of the interface equations.
    pub(crate) r: Vec<f64>,
    /// Ends of all segments of all spans, at the last evaluation.
    pub(crate) ends: Vec<Vec<SegmentEnd>>,
    /// How hard the spans are loaded now, and what is to be expected at the full load.
    pub(crate) courses: Vec<Course>,
    pub(crate) expected: Vec<Course>,
    /// The sum of all loads, in EI/L² of the softest beam: what forces may be expected to be.
    pub(crate) given_force: f64,
    /// What was seen of the laws of the spans.
    pub(crate) looks: Vec<Looks>,
    pub(crate) weights: Vec<f64>,
    scratch: Vec<f64>,
    /// The step by which the state was last moved.
    pub(crate) last_step: Vec<f64>,
    /// Steps of every stretch of concentric tubes, and their tips at the last evaluation.
    pub(crate) tube_steps: Vec<Vec<usize>>,
    pub(crate) tips: Vec<crate::tubes::Tip>,
    /// For each joint the closure rows without which its loop closes already; empty where every row is needed.
    pub(crate) slack: Vec<[bool; 6]>,
    /// The warning about loops that are held more often than they need, and what holds them.
    pub(crate) redundancy: Option<String>,
    pub(crate) held_twice: Vec<String>,
    /// Wrenches on the nodes besides the loads, in proportion to these, and how much of them acts: (moment, force) of each node.
    pub(crate) kick: (Vec<[Vector3<f64>; 2]>, f64),
    /// Poses of the nodes that a drag holds on to, and how strongly.
    pub(crate) drag: (Vec<Pose>, f64),
    /// Configurations that the drag also holds on to, one for each joint and hold; empty where it does not.
    pub(crate) held_back: Vec<Configuration>,
    /// Compliance in stretching that all beams have besides their own.
    pub(crate) softening: f64,
    /// Work done since a limit was set, and that limit.
    pub(crate) effort: (f64, f64),
    pub(crate) forced_segments: Option<usize>,
    pub(crate) finest_path: f64,
    pub(crate) counts: Counts,
    interrupt: Interrupt,
}

/// Work done since the state was last put at rest; counts, so that they repeat exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
    /// Second variations whose negative directions were counted.
    pub inertias: usize,
}

impl Equilibrium {
    /// Prepares a model. The state is the mechanism at rest, unloaded.
    ///
    /// # Errors
    /// A beam that is held nowhere, a rest shape or section without sound numbers.
    pub fn new(model: &Model) -> Result<Self, ProblemError> {
        Self::with_probes(model, &[])
    }

    /// The same, with nodes at further places on beams, so that their compliance can be asked for.
    ///
    /// # Errors
    /// As [`Equilibrium::new`].
    pub fn with_probes(model: &Model, further: &[BeamPoint]) -> Result<Self, ProblemError> {
        let mut probes = crate::neighbour::probes(model);
        probes.extend(further);
        let mut lowered = lower::lower(model, &probes, None)?;
        lowered.warnings = flexura_solution::summed_up(std::mem::take(&mut lowered.warnings));
        let mut this = Self {
            model: model.clone(),
            probes,
            watched: Vec::new(),
            meshes: Vec::new(),
            layout: Layout::default(),
            x: Vec::new(),
            load: 0.0,
            accuracy: 1.0,
            known_force: Vec::new(),
            tangent: Matrix::default(),
            chains: Vec::new(),
            factorised: false,
            lift: None,
            lifted_by: 0.0,
            second: crate::stability::Second::default(),
            kept: (Matrix::default(), Vec::new()),
            gaps: Vec::new(),
            r: Vec::new(),
            ends: Vec::new(),
            courses: Vec::new(),
            expected: Vec::new(),
            given_force: 0.0,
            looks: vec![Looks::default(); lowered.spans.len()],
            weights: Vec::new(),
            scratch: Vec::new(),
            last_step: Vec::new(),
            tube_steps: Vec::new(),
            tips: Vec::new(),
            slack: Vec::new(),
            redundancy: None,
            held_twice: Vec::new(),
            kick: (Vec::new(), 0.0),
            drag: (Vec::new(), 0.0),
            held_back: Vec::new(),
            softening: 0.0,
            effort: (0.0, f64::INFINITY),
            forced_segments: None,
            finest_path: f64::INFINITY,
            counts: Counts::default(),
            interrupt: Interrupt::default(),
            lowered,
        };
        this.rest();
        Ok(this)
    }

    /// Ends every study of it as soon as this flag is raised.
    pub fn heed(&mut self, interrupt: &Interrupt) {
        self.interrupt = interrupt.clone();
    }

    /// The model that it was made from.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Work done since the state was last put at rest.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Goes on counting from these.
    pub fn set_counts(&mut self, counts: Counts) {
        self.counts = counts;
    }

    /// Places on beams that are samples of every solution from now on, besides those that outputs ask for.
    pub fn watch(&mut self, places: Vec<BeamPoint>) {
        self.watched = places;
    }

    /// Length (m) and force (N) that count as one.
    pub fn units(&self) -> (f64, f64) {
        (self.lowered.scale.length, self.lowered.scale.force)
    }

    /// Warnings about the model.
    pub fn warnings(&self) -> &[String] {
        &self.lowered.warnings
    }

    /// Changes a point load. The state stays, so that a solve can start from it.
    pub fn set_point_load(&mut self, id: LoadId, force: Vector3<f64>, moment: Vector3<f64>) {
        self.put_point_load(id, force, moment);
        self.sum_known_forces();
    }

    /// The same without the sums that follow from it.
    pub(crate) fn put_point_load(&mut self, id: LoadId, force: Vector3<f64>, moment: Vector3<f64>) {
        let load = &mut self.model[id];
        load.force = force;
        load.moment = moment;
        let scaled = lower::point_load(&self.lowered.scale, force, moment, load.frame);
        if let LoadTarget::Body { .. } = load.target {
            for node in &mut self.lowered.nodes {
                for (_, load, _) in node.loads.iter_mut().filter(|l| l.2 == Some(id.0)) {
                    *load = scaled;
                }
            }
        } else {
            for span in &mut self.lowered.spans {
                for j in span.jumps.iter_mut().filter(|j| j.source == Some(id.0)) {
                    j.load = scaled;
                }
            }
            for node in &mut self.lowered.nodes {
                for (_, load, _) in node.loads.iter_mut().filter(|l| l.2 == Some(id.0)) {
                    *load = scaled;
                }
            }
        }
    }

    /// Changes what drives or loads a joint's coordinate; whether it is driven stays as it is. A driven coordinate moves there
    /// when the load fraction is set next.
    pub fn set_coordinate_law(&mut self, joint: usize, coordinate: usize, law: flexura_model::CoordinateLaw) {
        self.model.joints[joint].law.coordinates[coordinate] = law;
        let scale = self.lowered.scale;
        self.lowered.joints[joint].coordinates.set_law(coordinate, &law, &scale);
    }

    /// The values that parameters have now; nothing else changes.
    pub fn set_parameter_values(&mut self, values: &[f64]) {
        self.model.parameters.iter_mut().zip(values).for_each(|(parameter, value)| parameter.value = *value);
    }

    /// What counts as a change of 1: L for positions, 1 for turnings, EI/L² and EI/L for wrenches. For the
    /// final accuracy (`relative`) a beam's wrenches count against the largest that it carries, if that is more:
    /// beyond EI/L² their digits are limited by round-off, not by the method.
    pub(crate) fn set_weights(&mut self, relative: bool) {
        self.weights.clear();
        self.weights.resize(self.layout.unknowns, 1.0);
        for ((span, slots), course) in self.lowered.spans.iter().zip(&self.layout.spans).zip(&self.courses) {
            let (law, level) = (&self.lowered.beams[span.beam], &course.most);
            let [mut force, mut moment] = law.wrench_unit;
            if relative {
                force = force.max(level.force);
                moment = moment.max(level.moment).max(level.force * law.length / law.scale.length);
            }
            let shorter = law.scale.length / law.length;
            let w = &slots.wrench;
            for i in 0..w.count {
                let is_force = i + 6 - w.count < 3;
                self.weights[w.unknown + i] = if is_force { 1.0 / force } else { 1.0 / moment };
            }
            for inner in &slots.inner {
                for i in 0..3 {
                    self.weights[inner.unknown + 3 + i] = shorter;
                    self.weights[inner.unknown + 6 + i] = 1.0 / force;
                    self.weights[inner.unknown + 9 + i] = 1.0 / moment;
                }
            }
        }
        let largest = self.courses.iter().map(|c| c.most.force.max(c.most.tendons)).fold(1.0, f64::max);
        if relative {
            for slots in &self.layout.joints {
                let at = slots.wrench.unknown;
                self.weights[at..at + 6].fill(1.0 / largest);
            }
            for slot in self.layout.gears.iter().chain(self.layout.ropes.iter().flatten()) {
                self.weights[slot.unknown] = 1.0 / largest;
            }
        }
    }

    /// Size of a correction that round-off alone may cause.
    pub(crate) fn floor(&self) -> f64 {
        4e-14
    }

    pub(crate) fn node_pose(&self, node: Option<usize>) -> Pose {
        node.map_or(Pose::identity(), |n| read_pose(&self.x, self.layout.nodes[n].state))
    }

    pub(crate) fn configuration(&self, slot: &CoordinateSlot) -> Configuration {
        std::array::from_fn(|i| self.x[slot.state + i])
    }

    pub(crate) fn triple(&self, at: usize) -> Vector3<f64> {
        Vector3::new(self.x[at], self.x[at + 1], self.x[at + 2])
    }

    pub(crate) fn inner_state(&self, at: usize) -> Plain {
        Plain {
            rotation: std::array::from_fn(|i| self.x[at + i]),
            position: std::array::from_fn(|i| self.x[at + 4 + i]),
            force: std::array::from_fn(|i| self.x[at + 7 + i]),
            moment: std::array::from_fn(|i| self.x[at + 10 + i]),
            d: [[0.0; 1]; 12],
        }
    }

    /// The Newton step that a factorised tangent gives for the last residual.
    fn step_with(&mut self, tangent: &mut Matrix, chains: &mut [Chain], step: &mut [f64]) {
        self.counts.newton_steps += 1;
        let n = self.layout.interface;
        let mut rhs = std::mem::take(&mut self.scratch);
        rhs.clear();
        rhs.extend(self.r.iter().map(|r| -r));
        for (i, chain) in chains.iter_mut().enumerate() {
            if let Some(last) = self.layout.spans[i].inner.last() {
                let known = chain.reduce(&self.gaps[i]);
                rhs[last.unknown..last.unknown + BLOCK].copy_from_slice(&known);
            }
        }
        tangent.solve(&mut rhs);
        step[..n].copy_from_slice(&rhs);
        self.scratch = rhs;
        for (i, chain) in chains.iter().enumerate() {
            let inner = &self.layout.spans[i].inner;
            if inner.len() < 2 {
                continue;
            }
            let mut head = [0.0; crate::shooting::MAX_COLUMNS];
            let count = self.head_unknowns(i, |k, unknown| head[k] = step[unknown]);
            let last: [f64; BLOCK] = std::array::from_fn(|k| step[inner[inner.len() - 1].unknown + k]);
            let mut states = vec![[0.0; BLOCK]; inner.len() - 1];
            chain.back_substitute(&head[..count], &last, &mut states);
            for (slot, state) in inner.iter().zip(&states) {
                step[slot.unknown..slot.unknown + BLOCK].copy_from_slice(state);
            }
        }
    }

    /// Every joint and hold with where its configuration lies.
    pub(crate) fn coordinate_slots(&self) -> impl Iterator<Item = (&Coordinates, &CoordinateSlot)> {
        let holds = self.lowered.spans.iter().zip(&self.layout.spans).flat_map(|(span, slots)| {
            let end = span.end.as_ref().map(|end| (&end.coordinates, &slots.end));
            std::iter::once((&span.start.coordinates, &slots.start)).chain(end)
        });
        let joints = self
            .lowered
            .joints
            .iter()
            .zip(&self.layout.joints)
            .map(|(joint, slots)| (&joint.coordinates, &slots.coordinates));
        holds.chain(joints)
    }

    /// Runs of the state that are a pose (7 -> 6 unknowns): nodes and inner states.
    fn pose_slots(&self) -> impl Iterator<Item = PoseSlot> {
        let inner = self
            .layout
            .spans
            .iter()
            .flat_map(|s| s.inner.iter().map(|i| PoseSlot { state: i.state, unknown: i.unknown }));
        self.layout.nodes.iter().copied().chain(inner)
    }

    /// Runs of the state that are plain numbers: (state, unknown, count).
    pub(crate) fn number_slots(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let wrenches = self
            .layout
            .spans
            .iter()
            .map(|s| s.wrench)
            .chain(self.layout.joints.iter().map(|j| j.wrench))
            .map(|w| (w.state + 6 - w.count, w.unknown, w.count));
        let inner =
            self.layout.spans.iter().flat_map(|s| s.inner.iter().map(|i| (i.state + 7, i.unknown + 6, 6)));
        let numbers = self.layout.gears.iter().chain(self.layout.ropes.iter().flatten());
        let nests = self.layout.nests.iter().map(|slot| (slot.state, slot.unknown, slot.count));
        wrenches.chain(inner).chain(numbers.map(|slot| (slot.state, slot.unknown, 1))).chain(nests)
    }
}

pub(crate) fn read_pose(x: &[f64], at: usize) -> Pose {
    Pose::new(
        UnitQuaternion::from_quaternion(Quaternion::new(x[at], x[at + 1], x[at + 2], x[at + 3])),
        Vector3::new(x[at + 4], x[at + 5], x[at + 6]),
    )
}

pub(crate) fn write_pose(x: &mut [f64], at: usize, pose: &Pose) {
    let q = pose.rotation.quaternion();
    x[at..at + 4].copy_from_slice(&[q.w, q.i, q.j, q.k]);
    x[at + 4..at + 7].copy_from_slice(pose.position.as_slice());
}

impl System for Equilibrium {
    fn unknowns(&self) -> usize {
        self.layout.unknowns
    }

    fn set_load(&mut self, fraction: f64) {
        self.load = fraction;
        let driven: Vec<(usize, Configuration)> = self
            .coordinate_slots()
            .filter(|(c, slot)| c.joint.freedoms() > slot.count)
            .map(|(c, slot)| (slot.state, c.driven(&self.configuration(slot), fraction)))
            .collect();
        for (at, configuration) in driven {
            self.x[at..at + configuration.len()].copy_from_slice(&configuration);
        }
    }

    fn residual(&mut self) -> Result<(), Breakdown> {
        self.counts.residuals += 1;
        self.evaluate(false)
    }

    fn is_exhausted(&self) -> bool {
        self.effort.0 > self.effort.1
    }

    fn linearise(&mut self) -> Result<(), Breakdown> {
        if self.is_interrupted() {
            return Err(Breakdown::Interrupted);
        }
        self.counts.factorisations += 1;
        self.effort.0 += self.cost_of_factorising();
        self.factorised = false;
        self.evaluate(true)?;
        self.lifted_by = 0.0;
        if let Some(Lift { row, column }) = self.lift {
            // A row that stands alone may hold nothing else than what vanishes; one is the size of a nondimensional entry.
            let mut largest = 1.0_f64;
            self.tangent.for_each(|i, j, value| {
                if i == row || j == column {
                    largest = largest.max(value.abs());
                }
            });
            self.lifted_by = largest;
            self.tangent.add(row, column, largest);
        }
        self.tangent.factorise()?;
        self.factorised = true;
        Ok(())
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }

    fn has_tangent(&self) -> bool {
        self.factorised
    }

    fn orientation(&self) -> bool {
        self.chains.iter().fold(self.tangent.is_positive(), |sign, chain| {
            if chain.eliminated() > 0 { sign == chain.is_positive() } else { sign }
        })
    }

    fn newton_step(&mut self, step: &mut [f64]) {
        let (mut tangent, mut chains) = (std::mem::take(&mut self.tangent), std::mem::take(&mut self.chains));
        self.step_with(&mut tangent, &mut chains, step);
        (self.tangent, self.chains) = (tangent, chains);
    }

    fn keep_tangent(&mut self) {
        self.kept.0.clone_from(&self.tangent);
        self.kept.1.clone_from(&self.chains);
    }

    fn kept_step(&mut self, step: &mut [f64]) {
        let (mut tangent, mut chains) = std::mem::take(&mut self.kept);
        self.step_with(&mut tangent, &mut chains, step);
        self.kept = (tangent, chains);
    }

    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.weights).map(|((a, b), w)| a * b * w * w).sum()
    }

    fn retract(&mut self, step: &[f64]) {
        self.last_step.clear();
        self.last_step.extend_from_slice(step);
        let mut x = std::mem::take(&mut self.x);
        for slot in self.pose_slots() {
            let pose = read_pose(&x, slot.state);
            let d = |i: usize| step[slot.unknown + i];
            let moved = Pose::new(
                exp(&Vector3::new(d(0), d(1), d(2))) * pose.rotation,
                pose.position + Vector3::new(d(3), d(4), d(5)),
            );
            // Products drift from length one by round-off.
            let unit = UnitQuaternion::new_normalize(*moved.rotation.quaternion());
            write_pose(&mut x, slot.state, &Pose::new(unit, moved.position));
        }
        for (coordinates, slot) in self.coordinate_slots() {
            if slot.count > 0 {
                let from: Configuration = std::array::from_fn(|i| x[slot.state + i]);
                let to = coordinates.moved(&from, &step[slot.unknown..slot.unknown + slot.count]);
                x[slot.state..slot.state + to.len()].copy_from_slice(&to);
            }
        }
        for (state, unknown, count) in self.number_slots() {
            for i in 0..count {
                x[state + i] += step[unknown + i];
            }
        }
        self.x = x;
    }

    fn size(&self, step: &[f64]) -> f64 {
        let mut largest = 0.0_f64;
        for (s, w) in step.iter().zip(&self.weights) {
            let size = s.abs() * w;
            // `max` would hide a NaN.
            if size > largest || size.is_nan() {
                largest = size;
            }
        }
        largest
    }

    fn turning(&self, step: &[f64]) -> f64 {
        let mut largest = 0.0_f64;
        for slot in self.pose_slots() {
            let turn = Vector3::new(step[slot.unknown], step[slot.unknown + 1], step[slot.unknown + 2]);
            largest = largest.max(turn.norm());
        }
        for (coordinates, slot) in self.coordinate_slots() {
            if coordinates.kind == JointKind::Contact && slot.count >= 3 {
                // Of a contact the first three are.
                let turn: f64 = step[slot.unknown..slot.unknown + 3].iter().map(|s| s * s).sum();
                largest = largest.max(turn.sqrt());
            }
            // Of a ball and of a free joint the last three coordinates are a turning.
            if matches!(coordinates.kind, JointKind::Spherical | JointKind::Free) && slot.count > 0 {
                let last = slot.unknown + slot.count;
                let turn: f64 =
                    step[slot.unknown.max(last.saturating_sub(3))..last].iter().map(|s| s * s).sum();
                largest = largest.max(turn.sqrt());
            }
        }
        largest
    }

    fn store(&self, state: &mut Vec<f64>) {
        state.clear();
        state.extend_from_slice(&self.x);
    }

    fn restore(&mut self, state: &[f64]) {
        self.x.copy_from_slice(state);
    }

    fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) {
        for slot in self.pose_slots() {
            let (a, b) = (read_pose(from, slot.state), read_pose(to, slot.state));
            let turn = log(&(b.rotation * a.rotation.inverse()));
            let shift = b.position - a.position;
            for i in 0..3 {
                step[slot.unknown + i] = turn[i];
                step[slot.unknown + 3 + i] = shift[i];
            }
        }
        for (coordinates, slot) in self.coordinate_slots() {
            if slot.count > 0 {
                let a: Configuration = std::array::from_fn(|i| from[slot.state + i]);
                let b: Configuration = std::array::from_fn(|i| to[slot.state + i]);
                coordinates.step(&a, &b, &mut step[slot.unknown..slot.unknown + slot.count]);
            }
        }
        for (state, unknown, count) in self.number_slots() {
            for i in 0..count {
                step[unknown + i] = to[state + i] - from[state + i];
            }
        }
    }

    fn expect(&mut self, response: &[f64]) {
        for (i, slots) in self.layout.spans.iter().enumerate() {
            if slots.wrench.count == 6 {
                let at = slots.wrench.unknown;
                let force = Vector3::new(response[at], response[at + 1], response[at + 2]).norm();
                self.expected[i].raise(force);
            }
        }
    }

    /// ∫√(F/EI) ds along the span where that is largest: the shooting tangent of a loaded straight rod goes like its
    /// cosine. The force is taken to grow with the load from what it is now, or from what is expected.
    fn phase(&self, load: f64) -> f64 {
        (0..self.lowered.spans.len()).map(|span| self.span_phase(span, load)).fold(0.0, f64::max)
    }

    fn renew(&mut self) -> bool {
        let changed = self.resegment();
        self.restep(self.accuracy, true);
        changed
    }
}
