//! What can be followed.

use flexura_nonlinear::{Breakdown, Liftable, System};

/// Why a point cannot be had.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The residual or tangent has no sound numbers, or the tangent no inverse.
    Broken(Breakdown),
    /// The parameter has no such value: the message says why.
    Parameter(String),
}

impl From<Breakdown> for Refusal {
    fn from(breakdown: Breakdown) -> Self {
        Refusal::Broken(breakdown)
    }
}

/// The first parameter, in which paths are followed, and the second, for curves of critical points; both scaled so that
/// one is a large change.
pub type Parameters = [f64; 2];

/// A system r(x; p, q) = 0 of one or two parameters.
pub trait Problem {
    /// The equations at the present parameters.
    type System: Liftable;

    /// The equations at the present parameters.
    fn system(&mut self) -> &mut Self::System;

    /// The present parameters.
    fn parameters(&self) -> Parameters;

    /// Changes the parameters; the state stays where it is.
    ///
    /// # Errors
    /// The parameters cannot have these values.
    fn set_parameters(&mut self, values: Parameters) -> Result<(), Refusal>;

    /// The number of unstable directions of the present solution, where the last tangent was made; None where that is not decided.
    fn index(&mut self) -> Option<usize>;
}

/// A solution: what has to be put back to be there again.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// Both parameters.
    pub parameters: Parameters,
    /// The stored state.
    pub state: Vec<f64>,
}

impl Point {
    /// The present one.
    pub fn here<P: Problem>(problem: &mut P) -> Self {
        let mut state = Vec::new();
        problem.system().store(&mut state);
        Self { parameters: problem.parameters(), state }
    }

    /// Goes there.
    ///
    /// # Errors
    /// As [`Problem::set_parameters`].
    pub fn restore<P: Problem>(&self, problem: &mut P) -> Result<(), Refusal> {
        problem.system().restore(&self.state);
        problem.set_parameters(self.parameters)
    }
}

/// A direction of a path: a step of the state and of the first parameter.
#[derive(Clone, Debug, Default)]
pub struct Tangent {
    /// Along the state.
    pub step: Vec<f64>,
    /// Along the first parameter.
    pub parameter: f64,
}

impl Tangent {
    /// The scalar product in which paths are measured.
    pub fn product<S: Liftable>(&self, system: &S, step: &[f64], parameter: f64) -> f64 {
        system.product(&self.step, step) + self.parameter * parameter
    }

    /// Made one long.
    pub fn normalised<S: Liftable>(mut self, system: &S) -> Self {
        let length = self.product(system, &self.step, self.parameter).sqrt();
        self.scale(1.0 / length);
        self
    }

    /// Multiplied by a number.
    pub fn scale(&mut self, factor: f64) {
        self.step.iter_mut().for_each(|v| *v *= factor);
        self.parameter *= factor;
    }

    /// The largest scaled change, of the state or of the parameter.
    pub fn size<S: Liftable>(&self, system: &S) -> f64 {
        system.size(&self.step).max(self.parameter.abs())
    }
}

/// Step of the one-sided difference that gives the derivative along a parameter where it only points the way; short, for what a drive
/// does to stiff beams is far from linear.
const DIFFERENCE: f64 = 1e-7;
/// Step of the central difference where the derivative itself is wanted.
const CENTRAL: f64 = 1e-5;

/// `-J⁻¹ ∂r/∂p` along parameter `which`, with the last tangent, at the present state, whose residual must be the system's last one.
/// Afterwards that is the one of a neighbouring parameter.
///
/// # Errors
/// As [`Problem::set_parameters`].
pub fn slope<P: Problem>(problem: &mut P, which: usize) -> Result<Vec<f64>, Refusal> {
    let here = problem.parameters();
    let n = problem.system().unknowns();
    let point = Point::here(problem);
    let (mut before, mut after) = (vec![0.0; n], vec![0.0; n]);
    problem.system().newton_step(&mut before);
    // Where the parameter can go one way only, the other side serves.
    let mut refused = Refusal::Broken(Breakdown::NotFinite);
    for h in [DIFFERENCE, -DIFFERENCE] {
        let mut there = here;
        there[which] += h;
        let outcome = problem.set_parameters(there).and_then(|()| {
            problem.system().residual()?;
            problem.system().newton_step(&mut after);
            Ok(())
        });
        point.restore(problem)?;
        if outcome.is_ok() && after.iter().all(|v| v.is_finite()) {
            after.iter_mut().zip(&before).for_each(|(a, b)| *a = (*a - b) / h);
            return Ok(after);
        }
        if let (true, Err(refusal)) = (h > 0.0, outcome) {
            refused = refusal;
        }
    }
    Err(refused)
}

/// The same by a central difference. The system's residual is that of a neighbouring parameter afterwards.
///
/// # Errors
/// As [`Problem::set_parameters`].
pub(crate) fn central_slope<P: Problem>(problem: &mut P, which: usize) -> Result<Vec<f64>, Refusal> {
    let here = problem.parameters();
    let n = problem.system().unknowns();
    let point = Point::here(problem);
    let mut sides = [vec![0.0; n], vec![0.0; n]];
    for (side, h) in sides.iter_mut().zip([CENTRAL, -CENTRAL]) {
        let mut there = here;
        there[which] += h;
        let outcome = problem.set_parameters(there).and_then(|()| {
            problem.system().residual()?;
            problem.system().newton_step(side);
            Ok(())
        });
        point.restore(problem)?;
        outcome?;
    }
    let [up, down] = sides;
    Ok(up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * CENTRAL)).collect())
}
