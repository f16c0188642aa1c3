//! Files and documents of a result: JSON, CSV, VTK and SVG.
//!
//! Each writer returns text; nothing here touches a disk or a terminal. The wire types are this crate's
//! own, so that the result document stays as it is when the solver's types change.
//!
//! JSON knows no NaN and no infinity, and `null` in their place would be a lie: a document that would need
//! one is refused with [`OutputError`], which names the field.

mod contact;
mod csv;
mod derivatives;
mod design;
mod document;
mod fitting;
mod json;
mod kept;
mod modes;
mod motion;
mod read;
mod scene;
mod space;
mod svg;
mod thin;
mod trace;
mod vtk;
mod wire;

pub use contact::{ContactDocument, SideDocument};
pub use csv::{beams_csv, csv_line};
pub use design::{
    ConditionDocument, DesignDocument, DesignView, DesignWorkDocument, MultiplierDocument,
    OptimisationDocument, OptimisationHead, RefusedDesignDocument, SearchDocument, StepDocument, bound_name,
    front_csv, history_csv, optimisation_document,
};
pub use document::{document, equilibrium_document};
pub use fitting::{
    EstimateDocument, FitDocument, FitView, FitWorkDocument, FormulaDocument, FormulaPieceDocument,
    FormulaVariableDocument, FormulaView, LeftOutDocument, MeasuredDocument, SpecimenDocument,
    SpreadDocument, UnseenDocument, fit_csv, fit_document, formula_c, formula_csv, formula_document,
    formula_rust, formula_toml, points_csv,
};
pub use json::{Named, to_json};
pub use kept::{Make, kept_pictures};
pub use modes::{
    FrequenciesDocument, FrequencyBranch, FrequencyDocument, FrequencyPoint, ModesDocument, OnsetDocument,
    VibrationDocument, frequencies_csv, frequencies_document, modes_document, vibration_csv,
};
pub use motion::{
    BodySeries, CableSeries, InverseDynamicsDocument, JointSeries, MotionView, MotionWorkDocument, Series,
    SpringSeries, motion_csv, motion_document,
};
pub use read::{ReadError, read_document, solution_of};
pub use scene::{
    BeamScene, BodyScene, BoundariesScene, BoundaryScene, CableScene, DistributedScene, FoundationScene,
    HoldScene, JointScene, LoadDocument, LoadScene, MassScene, PlaceDocument, SceneDocument, SpringScene,
    TubeScene, TubesScene, UnitsDocument, WrapScene, loads, scene, scene_beside,
};
pub use space::{SignalDocument, StateSpaceDocument, state_space_csv, state_space_document, state_space_mat};
pub use svg::{
    SampleColumn, SweepView, diagram_svg, fit_svg, formula_svg, frequencies_svg, modes_svg, motion_svg,
    response_svg, shape_svg, shapes_svg, stacked, sweep_svg, vibration_svg,
};
pub use thin::shape_of;
pub use trace::{
    BranchDocument, BucklingDocument, CriticalDocument, ModeDocument, MotionDocument, MotionsDocument,
    PointDocument, ShapeDocument, TraceDocument, TraceView, TraceWorkDocument, buckling_document,
    critical_csv, modes_csv, path_csv, path_header, path_row, trace_document,
};
pub use vtk::model_vtp;
pub use wire::{
    BeamDocument, BodyDocument, CableDocument, CouplingDocument, Document, Elasticity, EquilibriumDocument,
    JointDocument, SpringDocument, StateDocument, TubesDocument, Value, WorkDocument,
};

/// Why something cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A number that is none.
    #[error("the result's `{field}` is {value}, which a result document cannot hold")]
    NotFinite {
        /// Key path in the document (`beams.link.moment[17]`).
        field: String,
        /// The value.
        value: f64,
    },
    /// JSON could not be written.
    #[error("the result document cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}
