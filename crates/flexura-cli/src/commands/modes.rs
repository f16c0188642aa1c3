//! `flexura modes FILE`

use super::{earlier, file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::ModesArguments;
use crate::failure::Failure;
use crate::progress::TraceMeter;
use crate::{frequencies_summary, modes_summary};
use flexura::Vibrated;
use flexura::model::{ModesPath, ModesStudy, StudyKind};
use flexura::modelfile::{Document, Flag};
use flexura::output::{
    OutputError, frequencies_csv, frequencies_document, frequencies_svg, vibration_csv, vibration_svg,
};
use flexura::solution::Solution;

pub fn run(arguments: &ModesArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let file = file.with_study("modes", &flags(arguments)).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let mut task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    if let Some(path) = &arguments.from {
        task.options.from = Some(Box::new(earlier::read(path, &task.model)?));
    }
    match task.model.studies.last().map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Modes(modes))) => {
            let answer = study(&task, name, modes)?;
            if !arguments.state_space.is_empty() && answer.failure.is_none() {
                super::state_space::write(&task, name, modes, arguments)?;
            }
            task.deliver(answer)
        }
        _ => Err(Failure::Machine(
            "the flags made no study; this is a bug in flexura, please report it".into(),
        )),
    }
}

fn flags(arguments: &ModesArguments) -> Vec<Flag> {
    let all = [
        ("count", &arguments.count),
        ("parameter", &arguments.parameter),
        ("range", &arguments.range),
        ("steps", &arguments.steps),
    ];
    let given =
        all.into_iter().filter(|(_, value)| value.is_some()).map(|(flag, value)| (flag, value.clone()));
    given.chain(arguments.at_rest.then_some(("at-rest", None))).collect()
}

/// Natural modes of a file's model.
pub fn study(task: &Task, name: &str, study: &ModesStudy) -> Result<Answer, Failure> {
    if let Some(path) = study.path {
        return along(task, name, study, path);
    }
    let vibrated = Vibrated::new(&task.model, study, &task.options, &mut |_| {})
        .map_err(|error| study_failure(&task.file, name, &error))?;
    let (model, modes) = (&vibrated.model, &vibrated.modes);

    let refused = |error: OutputError| unwritable(failure(&modes.solution), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::Modes(Box::new(vibrated.document().map_err(refused)?)));
        if task.wants_files() {
            files.push(("modes.csv", vibration_csv(model, modes).map_err(refused)?));
            files.push(("shapes.svg", vibration_svg(model, modes)));
        }
    }
    Ok(Answer {
        document,
        files,
        summary: modes_summary::render(model, modes),
        without_value: vibrated.evaluation.without_value.clone(),
        warnings: modes.solution.warnings.clone(),
        failure: failure(&modes.solution),
        growing: None,
    })
}

/// Frequencies along a path.
fn along(task: &Task, name: &str, study: &ModesStudy, path: ModesPath) -> Result<Answer, Failure> {
    let model = &task.model;
    let mut meter = TraceMeter::new(task.is_quiet, &model.parameters[path.parameter]);
    let found =
        flexura::modes_along(model, study, path, &task.options, &mut |progress| meter.update(&progress));
    meter.finish();
    let along = found.map_err(|error| study_failure(&task.file, name, &error))?;
    let trace = &along.trace;
    let failed =
        || Failure::of(trace.status, trace.reason.as_deref().or(Some("the path could not be followed")));
    let refused = |error: OutputError| unwritable(failed(), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        let own = frequencies_document(model, &along).map_err(refused)?;
        document = Some(StudyDocument::Frequencies(Box::new(own)));
        if task.wants_files() {
            files.push(("frequencies.csv", frequencies_csv(model, &along).map_err(refused)?));
            files.push(("frequencies.svg", frequencies_svg(model, &along)));
        }
    }
    Ok(Answer {
        document,
        files,
        summary: frequencies_summary::render(model, &along),
        without_value: Vec::new(),
        warnings: trace.warnings.clone(),
        failure: failed(),
        growing: None,
    })
}

fn failure(solution: &Solution) -> Option<Failure> {
    let reason = solution.reason.as_deref().unwrap_or("the equilibrium could not be found");
    Failure::of(solution.status, Some(reason))
}
