//! A study as it is typed on a command line: the words of its table as flags.
//!
//! The flags become a table of the tree like those of the file, with byte ranges in a text of their own, so that
//! everything that is said of the file's studies is said of this one too.

use crate::report::{Problem, Report, Source, Texts};
use crate::tree::{Entry, Node, Value};
use crate::{Document, build};
use flexura_expression::split;
use std::ops::Range;
use std::sync::Arc;

/// What messages call the text.
const SOURCE: &str = "command line";

/// A flag without its dashes, and what stands behind it.
pub type Flag = (&'static str, Option<String>);

impl Document {
    /// The same file with one more study, the last, of that kind and with what was typed: keys of its table by their names,
    /// lists as `A:B`, tables as `P=V` or `P=A:B`, flags that may be repeated once for each value.
    ///
    /// # Errors
    /// A list or table of another form. Wrong names and values are found where the model is made.
    pub fn with_study(&self, kind: &str, flags: &[Flag]) -> Result<Self, Report> {
        let words = Words::new(self.texts.typed_start(), kind, flags);
        let texts = Texts {
            typed: Some(Arc::new(Source { name: SOURCE.to_string(), text: words.text.clone() })),
            ..self.texts.clone()
        };
        let table = words.table(kind).map_err(|wrong| {
            let problem: Problem = texts.problem(wrong.span, "", wrong.message);
            Report::input(vec![problem.hint(wrong.hint)])
        })?;
        let mut root = self.root.clone();
        build::add_study(&mut root, kind, table);
        Ok(Self { texts, root })
    }
}

/// Something of another form than is wanted.
struct Wrong {
    span: Range<usize>,
    message: String,
    hint: String,
}

/// A flag and its value with their places.
struct Word {
    flag: &'static str,
    flag_span: Range<usize>,
    value: Option<Node>,
}

/// The verb and its flags written out, as they would be typed.
struct Words {
    text: String,
    /// Where the text is in the byte ranges.
    span: Range<usize>,
    list: Vec<Word>,
}

impl Words {
    /// `start` is where the text begins in the byte ranges.
    fn new(start: usize, verb: &str, flags: &[Flag]) -> Self {
        let mut text = verb.to_string();
        let mut list = Vec::new();
        for (flag, value) in flags {
            text.push(' ');
            let from = start + text.len();
            text.push_str(&format!("--{flag}"));
            let flag_span = from..start + text.len();
            let value = value.as_ref().map(|value| {
                let plain = !value.is_empty()
                    && value.chars().all(|c| c.is_alphanumeric() || "_-.:=*/+^".contains(c));
                let quote = if plain {
                    ""
                } else if value.contains('"') {
                    "'"
                } else {
                    "\""
                };
                text.push_str(&format!(" {quote}"));
                let from = start + text.len();
                text.push_str(value);
                let span = from..start + text.len();
                text.push_str(quote);
                Node { value: Value::Text(value.clone()), span }
            });
            list.push(Word { flag, flag_span, value });
        }
        Self { span: start..start + text.len(), text, list }
    }

    fn table(&self, kind: &str) -> Result<Node, Wrong> {
        let mut entries: Vec<Entry> = vec![Entry {
            key: "kind".to_string(),
            key_span: self.whole(),
            node: Node { value: Value::Text(kind.to_string()), span: self.whole() },
        }];
        for word in &self.list {
            let node = match (&word.value, word.flag) {
                (None, _) => Node { value: Value::Flag(true), span: word.flag_span.clone() },
                (Some(value), "range") => range(value, "write both ends: --range \"0 N:40 N\"")?,
                (Some(value), "imperfection") => {
                    let hint = "write a parameter and the value that it is led from: --imperfection slope=\"100 deg\"";
                    let (parameter, from) = equation(value, hint)?;
                    Node {
                        value: Value::Table(vec![entry("parameter", parameter), entry("from", from)]),
                        span: value.span.clone(),
                    }
                }
                (Some(value), "critical") => {
                    let hint = "write a second parameter and its range: --critical weight=\"0 N:2 N\"";
                    let (parameter, values) = equation(value, hint)?;
                    let range = range(&values, hint)?;
                    Node {
                        value: Value::Table(vec![entry("parameter", parameter), entry("range", range)]),
                        span: value.span.clone(),
                    }
                }
                (Some(value), "bounds") => {
                    let hint = "write a parameter and both ends: --bounds young=\"1 GPa:10 GPa\"";
                    let (name, values) = equation(value, hint)?;
                    named(name, range(&values, hint)?)
                }
                (Some(value), "noise") => {
                    let hint = "write an output and its standard deviation: --noise tip=\"0.1 mm\"";
                    let (name, deviation) = equation(value, hint)?;
                    named(name, deviation)
                }
                (Some(value), _) => value.clone(),
            };
            if word.flag == "critical-number" {
                let critical = entries.iter_mut().find(|entry| entry.key == "critical");
                if let Some(Entry { node: Node { value: Value::Table(inner), .. }, .. }) = critical {
                    inner.push(entry("number", node));
                }
                continue;
            }
            let key = word.flag.replace('-', "_");
            match entries.iter_mut().find(|entry| entry.key == key) {
                Some(Entry { node: Node { value: Value::List(list), .. }, .. }) => list.push(node),
                Some(Entry { node: Node { value: Value::Table(table), .. }, .. }) => {
                    if let Value::Table(more) = node.value {
                        table.extend(more);
                    }
                }
                // A flag that may be repeated makes a list from the first one on.
                _ if matches!(word.flag, "event" | "stop" | "unknown" | "per-specimen") => {
                    let list = Node { span: node.span.clone(), value: Value::List(vec![node]) };
                    entries.push(Entry { key, key_span: word.flag_span.clone(), node: list });
                }
                _ => entries.push(Entry { key, key_span: word.flag_span.clone(), node }),
            }
        }
        Ok(Node { value: Value::Table(entries), span: self.whole() })
    }

    fn whole(&self) -> Range<usize> {
        self.span.clone()
    }
}

fn entry(key: &str, node: Node) -> Entry {
    Entry { key: key.to_string(), key_span: node.span.clone(), node }
}

/// A table of one entry, whose name was typed.
fn named(name: Node, node: Node) -> Node {
    let (key, key_span) = match name.value {
        Value::Text(text) => (text, name.span.clone()),
        _ => (String::new(), name.span.clone()),
    };
    let span = name.span.start..node.span.end;
    Node { value: Value::Table(vec![Entry { key, key_span, node }]), span }
}

/// `A:B` as a list.
fn range(node: &Node, hint: &str) -> Result<Node, Wrong> {
    let Value::Text(text) = &node.value else { return Ok(node.clone()) };
    let parts = split(text, ':');
    if parts.len() != 2 {
        let message =
            format!("a range has two ends with a colon between them, but this has {} parts", parts.len());
        let message = if parts.len() == 1 {
            "a range has two ends with a colon between them".to_string()
        } else {
            message
        };
        return Err(Wrong { span: node.span.clone(), message, hint: hint.to_string() });
    }
    let list = parts.into_iter().map(|part| piece(node, text, part)).collect();
    Ok(Node { value: Value::List(list), span: node.span.clone() })
}

/// The two sides of `P=V`.
fn equation(node: &Node, hint: &str) -> Result<(Node, Node), Wrong> {
    let Value::Text(text) = &node.value else { return Ok((node.clone(), node.clone())) };
    match text.find('=') {
        Some(sign) => Ok((piece(node, text, 0..sign), piece(node, text, sign + 1..text.len()))),
        None => {
            let message = "there is no equals sign".to_string();
            Err(Wrong { span: node.span.clone(), message, hint: hint.to_string() })
        }
    }
}

/// A part of a text as a node, blanks around it left out.
fn piece(node: &Node, text: &str, part: Range<usize>) -> Node {
    let whole = &text[part.clone()];
    let start = node.span.start + part.start + whole.len() - whole.trim_start().len();
    let value = whole.trim().to_string();
    Node { span: start..start + value.len(), value: Value::Text(value) }
}
