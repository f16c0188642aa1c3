//! `flexura trace FILE --parameter P --range A:B`

use super::{file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::TraceArguments;
use crate::failure::Failure;
use crate::progress::TraceMeter;
use crate::trace_summary;
use flexura::model::{StudyKind, TraceStudy};
use flexura::modelfile::{Document, Flag};
use flexura::output::{OutputError, critical_csv, diagram_svg, path_csv, shapes_svg, trace_document};
use flexura::solution::{Status, Trace};
use flexura::{FileFamily, trace_view};

pub fn run(arguments: &TraceArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let file = file.with_study("trace", &flags(arguments)).map_err(|report| file_failure(&report))?;
    let task = Task::new(&arguments.model, file, arguments.output.as_deref(), arguments.tolerance)?;
    match task.model.studies.last().map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Trace(trace))) => task.deliver(study(&task, name, trace)?),
        _ => Err(Failure::Machine(
            "the flags made no study; this is a bug in flexura, please report it".into(),
        )),
    }
}

fn flags(arguments: &TraceArguments) -> Vec<Flag> {
    let mut flags: Vec<Flag> =
        vec![("parameter", Some(arguments.parameter.clone())), ("range", Some(arguments.range.clone()))];
    let single = [
        ("start", &arguments.start),
        ("steps", &arguments.steps),
        ("most-points", &arguments.most_points),
        ("guesses", &arguments.guesses),
        ("imperfection", &arguments.imperfection),
        ("critical", &arguments.critical),
        ("critical-number", &arguments.critical_number),
    ];
    flags.extend(
        single.into_iter().filter(|(_, value)| value.is_some()).map(|(flag, value)| (flag, value.clone())),
    );
    flags.extend(arguments.branches.iter().map(|value| ("branches", value.clone())));
    flags.extend(arguments.event.iter().map(|value| ("event", Some(value.clone()))));
    flags.extend(arguments.stop.iter().map(|value| ("stop", Some(value.clone()))));
    flags
}

/// A path of equilibria of a file's model.
pub fn study(task: &Task<'_>, name: &str, study: &TraceStudy) -> Result<Answer, Failure> {
    let model = &task.model;
    let mut family = FileFamily::new(&task.file, task.overrides, model);
    let mut meter = TraceMeter::new(task.is_quiet, &model.parameters[study.parameter]);
    let traced =
        flexura::trace(model, &mut family, study, &task.options, &mut |progress| meter.update(progress));
    meter.finish();
    let trace = traced.map_err(|error| study_failure(&task.file, name, &error))?;

    let refused = |error: OutputError| unwritable(failure(&trace), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        let view = trace_view(model, study, &trace, &mut family);
        document = Some(StudyDocument::Trace(Box::new(trace_document(&view).map_err(refused)?)));
        if task.folder.is_some() {
            files.push(("path.csv", path_csv(&view).map_err(refused)?));
            files.extend(critical_csv(&view).map_err(refused)?.map(|text| ("critical.csv", text)));
            files.push(("diagram.svg", diagram_svg(&view)));
            files.push(("shapes.svg", shapes_svg(&view)));
        }
    }
    Ok(Answer {
        document,
        files,
        summary: trace_summary::render(model, study, &trace),
        warnings: trace.warnings.clone(),
        failure: failure(&trace),
    })
}

fn failure(trace: &Trace) -> Option<Failure> {
    if trace.status == Status::Converged {
        return None;
    }
    let word = trace.status.word().replace('_', " ");
    Some(Failure::NotConverged(match &trace.reason {
        Some(reason) => format!("not converged, {word}: {reason}"),
        None => format!("not converged, {word}"),
    }))
}
