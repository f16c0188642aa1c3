//! Sequential quadratic programming from one design.

use crate::problem::{Problem, Scaled};
use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError, Constraints,
    CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints, NonlinearBlock, NonlinearBlocks,
    NonlinearEqualityValues, NonlinearInequalityValues, SelectedFirstOrderState, Slsqp, State, StepOutcome,
};
use std::cell::RefCell;
use std::convert::Infallible;

/// The accuracy that the search is asked for; when it is good enough is decided by the caller.
const ACCURACY: f64 = 1e-14;

/// The problem as the library wants it.
struct Facade<'p, 'm> {
    problem: &'p RefCell<Problem<'m>>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    counts: [usize; 2],
}

impl Facade<'_, '_> {
    fn at(&self, u: &[f64], slopes: bool) -> Option<Scaled> {
        self.problem.borrow_mut().at(u, slopes)
    }

    /// Some of the limits; not a number where the design has none, which the search steps back from.
    fn some(&self, u: &[f64], from: usize, count: usize) -> Vec<f64> {
        self.at(u, false)
            .map_or_else(|| vec![f64::NAN; count], |scaled| scaled.c[from..from + count].to_vec())
    }
}

type Wrong = ConstraintSolveError<Infallible>;

impl Constraints for Facade<'_, '_> {
    type Set = ConstraintSet<
        BoxBounds<Vec<f64>>,
        NoLinearConstraints,
        NonlinearBlocks<NonlinearBlock, NonlinearBlock>,
    >;
    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
            .with_nonlinear_equalities(self.counts[0])
            .with_nonlinear_inequalities(self.counts[1])
    }
}

impl CostFunction for Facade<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;
    fn cost(&self, u: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(self.at(u, false).map_or(f64::NAN, |scaled| scaled.f))
    }
}

impl Gradient for Facade<'_, '_> {
    type Gradient = Vec<f64>;
    fn gradient(&self, u: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let slopes = self.at(u, true).and_then(|scaled| scaled.slopes);
        Ok(slopes.map_or_else(|| vec![f64::NAN; u.len()], |(gradient, _)| gradient))
    }
}

impl NonlinearEqualityValues for Facade<'_, '_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;
    fn nonlinear_equalities(&self, u: &Vec<f64>) -> Result<Vec<f64>, Wrong> {
        Ok(self.some(u, 0, self.counts[0]))
    }
}

impl NonlinearInequalityValues for Facade<'_, '_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;
    fn nonlinear_inequalities(&self, u: &Vec<f64>) -> Result<Vec<f64>, Wrong> {
        Ok(self.some(u, self.counts[0], self.counts[1]))
    }
}

impl ConstraintJacobian for Facade<'_, '_> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;
    fn constraint_jacobian(&self, u: &Vec<f64>) -> Result<DenseMatrix, Wrong> {
        let rows = self.counts[0] + self.counts[1];
        let slopes = self.at(u, true).and_then(|scaled| scaled.slopes);
        let all = slopes.map_or_else(|| vec![f64::NAN; rows * u.len()], |(_, rows)| rows.concat());
        Ok(DenseMatrix::from_row_slice(rows, u.len(), &all))
    }
}

/// Steps from a point of the box; each accepted one is shown to `look`, which ends the search by returning true. The number of steps
/// comes back with the last accepted point.
pub(crate) fn search(
    problem: &RefCell<Problem<'_>>,
    from: &[f64],
    most: usize,
    look: &mut dyn FnMut(&[f64]) -> bool,
) -> (Vec<f64>, usize) {
    let n = from.len();
    let counts = problem.borrow().counts();
    let facade = Facade { problem, lower: vec![0.0; n], upper: vec![1.0; n], counts };
    let solver = Slsqp::new().with_absolute_accuracy_tolerance(ACCURACY);
    let state = SelectedFirstOrderState::new(from.to_vec());
    let executor = Executor::new(facade, solver, state).max_iter(most as u64);
    let Ok(mut stepper) = executor.into_stepper() else { return (from.to_vec(), 0) };
    let mut last = from.to_vec();
    let mut steps = 0;
    while let Ok(outcome) = stepper.step() {
        let now = stepper.state().param();
        if stepper.iter() as usize > steps {
            steps = stepper.iter() as usize;
            last.clone_from(now);
            if look(&last) {
                break;
            }
        }
        if matches!(outcome, StepOutcome::Stopped(_)) {
            break;
        }
    }
    (last, steps)
}
