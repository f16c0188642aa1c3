//! A surface through measured points, as heights over an ellipsoid.
//!
//! With z = (x/a, y/b, z/c) the surface is f = |z|² - 1 - Σ c P(z) = 0, the P being the monomials z1^i z2^j z3^k of
//! i + j + k ≤ degree with k 0 or 1. (On the ellipsoid z3² = 1 - z1² - z2², so that higher powers of z3 say nothing new: the
//! (degree + 1)² monomials span what spherical harmonics up to that degree do.) The c are those of least squares of
//! f/|∇f0| at the points, which is their distance from the surface to first order (Taubin, "Estimation of planar curves,
//! surfaces, and nonplanar space curves defined by implicit equations", IEEE PAMI 13 (1991)).

use super::error::SurfaceError;
use crate::dual::Scalar;
use flexura_spatial::Vector3;
use nalgebra::{DMatrix, DVector};

/// Highest degree.
pub(super) const HIGHEST: usize = 12;
/// |z| of points that can be fitted.
const NEAR: [f64; 2] = [0.5, 2.0];
/// Singular values below this part of the largest leave their direction open.
const OPEN: f64 = 1e-11;

/// The polynomial.
#[derive(Clone, Debug)]
pub(super) struct Heights {
    pub axes: [f64; 3],
    terms: Vec<Term>,
}

#[derive(Clone, Copy, Debug)]
struct Term {
    factor: f64,
    powers: [usize; 3],
}

/// Powers z^0 to z^degree of the three numbers.
struct Powers<T>([[T; HIGHEST + 1]; 3]);

impl<T: Scalar> Powers<T> {
    fn new(z: &[T; 3]) -> Self {
        let mut table = [[T::from(1.0); HIGHEST + 1]; 3];
        for (row, z) in table.iter_mut().zip(z) {
            for n in 1..=HIGHEST {
                row[n] = row[n - 1] * *z;
            }
        }
        Self(table)
    }

    /// The monomial, differentiated once along each of the given axes.
    fn term(&self, mut powers: [usize; 3], along: &[usize]) -> T {
        let mut factor = 1.0;
        for axis in along {
            if powers[*axis] == 0 {
                return T::from(0.0);
            }
            factor *= powers[*axis] as f64;
            powers[*axis] -= 1;
        }
        T::from(factor) * self.0[0][powers[0]] * self.0[1][powers[1]] * self.0[2][powers[2]]
    }
}

fn monomials(degree: usize) -> Vec<[usize; 3]> {
    let mut all = Vec::with_capacity((degree + 1) * (degree + 1));
    for k in 0..=degree.min(1) {
        for i in 0..=degree - k {
            all.extend((0..=degree - k - i).map(|j| [i, j, k]));
        }
    }
    all
}

impl Heights {
    /// The fit to points (m) over the ellipsoid with the given semi-axes (m).
    pub fn fitted(axes: [f64; 3], points: &[Vector3<f64>], degree: usize) -> Result<Self, SurfaceError> {
        if degree > HIGHEST {
            return Err(SurfaceError::Degree { degree, most: HIGHEST });
        }
        let powers = monomials(degree);
        if points.len() < powers.len() {
            return Err(SurfaceError::TooFewPoints { count: points.len(), needed: powers.len(), degree });
        }
        let mut matrix = DMatrix::zeros(points.len(), powers.len());
        let mut right = DVector::zeros(points.len());
        for (row, point) in points.iter().enumerate() {
            if !point.iter().all(|x| x.is_finite()) {
                return Err(SurfaceError::PointNotFinite { index: row });
            }
            let z: [f64; 3] = std::array::from_fn(|i| point[i] / axes[i]);
            let square: f64 = z.iter().map(|z| z * z).sum();
            let ratio = square.sqrt();
            if !(ratio >= NEAR[0] && ratio <= NEAR[1]) {
                return Err(SurfaceError::PointFar { index: row, ratio, least: NEAR[0], most: NEAR[1] });
            }
            // ∇f0 = 2 z/axes, of which one unit of f is 1/|∇f0| metres; in units of the first axis.
            let slope: f64 = (0..3).map(|i| (2.0 * z[i] * axes[0] / axes[i]).powi(2)).sum();
            let weight = 1.0 / slope.sqrt();
            let table = Powers::new(&z);
            for (column, powers) in powers.iter().enumerate() {
                matrix[(row, column)] = weight * table.term(*powers, &[]);
            }
            right[row] = weight * (square - 1.0);
        }
        let decomposition = matrix.svd(true, true);
        let values = &decomposition.singular_values;
        let open = OPEN * values.max();
        if !(values.min() > open) {
            return Err(SurfaceError::Undetermined { degree });
        }
        let factors = decomposition.solve(&right, open).map_err(|_| SurfaceError::Undetermined { degree })?;
        let terms =
            powers.iter().zip(&factors).map(|(powers, factor)| Term { factor: *factor, powers: *powers });
        Ok(Self { axes, terms: terms.collect() })
    }

    fn scaled<T: Scalar>(&self, x: &[T; 3]) -> [T; 3] {
        std::array::from_fn(|i| x[i] * T::from(1.0 / self.axes[i]))
    }

    /// f with Σ c P counted `share` times: from the ellipsoid (0) to the surface (1).
    pub fn value<T: Scalar>(&self, x: &[T; 3], share: f64) -> T {
        let z = self.scaled(x);
        let table = Powers::new(&z);
        let mut f = z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - T::from(1.0);
        for term in &self.terms {
            f = f - T::from(share * term.factor) * table.term(term.powers, &[]);
        }
        f
    }

    /// ∇f, 1/m.
    pub fn gradient<T: Scalar>(&self, x: &[T; 3], share: f64) -> [T; 3] {
        let z = self.scaled(x);
        let table = Powers::new(&z);
        let mut slope = z.map(|z| T::from(2.0) * z);
        for term in &self.terms {
            for i in 0..3 {
                slope[i] = slope[i] - T::from(share * term.factor) * table.term(term.powers, &[i]);
            }
        }
        std::array::from_fn(|i| slope[i] * T::from(1.0 / self.axes[i]))
    }

    /// ∇∇f v, 1/m.
    pub fn hessian<T: Scalar>(&self, x: &[T; 3], v: &[T; 3], share: f64) -> [T; 3] {
        let z = self.scaled(x);
        let along = self.scaled(v);
        let table = Powers::new(&z);
        let mut bend = along.map(|v| T::from(2.0) * v);
        for term in &self.terms {
            for i in 0..3 {
                for j in 0..3 {
                    let second = table.term(term.powers, &[i, j]);
                    bend[i] = bend[i] - T::from(share * term.factor) * second * along[j];
                }
            }
        }
        std::array::from_fn(|i| bend[i] * T::from(1.0 / self.axes[i]))
    }
}
