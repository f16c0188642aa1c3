//! Critical loads of the problem linearised about an equilibrium.

use crate::{Family, Options, ProblemError};
use flexura_model::{BuckleStudy, Model};
use flexura_solution::Buckling;

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
