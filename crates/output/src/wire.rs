//! The result document's shape, field for field. SI units, quaternions as (w, x, y, z).

use crate::{ContactDocument, Named, SceneDocument};
use serde::{Deserialize, Serialize};

/// The result document of a solve.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Document {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged", or how else it ended.
    pub status: String,
    /// Why it did not converge, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Fraction of the full load that was reached, when that is not all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_fraction: Option<f64>,
    /// Largest scaled residual of the equilibrium equations; null where a solve broke off in a state that has none.
    pub residual: Option<f64>,
    /// Estimated largest relative error; null when a study broke off before it could be estimated.
    pub error_estimate: Option<f64>,
    /// Newton steps taken.
    pub newton_steps: usize,
    /// Things to know though the solve went well.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Work counters.
    #[serde(default)]
    pub work: WorkDocument,
    /// The parameters that the model was solved with.
    #[serde(default)]
    pub parameters: Named<f64>,
    /// Of an inverse problem the parameters that were found, which stand in `parameters` too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unknowns: Option<Named<f64>>,
    /// The outputs; null where one has no value.
    #[serde(default)]
    pub outputs: Named<Option<Value>>,
    /// Why those outputs have none.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// The beams' states at their samples.
    pub beams: Named<BeamDocument>,
    /// The bodies' poses.
    pub bodies: Named<BodyDocument>,
    /// The joints' states.
    pub joints: Named<JointDocument>,
    /// The springs' states.
    #[serde(default)]
    pub springs: Named<SpringDocument>,
    /// The couplings' states.
    #[serde(default)]
    pub couplings: Named<CouplingDocument>,
    /// The cables' states.
    #[serde(default)]
    pub cables: Named<CableDocument>,
    /// The states of concentric tubes at their samples.
    #[serde(default)]
    pub tubes: Named<TubesDocument>,
    /// Small motion of the origin (rows) per small dead load there (columns), global axes, SI; where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compliance: Option<Named<[[f64; 6]; 6]>>,
    /// What the rows of a compliance and the numbers of a motion are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compliance_rows: Option<[String; 6]>,
    /// What the columns of a compliance are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compliance_columns: Option<[String; 6]>,
    /// Motion of the same places per unit of the load fraction, all loads and drives growing in proportion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Named<[f64; 6]>>,
    /// Derivatives of the outputs by the parameters, where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensitivities: Option<Named<Named<Value>>>,
    /// d ln output / d ln parameter; without those outputs and parameters that are zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elasticities: Option<Named<Named<Elasticity>>>,
    /// Equilibria under the full load, by energy, where others than the one from rest were looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub equilibria: Option<Vec<EquilibriumDocument>>,
    /// Strain energy, J.
    pub energy: f64,
    /// Null where it is not decided.
    pub stable: Option<bool>,
    /// Null where it is not decided.
    pub unstable_directions: Option<usize>,
    /// Why stability is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability_reason: Option<String>,
    /// What a picture needs besides.
    #[serde(default)]
    pub scene: SceneDocument,
}

/// The whole state of a mechanism, as in the result document of a solve.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StateDocument {
    /// The beams' states at their samples.
    pub beams: Named<BeamDocument>,
    /// The bodies' poses.
    pub bodies: Named<BodyDocument>,
    /// The joints' states.
    pub joints: Named<JointDocument>,
    /// The springs' states.
    pub springs: Named<SpringDocument>,
    /// The couplings' states.
    pub couplings: Named<CouplingDocument>,
    /// The cables' states.
    pub cables: Named<CableDocument>,
    /// The states of concentric tubes at their samples.
    pub tubes: Named<TubesDocument>,
    /// Strain energy, J.
    pub energy: f64,
}

/// A number or a vector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// One number.
    Number(f64),
    /// Three components.
    Vector([f64; 3]),
}

/// The elasticity of an output: a number, or three of which those are null that have none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Elasticity {
    /// Of one number.
    Number(f64),
    /// Of three components.
    Vector([Option<f64>; 3]),
}

/// Work counters, as in `flexura_solution::Work`.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
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
#[derive(Clone, Debug, Serialize, Deserialize)]
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
    /// Force of its elastic foundation per undeformed length, global, N/m; only where it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foundation: Option<Vec<[f64; 3]>>,
    /// Force of its elastic foundation on all of it, global, N; only where it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foundation_force: Option<[f64; 3]>,
}

/// A body's pose.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct BodyDocument {
    /// Global position, m.
    pub position: [f64; 3],
    /// (w, x, y, z).
    pub rotation: [f64; 4],
}

/// A joint's state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct JointDocument {
    /// What the coordinates are called, where there is more than one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// Coordinates, m and rad.
    pub coordinates: Vec<f64>,
    /// Efforts, N and N·m.
    pub efforts: Vec<f64>,
    /// Force of the parent on the child, global, N.
    pub force: [f64; 3],
    /// Moment of the parent on the child about M's origin, global, N·m.
    pub moment: [f64; 3],
    /// Of a rolling or contact joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactDocument>,
}

/// A spring's state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SpringDocument {
    /// Length along its course, m.
    pub length: f64,
    /// Tension, N.
    pub tension: f64,
    /// Stretch per rest length; null where that is zero.
    #[serde(default)]
    pub strain: Option<f64>,
    /// Too long to carry anything?
    #[serde(default)]
    pub slack: bool,
    /// Tension per present area, Pa, of a law that knows its area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<f64>,
    /// Its course, global, m, where it touches what it runs over.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub course: Vec<[f64; 3]>,
}

/// A coupling's state.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct CouplingDocument {
    /// λ: its effort on a coordinate is factor × λ.
    pub multiplier: f64,
}

/// A cable's state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CableDocument {
    /// Length from anchor to anchor, m.
    pub length: f64,
    /// Tension, N.
    pub tension: f64,
    /// Its course, global, m.
    pub course: Vec<[f64; 3]>,
}

/// The state of concentric tubes along their common axis. Every list has one entry for each sample, but those of
/// `angles` and `torques` hold one list for each tube, which ends where that tube does.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TubesDocument {
    /// Arc length from where the tubes leave the guide, m.
    pub s: Vec<f64>,
    /// Global position of the axis, m.
    pub position: Vec<[f64; 3]>,
    /// Rotation of the first tube's section, (w, x, y, z).
    pub rotation: Vec<[f64; 4]>,
    /// Force of the part beyond s on the part before it, all tubes together, global, N.
    pub force: Vec<[f64; 3]>,
    /// Moment of the part beyond s on the part before it, all tubes together, global, N·m.
    pub moment: Vec<[f64; 3]>,
    /// k1, k2, k3 of the first tube, 1/m.
    pub curvature: Vec<[f64; 3]>,
    /// Turn of each tube relative to the first, rad.
    pub angles: Vec<Vec<f64>>,
    /// Torque about the axis that each tube carries, N·m.
    pub torques: Vec<Vec<f64>>,
}

/// One of several equilibria.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EquilibriumDocument {
    /// Strain energy, J.
    pub energy: f64,
    /// Largest scaled residual.
    pub residual: f64,
    /// Estimated largest relative error.
    pub error_estimate: Option<f64>,
    /// Null where it is not decided.
    pub stable: Option<bool>,
    /// The outputs; null where one has no value.
    pub outputs: Named<Option<Value>>,
    /// Why those outputs have none.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// The bodies' poses.
    pub bodies: Named<BodyDocument>,
    /// The joints' states.
    pub joints: Named<JointDocument>,
    /// The whole state, rounded, for pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<StateDocument>,
}
