//! Intervals by profile likelihood (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis, 1988, chapter 6): an end lies where the
//! cost, while all other unknowns are fitted anew, has grown by t²/2 variances.

use crate::fit::Search;
use crate::least_squares::{LeastSquaresEnd, Minimum};
use crate::statistics::{Knowledge, student};
use flexura_solution::Estimate;

/// How near to t an end must be, and most fits for it.
const NEAR: f64 = 1e-5;
const MOST: usize = 30;
/// Farthest an end may lie, in ends of the linearised problem.
const FARTHEST: f64 = 100.0;

/// Adds the intervals to the estimates that are determined.
pub(crate) fn add(search: &mut Search<'_>, minimum: &Minimum, estimates: &mut [Estimate]) {
    let Some(known) = search.knowledge(minimum) else { return };
    let Some(t) = student(search.problem.study.confidence, known.freedom) else { return };
    for (k, estimate) in estimates.iter_mut().enumerate() {
        if estimate.standard_error.is_none() || search.bounds[k][0] == search.bounds[k][1] {
            continue;
        }
        let size = search.problem.variables[k].size;
        estimate.profile =
            Some([-1.0, 1.0].map(|side| end(search, minimum, &known, (k, side), t).map(|x| x * size)));
    }
}

/// One end of the interval of a variable.
fn end(
    search: &mut Search<'_>,
    minimum: &Minimum,
    known: &Knowledge,
    (k, side): (usize, f64),
    t: f64,
) -> Option<f64> {
    let error = known.covariance[(k, k)].sqrt();
    let own = search.bounds.clone();
    // With the others where the linearised problem has them.
    let along = known.covariance.column(k) / known.covariance[(k, k)];
    let at = |search: &mut Search<'_>, distance: f64| -> Option<f64> {
        let mut start = &minimum.x + &along * (side * distance);
        for (x, [low, high]) in start.iter_mut().zip(&own) {
            *x = x.clamp(*low, *high);
        }
        start[k] = minimum.x[k] + side * distance;
        search.bounds[k] = [start[k]; 2];
        let found = search.minimum(&start);
        search.bounds.clone_from(&own);
        let arrived = matches!(found.end, LeastSquaresEnd::Converged | LeastSquaresEnd::Stalled);
        arrived.then(|| (2.0 * (found.cost - minimum.cost).max(0.0) / known.variance).sqrt())
    };
    let room = if side > 0.0 { own[k][1] - minimum.x[k] } else { minimum.x[k] - own[k][0] };
    // τ grows from nothing, as |x - x̂|/error where the problem is linear: regula falsi on τ - t; an end that stays twice
    // counts half (Illinois).
    let (mut low, mut high): ((f64, f64), Option<(f64, f64)>) = ((0.0, -t), None);
    let mut was_below = None;
    let mut next = (t * error).min(room);
    for _ in 0..MOST {
        if search.problem.is_interrupted_now() {
            return None;
        }
        let off = at(search, next)? - t;
        if off.abs() <= NEAR * t {
            return Some(minimum.x[k] + side * next);
        }
        if off < 0.0 {
            if next >= room || next > FARTHEST * t * error {
                return None;
            }
            low = (next, off);
            if let Some(high) = high.as_mut().filter(|_| was_below == Some(true)) {
                high.1 *= 0.5;
            }
        } else {
            high = Some((next, off));
            if was_below == Some(false) {
                low.1 *= 0.5;
            }
        }
        was_below = Some(off < 0.0);
        next = match high {
            Some(high) => low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1),
            None => (next * (1.2 * t / (off + t).max(0.1 * t)).clamp(1.1, 4.0)).min(room),
        };
    }
    None
}
