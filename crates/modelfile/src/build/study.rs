//! Studies: what is to be done with the mechanism.

use super::design::{self, Known};
use super::result::{Built, event, live_outputs, stop};
use super::{fit, formula, motion, name, named_entries, table_of};
use crate::context::{Context, Needed, Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::{Entry, Node, Value};
use flexura_expression::Kind;
use flexura_model::{BuckleStudy, CriticalStudy, Model, ModesPath, ModesStudy, Study, StudyKind, TraceStudy};

/// How many branches `branches = true` stands for.
const BRANCHES: usize = 20;

/// Reads the studies.
pub(super) fn studies(context: &Context<'_>, model: &Model, outputs: &[Built]) -> Vec<Study> {
    let entries = named_entries(context, "study");
    if entries.is_empty() {
        return Vec::new();
    }
    let outputs = live_outputs(context, model, outputs);
    // Others may refer to a path.
    let (paths, rest): (Vec<&Entry>, Vec<&Entry>) = entries.iter().partition(|entry| is_trace(entry));
    let mut studies = Vec::new();
    for entry in paths.into_iter().chain(rest) {
        name(context, "study", entry);
        studies.extend(study(context, entry, &Known { model, outputs: &outputs, studies: &studies }).ok());
    }
    let place = |study: &Study| entries.iter().position(|entry| entry.key == study.name);
    studies.sort_by_key(place);
    studies
}

fn is_trace(entry: &Entry) -> bool {
    let kind = entry.node.get("kind").map(|kind| &kind.node.value);
    matches!(kind, Some(Value::Text(text)) if text == "trace")
}

fn study(context: &Context<'_>, entry: &Entry, known: &Known<'_>) -> Read<Study> {
    let Known { model, outputs, .. } = *known;
    let path = format!("study.{}", entry.key);
    let reader = Reader::open(context, entry, table_of("study").ok_or(Reported)?, &path)?;
    let kind = match reader.variant {
        "trace" => StudyKind::Trace(trace(&reader, model, outputs)?),
        "buckle" => StudyKind::Buckle(buckle(&reader, model)?),
        "modes" => StudyKind::Modes(modes(&reader, model)?),
        "inverse_dynamics" => StudyKind::InverseDynamics(motion::inverse_dynamics(&reader, model)?),
        "fit" => StudyKind::Fit(fit::fit(&reader, model, outputs)?),
        "formula" => {
            let traces: Vec<(&str, bool)> = known
                .studies
                .iter()
                .map(|study| (study.name.as_str(), matches!(study.kind, StudyKind::Trace(_))))
                .collect();
            StudyKind::Formula(formula::formula(&reader, model, outputs, &traces)?)
        }
        "optimise" => StudyKind::Optimise(design::optimise(&reader, known)?),
        _ => StudyKind::Solve,
    };
    Ok(Study { name: entry.key.clone(), kind })
}

fn trace(reader: &Reader<'_, '_>, model: &Model, outputs: &[Built]) -> Read<TraceStudy> {
    let context = reader.context;
    let parameter = parameter(reader, model).needed();
    let known = parameter.as_ref().ok();
    let range = range(reader, known).needed();
    let start = number(reader, "start", known);
    let steps = reader.count("steps");
    let most_points = reader.count("most_points");
    let branches = reader.flag_or_count("branches", BRANCHES);
    let events = each_text(reader, "event", |node, path| event(context, node, path, model, outputs));
    let stops = each_text(reader, "stop", |node, path| stop(context, node, path, model, outputs));
    let guesses = reader.count("guesses");
    let imperfection = imperfection(reader, model);
    let critical = critical(reader, model);
    let default = TraceStudy::default();
    let (parameter, range) = (parameter?, range?);
    Ok(TraceStudy {
        parameter: parameter.position,
        range,
        start: start?.unwrap_or(range[0]),
        steps: steps?.unwrap_or(default.steps),
        most_points: most_points?.unwrap_or(default.most_points),
        branches: branches?.unwrap_or(default.branches),
        events: events?,
        stops: stops?,
        guesses: guesses?.unwrap_or(default.guesses),
        imperfection: imperfection?,
        critical: critical?,
    })
}

fn buckle(reader: &Reader<'_, '_>, model: &Model) -> Read<BuckleStudy> {
    // A fraction of the load is a plain number.
    let fraction =
        Parameter { position: 0, name: String::new(), kind: Kind::Of(flexura_expression::Dimension::NUMBER) };
    let parameter = parameter(reader, model);
    let at = match &parameter {
        Ok(parameter) => number(reader, "at", Some(parameter.as_ref().unwrap_or(&fraction))),
        Err(Reported) => Err(Reported),
    };
    let count = reader.count("count");
    Ok(BuckleStudy {
        parameter: parameter?.map(|parameter| parameter.position),
        at: at?.unwrap_or(0.0),
        count: count?.unwrap_or(3),
    })
}

fn modes(reader: &Reader<'_, '_>, model: &Model) -> Read<ModesStudy> {
    let parameter = parameter(reader, model)?;
    let range = range(reader, parameter.as_ref());
    let (count, at_rest, steps) = (reader.count("count"), reader.flag("at_rest"), reader.count("steps"));
    let path = match (parameter, range?) {
        (Some(parameter), Some(range)) => {
            let steps = steps?.unwrap_or(TraceStudy::default().steps);
            Some(ModesPath { parameter: parameter.position, range, steps })
        }
        (None, None) if steps?.is_none() => None,
        (None, None) => {
            return Err(reader.wrong_at("steps", "steps of no path", "give `parameter` and `range`, too"));
        }
        (Some(_), None) => {
            let hint = "give the `range` along which it changes, or its value in [parameter]";
            return Err(reader.wrong_at("parameter", "a path needs a range", hint));
        }
        (None, Some(_)) => {
            let hint = "give the `parameter` that changes";
            return Err(reader.wrong_at("range", "a path needs a parameter", hint));
        }
    };
    let standard = ModesStudy::default();
    Ok(ModesStudy { count: count?.unwrap_or(standard.count), at_rest: at_rest?.unwrap_or(false), path })
}

fn imperfection(reader: &Reader<'_, '_>, model: &Model) -> Read<Option<(usize, f64)>> {
    let Some(table) = reader.table("imperfection")? else { return Ok(None) };
    let parameter = parameter(&table, model).needed();
    let from = number(&table, "from", parameter.as_ref().ok()).needed();
    Ok(Some((parameter?.position, from?)))
}

fn critical(reader: &Reader<'_, '_>, model: &Model) -> Read<Option<CriticalStudy>> {
    let Some(table) = reader.table("critical")? else { return Ok(None) };
    let parameter = parameter(&table, model).needed();
    let range = range(&table, parameter.as_ref().ok()).needed();
    let number = table.count("number");
    Ok(Some(CriticalStudy { parameter: parameter?.position, range: range?, number: number?.unwrap_or(1) }))
}

/// A parameter that a study names.
pub(super) struct Parameter {
    pub position: usize,
    pub name: String,
    pub kind: Kind,
}

/// The parameter behind the key `parameter`.
pub(super) fn parameter(reader: &Reader<'_, '_>, model: &Model) -> Read<Option<Parameter>> {
    let context = reader.context;
    let Some(name) = reader.text("parameter")? else { return Ok(None) };
    let Some(quantity) = context.parameters.get(name) else {
        let names: Vec<&str> = context.parameters.keys().map(String::as_str).collect();
        let hint = suggest(name, &names, "parameter");
        return Err(reader.wrong_at("parameter", format!("there is no parameter `{name}`"), hint));
    };
    let kind = quantity.ok_or(Reported)?.kind;
    let position = model.parameters.iter().position(|parameter| parameter.name == name).ok_or(Reported)?;
    Ok(Some(Parameter { position, name: name.to_string(), kind }))
}

/// A value of the parameter; None for it: it is not known, and any value will do.
pub(super) fn value(
    reader: &Reader<'_, '_>,
    node: &Node,
    path: &str,
    parameter: Option<&Parameter>,
) -> Read<f64> {
    let context = reader.context;
    let Some(quantity) = context.quantity(node, path, false)? else {
        let message = format!("expected a number, found {}", node.kind());
        return Err(context.wrong(&node.span, path, message));
    };
    // A parameter declared without a unit takes any, as an override of it does.
    if let Some(Parameter { name, kind: Kind::Of(wanted), .. }) = parameter
        && !quantity.kind.fits(wanted)
    {
        let message = format!("expected {wanted}, found {}", quantity.kind.dimension());
        let hint = if name.is_empty() {
            "without a `parameter` it is a fraction of the load".to_string()
        } else {
            format!("the parameter `{name}` is {wanted}")
        };
        return Err(context.wrong_with_hint(&node.span, path, message, hint));
    }
    Ok(quantity.value)
}

pub(super) fn number(reader: &Reader<'_, '_>, key: &str, parameter: Option<&Parameter>) -> Read<Option<f64>> {
    let Some((entry, _)) = reader.entry(key) else { return Ok(None) };
    value(reader, &entry.node, &reader.key_path(key), parameter).map(Some)
}

pub(super) fn range(reader: &Reader<'_, '_>, parameter: Option<&Parameter>) -> Read<Option<[f64; 2]>> {
    let Some((entry, key)) = reader.entry("range") else { return Ok(None) };
    let path = reader.key_path("range");
    let list = reader.list_of(&entry.node, &path, key, 2)?;
    let [from, to] = [0, 1].map(|i| value(reader, &list[i], &format!("{path}[{i}]"), parameter));
    Ok(Some([from?, to?]))
}

/// What is read from a text, or from each text of a list.
fn each_text<T>(reader: &Reader<'_, '_>, key: &str, read: impl Fn(&Node, &str) -> Read<T>) -> Read<Vec<T>> {
    let Some((entry, _)) = reader.entry(key) else { return Ok(Vec::new()) };
    let path = reader.key_path(key);
    let Value::List(list) = &entry.node.value else { return read(&entry.node, &path).map(|one| vec![one]) };
    // All of them, so that every mistake is told.
    let all: Vec<Read<T>> =
        list.iter().enumerate().map(|(i, node)| read(node, &format!("{path}[{i}]"))).collect();
    all.into_iter().collect()
}
