//! How finely a span is integrated and into how many shooting segments it is cut.
//!
//! Step length: one step of order eight turns a section by at most an angle that the wanted accuracy allows.
//! Segments: what starts a segment grows along it by at most about `exp(GROWTH)`, so that no information is
//! lost on the way; a short or softly loaded beam is one segment.

use crate::beam::BeamLaw;
use crate::lower::Span;
use flexura_mechanics::rod::{Channel, Piece};

/// A smooth stretch, then the jumps at its end (positions in the span's list).
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    pub s: [f64; 2],
    pub piece: Piece,
    /// Channels of tendons along it.
    pub channels: Vec<Channel>,
    pub jumps: Vec<usize>,
}

/// The mesh of one span.
#[derive(Clone, Debug)]
pub(crate) struct SpanMesh {
    /// Jumps at the very start.
    pub first_jumps: Vec<usize>,
    pub segments: Vec<Vec<Stretch>>,
}

/// The largest force and moment met along a span, nondimensional: what sets rates.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Level {
    pub force: f64,
    pub moment: f64,
    /// Σ T d of the tendons: the moment by which they bend the beam itself, beside that of the whole section.
    pub tendons: f64,
    /// Stiffness of foundations whose law is not linear, at the displacements met.
    pub foundation: f64,
}

/// Exponent by which a segment may let its start grow.
const GROWTH: f64 = 8.0;
/// Error of one radian of turning in unit steps: with it, `error = CONSTANT * turning * step^8`.
const CONSTANT: f64 = 3e-9;
/// Most steps of a stretch; a load that wants more is a mistake, or beyond double precision.
const MOST_STEPS: usize = 100_000;
/// A step never turns a section further than this, however loose the accuracy.
const LARGEST_TURN: f64 = 2.2;
/// Segments of a span on a foundation that is not linear: their ends show how stiff it has become.
const SAMPLED: usize = 8;

impl Level {
    /// Turning per nondimensional length at this level: bending by the moment, and the rate √(F/EI) of the
    /// exponentials and sines along a loaded beam. On a foundation of stiffness k those of EI d⁴y/ds⁴ = -k y and of
    /// EA d²u/ds² = k u join them, with the rates (k/EI)^¼ and √(k/EA).
    fn rate(&self, law: &BeamLaw, span: &Span, s: [f64; 2]) -> f64 {
        let soft = law.soft();
        let winding = span.channels.iter().filter(|c| c.holds(s)).map(|c| c.rate).fold(0.0, f64::max);
        let bend = law.rest_rate(s[0], s[1]) + (self.moment + self.tendons) * soft + winding;
        let push = law.foundation_stiffness(s) + self.foundation;
        (bend * bend + self.force * soft + (push * soft).sqrt() + push * law.yields()).sqrt()
    }

    pub fn segments(&self, law: &BeamLaw, span: &Span) -> usize {
        if span.undivided {
            return 1;
        }
        let length = (span.s[1] - span.s[0]) / law.scale.length;
        let push = law.foundation_stiffness(span.s) + self.foundation;
        let bending = (self.force * law.soft()).sqrt() + (0.25 * push * law.soft()).powf(0.25);
        let exponent = length * bending.max((push * law.yields()).sqrt());
        let least = if law.founded.is_nonlinear() { SAMPLED } else { 1 };
        ((exponent / GROWTH).ceil() as usize).clamp(least, 100_000)
    }

    /// Steps for a stretch to have an error of about `accuracy`.
    pub fn steps(&self, law: &BeamLaw, span: &Span, s: [f64; 2], accuracy: f64) -> usize {
        let turning = (s[1] - s[0]) / law.scale.length * self.rate(law, span, s);
        let turn = (accuracy / (CONSTANT * turning.max(1.0))).powf(0.125).min(LARGEST_TURN);
        ((turning / turn).ceil() as usize).clamp(1, MOST_STEPS)
    }
}

impl Stretch {
    pub fn new(law: &BeamLaw, span: &Span, s: [f64; 2], steps: usize, jumps: Vec<usize>) -> Self {
        let channels =
            span.channels.iter().filter(|c| c.holds(s)).map(|c| c.samples(law, s, steps)).collect();
        Self { s, piece: law.piece(s[0], s[1], steps), channels, jumps }
    }
}

impl SpanMesh {
    /// Cuts a span into `count` segments, each stretch into `steps(ends)` steps.
    pub fn build(law: &BeamLaw, span: &Span, count: usize, steps: impl Fn([f64; 2]) -> usize) -> Self {
        let [first, last] = span.s;
        let tiny = 1e-12 * law.length;
        let near = |a: f64, b: f64| (a - b).abs() <= tiny;
        let ends: Vec<f64> = (1..=count)
            .map(|i| if i == count { last } else { first + (last - first) * i as f64 / count as f64 })
            .collect();
        let mut cuts: Vec<f64> = law.breaks();
        cuts.extend(span.jumps.iter().map(|j| j.s));
        cuts.extend(span.channels.iter().flat_map(|c| c.breaks()));
        cuts.extend(&ends);
        cuts.retain(|s| *s > first + tiny && *s <= last + tiny);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| near(*a, *b));
        let jumps_at =
            |s: f64| -> Vec<usize> { (0..span.jumps.len()).filter(|&j| near(span.jumps[j].s, s)).collect() };
        let mut segments = vec![Vec::new()];
        let mut a = first;
        for b in cuts {
            let s = [a, b];
            let stretch = Stretch::new(law, span, s, steps(s), jumps_at(b));
            if let Some(segment) = segments.last_mut() {
                segment.push(stretch);
            }
            if ends.iter().any(|e| near(*e, b)) && !near(b, last) {
                segments.push(Vec::new());
            }
            a = b;
        }
        Self { first_jumps: jumps_at(first), segments }
    }

    pub fn stretches(&self) -> impl Iterator<Item = &Stretch> {
        self.segments.iter().flatten()
    }

    pub fn steps(&self) -> usize {
        self.stretches().map(|s| s.piece.steps).sum()
    }

    /// Gives every stretch `steps(ends, present)` steps.
    pub fn restep(&mut self, law: &BeamLaw, span: &Span, steps: impl Fn([f64; 2], usize) -> usize) {
        for stretch in self.segments.iter_mut().flatten() {
            let wanted = steps(stretch.s, stretch.piece.steps);
            if wanted != stretch.piece.steps {
                let jumps = std::mem::take(&mut stretch.jumps);
                *stretch = Stretch::new(law, span, stretch.s, wanted, jumps);
            }
        }
    }

    /// Where segment `i` starts, m.
    pub fn start_of(&self, i: usize) -> f64 {
        self.segments[i][0].s[0]
    }
}
