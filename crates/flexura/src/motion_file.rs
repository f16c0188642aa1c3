//! A motion in time of a model file, from the file to what came out.

use crate::model::{InverseDynamicsStudy, Model, StudyKind};
use crate::modelfile::Document;
use crate::output::{self, MotionView, OutputError};
use crate::solution::InverseDynamics;
use crate::{Error, Options};
use std::path::Path;

/// A motion in time with what belongs to it.
#[derive(Clone, Debug)]
pub struct Moved {
    /// The model, overrides filled in.
    pub model: Model,
    /// What was asked.
    pub study: InverseDynamicsStudy,
    /// What came out.
    pub motion: InverseDynamics,
}

impl Moved {
    /// The motion as its outputs want it, such as [`output::motion_csv`] and [`output::motion_svg`].
    pub fn view(&self) -> MotionView<'_> {
        motion_view(&self.model, &self.motion)
    }

    /// The result document.
    ///
    /// # Errors
    /// [`OutputError`] where the result holds a number that JSON cannot.
    pub fn document(&self) -> Result<output::InverseDynamicsDocument, OutputError> {
        output::motion_document(&self.view())
    }

    /// The output of that name over time, its components one after the other; None where it has no value at some time.
    pub fn output(&self, name: &str) -> Option<Vec<Vec<f64>>> {
        let position = self.model.outputs.iter().position(|output| output.name == name)?;
        self.motion.instants.iter().map(|instant| instant.outputs[position].clone()).collect()
    }

    /// The output of that name over time, if it is a number.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        let values = self.output(name)?;
        values.into_iter().map(|value| if let [number] = value[..] { Some(number) } else { None }).collect()
    }
}

/// A motion as its outputs want it.
pub fn motion_view<'a>(model: &'a Model, motion: &'a InverseDynamics) -> MotionView<'a> {
    MotionView { model, motion }
}

/// Reads a model file, overrides parameters (name, value with an optional unit) and moves it as its study of that name says; None:
/// its first of the kind `inverse_dynamics`.
///
/// # Errors
/// [`Error`], when the file or the model is wrong, or has no such study. A motion that could not be gone through to its end
/// comes back with a status that says so.
pub fn inverse_dynamics_file(
    path: impl AsRef<Path>,
    overrides: &[(String, String)],
    study: Option<&str>,
    options: &Options,
) -> Result<Moved, Error> {
    let file = Document::read(path.as_ref()).map_err(Error::File)?;
    let model = file.model(overrides).map_err(Error::File)?;
    let motion = |kind: &StudyKind| match kind {
        StudyKind::InverseDynamics(motion) => Some(motion.clone()),
        _ => None,
    };
    let study = crate::trace_file::chosen(&file, &model, study, "inverse_dynamics", motion)?;
    let motion = crate::inverse_dynamics(&model, &study, options, &mut |_| {}).map_err(Error::Model)?;
    Ok(Moved { model, study, motion })
}
