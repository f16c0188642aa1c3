//! Other values of parameters, and what follows from them.

use super::rule::{Value, Wrong};
use super::visit::{Item, Step, Visit};
use super::{Binding, Bindings, Rule, order};
use crate::{Issue, Model, Parameter, Quantity};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Puts the values of rules in their places.
struct Setter<'b> {
    bindings: std::iter::Peekable<std::slice::Iter<'b, Binding>>,
    slots: &'b [f64],
    place: usize,
    wrong: Option<(Arc<str>, Wrong)>,
}

impl Visit for Setter<'_> {
    fn enter(&mut self, _: Step<'_>) {}

    fn leave(&mut self) {}

    fn item(&mut self, item: Item<'_>) {
        let place = self.place;
        self.place += 1;
        let Some(binding) = self.bindings.next_if(|binding| binding.place == place) else { return };
        match (binding.rule.value(self.slots), item) {
            (Ok(Value::Number(value)), Item::Number(number)) => *number = value,
            (Ok(Value::Vector(value)), Item::Direction(direction)) => *direction = value,
            (Ok(Value::Rotation(value)), Item::Rotation(rotation)) => *rotation = value,
            (Ok(Value::Function(value)), Item::Function(function)) => *function = value,
            (Ok(_), _) => debug_assert!(false, "the rule of {} is of another kind", binding.path),
            (Err(wrong), _) => {
                self.wrong.get_or_insert_with(|| (binding.path.clone(), wrong));
            }
        }
    }
}

/// What of a model decides where its numbers stand: how many there are, and the names.
struct Parts(u64);

impl Visit for Parts {
    fn enter(&mut self, step: Step<'_>) {
        if let Step::Named(_, name) = step {
            for byte in name.bytes() {
                self.add(u64::from(byte));
            }
        }
    }

    fn leave(&mut self) {}

    fn item(&mut self, item: Item<'_>) {
        self.add(match item {
            Item::Number(_) => 256,
            Item::Direction(_) => 257,
            Item::Rotation(_) => 258,
            Item::Function(_) => 259,
        });
    }
}

impl Parts {
    /// Fowler, Noll and Vo's hash.
    fn add(&mut self, value: u64) {
        self.0 = (self.0 ^ value).wrapping_mul(0x0100_0000_01b3);
    }
}

/// Other values of what decides of which parts the mechanism is made are for whoever reads the model.
fn refuse_structural(parameter: &Parameter, value: f64) -> Result<(), Issue> {
    if !parameter.is_structural || parameter.value == value {
        return Ok(());
    }
    Err(Issue {
        path: format!("parameter.{}", parameter.name),
        message: "it decides of which parts the mechanism is made".to_string(),
        hint: Some("read the file again with another value".to_string()),
    })
}

impl Model {
    pub(super) fn parts(&mut self) -> u64 {
        let mut parts = Parts(0xcbf2_9ce4_8422_2325);
        self.visit(&mut parts);
        parts.0
    }

    /// The model with other values of some parameters: positions in [`Model::parameters`], and values (SI). The others keep
    /// theirs, but for those that are written by others, which follow, and every number that has a rule. A parameter that
    /// is given a value is no longer written by others.
    ///
    /// # Errors
    /// As [`Model::set`].
    pub fn at(&self, values: &[(usize, f64)]) -> Result<Model, Issue> {
        let mut model = self.clone();
        model.set(values)?;
        Ok(model)
    }

    /// [`Model::at`] in place. After an error the model is between two values, and only good for another call.
    ///
    /// # Errors
    /// A parameter that is not there or is [`crate::Parameter::is_structural`]; a rule that gives no number or direction with these
    /// values. What is unsound for another reason, such as a negative length, is left to [`Model::validate_mechanism`].
    pub fn set(&mut self, values: &[(usize, f64)]) -> Result<(), Issue> {
        for (position, value) in values {
            let Some(parameter) = self.parameters.get_mut(*position) else {
                return Err(Issue {
                    path: "parameter".to_string(),
                    message: format!("there is no parameter {position}"),
                    hint: None,
                });
            };
            refuse_structural(parameter, *value)?;
            parameter.value = *value;
            parameter.formula = None;
        }
        let bindings = self.placed();
        let mut slots: Vec<f64> = self.parameters.iter().map(|parameter| parameter.value).collect();
        for position in &bindings.order {
            let Some(formula) = self.parameters.get(*position).and_then(|p| p.formula.clone()) else {
                continue;
            };
            let value = formula.evaluate(&slots);
            let parameter = &mut self.parameters[*position];
            if !value.is_finite() {
                return Err(Issue {
                    path: format!("parameter.{}", parameter.name),
                    message: "the expression gives no finite number".to_string(),
                    hint: None,
                });
            }
            refuse_structural(parameter, value)?;
            (parameter.value, slots[*position]) = (value, value);
        }
        let bindings_list = bindings.list.iter().peekable();
        let mut setter = Setter { bindings: bindings_list, slots: &slots, place: 0, wrong: None };
        if !bindings.list.is_empty() {
            self.visit(&mut setter);
        }
        match setter.wrong {
            None => Ok(()),
            Some((path, (message, hint))) => {
                Err(Issue { path: path.to_string(), message, hint: Some(hint.to_string()) })
            }
        }
    }

    /// The bindings at their present places: someone may have added parts, or taken some away.
    fn placed(&mut self) -> Arc<Bindings> {
        let parts = self.parts();
        let orderly = self.bindings.order.len() == self.parameters.len();
        if (parts == self.bindings.parts || self.bindings.list.is_empty()) && orderly {
            return self.bindings.clone();
        }
        let rules: BTreeMap<String, Arc<Rule>> =
            self.bindings.iter().map(|b| (b.path.to_string(), b.rule.clone())).collect();
        let list = self.find(&rules);
        self.bindings = Arc::new(Bindings { list, parts, order: order(&self.parameters) });
        self.bindings.clone()
    }

    /// Which parameters change when this one does: itself, and those that are written by it.
    fn following(&self, parameter: usize) -> Vec<bool> {
        let mut moving = vec![false; self.parameters.len()];
        if let Some(own) = moving.get_mut(parameter) {
            *own = true;
        }
        for position in order(&self.parameters) {
            if let Some(formula) = &self.parameters[position].formula
                && formula.slots().any(|slot| moving.get(slot).copied().unwrap_or(false))
            {
                moving[position] = true;
            }
        }
        moving
    }

    /// Does anything of the mechanism, its outputs or targets hang on this parameter, directly or by others?
    pub fn depends_on(&self, parameter: usize) -> bool {
        let moving = self.following(parameter);
        let is_moving = |slot: usize| moving.get(slot).copied().unwrap_or(false);
        self.parameters.iter().zip(&moving).any(|(parameter, moving)| *moving && parameter.is_structural)
            || self.bindings.iter().any(|binding| binding.rule.parameters().any(is_moving))
            || self.read_by(&is_moving)
    }

    /// Does an output or a target read a parameter that moves?
    fn read_by(&self, is_moving: &dyn Fn(usize) -> bool) -> bool {
        let outputs = self.outputs.iter().chain(self.targets.iter().map(|target| &target.output));
        outputs
            .flat_map(|output| &output.probes)
            .any(|probe| probe.quantity == Quantity::Parameter && is_moving(probe.component))
    }

    /// The rules that this parameter moves; None where a parameter on the way is structural.
    pub fn moved_by(&self, parameter: usize) -> Option<Vec<&Binding>> {
        let moving = self.following(parameter);
        let is_moving = |slot: usize| moving.get(slot).copied().unwrap_or(false);
        let structural =
            self.parameters.iter().zip(&moving).any(|(parameter, moving)| *moving && parameter.is_structural);
        let moved = |binding: &&Binding| binding.rule.parameters().any(is_moving);
        (!structural).then(|| self.bindings.iter().filter(moved).collect())
    }

    /// Are the parameters that follow this one, and the numbers that it moves, polynomials of it of at most first degree?
    pub fn is_linear_in(&self, parameter: usize) -> bool {
        let moving = self.following(parameter);
        let is_moving = |slot: usize| moving.get(slot).copied().unwrap_or(false);
        let by_others = self.parameters.iter().zip(&moving).enumerate().all(|(i, (own, moving))| {
            let formula = own.formula.as_ref().filter(|_| *moving && i != parameter);
            formula.is_none_or(|formula| formula.is_linear_in(&is_moving))
        });
        by_others && self.bindings.iter().all(|binding| binding.rule.is_linear_in(&is_moving))
    }

    /// By how much the values of all parameters change with one of them: exact, by truncated Taylor arithmetic.
    pub fn parameter_rates(&self, parameter: usize) -> Vec<f64> {
        let slots: Vec<f64> = self.parameters.iter().map(|parameter| parameter.value).collect();
        let mut rates = vec![0.0; slots.len()];
        if let Some(own) = rates.get_mut(parameter) {
            *own = 1.0;
        }
        for position in order(&self.parameters) {
            if let Some(formula) =
                self.parameters[position].formula.as_ref().filter(|_| position != parameter)
            {
                rates[position] = formula.along(&slots, &rates)[1];
            }
        }
        rates
    }
}
