//! A branch as a smooth line: solid where it is stable, dashed where it is not.

use super::canvas::Style;
use flexura_solution::TracePoint;

/// Colour of what is not decided.
pub const UNDECIDED: &str = "#9a9a9a";

/// What is known of a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Stable,
    Unstable,
    Undecided,
}

impl Verdict {
    /// Of the piece between two neighbouring points. A fold or branch point itself is undecided, so the other end says it.
    pub fn between(a: &TracePoint, b: &TracePoint) -> Self {
        let known = match (a.stable, b.stable) {
            (Some(a), Some(b)) if a == b => Some(a),
            (Some(known), None) if b.kind.is_critical() => Some(known),
            (None, Some(known)) if a.kind.is_critical() => Some(known),
            _ => None,
        };
        match known {
            Some(true) => Verdict::Stable,
            Some(false) => Verdict::Unstable,
            None => Verdict::Undecided,
        }
    }

    /// How such a piece of a branch of that colour looks.
    pub fn style(self, colour: &'static str) -> Style {
        match self {
            Verdict::Stable => Style::line(colour, 2.2),
            Verdict::Unstable => Style::line(colour, 1.7).dashed("5 5"),
            Verdict::Undecided => Style::line(UNDECIDED, 1.3),
        }
    }
}

/// A point on the sheet with its way along the branch.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    pub arc: f64,
    pub at: [f64; 2],
}

/// Bézier curves through neighbouring stations, one for each pair; the tangent at a station is that of the parabola through
/// it and its neighbours.
pub fn smooth(stations: &[Station]) -> Vec<[[f64; 2]; 4]> {
    let tangents: Vec<[f64; 2]> = (0..stations.len()).map(|i| tangent(stations, i)).collect();
    let piece = |i: usize| {
        let (a, b) = (stations[i], stations[i + 1]);
        let step = b.arc - a.arc;
        let chord = (b.at[0] - a.at[0]).hypot(b.at[1] - a.at[1]);
        // A handle longer than half the chord makes loops where arc and chord do not go together.
        let handle = |tangent: [f64; 2]| {
            let length = step / 3.0 * tangent[0].hypot(tangent[1]);
            let factor = if length > 0.5 * chord { 0.5 * chord / length } else { 1.0 };
            tangent.map(|component| factor * step / 3.0 * component)
        };
        let (out, into) = (handle(tangents[i]), handle(tangents[i + 1]));
        [a.at, [a.at[0] + out[0], a.at[1] + out[1]], [b.at[0] - into[0], b.at[1] - into[1]], b.at]
    };
    (0..stations.len().saturating_sub(1)).map(piece).collect()
}

/// The same curves from their left end to the right, or from top to bottom.
pub fn from_the_left(pieces: &[[[f64; 2]; 4]]) -> Vec<[[f64; 2]; 4]> {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return Vec::new() };
    let (from, to) = (first[0], last[3]);
    // Hundredths of a pixel are what is written.
    let is_backwards = if (from[0] - to[0]).abs() > 0.01 { from[0] > to[0] } else { from[1] > to[1] };
    if !is_backwards {
        return pieces.to_vec();
    }
    pieces.iter().rev().map(|[a, b, c, d]| [*d, *c, *b, *a]).collect()
}

/// Change per arc at a station; zero where the arc stands still.
fn tangent(stations: &[Station], i: usize) -> [f64; 2] {
    let slope = |a: &Station, b: &Station| {
        let step = b.arc - a.arc;
        if step > 0.0 { [(b.at[0] - a.at[0]) / step, (b.at[1] - a.at[1]) / step] } else { [0.0; 2] }
    };
    let inner = |i: usize| {
        let [a, b, c] = [&stations[i - 1], &stations[i], &stations[i + 1]];
        let (before, after) = (b.arc - a.arc, c.arc - b.arc);
        if before <= 0.0 || after <= 0.0 {
            return [0.0; 2];
        }
        let (left, right) = (slope(a, b), slope(b, c));
        [0, 1].map(|k| (after * left[k] + before * right[k]) / (before + after))
    };
    let last = stations.len() - 1;
    // At an end, the parabola through the end and its two neighbours goes on.
    let end = |chord: [f64; 2], next: [f64; 2]| [0, 1].map(|k| 2.0 * chord[k] - next[k]);
    match i {
        _ if last == 0 => [0.0; 2],
        0 | 1 if last == 1 => slope(&stations[0], &stations[1]),
        0 => end(slope(&stations[0], &stations[1]), inner(1)),
        i if i == last => end(slope(&stations[last - 1], &stations[last]), inner(last - 1)),
        i => inner(i),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_met_from_end_to_end() {
        let at = |arc: f64| Station { arc, at: [3.0 * arc * arc, 2.0 * arc] };
        let pieces = smooth(&[at(0.0), at(0.5), at(1.5), at(2.0)]);
        assert_eq!(pieces.len(), 3);
        for (i, piece) in pieces.iter().enumerate() {
            let ends = [0.0, 0.5, 1.5, 2.0];
            let middle =
                [0, 1].map(|k| (piece[0][k] + 3.0 * piece[1][k] + 3.0 * piece[2][k] + piece[3][k]) / 8.0);
            let expected = at(0.5 * (ends[i] + ends[i + 1])).at;
            assert!((middle[0] - expected[0]).abs() < 1e-12 && (middle[1] - expected[1]).abs() < 1e-12);
        }
    }

    #[test]
    fn curves_that_lie_on_each_other_are_drawn_from_the_same_end() {
        let at = |arc: f64, x: f64| Station { arc, at: [x, x * x] };
        let there = smooth(&[at(0.0, 0.0), at(1.0, 1.0), at(2.0, 2.0)]);
        let back = smooth(&[at(0.0, 2.0), at(1.0, 1.0), at(2.0, 0.0)]);
        assert_eq!(from_the_left(&there), there);
        for (a, b) in from_the_left(&back).iter().flatten().zip(there.iter().flatten()) {
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12);
        }
    }

    #[test]
    fn stations_in_one_place_are_no_trouble() {
        let at = |arc: f64, x: f64| Station { arc, at: [x, 0.0] };
        for piece in smooth(&[at(0.0, 0.0), at(1.0, 1.0), at(1.0, 1.0), at(2.0, 2.0)]) {
            assert!(piece.iter().flatten().all(|c| c.is_finite()));
        }
        assert!(smooth(&[at(0.0, 0.0)]).is_empty() && smooth(&[]).is_empty());
    }
}
