//! The sub-commands, one a file.

pub mod buckle;
pub mod check;
pub mod completions;
mod earlier;
pub mod examples;
pub mod fit;
pub mod formula;
pub mod materials;
pub mod modes;
pub mod motion;
pub mod optimise;
pub mod run;
pub mod schema;
pub mod solve;
mod state_space;
pub mod sweep;
pub mod trace;
pub mod verify;
pub mod view;

use crate::failure::Failure;
use crate::screen;
use flexura::ProblemError;
use flexura::modelfile::{Document, Report, ReportKind, Severity};
use flexura::post::PostError;

/// Anything that is wrong with a model file, as the command's end.
pub fn file_failure(report: &Report) -> Failure {
    let message = report.render(true);
    match report.kind() {
        ReportKind::Io => Failure::Machine(message),
        ReportKind::Input => Failure::Input(message),
    }
}

/// A file that reads well but describes no solvable mechanism: shown at the place that is to blame.
pub fn problem_failure(file: &Document, error: &ProblemError) -> Failure {
    let hint = Some(error.hint.as_str()).filter(|hint| !hint.is_empty());
    Failure::Input(file.problem(&error.path, &error.message, hint).render(true))
}

/// A study that cannot be done: what is wrong with the whole of it is shown at its own table or flags.
pub fn study_failure(file: &Document, name: &str, error: &ProblemError) -> Failure {
    if error.path != "study" {
        return problem_failure(file, error);
    }
    problem_failure(file, &ProblemError { path: format!("study.{name}"), ..error.clone() })
}

/// Outputs that have no value, each where the file asks for it.
pub fn warn_of_outputs(file: &Document, without_value: &[PostError]) {
    for error in without_value {
        let mut problem = file.problem(&format!("output.{}", error.output()), &error.to_string(), None);
        problem.severity = Severity::Warning;
        screen::note(problem.render(true).trim_end());
    }
}

/// What looks unintended in the file though it can be solved.
pub fn warn_about(file: &Document, warnings: &[String]) {
    for problem in file.warnings() {
        screen::note(problem.render(true).trim_end());
    }
    for warning in warnings {
        screen::warn(warning);
    }
}
