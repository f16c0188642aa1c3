//! Known and unknown exchanged: parameters to be found so that results have wanted values.

use crate::Output;

/// A parameter that is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// Position in [`crate::Model::parameters`]; the model was built with the guess.
    pub parameter: usize,
    /// Range that must not be left, SI.
    pub range: Option<[f64; 2]>,
}

/// A result with a wanted value.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// What must have the value; its name is the text of the file, it has one formula.
    pub output: Output,
    /// The value, SI.
    pub value: f64,
}
