//! Closed intervals of numbers: every operation encloses all that it can give, round-off aside.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// All numbers from `lo` to `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub lo: f64,
    pub hi: f64,
}

impl Interval {
    /// Every number.
    pub const ALL: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    pub const ZERO: Self = Self::point(0.0);

    pub const fn point(value: f64) -> Self {
        Self { lo: value, hi: value }
    }

    /// Everything between the two, in whatever order; all numbers where one of them is none.
    pub fn between(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() { Self::ALL } else { Self { lo: a.min(b), hi: a.max(b) } }
    }

    pub fn is_bounded(&self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    pub fn is_zero(&self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }

    pub fn holds(&self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// The largest absolute value.
    pub fn magnitude(&self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    pub fn add(self, other: Self) -> Self {
        Self::between(self.lo + other.lo, self.hi + other.hi)
    }

    pub fn negate(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }

    pub fn scale(self, factor: f64) -> Self {
        self.multiply(Self::point(factor))
    }

    pub fn multiply(self, other: Self) -> Self {
        // At an end that is zero the product is zero, however large the other factor may get.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let ends = [
            product(self.lo, other.lo),
            product(self.lo, other.hi),
            product(self.hi, other.lo),
            product(self.hi, other.hi),
        ];
        if ends.iter().any(|v| v.is_nan()) {
            return Self::ALL;
        }
        let least = ends.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let most = ends.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
        Self { lo: least, hi: most }
    }

    pub fn square(self) -> Self {
        let (a, b) = (self.lo * self.lo, self.hi * self.hi);
        if self.holds(0.0) { Self { lo: 0.0, hi: a.max(b) } } else { Self::between(a, b) }
    }

    /// 1/x; all numbers where x may be zero.
    pub fn inverse(self) -> Self {
        if self.holds(0.0) { Self::ALL } else { Self::between(1.0 / self.lo, 1.0 / self.hi) }
    }

    /// Of a function that only rises or only falls.
    pub fn monotone(self, f: impl Fn(f64) -> f64) -> Self {
        Self::between(f(self.lo), f(self.hi))
    }

    /// sin(x + shift).
    pub fn sine(self, shift: f64) -> Self {
        let (a, b) = (self.lo + shift, self.hi + shift);
        if b - a >= TAU || (b - a).is_nan() {
            return Self { lo: -1.0, hi: 1.0 };
        }
        // Is there a place `at` + 2πk between the ends?
        let meets = |at: f64| ((b - at) / TAU).floor() >= ((a - at) / TAU).ceil();
        let mut sines = Self::between(a.sin(), b.sin());
        if meets(FRAC_PI_2) {
            sines.hi = 1.0;
        }
        if meets(-FRAC_PI_2) {
            sines.lo = -1.0;
        }
        sines
    }

    /// The angle of the point (x, y) = (`other`, `self`); all angles where the points surround the cut along negative x.
    pub fn angle(self, other: Self) -> Self {
        if other.lo <= 0.0 && self.holds(0.0) {
            return Self { lo: -PI, hi: PI };
        }
        let corners = [
            self.lo.atan2(other.lo),
            self.lo.atan2(other.hi),
            self.hi.atan2(other.lo),
            self.hi.atan2(other.hi),
        ];
        let least = corners.iter().fold(PI, |a, b| a.min(*b));
        let most = corners.iter().fold(-PI, |a, b| a.max(*b));
        Self { lo: least, hi: most }
    }
}
