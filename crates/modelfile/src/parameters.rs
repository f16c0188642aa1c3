//! Parameters: named numbers that may refer to each other in any order, and be overridden.

use crate::context::{Context, Parameters, suggest};
use crate::report::{Problem, Source};
use crate::tree::{Entry, Node, Value};
use flexura_expression::{Expression, ExpressionError, Kind, Quantity, reserved};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Where a parameter's value is written.
enum Text<'a> {
    File(&'a Node),
    Override { source: Arc<Source>, offset: usize },
}

struct Definition<'a> {
    name: &'a str,
    text: Text<'a>,
    expression: Option<Expression>,
    /// Positions of the parameters it refers to, with where.
    needs: Vec<(usize, Range<usize>)>,
}

/// Evaluates all parameters, first as declared, then with the overrides. What is wrong is recorded.
pub(crate) fn evaluate(context: &mut Context<'_>, entries: &[Entry], overrides: &[(String, String)]) {
    for entry in entries {
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
            context.wrong(&entry.key_span, &path, message);
        }
    }
    let declared = solve(context, entries, &BTreeMap::new(), None);
    if overrides.is_empty() || context.any_problem() {
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
    context.parameters = solve(context, entries, &replaced, Some(&declared));
}

fn solve(
    context: &Context<'_>,
    entries: &[Entry],
    replaced: &BTreeMap<&str, Arc<Source>>,
    declared: Option<&Parameters>,
) -> Parameters {
    let positions: BTreeMap<&str, usize> =
        entries.iter().enumerate().map(|(i, entry)| (entry.key.as_str(), i)).collect();
    let mut definitions: Vec<Definition<'_>> = entries
        .iter()
        .map(|entry| {
            let text = match replaced.get(entry.key.as_str()) {
                Some(source) => Text::Override { source: source.clone(), offset: entry.key.len() + 1 },
                None => Text::File(&entry.node),
            };
            Definition { name: &entry.key, text, expression: None, needs: Vec::new() }
        })
        .collect();
    let mut values: Parameters = Parameters::new();
    for definition in &mut definitions {
        let text = match &definition.text {
            Text::File(node) => match &node.value {
                Value::Text(text) => text.as_str(),
                Value::Number(_) => continue,
                _ => {
                    let path = format!("parameter.{}", definition.name);
                    let message = format!("expected a number or an expression, found {}", node.kind());
                    context.wrong_with_hint(
                        &node.span,
                        &path,
                        message,
                        format!("for example `{} = \"3 N\"`", definition.name),
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
    let path = format!("parameter.{}", definition.name);
    match &definition.text {
        Text::File(node) => {
            context.expression_error(node, &path, error);
        }
        Text::Override { source, offset } => {
            let mut problem = Problem::at(
                source,
                offset + error.span.start..offset + error.span.end,
                &path,
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
    names: &[Entry],
) -> Option<Quantity> {
    let Some(expression) = &definition.expression else {
        let Text::File(node) = &definition.text else { return None };
        return context.quantity(node, &format!("parameter.{}", definition.name), false).ok().flatten();
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
                let names: Vec<&str> = names.iter().map(|entry| entry.key.as_str()).collect();
                Err(ExpressionError::new(format!("there is no parameter `{name}`"), reference.span.clone())
                    .with_hint(suggest(name, &names, "parameter")))
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
    // An override keeps the dimension that the file declares.
    let before = declared.and_then(|declared| declared.get(definition.name)).copied().flatten();
    if let (Text::Override { .. }, Some(Quantity { kind: Kind::Of(wanted), .. })) = (&definition.text, before)
    {
        if !quantity.kind.fits(&wanted) {
            let message = format!("expected {wanted}, found {}", quantity.kind.dimension());
            let hint = format!("the file declares `{}` as {wanted}", definition.name);
            return fail(&ExpressionError::new(message, whole).with_hint(hint));
        }
        quantity.kind = Kind::Of(wanted);
    }
    Some(quantity)
}
