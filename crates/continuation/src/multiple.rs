//! Points at which several directions become critical at once, as those of a round column do.
//!
//! The matrix G = (Cᵀ J⁻¹ B)⁻¹ with fixed B and C of k columns is a smooth function along the path and vanishes where J
//! loses k ranks. It is found at points around the place, never at it, and its zero by a polynomial through them.

use crate::corrector::{Limits, Miss, between, correct};
use crate::locate::{Crossing, Special, Start};
use crate::problem::{Point, Problem, Tangent};
use flexura_nonlinear::{Liftable, System};

/// Points of the polynomial, as parts of the bracket; none near its middle.
const NODES: [f64; 6] = [0.0, 0.12, 0.3, 0.7, 0.88, 1.0];

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
    let mut points = Vec::with_capacity(NODES.len());
    let mut bases: Option<(Vec<usize>, Vec<Vec<f64>>)> = None;
    let mut values: Vec<Vec<f64>> = Vec::new();
    for node in NODES {
        from.point.restore(problem)?;
        let step: Vec<f64> = from.tangent.step.iter().map(|t| t * node * from.length).collect();
        problem.system().retract(&step);
        let parameters = from.point.parameters;
        problem
            .set_parameters([parameters[0] + node * from.length * from.tangent.parameter, parameters[1]])?;
        let limits =
            Limits { tolerance: from.tolerance, farthest: 1e3, reach: from.length, renewed_below: 0.0 };
        correct(problem, from.tangent, None, &limits)?;
        problem.system().linearise()?;
        if bases.is_none() {
            bases = Some(choose(problem, count, n));
        }
        let Some((rows, kernel)) = &bases else { return Ok(None) };
        let mut columns = Vec::with_capacity(count);
        let mut step = vec![0.0; n];
        for &row in rows {
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
    let kernel = bases.map(|(_, kernel)| kernel).unwrap_or_default();
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

/// Rows B and directions C: C spans what the tangent's inverse makes largest.
fn choose<P: Problem>(problem: &mut P, count: usize, n: usize) -> (Vec<usize>, Vec<Vec<f64>>) {
    let system = problem.system();
    let rows = system.lift_rows();
    let stride = rows.len().div_ceil(96).max(1);
    let mut images: Vec<(usize, Vec<f64>)> = Vec::new();
    for &row in rows.iter().step_by(stride) {
        let mut step = vec![0.0; n];
        system.unit_step(row, &mut step);
        images.push((row, step));
    }
    // Gram and Schmidt with the largest remainder first.
    let (mut chosen, mut kernel): (Vec<usize>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    for _ in 0..count.min(images.len()) {
        let sizes: Vec<f64> = images.iter().map(|(_, v)| system.product(v, v)).collect();
        let best = (0..sizes.len()).max_by(|a, b| sizes[*a].total_cmp(&sizes[*b])).unwrap_or(0);
        let (row, mut direction) = images.swap_remove(best);
        let length = sizes[best].sqrt();
        direction.iter_mut().for_each(|v| *v /= length);
        for (_, image) in &mut images {
            let along = system.product(image, &direction);
            image.iter_mut().zip(&direction).for_each(|(v, d)| *v -= along * d);
        }
        chosen.push(row);
        kernel.push(direction);
    }
    (chosen, kernel)
}

/// The inverse of a small matrix given by columns, as one list. None where there is none.
fn inverse(columns: Vec<Vec<f64>>) -> Option<Vec<f64>> {
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
