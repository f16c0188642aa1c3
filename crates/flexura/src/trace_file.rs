//! The studies of a model file, from the file to what came out, in one call.

use crate::model::{BuckleStudy, Model, Study, StudyKind, TraceStudy};
use crate::modelfile::{Document, suggestion};
use crate::output::{self, OutputError, TraceView};
use crate::post::{self, Evaluation};
use crate::solution::{Buckling, Trace};
use crate::{Error, Family, ModelFamily, Options, ProblemError};
use std::path::Path;

/// A path of equilibria with what belongs to it.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The model, overrides filled in.
    pub model: Model,
    /// What was asked.
    pub study: TraceStudy,
    /// What came out.
    pub trace: Trace,
}

impl Traced {
    /// The trace as its outputs want it, such as [`output::trace_document`] and [`output::diagram_svg`].
    pub fn view(&self) -> TraceView<'_> {
        TraceView::new(&self.model, &self.study, &self.trace)
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::TraceDocument, OutputError> {
        output::trace_document(&self.view())
    }
}

/// Critical loads with what belongs to them.
#[derive(Clone, Debug)]
pub struct Buckled {
    /// The model at the equilibrium about which the problem was linearised.
    pub model: Model,
    /// What was asked.
    pub study: BuckleStudy,
    /// What came out.
    pub buckling: Buckling,
    /// Stresses and outputs of the equilibrium, and why an output has no value.
    pub evaluation: Evaluation,
}

impl Buckled {
    /// Critical loads of a model.
    ///
    /// # Errors
    /// The model describes no solvable mechanism.
    pub fn new(model: &Model, study: &BuckleStudy, options: &Options) -> Result<Self, ProblemError> {
        let buckling = crate::buckle(model, study, options)?;
        let model = match study.parameter {
            Some(parameter) => ModelFamily::new(model).model(&[(parameter, study.at)])?,
            None => model.clone(),
        };
        let evaluation = post::evaluate_each(&model, &buckling.solution);
        Ok(Self { model, study: *study, buckling, evaluation })
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::BucklingDocument, OutputError> {
        output::buckling_document(&self.model, &self.buckling, &self.evaluation)
    }
}

/// Reads a model file, overrides parameters (name, value with an optional unit) and follows the path of its study of that
/// name; None: of its first trace.
///
/// # Errors
/// [`Error`], when the file or the model is wrong, or has no such study. A path that could not be followed to its end comes
/// back with a status that says so.
pub fn trace_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    study: Option<&str>,
    options: &Options,
) -> Result<Traced, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let trace = |kind: &StudyKind| match kind {
        StudyKind::Trace(trace) => Some(trace.clone()),
        _ => None,
    };
    let study = chosen(&file, &model, study, "trace", trace)?;
    let trace = crate::trace(&model, &study, options, &mut |_| {}).map_err(Error::Model)?;
    Ok(Traced { model, study, trace })
}

/// Reads a model file, overrides parameters and finds the critical loads of its study of that name; None: of its first of
/// the kind `buckle`.
///
/// # Errors
/// As [`trace_file`].
pub fn buckle_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    study: Option<&str>,
    options: &Options,
) -> Result<Buckled, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let buckle = |kind: &StudyKind| match kind {
        StudyKind::Buckle(buckle) => Some(*buckle),
        _ => None,
    };
    let study = chosen(&file, &model, study, "buckle", buckle)?;
    Buckled::new(&model, &study, options).map_err(Error::Model)
}

/// The study of that name.
///
/// # Errors
/// There is none; the nearest name is told.
pub fn study_named<'m>(file: &Document, model: &'m Model, name: &str) -> Result<&'m Study, Error> {
    model.studies.iter().find(|study| study.name == name).ok_or_else(|| {
        let names: Vec<&str> = model.studies.iter().map(|study| study.name.as_str()).collect();
        let hint = suggestion(name, &names, "study");
        wrong(file, &format!("there is no study `{name}`"), &hint)
    })
}

pub(crate) fn chosen<T>(
    file: &Document,
    model: &Model,
    name: Option<&str>,
    kind: &str,
    pick: impl Fn(&StudyKind) -> Option<T>,
) -> Result<T, Error> {
    match name {
        Some(name) => pick(&study_named(file, model, name)?.kind)
            .ok_or_else(|| wrong(file, &format!("the study `{name}` is not of the kind `{kind}`"), "")),
        None => model.studies.iter().find_map(|study| pick(&study.kind)).ok_or_else(|| {
            let hint = format!("write a table [study.NAME] with `kind = \"{kind}\"`");
            wrong(file, &format!("the file has no study of the kind `{kind}`"), &hint)
        }),
    }
}

fn wrong(file: &Document, message: &str, hint: &str) -> Error {
    let hint = Some(hint).filter(|hint| !hint.is_empty());
    Error::File(file.report(vec![file.problem("study", message, hint)]))
}
