//! Folds and branch points followed in two parameters.
//!
//! On the surface of `reduced` a fold is μ = μ_ξ = 0 in (ξ, p, q), a branch point μ_ξ = μ_p = 0: curves in three numbers, followed by
//! pseudo-arclength with differences of the first derivatives, which are exact. The lift is chosen anew at every point.

use crate::corrector::Miss;
use crate::problem::{Point, Problem};
use crate::reduced::{Choice, Surface, Value};
use flexura_nonlinear::System;

/// Why a curve ends.
#[derive(Clone, Debug, PartialEq)]
pub enum CriticalEnd {
    /// Steps became too short.
    Short,
}

/// Follows a critical point.
#[derive(Clone, Debug)]
pub struct CriticalWalker {
    fold: bool,
    surface: Surface,
    here: Value,
    /// Direction of the curve in (ξ, p, q), ξ measured by the size of the state's change.
    direction: [f64; 3],
    width: f64,
    largest: f64,
}

const STATE: f64 = 2e-4;
const PARAMETER: f64 = 1e-4;
/// A difference that is tried where the usual one reaches too far.
const SHORTER: f64 = 0.05;
const MOST: usize = 8;
const ENOUGH: f64 = 1e-8;
const SHORTEST: f64 = 1e-6;

/// The two conditions.
fn conditions(value: &Value, fold: bool) -> [f64; 2] {
    if fold { [value.mu, value.slope[0]] } else { [value.slope[0], value.slope[1]] }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl CriticalWalker {
    /// Starts at a critical point, towards larger (`1.0`) or smaller (`-1.0`) values of the second parameter, with steps of at
    /// most `largest` in either parameter and in the size of the state.
    ///
    /// # Errors
    /// The point is not critical, or nothing can be had there.
    pub fn start<P: Problem>(
        problem: &mut P,
        at: &Point,
        fold: bool,
        largest: f64,
        sense: f64,
    ) -> Result<Self, CriticalEnd> {
        at.restore(problem).map_err(|_| CriticalEnd::Short)?;
        let surface = Surface::choose(problem, true, Choice::Largest).ok_or(CriticalEnd::Short)?;
        at.restore(problem).map_err(|_| CriticalEnd::Short)?;
        let value = surface.settle(problem).map_err(|_| CriticalEnd::Short)?;
        let mut direction = along(problem, &surface, &value, fold).map_err(|_| CriticalEnd::Short)?;
        if direction[2] * sense < 0.0 {
            direction = direction.map(|v| -v);
        }
        let here = correct(problem, &surface, value, fold, &direction).map_err(|_| CriticalEnd::Short)?;
        Ok(Self { fold, surface, here, direction, width: 0.5 * largest, largest })
    }

    /// The present point.
    pub fn point(&self) -> &Point {
        &self.here.point
    }

    /// The null direction of the tangent there.
    pub fn kernel(&self) -> &[f64] {
        &self.here.along[0]
    }

    /// One step along the curve. The problem stands at the new point afterwards.
    ///
    /// # Errors
    /// The curve cannot be followed further.
    pub fn advance<P: Problem>(&mut self, problem: &mut P) -> Result<(), CriticalEnd> {
        while self.width > SHORTEST * self.largest {
            match self.step(problem) {
                Ok((here, surface, direction, cosine)) if cosine > 0.8 => {
                    self.surface = surface;
                    self.here = here;
                    self.direction = direction;
                    let growth = if cosine > 0.98 { 1.6 } else { 1.0 };
                    self.width = (self.width * growth).min(self.largest);
                    return self.here.point.restore(problem).map_err(|_| CriticalEnd::Short);
                }
                _ => self.width *= 0.4,
            }
        }
        let _ = self.here.point.restore(problem);
        Err(CriticalEnd::Short)
    }

    /// The point between the last and a new one at which the second parameter has a value.
    ///
    /// # Errors
    /// None is found.
    pub fn at_second<P: Problem>(
        &self,
        problem: &mut P,
        from: &Self,
        value: f64,
    ) -> Result<Self, CriticalEnd> {
        let mut walker = from.clone();
        for _ in 0..30 {
            let left = value - walker.here.point.parameters[1];
            if left.abs() <= 1e-12 {
                return Ok(walker);
            }
            walker.width = (left / walker.direction[2]).clamp(-self.largest, self.largest);
            let (here, surface, mut direction, _) = walker.step(problem).map_err(|_| CriticalEnd::Short)?;
            if dot(&direction, &walker.direction) < 0.0 {
                direction = direction.map(|v| -v);
            }
            (walker.here, walker.surface, walker.direction) = (here, surface, direction);
        }
        Err(CriticalEnd::Short)
    }

    fn step<P: Problem>(&self, problem: &mut P) -> Result<(Value, Surface, [f64; 3], f64), Miss> {
        self.here.point.restore(problem)?;
        let surface = self.surface.improved(problem).ok_or(Miss::NotContracting)?;
        self.here.point.restore(problem)?;
        // The same point, seen on this lift's surface.
        let start = surface.settle(problem)?;
        let mut direction = along(problem, &surface, &start, self.fold)?;
        let flow = self.compare(problem, &start, &direction);
        if flow < 0.0 {
            direction = direction.map(|v| -v);
        }
        let scale = problem.system().size(&start.along[0]).max(1e-9);
        let way = [direction[0] * self.width / scale, direction[1] * self.width, direction[2] * self.width];
        let guess = surface.at(problem, &start, way)?;
        let value = correct(problem, &surface, guess, self.fold, &direction)?;
        let mut next = along(problem, &surface, &value, self.fold)?;
        let mut cosine = dot(&next, &direction);
        if cosine < 0.0 {
            next = next.map(|v| -v);
            cosine = -cosine;
        }
        Ok((value, surface, next, cosine))
    }

    /// Which way a direction found on another lift's surface goes along ours: by both parameters and the state.
    fn compare<P: Problem>(&self, problem: &mut P, start: &Value, direction: &[f64; 3]) -> f64 {
        let step = |system: &P::System, value: &Value, d: &[f64; 3]| -> Vec<f64> {
            let scale = system.size(&value.along[0]).max(1e-9);
            let by = [d[0] / scale, d[1], d[2]];
            (0..value.along[0].len()).map(|i| (0..3).map(|k| value.along[k][i] * by[k]).sum()).collect()
        };
        let system = problem.system();
        let (old, new) = (step(system, &self.here, &self.direction), step(system, start, direction));
        let states = if old.len() == new.len() { system.product(&old, &new) } else { 0.0 };
        states + self.direction[1] * direction[1] + self.direction[2] * direction[2]
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(&v, &v).sqrt();
    v.map(|x| x / length)
}

/// Derivatives of the two conditions along (ξ, p, q), ξ measured by the size of the state's change.
fn derivatives<P: Problem>(
    problem: &mut P,
    surface: &Surface,
    value: &Value,
    fold: bool,
) -> Result<[[f64; 3]; 2], Miss> {
    let scale = problem.system().size(&value.along[0]).max(1e-9);
    let mut rows = [[0.0; 3]; 2];
    for k in 0..3 {
        let (width, unit) = if k == 0 { (STATE / scale, STATE) } else { (PARAMETER, PARAMETER) };
        let mut sides = |part: f64| -> Result<[[f64; 2]; 2], Miss> {
            let mut way = [0.0; 3];
            way[k] = part * width;
            let up = conditions(&surface.at(problem, value, way)?, fold);
            way[k] = -part * width;
            Ok([up, conditions(&surface.at(problem, value, way)?, fold)])
        };
        // Near the end of what exists a shorter difference may do; at the very end, one to one side.
        let found = match sides(1.0) {
            Ok(found) => Ok((2.0, found)),
            Err(_) => sides(SHORTER).map(|found| (2.0 * SHORTER, found)),
        };
        let (part, [up, down]) = match found {
            Ok(found) => found,
            Err(miss) => {
                let here = conditions(value, fold);
                let mut one = |sign: f64| -> Result<[f64; 2], Miss> {
                    let mut way = [0.0; 3];
                    way[k] = sign * SHORTER * width;
                    Ok(conditions(&surface.at(problem, value, way)?, fold))
                };
                match (one(1.0), one(-1.0)) {
                    (Ok(up), _) => (SHORTER, [up, here]),
                    (_, Ok(down)) => (SHORTER, [here, down]),
                    _ => return Err(miss),
                }
            }
        };
        for i in 0..2 {
            rows[i][k] = (up[i] - down[i]) / (part * unit);
        }
    }
    value.point.restore(problem)?;
    Ok(rows)
}

/// The direction in which both conditions stay.
fn along<P: Problem>(
    problem: &mut P,
    surface: &Surface,
    value: &Value,
    fold: bool,
) -> Result<[f64; 3], Miss> {
    // Where conditions have very different sizes the cross product would lose one of them.
    let rows = derivatives(problem, surface, value, fold)?.map(unit);
    Ok(unit(cross(&rows[0], &rows[1])))
}

/// Newton for both conditions in the plane across `direction`.
fn correct<P: Problem>(
    problem: &mut P,
    surface: &Surface,
    mut value: Value,
    fold: bool,
    direction: &[f64; 3],
) -> Result<Value, Miss> {
    let mut before = f64::INFINITY;
    for _ in 0..MOST {
        let rows = derivatives(problem, surface, &value, fold)?;
        let right = conditions(&value, fold);
        // Cramer's rule with the right side (-c1, -c2, 0).
        let (first, second) = (cross(&rows[1], direction), cross(direction, &rows[0]));
        let determinant = dot(&rows[0], &first);
        let way: [f64; 3] =
            std::array::from_fn(|k| -(right[0] * first[k] + right[1] * second[k]) / determinant);
        let size = way.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
        if !size.is_finite() || size > 0.7 * before {
            return Err(Miss::NotContracting);
        }
        let scale = problem.system().size(&value.along[0]).max(1e-9);
        value = surface.at(problem, &value, [way[0] / scale, way[1], way[2]])?;
        if size <= ENOUGH {
            return Ok(value);
        }
        before = size;
    }
    Err(Miss::NotContracting)
}
