//! Contact of two boundaries: what touches what, and how it may roll and slide.

use flexura_expression::Function;
use flexura_spatial::Vector3;

/// What a rolling or contact joint is made of besides its axes and coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Contact {
    /// Two curves in one plane.
    Rolling(Rolling),
    /// Two surfaces in space.
    Surfaces(Surfaces),
}

/// A planar joint whose moving boundary rolls and slides on a fixed one.
#[derive(Clone, Debug, PartialEq)]
pub struct Rolling {
    /// The moving boundary, in M's plane.
    pub child: Boundary,
    /// The fixed boundary, in F's plane.
    pub parent: Boundary,
    /// The child lies inside the parent's curve and touches it from there.
    pub concave: bool,
    /// Parameters of child and parent where they touch at coordinate zero. None: where the initial poses bring them closest.
    pub start: Option<[f64; 2]>,
    /// How much of the travel is sliding.
    pub slide: Slide,
    /// Boundaries that are apart in the initial poses are brought together.
    pub close: bool,
}

/// A boundary curve with the side on which nothing is.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// The curve.
    pub curve: BoundaryCurve,
    /// On which side of it, seen along growing parameter, the outside lies. None: right where the curve is closed and runs
    /// counter-clockwise, left where it runs clockwise; right of an open one.
    pub outside: Option<Side>,
}

/// A side of a curve, seen along growing parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// Curves (x, y) in the plane of a joint, m.
#[derive(Clone, Debug, PartialEq)]
pub enum BoundaryCurve {
    /// (a cos t, b sin t); t is the eccentric angle.
    Ellipse {
        /// a along x and b along y, m.
        semi_axes: [f64; 2],
        /// First and last t of an arc; None: all of it.
        range: Option<[f64; 2]>,
    },
    /// A straight line; the parameter is the distance from the point, m, growing to the left as seen against the normal.
    Line {
        /// A point of it.
        point: [f64; 2],
        /// Away from the material.
        normal: [f64; 2],
        /// First and last parameter; None: without end.
        range: Option<[f64; 2]>,
    },
    /// Circular arcs that join smoothly; the parameter is the arc length, m.
    Arcs {
        /// Where the first begins.
        point: [f64; 2],
        /// The direction in which it begins.
        direction: [f64; 2],
        /// Radius (m) and angle (rad) of each; a positive angle bends to the left.
        arcs: Vec<[f64; 2]>,
    },
    /// A C² cubic spline through points; the parameter is the chord length, m.
    Points {
        /// At least three of a closed curve, two of an open one.
        points: Vec<[f64; 2]>,
        /// Leads back from the last point to the first.
        closed: bool,
    },
    /// (x(t), y(t)).
    Expression {
        /// Coordinates as functions of the parameter.
        position: [Function; 2],
        /// First and last parameter.
        range: [f64; 2],
        /// The last point is the first, and the curve is smooth there.
        closed: bool,
    },
}

/// The coordinate of a rolling joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RollingCoordinate {
    /// By how much the contact normal has turned within the child, backwards: γ. The child's boundary must be convex.
    Turning,
    /// By how much the child has turned.
    Angle,
    /// How far the contact has travelled on the child, m.
    Arc,
}

/// How the travel of the contact on the child, a, is made of that on the parent (the roll, b) and of sliding: a = b + slide.
/// q is the joint's coordinate.
#[derive(Clone, Debug, PartialEq)]
pub enum Slide {
    /// Rolling without slip.
    None,
    /// The contact stays where it is on the parent: b = 0.
    Pure,
    /// slide = velocity / rate q.
    Velocity {
        /// Sliding velocity v_r, m/s.
        velocity: f64,
        /// Rate of the coordinate ω that it goes with, in its unit per second.
        rate: f64,
    },
    /// b = ratio × slide.
    Ratio {
        /// Roll per slide.
        ratio: f64,
    },
    /// slide = f(q), with f(0) = 0.
    Function(Function),
    /// slide interpolated by a C² cubic spline through (q, slide).
    Table(Vec<[f64; 2]>),
    /// Both are measured: b = roll(q), slide(q).
    Measured {
        /// b, m.
        roll: Function,
        /// Slide, m.
        slide: Function,
    },
    /// No slip, but the travel in steps of the coordinate, each with the radius of curvature at its beginning: the thesis's
    /// explicit recipe, first order in the step.
    Stepped {
        /// Step of the coordinate.
        step: f64,
    },
}

/// A joint of two surfaces in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Surfaces {
    /// The moving surface, in M's axes.
    pub child: Surface,
    /// The fixed surface, in F's axes.
    pub parent: Surface,
    /// The child lies inside the parent's surface and touches it from there.
    pub concave: bool,
    /// How the child moves on the parent.
    pub motion: SurfaceMotion,
    /// First and last angle of a rolling motion, rad, with zero between them. Unused by sliding.
    pub range: [f64; 2],
    /// Surfaces that are apart in the initial poses are brought together.
    pub close: bool,
}

/// How one surface moves on another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceMotion {
    /// Freely, without friction.
    Sliding,
    /// Rolling without slip and without spin, by the part of `about` that lies in the tangent plane.
    Rolling {
        /// Axis of the turning, in F's axes.
        about: Vector3<f64>,
    },
    /// Rolling without slip and without spin, with the contact travelling in the normal plane across `about`, which turns with
    /// the contact normal: in the osculating plane.
    Osculating {
        /// Axis of the turning, in F's axes.
        about: Vector3<f64>,
    },
}

/// Surfaces in space, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Semi-axes along x, y, z.
    Ellipsoid {
        /// m.
        semi_axes: Vector3<f64>,
    },
    /// An elliptic cylinder along z with the given semi-axes along x and y.
    Cylinder {
        /// m.
        semi_axes: [f64; 2],
    },
    /// The plane z = 0 with the outside at z > 0.
    Plane,
    /// A meridian turned about z.
    Revolution {
        /// Radius over z.
        profile: RevolutionProfile,
    },
    /// Measured heights over an ellipsoid.
    Heights {
        /// Of the ellipsoid along x, y, z, m.
        semi_axes: Vector3<f64>,
        /// Measured points, m.
        points: Vec<Vector3<f64>>,
        /// Degree of the polynomial that is fitted to them.
        degree: usize,
    },
}

/// The radius of a surface of revolution over z. Where it ends at zero, the surface is closed by a pole.
#[derive(Clone, Debug, PartialEq)]
pub enum RevolutionProfile {
    /// (z, radius), m; joined by a C² cubic spline of the radius squared.
    Points(Vec<[f64; 2]>),
    /// radius(z).
    Radius {
        /// m, of z in m.
        radius: Function,
        /// First and last z, m.
        range: [f64; 2],
    },
}
