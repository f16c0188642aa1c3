//! Rigid bodies and places on them.

use crate::BodyId;
use flexura_spatial::{Matrix3, Pose, Vector3};

/// The ground or a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BodyRef {
    /// The fixed world, its frame the global frame.
    Ground,
    /// A rigid body.
    Body(BodyId),
}

/// A frame fixed on a body or on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// What carries it.
    pub body: BodyRef,
    /// Its pose in the body's frame.
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
