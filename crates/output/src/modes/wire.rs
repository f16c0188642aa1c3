//! What a document of vibration holds.

use crate::Named;
use crate::scene::SceneDocument;
use crate::trace::ShapeDocument;
use crate::wire::{StateDocument, Value, WorkDocument};
use serde::Serialize;

/// Natural frequencies and shapes about one state.
#[derive(Clone, Debug, Serialize)]
pub struct ModesDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// Of the equilibrium: "converged", or how else it ended.
    pub status: String,
    /// Why it did not converge, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// Is the state that of rest, without any load?
    pub at_rest: bool,
    /// The modes, lowest first.
    pub modes: Vec<VibrationDocument>,
    /// Mass that takes part in shifts along x, y and z, kg.
    pub moving_mass: [f64; 3],
    /// Moment of inertia that takes part in turnings about x, y and z through the centre of that mass, kg·m².
    pub moving_inertia: [f64; 3],
    /// Elements that beams were cut into.
    pub elements: usize,
    /// Order of these elements.
    pub order: usize,
    /// Largest scaled residual of the equilibrium; null where a solve broke off in a state that has none.
    pub residual: Option<f64>,
    /// Estimated largest relative error of the equilibrium.
    pub error_estimate: Option<f64>,
    /// The parameters.
    pub parameters: Named<f64>,
    /// The outputs at the equilibrium; null where one has no value.
    pub outputs: Named<Option<Value>>,
    /// Why those outputs have none.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// The equilibrium.
    #[serde(flatten)]
    pub state: StateDocument,
    /// Is the equilibrium stable? Null where that is not decided.
    pub stable: Option<bool>,
    /// Number of unstable directions; null where that is not decided.
    pub unstable_directions: Option<usize>,
    /// Why it is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability_reason: Option<String>,
    /// Work counters of the equilibrium.
    pub work: WorkDocument,
    /// What a picture needs besides.
    pub scene: SceneDocument,
}

/// One mode: it moves like exp((growth ± i rate) t).
#[derive(Clone, Debug, Serialize)]
pub struct VibrationDocument {
    /// "swinging", "rigid" (a motion without stiffness), "diverging", "flutter", "decaying" or "creeping" (it comes back without
    /// swinging).
    pub kind: String,
    /// Hz; null of one that does not swing.
    pub frequency_hz: Option<f64>,
    /// Circular frequency, rad/s.
    pub rate: f64,
    /// 1/s; positive where it grows.
    pub growth: f64,
    /// ω², rad²/s²: the square of the rate less that of the growth.
    pub omega_squared: f64,
    /// Estimated relative error of rate and growth.
    pub error_estimate: f64,
    /// ζ, where something damps: the part by which it dies away of the modulus of growth and rate; negative where it grows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ratio: Option<f64>,
    /// Mass that moves with the largest displacement of the shape, kg; kg·m² where it only turns.
    pub generalised_mass: f64,
    /// By what shifts of the ground along x, y, z and turnings about these through the centre of mass drive it; null where there is
    /// no energy.
    pub participation: Option<[f64; 6]>,
    /// Effective masses in these motions: kg three times, then kg·m².
    pub effective_mass: Option<[f64; 6]>,
    /// Arc lengths (m) at which beams that move pass through their rest position.
    pub nodes: Named<Vec<f64>>,
    /// The shape; its largest displacement is one metre, or its largest turning one radian where nothing is displaced.
    pub shape: ShapeDocument,
    /// A quarter of a period later, where parts do not swing together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quadrature: Option<ShapeDocument>,
}
