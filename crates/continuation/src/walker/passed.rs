//! What lies between two points of a path.

use super::{Place, Walker, direction_here};
use crate::corrector::{Limits, Miss, between, correct};
use crate::locate::{Bracket, Special, locate};
use crate::multiple::{From, locate_multiple};
use crate::problem::{Point, Problem, Refusal};
use flexura_nonlinear::System;

/// How often the way between two points is halved at most, to tell apart what lies on it.
pub(super) const DEPTH: usize = 9;

/// Rate of the parameter along the path below which a fold may be near.
const FLAT: f64 = 0.05;

impl Walker {
    /// May something lie between the present point and the next, by what is known of both?
    pub(super) fn may_hold(&self, next: &Place) -> bool {
        let here = &self.here;
        let near = |place: &Place| place.tangent.parameter.abs() < FLAT;
        here.positive != next.positive
            || here.tangent.parameter * next.tangent.parameter < 0.0
            || here.index != next.index
            || near(here)
            || near(next)
    }

    /// Makes tangent, direction and orientation anew at a point, where those at hand are of a state before its last correction.
    pub(super) fn exactly<P: Problem>(&self, problem: &mut P, place: &mut Place) -> Result<(), Refusal> {
        place.point.restore(problem)?;
        problem.system().linearise()?;
        let (slope, mut tangent) = direction_here(problem)?;
        if tangent.product(problem.system(), &place.tangent.step, place.tangent.parameter) < 0.0 {
            tangent.scale(-1.0);
        }
        place.positive = problem.system().orientation();
        (place.slope, place.tangent) = (slope, tangent);
        place.point.restore(problem)
    }

    /// What lies between two neighbouring points. What cannot be told apart is halved, `depth` times at most. Err where it
    /// cannot be told then: the two do not lie on one path.
    pub(super) fn passed<P: Problem>(
        &self,
        problem: &mut P,
        from: &Place,
        to: &Place,
        whole: (&Place, &Place),
        depth: usize,
    ) -> Result<Vec<Special>, ()> {
        let turned = from.tangent.parameter * to.tangent.parameter < 0.0;
        let flipped = from.positive != to.positive;
        let change = match (from.index, to.index) {
            (Some(a), Some(b)) => Some(a.abs_diff(b)),
            _ => None,
        };
        // Where the count is made on another mesh than det J, it may change a little aside; the ends of the whole step then say how it
        // changes.
        let index = match change {
            Some(0) => [whole.0.index, whole.1.index],
            _ => [from.index, to.index],
        };
        let bracket = || Bracket { before: &from.point, after: &to.point, tangent: &from.tangent, index };
        let found = match (flipped, turned, change) {
            (false, false, None | Some(0 | 1)) => return Ok(Vec::new()),
            (true, true, None | Some(0 | 1)) => locate(problem, &bracket(), true),
            (true, false, None | Some(0 | 1)) => locate(problem, &bracket(), false),
            // The side branch of a pitchfork turns back where it meets the other.
            (false, true, None | Some(0 | 1)) => locate(problem, &bracket(), false),
            (_, _, Some(count)) if depth == 0 && count > 1 => self.multiple(problem, from, to, count),
            _ => Ok(None),
        };
        if let Ok(Some(special)) = found {
            return Ok(vec![special]);
        }
        if depth == 0 {
            return Err(());
        }
        // Not in the middle, where symmetry likes to put what is sought.
        let middle = self.place_between(problem, from, to, 0.47).map_err(|_| ())?;
        let parts = self.passed(problem, from, &middle, whole, depth - 1).and_then(|mut all| {
            all.extend(self.passed(problem, &middle, to, whole, depth - 1)?);
            Ok(all)
        });
        match (parts, change) {
            // The count, made on another mesh than J, changes beside the point at which J loses its ranks, far beside where the path turns.
            (Err(()), Some(count @ 2..)) => {
                self.multiple(problem, from, to, count).ok().flatten().map(|special| vec![special]).ok_or(())
            }
            (parts, _) => parts,
        }
    }

    fn multiple<P: Problem>(
        &self,
        problem: &mut P,
        from: &Place,
        to: &Place,
        count: usize,
    ) -> Result<Option<Special>, Miss> {
        let tolerance = self.options.tolerance;
        let from = From { point: &from.point, tangent: &from.tangent, length: to.arc - from.arc, tolerance };
        locate_multiple(problem, &from, count)
    }

    /// A point between two neighbouring points of the path.
    pub(super) fn place_between<P: Problem>(
        &self,
        problem: &mut P,
        from: &Place,
        to: &Place,
        part: f64,
    ) -> Result<Place, Miss> {
        let whole = between(problem, &from.point, &to.point);
        from.point.restore(problem)?;
        let step: Vec<f64> = whole.step.iter().map(|v| part * v).collect();
        let reach = whole.size(problem.system());
        problem.system().retract(&step);
        let parameters = from.point.parameters;
        problem.set_parameters([parameters[0] + part * whole.parameter, parameters[1]])?;
        let limits = Limits { tolerance: self.options.tolerance, farthest: 0.5, reach, renewed_below: 0.0 };
        correct(problem, &to.tangent, None, &limits)?;
        problem.system().linearise()?;
        let (slope, mut tangent) = direction_here(problem)?;
        if tangent.product(problem.system(), &whole.step, whole.parameter) < 0.0 {
            tangent.scale(-1.0);
        }
        Ok(Place {
            point: Point::here(problem),
            positive: problem.system().orientation(),
            index: problem.index(),
            arc: from.arc + part * (to.arc - from.arc),
            tangent,
            slope,
        })
    }
}
