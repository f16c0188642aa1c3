//! Values of a file as text.

use crate::tree::{Entry, Node, Value as Read};
use std::fmt::Write;

/// A value behind a key.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// Written as it is: a number, a flag.
    Plain(String),
    Text(String),
    List(Vec<Value>),
    Table(Table),
}

/// Keys with their values, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Table(Vec<(String, Value)>);

impl Value {
    pub fn plain(text: &str) -> Self {
        Value::Plain(text.to_string())
    }

    pub fn text(text: &str) -> Self {
        Value::Text(text.to_string())
    }

    pub fn flag(flag: bool) -> Self {
        Value::Plain(flag.to_string())
    }

    /// The shortest text that reads back as the same number.
    pub fn number(value: f64) -> Self {
        // Whole numbers of moderate size need no decimals; infinity is `inf` in TOML too.
        Value::Plain(
            if value.fract() == 0.0 && value.abs() < 1e15 && (value != 0.0 || value.is_sign_positive()) {
                format!("{value}")
            } else {
                format!("{value:?}")
            },
        )
    }

    fn write(&self, text: &mut String) {
        match self {
            Value::Plain(plain) => text.push_str(plain),
            Value::Text(own) => quoted(own, text),
            Value::List(list) => {
                text.push('[');
                for (i, value) in list.iter().enumerate() {
                    if i > 0 {
                        text.push_str(", ");
                    }
                    value.write(text);
                }
                text.push(']');
            }
            Value::Table(table) => {
                text.push_str("{ ");
                for (i, (key, value)) in table.0.iter().enumerate() {
                    if i > 0 {
                        text.push_str(", ");
                    }
                    name(key, text);
                    text.push_str(" = ");
                    value.write(text);
                }
                text.push_str(if table.0.is_empty() { "}" } else { " }" });
            }
        }
    }
}

/// A tree as a text that reads back as the same tree.
pub(crate) fn written_out(root: &Node) -> String {
    let is_table = |entry: &&Entry| matches!(entry.node.value, Read::Table(_));
    let (tables, own): (Vec<&Entry>, Vec<&Entry>) = root.entries().iter().partition(is_table);
    let mut text = table_of(own).lines();
    for entry in tables {
        let (inner, own): (Vec<&Entry>, Vec<&Entry>) = entry.node.entries().iter().partition(is_table);
        if !own.is_empty() || inner.is_empty() {
            text.push_str(&table_of(own).section(&entry.key, ""));
        }
        for named in inner {
            text.push_str(&table_of(named.node.entries().iter()).section(&entry.key, &named.key));
        }
    }
    text
}

fn table_of<'e>(entries: impl IntoIterator<Item = &'e Entry>) -> Table {
    Table(entries.into_iter().map(|entry| (entry.key.clone(), value_of(&entry.node))).collect())
}

fn value_of(node: &Node) -> Value {
    match &node.value {
        Read::Text(text) => Value::text(text),
        Read::Number(value) => Value::number(*value),
        Read::Flag(flag) => Value::flag(*flag),
        // A date means nothing in a model file; a text is refused in the same way.
        Read::Date => Value::text("a date"),
        Read::List(list) => Value::List(list.iter().map(value_of).collect()),
        Read::Table(entries) => Value::Table(table_of(entries)),
    }
}

impl Table {
    pub fn put(&mut self, key: &str, value: Value) {
        self.0.push((key.to_string(), value));
    }

    pub fn put_some(&mut self, key: &str, value: Option<Value>) {
        if let Some(value) = value {
            self.put(key, value);
        }
    }

    pub fn extend(&mut self, other: Table) {
        self.0.extend(other.0);
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A line for each key.
    pub fn lines(&self) -> String {
        let mut text = String::new();
        for (key, value) in &self.0 {
            name(key, &mut text);
            text.push_str(" = ");
            value.write(&mut text);
            text.push('\n');
        }
        text
    }

    /// The same behind a header.
    pub fn section(&self, word: &str, own: &str) -> String {
        let mut text = format!("\n[{word}");
        if !own.is_empty() {
            text.push('.');
            name(own, &mut text);
        }
        let _ = writeln!(text, "]");
        text + &self.lines()
    }
}

/// A key, in quotes where it needs them.
fn name(key: &str, text: &mut String) {
    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { text.push_str(key) } else { quoted(key, text) }
}

fn quoted(own: &str, text: &mut String) {
    text.push('"');
    for c in own.chars() {
        match c {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '\n' => text.push_str("\\n"),
            '\t' => text.push_str("\\t"),
            c if c.is_control() => {
                // Writing to a String cannot fail.
                let _ = write!(text, "\\u{:04X}", c as u32);
            }
            c => text.push(c),
        }
    }
    text.push('"');
}
