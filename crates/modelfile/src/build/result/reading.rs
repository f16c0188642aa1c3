//! What a design is judged by.

use super::{Built, Results};
use crate::context::{Context, Read};
use crate::tree::{Node, Value};
use flexura_model::Model;

/// Reads a formula over results, or the name of an output, as one number. Its parameters stay open, for they change with the design.
pub(in crate::build) fn reading(
    context: &Context<'_>,
    node: &Node,
    path: &str,
    model: &Model,
    outputs: &[Built],
) -> Read<Built> {
    let example = "for example \"output.tip\", \"beam.link.max_stress\" or \"model.mass\"";
    let Value::Text(text) = &node.value else {
        let message = format!("expected a formula over results, found {}", node.kind());
        return Err(context.wrong_with_hint(&node.span, path, message, example));
    };
    let results = Results { context, model, outputs: Some(outputs), is_live: true, may_be_infinite: false };
    let name = text.trim();
    let built = match outputs.iter().find(|built| built.output.name == name) {
        Some(_) if !context.parameters.contains_key(name) => {
            let text = format!("output.{name}");
            results.read(node, path, &text, text.clone())?
        }
        _ => results.read(node, path, text, name.to_string())?,
    };
    if built.output.formulas.len() > 1 {
        let message = "a single number is wanted, but this is a vector";
        let hint = format!("name a component, for example \"{}.x\"", built.output.name);
        return Err(context.wrong_with_hint(&node.span, path, message, hint));
    }
    Ok(built)
}
