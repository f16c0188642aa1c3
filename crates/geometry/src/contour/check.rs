//! Is a curve the boundary of anything? It must not cross itself, and be closed if it says so.

use super::curvature;
use super::error::BoundaryError;
use crate::path::Path;
use crate::smooth::Sample;

/// Most chords that are tested against each other.
const CHORDS: usize = 512;

fn thinned(samples: &[Sample]) -> Vec<&Sample> {
    let every = samples.len().div_ceil(CHORDS).max(1);
    let mut thin: Vec<&Sample> = samples.iter().step_by(every).collect();
    if let (Some(last), Some(end)) = (thin.last(), samples.last())
        && last.parameter < end.parameter
    {
        thin.push(end);
    }
    thin
}

/// Refuses a curve whose chords cross.
pub(super) fn refuse_crossings(samples: &[Sample], closed: bool) -> Result<(), BoundaryError> {
    let points = thinned(samples);
    let chords = points.len().saturating_sub(1);
    let at = |i: usize| {
        let p = &points[i].local.position;
        [p.x, p.y]
    };
    for i in 0..chords {
        let (a, b) = (at(i), at(i + 1));
        for j in i + 2..chords {
            if closed && i == 0 && j + 1 == chords {
                continue;
            }
            let (c, d) = (at(j), at(j + 1));
            if apart(a[0], b[0], c[0], d[0]) || apart(a[1], b[1], c[1], d[1]) {
                continue;
            }
            // A hair more than touching, so that a crossing at a sample is seen by one of the chords that meet there.
            let different = |p: [f64; 2], q: [f64; 2], r: [f64; 2], s: [f64; 2]| {
                let (one, other) = (side(p, q, r), side(p, q, s));
                let hair = 1e-9 * one.abs().max(other.abs());
                !(one > hair && other > hair || one < -hair && other < -hair)
            };
            if different(a, b, c, d) && different(c, d, a, b) {
                let (first, second) = (points[i].parameter, points[j].parameter);
                return Err(BoundaryError::Crosses { first, second });
            }
        }
    }
    Ok(())
}

fn apart(a: f64, b: f64, c: f64, d: f64) -> bool {
    a.max(b) < c.min(d) || c.max(d) < a.min(b)
}

/// Twice the signed area of a triangle.
fn side(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// Area that a closed curve encloses; positive where it runs counter-clockwise.
pub(super) fn signed_area(samples: &[Sample]) -> f64 {
    let area = |pair: &[Sample]| {
        let [p, q] = [&pair[0].local.position, &pair[1].local.position];
        0.5 * (p.x * q.y - p.y * q.x)
    };
    samples.windows(2).map(area).sum()
}

/// Refuses a closed curve whose ends differ in place, direction or curvature.
pub(super) fn refuse_gap(path: &Path, length: f64) -> Result<(), BoundaryError> {
    let knots = path.knots();
    let [first, last] = [knots[0], knots[knots.len() - 1]].map(|t| (path.local(t), path.jet(t)));
    let gap = (first.0.position - last.0.position).norm();
    let turn = (first.0.tangent - last.0.tangent).norm();
    let bend = (curvature(&first.1)[0] - curvature(&last.1)[0]).abs() * length;
    if gap > 1e-9 * length || turn > 1e-8 || bend > 1e-6 {
        return Err(BoundaryError::NotClosed { gap });
    }
    Ok(())
}
