//! Elastic foundations along beams.

use crate::{At, LoadAxes, Profile};
use flexura_expression::Function;
use flexura_spatial::Vector3;

/// What pushes a beam back, everywhere along a stretch of it, to where it lies in the undeformed mechanism. It is fixed to the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// Its law.
    pub law: FoundationLaw,
    /// Unit vector along which it acts, u = d·(p - p_rest); None: in all directions alike.
    pub direction: Option<Vector3<f64>>,
    /// The axes of the direction: global, or those of the undeformed section.
    pub axes: LoadAxes,
    /// Where it begins and ends along the beam.
    pub between: [At; 2],
}

/// Restoring force per undeformed length against displacement.
#[derive(Clone, Debug, PartialEq)]
pub enum FoundationLaw {
    /// k u, k in N/m².
    Linear(Profile),
    /// f(u) in N/m of u in m, with f(0) = 0.
    Force(Function),
}
