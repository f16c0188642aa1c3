//! Natural modes of a model file, in one call.

use crate::model::{Model, ModesStudy, StudyKind};
use crate::modelfile::Document;
use crate::output::{self, OutputError};
use crate::post::{self, Evaluation};
use crate::solution::Modes;
use crate::trace_file::chosen;
use crate::{Error, Options, ProblemError, Progress};
use std::path::Path;

/// Natural modes with what belongs to them.
#[derive(Clone, Debug)]
pub struct Vibrated {
    /// The model, overrides filled in.
    pub model: Model,
    /// What was asked.
    pub study: ModesStudy,
    /// What came out.
    pub modes: Modes,
    /// Stresses and outputs of the state, and why an output has no value.
    pub evaluation: Evaluation,
}

impl Vibrated {
    /// Natural modes of a model.
    ///
    /// # Errors
    /// The model describes no solvable mechanism, or nothing in it has a mass.
    pub fn new(
        model: &Model,
        study: &ModesStudy,
        options: &Options,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<Self, ProblemError> {
        let modes = crate::modes(model, study, options, progress)?;
        let evaluation = post::evaluate_each(model, &modes.solution);
        Ok(Self { model: model.clone(), study: *study, modes, evaluation })
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::ModesDocument, OutputError> {
        output::modes_document(&self.model, &self.modes, &self.evaluation)
    }
}

/// Reads a model file, overrides parameters (name, value with an optional unit) and finds the natural modes of its study of that
/// name; None: of its first of the kind `modes`.
///
/// # Errors
/// [`Error`], when the file or the model is wrong, or has no such study.
pub fn modes_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    study: Option<&str>,
    options: &Options,
) -> Result<Vibrated, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let modes = |kind: &StudyKind| match kind {
        StudyKind::Modes(modes) => Some(*modes),
        _ => None,
    };
    let study = chosen(&file, &model, study, "modes", modes)?;
    Vibrated::new(&model, &study, options, &mut |_| {}).map_err(Error::Model)
}
