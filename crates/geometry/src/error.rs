//! What can be wrong with a rest shape or a section, with the values that are wrong.

/// A rest shape that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A number that must be positive and finite is not.
    #[error("the {what} of the curve must be positive and finite, but is {value}")]
    NotPositive {
        /// Which number: "length", "radius", "angle", "turns".
        what: &'static str,
        /// Its value, SI.
        value: f64,
    },
    /// A number that must be finite is not.
    #[error("the {what} of the curve must be finite, but is {value}")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// Its value, SI.
        value: f64,
    },
    /// The parameter range of a parametric curve is empty or not finite.
    #[error("the range of the curve's parameter must increase, but is {from} to {to}")]
    Range {
        /// First parameter value.
        from: f64,
        /// Last parameter value.
        to: f64,
    },
    /// A parametric curve has no finite value, or no finite derivative, somewhere.
    #[error(
        "the curve or one of its first three derivatives is not finite at the parameter value {parameter}"
    )]
    Undefined {
        /// The parameter value.
        parameter: f64,
    },
    /// The whole curve is one point.
    #[error("the curve has no length")]
    NoLength,
    /// The curve stops and turns: its speed vanishes.
    #[error(
        "the curve has a cusp or stands still at the parameter value {parameter} (s = {s} m): its speed vanishes there, so it has no tangent"
    )]
    Cusp {
        /// The parameter value.
        parameter: f64,
        /// The arc length there, m.
        s: f64,
    },
    /// The curve changes its direction at a point.
    #[error(
        "the curve has a corner at the parameter value {parameter} (s = {s} m): a beam's axis must be smooth"
    )]
    Corner {
        /// The parameter value.
        parameter: f64,
        /// The arc length there, m.
        s: f64,
    },
    /// Fewer than two points.
    #[error("a curve through points needs at least two of them, but has {count}")]
    TooFewPoints {
        /// How many there are.
        count: usize,
    },
    /// Two consecutive points coincide.
    #[error("points {first} and {second} (counted from 0) of the curve coincide", second = first + 1)]
    DuplicatePoint {
        /// Index of the first of the two.
        first: usize,
    },
    /// A point is not finite.
    #[error("point {index} (counted from 0) of the curve is not finite")]
    PointNotFinite {
        /// Its index.
        index: usize,
    },
    /// The Frenet frame does not exist where the curve is straight.
    #[error(
        "the Frenet frame does not exist at s = {s} m, where the curvature vanishes; use the rotation-minimising frame (with a twist if one is wanted)"
    )]
    FrenetUndefined {
        /// Arc length of the straight place, m.
        s: f64,
    },
    /// The wanted direction of e2 runs along the tangent.
    #[error("the wanted direction of e2 is parallel to the curve's tangent at s = {s} m; choose another one")]
    DirectionParallel {
        /// Arc length of the place, m.
        s: f64,
    },
    /// The wanted direction of e2 is zero or not finite.
    #[error("the wanted direction of e2 must be a finite vector other than zero, but is [{x}, {y}, {z}]")]
    DirectionInvalid {
        /// First component.
        x: f64,
        /// Second component.
        y: f64,
        /// Third component.
        z: f64,
    },
    /// A rest curvature or a twist is not finite somewhere.
    #[error("the {what} is not finite at s = {s} m")]
    LawNotFinite {
        /// "k1", "k2", "k3" or "twist".
        what: &'static str,
        /// Arc length, m.
        s: f64,
    },
}

/// A cross section that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// A dimension or stiffness that must be positive is not.
    #[error("the {what} of the section must be positive, but is {value} at s = {s} m")]
    NotPositive {
        /// Which dimension or stiffness.
        what: &'static str,
        /// Its value, SI.
        value: f64,
        /// Arc length, m.
        s: f64,
    },
    /// A tube without a wall.
    #[error(
        "the inner diameter {inner} m of the tube is not below its outer diameter {outer} m at s = {s} m"
    )]
    NoWall {
        /// Inner diameter, m.
        inner: f64,
        /// Outer diameter, m.
        outer: f64,
        /// Arc length, m.
        s: f64,
    },
    /// A section given by its dimensions needs a material.
    #[error("a section given by its dimensions needs a material")]
    NoMaterial,
    /// A beam that shears needs a shear stiffness along both axes.
    #[error("the beam shears, so its section needs the shear stiffness {which}")]
    NoShearStiffness {
        /// "ga2" or "ga3".
        which: &'static str,
    },
    /// The stiffness matrix is not symmetric.
    #[error(
        "the stiffness matrix is not symmetric: entry ({row}, {column}) is {value}, its mirror image {mirrored}"
    )]
    NotSymmetric {
        /// Row from 1.
        row: usize,
        /// Column from 1.
        column: usize,
        /// The entry.
        value: f64,
        /// The mirrored entry.
        mirrored: f64,
    },
    /// The stiffness matrix is not positive definite.
    #[error("the stiffness matrix is not positive definite: some strain would cost no energy")]
    NotPositiveDefinite,
    /// Plane strain means nothing for this shape.
    #[error("plane strain is a property of wide strips: it needs a rectangle or an ellipse, not a {shape}")]
    PlaneStrain {
        /// "circle", "tube" or "stiffness".
        shape: &'static str,
    },
}
