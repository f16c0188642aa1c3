//! A rigid mechanism led along a parameter: its configurations, solved to round-off, and their first and second derivatives.
//!
//! Let F(ε) be the residual along a curve x(ε) of states that starts at the present one, under the law of the parameter p + ε. On
//! x(ε) = x ⊕ ε a the derivative F'(0) vanishes for a = x', and then F''(0) = -J x''. So both come from derivatives of residuals,
//! without a solve beside the present state:
//!
//! ```text
//! x' = -J⁻¹ d/dε   F(x,        p + ε)
//! x'' = -J⁻¹ d²/dε² F(x ⊕ ε x', p + ε)
//! ```
//!
//! F is made of rotations and of the laws of drives, which are smooth however near a singular position the mechanism is; central
//! differences of order eight therefore give nearly all digits, and those of order six say how many. Since ⊕ turns by exponentials in
//! global axes, the turning and shift of a body in x' and x'' are the derivatives of its velocity in the same axes.

use crate::Prepared;
use crate::family::Family;
use flexura_equilibrium::{Equilibrium, Law, ProblemError};
use flexura_model::{JointKind, Load, LoadFrame, LoadTarget, Model};
use flexura_nonlinear::{Breakdown, System};
use flexura_spatial::Vector3;

/// Weights of central differences at -4 .. 4: first derivative of orders eight and six, second of orders eight and six.
const WEIGHTS: [[f64; 9]; 4] = [
    antisymmetric([4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0]),
    antisymmetric([3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0]),
    symmetric(-205.0 / 72.0, [8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0]),
    symmetric(-49.0 / 18.0, [3.0 / 2.0, -3.0 / 20.0, 1.0 / 90.0, 0.0]),
];
/// Places on either side of the present value.
const PLACES: usize = 4;

const fn antisymmetric([a, b, c, d]: [f64; 4]) -> [f64; 9] {
    [-d, -c, -b, -a, 0.0, a, b, c, d]
}

const fn symmetric(middle: f64, [a, b, c, d]: [f64; 4]) -> [f64; 9] {
    [d, c, b, a, middle, a, b, c, d]
}

/// Motion between two places of a difference, in units of length and radians: truncation and round-off balance near it.
const SHIFT: f64 = 0.04;
/// Relative error at which a difference is good enough, and the most tries to get there.
const GOOD: f64 = 2e-11;
const TRIES: usize = 8;

/// A correction of this size is round-off.
const ROUND_OFF: f64 = 4e-14;
/// A correction that does not get smaller may be so large at most.
const STAGNANT: f64 = 1e-9;
const ITERATIONS: usize = 25;
/// How far off a predicted configuration may be, in absolute terms and as part of the motion.
const NEAR: f64 = 0.05;
const PART: f64 = 0.25;
/// How often a step is halved at most.
const HALVINGS: usize = 14;

/// Why a motion cannot be gone through.
#[derive(Debug)]
pub(crate) enum Halt {
    /// The values make no sound model.
    Model(ProblemError),
    /// The mechanism cannot be brought to this value of the parameter.
    Lost(f64),
    /// At this value something is not decided by the parameter.
    Singular(f64),
}

impl From<ProblemError> for Halt {
    fn from(error: ProblemError) -> Self {
        Halt::Model(error)
    }
}

/// Derivatives of a configuration by the parameter.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rates {
    /// Value of the parameter.
    pub value: f64,
    /// The configuration.
    pub state: Vec<f64>,
    /// First and second derivative of the state.
    pub steps: [Vec<f64>; 2],
    /// Of each joint's coordinates, SI.
    pub coordinates: [Vec<Vec<f64>>; 2],
    /// Relative error of both.
    pub error: f64,
}

pub(crate) struct Walker<'a> {
    pub prepared: Prepared,
    family: &'a mut dyn Family,
    parameter: usize,
    /// Value of the parameter that the law belongs to.
    value: f64,
    /// Distance of the places of a difference, and the largest.
    width: f64,
    widest: f64,
    /// The model at the first value: masses must stay what they are.
    first: Model,
}

impl<'a> Walker<'a> {
    /// At the first value (SI); `span` is how far the parameter goes.
    pub fn new(
        family: &'a mut dyn Family,
        parameter: usize,
        value: f64,
        span: f64,
    ) -> Result<Self, ProblemError> {
        let first = with_loads(family.model(&[(parameter, value)])?);
        let prepared = Prepared::new(&first)?;
        Ok(Self { prepared, family, parameter, value, width: 0.01 * span, widest: span, first })
    }

    pub fn problem(&mut self) -> &mut Equilibrium {
        &mut self.prepared.problem
    }

    /// The law at a value, without forces of inertia.
    fn law(&mut self, value: f64) -> Result<Law, ProblemError> {
        let model = with_loads(self.family.model(&[(self.parameter, value)])?);
        for (now, before) in model.bodies.iter().zip(&self.first.bodies) {
            if now.mass != before.mass
                || now.center_of_mass != before.center_of_mass
                || now.inertia != before.inertia
            {
                let name = &model.parameters[self.parameter].name;
                return Err(ProblemError::new(
                    format!("body.{}", now.name),
                    format!(
                        "its mass, or where it sits, changes with the parameter `{name}` that moves the mechanism"
                    ),
                    "a body that moves keeps its mass: let only joints and places depend on that parameter",
                ));
            }
        }
        self.prepared.problem.neighbour(&model)
    }

    /// Newton's method until round-off, starting from what was predicted; the size of the first correction, None where it does not
    /// converge.
    pub fn settle(&mut self) -> Option<f64> {
        let problem = &mut self.prepared.problem;
        let mut step = vec![0.0; problem.unknowns()];
        let (mut first, mut last) = (None, f64::INFINITY);
        for _ in 0..ITERATIONS {
            problem.linearise().ok()?;
            problem.newton_step(&mut step);
            let size = problem.motion_size(&step);
            let done = size <= ROUND_OFF || (last <= STAGNANT && size > 0.3 * last);
            if !size.is_finite() || (!done && size > 0.7 * last) {
                return None;
            }
            problem.retract(&step);
            first.get_or_insert(size);
            if done {
                return first;
            }
            last = size;
        }
        None
    }

    /// From a configuration whose derivatives are known to another value.
    pub fn advance(&mut self, from: &Rates, to: f64) -> Result<(), Halt> {
        let mut from = from.clone();
        let mut way = to - from.value;
        let mut halvings = 0;
        while from.value != to {
            let next = if (to - from.value).abs() <= way.abs() { to } else { from.value + way };
            if self.predicted(&from, next)? {
                if next == to {
                    return Ok(());
                }
                from = self.rates()?;
                continue;
            }
            halvings += 1;
            if halvings > HALVINGS {
                return Err(Halt::Lost(next));
            }
            way *= 0.5;
        }
        Ok(())
    }

    /// One step along the second-order prediction; false where it was too far.
    fn predicted(&mut self, from: &Rates, to: f64) -> Result<bool, Halt> {
        let law = self.law(to)?;
        let step = to - from.value;
        let problem = &mut self.prepared.problem;
        let before = self.value;
        problem.restore(&from.state);
        let own = problem.exchange(law);
        self.value = to;
        let [first, second] = &from.steps;
        let guess: Vec<f64> = first.iter().zip(second).map(|(a, b)| step * (a + 0.5 * step * b)).collect();
        let motion = problem.motion_size(&guess);
        problem.retract(&guess);
        let arrived = self.settle().is_some_and(|first| first <= NEAR && first <= PART * motion + STAGNANT);
        if !arrived {
            self.prepared.problem.exchange(own);
            self.prepared.problem.restore(&from.state);
            self.value = before;
        }
        Ok(arrived)
    }

    /// Derivatives at the present configuration, which must be a solved one without forces of inertia.
    pub fn rates(&mut self) -> Result<Rates, Halt> {
        let singular = Halt::Singular(self.value);
        let mut kept = Vec::new();
        self.prepared.problem.store(&mut kept);
        if self.prepared.problem.linearise().is_err() {
            return Err(singular);
        }
        self.prepared.problem.keep_tangent();
        let mut best: Option<(f64, Rates)> = None;
        let mut refused = None;
        let mut fitted = false;
        let mut width = self.width;
        for _ in 0..TRIES {
            let rates = match self.rates_of_width(&kept, width) {
                Ok(rates) => rates,
                // Beside the end of what makes sense there may be no model.
                Err(Halt::Model(error)) => {
                    width *= 0.25;
                    refused = Some(error);
                    continue;
                }
                Err(other) => return Err(other),
            };
            let motion = self.motion(&rates);
            let fitting = if motion > 0.0 { (SHIFT / motion).min(self.widest) } else { self.widest };
            let (error, before) = (rates.error, best.as_ref().map(|(_, best)| best.error));
            if before.is_none_or(|before| error < before) {
                best = Some((width, rates));
            } else if fitted {
                break;
            }
            // First to where the motion is of the right size, then to where it is smooth.
            if !fitted && refused.is_none() && !(0.5 * fitting..=1.5 * fitting).contains(&width) {
                width = fitting;
                fitted = true;
            } else if error > GOOD {
                width *= 0.5;
                fitted = true;
            } else {
                break;
            }
        }
        self.prepared.problem.restore(&kept);
        match (best, refused) {
            (Some((width, best)), _) => {
                // The next one may be smoother.
                self.width = 2.0 * width;
                let motion = self.motion(&best);
                if motion > 0.0 {
                    self.width = self.width.min(SHIFT / motion);
                }
                self.width = self.width.min(self.widest);
                Ok(best)
            }
            (None, Some(error)) => Err(Halt::Model(error)),
            (None, None) => Err(singular),
        }
    }

    /// How much the mechanism moves per unit of the parameter.
    fn motion(&self, rates: &Rates) -> f64 {
        let [first, second] = [0, 1].map(|i| self.prepared.problem.motion_size(&rates.steps[i]));
        first.max(second.sqrt())
    }

    fn rates_of_width(&mut self, kept: &[f64], width: f64) -> Result<Rates, Halt> {
        let value = self.value;
        let mut laws = Vec::with_capacity(2 * PLACES);
        for place in places() {
            laws.push(Some(self.law(value + place * width)?));
        }
        let lost = |_: Breakdown| Halt::Singular(value);
        let problem = &mut self.prepared.problem;
        let n = problem.unknowns();
        let still = vec![0.0; n];
        let correction = |problem: &mut Equilibrium| -> Result<Vec<f64>, Breakdown> {
            let mut step = vec![0.0; n];
            problem.residual()?;
            problem.kept_step(&mut step);
            Ok(step)
        };
        let along = around(problem, &mut laws, kept, [&still, &still], width, correction).map_err(lost)?;
        let first = combined(&along, WEIGHTS[0], width);
        let rough = combined(&along, WEIGHTS[1], width);
        let along = around(problem, &mut laws, kept, [&first, &still], width, correction).map_err(lost)?;
        let second = combined(&along, WEIGHTS[2], width * width);
        let rough_second = combined(&along, WEIGHTS[3], width * width);
        let read = |problem: &mut Equilibrium| Ok(problem.joint_coordinates());
        let along = around(problem, &mut laws, kept, [&first, &second], width, read).map_err(lost)?;
        let along = unwrapped(problem.model(), along);
        let coordinates = [(0, width), (2, width * width)].map(|(order, unit)| {
            (0..problem.model().joints.len())
                .map(|joint| {
                    let one: Vec<Vec<f64>> = along.iter().map(|all| all[joint].clone()).collect();
                    combined(&one, WEIGHTS[order], unit)
                })
                .collect()
        });

        let differ = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a - b).collect() };
        let [slope, bend] = [&first, &second].map(|step| problem.motion_size(step));
        let scale = bend.max(slope * slope);
        let truncated = |error: f64, size: f64| {
            // The error of order six, which is larger than that of order eight by two powers of the step.
            if size > 0.0 { (error / size).powf(4.0 / 3.0) } else { 0.0 }
        };
        let motion = slope.max(bend.sqrt()) * width;
        let rounded = if motion > 0.0 { 4.0 * f64::EPSILON / (motion * motion) } else { 0.0 };
        let error = truncated(problem.motion_size(&differ(&first, &rough)), slope.max(scale.sqrt()))
            .max(truncated(problem.motion_size(&differ(&second, &rough_second)), scale))
            .max(rounded);
        Ok(Rates { value, state: kept.to_vec(), steps: [first, second], coordinates, error })
    }
}

/// -4 .. -1, 1 .. 4.
fn places() -> impl Iterator<Item = f64> {
    (1..=PLACES).rev().map(|k| -(k as f64)).chain((1..=PLACES).map(|k| k as f64))
}

/// Reads something off at -4 .. 4 widths along a curve of states x ⊕ (ε a + ε² b / 2), each under its law.
fn around<T>(
    problem: &mut Equilibrium,
    laws: &mut [Option<Law>],
    kept: &[f64],
    [first, second]: [&[f64]; 2],
    width: f64,
    read: impl Fn(&mut Equilibrium) -> Result<T, Breakdown>,
) -> Result<Vec<T>, Breakdown> {
    let mut all = Vec::with_capacity(2 * PLACES + 1);
    for (i, place) in places().enumerate() {
        if i == PLACES {
            problem.restore(kept);
            all.push(read(problem)?);
        }
        let Some(law) = laws[i].take() else { return Err(Breakdown::NotFinite) };
        problem.restore(kept);
        let own = problem.exchange(law);
        let by = place * width;
        let step: Vec<f64> = first.iter().zip(second).map(|(a, b)| by * (a + 0.5 * by * b)).collect();
        problem.retract(&step);
        let value = read(problem);
        laws[i] = Some(problem.exchange(own));
        problem.restore(kept);
        all.push(value?);
    }
    Ok(all)
}

fn combined(values: &[Vec<f64>], weights: [f64; 9], unit: f64) -> Vec<f64> {
    let mut sum = vec![0.0; values.first().map_or(0, Vec::len)];
    // From outside inwards: the small terms first.
    for k in (0..=PLACES).rev() {
        for i in if k == 0 { vec![PLACES] } else { vec![PLACES - k, PLACES + k] } {
            sum.iter_mut().zip(&values[i]).for_each(|(sum, value)| *sum += weights[i] * value);
        }
    }
    sum.iter_mut().for_each(|sum| *sum /= unit);
    sum
}

/// Rotation vectors that turn over at half a turn are led on beyond it.
fn unwrapped(model: &Model, mut along: Vec<Vec<Vec<f64>>>) -> Vec<Vec<Vec<f64>>> {
    let turning = |kind: JointKind| match kind {
        JointKind::Spherical => Some(0),
        JointKind::Free => Some(3),
        JointKind::Contact => Some(0),
        _ => None,
    };
    for (j, joint) in model.joints.iter().enumerate() {
        let Some(at) = turning(joint.law.kind) else { continue };
        let middle = Vector3::from_column_slice(&along[PLACES][j][at..at + 3]);
        for place in &mut along {
            let vector = Vector3::from_column_slice(&place[j][at..at + 3]);
            if (vector - middle).norm() > std::f64::consts::PI {
                let other = vector * (1.0 - std::f64::consts::TAU / vector.norm());
                place[j][at..at + 3].copy_from_slice(other.as_slice());
            }
        }
    }
    along
}

/// The model with a load at the centre of mass of each body, for the forces of inertia.
fn with_loads(mut model: Model) -> Model {
    for (i, body) in model.bodies.iter().enumerate() {
        model.loads.push(Load {
            name: format!("inertia-of-{}", body.name),
            target: LoadTarget::Body { body: flexura_model::BodyId(i), point: body.center_of_mass },
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            frame: LoadFrame::Global,
        });
    }
    model
}
