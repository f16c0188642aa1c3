//! The JSON Schema (draft 2020-12) of a model file, for editors; made from the format's descriptor.

use crate::format::{FILE, Key, Need, REPEAT, Shape, Table};
use crate::json::{array, indent, object, text};

/// The JSON Schema of the model file.
///
/// It knows keys, types and words; it does not know dimensions, names, or which keys exclude each other.
pub fn schema() -> String {
    let mut members = vec![
        ("$schema", text("https://json-schema.org/draft/2020-12/schema")),
        ("title", text("flexura model file")),
    ];
    members.extend(table_members(&FILE, None));
    // What is included may hold the rest of a thing.
    let alone = object(&[("required", array([text("include")]))]);
    members.push(("if", object(&[("not", alone)])));
    members.push(("then", object(&[("properties", object(&needed()))])));
    members.push((
        "$defs",
        object(&[("number", number()), ("extended", extended()), ("vector", list_of("number", 3))]),
    ));
    indent(&object(&members))
}

/// The keys that things of one kind must have, by the name of their table.
fn needed() -> Vec<(&'static str, String)> {
    let tables = FILE.keys.iter().filter_map(|key| match &key.shape {
        Shape::NamedTables(inner) if inner.variants.is_none() => Some((key.name, inner)),
        _ => None,
    });
    let needed = tables.map(|(name, inner)| {
        let required = inner.keys.iter().filter(|key| key.need == Need::Required).map(|key| text(key.name));
        (name, object(&[("additionalProperties", object(&[("required", array(required))]))]))
    });
    needed.collect()
}

/// A number, or a text with a unit or an expression.
fn number() -> String {
    object(&[
        ("description", text("a number in SI units, a text with a unit, or an expression of parameters")),
        ("type", array([text("number"), text("string")])),
    ])
}

/// The same; TOML's `inf` is a number too, but JSON has none, so the type is all that can be said.
fn extended() -> String {
    object(&[
        ("description", text("a number (`inf` is rigid), a text with a unit, or an expression of s")),
        ("type", array([text("number"), text("string")])),
    ])
}

fn refer(name: &str) -> String {
    object(&[("$ref", text(&format!("#/$defs/{name}")))])
}

fn list_of(name: &str, count: usize) -> String {
    list(refer(name), Some(count), count)
}

fn list(items: String, most: Option<usize>, least: usize) -> String {
    let mut members = vec![("type", text("array")), ("items", items), ("minItems", least.to_string())];
    if let Some(most) = most {
        members.push(("maxItems", most.to_string()));
    }
    object(&members)
}

fn any_of(schemas: impl IntoIterator<Item = String>) -> String {
    object(&[("anyOf", array(schemas))])
}

fn type_of(name: &str) -> String {
    object(&[("type", text(name))])
}

fn table(table: &Table) -> String {
    object(&table_members(table, None))
}

/// The schema of a table that may have one more key.
fn table_members(table: &Table, more: Option<&Key>) -> Vec<(&'static str, String)> {
    let mut members = vec![("description", text(table.doc)), ("type", text("object"))];
    match &table.variants {
        None => members.extend(key_members(table.keys.iter().chain(more), None)),
        Some(variants) => {
            let each = variants.list.iter().map(|variant| {
                let word = object(&[
                    ("const", text(variant.name)),
                    ("description", text(&format!("{} {}", variants.by_doc, variant.doc))),
                ]);
                let required = variants.default != Some(variant.name);
                let mut members = vec![("title", text(variant.name)), ("type", text("object"))];
                members.extend(key_members(
                    table.keys.iter().chain(variant.keys).chain(more),
                    Some((variants.by, word, required)),
                ));
                object(&members)
            });
            members.push(("oneOf", array(each)));
        }
    }
    members
}

fn key_members<'k>(
    keys: impl Iterator<Item = &'k Key>,
    by: Option<(&'static str, String, bool)>,
) -> Vec<(&'static str, String)> {
    let mut properties = Vec::new();
    let mut required = Vec::new();
    if let Some((name, word, is_required)) = by {
        properties.push((name, word));
        if is_required {
            required.push(text(name));
        }
    }
    for key in keys {
        properties.push((key.name, property(key)));
        if key.need == Need::Required {
            required.push(text(key.name));
        }
    }
    vec![
        ("properties", object(&properties)),
        ("required", array(required)),
        ("additionalProperties", "false".to_string()),
    ]
}

/// The schema of a key's value, with the key's description before that of its type.
fn property(key: &Key) -> String {
    let mut description = key.doc.to_string();
    description.push_str(&format!(" {}.", capital(&key.shape.describe())));
    if let Need::Default(default) = key.need {
        description.push_str(&format!(" Default: {default}."));
    }
    description.push_str(&format!(" Example: {} = {}", key.name, key.example));
    object(&[("description", text(&description)), ("allOf", array([value(&key.shape)]))])
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

fn named(schema: String) -> String {
    object(&[("type", text("object")), ("additionalProperties", schema)])
}

fn value(shape: &Shape) -> String {
    match shape {
        Shape::Number(_) | Shape::Profile(_) | Shape::Function(_) | Shape::Station => refer("number"),
        Shape::AnyNumber | Shape::AnyRate | Shape::AnyFunction | Shape::Count => refer("number"),
        Shape::Knots => list(list_of("number", 2), None, 2),
        Shape::FlagOrCount => any_of([type_of("boolean"), refer("number")]),
        Shape::Texts => any_of([type_of("string"), list(type_of("string"), None, 0)]),
        Shape::Notched(_) => any_of(std::iter::once(refer("number")).chain(shape.table().map(table))),
        Shape::Stiffness(_) => refer("extended"),
        Shape::Vector(_) | Shape::Profiles(_) => refer("vector"),
        Shape::Range(_) | Shape::AnyRange | Shape::AnyPair => list_of("number", 2),
        Shape::Quaternion => list_of("number", 4),
        Shape::Matrix6 => list(list_of("number", 6), Some(6), 6),
        Shape::Inertia => any_of([refer("vector"), list(refer("vector"), Some(3), 3)]),
        Shape::PointOrStation => any_of([refer("number"), refer("vector")]),
        Shape::Offset => list(refer("number"), Some(3), 2),
        Shape::Text | Shape::Name(_) | Shape::Parameter | Shape::Equation => type_of("string"),
        Shape::Flag => type_of("boolean"),
        Shape::Choice(words) => object(&[("enum", array(words.iter().map(|(word, _)| text(word))))]),
        Shape::Placed(inner) | Shape::Reading(inner) => any_of([type_of("string"), table(inner)]),
        Shape::Table(inner) => table(inner),
        Shape::Tables(inner) => any_of([table(inner), list(table(inner), None, 0)]),
        Shape::NamedTables(inner) => {
            let mut members = table_members(inner, Some(&REPEAT));
            members.retain(|(name, _)| *name != "required");
            named(object(&members))
        }
        Shape::Unknowns(inner) => named(table(inner)),
        Shape::Repeat => named(any_of([refer("number"), list_of("number", 2)])),
        Shape::NamedNumbers | Shape::NamedTargets => named(refer("number")),
        Shape::NamedValues => named(refer("number")),
        Shape::NamedRanges => named(list_of("number", 2)),
        Shape::NamedGrids => named(list_of("number", 3)),
        Shape::Data(inner) => any_of([type_of("string"), table(inner)]),
        Shape::Rows => list(list(refer("number"), None, 1), None, 1),
        Shape::NamedOutputs => named(type_of("string")),
        Shape::Points => list(refer("vector"), None, 2),
        Shape::PlanePoints | Shape::Pairs => list(list_of("number", 2), None, 2),
        Shape::ForceRows => list(list_of("number", 2), None, 2),
        Shape::Along => list(
            object(&[
                ("type", text("object")),
                ("required", array([text("at")])),
                ("additionalProperties", refer("extended")),
            ]),
            None,
            2,
        ),
        Shape::Version => object(&[("const", "1".to_string())]),
    }
}
