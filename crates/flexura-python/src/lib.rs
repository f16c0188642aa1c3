//! The native part of the Python package: a model file's text in, solutions as numpy arrays and documents out.
//!
//! Everything that a person sees is in `python/flexura`; here stands only what needs Rust. The interpreter's lock is released
//! while anything is read or solved, signals are asked for before every factorisation, and a panic becomes an exception.

mod arrays;
mod errors;
mod guard;
mod mechanism;
mod solved;
mod stepper;
mod studies;
mod tree;

use pyo3::prelude::*;

/// The page that shows a result document, as HTML.
#[pyfunction]
fn page(document: &str) -> PyResult<String> {
    flexura::report::page(document).map_err(|error| errors::study(error.to_string()))
}

/// The JSON Schema of model files.
#[pyfunction]
fn schema() -> String {
    flexura::modelfile::schema()
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<mechanism::Mechanism>()?;
    module.add_class::<solved::Solved>()?;
    module.add_class::<studies::Study>()?;
    module.add_class::<stepper::Stepper>()?;
    module.add_function(wrap_pyfunction!(page, module)?)?;
    module.add_function(wrap_pyfunction!(tree::tree, module)?)?;
    module.add_function(wrap_pyfunction!(schema, module)?)
}
