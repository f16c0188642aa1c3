//! Natural frequencies and shapes about an equilibrium, or about the state at rest.
//!
//! Beams are cut into elements of high order on the solved shape (`flexura_equilibrium::Vibration`). What is found with elements that
//! resolve the waves of the highest frequency wanted is believed where the last degrees of the polynomials hold next to nothing of the
//! shapes' energy; else, and where there is no energy, it is found again with elements of higher order until two orders agree.

mod along;
mod damped;
mod onset;
mod pencil;
mod reading;
mod space;
mod unsymmetric;

pub use along::modes_along;
pub use space::{StateSpaceRequest, state_space};

use crate::{Options, Prepared, ProblemError, Progress};
use flexura_equilibrium::{Detail, Equilibrium, Footing, Vibration};
use flexura_model::{Model, ModesStudy, StudyKind};
use flexura_nonlinear::{Breakdown, PathOptions, System};
use flexura_solution::{Modes, Solution, Status};
use nalgebra::Complex;
use pencil::{Bench, FAIR, Pair, SHARP, Shifted, Start, Trouble};
use unsymmetric::Wave;

/// Orders of elements, from the first try on.
const ORDERS: [usize; 5] = [8, 10, 13, 16, 20];
/// Phase of the highest wave along one element, rad.
const PHASE: f64 = 4.5;
/// By how much more ω² than the highest found is resolved.
const BEYOND: f64 = 1.2;
/// Relative difference of ω² at which two orders agree.
const AGREE: f64 = 2e-10;
/// The same where only signs are asked for.
const ROUGH: f64 = 1e-4;
/// The same from which a frequency is doubtful.
const DOUBTFUL: f64 = 1e-8;
/// ω² beside what cancels in it, from which on it is none.
const NOTHING: f64 = 1e-12;
/// ω² beside the largest found that may be nothing.
const FAINT: f64 = 1e-6;
/// Relative difference between two shifts up to which a small ω² is something.
const SURE: f64 = 1e-3;
/// Shift beside the lowest |s| where something damps or spins.
const SHIFT: f64 = 0.3;
/// Relative distance of two ω² from which on they are compared as a pair.
const MEETING: f64 = 1e-2;
/// Of how many modes a verdict of stability looks.
const LOOKED_AT: [usize; 2] = [6, 3];
/// Steps of a mesh up to which it looks: elements take more memory than steps do.
const MOST_STEPS: usize = 1000;
/// Rounds in which motions without stiffness make room for others.
const ROUNDS: usize = 3;
/// Tolerance of the equilibrium, if that is less than what was asked for.
const SHAPE: f64 = 1e-10;
/// Accuracy of the mesh at rest.
const REST: f64 = 1e-12;
/// Residual at which the state at rest is the equilibrium.
const BALANCED: f64 = 1e-10;

/// Natural frequencies and shapes.
///
/// # Errors
/// A model that describes no solvable mechanism, one without inertia or without an energy.
pub fn modes(
    model: &Model,
    study: &ModesStudy,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<Modes, ProblemError> {
    crate::trace::check_study(model, StudyKind::Modes(*study))?;
    if study.path.is_some() {
        // One state is not what was asked for.
        return Err(ProblemError::new(
            "study",
            "follows frequencies along a path, not about one equilibrium",
            "call `modes_along`, or run the study with the command",
        ));
    }
    let (mut prepared, mut solution, at_rest) = stand(model, study, options, progress)?;
    let empty = |solution: Solution| Modes {
        solution,
        at_rest,
        modes: Vec::new(),
        mass: [0.0; 3],
        inertia: [0.0; 3],
        elements: [0; 2],
    };
    if solution.status != Status::Converged {
        return Ok(empty(solution));
    }
    refuse(prepared.problem())?;
    let found = match spectrum(prepared.problem(), &mut Bench::default(), study.count, None, Aim::Frequencies)
    {
        Ok(found) => found,
        Err(Trouble::Breakdown(Breakdown::Interrupted)) => {
            solution.status = Status::Interrupted;
            solution.reason = Some("interrupted before the modes were found".to_string());
            return Ok(empty(solution));
        }
        Err(trouble) => return Err(explain(&trouble)),
    };
    Ok(reading::read(prepared.problem(), solution, at_rest, study, &found))
}

/// The state about which it vibrates.
fn stand(
    model: &Model,
    study: &ModesStudy,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Prepared, Solution, bool), ProblemError> {
    // Whether anything holds it at rest does not matter.
    let unheld = || -> Result<Prepared, ProblemError> {
        let mut problem = Equilibrium::new(model)?;
        problem.heed(&options.interrupt);
        // Loops that are held twice are found.
        problem.footing()?;
        problem.refine_path(REST);
        problem.rest();
        Ok(Prepared { problem, path: PathOptions::default(), border: None, footing: Footing::Firm })
    };
    let at_rest = |load: f64| -> Result<Option<(Prepared, Solution)>, ProblemError> {
        let mut prepared = unheld()?;
        let problem = &mut prepared.problem;
        problem.set_load(load);
        if load > 0.0 && problem.residual_size() > BALANCED {
            return Ok(None);
        }
        let mut solution = problem.solution(options.samples);
        solution.status = Status::Converged;
        solution.error_estimate = 0.0;
        prepared.judge(&mut solution);
        Ok(Some((prepared, solution)))
    };
    if study.at_rest
        && let Some((prepared, solution)) = at_rest(0.0)?
    {
        return Ok((prepared, solution, true));
    }
    // What nothing loads is at rest, whether something holds it or not.
    if model.validate_mechanism().is_empty()
        && let Some((prepared, solution)) = at_rest(1.0)?
    {
        return Ok((prepared, solution, true));
    }
    if let Some(from) = &options.from {
        let mut prepared = unheld()?;
        if let Some(outcome) = prepared.solve_near(from, options.tolerance.min(SHAPE)) {
            let solution = prepared.solution(&outcome, options.samples);
            return Ok((prepared, solution, false));
        }
    }
    let mut prepared = Prepared::new(model)?;
    prepared.heed(&options.interrupt);
    let mut outcome = prepared.solve(options.tolerance.min(SHAPE), progress);
    let interrupted = outcome.status == Status::Interrupted;
    if outcome.status != Status::Converged && !interrupted && options.tolerance > SHAPE {
        outcome = prepared.solve(options.tolerance, progress);
    }
    let solution = prepared.solution(&outcome, options.samples);
    Ok((prepared, solution, false))
}

/// What this version finds no modes of.
fn refuse(problem: &Equilibrium) -> Result<(), ProblemError> {
    match problem.without_vibration() {
        Some(why) => {
            Err(ProblemError::new("study", format!("finds no modes: {why}"), "leave them out, or the study"))
        }
        None => Ok(()),
    }
}

/// How many of the lowest modes about the present equilibrium grow; None where no inertia decides, or where looking would take far more
/// than the solve has.
pub(crate) fn unstable_by_motion(problem: &mut Equilibrium) -> Option<usize> {
    if problem.without_vibration().is_some() || problem.integration_steps() > MOST_STEPS {
        return None;
    }
    // Where much damps, what creeps crowds in before the higher modes.
    let look = |count: &usize| spectrum(problem, &mut Bench::default(), *count, None, Aim::Signs).ok();
    let found = LOOKED_AT.iter().find_map(look)?;
    Some(onset::Sight::of(&found).growing())
}

/// What a spectrum is for.
#[derive(Clone, Copy, PartialEq)]
enum Aim {
    /// To the accuracy of the rod's theory.
    Frequencies,
    /// Only whether modes grow: a verdict beside a solve may not cost much more than the solve.
    Signs,
}

impl Aim {
    /// Relative difference of ω² at which two orders agree.
    fn agree(self) -> f64 {
        match self {
            Aim::Frequencies => AGREE,
            Aim::Signs => ROUGH,
        }
    }

    /// Orders of elements that are tried, one behind the other.
    fn orders(self, first: usize) -> Vec<usize> {
        match self {
            // Where the law changes within a small part of a wave, shorter elements of the highest order follow.
            Aim::Frequencies => [&ORDERS[first..], &ORDERS, &[ORDERS[4]; 2]].concat(),
            Aim::Signs => ORDERS.to_vec(),
        }
    }
}

/// What was found at one state.
pub(crate) struct Spectrum {
    pub vibration: Vibration,
    pub order: usize,
    pub waves: Vec<Wave>,
    /// Is there an energy and nothing that damps or spins, so that ω² are real and counted?
    pub has_energy: bool,
    /// Relative errors of ω².
    pub errors: Vec<f64>,
    /// Were fewer found than asked for?
    pub exhausted: bool,
}

/// The lowest modes of the present state: all motions without stiffness and `count` more. `near` is what was found at a state close
/// by.
fn spectrum(
    problem: &mut Equilibrium,
    bench: &mut Bench,
    count: usize,
    near: Option<&Spectrum>,
    aim: Aim,
) -> Result<Spectrum, Trouble> {
    let mut detail = Detail { order: ORDERS[0], square: 0.0, phase: PHASE };
    let mut before: Option<Found> = None;
    if let Some(near) = near {
        detail.square = BEYOND * highest(&near.waves) * near.vibration.unit;
    } else {
        // The first look says how short the waves are.
        let look = Found::new(problem, bench, &detail, count, &mut Start::look(-1.0), None)?;
        detail.square = BEYOND * highest(&look.waves) * look.vibration.unit;
        before = Some(look);
    }
    let residual = if near.is_some() { FAIR } else { SHARP };
    let first = near.and_then(|near| ORDERS.iter().position(|order| *order == near.order)).unwrap_or(0);
    for (round, order) in aim.orders(first).into_iter().enumerate() {
        detail.order = order;
        let (mut start, source) = match (&before, near) {
            (Some(found), _) => (start(&found.waves, found.has_energy, residual), Some(&found.vibration)),
            (None, Some(near)) => (start(&near.waves, near.has_energy, residual), Some(&near.vibration)),
            (None, None) => (Start::look(-1.0), None),
        };
        let found = Found::new(problem, bench, &detail, count, &mut start, source)?;
        let errors = found.tails(problem);
        // Where nothing bounds what is missed, and where the bound is too wide, two orders must agree.
        let compared = before.as_ref().filter(|_| round > 0).map(|before| found.errors(before));
        let is_last = order == ORDERS[4];
        for errors in [errors, compared].into_iter().flatten() {
            if errors.iter().all(|error| *error <= aim.agree()) || is_last {
                let agree = errors.iter().all(|error| *error <= DOUBTFUL.max(aim.agree()));
                if agree || detail.phase < 0.2 * PHASE {
                    let exhausted = found.waves.len() < count + found.rigid();
                    let has_energy = found.has_energy;
                    let Found { vibration, waves, .. } = found;
                    return Ok(Spectrum { vibration, order, waves, has_energy, errors, exhausted });
                }
            }
        }
        if is_last {
            detail.phase *= 0.5;
        }
        before = Some(found);
    }
    Err(Trouble::Missing)
}

fn highest(waves: &[Wave]) -> f64 {
    waves.iter().map(Wave::size).fold(0.0, f64::max)
}

/// What a search for modes like these begins with.
fn start(waves: &[Wave], has_energy: bool, residual: f64) -> Start {
    let squares: Vec<f64> = waves.iter().map(|wave| wave.square.re).collect();
    let below = if has_energy {
        shift_below(&squares)
    } else {
        -0.3 * squares.iter().map(|square| square.abs()).find(|square| *square > 0.0).unwrap_or(1.0)
    };
    let vectors =
        if has_energy { waves.iter().map(|wave| wave.vector[0].clone()).collect() } else { Vec::new() };
    Start { below, vectors, prove: true, residual }
}

/// A shift below ω² that are known roughly.
fn shift_below(squares: &[f64]) -> f64 {
    let first = squares.iter().copied().fold(f64::INFINITY, f64::min).min(1e300);
    // What may be nothing tells no distance.
    let faint = FAINT * squares.iter().map(|square| square.abs()).fold(0.0, f64::max);
    let next = squares.iter().map(|square| square.abs()).find(|square| *square > faint).unwrap_or(1.0);
    if first < 1e300 { first - 0.3 * first.abs().max(next) } else { -1.0 }
}

/// The lowest modes with elements of one kind.
struct Found {
    vibration: Vibration,
    waves: Vec<Wave>,
    has_energy: bool,
}

impl Found {
    /// Vectors of the start belong to `source`.
    fn new(
        problem: &mut Equilibrium,
        bench: &mut Bench,
        detail: &Detail,
        count: usize,
        start: &mut Start,
        source: Option<&Vibration>,
    ) -> Result<Self, Trouble> {
        let vibration = problem.vibration(detail)?;
        if let Some(source) = source {
            start.vectors.iter_mut().for_each(|x| *x = problem.vector_carried(source, x, &vibration));
        }
        if vibration.inertia.is_empty() {
            return Err(Trouble::Weightless);
        }
        let has_energy = vibration.has_energy;
        let is_quadratic = !(vibration.damping.is_empty() && vibration.gyroscopic.is_empty());
        let named = |trouble: Trouble| match trouble {
            Trouble::Massless(x) => Trouble::Loose(problem.loosest(&vibration, &x)),
            other => other,
        };
        let waves = if is_quadratic {
            damped::slowest(&vibration, count, SHIFT * start.below.abs().sqrt()).map_err(named)?
        } else if has_energy {
            let pairs = counted(&vibration, bench, count, start).map_err(named)?;
            let real = |(square, x): Pair| Wave {
                square: Complex::new(square, 0.0),
                rate: None,
                vector: [x, Vec::new()],
            };
            pairs.into_iter().map(real).collect()
        } else {
            complex(&vibration, count, start.below).map_err(named)?
        };
        Ok(Self { vibration, waves, has_energy: has_energy && !is_quadratic })
    }

    /// Relative errors of ω² by what elements leave of the shapes, where there is an energy.
    fn tails(&self, problem: &Equilibrium) -> Option<Vec<f64>> {
        let tail = |wave: &Wave| problem.unresolved(&self.vibration, &wave.vector[0], wave.square.re);
        self.has_energy.then(|| self.waves.iter().map(tail).collect())
    }

    fn rigid(&self) -> usize {
        self.waves.iter().filter(|wave| wave.square == Complex::new(0.0, 0.0)).count()
    }

    /// Two that meet where nothing makes them real are very sensitive, but their mean and the square of their difference are not.
    fn error_of_meeting(&self, i: usize, before: &Self) -> Option<f64> {
        let z = |wave: &Wave| wave.square;
        let size = |z: Complex<f64>| z.re.hypot(z.im);
        let own = z(&self.waves[i]);
        let others = self.waves.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, wave)| z(wave));
        let other = others.min_by(|a, b| size(*a - own).total_cmp(&size(*b - own)))?;
        if self.has_energy || size(own) == 0.0 || size(own - other) > MEETING * size(own) {
            return None;
        }
        let pair = |a: Complex<f64>, b: Complex<f64>| ((a + b) * 0.5, (a - b) * (a - b) * 0.25);
        let (mean, square) = pair(own, other);
        let mut list: Vec<Complex<f64>> = before.waves.iter().map(z).collect();
        list.sort_by(|a, b| size(*a - mean).total_cmp(&size(*b - mean)));
        let [a, b, ..] = list[..] else { return None };
        let (mean_before, square_before) = pair(a, b);
        Some((size(mean - mean_before) + size(square - square_before) / size(mean)) / size(mean))
    }

    /// Relative differences of ω².
    fn errors(&self, before: &Self) -> Vec<f64> {
        let each = self.waves.iter().enumerate().map(|(i, wave)| {
            let size = wave.square.norm_sqr().sqrt();
            if let Some(error) = self.error_of_meeting(i, before) {
                return error;
            }
            let apart = |other: &Wave| (other.square - wave.square).norm_sqr().sqrt();
            let nearest = before.waves.iter().map(apart).fold(f64::INFINITY, f64::min);
            if size == 0.0 { 0.0 } else { nearest / size }
        });
        each.collect()
    }
}

/// The lowest ω² of a mechanism that has an energy, all of them.
fn counted(
    vibration: &Vibration,
    bench: &mut Bench,
    count: usize,
    start: &Start,
) -> Result<Vec<Pair>, Trouble> {
    let mut shifted = Shifted::new(vibration, bench);
    let mut pairs = shifted.lowest(count, start)?;
    settle_rigid(vibration, &mut pairs);
    for _ in 0..ROUNDS {
        let scale = pairs.iter().map(|(square, _)| square.abs()).fold(0.0, f64::max);
        let small = pairs.iter().filter(|(square, _)| square.abs() <= FAINT * scale).count();
        if small == 0 {
            break;
        }
        // From another shift round-off makes something else of nothing, and softness stays what it is.
        let below = pairs.first().map_or(0.0, |(square, _)| square.min(0.0));
        let next = pairs.iter().map(|(square, _)| *square).find(|square| *square > FAINT * scale);
        let hint = 1.7 * below - 0.4 * next.unwrap_or(1.0);
        let again = Start { below: hint, vectors: Vec::new(), prove: true, residual: start.residual };
        let mut again = shifted.lowest(count + small, &again)?;
        settle_rigid(vibration, &mut again);
        for (i, (square, _)) in again.iter_mut().enumerate().take(small) {
            let apart = pairs.get(i).map_or(f64::INFINITY, |(before, _)| (*square - before).abs());
            if apart > SURE * square.abs() {
                *square = 0.0;
            }
        }
        again.sort_by(|a, b| a.0.total_cmp(&b.0));
        let same = again.len() == pairs.len();
        pairs = again;
        if same {
            break;
        }
    }
    Ok(pairs)
}

/// The lowest ω² by their size of a mechanism without an energy.
fn complex(vibration: &Vibration, count: usize, hint: f64) -> Result<Vec<Wave>, Trouble> {
    let mut waves = unsymmetric::nearest(vibration, count + 2, hint)?;
    waves.sort_by(|a, b| {
        let size = |wave: &Wave| wave.square.norm_sqr();
        if (size(a) / size(b) - 1.0).abs() < 1e-9 {
            b.square.im.total_cmp(&a.square.im)
        } else {
            size(a).total_cmp(&size(b))
        }
    });
    // A conjugate pair is not torn apart.
    let torn = waves.get(count.wrapping_sub(1)).is_some_and(|wave| wave.square.im > 0.0);
    waves.truncate(count + usize::from(torn));
    Ok(waves)
}

/// ω² of motions without stiffness are zero, not what round-off leaves of them.
fn settle_rigid(vibration: &Vibration, pairs: &mut [Pair]) {
    for (square, x) in pairs.iter_mut() {
        let cancels: f64 =
            vibration.stiffness.iter().map(|(i, j, value)| (value * x[*i] * x[*j]).abs()).sum();
        if square.abs() <= NOTHING * cancels {
            *square = 0.0;
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
}

fn explain(trouble: &Trouble) -> ProblemError {
    let wrong = |message: String, hint: &str| ProblemError::new("study", message, hint);
    match trouble {
        Trouble::Weightless => wrong(
            "finds no modes: nothing that moves has a mass".to_string(),
            "give materials a `density`, stiffness sections a `mass_per_length`, bodies a `mass`",
        ),
        Trouble::Loose(name) => {
            let what = name.clone().unwrap_or_else(|| "something".to_string());
            wrong(
                format!("finds no modes: {what} moves without stiffness and without inertia"),
                "give it a mass and an `inertia`, or hold it",
            )
        }
        Trouble::Bottomless => wrong(
            "finds no modes: something without inertia is unstable".to_string(),
            "give all that moves an inertia",
        ),
        Trouble::Missing | Trouble::Massless(_) | Trouble::Breakdown(_) => wrong(
            "finds no modes to be relied on: stiffnesses or masses lie too many orders of magnitude apart"
                .to_string(),
            "ask for fewer modes, or make rigid what is all but rigid",
        ),
    }
}
