//! What is noted on the way from the file to the model: how each number follows from parameters.
//!
//! Whatever reads a value notes its formula under the path of the value. What is put together of several values (a direction, a
//! rotation, a shear modulus) joins their formulas into one rule under the path that the model knows. A formula that no
//! number of the model takes makes its parameters structural: with another value of these the file must be read again.

use crate::parameters;
use crate::tree::Node;
use flexura_expression::{Expression, Formula, Function, Open, Reference};
use flexura_model::{Model, Rule};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Values under these paths are no numbers of the mechanism: parameters have formulas of their own, and studies stay what they
/// were when a parameter changes.
const ASIDE: [&str; 3] = ["parameter.", "unknown.", "study."];

#[derive(Default)]
pub(crate) struct Rules {
    /// Positions of the parameters.
    positions: BTreeMap<String, usize>,
    rules: RefCell<BTreeMap<String, Rule>>,
    /// How parameters are written by others.
    formulas: RefCell<BTreeMap<String, Formula>>,
    /// Parameters on which more than numbers depend.
    structural: RefCell<BTreeSet<String>>,
}

impl Rules {
    pub fn new(root: &Node) -> Self {
        let declared = parameters::declared(root);
        let positions = declared.iter().enumerate().map(|(i, one)| (one.name.to_string(), i)).collect();
        Self { positions, ..Self::default() }
    }

    fn open(&self, expression: &Expression, variable: Option<&str>) -> Option<Function> {
        expression.open(&mut |reference| match reference.name()? {
            name if Some(name) == variable => Some(Open::Variable),
            name => self.positions.get(name).map(|slot| Open::Slot(*slot)),
        })
    }

    /// The formula of an expression in which what is no parameter is worked out by `value`.
    pub fn open_with(
        &self,
        expression: &Expression,
        value: &mut dyn FnMut(&Reference) -> Option<f64>,
    ) -> Option<Formula> {
        let open = expression.open(&mut |reference| {
            let slot = reference.name().and_then(|name| self.positions.get(name));
            slot.map(|slot| Open::Slot(*slot)).or_else(|| value(reference).map(Open::Value))
        });
        open.map(Function::formula)
    }

    /// Notes the formula of a value, or of a function of the variable.
    pub fn record(&self, path: &str, expression: &Expression, variable: Option<&str>) {
        if expression.references().iter().all(|reference| reference.name() == variable && variable.is_some())
        {
            return;
        }
        let Some(function) = self.open(expression, variable) else {
            self.fix(expression);
            return;
        };
        if function.slots().next().is_some() {
            let rule = match variable {
                Some(_) => Rule::Function(function),
                None => Rule::Number(function.formula()),
            };
            self.rules.borrow_mut().insert(path.to_string(), rule);
        }
    }

    /// Notes how a parameter is written, by others or by a number.
    pub fn record_parameter(&self, name: &str, expression: Option<&Expression>) {
        let mut formulas = self.formulas.borrow_mut();
        formulas.remove(name);
        let function = expression.and_then(|expression| self.open(expression, None));
        if let Some(function) = function.filter(|function| function.slots().next().is_some()) {
            formulas.insert(name.to_string(), function.formula());
        }
    }

    /// With a parameter of this expression at another value, more than numbers may change.
    pub fn fix(&self, expression: &Expression) {
        let mut structural = self.structural.borrow_mut();
        for reference in expression.references() {
            structural.extend(reference.name().map(str::to_string));
        }
    }

    /// The same for a text.
    pub fn fix_text(&self, text: &str) {
        if let Ok(expression) = Expression::parse(text) {
            self.fix(&expression);
        }
    }

    pub fn fix_name(&self, name: &str) {
        self.structural.borrow_mut().insert(name.to_string());
    }

    fn take(&self, path: &str) -> Option<Formula> {
        let mut rules = self.rules.borrow_mut();
        match rules.get(path) {
            Some(Rule::Number(_)) => match rules.remove(path) {
                Some(Rule::Number(formula)) => Some(formula),
                _ => None,
            },
            _ => None,
        }
    }

    pub fn put(&self, path: String, rule: Rule) {
        self.rules.borrow_mut().insert(path, rule);
    }

    /// The formulas of some values, taken away; None where all of them are plain numbers. A value without a formula is given.
    pub fn join<const N: usize>(&self, paths: [String; N], values: [f64; N]) -> Option<[Formula; N]> {
        let taken = paths.map(|path| self.take(&path));
        if taken.iter().all(Option::is_none) {
            return None;
        }
        let mut values = values.into_iter();
        Some(taken.map(|formula| {
            let value = values.next().unwrap_or(f64::NAN);
            formula.unwrap_or_else(|| Formula::constant(value))
        }))
    }

    /// Joins the formulas of a list.
    pub fn join_list<const N: usize>(&self, path: &str, values: [f64; N]) -> Option<[Formula; N]> {
        self.join(std::array::from_fn(|i| format!("{path}[{i}]")), values)
    }

    /// The value of one path belongs to others.
    pub fn rename(&self, from: &str, to: &[String]) {
        if let Some(formula) = self.take(from) {
            for path in to {
                self.put(path.clone(), Rule::Number(formula.clone()));
            }
        }
    }

    /// The function under the path is a number after all.
    pub fn as_number(&self, path: &str) {
        let mut rules = self.rules.borrow_mut();
        if let Some(Rule::Function(function)) = rules.get(path) {
            let formula = function.clone().formula();
            rules.insert(path.to_string(), Rule::Number(formula));
        }
    }

    /// The components of a direction, where they have formulas.
    pub fn direction(&self, path: &str) -> Option<[Formula; 3]> {
        match self.rules.borrow().get(path) {
            Some(Rule::Direction(formulas)) => Some(formulas.clone()),
            _ => None,
        }
    }

    /// Takes away the components of a direction.
    pub fn take_direction(&self, path: &str) -> Option<[Formula; 3]> {
        let mut rules = self.rules.borrow_mut();
        match rules.get(path) {
            Some(Rule::Direction(_)) => match rules.remove(path) {
                Some(Rule::Direction(formulas)) => Some(formulas),
                _ => None,
            },
            _ => None,
        }
    }

    /// Gives the model its rules, and its parameters their formulas.
    pub fn hand_over(&self, model: &mut Model) {
        let mut formulas = self.formulas.take();
        for parameter in &mut model.parameters {
            parameter.formula = formulas.remove(&parameter.name).map(Arc::new);
        }
        let mut rules = self.rules.take();
        let is_aside = |path: &str| ASIDE.iter().any(|aside| path.starts_with(aside));
        rules.retain(|path, _| !is_aside(path) || (path.starts_with("unknown.") && path.contains(".range[")));
        let used: BTreeMap<String, Vec<usize>> =
            rules.iter().map(|(path, rule)| (path.clone(), rule.parameters().collect())).collect();
        let lost = model.bind_all(rules);
        let structural = self.structural.take();
        for parameter in &mut model.parameters {
            parameter.is_structural = structural.contains(&parameter.name);
        }
        for position in lost.iter().filter_map(|path| used.get(path)).flatten() {
            if let Some(parameter) = model.parameters.get_mut(*position) {
                parameter.is_structural = true;
            }
        }
    }
}
