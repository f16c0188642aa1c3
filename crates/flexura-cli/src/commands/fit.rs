//! `flexura fit FILE --data CSV --unknown P`

use super::{file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::FitArguments;
use crate::failure::Failure;
use crate::{files, fit_summary};
use flexura::model::{FitStudy, Model, StudyKind};
use flexura::modelfile::{Document, Flag, to_toml};
use flexura::output::{FitView, OutputError, fit_csv, fit_document, fit_svg};
use flexura::solution::Fit;
use flexura::{Error, study_named};

pub fn run(arguments: &FitArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let flags = flags(arguments)?;
    let is_typed = !flags.is_empty();
    if let (true, Some(study)) = (is_typed, &arguments.study) {
        return Err(Failure::Input(format!(
            "the study `{study}` says itself what is fitted to what; leave it out, or the flags"
        )));
    }
    let file = match is_typed {
        true => file.with_study("fit", &flags).map_err(|report| file_failure(&report))?,
        false => file,
    };
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    task.without_page()?;
    let found = match (&arguments.study, is_typed) {
        (Some(name), _) => Some(study_named(&task.file, &task.model, name).map_err(refused_study)?),
        (None, true) => task.model.studies.last(),
        (None, false) => task.model.studies.iter().find(|study| matches!(study.kind, StudyKind::Fit(_))),
    };
    match found.map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Fit(fit))) => {
            let (answer, fitted) = fitted(&task, name, fit)?;
            task.deliver(answer)?;
            match &arguments.write {
                Some(path) => files::replace(path, text_of(&fitted)?),
                None => Ok(()),
            }
        }
        Some((name, other)) => {
            Err(Failure::Input(format!("the study `{name}` is of the kind \"{}\", not \"fit\"", other.word())))
        }
        None => Err(Failure::Input(
            "the file has no study of the kind \"fit\"; say what is to be found and from what: --data FILE.csv --unknown PARAMETER"
                .to_owned(),
        )),
    }
}

fn refused_study(error: Error) -> Failure {
    match error {
        Error::File(report) => file_failure(&report),
        Error::Model(error) => Failure::Input(error.to_string()),
    }
}

fn text_of(model: &Model) -> Result<String, Failure> {
    to_toml(model).map_err(|issue| Failure::Input(format!("the model cannot be written: {}", issue.message)))
}

fn flags(arguments: &FitArguments) -> Result<Vec<Flag>, Failure> {
    let mut flags: Vec<Flag> = Vec::new();
    if let Some(data) = &arguments.data {
        // A file is looked for beside the model file; one that is typed, from here.
        let path = std::path::absolute(data)
            .map_err(|error| Failure::Input(format!("{}: {error}", data.to_string_lossy())))?;
        flags.push(("data", Some(path.to_string_lossy().into_owned())));
    }
    for (flag, values) in [
        ("unknown", &arguments.unknown),
        ("per-specimen", &arguments.per_specimen),
        ("bounds", &arguments.bounds),
        ("noise", &arguments.noise),
    ] {
        flags.extend(values.iter().map(|value| (flag, Some(value.clone()))));
    }
    for (flag, value) in [
        ("loss", &arguments.loss),
        ("intervals", &arguments.intervals),
        ("confidence", &arguments.confidence),
    ] {
        flags.extend(value.iter().map(|value| (flag, Some(value.clone()))));
    }
    if arguments.reject {
        flags.push(("reject", None));
    }
    Ok(flags)
}

/// A fit of a file's model.
pub fn study(task: &Task, name: &str, study: &FitStudy) -> Result<Answer, Failure> {
    fitted(task, name, study).map(|(answer, _)| answer)
}

fn fitted(task: &Task, name: &str, study: &FitStudy) -> Result<(Answer, Model), Failure> {
    let model = &task.model;
    let (fit, fitted) =
        flexura::fit(model, study, &task.options).map_err(|error| study_failure(&task.file, name, &error))?;
    let view = FitView { model, study, fit: &fit, fitted: &fitted };
    let refused = |error: OutputError| unwritable(failure(&fit), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::Fit(Box::new(fit_document(&view).map_err(refused)?)));
        if task.wants_files() {
            files.push(("residuals.csv", fit_csv(&view)));
            files.push(("fit.svg", fit_svg(&view)));
            // What no file can say is left out.
            files.extend(to_toml(&fitted).ok().map(|text| ("fitted.toml", text)));
        }
    }
    let answer = Answer {
        document,
        files,
        summary: fit_summary::render(&view),
        without_value: Vec::new(),
        warnings: fit.warnings.clone(),
        failure: failure(&fit),
        growing: None,
    };
    Ok((answer, fitted))
}

fn failure(fit: &Fit) -> Option<Failure> {
    let reason = fit.reason.as_deref().unwrap_or("no minimum was found");
    Failure::of(fit.status, Some(reason))
}
