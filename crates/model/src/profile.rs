//! Quantities that may vary along a beam.

use crate::Notch;
use flexura_expression::{Function, Variation};

/// A place along a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// Fraction of the beam's undeformed length, 0 to 1.
    Fraction(f64),
    /// Undeformed arc length from the start, m.
    Length(f64),
}

impl At {
    /// The arc length (m) on a beam of the given length.
    pub fn arc_length(&self, length: f64) -> f64 {
        match self {
            At::Fraction(fraction) => fraction * length,
            At::Length(s) => *s,
        }
    }
}

/// A quantity along a beam.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// The same everywhere.
    Constant(f64),
    /// Straight lines between the rows, constant beyond the first and last row.
    Table {
        /// Where the rows stand, strictly increasing along the beam.
        at: Vec<At>,
        /// The value at each row, SI.
        value: Vec<f64>,
    },
    /// A function of the undeformed arc length s (m).
    Function(Function),
    /// The height of a notched flexure hinge.
    Notch(Notch),
}

impl Profile {
    /// The value at arc length `s` on a beam of the given length.
    pub fn value(&self, s: f64, length: f64) -> f64 {
        match self {
            Profile::Constant(value) => *value,
            Profile::Function(function) => function.value(s),
            Profile::Notch(notch) => notch.height(s, length),
            Profile::Table { at, value } => {
                let upper = at.partition_point(|row| row.arc_length(length) <= s);
                if upper == 0 {
                    return value[0];
                }
                if upper == at.len() {
                    return value[upper - 1];
                }
                let (a, b) = (at[upper - 1].arc_length(length), at[upper].arc_length(length));
                let t = (s - a) / (b - a);
                value[upper - 1] * (1.0 - t) + value[upper] * t
            }
        }
    }

    /// The derivative by arc length at `s`; at a kink that of the part beyond. NaN for a notch, which has none here.
    pub fn slope(&self, s: f64, length: f64) -> f64 {
        match self {
            Profile::Constant(_) => 0.0,
            Profile::Function(function) => function.jet(s)[1],
            Profile::Notch(_) => f64::NAN,
            Profile::Table { at, value } => {
                let upper = at.partition_point(|row| row.arc_length(length) <= s);
                if upper == 0 || upper == at.len() {
                    return 0.0;
                }
                let (a, b) = (at[upper - 1].arc_length(length), at[upper].arc_length(length));
                (value[upper] - value[upper - 1]) / (b - a)
            }
        }
    }

    /// The value if it is the same everywhere.
    pub fn as_constant(&self) -> Option<f64> {
        match self {
            Profile::Constant(value) => Some(*value),
            Profile::Function(function) => function.as_constant(),
            Profile::Notch(_) => None,
            Profile::Table { value, .. } => value.iter().all(|v| *v == value[0]).then(|| value[0]),
        }
    }

    /// What a function can be between two arc lengths between its breaks; None for what is no function, whose breaks say all.
    pub fn variation(&self, a: f64, b: f64) -> Option<Variation> {
        match self {
            Profile::Function(function) if function.as_constant().is_none() => Some(function.variation(a, b)),
            _ => None,
        }
    }

    /// Arc lengths strictly inside the beam, in increasing order, between which the profile is smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        let mut breaks: Vec<f64> = match self {
            Profile::Table { at, .. } => at.iter().map(|row| row.arc_length(length)).collect(),
            Profile::Notch(notch) => notch.breaks(length),
            Profile::Function(function) => function.breaks(0.0, length),
            Profile::Constant(_) => Vec::new(),
        };
        // What comes out at an end but for round-off is no break.
        let margin = 1e-12 * length;
        breaks.retain(|s| *s > margin && *s < length - margin);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| (*a - *b).abs() < margin);
        breaks
    }
}

impl From<f64> for Profile {
    fn from(value: f64) -> Self {
        Profile::Constant(value)
    }
}
