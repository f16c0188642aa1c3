//! Design optimisation of a model file, from the file to what came out.

use crate::model::{Model, OptimiseStudy, StudyKind};
use crate::modelfile::Document;
use crate::output::{self, DesignView, OutputError};
use crate::post::{self, Evaluation};
use crate::solution::{Optimisation, Status};
use crate::{DesignProgress, Error, Options, ProblemError};
use std::path::Path;

/// An optimisation with what belongs to it.
#[derive(Clone, Debug)]
pub struct Optimised {
    /// The model with the values of the best design.
    pub model: Model,
    /// What was asked.
    pub study: OptimiseStudy,
    /// What came out.
    pub result: Optimisation,
    /// Stresses and outputs of the best design's equilibrium; None where there is none.
    pub evaluation: Option<Evaluation>,
}

impl Optimised {
    /// Searches the best values of a model's parameters.
    ///
    /// # Errors
    /// The model describes no solvable mechanism, or the study does not fit it.
    pub fn new(
        model: &Model,
        study: &OptimiseStudy,
        options: &Options,
        progress: &mut dyn FnMut(DesignProgress),
    ) -> Result<Self, ProblemError> {
        let (mut result, model) = crate::optimise(model, study, options, progress)?;
        let evaluation = result.solution.as_ref().map(|solution| post::evaluate_each(&model, solution));
        if let (Some(solution), Some(evaluation)) = (&mut result.solution, &evaluation) {
            if solution.status == Status::Converged {
                solution.warnings.extend(post::large_strain(&model, solution, evaluation));
            }
            solution.warnings.extend(evaluation.without_value.iter().map(ToString::to_string));
        }
        Ok(Self { model, study: study.clone(), result, evaluation })
    }

    /// The optimisation as its outputs want it.
    pub fn view(&self) -> DesignView<'_> {
        DesignView {
            model: &self.model,
            study: &self.study,
            result: &self.result,
            evaluation: self.evaluation.as_ref(),
        }
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::OptimisationDocument, OutputError> {
        output::optimisation_document(&self.view())
    }

    /// The best value of a parameter that was varied, SI.
    pub fn value(&self, name: &str) -> Option<f64> {
        let best = self.result.best.as_ref()?;
        let is_it = |position: usize| self.model.parameters.get(position).is_some_and(|p| p.name == name);
        let place = self.study.vary.iter().position(|varied| is_it(varied.parameter))?;
        best.values.get(place).copied()
    }
}

/// Reads a model file, overrides parameters (name, value with an optional unit) and does its optimisation of that name; None: its
/// first of the kind `optimise`.
///
/// # Errors
/// [`Error`], when the file or the model is wrong, or has no such study. A search that found no design which meets all constraints
/// comes back with a status that says so.
pub fn optimise_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    study: Option<&str>,
    options: &Options,
) -> Result<Optimised, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let optimise = |kind: &StudyKind| match kind {
        StudyKind::Optimise(study) => Some(study.clone()),
        _ => None,
    };
    let study = crate::trace_file::chosen(&file, &model, study, "optimise", optimise)?;
    Optimised::new(&model, &study, options, &mut |_| {}).map_err(Error::Model)
}
