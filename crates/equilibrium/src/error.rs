//! A model that describes no solvable mechanism.

/// What is wrong, where, and what to write instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct ProblemError {
    /// Key path of the culprit in the model's words ("body.slider", "beam.link.end").
    pub path: String,
    /// What is wrong, one sentence.
    pub message: String,
    /// What to write instead.
    pub hint: String,
}

impl ProblemError {
    /// An error with its place in the words of the model file, what is wrong, and what to do.
    pub fn new(path: impl Into<String>, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into(), hint: hint.into() }
    }
}
