//! The law of a motion in time.

use super::study::{Parameter, number, parameter, value};
use crate::context::{Needed, Read, Reported};
use crate::reader::Reader;
use crate::tree::{Node, Value};
use flexura_expression::{Dimension, Function, Kind};
use flexura_model::{InverseDynamicsStudy, Model, MotionLaw, Pace, Sampling, Until};

/// At how many times a motion is looked at.
const SAMPLES: usize = 101;
/// The keys that are a law each.
const LAWS: [&str; 4] = ["trapezoid", "knots", "value", "rate"];
/// The variable of a law.
const TIME: &str = "t";

pub(super) fn inverse_dynamics(reader: &Reader<'_, '_>, model: &Model) -> Read<InverseDynamicsStudy> {
    let parameter = parameter(reader, model).needed();
    let known = parameter.as_ref().ok();
    let own = known.and_then(|parameter| model.parameters.get(parameter.position)).map(|p| p.value);
    let law = law(reader, known, own);
    let sampling = sampling(reader);
    Ok(InverseDynamicsStudy { parameter: parameter?.position, law: law?, sampling: sampling? })
}

fn law(reader: &Reader<'_, '_>, parameter: Option<&Parameter>, own: Option<f64>) -> Read<MotionLaw> {
    let given: Vec<&str> = LAWS.into_iter().filter(|key| reader.has(key)).collect();
    let law = match given[..] {
        [only] => only,
        [] => {
            return Err(reader.wrong_with_hint(
                "how the parameter moves in time is missing",
                "give one of `trapezoid`, `knots`, `value` and `rate`, for example `rate = \"80 deg/s\"`",
            ));
        }
        [first, second, ..] => {
            let message = format!("`{first}` and `{second}` are two laws of one motion");
            return Err(reader.wrong_at(second, message, "keep one of them"));
        }
    };
    let idle: &[&str] = match law {
        "rate" => &[],
        "value" => &["from", "to"],
        _ => &["from", "to", "duration"],
    };
    let mut kept = Ok(());
    for key in idle.iter().filter(|key| reader.has(key)) {
        let hint = match law {
            "trapezoid" => format!("write it into the table: `trapezoid = {{ ..., {key} = ... }}`"),
            _ => format!("`{law}` says it all: leave `{key}` out"),
        };
        kept = Err(reader.wrong_at(key, format!("`{key}` does not go with `{law}`"), hint));
    }
    let law = match law {
        "trapezoid" => trapezoid(reader, parameter, own),
        "knots" => knots(reader, parameter).map(MotionLaw::Knots),
        "value" => function(reader, parameter),
        _ => constant(reader, parameter, own),
    };
    kept.and(law)
}

fn trapezoid(reader: &Reader<'_, '_>, parameter: Option<&Parameter>, own: Option<f64>) -> Read<MotionLaw> {
    let table = reader.table("trapezoid").needed()?;
    let from = number(&table, "from", parameter);
    let to = number(&table, "to", parameter).needed();
    let ramp = table.number("ramp").needed();
    let pace = match (table.has("speed"), table.has("duration")) {
        (true, false) => rate(&table, "speed", parameter).needed().map(Pace::Speed),
        (false, true) => table.number("duration").needed().map(Pace::Duration),
        (false, false) => Err(table.wrong_with_hint(
            "the key `speed` (or `duration`) is missing",
            "for example `speed = \"80 deg/s\"`",
        )),
        (true, true) => {
            Err(table.wrong_at("duration", "give `speed` or `duration`, not both", "remove one of the two"))
        }
    };
    let (from, to, ramp) = (from?, to?, ramp?);
    Ok(MotionLaw::Trapezoid { from: from.or(own).ok_or(Reported)?, to, pace: pace?, ramp })
}

fn constant(reader: &Reader<'_, '_>, parameter: Option<&Parameter>, own: Option<f64>) -> Read<MotionLaw> {
    let rate = rate(reader, "rate", parameter).needed();
    let from = number(reader, "from", parameter);
    let until = match (reader.has("to"), reader.has("duration")) {
        (true, false) => number(reader, "to", parameter).needed().map(Until::Value),
        (false, true) => reader.number("duration").needed().map(Until::Duration),
        (false, false) => Err(reader.wrong_with_hint(
            "where the motion ends is missing",
            "give `to`, the last value, or `duration`, for example `duration = \"2 s\"`",
        )),
        (true, true) => {
            Err(reader.wrong_at("duration", "give `to` or `duration`, not both", "remove one of the two"))
        }
    };
    let (rate, from) = (rate?, from?);
    Ok(MotionLaw::Constant { from: from.or(own).ok_or(Reported)?, rate, until: until? })
}

fn function(reader: &Reader<'_, '_>, parameter: Option<&Parameter>) -> Read<MotionLaw> {
    let value = value_of_time(reader, parameter);
    let duration = if reader.has("duration") {
        reader.number("duration").needed()
    } else {
        Err(reader.missing_key("duration"))
    };
    Ok(MotionLaw::Function { value: value?, duration: duration? })
}

/// The expression of t behind `value`.
fn value_of_time(reader: &Reader<'_, '_>, parameter: Option<&Parameter>) -> Read<Function> {
    let context = reader.context;
    if context.parameters.contains_key(TIME) {
        let message = format!("`{TIME}` is the time of the motion and a parameter of the model");
        return Err(reader.wrong_at("value", message, "give the model's parameter another name"));
    }
    let (entry, _) = reader.entry("value").ok_or(Reported)?;
    let path = reader.key_path("value");
    let dimension = match parameter {
        Some(Parameter { kind: Kind::Of(dimension), .. }) => *dimension,
        // A parameter declared without a unit takes any.
        _ => match &entry.node.value {
            Value::Text(text) => {
                let kind = Kind::Of(Dimension::TIME);
                context.lower_either(&entry.node, &path, text, TIME, kind)?.kind.dimension()
            }
            _ => Dimension::NUMBER,
        },
    };
    reader.function_in(&entry.node, &path, &dimension, TIME, Kind::Of(Dimension::TIME))
}

/// Rows of a time and a value.
fn knots(reader: &Reader<'_, '_>, parameter: Option<&Parameter>) -> Read<Vec<[f64; 2]>> {
    let context = reader.context;
    let (entry, key) = reader.entry("knots").ok_or(Reported)?;
    let path = reader.key_path("knots");
    let hint = || format!("for example `knots = {}`", key.example);
    let Value::List(rows) = &entry.node.value else {
        let message = format!("expected a list of knots, found {}", entry.node.kind());
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint()));
    };
    let read = |i: usize, row: &Node| {
        let path = format!("{path}[{i}]");
        let Value::List(pair) = &row.value else {
            let message = format!("expected a time and a value, found {}", row.kind());
            return Err(context.wrong_with_hint(&row.span, &path, message, hint()));
        };
        let [time, at] = &pair[..] else {
            let message = format!("a knot is a time and a value, found {} numbers", pair.len());
            return Err(context.wrong_with_hint(&row.span, &path, message, hint()));
        };
        let time = time_of(reader, time, &format!("{path}[0]"));
        let at = value(reader, at, &format!("{path}[1]"), parameter);
        Ok([time?, at?])
    };
    // All of them, so that every mistake is told.
    let all: Vec<Read<[f64; 2]>> = rows.iter().enumerate().map(|(i, row)| read(i, row)).collect();
    all.into_iter().collect()
}

fn time_of(reader: &Reader<'_, '_>, node: &Node, path: &str) -> Read<f64> {
    let context = reader.context;
    let Some(quantity) = context.quantity(node, path, false)? else {
        let message = format!("expected {}, found {}", Dimension::TIME, node.kind());
        return Err(context.wrong(&node.span, path, message));
    };
    if !quantity.kind.fits(&Dimension::TIME) {
        let message = format!("expected {}, found {}", Dimension::TIME, quantity.kind.dimension());
        return Err(context.wrong_with_hint(&node.span, path, message, "a knot is a time and a value"));
    }
    Ok(quantity.value)
}

/// A value of the parameter per second.
fn rate(reader: &Reader<'_, '_>, name: &str, parameter: Option<&Parameter>) -> Read<Option<f64>> {
    let context = reader.context;
    let Some((entry, key)) = reader.entry(name) else { return Ok(None) };
    let path = reader.key_path(name);
    let Some(quantity) = context.quantity(&entry.node, &path, false)? else {
        let message = format!("expected a number, found {}", entry.node.kind());
        let hint = format!("for example `{name} = {}`", key.example);
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
    };
    if let Some(Parameter { name, kind: Kind::Of(dimension), .. }) = parameter {
        let wanted = dimension.over(&Dimension::TIME);
        if !quantity.kind.fits(&wanted) {
            let message = format!("expected {wanted}, found {}", quantity.kind.dimension());
            let hint = format!("the parameter `{name}` is {dimension}, and its rate is per second");
            return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
        }
    }
    Ok(Some(quantity.value))
}

fn sampling(reader: &Reader<'_, '_>) -> Read<Sampling> {
    match (reader.count("samples")?, reader.number("step")?) {
        (Some(_), Some(_)) => {
            Err(reader.wrong_at("step", "give `samples` or `step`, not both", "remove one of the two"))
        }
        (_, Some(step)) => Ok(Sampling::Step(step)),
        (count, None) => Ok(Sampling::Count(count.unwrap_or(SAMPLES))),
    }
}
