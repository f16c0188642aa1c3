//! Tables to the model, one file for each group of tables.

mod beam;
mod body;
mod cable;
mod contact;
mod coupling;
mod curve;
mod design;
mod fit;
mod formula;
mod foundation;
mod joint;
mod load;
mod material;
mod measurements;
mod motion;
mod place;
mod result;
mod spring;
mod study;
mod surface;
mod tubes;
mod unknown;

pub(crate) use result::name_of;

use crate::context::{Context, Needed, Read};
use crate::format::{FILE, Key, Shape, Table};
use crate::parameters;
use crate::reader::Reader;
use crate::report::Problem;
use crate::tree::{Entry, Node, Value};
use flexura_model::{Model, Parameter, Spin, name_problem};
use flexura_spatial::Vector3;
use std::collections::BTreeSet;

/// Evaluates the parameters, on which everything else may depend.
pub(crate) fn parameters(context: &mut Context<'_>, overrides: &[(String, String)]) {
    for word in ["parameter", "unknown"] {
        named_entries(context, word);
    }
    parameters::evaluate(context, overrides);
}

fn spin(table: &Reader<'_, '_>) -> Read<Spin> {
    let axis = table.direction("axis").needed();
    let rate = table.number("rate").needed();
    let through = table.vector("through");
    Ok(Spin { axis: axis?, rate: rate?, through: through?.unwrap_or_else(Vector3::zeros) })
}

/// Reads the whole file. None: something is wrong, which has been recorded.
pub(crate) fn model(context: &Context<'_>) -> Option<Model> {
    let root = context.root;
    let file = Reader::open_node(context, root, &(0..0), &FILE, "").ok()?;
    let mut model = Model {
        name: file.text("name").ok().flatten().unwrap_or_default().to_string(),
        gravity: file.vector("gravity").ok().flatten().unwrap_or_else(Vector3::zeros),
        mass_damping: file.number("mass_damping").ok().flatten().unwrap_or(0.0),
        spin: file.table("spin").ok().flatten().and_then(|table| spin(&table).ok()),
        ..Model::default()
    };
    for declared in parameters::declared(root) {
        if let Some(Some(quantity)) = context.parameters.get(declared.name) {
            model.parameters.push(Parameter {
                name: declared.name.to_string(),
                value: quantity.value,
                unit: quantity.kind.dimension().unit(),
                ..Parameter::default()
            });
        }
    }
    model.materials = each(context, "material", material::material);
    model.sections = each(context, "section", material::section);
    model.bodies = each(context, "body", body::body);
    model.beams = each(context, "beam", beam::beam);
    material::check_stretch(context, &model);
    model.joints = each(context, "joint", joint::joint);
    let couplings = each(context, "coupling", |reader, name| coupling::coupling(reader, name, &model.joints));
    model.couplings = couplings;
    model.springs = each(context, "spring", spring::spring);
    model.cables = each(context, "cable", cable::cable);
    model.tubes = each(context, "tubes", tubes::tubes);
    model.masses = each(context, "mass", load::mass);
    model.loads = each(context, "load", load::load);
    let mut outputs = Vec::new();
    for entry in named_entries(context, "output") {
        name(context, "output", entry);
        if let Ok(output) = result::output(context, entry, &model) {
            outputs.push(output);
        }
    }
    model.unknowns = unknown::unknowns(context, &model);
    // With their parameters open, so that models which differ by a parameter alone have the same outputs.
    let live = result::live_outputs(context, &model, &outputs);
    model.targets = result::targets(context, named_entries(context, "target"), &model, &live);
    model.outputs = live.into_iter().map(|built| built.output).collect();
    model.studies = study::studies(context, &model, &outputs);
    if !context.any_problem() {
        unknown::check_count(context, &model);
    }
    if context.any_problem() {
        return None;
    }
    // Before the checks, which ask what depends on what.
    context.rules.hand_over(&mut model);
    for issue in model.validate() {
        if context.is_full() {
            break;
        }
        if is_aside(context, &model, &issue.path) {
            continue;
        }
        let span = root.locate(&issue.path).unwrap_or(0..0);
        let mut problem = context.problem(&span, &issue.path, issue.message);
        problem.hint = issue.hint;
        context.record(problem);
    }
    if context.any_problem() {
        return None;
    }
    Some(model)
}

/// Is something wrong only with a study that is not the one to be done? With other values of parameters than the file's, or beside a
/// study that was typed, a study of the file need not make sense; where it is done after all, it is looked at again.
fn is_aside(context: &Context<'_>, model: &Model, path: &str) -> bool {
    let Some(rest) = path.strip_prefix("study.") else { return false };
    let name = rest.split('.').next().unwrap_or(rest);
    match (&context.texts.typed, model.studies.last()) {
        (Some(_), Some(typed)) => typed.name != name,
        _ => context.is_overridden,
    }
}

/// Puts a study behind those of the file, under a name that none of them has.
pub(crate) fn add_study(root: &mut Node, kind: &str, table: Node) {
    let Value::Table(entries) = &mut root.value else { return };
    let place = table.span.clone();
    if !entries.iter().any(|entry| entry.key == "study") {
        let node = Node { value: Value::Table(Vec::new()), span: place.clone() };
        entries.push(Entry { key: "study".to_string(), key_span: place.clone(), node });
    }
    let studies = entries.iter_mut().find(|entry| entry.key == "study").map(|entry| &mut entry.node.value);
    let Some(Value::Table(studies)) = studies else { return };
    let mut key = kind.to_string();
    while studies.iter().any(|entry| entry.key == key) {
        key.push('_');
    }
    studies.push(Entry { key, key_span: place, node: table });
}

/// The entries of a table of named things; what is no table has been recorded on the way.
pub(crate) fn named_entries<'a>(context: &Context<'a>, word: &str) -> &'a [Entry] {
    let Some(entry) = context.root.get(word) else { return &[] };
    if !matches!(entry.node.value, Value::Table(_)) {
        let message = format!("expected named tables, found {}", entry.node.kind());
        let hint = match FILE.keys.iter().find(|key| key.name == word) {
            Some(Key { shape: Shape::NamedTables(_) | Shape::Unknowns(_), .. }) => {
                format!("write `[{word}.NAME]` and the keys below it")
            }
            _ => format!("write `[{word}]` and `NAME = ...` below it"),
        };
        context.wrong_with_hint(&entry.node.span, word, message, hint);
    }
    entry.node.entries()
}

fn name(context: &Context<'_>, word: &str, entry: &Entry) {
    let path = format!("{word}.{}", entry.key);
    if let Some(problem) = name_problem(&entry.key) {
        context.wrong(&entry.key_span, &path, format!("the name `{}` {problem}", entry.key));
    }
    if word == "body" && entry.key == "ground" {
        let message = "`ground` is the fixed world and cannot be the name of a body";
        context.wrong_with_hint(&entry.key_span, &path, message, "it is there without being defined");
    }
}

/// The descriptor of a kind of named tables.
fn table_of(word: &str) -> Option<&'static Table> {
    match FILE.keys.iter().find(|key| key.name == word)?.shape {
        Shape::NamedTables(table) | Shape::Unknowns(table) => Some(table),
        _ => None,
    }
}

/// Builds each named thing. Where one fails the list is short, but then nothing is made of it.
fn each<'c, 'a, T>(
    context: &'c Context<'a>,
    word: &'static str,
    build: impl Fn(&Reader<'c, 'a>, String) -> crate::context::Read<T>,
) -> Vec<T> {
    let Some(table) = table_of(word) else { return Vec::new() };
    let mut built = Vec::new();
    for entry in named_entries(context, word) {
        name(context, word, entry);
        let path = format!("{word}.{}", entry.key);
        if let Ok(reader) = Reader::open(context, entry, table, &path)
            && let Ok(thing) = build(&reader, entry.key.clone())
        {
            built.push(thing);
        }
    }
    built
}

/// What looks unintended: things that nothing refers to, numbers and parts that are hardly meant.
pub(crate) fn warnings(context: &Context<'_>, model: &Model) -> Vec<Problem> {
    let mut warnings = unused(context);
    warnings.extend(context.doubts());
    let mut told = BTreeSet::new();
    for doubt in model.doubts() {
        let span = context.root.locate(&doubt.path).unwrap_or(0..0);
        // The copies of a repeated table are told once.
        if context.is_copy(&doubt.path) && !told.insert(span.start) {
            continue;
        }
        let mut warning = context.problem(&span, &doubt.path, doubt.message).warning();
        warning.hint = doubt.hint;
        warnings.push(warning);
    }
    warnings.sort_by_key(|warning| warning.span.start);
    warnings
}

/// What nothing refers to. Many of a kind are told together.
fn unused(context: &Context<'_>) -> Vec<Problem> {
    let mut warnings = Vec::new();
    let kinds = [
        ("parameter", "parameters", ""),
        ("material", "materials", ""),
        ("section", "sections", ""),
        ("body", "bodies", " and nothing holds or loads it"),
    ];
    for (word, plural, more) in kinds {
        // A repeated table is told once.
        let mut told = BTreeSet::new();
        let entries = context.root.get(word).map_or(&[][..], |entry| entry.node.entries());
        let idle: Vec<&Entry> = entries
            .iter()
            .filter(|entry| !context.is_used(word, &entry.key))
            // A part that several models share offers more than each of them needs.
            .filter(|entry| !context.texts.is_included(&entry.key_span))
            .filter(|entry| {
                !context.is_copy(&format!("{word}.{}", entry.key)) || told.insert(entry.key_span.start)
            })
            .collect();
        let warning = |entry: &Entry, message: String| {
            let path = format!("{word}.{}", entry.key);
            context.problem(&entry.key_span, &path, message).warning()
        };
        match idle.as_slice() {
            [first, second, third, _, ..] => {
                let (first_name, more) = (&first.key, idle.len() - 3);
                let message = format!(
                    "{} {plural} are never used: `{first_name}`, `{}`, `{}` and {more} more",
                    idle.len(),
                    second.key,
                    third.key
                );
                warnings.push(warning(first, message));
            }
            few => warnings.extend(
                few.iter()
                    .map(|entry| warning(entry, format!("the {word} `{}` is never used{more}", entry.key))),
            ),
        }
    }
    warnings
}
