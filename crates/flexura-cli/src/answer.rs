//! What a study has to say, and how it gets to the screen and onto the disk.

use crate::arguments::{ModelArguments, ShownArguments};
use crate::commands::{file_failure, warn_about, warn_of_outputs};
use crate::failure::Failure;
use crate::files::{self, Growing};
use crate::interrupt;
use crate::shown::Shown;
use crate::{page, screen};
use flexura::Options;
use flexura::model::{Model, visible};
use flexura::modelfile::Document;
use flexura::output::{
    self, BucklingDocument, FitDocument, FormulaDocument, FrequenciesDocument, InverseDynamicsDocument,
    ModesDocument, OptimisationDocument, OptimisationHead, SceneDocument, TraceDocument, to_json,
};
use flexura::post::PostError;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// A model file that was read, and what is wanted of its studies.
pub struct Task {
    pub file: Document,
    pub model: Model,
    pub options: Options,
    pub folder: Option<PathBuf>,
    /// What is wanted by its name.
    pub shown: Shown,
    pub is_json: bool,
    pub is_quiet: bool,
}

impl Task {
    /// Makes the model of a file that was read.
    pub fn new(
        arguments: &ModelArguments,
        file: Document,
        (folder, shown): (Option<&Path>, &ShownArguments),
        tolerance: Option<f64>,
    ) -> Result<Self, Failure> {
        let model = file.model(&arguments.overrides).map_err(|report| file_failure(&report))?;
        let mut options = Options { interrupt: interrupt::listen(), ..Options::default() };
        if let Some(tolerance) = tolerance {
            options.tolerance = tolerance;
        }
        if let Some(folder) = folder {
            // Hours of work should not end at a folder that cannot be written into.
            files::probe(folder)?;
        }
        let folder = folder.map(Path::to_path_buf);
        let (is_json, is_quiet) = (arguments.json, arguments.quiet);
        let shown = Shown::new(shown, folder.is_some())?;
        if is_json || folder.is_some() || shown.wants_page() {
            options.shapes = SHAPE;
        }
        Ok(Self { file, model, options, folder, shown, is_json, is_quiet })
    }

    /// Refuses a page of a study that has no states of the mechanism.
    pub fn without_page(&self) -> Result<(), Failure> {
        match self.shown.wants_page() {
            true => Err(Failure::Input(
                "this study has no states of the mechanism for a page; write its picture: --svg FILE"
                    .to_owned(),
            )),
            false => Ok(()),
        }
    }

    /// Will anybody read the result document?
    pub fn wants_document(&self) -> bool {
        self.is_json || self.folder.is_some() || self.shown.is_wanted()
    }

    /// Are the files beside the document made, of which pictures are some?
    pub fn wants_files(&self) -> bool {
        self.folder.is_some() || self.shown.wants_picture()
    }

    /// The scene of a document tells the model file too.
    pub fn with_text(&self, mut answer: Answer) -> Answer {
        if let Some(scene) = answer.document.as_mut().and_then(StudyDocument::scene) {
            scene.text = Some(self.file.whole_text().into_owned());
        }
        answer
    }

    /// Writes the files, prints document or summary, tells the warnings, and ends as the study did.
    pub fn deliver(&self, answer: Answer) -> Result<(), Failure> {
        let is_interrupted = self.options.interrupt.is_raised();
        let mut answer = self.with_text(answer);
        // What has no room on the disk is shown nevertheless.
        let (written, unwritten) = match self.write(&mut answer, self.folder.as_deref()) {
            Ok(written) => (written, None),
            Err(failure) => (None, Some(failure)),
        };
        let text = match (&written, &answer.document) {
            (None, Some(document)) if self.shown.wants_page() => Some(json(document)?),
            _ => written.clone(),
        };
        let shown = self.shown.write(text.as_deref(), &answer.pictures()).err();
        let unwritten = unwritten.or(shown);
        if let Some(document) = answer.document.as_ref().filter(|_| self.is_json) {
            screen::print_table(&written.map_or_else(|| json(document), Ok)?)?;
        } else if !self.is_quiet {
            screen::print(&answer.summary)?;
        }
        if !self.is_quiet {
            warn_about(&self.file, &answer.warnings);
            warn_of_outputs(&self.file, &answer.without_value);
        }
        if let Some(failure) = unwritten {
            return Err(failure);
        }
        if !self.is_quiet {
            self.tell_files(&answer, self.folder.as_deref());
            self.shown.tell();
        }
        match answer.failure {
            // It may have been ended in what comes after the equilibrium.
            None if is_interrupted => {
                Err(Failure::Interrupted("interrupted; what was found is kept".to_owned()))
            }
            failure => failure.map_or(Ok(()), Err),
        }
    }

    /// Writes the files of an answer; the text of the document, if there is a folder.
    pub fn write(&self, answer: &mut Answer, folder: Option<&Path>) -> Result<Option<String>, Failure> {
        let (Some(folder), Some(document)) = (folder, &answer.document) else { return Ok(None) };
        let page = document.has_page().then_some(page::NAME);
        let names = answer.files.iter().map(|(name, _)| *name).chain(page).collect();
        let text = json(&Written { document, files: names })?;
        if let Some(name) = page {
            answer.files.push((name, self.shown.page_of(&text)?));
        }
        files::replace_all(folder, &text, &answer.files)?;
        answer.growing.take().into_iter().for_each(Growing::finish);
        Ok(Some(text))
    }

    /// Says which files were written.
    pub fn tell_files(&self, answer: &Answer, folder: Option<&Path>) {
        let (Some(folder), Some((last, names))) = (folder, answer.files.split_last()) else { return };
        let names: Vec<&str> =
            std::iter::once(files::RESULT).chain(names.iter().map(|(name, _)| *name)).collect();
        let folder = folder.to_string_lossy();
        screen::note(&format!("wrote {} and {} into {}", names.join(", "), last.0, visible(&folder)));
    }
}

/// Sections along each beam of the shapes between those states of a path that are kept whole.
const SHAPE: usize = 17;

/// What came out of a study.
pub struct Answer {
    /// The result document, where somebody wants it.
    pub document: Option<StudyDocument>,
    /// Further files by name, where a folder is given or a picture is wanted.
    pub files: Vec<(&'static str, String)>,
    /// What a person reads.
    pub summary: String,
    /// Outputs that have no value.
    pub without_value: Vec<PostError>,
    pub warnings: Vec<String>,
    /// Why it did not do what was asked.
    pub failure: Option<Failure>,
    /// The rows that were written on the way.
    pub growing: Option<Growing>,
}

impl Answer {
    /// Its pictures, as they are written into a folder.
    pub fn pictures(&self) -> Vec<String> {
        let drawn = self.files.iter().filter(|(name, _)| name.ends_with(".svg"));
        drawn.map(|(_, picture)| picture.clone()).collect()
    }
}

/// The result document of any study.
#[derive(Serialize)]
#[serde(untagged)]
pub enum StudyDocument {
    Solve(Box<output::Document>),
    Trace(Box<TraceDocument>),
    Buckling(Box<BucklingDocument>),
    Modes(Box<ModesDocument>),
    Frequencies(Box<FrequenciesDocument>),
    InverseDynamics(Box<InverseDynamicsDocument>),
    Fit(Box<FitDocument>),
    Formula(Box<FormulaDocument>),
    Optimise(Box<OptimisationDocument>),
}

/// A document on the disk knows which files stand beside it.
#[derive(Serialize)]
struct Written<'a> {
    #[serde(flatten)]
    document: &'a StudyDocument,
    files: Vec<&'static str>,
}

impl StudyDocument {
    /// Has it states of the mechanism, which a page can show?
    pub fn has_page(&self) -> bool {
        !matches!(self, StudyDocument::Frequencies(_) | StudyDocument::Fit(_) | StudyDocument::Formula(_))
    }

    /// What there is to draw.
    fn scene(&mut self) -> Option<&mut SceneDocument> {
        match self {
            StudyDocument::Solve(document) => Some(&mut document.scene),
            StudyDocument::Trace(document) => document.scene.as_mut(),
            StudyDocument::Buckling(document) => Some(&mut document.scene),
            StudyDocument::Modes(document) => Some(&mut document.scene),
            StudyDocument::InverseDynamics(document) => document.scene.as_mut(),
            StudyDocument::Frequencies(_) | StudyDocument::Fit(_) | StudyDocument::Formula(_) => None,
            StudyDocument::Optimise(document) => match &mut document.head {
                OptimisationHead::Solved(state) => Some(&mut state.scene),
                OptimisationHead::Empty { .. } => None,
            },
        }
    }
}

/// The text of a document.
pub fn json(document: &impl Serialize) -> Result<String, Failure> {
    to_json(document).map_err(|error| Failure::Machine(error.to_string()))
}

/// A result that holds a number which is none can only be one that did not converge, or a bug.
pub fn unwritable(failure: Option<Failure>, message: &str) -> Failure {
    match failure {
        Some(Failure::NotConverged(why)) => Failure::NotConverged(without_document(&why, message)),
        Some(Failure::Interrupted(why)) => Failure::Interrupted(without_document(&why, message)),
        _ => Failure::Machine(format!("{message}; this is a bug in flexura, please report it")),
    }
}

fn without_document(why: &str, message: &str) -> String {
    format!("{why}; there is no result document of where it broke off, for {message}")
}
