//! Lists of results as numpy arrays, each copied once, from many small structs into one block.

use flexura::spatial::Vector3;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// A list of numbers: (n,).
pub fn numbers<'py>(py: Python<'py>, values: impl Iterator<Item = f64>) -> Bound<'py, PyAny> {
    PyArray1::from_vec(py, values.collect()).into_any()
}

/// A list of vectors: (n, 3).
pub fn vectors<'py>(
    py: Python<'py>,
    values: impl ExactSizeIterator<Item = Vector3<f64>>,
) -> PyResult<Bound<'py, PyAny>> {
    rows(py, values.map(|value| [value.x, value.y, value.z]))
}

/// A list of rows of `N` numbers: (n, N).
pub fn rows<'py, const N: usize>(
    py: Python<'py>,
    values: impl ExactSizeIterator<Item = [f64; N]>,
) -> PyResult<Bound<'py, PyAny>> {
    let count = values.len();
    let flat: Vec<f64> = values.flatten().collect();
    Ok(PyArray1::from_vec(py, flat).reshape([count, N])?.into_any())
}
