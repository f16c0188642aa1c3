//! The result document of a sweep.

use super::is_interrupted;
use super::table::Table;
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{
    LoadDocument, Named, OutputError, SceneDocument, StateDocument, Value, loads, scene, scene_beside,
    shape_of,
};
use flexura::post::{OutputResult, OutputValue};
use flexura::{Axis, Sample};
use serde::Serialize;

#[derive(Serialize)]
pub struct SweepDocument<'a> {
    flexura: &'static str,
    model: &'a str,
    study: &'static str,
    status: &'static str,
    /// Of the mechanism; those of samples stand there.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    warnings: &'a [String],
    vary: Named<&'a [f64]>,
    samples: Vec<SampleDocument<'a>>,
    /// What a picture needs besides; where shapes are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<SceneDocument>,
}

#[derive(Serialize)]
struct SampleDocument<'a> {
    parameters: Named<f64>,
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unknowns: Option<Named<f64>>,
    outputs: Named<Option<Value>>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    output_reasons: Named<&'a str>,
    stable: Option<bool>,
    unstable_directions: Option<usize>,
    energy: Option<f64>,
    error_estimate: Option<f64>,
    /// The state with few samples, rounded, for pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<StateDocument>,
    /// Where more than loads is varied: what a picture of this sample needs besides.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<SceneDocument>,
    /// Loads that are not as in the scene.
    #[serde(skip_serializing_if = "Named::is_empty")]
    loads: Named<LoadDocument>,
}

impl<'a> SweepDocument<'a> {
    pub fn new(file: &Document, table: &'a Table<'a>, samples: &'a [Sample]) -> Result<Self, OutputError> {
        let first = samples.iter().find_map(|sample| sample.shape.as_deref());
        let scene = first.map(|(model, solution)| scene(model, solution)).transpose()?;
        let beside = first.map(|(model, _)| model).zip(scene.as_ref());
        let name = |axis: &Axis| axis.parameter.clone();
        Ok(Self {
            flexura: env!("CARGO_PKG_VERSION"),
            model: &table.model.name,
            study: "sweep",
            status: match () {
                () if samples.iter().any(is_interrupted) => "interrupted",
                () if samples.iter().all(|sample| sample.status.is_converged()) => "converged",
                () => "incomplete",
            },
            warnings: &table.known,
            vary: Named(table.axes.iter().map(|axis| (name(axis), axis.values.as_slice())).collect()),
            samples: samples
                .iter()
                .map(|sample| SampleDocument::new(table, sample, beside))
                .collect::<Result<_, _>>()?,
            scene: scene.map(|scene| SceneDocument { text: Some(file.whole_text().into_owned()), ..scene }),
        })
    }
}

impl<'a> SampleDocument<'a> {
    fn new(
        table: &Table<'a>,
        sample: &'a Sample,
        first: Option<(&Model, &SceneDocument)>,
    ) -> Result<Self, OutputError> {
        let shape = sample.shape.as_deref();
        let (scene, loads) = match (first, shape) {
            (Some((first, scene)), Some((model, solution))) => match scene_beside(scene, model, solution)? {
                Some(scene) => (Some(scene), Named::default()),
                None => (None, loads(first, model)?),
            },
            _ => (None, Named::default()),
        };
        let model = table.model;
        let output_name = |position: usize| model.outputs[position].name.clone();
        let value = |output: &OutputResult| match output.value {
            OutputValue::Number(value) => Value::Number(value),
            OutputValue::Vector(values) => Value::Vector(values),
        };
        let outputs = sample.outputs.iter().enumerate();
        let names = table.axes.iter().map(|axis| axis.parameter.clone());
        Ok(Self {
            parameters: Named(names.zip(sample.values.iter().copied()).collect()),
            status: sample.status.word(),
            reason: sample.reason.as_deref(),
            warnings: table.own_warnings(sample),
            unknowns: (!sample.found.is_empty()).then(|| {
                let names = model.unknowns.iter().map(|u| model.parameters[u.parameter].name.clone());
                Named(names.zip(sample.found.iter().copied()).collect())
            }),
            outputs: Named(outputs.map(|(i, output)| (output_name(i), output.as_ref().map(value))).collect()),
            output_reasons: Named(
                sample.output_reasons.iter().map(|(i, reason)| (output_name(*i), reason.as_str())).collect(),
            ),
            stable: sample.unstable_directions.map(|count| count == 0),
            unstable_directions: sample.unstable_directions,
            energy: sample.energy,
            error_estimate: sample.error_estimate,
            shape: shape.map(|(model, solution)| shape_of(model, solution)).transpose()?,
            scene,
            loads,
        })
    }
}
