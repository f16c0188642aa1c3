//! Events and stops of a trace: where a result has a value, and the n-th of what is met.

use super::{Built, Results, slot};
use crate::context::{Context, Read, Reported};
use crate::tree::{Node, Value};
use flexura_expression::{Binding, Expression, Kind, nearest};
use flexura_model::{Model, Output, Quantity, Stop, Target};

const EXAMPLE: &str = "for example \"output.w = 10 mm\" or \"joint.way.effort = 0\"";
const WORDS: [&str; 3] = ["fold", "branch", "event"];

/// Reads `output.w = 10 mm`, which stands in `node`. Its parameters stay open, so that it is the same event at every value
/// of them; a value on the right that hangs on parameters is brought to the left.
pub(in crate::build) fn event(
    context: &Context<'_>,
    node: &Node,
    path: &str,
    model: &Model,
    outputs: &[Built],
) -> Read<Target> {
    let Value::Text(text) = &node.value else {
        let message = format!("expected an event, found {}", node.kind());
        return Err(context.wrong_with_hint(&node.span, path, message, EXAMPLE));
    };
    let signs: Vec<usize> = text.match_indices('=').map(|(i, _)| i).collect();
    let [sign] = signs[..] else {
        let message = match signs.len() {
            0 => "an event says where a result has a value, but there is no equals sign".to_string(),
            count => format!("an event is one equation, but there are {count} equals signs"),
        };
        return Err(context.wrong_with_hint(&node.span, path, message, EXAMPLE));
    };
    let [left, right] = [part(context, node, 0, sign), part(context, node, sign + 1, text.len())];
    check_right(context, &right, path, text)?;
    let results = Results { context, model, outputs: Some(outputs), is_live: true, may_be_infinite: false };
    let (Value::Text(left_text), Value::Text(right_text)) = (&left.value, &right.value) else {
        return Err(Reported);
    };
    if let Some(word) = WORDS.iter().find(|word| **word == left_text) {
        let message = format!("`{word}` is no result");
        let hint = format!("to stop at the second one, write \"{word} 2\"");
        return Err(context.wrong_with_hint(&left.span, path, message, hint));
    }
    let built = results.read(&left, path, left_text, text.trim().to_string());
    let value = results.read(&right, path, right_text, String::new());
    let (built, value) = (built?, value?);
    if built.output.formulas.len() > 1 {
        let message = "an event is about a single number, but this is a vector";
        let hint = format!("name a component, for example \"{left_text}.x = 0\"");
        return Err(context.wrong_with_hint(&left.span, path, message, hint));
    }
    if built.output.probes.iter().all(|probe| probe.quantity == Quantity::Parameter) {
        let message = "an event must refer to a result, or it never happens";
        return Err(context.wrong_with_hint(&left.span, path, message, results.roots()));
    }
    if built.kind != Kind::Plain && !value.kind.fits(&built.kind.dimension()) {
        let message = format!("expected {}, found {}", built.kind.dimension(), value.kind.dimension());
        let hint = "the value has the dimension of the result";
        return Err(context.wrong_with_hint(&right.span, path, message, hint));
    }
    if !value.output.probes.is_empty() {
        return Ok(Target { output: difference(built, &value)?, value: 0.0 });
    }
    let value = value.output.formulas.first().map_or(f64::NAN, |formula| formula.evaluate(&[]));
    if !value.is_finite() {
        return Err(context.wrong(&right.span, path, "must be a finite number"));
    }
    Ok(Target { output: built.output, value })
}

/// What is on the left less what is on the right, where that hangs on parameters.
fn difference(left: Built, right: &Built) -> Read<Output> {
    let mut output = left.output;
    let slots: Vec<usize> =
        right.output.probes.iter().map(|probe| slot(&mut output.probes, *probe)).collect();
    let sides = [output.formulas.pop(), right.output.formulas.first().map(|formula| formula.renamed(&slots))];
    let [Some(left), Some(right)] = sides else { return Err(Reported) };
    let difference = Expression::parse("left - right").and_then(|expression| {
        // Their dimensions were compared before.
        expression.lower(&mut |reference| {
            let side = if reference.name() == Some("left") { &left } else { &right };
            Ok(Binding::Formula(side.clone(), Kind::Plain))
        })
    });
    output.formulas.push(difference.map_err(|_| Reported)?.formula());
    Ok(output)
}

/// Reads an event, or `fold 2`.
pub(in crate::build) fn stop(
    context: &Context<'_>,
    node: &Node,
    path: &str,
    model: &Model,
    outputs: &[Built],
) -> Read<Stop> {
    let hint = "a stop is \"fold\", \"fold 2\", \"branch 1\", \"event 3\", or an equation such as \"output.w = 10 mm\"";
    let Value::Text(text) = &node.value else {
        let message = format!("expected a stop, found {}", node.kind());
        return Err(context.wrong_with_hint(&node.span, path, message, hint));
    };
    if text.contains('=') {
        return event(context, node, path, model, outputs).map(Stop::Value);
    }
    let wrong = |message: String, hint: &str| Err(context.wrong_with_hint(&node.span, path, message, hint));
    let words: Vec<&str> = text.split_whitespace().collect();
    let (word, number) = match words[..] {
        [word] => (word, 1),
        [word, number] => match number.parse::<usize>() {
            Ok(number) => (word, number),
            Err(_) => return wrong(format!("`{number}` is no whole number"), hint),
        },
        _ => return wrong("this is no stop".to_string(), hint),
    };
    match word {
        "fold" => Ok(Stop::Fold(number)),
        "branch" => Ok(Stop::Branch(number)),
        "event" => Ok(Stop::Event(number)),
        _ => match nearest(word, WORDS) {
            Some(near) => wrong(format!("there is no stop `{word}`"), &format!("did you mean `{near}`?")),
            None => wrong(format!("there is no stop `{word}`"), hint),
        },
    }
}

/// A part of a text as a node of its own, blanks around it left out.
fn part(context: &Context<'_>, node: &Node, from: usize, to: usize) -> Node {
    let Value::Text(text) = &node.value else { return node.clone() };
    let whole = &text[from..to];
    let start = from + whole.len() - whole.trim_start().len();
    let part = whole.trim();
    // Of nothing, the place of the equals sign is shown.
    let range = if part.is_empty() { from.min(to)..from.min(to) } else { start..start + part.len() };
    Node { value: Value::Text(part.to_string()), span: context.inner(node, &range) }
}

/// The value on the right must be known beforehand.
fn check_right(context: &Context<'_>, right: &Node, path: &str, whole: &str) -> Read<()> {
    let Value::Text(text) = &right.value else { return Ok(()) };
    let parsed = Expression::parse(text);
    let is_result = parsed.is_ok_and(|value| value.references().iter().any(|r| r.segments.len() > 1));
    if !is_result {
        return Ok(());
    }
    let message = "results stand on the left of an event, its value on the right";
    let (left, _) = whole.split_once('=').unwrap_or((whole, ""));
    let hint = format!("bring it to the other side: \"{} - ({text}) = 0\"", left.trim());
    Err(context.wrong_with_hint(&right.span, path, message, hint))
}
