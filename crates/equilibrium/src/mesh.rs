//! How finely a span is integrated and into how many shooting segments it is cut.
//!
//! Step length: one step of order eight turns a section by at most an angle that the wanted accuracy allows, and takes the law in
//! to that accuracy (`look.rs`); where it does not, the stretch is halved. Rates are local: those of the law and of the forces
//! there. Where everything is the same along a span it is one piece between jumps.
//! Segments: what starts a segment grows along it by at most about `exp(GROWTH)`, so that no information is
//! lost on the way; a short or softly loaded beam is one segment.

use crate::beam::BeamLaw;
use crate::course::{Course, Level};
use crate::look::{Look, Looks, Measure};
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
    /// What the law is like along it, of a stretch of a mesh.
    pub look: Look,
}

/// The mesh of one span.
#[derive(Clone, Debug)]
pub(crate) struct SpanMesh {
    /// Jumps at the very start.
    pub first_jumps: Vec<usize>,
    pub segments: Vec<Vec<Stretch>>,
    /// What it was made for.
    made_for: Course,
    /// What it is worth.
    pub cut: Cut,
}

/// What the cutting of a span came to.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cut {
    /// Error that the law's integrals are left with when all steps are halved.
    pub law_error: f64,
    /// Would it need more steps than are made?
    pub is_overfull: bool,
    /// Steps that it would need; as far as they were counted if it is overfull.
    pub wanted: usize,
}

/// Exponent by which a segment may let its start grow.
const GROWTH: f64 = 8.0;
/// Error of one radian of turning in unit steps: with it, `error = CONSTANT * turning * step^8`.
const CONSTANT: f64 = 3e-9;
/// Most steps of a span; a load that wants more is a mistake, or beyond double precision.
pub(crate) const MOST_STEPS: usize = 100_000;
/// Most stretches that an interval is cut into, before equal neighbours are joined.
const MOST_PARTS: usize = 10_000;
/// A step never turns a section further than this, however loose the accuracy.
const LARGEST_TURN: f64 = 2.2;
/// Segments of a span on a foundation that is not linear: their ends show how stiff it has become.
const SAMPLED: usize = 8;
/// Part of the accuracy that the law of one stretch may use up.
const SHARE: f64 = 0.03;
/// By how much halving the steps reduces the error at least (`accuracy.rs`). Where the law is not smooth it does not, so that
/// what is left of it then must be smaller by as much beforehand.
const GAIN: f64 = 32.0;
/// Part of what is allowed that may be left when all steps are halved: the errors of all stretches add up.
const LEFT: f64 = 0.1;
/// Stretches with more steps than this are halved, so that each part has the rates of its own.
const MOST_AT_ONCE: usize = 4;
/// Width, as a part of the length, of a stretch that is not halved any more.
const NARROWEST: f64 = 1e-11;

impl Level {
    /// Turning per nondimensional length at this level: bending by the moment, and the rate √(F/EI) of the
    /// exponentials and sines along a loaded beam. On a foundation of stiffness k those of EI d⁴y/ds⁴ = -k y and of
    /// EA d²u/ds² = k u join them, with the rates (k/EI)^¼ and √(k/EA).
    fn rate(&self, look: &Look, winding: f64) -> f64 {
        let bend = look.bend + (self.moment + self.tendons) * look.soft + winding;
        let push = look.push + self.foundation;
        (bend * bend + self.force * look.soft + (push * look.soft).sqrt() + push * look.yields).sqrt()
    }

    /// Exponent per nondimensional length by which what a start changes grows.
    fn growth(&self, look: &Look) -> f64 {
        let push = look.push + self.foundation;
        let bending = (self.force * look.soft).sqrt() + (0.25 * push * look.soft).powf(0.25);
        bending.max((push * look.yields).sqrt())
    }

    /// Steps for a stretch of this nondimensional length to have an error of about `accuracy`.
    pub fn steps(&self, look: &Look, winding: f64, length: f64, accuracy: f64) -> usize {
        let turning = length * self.rate(look, winding);
        let turn = (accuracy / (CONSTANT * turning.max(1.0))).powf(0.125).min(LARGEST_TURN);
        ((turning / turn).ceil() as usize).clamp(1, MOST_STEPS)
    }
}

/// A stretch to be made.
#[derive(Clone, Copy, Debug)]
struct Part {
    s: [f64; 2],
    steps: usize,
    look: Look,
}

/// A span that is to be cut: its law, what was seen of it, and the loads along it.
pub(crate) struct Cutter<'a> {
    pub law: &'a BeamLaw,
    pub span: &'a Span,
    pub looks: &'a mut Looks,
    pub course: &'a Course,
    pub accuracy: f64,
}

/// The parts of a span.
#[derive(Default)]
struct Plan {
    parts: Vec<Part>,
    cut: Cut,
}

impl Cutter<'_> {
    fn winding(&self, s: [f64; 2]) -> f64 {
        self.span.channels.iter().filter(|c| c.holds(s)).map(|c| c.rate).fold(0.0, f64::max)
    }

    fn nondimensional(&self, [a, b]: [f64; 2]) -> f64 {
        (b - a) / self.law.scale.length
    }

    fn look(&mut self, s: [f64; 2]) -> Look {
        if self.span.is_even(self.law) {
            self.law.even_look(s)
        } else {
            self.looks.at(self.law, &self.span.channels, s)
        }
    }

    /// What errors of the law are measured by.
    fn measure(&self) -> Measure {
        let law = self.law;
        let [force, moment] = law.wrench_unit;
        Measure {
            wrench: [force.max(self.course.most.force), moment.max(self.course.most.moment)],
            soft: law.soft_all_along(),
            length: self.nondimensional(self.span.s),
            push: law.foundation_stiffness(self.span.s) * self.nondimensional(self.span.s),
        }
    }

    /// Cuts the span, which has these places where something happens, its ends among them.
    fn plan(&mut self, places: &[f64]) -> Plan {
        let measure = self.measure();
        let mut plan = Plan::default();
        let mut steps = 0;
        for pair in places.windows(2) {
            let (s, known) = ([pair[0], pair[1]], plan.parts.len());
            // However many segments there are, the span has no more steps than are made, and one for each.
            let left = MOST_STEPS.saturating_sub(steps).max(1);
            if self.span.is_even(self.law) || left == 1 {
                let look = self.law.even_look(s);
                let level = self.course.over(s);
                let steps = level.steps(&look, self.winding(s), self.nondimensional(s), self.accuracy);
                plan.parts.push(Part { s, steps: steps.min(left), look });
            } else {
                self.halve(s, &measure, &mut plan);
            }
            steps += plan.parts[known..].iter().map(|part| part.steps).sum::<usize>();
        }
        plan.cut.is_overfull |= steps >= MOST_STEPS;
        plan.cut.wanted = steps;
        if plan.cut.is_overfull {
            // Nothing is worked out on it; it need not take memory.
            plan.parts.iter_mut().for_each(|part| part.steps = 1);
        }
        plan
    }

    /// Halves an interval until the steps on every part are good enough, and joins equal neighbours.
    fn halve(&mut self, whole: [f64; 2], measure: &Measure, plan: &mut Plan) {
        let first = plan.parts.len();
        let winding = self.winding(whole);
        let (mut open, mut made) = (vec![whole], 0);
        while let Some([a, b]) = open.pop() {
            if plan.cut.is_overfull {
                // What is left takes no more looks.
                let look = plan.parts.last().map_or_else(|| self.law.even_look(whole), |last| last.look);
                plan.parts.push(Part { s: [a, whole[1]], steps: 1, look });
                break;
            }
            let (s, middle) = ([a, b], 0.5 * (a + b));
            let look = self.look(s);
            let level = self.course.over(s);
            let steps = level.steps(&look, winding, self.nondimensional(s), self.accuracy);
            let narrow = b - a <= NARROWEST * self.law.length;
            let full = made + open.len() >= MOST_PARTS;
            plan.cut.is_overfull |= full || narrow && steps >= MOST_STEPS;
            if !(narrow || full) && (steps > MOST_AT_ONCE || !self.takes_in(s, &look, &level, measure, plan))
            {
                open.push([middle, b]);
                open.push([a, middle]);
                continue;
            }
            made += 1;
            let part = Part { s, steps, look };
            match plan.parts[first..].last_mut() {
                Some(last) if last.joins(&part) => last.join(&part),
                _ => plan.parts.push(part),
            }
        }
    }

    /// Does one step take the law in, and do two steps by as much better as they should?
    fn takes_in(
        &mut self,
        [a, b]: [f64; 2],
        look: &Look,
        level: &Level,
        measure: &Measure,
        plan: &mut Plan,
    ) -> bool {
        let allowed = SHARE * self.accuracy;
        let error = look.error(level, measure);
        if error > allowed {
            return false;
        }
        let middle = 0.5 * (a + b);
        let mut left = error;
        // A law without sound numbers is left to Newton, who refuses the state.
        if error > 1e-2 * LEFT * allowed / GAIN {
            left = 0.0;
            for half in [[a, middle], [middle, b]] {
                left += self.look(half).error(level, measure);
            }
        }
        if left > LEFT * allowed / GAIN {
            return false;
        }
        plan.cut.law_error += left;
        true
    }

    /// Exponents of growth from the start to the end of every part; the first is zero.
    fn growth(&mut self) -> Vec<(f64, f64)> {
        let places = self.places(&[]);
        let plan = self.plan(&places);
        let mut sum = 0.0;
        let mut grown = vec![(self.span.s[0], 0.0)];
        for part in &plan.parts {
            sum += self.nondimensional(part.s) * self.course.over(part.s).growth(&part.look);
            grown.push((part.s[1], sum));
        }
        grown
    }

    /// How many segments the span should have.
    pub fn segments(&mut self) -> usize {
        if self.span.undivided {
            return 1;
        }
        let exponent = if self.span.is_even(self.law) {
            let level = &self.course.most;
            self.nondimensional(self.span.s) * level.growth(&self.law.even_look(self.span.s))
        } else {
            self.growth().last().map_or(0.0, |(_, sum)| *sum)
        };
        let least = if self.law.founded.is_nonlinear() { SAMPLED } else { 1 };
        ((exponent / GROWTH).ceil() as usize).clamp(least, MOST_STEPS)
    }

    /// Where `count` segments end: along each of them a start grows by as much; at equal distances where all is even.
    fn ends(&mut self, count: usize) -> Vec<f64> {
        let [first, last] = self.span.s;
        let even =
            |i: usize| if i == count { last } else { first + (last - first) * i as f64 / count as f64 };
        if count == 1 || self.span.is_even(self.law) {
            return (1..=count).map(even).collect();
        }
        // A part of the growth goes with the length, so that a span without forces has segments, too.
        let mut grown = self.growth();
        let whole = grown.last().map_or(0.0, |(_, sum)| *sum).max(1e-300);
        for (s, sum) in &mut grown {
            *sum = 0.9 * *sum / whole + 0.1 * (*s - first) / (last - first);
        }
        let whole = grown.last().map_or(1.0, |(_, sum)| *sum);
        let at = |i: usize| {
            let wanted = whole * i as f64 / count as f64;
            let next = grown.partition_point(|(_, sum)| *sum < wanted).clamp(1, grown.len() - 1);
            let ((a, x), (b, y)) = (grown[next - 1], grown[next]);
            a + (b - a) * ((wanted - x) / (y - x)).clamp(0.0, 1.0)
        };
        (1..count).map(at).chain(std::iter::once(last)).collect()
    }

    /// The span's ends, segments' ends and all places where something is not smooth or jumps, in order.
    fn places(&self, ends: &[f64]) -> Vec<f64> {
        let [first, last] = self.span.s;
        let mut places = self.span.happenings(self.law);
        places.extend(ends);
        order(&mut places, self.span.s, self.law.length);
        places.insert(0, first);
        if let Some(end) = places.last_mut().filter(|s| (**s - last).abs() <= 1e-12 * self.law.length) {
            *end = last;
        }
        places
    }

    /// Cuts the span into `count` segments.
    pub fn build(&mut self, count: usize) -> SpanMesh {
        let ends = self.ends(count);
        self.build_between(&ends)
    }

    pub fn build_between(&mut self, ends: &[f64]) -> SpanMesh {
        let places = self.places(ends);
        let plan = self.plan(&places);
        let mut mesh = SpanMesh::assemble(self.law, self.span, ends, &plan.parts);
        mesh.made_for = self.course.clone();
        mesh.cut = plan.cut;
        mesh
    }

    /// Is the law even, and was it when the mesh was made? Then only the numbers of steps differ.
    fn fits(&self, plan: &Plan, mesh: &SpanMesh) -> bool {
        self.span.is_even(self.law) && plan.parts.len() == mesh.stretches().count()
    }

    /// Does the span need more steps than the mesh has?
    pub fn wants_steps(&mut self, mesh: &SpanMesh) -> bool {
        let places = self.places(&mesh.ends());
        let plan = self.plan(&places);
        if self.fits(&plan, mesh) {
            return plan.parts.iter().zip(mesh.stretches()).any(|(part, s)| part.steps > s.piece.steps);
        }
        plan.parts.iter().map(|part| part.steps).sum::<usize>() > mesh.steps()
    }

    /// Cuts the same segments anew; with `grow` nothing gets coarser.
    pub fn restep(&mut self, mesh: &mut SpanMesh, grow: bool) {
        let ends = mesh.ends();
        let even = self.span.is_even(self.law).then(|| self.plan(&self.places(&ends)));
        let Some(plan) = even.filter(|plan| self.fits(plan, mesh)) else {
            let larger = self.course.max(&mesh.made_for);
            let course = if grow { &larger } else { self.course };
            let mut cutter = Cutter { course, looks: &mut *self.looks, ..*self };
            *mesh = cutter.build_between(&ends);
            return;
        };
        mesh.cut = plan.cut;
        for (stretch, part) in mesh.segments.iter_mut().flatten().zip(&plan.parts) {
            let wanted = if grow { part.steps.max(stretch.piece.steps) } else { part.steps };
            stretch.restep(self.law, self.span, wanted);
        }
    }
}

/// Sorts places, keeps those in a span but for its start, and makes one of those that coincide.
pub(crate) fn order(places: &mut Vec<f64>, [first, last]: [f64; 2], length: f64) {
    let tiny = 1e-12 * length;
    places.push(last);
    places.retain(|s| *s > first + tiny && *s <= last + tiny);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| (*a - *b).abs() <= tiny);
}

impl Part {
    /// Do the steps of a part that follows go on in the same width?
    fn joins(&self, next: &Self) -> bool {
        let width = |part: &Self| (part.s[1] - part.s[0]) / part.steps as f64;
        (width(self) / width(next) - 1.0).abs() < 1e-9
    }

    fn join(&mut self, next: &Self) {
        self.s[1] = next.s[1];
        self.steps += next.steps;
        self.look = self.look.max(&next.look);
    }
}

impl Stretch {
    pub fn new(law: &BeamLaw, span: &Span, s: [f64; 2], steps: usize, jumps: Vec<usize>) -> Self {
        let channels =
            span.channels.iter().filter(|c| c.holds(s)).map(|c| c.samples(law, s, steps)).collect();
        Self { s, piece: law.piece(s[0], s[1], steps), channels, jumps, look: Look::default() }
    }

    /// The same in another number of steps.
    fn restep(&mut self, law: &BeamLaw, span: &Span, steps: usize) {
        if steps != self.piece.steps {
            let (jumps, look) = (std::mem::take(&mut self.jumps), self.look);
            *self = Self { look, ..Self::new(law, span, self.s, steps, jumps) };
        }
    }
}

impl SpanMesh {
    /// The mesh of given parts, in order, which fall into segments that end at `ends`.
    fn assemble(law: &BeamLaw, span: &Span, ends: &[f64], parts: &[Part]) -> Self {
        let [first, last] = span.s;
        let tiny = 1e-12 * law.length;
        let near = |a: f64, b: f64| (a - b).abs() <= tiny;
        let jumps_at =
            |s: f64| -> Vec<usize> { (0..span.jumps.len()).filter(|&j| near(span.jumps[j].s, s)).collect() };
        let mut segments = vec![Vec::new()];
        for part in parts {
            let end = part.s[1];
            let mut stretch = Stretch::new(law, span, part.s, part.steps, Vec::new());
            stretch.look = part.look;
            stretch.jumps = jumps_at(end);
            if let Some(segment) = segments.last_mut() {
                segment.push(stretch);
            }
            if ends.iter().any(|e| near(*e, end)) && !near(end, last) {
                segments.push(Vec::new());
            }
        }
        let first_jumps = jumps_at(first);
        Self { first_jumps, segments, made_for: Course::default(), cut: Cut::default() }
    }

    /// The same mesh for the law of a neighbouring model: what lies between two places where something happens goes along with
    /// them. None where other things happen, or in another order.
    pub fn under(&self, from: (&BeamLaw, &Span), to: (&BeamLaw, &Span)) -> Option<Self> {
        let (old, new) = (from.1.inside(from.0), to.1.inside(to.0));
        if old.len() != new.len() {
            return None;
        }
        let tiny = 1e-12 * from.0.length;
        let moved = |s: f64| {
            let next = old.partition_point(|place| *place < s - tiny).clamp(1, old.len() - 1);
            let (a, b) = (old[next - 1], old[next]);
            let (c, d) = (new[next - 1], new[next]);
            if (s - b).abs() <= tiny {
                d
            } else if (s - a).abs() <= tiny {
                c
            } else if a == c && b == d {
                s
            } else {
                c + (d - c) * ((s - a) / (b - a))
            }
        };
        let ends: Vec<f64> = self.ends().into_iter().map(moved).collect();
        let parts: Vec<Part> = self
            .stretches()
            .map(|stretch| Part { s: stretch.s.map(moved), steps: stretch.piece.steps, look: stretch.look })
            .collect();
        let mesh = Self::assemble(to.0, to.1, &ends, &parts);
        let same = mesh.stretches().zip(self.stretches()).all(|(a, b)| a.jumps.len() == b.jumps.len());
        let made_for = self.made_for.clone();
        same.then_some(Self { made_for, cut: self.cut, ..mesh })
    }

    pub fn stretches(&self) -> impl Iterator<Item = &Stretch> {
        self.segments.iter().flatten()
    }

    pub fn steps(&self) -> usize {
        self.stretches().map(|s| s.piece.steps).sum()
    }

    /// Gives every stretch `steps(position, present)` steps.
    pub fn multiply(&mut self, law: &BeamLaw, span: &Span, steps: impl Fn(usize, usize) -> usize) {
        for (i, stretch) in self.segments.iter_mut().flatten().enumerate() {
            let wanted = steps(i, stretch.piece.steps);
            stretch.restep(law, span, wanted);
        }
    }

    /// Where segment `i` starts, m.
    pub fn start_of(&self, i: usize) -> f64 {
        self.segments[i][0].s[0]
    }

    /// Where the segments end, m.
    pub fn ends(&self) -> Vec<f64> {
        self.segments.iter().filter_map(|segment| segment.last()).map(|stretch| stretch.s[1]).collect()
    }
}
