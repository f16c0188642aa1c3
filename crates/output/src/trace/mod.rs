//! What is written of a trace and of buckling: documents and tables.

mod document;
mod table;
mod wire;

pub use document::{buckling_document, trace_document};
pub(crate) use document::{inside, shape_document};
pub(crate) use table::{cell, headed, line, output_headings, reasons};
pub use table::{critical_csv, modes_csv, path_csv, path_header, path_row};
pub use wire::{
    BranchDocument, BucklingDocument, CriticalDocument, ModeDocument, MotionDocument, MotionsDocument,
    PointDocument, ShapeDocument, TraceDocument, TraceWorkDocument,
};

use flexura_model::{Model, TraceStudy};
use flexura_solution::{Trace, TracePoint};

/// A trace with what belongs to it: the study, and the model as it is at every point with a state or a shape. The parameter
/// may be a thickness or the place of a support, so that one model does not do for all.
#[derive(Clone, Debug)]
pub struct TraceView<'a> {
    /// The model that the study was asked of.
    pub model: &'a Model,
    /// What was asked.
    pub study: &'a TraceStudy,
    /// What came out.
    pub trace: &'a Trace,
    /// Parallel to the branches and their points.
    kept: Vec<Vec<Option<Model>>>,
    /// Parallel to the points of the critical curve.
    critical: Vec<Option<Model>>,
}

impl<'a> TraceView<'a> {
    /// Makes the models of the kept states.
    pub fn new(model: &'a Model, study: &'a TraceStudy, trace: &'a Trace) -> Self {
        // A state of a trace belongs to a model that is sound; were it none, the model at hand stands in.
        let again = |point: &TracePoint, second: Option<(usize, f64)>| {
            point.solution.as_ref().or(point.shape.as_ref())?;
            let values: Vec<(usize, f64)> =
                std::iter::once((trace.parameter, point.parameter)).chain(second).collect();
            model.at(&values).ok()
        };
        let kept = trace
            .branches
            .iter()
            .map(|branch| branch.points.iter().map(|point| again(point, None)).collect());
        let kept = kept.collect();
        let critical = trace
            .critical
            .iter()
            .flat_map(|curve| curve.points.iter().map(|(value, point)| (point, (curve.parameter, *value))));
        let critical = critical.map(|(point, second)| again(point, Some(second))).collect();
        Self { model, study, trace, kept, critical }
    }

    /// The model at a point of a branch.
    pub(crate) fn model_at(&self, branch: usize, point: usize) -> &Model {
        self.kept.get(branch).and_then(|points| points.get(point)?.as_ref()).unwrap_or(self.model)
    }

    /// The model at a point of the critical curve.
    pub(crate) fn critical_model(&self, point: usize) -> &Model {
        self.critical.get(point).and_then(Option::as_ref).unwrap_or(self.model)
    }

    /// Name and unit of the parameter.
    pub(crate) fn parameter(&self) -> (&'a str, &'a str) {
        parameter_of(self.model, Some(self.trace.parameter))
    }

    /// The text of an event, by its position.
    pub(crate) fn event(&self, position: usize) -> Option<&'a str> {
        event_of(self.study, position)
    }
}

fn event_of(study: &TraceStudy, position: usize) -> Option<&str> {
    study.events.get(position).map(|event| event.output.name.as_str())
}

/// Name and unit of a parameter; None is the fraction of the load.
pub(crate) fn parameter_of(model: &Model, position: Option<usize>) -> (&str, &str) {
    match position.and_then(|position| model.parameters.get(position)) {
        Some(parameter) => (&parameter.name, &parameter.unit),
        None => ("load_fraction", ""),
    }
}
