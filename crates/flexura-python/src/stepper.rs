//! Solves one after another, each from where the last one ended: for loops of control.

use crate::errors::Wrong;
use crate::guard::released;
use crate::mechanism::Mechanism;
use flexura::model::Model;
use flexura::post::{OutputValue, each_output};
use flexura::solution::Status;
use flexura::{Family, FileFamily, Outcome, Prepared, ProblemError};
use numpy::{PyArray1, PyReadonlyArray1, PyReadwriteArray1};
use pyo3::prelude::*;
use std::sync::Arc;

/// What a step may write into its array.
enum Wanted {
    /// Components of outputs, by output.
    Outputs(Vec<usize>),
    /// The unknown parameters.
    Unknowns,
}

/// A mechanism that stands at its last equilibrium.
#[pyclass(module = "flexura._native")]
pub struct Stepper {
    file: Arc<flexura::modelfile::Document>,
    overrides: Vec<(String, String)>,
    model: Arc<Model>,
    prepared: Prepared,
    inputs: Vec<usize>,
    targets: bool,
    wanted: Wanted,
    tolerance: f64,
    stands: bool,
    /// Why the last step did not converge.
    reason: Option<String>,
    /// Values of the inputs, kept so that a step needs no new list.
    values: Vec<(usize, f64)>,
}

#[pymethods]
impl Stepper {
    /// `inputs` are positions of parameters, or empty for the wanted values of the targets; `outputs` are positions of
    /// outputs, or empty for the unknown parameters.
    #[new]
    fn new(
        py: Python<'_>,
        mechanism: &Mechanism,
        inputs: Vec<usize>,
        outputs: Vec<usize>,
        tolerance: f64,
    ) -> PyResult<Self> {
        let model = mechanism.model.clone();
        let prepared = released(py, |_| Prepared::new(&model))?
            .map_err(|error| Wrong::from(error).raise(py, &mechanism.file, mechanism.place))?;
        let values = inputs.iter().map(|input| (*input, model.parameters[*input].value)).collect();
        Ok(Self {
            file: mechanism.file.clone(),
            overrides: Vec::new(),
            model,
            prepared,
            targets: inputs.is_empty(),
            inputs,
            wanted: if outputs.is_empty() { Wanted::Unknowns } else { Wanted::Outputs(outputs) },
            tolerance,
            stands: false,
            reason: None,
            values,
        })
    }

    /// Goes to the equilibrium for these inputs and writes what is wanted into `out`; the word of its status.
    fn step(
        &mut self,
        py: Python<'_>,
        values: PyReadonlyArray1<'_, f64>,
        mut out: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<&'static str> {
        let (values, out) = (values.as_slice()?, out.as_slice_mut()?);
        released(py, |interrupt| {
            self.prepared.heed(interrupt);
            self.go(values, out)
        })
    }

    /// Why the last step did not converge.
    #[getter]
    fn reason(&self) -> Option<&str> {
        self.reason.as_deref()
    }

    /// How many numbers go in, and how many come out.
    #[getter]
    fn sizes(&self) -> (usize, usize) {
        let inputs = if self.targets { self.model.targets.len() } else { self.inputs.len() };
        let outputs = match &self.wanted {
            Wanted::Unknowns => self.model.unknowns.len(),
            Wanted::Outputs(outputs) => {
                outputs.iter().map(|output| self.model.outputs[*output].formulas.len()).sum()
            }
        };
        (inputs, outputs)
    }

    /// Begins again at rest.
    fn reset(&mut self) {
        self.stands = false;
    }

    /// An array of the size that `step` writes into.
    fn room<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::zeros(py, self.sizes().1, false)
    }
}

/// The family of a file in which the targets want other values.
struct Retargeted<'a> {
    family: FileFamily<'a>,
    targets: &'a [f64],
}

impl Family for Retargeted<'_> {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        let mut model = self.family.model(values)?;
        for (target, value) in model.targets.iter_mut().zip(self.targets) {
            target.value = *value;
        }
        Ok(model)
    }

    fn depends_on(&mut self, parameter: usize) -> bool {
        self.family.depends_on(parameter)
    }
}

impl Stepper {
    fn go(&mut self, values: &[f64], out: &mut [f64]) -> &'static str {
        let status = match self.outcome(values) {
            Ok(outcome) => {
                self.reason = outcome.reason;
                outcome.status.word()
            }
            Err(error) => {
                self.reason = Some(format!("{}: {}", error.path, error.message));
                "input_error"
            }
        };
        self.stands = status == Status::Converged.word();
        if self.stands {
            self.write(out)
        } else {
            out.fill(f64::NAN)
        }
        status
    }

    fn outcome(&mut self, values: &[f64]) -> Result<Outcome, ProblemError> {
        if self.targets {
            return Ok(self.meet(values));
        }
        self.values.iter_mut().zip(values).for_each(|(kept, value)| kept.1 = *value);
        let mut family = FileFamily::new(&self.file, &self.overrides, &self.model);
        let model = family.model(&self.values)?;
        self.prepared.adopt(&model)?;
        let inverse = !model.unknowns.is_empty();
        Ok(match (self.stands, inverse) {
            (true, false) => self.prepared.solve_from_here(self.tolerance, &mut |_| {}),
            (false, false) => self.prepared.solve(self.tolerance, &mut |_| {}),
            (true, true) => self.prepared.solve_inverse_from_here(&mut family, self.tolerance),
            (false, true) => self.prepared.solve_inverse(&mut family, self.tolerance, &mut |_| {}),
        })
    }

    fn meet(&mut self, targets: &[f64]) -> Outcome {
        let family = FileFamily::new(&self.file, &self.overrides, &self.model);
        let mut family = Retargeted { family, targets };
        if self.stands {
            let outcome = self.prepared.solve_inverse_from_here(&mut family, self.tolerance);
            if outcome.status == Status::Converged {
                return outcome;
            }
        }
        if let Ok(model) = family.model(&[]) {
            // What fails here fails in the solve, which says why.
            let _ = self.prepared.adopt(&model);
        }
        self.prepared.solve_inverse(&mut family, self.tolerance, &mut |_| {})
    }

    fn write(&mut self, out: &mut [f64]) {
        match &self.wanted {
            Wanted::Unknowns => {
                let model = self.prepared.model();
                let found = model.unknowns.iter().map(|unknown| model.parameters[unknown.parameter].value);
                out.iter_mut().zip(found).for_each(|(place, value)| *place = value);
            }
            Wanted::Outputs(outputs) => {
                let mut solution = self.prepared.problem().solution(2);
                self.prepared.add_tangents(&mut solution, &[]);
                let results = each_output(self.prepared.model(), &solution);
                let mut places = out.iter_mut();
                for output in outputs {
                    let count = self.model.outputs[*output].formulas.len();
                    let numbers = match results.get(*output) {
                        Some(Ok(result)) => match result.value {
                            OutputValue::Number(value) => [value, f64::NAN, f64::NAN],
                            OutputValue::Vector(vector) => vector,
                        },
                        _ => [f64::NAN; 3],
                    };
                    numbers.iter().take(count).for_each(|number| {
                        if let Some(place) = places.next() {
                            *place = *number;
                        }
                    });
                }
            }
        }
    }
}
