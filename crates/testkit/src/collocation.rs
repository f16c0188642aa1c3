//! Two-point boundary value problems of a rod by collocation: the second method for shapes that have no
//! closed form.
//!
//! On each of a few elements the 13 numbers (p, q, F, M) are polynomials whose derivative satisfies the
//! balance equations at the Chebyshev-Lobatto points, written with the integration matrix Q so that
//! round-off is not amplified; Newton's method on all values at once, dense. It shares no idea with
//! shooting: no initial value problem is solved. (Ascher, Mattheij and Russell, *Numerical
//! Solution of Boundary Value Problems for ODEs* (1995), ch. 5; Trefethen, 2000.)

use crate::chebyshev::{integration, interpolate, points};
use crate::ivp::rest_poses;
use crate::rod::{Rod, State};
use flexura_spatial::{Pose, Wrench};
use nalgebra::{DMatrix, DVector};

/// What holds or loads the end s = L; the start is clamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tip {
    /// The pose is given, its twist included: the wrench is found.
    Pose(Pose),
    /// A wrench of constant direction in fixed axes.
    Dead(Wrench),
    /// A wrench in the end section's own axes.
    Follower(Wrench),
    /// The position is given (m), the moment in fixed axes as well: a ball joint.
    Pinned {
        /// Where the end is held.
        position: flexura_spatial::Vector3<f64>,
        /// Moment on the end, N·m.
        moment: flexura_spatial::Vector3<f64>,
    },
}

/// The polynomials: `elements` pieces of degree `degree`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// Number of equal elements.
    pub elements: usize,
    /// Degree on each.
    pub degree: usize,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CollocationError {
    /// Newton's method did not converge at this fraction of the load; the last scaled step.
    NotConverged {
        /// Fraction of the load, 0 to 1.
        fraction: f64,
        /// Largest scaled change of the last step.
        step: f64,
    },
    /// The linear system is singular at this fraction of the load.
    Singular {
        /// Fraction of the load, 0 to 1.
        fraction: f64,
    },
}

/// A bent rod.
#[derive(Clone, Debug)]
pub struct Solution {
    length: f64,
    mesh: Mesh,
    values: Vec<[f64; 13]>,
}

impl Solution {
    /// Place and internal wrench at arc length `s`.
    pub fn at(&self, s: f64) -> State {
        let width = self.length / self.mesh.elements as f64;
        let element = ((s / width) as usize).min(self.mesh.elements - 1);
        let first = element * self.mesh.degree;
        let x = 2.0 * (s - width * element as f64) / width - 1.0;
        State::from_array(&interpolate(&self.values[first..=first + self.mesh.degree], x))
    }

    /// The end s = L.
    pub fn tip(&self) -> State {
        self.at(self.length)
    }

    /// The start s = 0.
    pub fn root(&self) -> State {
        self.at(0.0)
    }
}

/// Solves the rod that is clamped at `start`, following `tip(λ)` and λ times the distributed load from λ = 0
/// (where `tip` must fit the unloaded rod) to 1 in `steps` equal steps.
///
/// # Errors
/// Newton's method fails on a step, or the equations are singular there.
pub fn solve(
    rod: &Rod,
    start: &Pose,
    tip: &dyn Fn(f64) -> Tip,
    steps: usize,
    mesh: Mesh,
) -> Result<Solution, CollocationError> {
    let places = places(rod.length, mesh);
    // The unloaded rod, from the nearest of many integration steps.
    let fine = 64 * mesh.elements.max(2);
    let rest = rest_poses(rod, fine);
    let mut values: Vec<[f64; 13]> = places
        .iter()
        .map(|s| {
            let i = ((s / rod.length * fine as f64).round() as usize).min(fine);
            State::new(&(*start * rest[i].1), &Wrench::zero()).to_array()
        })
        .collect();
    align(&mut values);
    for step in 0..=steps {
        let fraction = step as f64 / steps as f64;
        newton(rod, start, &tip(fraction), fraction, &places, mesh, &mut values)?;
    }
    Ok(Solution { length: rod.length, mesh, values })
}

/// A quaternion and its opposite are the same rotation: keep neighbours on the same side.
fn align(values: &mut [[f64; 13]]) {
    for i in 1..values.len() {
        let dot: f64 = (3..7).map(|j| values[i][j] * values[i - 1][j]).sum();
        if dot < 0.0 {
            values[i][3..7].iter_mut().for_each(|x| *x = -*x);
        }
    }
}

/// The arc lengths of all points.
fn places(length: f64, mesh: Mesh) -> Vec<f64> {
    let width = length / mesh.elements as f64;
    let x = points(mesh.degree);
    let mut places = vec![0.0];
    for element in 0..mesh.elements {
        places.extend(x[1..].iter().map(|x| width * (element as f64 + 0.5 * (1.0 + x))));
    }
    places
}

/// Newton's method at one fraction of the load.
fn newton(
    rod: &Rod,
    start: &Pose,
    tip: &Tip,
    fraction: f64,
    places: &[f64],
    mesh: Mesh,
    values: &mut [[f64; 13]],
) -> Result<(), CollocationError> {
    let scales = rod.scales();
    let q = integration(mesh.degree) * (0.5 * rod.length / mesh.elements as f64);
    let mut largest = f64::INFINITY;
    for _ in 0..40 {
        let (residual, jacobian) = system(rod, start, tip, fraction, places, mesh, &q, values, &scales);
        let step = jacobian.lu().solve(&residual).ok_or(CollocationError::Singular { fraction })?;
        let change = step.amax();
        for (i, value) in values.iter_mut().enumerate() {
            for j in 0..13 {
                value[j] -= step[13 * i + j] * scales[j];
            }
        }
        // Past 1e-9 the next step is round-off: the one just made squares it away.
        if change < 1e-9 {
            return Ok(());
        }
        largest = change;
        if !change.is_finite() {
            break;
        }
    }
    Err(CollocationError::NotConverged { fraction, step: largest })
}

/// Residual and Jacobian in scaled unknowns. Rows: 7 for the start, 13 for every point but the first, 6 for
/// the end.
///
/// ```text
/// | start                           |   7 rows, point 0
/// | y_i - y_0 - (Q f)_i on element 0  |  13·degree rows, points 0 .. degree
/// |       y_i - y_0 - (Q f)_i on ...  |
/// | end                             |   6 rows, last point
/// ```
#[expect(clippy::too_many_arguments, reason = "one call site, each a plain datum of the system")]
fn system(
    rod: &Rod,
    start: &Pose,
    tip: &Tip,
    fraction: f64,
    places: &[f64],
    mesh: Mesh,
    q: &DMatrix<f64>,
    values: &[[f64; 13]],
    scales: &[f64; 13],
) -> (DVector<f64>, DMatrix<f64>) {
    let size = 13 * values.len();
    let mut residual = DVector::zeros(size);
    let mut jacobian = DMatrix::zeros(size, size);
    let fixed = State::new(start, &Wrench::zero()).to_array();
    for j in 0..7 {
        residual[j] = (values[0][j] - fixed[j]) / scales[j];
        jacobian[(j, j)] = 1.0;
    }
    for element in 0..mesh.elements {
        let first = element * mesh.degree;
        for k in 0..=mesh.degree {
            let point = first + k;
            let slope = rod.rates(places[point], &values[point], fraction);
            let mut tangent = [[0.0; 13]; 13];
            let local = |y: &[f64; 13]| rod.rates(places[point], y, fraction).to_vec();
            add_differences(&local, &values[point], scales, |r, c, value| {
                tangent[r][c] = value / scales[r] * scales[c];
            });
            for i in 1..=mesh.degree {
                let row = 7 + 13 * (first + i - 1);
                let weight = q[(i, k)];
                for r in 0..13 {
                    residual[row + r] -= weight * slope[r] / scales[r];
                    for c in 0..13 {
                        jacobian[(row + r, 13 * point + c)] -= weight * tangent[r][c];
                    }
                }
            }
        }
        for i in 1..=mesh.degree {
            let row = 7 + 13 * (first + i - 1);
            for r in 0..13 {
                residual[row + r] += (values[first + i][r] - values[first][r]) / scales[r];
                jacobian[(row + r, 13 * (first + i) + r)] += 1.0;
                jacobian[(row + r, 13 * first + r)] -= 1.0;
            }
        }
    }
    let last = values.len() - 1;
    let row = size - 6;
    let condition = |y: &[f64; 13]| end_condition(tip, y, scales).to_vec();
    for (j, value) in condition(&values[last]).into_iter().enumerate() {
        residual[row + j] = value;
    }
    add_differences(&condition, &values[last], scales, |r, c, value| {
        jacobian[(row + r, 13 * last + c)] += value * scales[c];
    });
    (residual, jacobian)
}

/// The six conditions at the end, scaled.
fn end_condition(tip: &Tip, y: &[f64; 13], scales: &[f64; 13]) -> [f64; 6] {
    let state = State::from_array(y);
    let (upper, lower, sizes) = match tip {
        Tip::Pose(pose) => {
            let turn = pose.rotation.quaternion().conjugate() * state.orientation;
            (state.position - pose.position, turn.imag(), [scales[0], 1.0])
        }
        Tip::Dead(wrench) => {
            (state.force - wrench.force, state.moment - wrench.moment, [scales[7], scales[10]])
        }
        Tip::Follower(wrench) => {
            let here = wrench.rotated(&state.pose().rotation);
            (state.force - here.force, state.moment - here.moment, [scales[7], scales[10]])
        }
        Tip::Pinned { position, moment } => {
            (state.position - position, state.moment - moment, [scales[0], scales[10]])
        }
    };
    std::array::from_fn(|i| if i < 3 { upper[i] / sizes[0] } else { lower[i - 3] / sizes[1] })
}

/// Calls `add(row, column, ∂f_row/∂y_column)` by central differences. Newton's method needs no more: the
/// residual alone decides what it converges to.
fn add_differences(
    f: &dyn Fn(&[f64; 13]) -> Vec<f64>,
    y: &[f64; 13],
    scales: &[f64; 13],
    mut add: impl FnMut(usize, usize, f64),
) {
    for c in 0..13 {
        let h = 1e-5 * scales[c];
        let (mut plus, mut minus) = (*y, *y);
        plus[c] += h;
        minus[c] -= h;
        for (r, (a, b)) in f(&plus).into_iter().zip(f(&minus)).enumerate() {
            let slope = (a - b) / (2.0 * h);
            if slope != 0.0 {
                add(r, c, slope);
            }
        }
    }
}

#[cfg(test)]
#[path = "collocation_tests.rs"]
mod tests;
