//! The document of a motion in time, field for field. SI units, quaternions as (w, x, y, z). Every list has one entry for each time.

use crate::{Named, SceneDocument};
use serde::Serialize;

/// The result document of a motion in time.
#[derive(Clone, Debug, Serialize)]
pub struct InverseDynamicsDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged", or how else it ended.
    pub status: String,
    /// Why it was not gone through to its end, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// The parameter that drives the mechanism.
    pub parameter: String,
    /// The parameters, the one that drives at its own value.
    pub parameters: Named<f64>,
    /// Estimated largest error of the motion by the parameter and of its second derivative, relative to their sizes.
    pub error_estimate: f64,
    /// s. Where the acceleration jumps there are two of one time, just before and just after.
    pub times: Vec<f64>,
    /// The parameter over time.
    pub value: Vec<f64>,
    /// Its rate.
    pub rate: Vec<f64>,
    /// Its second derivative by time.
    pub acceleration: Vec<f64>,
    /// The outputs; null at times at which one has no value.
    pub outputs: Named<Series>,
    /// Why such an output has no value, the first time.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// The bodies' poses and motions.
    pub bodies: Named<BodySeries>,
    /// The joints' states and motions.
    pub joints: Named<JointSeries>,
    /// The springs' states.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub springs: Named<SpringSeries>,
    /// The cables' states.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub cables: Named<CableSeries>,
    /// Power of all driven joint coordinates, W.
    pub drive_power: Vec<f64>,
    /// Power of gravity, W.
    pub gravity_power: Vec<f64>,
    /// Kinetic energy, J.
    pub kinetic_energy: Vec<f64>,
    /// Strain energy of springs and joints, J.
    pub energy: Vec<f64>,
    /// Work counters.
    pub work: MotionWorkDocument,
    /// What a picture needs besides, at the first time; none where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneDocument>,
}

/// An output over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Series {
    /// One number at each time.
    Numbers(Vec<Option<f64>>),
    /// Three components at each time.
    Vectors(Vec<Option<[f64; 3]>>),
}

/// A body over time, global axes.
#[derive(Clone, Debug, Serialize)]
pub struct BodySeries {
    /// Of its origin, m.
    pub position: Vec<[f64; 3]>,
    /// (w, x, y, z), of the two signs always the one nearer to the one before.
    pub rotation: Vec<[f64; 4]>,
    /// Of its origin, m/s.
    pub velocity: Vec<[f64; 3]>,
    /// rad/s.
    pub angular_velocity: Vec<[f64; 3]>,
    /// Of its origin, m/s².
    pub acceleration: Vec<[f64; 3]>,
    /// rad/s².
    pub angular_acceleration: Vec<[f64; 3]>,
}

/// A joint over time; coordinates and what belongs to them as one list for each time.
#[derive(Clone, Debug, Serialize)]
pub struct JointSeries {
    /// What the coordinates are called, where there is more than one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// m and rad.
    pub coordinates: Vec<Vec<f64>>,
    /// m/s and rad/s.
    pub velocities: Vec<Vec<f64>>,
    /// m/s² and rad/s².
    pub accelerations: Vec<Vec<f64>>,
    /// Efforts on the coordinates, those of drives included, N and N·m.
    pub efforts: Vec<Vec<f64>>,
    /// Force of the parent on the child, global, N.
    pub force: Vec<[f64; 3]>,
    /// Moment of the parent on the child about M's origin, global, N·m.
    pub moment: Vec<[f64; 3]>,
    /// Of a rolling or contact joint: where the two touch, global, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contact_point: Vec<[f64; 3]>,
}

/// A spring over time.
#[derive(Clone, Debug, Serialize)]
pub struct SpringSeries {
    /// m.
    pub length: Vec<f64>,
    /// N.
    pub tension: Vec<f64>,
}

/// A cable over time.
#[derive(Clone, Debug, Serialize)]
pub struct CableSeries {
    /// m.
    pub length: Vec<f64>,
    /// N.
    pub tension: Vec<f64>,
}

/// Work counters, as in `flexura_solution::MotionWork`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MotionWorkDocument {
    /// Times that were looked at.
    pub instants: usize,
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
}
