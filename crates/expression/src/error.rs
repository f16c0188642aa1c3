//! What is wrong with an expression, and where.

use std::ops::Range;

/// What is wrong with an expression, with the byte range in its text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong, one sentence.
    pub message: String,
    /// Where, as a byte range in the expression's text.
    pub span: Range<usize>,
    /// What to write instead, if there is a good guess.
    pub hint: Option<String>,
}

impl ExpressionError {
    /// An error without a hint.
    pub fn new(message: impl Into<String>, span: Range<usize>) -> Self {
        Self { message: message.into(), span, hint: None }
    }

    /// The same error with a hint.
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}
