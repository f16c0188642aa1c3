//! Is a path a beam's axis at all? It must not stand still (a cusp), nor change its direction in no length (a
//! corner).

use crate::ShapeError;
use crate::cells::Cell;
use crate::legendre::{NODES, RULE};
use crate::path::{Local, Path};

/// A speed below this fraction of the mean is a cusp.
const CUSP: f64 = 1e-7;

/// A place where a cell was sampled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// The path's parameter.
    pub parameter: f64,
    /// Arc length, m.
    pub s: f64,
    /// The geometry there.
    pub local: Local,
}

/// The ends and nodes of all cells, in order.
pub(crate) fn samples(path: &Path, cells: &[Cell]) -> Vec<Sample> {
    let sample = |parameter, s| Sample { parameter, s, local: path.local(parameter) };
    let mut samples = Vec::with_capacity(cells.len() * (NODES + 1) + 1);
    for cell in cells {
        samples.push(sample(cell.range[0], cell.start));
        samples.extend(RULE.nodes.iter().map(|x| sample(cell.parameter(*x), cell.arc_length(*x))));
    }
    if let Some(cell) = cells.last() {
        samples.push(sample(cell.range[1], cell.start + cell.length()));
    }
    samples
}

/// Looks for slow places and refuses the path if it stands still at one.
pub(crate) fn refuse_cusps(path: &Path, samples: &[Sample], length: f64) -> Result<(), ShapeError> {
    let Some((first, last)) = samples.first().zip(samples.last()) else {
        return Err(ShapeError::NoLength);
    };
    let mean = length / (last.parameter - first.parameter);
    for (i, here) in samples.iter().enumerate() {
        let before = &samples[i.saturating_sub(1)];
        let after = &samples[(i + 1).min(samples.len() - 1)];
        let speed = here.local.speed;
        // A speed that vanishes between two samples is small at both of them.
        if speed > before.local.speed || speed > after.local.speed || speed > 0.2 * mean {
            continue;
        }
        let between = golden_minimum(before.parameter, after.parameter, |t| path.local(t).speed);
        let slowest = path.local(between).speed;
        let (parameter, slowest) =
            if speed <= slowest { (here.parameter, speed) } else { (between, slowest) };
        if !(slowest > CUSP * mean) {
            return Err(ShapeError::Cusp { parameter, s: here.s });
        }
    }
    Ok(())
}

/// Refuses a path whose tangent jumps.
///
/// Between two samples it may turn by about the curvature times the distance. Where it turns more, halving
/// the interval tells a tight bend, which gets spread over the halves, from a corner, which does not.
pub(crate) fn refuse_corners(path: &Path, samples: &[Sample]) -> Result<(), ShapeError> {
    for pair in samples.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let bend = a.local.bend.norm().max(b.local.bend.norm());
        let turn = (b.local.tangent - a.local.tangent).norm();
        if turn <= 3.0 * bend * (b.s - a.s) + 1e-7 {
            continue;
        }
        let (mut from, mut to) = (a.parameter, b.parameter);
        let (mut start, mut end) = (a.local.tangent, b.local.tangent);
        for _ in 0..40 {
            let parameter = 0.5 * (from + to);
            let middle = path.local(parameter).tangent;
            if (middle - start).norm() > (end - middle).norm() {
                (to, end) = (parameter, middle);
            } else {
                (from, start) = (parameter, middle);
            }
        }
        if (end - start).norm() > 0.1 * turn {
            return Err(ShapeError::Corner { parameter: 0.5 * (from + to), s: a.s });
        }
    }
    Ok(())
}

/// Golden-section search for the minimum of `f` between `a` and `b`.
pub(crate) fn golden_minimum(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..80 {
        if fc < fd {
            (b, d, fd) = (d, c, fc);
            c = b - RATIO * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + RATIO * (b - a);
            fd = f(d);
        }
    }
    0.5 * (a + b)
}
