//! Joints: which motion they leave free, and what drives, loads or springs it.

use crate::{Contact, Frame, Mount, RollingCoordinate};
use flexura_spatial::{Pose, Vector3};

/// A joint between a parent (carries the fixed frame F) and a child (carries the moving frame M).
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name, unique among joints.
    pub name: String,
    /// F on its body.
    pub parent: Frame,
    /// What carries M.
    pub child: Mount,
    /// X of M in the child. None: M is where F is in the initial poses, so that the joint starts at zero.
    pub child_pose: Option<Pose>,
    /// Kind, axis and coordinates.
    pub law: JointLaw,
}

/// The law of a joint or of a beam end's hold: X_FM(q) with what acts on q.
#[derive(Clone, Debug, PartialEq)]
pub struct JointLaw {
    /// Which motions are left.
    pub kind: JointKind,
    /// Unit axis in F's axes; unused by weld, spherical and free. Of a planar joint it is the plane's normal.
    pub axis: Vector3<f64>,
    /// A second unit axis: of a universal joint the one that turns with M (in F's axes where M coincides with F);
    /// of a planar or rolling joint the direction of x, at right angles to the normal. Unused by the others.
    pub second_axis: Vector3<f64>,
    /// What touches what: of rolling and contact joints, and of these alone.
    pub contact: Option<Box<Contact>>,
    /// One per coordinate, in the kind's order.
    pub coordinates: Vec<CoordinateLaw>,
}

impl JointLaw {
    /// A law of the given kind whose coordinates are all free and unloaded.
    pub fn free(kind: JointKind, axis: Vector3<f64>) -> Self {
        let second_axis = across(&axis);
        let coordinates = vec![CoordinateLaw::default(); kind.freedoms()];
        Self { kind, axis, second_axis, contact: None, coordinates }
    }

    /// No motion at all: a clamp.
    pub fn weld() -> Self {
        Self::free(JointKind::Weld, Vector3::x())
    }
}

/// The first of x, y, z that is not along `axis`, made to be at right angles to it.
pub fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    let start = if axis.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    (start - axis * axis.dot(&start)).normalize()
}

/// Is a coordinate an angle or a length?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// rad; its effort is a moment.
    Angle,
    /// m; its effort is a force.
    Length,
}

/// The kinds of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// No motion.
    Weld,
    /// Turning about the axis; one angle.
    Revolute,
    /// Sliding along the axis; one length.
    Prismatic,
    /// Turning about the axis and sliding along it; an angle and a length.
    Cylindrical,
    /// Turning about the axis, then about the second axis, which the first turning carries along; two angles.
    Universal,
    /// Turning about a point; coordinates are the rotation vector from F to M.
    Spherical,
    /// Sliding in the plane across the axis and turning about it: x along the second axis, y = axis × x, angle.
    Planar,
    /// No constraint; the position of M's origin in F and the rotation vector from F to M.
    Free,
    /// A boundary of the child rolls and slides on one of the parent, in the plane across the axis, with x along the second
    /// axis; one coordinate.
    Rolling(RollingCoordinate),
    /// A surface of the child touches one of the parent and slides on it without friction: the rotation vector from F to M,
    /// and two parameters u, v of the contact. These are the parent's where the child's surface is curved outwards in both
    /// directions, otherwise the child's: longitude and latitude of an ellipsoid or of heights (of the coordinates divided by
    /// the semi-axes), longitude and z of a cylinder or a surface of revolution, x and y of a plane. All count as angles: those
    /// that are lengths are numbers of metres, whose effort is in J/m.
    Contact,
    /// A surface of the child rolls on one of the parent without slip and without spin, along a path; one angle.
    SurfaceRolling,
}

impl JointKind {
    /// Number of coordinates.
    pub fn freedoms(self) -> usize {
        match self {
            JointKind::Weld => 0,
            JointKind::Revolute
            | JointKind::Prismatic
            | JointKind::Rolling(_)
            | JointKind::SurfaceRolling => 1,
            JointKind::Cylindrical | JointKind::Universal => 2,
            JointKind::Spherical | JointKind::Planar => 3,
            JointKind::Contact => 5,
            JointKind::Free => 6,
        }
    }

    /// How many coordinates, the first ones, mean something by themselves. Where a contact is on its surface is read off as a
    /// point instead: what its parameters are depends on the surface.
    pub fn named_coordinates(self) -> usize {
        if self == JointKind::Contact { 3 } else { self.freedoms() }
    }

    /// What each coordinate is, in order.
    pub fn coordinate_kinds(self) -> &'static [CoordinateKind] {
        use CoordinateKind::{Angle, Length};
        match self {
            JointKind::Weld => &[],
            JointKind::Revolute => &[Angle],
            JointKind::Prismatic => &[Length],
            JointKind::Cylindrical => &[Angle, Length],
            JointKind::Universal => &[Angle, Angle],
            JointKind::Spherical => &[Angle, Angle, Angle],
            JointKind::Planar => &[Length, Length, Angle],
            JointKind::Free => &[Length, Length, Length, Angle, Angle, Angle],
            JointKind::Contact => &[Angle, Angle, Angle, Angle, Angle],
            JointKind::Rolling(RollingCoordinate::Arc) => &[Length],
            JointKind::Rolling(_) | JointKind::SurfaceRolling => &[Angle],
        }
    }

    /// What each coordinate is called, in order.
    pub fn coordinate_names(self) -> &'static [&'static str] {
        match self {
            JointKind::Weld => &[],
            JointKind::Revolute => &["angle"],
            JointKind::Prismatic => &["position"],
            JointKind::Cylindrical => &["angle", "position"],
            JointKind::Universal => &["first", "second"],
            JointKind::Spherical => &["x", "y", "z"],
            JointKind::Planar => &["x", "y", "angle"],
            JointKind::Free => &["x", "y", "z", "rx", "ry", "rz"],
            JointKind::Contact => &["rx", "ry", "rz", "u", "v"],
            JointKind::SurfaceRolling => &["angle"],
            JointKind::Rolling(RollingCoordinate::Turning) => &["turning"],
            JointKind::Rolling(RollingCoordinate::Angle) => &["angle"],
            JointKind::Rolling(RollingCoordinate::Arc) => &["arc"],
        }
    }
}

/// What acts on one joint coordinate: τ = effort - stiffness (q - rest) - damping q̇.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct CoordinateLaw {
    /// Free (with a given effort) or driven.
    pub drive: Drive,
    /// N/m or N·m/rad.
    pub stiffness: f64,
    /// Where the stiffness is relaxed, m or rad.
    pub rest: f64,
    /// Force or moment against the rate of the coordinate, N·s/m or N·m·s/rad.
    pub damping: f64,
    /// Range that is reported when left, and pushes when it has a stiffness.
    pub limits: Option<Limits>,
}

/// Is the coordinate found or given?
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// Found from equilibrium under this effort (N or N·m).
    Free {
        /// Force or moment on the child along the coordinate.
        effort: f64,
    },
    /// Held at this value (m or rad); its effort is found.
    Driven {
        /// The coordinate.
        coordinate: f64,
    },
}

impl Default for Drive {
    fn default() -> Self {
        Drive::Free { effort: 0.0 }
    }
}

/// A linear relation between joint coordinates, as gears, racks and screws make: Σ factor q = offset. It is kept
/// by efforts factor × λ on the coordinates, which do no work.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// Its name, unique among couplings.
    pub name: String,
    /// The coordinates and their factors; at least two, all different, none driven.
    pub terms: Vec<CouplingTerm>,
    /// What the sum is held at, in the unit of factor times coordinate.
    pub offset: f64,
}

/// One coordinate of a coupling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingTerm {
    /// The joint.
    pub joint: crate::JointId,
    /// Number of the coordinate in the joint.
    pub coordinate: usize,
    /// What it is multiplied with.
    pub factor: f64,
}

/// The range of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Lower and upper bound, m or rad.
    pub range: [f64; 2],
    /// None: only reported. Some: pushes back with this stiffness beyond the range.
    pub stiffness: Option<f64>,
}
