//! Rigid bodies and places on them.

use crate::{BeamPoint, BodyId};
use flexura_spatial::{Matrix3, Pose, Vector3};

/// What can carry a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount {
    /// The fixed world, its frame the global frame.
    Ground,
    /// A rigid body.
    Body(BodyId),
    /// The section of a beam at a place along it; its frame sits on the axis, with the axes e1, e2, e3.
    Beam(BeamPoint),
}

/// A frame fixed on a body, on the ground or on the section of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// What carries it.
    pub mount: Mount,
    /// Its pose in the frame of what carries it.
    pub pose: Pose,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name, unique among bodies; never "ground".
    pub name: String,
    /// Where it is initially, before anything is loaded.
    pub pose: Pose,
    /// kg; zero is massless.
    pub mass: f64,
    /// In the body's axes, m.
    pub center_of_mass: Vector3<f64>,
    /// About the centre of mass in the body's axes, kg·m². Used by motion only.
    pub inertia: Matrix3<f64>,
}
