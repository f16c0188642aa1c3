//! What a study has to say, and how it gets to the screen and onto the disk.

use crate::arguments::ModelArguments;
use crate::commands::{file_failure, warn_about};
use crate::failure::Failure;
use crate::screen;
use flexura::Options;
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{self, BucklingDocument, InverseDynamicsDocument, TraceDocument, to_json};
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};

/// A model file that was read, and what is wanted of its studies.
pub struct Task<'a> {
    pub file: Document,
    pub model: Model,
    pub overrides: &'a [(String, String)],
    pub options: Options,
    pub folder: Option<PathBuf>,
    pub is_json: bool,
    pub is_quiet: bool,
}

impl<'a> Task<'a> {
    /// Makes the model of a file that was read.
    pub fn new(
        arguments: &'a ModelArguments,
        file: Document,
        folder: Option<&Path>,
        tolerance: Option<f64>,
    ) -> Result<Self, Failure> {
        let overrides = &arguments.overrides;
        let model = file.model(overrides).map_err(|report| file_failure(&report))?;
        let mut options = Options::default();
        if let Some(tolerance) = tolerance {
            options.tolerance = tolerance;
        }
        let folder = folder.map(Path::to_path_buf);
        let (is_json, is_quiet) = (arguments.json, arguments.quiet);
        Ok(Self { file, model, overrides, options, folder, is_json, is_quiet })
    }

    /// Will anybody read the result document?
    pub fn wants_document(&self) -> bool {
        self.is_json || self.folder.is_some()
    }

    /// Writes the files, prints document or summary, tells the warnings, and ends as the study did.
    pub fn deliver(&self, answer: Answer) -> Result<(), Failure> {
        self.write(&answer, self.folder.as_deref())?;
        if let Some(document) = answer.document.as_ref().filter(|_| self.is_json) {
            screen::print(&json(document)?)?;
        } else if !self.is_quiet {
            screen::print(&answer.summary)?;
        }
        if !self.is_quiet {
            warn_about(&self.file, &answer.warnings);
            self.tell_files(&answer, self.folder.as_deref());
        }
        answer.failure.map_or(Ok(()), Err)
    }

    /// Writes the files of an answer.
    pub fn write(&self, answer: &Answer, folder: Option<&Path>) -> Result<(), Failure> {
        let (Some(folder), Some(document)) = (folder, &answer.document) else { return Ok(()) };
        let result = ("result.json", json(document)?);
        fs::create_dir_all(folder).map_err(|error| {
            Failure::Machine(format!("cannot make the folder {}: {error}", folder.display()))
        })?;
        for (name, text) in std::iter::once(&result).chain(&answer.files) {
            let path = folder.join(name);
            fs::write(&path, text)
                .map_err(|error| Failure::Machine(format!("cannot write {}: {error}", path.display())))?;
        }
        Ok(())
    }

    /// Says which files were written.
    pub fn tell_files(&self, answer: &Answer, folder: Option<&Path>) {
        let (Some(folder), Some((last, names))) = (folder, answer.files.split_last()) else { return };
        let names: Vec<&str> =
            std::iter::once("result.json").chain(names.iter().map(|(name, _)| *name)).collect();
        screen::note(&format!("wrote {} and {} into {}", names.join(", "), last.0, folder.display()));
    }
}

/// What came out of a study.
pub struct Answer {
    /// The result document, where somebody wants it.
    pub document: Option<StudyDocument>,
    /// Further files by name, where a folder is given.
    pub files: Vec<(&'static str, String)>,
    /// What a person reads.
    pub summary: String,
    pub warnings: Vec<String>,
    /// Why it did not do what was asked.
    pub failure: Option<Failure>,
}

/// The result document of any study.
#[derive(Serialize)]
#[serde(untagged)]
pub enum StudyDocument {
    Solve(Box<output::Document>),
    Trace(Box<TraceDocument>),
    Buckling(Box<BucklingDocument>),
    InverseDynamics(Box<InverseDynamicsDocument>),
}

/// The text of a document.
pub fn json(document: &impl Serialize) -> Result<String, Failure> {
    to_json(document).map_err(|error| Failure::Machine(error.to_string()))
}

/// A result that holds a number which is none can only be one that did not converge, or a bug.
pub fn unwritable(failure: Option<Failure>, message: &str) -> Failure {
    match failure {
        Some(failure @ Failure::NotConverged(_)) => failure,
        _ => Failure::Machine(format!("{message}; this is a bug in flexura, please report it")),
    }
}
