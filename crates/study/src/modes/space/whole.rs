//! The response of all that the mechanism can do, beside which a reduced one is held.

use super::signals::{Measure, Wanted};

/// Modes nearer to each other than this part of ω² count as one: between them is nothing but their resonance.
const TOGETHER: f64 = 1e-2;
/// How far before the last mode, of its distance from the one before, its resonance is looked at.
const BEFORE: f64 = 0.02;
/// What answers to an input by less than this of what answers most does so by round-off.
const ROUND: f64 = 1e-9;

/// A response as modes and residual vectors make it, without damping.
pub struct Reduced {
    /// For each coordinate what outputs change by.
    pub readings: Vec<Vec<f64>>,
    /// For each input the part that each coordinate takes of it.
    pub shares: Vec<Vec<f64>>,
    /// For each input what is left for the outputs.
    pub feedthrough: Vec<Vec<f64>>,
}

/// Changes of all outputs by each input, at one ω².
pub struct Place {
    pub square: f64,
    pub readings: Vec<Vec<f64>>,
}

/// Where to look: midway between modes, and shortly before the last.
pub fn places(squares: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = squares.iter().copied().filter(|square| *square > 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    let mut known = vec![0.0];
    for square in sorted {
        if square - known.last().copied().unwrap_or(0.0) > TOGETHER * square {
            known.push(square);
        }
    }
    let mut places: Vec<f64> = known.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    if let [.., before, last] = known[..] {
        places.push(last - BEFORE * (last - before));
    }
    places
}

/// The largest difference of any output to any input, beside the size of the response at the same ω²: the parts of all coordinates
/// without their signs, which does not vanish where parts cancel; None where nothing answers. Components of a vector are held beside
/// the largest of them: which axes it is read in does not matter, nor that some of them all but vanish by symmetry.
pub fn apart(
    places: &[Place],
    reduced: &Reduced,
    squares: &[f64],
    wanted: &[Wanted],
    inputs: usize,
) -> Option<f64> {
    let mut worst: Option<f64> = None;
    for u in 0..inputs {
        let largest = |k: usize| places.iter().map(|place| place.readings[u][k].abs()).fold(0.0, f64::max);
        let parts = |k: usize, square: f64| -> Vec<f64> {
            let each = reduced.readings.iter().zip(&reduced.shares[u]).zip(squares);
            each.map(|((reading, share), own)| reading[k] * share / (own - square)).collect()
        };
        let alike = |k: usize| {
            let own = wanted[k].clone();
            (0..wanted.len()).filter(move |other| {
                wanted[*other].output == own.output && wanted[*other].measure == own.measure
            })
        };
        let most = (0..wanted.len()).map(&largest).fold(0.0, f64::max);
        for (k, output) in wanted.iter().enumerate() {
            if alike(k).all(|other| largest(other) <= ROUND * most) {
                continue;
            }
            // What is left of a velocity or an acceleration does not go through: it would take the input's own rates.
            let through = if output.measure == Measure::Change { reduced.feedthrough[u][k] } else { 0.0 };
            for place in places {
                let sum: f64 = parts(k, place.square).iter().sum();
                let whole = place.readings[u][k];
                let size = alike(k)
                    .map(|other| parts(other, place.square).iter().map(|part| part.abs()).sum::<f64>())
                    .fold(whole.abs(), f64::max);
                let off = (through + sum - whole).abs() / size;
                worst = Some(worst.map_or(off, |worst| worst.max(off)));
            }
        }
    }
    worst
}
