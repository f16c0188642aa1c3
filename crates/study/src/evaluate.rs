//! A mechanism as a function of its parameters: outputs and their derivatives, warm from one set of values to the next.
//!
//! Fits, designs and response formulas ask for many neighbouring equilibria. [`Evaluator::at`] leads the state from
//! the last one; where none is near, or the mechanism is made of other parts than before, it starts from rest as a solve does.

use crate::family::ModelFamily;
use crate::{Outcome, Prepared};
use flexura_equilibrium::{Interrupt, ProblemError};
use flexura_model::{Issue, Model};
use flexura_nonlinear::System;
use flexura_solution::{Solution, Status};

/// What an equilibrium says of the outputs.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Whether there is one.
    pub status: Status,
    /// Why there is none.
    pub reason: Option<String>,
    /// The components of the model's outputs one after another, SI; None of those without a value.
    pub values: Vec<Option<f64>>,
    /// Parallel to the values, for each of the evaluator's parameters: d value / d parameter, SI; of an inverse
    /// problem while its targets are kept. None where there is no value beside. Empty where they were not asked for.
    pub slopes: Vec<Vec<Option<f64>>>,
    /// Estimated largest relative error of the state.
    pub error_estimate: f64,
}

/// Leads one mechanism through values of its parameters.
#[derive(Clone, Debug)]
pub struct Evaluator {
    prepared: Prepared,
    /// As it was led last.
    model: Model,
    parameters: Vec<usize>,
    tolerance: f64,
    interrupt: Interrupt,
    stands: bool,
    /// Is a way that is too long at once gone in parts, before it is gone from rest?
    goes_in_parts: bool,
}

/// The shortest part of such a way.
const SHORTEST: f64 = 1.0 / 64.0;

impl Evaluator {
    /// Makes a model ready; `parameters` are those by which derivatives will be wanted, positions in
    /// [`Model::parameters`].
    ///
    /// # Errors
    /// The model describes no solvable mechanism; a parameter decides of which parts it is made, or is one of its unknowns.
    pub fn new(model: &Model, parameters: &[usize], tolerance: f64) -> Result<Self, ProblemError> {
        for position in parameters {
            let Some(parameter) = model.parameters.get(*position) else {
                return Err(ProblemError::new("parameter", format!("there is no parameter {position}"), ""));
            };
            let path = format!("parameter.{}", parameter.name);
            if parameter.is_structural {
                let message =
                    "decides of which parts the mechanism is made: nothing leads from one value to the next";
                return Err(ProblemError::new(path, message, "solve at each value, as `flexura sweep` does"));
            }
            if model.unknowns.iter().any(|unknown| unknown.parameter == *position) {
                let message = "is found by every solve, so that nothing else can move it";
                return Err(ProblemError::new(path, message, "take it out of [unknown]"));
            }
        }
        let prepared = Prepared::new(model)?;
        let parameters = parameters.to_vec();
        let interrupt = Interrupt::default();
        let (stands, goes_in_parts) = (false, false);
        Ok(Self { prepared, model: model.clone(), parameters, tolerance, interrupt, stands, goes_in_parts })
    }

    /// Ends every solve early once this flag is raised.
    pub fn heed(&mut self, interrupt: &Interrupt) {
        self.interrupt = interrupt.clone();
        self.prepared.heed(interrupt);
    }

    /// Goes to values that are too far from the last ones in parts, so that it stays on the same branch of equilibria where it can. Each
    /// equilibrium then costs a copy of the last one.
    pub fn go_in_parts(&mut self) {
        self.goes_in_parts = true;
    }

    /// The parameters by which there are derivatives.
    pub fn parameters(&self) -> &[usize] {
        &self.parameters
    }

    /// Unknowns of its equations.
    pub fn unknowns(&self) -> usize {
        self.prepared.problem.unknowns()
    }

    /// The model as it was led last, with the values found for its unknown parameters.
    pub fn model(&self) -> &Model {
        self.prepared.model()
    }

    /// The next equilibrium is reached from rest.
    pub fn reset(&mut self) {
        self.stands = false;
    }

    /// Takes an equilibrium with these values (SI) that was found before, by a path for instance, as where the next one is reached
    /// from. Is it one?
    ///
    /// # Errors
    /// The values make no sound model.
    pub fn stand(&mut self, values: &[(usize, f64)], from: &Solution) -> Result<bool, ProblemError> {
        self.put(values)?;
        self.stands = self.prepared.solve_near(from, self.tolerance).is_some();
        Ok(self.stands)
    }

    /// The equilibrium with these values (SI) of parameters; others keep what they had last. Derivatives take some three
    /// solves' worth for each parameter.
    ///
    /// # Errors
    /// The values make no sound model. Where there is no equilibrium, the status says so.
    pub fn at(&mut self, values: &[(usize, f64)], derivatives: bool) -> Result<Evaluation, ProblemError> {
        let outcome = self.lead(values)?;
        self.stands = outcome.status == Status::Converged;
        let mut evaluation = Evaluation {
            status: outcome.status,
            reason: outcome.reason,
            values: Vec::new(),
            slopes: Vec::new(),
            error_estimate: outcome.error_estimate,
        };
        if !self.stands {
            return Ok(evaluation);
        }
        let failed = |evaluation: Evaluation, reason: String| {
            Ok(Evaluation { status: Status::Singular, reason: Some(reason), ..evaluation })
        };
        match self.prepared.outputs() {
            Ok(values) => evaluation.values = values,
            Err(error) => return failed(evaluation, error.to_string()),
        }
        if !derivatives {
            return Ok(evaluation);
        }
        match self.prepared.sensitivities(&mut ModelFamily::new(&self.model), &self.parameters) {
            Ok(found) => {
                let column = |parameter| found.parameters.iter().position(|known| *known == parameter);
                let columns: Vec<Option<usize>> = self.parameters.iter().map(|p| column(*p)).collect();
                let row = |row: &Vec<Option<f64>>| columns.iter().map(|column| row[(*column)?]).collect();
                evaluation.slopes = found.outputs.iter().flatten().map(row).collect();
                if let Some((parameter, reason)) = found.left_out.first() {
                    let name = &self.model.parameters[*parameter].name;
                    return failed(evaluation, format!("no derivatives by `{name}`: {reason}"));
                }
                Ok(evaluation)
            }
            Err(error) => failed(evaluation, error.to_string()),
        }
    }

    /// The equilibrium last found, as a solve tells it.
    pub fn solution(&mut self, samples: usize) -> Solution {
        let outcome = Outcome {
            status: if self.stands { Status::Converged } else { Status::Stalled },
            reason: None,
            ending: None,
            error_estimate: f64::NAN,
            path: flexura_nonlinear::PathWork::default(),
        };
        self.prepared.solution(&outcome, samples)
    }

    /// Puts the model with these values under the present state.
    fn put(&mut self, values: &[(usize, f64)]) -> Result<(), ProblemError> {
        let unsound =
            |issue: Issue| ProblemError::new(issue.path, issue.message, issue.hint.unwrap_or_default());
        if self.stands {
            // What was found last is where the next search begins.
            self.model.set(&self.prepared.unknown_values()).map_err(unsound)?;
        }
        self.model.set(values).map_err(unsound)?;
        if let Some(issue) = self.model.validate_beside(self.prepared.model()).into_iter().next() {
            return Err(unsound(issue));
        }
        if self.prepared.adopt(&self.model).is_err() {
            // Something appears, vanishes or meets: another system of equations.
            self.prepared = Prepared::new(&self.model)?;
            self.prepared.heed(&self.interrupt);
            self.stands = false;
        }
        Ok(())
    }

    fn lead(&mut self, values: &[(usize, f64)]) -> Result<Outcome, ProblemError> {
        if self.stands && self.goes_in_parts && self.model.unknowns.is_empty() {
            if let Some(outcome) = self.in_parts(values)? {
                return Ok(outcome);
            }
            self.stands = false;
        }
        self.put(values)?;
        let mut family = ModelFamily::new(&self.model);
        let (tolerance, idle) = (self.tolerance, &mut |_| {});
        Ok(match (self.stands, self.model.unknowns.is_empty()) {
            (true, true) => self.prepared.solve_from_here(tolerance, idle),
            (false, true) => self.prepared.solve(tolerance, idle),
            (true, false) => self.prepared.solve_inverse_from_here(&mut family, tolerance),
            (false, false) => self.prepared.solve_inverse(&mut family, tolerance, idle),
        })
    }

    /// From the equilibrium last found to these values along the straight line between the two, in steps that are near enough; None where
    /// it cannot be gone.
    fn in_parts(&mut self, values: &[(usize, f64)]) -> Result<Option<Outcome>, ProblemError> {
        let start: Vec<f64> = values.iter().map(|(p, _)| self.model.parameters[*p].value).collect();
        let (mut part, mut step) = (0.0_f64, 1.0_f64);
        while !self.prepared.problem.is_interrupted() {
            let next = if part + step > 1.0 - 1e-9 { 1.0 } else { part + step };
            let between = |(start, (p, end)): (&f64, &(usize, f64))| {
                // The end is met to the last bit.
                (*p, if next == 1.0 { *end } else { start + next * (end - start) })
            };
            let there: Vec<(usize, f64)> = start.iter().zip(values).map(between).collect();
            let kept = self.prepared.clone();
            self.put(&there)?;
            let outcome = self.stands.then(|| self.prepared.solve_near_here(self.tolerance));
            match outcome.filter(|outcome| outcome.status == Status::Converged) {
                Some(outcome) if next == 1.0 => return Ok(Some(outcome)),
                Some(_) => (part, step) = (next, 2.0 * step),
                None => {
                    self.prepared = kept;
                    self.stands = true;
                    step *= 0.5;
                    if step < SHORTEST {
                        break;
                    }
                }
            }
        }
        Ok(None)
    }
}
