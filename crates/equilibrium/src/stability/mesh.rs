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
use crate::mesh::{Level, Stretch};
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
fn measure(length: f64, law: &BeamLaw, level: &Level, pull: f64) -> f64 {
    let reach = std::f64::consts::FRAC_2_PI * length;
    let square = reach * reach;
    let (soft, yields) = (law.soft(), law.yields());
    soft * (reach * (level.moment + level.tendons) + square * level.force)
        + 2.0 * pull * square * (square * soft + yields)
}

/// κ along a stretch between two states: laws at displacements between those of its ends.
fn pull(law: &BeamLaw, s: [f64; 2], ends: [&Plain; 2]) -> f64 {
    if !law.founded.is_nonlinear() {
        return 0.0;
    }
    let rest = |s: f64| law.place(s).position / law.scale.length;
    let moved = [0, 1].map(|end| Vector3::from(ends[end].position) - rest(s[end]));
    let at = |i: usize| {
        let t = i as f64 / (PLACES - 1) as f64;
        let s = s[0] + t * (s[1] - s[0]);
        -law.foundation_slopes(s, &(rest(s) + moved[0] * (1.0 - t) + moved[1] * t))[1]
    };
    (0..PLACES).map(at).fold(0.0, f64::max)
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
        let level = self.levels[span];
        let start = self.head_state(span);
        let mut forms = Vec::new();
        let mut here = start;
        for (k, segment) in mesh.segments.iter().enumerate() {
            if k == 0 {
                mesh.first_jumps.iter().for_each(|&j| jump(&description.jumps[j], self.load, &mut here));
            } else {
                here = self.inner_state(self.layout.spans[span].inner[k - 1].state);
            }
            for stretch in segment {
                let [first, last] = stretch.s;
                let whole = (last - first) / law.scale.length;
                // From the condition, as a quadratic in the length.
                let (a, b) = (law.soft() * level.force, law.soft() * (level.moment + level.tendons));
                let aim = 2.0 * AIM / (b + (b * b + 4.0 * a * AIM).sqrt()).max(1e-300);
                let push = law.foundation_stiffness(stretch.s) + level.foundation;
                let grown = whole * (push * law.soft()).powf(0.25).max((push * law.yields()).sqrt());
                let count = (whole / (aim * std::f64::consts::FRAC_PI_2))
                    .max(grown / GROWTH)
                    .ceil()
                    .clamp(parts as f64, MOST_STRETCHES as f64);
                let mut width = (last - first) / count;
                let mut s = first;
                while s < last {
                    let left = last - s;
                    // Equal parts of what is left, so that no sliver remains.
                    let next =
                        if left <= 1.000_001 * width { last } else { s + left / (left / width).ceil() };
                    let steps = level.steps(law, description, [s, next], ACCURACY);
                    let mut part = Stretch::new(law, description, [s, next], steps, Vec::new());
                    if let Some(kept) = kept {
                        let change = kept.get(forms.len()).ok_or(Breakdown::Singular)?;
                        part.piece.straighten(&change.map(Into::into));
                    }
                    let form = Form::new(&part, law.soft(), (self.load, &pulls), &here, end).filter(|form| {
                        let met = Level {
                            force: norm(&here.force).max(norm(&form.end.force)),
                            moment: norm(&here.moment).max(norm(&form.end.moment)),
                            tendons: level.tendons,
                            foundation: 0.0,
                        };
                        let pull = pull(law, [s, next], [&here, &form.end]);
                        measure((next - s) / law.scale.length, law, &met, pull) <= MOST
                    });
                    if let Some(form) = form {
                        here = form.end;
                        forms.push(form);
                        s = next;
                    } else if forms.len() < MOST_STRETCHES && next - s > 1e-9 * law.length {
                        width = 0.5 * (next - s);
                    } else {
                        return Err(Breakdown::Singular);
                    }
                }
                stretch.jumps.iter().for_each(|&j| jump(&description.jumps[j], self.load, &mut here));
            }
        }
        if !norm(&here.moment).is_finite() {
            return Err(Breakdown::NotFinite);
        }
        Ok(Cut { forms, start, end: here })
    }
}
