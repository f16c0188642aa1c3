//! Joints: which motion they leave free, and what drives, loads or springs it.

use crate::{BodyRef, Frame};
use flexura_spatial::{Pose, Vector3};

/// A joint between a parent (carries the fixed frame F) and a child (carries the moving frame M).
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name, unique among joints.
    pub name: String,
    /// F on its body.
    pub parent: Frame,
    /// What carries M.
    pub child: BodyRef,
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
    /// Unit axis in F's axes; unused by weld and spherical.
    pub axis: Vector3<f64>,
    /// One per coordinate, in the kind's order.
    pub coordinates: Vec<CoordinateLaw>,
}

impl JointLaw {
    /// A law of the given kind whose coordinates are all free and unloaded.
    pub fn free(kind: JointKind, axis: Vector3<f64>) -> Self {
        Self { kind, axis, coordinates: vec![CoordinateLaw::default(); kind.freedoms()] }
    }

    /// No motion at all: a clamp.
    pub fn weld() -> Self {
        Self::free(JointKind::Weld, Vector3::x())
    }
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
    /// Turning about a point; coordinates are the rotation vector from F to M.
    Spherical,
}

impl JointKind {
    /// Number of coordinates.
    pub fn freedoms(self) -> usize {
        match self {
            JointKind::Weld => 0,
            JointKind::Revolute | JointKind::Prismatic => 1,
            JointKind::Spherical => 3,
        }
    }
}

/// What acts on one joint coordinate: τ = effort - stiffness (q - rest).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct CoordinateLaw {
    /// Free (with a given effort) or driven.
    pub drive: Drive,
    /// N/m or N·m/rad.
    pub stiffness: f64,
    /// Where the stiffness is relaxed, m or rad.
    pub rest: f64,
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

/// The range of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Lower and upper bound, m or rad.
    pub range: [f64; 2],
    /// None: only reported. Some: pushes back with this stiffness beyond the range.
    pub stiffness: Option<f64>,
}
