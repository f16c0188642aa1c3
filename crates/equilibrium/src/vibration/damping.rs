//! What resists the rates of motions: beams within themselves, dampers on coordinates and springs, and everything by its momentum.

use super::Vibration;
use super::cut::Elements;
use crate::assembly::Sink;
use crate::layout::CoordinateSlot;
use crate::springs::Course;
use crate::stability::Motions;
use crate::system::Equilibrium;
use flexura_mechanics::spring::{Spring, TensionLaw};
use flexura_nonlinear::{BlockPlace, Matrix};
use flexura_spatial::Vector6;

impl Equilibrium {
    /// Time of a beam's own damping, s.
    pub(super) fn damping_of(&self, beam: usize) -> f64 {
        self.model.beams.get(beam).map_or(0.0, |beam| beam.damping)
    }

    /// Does anything resist the rates of motions?
    pub fn is_damped(&self) -> bool {
        let coordinates = self.model.joints.iter().map(|joint| &joint.law).chain(
            self.model.beams.iter().flat_map(|beam| beam.start.iter().chain(&beam.end).map(|end| &end.hold)),
        );
        self.model.mass_damping != 0.0
            || self.model.beams.iter().any(|beam| beam.damping != 0.0)
            || self.model.springs.iter().any(|spring| spring.damping != 0.0)
            || coordinates.flat_map(|law| &law.coordinates).any(|law| law.damping != 0.0)
    }

    /// Fills [`Vibration::damping`]; inertia stands already.
    pub(super) fn add_damping(&self, spans: &[Elements], vibration: &mut Vibration) {
        if !self.is_damped() {
            return;
        }
        let rate = vibration.unit.sqrt();
        let mut entries = Vec::new();
        let held = self.model.mass_damping / rate;
        if held != 0.0 {
            entries.extend(vibration.inertia.iter().map(|(i, j, value)| (*i, *j, held * value)));
        }
        let columns = &vibration.columns;
        let mut add = |i: usize, j: usize, value: f64| {
            if let (true, Some(i), Some(j)) = (value != 0.0, columns[i], columns[j]) {
                entries.push((i, j, value));
            }
        };
        for (span, own) in spans.iter().enumerate() {
            let time = self.damping_of(self.lowered.spans[span].beam) * rate;
            if time > 0.0 {
                self.damp_beam(span, own, &mut |i, j, value| add(i, j, time * value));
            }
        }
        let ends = self.lowered.spans.iter().zip(&self.layout.spans).flat_map(|(span, slots)| {
            let end = span.end.as_ref().map(|hold| (&hold.coordinates, &slots.end));
            [Some((&span.start.coordinates, &slots.start)), end].into_iter().flatten()
        });
        let joints = self.lowered.joints.iter().zip(&self.layout.joints);
        let joints = joints.map(|(joint, slots)| (&joint.coordinates, &slots.coordinates));
        for (coordinates, slot) in ends.chain(joints) {
            self.damp_coordinates(coordinates, slot, &mut |i, j, value| add(i, j, rate * value));
        }
        self.damp_springs(&mut |i, j, value| add(i, j, rate * value));
        vibration.damping = entries;
    }

    fn damp_beam(&self, span: usize, own: &Elements, add: &mut dyn FnMut(usize, usize, f64)) {
        let order = own.rule.order;
        for (e, element) in own.list.iter().enumerate() {
            let Some(local) = &element.viscous else { continue };
            let nodes: Vec<Motions> = (0..=order).map(|node| self.node_motions(span, own, e, node)).collect();
            let inner = |i: usize, j: usize, x: &Vector6<f64>, y: &Vector6<f64>| {
                x.dot(&(local.fixed_view::<6, 6>(6 * i, 6 * j) * y))
            };
            for (j, columns) in nodes.iter().enumerate() {
                for (column, y) in columns {
                    for (i, rows) in nodes.iter().enumerate() {
                        for (row, x) in rows {
                            add(*row, *column, inner(i, j, x, y));
                        }
                    }
                    for k in 0..own.kept * order {
                        let row = local.view((6 * (order + 1) + k, 6 * j), (1, 6));
                        add(own.wrenches(e) + k, *column, (row * y)[0]);
                    }
                }
            }
        }
    }

    fn damp_coordinates(
        &self,
        coordinates: &crate::coordinates::Coordinates,
        slot: &CoordinateSlot,
        add: &mut dyn FnMut(usize, usize, f64),
    ) {
        if !coordinates.is_damped() {
            return;
        }
        let drag = coordinates.drag(&self.configuration(slot));
        for (i, row) in drag.iter().enumerate().take(slot.count) {
            for (j, value) in row.iter().enumerate().take(slot.count) {
                add(slot.unknown + i, slot.unknown + j, *value);
            }
        }
    }

    /// A damper along a spring's course is a spring without tension whose tension grows with the rate of its length.
    fn damp_springs(&self, add: &mut dyn FnMut(usize, usize, f64)) {
        let total = self.layout.interface;
        let mut plain = Matrix::default();
        plain.arrange(total, &[BlockPlace { first: 0, count: total, place: [0.0; 3] }]);
        let scale = self.lowered.scale;
        for (index, link) in self.lowered.springs.iter().enumerate() {
            let damping = self.model.springs.get(index).map_or(0.0, |spring| spring.damping);
            let Ok(Course { ends, length, around }) = self.spring_course(index) else { continue };
            if damping == 0.0 || self.spring_law(index).is_slack(length) {
                continue;
            }
            let stiffness = damping * scale.length / scale.force;
            let law = TensionLaw::Linear { stiffness, tension_only: false };
            let damper = Spring { law, rest_length: length, is_loose: false };
            plain.reset();
            let mut r = vec![0.0; total];
            let mut sink = Sink { r: &mut r, matrix: Some(&mut plain) };
            match (&around, &link.wrap) {
                (Some(around), Some(wrap)) => {
                    self.pull_around(link, wrap, &damper, &ends, around, &mut sink);
                }
                _ => {
                    if let Some(force) = damper.between(&ends[0], &ends[1]) {
                        self.pull(&link.ends, &ends, &force, &mut sink);
                    }
                }
            }
            // Forces by motions are what the damper takes back.
            plain.for_each(|i, j, value| add(i, j, -value));
        }
    }
}
