//! What the user wants to read off a result.

use crate::{At, BeamId, BodyId, CableId, JointId, SpringId, TubesId};
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
    /// Which component of a vector, 0 for a number; of a 6 x 6 matrix it is 6 row + column, with the order
    /// (x, y, z, rx, ry, rz) of motions and (fx, fy, fz, mx, my, mz) of loads.
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
    /// A cable.
    Cable(CableId),
    /// The tip of concentric tubes: position, rotation, tangent.
    Tubes(TubesId),
    /// The whole mechanism.
    Model,
}

impl Quantity {
    /// Is it of a beam as a whole, wherever the probe is?
    pub fn is_of_whole_beam(self) -> bool {
        matches!(self, Quantity::FoundationForce | Quantity::Mass) || self.is_peak()
    }

    /// Is it the largest or least of what stands along a beam?
    pub fn is_peak(self) -> bool {
        matches!(self, Quantity::MaxStress | Quantity::MaxStrain | Quantity::MinSafety)
    }
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
    /// Force of its foundation per undeformed length (beam), global.
    Foundation,
    /// Force of its foundation on the whole beam, wherever the probe is (beam), global.
    FoundationForce,
    /// Largest von Mises stress along the whole beam, found between samples too (beam), Pa.
    MaxStress,
    /// Surface strain of largest size along the whole beam, as a size (beam).
    MaxStrain,
    /// Yield strength over the largest von Mises stress (beam).
    MinSafety,
    /// Mass of the whole beam (beam), or of all beams, bodies and point masses (model), kg.
    Mass,
    /// Coordinate of the joint; component is its number.
    Coordinate,
    /// Effort on a joint coordinate; component is its number.
    Effort,
    /// The contact, global (joint), m.
    ContactPoint,
    /// Unit normal from the parent to the child, global (joint).
    ContactNormal,
    /// Normal force in the contact, positive where the two press on each other (joint).
    ContactForce,
    /// What the parent exerts on the child across the normal, global (joint).
    ContactFriction,
    /// The contact in the axes of the joint's frame on the child (joint), m.
    ContactOnChild,
    /// The contact in the axes of the joint's frame on the parent (joint), m.
    ContactOnParent,
    /// Parameters of the boundaries where they touch (joint): child's first and second, parent's first and second.
    ContactParameter,
    /// Radius of curvature in the direction of travel (joint), m: the child's, the parent's.
    ContactRadius,
    /// How far the contact has rolled on the parent, how far the child has slid (joint), m.
    ContactTravel,
    /// Their derivatives by the joint's coordinate.
    ContactRate,
    /// Length of a spring or cable.
    Length,
    /// Tension of a spring or cable.
    Tension,
    /// Global position less that in the undeformed mechanism (beam, body).
    Displacement,
    /// Rotation vector of the turning since the undeformed mechanism (beam, body), rad.
    Turning,
    /// Of the finite screw from the undeformed pose to the present one (body): unit vector along its axis.
    ScrewAxis,
    /// The point of the finite screw's axis nearest to the body's present origin, m.
    ScrewPoint,
    /// Travel along the finite screw's axis per turning, m/rad.
    ScrewPitch,
    /// Turning about the finite screw's axis, rad.
    ScrewAngle,
    /// Of the instantaneous screw as all loads and drives grow in proportion (body): unit vector along its axis.
    MotionAxis,
    /// The point of the instantaneous screw's axis nearest to the body's present origin: in a planar motion
    /// the instantaneous centre of rotation, m.
    MotionPoint,
    /// Travel along the instantaneous screw's axis per turning, m/rad.
    MotionPitch,
    /// Tangent compliance (beam, body): small motion of the origin (m, rad) per small dead load there (N, N·m),
    /// global axes.
    Compliance,
    /// Inverse of the compliance: load per motion with the other five motions blocked.
    Stiffness,
    /// The point at which the coupling block of the compliance is symmetric; in the plane, where a force
    /// turns nothing and a moment shifts nothing (beam, body), m.
    CenterOfCompliance,
    /// Velocity of the origin (body), or of a coordinate, whose number is the component (joint); of a motion in time only.
    Velocity,
    /// Angular velocity (body).
    AngularVelocity,
    /// Acceleration of the origin (body), or of a coordinate (joint).
    Acceleration,
    /// Angular acceleration (body).
    AngularAcceleration,
    /// Strain energy of the mechanism.
    Energy,
    /// Value of a parameter (model), whose position is the component: in events it may change along the path.
    Parameter,
}
