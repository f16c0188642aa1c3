//! A model written out as a file that reads back as the same model.
//!
//! Numbers are in SI units. One that follows parameters is written as its formula, in the words in which it was read. What the
//! reader makes of several keys (a shear modulus of Poisson's ratio, a rotation of its angles) is written by the keys that its rule
//! is made of; what nothing follows is written by the shortest keys that there are. Not kept: comments, the units of plain
//! numbers, `repeat` (its copies are written out), and points that came from a file beside (they stand in the text).

mod design;
mod fit;
mod results;
mod shapes;
mod studies;
mod things;
mod tree;

use flexura_expression::Formula;
use flexura_model::{At, Issue, Model, Rule};
use flexura_spatial::Vector3;
use std::collections::BTreeMap;
pub(crate) use tree::written_out;
use tree::{Table, Value};

/// The model as the text of a file.
///
/// # Errors
/// What no file can say, as only code can write it: quantities along a beam that are tables of their own, formulas without
/// words. A model that is not sound.
pub fn to_toml(model: &Model) -> Result<String, Issue> {
    let writer = Writer::new(model);
    let mut file = Table::default();
    file.put("format", Value::plain("1"));
    if !model.name.is_empty() {
        file.put("name", Value::text(&model.name));
    }
    if writer.is_bound("gravity") || model.gravity != Vector3::zeros() {
        file.put("gravity", writer.vector("gravity", &model.gravity));
    }
    if writer.is_bound("mass_damping") || model.mass_damping != 0.0 {
        file.put("mass_damping", writer.number("mass_damping", model.mass_damping));
    }
    if let Some(spin) = &model.spin {
        let mut table = Table::default();
        table.put("axis", writer.direction("spin.axis", &spin.axis));
        table.put("rate", writer.number("spin.rate", spin.rate));
        table.put("through", writer.vector("spin.through", &spin.through));
        file.put("spin", Value::Table(table));
    }
    let mut text = file.lines();
    writer.things(&mut text)?;
    writer.results(&mut text);
    writer.studies(&mut text);
    prove(model, &text)?;
    Ok(text)
}

/// Expressions that were made in code may have no words: the text must read back, and its outputs ask for the same.
fn prove(model: &Model, text: &str) -> Result<(), Issue> {
    let again = crate::Document::parse(text, "model.toml").and_then(|document| document.model(&[]));
    let again = again.map_err(|report| {
        let first = report.problems().first();
        Issue {
            path: first.map_or_else(String::new, |problem| problem.path.clone()),
            message: format!(
                "as a file it makes no sense: {}",
                first.map_or("", |problem| problem.message.as_str())
            ),
            hint: first.and_then(|problem| problem.hint.clone()),
        }
    })?;
    match model.outputs.iter().zip(&again.outputs).find(|(own, read)| own.probes != read.probes) {
        None => Ok(()),
        Some((own, _)) => Err(Issue {
            path: format!("output.{}", own.name),
            message: "the text of its formula does not say what it reads off".to_string(),
            hint: Some("make it of a text by the reader, or of a single slot".to_string()),
        }),
    }
}

struct Writer<'m> {
    model: &'m Model,
    rules: BTreeMap<&'m str, &'m Rule>,
    /// The names of parameters.
    names: Vec<&'m str>,
}

impl<'m> Writer<'m> {
    fn new(model: &'m Model) -> Self {
        let rules = model.bindings.iter().map(|binding| (&*binding.path, &*binding.rule)).collect();
        let names = model.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        Self { model, rules, names }
    }

    fn rule(&self, path: &str) -> Option<&'m Rule> {
        self.rules.get(path).copied()
    }

    /// Has anything at the path, or below it, a rule?
    fn is_bound(&self, path: &str) -> bool {
        self.rules
            .range(path..)
            .take_while(|(other, _)| other.starts_with(path))
            .any(|(other, _)| other[path.len()..].is_empty() || other[path.len()..].starts_with(['.', '[']))
    }

    /// A number, or its formula.
    fn number(&self, path: &str, value: f64) -> Value {
        match self.rule(path) {
            Some(Rule::Number(formula) | Rule::Quotient(formula, _)) => Value::text(formula.text()),
            _ => Value::number(value),
        }
    }

    fn numbers(&self, path: &str, values: &[f64]) -> Value {
        let one = |(i, value): (usize, &f64)| self.number(&format!("{path}[{i}]"), *value);
        Value::List(values.iter().enumerate().map(one).collect())
    }

    fn rows<const N: usize>(&self, path: &str, rows: impl IntoIterator<Item = [f64; N]>) -> Value {
        let row = |(i, row): (usize, [f64; N])| self.numbers(&format!("{path}[{i}]"), &row);
        Value::List(rows.into_iter().enumerate().map(row).collect())
    }

    fn vector(&self, path: &str, vector: &Vector3<f64>) -> Value {
        self.numbers(path, vector.as_slice())
    }

    /// A place on a beam: a fraction is a plain number, a length has its unit.
    fn at(&self, path: &str, at: At) -> Value {
        match (self.rule(path), at) {
            (Some(Rule::Number(formula)), _) => Value::text(formula.text()),
            (_, At::Fraction(fraction)) => Value::number(fraction),
            (_, At::Length(length)) => Value::text(&format!("{length:?} m")),
        }
    }

    fn direction(&self, path: &str, vector: &Vector3<f64>) -> Value {
        match self.rule(path) {
            Some(Rule::Direction(formulas)) => texts(formulas),
            _ => Value::List(vector.iter().map(|value| Value::number(*value)).collect()),
        }
    }
}

/// Formulas as a list of texts.
fn texts(formulas: &[Formula]) -> Value {
    Value::List(formulas.iter().map(|formula| Value::text(formula.text())).collect())
}

fn unwritable(path: &str) -> Issue {
    Issue {
        path: path.to_string(),
        message: "a file has no words for this table along the beam".to_string(),
        hint: Some("write it as a function of s".to_string()),
    }
}
