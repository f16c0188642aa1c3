//! The study: from all starts to the best design, and its front.

use crate::evaluate::Designs;
use crate::front;
use crate::problem::Problem;
use crate::search::Search;
use crate::starts::spread;
use flexura_model::{Model, OptimiseStudy, Study, StudyKind};
use flexura_solution::{Design, Optimisation, StartEnd, Status};
use flexura_study::{Options, ProblemError};
use std::cell::RefCell;

/// Solves are at least as accurate, so that the last steps of a search are not lost in their error.
const ACCURACY: f64 = 1e-10;
/// Designs at which an objective that does not change at the guess is tried.
const TRIED: usize = 4;
/// Relative difference at which the optimum, reached from rest, is another equilibrium.
const OTHER: f64 = 1e-6;

/// How far an optimisation has come.
#[derive(Clone, Copy, Debug)]
pub struct DesignProgress {
    /// Number of the start, from zero, and of how many; beyond them the front.
    pub start: usize,
    /// How many there are.
    pub starts: usize,
    /// Steps of this search.
    pub iteration: usize,
    /// Designs solved so far.
    pub evaluations: usize,
    /// The objective, SI.
    pub objective: f64,
    /// Largest relative miss of a condition.
    pub violation: f64,
}

/// Tells progress and counts steps.
pub(crate) struct Told<'m> {
    progress: &'m mut dyn FnMut(DesignProgress),
    start: usize,
    starts: usize,
    pub iterations: usize,
}

impl Told<'_> {
    pub fn tell(&mut self, iteration: usize, problem: &Problem<'_>, design: &Design) {
        (self.progress)(DesignProgress {
            start: self.start,
            starts: self.starts,
            iteration,
            evaluations: problem.designs.work.evaluations,
            objective: design.objective,
            violation: design.violation,
        });
    }
}

/// Searches the parameters that make an objective best. The model that comes back has their values.
///
/// Where no start leads to a design that meets all conditions, the one that misses them least comes back with the status
/// [`Status::Infeasible`].
///
/// # Errors
/// The model describes no solvable mechanism, the study does not fit it, or the objective does not change with the parameters.
pub fn optimise<'m>(
    model: &Model,
    study: &'m OptimiseStudy,
    options: &'m Options,
    progress: &'m mut dyn FnMut(DesignProgress),
) -> Result<(Optimisation, Model), ProblemError> {
    let named = Study { name: "study".to_string(), kind: StudyKind::Optimise(study.clone()) };
    if let Some(issue) = model.study_issues(&named).into_iter().next() {
        return Err(ProblemError::new("study", issue.message, issue.hint.unwrap_or_default()));
    }
    let sharp =
        Options { tolerance: options.tolerance.min(ACCURACY), sensitivities: false, ..options.clone() };
    let problem = RefCell::new(Problem::new(study, Designs::new(model, study, &sharp)?));
    let guess: Vec<f64> = study.vary.iter().map(|varied| varied.guess).collect();
    let mut points = vec![problem.borrow().point(&guess)];
    points.extend(spread(study.starts - 1, study.vary.len(), study.seed));
    refuse_idle(&problem, &points[0])?;

    let mut told = Told { progress, start: 0, starts: points.len(), iterations: 0 };
    let mut starts: Vec<StartEnd> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        told.start = i;
        let (end, _) = Search::new(&problem, &mut told).run(point, study.method);
        starts.push(end);
        if problem.borrow().designs.is_interrupted() {
            break;
        }
    }
    let (status, reason, best) = best_of(study, &starts);
    let mut warnings = Vec::new();
    let mut found = Vec::new();
    if let (Some(front), Some(first), Status::Converged) = (&study.front, &best, status) {
        told.start = told.starts;
        (found, warnings) = front::follow(&problem, &mut told, front, first);
    }
    let mut result = Optimisation {
        status: if options.interrupt.is_raised() { Status::Interrupted } else { status },
        reason,
        warnings,
        best,
        starts,
        front: found,
        left_out: Vec::new(),
        left_out_count: 0,
        work: Default::default(),
        solution: None,
    };
    let model = conclude(&mut result, &problem, model, options)?;
    let mut problem = problem.into_inner();
    result.left_out = std::mem::take(&mut problem.designs.left_out);
    result.left_out_count = problem.designs.left_out_count;
    result.work = problem.designs.work;
    result.work.iterations = told.iterations;
    if problem.designs.undecided {
        let warning = "the stability of some designs is not decided; they were not refused";
        result.warnings.push(warning.to_string());
    }
    Ok((result, model))
}

/// An objective that nothing changes has no best value.
fn refuse_idle(problem: &RefCell<Problem<'_>>, guess: &[f64]) -> Result<(), ProblemError> {
    let mut problem = problem.borrow_mut();
    if problem.is_idle(guess) != Some(true) {
        return Ok(());
    }
    // The guess may be where it is best.
    let beside = spread(TRIED, guess.len(), 1);
    if beside.iter().any(|point| problem.is_idle(point) == Some(false)) {
        return Ok(());
    }
    Err(ProblemError::new(
        "study",
        "the objective depends on no parameter that may change",
        "name another result, or let a parameter change that it depends on",
    ))
}

/// The best design of all starts that meets the conditions; else that which misses them least.
fn best_of(study: &OptimiseStudy, starts: &[StartEnd]) -> (Status, Option<String>, Option<Design>) {
    let sign = if study.maximise { -1.0 } else { 1.0 };
    let ended = || starts.iter().filter_map(|end| end.design.as_ref().map(|design| (end, design)));
    let meets = |design: &Design| design.violation <= study.tolerance;
    let best = ended()
        .filter(|(_, design)| meets(design))
        .min_by(|a, b| (sign * a.1.objective).total_cmp(&(sign * b.1.objective)));
    if let Some((end, design)) = best {
        return (end.status, end.reason.clone(), Some(design.clone()));
    }
    let least = ended().min_by(|a, b| a.1.violation.total_cmp(&b.1.violation));
    if let Some((end, design)) = least {
        let searches = if starts.len() == 1 { "the search" } else { "none of the searches" };
        let not = if starts.len() == 1 { "did not lead" } else { "led" };
        let reason = end.reason.clone().unwrap_or_default();
        let reason =
            format!("{searches} {not} to a design that meets all constraints; the nearest: {reason}");
        if end.status == Status::Interrupted {
            let reason = "interrupted before a design met all constraints; the nearest so far is kept";
            return (end.status, Some(reason.to_string()), Some(design.clone()));
        }
        return (Status::Infeasible, Some(reason), Some(design.clone()));
    }
    let first = starts.first();
    if let Some(interrupted) = starts.iter().find(|end| end.status == Status::Interrupted) {
        return (interrupted.status, interrupted.reason.clone(), None);
    }
    let reason = first.and_then(|end| end.reason.clone()).unwrap_or_default();
    let status = first.map_or(Status::Stalled, |end| end.status);
    (status, Some(format!("no start has values; the first: {reason}")), None)
}

/// The equilibrium of the best design, and whether it is the one that a solve reaches.
fn conclude(
    result: &mut Optimisation,
    problem: &RefCell<Problem<'_>>,
    model: &Model,
    options: &Options,
) -> Result<Model, ProblemError> {
    let Some(best) = &result.best else { return Ok(model.clone()) };
    let mut problem = problem.borrow_mut();
    let vary = problem.study.vary.iter().zip(&best.values);
    let values: Vec<(usize, f64)> = vary.map(|(varied, x)| (varied.parameter, *x)).collect();
    let design = model
        .at(&values)
        .map_err(|issue| ProblemError::new(issue.path, issue.message, issue.hint.unwrap_or_default()))?;
    let (solution, found) = flexura_study::solve_model(&design, options, &mut |_| {})?;
    if solution.status == Status::Converged {
        if let Some(numbers) = problem.designs.again_from_rest(&best.values) {
            let was = best.objective;
            if (numbers.values[0] - was).abs() > OTHER * was.abs() {
                result.warnings.push(format!(
                    "led from design to design, the mechanism is in another equilibrium than the one that a solve reaches from rest, \
                     where the objective is {:.6e}; give a guess nearer to the optimum",
                    numbers.values[0]
                ));
            }
        }
    } else if solution.status != Status::Interrupted {
        let reason = solution.reason.clone().unwrap_or_default();
        result
            .warnings
            .push(format!("the optimum has no equilibrium that a solve reaches from rest: {reason}"));
    }
    result.solution = Some(Box::new(solution));
    Ok(found)
}
