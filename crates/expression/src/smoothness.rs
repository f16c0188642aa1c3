//! Where a function is not smooth, and how far it is from a polynomial between two places.

use crate::Function;
use crate::bounds::{Bounds, ORDER};

/// Stretches that are looked at before the search for kinks gives up.
const MOST_LOOKS: usize = 100_000;
/// Kinks of one function that are told apart.
const MOST_BREAKS: usize = 2_000;
/// Kinks closer than this part of the whole are one.
const NEAR: f64 = 1e-12;

/// Remainder, relative to what the values differ by, up to which a polynomial stands for a function.
const RESOLVED: f64 = 1e-3;

/// What a function can be between two places, for certain.
#[derive(Clone, Copy, Debug)]
pub struct Variation {
    /// Least and greatest value between the two, ends aside; infinite where nothing is known.
    pub values: [f64; 2],
    /// Least and greatest derivative, likewise.
    pub slopes: [f64; 2],
    /// How far it is at most from a polynomial of degree 7; infinite where it may have a kink.
    pub remainder: f64,
}

impl Variation {
    /// By how much the values may go up and down without that a dozen places between the two show it: zero where that is ruled
    /// out. What is narrower than the distance of these places would leave a polynomial further than `RESOLVED` allows.
    pub fn hidden(&self) -> f64 {
        self.unless_resolved(self.values[1] - self.values[0])
    }

    /// The same of the derivative.
    pub fn hidden_slope(&self) -> f64 {
        self.unless_resolved(self.slopes[1] - self.slopes[0])
    }

    fn unless_resolved(&self, spread: f64) -> f64 {
        if self.remainder <= RESOLVED * (self.values[1] - self.values[0]) {
            0.0
        } else if spread.is_nan() {
            f64::INFINITY
        } else {
            spread
        }
    }
}

impl Function {
    fn bounds(&self, a: f64, b: f64) -> Bounds {
        self.program.run(Bounds::variable(a, b), &[])
    }

    /// What the function can be between `a` and `b`, by interval arithmetic. It may be singular right at an end.
    pub fn variation(&self, a: f64, b: f64) -> Variation {
        let inset = (NEAR * (b - a)).max(8.0 * f64::EPSILON * a.abs().max(b.abs()));
        let Bounds { c } = self.bounds(a + inset, b - inset);
        let remainder = c[ORDER].magnitude() * (0.5 * (b - a)).powi(ORDER as i32);
        let remainder = if c.iter().all(|c| c.is_bounded()) { remainder } else { f64::INFINITY };
        Variation { values: [c[0].lo, c[0].hi], slopes: [c[1].lo, c[1].hi], remainder }
    }

    /// Places strictly between `a` and `b` where the function jumps, bends sharply or has a derivative without bound: where the
    /// argument of `sign` or `abs` passes zero, where `min` and `max` change sides, where a root is taken of zero, and so on.
    /// Increasing. Those of a function with thousands of them are not all found.
    pub fn breaks(&self, a: f64, b: f64) -> Vec<f64> {
        if self.as_constant().is_some() || !(a < b && (b - a).is_finite()) {
            return Vec::new();
        }
        let mut found = Vec::new();
        let mut open = vec![[a, b]];
        let mut looks = 0;
        while let Some([from, to]) = open.pop() {
            looks += 1;
            if looks > MOST_LOOKS || found.len() > MOST_BREAKS {
                break;
            }
            if self.bounds(from, to).is_bounded() {
                continue;
            }
            let middle = 0.5 * (from + to);
            // Several numbers next to each other may all give zero.
            let grain = 4.0 * f64::EPSILON * middle.abs().max(0.1 * (b - a));
            if to - from <= 2.0 * grain {
                found.push(middle);
                continue;
            }
            // A kink right at the middle would be at an end of both halves, where nobody sees it.
            if !self.bounds(middle - grain, middle + grain).is_bounded() {
                found.push(middle);
            }
            open.push([middle, to]);
            open.push([from, middle]);
        }
        let margin = NEAR * (b - a);
        found.retain(|place| *place > a + margin && *place < b - margin);
        found.sort_by(f64::total_cmp);
        found.dedup_by(|later, earlier| *later - *earlier < margin);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn breaks(text: &str, a: f64, b: f64) -> Vec<f64> {
        Function::parse(text, "s").expect("parses").breaks(a, b)
    }

    #[track_caller]
    fn assert_breaks(text: &str, expected: &[f64]) {
        let found = breaks(text, 0.0, 1.0);
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() < 1e-14, "{text}: {found:?} against {expected:?}");
        }
    }

    #[test]
    fn jumps_and_kinks_are_found_where_the_arguments_pass_zero() {
        assert_breaks("-0.1*(1 + sign(s - 0.1))/2", &[0.1]);
        assert_breaks("sign(s - 0.5)", &[0.5]);
        assert_breaks("abs(3*s - 1)", &[1.0 / 3.0]);
        assert_breaks("min(s, 0.3, 1 - s)", &[0.3, 0.7]);
        assert_breaks("max(s^2, 0.25)", &[0.5]);
        assert_breaks("sign(sin(10*pi*s))", &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]);
        assert_breaks("abs(s - 0.2) + sign(s - 0.7)", &[0.2, 0.7]);
        assert_breaks("abs(s - 0.6)^1.5", &[0.6]);
        assert_breaks("cbrt(s - 0.25)", &[0.25]);
        assert_breaks("hypot(s - 0.3, 0)", &[0.3]);
        assert_breaks("asin(2*abs(s - 0.5))", &[0.5]);
        assert_breaks("atan2(s - 0.4, -1)", &[0.4]);
    }

    #[test]
    fn smooth_functions_have_no_breaks_and_singular_ends_count_for_none() {
        for text in [
            "1 + s",
            "tanh((s - 0.1)/0.001)",
            "s^2.1",
            "sqrt(s)",
            "exp(-((s - 0.137)/1e-4)^2)",
            "1/(0.001 + s)",
            "sin(300*s)^2 + cos(300*s)^2",
            "atan(1e4*(s - 0.3))",
            "s/(1 + s^2)",
            "ln(1e-6 + s)",
            "sqrt(1 - s^2)",
        ] {
            assert_eq!(breaks(text, 0.0, 1.0), Vec::<f64>::new(), "{text}");
        }
    }

    #[test]
    fn a_function_keeps_within_its_variation() {
        let texts = [
            "sin(3*s)",
            "cos(7*s + 1)",
            "tan(s/2)",
            "asin(s/2)",
            "acos(s/3)",
            "atan(5*s - 2)",
            "sinh(2*s)",
            "cosh(s - 0.5)",
            "tanh(9*s - 4)",
            "exp(-s)",
            "ln(0.1 + s)",
            "log10(s + 2)",
            "sqrt(s + 0.2)",
            "cbrt(s - 0.5)",
            "abs(s - 0.3)",
            "sign(s - 0.3)",
            "min(s, 0.4)",
            "max(s, 1 - s)",
            "hypot(s, 0.1)",
            "atan2(s, 1 - s)",
            "s^3 - s^2",
            "(s + 1)^-3",
            "(s + 0.1)^2.7",
            "(s + 0.1)^s",
            "1/(s + 0.2)",
            "s*(1 - s)",
            "s^2.1",
        ];
        for text in texts {
            let function = Function::parse(text, "s").expect("parses");
            for pieces in [1, 3, 10, 64] {
                for i in 0..pieces {
                    let (a, b) = (f64::from(i) / f64::from(pieces), f64::from(i + 1) / f64::from(pieces));
                    let variation = function.variation(a, b);
                    let [lo, hi] = variation.values;
                    let slack = 1e-12 * (1.0 + hi.abs());
                    let values: Vec<f64> =
                        (1..20).map(|k| function.value(a + (b - a) * f64::from(k) / 20.0)).collect();
                    assert!(values.iter().all(|v| *v >= lo - slack && *v <= hi + slack), "{text} {a} {b}");
                    // The Taylor polynomial about the middle: the jet knows four of its terms, and the others are small here.
                    if variation.remainder < 1e-6 && pieces == 64 {
                        let middle = 0.5 * (a + b);
                        let [f, f1, f2, f3] = function.jet(middle);
                        let h = 0.5 * (b - a);
                        let taylor = f + h * (f1 + h * (f2 / 2.0 + h * f3 / 6.0));
                        assert!((taylor - function.value(b)).abs() < 1e-3, "{text} {a} {b}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_remainder_bounds_the_distance_from_a_polynomial() {
        // Of exp over a width w about m: e^m (w/2)^8/8! at least, and no more than the end's value gives.
        let exp = Function::parse("exp(s)", "s").expect("parses");
        let found = exp.variation(0.0, 1.0).remainder;
        let factor = 0.5f64.powi(8) / 40320.0;
        assert!(found >= factor * (1.0 - 1e-10) && found <= std::f64::consts::E * factor);
        // A polynomial of degree 7 leaves nothing, one of degree 8 its last coefficient.
        let seven = Function::parse("3*s^7 - 2*s^4 + s", "s").expect("parses");
        assert_eq!(seven.variation(0.0, 1.0).remainder, 0.0);
        let eight = Function::parse("s^8", "s").expect("parses");
        assert!((eight.variation(-1.0, 1.0).remainder - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_spike_between_samples_is_not_overlooked() {
        let spike = Function::parse("exp(-((s - 0.137)/1e-4)^2)", "s").expect("parses");
        assert!(spike.variation(0.0, 1.0).hidden() > 0.99);
        assert!(spike.variation(0.2, 1.0).hidden() < 1e-10);
        assert_eq!(spike.variation(0.137, 0.13702).hidden(), 0.0);
    }
}
