//! The arc length of a path, as a table of cells in each of which it is a converged Legendre series.

use crate::ShapeError;
use crate::frame::{any_normal, reference_rate};
use crate::legendre::{Integral, NODES, RULE};
use crate::path::Path;

/// Cells are halved at most this often; only kinks in a user's expression get there.
const DEPTH: usize = 40;
/// Most cells of one path; beyond, they are taken as they are.
const MOST_CELLS: usize = 20_000;
/// What may be overlooked in a cell moves no point by more than this part of the length.
const OVERLOOKED: f64 = 1e-15;

/// A stretch of parameter values in which s(t) is a polynomial to round-off and the tangent turns by less
/// than 60 degrees.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    /// First and last parameter value.
    pub range: [f64; 2],
    /// Arc length at the first parameter value, m.
    pub start: f64,
    /// |dx/dt| times half the cell's width.
    speed: Integral,
    /// By how much the tangent turns along it, back and forth, rad.
    pub turning: f64,
}

impl Cell {
    /// The parameter value at x in [-1, 1].
    pub fn parameter(&self, x: f64) -> f64 {
        let [a, b] = self.range;
        if x < 0.0 { a + 0.5 * (b - a) * (1.0 + x) } else { b - 0.5 * (b - a) * (1.0 - x) }
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.speed.whole()
    }

    /// The arc length at x in [-1, 1], m.
    pub fn arc_length(&self, x: f64) -> f64 {
        self.start + self.speed.to(x)
    }

    /// Where in the cell, x in [-1, 1], the arc length is `s`: Newton's method on the series.
    pub fn place(&self, s: f64) -> f64 {
        let wanted = s - self.start;
        let mut x = (2.0 * wanted / self.length() - 1.0).clamp(-1.0, 1.0);
        for _ in 0..20 {
            let step = (wanted - self.speed.to(x)) / self.speed.rate(x);
            let next = (x + step).clamp(-1.0, 1.0);
            let change = (next - x).abs();
            x = next;
            if change < 1e-15 {
                break;
            }
        }
        x
    }
}

/// Cuts a path into cells; returns them with the length of the whole.
pub(crate) fn cut(path: &Path) -> Result<(Vec<Cell>, f64), ShapeError> {
    let knots = path.knots();
    // A first idea of the length, to judge convergence by.
    let mut scale = 0.0;
    for pair in knots.windows(2) {
        for x in RULE.nodes {
            let t = pair[0] + 0.5 * (pair[1] - pair[0]) * (1.0 + x);
            scale += path.local(t).speed * (pair[1] - pair[0]) / NODES as f64;
        }
    }
    if !scale.is_finite() {
        return Err(first_undefined(path, &knots));
    }
    if scale <= 0.0 {
        return Err(ShapeError::NoLength);
    }
    let mut cells = Vec::new();
    for pair in knots.windows(2) {
        split(path, [pair[0], pair[1]], scale, 0, &mut cells)?;
    }
    let mut length = 0.0;
    for cell in &mut cells {
        cell.start = length;
        length += cell.length();
    }
    Ok((cells, length))
}

/// Appends the converged cells of one stretch, halving it as long as needed.
fn split(
    path: &Path,
    range: [f64; 2],
    scale: f64,
    depth: usize,
    cells: &mut Vec<Cell>,
) -> Result<(), ShapeError> {
    let [a, b] = range;
    let half = 0.5 * (b - a);
    let mut speed = [0.0; NODES];
    let mut roll = [0.0; NODES];
    let first = path.local(a);
    let direction = any_normal(&first.tangent);
    let last = path.local(b);
    for (local, parameter) in [(&first, a), (&last, b)] {
        if !local.is_finite() {
            return Err(ShapeError::Undefined { parameter });
        }
    }
    let mut turns = !(last.tangent.dot(&first.tangent) > 0.5);
    let (mut turning, mut before) = (0.0, first.tangent);
    for (i, x) in RULE.nodes.iter().enumerate() {
        let t = a + half * (1.0 + x);
        let local = path.local(t);
        if !local.is_finite() {
            return Err(ShapeError::Undefined { parameter: t });
        }
        speed[i] = local.speed * half;
        roll[i] = reference_rate(&local, &direction) * speed[i];
        turns |= !(local.tangent.dot(&first.tangent) > 0.5);
        turning += (local.tangent - before).norm();
        before = local.tangent;
    }
    turning += (last.tangent - before).norm();
    let speed = Integral::new(&speed);
    let converged = speed.tail() <= 4e-16 * scale && Integral::new(&roll).tail() <= 2e-15;
    let sound = converged && !turns && path.is_resolved(range, OVERLOOKED * scale);
    if !sound && depth < DEPTH && cells.len() < MOST_CELLS {
        let middle = a + half;
        split(path, [a, middle], scale, depth + 1, cells)?;
        return split(path, [middle, b], scale, depth + 1, cells);
    }
    // The finest cell may hold a kink, but not a speed without bound.
    if !(speed.tail() < 1e-3 * scale) {
        return Err(ShapeError::Undefined { parameter: a + half });
    }
    cells.push(Cell { range, start: 0.0, speed, turning });
    Ok(())
}

/// The parameter value at which a path is not finite, for the message.
fn first_undefined(path: &Path, knots: &[f64]) -> ShapeError {
    for pair in knots.windows(2) {
        for x in RULE.nodes {
            let parameter = pair[0] + 0.5 * (pair[1] - pair[0]) * (1.0 + x);
            if !path.local(parameter).speed.is_finite() {
                return ShapeError::Undefined { parameter };
            }
        }
    }
    ShapeError::Undefined { parameter: knots[0] }
}
