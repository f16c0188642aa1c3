//! Everything that holds, and everything that is held, as one pencil.

use super::cut::Elements;
use super::mass::Lump;
use super::rule::Rule;
use super::{Detail, Vibration};
use crate::assembly::Sink;
use crate::held::Held;
use crate::layout::CoordinateSlot;
use crate::shooting::wrench_of;
use crate::stability::{Motions, vector};
use crate::system::Equilibrium;
use flexura_nonlinear::{BlockPlace, Breakdown, Matrix, System};
use flexura_spatial::{Twist, Vector3, Wrench};
use nalgebra::{DVector, Vector6};
use std::sync::Arc;

type V = Vector3<f64>;

/// A change of (moment, force) as a wrench.
fn wrench(v: &Vector6<f64>) -> Wrench {
    Wrench::new(V::new(v[3], v[4], v[5]), V::new(v[0], v[1], v[2]))
}

impl Equilibrium {
    /// Stiffness and inertia about the present state.
    ///
    /// # Errors
    /// A number overflows, or somebody asked for the end.
    pub fn vibration(&mut self, detail: &Detail) -> Result<Vibration, Breakdown> {
        if self.is_interrupted() {
            return Err(Breakdown::Interrupted);
        }
        // Levels of force, by which beams are cut, are those of the last evaluation.
        self.residual()?;
        let rule = Arc::new(Rule::new(detail.order.max(2)));
        let mut total = self.layout.interface;
        let mut spans = Vec::with_capacity(self.lowered.spans.len());
        for span in 0..self.lowered.spans.len() {
            let elements = self.elements(span, &rule, detail, total)?;
            total += elements.count();
            spans.push(elements);
        }
        let own: Vec<[usize; 2]> = spans.iter().map(|own| [own.first, own.count()]).collect();
        let (rows, columns, size, mut multipliers) = self.targets(&own, total);
        multipliers += spans.iter().map(Elements::multipliers).sum::<usize>();
        let mut plain = Matrix::default();
        plain.arrange(total, &[BlockPlace { first: 0, count: total, place: [0.0; 3] }]);
        plain.reset();
        let mut r = vec![0.0; total];
        let mut sink = Sink { r: &mut r, matrix: Some(&mut plain) };
        for joint in 0..self.lowered.joints.len() {
            self.evaluate_joint(joint, &mut sink);
        }
        self.evaluate_gears(&mut sink);
        self.evaluate_node_loads(&mut sink);
        self.evaluate_springs(&mut sink);
        self.evaluate_ropes(&mut sink);
        for (span, own) in spans.iter().enumerate() {
            self.add_elements(span, own, &mut sink);
        }
        let mut stiffness = Vec::new();
        plain.for_each(|i, j, value| {
            let (row, column) = (rows[i], columns[j]);
            if let (Some(i), Some(j)) = (row.at, column.at) {
                stiffness.push((i, j, if row.flipped { value } else { -value }));
            }
        });
        let columns: Vec<Option<usize>> = columns.iter().map(|column| column.at).collect();
        let blocks = self.places_of(&spans, &columns);
        let mut vibration = Vibration {
            size,
            multipliers,
            stiffness,
            inertia: Vec::new(),
            damping: Vec::new(),
            gyroscopic: Vec::new(),
            has_energy: self.without_energy().is_none(),
            rigid: std::array::from_fn(|_| vec![0.0; size]),
            whole: [0.0; 6],
            unit: self.square_unit(),
            mass: self.mass_unit(),
            length: self.lowered.scale.length,
            blocks,
            elements: spans.iter().map(|own| own.list.len()).sum(),
            columns,
            spans: Vec::new(),
            layout: self.layout.clone(),
        };
        let lumps = self.lumps(&spans);
        self.add_inertia(&lumps, &mut vibration);
        self.add_damping(&spans, &mut vibration);
        for (span, own) in spans.iter().enumerate() {
            self.add_threads(span, own, &mut vibration);
        }
        vibration.spans = spans;
        Ok(vibration)
    }

    /// The motions that move an end of a span, as unknowns with their six-vectors.
    pub(super) fn end_motions(&self, held: &Held, slot: &CoordinateSlot) -> Motions {
        let mut list = Motions::new();
        self.target_columns(held, slot.unknown, |unknown, Twist { angular, linear }| {
            list.push((unknown, vector(angular, linear)));
        });
        list
    }

    fn add_elements(&self, span: usize, own: &Elements, sink: &mut Sink<'_>) {
        let slots = &self.layout.spans[span];
        let description = &self.lowered.spans[span];
        let start = self.held_by(&description.start, &slots.start);
        let end = description.end.as_ref().map(|hold| self.held_by(hold, &slots.end));
        let order = own.rule.order;
        for (e, element) in own.list.iter().enumerate() {
            let a = &element.tangent;
            let mut columns: Vec<(usize, DVector<f64>)> = Vec::new();
            let mut rows: Vec<(usize, usize)> = Vec::new();
            for node in 0..=order {
                if let Some(unknown) = own.node(e, node) {
                    columns.extend((0..6).map(|i| (unknown + i, a.column(6 * node + i).into_owned())));
                    rows.extend((0..6).map(|i| (unknown + i, 6 * node + i)));
                    continue;
                }
                let motions = match (node, &end) {
                    (0, _) => self.end_motions(&start, &slots.start),
                    (_, Some(end)) => self.end_motions(end, &slots.end),
                    (_, None) => continue,
                };
                columns.extend(motions.iter().map(|(unknown, x)| (*unknown, a.columns(6 * node, 6) * x)));
            }
            let first = 6 * (order + 1);
            for k in 0..own.kept * order {
                let unknown = own.wrenches(e) + k;
                columns.push((unknown, a.column(first + k).into_owned()));
                rows.push((unknown, first + k));
            }
            for (unknown, column) in &columns {
                for (row, local) in &rows {
                    if column[*local] != 0.0 {
                        sink.add_number(*row, *unknown, -column[*local]);
                    }
                }
            }
            // Changes of minus the wrench at the start, and of that at the end.
            let at = |node: usize| {
                let columns = &columns;
                move |f: &mut dyn FnMut(usize, Wrench)| {
                    for (unknown, column) in columns {
                        let change: Vector6<f64> = column.fixed_rows::<6>(6 * node).into_owned();
                        if change != Vector6::zeros() {
                            f(*unknown, wrench(&change));
                        }
                    }
                }
            };
            if e == 0 {
                let on_child = -wrench_of(&own.ends[0]);
                let coordinates = &description.start.coordinates;
                self.hold_rows(&start, &slots.start, coordinates, &on_child, &at(0), sink);
            }
            if let (true, Some(held), Some(hold)) = (e + 1 == own.list.len(), &end, &description.end) {
                let wrench = wrench_of(&own.ends[1]);
                self.hold_rows(held, &slots.end, &hold.coordinates, &wrench, &at(order), sink);
            }
        }
    }

    /// Unknowns of the pencil in blocks with their places.
    fn places_of(&self, spans: &[Elements], columns: &[Option<usize>]) -> Vec<BlockPlace> {
        let mut blocks = Vec::new();
        let mut add = |range: std::ops::Range<usize>, place: [f64; 3]| {
            let taken = range.filter_map(|i| columns[i]);
            let (count, first) = taken.fold((0, usize::MAX), |(count, first), at| (count + 1, first.min(at)));
            if count > 0 {
                blocks.push(BlockPlace { first, count, place });
            }
        };
        for block in self.layout.blocks(&self.lowered) {
            // Start and end coordinates of a span do not follow each other; singles are blocks of their own.
            for i in block.first..block.first + block.count {
                add(i..i + 1, block.place);
            }
        }
        for own in spans {
            let order = own.rule.order;
            for (e, element) in own.list.iter().enumerate() {
                let inner = own.wrenches(e) - 6 * (order - 1);
                add(inner..own.wrenches(e) + own.kept * order, element.places[order / 2].into());
                if let Some(last) = own.node(e, order) {
                    add(last..last + 6, element.places[order].into());
                }
            }
        }
        blocks
    }

    /// What a spinning frame does to a lump: gyroscopic terms, and the slope of centrifugal force and moment.
    fn spin_lump(&self, lump: &Lump, motions: &[(usize, Vector6<f64>)], vibration: &mut Vibration) {
        let Some(spun) = self.spun() else { return };
        let rate = spun.rate / vibration.unit.sqrt();
        let gyroscopic = lump.gyroscopic(&spun.axis) * rate;
        let centrifugal = (!lump.on_node).then(|| lump.centrifugal(&spun.axis) * (rate * rate));
        for (j, b) in motions {
            let turned = gyroscopic * b;
            let pulled = centrifugal.map(|block| block * b);
            for (i, a) in motions {
                let value = a.dot(&turned);
                if value != 0.0 {
                    vibration.gyroscopic.push((*i, *j, value));
                }
                if let Some(value) = pulled.map(|pulled| a.dot(&pulled)).filter(|value| *value != 0.0) {
                    vibration.stiffness.push((*i, *j, value));
                }
            }
        }
    }

    fn add_inertia(&self, lumps: &[Lump], vibration: &mut Vibration) {
        let columns = std::mem::take(&mut vibration.columns);
        let (mass, mut center) = (lumps.iter().map(Lump::mass).sum::<f64>(), V::zeros());
        if mass > 0.0 {
            center = lumps.iter().map(Lump::moment).sum::<V>() / mass;
        }
        for lump in lumps {
            let motions: Vec<(usize, Vector6<f64>)> =
                lump.motions.iter().filter_map(|(i, x)| columns[*i].map(|at| (at, *x))).collect();
            let moved: Vec<Vector6<f64>> = motions.iter().map(|(_, x)| lump.block * x).collect();
            for (j, b) in motions.iter().zip(&moved) {
                for (i, a) in &motions {
                    let value = a.dot(b);
                    if value != 0.0 {
                        vibration.inertia.push((*i, j.0, value));
                    }
                }
            }
            if motions.is_empty() {
                continue;
            }
            self.spin_lump(lump, &motions, vibration);
            for axis in 0..6 {
                let motion = lump.as_a_whole(axis, &center);
                let carried = lump.block * motion;
                for (i, x) in &motions {
                    vibration.rigid[axis][*i] += x.dot(&carried);
                }
                let unit = vibration.mass * if axis < 3 { 1.0 } else { vibration.length * vibration.length };
                vibration.whole[axis] += unit * motion.dot(&carried);
            }
        }
        vibration.columns = columns;
    }
}
