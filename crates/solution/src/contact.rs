//! What is known of a contact.

use flexura_spatial::Vector3;

/// Where and how the two bodies of a rolling or contact joint touch. SI.
#[derive(Clone, Copy, Debug)]
pub struct ContactSolution {
    /// The contact, global, m.
    pub point: Vector3<f64>,
    /// Unit normal from the parent to the child, global.
    pub normal: Vector3<f64>,
    /// The contact in the axes of the child's frame M and of the parent's frame F, m.
    pub points: [Vector3<f64>; 2],
    /// The boundaries' own parameters there, of child and parent.
    pub parameters: [[f64; 2]; 2],
    /// Radii of curvature of child and parent in the direction of travel, m; negative where hollow, None where straight.
    pub radii: [Option<f64>; 2],
    /// Normal force, N: positive where the two press on each other, negative where something must pull to keep them
    /// together.
    pub force: f64,
    /// What the parent exerts on the child across the normal, global, N.
    pub friction: Vector3<f64>,
    /// How far the contact has rolled on the parent, and the child slid on it, since coordinate zero, m.
    pub travel: [f64; 2],
    /// Their derivatives by the joint's coordinate, m per unit.
    pub rates: [f64; 2],
}
