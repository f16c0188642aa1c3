//! Parameters from measurements.

use crate::least_squares::{LeastSquaresEnd, LeastSquaresOptions, Loss, Minimum, least_squares};
use crate::problem::{Place, Problem};
use crate::statistics::{Knowledge, student};
use crate::{profile, report, specimens};
use flexura_model::{FitLoss, FitStudy, Model, StudyKind};
use flexura_solution::{Estimate, Fit, FitWork, Status};
use flexura_study::{Options, ProblemError, check_study};
use nalgebra::DVector;

/// Relative step at which the search ends, and the part of a standard error that does as well.
const STEP: f64 = 1e-8;
const UNCERTAINTY: f64 = 1e-4;
/// Most steps of a search.
const STEPS: usize = 200;
/// Part of the wanted accuracy to which states are found: residuals are differences.
const FINER: f64 = 0.1;
/// Median of |r| to the standard deviation of a normal law, and passes over the scale of a loss that is estimated by it.
const MEDIAN: f64 = 1.482_602_218_505_602;
const PASSES: usize = 3;
/// Residuals below this part of what was measured are round-off, and tell nothing of specimens.
const ROUND_OFF: f64 = 1e-7;

/// Finds the unknown parameters of a study; returns them with the model that has those that are the same for all specimens.
///
/// Where some rows of the data have no equilibrium they are left out, each with its reason. A search that does not end at a minimum
/// returns what it has, with a status that says so.
///
/// # Errors
/// The study or the model makes no sense.
pub fn fit(model: &Model, study: &FitStudy, options: &Options) -> Result<(Fit, Model), ProblemError> {
    check_study(model, StudyKind::Fit(study.clone()))?;
    let problem = Problem::new(model, study, options.tolerance * FINER, &options.interrupt)?;
    let bounds = problem.bounds();
    let mut search = Search {
        problem,
        step: STEP.max(options.tolerance),
        bounds,
        loss: Loss::Squares,
        left_out: Vec::new(),
        iterations: 0,
    };
    let start = search.problem.start();
    let mut minimum = search.robust(&start);
    let mut verdicts = specimens::verdicts(&search.problem, &minimum, search.loss, &search.held(&minimum));
    if minimum.residuals.is_empty() || search.is_exact(&minimum) {
        verdicts.iter_mut().for_each(|verdict| verdict.distance = None);
    }
    let first = search.estimates(model, &minimum);
    if study.reject && verdicts.iter().any(specimens::is_outside) {
        minimum = search.without(&mut verdicts, &minimum);
    }
    let mut estimates = search.estimates(model, &minimum);
    for (estimate, first) in estimates.iter_mut().zip(first) {
        // What belongs to a rejected specimen alone stays as it was found.
        if estimate.specimen.is_some_and(|specimen| verdicts[specimen].is_rejected) {
            *estimate = first;
        }
    }
    let converged = minimum.end == LeastSquaresEnd::Converged;
    if study.profile && converged {
        profile::add(&mut search, &minimum, &mut estimates);
    }
    Ok(search.told(model, minimum, estimates, verdicts))
}

pub(crate) struct Search<'m> {
    pub problem: Problem<'m>,
    pub step: f64,
    pub bounds: Vec<[f64; 2]>,
    pub loss: Loss,
    pub left_out: Vec<(usize, String)>,
    pub iterations: usize,
}

impl Search<'_> {
    /// The minimum with the loss that was asked for, its scale by the noise, or by the residuals themselves.
    fn robust(&mut self, start: &DVector<f64>) -> Minimum {
        let mut minimum = self.minimum(start);
        let word = self.problem.study.loss;
        if word == FitLoss::Squares || minimum.residuals.is_empty() {
            return minimum;
        }
        let is_known = !self.problem.study.noise.is_empty();
        for _ in 0..if is_known { 1 } else { PASSES } {
            let unit =
                if is_known { 1.0 } else { MEDIAN * median(minimum.residuals.iter().map(|r| r.abs())) };
            if unit == 0.0 {
                break;
            }
            // 95 % of the efficiency of least squares where the noise is normal (Huber 1981; P. W. Holland, R. E. Welsch 1977).
            self.loss = match word {
                FitLoss::Squares => Loss::Squares,
                FitLoss::Huber => Loss::Huber(1.345 * unit),
                FitLoss::SoftL1 => Loss::SoftL1(1.345 * unit),
                FitLoss::Cauchy => Loss::Cauchy(2.385 * unit),
            };
            minimum = self.minimum(&minimum.x.clone());
        }
        minimum
    }

    /// The minimum over the rows that have an answer.
    pub fn minimum(&mut self, start: &DVector<f64>) -> Minimum {
        let mut x = start.clone();
        let mut again = !self.left_out.is_empty();
        loop {
            let minimum = self.once(&x);
            let failed = std::mem::take(&mut self.problem.failed);
            match minimum.end {
                LeastSquaresEnd::NoStart | LeastSquaresEnd::Stalled
                    if !failed.is_empty() && !self.problem.is_interrupted_now() =>
                {
                    for (row, reason) in failed {
                        self.problem.is_active[row] = false;
                        self.left_out.push((row, reason));
                    }
                    if !self.problem.is_active.contains(&true) {
                        return minimum;
                    }
                    x.clone_from(&minimum.x);
                    again = true;
                }
                LeastSquaresEnd::Converged if again => {
                    again = false;
                    // What failed on the way may have an answer at the end.
                    if !self.take_back(&minimum.x) {
                        return minimum;
                    }
                    x.clone_from(&minimum.x);
                }
                _ => return minimum,
            }
        }
    }

    fn once(&mut self, x: &DVector<f64>) -> Minimum {
        let options = LeastSquaresOptions {
            bounds: self.bounds.clone(),
            loss: self.loss,
            step: self.step,
            uncertainty: UNCERTAINTY,
            iterations: STEPS,
        };
        let minimum = least_squares(&mut self.problem, x, &options);
        self.iterations += minimum.iterations;
        minimum
    }

    fn take_back(&mut self, x: &DVector<f64>) -> bool {
        let rows: Vec<usize> = self.left_out.iter().map(|(row, _)| *row).collect();
        let answers = self.problem.answers(x, &rows, false);
        let mut any = false;
        for (row, answer) in rows.iter().zip(answers) {
            let Ok(answer) = answer else { continue };
            let computed = self.problem.computed(&answer);
            let measured = &self.problem.study.data.rows[*row].measured;
            if computed
                .iter()
                .zip(measured)
                .all(|(computed, measured)| measured.is_none() || computed.is_some())
            {
                self.problem.is_active[*row] = true;
                self.left_out.retain(|(left, _)| left != row);
                any = true;
            }
        }
        any
    }

    /// Which variables stand at a bound, or have no room between them.
    pub fn held(&self, minimum: &Minimum) -> Vec<bool> {
        let near = |x: f64, bound: f64| bound.is_finite() && (x - bound).abs() <= 1e-9 * (1.0 + bound.abs());
        let held = |(x, [low, high]): (&f64, &[f64; 2])| near(*x, *low) || near(*x, *high);
        minimum.x.iter().zip(&self.bounds).map(held).collect()
    }

    /// Are the residuals nothing beside what was measured?
    fn is_exact(&self, minimum: &Minimum) -> bool {
        let places = self.problem.places();
        let size = |place: &Place| {
            let value = self.problem.study.data.rows[place.row].measured[place.column].unwrap_or(0.0);
            (value / self.problem.unit_of(*place)).powi(2)
        };
        let sum: f64 = places.iter().map(size).sum();
        minimum.residuals.norm() <= ROUND_OFF * sum.sqrt()
    }

    /// The minimum without the specimens that lie outside; their own unknowns stay.
    fn without(&mut self, verdicts: &mut [flexura_solution::SpecimenFit], minimum: &Minimum) -> Minimum {
        for (row, measured) in self.problem.study.data.rows.iter().enumerate() {
            if specimens::is_outside(&verdicts[measured.specimen]) {
                self.problem.is_active[row] = false;
            }
        }
        verdicts.iter_mut().for_each(|verdict| verdict.is_rejected = specimens::is_outside(verdict));
        for (k, variable) in self.problem.variables.iter().enumerate() {
            if variable.specimen.is_some_and(|specimen| verdicts[specimen].is_rejected) {
                self.bounds[k] = [minimum.x[k]; 2];
            }
        }
        self.robust(&minimum.x.clone())
    }

    pub fn knowledge(&self, minimum: &Minimum) -> Option<Knowledge> {
        (!minimum.residuals.is_empty()).then(|| Knowledge::of(minimum, self.loss, &self.held(minimum)))?
    }

    /// The estimates with the intervals of the linearised problem.
    fn estimates(&self, model: &Model, minimum: &Minimum) -> Vec<Estimate> {
        let knowledge = self.knowledge(minimum);
        let held = self.held(minimum);
        let width = knowledge.as_ref().and_then(|k| student(self.problem.study.confidence, k.freedom));
        let variables = self.problem.variables.iter().enumerate();
        variables
            .map(|(k, variable)| {
                let value = minimum.x[k] * variable.size;
                let error = knowledge
                    .as_ref()
                    .filter(|knowledge| knowledge.freedom > 0 && knowledge.is_seen[k] && !held[k]);
                let standard_error = error.map(|known| known.covariance[(k, k)].sqrt() * variable.size);
                Estimate {
                    parameter: variable.parameter,
                    specimen: variable.specimen,
                    guess: model.parameters[variable.parameter].value,
                    value,
                    standard_error,
                    interval: standard_error
                        .zip(width)
                        .map(|(error, width)| [value - width * error, value + width * error]),
                    profile: None,
                    is_at_bound: held[k],
                }
            })
            .collect()
    }

    fn told(
        mut self,
        model: &Model,
        minimum: Minimum,
        estimates: Vec<Estimate>,
        specimens: Vec<flexura_solution::SpecimenFit>,
    ) -> (Fit, Model) {
        let knowledge = self.knowledge(&minimum);
        let (status, reason) = self.end(&minimum);
        let scatter = knowledge.as_ref().map_or(f64::NAN, |known| known.variance.sqrt());
        let unseen =
            knowledge.as_ref().map_or(Vec::new(), |known| report::unseen(&self.problem, &minimum, known));
        let correlation = report::correlation(&estimates, knowledge.as_ref(), &self.problem);
        let (rows, measured) = report::rows(&mut self.problem, &minimum, self.loss);
        let mut fitted = model.clone();
        let common: Vec<(usize, f64)> = estimates
            .iter()
            .filter(|estimate| estimate.specimen.is_none())
            .map(|estimate| (estimate.parameter, estimate.value))
            .collect();
        // What the search has solved with is sound.
        let _ = fitted.set(&common);
        let [solves, derivatives] = self.problem.solves();
        let spread = report::spread(&estimates, &specimens);
        let mut found = Fit {
            status,
            reason,
            warnings: Vec::new(),
            estimates,
            correlation,
            unseen,
            rows,
            left_out: self.left_out,
            specimens,
            spread,
            measured,
            scatter,
            is_relative: !self.problem.study.noise.is_empty(),
            freedom: knowledge.as_ref().map_or(0, |known| known.freedom),
            work: FitWork { iterations: self.iterations, solves, derivatives },
        };
        found.left_out.sort_by_key(|(row, _)| *row);
        found.warnings = report::warnings(model, self.problem.study, &found);
        (found, fitted)
    }

    fn end(&self, minimum: &Minimum) -> (Status, Option<String>) {
        let told = |status, reason: String| (status, Some(reason));
        match minimum.end {
            LeastSquaresEnd::Converged => (Status::Converged, None),
            LeastSquaresEnd::Interrupted => told(Status::Interrupted, "interrupted".to_string()),
            _ if self.problem.is_interrupted_now() => {
                told(Status::Interrupted, "interrupted".to_string())
            }
            LeastSquaresEnd::Exhausted => told(
                Status::IterationLimit,
                format!("{STEPS} steps lead to no minimum; give bounds, or a better first guess"),
            ),
            LeastSquaresEnd::Stalled => told(
                Status::Stalled,
                "no step makes the residuals smaller, though their derivatives say so: the model jumps there, or is less accurate \
                 than the data; ask for a smaller tolerance, or begin elsewhere"
                    .to_string(),
            ),
            LeastSquaresEnd::NoStart => {
                let first = self.left_out.first();
                let why = first.map_or(String::new(), |(row, reason)| {
                    format!(": {reason} (line {})", self.problem.study.data.rows[*row].line)
                });
                told(Status::Stalled, format!("at the first guess no row of the data has an answer{why}"))
            }
        }
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = values.collect();
    if all.is_empty() {
        return 0.0;
    }
    all.sort_by(f64::total_cmp);
    let middle = all.len() / 2;
    if all.len() % 2 == 1 { all[middle] } else { 0.5 * (all[middle - 1] + all[middle]) }
}
