//! Reading one table by its descriptor.

mod values;

pub(crate) use values::station;

use crate::context::{Context, Read, Reported};
use crate::format::{Key, Need, Shape, Table};
use crate::tree::{Entry, Node, Value};
use flexura_expression::nearest;
use std::ops::Range;

/// A table being read. On opening, unknown keys and missing ones are recorded; a value is then read by its
/// key, with the dimension that the descriptor gives.
pub(crate) struct Reader<'c, 'a> {
    pub context: &'c Context<'a>,
    pub node: &'c Node,
    pub path: String,
    /// Where the table is named.
    pub place: Range<usize>,
    /// The chosen variant's name; empty where there are none.
    pub variant: &'static str,
    keys: Vec<&'static Key>,
}

impl<'c, 'a> Reader<'c, 'a> {
    /// Opens a table that stands behind a key.
    pub(crate) fn open(
        context: &'c Context<'a>,
        entry: &'c Entry,
        table: &'static Table,
        path: &str,
    ) -> Read<Self> {
        // An inline table is shown by its key as a header is.
        Self::open_node(context, &entry.node, &entry.key_span, table, path)
    }

    pub(crate) fn open_node(
        context: &'c Context<'a>,
        node: &'c Node,
        place: &Range<usize>,
        table: &'static Table,
        path: &str,
    ) -> Read<Self> {
        if !matches!(node.value, Value::Table(_)) {
            return Err(context.wrong(&node.span, path, format!("expected a table, found {}", node.kind())));
        }
        let mut reader = Self {
            context,
            node,
            path: path.to_string(),
            place: place.clone(),
            variant: "",
            keys: table.keys.iter().collect(),
        };
        let mut by = None;
        let mut chosen = Ok(());
        if let Some(variants) = &table.variants {
            by = Some(variants.by);
            match reader.choose(table) {
                Ok(variant) => {
                    reader.variant = variant.name;
                    reader.keys.extend(variant.keys.iter());
                }
                Err(Reported) => chosen = Err(Reported),
            }
        }
        for entry in node.entries() {
            let known = by == Some(entry.key.as_str()) || reader.keys.iter().any(|key| key.name == entry.key);
            let elsewhere = table.all_keys().any(|key| key.name == entry.key);
            // Without a variant, nothing can be said of the keys of all of them.
            if !known && (chosen.is_ok() || !elsewhere) {
                reader.unknown_key(entry, table);
            }
        }
        chosen?;
        for key in &reader.keys {
            if key.need == Need::Required && node.get(key.name).is_none() {
                reader.missing(key);
            }
        }
        Ok(reader)
    }

    fn choose(&self, table: &'static Table) -> Read<&'static crate::format::Variant> {
        let Some(variants) = &table.variants else { return Err(Reported) };
        let names: Vec<&str> = variants.list.iter().map(|variant| variant.name).collect();
        let path = self.key_path(variants.by);
        let word = match self.node.get(variants.by) {
            None => match variants.default {
                Some(default) => default,
                None => {
                    let message = format!("the key `{}` is missing", variants.by);
                    let hint = format!(
                        "for example `{} = \"{}\"`; there are {}",
                        variants.by,
                        names[0],
                        list(&names)
                    );
                    return Err(self.context.wrong_with_hint(&self.place, &self.path, message, hint));
                }
            },
            Some(entry) => match &entry.node.value {
                Value::Text(text) => text,
                _ => {
                    let message = format!("expected a text, found {}", entry.node.kind());
                    return Err(self.context.wrong_with_hint(
                        &entry.node.span,
                        &path,
                        message,
                        format!("there are {}", list(&names)),
                    ));
                }
            },
        };
        if let Some(variant) = variants.list.iter().find(|variant| variant.name == word) {
            return Ok(variant);
        }
        let span = self.node.get(variants.by).map_or(&self.place, |entry| &entry.node.span);
        let hint = match nearest(word, names.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("there are {}", list(&names)),
        };
        Err(self.context.wrong_with_hint(
            span,
            &path,
            format!("there is no {} \"{word}\"", variants.by),
            hint,
        ))
    }

    fn unknown_key(&self, entry: &Entry, table: &'static Table) {
        if self.context.is_full() {
            self.context.wrong(&entry.key_span, "", "");
            return;
        }
        let name = &entry.key;
        let path = self.key_path(name);
        if let Some(variants) = &table.variants {
            let owners: Vec<&str> = variants
                .list
                .iter()
                .filter(|variant| variant.keys.iter().any(|key| key.name == name))
                .map(|variant| variant.name)
                .collect();
            if !owners.is_empty() {
                let message = format!("`{name}` does not go with {} = \"{}\"", variants.by, self.variant);
                let hint =
                    self.inner_hint(name).unwrap_or_else(|| format!("it belongs to {}", list(&owners)));
                self.context.wrong_with_hint(&entry.key_span, &path, message, hint);
                return;
            }
        }
        let mut names: Vec<&str> = table.variants.iter().map(|variants| variants.by).collect();
        names.extend(self.keys.iter().map(|key| key.name));
        let hint = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "the known keys are {}",
                names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
            ),
        };
        self.context.wrong_with_hint(
            &entry.key_span,
            &path,
            format!("`{name}` is not a known key here"),
            hint,
        );
    }

    /// Where the key belongs into tables of this one, as that of a coordinate into the coordinate's.
    fn inner_hint(&self, name: &str) -> Option<String> {
        let owners: Vec<&&Key> = self
            .keys
            .iter()
            .filter(|key| matches!(key.shape, Shape::Table(table) if table.keys.iter().any(|key| key.name == name)))
            .filter(|key| self.variant.is_empty() || key.need == Need::Default("free"))
            .collect();
        let first = owners.first()?;
        let Shape::Table(table) = first.shape else { return None };
        let inner = table.keys.iter().find(|key| key.name == name)?;
        let names: Vec<String> = owners.iter().map(|key| format!("`{}`", key.name)).collect();
        Some(format!(
            "it goes into the table of a coordinate ({}), for example `{} = {{ {name} = {} }}`",
            names.join(", "),
            first.name,
            inner.example
        ))
    }

    fn missing(&self, key: &Key) -> Reported {
        let message = format!("the key `{}` is missing", key.name);
        let hint = example(key);
        self.context.wrong_with_hint(&self.place, &self.path, message, hint)
    }

    /// Records that a key is missing which is required only in this case.
    pub(crate) fn missing_key(&self, name: &str) -> Reported {
        match self.keys.iter().find(|key| key.name == name) {
            Some(key) => self.missing(key),
            None => self.wrong(format!("the key `{name}` is missing")),
        }
    }

    /// Records a problem of the table as a whole.
    pub(crate) fn wrong(&self, message: impl Into<String>) -> Reported {
        self.context.wrong(&self.place, &self.path, message)
    }

    pub(crate) fn wrong_with_hint(&self, message: impl Into<String>, hint: impl Into<String>) -> Reported {
        self.context.wrong_with_hint(&self.place, &self.path, message, hint)
    }

    /// Records a problem of one key.
    pub(crate) fn wrong_at(
        &self,
        key: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Reported {
        let span = self.node.get(key).map_or(&self.place, |entry| &entry.node.span);
        self.context.wrong_with_hint(span, &self.key_path(key), message, hint)
    }

    pub(crate) fn key_path(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_string() } else { format!("{}.{key}", self.path) }
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.node.get(key).is_some()
    }

    pub(crate) fn keys(&self) -> &[&'static Key] {
        &self.keys
    }

    pub(crate) fn entry(&self, name: &str) -> Option<(&'c Entry, &'static Key)> {
        let key = self.keys.iter().find(|key| key.name == name);
        debug_assert!(key.is_some(), "`{name}` is not in the descriptor of `{}`", self.path);
        Some((self.node.get(name)?, key?))
    }

    /// A table within this one.
    pub(crate) fn table(&self, name: &str) -> Read<Option<Reader<'c, 'a>>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let (Shape::Table(table) | Shape::Data(table)) = key.shape else { return Err(Reported) };
        Reader::open(self.context, entry, table, &self.key_path(name)).map(Some)
    }

    /// A table, or each table of a list.
    pub(crate) fn tables(&self, name: &str) -> Read<Vec<Reader<'c, 'a>>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(Vec::new()) };
        let Shape::Tables(table) = key.shape else { return Err(Reported) };
        let path = self.key_path(name);
        let Value::List(list) = &entry.node.value else {
            return Reader::open(self.context, entry, table, &path).map(|reader| vec![reader]);
        };
        let opened: Vec<Read<Reader<'c, 'a>>> = list
            .iter()
            .enumerate()
            .map(|(i, node)| {
                let place = node.span.start..node.span.start + 1;
                Reader::open_node(self.context, node, &place, table, &format!("{path}[{i}]"))
            })
            .collect();
        opened.into_iter().collect()
    }
}

fn example(key: &Key) -> String {
    format!("for example `{} = {}`", key.name, key.example)
}

/// `"a", "b", "c"`.
pub(crate) fn list(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}
