//! Reading one table by its descriptor.

use crate::context::{Context, Read, Reported};
use crate::format::{Key, Named, Need, Shape, Table};
use crate::tree::{Entry, Node, Value};
use flexura_expression::{Dimension, Function, Kind, Quantity, nearest};
use flexura_model::{At, BodyId, Mount, Profile};
use flexura_spatial::Vector3;
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

    fn expected(&self, node: &Node, path: &str, key: &Key) -> Reported {
        let message = format!("expected {}, found {}", key.shape.wanted(), node.kind());
        self.context.wrong_with_hint(&node.span, path, message, example(key))
    }

    fn number_in(
        &self,
        node: &Node,
        path: &str,
        key: &Key,
        dimension: &Dimension,
        infinite: bool,
    ) -> Read<Quantity> {
        let Some(quantity) = self.context.quantity(node, path, infinite)? else {
            let wanted = if matches!(key.shape, Shape::Number(_)) {
                key.shape.wanted()
            } else {
                dimension.to_string()
            };
            let message = format!("expected {wanted}, found {}", node.kind());
            return Err(self.context.wrong_with_hint(&node.span, path, message, example(key)));
        };
        if !quantity.kind.fits(dimension) {
            let message = format!("expected {dimension}, found {}", quantity.kind.dimension());
            return Err(self.context.wrong_with_hint(&node.span, path, message, example(key)));
        }
        Ok(quantity)
    }

    pub(crate) fn quantity(&self, name: &str) -> Read<Option<Quantity>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        self.number_in(&entry.node, &self.key_path(name), key, &key.shape.dimension(), false).map(Some)
    }

    pub(crate) fn number(&self, name: &str) -> Read<Option<f64>> {
        Ok(self.quantity(name)?.map(|quantity| quantity.value))
    }

    /// A list of a fixed number of numbers.
    pub(crate) fn numbers<const N: usize>(&self, name: &str) -> Read<Option<[Quantity; N]>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        self.numbers_in(&entry.node, &self.key_path(name), key, &[key.shape.dimension(); N]).map(Some)
    }

    pub(crate) fn numbers_in<const N: usize>(
        &self,
        node: &Node,
        path: &str,
        key: &Key,
        dimensions: &[Dimension; N],
    ) -> Read<[Quantity; N]> {
        let list = self.list_of(node, path, key, N)?;
        let mut values = [Quantity::plain(0.0); N];
        let mut result = Ok(());
        for (i, (item, dimension)) in list.iter().zip(dimensions).enumerate() {
            match self.number_in(item, &format!("{path}[{i}]"), key, dimension, false) {
                Ok(quantity) => values[i] = quantity,
                Err(Reported) => result = Err(Reported),
            }
        }
        result.map(|()| values)
    }

    fn list_of<'n>(&self, node: &'n Node, path: &str, key: &Key, count: usize) -> Read<&'n [Node]> {
        let Value::List(list) = &node.value else { return Err(self.expected(node, path, key)) };
        if list.len() != count {
            let message = format!("expected {count} numbers, found {}", list.len());
            return Err(self.context.wrong_with_hint(&node.span, path, message, example(key)));
        }
        Ok(list)
    }

    pub(crate) fn vector(&self, name: &str) -> Read<Option<Vector3<f64>>> {
        let numbers = self.numbers::<3>(name)?;
        Ok(numbers.map(|numbers| Vector3::from(numbers.map(|quantity| quantity.value))))
    }

    /// A direction, made a unit vector; zero is refused.
    pub(crate) fn direction(&self, name: &str) -> Read<Option<Vector3<f64>>> {
        let Some(vector) = self.vector(name)? else { return Ok(None) };
        // Scaled first, so that neither tiny nor huge components are lost in the squares.
        let scale = vector.amax();
        if scale == 0.0 {
            return Err(self.wrong_at(
                name,
                "a direction must not be zero",
                format!("for example `{name} = [1, 0, 0]`"),
            ));
        }
        Ok(Some((vector / scale).normalize()))
    }

    pub(crate) fn text(&self, name: &str) -> Read<Option<&'c str>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        match &entry.node.value {
            Value::Text(text) => Ok(Some(text)),
            _ => Err(self.expected(&entry.node, &self.key_path(name), key)),
        }
    }

    pub(crate) fn flag(&self, name: &str) -> Read<Option<bool>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        match &entry.node.value {
            Value::Flag(flag) => Ok(Some(*flag)),
            _ => Err(self.expected(&entry.node, &self.key_path(name), key)),
        }
    }

    pub(crate) fn choice(&self, name: &str) -> Read<Option<&'static str>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let path = self.key_path(name);
        let (Value::Text(text), Shape::Choice(words)) = (&entry.node.value, key.shape) else {
            return Err(self.expected(&entry.node, &path, key));
        };
        if let Some((word, _)) = words.iter().find(|(word, _)| word == text) {
            return Ok(Some(word));
        }
        let names: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let hint = match nearest(text, names.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("there are {}", list(&names)),
        };
        Err(self.context.wrong_with_hint(
            &entry.node.span,
            &path,
            format!("there is no {name} \"{text}\""),
            hint,
        ))
    }

    /// The position of the named thing in the model's list.
    pub(crate) fn name(&self, name: &str) -> Read<Option<usize>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let (Value::Text(text), Shape::Name(named)) = (&entry.node.value, key.shape) else {
            return Err(self.expected(&entry.node, &self.key_path(name), key));
        };
        self.resolve(&entry.node, &self.key_path(name), named, text).map(Some)
    }

    fn resolve(&self, node: &Node, path: &str, named: Named, text: &str) -> Read<usize> {
        if let Some(position) = self.context.position(named, text) {
            return Ok(position);
        }
        let (message, hint) = if named == Named::Body && text == "ground" {
            ("the ground does not move, so nothing can load it".to_string(), "name a body".to_string())
        } else {
            self.context.unknown_name(named, text)
        };
        Err(self.context.wrong_with_hint(&node.span, path, message, hint))
    }

    pub(crate) fn body(&self, name: &str) -> Read<Option<Mount>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        match &entry.node.value {
            Value::Text(text) => self.body_in(&entry.node, &self.key_path(name), text).map(Some),
            _ => Err(self.expected(&entry.node, &self.key_path(name), key)),
        }
    }

    pub(crate) fn body_in(&self, node: &Node, path: &str, text: &str) -> Read<Mount> {
        if text == "ground" {
            return Ok(Mount::Ground);
        }
        self.resolve(node, path, Named::BodyOrGround, text).map(|position| Mount::Body(BodyId(position)))
    }

    /// A place along a beam: a plain number is a fraction.
    pub(crate) fn station(&self, name: &str) -> Read<Option<At>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        self.station_in(&entry.node, &self.key_path(name), key).map(Some)
    }

    pub(crate) fn station_in(&self, node: &Node, path: &str, key: &Key) -> Read<At> {
        let Some(quantity) = self.context.quantity(node, path, false)? else {
            let message = format!("expected {}, found {}", Shape::Station.describe(), node.kind());
            return Err(self.context.wrong_with_hint(
                &node.span,
                path,
                message,
                format!("for example `{} = 0.5`", key.name),
            ));
        };
        station(quantity).ok_or_else(|| {
            let found = quantity.kind.dimension();
            self.context.wrong(
                &node.span,
                path,
                format!("expected {}, found {found}", Shape::Station.describe()),
            )
        })
    }

    /// A number or an expression of s.
    pub(crate) fn profile(&self, name: &str) -> Read<Option<Profile>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        self.profile_in(&entry.node, &self.key_path(name), key).map(Some)
    }

    pub(crate) fn profile_in(&self, node: &Node, path: &str, key: &Key) -> Read<Profile> {
        let dimension = key.shape.dimension();
        let infinite = matches!(key.shape, Shape::Stiffness(_));
        let Value::Text(_) = &node.value else {
            return self
                .number_in(node, path, key, &dimension, infinite)
                .map(|quantity| Profile::Constant(quantity.value));
        };
        let function = self.function_in(node, path, &dimension, "s", Kind::Of(Dimension::LENGTH))?;
        match function.as_constant() {
            Some(value) if value.is_nan() || (value.is_infinite() && !infinite) => {
                Err(self.context.wrong(&node.span, path, "must be a finite number"))
            }
            Some(value) => Ok(Profile::Constant(value)),
            None => Ok(Profile::Function(function)),
        }
    }

    /// An expression of a variable. Where no unit is mentioned at all, everything is in SI units;
    /// otherwise the variable has its dimension.
    pub(crate) fn function_in(
        &self,
        node: &Node,
        path: &str,
        dimension: &Dimension,
        variable: &str,
        kind: Kind,
    ) -> Read<Function> {
        let text = match &node.value {
            Value::Text(text) => text,
            Value::Number(_) => {
                let quantity = self.context.quantity(node, path, false)?.ok_or(Reported)?;
                return Ok(Function::constant(quantity.value));
            }
            _ => {
                let message =
                    format!("expected a number or an expression of {variable}, found {}", node.kind());
                return Err(self.context.wrong(&node.span, path, message));
            }
        };
        let lowered = self.context.lower_either(node, path, text, variable, kind)?;
        if let Some(span) = &lowered.not_finite {
            let span = self.context.inner(node, span);
            return Err(self.context.wrong(&span, path, "the expression gives no finite number"));
        }
        if !lowered.kind.fits(dimension) {
            let mut problem = self.context.problem(
                &node.span,
                path,
                format!("expected {dimension}, found {}", lowered.kind.dimension()),
            );
            if variable == "s" && lowered.constant().is_none() {
                problem = problem.hint("here `s` is the arc length in metres, never the second");
            } else if let Some(key) = self.keys.iter().find(|key| path.ends_with(key.name)) {
                problem = problem.hint(example(key));
            }
            return Err(self.context.record(problem));
        }
        Ok(lowered.function())
    }

    /// Three numbers or expressions of s.
    pub(crate) fn profiles(&self, name: &str) -> Read<Option<[Profile; 3]>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let path = self.key_path(name);
        let list = self.list_of(&entry.node, &path, key, 3)?;
        let [a, b, c] = [0, 1, 2].map(|i| self.profile_in(&list[i], &format!("{path}[{i}]"), key));
        Ok(Some([a?, b?, c?]))
    }

    /// A table within this one.
    pub(crate) fn table(&self, name: &str) -> Read<Option<Reader<'c, 'a>>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let Shape::Table(table) = key.shape else { return Err(Reported) };
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

/// A fraction of a beam's length, or a length.
pub(crate) fn station(quantity: Quantity) -> Option<At> {
    match quantity.kind {
        Kind::Plain | Kind::Of(Dimension::NUMBER) => Some(At::Fraction(quantity.value)),
        Kind::Of(Dimension::LENGTH) => Some(At::Length(quantity.value)),
        Kind::Of(_) => None,
    }
}

fn example(key: &Key) -> String {
    format!("for example `{} = {}`", key.name, key.example)
}

/// `"a", "b", "c"`.
pub(crate) fn list(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}
