//! The shape of the result document of an optimisation, field for field. SI units.

use crate::{Document, Named};
use serde::Serialize;

/// The result document of an optimisation: that of the best design's equilibrium, with what the search found.
#[derive(Clone, Debug, Serialize)]
pub struct OptimisationDocument {
    /// Its beginning: the state of the best design, as a solve has it.
    #[serde(flatten)]
    pub head: OptimisationHead,
    /// "sqp" or "cma_es".
    pub method: &'static str,
    /// "minimise" or "maximise".
    pub goal: &'static str,
    /// What was made least or greatest, as the file writes it.
    pub objective: String,
    /// The best design; where no design meets all constraints, the one that misses them least.
    pub optimum: Option<DesignDocument>,
    /// Each search, in the order of its start.
    pub starts: Vec<SearchDocument>,
    /// The compromises between two objectives.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub front: Vec<DesignDocument>,
    /// Designs that have no values, the first few.
    pub left_out: Vec<RefusedDesignDocument>,
    /// How many there were.
    pub left_out_count: usize,
    /// Steps and designs of all searches.
    pub search_work: DesignWorkDocument,
}

/// How the document begins.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum OptimisationHead {
    /// With the state of the best design.
    Solved(Box<Document>),
    /// Without one.
    Empty {
        /// Version of flexura that wrote it.
        flexura: String,
        /// The model's name.
        model: String,
        /// "optimise".
        study: &'static str,
        /// How it ended.
        status: String,
        /// Why it did not converge.
        #[serde(skip_serializing_if = "Option::is_none")]
        reason: Option<String>,
        /// Things to know.
        warnings: Vec<String>,
        /// The model's parameters.
        parameters: Named<f64>,
    },
}

/// A design.
#[derive(Clone, Debug, Serialize)]
pub struct DesignDocument {
    /// Values of the varied parameters.
    pub parameters: Named<f64>,
    /// The objective.
    pub objective: f64,
    /// The second objective.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other: Option<f64>,
    /// The bounds that hold it, by name.
    pub active: Vec<String>,
    /// By how much the objective changes with each of these bounds.
    pub multipliers: Vec<MultiplierDocument>,
    /// What the constraints bound.
    pub constraints: Vec<ConditionDocument>,
    /// Largest miss of a constraint relative to its size.
    pub violation: f64,
    /// What of the scaled gradient nothing holds.
    pub stationarity: f64,
    /// Is its equilibrium stable? Null where that is not decided or was not asked.
    pub stable: Option<bool>,
}

/// A bound and what it costs.
#[derive(Clone, Debug, Serialize)]
pub struct MultiplierDocument {
    /// Its name, as in the list of what is active.
    pub bound: String,
    /// d objective / d bound.
    pub rate: f64,
}

/// A constraint with the value of what it bounds.
#[derive(Clone, Debug, Serialize)]
pub struct ConditionDocument {
    /// What is bounded, as the file writes it.
    pub output: String,
    /// The study along whose path it is read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over: Option<String>,
    /// At which point of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Its value.
    pub value: f64,
    /// It must not be less.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    /// It must not be more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most: Option<f64>,
    /// It must be this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equals: Option<f64>,
}

/// One search.
#[derive(Clone, Debug, Serialize)]
pub struct SearchDocument {
    /// Where it began.
    pub from: Named<f64>,
    /// How it ended.
    pub status: String,
    /// Why it did not converge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Where it ended; null where not even the first design has values.
    pub end: Option<DesignDocument>,
    /// The designs on the way.
    pub history: Vec<StepDocument>,
}

/// A design on the way.
#[derive(Clone, Debug, Serialize)]
pub struct StepDocument {
    /// Values of the varied parameters.
    pub parameters: Named<f64>,
    /// The objective.
    pub objective: f64,
    /// Largest miss of a constraint relative to its size.
    pub violation: f64,
}

/// A design without values.
#[derive(Clone, Debug, Serialize)]
pub struct RefusedDesignDocument {
    /// Values of the varied parameters.
    pub parameters: Named<f64>,
    /// Why.
    pub reason: String,
}

/// Work counters.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DesignWorkDocument {
    /// Steps of all searches.
    pub iterations: usize,
    /// Designs that were solved.
    pub evaluations: usize,
    /// Designs whose derivatives were taken.
    pub gradients: usize,
    /// Paths that were followed.
    pub paths: usize,
}
