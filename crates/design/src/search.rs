//! From one design to an optimum, or to where no step helps any more.

use crate::problem::{Goal, Problem};
use crate::study::Told;
use crate::{evolve, sqp};
use flexura_model::Optimiser;
use flexura_solution::{Bound, Design, StartEnd, Status, Step};
use std::cell::RefCell;

/// Searches that begin anew where the last one ended, before it counts as the end.
const ROUNDS: usize = 5;
/// Round-off and the differences behind the derivatives may leave this many times the tolerance of the gradient.
const SLACK: f64 = 100.0;

/// One search for the present goal.
pub(crate) struct Search<'s, 'm> {
    pub problem: &'s RefCell<Problem<'m>>,
    pub told: &'s mut Told<'m>,
    history: Vec<Step>,
    /// The design noted last.
    last: Option<Design>,
    used: usize,
}

impl<'s, 'm> Search<'s, 'm> {
    pub fn new(problem: &'s RefCell<Problem<'m>>, told: &'s mut Told<'m>) -> Self {
        Self { problem, told, history: Vec::new(), last: None, used: 0 }
    }

    /// Goes from a point of the box.
    pub fn run(mut self, from: &[f64], method: Optimiser) -> (StartEnd, Vec<f64>) {
        let values = self.problem.borrow().values(from);
        let first = self.problem.borrow_mut().judge(from);
        if let Some(design) = &first {
            self.note(design);
        }
        let mut u = from.to_vec();
        if method == Optimiser::CmaEs {
            u = self.evolve(&u);
        } else if first.is_none() {
            let reason =
                format!("its first design has no values: {}", self.problem.borrow().designs.last_reason());
            let status = if self.is_interrupted() { Status::Interrupted } else { Status::Stalled };
            let end =
                StartEnd { from: values, status, reason: Some(reason), design: None, history: self.history };
            return (end, u);
        }
        u = self.descend(u);
        let mut design = self.problem.borrow_mut().judge(&u);
        if design.is_none() && self.is_interrupted() {
            design = self.last.take();
        }
        let (status, reason) = self.verdict(design.as_ref());
        (StartEnd { from: values, status, reason, design, history: self.history }, u)
    }

    fn tolerance(&self) -> f64 {
        self.problem.borrow().study.tolerance
    }

    fn most(&self) -> usize {
        self.problem.borrow().study.most_iterations.saturating_sub(self.used)
    }

    fn is_interrupted(&self) -> bool {
        self.problem.borrow().designs.is_interrupted()
    }

    fn note(&mut self, design: &Design) {
        let step =
            Step { values: design.values.clone(), objective: design.objective, violation: design.violation };
        self.told.tell(self.used, &self.problem.borrow(), design);
        self.history.push(step);
        self.last = Some(design.clone());
    }

    fn evolve(&mut self, from: &[f64]) -> Vec<f64> {
        let problem = self.problem;
        let (seed, most) = (problem.borrow().study.seed, self.most());
        let mut shown = Vec::new();
        let (u, generations) = evolve::search(problem, from, seed, most, &mut |u| {
            if shown.last().is_none_or(|last: &Vec<f64>| last != u) {
                shown.push(u.to_vec());
            }
            problem.borrow().designs.is_interrupted()
        });
        for u in shown {
            let design = self.problem.borrow_mut().judge(&u);
            if let Some(design) = design {
                self.note(&design);
            }
        }
        self.told.iterations += generations;
        u
    }

    /// Steps by derivatives, again and again until nothing changes.
    fn descend(&mut self, mut u: Vec<f64>) -> Vec<f64> {
        for _ in 0..ROUNDS {
            let before = u.clone();
            u = self.steps(&u);
            if self.is_interrupted() || self.most() == 0 || self.is_optimum(&u, 1.0) {
                break;
            }
            let missed = self.problem.borrow_mut().judge(&u).map_or(0.0, |design| design.violation);
            let goal = self.problem.borrow().goal;
            if missed > self.tolerance() && matches!(goal, Goal::First | Goal::Second) {
                // The conditions first, by themselves.
                self.problem.borrow_mut().goal = Goal::Feasible;
                u = self.steps(&u);
                self.problem.borrow_mut().goal = goal;
            } else if before == u || self.is_optimum(&u, SLACK) {
                break;
            }
        }
        u
    }

    fn steps(&mut self, from: &[f64]) -> Vec<f64> {
        let (problem, tolerance, most) = (self.problem, self.tolerance(), self.most());
        let mut seen: Vec<Design> = Vec::new();
        let (u, steps) = sqp::search(problem, from, most, &mut |u| {
            let design = problem.borrow_mut().judge(u);
            let ends = design.as_ref().is_none_or(|design| is_met(design, tolerance, 1.0));
            seen.extend(design);
            ends || problem.borrow().designs.is_interrupted()
        });
        for design in &seen {
            self.used += 1;
            self.note(design);
        }
        self.told.iterations += steps;
        u
    }

    fn is_optimum(&self, u: &[f64], slack: f64) -> bool {
        let tolerance = self.tolerance();
        self.problem.borrow_mut().judge(u).is_some_and(|design| is_met(&design, tolerance, slack))
    }

    fn verdict(&self, design: Option<&Design>) -> (Status, Option<String>) {
        if self.is_interrupted() {
            return (Status::Interrupted, Some("interrupted".to_string()));
        }
        let Some(design) = design else {
            let reason = self.problem.borrow().designs.last_reason();
            return (Status::Stalled, Some(format!("its last design has no derivatives: {reason}")));
        };
        if is_met(design, self.tolerance(), SLACK) {
            return (Status::Converged, None);
        }
        if design.violation > self.tolerance() {
            return (Status::Infeasible, self.problem.borrow().missed(design));
        }
        if self.most() == 0 {
            let reason = "it met all conditions and was still getting better after `most_iterations` steps";
            return (Status::IterationLimit, Some(reason.to_string()));
        }
        let reason = format!(
            "no step makes it better, though the gradient is not balanced by what is active (to {:.1e} of its size): the \
             objective or a condition has a corner there, or designs beside it have no values",
            design.stationarity
        );
        (Status::Stalled, Some(reason))
    }
}

/// Does a design meet all conditions, and those of an optimum?
fn is_met(design: &Design, tolerance: f64, slack: f64) -> bool {
    design.violation <= tolerance && design.stationarity <= slack * tolerance
}

impl Problem<'_> {
    /// What a design misses most, in words.
    pub fn missed(&self, design: &Design) -> Option<String> {
        let (bound, miss) = self.most_missed(design)?;
        let (position, word, wanted) = match bound {
            Bound::Least(i) => (i, "at least", self.study.conditions[i].least),
            Bound::Most(i) => (i, "at most", self.study.conditions[i].most),
            Bound::Equals(i) => (i, "to be", self.study.conditions[i].equals),
            Bound::Lower(_) | Bound::Upper(_) | Bound::Other => return None,
        };
        let output = &self.study.conditions[position].reading.output;
        let with_unit = |value: f64| format!("{value:.6e} {}", output.unit).trim_end().to_string();
        Some(format!(
            "`{}` is {} where it is wanted {word} {}: missed by {:.3e} of its size",
            output.name,
            with_unit(design.conditions[position]),
            with_unit(wanted.unwrap_or(f64::NAN)),
            miss
        ))
    }
}
