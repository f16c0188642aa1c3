//! What the user wants to read off a result.

use crate::{At, BeamId, BodyId, JointId, SpringId};
use flexura_expression::Formula;

/// A named output.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Its name, unique among outputs.
    pub name: String,
    /// SI unit as text, "" for a plain number.
    pub unit: String,
    /// One formula for a number, three for a vector.
    pub formulas: Vec<Formula>,
    /// What the slots of the formulas stand for.
    pub probes: Vec<Probe>,
}

/// One number of a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Of what.
    pub target: ProbeTarget,
    /// Which quantity.
    pub quantity: Quantity,
    /// Which component (0, 1, 2) of a vector; 0 for a number.
    pub component: usize,
}

/// What a probe looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProbeTarget {
    /// A place on a beam.
    Beam(BeamId, At),
    /// A body.
    Body(BodyId),
    /// A joint.
    Joint(JointId),
    /// A spring.
    Spring(SpringId),
    /// The whole mechanism.
    Model,
}

/// Quantities that can be read off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Global position (beam, body).
    Position,
    /// Rotation vector from the global axes (beam, body), rad.
    Rotation,
    /// Global unit tangent e1 (beam).
    Tangent,
    /// Internal force on the part before s (beam), or the joint's force on the child (joint), global.
    Force,
    /// Internal moment (beam), or the joint's moment on the child at M (joint), global.
    Moment,
    /// Curvatures k1, k2, k3 (beam).
    Curvature,
    /// ε, the relative stretch of the axis (beam).
    Stretch,
    /// Largest surface strain of the section (beam).
    Strain,
    /// Largest von Mises stress of the section (beam).
    Stress,
    /// Coordinate of the joint; component is its number.
    Coordinate,
    /// Effort on a joint coordinate; component is its number.
    Effort,
    /// Length of a spring.
    Length,
    /// Tension of a spring.
    Tension,
    /// Strain energy of the mechanism.
    Energy,
}
