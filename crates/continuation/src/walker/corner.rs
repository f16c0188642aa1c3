//! Corners, at which the direction of a path turns at once, and places that a path comes back to.

use super::{Place, Walker, direction_here};
use crate::corrector::{Limits, Miss, between, correct};
use crate::problem::{Point, Problem};
use flexura_nonlinear::System;

/// Tries to come level with a point that a path seems to pass, and how far beside it that may be, as a part of the step.
const ALIGNED: usize = 6;
const SAME_PLACE: f64 = 1e-4;
/// How far beside the old direction the new one may lie at a corner, as a part of the step, and how well the point beyond is found.
const BESIDE: f64 = 3.0;
const ROUND: f64 = 1e-3;

impl Walker {
    /// Is `point` on the path, and not just beside it, near `part` of the last step? A body that has turned once round may stand
    /// as it stood before, but under another load.
    pub(super) fn goes_through<P: Problem>(
        &mut self,
        problem: &mut P,
        point: &Point,
        part: f64,
        width: f64,
    ) -> bool {
        let mut part = part;
        let mut aside = f64::INFINITY;
        for _ in 0..ALIGNED {
            let Ok(place) = self.between(problem, part) else { break };
            let to = between(problem, &place.point, point);
            let system = problem.system();
            let along = place.tangent.product(system, &to.step, to.parameter);
            let square = to.product(system, &to.step, to.parameter);
            aside = (square - along * along).max(0.0).sqrt();
            if along.abs() <= SAME_PLACE * width {
                break;
            }
            part += along / width;
        }
        let _ = self.here.point.restore(problem);
        aside <= SAME_PLACE * width.max(1e-3)
    }

    /// A step so short that what the path still turns by in it is a corner, where a spring goes slack or a foundation begins to
    /// push: the point beyond is found with the tangent of the other side. A path that turns back there is not led round.
    pub(super) fn round<P: Problem>(
        &mut self,
        problem: &mut P,
        width: f64,
    ) -> Result<(Place, f64), (Miss, f64)> {
        const SHORTER: f64 = 0.4;
        let here = &self.here;
        here.point.restore(problem).map_err(|refusal| (Miss::from(refusal), SHORTER))?;
        self.is_tangent_here = false;
        let mut step = here.tangent.clone();
        step.scale(width);
        let reach = step.size(problem.system());
        problem.system().retract(&step.step);
        let [first, second] = here.point.parameters;
        let found = problem.set_parameters([first + step.parameter, second]).map_err(Miss::from);
        let limits = Limits {
            tolerance: self.options.tolerance.min(ROUND * reach),
            farthest: BESIDE,
            reach,
            renewed_below: 0.0,
        };
        found.and_then(|()| correct(problem, &here.tangent, None, &limits)).map_err(|m| (m, SHORTER))?;
        problem.system().linearise().map_err(|b| (b.into(), SHORTER))?;
        let (slope, mut tangent) = direction_here(problem).map_err(|refusal| (refusal.into(), SHORTER))?;
        let positive = problem.system().orientation();
        // The sign of the determinant and that of the parameter's rate go together along a path: where one stays, so does the other.
        if tangent.parameter * here.tangent.parameter < 0.0 {
            tangent.scale(-1.0);
        }
        let along = tangent.product(problem.system(), &here.tangent.step, here.tangent.parameter);
        if positive != here.positive || along <= 0.0 {
            return Err((Miss::NotContracting, SHORTER));
        }
        let (point, arc) = (Point::here(problem), here.arc + width);
        Ok((Place { point, positive, index: problem.index(), arc, tangent, slope }, 2.0))
    }
}
