//! The text of a model file as dictionaries, in the order of the text.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

/// A text that was understood as a model file before, as a dictionary.
#[pyfunction]
pub fn tree<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyDict>> {
    dictionary(py, DeTable::parse_recoverable(text).0.get_ref())
}

fn dictionary<'py>(py: Python<'py>, table: &DeTable<'_>) -> PyResult<Bound<'py, PyDict>> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let dictionary = PyDict::new(py);
    for (key, value) in entries {
        dictionary.set_item(key.get_ref().as_ref(), object(py, value)?)?;
    }
    Ok(dictionary)
}

fn object<'py>(py: Python<'py>, value: &Spanned<DeValue<'_>>) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value.get_ref() {
        DeValue::String(text) => text.as_ref().into_pyobject(py)?.into_any(),
        DeValue::Integer(integer) => number(py, integer)?,
        DeValue::Float(float) => {
            float.as_str().parse::<f64>().unwrap_or(f64::NAN).into_pyobject(py)?.into_any()
        }
        DeValue::Boolean(flag) => flag.into_pyobject(py)?.to_owned().into_any(),
        DeValue::Datetime(date) => date.to_string().into_pyobject(py)?.into_any(),
        DeValue::Array(list) => {
            let items = PyList::empty(py);
            for item in list {
                items.append(object(py, item)?)?;
            }
            items.into_any()
        }
        DeValue::Table(table) => dictionary(py, table)?.into_any(),
    })
}

fn number<'py>(py: Python<'py>, integer: &DeInteger<'_>) -> PyResult<Bound<'py, PyAny>> {
    let text = integer.as_str();
    Ok(match i64::from_str_radix(text, integer.radix()) {
        Ok(value) => value.into_pyobject(py)?.into_any(),
        Err(_) => text.parse::<f64>().unwrap_or(f64::INFINITY).into_pyobject(py)?.into_any(),
    })
}
