//! Studies that meet data: what is to be found, and from which table.

use super::measurements::{Known, measurements};
use super::result::Built;
use crate::context::{Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::{Entry, Node, Value};
use flexura_expression::Dimension;
use flexura_model::{FitLoss, FitStudy, FitUnknown, Model};

pub(super) fn fit(reader: &Reader<'_, '_>, model: &Model, outputs: &[Built]) -> Read<FitStudy> {
    let known = Known::new(reader.context, model, outputs);
    let mut unknowns = Vec::new();
    let mut found = Ok(());
    for (key, is_per_specimen) in [("unknown", false), ("per_specimen", true)] {
        match parameters(reader, &known, key) {
            Ok(list) => unknowns.extend(list.into_iter().map(|parameter| FitUnknown {
                parameter,
                bounds: None,
                is_per_specimen,
            })),
            Err(Reported) => found = Err(Reported),
        }
    }
    let bounds = bounds(reader, &known, &mut unknowns);
    let noise = noise(reader, &known);
    let data = measurements(reader, &known);
    let loss = reader.choice("loss");
    let intervals = reader.choice("intervals");
    let confidence = reader.number("confidence");
    let reject = reader.flag("reject");
    found?;
    bounds?;
    let loss = loss?;
    Ok(FitStudy {
        data: data?,
        unknowns,
        noise: noise?,
        loss: FitLoss::ALL.into_iter().find(|known| Some(known.word()) == loss).unwrap_or_default(),
        profile: intervals? == Some("profile"),
        confidence: confidence?.unwrap_or(0.95),
        reject: reject?.unwrap_or(false),
    })
}

/// Texts behind a key, one or a list, each with its place.
pub(super) fn texts<'c>(reader: &Reader<'c, '_>, name: &str) -> Read<Vec<(&'c Node, String, &'c str)>> {
    let Some((entry, key)) = reader.entry(name) else { return Ok(Vec::new()) };
    let path = reader.key_path(name);
    let nodes: Vec<(&Node, String)> = match &entry.node.value {
        Value::List(list) => {
            list.iter().enumerate().map(|(i, node)| (node, format!("{path}[{i}]"))).collect()
        }
        _ => vec![(&entry.node, path)],
    };
    let text = |(node, path): (&'c Node, String)| match &node.value {
        Value::Text(text) => Ok((node, path, text.as_str())),
        _ => {
            let message = format!("expected a text, found {}", node.kind());
            let hint = format!("for example `{} = {}`", key.name, key.example);
            Err(reader.context.wrong_with_hint(&node.span, &path, message, hint))
        }
    };
    nodes.into_iter().map(text).collect()
}

/// Names of parameters behind a key.
fn parameters(reader: &Reader<'_, '_>, known: &Known<'_>, key: &str) -> Read<Vec<usize>> {
    let read = |(node, path, text): (&Node, String, &str)| {
        known.parameter(text).ok_or_else(|| {
            let hint = suggest(text, &known.parameter_names(), "parameter");
            reader.context.wrong_with_hint(&node.span, &path, format!("there is no parameter `{text}`"), hint)
        })
    };
    texts(reader, key)?.into_iter().map(read).collect()
}

/// The entries of a table of names.
pub(super) fn named<'c>(reader: &Reader<'c, '_>, key: &str) -> Read<&'c [Entry]> {
    let Some((entry, key)) = reader.entry(key) else { return Ok(&[]) };
    match &entry.node.value {
        Value::Table(entries) => Ok(entries),
        _ => {
            let message = format!("expected {}, found {}", key.shape.wanted(), entry.node.kind());
            Err(reader.wrong_at(key.name, message, format!("for example `{} = {}`", key.name, key.example)))
        }
    }
}

fn bounds(reader: &Reader<'_, '_>, known: &Known<'_>, unknowns: &mut [FitUnknown]) -> Read<()> {
    let mut all = Ok(());
    for entry in named(reader, "bounds")? {
        let path = format!("{}.{}", reader.key_path("bounds"), entry.key);
        let wanted = known.parameter(&entry.key);
        let Some(unknown) = unknowns.iter_mut().find(|unknown| Some(unknown.parameter) == wanted) else {
            let message = format!("`{}` is not to be found", entry.key);
            let hint = "bounds are for the parameters in `unknown` and `per_specimen`";
            all = Err(reader.context.wrong_with_hint(&entry.key_span, &path, message, hint));
            continue;
        };
        let dimension = known.parameter_dimension(unknown.parameter);
        match range(reader, &entry.node, &path, "bounds", dimension) {
            Ok(range) => unknown.bounds = Some(range),
            Err(Reported) => all = Err(Reported),
        }
    }
    all
}

/// Two numbers of a dimension; None: any will do.
pub(super) fn range(
    reader: &Reader<'_, '_>,
    node: &Node,
    path: &str,
    key: &str,
    dimension: Option<Dimension>,
) -> Read<[f64; 2]> {
    let Some((_, key)) = reader.entry(key) else { return Err(Reported) };
    let list = match &node.value {
        Value::List(list) if list.len() == 2 => list,
        _ => {
            let message = "expected a list of 2 numbers".to_string();
            let hint = format!("for example `{} = {}`", key.name, key.example);
            return Err(reader.context.wrong_with_hint(&node.span, path, message, hint));
        }
    };
    let [low, high] = [0, 1].map(|i| number(reader, &list[i], &format!("{path}[{i}]"), dimension.as_ref()));
    Ok([low?, high?])
}

/// A number of a dimension; None: any will do.
pub(super) fn number(
    reader: &Reader<'_, '_>,
    node: &Node,
    path: &str,
    dimension: Option<&Dimension>,
) -> Read<f64> {
    let context = reader.context;
    let Some(quantity) = context.quantity(node, path, false)? else {
        return Err(context.wrong(&node.span, path, format!("expected a number, found {}", node.kind())));
    };
    match dimension {
        Some(wanted) if !quantity.kind.fits(wanted) => {
            let message = format!("expected {wanted}, found {}", quantity.kind.dimension());
            Err(context.wrong(&node.span, path, message))
        }
        _ => Ok(quantity.value),
    }
}

fn noise(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<Vec<(usize, usize, f64)>> {
    let mut noise = Vec::new();
    let mut all = Ok(());
    for entry in named(reader, "noise")? {
        let path = format!("{}.{}", reader.key_path("noise"), entry.key);
        let Some((output, component)) = known.output(&entry.key) else {
            let names = known.output_names();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let message = format!("there is no output `{}`", entry.key);
            let hint = suggest(&entry.key, &names, "output");
            all = Err(reader.context.wrong_with_hint(&entry.key_span, &path, message, hint));
            continue;
        };
        match number(reader, &entry.node, &path, Some(&known.output_dimension(output))) {
            Ok(value) => noise.push((output, component, value)),
            Err(Reported) => all = Err(Reported),
        }
    }
    all.map(|()| noise)
}
