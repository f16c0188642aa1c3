//! `flexura::Stepper` with numpy arrays.

use crate::errors::Wrong;
use crate::guard::released;
use crate::mechanism::Mechanism;
use numpy::{PyReadonlyArray1, PyReadwriteArray1};
use pyo3::prelude::*;

/// A mechanism that stands at its last equilibrium.
#[pyclass(module = "flexura._native")]
pub struct Stepper(flexura::Stepper);

#[pymethods]
impl Stepper {
    /// `inputs` are parameters, or none for the wanted values of the targets; `outputs` are outputs, or none for the unknown
    /// parameters.
    #[new]
    fn new(
        py: Python<'_>,
        mechanism: &Mechanism,
        inputs: Vec<String>,
        outputs: Vec<String>,
        tolerance: f64,
    ) -> PyResult<Self> {
        let inputs: Vec<&str> = inputs.iter().map(String::as_str).collect();
        let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
        let made = released(py, |_| flexura::Stepper::new(&mechanism.model, &inputs, &outputs, tolerance))?;
        made.map(Self).map_err(|error| Wrong::from(error).raise(py, &mechanism.file, mechanism.place))
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
            self.0.heed(interrupt);
            self.0.step(values, out).word()
        })
    }

    /// Why the last step did not converge.
    #[getter]
    fn reason(&self) -> Option<&str> {
        self.0.reason()
    }

    /// How many numbers go in, and how many come out.
    #[getter]
    fn sizes(&self) -> (usize, usize) {
        (self.0.inputs(), self.0.outputs())
    }

    /// Begins again at rest.
    fn reset(&mut self) {
        self.0.reset();
    }
}
