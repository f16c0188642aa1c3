//! What can be done with a model. Each study returns a `Solution`.

use flexura_model::Model;
use flexura_solution::Solution;

/// How a solve is to be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// Wanted accuracy, relative to L for lengths, 1 for rotations, EI/L² and EI/L for wrenches.
    pub tolerance: f64,
    /// Samples along each beam in the result, ends included.
    pub samples: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-8, samples: 101 }
    }
}

/// How far a study has come.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Fraction of the full load that is reached, 0 to 1.
    pub load_fraction: f64,
    /// Load steps so far.
    pub load_steps: usize,
}

/// A model that describes no solvable mechanism.
#[derive(Clone, Debug)]
pub struct ProblemError {
    /// Key path of the culprit in the model's words ("body.slider", "beam.link.end").
    pub path: String,
    /// What is wrong, one sentence.
    pub message: String,
    /// What to write instead.
    pub hint: String,
}

/// What the model is: unknowns against equations.
#[derive(Clone, Debug, Default)]
pub struct Census {
    /// What is unknown ("beam.link: wrench at its start") and how many numbers that is.
    pub unknowns: Vec<(String, usize)>,
    /// What must hold ("beam.link: clamp at its end") and how many equations that is.
    pub equations: Vec<(String, usize)>,
    /// Things a user should know.
    pub warnings: Vec<String>,
}

/// Counts unknowns against equations, and checks that the mechanism is held. No solve.
pub fn check(_model: &Model) -> Result<Census, ProblemError> {
    unimplemented!()
}

/// The equilibrium reached from rest under proportional load.
pub fn solve(
    _model: &Model,
    _options: &Options,
    _progress: &mut dyn FnMut(Progress),
) -> Result<Solution, ProblemError> {
    unimplemented!()
}
