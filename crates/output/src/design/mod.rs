//! Design optimisation as documents and tables.

mod document;
mod table;
mod wire;

pub use document::{bound_name, optimisation_document};
pub use table::{front_csv, history_csv};
pub use wire::{
    ConditionDocument, DesignDocument, DesignWorkDocument, MultiplierDocument, OptimisationDocument,
    OptimisationHead, RefusedDesignDocument, SearchDocument, StepDocument,
};

use flexura_model::{Model, OptimiseStudy};
use flexura_post::Evaluation;
use flexura_solution::Optimisation;

/// An optimisation with what belongs to it.
#[derive(Clone, Copy, Debug)]
pub struct DesignView<'a> {
    /// The model with the values of the best design.
    pub model: &'a Model,
    /// What was asked.
    pub study: &'a OptimiseStudy,
    /// What came out.
    pub result: &'a Optimisation,
    /// Stresses and outputs of the best design's equilibrium; None where there is none.
    pub evaluation: Option<&'a Evaluation>,
}
