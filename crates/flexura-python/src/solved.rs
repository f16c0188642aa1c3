//! An equilibrium, whose arrays and documents are made when they are asked for.

use crate::arrays::{numbers, rows, vectors};
use crate::errors::{Place, Wrong, bug};
use crate::guard::released;
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{beams_csv, document, equilibrium_document, model_vtp, shape_svg, to_json};
use flexura::post::{Evaluation, OutputResult, OutputValue, evaluate_each, large_strain};
use flexura::solution::{BeamSample, Solution, Status};
use flexura::{ModelFamily, Prepared};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// Of what something was asked.
#[derive(Clone)]
pub struct Request {
    pub file: Arc<Document>,
    pub place: Place,
    pub tolerance: f64,
}

/// A solution with its model.
#[pyclass(frozen, module = "flexura._native")]
pub struct Solved {
    request: Request,
    pub model: Model,
    pub solution: Solution,
    evaluation: Evaluation,
}

/// Derivatives: rows of all outputs' components, then of the unknown parameters; columns of the parameters; NaN where there is
/// none; and parameters that are left out, with the reason.
type Derivatives = (Vec<(String, Vec<Vec<f64>>)>, Vec<String>, Vec<(String, String)>);

#[pymethods]
impl Solved {
    #[getter]
    fn status(&self) -> &'static str {
        self.solution.status.word()
    }

    #[getter]
    fn reason(&self) -> Option<&str> {
        self.solution.reason.as_deref()
    }

    #[getter]
    fn load_fraction(&self) -> f64 {
        self.solution.load_fraction
    }

    #[getter]
    fn energy(&self) -> f64 {
        self.solution.energy
    }

    #[getter]
    fn error_estimate(&self) -> f64 {
        self.solution.error_estimate
    }

    #[getter]
    fn residual(&self) -> f64 {
        self.solution.residual
    }

    #[getter]
    fn stable(&self) -> Option<bool> {
        self.solution.stable
    }

    #[getter]
    fn unstable_directions(&self) -> Option<usize> {
        self.solution.unstable_directions
    }

    #[getter]
    fn stability_reason(&self) -> Option<&str> {
        self.solution.stability_reason.as_deref()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.solution.warnings.clone()
    }

    /// Values of the parameters, SI, those that were found among them.
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for parameter in &self.model.parameters {
            values.set_item(&parameter.name, parameter.value)?;
        }
        Ok(values)
    }

    /// Values of the outputs: numbers, or arrays of three; outputs without a value are missing.
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for output in &self.evaluation.outputs {
            match output.value {
                OutputValue::Number(value) => values.set_item(&output.name, value)?,
                OutputValue::Vector(value) => {
                    values.set_item(&output.name, numbers(py, value.into_iter()))?;
                }
            }
        }
        Ok(values)
    }

    /// Outputs without a value, and why.
    fn output_reasons(&self) -> Vec<(String, String)> {
        let without = self.evaluation.without_value.iter();
        without.map(|error| (error.output().to_owned(), error.to_string())).collect()
    }

    /// The state of a beam at its samples, each quantity an array.
    fn beam<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(position) = self.model.beams.iter().position(|beam| beam.name == name) else {
            return Ok(None);
        };
        let Some(result) = self.solution.beams.get(position) else { return Ok(None) };
        let samples = &result.samples;
        let of = |pick: fn(&BeamSample) -> _| vectors(py, samples.iter().map(pick));
        let beam = PyDict::new(py);
        beam.set_item("s", numbers(py, samples.iter().map(|sample| sample.s)))?;
        beam.set_item("position", of(|sample| sample.pose.position)?)?;
        beam.set_item("rotation", rows(py, samples.iter().map(quaternion))?)?;
        beam.set_item("force", of(|sample| sample.wrench.force)?)?;
        beam.set_item("moment", of(|sample| sample.wrench.moment)?)?;
        beam.set_item("curvature", of(|sample| sample.curvature)?)?;
        beam.set_item("stretch", numbers(py, samples.iter().map(|sample| sample.strain.x)))?;
        let stress = self.evaluation.beams.get(position).and_then(Option::as_ref);
        if let Some(stress) = stress {
            beam.set_item("stress", numbers(py, stress.samples.iter().map(|section| section.von_mises)))?;
            beam.set_item("strain", numbers(py, stress.samples.iter().map(|section| section.strain)))?;
        }
        if self.model.beams[position].foundation.is_empty() {
            return Ok(Some(beam));
        }
        beam.set_item("foundation", of(|sample| sample.foundation)?)?;
        beam.set_item("foundation_force", numbers(py, result.foundation_force.iter().copied()))?;
        Ok(Some(beam))
    }

    /// The result document as JSON; None where it would hold a number that is none, which only happens to a solve that broke
    /// off.
    fn document(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let written = released(py, |_| {
            let mut whole = document(&self.model, &self.solution, &self.evaluation)?;
            whole.scene.text = Some(self.request.file.whole_text().into_owned());
            to_json(&whole)
        })?;
        match written {
            Ok(text) => Ok(Some(text)),
            Err(_) if self.solution.status != Status::Converged => Ok(None),
            Err(error) => Err(bug(&error.to_string())),
        }
    }

    /// Its entry among several equilibria, as JSON.
    fn entry(&self) -> PyResult<String> {
        let entry = equilibrium_document(&self.model, &self.solution, &self.evaluation);
        entry.and_then(|entry| to_json(&entry)).map_err(|error| bug(&error.to_string()))
    }

    /// Its picture.
    fn svg(&self, py: Python<'_>) -> PyResult<String> {
        released(py, |_| shape_svg(&self.model, &self.solution))
    }

    /// Its shape for VTK (.vtp).
    fn vtp(&self, py: Python<'_>) -> PyResult<String> {
        released(py, |_| model_vtp(&self.model, &self.solution, &self.evaluation))
    }

    /// The beams' samples as a table.
    fn csv(&self, py: Python<'_>) -> PyResult<String> {
        let table = released(py, |_| beams_csv(&self.model, &self.solution, &self.evaluation))?;
        table.map_err(|error| bug(&error.to_string()))
    }

    /// Derivatives of all outputs, and of what was found, by some parameters.
    fn derivatives(&self, py: Python<'_>, parameters: Vec<usize>) -> PyResult<Derivatives> {
        let done = released(py, |interrupt| self.differentiate(&parameters, interrupt))?;
        done.map_err(|wrong| wrong.raise(py, &self.request.file, self.request.place))
    }
}

impl Solved {
    /// A solution with what it means.
    pub fn new(request: &Request, model: Model, mut solution: Solution) -> Self {
        let evaluation = evaluate_each(&model, &solution);
        if solution.status == Status::Converged {
            solution.warnings.extend(large_strain(&model, &solution, &evaluation));
        }
        solution.warnings.extend(evaluation.without_value.iter().map(ToString::to_string));
        Self { request: request.clone(), model, solution, evaluation }
    }

    fn differentiate(
        &self,
        parameters: &[usize],
        interrupt: &flexura::Interrupt,
    ) -> Result<Derivatives, Wrong> {
        let mut family = ModelFamily::new(&self.model);
        let mut prepared = Prepared::new(&self.model)?;
        prepared.heed(interrupt);
        if prepared.solve_near(&self.solution, self.request.tolerance).is_none() {
            return Err(Wrong::Told("no derivatives: this is no equilibrium of its model".to_owned()));
        }
        let found = prepared.sensitivities(&mut family, parameters);
        let found = found.map_err(|error| Wrong::Told(error.to_string()))?;
        let name = |parameter: &usize| self.model.parameters[*parameter].name.clone();
        let of = |value: &Option<f64>| value.unwrap_or(f64::NAN);
        let mut lines: Vec<(String, Vec<Vec<f64>>)> = Vec::new();
        for (output, components) in self.model.outputs.iter().zip(&found.outputs) {
            let components = components.iter().map(|row| row.iter().map(of).collect());
            lines.push((output.name.clone(), components.collect()));
        }
        for (unknown, row) in self.model.unknowns.iter().zip(&found.unknowns) {
            lines.push((format!("parameter.{}", name(&unknown.parameter)), vec![row.clone()]));
        }
        let columns = found.parameters.iter().map(name).collect();
        let left_out = found.left_out.iter().map(|(parameter, why)| (name(parameter), why.clone()));
        Ok((lines, columns, left_out.collect()))
    }
}

/// (w, x, y, z) of a section, of the two signs the one with w >= 0.
fn quaternion(sample: &BeamSample) -> [f64; 4] {
    let q = sample.pose.rotation.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    [sign * q.w, sign * q.i, sign * q.j, sign * q.k]
}

/// The numbers of an output.
pub fn components(result: &OutputResult) -> Vec<f64> {
    match result.value {
        OutputValue::Number(value) => vec![value],
        OutputValue::Vector(value) => value.to_vec(),
    }
}
