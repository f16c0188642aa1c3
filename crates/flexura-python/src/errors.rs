//! Problems as Python exceptions, which stand in `flexura/errors.py`.

use flexura::modelfile::{Document, Problem, Report, ReportKind};
use flexura::{Error, ProblemError};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Where messages find what they speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the lines of a file that the user wrote.
    Lines,
    /// In the words with which a model was built.
    Words,
}

/// What is wrong, before the interpreter's lock is held again.
pub enum Wrong {
    /// A file, a text or a value.
    Report(Box<Report>),
    /// A model that describes no solvable mechanism.
    Problem(ProblemError),
    /// Something that a study cannot do.
    Study(Box<Problem>),
    /// The same in a sentence.
    Told(String),
}

impl From<Report> for Wrong {
    fn from(report: Report) -> Self {
        Wrong::Report(Box::new(report))
    }
}

impl From<ProblemError> for Wrong {
    fn from(error: ProblemError) -> Self {
        Wrong::Problem(error)
    }
}

impl From<Error> for Wrong {
    fn from(error: Error) -> Self {
        match error {
            Error::File(report) => report.into(),
            Error::Model(error) => error.into(),
        }
    }
}

impl Wrong {
    /// A study of that name that cannot be done.
    pub fn of_study(file: &Document, name: &str, error: &ProblemError) -> Self {
        let path = if error.path == "study" { format!("study.{name}") } else { error.path.clone() };
        Wrong::Study(Box::new(file.problem(&path, &error.message, hint_of(error))))
    }

    /// As an exception; `file` is asked for the place of what concerns a finished model.
    pub fn raise(self, py: Python<'_>, file: &Document, place: Place) -> PyErr {
        match self {
            Wrong::Report(report) => of_report(py, &report, place),
            Wrong::Problem(error) => {
                let problem = file.problem(&error.path, &error.message, hint_of(&error));
                exception(py, "ModelError", &[problem], 0, place)
            }
            Wrong::Study(problem) => exception(py, "StudyError", &[*problem], 0, place),
            Wrong::Told(message) => study(message),
        }
    }
}

fn hint_of(error: &ProblemError) -> Option<&str> {
    Some(error.hint.as_str()).filter(|hint| !hint.is_empty())
}

/// A report as an exception.
pub fn of_report(py: Python<'_>, report: &Report, place: Place) -> PyErr {
    match report.kind() {
        ReportKind::Io => PyOSError::new_err(report.problems()[0].message.clone()),
        ReportKind::Input => exception(py, "ModelError", report.problems(), report.omitted(), place),
    }
}

/// A `StudyError` of one sentence.
pub fn study(message: String) -> PyErr {
    Python::attach(|py| raised(py, "StudyError", |class| class.call1((message,))))
}

/// A `FlexuraError` that should never be seen.
pub fn bug(message: &str) -> PyErr {
    let message = format!("{message}; this is a bug in flexura, please report it");
    Python::attach(|py| raised(py, "FlexuraError", |class| class.call1((message,))))
}

fn exception(py: Python<'_>, name: &str, problems: &[Problem], omitted: usize, place: Place) -> PyErr {
    raised(py, name, |class| {
        let list = PyList::empty(py);
        for problem in problems {
            list.append(dictionary(py, problem, place)?)?;
        }
        class.call_method1("of", (list, omitted))
    })
}

/// A problem as a dictionary.
pub fn dictionary<'py>(py: Python<'py>, problem: &Problem, place: Place) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    // An override stands in a text of its own, `name=value`.
    let given = problem.file == "--set";
    let in_file = place == Place::Lines && !given;
    let in_lines = in_file && problem.line > 0;
    let path = match problem.path.as_str() {
        "" if given => format!("parameter.{}", problem.value.split('=').next().unwrap_or_default()),
        path => path.to_owned(),
    };
    dictionary.set_item("path", path)?;
    dictionary.set_item("value", (!problem.value.is_empty()).then_some(&problem.value))?;
    dictionary.set_item("message", &problem.message)?;
    dictionary.set_item("hint", &problem.hint)?;
    dictionary.set_item("file", in_file.then_some(&problem.file))?;
    dictionary.set_item("line", in_lines.then_some(problem.line))?;
    dictionary.set_item("column", in_lines.then_some(problem.column))?;
    let text = in_file.then(|| problem.render(false).trim_end().to_owned());
    dictionary.set_item("text", text)?;
    Ok(dictionary)
}

fn raised<'py>(
    py: Python<'py>,
    name: &str,
    make: impl FnOnce(&Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>>,
) -> PyErr {
    let made =
        py.import("flexura.errors").and_then(|module| module.getattr(name)).and_then(|class| make(&class));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}
