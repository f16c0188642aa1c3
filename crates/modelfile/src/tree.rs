//! The TOML text as a tree of our own, every key and value with its byte range.

use crate::repeat::stands_for;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub value: Value,
    pub span: Range<usize>,
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    Number(f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key with its value, in the order of the file.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub key_span: Range<usize>,
    pub node: Node,
}

impl Node {
    /// What it is, in words, with its article.
    pub(crate) fn kind(&self) -> &'static str {
        match self.value {
            Value::Text(_) => "a text",
            Value::Number(_) => "a number",
            Value::Flag(_) => "true or false",
            Value::Date => "a date",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }

    pub(crate) fn entries(&self) -> &[Entry] {
        match &self.value {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    pub(crate) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.key == key)
    }

    /// The byte range of the deepest thing on the way to `path` (`section.strip.along[2].width`). A copy of a
    /// repeated table is looked for where its template stands.
    pub(crate) fn locate(&self, path: &str) -> Option<Range<usize>> {
        let mut node = self;
        let mut rest = path;
        let mut found = None;
        // Keys hold no dots here: names that do are refused before anyone asks.
        while !rest.is_empty() {
            if let Some(index) = rest.strip_prefix('[') {
                let Some((number, behind)) = index.split_once(']') else { break };
                rest = behind.trim_start_matches('.');
                let Ok(number) = number.parse::<usize>() else { break };
                // One table may stand for a list of one, and a list may be given as a single text.
                let Value::List(list) = &node.value else { continue };
                let Some(next) = list.get(number) else { break };
                node = next;
                found = Some(node.span.clone());
                continue;
            }
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            let name = &rest[..end];
            let template = || node.entries().iter().find(|entry| stands_for(&entry.key, name));
            let Some(entry) = node.get(name).or_else(template) else { break };
            rest = rest[end..].trim_start_matches('.');
            node = &entry.node;
            // A table is best shown by its key; a value by itself.
            let is_table = matches!(node.value, Value::Table(_));
            found = Some(if is_table { entry.key_span.clone() } else { node.span.clone() });
        }
        found
    }
}

/// Copies the parser's tree. Numbers that fit nowhere become infinite and are refused where they are read.
pub(crate) fn tree(value: &Spanned<DeValue<'_>>) -> Node {
    let span = value.span();
    let value = match value.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => Value::Number(number(integer)),
        DeValue::Float(float) => Value::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => Value::List(list.iter().map(tree).collect()),
        DeValue::Table(table) => Value::Table(entries(table)),
    };
    Node { value, span }
}

pub(crate) fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = table
        .iter()
        .map(|(key, value)| Entry { key: key.get_ref().to_string(), key_span: key.span(), node: tree(value) })
        .collect();
    // The parser sorts by name; people expect the order of the file.
    entries.sort_by_key(|entry| entry.key_span.start);
    entries
}

fn number(integer: &DeInteger<'_>) -> f64 {
    let text = integer.as_str();
    match i128::from_str_radix(text, integer.radix()) {
        Ok(value) => value as f64,
        Err(_) => text.parse().unwrap_or(f64::INFINITY),
    }
}
