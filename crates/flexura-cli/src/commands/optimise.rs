//! `flexura optimise FILE [STUDY]`

use super::{file_failure, problem_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::OptimiseArguments;
use crate::design_summary;
use crate::failure::Failure;
use crate::files;
use crate::progress::DesignMeter;
use flexura::model::{OptimiseStudy, StudyKind};
use flexura::modelfile::{Document, to_toml};
use flexura::output::{OutputError, front_csv, history_csv, shape_svg};
use flexura::solution::Optimisation;
use flexura::{Error, Optimised, study_named};
use std::path::Path;

pub fn run(arguments: &OptimiseArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    let (name, chosen) = chosen(&task, arguments.study.as_deref())?;
    let optimised = search(&task, &name, &chosen)?;
    if let Some(path) = arguments.write.as_deref().filter(|_| optimised.result.best.is_some()) {
        write(&optimised, path)?;
    }
    task.deliver(answer(&task, &optimised)?)
}

/// The study of that name, or the first of its kind.
fn chosen(task: &Task, name: Option<&str>) -> Result<(String, OptimiseStudy), Failure> {
    let wrong = |message: &str, hint: Option<&str>| {
        Failure::Input(task.file.problem("study", message, hint).render(true))
    };
    let Some(name) = name else {
        let found = task.model.studies.iter().find_map(|study| match &study.kind {
            StudyKind::Optimise(design) => Some((study.name.clone(), design.clone())),
            _ => None,
        });
        let hint = "write a table [study.NAME] with `kind = \"optimise\"`, an objective and what may change";
        return found.ok_or_else(|| wrong("the file has no study of the kind `optimise`", Some(hint)));
    };
    let study = study_named(&task.file, &task.model, name).map_err(|error| match error {
        Error::File(report) => file_failure(&report),
        Error::Model(error) => problem_failure(&task.file, &error),
    })?;
    match &study.kind {
        StudyKind::Optimise(design) => Ok((study.name.clone(), design.clone())),
        _ => Err(wrong(&format!("the study `{name}` is not of the kind `optimise`"), None)),
    }
}

/// An optimisation of a file's model.
pub fn study(task: &Task, name: &str, study: &OptimiseStudy) -> Result<Answer, Failure> {
    answer(task, &search(task, name, study)?)
}

fn search(task: &Task, name: &str, study: &OptimiseStudy) -> Result<Optimised, Failure> {
    let mut meter = DesignMeter::new(task.is_quiet, &study.objective.output);
    let optimised =
        Optimised::new(&task.model, study, &task.options, &mut |progress| meter.update(&progress));
    meter.finish();
    optimised.map_err(|error| study_failure(&task.file, name, &error))
}

fn answer(task: &Task, optimised: &Optimised) -> Result<Answer, Failure> {
    let result = &optimised.result;
    let refused = |error: OutputError| unwritable(failure(result), &error.to_string());
    let mut document = None;
    let mut tables = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::Optimise(Box::new(optimised.document().map_err(refused)?)));
        if task.wants_files() {
            let view = optimised.view();
            tables.push(("history.csv", history_csv(&view).map_err(refused)?));
            tables.extend(front_csv(&view).map_err(refused)?.map(|text| ("front.csv", text)));
            tables.extend(result.solution.as_ref().map(|s| ("shape.svg", shape_svg(&optimised.model, s))));
        }
    }
    let mut warnings = result.warnings.clone();
    warnings.extend(result.solution.iter().flat_map(|solution| solution.warnings.clone()));
    Ok(Answer {
        document,
        files: tables,
        summary: design_summary::render(optimised),
        without_value: Vec::new(),
        warnings,
        failure: failure(result),
        growing: None,
    })
}

/// The model at the optimum as a file.
fn write(optimised: &Optimised, path: &Path) -> Result<(), Failure> {
    let text = to_toml(&optimised.model)
        .map_err(|issue| Failure::Machine(format!("{}: {}", issue.path, issue.message)))?;
    files::replace(path, text.as_bytes())
}

fn failure(result: &Optimisation) -> Option<Failure> {
    Failure::of(result.status, result.reason.as_deref())
}
