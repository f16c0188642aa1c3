//! Which numbers of the state and which unknowns belong to what.
//!
//! The unknowns come in two parts: first those of the interface (nodes, start wrenches and coordinates, the
//! last inner state of each span, joints), then the inner states that block elimination removes. Equations
//! use the same numbering: a node's balance stands at its pose, a span's closure at its start wrench, a
//! coordinate's effort balance at the coordinate, a joint's closure at its wrench, a coupling's relation at its multiplier, a
//! cable's length at its tension.

use crate::coordinates::Coordinates;
use crate::lower::{Lowered, RopeLaw};
use crate::mesh::SpanMesh;
use flexura_nonlinear::BlockPlace;
use flexura_spatial::Vector3;

/// Where a pose lies: seven numbers of the state, six unknowns (turning, shift).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSlot {
    pub state: usize,
    pub unknown: usize,
}

/// Where joint coordinates lie: seven numbers of the state, `count` unknowns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoordinateSlot {
    pub state: usize,
    pub unknown: usize,
    pub count: usize,
}

/// Where a wrench lies: six numbers (force, moment) of the state; unknown are the last `count` of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WrenchSlot {
    pub state: usize,
    pub unknown: usize,
    pub count: usize,
}

/// A state inside a span: pose and wrench, thirteen numbers of the state, twelve unknowns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InnerSlot {
    pub state: usize,
    pub unknown: usize,
}

#[derive(Clone, Debug)]
pub(crate) struct SpanSlots {
    pub start: CoordinateSlot,
    pub wrench: WrenchSlot,
    pub end: CoordinateSlot,
    /// One for each segment but the first; the last of them belongs to the interface.
    pub inner: Vec<InnerSlot>,
}

#[derive(Clone, Debug)]
pub(crate) struct JointSlots {
    pub coordinates: CoordinateSlot,
    pub wrench: WrenchSlot,
}

/// Where a single number lies: the multiplier of a coupling, the tension of a cable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NumberSlot {
    pub state: usize,
    pub unknown: usize,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    pub nodes: Vec<PoseSlot>,
    pub spans: Vec<SpanSlots>,
    pub joints: Vec<JointSlots>,
    pub gears: Vec<NumberSlot>,
    /// None where the tension is given.
    pub ropes: Vec<Option<NumberSlot>>,
    /// Of concentric tubes: the moment where they leave their guide, then the torques of all but the first.
    pub nests: Vec<WrenchSlot>,
    /// Unknowns of the interface.
    pub interface: usize,
    /// All unknowns.
    pub unknowns: usize,
    /// Numbers of the state.
    pub state: usize,
}

struct Counter {
    state: usize,
    unknown: usize,
}

impl Counter {
    fn take(&mut self, state: usize, unknowns: usize) -> (usize, usize) {
        let at = (self.state, self.unknown);
        self.state += state;
        self.unknown += unknowns;
        at
    }

    fn pose(&mut self) -> PoseSlot {
        let (state, unknown) = self.take(7, 6);
        PoseSlot { state, unknown }
    }

    fn coordinates(&mut self, coordinates: &Coordinates) -> CoordinateSlot {
        let count = coordinates.unknowns();
        let (state, unknown) = self.take(7, count);
        CoordinateSlot { state, unknown, count }
    }

    fn wrench(&mut self, count: usize) -> WrenchSlot {
        let (state, unknown) = self.take(6, count);
        WrenchSlot { state, unknown, count }
    }

    fn number(&mut self) -> NumberSlot {
        let (state, unknown) = self.take(1, 1);
        NumberSlot { state, unknown }
    }

    fn inner(&mut self) -> InnerSlot {
        let (state, unknown) = self.take(13, 12);
        InnerSlot { state, unknown }
    }
}

impl Layout {
    /// The unknowns of the interface in blocks, with where they lie in the undeformed mechanism: what the sparse
    /// factorisation orders its elimination by.
    pub fn blocks(&self, lowered: &Lowered) -> Vec<BlockPlace> {
        let mut blocks = Vec::new();
        let mut add = |first: usize, end: usize, place: Vector3<f64>| {
            blocks.push(BlockPlace { first, count: end - first, place: place.into() });
        };
        for (node, slot) in lowered.nodes.iter().zip(&self.nodes) {
            add(slot.unknown, slot.unknown + 6, node.initial.position);
        }
        for (span, slots) in lowered.spans.iter().zip(&self.spans) {
            let ends = span.s.map(|s| lowered.rest_pose(span.beam, s).position);
            // Coordinates, wrench, coordinates and the last inner state follow each other.
            let last = slots.inner.last().filter(|inner| inner.unknown < self.interface);
            let end = last.map_or(slots.end.unknown + slots.end.count, |inner| inner.unknown + 12);
            add(slots.start.unknown, end, (ends[0] + ends[1]) * 0.5);
        }
        for (joint, slots) in lowered.joints.iter().zip(&self.joints) {
            let place = lowered.carrier_pose(&joint.parent).position;
            add(slots.coordinates.unknown, slots.wrench.unknown + 6, place);
        }
        let numbers = self.gears.iter().chain(self.ropes.iter().flatten());
        for slot in numbers {
            add(slot.unknown, slot.unknown + 1, Vector3::zeros());
        }
        for (nest, slot) in lowered.nests.iter().zip(&self.nests) {
            add(slot.unknown, slot.unknown + slot.count, lowered.carrier_pose(&nest.base).position);
        }
        blocks
    }

    pub fn new(lowered: &Lowered, meshes: &[SpanMesh]) -> Self {
        let mut counter = Counter { state: 0, unknown: 0 };
        let nodes = lowered.nodes.iter().map(|_| counter.pose()).collect();
        let mut spans: Vec<SpanSlots> = Vec::with_capacity(lowered.spans.len());
        for (span, mesh) in lowered.spans.iter().zip(meshes) {
            let start = counter.coordinates(&span.start.coordinates);
            let wrench = counter.wrench(if span.determinate { 3 } else { 6 });
            let end = match &span.end {
                Some(hold) => counter.coordinates(&hold.coordinates),
                None => CoordinateSlot { state: counter.state, unknown: counter.unknown, count: 0 },
            };
            let last = if mesh.segments.len() > 1 { vec![counter.inner()] } else { Vec::new() };
            spans.push(SpanSlots { start, wrench, end, inner: last });
        }
        let joints = lowered
            .joints
            .iter()
            .map(|joint| JointSlots {
                coordinates: counter.coordinates(&joint.coordinates),
                wrench: counter.wrench(6),
            })
            .collect();
        let gears = lowered.gears.iter().map(|_| counter.number()).collect();
        let ropes = lowered
            .ropes
            .iter()
            .map(|rope| matches!(rope.law, RopeLaw::Length(_)).then(|| counter.number()))
            .collect();
        let nests = lowered
            .nests
            .iter()
            .map(|nest| {
                let count = 3 + nest.others();
                let (state, unknown) = counter.take(count, count);
                WrenchSlot { state, unknown, count }
            })
            .collect();
        let interface = counter.unknown;
        for (slots, mesh) in spans.iter_mut().zip(meshes) {
            let eliminated = mesh.segments.len().saturating_sub(2);
            let mut inner: Vec<InnerSlot> = (0..eliminated).map(|_| counter.inner()).collect();
            inner.append(&mut slots.inner);
            slots.inner = inner;
        }
        Self {
            nodes,
            spans,
            joints,
            gears,
            ropes,
            nests,
            interface,
            unknowns: counter.unknown,
            state: counter.state,
        }
    }
}
