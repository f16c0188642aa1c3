//! The whole way from a model file to a result, in one call.

use crate::model::Model;
use crate::modelfile::{Document, Report};
use crate::output::{self, OutputError};
use crate::post::{self, Evaluation, OutputValue, Summary};
use crate::solution::Solution;
use crate::{Options, ProblemError};
use std::path::Path;

/// A model with its solution and what that means.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The model that was solved, overrides filled in.
    pub model: Model,
    /// What the solver returned.
    pub solution: Solution,
    /// Stresses and outputs, and why an output has no value; the solution's warnings tell of that too.
    pub evaluation: Evaluation,
}

impl Solved {
    /// The output of that name, if the model has one.
    pub fn output(&self, name: &str) -> Option<OutputValue> {
        self.evaluation.outputs.iter().find(|output| output.name == name).map(|output| output.value)
    }

    /// The output of that name, if the model has one and it is a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.output(name)? {
            OutputValue::Number(value) => Some(value),
            OutputValue::Vector(_) => None,
        }
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::Document, OutputError> {
        output::document(&self.model, &self.solution, &self.evaluation)
    }

    /// What a person wants to read.
    pub fn summary(&self) -> Summary {
        post::summarise(&self.model, &self.solution, &self.evaluation)
    }
}

/// Why there is no result at all. Not converging is none of these.
#[derive(Debug)]
pub enum Error {
    /// The file cannot be read, or something in it is wrong.
    File(Report),
    /// The file reads well but describes no solvable mechanism.
    Model(ProblemError),
}

impl std::fmt::Display for Error {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Error::File(report) => formatter.write_str(report.render(false).trim_end()),
            Error::Model(error) => write!(formatter, "{}: {} ({})", error.path, error.message, error.hint),
        }
    }
}

impl std::error::Error for Error {}

/// Reads a model file, overrides parameters (name, value with an optional unit) and solves it, forward or
/// inverse.
///
/// # Errors
/// [`Error`], when the file or the model is wrong. A solve that does not converge comes back as a solution
/// whose status says so.
pub fn solve_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    options: &Options,
) -> Result<Solved, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let (mut solution, model) = crate::solve_model(&model, options, &mut |_| {}).map_err(Error::Model)?;
    let evaluation = post::evaluate_each(&model, &solution);
    solution.warnings.extend(evaluation.without_value.iter().map(ToString::to_string));
    Ok(Solved { model, solution, evaluation })
}
