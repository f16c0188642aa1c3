//! What can be wrong with a boundary.

use crate::ShapeError;

/// A boundary that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundaryError {
    /// A number that must be positive and finite is not.
    #[error("the {what} of the boundary must be positive and finite, but is {value}")]
    NotPositive {
        /// Which number.
        what: &'static str,
        /// Its value, m.
        value: f64,
    },
    /// The range of the parameter is empty or not finite.
    #[error("the range of the boundary's parameter must increase, but is {from} to {to}")]
    Range {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// An arc of an ellipse that covers a part of it twice.
    #[error("the arc from {from} to {to} rad is more than one turn of the ellipse")]
    MoreThanATurn {
        /// First angle, rad.
        from: f64,
        /// Last angle, rad.
        to: f64,
    },
    /// A line whose normal is zero.
    #[error("the line needs a finite point and a normal other than zero")]
    NoNormal,
    /// An arc that is none.
    #[error(
        "an arc of the boundary needs a positive radius and an angle other than zero, but has {radius} m and {angle} rad"
    )]
    Arc {
        /// Its radius, m.
        radius: f64,
        /// Its angle, rad.
        angle: f64,
    },
    /// Arcs that begin nowhere.
    #[error("the boundary needs at least one arc, and a direction other than zero in which the first begins")]
    NoDirection,
    /// The curve itself cannot be used.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The curve crosses itself.
    #[error("the boundary crosses itself near the parameter values {first} and {second}")]
    Crosses {
        /// One of the two values.
        first: f64,
        /// The other.
        second: f64,
    },
    /// A closed curve whose ends do not meet.
    #[error(
        "the boundary is said to be closed, but its ends are {gap} m apart, or differ in direction or curvature"
    )]
    NotClosed {
        /// Distance of the ends, m.
        gap: f64,
    },
    /// The outside of a closed curve is said to be where it encloses something.
    #[error(
        "the outside of a closed boundary cannot lie within it; for a body inside a hollow use `concave = true`"
    )]
    OutsideWithin,
}
