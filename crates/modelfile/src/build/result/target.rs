//! Wanted values of results.

use super::{Built, Results, Walk};
use crate::context::{Context, Read, suggest};
use crate::tree::{Entry, Node, Value};
use flexura_expression::{ExpressionError, Kind, Reference};
use flexura_model::{Model, Output, Quantity, Target};
use std::cell::Cell;

impl<'r> Results<'r, '_> {
    /// The output that `output.NAME` or `output.NAME.x` refers to; no component: all of it.
    pub(super) fn output(
        &self,
        outputs: &'r [Built],
        reference: &Reference,
        silent: &Cell<bool>,
    ) -> Result<(&'r Output, Kind, Option<usize>), ExpressionError> {
        let mut walk = Walk::new(reference);
        walk.take();
        let (name, span) = walk.name("the name of an output", "output.tip")?;
        let Some(built) = outputs.iter().find(|built| built.output.name == name) else {
            let written = self.context.root.get("output").map_or(&[][..], |entry| entry.node.entries());
            if written.iter().any(|entry| entry.key == name) {
                silent.set(true);
            }
            let names: Vec<&str> = outputs.iter().map(|built| built.output.name.as_str()).collect();
            let error = ExpressionError::new(format!("there is no output `{name}`"), span);
            return Err(error.with_hint(suggest(name, &names, "output")));
        };
        let is_vector = built.output.formulas.len() > 1;
        let component = match walk.take() {
            None if is_vector => None,
            None => Some(0),
            Some((_, span)) if !is_vector => {
                let error = ExpressionError::new(format!("nothing can follow `output.{name}`"), span);
                return Err(error.with_hint("it is a single number"));
            }
            Some((segment, span)) => {
                let known = ["x", "y", "z"];
                let part = known.iter().position(
                    |known| matches!(segment, flexura_expression::Segment::Name(part) if part == known),
                );
                let Some(part) = part else {
                    let error = ExpressionError::new(format!("`output.{name}` has no such component"), span);
                    return Err(error.with_hint("the components are x, y, z"));
                };
                walk.end("a component")?;
                Some(part)
            }
        };
        Ok((&built.output, built.kind, component))
    }
}

/// Reads the wanted values.
pub(in crate::build) fn targets(
    context: &Context<'_>,
    entries: &[Entry],
    model: &Model,
    outputs: &[Built],
) -> Vec<Target> {
    let results = Results { context, model, outputs: Some(outputs), is_live: true, may_be_infinite: false };
    entries.iter().filter_map(|entry| target(&results, entry).ok()).collect()
}

fn target(results: &Results<'_, '_>, entry: &Entry) -> Read<Target> {
    let context = results.context;
    let path = format!("target.\"{}\"", entry.key);
    if let Value::Table(_) = entry.node.value {
        // What a key without quotes becomes: TOML takes its dots for tables.
        let message = "a target is a number, found a table";
        let hint = "put the expression in quotes: `\"body.slider.position.x\" = \"140 mm\"`";
        return Err(context.wrong_with_hint(
            &entry.key_span,
            &format!("target.{}", entry.key),
            message,
            hint,
        ));
    }
    let key = Node { value: Value::Text(entry.key.clone()), span: entry.key_span.clone() };
    let Built { output, kind } = results.read(&key, &path, &entry.key, entry.key.clone())?;
    if output.formulas.len() > 1 {
        let message = "a target is a single number, but this is a vector";
        return Err(context.wrong_with_hint(
            &entry.key_span,
            &path,
            message,
            format!("name a component, for example `\"{}.x\"`", entry.key),
        ));
    }
    if output.probes.iter().all(|probe| probe.quantity == Quantity::Parameter) {
        let message = "a target must refer to a result, or nothing can change it";
        return Err(context.wrong_with_hint(&entry.key_span, &path, message, results.roots()));
    }
    let example = "for example `\"body.slider.position.x\" = \"140 mm\"`";
    let Some(value) = context.quantity(&entry.node, &path, false)? else {
        let message = format!("expected {}, found {}", kind.dimension(), entry.node.kind());
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, example));
    };
    if kind != Kind::Plain && !value.kind.fits(&kind.dimension()) {
        let message = format!("expected {}, found {}", kind.dimension(), value.kind.dimension());
        return Err(context.wrong_with_hint(
            &entry.node.span,
            &path,
            message,
            "the wanted value has the dimension of the result",
        ));
    }
    Ok(Target { output, value: value.value })
}
