//! Taylor arithmetic on intervals: what a function and its derivatives can be anywhere in a stretch.
//!
//! R. E. Moore, *Interval Analysis* (1966), ch. 11: with c_k ⊇ f⁽ᵏ⁾(x)/k! for every x of a stretch of width w, the
//! Taylor polynomial about its middle errs by at most |c_N| (w/2)ᴺ. A function whose remainder is small therefore hides nothing
//! between the places where it is looked at. Where an operation has no derivative (a kink, a jump, a root at zero) the
//! coefficients are unbounded.

use crate::expression::{Binary, Call};
use crate::interval::Interval;
use crate::program::Number;

/// Order of the remainder.
pub(crate) const ORDER: usize = 8;

type Series = [Interval; ORDER + 1];

/// Enclosures of the Taylor coefficients over a stretch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub c: Series,
}

impl Bounds {
    /// The variable itself between two places.
    pub fn variable(a: f64, b: f64) -> Self {
        let mut c = [Interval::ZERO; ORDER + 1];
        c[0] = Interval::between(a, b);
        c[1] = Interval::point(1.0);
        Self { c }
    }

    pub fn is_bounded(&self) -> bool {
        self.c.iter().all(Interval::is_bounded)
    }

    fn is_constant(&self) -> bool {
        self.c[1..].iter().all(Interval::is_zero)
    }

    /// Of a value alone: nothing is known of the derivatives.
    fn rough(value: Interval) -> Self {
        let mut c = [Interval::ALL; ORDER + 1];
        c[0] = value;
        Self { c }
    }

    fn add(self, other: Self) -> Self {
        Self { c: std::array::from_fn(|k| self.c[k].add(other.c[k])) }
    }

    fn scale(self, factor: f64) -> Self {
        Self { c: self.c.map(|c| c.scale(factor)) }
    }

    /// Cauchy product.
    fn multiply(self, other: Self) -> Self {
        let mut c = [Interval::ZERO; ORDER + 1];
        for (j, a) in self.c.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (k, b) in other.c[..=ORDER - j].iter().enumerate().filter(|(_, b)| !b.is_zero()) {
                c[j + k] = c[j + k].add(a.multiply(*b));
            }
        }
        Self { c }
    }

    fn square(self) -> Self {
        let mut square = self.multiply(self);
        square.c[0] = self.c[0].square();
        square
    }

    fn divide(self, other: Self) -> Self {
        let inverse = other.c[0].inverse();
        let mut q = [Interval::ZERO; ORDER + 1];
        for k in 0..=ORDER {
            let known = (0..k).fold(Interval::ZERO, |sum, j| sum.add(q[j].multiply(other.c[k - j])));
            q[k] = self.c[k].add(known.negate()).multiply(inverse);
        }
        Self { c: q }
    }

    /// g(self) from enclosures of g's own coefficients over all values of self: Σ g_k (self - c_0)ᵏ.
    fn compose(self, g: &Series) -> Self {
        if self.is_constant() {
            let mut c = [Interval::ZERO; ORDER + 1];
            c[0] = g[0];
            return Self { c };
        }
        let mut inner = self;
        inner.c[0] = Interval::ZERO;
        let mut power = Self::constant(1.0);
        let mut c = [Interval::ZERO; ORDER + 1];
        for (k, g) in g.iter().enumerate() {
            for (sum, p) in c.iter_mut().zip(&power.c) {
                *sum = sum.add(g.multiply(*p));
            }
            if k < ORDER {
                power = power.multiply(inner);
            }
        }
        Self { c }
    }

    /// From the value and the coefficients of the derivative.
    fn integral(value: Interval, slope: &Self) -> Self {
        let mut c = [value; ORDER + 1];
        for k in 1..=ORDER {
            c[k] = slope.c[k - 1].scale(1.0 / k as f64);
        }
        Self { c }
    }

    /// The derivative; its last coefficient is unknown, and nobody looks at it.
    fn slope(self) -> Self {
        let mut c = [Interval::ZERO; ORDER + 1];
        for k in 0..ORDER {
            c[k] = self.c[k + 1].scale((k + 1) as f64);
        }
        Self { c }
    }

    /// `self` to a constant power that is not whole.
    fn real_power(self, p: f64) -> Self {
        let base = self.c[0];
        if base.lo < 0.0 {
            return Self::rough(Interval::ALL);
        }
        if base.lo == 0.0 {
            // The value is bounded for a positive power; some derivative never is.
            let value = if p > 0.0 { base.monotone(|x| x.powf(p)) } else { Interval::ALL };
            return if self.is_constant() { self.compose(&[value; ORDER + 1]) } else { Self::rough(value) };
        }
        let mut factor = 1.0;
        let g = std::array::from_fn(|k| {
            let power = p - k as f64;
            let term = base.monotone(|x| x.powf(power)).scale(factor);
            factor *= power / (k + 1) as f64;
            term
        });
        self.compose(&g)
    }

    /// sin or cos, `shift` being that of the sine.
    fn wave(self, shift: f64) -> Self {
        let mut factor = 1.0;
        let g = std::array::from_fn(|k| {
            let term = self.c[0].sine(shift + k as f64 * std::f64::consts::FRAC_PI_2).scale(factor);
            factor /= (k + 1) as f64;
            term
        });
        self.compose(&g)
    }

    /// A function whose derivatives repeat: `even` is the value and every second derivative.
    fn repeating(self, even: Interval, odd: Interval) -> Self {
        let mut factor = 1.0;
        let g = std::array::from_fn(|k| {
            let term = if k % 2 == 0 { even } else { odd }.scale(factor);
            factor /= (k + 1) as f64;
            term
        });
        self.compose(&g)
    }

    fn logarithm(self) -> Self {
        let base = self.c[0];
        if base.lo <= 0.0 {
            return Self::rough(Interval::ALL);
        }
        let g = std::array::from_fn(|k| match k {
            0 => base.monotone(f64::ln),
            k => {
                let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
                base.monotone(|x| x.powi(-(k as i32))).scale(sign / k as f64)
            }
        });
        self.compose(&g)
    }

    /// y' = (1 - y²) x'.
    fn tanh(self) -> Self {
        let slope = self.slope();
        let mut y = Self::constant(0.0);
        y.c[0] = self.c[0].monotone(f64::tanh);
        for k in 1..=ORDER {
            // Coefficients of 1 - y² up to k - 1.
            let mut rest = y.square().scale(-1.0);
            rest.c[0] = rest.c[0].add(Interval::point(1.0));
            let sum = (0..k).fold(Interval::ZERO, |sum, j| sum.add(slope.c[j].multiply(rest.c[k - 1 - j])));
            y.c[k] = sum.scale(1.0 / k as f64);
        }
        y
    }

    fn arctangent(self) -> Self {
        let slope = self.slope().divide(self.square().add(Self::constant(1.0)));
        Self::integral(self.c[0].monotone(f64::atan), &slope)
    }

    fn arcsine(self) -> Self {
        if self.c[0].lo <= -1.0 || self.c[0].hi >= 1.0 {
            return Self::rough(Interval::ALL);
        }
        let root = Self::constant(1.0).add(self.square().scale(-1.0)).real_power(0.5);
        Self::integral(self.c[0].monotone(f64::asin), &self.slope().divide(root))
    }

    /// `self` where it is on this side of zero, its opposite on the other.
    fn absolute(self) -> Self {
        let base = self.c[0];
        if base.lo >= 0.0 {
            self
        } else if base.hi <= 0.0 {
            self.scale(-1.0)
        } else {
            Self::rough(Interval { lo: 0.0, hi: base.magnitude() })
        }
    }

    fn sign(self) -> Self {
        let base = self.c[0];
        if base.is_zero() {
            Self::constant(0.0)
        } else if base.lo >= 0.0 {
            Self::constant(1.0)
        } else if base.hi <= 0.0 {
            Self::constant(-1.0)
        } else {
            Self::rough(Interval { lo: -1.0, hi: 1.0 })
        }
    }

    /// The lesser of two.
    fn least(self, other: Self) -> Self {
        let gap = self.add(other.scale(-1.0)).c[0];
        if gap.hi <= 0.0 {
            self
        } else if gap.lo >= 0.0 {
            other
        } else {
            let (a, b) = (self.c[0], other.c[0]);
            Self::rough(Interval { lo: a.lo.min(b.lo), hi: a.hi.min(b.hi) })
        }
    }

    fn angle(self, other: Self) -> Self {
        let (y, x) = (self, other);
        let value = y.c[0].angle(x.c[0]);
        if y.is_constant() && x.is_constant() {
            return Self::constant(0.0).add(y.compose(&[value; ORDER + 1]));
        }
        if x.c[0].lo <= 0.0 && y.c[0].holds(0.0) {
            return Self::rough(value);
        }
        let turn = x.multiply(y.slope()).add(y.multiply(x.slope()).scale(-1.0));
        Self::integral(value, &turn.divide(x.square().add(y.square())))
    }
}

impl Number for Bounds {
    fn constant(value: f64) -> Self {
        let mut c = [Interval::ZERO; ORDER + 1];
        c[0] = Interval::between(value, value);
        Self { c }
    }

    fn negate(self) -> Self {
        self.scale(-1.0)
    }

    fn binary(binary: Binary, a: Self, b: Self) -> Self {
        match binary {
            Binary::Add => a.add(b),
            Binary::Subtract => a.add(b.scale(-1.0)),
            Binary::Multiply => a.multiply(b),
            Binary::Divide => a.divide(b),
            Binary::Power if b.is_constant() && b.c[0].lo == b.c[0].hi => a.real_power(b.c[0].lo),
            Binary::Power => Self::call1(Call::Exp, a.logarithm().multiply(b)),
        }
    }

    fn whole_power(self, exponent: i32) -> Self {
        let mut result = Self::constant(1.0);
        let (mut square, mut left) = (self, exponent.unsigned_abs());
        while left > 0 {
            if left & 1 == 1 {
                result = result.multiply(square);
            }
            left >>= 1;
            if left > 0 {
                square = square.square();
            }
        }
        if exponent < 0 { Self::constant(1.0).divide(result) } else { result }
    }

    fn call1(call: Call, a: Self) -> Self {
        use std::f64::consts::{FRAC_PI_2, LN_10};
        let base = a.c[0];
        match call {
            Call::Sin => a.wave(0.0),
            Call::Cos => a.wave(FRAC_PI_2),
            Call::Tan => a.wave(0.0).divide(a.wave(FRAC_PI_2)),
            Call::Asin => a.arcsine(),
            Call::Acos => Self::constant(FRAC_PI_2).add(a.arcsine().scale(-1.0)),
            Call::Atan => a.arctangent(),
            Call::Sinh | Call::Cosh => {
                let least = if base.holds(0.0) { 1.0 } else { base.lo.abs().min(base.hi.abs()).cosh() };
                let cosh = Interval::between(least, base.magnitude().cosh());
                let sinh = base.monotone(f64::sinh);
                if call == Call::Sinh { a.repeating(sinh, cosh) } else { a.repeating(cosh, sinh) }
            }
            Call::Tanh => a.tanh(),
            Call::Exp => a.repeating(base.monotone(f64::exp), base.monotone(f64::exp)),
            Call::Ln => a.logarithm(),
            Call::Log10 => a.logarithm().scale(1.0 / LN_10),
            Call::Sqrt => a.real_power(0.5),
            Call::Cbrt if base.lo > 0.0 => a.real_power(1.0 / 3.0),
            Call::Cbrt if base.hi < 0.0 => a.scale(-1.0).real_power(1.0 / 3.0).scale(-1.0),
            Call::Cbrt => Self::rough(base.monotone(f64::cbrt)),
            Call::Abs => a.absolute(),
            Call::Sign => a.sign(),
            Call::Atan2 | Call::Min | Call::Max | Call::Hypot => Self::rough(Interval::ALL),
        }
    }

    fn call2(call: Call, a: Self, b: Self) -> Self {
        match call {
            Call::Atan2 => a.angle(b),
            Call::Min => a.least(b),
            Call::Max => a.scale(-1.0).least(b.scale(-1.0)).scale(-1.0),
            Call::Hypot => a.square().add(b.square()).real_power(0.5),
            _ => Self::rough(Interval::ALL),
        }
    }
}
