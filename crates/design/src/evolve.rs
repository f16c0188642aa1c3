//! An evolution strategy over the box, for landscapes that derivatives get lost in.

use crate::problem::Problem;
use basin::{
    BoundedCmaEs, BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, DenseMatrix,
    Executor, PopulationProgress, StepOutcome,
};
use std::cell::RefCell;
use std::convert::Infallible;

/// First standard deviation, in ranges, and the one at which the search has come together.
const SPREAD: f64 = 0.3;
const TOGETHER: f64 = 1e-4;
/// What a relative miss of one costs.
const PENALTY: f64 = 1e2;
/// By how much a design without values is worse than the worst with values.
const WORSE: f64 = 1e3;

struct Facade<'p, 'm> {
    problem: &'p RefCell<Problem<'m>>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    best: &'p RefCell<Option<Best>>,
}

/// The least cost and where.
type Best = (f64, Vec<f64>);

impl Constraints for Facade<'_, '_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;
    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl CostFunction for Facade<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;
    fn cost(&self, u: &Vec<f64>) -> Result<f64, Infallible> {
        let mut problem = self.problem.borrow_mut();
        let Some(scaled) = problem.at(u, false) else { return Ok(problem.worst + WORSE) };
        let cost = scaled.f + PENALTY * problem.violation(&scaled.numbers);
        let mut best = self.best.borrow_mut();
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            *best = Some((cost, u.clone()));
        }
        Ok(cost)
    }
}

/// The best point that was met, and the number of generations. `look` ends the search by returning true.
pub(crate) fn search(
    problem: &RefCell<Problem<'_>>,
    from: &[f64],
    seed: u64,
    most: usize,
    look: &mut dyn FnMut(&[f64]) -> bool,
) -> (Vec<f64>, usize) {
    let n = from.len();
    let best: RefCell<Option<Best>> = RefCell::new(None);
    let facade = Facade { problem, lower: vec![0.0; n], upper: vec![1.0; n], best: &best };
    let solver = BoundedCmaEs::<Vec<f64>, DenseMatrix>::new(seed, SPREAD)
        .with_lambda(8 + 2 * n)
        .with_absolute_distribution_size_tolerance(TOGETHER);
    let state = PopulationProgress::<Vec<f64>>::from_point(from.to_vec());
    let executor = Executor::new(facade, solver, state).max_iter(most as u64);
    let Ok(mut stepper) = executor.into_stepper() else { return (from.to_vec(), 0) };
    let met = || best.borrow().as_ref().map_or_else(|| from.to_vec(), |(_, u)| u.clone());
    let mut generations = 0;
    while let Ok(outcome) = stepper.step() {
        if stepper.iter() as usize > generations {
            generations = stepper.iter() as usize;
            if look(&met()) {
                break;
            }
        }
        if matches!(outcome, StepOutcome::Stopped(_)) {
            break;
        }
    }
    (met(), generations)
}
