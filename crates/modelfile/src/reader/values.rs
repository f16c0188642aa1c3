//! Values behind the keys of a table: numbers, vectors, texts, names, places, functions.

use super::{Reader, example, list};
use crate::context::{Doubt, Read, Reported};
use crate::format::{Key, Named, Shape};
use crate::tree::{Node, Value};
use flexura_expression::{Dimension, Function, Kind, Quantity, nearest};
use flexura_model::{At, BodyId, Mount, Profile, Rule, direction_of};
use flexura_spatial::Vector3;
use std::f64::consts::TAU;

/// A full turn, with what people round it up to.
const TURN: f64 = 1.000_003 * TAU;
/// Larger counts are mistakes.
const MOST_COUNT: f64 = 1e9;

impl<'c> Reader<'c, '_> {
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
            let wanted = match key.shape {
                Shape::Number(_) | Shape::Notched(_) | Shape::Count | Shape::FlagOrCount => {
                    key.shape.wanted()
                }
                _ => dimension.to_string(),
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

    /// More than a full turn without a unit is rather meant in degrees.
    fn doubt_radians(&self, node: &Node, path: &str, dimension: &Dimension, quantity: &Quantity) {
        let value = quantity.value;
        if !dimension.is_angle() || quantity.kind != Kind::Plain || value.abs() <= TURN {
            return;
        }
        let hint = match &node.value {
            Value::Text(text) => {
                format!("write `{text} deg` if it is one number, else give its parts their units")
            }
            _ => format!("write `\"{value} deg\"`, or `\"{value} rad\"` if it is meant so"),
        };
        self.context.doubt(Doubt {
            span: node.span.clone(),
            path: path.to_string(),
            message: format!("an angle without a unit is in radians: {value} is {:.1} turns", value / TAU),
            hint,
        });
    }

    pub(crate) fn quantity(&self, name: &str) -> Read<Option<Quantity>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        self.number_in(&entry.node, &self.key_path(name), key, &key.shape.dimension(), false).map(Some)
    }

    pub(crate) fn number(&self, name: &str) -> Read<Option<f64>> {
        let Some(quantity) = self.quantity(name)? else { return Ok(None) };
        if let Some((entry, key)) = self.entry(name) {
            self.doubt_radians(&entry.node, &self.key_path(name), &key.shape.dimension(), &quantity);
        }
        Ok(Some(quantity.value))
    }

    /// A whole number that is not negative.
    pub(crate) fn count(&self, name: &str) -> Read<Option<usize>> {
        let Some((entry, key)) = self.entry(name) else { return Ok(None) };
        let path = self.key_path(name);
        let value = self.number_in(&entry.node, &path, key, &Dimension::NUMBER, false)?.value;
        // Expressions may miss a whole number by rounding.
        let whole = value.round();
        if (value - whole).abs() > 1e-9 * whole.abs().max(1.0) || !(0.0..=MOST_COUNT).contains(&whole) {
            let message = format!("expected {}, found {value}", key.shape.wanted());
            return Err(self.context.wrong_with_hint(&entry.node.span, &path, message, example(key)));
        }
        Ok(Some(whole as usize))
    }

    /// A whole number, or false for none and true for `yes`.
    pub(crate) fn flag_or_count(&self, name: &str, yes: usize) -> Read<Option<usize>> {
        match self.entry(name) {
            None => Ok(None),
            Some((entry, key)) => match &entry.node.value {
                Value::Flag(flag) => Ok(Some(if *flag { yes } else { 0 })),
                Value::Text(text)
                    if text.chars().all(char::is_alphabetic)
                        && !self.context.parameters.contains_key(text) =>
                {
                    let message = format!("expected {}, found \"{text}\"", key.shape.wanted());
                    Err(self.wrong_at(name, message, example(key)))
                }
                _ => self.count(name),
            },
        }
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
                Ok(quantity) => {
                    self.doubt_radians(item, &format!("{path}[{i}]"), dimension, &quantity);
                    values[i] = quantity;
                }
                Err(Reported) => result = Err(Reported),
            }
        }
        result.map(|()| values)
    }

    pub(crate) fn list_of<'n>(
        &self,
        node: &'n Node,
        path: &str,
        key: &Key,
        count: usize,
    ) -> Read<&'n [Node]> {
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
        let path = self.key_path(name);
        if let Some(formulas) = self.context.rules.join_list(&path, vector.into()) {
            self.context.rules.put(path, Rule::Direction(formulas));
        }
        direction_of(&vector).map(Some).ok_or_else(|| {
            self.wrong_at(name, "a direction must not be zero", format!("for example `{name} = [1, 0, 0]`"))
        })
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
        if self.context.is_told(&node.span, path) {
            return Err(self.context.wrong(&node.span, path, ""));
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
        if node.get("notch").is_some() {
            let message = format!("`{}` cannot be a notch here", key.name);
            let hint = "a notch may stand for the width or height of a rectangle and the diameter of a circle, outside of `along`";
            return Err(self.context.wrong_with_hint(&node.span, path, message, hint));
        }
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
            Some(value) => {
                self.context.rules.as_number(path);
                Ok(Profile::Constant(value))
            }
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
}

/// A fraction of a beam's length, or a length.
pub(crate) fn station(quantity: Quantity) -> Option<At> {
    match quantity.kind {
        Kind::Plain | Kind::Of(Dimension::NUMBER) => Some(At::Fraction(quantity.value)),
        Kind::Of(Dimension::LENGTH) => Some(At::Length(quantity.value)),
        Kind::Of(_) => None,
    }
}
