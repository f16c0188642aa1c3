//! A parameter over time: value, rate and second derivative, and the times at which a motion is looked at.

use flexura_expression::Function;
use flexura_model::{InverseDynamicsStudy, MotionLaw, Pace, Until};

/// Part of the duration within which two times are one.
const SAME: f64 = 1e-9;

/// A cubic over a stretch of time: Σ c[k] (t - start)ᵏ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    start: f64,
    end: f64,
    c: [f64; 4],
}

impl Piece {
    /// Value, rate, second derivative.
    fn at(&self, time: f64) -> [f64; 3] {
        let (s, [a, b, c, d]) = (time - self.start, self.c);
        [a + s * (b + s * (c + s * d)), b + s * (2.0 * c + s * 3.0 * d), 2.0 * c + 6.0 * d * s]
    }
}

/// Which side of a jump is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    Before,
    After,
}

/// A time that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moment {
    pub time: f64,
    /// Value, rate, second derivative of the parameter.
    pub at: [f64; 3],
}

/// The value of a parameter over time.
#[derive(Clone, Debug)]
pub(crate) enum Profile {
    Pieces(Vec<Piece>),
    Function { value: Function, duration: f64 },
}

impl Profile {
    pub fn new(law: &MotionLaw) -> Self {
        match law {
            MotionLaw::Trapezoid { from, to, pace, ramp } => {
                let speed = match pace {
                    Pace::Speed(speed) => speed.copysign(to - from),
                    // The ramps together cover what one of them would at full speed.
                    Pace::Duration(duration) => (to - from) / (duration - ramp),
                };
                Profile::Pieces(trapezoid(*from, *to, speed, *ramp))
            }
            MotionLaw::Knots(knots) => Profile::Pieces(spline(knots)),
            MotionLaw::Function { value, duration } => {
                Profile::Function { value: value.clone(), duration: *duration }
            }
            MotionLaw::Constant { from, rate, until } => {
                let end = match until {
                    Until::Value(to) => (to - from) / rate,
                    Until::Duration(duration) => *duration,
                };
                Profile::Pieces(vec![Piece { start: 0.0, end, c: [*from, *rate, 0.0, 0.0] }])
            }
        }
    }

    /// First and last time.
    pub fn ends(&self) -> [f64; 2] {
        match self {
            Profile::Pieces(pieces) => [
                pieces.first().map_or(0.0, |piece| piece.start),
                pieces.last().map_or(0.0, |piece| piece.end),
            ],
            Profile::Function { duration, .. } => [0.0, *duration],
        }
    }

    /// Value, rate and second derivative at a time; at the border of two stretches those of the one side.
    pub fn at(&self, time: f64, side: Side) -> [f64; 3] {
        match self {
            Profile::Pieces(pieces) => {
                let last = pieces.len() - 1;
                let position = match side {
                    Side::Before => pieces.iter().position(|piece| time <= piece.end),
                    Side::After => pieces.iter().position(|piece| time < piece.end),
                };
                pieces[position.unwrap_or(last)].at(time)
            }
            Profile::Function { value, .. } => {
                let [value, rate, acceleration, _] = value.jet(time);
                [value, rate, acceleration]
            }
        }
    }

    /// Times inside at which the second derivative jumps.
    fn jumps(&self) -> Vec<f64> {
        let Profile::Pieces(pieces) = self else { return Vec::new() };
        let largest = pieces
            .iter()
            .flat_map(|piece| [piece.at(piece.start)[2].abs(), piece.at(piece.end)[2].abs()])
            .fold(0.0, f64::max);
        let jump = |pair: &&[Piece]| {
            (pair[0].at(pair[0].end)[2] - pair[1].at(pair[1].start)[2]).abs() > 1e-9 * largest
        };
        pieces.windows(2).filter(jump).map(|pair| pair[0].end).collect()
    }

    /// The times of a study: evenly spread, and both sides of every jump.
    pub fn moments(&self, study: &InverseDynamicsStudy) -> Vec<Moment> {
        let ends = self.ends();
        let [start, end] = ends;
        let last = study.sampling.count(ends).max(2) - 1;
        let (jumps, same) = (self.jumps(), SAME * (end - start));
        let mut times: Vec<(f64, Side)> = (0..=last)
            .map(|i| start + (end - start) * i as f64 / last as f64)
            .filter(|time| jumps.iter().all(|jump| (jump - time).abs() > same))
            .map(|time| (time, Side::After))
            .collect();
        times.extend(jumps.iter().flat_map(|jump| [(*jump, Side::Before), (*jump, Side::After)]));
        // The sort is stable, so that before stays before after.
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        times.into_iter().map(|(time, side)| Moment { time, at: self.at(time, side) }).collect()
    }
}

fn trapezoid(from: f64, to: f64, speed: f64, ramp: f64) -> Vec<Piece> {
    let acceleration = speed / ramp;
    // Never less than nothing by round-off.
    let cruise = ((to - from) / speed - ramp).max(0.0);
    let rise = 0.5 * speed * ramp;
    let [second, third] = [ramp, ramp + cruise];
    let pieces = [
        Piece { start: 0.0, end: second, c: [from, 0.0, 0.5 * acceleration, 0.0] },
        Piece { start: second, end: third, c: [from + rise, speed, 0.0, 0.0] },
        Piece { start: third, end: third + ramp, c: [to - rise, speed, -0.5 * acceleration, 0.0] },
    ];
    // Where it only just gets to its speed there is nothing between the ramps.
    pieces.into_iter().filter(|piece| piece.end - piece.start > SAME * (third + ramp)).collect()
}

/// The cubic spline with continuous second derivative through the knots, of slope zero at both ends. With M the second
/// derivative at the knots, h the distances of times and d the slopes of chords,
/// h₋ M₋ + 2 (h₋ + h) M + h M₊ = 6 (d - d₋). Source: de Boor, *A Practical Guide to Splines* (2001), ch. IV.
fn spline(knots: &[[f64; 2]]) -> Vec<Piece> {
    let n = knots.len();
    let h: Vec<f64> = knots.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let d: Vec<f64> = knots.windows(2).zip(&h).map(|(pair, h)| (pair[1][1] - pair[0][1]) / h).collect();
    let mut diagonal = vec![0.0; n];
    let mut m = vec![0.0; n];
    for i in 0..n {
        let (before, after) = (i.checked_sub(1).map(|k| (h[k], d[k])), h.get(i).map(|h| (*h, d[i])));
        let (h0, d0) = before.unwrap_or((0.0, 0.0));
        let (h1, d1) = after.unwrap_or((0.0, 0.0));
        diagonal[i] = 2.0 * (h0 + h1);
        m[i] = 6.0 * (d1 - d0);
    }
    // Thomas' elimination; the matrix is diagonally dominant.
    for i in 1..n {
        let factor = h[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * h[i - 1];
        m[i] -= factor * m[i - 1];
    }
    for i in (0..n).rev() {
        let known = if i + 1 < n { h[i] * m[i + 1] } else { 0.0 };
        m[i] = (m[i] - known) / diagonal[i];
    }
    (0..n - 1)
        .map(|i| Piece {
            start: knots[i][0],
            end: knots[i + 1][0],
            c: [
                knots[i][1],
                d[i] - h[i] * (2.0 * m[i] + m[i + 1]) / 6.0,
                0.5 * m[i],
                (m[i + 1] - m[i]) / (6.0 * h[i]),
            ],
        })
        .collect()
}
