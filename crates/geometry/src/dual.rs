//! Forward-mode derivatives: numbers that carry their rates along `N` directions, and vectors of them.
//!
//! What is written over [`Scalar`] is evaluated with `f64` for its value, and with [`Dual`] for its exact derivatives as
//! well: f(x + Σ ε_i d_i) = f(x) + Σ ε_i ∂f/∂d_i with ε_i ε_j = 0 (Griewank and Walther, *Evaluating Derivatives*, 2nd
//! ed., ch. 3).

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, with or without derivatives.
pub trait Scalar:
    Copy
    + Debug
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number itself.
    fn value(self) -> f64;

    /// f of this number, where f and f' have the given values here.
    #[must_use]
    fn lift(self, f: f64, slope: f64) -> Self;

    /// Its square root.
    #[must_use]
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.lift(root, 0.5 / root)
    }
}

impl Scalar for f64 {
    fn value(self) -> f64 {
        self
    }
    fn lift(self, f: f64, _: f64) -> f64 {
        f
    }
}

/// A number with its derivatives along `N` directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The number.
    pub value: f64,
    /// Its derivatives.
    pub rates: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A number with given derivatives.
    pub fn new(value: f64, rates: [f64; N]) -> Self {
        Self { value, rates }
    }

    fn map(self, value: f64, rate: impl Fn(usize) -> f64) -> Self {
        Self { value, rates: std::array::from_fn(rate) }
    }
}

impl<const N: usize> From<f64> for Dual<N> {
    fn from(value: f64) -> Self {
        Self { value, rates: [0.0; N] }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        self.map(self.value + b.value, |i| self.rates[i] + b.rates[i])
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self.map(self.value - b.value, |i| self.rates[i] - b.rates[i])
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the rule of products")]
impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        self.map(self.value * b.value, |i| self.rates[i] * b.value + self.value * b.rates[i])
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the rule of quotients")]
impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.value / b.value;
        self.map(quotient, |i| (self.rates[i] - quotient * b.rates[i]) / b.value)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(-self.value, |i| -self.rates[i])
    }
}

impl<const N: usize> Scalar for Dual<N> {
    fn value(self) -> f64 {
        self.value
    }
    fn lift(self, f: f64, slope: f64) -> Self {
        self.map(f, |i| slope * self.rates[i])
    }
}

/// Vectors and matrices (by rows) of scalars.
pub mod vector {
    use super::{Dual, Scalar};
    use flexura_spatial::Vector3;

    /// Three numbers.
    pub type Triple<T> = [T; 3];
    /// A matrix by rows.
    pub type Rows<T> = [[T; 3]; 3];

    /// A vector without derivatives.
    pub fn constant<T: Scalar>(v: &Triple<f64>) -> Triple<T> {
        v.map(T::from)
    }

    /// A vector with the derivative `rate` along one direction.
    pub fn moving(v: &Triple<f64>, rate: &Triple<f64>) -> Triple<Dual<1>> {
        std::array::from_fn(|i| Dual::new(v[i], [rate[i]]))
    }

    /// Its values alone.
    pub fn values<T: Scalar>(v: &Triple<T>) -> Triple<f64> {
        v.map(Scalar::value)
    }

    /// Its derivatives along the one direction.
    pub fn rates(v: &Triple<Dual<1>>) -> Vector3<f64> {
        Vector3::new(v[0].rates[0], v[1].rates[0], v[2].rates[0])
    }

    /// a + b.
    pub fn sum<T: Scalar>(a: &Triple<T>, b: &Triple<T>) -> Triple<T> {
        std::array::from_fn(|i| a[i] + b[i])
    }

    /// a - b.
    pub fn difference<T: Scalar>(a: &Triple<T>, b: &Triple<T>) -> Triple<T> {
        std::array::from_fn(|i| a[i] - b[i])
    }

    /// c a.
    pub fn scaled<T: Scalar>(c: T, a: &Triple<T>) -> Triple<T> {
        a.map(|x| c * x)
    }

    /// a·b.
    pub fn dot<T: Scalar>(a: &Triple<T>, b: &Triple<T>) -> T {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    /// |a|.
    pub fn norm<T: Scalar>(a: &Triple<T>) -> T {
        dot(a, a).sqrt()
    }

    /// a/|a|.
    pub fn unit<T: Scalar>(a: &Triple<T>) -> Triple<T> {
        scaled(T::from(1.0) / norm(a), a)
    }

    /// a × b.
    pub fn cross<T: Scalar>(a: &Triple<T>, b: &Triple<T>) -> Triple<T> {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    /// M a.
    pub fn turned<T: Scalar>(m: &Rows<T>, a: &Triple<T>) -> Triple<T> {
        m.map(|row| dot(&row, a))
    }

    /// Mᵀ a.
    pub fn back<T: Scalar>(m: &Rows<T>, a: &Triple<T>) -> Triple<T> {
        std::array::from_fn(|j| m[0][j] * a[0] + m[1][j] * a[1] + m[2][j] * a[2])
    }

    /// Two unit vectors across the unit vector n, right-handed with it: t1 = (a × n)/|a × n|, t2 = n × t1, where a is the
    /// coordinate axis least along n.
    pub fn tangents<T: Scalar>(n: &Triple<T>) -> [Triple<T>; 2] {
        let size = n.map(|x| x.value().abs());
        let least = (0..3).min_by(|i, j| size[*i].total_cmp(&size[*j])).unwrap_or(0);
        let mut a = [T::from(0.0); 3];
        a[least] = T::from(1.0);
        let first = unit(&cross(&a, n));
        [first, cross(n, &first)]
    }
}

#[cfg(test)]
mod tests {
    use super::vector::*;
    use super::*;

    fn formula<T: Scalar>(v: &Triple<T>) -> Triple<T> {
        let [x, y, z] = *v;
        let root = (x * x + y / z).sqrt();
        let n = unit(&[root, -x, y - z]);
        let [t1, t2] = tangents(&n);
        sum(
            &scaled(x, &t1),
            &scaled(z.lift(z.value().sin(), z.value().cos()), &cross(&t1, &difference(&t2, v))),
        )
    }

    /// Fourth-order differences: f' = [8 (f(h) - f(-h)) - (f(2h) - f(-2h))]/12h.
    #[test]
    fn rates_are_derivatives() {
        let at = [0.7, 1.3, -2.1].map(|x: f64| x.abs());
        let directions = [[0.3, -0.4, 0.9], [1.0, 0.2, 0.1]];
        let dual: Triple<Dual<2>> =
            std::array::from_fn(|i| Dual::new(at[i], [directions[0][i], directions[1][i]]));
        let result = formula(&dual);
        assert_eq!(values(&result), formula(&at));
        let h = 1e-3;
        for (k, direction) in directions.iter().enumerate() {
            let shifted = |x: f64| formula(&std::array::from_fn(|i| at[i] + x * direction[i]));
            let [p2, p1, m1, m2] = [2.0 * h, h, -h, -2.0 * h].map(shifted);
            for i in 0..3 {
                let slope = (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h);
                assert!((slope - result[i].rates[k]).abs() < 1e-10, "{slope} {:?}", result[i]);
            }
        }
    }

    #[test]
    fn tangents_are_a_right_handed_frame() {
        for n in [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [0.48, 0.64, 0.6]] {
            let [a, b] = tangents(&n);
            let along = dot(&cross(&a, &b), &n);
            assert!((along - 1.0).abs() < 1e-15 && dot(&a, &n).abs() < 1e-15 && dot(&a, &b).abs() < 1e-15);
        }
    }
}
