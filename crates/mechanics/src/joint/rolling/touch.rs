//! The first contact, found from a rough pose: where the normals oppose and the gap between the boundaries is least.

use flexura_geometry::{Contour, ContourPoint};
use std::f64::consts::{PI, TAU};

/// Places along each boundary from which the search starts, and how many pairs are refined.
const PLACES: usize = 64;
const REFINED: usize = 12;

/// Arc lengths (child, parent) of the contact of a child at `position` under `angle`: T_A ∥ T_B in the right sense, and the
/// gap along the common normal. Of several such pairs the one with the smallest gap.
pub(super) fn closest(
    child: &Contour,
    parent: &Contour,
    sense: f64,
    position: [f64; 2],
    angle: f64,
) -> Option<[f64; 2]> {
    let opposite = if sense > 0.0 { PI } else { 0.0 };
    let (sin, cos) = angle.sin_cos();
    let world = |point: [f64; 2]| {
        [position[0] + cos * point[0] - sin * point[1], position[1] + sin * point[0] + cos * point[1]]
    };
    let back = |point: [f64; 2]| {
        let d = [point[0] - position[0], point[1] - position[1]];
        [cos * d[0] + sin * d[1], cos * d[1] - sin * d[0]]
    };
    let size = child.length().or(parent.length())?;
    let own = places(child, back([0.0, 0.0]), size);
    let other = places(parent, position, size);
    // Misfit of the directions, and the part of the gap that is along the tangent.
    let misfit = |a: &ContourPoint, b: &ContourPoint| {
        let turn = a.angle + angle - b.angle - opposite;
        let turn = turn - TAU * (turn / TAU).round();
        let from = world(a.point);
        let gap = [from[0] - b.point[0], from[1] - b.point[1]];
        let [x, y] = b.tangent();
        (turn, gap[0] * x + gap[1] * y, gap)
    };
    let mut pairs: Vec<(f64, [f64; 2])> = Vec::with_capacity(own.len() * other.len());
    for (s, a) in &own {
        for (t, b) in &other {
            let (turn, along, gap) = misfit(a, b);
            let cost = (turn * size).powi(2) + along * along + 1e-2 * (gap[0] * gap[0] + gap[1] * gap[1]);
            pairs.push((cost, [*s, *t]));
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Option<(f64, [f64; 2])> = None;
    for (_, start) in pairs.into_iter().take(REFINED) {
        let Some((gap, found)) = refine(child, parent, sense, angle, start, size, &misfit) else { continue };
        if best.is_none_or(|(least, _)| gap < least) {
            best = Some((gap, found));
        }
    }
    best.map(|(_, found)| found)
}

/// Places on a boundary; on a line without end those near a point.
fn places(contour: &Contour, near: [f64; 2], size: f64) -> Vec<(f64, ContourPoint)> {
    let [from, to] = match (contour.range(), contour.length()) {
        (Some(range), _) => range,
        (None, Some(length)) => [0.0, length],
        (None, None) => {
            let foot = contour.at(0.0).map_or(0.0, |origin| {
                let [x, y] = origin.tangent();
                (near[0] - origin.point[0]) * x + (near[1] - origin.point[1]) * y
            });
            [foot - size, foot + size]
        }
    };
    let place = |i: usize| from + (to - from) * (i as f64 + 0.5) / PLACES as f64;
    (0..PLACES).filter_map(|i| contour.at(place(i)).map(|point| (place(i), point))).collect()
}

/// Newton's method on both conditions. Returns the gap and the arc lengths.
fn refine(
    child: &Contour,
    parent: &Contour,
    sense: f64,
    angle: f64,
    mut at: [f64; 2],
    size: f64,
    misfit: &impl Fn(&ContourPoint, &ContourPoint) -> (f64, f64, [f64; 2]),
) -> Option<(f64, [f64; 2])> {
    for _ in 0..60 {
        let (a, b) = (child.at(at[0])?, parent.at(at[1])?);
        let (turn, along, gap) = misfit(&a, &b);
        let [x, y] = b.tangent();
        // Rows: turning κ_A ds_A - κ_B ds_B; gap along T_B: T_A·T_B ds_A + (-1 + κ_B N_B·gap) ds_B.
        let (sin, cos) = (a.angle + angle).sin_cos();
        let matrix = [
            [a.curvature, -b.curvature],
            [cos * x + sin * y, -1.0 + b.curvature * (x * gap[1] - y * gap[0])],
        ];
        let det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        if det == 0.0 || !det.is_finite() {
            return None;
        }
        let step = [
            -(turn * matrix[1][1] - along * matrix[0][1]) / det,
            -(matrix[0][0] * along - matrix[1][0] * turn) / det,
        ];
        let longest = step[0].abs().max(step[1].abs());
        let factor = (0.25 * size / longest).min(1.0);
        for (s, d) in at.iter_mut().zip(step) {
            *s += factor * d;
        }
        for (s, contour) in at.iter_mut().zip([child, parent]) {
            if let Some([from, to]) = contour.range() {
                *s = s.clamp(from, to);
            }
        }
        if longest <= 1e-14 * size {
            break;
        }
    }
    let (a, b) = (child.at(at[0])?, parent.at(at[1])?);
    let (turn, along, gap) = misfit(&a, &b);
    // Within a hollow the child must be the more curved one.
    let fits = sense > 0.0 || a.curvature >= b.curvature * (1.0 - 1e-9);
    let met = turn.abs() < 1e-9 && along.abs() < 1e-9 * size;
    (met && fits).then(|| (gap[0].hypot(gap[1]), at))
}
