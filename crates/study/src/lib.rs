//! What can be done with a model. Each study returns a `Solution`.

mod ending;
mod evaluate;
mod family;
mod inverse;
mod modes;
mod motion;
mod search;
mod sensitivity;
mod settle;
mod slope;
mod solve;
mod trace;
mod way;

pub use ending::Ending;
pub use evaluate::{Evaluation, Evaluator};
pub use family::{Family, ModelFamily};
pub use flexura_equilibrium::{Census, Equilibrium, Interrupt, Law, ProblemError};
pub use modes::{StateSpaceRequest, modes, modes_along, state_space};
pub use motion::{MotionProgress, inverse_dynamics, inverse_dynamics_family};
pub use search::equilibria;
pub use sensitivity::SensitivityError;
pub use solve::{Options, Outcome, Prepared, Progress, solve, solve_family, solve_model};
pub use trace::{TraceProgress, buckle, buckle_family, check_study, trace, trace_family};

use flexura_model::Model;

/// Counts unknowns against equations, and checks that the mechanism is held. No solve.
///
/// # Errors
/// Names what is loose, held twice or without sound numbers.
pub fn check(model: &Model) -> Result<Census, ProblemError> {
    let mut prepared = Prepared::new(model)?;
    Ok(prepared.problem().census())
}
