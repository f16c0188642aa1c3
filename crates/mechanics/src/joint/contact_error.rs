//! What can be wrong with a joint of two boundaries: curves that roll in a plane, or surfaces that touch in space.

use flexura_geometry::{BoundaryError, SurfaceError};

/// A rolling or contact joint that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// A boundary that is none.
    #[error("{source}")]
    Boundary {
        /// "child" or "parent".
        which: &'static str,
        /// What is wrong with it.
        source: BoundaryError,
    },
    /// A kind of joint whose two sides touch, without what touches.
    #[error("the joint has no boundaries or surfaces that belong to its kind")]
    Missing,
    /// The turning of a tangent says where the contact is on convex boundaries only.
    #[error(
        "the child's boundary is not curved outwards everywhere, so its turning does not say where it touches"
    )]
    NotConvex,
    /// Two lines touch everywhere or nowhere.
    #[error("both boundaries are straight lines, which cannot roll on each other")]
    BothStraight,
    /// A hollow into which the child does not fit.
    #[error(
        "at the first contact the hollow of the parent has the radius of curvature {parent} m, and the child {child} m: the child does not fit into it"
    )]
    TooCurved {
        /// Radius of the child, m.
        child: f64,
        /// Radius of the parent, m.
        parent: f64,
    },
    /// Nowhere in the initial orientation do the normals oppose.
    #[error(
        "in the initial poses there is no place where the two boundaries could touch with opposite normals"
    )]
    NoContact,
    /// The first contact is not on the curve.
    #[error("the first contact on the {which}, at the parameter {parameter}, is not on its boundary")]
    StartOutside {
        /// "child" or "parent".
        which: &'static str,
        /// The curve's parameter there.
        parameter: f64,
    },
    /// There must be no travel at coordinate zero.
    #[error("the {which} at coordinate zero must be zero, but is {value} m")]
    TravelAtZero {
        /// "slide" or "roll".
        which: &'static str,
        /// Its value, m.
        value: f64,
    },
    /// A sliding velocity belongs to a rate of turning.
    #[error("a sliding velocity goes with a rate of turning, but the coordinate is an arc")]
    VelocityByArc,
    /// A number of the slide law that makes no sense.
    #[error("the {what} of the slide law is {value}")]
    SlideNumber {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A table that does not increase.
    #[error("the coordinates in the table of the slide law must increase")]
    SlideTable,
    /// Pure sliding within a hollow that fits exactly, and the like: nothing says how the travel goes.
    #[error(
        "with the coordinate `{coordinate}` the travel is not defined, because the boundaries have equal curvatures and no slip"
    )]
    Conforming {
        /// The coordinate's name.
        coordinate: &'static str,
    },
    /// A surface that is none.
    #[error("{source}")]
    Surface {
        /// "child" or "parent".
        which: &'static str,
        /// What is wrong with it.
        source: SurfaceError,
    },
    /// Two surfaces that may touch along a line.
    #[error("at least one of the two surfaces must be curved in both directions")]
    NoneRounded,
    /// A hollow, a saddle or a waist into which the child does not fit.
    #[error(
        "where the surfaces could touch first they would cut into each other: the sum of their curvatures is {curvature} 1/m in one direction and must be positive in all"
    )]
    Cuts {
        /// The smallest sum of the curvatures of child and parent, 1/m.
        curvature: f64,
    },
    /// An axis that is none.
    #[error("the axis that a surface rolls about must be finite and other than zero")]
    NoAxis,
    /// Turning about the normal is spin, not rolling.
    #[error(
        "the axis that the surface rolls about is along the normal of the first contact, about which it would spin"
    )]
    AxisAlongNormal,
    /// The coordinate must be able to be zero.
    #[error(
        "the range of a rolling surface must lead from a negative angle, or zero, to a positive one, but is {from} to {to} rad"
    )]
    RollingRange {
        /// First angle, rad.
        from: f64,
        /// Last angle, rad.
        to: f64,
    },
}
