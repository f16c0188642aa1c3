//! Branches that leave a point at which several directions become critical at once.
//!
//! Differences make the equations that decide how they leave (`algebraic`), whose zeros are led to the branches themselves; of two halves
//! that leave in opposite directions the tangent is the difference, in which what bends them is gone.

use crate::algebraic::{Algebraic, Half, dot};
use crate::corrector::between;
use crate::multiple::{heard, inverse};
use crate::problem::{Point, Problem, Tangent, slope};
use crate::walker::{WalkOptions, largest};
use flexura_nonlinear::{Liftable, System};

/// A branch that leaves.
#[derive(Clone, Debug)]
pub struct Leaving {
    /// Its direction.
    pub tangent: Tangent,
    /// Points of it close by, against its direction and along it, where they are known.
    pub points: [Option<Point>; 2],
}

impl From<Tangent> for Leaving {
    fn from(tangent: Tangent) -> Self {
        Self { tangent, points: [None, None] }
    }
}

/// What was found.
#[derive(Clone, Debug)]
pub enum Spread {
    /// The branches, each of which leaves both ways.
    Branches(Vec<Leaving>),
    /// So many that they form a family, as the directions in which a round column may bend do.
    Family,
}

/// Most directions of which the equations are made.
const MOST: usize = 4;
/// Length of the differences beside the largest step, and what it is divided by where equations cannot be had: how strongly a mechanism
/// bends from its kernel no measure of the kernel tells.
const LENGTH: f64 = 0.1;
const SHORTER: f64 = 4.0;
const LENGTHS: i32 = 8;
/// Where the rows are chosen, as a part of the differences.
const ASIDE: f64 = 0.02;
/// Size of the last correction of a value, as a part of the sphere: differences of the third order are to be told from it.
const EVEN: f64 = 1e-8;
/// Newton steps to a point.
const STEPS: usize = 30;
/// A point that is not reached in this many times its length is another one's.
const FARTHEST: f64 = 4.0;
/// Cosine of the angle between two directions that are one, and that of a half to what it was led from.
const SAME: f64 = 0.99;
const LED: f64 = 0.9;

/// Finds the branches at a point whose tangent vanishes along `kernel`, but for the path itself, which runs along `path`.
pub fn spread<P: Problem>(
    problem: &mut P,
    options: &WalkOptions,
    from: &Point,
    kernel: &[Vec<f64>],
    path: &Tangent,
) -> Spread {
    let count = kernel.len();
    if count > MOST {
        return Spread::Branches(Vec::new());
    }
    let most = 3_usize.pow(count as u32) + 1;
    for length in (0..LENGTHS).map(|i| LENGTH / SHORTER.powi(i)) {
        let mut sphere = Sphere::new(problem, options, from, kernel, path, length);
        let Some(equations) = sphere.as_mut().and_then(|sphere| sphere.equations(problem)) else { continue };
        let Some(sphere) = sphere else { continue };
        let halves = equations.halves(most);
        if halves.len() > most {
            return Spread::Family;
        }
        let led: Vec<Led> = halves.iter().filter_map(|half| sphere.lead(problem, options, half)).collect();
        let found = whole(problem.system(), led, path);
        if !found.is_empty() {
            return Spread::Branches(found);
        }
    }
    Spread::Branches(Vec::new())
}

/// A half that was led to its branch: the direction of its amplitudes, the way there and the point.
struct Led {
    amplitudes: Vec<f64>,
    way: Tangent,
    point: Point,
}

/// Joins halves that leave in opposite directions, without those of the path.
fn whole<S: Liftable>(system: &S, mut halves: Vec<Led>, path: &Tangent) -> Vec<Leaving> {
    let path = path.clone().normalised(system);
    let mut found: Vec<Leaving> = Vec::new();
    while let Some(half) = halves.pop() {
        let cosine = |other: &Led| dot(&other.amplitudes, &half.amplitudes);
        let opposite = (0..halves.len()).min_by(|a, b| cosine(&halves[*a]).total_cmp(&cosine(&halves[*b])));
        let mut tangent = half.way;
        let mut back = None;
        if let Some(opposite) = opposite.filter(|i| cosine(&halves[*i]) < -LED) {
            let other = halves.swap_remove(opposite);
            tangent.step.iter_mut().zip(&other.way.step).for_each(|(t, o)| *t -= o);
            tangent.parameter -= other.way.parameter;
            back = Some(other.point);
        }
        let tangent = tangent.normalised(system);
        let same = |other: &Tangent| other.product(system, &tangent.step, tangent.parameter).abs() > SAME;
        if !same(&path) && !found.iter().any(|other| same(&other.tangent)) {
            found.push(Leaving { tangent, points: [back, Some(half.point)] });
        }
    }
    found
}

/// A small sphere of amplitudes around the point.
struct Sphere<'a> {
    from: &'a Point,
    kernel: &'a [Vec<f64>],
    /// Equations that are given up.
    rows: Vec<usize>,
    /// What the parameter does aside of the kernel. Where nothing else moved, the tangent would stay as critical as it is.
    along: Vec<f64>,
    /// Length of an amplitude of one, and of a change of the parameter by one.
    radius: f64,
    shift: f64,
}

impl<'a> Sphere<'a> {
    fn new<P: Problem>(
        problem: &mut P,
        options: &WalkOptions,
        from: &'a Point,
        kernel: &'a [Vec<f64>],
        path: &Tangent,
        length: f64,
    ) -> Option<Self> {
        let widest = |system: &P::System, direction: &Vec<f64>| {
            largest(system, &Tangent { step: direction.clone(), parameter: 0.0 }, options)
        };
        from.restore(problem).ok()?;
        let radius =
            kernel.iter().map(|c| widest(problem.system(), c)).fold(f64::INFINITY, f64::min) * length;
        let mut sphere = Self {
            from,
            kernel,
            rows: Vec::new(),
            along: Vec::new(),
            radius,
            shift: length * options.largest_parameter,
        };
        // A little along the path, where the tangent has an inverse: aside of it rows would be heard that at the point are not.
        let mut along = path.clone();
        along.scale(ASIDE * length * largest(problem.system(), path, options));
        problem.system().retract(&along.step);
        let parameters = from.parameters;
        problem.set_parameters([parameters[0] + along.parameter, parameters[1]]).ok()?;
        problem.system().linearise().ok()?;
        let mut along = slope(problem, 0).ok()?;
        for direction in kernel {
            let part = problem.system().product(direction, &along);
            along.iter_mut().zip(direction).for_each(|(a, d)| *a -= part * d);
        }
        sphere.along = along;
        sphere.rows = heard(problem.system(), kernel);
        Some(sphere)
    }

    /// Goes to a place by the kernel and by what the parameter does beside it.
    fn go<P: Problem>(&self, problem: &mut P, amplitudes: &[f64], parameter: f64) -> Option<()> {
        self.from.restore(problem).ok()?;
        let mut step = vec![0.0; problem.system().unknowns()];
        for (amplitude, direction) in amplitudes.iter().zip(self.kernel) {
            let by = amplitude * self.radius;
            step.iter_mut().zip(direction).for_each(|(s, d)| *s += by * d);
        }
        let shift = parameter * self.shift;
        step.iter_mut().zip(&self.along).for_each(|(s, a)| *s += shift * a);
        problem.system().retract(&step);
        let parameters = self.from.parameters;
        problem.set_parameters([parameters[0] + shift, parameters[1]]).ok()
    }

    fn equations<P: Problem>(&mut self, problem: &mut P) -> Option<Algebraic> {
        Algebraic::by_differences(self.kernel.len(), |amplitudes, parameter| {
            self.value(problem, amplitudes, parameter)
        })
    }

    /// g there: what the rows that are given up must bear so that all others hold, by Newton's method at fixed amplitudes.
    fn value<P: Problem>(&self, problem: &mut P, amplitudes: &[f64], parameter: f64) -> Option<Vec<f64>> {
        self.go(problem, amplitudes, parameter)?;
        let unknowns = problem.system().unknowns();
        let mut step = vec![0.0; unknowns];
        for _ in 0..STEPS {
            let gone = {
                let here = Point::here(problem);
                between(problem, self.from, &here)
            };
            let system = problem.system();
            system.linearise().ok()?;
            system.newton_step(&mut step);
            let mut borne = Vec::with_capacity(self.rows.len());
            for &row in &self.rows {
                let mut one = vec![0.0; unknowns];
                system.unit_step(row, &mut one);
                borne.push(one);
            }
            let columns: Vec<Vec<f64>> = borne
                .iter()
                .map(|one| self.kernel.iter().map(|c| system.product(c, one)).collect())
                .collect();
            let missing: Vec<f64> = self
                .kernel
                .iter()
                .zip(amplitudes)
                .map(|(c, z)| z * self.radius - system.product(c, &gone.step) - system.product(c, &step))
                .collect();
            let inverse = inverse(columns)?;
            let forces: Vec<f64> = inverse.chunks(missing.len()).map(|row| dot(row, &missing)).collect();
            for (force, one) in forces.iter().zip(&borne) {
                step.iter_mut().zip(one).for_each(|(s, o)| *s += force * o);
            }
            let size = system.size(&step);
            if !size.is_finite() || size > FARTHEST * self.radius.max(self.shift) {
                return None;
            }
            system.retract(&step);
            if size <= EVEN * self.radius {
                return Some(forces);
            }
        }
        None
    }

    /// From a zero of the equations to the branch: its amplitudes and the way there. Where other directions are nearly critical still,
    /// corrections first grow, which the corrector of a path rightly takes for leaving it.
    fn lead<P: Problem>(&self, problem: &mut P, options: &WalkOptions, half: &Half) -> Option<Led> {
        self.go(problem, &half.amplitudes, half.parameter)?;
        let mut across = vec![0.0; problem.system().unknowns()];
        for (amplitude, direction) in half.amplitudes.iter().zip(self.kernel) {
            across.iter_mut().zip(direction).for_each(|(a, d)| *a += amplitude * d);
        }
        let across = Tangent { step: across, parameter: 0.0 }.normalised(problem.system());
        let reach = (self.radius * across.size(problem.system())).max(half.parameter.abs() * self.shift);
        let mut step = vec![0.0; problem.system().unknowns()];
        for _ in 0..STEPS {
            problem.system().linearise().ok()?;
            problem.system().newton_step(&mut step);
            let along = slope(problem, 0).ok()?;
            let system = problem.system();
            let mut dp = -across.product(system, &step, 0.0) / across.product(system, &along, 0.0);
            step.iter_mut().zip(&along).for_each(|(s, v)| *s += v * dp);
            let size = system.size(&step).max(dp.abs());
            if !size.is_finite() {
                return None;
            }
            if size > reach {
                // The tangent hardly has an inverse near the point: long steps lead anywhere.
                let part = reach / size;
                step.iter_mut().for_each(|s| *s *= part);
                dp *= part;
            }
            system.retract(&step);
            let mut parameters = problem.parameters();
            parameters[0] += dp;
            problem.set_parameters(parameters).ok()?;
            if size <= options.tolerance {
                let point = Point::here(problem);
                let gone = between(problem, self.from, &point);
                let system = problem.system();
                let mut amplitudes: Vec<f64> =
                    self.kernel.iter().map(|c| system.product(c, &gone.step)).collect();
                let length = dot(&amplitudes, &amplitudes).sqrt();
                amplitudes.iter_mut().for_each(|a| *a /= length);
                let is_near = gone.size(system) <= FARTHEST * reach;
                let is_led = is_near && dot(&amplitudes, &half.amplitudes) > LED;
                return is_led.then_some(Led { amplitudes, way: gone, point });
            }
        }
        None
    }
}
