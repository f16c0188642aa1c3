//! Where along a path flutter or divergence sets in.
//!
//! Between two points of a path at which different numbers of modes grow, a function of the parameter passes zero that is smooth there,
//! whatever the frequencies themselves do:
//!
//! ```text
//!                      flutter                           divergence
//!   nothing damps      (z₁ - z₂)²/4 of two z that meet   the ω² nearest to zero
//!   something does     Re s of the mode that grows       the real s nearest to zero
//! ```
//!
//! with z = ω², or s where the frame spins: two of them that meet are roots of a square, of which sum and discriminant do not know that
//! they meet (A. P. Seyranian and A. A. Mailybaev, *Multiparameter Stability Theory with Mechanical Applications*, 2003, ch. 2). Its
//! zero is found between two values of opposite sign, by the inverse of a parabola where that is to be trusted (T. R. Chandrupatla,
//! *Adv. Eng. Softw.* 28 (1997) 145).

use super::{Spectrum, Wave, reading};
use crate::ProblemError;
use flexura_solution::{Followed, ModeKind, Onset, OnsetKind};
use nalgebra::Complex;

type C = Complex<f64>;

/// Halvings of the interval before the function is taken for smooth.
const HALVINGS: usize = 4;
/// Most looks after these.
const LOOKS: usize = 50;
/// Looks on either side of where equilibria are not found.
const ASIDE: usize = 3;
/// Relative width of the interval at which the value is known.
const NARROW: f64 = 1e-14;

/// What is looked at.
#[derive(Clone, Copy)]
enum Watched {
    /// Two roots whose mean is near this.
    Meeting(C),
    /// The real part of s nearest to this.
    Growth(C),
    /// The ω² nearest to zero.
    Square,
}

/// The value, and its scale, by which errors of the spectrum are multiplied; the rate there.
struct Look {
    value: f64,
    scale: f64,
    rate: f64,
    error: f64,
}

/// What is seen of a spectrum.
pub(super) struct Sight {
    /// s where one of ±s alone is meant, else ω²; ω²; is it s?
    roots: Vec<(C, C, bool)>,
    modes: Vec<Followed>,
    errors: Vec<f64>,
    /// ω² of 1, rad²/s².
    unit: f64,
    is_damped: bool,
}

impl Sight {
    pub fn of(found: &Spectrum) -> Self {
        let root = |wave: &Wave| (wave.rate.unwrap_or(wave.square), wave.square, wave.rate.is_some());
        Self {
            roots: found.waves.iter().map(root).collect(),
            modes: reading::rates(found),
            errors: found.errors.clone(),
            unit: found.vibration.unit,
            is_damped: !found.vibration.damping.is_empty(),
        }
    }

    /// How many modes grow.
    pub fn growing(&self) -> usize {
        self.modes.iter().filter(|mode| mode.growth > 0.0).count()
    }
}

fn size(z: C) -> f64 {
    z.re.hypot(z.im)
}

/// What to watch, as what grows on the unstable side says.
fn watch(stable: &Sight, unstable: &Sight) -> Option<(Watched, ModeKind)> {
    let apart = |z: C| stable.roots.iter().map(|(other, ..)| size(*other - z)).fold(f64::INFINITY, f64::min);
    // The one that is farthest from everything on the other side is new, where more than one grow.
    let new = unstable.roots.iter().zip(&unstable.modes).filter(|(_, mode)| mode.growth > 0.0);
    let ((z, _, is_rate), mode) = new.max_by(|a, b| apart(a.0.0).total_cmp(&apart(b.0.0)))?;
    let watched = match (unstable.is_damped, mode.kind) {
        (true, ModeKind::Diverging) => Watched::Growth(C::new(0.0, 0.0)),
        (true, _) => Watched::Growth(*z),
        (false, ModeKind::Diverging) => Watched::Square,
        // Its partner is the mirror image in the axis on which both lay.
        (false, _) if *is_rate => Watched::Meeting(C::new(0.0, z.im)),
        (false, _) => Watched::Meeting(C::new(z.re, 0.0)),
    };
    Some((watched, mode.kind))
}

fn look(sight: &Sight, watched: &Watched) -> Option<Look> {
    let unit = sight.unit;
    let each = || sight.roots.iter().zip(&sight.errors);
    match *watched {
        Watched::Square => {
            let ((_, square, _), error) = each().min_by(|a, b| size(a.0.1).total_cmp(&size(b.0.1)))?;
            Some(Look { value: square.re, scale: size(*square), rate: 0.0, error: *error })
        }
        Watched::Growth(to) => {
            let nearest = each().min_by(|a, b| size(a.0.0 - to).total_cmp(&size(b.0.0 - to)));
            let ((s, ..), error) = nearest?;
            Some(Look { value: s.re, scale: size(*s), rate: s.im * unit.sqrt(), error: 0.5 * error })
        }
        Watched::Meeting(mean) => {
            let mut best: Option<(f64, Look)> = None;
            for (i, ((a, _, is_rate), error)) in each().enumerate() {
                for ((b, ..), other) in each().skip(i + 1) {
                    let (sum, half) = ((a + b) * 0.5, (a - b) * 0.5);
                    let off = size(sum - mean) + size(half);
                    if best.as_ref().is_some_and(|(best, _)| *best <= off) {
                        continue;
                    }
                    let rate = if *is_rate { sum.im } else { sum.re.max(0.0).sqrt() };
                    let scale = sum.norm_sqr();
                    let (value, error) = ((half * half).re, error.max(*other));
                    best = Some((off, Look { value, scale, rate: rate * unit.sqrt(), error }));
                }
            }
            best.map(|(_, look)| look)
        }
    }
}

/// Where the number of growing modes changes between two values at which `ends` were found; `at` finds the spectrum at a value.
pub(super) fn locate(
    values: [f64; 2],
    ends: [&Sight; 2],
    at: &mut dyn FnMut(f64) -> Result<Option<Sight>, ProblemError>,
) -> Result<Option<Onset>, ProblemError> {
    let counts = ends.map(Sight::growing);
    let begins = counts[0] < counts[1];
    // From the side on which fewer grow, to the other.
    let [mut low, mut high] = if begins { values } else { [values[1], values[0]] };
    let few = counts[0].min(counts[1]);
    let (mut below, mut above): (Option<Sight>, Option<Sight>) = (None, None);
    let [first, second] = if begins { ends } else { [ends[1], ends[0]] };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let Some(found) = at(middle)? else { break };
        if found.growing() <= few {
            (low, below) = (middle, Some(found));
        } else {
            (high, above) = (middle, Some(found));
        }
    }
    let sides = [below.as_ref().unwrap_or(first), above.as_ref().unwrap_or(second)];
    let Some((watched, kind)) = watch(sides[0], sides[1]) else { return Ok(None) };
    let looks = sides.map(|side| look(side, &watched));
    let [Some(a), Some(b)] = looks else { return Ok(None) };
    let kind = if kind == ModeKind::Diverging { OnsetKind::Divergence } else { OnsetKind::Flutter };
    let (value, rate, error_estimate) =
        zero([low, high], [a, b], &mut |value| Ok(at(value)?.and_then(|found| look(&found, &watched))))?;
    Ok(Some(Onset { parameter: value, kind, begins, rate, error_estimate }))
}

/// The zero between two values at which the function has opposite signs, with the rate there and the error of the value; where they are
/// alike, or a look fails, the narrowest interval known is the error.
fn zero(
    [mut a, mut b]: [f64; 2],
    [mut at_a, mut at_b]: [Look; 2],
    at: &mut dyn FnMut(f64) -> Result<Option<Look>, ProblemError>,
) -> Result<(f64, f64, f64), ProblemError> {
    let relative = |from: f64, to: f64| (to - from).abs() / from.abs().max(to.abs()).max(f64::MIN_POSITIVE);
    if at_a.value == 0.0 {
        return Ok((a, at_a.rate, NARROW));
    }
    if (at_a.value > 0.0) == (at_b.value > 0.0) {
        return Ok((b, at_b.rate, relative(a, b)));
    }
    let (mut c, mut at_c);
    let mut t = 0.5;
    let mut slope = ((at_b.value - at_a.value) / (b - a)).abs();
    for _ in 0..LOOKS {
        let x = a + t * (b - a);
        let Some(seen) = at(x)? else {
            return Ok(across([a, b], [&at_a, &at_b], at)?.unwrap_or((b, at_b.rate, relative(a, b))));
        };
        if (seen.value > 0.0) == (at_a.value > 0.0) {
            (c, at_c) = (a, at_a.value);
        } else {
            (c, at_c) = (b, at_b.value);
            (b, at_b) = (a, at_a);
        }
        (a, at_a) = (x, seen);
        slope = ((at_b.value - at_a.value) / (b - a)).abs().max(f64::MIN_POSITIVE);
        let width = NARROW * a.abs().max(b.abs());
        if (b - a).abs() <= width || at_a.value == 0.0 {
            break;
        }
        // Inverse quadratic interpolation where it is monotonic.
        let (xi, phi) = ((a - b) / (c - b), (at_a.value - at_b.value) / (at_c - at_b.value));
        t = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            let (fa, fb) = (at_a.value, at_b.value);
            fa / (fb - fa) * at_c / (fb - at_c) + (c - a) / (b - a) * fa / (at_c - fa) * fb / (at_c - fb)
        } else {
            0.5
        };
        let least = 0.5 * width / (b - a).abs();
        t = t.clamp(least, 1.0 - least);
    }
    let best = if at_a.value.abs() <= at_b.value.abs() { (a, &at_a) } else { (b, &at_b) };
    let size = best.0.abs().max(f64::MIN_POSITIVE);
    let left = (best.1.value.abs() + best.1.error.max(1e-14) * best.1.scale) / slope;
    Ok((best.0, best.1.rate, (left.min((b - a).abs().max(left)) / size).max(NARROW)))
}

/// The same where equilibria so near to a critical one are not found: by the polynomial through looks on both sides; its error is what
/// the outermost of these change.
fn across(
    [a, b]: [f64; 2],
    known: [&Look; 2],
    at: &mut dyn FnMut(f64) -> Result<Option<Look>, ProblemError>,
) -> Result<Option<(f64, f64, f64)>, ProblemError> {
    let mut seen: Vec<[f64; 3]> =
        vec![[a, known[0].value, known[0].rate], [b, known[1].value, known[1].rate]];
    for k in 1..=ASIDE {
        for (from, sign) in [(a, -1.0), (b, 1.0)] {
            let x = from + sign * 0.5 * k as f64 * (b - a);
            if let Some(look) = at(x)? {
                seen.push([x, look.value, look.rate]);
            }
        }
    }
    if seen.len() < 4 {
        return Ok(None);
    }
    let through = |points: &[[f64; 3]], which: usize, x: f64| -> f64 {
        let part = |i: usize| {
            let others = points.iter().enumerate().filter(|(j, _)| *j != i);
            points[i][which] * others.map(|(_, p)| (x - p[0]) / (points[i][0] - p[0])).product::<f64>()
        };
        (0..points.len()).map(part).sum()
    };
    let root = |points: &[[f64; 3]]| {
        let (mut low, mut high) = (a, b);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let is_left = (through(points, 1, middle) > 0.0) == (known[0].value > 0.0);
            if is_left { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    let x = root(&seen);
    let fewer = root(&seen[..seen.len() - 2]);
    Ok(Some((x, through(&seen, 2, x), ((x - fewer) / x).abs().max(NARROW))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_is_found_to_round_off_in_few_looks() {
        let of = |x: f64| Look { value: x.exp() - 3.0, scale: 1.0, rate: x, error: 0.0 };
        let mut looks = 0;
        let (x, rate, error) = zero([0.0, 4.0], [of(0.0), of(4.0)], &mut |x| {
            looks += 1;
            Ok(Some(of(x)))
        })
        .unwrap();
        assert!((x - 3.0_f64.ln()).abs() < 1e-14, "{x}");
        assert!((rate - x).abs() < 1e-13 && error < 1e-12);
        assert!(looks < 14, "{looks}");
    }
}
