//! A linear model for control.

use crate::Solution;
use nalgebra::{Complex, DMatrix};

/// ẋ = A x + B u, y = C x + D u about an equilibrium, SI units.
///
/// States are the modal coordinates q, scaled so that every generalised mass is 1 kg (q in m·√kg), then their rates.
#[derive(Clone, Debug)]
pub struct StateSpace {
    /// The equilibrium, its status and warnings.
    pub solution: Solution,
    /// What goes in.
    pub inputs: Vec<Signal>,
    /// What comes out, as a change from the equilibrium.
    pub outputs: Vec<Signal>,
    /// ω² of each coordinate, rad²/s².
    pub squares: Vec<f64>,
    /// How many of the coordinates are modes; the others are residual vectors.
    pub modes: usize,
    /// How many residual vectors there are for each input, fewer where they told nothing new.
    pub residual_vectors: usize,
    /// Rows of A.
    pub a: Vec<Vec<f64>>,
    /// Rows of B, a column for each input.
    pub b: Vec<Vec<f64>>,
    /// Rows of C, one for each output.
    pub c: Vec<Vec<f64>>,
    /// Rows of D.
    pub d: Vec<Vec<f64>>,
    /// Largest difference from the response of all that the mechanism can do, between standstill and the last mode, without damping,
    /// beside the size of the response at the same frequency, its coordinates' parts without their signs; None where nothing was
    /// compared.
    pub error_estimate: Option<f64>,
}

/// An input or output of a linear model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// `load.push.force.x`, `ground.acceleration.z`, `tip.velocity`.
    pub name: String,
    /// SI unit.
    pub unit: String,
}

impl StateSpace {
    /// C (iω - A)⁻¹ B + D at a circular frequency (rad/s): for each output, for each input its real and imaginary part; None at a
    /// pole.
    pub fn response(&self, omega: f64) -> Option<Vec<Vec<[f64; 2]>>> {
        let n = self.a.len();
        let real = |value: f64| Complex::new(value, 0.0);
        let shifted =
            DMatrix::from_fn(n, n, |i, j| Complex::new(-self.a[i][j], if i == j { omega } else { 0.0 }));
        let inputs = DMatrix::from_fn(n, self.inputs.len(), |i, j| real(self.b[i][j]));
        let states = shifted.lu().solve(&inputs)?;
        let entry = |k: usize, u: usize| {
            let sum: Complex<f64> = (0..n).map(|i| states[(i, u)] * real(self.c[k][i])).sum();
            [sum.re + self.d[k][u], sum.im]
        };
        let rows: Vec<Vec<[f64; 2]>> =
            (0..self.outputs.len()).map(|k| (0..self.inputs.len()).map(|u| entry(k, u)).collect()).collect();
        let is_sound = rows.iter().flatten().flatten().all(|value| value.is_finite());
        is_sound.then_some(rows)
    }
}
