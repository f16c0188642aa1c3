//! The equilibrium reached from rest under proportional load.

use crate::ending::Ending;
use crate::family::{Family, ModelFamily};
use crate::inverse::Border;
use crate::sensitivity;
use crate::settle;
use crate::way::Way;
use flexura_equilibrium::{Equilibrium, Finish, Footing, Interrupt, ProblemError, Stability};
use flexura_model::{BeamPoint, LoadId, Model, Output, ProbeTarget, Quantity};
use flexura_nonlinear::{Breakdown, NewtonEnd, NewtonOptions, PathOptions, PathWork, System, converge};
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
    /// Ends the study early, with what it has found, once it is raised.
    pub interrupt: Interrupt,
    /// Samples along each beam of the shapes at those points of a path whose whole state is not kept; zero for no shapes.
    pub shapes: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            samples: 101,
            compliances: Vec::new(),
            sensitivities: false,
            from: None,
            interrupt: Interrupt::default(),
            shapes: 0,
        }
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
    /// How it stands at rest.
    pub(crate) footing: Footing,
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
    /// What ended the way to the full load before it.
    pub ending: Option<Ending>,
    /// Estimated largest error.
    pub error_estimate: f64,
    /// Load steps.
    pub path: PathWork,
}

impl Outcome {
    /// The way ended before the full load.
    fn ended(ending: Ending, path: PathWork) -> Self {
        Self {
            status: ending.status(),
            reason: Some(ending.to_string()),
            ending: Some(ending),
            error_estimate: f64::NAN,
            path,
        }
    }

    /// At the full load, but not as it should be.
    pub(crate) fn without(status: Status, reason: String, error_estimate: f64, path: PathWork) -> Self {
        Self { status, reason: Some(reason), ending: None, error_estimate, path }
    }
}

/// Size of the first Newton correction up to which a known state counts as near.
const NEAR: f64 = 0.5;

/// The same for a result that a user names as the start.
const NEAR_RESULT: f64 = 2.0;

/// Part of the load before the full one at which a branch point is looked for that the path has not seen.
const LATE: f64 = 1e-4;

/// Samples of all beams together, and of each at least.
const MOST_SAMPLES: usize = 30_000;
const FEWEST_SAMPLES: usize = 5;

/// Why the energy of what spins does not decide.
pub(crate) const SPINS: &str = "the frame spins, and gyroscopic forces may hold what its energy does not";

/// What is said of a verdict that the spectrum has given.
pub(crate) fn by_motion(reason: &str) -> String {
    format!("stability is decided by the lowest modes: {reason}")
}

/// Why an equilibrium may have no verdict though its mechanism has an energy.
pub(crate) const CRITICAL: &str = "the equilibrium is critical: a direction gives way without resistance";

/// Work that a solve may do, in integration steps of one state: for every model, and for each span of it.
const MOST_EFFORT: f64 = 4e6;
const EFFORT_OF_SPAN: f64 = 5e5;

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
        if let Some(issue) = model.validate_mechanism().into_iter().next() {
            return Err(ProblemError::new(issue.path, issue.message, issue.hint.unwrap_or_default()));
        }
        let mut problem = Equilibrium::with_probes(model, probes)?;
        // What is beyond reach is said by every solve; nothing is worked out on its mesh.
        let footing = if problem.beyond_reach().is_some() { Footing::Firm } else { problem.footing()? };
        let mut this = Self { problem, path: PathOptions::default(), border: None, footing };
        if this.footing != Footing::Firm {
            this.check_start()?;
        }
        Ok(this)
    }

    /// Checks that a mechanism that does not stand firmly at rest can be started all the same.
    fn check_start(&mut self) -> Result<(), ProblemError> {
        let mut problem = self.problem.clone();
        problem.allow_effort(self.most_effort());
        let mut progress = |_| {};
        let mut way = Way::new(&mut problem, self.path, &mut progress);
        settle::stands(&mut way, &self.footing)
    }

    fn most_effort(&self) -> f64 {
        MOST_EFFORT + EFFORT_OF_SPAN * self.problem.spans() as f64
    }

    /// The model as it stands: of an inverse problem with the values found.
    pub fn model(&self) -> &Model {
        self.problem.model()
    }

    /// Ends every solve early, with what it has found, once this flag is raised.
    pub fn heed(&mut self, interrupt: &Interrupt) {
        self.problem.heed(interrupt);
    }

    /// Where a solve from rest was ended.
    pub(crate) fn interrupted(&self, path: PathWork) -> Outcome {
        Outcome::ended(Ending::Interrupted { load: self.problem.load_fraction() }, path)
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

    /// A load that is taken for a mistake: nothing is solved, and no mesh is made for it.
    pub(crate) fn overloaded(&self) -> Option<Outcome> {
        let reason = self.problem.beyond_reach()?;
        Some(Outcome::ended(Ending::Excessive(reason), PathWork::default()))
    }

    /// From rest to the full load, then to `tolerance`.
    pub fn solve(&mut self, tolerance: f64, progress: &mut dyn FnMut(Progress)) -> Outcome {
        self.problem.rest();
        if let Some(outcome) = self.overloaded() {
            return outcome;
        }
        let most = self.most_effort();
        self.problem.allow_effort(most);
        let mut way = Way::new(&mut self.problem, self.path, progress);
        let gone = settle::go(&mut way, &self.footing);
        let work = way.work;
        self.problem.allow_effort(most);
        let outcome = match gone {
            Ok(()) => self.finish(tolerance, work, f64::INFINITY),
            Err(_) if self.problem.is_interrupted() => self.interrupted(work),
            Err(ending) => Outcome::ended(ending, work),
        };
        self.problem.allow_effort(f64::INFINITY);
        outcome
    }

    /// From an earlier result to the equilibrium next to it; None if there is none near.
    pub fn solve_near(&mut self, from: &Solution, tolerance: f64) -> Option<Outcome> {
        self.problem.stand(from);
        let outcome = self.finish(tolerance, PathWork { taken: 1, ..PathWork::default() }, NEAR_RESULT);
        (outcome.status == Status::Converged).then_some(outcome)
    }

    /// From where it stands, which should be near, to `tolerance`; where nothing is near, the state is none.
    pub fn solve_near_here(&mut self, tolerance: f64) -> Outcome {
        self.problem.set_load(1.0);
        self.finish(tolerance, PathWork { taken: 1, ..PathWork::default() }, NEAR)
    }

    /// From where it stands, which should be near, to `tolerance`; from rest if it is not near.
    pub fn solve_from_here(&mut self, tolerance: f64, progress: &mut dyn FnMut(Progress)) -> Outcome {
        let outcome = self.solve_near_here(tolerance);
        if outcome.status == Status::Converged {
            return outcome;
        }
        self.solve(tolerance, progress)
    }

    pub(crate) fn finish(&mut self, tolerance: f64, path: PathWork, nearest: f64) -> Outcome {
        let (status, reason, error_estimate) = match self.problem.finish(tolerance, nearest) {
            Finish::Done { error } => (Status::Converged, None, error),
            Finish::Failed(NewtonEnd::Broken(Breakdown::Interrupted)) => {
                return self.interrupted(path);
            }
            Finish::AccuracyLimit { error } => (
                Status::AccuracyLimit,
                Some(format!(
                    "an error of {error:.1e} is the best that double precision gives here; ask for a larger tolerance"
                )),
                error,
            ),
            Finish::Failed(NewtonEnd::Exhausted) => {
                let ending = Ending::Work { load: 1.0, steps: path.taken + path.refused, crossings: path.crossings };
                return Outcome::ended(ending, path);
            }
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
            return Outcome::without(Status::Inconsistent, reason, error_estimate, path);
        }
        if let Some((joint, shift, turn)) = self.problem.open_loop() {
            let names = self.problem.withdraw_redundancy().join(", ");
            let reason = format!(
                "the loop does not close: at {joint} its two sides are {:.4} mm and {:.4} deg apart; free one of its \
                 joints, or correct the places and axes of {names}",
                shift * 1e3,
                turn.to_degrees()
            );
            return Outcome::without(Status::Inconsistent, reason, error_estimate, path);
        }
        Outcome { status, reason, ending: None, error_estimate, path }
    }

    /// Says whether the present equilibrium is stable.
    pub(crate) fn judge(&mut self, solution: &mut Solution) {
        match self.problem.stability() {
            // What is unstable at rest in a spinning frame may be held by its motion.
            Ok(Stability::Unstable(count)) if count > 0 && self.problem.spins() => {
                self.judge_by_motion(solution, SPINS);
            }
            Ok(Stability::Unstable(count)) => {
                solution.unstable_directions = Some(count);
                solution.stable = Some(count == 0);
                solution.stability_reason = None;
            }
            Ok(Stability::Undecided(reason)) => self.judge_by_motion(solution, &reason),
            Err(_) => solution.stability_reason = Some(CRITICAL.to_string()),
        }
    }

    /// Where no energy decides, the lowest modes do.
    fn judge_by_motion(&mut self, solution: &mut Solution, reason: &str) {
        let count = crate::modes::unstable_by_motion(&mut self.problem);
        solution.unstable_directions = count;
        solution.stable = count.map(|count| count == 0);
        match count {
            Some(_) => {
                solution.stability_reason = None;
                solution.warnings.push(by_motion(reason));
            }
            None => solution.stability_reason = Some(reason.to_string()),
        }
    }

    /// A branch point so near the full load that only the last corrections, on a finer mesh, have passed it.
    fn warn_of_a_late_crossing(&self, solution: &mut Solution) {
        let mut before = self.problem.clone();
        before.set_load(1.0 - LATE);
        let newton = NewtonOptions { tolerance: 1e-9, iterations: 20, nearest: f64::INFINITY };
        let arrived = matches!(converge(&mut before, &newton), NewtonEnd::Converged { .. });
        let fewer = |count: usize| solution.unstable_directions.is_some_and(|now| count < now);
        if arrived && matches!(before.stability(), Ok(Stability::Unstable(count)) if fewer(count)) {
            solution.warnings.push(passes(1.0));
        }
    }

    /// The present state as a solution.
    pub fn solution(&mut self, outcome: &Outcome, samples: usize) -> Solution {
        let mut solution = self.problem.solution(samples);
        solution.status = outcome.status;
        solution.reason = outcome.reason.clone();
        solution.error_estimate = outcome.error_estimate;
        if let Some(load) = outcome.path.crossing {
            solution.warnings.push(passes(load));
        }
        if outcome.status == Status::Converged {
            self.judge(&mut solution);
            if outcome.path.crossing.is_none() && solution.unstable_directions.is_some_and(|count| count > 0)
            {
                self.warn_of_a_late_crossing(&mut solution);
            }
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

fn passes(load: f64) -> String {
    format!(
        "the path from rest passes a branch point at {:.4} % of the load, and the equilibrium found lies beyond it; \
         `flexura trace` shows what branches off there",
        100.0 * load
    )
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
/// A model that describes no solvable mechanism.
pub fn solve(
    model: &Model,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<Solution, ProblemError> {
    Ok(solve_model(model, options, progress)?.0)
}

/// [`solve`] with the model that belongs to the solution: that with the values that were found for its unknown parameters.
///
/// # Errors
/// As [`solve`].
pub fn solve_model(
    model: &Model,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Solution, Model), ProblemError> {
    solve_family(model, &mut ModelFamily::new(model), options, progress)
}

/// [`solve_model`] where something else than the model's own rules makes the models with other values of its parameters.
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
    prepared.heed(&options.interrupt);
    let near = options.from.as_ref().and_then(|from| prepared.solve_near(from, options.tolerance));
    let far = options.from.is_some() && near.is_none();
    let outcome = match (near, model.unknowns.is_empty()) {
        (Some(outcome), true) => outcome,
        (Some(_), false) => prepared.solve_inverse_from_here(family, options.tolerance),
        (None, true) => prepared.solve(options.tolerance, progress),
        (None, false) => prepared.solve_inverse(family, options.tolerance, progress),
    };
    let mut solution = prepared.told(&outcome, options);
    if far && outcome.status != Status::Interrupted {
        solution.warnings.push(
            "the earlier result is too far from an equilibrium of this model; it was solved from rest"
                .to_string(),
        );
    }
    if outcome.status == Status::Converged && options.sensitivities {
        let parameters: Vec<usize> = (0..model.parameters.len()).collect();
        match prepared.sensitivities(family, &parameters) {
            Ok(sensitivities) => {
                let warnings = sensitivity::warnings(prepared.model(), &solution, &sensitivities);
                solution.warnings.extend(warnings);
                solution.sensitivities = Some(sensitivities);
            }
            Err(error) => solution.warnings.push(error.to_string()),
        }
    }
    Ok((solution, prepared.model().clone()))
}

impl Prepared {
    /// The present state with everything that a solve tells of it, but for sensitivities.
    pub fn told(&mut self, outcome: &Outcome, options: &Options) -> Solution {
        let beams = self.model().beams.len().max(1);
        let samples = options.samples.min((MOST_SAMPLES / beams).max(FEWEST_SAMPLES));
        let mut solution = self.solution(outcome, samples);
        if let Some(count @ 1..) = solution.unstable_directions {
            solution.warnings.push(format!(
                "the equilibrium is unstable in {count} {}: the mechanism does not stay there by itself; `flexura trace` shows where other \
                 branches leave its path",
                if count == 1 { "direction" } else { "directions" }
            ));
        }
        if outcome.status == Status::Converged {
            self.add_tangents(&mut solution, &options.compliances);
        }
        solution.found = self.unknown_values();
        solution
    }

    /// Compliances and motions of what outputs ask for, and of `further`.
    pub fn add_tangents(&mut self, solution: &mut Solution, further: &[ProbeTarget]) {
        let mut targets = tangent_targets(self.problem.model());
        targets
            .extend(further.iter().filter(|target| !targets.contains(target)).copied().collect::<Vec<_>>());
        match self.problem.tangents(&targets) {
            Ok(tangents) => solution.tangents = tangents,
            Err(Breakdown::Interrupted) => {
                solution.warnings.push("no compliances: interrupted".to_string());
            }
            Err(_) => solution.warnings.push(
                "no compliances: the tangent has no inverse here, which is a fold or branch point"
                    .to_string(),
            ),
        }
    }
}
