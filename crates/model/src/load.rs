//! Point loads, lumped masses and points of attachment.

use crate::{At, BeamId, Mount};
use flexura_spatial::{Matrix3, Vector3};

/// A place on a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamPoint {
    /// Which beam.
    pub beam: BeamId,
    /// Where along it.
    pub at: At,
}

/// Where a load acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadTarget {
    /// At a point of a body, in the body's frame, m.
    Body {
        /// The body.
        body: crate::BodyId,
        /// The point in the body's frame.
        point: Vector3<f64>,
    },
    /// On a beam.
    Beam(BeamPoint),
}

/// Does a load turn with what it acts on?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadFrame {
    /// Dead: constant in global axes.
    Global,
    /// Follower: constant in the axes of the body or of the beam's section.
    Local,
}

/// A point force and moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Its name, unique among loads.
    pub name: String,
    /// Where it acts.
    pub target: LoadTarget,
    /// N.
    pub force: Vector3<f64>,
    /// N·m.
    pub moment: Vector3<f64>,
    /// Dead or follower.
    pub frame: LoadFrame,
}

/// A lumped mass on a beam; weighs when there is gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMass {
    /// Its name, unique among masses.
    pub name: String,
    /// Where it sits.
    pub point: BeamPoint,
    /// kg.
    pub mass: f64,
    /// Moments of inertia about its centre in the axes of the section, kg·m².
    pub inertia: Matrix3<f64>,
}

/// A point that a spring holds on to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// What carries the point.
    pub mount: Mount,
    /// The point in the frame of what carries it, m; on a beam (0, y, z) lies in the section.
    pub point: Vector3<f64>,
}

impl Attachment {
    /// A point of a beam's axis.
    pub fn on_beam(point: BeamPoint) -> Self {
        Self { mount: Mount::Beam(point), point: Vector3::zeros() }
    }
}
