//! The equilibrium reached from rest under proportional load.

use crate::family::Family;
use crate::inverse::Border;
use flexura_equilibrium::{Equilibrium, Finish, ProblemError, Stability};
use flexura_model::{BeamPoint, LoadId, Model, Output, ProbeTarget, Quantity};
use flexura_nonlinear::{Breakdown, NewtonEnd, PathEnd, PathOptions, PathWork, System, follow};
use flexura_solution::{Solution, Status};
use flexura_spatial::Vector3;

/// How a solve is to be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// Wanted accuracy, relative to L for lengths, 1 for rotations, EI/L² and EI/L for wrenches.
    pub tolerance: f64,
    /// Samples along each beam in the result, ends included; fewer in networks of hundreds of beams, so that a result holds
    /// some ten thousands of them.
    pub samples: usize,
    /// Bodies and places on beams whose compliance is wanted, besides those that outputs name.
    pub compliances: Vec<ProbeTarget>,
    /// Derivatives of all outputs with respect to all parameters.
    pub sensitivities: bool,
    /// An earlier result to start from, of this or a neighbouring model, in place of the rest state.
    pub from: Option<Box<Solution>>,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-8, samples: 101, compliances: Vec::new(), sensitivities: false, from: None }
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
    pub(crate) problem: Equilibrium,
    pub(crate) path: PathOptions,
    /// Derivatives along the unknown parameters, from the last correction of an inverse problem.
    pub(crate) border: Option<Border>,
}

/// What a light solution is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum What {
    Targets,
    Both,
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

/// The same for a result that a user names as the start.
const NEAR_RESULT: f64 = 2.0;

/// Samples of all beams together, and of each at least.
const MOST_SAMPLES: usize = 30_000;
const FEWEST_SAMPLES: usize = 5;

/// Why an equilibrium may have no verdict though its mechanism has an energy.
pub(crate) const CRITICAL: &str = "the equilibrium is critical: a direction gives way without resistance";

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
        Self::with_probes(model, &[])
    }

    /// The same, with places on beams whose compliance will be asked for.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn with_probes(model: &Model, probes: &[BeamPoint]) -> Result<Self, ProblemError> {
        let mut problem = Equilibrium::with_probes(model, probes)?;
        problem.check_held()?;
        Ok(Self { problem, path: PathOptions::default(), border: None })
    }

    /// The model as it stands: of an inverse problem with the values found.
    pub fn model(&self) -> &Model {
        self.problem.model()
    }

    /// Puts a neighbouring model, made of the same parts, under the present state, to be solved from there.
    ///
    /// # Errors
    /// A model that is made of other parts.
    pub fn adopt(&mut self, model: &Model) -> Result<(), ProblemError> {
        let law = self.problem.neighbour(model)?;
        self.problem.exchange(law);
        self.border = None;
        Ok(())
    }

    /// What outputs and targets need, and no more.
    pub(crate) fn light_solution(&mut self, what: What) -> Result<Solution, Breakdown> {
        let model = self.problem.model();
        let outputs: Vec<&Output> = match what {
            What::Targets => model.targets.iter().map(|target| &target.output).collect(),
            What::Both => {
                model.outputs.iter().chain(model.targets.iter().map(|target| &target.output)).collect()
            }
        };
        let probes = || outputs.iter().flat_map(|output| &output.probes);
        let energies = probes().any(|probe| probe.quantity == Quantity::Energy);
        let beams: Vec<usize> = probes()
            .filter_map(|probe| match probe.target {
                ProbeTarget::Beam(beam, _) => Some(beam.0),
                _ => None,
            })
            .collect();
        let mut solution = self.problem.sampled(2, energies, |beam| beams.contains(&beam));
        if self.asks_for_tangents() {
            solution.tangents = self.problem.tangents(&tangent_targets(self.problem.model()))?;
        }
        Ok(solution)
    }

    pub(crate) fn asks_for_tangents(&self) -> bool {
        !tangent_targets(self.problem.model()).is_empty()
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
        if let Some(reason) = self.problem.beyond_reach() {
            return Outcome {
                status: Status::IterationLimit,
                reason: Some(reason),
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
                reason: Some(self.why_stalled(load)),
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

    fn why_stalled(&self, load: f64) -> String {
        let part = 100.0 * load;
        if let Some(reason) = self.problem.beyond_reach() {
            return format!("the path from rest ends at {part:.4} % of the load: {reason}");
        }
        let ends = self.problem.contact_ends();
        if ends.is_empty() {
            format!(
                "the path from rest ends at {part:.4} % of the load, most likely at a fold (limit point) where the \
                 mechanism snaps; reduce the load, or drive the motion by a joint coordinate instead of a force"
            )
        } else {
            let ends = ends.join(", and ");
            format!(
                "the path from rest ends at {part:.4} % of the load: {ends}; reduce the load, or give longer boundaries"
            )
        }
    }

    /// From an earlier result to the equilibrium next to it; None if there is none near.
    pub fn solve_near(&mut self, from: &Solution, tolerance: f64) -> Option<Outcome> {
        self.problem.stand(from);
        let outcome = self.finish(tolerance, PathWork { taken: 1, ..PathWork::default() }, NEAR_RESULT);
        (outcome.status == Status::Converged).then_some(outcome)
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

    pub(crate) fn finish(&mut self, tolerance: f64, path: PathWork, nearest: f64) -> Outcome {
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
        if let Some((cable, push)) = self.problem.slack_cable() {
            let reason = format!(
                "{cable} would have to push with {push:.6} N to have its length: it is slack; shorten it, or leave it out"
            );
            return Outcome { status: Status::Inconsistent, reason: Some(reason), error_estimate, path };
        }
        if let Some((joint, shift, turn)) = self.problem.open_loop() {
            let reason = format!(
                "the loop does not close: at {joint} its two sides are {:.4} mm and {:.4} deg apart; free one of its \
                 joints, or correct the places and axes of those that the warning names",
                shift * 1e3,
                turn.to_degrees()
            );
            return Outcome { status: Status::Inconsistent, reason: Some(reason), error_estimate, path };
        }
        Outcome { status, reason, error_estimate, path }
    }

    /// Says whether the present equilibrium is stable.
    pub(crate) fn judge(&mut self, solution: &mut Solution) {
        match self.problem.stability() {
            Ok(Stability::Unstable(count)) => {
                solution.unstable_directions = Some(count);
                solution.stable = Some(count == 0);
                solution.stability_reason = None;
            }
            Ok(Stability::Undecided(reason)) => solution.stability_reason = Some(reason),
            Err(_) => solution.stability_reason = Some(CRITICAL.to_string()),
        }
    }

    /// The present state as a solution.
    pub fn solution(&mut self, outcome: &Outcome, samples: usize) -> Solution {
        let mut solution = self.problem.solution(samples);
        solution.status = outcome.status;
        solution.reason = outcome.reason.clone();
        solution.error_estimate = outcome.error_estimate;
        if let Some(load) = outcome.path.crossing {
            solution.warnings.push(format!(
                "the path from rest passes a branch point at {:.4} % of the load, and the equilibrium found lies beyond it; \
                 `flexura trace` shows what branches off there",
                100.0 * load
            ));
        }
        if outcome.status == Status::Converged {
            self.judge(&mut solution);
        } else {
            solution.stability_reason = Some("this is no equilibrium under the full load".to_string());
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

/// Bodies and places on beams whose small motions the outputs or targets ask for.
pub(crate) fn tangent_targets(model: &Model) -> Vec<ProbeTarget> {
    let all = model.outputs.iter().chain(model.targets.iter().map(|target| &target.output));
    let mut targets: Vec<ProbeTarget> = Vec::new();
    for probe in all.flat_map(|output| &output.probes) {
        let asked = matches!(
            probe.quantity,
            Quantity::Compliance
                | Quantity::Stiffness
                | Quantity::CenterOfCompliance
                | Quantity::MotionAxis
                | Quantity::MotionPoint
                | Quantity::MotionPitch
        );
        if asked && !targets.contains(&probe.target) {
            targets.push(probe.target);
        }
    }
    targets
}

/// The equilibrium reached from rest under proportional load without passing a fold; of an inverse problem, the
/// parameters too.
///
/// A solve that does not get there returns a solution too: its status says so, its state is the last point
/// that was reached.
///
/// # Errors
/// A model that describes no solvable mechanism; an inverse problem, which needs [`solve_family`].
pub fn solve(
    model: &Model,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<Solution, ProblemError> {
    let mut fixed = |_: &[(usize, f64)]| -> Result<Model, ProblemError> {
        Err(ProblemError::new(
            "unknown",
            "the model cannot be made again with other values of its parameters",
            "solve it as a family: from its file, or with a function that makes it",
        ))
    };
    Ok(solve_family(model, &mut fixed, options, progress)?.0)
}

/// [`solve`] of a model whose parameters can be given other values: for inverse problems and for sensitivities. The
/// second of the pair is the model with the values found.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn solve_family(
    model: &Model,
    family: &mut dyn Family,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Solution, Model), ProblemError> {
    let probes = options.compliances.iter().filter_map(|target| match target {
        ProbeTarget::Beam(beam, at) => Some(BeamPoint { beam: *beam, at: *at }),
        _ => None,
    });
    let mut prepared = Prepared::with_probes(model, &probes.collect::<Vec<_>>())?;
    let near = options.from.as_ref().and_then(|from| prepared.solve_near(from, options.tolerance));
    let far = options.from.is_some() && near.is_none();
    let outcome = match (near, model.unknowns.is_empty()) {
        (Some(outcome), true) => outcome,
        (Some(_), false) => prepared.solve_inverse_from_here(family, options.tolerance),
        (None, true) => prepared.solve(options.tolerance, progress),
        (None, false) => prepared.solve_inverse(family, options.tolerance, progress),
    };
    let samples = options.samples.min((MOST_SAMPLES / model.beams.len().max(1)).max(FEWEST_SAMPLES));
    let mut solution = prepared.solution(&outcome, samples);
    if far {
        solution.warnings.push(
            "the earlier result is too far from an equilibrium of this model; it was solved from rest"
                .to_string(),
        );
    }
    if outcome.status == Status::Converged {
        prepared.add_tangents(&mut solution, &options.compliances);
        if options.sensitivities {
            let parameters: Vec<usize> = (0..model.parameters.len()).collect();
            match prepared.sensitivities(family, &parameters) {
                Ok(sensitivities) => {
                    for (parameter, reason) in &sensitivities.left_out {
                        let name = &prepared.model().parameters[*parameter].name;
                        solution.warnings.push(format!("no sensitivities to `{name}`: {reason}"));
                    }
                    solution.sensitivities = Some(sensitivities);
                }
                Err(error) => solution.warnings.push(error.to_string()),
            }
        }
    }
    solution.found = prepared.unknown_values();
    Ok((solution, prepared.model().clone()))
}

impl Prepared {
    /// Compliances and motions of what outputs ask for, and of `further`.
    pub fn add_tangents(&mut self, solution: &mut Solution, further: &[ProbeTarget]) {
        let mut targets = tangent_targets(self.problem.model());
        targets
            .extend(further.iter().filter(|target| !targets.contains(target)).copied().collect::<Vec<_>>());
        match self.problem.tangents(&targets) {
            Ok(tangents) => solution.tangents = tangents,
            Err(_) => solution.warnings.push(
                "no compliances: the tangent has no inverse here, which is a fold or branch point"
                    .to_string(),
            ),
        }
    }
}
