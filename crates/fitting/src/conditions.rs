//! One mechanism under many conditions: sets of values of its parameters, side by side on all cores.
//!
//! A condition that stands is led from its own last state, which depends on nothing but its own values, so that numbers depend
//! neither on their neighbours nor on how many threads share the work.

use flexura_model::Model;
use flexura_solution::Status;
use flexura_study::{Evaluator, Interrupt, ProblemError};
use rayon::prelude::*;

/// Unknowns of all conditions together up to which each keeps its state.
const KEPT: usize = 4_000_000;

/// What a condition says.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    /// Components of the outputs.
    pub values: Vec<Option<f64>>,
    /// By the evaluator's parameters; empty where they were not wanted.
    pub slopes: Vec<Vec<Option<f64>>>,
}

/// Conditions with the states in which they stand.
pub(crate) struct Conditions {
    base: Evaluator,
    states: Vec<Option<Box<Evaluator>>>,
    keep: bool,
    interrupt: Interrupt,
    pub solves: usize,
    pub derivatives: usize,
}

impl Conditions {
    /// `parameters` are those by which there are derivatives.
    pub fn new(
        model: &Model,
        parameters: &[usize],
        count: usize,
        tolerance: f64,
        interrupt: &Interrupt,
    ) -> Result<Self, ProblemError> {
        let mut base = Evaluator::new(model, parameters, tolerance)?;
        base.heed(interrupt);
        let keep = base.unknowns().saturating_mul(count) <= KEPT;
        let states = (0..count).map(|_| None).collect();
        Ok(Self { base, states, keep, interrupt: interrupt.clone(), solves: 0, derivatives: 0 })
    }

    /// Are answers still wanted?
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }

    /// The answers of some conditions, each with its values. Why there is none, where there is none.
    pub fn answers(
        &mut self,
        asked: &[(usize, Vec<(usize, f64)>)],
        derivatives: bool,
    ) -> Vec<Result<Answer, String>> {
        let mut evaluators: Vec<Box<Evaluator>> = Vec::with_capacity(asked.len());
        for (condition, _) in asked {
            evaluators.push(self.states[*condition].take().unwrap_or_else(|| Box::new(self.base.clone())));
        }
        let (interrupt, all) = (&self.interrupt, evaluators.par_iter_mut().zip(asked));
        let answers: Vec<Result<Answer, String>> = all
            .map(|(evaluator, (_, values))| {
                if interrupt.is_raised() {
                    return Err("interrupted".to_string());
                }
                answer(evaluator, values, derivatives)
            })
            .collect();
        self.solves += asked.len();
        self.derivatives += if derivatives { asked.len() } else { 0 };
        if self.keep {
            for ((condition, _), evaluator) in asked.iter().zip(evaluators) {
                self.states[*condition] = Some(evaluator);
            }
        }
        answers
    }
}

fn answer(evaluator: &mut Evaluator, values: &[(usize, f64)], derivatives: bool) -> Result<Answer, String> {
    let found = evaluator
        .at(values, derivatives)
        .map_err(|error| format!("{}: {}", error.path, error.message).trim_start_matches(": ").to_string())?;
    if found.status != Status::Converged {
        return Err(found.reason.unwrap_or_else(|| "no equilibrium was found".to_string()));
    }
    Ok(Answer { values: found.values, slopes: found.slopes })
}
