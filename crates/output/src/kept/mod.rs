//! Still pictures of a result that was kept: from its document alone, by the same rules as when it was found.
//!
//! What a picture draws besides the states, the parts of the mechanism and how they hang together, is read from the model file that
//! the document holds; rest shapes stand in its scene. So the document is read back into what the drawings know, a
//! [`flexura_solution::Solution`] or [`flexura_solution::Trace`], with what they ask for and no more.

mod motions;
mod paths;
mod samples;
mod states;

use crate::Named;
use crate::read::ReadError;
use flexura_model::Model;
use serde::Deserialize;
use serde_json::Value;

/// Makes the model of a model file with values (SI) of its parameters, by their names; what is wrong, in words.
pub type Make<'m> = dyn FnMut(&str, &[(String, f64)]) -> Result<Model, String> + 'm;

/// The pictures (SVG) of a result document, in the order in which a folder of results has them.
///
/// # Errors
/// The text is no result document, does not hold its model file, or is of a study that has no picture of its states.
pub fn kept_pictures(text: &str, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let document: Value =
        serde_json::from_str(text).map_err(|error| ReadError::NoDocument(error.to_string()))?;
    if document.get("flexura").is_none_or(|version| !version.is_string()) {
        return Err(ReadError::NoDocument("it has no key `flexura`".into()));
    }
    // Where names have an order, from the text again: a value would sort them.
    let broken = |error: serde_json::Error| ReadError::Broken(error.to_string());
    match document.get("study").and_then(Value::as_str) {
        Some("run") => {
            let run: Run = serde_json::from_str(text).map_err(broken)?;
            let all = run.studies.0.iter().map(|(_, study)| pictures(study, make));
            Ok(all.collect::<Result<Vec<_>, _>>()?.concat())
        }
        Some("sweep") => samples::sweep(&document, &serde_json::from_str(text).map_err(broken)?),
        _ => pictures(&document, make),
    }
}

/// The studies of a file.
#[derive(Deserialize)]
struct Run {
    studies: Named<Value>,
}

fn pictures(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    match document.get("study").and_then(Value::as_str) {
        Some("solve" | "optimise") => states::solve(document, make),
        Some("trace") => paths::trace(document, make),
        Some("buckle") => states::buckle(document, make),
        Some("modes") => states::modes(document, make),
        Some("inverse_dynamics") => motions::motion(document, make),
        Some(study) => Err(ReadError::NoPicture(study.to_owned())),
        None => Err(ReadError::NoDocument("it has no key `study`".into())),
    }
}

/// The model that a document is of, with its own parameters and with further ones.
fn model_of(document: &Value, further: &[(String, f64)], make: &mut Make<'_>) -> Result<Model, ReadError> {
    let text = document.pointer("/scene/text").and_then(Value::as_str).ok_or(ReadError::NoModel)?;
    let own = document.get("parameters").and_then(Value::as_object).into_iter().flatten();
    let mut values: Vec<(String, f64)> =
        own.filter_map(|(name, value)| Some((name.clone(), value.as_f64()?))).collect();
    for (name, value) in further {
        values.retain(|(other, _)| other != name);
        values.push((name.clone(), *value));
    }
    make(text, &values).map_err(ReadError::OtherMechanism)
}

fn text<'v>(value: &'v Value, key: &str) -> &'v str {
    value.get(key).and_then(Value::as_str).unwrap_or_default()
}

fn number(value: &Value, key: &str) -> f64 {
    value.get(key).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// Three numbers.
fn vector(value: &Value) -> Option<[f64; 3]> {
    let list = value.as_array()?;
    Some([list.first()?.as_f64()?, list.get(1)?.as_f64()?, list.get(2)?.as_f64()?])
}

/// A number, or three.
fn components(value: &Value) -> Option<Vec<f64>> {
    value.as_f64().map(|number| vec![number]).or_else(|| vector(value).map(Vec::from))
}
