//! From a branch point onto one of its branches.

use super::{Place, Stall, WalkOptions, WalkWork, Walker, direction_here, largest, stall};
use crate::corrector::{Limits, Miss, between, correct};
use crate::problem::{Point, Problem, Refusal, Tangent};
use crate::spread::Leaving;
use flexura_nonlinear::System;

impl Walker {
    /// Starts from a branch point along one of its branches (`sense` ±1): the first point beyond it.
    ///
    /// # Errors
    /// No point of that branch is found.
    pub fn switch<P: Problem>(
        problem: &mut P,
        options: WalkOptions,
        from: &Point,
        branch: &Leaving,
        sense: f64,
    ) -> Result<Self, Stall> {
        let side = usize::from(sense > 0.0);
        if let Some(point) = &branch.points[side] {
            return Self::at_known(problem, options, from, point).map_err(|miss| match miss {
                Miss::Refused(refusal) => stall(refusal),
                _ => Stall::Short,
            });
        }
        let mut tangent = branch.tangent.clone();
        tangent.scale(sense);
        from.restore(problem).map_err(stall)?;
        // A short one: what crosses the branch close to its start is not to be stepped over.
        let mut width = 0.15 * largest(problem.system(), &tangent, &options);
        let mut worst = Stall::Short;
        for _ in 0..14 {
            match first_point(problem, &options, from, &tangent, width) {
                Ok(here) => {
                    let start =
                        Place { point: from.clone(), arc: 0.0, tangent: tangent.clone(), ..here.clone() };
                    return Ok(Self::beyond(options, start, here, width));
                }
                Err(Miss::Refused(Refusal::Parameter(why))) => worst = Stall::Parameter(why),
                Err(_) => {}
            }
            width *= 0.5;
        }
        Err(worst)
    }

    /// Starts at a point of a branch that is known to be near its branch point.
    fn at_known<P: Problem>(
        problem: &mut P,
        options: WalkOptions,
        from: &Point,
        point: &Point,
    ) -> Result<Self, Miss> {
        point.restore(problem)?;
        problem.system().linearise()?;
        let (slope, mut tangent) = direction_here(problem)?;
        let gone = between(problem, from, point);
        let system = problem.system();
        let width = gone.product(system, &gone.step, gone.parameter).sqrt();
        if tangent.product(system, &gone.step, gone.parameter) < 0.0 {
            tangent.scale(-1.0);
        }
        let positive = system.orientation();
        let here =
            Place { point: point.clone(), index: problem.index(), positive, arc: width, tangent, slope };
        let left = gone.normalised(problem.system());
        let start = Place { point: from.clone(), arc: 0.0, tangent: left, ..here.clone() };
        Ok(Self::beyond(options, start, here, width))
    }

    fn beyond(options: WalkOptions, start: Place, here: Place, width: f64) -> Self {
        Self {
            options,
            here,
            before: None,
            width,
            last: Some((start, width)),
            is_tangent_here: true,
            work: WalkWork { taken: 1, refused: 0 },
            corners: 0,
        }
    }
}

/// The first point of a branch beyond its branch point.
fn first_point<P: Problem>(
    problem: &mut P,
    options: &WalkOptions,
    from: &Point,
    tangent: &Tangent,
    width: f64,
) -> Result<Place, Miss> {
    from.restore(problem)?;
    let step: Vec<f64> = tangent.step.iter().map(|t| width * t).collect();
    let reach = width * tangent.size(problem.system());
    problem.system().retract(&step);
    let parameters = from.parameters;
    problem.set_parameters([parameters[0] + width * tangent.parameter, parameters[1]])?;
    let limits =
        Limits { tolerance: options.tolerance, farthest: options.farthest, reach, renewed_below: 0.0 };
    correct(problem, tangent, None, &limits)?;
    let point = Point::here(problem);
    let gone = between(problem, from, &point);
    problem.system().linearise()?;
    let (slope, mut direction) = direction_here(problem)?;
    let system = problem.system();
    let length = gone.product(system, &gone.step, gone.parameter).sqrt();
    let cosine = tangent.product(system, &gone.step, gone.parameter) / length;
    let mut ahead = direction.product(system, &tangent.step, tangent.parameter);
    if ahead < 0.0 {
        direction.scale(-1.0);
        ahead = -ahead;
    }
    if cosine < 0.9 || ahead < options.least_cosine {
        return Err(Miss::NotContracting);
    }
    Ok(Place {
        positive: problem.system().orientation(),
        index: problem.index(),
        arc: width,
        tangent: direction,
        slope,
        point,
    })
}
