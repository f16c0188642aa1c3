//! What the law of a beam is like between two places: its extremes, which set rates, and how well one integration step there
//! takes it in.
//!
//! A law g enters the equations through its integrals. One step of order eight reads it at twelve places; two steps half as long
//! read it at others. The difference of both in ∫g ds and in its first moment is the error of the longer step, of whatever order
//! that is where g is not smooth. What both overlook is ruled out by interval arithmetic (`flexura_expression::Variation`).

use crate::beam::{BeamLaw, stage};
use crate::channel::TendonChannel;
use crate::course::Level;
use flexura_geometry::section_hidden;
use flexura_mechanics::ode::{NODES, STAGES, WEIGHTS};
use flexura_mechanics::rod::LoadSample;
use std::collections::BTreeMap;

/// Kinds of numbers of which a law consists.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Turn,
    Soft,
    Yield,
    Force,
    Moment,
    Push,
    Offset,
    Slope,
}

const KINDS: usize = 8;

/// The law between two places; nondimensional.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Look {
    /// Largest rest curvature.
    pub bend: f64,
    /// Largest compliance in bending and torsion.
    pub soft: f64,
    /// Largest compliance in stretching and shear.
    pub yields: f64,
    /// Largest stiffness of foundations at rest.
    pub push: f64,
    /// Errors of the integrals by one step: of the rest curvature (rad), of compliances, of loads and so on.
    defects: [f64; KINDS],
}

/// In units of what an error of a law is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measure {
    /// What force and moment count as one.
    pub wrench: [f64; 2],
    /// ∫ of the compliance in bending along the span.
    pub soft: f64,
    /// Length of the span.
    pub length: f64,
    /// Largest stiffness of foundations times the length.
    pub push: f64,
}

impl Look {
    /// The larger of both in everything.
    pub fn max(&self, other: &Self) -> Self {
        Self {
            bend: self.bend.max(other.bend),
            soft: self.soft.max(other.soft),
            yields: self.yields.max(other.yields),
            push: self.push.max(other.push),
            defects: std::array::from_fn(|i| self.defects[i].max(other.defects[i])),
        }
    }

    /// Error of the state by one step of this length, where the wrenches are those of `level`.
    pub fn error(&self, level: &Level, measure: &Measure) -> f64 {
        let of = |kind: Kind| self.defects[kind as usize];
        let part = |error: f64, whole: f64| if whole > 0.0 { error / whole } else { 0.0 };
        let bending = (level.moment + level.tendons).max(1.0 / measure.soft);
        of(Kind::Turn)
            + of(Kind::Soft) * bending
            + of(Kind::Yield) * level.force / measure.length
            + of(Kind::Force) / measure.wrench[0].max(level.force)
            + of(Kind::Moment) / measure.wrench[1].max(level.moment)
            + part(of(Kind::Push), measure.push)
            + of(Kind::Offset) * level.tendons * self.soft
            + of(Kind::Slope) / measure.length
    }
}

/// The numbers of a law at one place.
struct Reader<'a> {
    law: &'a BeamLaw,
    channels: Vec<&'a TendonChannel>,
    numbers: Vec<f64>,
    kinds: Vec<Kind>,
}

impl Reader<'_> {
    fn read(&mut self, s: f64, look: &mut Look) {
        self.numbers.clear();
        self.kinds.clear();
        let local = self.law.scaled_law(s);
        look.bend = look.bend.max(local.k0.norm());
        self.add(Kind::Turn, local.k0.as_slice());
        let c = &local.compliance;
        for i in 0..6 {
            let kind = if i < 3 { Kind::Yield } else { Kind::Soft };
            if i < 3 {
                look.yields = look.yields.max(c[(i, i)]);
            } else {
                look.soft = look.soft.max(c[(i, i)]);
            }
            let first = if self.law.is_coupled() { 0 } else { i };
            for j in first..=i {
                self.add(kind, &[c[(i, j)]]);
            }
        }
        if self.law.is_loaded() {
            let LoadSample { dead_force, dead_moment, section_force, section_moment } =
                self.law.scaled_load(s);
            self.add(Kind::Force, &dead_force);
            self.add(Kind::Force, &section_force);
            self.add(Kind::Moment, &dead_moment);
            self.add(Kind::Moment, &section_moment);
        }
        if !self.law.founded.is_empty() || self.law.spins() {
            let push = self.law.stiffness_at_rest(s) + self.law.outward_slope(s);
            look.push = look.push.max(push);
            self.add(Kind::Push, &[push]);
        }
        for i in 0..self.channels.len() {
            let place = self.channels[i].at(s);
            let reach = self.channels[i].reach * self.law.scale.length;
            self.add(Kind::Offset, &place.offset.map(|v| if reach > 0.0 { v / reach } else { 0.0 }));
            self.add(Kind::Slope, &place.slope);
        }
    }

    fn add(&mut self, kind: Kind, numbers: &[f64]) {
        self.numbers.extend_from_slice(numbers);
        self.kinds.resize(self.numbers.len(), kind);
    }

    /// ∫g ds and ∫g (2x - 1) ds of every number, x from 0 to 1 along the stretch, by `steps` steps.
    fn integrals(&mut self, [a, b]: [f64; 2], steps: usize, look: &mut Look) -> Vec<[f64; 2]> {
        let h = (b - a) / self.law.scale.length / steps as f64;
        let mut sums = Vec::new();
        for i in 0..steps * STAGES {
            self.read(stage(a, b, steps, i), look);
            sums.resize(self.numbers.len(), [0.0; 2]);
            let x = ((i / STAGES) as f64 + NODES[i % STAGES]) / steps as f64;
            let weight = h * WEIGHTS[i % STAGES];
            for (sum, g) in sums.iter_mut().zip(&self.numbers) {
                sum[0] += weight * g;
                sum[1] += weight * g * (2.0 * x - 1.0);
            }
        }
        sums
    }
}

impl BeamLaw {
    /// Looks at the law between two places, none of its breaks between them.
    fn look(&self, channels: &[TendonChannel], s: [f64; 2]) -> Look {
        let mut look = Look::default();
        let here: Vec<&TendonChannel> = channels.iter().filter(|channel| channel.holds(s)).collect();
        let mut reader = Reader { law: self, channels: here, numbers: Vec::new(), kinds: Vec::new() };
        let whole = reader.integrals(s, 1, &mut look);
        let halves = reader.integrals(s, 2, &mut look);
        for ((whole, halves), kind) in whole.iter().zip(&halves).zip(&reader.kinds) {
            let error = (whole[0] - halves[0]).abs() + (whole[1] - halves[1]).abs();
            let defect = &mut look.defects[*kind as usize];
            // Not `max`, which would hide what is no number.
            *defect = if *defect >= error { *defect } else { error };
        }
        self.add_hidden(&reader.channels, s, &mut look);
        look
    }

    /// Adds what may hide between the places that were looked at.
    fn add_hidden(&self, channels: &[&TendonChannel], [a, b]: [f64; 2], look: &mut Look) {
        let width = (b - a) / self.scale.length;
        let mut add = |kind: Kind, value: f64| look.defects[kind as usize] += value;
        add(Kind::Turn, self.shape.hidden_turn(a, b));
        // A compliance goes with at most the fourth power of a dimension.
        let part = 4.0 * section_hidden(self.section(), a, b, self.length);
        let [force, moment] = self.hidden_load(a, b);
        add(Kind::Force, force * width);
        add(Kind::Moment, moment * width);
        add(Kind::Push, self.hidden_stiffness(a, b) * width);
        for channel in channels {
            let [offset, slope] = channel.hidden([a, b]);
            add(Kind::Offset, offset * width);
            add(Kind::Slope, slope * width);
        }
        if part > 0.0 {
            look.defects[Kind::Soft as usize] += part * look.soft * width;
            look.defects[Kind::Yield as usize] += part * look.yields * width;
        }
    }

    /// The law where it is the same all along, but for where foundations begin and end.
    pub fn even_look(&self, s: [f64; 2]) -> Look {
        let push = self.foundation_stiffness(s);
        Look { bend: self.rest_rate(), soft: self.soft(), yields: self.yields(), push, defects: [0.0; KINDS] }
    }
}

/// What was seen of the law along one span, kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct Looks {
    seen: BTreeMap<[u64; 2], Look>,
}

impl Looks {
    /// The law between two places of a span.
    pub fn at(&mut self, law: &BeamLaw, channels: &[TendonChannel], s: [f64; 2]) -> Look {
        *self.seen.entry(s.map(f64::to_bits)).or_insert_with(|| law.look(channels, s))
    }

    /// Forgets everything, for the law has changed.
    pub fn clear(&mut self) {
        self.seen.clear();
    }
}
