//! `flexura buckle FILE`

use super::{file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::BuckleArguments;
use crate::buckling_summary;
use crate::failure::Failure;
use flexura::Buckled;
use flexura::model::{BuckleStudy, StudyKind};
use flexura::modelfile::{Document, Flag};
use flexura::output::{OutputError, modes_csv, modes_svg};
use flexura::solution::Solution;

pub fn run(arguments: &BuckleArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let file = file.with_study("buckle", &flags(arguments)).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    match task.model.studies.last().map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Buckle(buckle))) => task.deliver(study(&task, name, buckle)?),
        _ => Err(Failure::Machine(
            "the flags made no study; this is a bug in flexura, please report it".into(),
        )),
    }
}

fn flags(arguments: &BuckleArguments) -> Vec<Flag> {
    let all = [("parameter", &arguments.parameter), ("at", &arguments.at), ("count", &arguments.count)];
    all.into_iter().filter(|(_, value)| value.is_some()).map(|(flag, value)| (flag, value.clone())).collect()
}

/// Critical loads of a file's model.
pub fn study(task: &Task, name: &str, study: &BuckleStudy) -> Result<Answer, Failure> {
    let buckled = Buckled::new(&task.model, study, &task.options)
        .map_err(|error| study_failure(&task.file, name, &error))?;
    let (model, buckling) = (&buckled.model, &buckled.buckling);

    let refused = |error: OutputError| unwritable(failure(&buckling.solution), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::Buckling(Box::new(buckled.document().map_err(refused)?)));
        if task.wants_files() {
            files.push(("modes.csv", modes_csv(model, buckling).map_err(refused)?));
            files.push(("shapes.svg", modes_svg(model, buckling)));
        }
    }
    Ok(Answer {
        document,
        files,
        summary: buckling_summary::render(model, study, buckling),
        without_value: buckled.evaluation.without_value.clone(),
        warnings: buckling.solution.warnings.clone(),
        failure: failure(&buckling.solution),
        growing: None,
    })
}

fn failure(solution: &Solution) -> Option<Failure> {
    let reason = solution.reason.as_deref().unwrap_or("the equilibrium could not be found");
    Failure::of(solution.status, Some(reason))
}
