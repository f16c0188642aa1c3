//! The second variation as one symmetric matrix, and its count of negative eigenvalues.

use super::mesh::Cut;
use crate::assembly::Sink;
use crate::held::{Held, HoldRef};
use crate::layout::{CoordinateSlot, SpanSlots};
use crate::lower::{Hold, Span};
use crate::shooting::{SegmentEnd, wrench_of};
use crate::system::Equilibrium;
use flexura_nonlinear::{BlockPlace, Breakdown, Matrix, Symmetric};
use flexura_spatial::{Twist, Vector3, Wrench};
use nalgebra::Vector6;

type V = Vector3<f64>;
pub(crate) type Motions = Vec<(usize, Vector6<f64>)>;

/// A row or column of the plain tangents in the symmetric matrix: its number and sign there; none where it has no part in it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Target {
    pub at: Option<usize>,
    pub flipped: bool,
}

/// What a stretch costs, in integration steps of one state.
const STRETCH: f64 = 40.0;

/// The second variation, kept from one use to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Second {
    /// How many stretches each span is cut into.
    shape: Vec<usize>,
    /// What the plain tangents give.
    plain: Matrix,
    r: Vec<f64>,
    pub(super) symmetric: Symmetric,
}

/// Numbers of what a span adds: the poses between its stretches, and that of a free end.
pub(super) struct Numbers {
    first: usize,
    stretches: usize,
    free: bool,
}

impl Numbers {
    /// The pose behind stretch `k`; none behind the last where the end is held.
    pub fn pose(&self, k: usize) -> Option<usize> {
        (k + 1 < self.stretches || self.free).then_some(self.first + 6 * k)
    }

    /// The pose before stretch `k`; none before the first, whose start is held.
    pub fn pose_before(&self, k: usize) -> Option<usize> {
        k.checked_sub(1).and_then(|k| self.pose(k))
    }

    /// Its unknowns in the plain tangents: the first, and how many.
    pub fn slots(&self) -> [usize; 2] {
        [self.first, self.count()]
    }

    pub fn count(&self) -> usize {
        6 * self.stretches - if self.free { 0 } else { 6 }
    }
}

pub(crate) fn vector(angular: V, linear: V) -> Vector6<f64> {
    Vector6::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

/// A change of (moment, force) as a wrench.
fn wrench(v: &Vector6<f64>) -> Wrench {
    Wrench::new(V::new(v[3], v[4], v[5]), V::new(v[0], v[1], v[2]))
}

fn identity(at: usize) -> Motions {
    (0..6).map(|i| (at + i, Vector6::ith(i, 1.0))).collect()
}

impl Equilibrium {
    /// Negative directions of the second variation under the constraints.
    pub(super) fn unstable_directions(&mut self) -> Result<usize, Breakdown> {
        let (multipliers, ..) = self.second_variation(1, None)?;
        let inertia = self.second.symmetric.factorise()?;
        if inertia.zero > 0 {
            return Err(Breakdown::Singular);
        }
        inertia.negative.checked_sub(multipliers).ok_or(Breakdown::Singular)
    }

    /// Assembles the second variation, every smooth stretch of a beam cut into `parts` at least. Returns how many of its
    /// unknowns are multipliers, and what it was made of.
    pub(super) fn second_variation(
        &mut self,
        parts: usize,
        kept: Option<&[Vec<[V; 2]>]>,
    ) -> Result<(usize, Vec<Cut>, Vec<Numbers>), Breakdown> {
        let mut end = SegmentEnd::new();
        let mut cuts = Vec::with_capacity(self.lowered.spans.len());
        for span in 0..self.lowered.spans.len() {
            cuts.push(self.short_stretches(span, parts, kept.map(|kept| &kept[span][..]), &mut end)?);
        }
        let mut total = self.layout.interface;
        let mut numbers = Vec::with_capacity(cuts.len());
        for (cut, span) in cuts.iter().zip(&self.lowered.spans) {
            let own = Numbers { first: total, stretches: cut.forms.len(), free: span.end.is_none() };
            total += own.count();
            numbers.push(own);
        }
        let own: Vec<[usize; 2]> = numbers.iter().map(Numbers::slots).collect();
        let (rows, columns, size, multipliers) = self.targets(&own, total);
        let shape: Vec<usize> = cuts.iter().map(|cut| cut.forms.len()).collect();
        self.effort.0 += STRETCH * shape.iter().sum::<usize>() as f64 + self.cost_of_factorising();
        let mut second = std::mem::take(&mut self.second);
        if second.shape != shape || second.plain.size() != total {
            let one = BlockPlace { first: 0, count: total, place: [0.0; 3] };
            second.plain.arrange(total, &[one]);
            second.symmetric.arrange(size, &self.block_places(&numbers, &columns));
            second.shape = shape;
        }
        second.plain.reset();
        second.symmetric.reset();
        second.r.resize(total, 0.0);
        let mut sink = Sink { r: &mut second.r, matrix: Some(&mut second.plain) };
        for joint in 0..self.lowered.joints.len() {
            self.evaluate_joint(joint, &mut sink);
        }
        self.evaluate_gears(&mut sink);
        self.evaluate_node_loads(&mut sink);
        self.evaluate_springs(&mut sink);
        self.evaluate_ropes(&mut sink);
        for ((span, cut), own) in cuts.iter().enumerate().zip(&numbers) {
            self.add_span(span, cut, own, &mut sink);
        }
        let symmetric = &mut second.symmetric;
        second.plain.for_each(|i, j, value| {
            let (row, column) = (rows[i], columns[j]);
            if let (Some(i), Some(j)) = (row.at, column.at) {
                // Rows are minus the energy's derivatives, but for those that are marked.
                symmetric.add(i, j, if row.flipped { value } else { -value });
            }
        });
        self.second = second;
        Ok((multipliers, cuts, numbers))
    }

    /// Where rows and columns of the plain tangents stand in the symmetric matrix, its size, and how many of its unknowns are
    /// multipliers. Of each span's own unknowns `own` has the first and their number.
    pub(crate) fn targets(
        &self,
        own: &[[usize; 2]],
        total: usize,
    ) -> (Vec<Target>, Vec<Target>, usize, usize) {
        let mut columns = vec![Target::default(); total];
        let mut flipped = vec![false; total];
        let mut size = 0;
        let mut take = |columns: &mut Vec<Target>, first: usize, count: usize| {
            for target in &mut columns[first..first + count] {
                target.at = Some(size);
                size += 1;
            }
        };
        let mut multipliers = 0;
        for slot in &self.layout.nodes {
            take(&mut columns, slot.unknown, 6);
        }
        for slots in &self.layout.spans {
            for slot in [&slots.start, &slots.end] {
                take(&mut columns, slot.unknown, slot.count);
                flipped[slot.unknown..slot.unknown + slot.count].fill(true);
            }
        }
        for (i, slots) in self.layout.joints.iter().enumerate() {
            let slot = &slots.coordinates;
            take(&mut columns, slot.unknown, slot.count);
            flipped[slot.unknown..slot.unknown + slot.count].fill(true);
            for component in 0..6 {
                // A closure row that others repeat is left out together with the component that would keep it.
                let row = (component + 3) % 6;
                if !self.slack.get(i).is_some_and(|slack| slack[row]) {
                    take(&mut columns, slots.wrench.unknown + component, 1);
                    multipliers += 1;
                }
            }
        }
        for slot in &self.layout.gears {
            take(&mut columns, slot.unknown, 1);
            multipliers += 1;
        }
        for slot in self.layout.ropes.iter().flatten() {
            take(&mut columns, slot.unknown, 1);
            flipped[slot.unknown] = true;
            multipliers += 1;
        }
        for [first, count] in own {
            take(&mut columns, *first, *count);
        }
        let mut rows: Vec<Target> =
            columns.iter().zip(&flipped).map(|(c, flipped)| Target { at: c.at, flipped: *flipped }).collect();
        for slots in &self.layout.joints {
            // Closure rows are turning, then shift; the wrench is force, then moment.
            let at = slots.wrench.unknown;
            for row in 0..6 {
                rows[at + row] = columns[at + (row + 3) % 6];
            }
        }
        (rows, columns, size, multipliers)
    }

    /// Unknowns of the symmetric matrix in blocks with their places.
    fn block_places(&self, numbers: &[Numbers], columns: &[Target]) -> Vec<BlockPlace> {
        let mut blocks = Vec::new();
        let mut add = |range: std::ops::Range<usize>, place: [f64; 3]| {
            let taken: Vec<usize> = range.filter_map(|i| columns[i].at).collect();
            if let Some(first) = taken.iter().min() {
                blocks.push(BlockPlace { first: *first, count: taken.len(), place });
            }
        };
        for block in self.layout.blocks(&self.lowered) {
            // Start and end coordinates of a span do not follow each other; singles are blocks of their own.
            for i in block.first..block.first + block.count {
                add(i..i + 1, block.place);
            }
        }
        for (own, span) in numbers.iter().zip(&self.lowered.spans) {
            let ends = span.s.map(|s| self.lowered.rest_pose(span.beam, s).position);
            for k in 0..own.stretches {
                let t = (k + 1) as f64 / own.stretches as f64;
                if let Some(pose) = own.pose(k) {
                    add(pose..pose + 6, (ends[0] * (1.0 - t) + ends[1] * t).into());
                }
            }
        }
        blocks
    }

    fn add_span(&self, span: usize, cut: &Cut, own: &Numbers, sink: &mut Sink<'_>) {
        let slots = &self.layout.spans[span];
        let description = &self.lowered.spans[span];
        let start = self.held_by(&description.start, &slots.start);
        let end = description.end.as_ref().map(|hold| self.held_by(hold, &slots.end));
        let motions = |held: &Held, slot: &CoordinateSlot| {
            let mut list = Motions::new();
            self.target_columns(held, slot.unknown, |unknown, Twist { angular, linear }| {
                list.push((unknown, vector(angular, linear)));
            });
            list
        };
        for (k, form) in cut.forms.iter().enumerate() {
            let before = match own.pose_before(k) {
                Some(pose) => identity(pose),
                None => motions(&start, &slots.start),
            };
            let after = match (own.pose(k), &end) {
                (Some(pose), _) => identity(pose),
                (None, Some(end)) => motions(end, &slots.end),
                (None, None) => continue,
            };
            if k == 0 {
                self.pull_jumps(description, form.s[0], &before, slots, sink);
            }
            self.pull_jumps(description, form.s[1], &after, slots, sink);
            // Changes of minus the wrench at the start, and of that at the end.
            let at_start = |f: &mut dyn FnMut(usize, Vector6<f64>)| {
                before.iter().for_each(|(unknown, x)| f(*unknown, form.aa * x));
                after.iter().for_each(|(unknown, x)| f(*unknown, form.ba.tr_mul(x)));
            };
            let at_end = |f: &mut dyn FnMut(usize, Vector6<f64>)| {
                before.iter().for_each(|(unknown, x)| f(*unknown, form.ba * x));
                after.iter().for_each(|(unknown, x)| f(*unknown, form.bb * x));
            };
            match own.pose_before(k) {
                Some(pose) => at_start(&mut |unknown, change| add(sink, pose, unknown, &-change)),
                None => {
                    let derivative = |f: &mut dyn FnMut(usize, Wrench)| {
                        at_start(&mut |unknown, change| f(unknown, wrench(&change)))
                    };
                    let on_child = -wrench_of(&cut.start);
                    self.hold_rows(
                        &start,
                        &slots.start,
                        &description.start.coordinates,
                        &on_child,
                        &derivative,
                        sink,
                    );
                }
            }
            match (own.pose(k), &end, &description.end) {
                (Some(pose), _, _) => at_end(&mut |unknown, change| add(sink, pose, unknown, &-change)),
                (None, Some(held), Some(hold)) => {
                    let derivative = |f: &mut dyn FnMut(usize, Wrench)| {
                        at_end(&mut |unknown, change| f(unknown, wrench(&change)))
                    };
                    self.hold_rows(
                        held,
                        &slots.end,
                        &hold.coordinates,
                        &wrench_of(&cut.end),
                        &derivative,
                        sink,
                    );
                }
                _ => {}
            }
        }
    }

    /// Centrifugal force on masses at a place along a span, which grows with the motions of the place.
    fn pull_jumps(&self, span: &Span, s: f64, motions: &Motions, slots: &SpanSlots, sink: &mut Sink<'_>) {
        let near = 1e-9 * self.lowered.beams[span.beam].length;
        let here = span.jumps.iter().filter(|jump| (jump.s - s).abs() <= near);
        for outward in here.filter_map(|jump| jump.load.outward.as_ref()) {
            for (column, y) in motions {
                let change = outward.change(&V::new(y[3], y[4], y[5])) * self.load;
                for (row, x) in motions {
                    let within =
                        |slot: &CoordinateSlot| (slot.unknown..slot.unknown + slot.count).contains(row);
                    // Rows of coordinates are minus the effort that acts.
                    let sign = if within(&slots.start) || within(&slots.end) { -1.0 } else { 1.0 };
                    sink.add_number(*row, *column, sign * V::new(x[3], x[4], x[5]).dot(&change));
                }
            }
        }
    }

    pub(crate) fn held_by(&self, hold: &Hold, slot: &CoordinateSlot) -> Held {
        self.held(&hold.carrier, &HoldRef::of(hold), &self.configuration(slot))
    }
}

fn add(sink: &mut Sink<'_>, row: usize, column: usize, v: &Vector6<f64>) {
    for i in 0..6 {
        sink.add_number(row + i, column, v[i]);
    }
}
