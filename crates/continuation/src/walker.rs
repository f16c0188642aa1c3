//! Along a path, step by step.
//!
//! A step is predicted along the path's tangent, bent as it bent before, and must prove that it stays on the path: the
//! prediction is near, Newton contracts at once, and the direction changes little. Between two points the sign of det J, the sign of
//! the parameter's rate and the count of unstable directions tell what was passed; what cannot be told apart is looked at
//! again in shorter steps (`passed`).

mod corner;
mod leave;
mod passed;

use crate::corrector::{Limits, Miss, between, correct, settle};
use crate::locate::Special;
use crate::problem::{Point, Problem, Refusal, Tangent, slope};
use flexura_nonlinear::{Breakdown, System};

/// How a path is followed.
#[derive(Clone, Copy, Debug)]
pub struct WalkOptions {
    /// Size of the last correction of a point.
    pub tolerance: f64,
    /// Largest size of a step of the state.
    pub largest_change: f64,
    /// Largest step of the parameter.
    pub largest_parameter: f64,
    /// Shortest step, as a part of the largest.
    pub shortest: f64,
    /// First correction, as a part of the step, at which a step is refused, and what is aimed at.
    pub farthest: f64,
    /// What is aimed at.
    pub aim: f64,
    /// Smallest cosine between the directions of two neighbouring points, and what is aimed at.
    pub least_cosine: f64,
    /// Cosine that is aimed at.
    pub aimed_cosine: f64,
    /// Are paths led round corners, at which their direction turns at once?
    pub rounds_corners: bool,
}

impl Default for WalkOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            largest_change: 0.25,
            largest_parameter: 0.025,
            shortest: 1e-7,
            farthest: 0.3,
            aim: 0.05,
            least_cosine: 0.75,
            aimed_cosine: 0.94,
            rounds_corners: true,
        }
    }
}

/// A regular point of a path.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where it is.
    pub point: Point,
    /// The path's direction, of length one.
    pub tangent: Tangent,
    /// Is det J positive? Only comparable between points of one layout.
    pub positive: bool,
    /// Number of unstable directions, if decided.
    pub index: Option<usize>,
    /// Way along the path.
    pub arc: f64,
    slope: Vec<f64>,
}

/// What a step came to.
#[derive(Clone, Debug)]
pub enum Advance {
    /// A new point, and what was passed on the way, in order.
    To(Vec<Special>),
    /// The path cannot be followed further.
    Stalled(Stall),
}

/// Why a path cannot be followed.
#[derive(Clone, Debug, PartialEq)]
pub enum Stall {
    /// Steps became too short.
    Short,
    /// Beyond, the parameter has no sound values.
    Parameter(String),
}

/// Counts of a walk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WalkWork {
    /// Steps taken.
    pub taken: usize,
    /// Steps refused.
    pub refused: usize,
}

/// Follows a path.
#[derive(Clone, Debug)]
pub struct Walker {
    options: WalkOptions,
    here: Place,
    /// The direction at the point before, and the step between.
    before: Option<(Tangent, f64)>,
    /// Length of the next step.
    width: f64,
    /// The last accepted step, by length and direction, for points between.
    last: Option<(Place, f64)>,
    is_tangent_here: bool,
    work: WalkWork,
    /// Steps round corners since the path was clear.
    corners: usize,
}

/// Size of a correction below which a step's tangent is made anew: what is left to correct then is nothing to the tangent.
const LATE: f64 = 1e-4;
/// Steps below this part of the longest are led round corners (`corner.rs`); such steps before the path is clear again, from which it is
/// not corners that keep it; and the part of the longest from which a step shows the path clear.
const CORNER: f64 = 1e-4;
const CROWDED: usize = 8;
const CLEAR: f64 = 1e-2;

impl Walker {
    /// Starts at the present solution, towards larger (`1.0`) or smaller (`-1.0`) parameters.
    ///
    /// # Errors
    /// The tangent cannot be had there, or no solution is near.
    pub fn start<P: Problem>(problem: &mut P, options: WalkOptions, direction: f64) -> Result<Self, Refusal> {
        settle(problem, options.tolerance).map_err(|miss| match miss {
            Miss::Refused(refusal) => refusal,
            _ => Refusal::Broken(Breakdown::Singular),
        })?;
        problem.system().linearise()?;
        let (slope, mut tangent) = direction_here(problem)?;
        if tangent.parameter * direction < 0.0 {
            tangent.scale(-1.0);
        }
        let here = Place {
            point: Point::here(problem),
            positive: problem.system().orientation(),
            index: problem.index(),
            arc: 0.0,
            tangent,
            slope,
        };
        let width = 0.5 * largest(problem.system(), &here.tangent, &options);
        Ok(Self {
            options,
            here,
            before: None,
            width,
            last: None,
            is_tangent_here: true,
            work: WalkWork::default(),
            corners: 0,
        })
    }

    /// The present point.
    pub fn here(&self) -> &Place {
        &self.here
    }

    /// What was done.
    pub fn work(&self) -> WalkWork {
        self.work
    }

    /// Tells that the problem was used for something else: its last tangent is not that of the present point.
    pub fn disturbed(&mut self) {
        self.is_tangent_here = false;
    }

    /// Brings the present point back to the path after the problem's discretisation has changed; `tangent` is the path's
    /// direction in the layout that is now in force, if that is another one.
    ///
    /// # Errors
    /// No point is found near.
    pub fn polish<P: Problem>(&mut self, problem: &mut P, tangent: Option<Tangent>) -> Result<(), Stall> {
        if let Some(tangent) = tangent {
            self.here.tangent = tangent.normalised(problem.system());
            self.here.point = Point::here(problem);
            self.before = None;
            self.last = None;
        }
        self.is_tangent_here = false;
        self.here.point.restore(problem).map_err(stall)?;
        let limits = Limits {
            tolerance: self.options.tolerance,
            farthest: 1.0,
            reach: self.options.largest_change,
            renewed_below: 0.0,
        };
        let polished = correct(problem, &self.here.tangent, None, &limits);
        polished.map_err(|_| Stall::Short)?;
        problem.system().linearise().map_err(|b| stall(b.into()))?;
        let (slope, mut tangent) = direction_here(problem).map_err(stall)?;
        let ahead = &self.here.tangent;
        if tangent.product(problem.system(), &ahead.step, ahead.parameter) < 0.0 {
            tangent.scale(-1.0);
        }
        self.here = Place {
            point: Point::here(problem),
            positive: problem.system().orientation(),
            index: problem.index(),
            arc: self.here.arc,
            tangent,
            slope,
        };
        self.is_tangent_here = true;
        Ok(())
    }

    /// Where a point lies along the last step, as a part of it.
    pub fn part_of<P: Problem>(&self, problem: &mut P, point: &Point) -> f64 {
        let Some((left, width)) = &self.last else { return 1.0 };
        let to = between(problem, &left.point, point);
        left.tangent.product(problem.system(), &to.step, to.parameter) / width
    }

    /// The way along the path at a part of the last step.
    pub fn arc_at(&self, part: f64) -> f64 {
        self.last.as_ref().map_or(self.here.arc, |(left, width)| left.arc + part * width)
    }

    /// The size of the correction that takes a step `u = -J⁻¹ r` of the present point back to the plane across the path: what an
    /// error of the residual does to the point.
    pub fn across<S: flexura_nonlinear::Liftable>(&self, system: &S, u: &[f64]) -> f64 {
        let Place { tangent, slope, .. } = &self.here;
        let dp = -tangent.product(system, u, 0.0) / tangent.product(system, slope, 1.0);
        let step: Vec<f64> = u.iter().zip(slope).map(|(u, v)| u + v * dp).collect();
        system.size(&step).max(dp.abs())
    }

    /// One step along the path. The problem stands at the new point afterwards.
    pub fn advance<P: Problem>(&mut self, problem: &mut P) -> Advance {
        let mut parameter_trouble = None;
        loop {
            let cap = largest(problem.system(), &self.here.tangent, &self.options);
            self.width = self.width.min(cap);
            if self.width < self.options.shortest * cap {
                let _ = self.here.point.restore(problem);
                return Advance::Stalled(parameter_trouble.map_or(Stall::Short, Stall::Parameter));
            }
            let width = self.width;
            let at_corner = self.options.rounds_corners && width < CORNER * cap && self.corners < CROWDED;
            let tried = if at_corner { self.round(problem, width) } else { self.try_step(problem, width) };
            match tried {
                Ok((mut place, growth)) => {
                    if self.may_hold(&place) && self.exactly(problem, &mut place).is_err() {
                        self.width = 0.7 * width;
                        self.work.refused += 1;
                        continue;
                    }
                    match self.passed(problem, &self.here, &place, (&self.here, &place), passed::DEPTH) {
                        Ok(specials) => {
                            let left = std::mem::replace(&mut self.here, place);
                            if at_corner {
                                self.corners += 1;
                            } else if width > CLEAR * cap {
                                self.corners = 0;
                            }
                            // The direction has turned at once, and does not go on turning.
                            self.before = (!at_corner).then(|| (left.tangent.clone(), width));
                            self.last = Some((left, width));
                            self.width = (width * growth).min(cap);
                            self.work.taken += 1;
                            let disturbed = !specials.is_empty();
                            if disturbed {
                                self.is_tangent_here = false;
                            }
                            if self.here.point.restore(problem).is_err() {
                                return Advance::Stalled(Stall::Short);
                            }
                            return Advance::To(specials);
                        }
                        Err(()) => {
                            self.is_tangent_here = false;
                            self.width = 0.4 * width;
                        }
                    }
                }
                Err((miss, factor)) => {
                    if let Miss::Refused(Refusal::Parameter(why)) = miss {
                        parameter_trouble = Some(why);
                    }
                    self.is_tangent_here = false;
                    self.width = factor * width;
                }
            }
            self.work.refused += 1;
        }
    }

    /// The point of the last step at `part` of its length from its start: for what lies between two points.
    ///
    /// # Errors
    /// There was no step, or no point is found there.
    pub fn between<P: Problem>(&mut self, problem: &mut P, part: f64) -> Result<Place, Stall> {
        self.is_tangent_here = false;
        let Some((left, _)) = &self.last else { return Err(Stall::Short) };
        self.place_between(problem, left, &self.here, part).map_err(|miss| match miss {
            Miss::Refused(refusal) => stall(refusal),
            _ => Stall::Short,
        })
    }

    /// Goes to the point of the last step at `part` of its length, with as little work as it takes to be there.
    ///
    /// # Errors
    /// There was no step, or no point is found there.
    pub fn glance<P: Problem>(&mut self, problem: &mut P, part: f64) -> Result<(), Stall> {
        let Some((left, _)) = &self.last else { return Err(Stall::Short) };
        if !self.is_tangent_here {
            self.here.point.restore(problem).map_err(stall)?;
            problem.system().linearise().map_err(|b| stall(b.into()))?;
            self.is_tangent_here = true;
        }
        let whole = between(problem, &left.point, &self.here.point);
        left.point.restore(problem).map_err(stall)?;
        let step: Vec<f64> = whole.step.iter().map(|v| part * v).collect();
        let reach = whole.size(problem.system());
        problem.system().retract(&step);
        let parameters = left.point.parameters;
        problem.set_parameters([parameters[0] + part * whole.parameter, parameters[1]]).map_err(stall)?;
        let limits = Limits { tolerance: self.options.tolerance, farthest: 0.5, reach, renewed_below: 0.0 };
        let found = correct(problem, &self.here.tangent, Some(&self.here.slope), &limits);
        self.is_tangent_here = found.as_ref().is_ok_and(|found| !found.renewed);
        found.map(|_| ()).map_err(|_| Stall::Short)
    }

    /// The point of the last step at which the parameter has a value that lies between its ends.
    ///
    /// # Errors
    /// There was no step, or no point is found there.
    pub fn at_parameter<P: Problem>(&mut self, problem: &mut P, value: f64) -> Result<Place, Stall> {
        self.is_tangent_here = false;
        let Some((left, _)) = &self.last else { return Err(Stall::Short) };
        let whole = between(problem, &left.point, &self.here.point);
        let part = (value - left.point.parameters[0]) / whole.parameter;
        left.point.restore(problem).map_err(stall)?;
        let step: Vec<f64> = whole.step.iter().map(|v| part * v).collect();
        problem.system().retract(&step);
        problem.set_parameters([value, left.point.parameters[1]]).map_err(stall)?;
        let arc = left.arc + part * (self.here.arc - left.arc);
        settle(problem, self.options.tolerance).map_err(|_| Stall::Short)?;
        problem.system().linearise().map_err(|b| stall(b.into()))?;
        let (slope, mut tangent) = direction_here(problem).map_err(stall)?;
        if tangent.product(problem.system(), &whole.step, whole.parameter) < 0.0 {
            tangent.scale(-1.0);
        }
        Ok(Place {
            point: Point::here(problem),
            positive: problem.system().orientation(),
            index: problem.index(),
            arc,
            tangent,
            slope,
        })
    }

    /// Does the last step pass through `point`, in the direction `tangent`?
    pub fn passes<P: Problem>(&mut self, problem: &mut P, point: &Point, tangent: &Tangent) -> bool {
        let Some((left, width)) = &self.last else { return false };
        if left.point.state.len() != point.state.len() || self.here.point.state.len() != point.state.len() {
            return false;
        }
        let to = between(problem, &left.point, point);
        let system = problem.system();
        let along = left.tangent.product(system, &to.step, to.parameter);
        let square = to.product(system, &to.step, to.parameter);
        let aside = (square - along * along).max(0.0).sqrt();
        let same_way = tangent.step.len() == left.tangent.step.len()
            && left.tangent.product(system, &tangent.step, tangent.parameter) > 0.5;
        let (whole, part) = (*width, along / width);
        let seems = same_way && along > 0.0 && along <= 1.05 * width && aside <= 0.25 * width;
        seems && self.goes_through(problem, point, part, whole)
    }

    fn try_step<P: Problem>(&mut self, problem: &mut P, width: f64) -> Result<(Place, f64), (Miss, f64)> {
        self.here.point.restore(problem).map_err(|refusal| (Miss::from(refusal), 0.3))?;
        if !self.is_tangent_here {
            problem.system().linearise().map_err(|b| (Miss::from(b), 0.3))?;
            // The direction may be that of a tangent from a little before the last correction, which near critical points tells.
            let (slope, mut tangent) =
                direction_here(problem).map_err(|refusal| (Miss::from(refusal), 0.3))?;
            let ahead = &self.here.tangent;
            if tangent.product(problem.system(), &ahead.step, ahead.parameter) < 0.0 {
                tangent.scale(-1.0);
            }
            (self.here.slope, self.here.tangent) = (slope, tangent);
            self.is_tangent_here = true;
        }
        let here = &self.here;
        let mut step = here.tangent.clone();
        step.scale(width);
        if let Some((before, gone)) = &self.before
            && before.step.len() == step.step.len()
        {
            // The direction goes on turning as it did.
            let bend = 0.5 * width * width / gone;
            for ((s, new), old) in step.step.iter_mut().zip(&here.tangent.step).zip(&before.step) {
                *s += bend * (new - old);
            }
            step.parameter += bend * (here.tangent.parameter - before.parameter);
        }
        let reach = step.size(problem.system());
        problem.system().retract(&step.step);
        let parameters = here.point.parameters;
        problem
            .set_parameters([parameters[0] + step.parameter, parameters[1]])
            .map_err(|refusal| (refusal.into(), 0.3))?;
        let limits = Limits {
            tolerance: self.options.tolerance,
            farthest: self.options.farthest,
            reach,
            renewed_below: LATE,
        };
        let arrived = correct(problem, &here.tangent, Some(&here.slope), &limits).map_err(|miss| {
            let factor = match &miss {
                Miss::Far(by) => (0.5 * self.options.farthest / by).sqrt().clamp(0.1, 0.6),
                _ => 0.35,
            };
            (miss, factor)
        })?;
        let (slope, mut tangent) = if arrived.renewed {
            let tangent = direction(problem.system(), &arrived.slope).ok_or((Miss::NotContracting, 0.7))?;
            (arrived.slope, tangent)
        } else {
            problem.system().linearise().map_err(|b| (b.into(), 0.7))?;
            direction_here(problem).map_err(|refusal| (refusal.into(), 0.7))?
        };
        let mut cosine = tangent.product(problem.system(), &here.tangent.step, here.tangent.parameter);
        // The metric may have changed a little with the loads.
        let length =
            here.tangent.product(problem.system(), &here.tangent.step, here.tangent.parameter).sqrt();
        cosine /= length;
        if cosine < 0.0 {
            tangent.scale(-1.0);
            cosine = -cosine;
        }
        if cosine < self.options.least_cosine {
            return Err((Miss::NotContracting, 0.4));
        }
        let by_way = (self.options.aim * reach / arrived.first.max(1e-12)).sqrt();
        let turned = cosine.min(1.0).acos();
        let by_turn = self.options.aimed_cosine.acos() / turned.max(1e-6);
        let growth = by_way.min(by_turn).clamp(0.5, 2.0);
        let place = Place {
            point: Point::here(problem),
            positive: problem.system().orientation(),
            index: problem.index(),
            arc: here.arc + width,
            tangent,
            slope,
        };
        Ok((place, growth))
    }
}

fn stall(refusal: Refusal) -> Stall {
    match refusal {
        Refusal::Parameter(why) => Stall::Parameter(why),
        Refusal::Broken(_) => Stall::Short,
    }
}

/// The longest step in a direction that the options allow.
pub(crate) fn largest<S: flexura_nonlinear::Liftable>(
    system: &S,
    tangent: &Tangent,
    options: &WalkOptions,
) -> f64 {
    let by_change = options.largest_change / system.size(&tangent.step).max(1e-12);
    let by_turning = options.largest_change / system.turning(&tangent.step).max(1e-12);
    let by_parameter = options.largest_parameter / tangent.parameter.abs().max(1e-12);
    by_change.min(by_turning).min(by_parameter)
}

/// The slope of the state and the unit direction of the path, with the tangent of the present point.
fn direction_here<P: Problem>(problem: &mut P) -> Result<(Vec<f64>, Tangent), Refusal> {
    let slope = slope(problem, 0)?;
    let tangent = direction(problem.system(), &slope).ok_or(Refusal::Broken(Breakdown::NotFinite))?;
    Ok((slope, tangent))
}

/// The unit direction of a path whose state has this slope.
fn direction<S: flexura_nonlinear::Liftable>(system: &S, slope: &[f64]) -> Option<Tangent> {
    let tangent = Tangent { step: slope.to_vec(), parameter: 1.0 }.normalised(system);
    tangent.parameter.is_finite().then_some(tangent)
}
