//! The indices of `repeat`.

use crate::context::{Context, Read, Reported};
use crate::tree::{Entry, Node, Value};
use flexura_expression::reserved;

/// Numbers beyond this are a mistake.
const LARGEST: f64 = 1e9;

const EXAMPLE: &str = "for example `repeat = { i = 10, j = [1, 5] }`: i from 0 to 9, j from 1 to 5";

/// Names of indices, each with its first and last value; the last index runs fastest.
pub(super) struct Indices(Vec<(String, i64, i64)>);

impl Indices {
    pub(super) fn names(&self) -> Vec<&str> {
        self.0.iter().map(|(name, ..)| name.as_str()).collect()
    }

    pub(super) fn slot(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|(known, ..)| known == name)
    }

    /// How many combinations there are; a float, so that it cannot overflow.
    pub(super) fn count(&self) -> f64 {
        self.0.iter().map(|(_, first, last)| (last - first + 1).max(0) as f64).product()
    }

    pub(super) fn first(&self) -> Vec<i64> {
        self.0.iter().map(|(_, first, _)| *first).collect()
    }

    /// The next combination.
    pub(super) fn next(&self, values: &mut [i64]) {
        for (value, (_, first, last)) in values.iter_mut().zip(&self.0).rev() {
            if *value < *last {
                *value += 1;
                return;
            }
            *value = *first;
        }
    }

    /// "i = 3, j = 4".
    pub(super) fn show(&self, values: &[i64]) -> String {
        let each = self.0.iter().zip(values).map(|((name, ..), value)| format!("{name} = {value}"));
        each.collect::<Vec<_>>().join(", ")
    }

    /// The name with every index in it.
    pub(super) fn example(&self, name: &str) -> String {
        let stem = name.split('{').next().unwrap_or_default().trim_end_matches('_');
        let stem = if stem.is_empty() { "n" } else { stem };
        self.0.iter().fold(stem.to_string(), |text, (name, ..)| format!("{text}_{{{name}}}"))
    }
}

/// Reads the `repeat` of a table.
pub(super) fn indices(context: &Context<'_>, table: &Node, path: &str) -> Read<Indices> {
    let entry = table.get("repeat").ok_or(Reported)?;
    let path = format!("{path}.repeat");
    if !matches!(entry.node.value, Value::Table(_)) {
        let message = format!("expected a table of indices, found {}", entry.node.kind());
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, EXAMPLE));
    }
    if entry.node.entries().is_empty() {
        return Err(context.wrong_with_hint(&entry.key_span, &path, "`repeat` names no index", EXAMPLE));
    }
    let each: Vec<Read<(String, i64, i64)>> =
        entry.node.entries().iter().map(|entry| index(context, entry, &path)).collect();
    each.into_iter().collect::<Read<Vec<_>>>().map(Indices)
}

fn index(context: &Context<'_>, entry: &Entry, path: &str) -> Read<(String, i64, i64)> {
    let name = &entry.key;
    let path = format!("{path}.{name}");
    let starts = name.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_');
    let taken = if !starts || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        Some("a name is made of letters, digits and `_`".to_string())
    } else if let Some(what) = reserved(name) {
        Some(format!("it is {what}"))
    } else if context.parameters.contains_key(name) {
        Some("it is a parameter".to_string())
    } else {
        None
    };
    if let Some(why) = taken {
        let message = format!("`{name}` cannot be the name of an index: {why}");
        return Err(context.wrong_with_hint(&entry.key_span, &path, message, EXAMPLE));
    }
    let node = &entry.node;
    match &node.value {
        Value::List(list) => {
            let [first, last] = list.as_slice() else {
                let message = format!("expected the first and the last value, found {} numbers", list.len());
                return Err(context.wrong_with_hint(&node.span, &path, message, EXAMPLE));
            };
            let first = whole(context, first, &format!("{path}[0]"))?;
            let last = whole(context, last, &format!("{path}[1]"))?;
            // One less is none at all, which a count that depends on parameters may well come out as.
            if last < first - 1 {
                let message = format!("the index ends at {last} before it begins at {first}");
                return Err(context.wrong_with_hint(&node.span, &path, message, EXAMPLE));
            }
            Ok((name.clone(), first, last))
        }
        _ => {
            let count = whole(context, node, &path)?;
            if count < 0 {
                let message = format!("a count must not be negative, is {count}");
                return Err(context.wrong_with_hint(&node.span, &path, message, EXAMPLE));
            }
            Ok((name.clone(), 0, count - 1))
        }
    }
}

fn whole(context: &Context<'_>, node: &Node, path: &str) -> Read<i64> {
    let Some(quantity) = context.quantity(node, path, false)? else {
        let message = format!("expected a count, or the first and the last value, found {}", node.kind());
        return Err(context.wrong_with_hint(&node.span, path, message, EXAMPLE));
    };
    let value = quantity.value.round();
    let dimension = quantity.kind.dimension();
    if !dimension.is_number() || dimension.is_angle() {
        let message = format!("expected a whole number, found {dimension}");
        return Err(context.wrong_with_hint(&node.span, path, message, EXAMPLE));
    }
    if (quantity.value - value).abs() > 1e-6 || value.abs() > LARGEST {
        let message = format!("expected a whole number, found {}", quantity.value);
        return Err(context.wrong_with_hint(&node.span, path, message, EXAMPLE));
    }
    Ok(value as i64)
}
