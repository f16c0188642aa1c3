//! Parameters: named numbers that may refer to each other in any order, and be overridden.

use crate::context::{Context, Parameters, no_parameter, suggest};
use crate::report::{Problem, Source};
use crate::tree::{Entry, Node, Value};
use flexura_expression::{Expression, ExpressionError, Kind, Quantity, free_name, reserved};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// Where a parameter's value is written.
enum Text<'a> {
    File(&'a Node),
    Override { source: Arc<Source>, offset: usize },
}

struct Definition<'a> {
    name: &'a str,
    /// The key of its value.
    path: String,
    text: Text<'a>,
    /// Does its text stand instead of the one that declares it?
    replaced: bool,
    expression: Option<Expression>,
    /// Positions of the parameters it refers to, with where.
    needs: Vec<(usize, Range<usize>)>,
}

/// Where a parameter is declared: in [parameter], or in [unknown] by its guess.
pub(crate) struct Declared<'a> {
    pub name: &'a str,
    entry: &'a Entry,
    node: &'a Node,
    path: String,
}

/// All parameters, in the order of the file.
pub(crate) fn declared(root: &Node) -> Vec<Declared<'_>> {
    let entries = |word: &str| root.get(word).map_or(&[][..], |entry| entry.node.entries());
    let mut all: Vec<Declared<'_>> = entries("parameter")
        .iter()
        .map(|entry| {
            let path = format!("parameter.{}", entry.key);
            Declared { name: &entry.key, entry, node: &entry.node, path }
        })
        .collect();
    let known: BTreeSet<&str> = all.iter().map(|declared| declared.name).collect();
    let more: Vec<Declared<'_>> =
        guesses(root).into_iter().filter(|guess| !known.contains(guess.name)).collect();
    all.extend(more);
    all
}

fn guesses<'a>(root: &'a Node) -> Vec<Declared<'a>> {
    let entries = root.get("unknown").map_or(&[][..], |entry| entry.node.entries());
    let guess = |entry: &'a Entry| {
        let path = format!("unknown.{}.guess", entry.key);
        Some(Declared { name: &entry.key, entry, node: &entry.node.get("guess")?.node, path })
    };
    entries.iter().filter_map(guess).collect()
}

/// Evaluates all parameters, first as declared, then with guesses and overrides. What is wrong is recorded.
pub(crate) fn evaluate(context: &mut Context<'_>, overrides: &[(String, String)]) {
    let root = context.root;
    let entries = &declared(root)[..];
    for Declared { entry, .. } in entries {
        let path = format!("parameter.{}", entry.key);
        let starts = entry.key.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_');
        if !starts || !entry.key.chars().all(|c| c.is_alphanumeric() || c == '_') {
            let message = format!("`{}` cannot be the name of a parameter", entry.key);
            context.wrong_with_hint(
                &entry.key_span,
                &path,
                message,
                "a name is made of letters, digits and `_`, and does not begin with a digit",
            );
        } else if let Some(what) = reserved(&entry.key) {
            let message = format!("`{}` cannot be the name of a parameter: it is {what}", entry.key);
            let names = std::iter::once(free_name(&entry.key))
                .chain((1..=entries.len()).map(|i| format!("{}_{i}", entry.key)));
            let free = names.into_iter().find(|free| !entries.iter().any(|other| other.name == free));
            let hint = format!("take another name, such as `{}`", free.unwrap_or_default());
            context.wrong_with_hint(&entry.key_span, &path, message, hint);
            context.misnamed.insert(entry.key.clone());
        }
    }
    let declared = solve(context, entries, &BTreeMap::new(), &BTreeMap::new(), None);
    let in_table: BTreeSet<&str> = root
        .get("parameter")
        .map_or(&[][..], |entry| entry.node.entries())
        .iter()
        .map(|entry| entry.key.as_str())
        .collect();
    let guesses: BTreeMap<&str, Declared<'_>> = guesses(root)
        .into_iter()
        .filter(|guess| in_table.contains(guess.name))
        .map(|guess| (guess.name, guess))
        .collect();
    if (overrides.is_empty() && guesses.is_empty()) || context.any_problem() {
        context.parameters = declared;
        for (name, _) in overrides {
            context.mark_used("parameter", name);
        }
        return;
    }
    let mut replaced = BTreeMap::new();
    for (name, value) in overrides {
        let name = name.trim();
        let source = Arc::new(Source { name: "--set".to_string(), text: format!("{name}={value}") });
        if !declared.contains_key(name) {
            let names: Vec<&str> = declared.keys().map(String::as_str).collect();
            let problem = Problem::at(&source, 0..name.len(), "", format!("there is no parameter `{name}`"));
            context.record(problem.hint(suggest(name, &names, "parameter")));
            continue;
        }
        context.mark_used("parameter", name);
        replaced.insert(name, source);
    }
    context.parameters = solve(context, entries, &guesses, &replaced, Some(&declared));
}

fn solve(
    context: &Context<'_>,
    entries: &[Declared<'_>],
    guesses: &BTreeMap<&str, Declared<'_>>,
    replaced: &BTreeMap<&str, Arc<Source>>,
    declared: Option<&Parameters>,
) -> Parameters {
    let positions: BTreeMap<&str, usize> =
        entries.iter().enumerate().map(|(i, entry)| (entry.name, i)).collect();
    let mut definitions: Vec<Definition<'_>> = entries
        .iter()
        .map(|entry| {
            let (text, path, replaced) = match (replaced.get(entry.name), guesses.get(entry.name)) {
                (Some(source), _) => {
                    let text = Text::Override { source: source.clone(), offset: entry.name.len() + 1 };
                    (text, &entry.path, true)
                }
                (None, Some(guess)) => (Text::File(guess.node), &guess.path, true),
                (None, None) => (Text::File(entry.node), &entry.path, false),
            };
            let path = path.clone();
            Definition { name: entry.name, path, text, replaced, expression: None, needs: Vec::new() }
        })
        .collect();
    let mut values: Parameters = Parameters::new();
    for definition in &mut definitions {
        let text = match &definition.text {
            Text::File(node) => match &node.value {
                Value::Text(text) => text.as_str(),
                Value::Number(_) => continue,
                _ => {
                    let path = &definition.path;
                    let message = format!("expected a number or an expression, found {}", node.kind());
                    context.wrong_with_hint(
                        &node.span,
                        path,
                        message,
                        format!("for example `{} = \"3 N\"`", path.rsplit('.').next().unwrap_or_default()),
                    );
                    values.insert(definition.name.to_string(), None);
                    continue;
                }
            },
            Text::Override { source, offset } => &source.text[*offset..],
        };
        match Expression::parse(text) {
            Ok(expression) => {
                definition.needs = expression
                    .references()
                    .iter()
                    .filter_map(|reference| {
                        Some((*positions.get(reference.name()?)?, reference.span.clone()))
                    })
                    .collect();
                definition.needs.sort_by_key(|(_, span)| span.start);
                definition.expression = Some(expression);
            }
            Err(error) => {
                complain(context, definition, &error);
                values.insert(definition.name.to_string(), None);
            }
        }
    }
    let order = order(context, &definitions, &mut values);
    for position in order {
        let definition = &definitions[position];
        if values.contains_key(definition.name) {
            continue;
        }
        let value = value(context, definition, &values, declared, entries);
        values.insert(definition.name.to_string(), value);
    }
    values
}

/// An order in which every parameter comes behind those it needs. Those on a cycle are recorded and left out.
fn order(context: &Context<'_>, definitions: &[Definition<'_>], values: &mut Parameters) -> Vec<usize> {
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); definitions.len()];
    let mut open: Vec<usize> = vec![0; definitions.len()];
    for (i, definition) in definitions.iter().enumerate() {
        open[i] = definition.needs.len();
        for (needed, _) in &definition.needs {
            users[*needed].push(i);
        }
    }
    let mut order: Vec<usize> = (0..definitions.len()).filter(|i| open[*i] == 0).collect();
    let mut next = 0;
    while next < order.len() {
        for user in &users[order[next]] {
            open[*user] -= 1;
            if open[*user] == 0 {
                order.push(*user);
            }
        }
        next += 1;
    }
    // What is left lies on a cycle or behind one; each cycle is told once.
    let mut told = vec![false; definitions.len()];
    for first in (0..definitions.len()).filter(|i| open[*i] > 0) {
        values.insert(definitions[first].name.to_string(), None);
        let mut trail = Vec::new();
        let mut at = first;
        while !told[at] {
            told[at] = true;
            trail.push(at);
            match definitions[at].needs.iter().find(|(needed, _)| open[*needed] > 0) {
                Some((needed, _)) => at = *needed,
                None => break,
            }
        }
        let Some(begin) = trail.iter().position(|i| *i == at) else { continue };
        let mut names: Vec<&str> = trail[begin..].iter().map(|i| definitions[*i].name).collect();
        names.push(definitions[at].name);
        let message = if names.len() == 2 {
            format!("the parameter `{}` refers to itself", names[0])
        } else {
            format!("the parameters refer to each other in a circle: {}", names.join(" -> "))
        };
        let span = definitions[at]
            .needs
            .iter()
            .find(|(needed, _)| open[*needed] > 0)
            .map_or(0..0, |(_, span)| span.clone());
        complain(context, &definitions[at], &ExpressionError::new(message, span));
    }
    order
}

fn complain(context: &Context<'_>, definition: &Definition<'_>, error: &ExpressionError) {
    let path = &definition.path;
    match &definition.text {
        Text::File(node) => {
            context.expression_error(node, path, error);
        }
        Text::Override { source, offset } => {
            let mut problem = Problem::at(
                source,
                offset + error.span.start..offset + error.span.end,
                path,
                error.message.clone(),
            );
            problem.hint = error.hint.clone();
            context.record(problem);
        }
    }
}

fn value(
    context: &Context<'_>,
    definition: &Definition<'_>,
    values: &Parameters,
    declared: Option<&Parameters>,
    names: &[Declared<'_>],
) -> Option<Quantity> {
    let before = declared.and_then(|declared| declared.get(definition.name)).copied().flatten();
    context.rules.record_parameter(definition.name, definition.expression.as_ref());
    let Some(expression) = &definition.expression else {
        let Text::File(node) = &definition.text else { return None };
        let mut quantity = context.quantity(node, &definition.path, false).ok().flatten()?;
        if let (true, Some(Quantity { kind, .. })) = (definition.replaced, before) {
            quantity.kind = kind;
        }
        return Some(quantity);
    };
    let silent = Cell::new(false);
    let text = expression.text();
    let whole = 0..text.len();
    let lowered = expression.lower(&mut |reference| {
        let found = reference.name().and_then(|name| {
            context.mark_used("parameter", name);
            values.get(name)
        });
        match found {
            Some(Some(quantity)) => Ok(flexura_expression::Binding::Value(*quantity)),
            Some(None) => {
                silent.set(true);
                Err(ExpressionError::new(String::new(), reference.span.clone()))
            }
            None => {
                if context.is_full() {
                    return Err(ExpressionError::new(String::new(), reference.span.clone()));
                }
                let name = &text[reference.span.clone()];
                let names: Vec<&str> = names.iter().map(|entry| entry.name).collect();
                Err(no_parameter(name, &names, reference.span.clone()))
            }
        }
    });
    let fail = |error: &ExpressionError| {
        if !silent.get() {
            complain(context, definition, error);
        }
        None
    };
    let lowered = match lowered {
        Ok(lowered) => lowered,
        Err(error) => return fail(&error),
    };
    let mut quantity = Quantity { value: lowered.constant().unwrap_or(f64::NAN), kind: lowered.kind };
    if !quantity.value.is_finite() {
        let span = lowered.not_finite.unwrap_or(whole);
        return fail(&ExpressionError::new("the expression gives no finite number", span));
    }
    // An override or a guess keeps the dimension that the file declares.
    if let (true, Some(Quantity { kind: Kind::Of(wanted), .. })) = (definition.replaced, before) {
        if !quantity.kind.fits(&wanted) {
            let message = format!("expected {wanted}, found {}", quantity.kind.dimension());
            let hint = format!("the file declares `{}` as {wanted}", definition.name);
            return fail(&ExpressionError::new(message, whole).with_hint(hint));
        }
        quantity.kind = Kind::Of(wanted);
    }
    Some(quantity)
}
