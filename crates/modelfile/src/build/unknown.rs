//! Unknown parameters.

use super::{named_entries, table_of};
use crate::context::{Context, Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::Entry;
use flexura_model::{Model, Unknown};

/// Reads the parameters that are to be found; what they begin with was evaluated with the parameters.
pub(super) fn unknowns(context: &Context<'_>, model: &Model) -> Vec<Unknown> {
    named_entries(context, "unknown").iter().filter_map(|entry| unknown(context, entry, model).ok()).collect()
}

fn unknown(context: &Context<'_>, entry: &Entry, model: &Model) -> Read<Unknown> {
    let path = format!("unknown.{}", entry.key);
    let table = table_of("unknown").ok_or(Reported)?;
    let reader = Reader::open(context, entry, table, &path)?;
    let quantity = match context.parameters.get(&entry.key) {
        Some(quantity) => quantity.ok_or(Reported)?,
        None => {
            let names: Vec<&str> = context.parameters.keys().map(String::as_str).collect();
            let near = suggest(&entry.key, &names, "parameter");
            let hint = if near.starts_with("did you mean") {
                near
            } else {
                "give it a `guess`, which declares it, or a value in [parameter]".to_string()
            };
            let message = format!("there is no parameter `{}`", entry.key);
            return Err(context.wrong_with_hint(&entry.key_span, &path, message, hint));
        }
    };
    let range = match reader.entry("range") {
        None => None,
        Some((range, key)) => {
            let path = reader.key_path("range");
            let dimension = quantity.kind.dimension();
            Some(reader.numbers_in(&range.node, &path, key, &[dimension; 2])?.map(|quantity| quantity.value))
        }
    };
    let parameter = model.parameters.iter().position(|parameter| parameter.name == entry.key);
    Ok(Unknown { parameter: parameter.ok_or(Reported)?, range })
}

/// There must be as many wanted values as unknowns.
pub(super) fn check_count(context: &Context<'_>, model: &Model) {
    let (unknowns, targets) = (&model.unknowns, &model.targets);
    if unknowns.len() == targets.len() {
        return;
    }
    let list = |names: Vec<&str>| match names.len() {
        0 => "none".to_string(),
        _ => names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", "),
    };
    let parameters = unknowns.iter().filter_map(|unknown| model.parameters.get(unknown.parameter));
    let unknown_names = list(parameters.map(|parameter| parameter.name.as_str()).collect());
    let target_names = list(targets.iter().map(|target| target.output.name.as_str()).collect());
    let word = if unknowns.len() > targets.len() { "unknown" } else { "target" };
    let span = context.root.get(word).map_or(0..0, |entry| entry.key_span.clone());
    let message = format!(
        "there must be as many targets as unknowns: unknowns {}, targets {}",
        unknowns.len(),
        targets.len()
    );
    let hint = format!("unknown: {unknown_names}; targets: {target_names}");
    context.wrong_with_hint(&span, word, message, hint);
}
