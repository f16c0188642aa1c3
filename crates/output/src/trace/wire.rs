//! The shape of the result documents of a trace and of buckling, field for field. SI units.

use crate::wire::{StateDocument, Value, WorkDocument};
use crate::{LoadDocument, Named, SceneDocument};
use serde::Serialize;

/// The result document of a trace.
#[derive(Clone, Debug, Serialize)]
pub struct TraceDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged" where every branch ended as was asked for, or how else it ended.
    pub status: String,
    /// Why it did not converge, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// The parameter that changes.
    pub parameter: String,
    /// Values between which it was followed.
    pub range: [f64; 2],
    /// The model's parameters; that which changes has its own value here.
    pub parameters: Named<f64>,
    /// Why stability is nowhere decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability_reason: Option<String>,
    /// The branches, the one that starts at rest first.
    pub branches: Vec<BranchDocument>,
    /// The fold or branch point that was followed in a second parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical: Option<CriticalDocument>,
    /// Work counters.
    pub work: TraceWorkDocument,
    /// What a picture needs besides, at the first state that is kept; none where none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneDocument>,
}

/// A smooth curve of equilibria.
#[derive(Clone, Debug, Serialize)]
pub struct BranchDocument {
    /// "rest", "branch_point", "search" or "imperfection".
    pub origin: &'static str,
    /// Position of the branch from whose branch point this one comes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_branch: Option<usize>,
    /// Position of that point in its branch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_point: Option<usize>,
    /// Why it ends where it does, at its first and at its last point: "start", "range", "stop", "closed", "point_limit",
    /// "stalled" or "interrupted".
    pub ends: [&'static str; 2],
    /// Of an end that is "stalled": why it cannot be followed further.
    #[serde(skip_serializing_if = "is_nothing")]
    pub end_reasons: [Option<String>; 2],
    /// Its points in order.
    pub points: Vec<PointDocument>,
}

fn is_nothing(reasons: &[Option<String>; 2]) -> bool {
    reasons.iter().all(Option::is_none)
}

/// One equilibrium of a path.
#[derive(Clone, Debug, Serialize)]
pub struct PointDocument {
    /// Of a critical point: the value of the second parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_parameter: Option<f64>,
    /// Value of the parameter.
    pub parameter: f64,
    /// Way along the branch in the measure of the path's steps.
    pub arc: f64,
    /// "regular", "fold", "branch", "event" or "end".
    pub kind: &'static str,
    /// Of a branch point: "supercritical_pitchfork", "subcritical_pitchfork", "pitchfork", "transcritical" or
    /// "multiple".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossing: Option<&'static str>,
    /// Of an event: what was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub event: Option<String>,
    /// The outputs; null where one has no value.
    pub outputs: Named<Option<Value>>,
    /// Why those outputs have none.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// Null where it is not decided, as at a fold or branch point itself.
    pub stable: Option<bool>,
    /// Null where it is not decided.
    pub unstable_directions: Option<usize>,
    /// Estimated largest relative error; null where a trace broke off before it could be estimated.
    pub error_estimate: Option<f64>,
    /// The whole state, where it is kept.
    #[serde(flatten)]
    pub state: Option<StateDocument>,
    /// Where the whole state is not kept: the state with fewer samples, rounded, for pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<StateDocument>,
    /// Where the parameter changes more than loads: what a picture of this state needs besides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneDocument>,
    /// Loads that are not as in the scene, of a point with a state or a shape.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub loads: Named<LoadDocument>,
    /// At folds and branch points: in which directions the mechanism gives way without resistance.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<ShapeDocument>,
}

/// A small motion of a mechanism, so large that its largest displacement is one metre, or its largest turning one radian
/// where nothing is displaced. A beam's lists run parallel to those of its state.
#[derive(Clone, Debug, Serialize)]
pub struct ShapeDocument {
    /// Of each beam's samples.
    pub beams: Named<MotionsDocument>,
    /// Of each body.
    pub bodies: Named<MotionDocument>,
}

/// Small motions of a beam's samples.
#[derive(Clone, Debug, Serialize)]
pub struct MotionsDocument {
    /// Global, m.
    pub displacement: Vec<[f64; 3]>,
    /// Rotation vectors, global, rad.
    pub turning: Vec<[f64; 3]>,
}

/// A small motion of a body.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MotionDocument {
    /// Global, m.
    pub displacement: [f64; 3],
    /// Rotation vector, global, rad.
    pub turning: [f64; 3],
}

/// A fold or branch point as a second parameter changes.
#[derive(Clone, Debug, Serialize)]
pub struct CriticalDocument {
    /// The second parameter.
    pub parameter: String,
    /// "fold" or "branch".
    pub kind: &'static str,
    /// Of a branch point, as at the point where it starts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossing: Option<&'static str>,
    /// Why it ends where it does, as of a branch.
    pub ends: [&'static str; 2],
    /// Of an end that is "stalled": why it cannot be followed further.
    #[serde(skip_serializing_if = "is_nothing")]
    pub end_reasons: [Option<String>; 2],
    /// Its points in order: `parameter` is the critical value of the traced parameter, `second_parameter` that of the second.
    pub points: Vec<PointDocument>,
}

/// Work counters, as in `flexura_solution::TraceWork`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TraceWorkDocument {
    /// Points on all branches.
    pub points: usize,
    /// Steps tried and given up.
    pub refused: usize,
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
    /// Inertias counted.
    pub inertias: usize,
}

/// The result document of buckling.
#[derive(Clone, Debug, Serialize)]
pub struct BucklingDocument {
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
    /// The parameter whose critical values these are; null where all loads and drives grow in proportion.
    pub parameter: Option<String>,
    /// Its value, or the fraction of the load, at the equilibrium about which the problem is linearised.
    pub at: f64,
    /// The critical values, nearest first.
    pub modes: Vec<ModeDocument>,
    /// Largest scaled residual of the equilibrium; null where a solve broke off in a state that has none.
    pub residual: Option<f64>,
    /// Estimated largest relative error of the equilibrium.
    pub error_estimate: Option<f64>,
    /// The parameters at the equilibrium.
    pub parameters: Named<f64>,
    /// The outputs at the equilibrium; null where one has no value.
    pub outputs: Named<Option<Value>>,
    /// Why those outputs have none.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub output_reasons: Named<String>,
    /// The equilibrium.
    #[serde(flatten)]
    pub state: StateDocument,
    /// Null where it is not decided.
    pub stable: Option<bool>,
    /// Null where it is not decided.
    pub unstable_directions: Option<usize>,
    /// Why stability is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability_reason: Option<String>,
    /// Work counters of the equilibrium.
    pub work: WorkDocument,
    /// What a picture needs besides.
    pub scene: SceneDocument,
}

/// A critical load and how the mechanism gives way under it.
#[derive(Clone, Debug, Serialize)]
pub struct ModeDocument {
    /// Value of the parameter, or fraction of the load.
    pub value: f64,
    /// Estimated error of the value.
    pub error_estimate: f64,
    /// How the mechanism gives way.
    pub shape: ShapeDocument,
}
