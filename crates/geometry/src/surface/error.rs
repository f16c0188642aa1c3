//! What can be wrong with a surface.

/// A surface that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// A semi-axis that is none.
    #[error("the semi-axis of the surface along {axis} must be positive and finite, but is {value}")]
    Axis {
        /// "x", "y" or "z".
        axis: &'static str,
        /// Its value, m.
        value: f64,
    },
    /// A point with a coordinate that is no number.
    #[error("point {index} of the surface has a coordinate that is not finite")]
    PointNotFinite {
        /// Its number, from 0.
        index: usize,
    },
    /// Fewer points than coefficients.
    #[error(
        "a surface of degree {degree} has {needed} coefficients and needs at least as many points, but has {count}"
    )]
    TooFewPoints {
        /// How many there are.
        count: usize,
        /// How many are needed.
        needed: usize,
        /// Degree of the polynomial.
        degree: usize,
    },
    /// A degree that cannot be had.
    #[error("the degree of the surface must be at most {most}, but is {degree}")]
    Degree {
        /// What was asked for.
        degree: usize,
        /// The most.
        most: usize,
    },
    /// A measured point far from the ellipsoid that the heights are counted from.
    #[error(
        "point {index} lies at {ratio} of the ellipsoid's radius in its direction; heights can be fitted between {least} and {most}"
    )]
    PointFar {
        /// Its number, from 0.
        index: usize,
        /// |(x/a, y/b, z/c)|.
        ratio: f64,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
    },
    /// The points lie such that they leave coefficients open.
    #[error("the points do not determine a surface of degree {degree}: they lie on too few lines or planes")]
    Undetermined {
        /// Degree of the polynomial.
        degree: usize,
    },
    /// A fit that left its points.
    #[error("the surface of degree {degree} that was fitted has no place near point {index}")]
    NoFoot {
        /// The point's number, from 0.
        index: usize,
        /// Degree of the polynomial.
        degree: usize,
    },
    /// A meridian needs at least three points.
    #[error("the profile of a surface of revolution needs at least three points, but has {count}")]
    TooFewProfilePoints {
        /// How many there are.
        count: usize,
    },
    /// Points of a meridian in a wrong order.
    #[error("the z of the profile must increase from point to point, but does not after point {index}")]
    ProfileOrder {
        /// The point's number, from 0.
        index: usize,
    },
    /// The range of z is empty or not finite.
    #[error("the range of the profile must increase, but is {from} to {to} m")]
    Range {
        /// First z, m.
        from: f64,
        /// Last z, m.
        to: f64,
    },
    /// A radius below zero, or zero between the ends.
    #[error("the radius of the profile must be positive between its ends, but is {radius} m at z = {z} m")]
    Radius {
        /// Where, m.
        z: f64,
        /// The radius there, m.
        radius: f64,
    },
}
