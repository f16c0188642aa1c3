//! Studies of the kind `optimise`.

use super::result::{Built, reading};
use super::study::{Parameter, number, range};
use crate::context::{Context, Needed, Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::{Entry, Node, Value};
use flexura_expression::{Expression, Kind};
use flexura_model::{
    Condition, Front, Model, OptimiseStudy, Optimiser, Reading, Study, StudyKind, TraceStudy, Varied, Wanted,
    Where,
};

/// What a reader of such a study looks up.
pub(super) struct Known<'k> {
    pub model: &'k Model,
    pub outputs: &'k [Built],
    /// The studies that were read so far, among them all traces.
    pub studies: &'k [Study],
}

/// Reads the study.
pub(super) fn optimise(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<OptimiseStudy> {
    let vary = vary(reader, known.model);
    let objective = objective(reader, known);
    let conditions = conditions(reader, known, vary.as_deref().unwrap_or_default());
    let stable = reader.flag("stable");
    let starts = reader.count("starts");
    let seed = reader.count("seed");
    let method = reader.choice("method");
    let front = front(reader, known);
    let tolerance = reader.number("tolerance");
    let most_iterations = reader.count("most_iterations");
    let default = OptimiseStudy::default();
    let (objective, maximise) = objective?;
    Ok(OptimiseStudy {
        objective,
        maximise,
        vary: vary?,
        conditions: conditions?,
        stable: stable?.unwrap_or(default.stable),
        starts: starts?.unwrap_or(default.starts),
        seed: seed?.map_or(default.seed, |seed| seed as u64),
        method: if method? == Some("cma_es") { Optimiser::CmaEs } else { Optimiser::Sqp },
        front: front?,
        tolerance: tolerance?.unwrap_or(default.tolerance),
        most_iterations: most_iterations?.unwrap_or(default.most_iterations),
    })
}

fn vary(reader: &Reader<'_, '_>, model: &Model) -> Read<Vec<Varied>> {
    let Some((entry, key)) = reader.entry("vary") else { return Err(Reported) };
    let Some(table) = key.shape.table() else { return Err(Reported) };
    let path = reader.key_path("vary");
    if !matches!(entry.node.value, Value::Table(_)) {
        let message = format!("expected a table, found {}", entry.node.kind());
        let hint = format!("for example `vary = {}`", key.example);
        return Err(reader.context.wrong_with_hint(&entry.node.span, &path, message, hint));
    }
    let one = |entry: &Entry| {
        let path = format!("{path}.{}", entry.key);
        let parameter = named(reader.context, entry, &path, model)?;
        let inner = Reader::open(reader.context, entry, table, &path)?;
        let range = range(&inner, Some(&parameter)).needed();
        let guess = number(&inner, "guess", Some(&parameter));
        let [low, high] = range?;
        let own = model.parameters[parameter.position].value;
        let usual = if (low..=high).contains(&own) { own } else { 0.5 * (low + high) };
        Ok(Varied { parameter: parameter.position, range: [low, high], guess: guess?.unwrap_or(usual) })
    };
    let all: Vec<Read<Varied>> = entry.node.entries().iter().map(one).collect();
    all.into_iter().collect()
}

/// The parameter that the key of an entry names.
fn named(context: &Context<'_>, entry: &Entry, path: &str, model: &Model) -> Read<Parameter> {
    context.mark_used("parameter", &entry.key);
    let Some(quantity) = context.parameters.get(&entry.key) else {
        let names: Vec<&str> = context.parameters.keys().map(String::as_str).collect();
        let hint = suggest(&entry.key, &names, "parameter");
        let message = format!("there is no parameter `{}`", entry.key);
        return Err(context.wrong_with_hint(&entry.key_span, path, message, hint));
    };
    let kind = quantity.ok_or(Reported)?.kind;
    let position = model.parameters.iter().position(|p| p.name == entry.key).ok_or(Reported)?;
    Ok(Parameter { position, name: entry.key.clone(), kind })
}

/// What is behind `minimise` or `maximise`, one of which there must be.
fn objective(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<(Reading, bool)> {
    let maximise = match (reader.has("minimise"), reader.has("maximise")) {
        (true, false) => false,
        (false, true) => true,
        (false, false) => {
            let hint = "write `minimise = \"model.mass\"`, or `maximise` and a result";
            return Err(reader.wrong_with_hint("there is nothing to be made least or greatest", hint));
        }
        (true, true) => {
            let message = "an objective cannot be made least and another greatest at once";
            let hint = "of two objectives, put the second into `pareto = { maximise = ... }`";
            return Err(reader.wrong_at("maximise", message, hint));
        }
    };
    let word = if maximise { "maximise" } else { "minimise" };
    let Some((entry, key)) = reader.entry(word) else { return Err(Reported) };
    let path = reader.key_path(word);
    let usual = if maximise { Wanted::Least } else { Wanted::Greatest };
    let reading = match &entry.node.value {
        Value::Table(_) => {
            let table = key.shape.table().ok_or(Reported)?;
            let inner = Reader::open(reader.context, entry, table, &path)?;
            let (built, at) = (text_of(&inner, known), place(&inner, known, usual));
            Reading { output: built?.output, at: at? }
        }
        _ => {
            let output = reading(reader.context, &entry.node, &path, known.model, known.outputs)?.output;
            Reading { output, at: Where::Equilibrium }
        }
    };
    Ok((reading, maximise))
}

fn text_of(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<Built> {
    let Some((entry, _)) = reader.entry("output") else { return Err(Reported) };
    reading(reader.context, &entry.node, &reader.key_path("output"), known.model, known.outputs)
}

/// Of which equilibrium: `over` and `point`.
fn place(reader: &Reader<'_, '_>, known: &Known<'_>, usual: Wanted) -> Read<Where> {
    let (over, point) = (reader.text("over")?, reader.text("point")?);
    let Some(name) = over else {
        if point.is_some() {
            let message = "a point of a path is named, but no path";
            return Err(reader.wrong_at("point", message, "name a study of the kind `trace` as `over`"));
        }
        return Ok(Where::Equilibrium);
    };
    let traces: Vec<(&str, &TraceStudy)> = known.studies.iter().filter_map(trace_of).collect();
    let Some((_, trace)) = traces.iter().find(|(known, _)| *known == name) else {
        let names: Vec<&str> = traces.iter().map(|(name, _)| *name).collect();
        let hint = match names[..] {
            [] => "write a table [study.NAME] with `kind = \"trace\"`".to_string(),
            _ => suggest(name, &names, "trace"),
        };
        return Err(reader.wrong_at("over", format!("there is no study `{name}` of the kind `trace`"), hint));
    };
    let point = match point {
        None => usual,
        Some(text) => wanted(text).ok_or_else(|| {
            let hint = "there are \"greatest\", \"least\" and folds by their numbers, such as \"fold 1\"";
            reader.wrong_at("point", format!("there is no point \"{text}\""), hint)
        })?,
    };
    Ok(Where::Path { study: name.to_string(), trace: Box::new((*trace).clone()), point })
}

fn trace_of(study: &Study) -> Option<(&str, &TraceStudy)> {
    match &study.kind {
        StudyKind::Trace(trace) => Some((study.name.as_str(), trace)),
        _ => None,
    }
}

fn wanted(text: &str) -> Option<Wanted> {
    match text.split_whitespace().collect::<Vec<_>>()[..] {
        ["greatest"] => Some(Wanted::Greatest),
        ["least"] => Some(Wanted::Least),
        ["fold"] => Some(Wanted::Fold(1)),
        ["fold", number] => number.parse().ok().map(Wanted::Fold),
        _ => None,
    }
}

fn conditions(reader: &Reader<'_, '_>, known: &Known<'_>, vary: &[Varied]) -> Read<Vec<Condition>> {
    let mut all = Vec::new();
    let mut failed = false;
    for table in reader.tables("constraints")? {
        match condition(&table, known, vary) {
            Ok(conditions) => all.extend(conditions),
            Err(Reported) => failed = true,
        }
    }
    if failed { Err(Reported) } else { Ok(all) }
}

/// A constraint; one that has two bounds along a path is two, at the greatest and at the least.
fn condition(reader: &Reader<'_, '_>, known: &Known<'_>, vary: &[Varied]) -> Read<Vec<Condition>> {
    let built = text_of(reader, known);
    let bound = |key: &str| bound(reader, key, built.as_ref().ok(), known.model, vary);
    let (least, most, equals) = (bound("least"), bound("most"), bound("equals"));
    let upper = place(reader, known, Wanted::Greatest);
    let (output, least, most, equals) = (built?.output, least?, most?, equals?);
    let upper = upper?;
    let one = |at, least, most, equals| Condition {
        reading: Reading { output: output.clone(), at },
        least,
        most,
        equals,
    };
    if upper == Where::Equilibrium || reader.has("point") {
        return Ok(vec![one(upper, least, most, equals)]);
    }
    let lower = place(reader, known, Wanted::Least)?;
    Ok(match (least, most, equals) {
        (Some(_), Some(_), None) => vec![one(upper, None, most, None), one(lower, least, None, None)],
        (Some(_), None, None) => vec![one(lower, least, None, None)],
        _ => vec![one(upper, least, most, equals)],
    })
}

/// A bound, which has the dimension of what it bounds and stays as it is while the design changes.
fn bound(
    reader: &Reader<'_, '_>,
    key: &str,
    built: Option<&Built>,
    model: &Model,
    vary: &[Varied],
) -> Read<Option<f64>> {
    let Some((entry, _)) = reader.entry(key) else { return Ok(None) };
    let (context, path) = (reader.context, reader.key_path(key));
    if let Some(name) = varied_in(&entry.node, model, vary) {
        let message = format!("a bound stays as it is, but `{name}` may change");
        let hint = format!("bring it to the other side: `output = \"... - {name}\"` and a number here");
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
    }
    let Some(quantity) = context.quantity(&entry.node, &path, false)? else {
        let message = format!("expected a number, found {}", entry.node.kind());
        return Err(context.wrong(&entry.node.span, &path, message));
    };
    if let Some(Built { kind, .. }) = built
        && *kind != Kind::Plain
        && !quantity.kind.fits(&kind.dimension())
    {
        let message = format!("expected {}, found {}", kind.dimension(), quantity.kind.dimension());
        let hint = "a bound has the dimension of the result";
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
    }
    Ok(Some(quantity.value))
}

/// A parameter in a formula that follows one that may change.
fn varied_in(node: &Node, model: &Model, vary: &[Varied]) -> Option<String> {
    let Value::Text(text) = &node.value else { return None };
    let expression = Expression::parse(text).ok()?;
    let names: Vec<String> =
        expression.references().iter().filter_map(|reference| reference.name().map(str::to_string)).collect();
    let is_varied = |name: &String| {
        let position = model.parameters.iter().position(|parameter| parameter.name == *name);
        vary.iter().any(|varied| Some(varied.parameter) == position)
    };
    names.into_iter().find(is_varied)
}

fn front(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<Option<Front>> {
    let Some(table) = reader.table("pareto")? else { return Ok(None) };
    let other = objective(&table, known);
    let points = table.count("points");
    let (other, maximise) = other?;
    Ok(Some(Front { other, maximise, points: points?.unwrap_or(11) }))
}
