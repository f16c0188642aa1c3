//! Points at which several directions become critical at once, as those of a round column do.
//!
//! The matrix G = (Cᵀ J⁻¹ B)⁻¹ with fixed B and C of k columns is a smooth function along the path and vanishes where J
//! loses k ranks. It is found at points around the place, never at it, and its zero by a polynomial through them.

use crate::algebraic::dot;
use crate::corrector::{Limits, Miss, between, correct};
use crate::locate::{Crossing, Special, Start};
use crate::problem::{Point, Problem, Tangent};
use flexura_nonlinear::{Liftable, System};

/// Points of the polynomial, as parts of the bracket; none near its middle.
const NODES: [f64; 6] = [0.0, 0.12, 0.3, 0.7, 0.88, 1.0];

/// Rows that are tried.
const TRIED: usize = 96;

/// A path's point, its tangent and slope, from which points of the bracket are reached.
pub(crate) struct From<'a> {
    pub point: &'a Point,
    pub tangent: &'a Tangent,
    /// Length of the bracket along the tangent.
    pub length: f64,
    pub tolerance: f64,
}

/// The point between the ends of a small bracket at which `count` directions are critical.
pub(crate) fn locate_multiple<P: Problem>(
    problem: &mut P,
    from: &From<'_>,
    count: usize,
) -> Result<Option<Special>, Miss> {
    let n = problem.system().unknowns();
    let mut sides = Vec::with_capacity(2);
    for node in [NODES[0], NODES[NODES.len() - 1]] {
        go(problem, from, node)?;
        sides.push(images(problem.system()));
    }
    let kernel = turned(problem.system(), &sides, count);
    let rows = heard(problem.system(), &kernel);
    if rows.len() < count {
        return Ok(None);
    }
    let mut points = Vec::with_capacity(NODES.len());
    let mut values: Vec<Vec<f64>> = Vec::new();
    for node in NODES {
        go(problem, from, node)?;
        let mut columns = Vec::with_capacity(count);
        let mut step = vec![0.0; n];
        for &row in &rows {
            problem.system().unit_step(row, &mut step);
            columns.push(kernel.iter().map(|c| problem.system().product(c, &step)).collect::<Vec<f64>>());
        }
        match inverse(columns) {
            Some(g) => values.push(g),
            None => return Ok(None),
        }
        points.push(Point::here(problem));
    }
    // The combination of G's entries that changes most.
    let weights: Vec<f64> = values[5].iter().zip(&values[0]).map(|(b, a)| b - a).collect();
    let f: Vec<f64> = values.iter().map(|g| g.iter().zip(&weights).map(|(g, w)| g * w).sum()).collect();
    let Some(part) = root(&f) else { return Ok(None) };
    // The state there, by the same polynomial.
    let mut step = vec![0.0; n];
    let mut parameter = points[0].parameters[0];
    for (i, point) in points.iter().enumerate().skip(1) {
        let weight = lagrange(i, part);
        let way = between(problem, &points[0], point);
        step.iter_mut().zip(&way.step).for_each(|(s, w)| *s += weight * w);
        parameter += weight * way.parameter;
    }
    points[0].restore(problem)?;
    problem.system().retract(&step);
    problem.set_parameters([parameter, points[0].parameters[1]])?;
    let point = Point::here(problem);
    let start = Start {
        point: from.point.clone(),
        tangent: from.tangent.clone(),
        length: from.length,
        tolerance: from.tolerance,
    };
    let crossing = Some(Crossing::Multiple(count));
    Ok(Some(Special {
        crossing,
        point,
        kernel,
        branches: Vec::new(),
        part,
        imperfection: 0.0,
        start: Some(start),
    }))
}

/// Goes to the path's point at a part of the bracket, with its tangent.
fn go<P: Problem>(problem: &mut P, from: &From<'_>, part: f64) -> Result<(), Miss> {
    from.point.restore(problem)?;
    let step: Vec<f64> = from.tangent.step.iter().map(|t| t * part * from.length).collect();
    problem.system().retract(&step);
    let parameters = from.point.parameters;
    problem.set_parameters([parameters[0] + part * from.length * from.tangent.parameter, parameters[1]])?;
    let limits = Limits { tolerance: from.tolerance, farthest: 1e3, reach: from.length, renewed_below: 0.0 };
    correct(problem, from.tangent, None, &limits)?;
    Ok(problem.system().linearise()?)
}

/// The solutions of single rows.
fn images<S: Liftable>(system: &mut S) -> Vec<(usize, Vec<f64>)> {
    let rows = system.lift_rows();
    let image = |row: usize| {
        let mut step = vec![0.0; system.unknowns()];
        system.unit_step(row, &mut step);
        (row, step)
    };
    rows.iter().step_by(rows.len().div_ceil(TRIED).max(1)).copied().map(image).collect()
}

/// The critical directions, by what changes its sign between both sides of the point: what is only soft, and however large in its units,
/// does not.
fn turned<S: Liftable>(system: &S, sides: &[Vec<(usize, Vec<f64>)>], count: usize) -> Vec<Vec<f64>> {
    let length = |v: &[f64]| system.product(v, v).sqrt();
    let mut changes: Vec<Vec<f64>> = sides[0]
        .iter()
        .zip(&sides[1])
        .map(|((_, a), (_, b))| {
            let scale = length(a) + length(b);
            a.iter().zip(b).map(|(a, b)| (a - b) / scale).collect()
        })
        .collect();
    changes.retain(|change: &Vec<f64>| change.iter().all(|c| c.is_finite()));
    // Gram and Schmidt with the largest remainder first.
    let mut kernel: Vec<Vec<f64>> = Vec::new();
    for _ in 0..count.min(changes.len()) {
        let lengths: Vec<f64> = changes.iter().map(|change| length(change)).collect();
        let best = (0..lengths.len()).max_by(|a, b| lengths[*a].total_cmp(&lengths[*b])).unwrap_or(0);
        let mut direction = changes.swap_remove(best);
        direction.iter_mut().for_each(|v| *v /= lengths[best]);
        for change in &mut changes {
            let along = system.product(change, &direction);
            change.iter_mut().zip(&direction).for_each(|(v, d)| *v -= along * d);
        }
        kernel.push(direction);
    }
    kernel
}

/// The rows whose solutions are most of all the kernel's, whatever their units, and differ most from each other.
pub(crate) fn heard<S: Liftable>(system: &mut S, kernel: &[Vec<f64>]) -> Vec<usize> {
    let mut shares: Vec<(usize, Vec<f64>)> = Vec::new();
    for (row, step) in images(system) {
        let length = system.product(&step, &step).sqrt();
        let share: Vec<f64> = kernel.iter().map(|c| system.product(c, &step) / length).collect();
        if share.iter().all(|s| s.is_finite()) {
            shares.push((row, share));
        }
    }
    let mut chosen = Vec::new();
    for _ in kernel {
        let size = |share: &[f64]| dot(share, share);
        let Some(best) = (0..shares.len()).max_by(|a, b| size(&shares[*a].1).total_cmp(&size(&shares[*b].1)))
        else {
            break;
        };
        let (row, share) = shares.swap_remove(best);
        let length = size(&share);
        for (_, other) in &mut shares {
            let along = dot(other, &share) / length;
            other.iter_mut().zip(&share).for_each(|(o, s)| *o -= along * s);
        }
        chosen.push(row);
    }
    chosen
}

/// The inverse of a small matrix given by columns, as one list. None where there is none.
pub(crate) fn inverse(columns: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let k = columns.len();
    let mut rows: Vec<Vec<f64>> = (0..k)
        .map(|i| {
            let mut row: Vec<f64> = columns.iter().map(|c| c[i]).collect();
            row.extend((0..k).map(|j| if i == j { 1.0 } else { 0.0 }));
            row
        })
        .collect();
    for i in 0..k {
        let pivot = (i..k).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs()))?;
        rows.swap(i, pivot);
        let top = rows[i][i];
        if top == 0.0 || !top.is_finite() {
            return None;
        }
        rows[i].iter_mut().for_each(|v| *v /= top);
        let upper = rows[i].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(j, _)| *j != i) {
            let factor = row[i];
            row.iter_mut().zip(&upper).for_each(|(v, u)| *v -= factor * u);
        }
    }
    Some(rows.into_iter().flat_map(|row| row[k..].to_vec()).collect())
}

/// Lagrange's weight of node `i` at `part`.
fn lagrange(i: usize, part: f64) -> f64 {
    (0..NODES.len()).filter(|j| *j != i).map(|j| (part - NODES[j]) / (NODES[i] - NODES[j])).product()
}

/// The zero in (0, 1) of the polynomial through the values.
fn root(f: &[f64]) -> Option<f64> {
    let at = |t: f64| (0..f.len()).map(|i| f[i] * lagrange(i, t)).sum::<f64>();
    let (mut low, mut high) = (0.0, 1.0);
    if at(low) * at(high) > 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at(low) * at(middle) <= 0.0 { high = middle } else { low = middle }
    }
    Some(0.5 * (low + high))
}
