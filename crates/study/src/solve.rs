//! The equilibrium reached from rest under proportional load.

use flexura_equilibrium::{Equilibrium, Finish, ProblemError};
use flexura_model::{LoadId, Model};
use flexura_nonlinear::{Breakdown, NewtonEnd, PathEnd, PathOptions, PathWork, System, follow};
use flexura_solution::{Solution, Status};
use flexura_spatial::Vector3;

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

/// A model made ready for many solves: change a load, solve again from rest or from where it stands.
#[derive(Clone, Debug)]
pub struct Prepared {
    problem: Equilibrium,
    path: PathOptions,
}

/// What a solve came to, before anything is sampled.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
    /// Why it did not converge, and what to try.
    pub reason: Option<String>,
    /// Estimated largest error.
    pub error_estimate: f64,
    /// Load steps.
    pub path: PathWork,
}

/// Size of the first Newton correction up to which a known state counts as near.
const NEAR: f64 = 0.5;

/// √(F/EI) L beyond which a load is taken for a mistake.
const LARGEST_PHASE: f64 = 1e4;
/// Mesh accuracy of a second look at a path that seemed to end.
const CAREFUL_MESH: f64 = 1e-9;
/// How the second look is taken.
const CAREFUL_PATH: PathOptions = PathOptions {
    first_response: 0.4,
    largest_correction: 0.3,
    largest_contraction: 0.3,
    least_agreement: 0.7,
    largest_phase: 1.0,
    point_tolerance: 1e-4,
    largest_turning: 0.7,
    shortest_step: 1e-11,
    crossing_step: 1e-7,
    largest_deviation: 0.3,
    steps: 20_000,
};

impl Prepared {
    /// Prepares a model and checks that it is held.
    ///
    /// # Errors
    /// Names what is loose, held twice or without sound numbers.
    pub fn new(model: &Model) -> Result<Self, ProblemError> {
        let mut problem = Equilibrium::new(model)?;
        problem.check_held()?;
        Ok(Self { problem, path: PathOptions::default() })
    }

    /// The equations behind it.
    pub fn problem(&mut self) -> &mut Equilibrium {
        &mut self.problem
    }

    /// How carefully the path from rest is followed.
    pub fn path_options(&mut self) -> &mut PathOptions {
        &mut self.path
    }

    /// Changes a point load (N, N·m).
    pub fn set_point_load(&mut self, id: LoadId, force: Vector3<f64>, moment: Vector3<f64>) {
        self.problem.set_point_load(id, force, moment);
    }

    /// Assembles and factorises the tangent at the present state.
    ///
    /// # Errors
    /// The tangent has no inverse, or is not finite.
    pub fn linearise(&mut self) -> Result<(), Breakdown> {
        self.problem.linearise()
    }

    /// Puts the mechanism at rest.
    pub fn rest(&mut self) {
        self.problem.rest();
    }

    /// From rest to the full load, then to `tolerance`.
    pub fn solve(&mut self, tolerance: f64, progress: &mut dyn FnMut(Progress)) -> Outcome {
        self.problem.rest();
        let mut report =
            |load: f64, steps: usize| progress(Progress { load_fraction: load, load_steps: steps });
        if self.problem.phase(1.0) > LARGEST_PHASE {
            return Outcome {
                status: Status::IterationLimit,
                reason: Some(
                    "the load is more than a hundred million times EI/L²; check its unit and the section's dimensions"
                        .to_string(),
                ),
                error_estimate: f64::NAN,
                path: PathWork::default(),
            };
        }
        let (mut end, mut path) = follow(&mut self.problem, &self.path, &mut report);
        if let PathEnd::Stalled { load: before } = end {
            // A coarse mesh can end a path that the beam itself does not: look again with a fine one.
            self.problem.refine_path(CAREFUL_MESH);
            self.problem.rest();
            let mut again = follow(&mut self.problem, &CAREFUL_PATH, &mut report);
            self.problem.refine_path(f64::INFINITY);
            if matches!(again.0, PathEnd::Stalled { load } if load < before) {
                // It came less far: the first look is the better answer.
                self.problem.rest();
                again = follow(&mut self.problem, &self.path, &mut report);
            }
            (end, path) = (again.0, PathWork { refused: path.refused + again.1.refused, ..again.1 });
        }
        match end {
            PathEnd::Complete => self.finish(tolerance, path, f64::INFINITY),
            PathEnd::Stalled { load } => Outcome {
                status: Status::Stalled,
                reason: Some(format!(
                    "the path from rest ends at {:.4} % of the load, most likely at a fold (limit point) where the \
                     mechanism snaps; reduce the load, or drive the motion by a joint coordinate instead of a force",
                    100.0 * load
                )),
                error_estimate: f64::NAN,
                path,
            },
            PathEnd::StepLimit { load } => Outcome {
                status: Status::IterationLimit,
                reason: Some(format!(
                    "{} load steps led to {:.4} % of the load only; look for stiffnesses that are many orders of \
                     magnitude apart, or reduce the load",
                    path.taken + path.refused,
                    100.0 * load
                )),
                error_estimate: f64::NAN,
                path,
            },
            PathEnd::SingularAtRest => Outcome {
                status: Status::Singular,
                reason: Some("the unloaded mechanism has a motion without resistance".to_string()),
                error_estimate: f64::NAN,
                path,
            },
        }
    }

    /// From where it stands, which should be near, to `tolerance`; from rest if it is not near.
    pub fn solve_from_here(&mut self, tolerance: f64, progress: &mut dyn FnMut(Progress)) -> Outcome {
        self.problem.set_load(1.0);
        let outcome = self.finish(tolerance, PathWork { taken: 1, ..PathWork::default() }, NEAR);
        if outcome.status == Status::Converged {
            return outcome;
        }
        self.solve(tolerance, progress)
    }

    fn finish(&mut self, tolerance: f64, path: PathWork, nearest: f64) -> Outcome {
        let (status, reason, error_estimate) = match self.problem.finish(tolerance, nearest) {
            Finish::Done { error } => (Status::Converged, None, error),
            Finish::AccuracyLimit { error } => (
                Status::AccuracyLimit,
                Some(format!(
                    "an error of {error:.1e} is the best that double precision gives here; ask for a larger tolerance"
                )),
                error,
            ),
            Finish::Failed(NewtonEnd::Broken(Breakdown::Singular)) => (
                Status::Singular,
                Some("the tangent has no inverse at the full load: a fold or branch point".to_string()),
                f64::NAN,
            ),
            Finish::Failed(_) => (
                Status::Stalled,
                Some(
                    "the last corrections at the full load do not get smaller: the load is at a fold or so large that \
                     round-off rules; try slightly less load or a larger tolerance"
                        .to_string(),
                ),
                f64::NAN,
            ),
        };
        if let Some((joint, shift, turn)) = self.problem.open_loop() {
            let reason = format!(
                "the loop does not close: at {joint} its two sides are {shift:.3e} m and {:.3e} deg apart; free one of its \
                 joints, or correct the places and axes of those that the warning names",
                turn.to_degrees()
            );
            return Outcome { status: Status::Inconsistent, reason: Some(reason), error_estimate, path };
        }
        Outcome { status, reason, error_estimate, path }
    }

    /// The present state as a solution.
    pub fn solution(&mut self, outcome: &Outcome, samples: usize) -> Solution {
        let mut solution = self.problem.solution(samples);
        solution.status = outcome.status;
        solution.reason = outcome.reason.clone();
        solution.error_estimate = outcome.error_estimate;
        if let Some(load) = outcome.path.crossing {
            solution.warnings.push(format!(
                "the path from rest passes a branch point at {:.4} % of the load; the equilibrium found lies beyond it \
                 and may be unstable",
                100.0 * load
            ));
        }
        solution.work.load_steps = outcome.path.taken;
        solution.work.rejected_steps = outcome.path.refused;
        let counts = self.problem.counts();
        solution.work.newton_steps = counts.newton_steps;
        solution.work.factorisations = counts.factorisations;
        solution.work.residuals = counts.residuals;
        solution
    }
}

/// The equilibrium reached from rest under proportional load without passing a fold.
///
/// A solve that does not get there returns a solution too: its status says so, its state is the last point
/// that was reached.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn solve(
    model: &Model,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<Solution, ProblemError> {
    let mut prepared = Prepared::new(model)?;
    let outcome = prepared.solve(options.tolerance, progress);
    Ok(prepared.solution(&outcome, options.samples))
}
