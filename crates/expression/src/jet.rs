//! Truncated Taylor arithmetic: a value and its first three derivatives, exact to round-off.

use crate::expression::Call;
use crate::program::Number;
use std::f64::consts::LN_10;

/// Taylor coefficients c[k] = f⁽ᵏ⁾/k! about the point of evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jet {
    pub(crate) c: [f64; 4],
}

impl Jet {
    pub(crate) fn constant(value: f64) -> Self {
        Self { c: [value, 0.0, 0.0, 0.0] }
    }

    pub(crate) fn variable(value: f64) -> Self {
        Self { c: [value, 1.0, 0.0, 0.0] }
    }

    pub(crate) fn line(value: f64, rate: f64) -> Self {
        Self { c: [value, rate, 0.0, 0.0] }
    }

    pub(crate) fn derivatives(&self) -> [f64; 4] {
        [self.c[0], self.c[1], 2.0 * self.c[2], 6.0 * self.c[3]]
    }

    fn is_constant(&self) -> bool {
        self.c[1] == 0.0 && self.c[2] == 0.0 && self.c[3] == 0.0
    }

    pub(crate) fn scale(self, factor: f64) -> Self {
        Self { c: self.c.map(|c| c * factor) }
    }

    pub(crate) fn add(self, other: Self) -> Self {
        Self { c: std::array::from_fn(|k| self.c[k] + other.c[k]) }
    }

    /// Cauchy product.
    pub(crate) fn multiply(self, other: Self) -> Self {
        let (a, b) = (self.c, other.c);
        Self {
            c: [
                a[0] * b[0],
                a[0] * b[1] + a[1] * b[0],
                a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
                a[0] * b[3] + a[1] * b[2] + a[2] * b[1] + a[3] * b[0],
            ],
        }
    }

    /// q with q·other = self, coefficient by coefficient.
    pub(crate) fn divide(self, other: Self) -> Self {
        let (a, b) = (self.c, other.c);
        let mut q = [0.0; 4];
        for k in 0..4 {
            let known: f64 = (0..k).map(|j| q[j] * b[k - j]).sum();
            q[k] = (a[k] - known) / b[0];
        }
        Self { c: q }
    }

    /// g(self) from g, g', g'', g''' at the value (Faà di Bruno).
    fn compose(self, g: [f64; 4]) -> Self {
        // Else an infinite derivative, as of sqrt at 0, would turn a constant's zeros into NaN.
        if self.is_constant() {
            return Self::constant(g[0]);
        }
        let [_, a, b, c] = self.c;
        Self {
            c: [
                g[0],
                g[1] * a,
                g[1] * b + 0.5 * g[2] * a * a,
                g[1] * c + g[2] * a * b + g[3] / 6.0 * a * a * a,
            ],
        }
    }

    pub(crate) fn whole_power(self, exponent: i32) -> Self {
        let mut result = Self::constant(1.0);
        let mut square = self;
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result = result.multiply(square);
            }
            left >>= 1;
            if left > 0 {
                square = square.multiply(square);
            }
        }
        result = if exponent < 0 { Self::constant(1.0).divide(result) } else { result };
        // The value itself is the one that a plain evaluation gives, to the last bit.
        result.c[0] = self.c[0].whole_power(exponent);
        result
    }

    pub(crate) fn power(self, exponent: Self) -> Self {
        let x = self.c[0];
        if exponent.is_constant() {
            let p = exponent.c[0];
            if p.fract() == 0.0 && p.abs() <= 64.0 {
                return self.whole_power(p as i32);
            }
            // p (p-1) ... x^(p-k), where a zero factor wins over an infinite power.
            let term = |factor: f64, power: f64| if factor == 0.0 { 0.0 } else { factor * x.powf(power) };
            return self.compose([
                x.powf(p),
                term(p, p - 1.0),
                term(p * (p - 1.0), p - 2.0),
                term(p * (p - 1.0) * (p - 2.0), p - 3.0),
            ]);
        }
        let mut result = self.call1(Call::Ln).multiply(exponent).call1(Call::Exp);
        result.c[0] = x.powf(exponent.c[0]);
        result
    }

    pub(crate) fn call1(self, call: Call) -> Self {
        let x = self.c[0];
        let value = f64::call1(call, x);
        let g = match call {
            Call::Sin => [value, x.cos(), -value, -x.cos()],
            Call::Cos => [value, -x.sin(), -value, x.sin()],
            Call::Tan => {
                let slope = 1.0 + value * value;
                [value, slope, 2.0 * value * slope, slope * (2.0 + 6.0 * value * value)]
            }
            Call::Asin | Call::Acos => {
                let sign = if call == Call::Asin { 1.0 } else { -1.0 };
                let u = (1.0 - x) * (1.0 + x);
                let root = u.sqrt();
                [value, sign / root, sign * x / (u * root), sign * (1.0 + 2.0 * x * x) / (u * u * root)]
            }
            Call::Atan => {
                let u = 1.0 + x * x;
                [value, 1.0 / u, -2.0 * x / (u * u), (6.0 * x * x - 2.0) / (u * u * u)]
            }
            Call::Sinh => [value, x.cosh(), value, x.cosh()],
            Call::Cosh => [value, x.sinh(), value, x.sinh()],
            Call::Tanh => {
                let slope = 1.0 - value * value;
                [value, slope, -2.0 * value * slope, slope * (6.0 * value * value - 2.0)]
            }
            Call::Exp => [value; 4],
            Call::Ln => [value, 1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)],
            Call::Log10 => [value, 1.0 / (LN_10 * x), -1.0 / (LN_10 * x * x), 2.0 / (LN_10 * x * x * x)],
            Call::Sqrt => [value, 0.5 / value, -0.25 / (x * value), 0.375 / (x * x * value)],
            Call::Cbrt => {
                let first = value / (3.0 * x);
                [value, first, -2.0 / 3.0 * first / x, 10.0 / 9.0 * first / (x * x)]
            }
            Call::Abs => [value, f64::call1(Call::Sign, x), 0.0, 0.0],
            Call::Sign => [value, 0.0, 0.0, 0.0],
            Call::Atan2 | Call::Min | Call::Max | Call::Hypot => [f64::NAN; 4],
        };
        self.compose(g)
    }

    pub(crate) fn call2(self, call: Call, other: Self) -> Self {
        let value = f64::call2(call, self.c[0], other.c[0]);
        match call {
            Call::Min | Call::Max if value == self.c[0] => self,
            Call::Min | Call::Max => other,
            Call::Hypot => {
                let mut result = self.multiply(self).add(other.multiply(other)).call1(Call::Sqrt);
                result.c[0] = value;
                result
            }
            Call::Atan2 if self.is_constant() && other.is_constant() => Self::constant(value),
            Call::Atan2 => {
                // θ' = (x y' - y x')/(x² + y²), integrated term by term.
                let (y, x) = (self, other);
                let slope = x.multiply(y.slope()).add(y.multiply(x.slope()).scale(-1.0));
                let q = slope.divide(x.multiply(x).add(y.multiply(y))).c;
                Self { c: [value, q[0], q[1] / 2.0, q[2] / 3.0] }
            }
            _ => Self::constant(f64::NAN),
        }
    }

    /// The derivative's coefficients; the fourth is unknown and left zero, since no one looks at it.
    fn slope(self) -> Self {
        Self { c: [self.c[1], 2.0 * self.c[2], 3.0 * self.c[3], 0.0] }
    }
}
