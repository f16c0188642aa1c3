//! What can be done with a model. Each study returns a `Solution`.

mod family;
mod inverse;
mod motion;
mod search;
mod sensitivity;
mod solve;
mod trace;

pub use family::Family;
pub use flexura_equilibrium::{Census, Equilibrium, Interrupt, ProblemError};
pub use motion::{MotionProgress, inverse_dynamics};
pub use search::equilibria;
pub use sensitivity::SensitivityError;
pub use solve::{Options, Outcome, Prepared, Progress, solve, solve_family};
pub use trace::{TraceProgress, buckle, trace};

use flexura_model::Model;

/// Counts unknowns against equations, and checks that the mechanism is held. No solve.
///
/// # Errors
/// Names what is loose, held twice or without sound numbers.
pub fn check(model: &Model) -> Result<Census, ProblemError> {
    let mut problem = Equilibrium::new(model)?;
    problem.check_held()?;
    Ok(problem.census())
}
