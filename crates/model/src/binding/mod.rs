//! Numbers that hang on parameters: where they stand in the model, and the formulas that give them.
//!
//! A number of a [`Model`] is a value, or a value with a [`Rule`] beside it. [`Model::at`] makes the model with other values of
//! its parameters: parameters that are written by others are worked out first, then every bound number. What changes the
//! parts of a mechanism (how often something is repeated, a degree) hangs on no rule; such a parameter is
//! [`Parameter::is_structural`], and only what read the model can make it again.

mod rule;
mod set;
mod visit;
mod visit_joint;

pub use rule::{ALMOST_RIGHT, Rule, direction_of, roll_pitch_yaw};
pub use visit::Part;

use crate::{Issue, Model, Parameter};
use flexura_expression::Formula;
use std::collections::BTreeMap;
use std::sync::Arc;
use visit::{Item, Step, Visit};

/// The rules of a model, each with its place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bindings {
    /// In the order of the places.
    list: Vec<Binding>,
    /// What the places belong to: a model of other parts has others.
    parts: u64,
    /// An order of the parameters in which each comes behind those by which it is written.
    order: Vec<usize>,
}

/// A rule and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// In the words of the model file: `beam.link.length`, `load.push.force[2]`.
    pub path: Arc<str>,
    /// How its value follows from the parameters.
    pub rule: Arc<Rule>,
    /// What the number is to the equations.
    pub part: Part,
    /// Number of the item in the walk over the model.
    place: usize,
}

impl Bindings {
    /// The rules with their places, in the order of the model.
    pub fn iter(&self) -> impl Iterator<Item = &Binding> {
        self.list.iter()
    }

    /// Are there none?
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

/// Finds the places of paths.
struct Finder<'r> {
    rules: &'r BTreeMap<String, Arc<Rule>>,
    found: Vec<Binding>,
    path: String,
    /// Where each step begins in the path.
    lengths: Vec<usize>,
    /// Where `[0]` stands that the file may leave out.
    only: Option<usize>,
    part: Part,
    place: usize,
}

impl Visit for Finder<'_> {
    fn part(&mut self, part: Part) {
        self.part = part;
    }

    fn enter(&mut self, step: Step<'_>) {
        use std::fmt::Write;
        self.lengths.push(self.path.len());
        // Writing to a String cannot fail.
        let _ = match step {
            Step::Named(word, name) => write!(self.path, "{word}.{name}"),
            Step::Quoted(word, name) => write!(self.path, "{word}.\"{name}\""),
            Step::Key(key) if self.path.is_empty() => write!(self.path, "{key}"),
            Step::Key(key) => write!(self.path, ".{key}"),
            Step::Index(i) => write!(self.path, "[{i}]"),
            Step::Table(i, only) => {
                self.only = only.then_some(self.path.len());
                write!(self.path, "[{i}]")
            }
        };
    }

    fn leave(&mut self) {
        let length = self.lengths.pop().unwrap_or_default();
        self.path.truncate(length);
        self.only = self.only.filter(|at| *at < length);
    }

    fn item(&mut self, item: Item<'_>) {
        let mut rule = self.rules.get(&self.path);
        let mut path = self.path.clone();
        if let (None, Some(at)) = (rule, self.only) {
            path.replace_range(at..at + 3, "");
            rule = self.rules.get(&path);
        }
        if let Some(rule) = rule.filter(|rule| fits(&item, rule)) {
            self.found.push(Binding {
                path: path.into(),
                rule: rule.clone(),
                part: self.part,
                place: self.place,
            });
        }
        self.place += 1;
    }
}

fn fits(item: &Item<'_>, rule: &Rule) -> bool {
    match rule {
        Rule::Number(_)
        | Rule::Quotient(..)
        | Rule::Factor { .. }
        | Rule::Offset(_)
        | Rule::ShearModulus { .. }
        | Rule::Reciprocal(_) => matches!(item, Item::Number(_)),
        Rule::Direction(_) | Rule::Across { .. } => matches!(item, Item::Direction(_)),
        Rule::Turn { .. } | Rule::RollPitchYaw(_) | Rule::Quaternion(_) => matches!(item, Item::Rotation(_)),
        Rule::Function(_) => matches!(item, Item::Function(_)),
    }
}

impl Model {
    /// Gives numbers their rules, by their paths, in place of all that there were; the paths at which nothing can have the rule
    /// are returned. The numbers themselves stay as they are.
    pub fn bind_all(&mut self, rules: BTreeMap<String, Rule>) -> Vec<String> {
        let rules: BTreeMap<String, Arc<Rule>> =
            rules.into_iter().map(|(path, rule)| (path, Arc::new(rule))).collect();
        let list = if rules.is_empty() { Vec::new() } else { self.find(&rules) };
        let found: std::collections::BTreeSet<&str> = list.iter().map(|binding| &*binding.path).collect();
        let lost = rules.keys().filter(|path| !found.contains(path.as_str())).cloned().collect();
        let bindings = Bindings { list, parts: self.parts(), order: order(&self.parameters) };
        self.bindings = Arc::new(bindings);
        lost
    }

    fn find(&mut self, rules: &BTreeMap<String, Arc<Rule>>) -> Vec<Binding> {
        let (path, lengths) = (String::new(), Vec::new());
        let mut finder =
            Finder { rules, found: Vec::new(), path, lengths, only: None, part: Part::Other, place: 0 };
        self.visit(&mut finder);
        finder.found
    }

    /// Lets a number follow a formula of parameters: `model.bind("beam.link.length", "2*reach")`. Numbers in the formula
    /// are in SI units, or have a unit behind them.
    ///
    /// # Errors
    /// There is no number at the path, the text is no formula of the parameters, or it gives no sound number.
    pub fn bind(&mut self, path: &str, formula: &str) -> Result<(), Issue> {
        let formula = self.formula(path, formula)?;
        let mut rules: BTreeMap<String, Arc<Rule>> =
            self.bindings.iter().map(|b| (b.path.to_string(), b.rule.clone())).collect();
        rules.insert(path.to_string(), Arc::new(Rule::Number(formula)));
        let list = self.find(&rules);
        if list.iter().all(|binding| &*binding.path != path) {
            return Err(Issue {
                path: path.to_string(),
                message: "there is no number here that a formula could give".to_string(),
                hint: Some("paths are those of the model file, for example `beam.link.length`".to_string()),
            });
        }
        self.bindings = Arc::new(Bindings { list, parts: self.parts(), order: order(&self.parameters) });
        self.set(&[])
    }

    /// Lets a number be nothing but its value again.
    pub fn unbind(&mut self, path: &str) {
        let mut bindings = Bindings::clone(&self.bindings);
        bindings.list.retain(|binding| &*binding.path != path);
        self.bindings = Arc::new(bindings);
    }

    /// Adds a parameter that is a number (SI, `unit` its SI unit as text), and returns its position.
    pub fn add_parameter(&mut self, name: impl Into<String>, value: f64, unit: impl Into<String>) -> usize {
        let parameter = Parameter { name: name.into(), value, unit: unit.into(), ..Parameter::default() };
        self.parameters.push(parameter);
        self.reorder();
        self.parameters.len() - 1
    }

    /// Adds a parameter that is written by others, and returns its position.
    ///
    /// # Errors
    /// The text is no formula of the parameters that are there.
    pub fn add_formula(
        &mut self,
        name: impl Into<String>,
        formula: &str,
        unit: impl Into<String>,
    ) -> Result<usize, Issue> {
        let name = name.into();
        let formula = self.formula(&format!("parameter.{name}"), formula)?;
        let values: Vec<f64> = self.parameters.iter().map(|parameter| parameter.value).collect();
        let position = self.add_parameter(name, formula.evaluate(&values), unit);
        self.parameters[position].formula = Some(Arc::new(formula));
        self.reorder();
        Ok(position)
    }

    fn reorder(&mut self) {
        let mut bindings = Bindings::clone(&self.bindings);
        bindings.order = order(&self.parameters);
        self.bindings = Arc::new(bindings);
    }

    /// Position of the parameter of this name.
    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == name)
    }

    /// A text as a formula over the parameters, its dimensions checked.
    fn formula(&self, path: &str, text: &str) -> Result<Formula, Issue> {
        use flexura_expression::{Expression, ExpressionError, Function, Kind, Open, Quantity};
        let dimension = |unit: &str| {
            let one = Expression::parse(&format!("1 {unit}")).ok()?;
            one.evaluate(&mut |_| Err(ExpressionError::new(String::new(), 0..0))).ok()
        };
        let quantity = |parameter: &Parameter| Quantity {
            value: parameter.value,
            kind: match dimension(&parameter.unit) {
                Some(one) if !parameter.unit.is_empty() => one.kind,
                _ => Kind::Plain,
            },
        };
        let issue = |error: ExpressionError| Issue {
            path: path.to_string(),
            message: error.message,
            hint: error.hint,
        };
        let expression = Expression::parse(text).map_err(issue)?;
        let checked = expression.evaluate(&mut |reference| {
            let position = reference.name().and_then(|name| self.parameter(name));
            position.map(|position| quantity(&self.parameters[position])).ok_or_else(|| {
                let shown = text.get(reference.span.clone()).unwrap_or_default();
                ExpressionError::new(format!("there is no parameter `{shown}`"), reference.span.clone())
            })
        });
        checked.map_err(issue)?;
        let open = expression.open(&mut |reference| self.parameter(reference.name()?).map(Open::Slot));
        open.map(Function::formula).ok_or_else(|| Issue {
            path: path.to_string(),
            message: "the expression holds too much at once".to_string(),
            hint: Some("put parts of it into parameters".to_string()),
        })
    }
}

/// Each behind those by which it is written. A circle, which nothing that reads a model lets pass, stays in the order of the list.
fn order(parameters: &[Parameter]) -> Vec<usize> {
    let needs = |i: usize| parameters[i].formula.iter().flat_map(|formula| formula.slots());
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); parameters.len()];
    let mut open = vec![0usize; parameters.len()];
    for i in 0..parameters.len() {
        for needed in needs(i).filter(|needed| *needed < parameters.len()) {
            users[needed].push(i);
            open[i] += 1;
        }
    }
    let mut order: Vec<usize> = (0..parameters.len()).filter(|i| open[*i] == 0).collect();
    let mut next = 0;
    while next < order.len() {
        for user in &users[order[next]] {
            open[*user] -= 1;
            if open[*user] == 0 {
                order.push(*user);
            }
        }
        next += 1;
    }
    order.extend((0..parameters.len()).filter(|i| open[*i] > 0));
    order
}

#[cfg(test)]
mod tests;
