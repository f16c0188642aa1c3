//! Cuts spans into stretches that are stable by themselves, and carries the state along them.
//!
//! A stretch of length ℓ, clamped at its start, with section moments up to M and forces up to F, bends and twists with at
//! least B ∫|θ'|² against at most M ∫|θ||θ'| + F ∫|θ|², B the softest stiffness. With ∫|θ|² ≤ (2ℓ/π)² ∫|θ'|² its second variation is
//! positive where
//!
//! ```text
//!   (2ℓ/π) M/B + (2ℓ/π)² F/B + 2 κ ((2ℓ/π)⁴/B + (2ℓ/π)² A) < 1
//! ```
//!
//! κ is the most by which a foundation pulls away per displacement, where its law has a negative slope: its part is κ ∫|δp|², with
//! δp' = δθ × p' + δν and A the largest compliance in stretching and shear. One that pushes back only helps.

use super::segment::Form;
use crate::beam::BeamLaw;
use crate::course::Level;
use crate::look::Look;
use crate::lower::Span;
use crate::mesh::Stretch;
use crate::shooting::{Plain, SegmentEnd, jump};
use crate::system::Equilibrium;
use flexura_nonlinear::Breakdown;
use flexura_spatial::Vector3;

/// What the left side above may be: aimed at, and at most.
const AIM: f64 = 0.7;
const MOST: f64 = 0.95;
/// Accuracy of the integration along stretches.
const ACCURACY: f64 = 1e-9;
/// Most stretches of one span.
const MOST_STRETCHES: usize = 20_000;

/// Rate of growth times length that a stretch on a foundation may have, so that its map keeps its digits.
const GROWTH: f64 = 2.0;
/// Places along a stretch at which the slope of a foundation is taken.
const PLACES: usize = 5;

/// The left side above; `pull` is κ.
fn measure(length: f64, look: &Look, level: &Level, pull: f64) -> f64 {
    let reach = std::f64::consts::FRAC_2_PI * length;
    let square = reach * reach;
    let Look { soft, yields, .. } = *look;
    soft * (reach * (level.moment + level.tendons) + square * level.force)
        + 2.0 * pull * square * (square * soft + yields)
}

/// κ along a stretch between two states: laws at displacements between those of its ends.
fn pull(law: &BeamLaw, s: [f64; 2], ends: [&Plain; 2]) -> f64 {
    let outward = law.outward_slope(0.5 * (s[0] + s[1]));
    if !law.founded.is_nonlinear() {
        return outward;
    }
    let rest = |s: f64| law.place(s).position / law.scale.length;
    let moved = [0, 1].map(|end| Vector3::from(ends[end].position) - rest(s[end]));
    let at = |i: usize| {
        let t = i as f64 / (PLACES - 1) as f64;
        let s = s[0] + t * (s[1] - s[0]);
        -law.foundation_slopes(s, &(rest(s) + moved[0] * (1.0 - t) + moved[1] * t))[1]
    };
    outward + (0..PLACES).map(at).fold(0.0, f64::max)
}

fn norm(v: &[f64; 3]) -> f64 {
    Vector3::from(*v).norm()
}

/// A span as short stretches.
pub(super) struct Cut {
    pub forms: Vec<Form>,
    /// The state at the span's start, before any load there.
    pub start: Plain,
    /// The state at its end, after what jumps there.
    pub end: Plain,
}

impl Equilibrium {
    /// Cuts a span, each smooth stretch of it into `parts` at least. With `kept`, changes of the section moments at both ends of every
    /// stretch, the rest curvature gives way to these, so that the shape stays as it is.
    pub(super) fn short_stretches(
        &self,
        span: usize,
        parts: usize,
        kept: Option<&[[Vector3<f64>; 2]]>,
        end: &mut SegmentEnd,
    ) -> Result<Cut, Breakdown> {
        let description = &self.lowered.spans[span];
        let law = &self.lowered.beams[description.beam];
        let mesh = &self.meshes[span];
        let pulls: Vec<_> = self
            .pulls(span)
            .into_iter()
            .map(|pull| crate::shooting::Pull { unknown: false, ..pull })
            .collect();
        let start = self.head_state(span);
        let mut forms = Vec::new();
        let mut here = start;
        for (k, segment) in mesh.segments.iter().enumerate() {
            if k == 0 {
                mesh.first_jumps.iter().for_each(|&j| jump(&description.jumps[j], self.load, &mut here));
            } else {
                here = self.inner_state(self.layout.spans[span].inner[k - 1].state);
            }
            for run in runs(law, description, segment) {
                let mut s = run.s()[0];
                let widest = self.first_width(span, &run, parts);
                let mut width = widest;
                while s < run.s()[1] {
                    let next = run.next(s, self.width(span, &run, s, width));
                    let mut pieces = self.pieces(span, &run, [s, next]);
                    if let Some(kept) = kept {
                        let change = kept.get(forms.len()).ok_or(Breakdown::Singular)?;
                        straighten(&mut pieces, change);
                    }
                    let look = run.look([s, next]);
                    let form =
                        Form::new(&pieces, look.soft, (self.load, &pulls), &here, end).filter(|form| {
                            let met = Level {
                                force: norm(&here.force).max(norm(&form.end.force)),
                                moment: norm(&here.moment).max(norm(&form.end.moment)),
                                tendons: self.courses[span].most.tendons,
                                foundation: 0.0,
                            };
                            let pull = pull(law, [s, next], [&here, &form.end]);
                            measure((next - s) / law.scale.length, &look, &met, pull) <= MOST
                        });
                    if let Some(form) = form {
                        here = form.end;
                        forms.push(form);
                        s = next;
                        if run.stretches.len() > 1 {
                            width = (2.0 * width).min(widest);
                        }
                    } else if forms.len() < MOST_STRETCHES && next - s > 1e-9 * law.length {
                        width = 0.5 * (next - s);
                    } else {
                        return Err(Breakdown::Singular);
                    }
                }
                let jumps = run.stretches.last().map_or(&[][..], |stretch| &stretch.jumps);
                jumps.iter().for_each(|&j| jump(&description.jumps[j], self.load, &mut here));
            }
        }
        if !norm(&here.moment).is_finite() {
            return Err(Breakdown::NotFinite);
        }
        Ok(Cut { forms, start, end: here })
    }
}

impl Equilibrium {
    /// Width (m) of the stretches of a run, `parts` of them at least.
    fn first_width(&self, span: usize, run: &Run<'_>, parts: usize) -> f64 {
        let [first, last] = run.s();
        let law = &self.lowered.beams[self.lowered.spans[span].beam];
        let count = if run.stretches.len() == 1 {
            let course = &self.courses[span];
            let level = if course.marks.is_empty() { course.most } else { course.over([first, last]) };
            wanted(law, &run.look([first, last]), &level, [first, last])
        } else {
            1.0
        };
        (last - first) / count.clamp(parts as f64, MOST_STRETCHES as f64)
    }

    /// `widest` (m), or less where the beam is softer or more loaded than that allows.
    fn width(&self, span: usize, run: &Run<'_>, s: f64, widest: f64) -> f64 {
        let mut width = widest;
        if run.stretches.len() == 1 {
            return width;
        }
        let law = &self.lowered.beams[self.lowered.spans[span].beam];
        loop {
            let part = [s, (s + width).min(run.s()[1])];
            let count = wanted(law, &run.look(part), &self.courses[span].over(part), part);
            if count <= 1.0 || width < 1e-9 * law.length {
                return width;
            }
            width = (width / count).max(0.5 * width);
        }
    }

    /// A part of a run, as finely as the mesh has it and a stretch needs.
    fn pieces(&self, span: usize, run: &Run<'_>, [from, to]: [f64; 2]) -> Vec<Stretch> {
        let description = &self.lowered.spans[span];
        let law = &self.lowered.beams[description.beam];
        let course = &self.courses[span];
        let winding =
            |s| description.channels.iter().filter(|c| c.holds(s)).map(|c| c.rate).fold(0.0, f64::max);
        let mut pieces = Vec::new();
        for stretch in run.stretches.iter().filter(|stretch| stretch.s[1] > from && stretch.s[0] < to) {
            let s = [stretch.s[0].max(from), stretch.s[1].min(to)];
            // What round-off leaves over.
            if s[1] - s[0] <= 1e-14 * law.length && run.stretches.len() > 1 {
                continue;
            }
            let length = (s[1] - s[0]) / law.scale.length;
            let mut steps = course.over(s).steps(&stretch.look, winding(s), length, ACCURACY);
            if run.stretches.len() > 1 {
                let part = (s[1] - s[0]) / (stretch.s[1] - stretch.s[0]);
                steps = steps.max((stretch.piece.steps as f64 * part * 0.999_999).ceil() as usize);
            }
            let begin = pieces.last().map_or(from, |piece: &Stretch| piece.s[1]);
            pieces.push(Stretch::new(law, description, [begin, s[1]], steps, Vec::new()));
        }
        pieces
    }
}

/// How many equal parts the condition above and the growth along a foundation ask of a stretch, as a quadratic in the length.
fn wanted(law: &BeamLaw, look: &Look, level: &Level, [first, last]: [f64; 2]) -> f64 {
    let whole = (last - first) / law.scale.length;
    let (a, b) = (look.soft * level.force, look.soft * (level.moment + level.tendons));
    let aim = 2.0 * AIM / (b + (b * b + 4.0 * a * AIM).sqrt()).max(1e-300);
    let push = look.push + level.foundation;
    let grown = whole * (push * look.soft).powf(0.25).max((push * look.yields).sqrt());
    (whole / (aim * std::f64::consts::FRAC_PI_2)).max(grown / GROWTH).ceil()
}

/// Stretches of the mesh that follow each other with nothing between them that jumps or is not smooth.
struct Run<'a> {
    stretches: &'a [Stretch],
}

impl Run<'_> {
    /// Its ends, m.
    fn s(&self) -> [f64; 2] {
        [self.stretches[0].s[0], self.stretches[self.stretches.len() - 1].s[1]]
    }

    /// What the law is like between two places.
    fn look(&self, [from, to]: [f64; 2]) -> Look {
        let here = self.stretches.iter().filter(|stretch| stretch.s[1] > from && stretch.s[0] < to);
        here.map(|stretch| stretch.look).reduce(|a, b| a.max(&b)).unwrap_or_default()
    }

    /// The end of a stretch that starts at `s`: equal parts of what is left, so that no sliver remains.
    fn next(&self, s: f64, width: f64) -> f64 {
        let last = self.s()[1];
        let left = last - s;
        if left <= 1.000_001 * width { last } else { s + left / (left / width).ceil() }
    }
}

/// The runs of a segment.
fn runs<'a>(law: &BeamLaw, span: &Span, segment: &'a [Stretch]) -> Vec<Run<'a>> {
    let places = span.inside(law);
    let happens = |s: f64| {
        let next = places.partition_point(|place| *place < s - 1e-12 * law.length);
        places.get(next).is_some_and(|place| *place <= s + 1e-12 * law.length)
    };
    segment.chunk_by(|a, _| !happens(a.s[1])).map(|stretches| Run { stretches }).collect()
}

/// Takes the change of the section moment, which goes in a straight line between both ends, out of the rest curvature.
fn straighten(pieces: &mut [Stretch], change: &[Vector3<f64>; 2]) {
    let Some((first, last)) = pieces.first().zip(pieces.last()).map(|(a, b)| (a.s[0], b.s[1])) else {
        return;
    };
    for stretch in pieces {
        let at = |s: f64| change[0] + (change[1] - change[0]) * ((s - first) / (last - first));
        stretch.piece.straighten(&stretch.s.map(at).map(Into::into));
    }
}
