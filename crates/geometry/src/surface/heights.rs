//! A surface through measured points, as heights over an ellipsoid.
//!
//! With z = (x/a, y/b, z/c) the surface is f = |z|² - 1 - Σ c P(z) = 0, the P being the monomials z1^i z2^j z3^k of
//! i + j + k ≤ degree with k 0 or 1. (On the ellipsoid z3² = 1 - z1² - z2², so that higher powers of z3 say nothing new: the
//! (degree + 1)² monomials span what spherical harmonics up to that degree do.) The c are those of least squares of
//! f/|∇f0| at the points, which is their distance from the surface to first order (Taubin, "Estimation of planar curves,
//! surfaces, and nonplanar space curves defined by implicit equations", IEEE PAMI 13 (1991)).

use super::error::SurfaceError;
use crate::dual::Scalar;
use flexura_spatial::{Vector3, singular_values};
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
    degree: usize,
    terms: Vec<Term>,
}

#[derive(Clone, Copy, Debug)]
struct Term {
    factor: f64,
    powers: [usize; 3],
}

/// z^n of the three numbers with their first two derivatives, for n up to the degree.
struct Powers<T>([[[T; HIGHEST + 1]; 3]; 3]);

impl<T: Scalar> Powers<T> {
    fn new(z: &[T; 3], degree: usize) -> Self {
        let zero = T::from(0.0);
        let mut tables = [[[zero; HIGHEST + 1]; 3]; 3];
        for (table, z) in tables.iter_mut().zip(z) {
            table[0][0] = T::from(1.0);
            for n in 1..=degree {
                table[0][n] = table[0][n - 1] * *z;
                table[1][n] = T::from(n as f64) * table[0][n - 1];
                table[2][n] = T::from(n as f64) * table[1][n - 1];
            }
        }
        Self(tables)
    }

    /// The monomial, differentiated along each axis as often as `order` says.
    fn term(&self, [i, j, k]: [usize; 3], order: [usize; 3]) -> T {
        self.0[0][order[0]][i] * self.0[1][order[1]][j] * self.0[2][order[2]][k]
    }
}

/// Which derivative belongs to an entry of the Hessian.
fn order(i: usize, j: usize) -> [usize; 3] {
    let mut order = [0; 3];
    order[i] += 1;
    order[j] += 1;
    order
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
            if !(NEAR[0]..=NEAR[1]).contains(&ratio) {
                return Err(SurfaceError::PointFar { index: row, ratio, least: NEAR[0], most: NEAR[1] });
            }
            // ∇f0 = 2 z/axes, of which one unit of f is 1/|∇f0| metres; in units of the first axis.
            let slope: f64 = (0..3).map(|i| (2.0 * z[i] * axes[0] / axes[i]).powi(2)).sum();
            let weight = 1.0 / slope.sqrt();
            let table = Powers::new(&z, degree);
            for (column, powers) in powers.iter().enumerate() {
                matrix[(row, column)] = weight * table.term(*powers, [0; 3]);
            }
            right[row] = weight * (square - 1.0);
        }
        let Some(decomposition) = singular_values(matrix, true, true) else {
            return Err(SurfaceError::Undetermined { degree });
        };
        let values = &decomposition.singular_values;
        let open = OPEN * values.max();
        if !(values.min() > open) {
            return Err(SurfaceError::Undetermined { degree });
        }
        let factors = decomposition.solve(&right, open).map_err(|_| SurfaceError::Undetermined { degree })?;
        let terms =
            powers.iter().zip(&factors).map(|(powers, factor)| Term { factor: *factor, powers: *powers });
        Ok(Self { axes, degree, terms: terms.collect() })
    }

    fn scaled<T: Scalar>(&self, x: &[T; 3]) -> [T; 3] {
        std::array::from_fn(|i| x[i] * T::from(1.0 / self.axes[i]))
    }

    /// f with Σ c P counted `share` times: from the ellipsoid (0) to the surface (1).
    pub fn value<T: Scalar>(&self, x: &[T; 3], share: f64) -> T {
        let z = self.scaled(x);
        let table = Powers::new(&z, self.degree);
        let mut f = z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - T::from(1.0);
        for term in &self.terms {
            f = f - T::from(share * term.factor) * table.term(term.powers, [0; 3]);
        }
        f
    }

    /// ∇f, 1/m.
    pub fn gradient<T: Scalar>(&self, x: &[T; 3], share: f64) -> [T; 3] {
        let z = self.scaled(x);
        let table = Powers::new(&z, self.degree);
        let mut slope = z.map(|z| T::from(2.0) * z);
        for term in &self.terms {
            let factor = T::from(share * term.factor);
            for (i, order) in [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter().enumerate() {
                slope[i] = slope[i] - factor * table.term(term.powers, order);
            }
        }
        std::array::from_fn(|i| slope[i] * T::from(1.0 / self.axes[i]))
    }

    /// ∇∇f, 1/m².
    pub fn hessian<T: Scalar>(&self, x: &[T; 3], share: f64) -> [[T; 3]; 3] {
        let table = Powers::new(&self.scaled(x), self.degree);
        let mut bend = [[T::from(0.0); 3]; 3];
        for term in &self.terms {
            let factor = T::from(-share * term.factor);
            for i in 0..3 {
                for j in i..3 {
                    bend[i][j] = bend[i][j] + factor * table.term(term.powers, order(i, j));
                }
            }
        }
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own = if i == j { bend[i][i] + T::from(2.0) } else { bend[i.min(j)][i.max(j)] };
                own * T::from(1.0 / (self.axes[i] * self.axes[j]))
            })
        })
    }
}
