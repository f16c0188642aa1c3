//! `flexura trace FILE --parameter P --range A:B`

use super::{file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::TraceArguments;
use crate::failure::Failure;
use crate::files::{self, Growing};
use crate::progress::TraceMeter;
use crate::trace_summary;
use flexura::TraceProgress;
use flexura::model::{Model, StudyKind, TraceStudy};
use flexura::modelfile::{Document, Flag};
use flexura::output::TraceView;
use flexura::output::{
    OutputError, critical_csv, diagram_svg, path_csv, path_header, path_row, shapes_svg, trace_document,
};
use flexura::solution::Trace;
use std::path::Path;

pub fn run(arguments: &TraceArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let file = file.with_study("trace", &flags(arguments)).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    match task.model.studies.last().map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Trace(trace))) => {
            task.deliver(study(&task, name, trace, task.folder.as_deref())?)
        }
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

/// A path of equilibria of a file's model; while it is followed its points stand in `path.csv.partial` of the folder.
pub fn study(task: &Task, name: &str, study: &TraceStudy, folder: Option<&Path>) -> Result<Answer, Failure> {
    let model = &task.model;
    let mut meter = TraceMeter::new(task.is_quiet, &model.parameters[study.parameter]);
    let mut growing = folder.map(|folder| begin(folder, model, study)).transpose()?;
    let traced = flexura::trace(model, study, &task.options, &mut |progress| {
        meter.update(&progress);
        if let Some(growing) = &mut growing {
            growing.add(&rows(model, study, &progress));
        }
    });
    meter.finish();
    let trace = match traced {
        Ok(trace) => trace,
        Err(error) => {
            growing.into_iter().for_each(Growing::finish);
            return Err(study_failure(&task.file, name, &error));
        }
    };

    let refused = |error: OutputError| unwritable(failure(&trace), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        let view = TraceView::new(model, study, &trace);
        document = Some(StudyDocument::Trace(Box::new(trace_document(&view).map_err(refused)?)));
        if task.wants_files() {
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
        without_value: Vec::new(),
        warnings: trace.warnings.clone(),
        failure: failure(&trace),
        growing,
    })
}

fn begin(folder: &Path, model: &Model, study: &TraceStudy) -> Result<Growing, Failure> {
    files::make_folder(folder)?;
    Growing::begin(&folder.join("path.csv"), &path_header(model, study))
}

/// The points that are new. One that holds a number which is none is told in the end.
fn rows(model: &Model, study: &TraceStudy, progress: &TraceProgress<'_>) -> String {
    let first = progress.points - progress.found.len();
    let numbered = progress.found.iter().enumerate();
    let rows = numbered.map(|(i, point)| path_row(model, study, [progress.branch, first + i], point));
    rows.filter_map(Result::ok).collect()
}

fn failure(trace: &Trace) -> Option<Failure> {
    Failure::of(trace.status, trace.reason.as_deref())
}
