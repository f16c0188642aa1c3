//! Parameters whose residuals are least: a trust region around Gauss and Newton's step (J. J. Moré, The Levenberg-Marquardt
//! algorithm, 1978), with bounds and losses.
//!
//! With the residuals r(x) and J = ∂r/∂x a step minimises |r + J s| within |D s| ≤ Δ, D the largest norms of J's columns so far.
//! Variables at a bound that the step would cross are held there. Between two Jacobians J follows the residuals by Broyden's rank
//! one in each row, since residuals are cheaper than their derivatives; nothing is called an end that a fresh J has not confirmed.

mod loss;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail where it stands")]
mod tests;

use flexura_spatial::singular_values;
pub use loss::Loss;
use nalgebra::{DMatrix, DVector};

/// Residuals as a function of variables of about size one.
pub trait Residuals {
    /// The residuals at x, and ∂r/∂x where it is wanted. None where something has no value.
    fn at(&mut self, x: &DVector<f64>, jacobian: bool) -> Option<(DVector<f64>, Option<DMatrix<f64>>)>;

    /// Shall it end, with what there is?
    fn is_interrupted(&self) -> bool {
        false
    }
}

/// How carefully.
#[derive(Clone, Debug)]
pub struct LeastSquaresOptions {
    /// Bounds of each variable; may be infinite.
    pub bounds: Vec<[f64; 2]>,
    /// What a residual costs.
    pub loss: Loss,
    /// Largest step, relative to 1 + |x|, that ends it.
    pub step: f64,
    /// Part of a variable's own uncertainty, as the residuals show it, below which a step ends it too.
    pub uncertainty: f64,
    /// Most steps.
    pub iterations: usize,
}

/// How it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeastSquaresEnd {
    /// At a minimum.
    Converged,
    /// No step makes it better, though the derivatives say so.
    Stalled,
    /// After the most steps.
    Exhausted,
    /// By the flag.
    Interrupted,
    /// There are no residuals where it should begin.
    NoStart,
}

/// Where it ended.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The variables.
    pub x: DVector<f64>,
    /// The residuals there.
    pub residuals: DVector<f64>,
    /// Their exact Jacobian there.
    pub jacobian: DMatrix<f64>,
    /// ½ scale² Σ ρ.
    pub cost: f64,
    /// How it ended.
    pub end: LeastSquaresEnd,
    /// Steps that were taken.
    pub iterations: usize,
    /// Residuals that were asked for, and Jacobians among them.
    pub evaluations: [usize; 2],
}

/// First radius, in variables, which are of size one; ratios of a step's gain to the predicted one that change the radius.
const FIRST: f64 = 1.0;
const POOR: f64 = 0.25;
const GOOD: f64 = 0.75;
/// Reduction beside the predicted one that a step must bring.
const LEAST: f64 = 1e-4;
/// Radius, in variables, below which nothing gets better.
const SMALLEST: f64 = 1e-15;

/// The minimum reached from a start, which is moved into the bounds.
pub fn least_squares(
    problem: &mut dyn Residuals,
    start: &DVector<f64>,
    options: &LeastSquaresOptions,
) -> Minimum {
    let mut search =
        Search { options, evaluations: [0, 0], iterations: 0, scale: DVector::zeros(start.len()) };
    let mut x = start.clone();
    for (x, [low, high]) in x.iter_mut().zip(&options.bounds) {
        *x = x.clamp(*low, *high);
    }
    let none = |search: Search<'_>, x: DVector<f64>| Minimum {
        jacobian: DMatrix::zeros(0, x.len()),
        x,
        residuals: DVector::zeros(0),
        cost: f64::NAN,
        end: LeastSquaresEnd::NoStart,
        iterations: 0,
        evaluations: search.evaluations,
    };
    let Some((residuals, Some(jacobian))) = search.ask(problem, &x, true) else { return none(search, x) };
    let cost = search.cost(&residuals);
    search.renew_scale(&jacobian);
    let at = Minimum {
        x,
        residuals,
        jacobian,
        cost,
        end: LeastSquaresEnd::Exhausted,
        iterations: 0,
        evaluations: [0, 0],
    };
    search.run(problem, at)
}

struct Search<'o> {
    options: &'o LeastSquaresOptions,
    evaluations: [usize; 2],
    iterations: usize,
    /// D.
    scale: DVector<f64>,
}

impl Search<'_> {
    fn ask(
        &mut self,
        problem: &mut dyn Residuals,
        x: &DVector<f64>,
        jacobian: bool,
    ) -> Option<(DVector<f64>, Option<DMatrix<f64>>)> {
        self.evaluations[0] += 1;
        self.evaluations[1] += usize::from(jacobian);
        let (residuals, matrix) = problem.at(x, jacobian)?;
        let sound = residuals.iter().all(|r| r.is_finite())
            && matrix.as_ref().is_none_or(|m| m.iter().all(|v| v.is_finite()));
        sound.then_some((residuals, matrix))
    }

    fn cost(&self, residuals: &DVector<f64>) -> f64 {
        residuals.iter().map(|r| self.options.loss.cost(*r)).sum()
    }

    fn renew_scale(&mut self, jacobian: &DMatrix<f64>) {
        for (d, column) in self.scale.iter_mut().zip(jacobian.column_iter()) {
            *d = d.max(column.norm());
        }
        let largest = self.scale.amax().max(f64::MIN_POSITIVE);
        self.scale.iter_mut().for_each(|d| *d = d.max(1e-12 * largest));
    }

    fn run(mut self, problem: &mut dyn Residuals, mut at: Minimum) -> Minimum {
        let mut radius = FIRST * self.scale.norm();
        // J as the steps use it: exact, or followed by the residuals.
        let mut jacobian = at.jacobian.clone();
        let mut fresh = true;
        loop {
            if problem.is_interrupted() {
                return self.end(at, LeastSquaresEnd::Interrupted);
            }
            if self.iterations >= self.options.iterations {
                return self.end(at, LeastSquaresEnd::Exhausted);
            }
            let (step, predicted) = self.step(&at, &jacobian, radius);
            let tiny = self.is_tiny(&at, &step, &jacobian);
            if tiny && fresh {
                return self.end(at, LeastSquaresEnd::Converged);
            }
            if tiny {
                if !self.refresh(problem, &mut at) {
                    return self.end(at, LeastSquaresEnd::Stalled);
                }
                jacobian.clone_from(&at.jacobian);
                fresh = true;
                continue;
            }
            let x = &at.x + &step;
            let length = self.scale.component_mul(&step).norm();
            let found = self.ask(problem, &x, false);
            let better = found.map(|(residuals, _)| {
                let cost = self.cost(&residuals);
                (at.cost - cost, cost, residuals)
            });
            let ratio = better.as_ref().map_or(-1.0, |(gain, ..)| gain / predicted.max(f64::MIN_POSITIVE));
            if ratio < POOR {
                radius = 0.25 * length;
            } else if ratio > GOOD {
                radius = radius.max(2.0 * length);
            }
            match better {
                Some((_, cost, residuals)) if ratio > LEAST => {
                    self.iterations += 1;
                    let change = &residuals - &at.residuals - &jacobian * &step;
                    follow(&mut jacobian, &at.jacobian, &change, &step);
                    (at.x, at.residuals, at.cost) = (x, residuals, cost);
                    fresh = false;
                    if ratio < POOR && self.refresh(problem, &mut at) {
                        jacobian.clone_from(&at.jacobian);
                        fresh = true;
                    }
                }
                _ if !fresh => {
                    if !self.refresh(problem, &mut at) {
                        return self.end(at, LeastSquaresEnd::Stalled);
                    }
                    jacobian.clone_from(&at.jacobian);
                    fresh = true;
                }
                _ if length < SMALLEST * self.scale.norm() => {
                    return self.end(at, LeastSquaresEnd::Stalled);
                }
                _ => {}
            }
        }
    }

    /// The exact Jacobian where it stands.
    fn refresh(&mut self, problem: &mut dyn Residuals, at: &mut Minimum) -> bool {
        let Some((residuals, Some(jacobian))) = self.ask(problem, &at.x.clone(), true) else { return false };
        self.renew_scale(&jacobian);
        at.cost = self.cost(&residuals);
        (at.residuals, at.jacobian) = (residuals, jacobian);
        true
    }

    fn end(self, mut at: Minimum, end: LeastSquaresEnd) -> Minimum {
        (at.end, at.iterations, at.evaluations) = (end, self.iterations, self.evaluations);
        at
    }

    /// The step within the radius and the bounds, and how much it should bring.
    fn step(&self, at: &Minimum, jacobian: &DMatrix<f64>, radius: f64) -> (DVector<f64>, f64) {
        let (mut rows, mut matrix) = (at.residuals.clone(), jacobian.clone());
        for (i, r) in rows.iter_mut().enumerate() {
            let [residual, row] = self.options.loss.factors(*r);
            *r *= residual;
            matrix.row_mut(i).scale_mut(row);
        }
        let n = at.x.len();
        let mut held = vec![false; n];
        let mut step = DVector::zeros(n);
        // What would cross a bound is stopped there, and the others find their way with it standing.
        for _ in 0..=n {
            let free: Vec<usize> = (0..n).filter(|k| !held[*k]).collect();
            let right = -(&rows + &matrix * held_part(&step, &held));
            let part = within(&matrix, &free, &right, &self.scale, radius);
            let mut stopped = false;
            for (k, value) in free.iter().zip(part.iter()) {
                let [low, high] = self.options.bounds[*k];
                let next = at.x[*k] + value;
                step[*k] = next.clamp(low, high) - at.x[*k];
                if next < low || next > high {
                    held[*k] = true;
                    stopped = true;
                }
            }
            if !stopped {
                break;
            }
        }
        let ahead = &rows + &matrix * &step;
        let predicted = 0.5 * (rows.norm_squared() - ahead.norm_squared());
        (step, predicted)
    }

    fn is_tiny(&self, at: &Minimum, step: &DVector<f64>, jacobian: &DMatrix<f64>) -> bool {
        let relative = step.iter().zip(&at.x).all(|(s, x)| s.abs() <= self.options.step * (1.0 + x.abs()));
        let spare = at.residuals.len().saturating_sub(at.x.len());
        let of_noise = spare > 0
            && (jacobian * step).norm_squared()
                <= self.options.uncertainty.powi(2) * at.residuals.norm_squared() / spare as f64;
        relative || of_noise
    }
}

fn held_part(step: &DVector<f64>, held: &[bool]) -> DVector<f64> {
    DVector::from_fn(step.len(), |k, _| if held[k] { step[k] } else { 0.0 })
}

/// Broyden's rank one, row by row: what does not depend on a variable stays so (L. K. Schubert, 1970). `pattern` is the last exact
/// Jacobian.
fn follow(jacobian: &mut DMatrix<f64>, pattern: &DMatrix<f64>, change: &DVector<f64>, step: &DVector<f64>) {
    for i in 0..jacobian.nrows() {
        let own: Vec<usize> = (0..step.len()).filter(|k| pattern[(i, *k)] != 0.0).collect();
        let square: f64 = own.iter().map(|k| step[*k].powi(2)).sum();
        if square > 0.0 {
            own.iter().for_each(|k| jacobian[(i, *k)] += change[i] * step[*k] / square);
        }
    }
}

/// The s of the free variables with |J s - right| least within |D s| ≤ radius. The singular values of J D⁻¹ make the damped step a
/// sum, whose length falls with the damping; its reciprocal is nearly linear in it, which makes Newton's steps few.
fn within(
    matrix: &DMatrix<f64>,
    free: &[usize],
    right: &DVector<f64>,
    scale: &DVector<f64>,
    radius: f64,
) -> DVector<f64> {
    let scaled = DMatrix::from_fn(matrix.nrows(), free.len(), |i, k| matrix[(i, free[k])] / scale[free[k]]);
    if free.is_empty() {
        return DVector::zeros(0);
    }
    // Many rows: their triangle has the same singular values.
    let (triangle, turned) = if scaled.nrows() > scaled.ncols() {
        let qr = scaled.qr();
        let mut turned = right.clone();
        qr.q_tr_mul(&mut turned);
        (qr.r(), turned.rows(0, free.len()).into_owned())
    } else {
        (scaled, right.clone())
    };
    let Some(svd) = singular_values(triangle, true, true) else { return DVector::zeros(free.len()) };
    let (Some(u), sigma, Some(vt)) = (svd.u, svd.singular_values, svd.v_t) else {
        return DVector::zeros(free.len());
    };
    let along = u.tr_mul(&turned);
    let floor = 1e-14 * sigma.max();
    let damped = |lambda: f64| {
        let mut sum = DVector::zeros(sigma.len());
        for (k, s) in sigma.iter().enumerate() {
            if *s > floor {
                sum[k] = s * along[k] / (s * s + lambda);
            }
        }
        sum
    };
    let mut lambda = 0.0;
    let mut coefficients = damped(0.0);
    for _ in 0..60 {
        let length = coefficients.norm();
        if length <= 1.1 * radius && (lambda == 0.0 || length >= 0.9 * radius) {
            break;
        }
        let slope: f64 = sigma
            .iter()
            .zip(coefficients.iter())
            .map(|(s, c)| if *s > floor { c * c / (s * s + lambda) } else { 0.0 })
            .sum();
        let next = lambda + (length / radius - 1.0) * length * length / slope.max(f64::MIN_POSITIVE);
        lambda = if next > 0.0 { next } else { 0.5 * lambda };
        coefficients = damped(lambda);
    }
    let turned = vt.tr_mul(&coefficients);
    DVector::from_fn(free.len(), |k, _| turned[k] / scale[free[k]])
}
