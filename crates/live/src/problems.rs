//! What is wrong with a text, with its place, for the page's editor.

use flexura::ProblemError;
use flexura::modelfile::{Document, Problem, Report, Severity};
use serde::Serialize;

/// One thing that is wrong, in the words of the command.
#[derive(Serialize)]
pub struct ProblemDocument {
    is_warning: bool,
    /// Line and column from 1; 0 where it is not in a line of the text.
    line: usize,
    column: usize,
    /// Positions in the text as JavaScript counts them.
    from: usize,
    to: usize,
    path: String,
    message: String,
    hint: Option<String>,
    /// As the command shows it.
    shown: String,
}

impl ProblemDocument {
    /// A problem; `text` is the model file, if that is where it stands.
    pub fn new(problem: &Problem, text: &str) -> Self {
        let is_typed = problem.file.starts_with("--");
        let units = |byte: usize| text.get(..byte).map_or(0, |before| before.encode_utf16().count());
        let place = |number: usize| if is_typed { 0 } else { number };
        Self {
            is_warning: problem.severity == Severity::Warning,
            line: place(problem.line),
            column: place(problem.column),
            from: if is_typed { 0 } else { units(problem.span.start) },
            to: if is_typed { 0 } else { units(problem.span.end) },
            path: problem.path.clone(),
            message: problem.message.clone(),
            hint: problem.hint.clone(),
            shown: problem.render(false),
        }
    }
}

/// Why nothing was done.
pub struct Trouble(pub Vec<ProblemDocument>);

impl Trouble {
    /// Without a place.
    pub fn plain(message: String) -> Self {
        Self(vec![ProblemDocument {
            is_warning: false,
            line: 0,
            column: 0,
            from: 0,
            to: 0,
            path: String::new(),
            shown: format!("error: {message}"),
            message,
            hint: None,
        }])
    }

    /// The text is wrong.
    pub fn of_report(report: &Report, text: &str) -> Self {
        Self(report.problems().iter().map(|problem| ProblemDocument::new(problem, text)).collect())
    }

    /// The text reads well, but what it describes makes no sense.
    pub fn of_model(file: &Document, error: &ProblemError) -> Self {
        let hint = Some(error.hint.as_str()).filter(|hint| !hint.is_empty());
        let problem = file.problem(&error.path, &error.message, hint);
        Self(vec![ProblemDocument::new(&problem, file.text())])
    }
}
