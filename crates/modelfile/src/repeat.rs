//! Tables that stand for many: `repeat` names indices, and every combination of them becomes a table of its own.
//!
//! In the name of such a table and in every text inside, `{expression}` is replaced by its value, a whole number. That
//! is done on the tree, before anything is built; the byte ranges stay those of the template.

mod indices;
mod pattern;

use crate::context::{Context, Read, Reported};
use crate::format::{FILE, Shape};
use crate::tree::{Entry, Node, Value};
use indices::{Indices, indices};
use pattern::{Pattern, braces, pattern};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry as Place;

pub(crate) use pattern::stands_for;

/// Most copies in a file.
const MOST: usize = 200_000;
/// Most values in the copies of a table: what fits into memory with ease.
const MOST_VALUES: f64 = 2e7;

/// A tree in which nothing is repeated any more.
pub(crate) struct Expanded {
    pub root: Node,
    pub copies: Copies,
}

/// Which tables are copies, and of what.
#[derive(Default)]
pub(crate) struct Copies {
    indices: Vec<Indices>,
    /// By path (`body.n_3_4`): the template's number, and the values of its indices.
    of: BTreeMap<String, (usize, Vec<i64>)>,
}

impl Copies {
    /// The values of the indices where the path leads into a copy: "i = 3, j = 4".
    pub(crate) fn values(&self, path: &str) -> Option<String> {
        let (template, values) = self.find(path)?;
        Some(self.indices[*template].show(values))
    }

    pub(crate) fn is_copy(&self, path: &str) -> bool {
        self.find(path).is_some()
    }

    fn find(&self, path: &str) -> Option<&(usize, Vec<i64>)> {
        if self.of.is_empty() {
            return None;
        }
        let end = path.match_indices('.').nth(1).map_or(path.len(), |(i, _)| i);
        self.of.get(&path[..end])
    }
}

/// Expands every table with `repeat`. None: there is none.
pub(crate) fn expand(context: &Context<'_>) -> Read<Option<Expanded>> {
    let root = context.root;
    let mut result = Ok(());
    let mut any = false;
    let mut left = MOST;
    let mut copies = Copies::default();
    let mut entries = Vec::with_capacity(root.entries().len());
    for entry in root.entries() {
        let key = FILE.keys.iter().find(|key| key.name == entry.key);
        match key.map(|key| key.shape) {
            Some(Shape::NamedTables(_)) if is_repeated(entry) => {
                any = true;
                match tables(context, entry, &mut copies, &mut left) {
                    Ok(tables) => entries.push(Entry {
                        key: entry.key.clone(),
                        key_span: entry.key_span.clone(),
                        node: Node { value: Value::Table(tables), span: entry.node.span.clone() },
                    }),
                    Err(Reported) => result = Err(Reported),
                }
            }
            shape => {
                let repeatable = matches!(shape, Some(Shape::NamedTables(_)));
                if repeatable || matches!(shape, Some(Shape::NamedOutputs | Shape::NamedTargets)) {
                    for inner in entry.node.entries() {
                        if stray(context, inner, &format!("{}.{}", entry.key, inner.key), repeatable).is_err()
                        {
                            result = Err(Reported);
                        }
                    }
                }
                entries.push(entry.clone());
            }
        }
    }
    result?;
    let root = Node { value: Value::Table(entries), span: root.span.clone() };
    Ok(any.then_some(Expanded { root, copies }))
}

fn is_repeated(entry: &Entry) -> bool {
    entry.node.entries().iter().any(|inner| inner.node.get("repeat").is_some())
}

/// How many values a node holds, itself included.
fn values_in(node: &Node) -> f64 {
    let mut count = 0.0;
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        count += 1.0;
        match &node.value {
            Value::List(list) => open.extend(list),
            Value::Table(entries) => open.extend(entries.iter().map(|entry| &entry.node)),
            _ => {}
        }
    }
    count
}

/// Braces where nothing is repeated.
fn stray(context: &Context<'_>, entry: &Entry, path: &str, repeatable: bool) -> Read<()> {
    let hint = if repeatable {
        "give this table indices, for example `repeat = { i = 10 }`"
    } else {
        "only tables such as [body.NAME] can be repeated; write each of these out"
    };
    let wrong = |node: &Node, text: &str, path: &str| {
        let Some(range) = braces(text) else { return Ok(()) };
        let message = format!("`{}` is only replaced in a table with `repeat`", &text[range.clone()]);
        Err(context.wrong_with_hint(&context.inner(node, &range), path, message, hint))
    };
    let key = Node { value: Value::Text(entry.key.clone()), span: entry.key_span.clone() };
    wrong(&key, &entry.key, path)?;
    let mut open: Vec<(&Node, String)> = vec![(&entry.node, path.to_string())];
    while let Some((node, path)) = open.pop() {
        match &node.value {
            Value::Text(text) => wrong(node, text, &path)?,
            Value::List(list) => {
                open.extend(list.iter().enumerate().map(|(i, item)| (item, format!("{path}[{i}]"))));
            }
            Value::Table(entries) => {
                // The name of a file may hold anything.
                let inner = entries.iter().filter(|entry| entry.key != "file");
                open.extend(inner.map(|entry| (&entry.node, format!("{path}.{}", entry.key))));
            }
            _ => {}
        }
    }
    Ok(())
}

/// The tables of one kind, each template replaced by its copies.
fn tables(context: &Context<'_>, kind: &Entry, copies: &mut Copies, left: &mut usize) -> Read<Vec<Entry>> {
    let word = kind.key.as_str();
    let mut result = Ok(());
    let mut all: Vec<Entry> = Vec::new();
    // The number of the template that made it, or none where it stands in the file by itself.
    let mut names: BTreeMap<String, Option<usize>> = BTreeMap::new();
    for entry in kind.node.entries().iter().filter(|entry| entry.node.get("repeat").is_none()) {
        names.insert(entry.key.clone(), None);
    }
    for entry in kind.node.entries() {
        let path = format!("{word}.{}", entry.key);
        if entry.node.get("repeat").is_none() {
            match stray(context, entry, &path, true) {
                Ok(()) => all.push(entry.clone()),
                Err(Reported) => result = Err(Reported),
            }
            continue;
        }
        let made = Template::new(context, entry, &path)
            .and_then(|template| template.copy_all(word, copies, &mut names, left, &mut all));
        if made.is_err() {
            result = Err(Reported);
        }
    }
    result.map(|()| all)
}

/// A table with `repeat`, its texts understood.
struct Template<'c, 'a> {
    context: &'c Context<'a>,
    entry: &'c Entry,
    path: &'c str,
    indices: Indices,
    /// The table's name, and where it stands.
    name: Pattern,
    name_node: Node,
    /// The texts with braces, by the byte at which they begin.
    texts: BTreeMap<usize, Pattern>,
}

impl<'c, 'a> Template<'c, 'a> {
    fn new(context: &'c Context<'a>, entry: &'c Entry, path: &'c str) -> Read<Self> {
        let indices = indices(context, &entry.node, path)?;
        let name_node = Node { value: Value::Text(entry.key.clone()), span: entry.key_span.clone() };
        let mut result = Ok(());
        let mut read = |node: &Node, text: &str| match pattern(context, &indices, node, path, text) {
            Ok(pattern) => Some(pattern),
            Err(Reported) => {
                result = Err(Reported);
                None
            }
        };
        let name = read(&name_node, &entry.key);
        let mut texts = BTreeMap::new();
        let mut open: Vec<&Node> = entry
            .node
            .entries()
            .iter()
            .filter(|entry| entry.key != "repeat")
            .map(|entry| &entry.node)
            .collect();
        while let Some(node) = open.pop() {
            match &node.value {
                Value::Text(text) if text.contains(['{', '}']) => {
                    if let Some(pattern) = read(node, text) {
                        texts.insert(node.span.start, pattern);
                    }
                }
                Value::List(list) => open.extend(list),
                Value::Table(entries) => open.extend(entries.iter().map(|entry| &entry.node)),
                _ => {}
            }
        }
        result?;
        Ok(Self { context, entry, path, indices, name: name.ok_or(Reported)?, name_node, texts })
    }

    fn wrong(&self, message: String, hint: String) -> Reported {
        self.context.wrong_with_hint(&self.entry.key_span, self.path, message, hint)
    }

    /// Makes every copy.
    fn copy_all(
        self,
        word: &str,
        copies: &mut Copies,
        names: &mut BTreeMap<String, Option<usize>>,
        left: &mut usize,
        all: &mut Vec<Entry>,
    ) -> Read<()> {
        let count = self.indices.count();
        if count > *left as f64 {
            let message = format!("the file would have {} tables of `repeat`", count + (MOST - *left) as f64);
            return Err(self.wrong(message, format!("there may be {MOST} in all")));
        }
        let values = count * values_in(&self.entry.node);
        if values > MOST_VALUES {
            let message = format!("the copies of this table would hold {values} values");
            return Err(self.wrong(
                message,
                format!("there may be {MOST_VALUES}; long lists of points belong in a file"),
            ));
        }
        *left -= count as usize;
        all.reserve(count as usize);
        let number = copies.indices.len();
        let mut values = self.indices.first();
        for _ in 0..count as usize {
            let slots: Vec<f64> = values.iter().map(|value| *value as f64).collect();
            let name = self.text(&self.name, &self.name_node, &slots, &values)?;
            match names.entry(name.clone()) {
                Place::Vacant(place) => {
                    place.insert(Some(number));
                }
                Place::Occupied(place) => {
                    let shown = self.indices.show(&values);
                    let (message, hint) = match place.get() {
                        Some(other) if *other == number => (
                            format!("two copies are named `{name}`, one of them that for {shown}"),
                            format!(
                                "put every index into the name, for example `{word}.\"{}\"`",
                                self.indices.example(&self.entry.key)
                            ),
                        ),
                        _ => (
                            format!("the copy for {shown} is named `{name}`, but that name is taken"),
                            "rename one of the two, or let the index run elsewhere".to_string(),
                        ),
                    };
                    return Err(self.wrong(message, hint));
                }
            }
            let node = self.node(&self.entry.node, &slots, &values, true)?;
            copies.of.insert(format!("{word}.{name}"), (number, values.clone()));
            all.push(Entry { key: name, key_span: self.entry.key_span.clone(), node });
            self.indices.next(&mut values);
        }
        copies.indices.push(self.indices);
        Ok(())
    }

    /// A copy of a node; of the template itself without its `repeat`.
    fn node(&self, node: &Node, slots: &[f64], values: &[i64], is_whole: bool) -> Read<Node> {
        let value = match &node.value {
            Value::Text(text) => Value::Text(match self.texts.get(&node.span.start) {
                Some(pattern) => self.text(pattern, node, slots, values)?,
                None => text.clone(),
            }),
            Value::List(list) => {
                let list: Read<Vec<Node>> =
                    list.iter().map(|item| self.node(item, slots, values, false)).collect();
                Value::List(list?)
            }
            Value::Table(entries) => {
                let kept = entries.iter().filter(|entry| !(is_whole && entry.key == "repeat"));
                let copy = |entry: &Entry| {
                    let node = self.node(&entry.node, slots, values, false)?;
                    Ok(Entry { key: entry.key.clone(), key_span: entry.key_span.clone(), node })
                };
                Value::Table(kept.map(copy).collect::<Read<Vec<Entry>>>()?)
            }
            other => other.clone(),
        };
        Ok(Node { value, span: node.span.clone() })
    }

    fn text(&self, pattern: &Pattern, node: &Node, slots: &[f64], values: &[i64]) -> Read<String> {
        pattern.fill(slots).map_err(|wrong| {
            let span = self.context.inner(node, &wrong.range);
            let shown = self.indices.show(values);
            let message = format!("expected a whole number, found {} for {shown}", wrong.value);
            let hint = "what stands in braces is replaced by its value, which must be a whole number";
            self.context.wrong_with_hint(&span, self.path, message, hint)
        })
    }
}
