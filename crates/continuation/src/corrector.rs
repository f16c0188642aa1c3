//! From a predicted point back to the path, in the plane across its direction.
//!
//! With u = -J⁻¹ r and v = -J⁻¹ ∂r/∂p the correction dx = u + v dp, dp = -⟨t, u⟩/(⟨t, v⟩ + t_p) solves the bordered
//! system of pseudo-arclength (H. B. Keller, "Numerical solution of bifurcation and nonlinear eigenvalue problems", 1977). J
//! is taken from the point before as long as it contracts.

use crate::problem::{Point, Problem, Refusal, Tangent, slope};
use flexura_nonlinear::{Breakdown, System};

/// How it went.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Miss {
    /// The prediction was too far off; by how much of the step.
    Far(f64),
    /// The corrections do not get smaller.
    NotContracting,
    /// A point could not be had.
    Refused(Refusal),
}

impl From<Refusal> for Miss {
    fn from(refusal: Refusal) -> Self {
        Miss::Refused(refusal)
    }
}

impl From<Breakdown> for Miss {
    fn from(breakdown: Breakdown) -> Self {
        Miss::Refused(Refusal::Broken(breakdown))
    }
}

/// What a corrector may use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Size of the last correction.
    pub tolerance: f64,
    /// Largest first correction, as a part of the step.
    pub farthest: f64,
    /// Size of the predicted step.
    pub reach: f64,
    /// Size of a correction below which the tangent is renewed once, so that it is, but for corrections of the correction, the new
    /// point's; zero where the old one may serve to the end.
    pub renewed_below: f64,
}

/// A correction that arrived.
#[derive(Clone, Debug)]
pub(crate) struct Corrected {
    /// Size of the first correction.
    pub first: f64,
    /// Is the system's tangent another one than before?
    pub renewed: bool,
    /// v of the last tangent.
    pub slope: Vec<f64>,
}

const MOST: usize = 12;
/// Contraction from which the tangent is renewed, and the worst that is accepted of a new one.
const SLOW: f64 = 0.2;
const WORST: f64 = 0.5;
/// Corrections that round-off may cause: below, a standstill counts as arrival.
const ROUND_OFF: f64 = 1e-9;

/// Brings the present state, which was predicted, to the path in the plane across `across`. `along` is v at a point near
/// by, if the last tangent is of that point; it is renewed with the tangent.
pub(crate) fn correct<P: Problem>(
    problem: &mut P,
    across: &Tangent,
    along: Option<&[f64]>,
    limits: &Limits,
) -> Result<Corrected, Miss> {
    let n = problem.system().unknowns();
    let mut step = vec![0.0; n];
    let mut fresh = along.is_none();
    let mut renewed = fresh;
    let mut v = match along {
        Some(along) => {
            problem.system().residual()?;
            problem.system().newton_step(&mut step);
            along.to_vec()
        }
        None => linearise(problem, &mut step)?,
    };
    let (mut first, mut before) = (None, f64::INFINITY);
    let mut borne = Borne::default();
    for _ in 0..MOST {
        let system = problem.system();
        let dp = -across.product(system, &step, 0.0) / across.product(system, &v, 1.0);
        step.iter_mut().zip(&v).for_each(|(s, v)| *s += v * dp);
        let size = system.size(&step).max(dp.abs());
        if !size.is_finite() {
            return Err(Breakdown::NotFinite.into());
        }
        if size > limits.farthest * limits.reach && first.is_none() {
            return Err(Miss::Far(size / limits.reach));
        }
        let start = *first.get_or_insert(size);
        let slow = size > SLOW * before;
        if size > WORST * before && fresh && size > ROUND_OFF && !borne.bear(size, before) {
            return Err(Miss::NotContracting);
        }
        system.retract(&step);
        let mut parameters = problem.parameters();
        parameters[0] += dp;
        problem.set_parameters(parameters)?;
        if size <= limits.tolerance || (size <= ROUND_OFF && slow) {
            return Ok(Corrected { first: start, renewed, slope: v });
        }
        before = size;
        if !fresh && (slow || size < limits.renewed_below) {
            v = linearise(problem, &mut step)?;
            (fresh, renewed) = (true, true);
            before = f64::INFINITY;
        } else {
            problem.system().residual()?;
            problem.system().newton_step(&mut step);
        }
    }
    Err(Miss::NotContracting)
}

/// u into `step`, and v, with a new tangent. The residual is that of another parameter afterwards.
fn linearise<P: Problem>(problem: &mut P, step: &mut [f64]) -> Result<Vec<f64>, Miss> {
    problem.system().linearise()?;
    problem.system().newton_step(step);
    Ok(slope(problem, 0)?)
}

/// One correction that does not contract is borne: what a small turning of a stiff beam leaves of second order is a force that the next
/// correction takes away.
#[derive(Default)]
struct Borne(bool);

impl Borne {
    fn bear(&mut self, size: f64, before: f64) -> bool {
        !std::mem::replace(&mut self.0, true) && size <= 2.0 * before
    }
}

/// Newton at fixed parameters from a state near by.
pub(crate) fn settle<P: Problem>(problem: &mut P, tolerance: f64) -> Result<(), Miss> {
    let mut step = vec![0.0; problem.system().unknowns()];
    let mut before = f64::INFINITY;
    let mut borne = Borne::default();
    for _ in 0..MOST {
        problem.system().linearise()?;
        problem.system().newton_step(&mut step);
        let size = problem.system().size(&step);
        let stands = size > WORST * before;
        if !size.is_finite() || (stands && size > ROUND_OFF && !borne.bear(size, before)) {
            return Err(Miss::NotContracting);
        }
        problem.system().retract(&step);
        if size <= tolerance || (stands && size <= ROUND_OFF) {
            return Ok(());
        }
        before = size;
    }
    Err(Miss::NotContracting)
}

/// The step from one point to another, with the first parameter's.
pub fn between<P: Problem>(problem: &mut P, from: &Point, to: &Point) -> Tangent {
    let mut step = vec![0.0; problem.system().unknowns()];
    problem.system().difference(&from.state, &to.state, &mut step);
    Tangent { step, parameter: to.parameters[0] - from.parameters[0] }
}
