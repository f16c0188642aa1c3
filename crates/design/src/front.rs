//! The compromises between two objectives: the first made best while the second is bounded, its bound led from one end to the other.

use crate::problem::{Goal, Problem};
use crate::search::Search;
use crate::study::Told;
use flexura_model::{Front, Optimiser};
use flexura_solution::{Design, Status};
use std::cell::RefCell;

/// Difference of the second objective, relative to its size, below which there is no front.
const SAME: f64 = 1e-6;

/// The front from the best of the first objective on, and what to say of it.
pub(crate) fn follow<'m>(
    problem: &RefCell<Problem<'m>>,
    told: &mut Told<'m>,
    front: &Front,
    first: &Design,
) -> (Vec<Design>, Vec<String>) {
    let mut warnings = Vec::new();
    let from = problem.borrow().point(&first.values);
    problem.borrow_mut().goal = Goal::Second;
    let (end, _) = Search::new(problem, told).run(&from, Optimiser::Sqp);
    problem.borrow_mut().goal = Goal::First;
    let Some(last) = end.design.filter(|_| end.status == Status::Converged) else {
        let reason = end.reason.unwrap_or_default();
        return (
            vec![first.clone()],
            vec![format!("there is no front, for the second objective has no optimum of its own: {reason}")],
        );
    };
    let (Some(a), Some(b)) = (first.other, last.other) else { return (vec![first.clone()], warnings) };
    if (a - b).abs() <= SAME * a.abs().max(b.abs()) {
        warnings.push("both objectives are best at the same design, so there is no compromise".to_string());
        return (vec![first.clone()], warnings);
    }
    let mut designs = vec![first.clone()];
    let mut near = from;
    for k in 1..front.points {
        let bound = a + (b - a) * k as f64 / (front.points - 1) as f64;
        problem.borrow_mut().goal = Goal::Under(bound);
        let (end, u) = Search::new(problem, told).run(&near, Optimiser::Sqp);
        let (mut status, mut design, mut reached, mut reason) = (end.status, end.design, u, end.reason);
        if status != Status::Converged {
            // From the other end.
            let from = problem.borrow().point(&last.values);
            let (end, u) = Search::new(problem, told).run(&from, Optimiser::Sqp);
            (status, design, reached, reason) = (end.status, end.design, u, end.reason);
        }
        match design.filter(|_| status == Status::Converged) {
            Some(design) => {
                designs.push(design);
                near = reached;
            }
            // At the far end the bound leaves nothing to be chosen, and that design is known.
            None if k + 1 == front.points => designs.push(last.clone()),
            None => warnings.push(format!(
                "the point of the front at {bound:.6e} was not found: {}",
                reason.unwrap_or_default()
            )),
        }
        if problem.borrow().designs.is_interrupted() {
            break;
        }
    }
    problem.borrow_mut().goal = Goal::First;
    (designs, warnings)
}
