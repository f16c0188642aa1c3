//! Paths of equilibria in one parameter.

use crate::{Family, Options, ProblemError};
use flexura_model::{BuckleStudy, Model, TraceStudy};
use flexura_solution::{Buckling, Trace};

/// How far a trace has come.
#[derive(Clone, Copy, Debug)]
pub struct TraceProgress {
    /// Number of the branch that is being followed.
    pub branch: usize,
    /// Points on it so far.
    pub points: usize,
    /// Value of the parameter at the last of them, SI.
    pub parameter: f64,
}

/// Follows equilibria.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn trace(
    _model: &Model,
    _family: &mut dyn Family,
    _study: &TraceStudy,
    _options: &Options,
    _progress: &mut dyn FnMut(TraceProgress),
) -> Result<Trace, ProblemError> {
    Err(ProblemError::new("study", "cannot be done", ""))
}

/// Critical loads of the linearised problem.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn buckle(
    _model: &Model,
    _family: &mut dyn Family,
    _study: &BuckleStudy,
    _options: &Options,
) -> Result<Buckling, ProblemError> {
    Err(ProblemError::new("study", "cannot be done", ""))
}
