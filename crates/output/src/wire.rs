//! The result document's shape, field for field. SI units, quaternions as (w, x, y, z).

use crate::Named;
use serde::Serialize;

/// The result document of a solve.
#[derive(Clone, Debug, Serialize)]
pub struct Document {
    /// Version of flexura that wrote it.
    pub flexura: &'static str,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: &'static str,
    /// "converged", or how else it ended.
    pub status: &'static str,
    /// Why it did not converge, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Fraction of the full load that was reached, when that is not all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_fraction: Option<f64>,
    /// Largest scaled residual of the equilibrium equations.
    pub residual: f64,
    /// Estimated largest relative error; null when a study broke off before it could be estimated.
    pub error_estimate: Option<f64>,
    /// Newton steps taken.
    pub newton_steps: usize,
    /// Things to know though the solve went well.
    pub warnings: Vec<String>,
    /// Work counters.
    pub work: WorkDocument,
    /// The parameters that the model was solved with.
    pub parameters: Named<f64>,
    /// The outputs.
    pub outputs: Named<Value>,
    /// The beams' states at their samples.
    pub beams: Named<BeamDocument>,
    /// The bodies' poses.
    pub bodies: Named<BodyDocument>,
    /// The joints' states.
    pub joints: Named<JointDocument>,
    /// The springs' states.
    pub springs: Named<SpringDocument>,
    /// Strain energy, J.
    pub energy: f64,
    /// Null where it is not decided.
    pub stable: Option<bool>,
    /// Null where it is not decided.
    pub unstable_directions: Option<usize>,
    /// Why stability is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability_reason: Option<String>,
}

/// A number or a vector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// One number.
    Number(f64),
    /// Three components.
    Vector([f64; 3]),
}

/// Work counters, as in `flexura_solution::Work`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct WorkDocument {
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
    /// Load steps taken.
    pub load_steps: usize,
    /// Load steps given up.
    pub rejected_steps: usize,
    /// Integration steps of the final mesh.
    pub integration_steps: usize,
    /// Shooting segments of the final mesh.
    pub segments: usize,
}

/// A beam's state; every list has one entry for each sample.
#[derive(Clone, Debug, Serialize)]
pub struct BeamDocument {
    /// Undeformed arc length, m.
    pub s: Vec<f64>,
    /// Global position of the axis, m.
    pub position: Vec<[f64; 3]>,
    /// Rotation of the section, (w, x, y, z).
    pub rotation: Vec<[f64; 4]>,
    /// Internal force of the part beyond s on the part before it, global, N.
    pub force: Vec<[f64; 3]>,
    /// Internal moment of the part beyond s on the part before it, global, N·m.
    pub moment: Vec<[f64; 3]>,
    /// k1, k2, k3, 1/m.
    pub curvature: Vec<[f64; 3]>,
    /// Relative stretch of the axis.
    pub stretch: Vec<f64>,
    /// Largest von Mises stress of the section, Pa; null for a section given as a stiffness.
    pub stress: Option<Vec<f64>>,
    /// Largest surface strain of the section; null for a section given as a stiffness.
    pub strain: Option<Vec<f64>>,
}

/// A body's pose.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BodyDocument {
    /// Global position, m.
    pub position: [f64; 3],
    /// (w, x, y, z).
    pub rotation: [f64; 4],
}

/// A joint's state.
#[derive(Clone, Debug, Serialize)]
pub struct JointDocument {
    /// Coordinates, m and rad.
    pub coordinates: Vec<f64>,
    /// Efforts, N and N·m.
    pub efforts: Vec<f64>,
    /// Force of the parent on the child, global, N.
    pub force: [f64; 3],
    /// Moment of the parent on the child about M's origin, global, N·m.
    pub moment: [f64; 3],
}

/// A spring's state.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SpringDocument {
    /// Length, m.
    pub length: f64,
    /// Tension, N.
    pub tension: f64,
}
