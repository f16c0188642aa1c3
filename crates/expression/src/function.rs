//! What a bound expression becomes: a function of one variable, or a formula over slots.

use crate::jet::Jet;
use crate::program::Program;
use crate::{Binding, Expression, ExpressionError, Kind, Reference};

/// A real function of one variable in SI units, all parameters folded in.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    pub(crate) text: String,
    pub(crate) program: Program,
}

impl Function {
    /// The function that is `value` everywhere.
    pub fn constant(value: f64) -> Self {
        Self { text: value.to_string(), program: Program::constant(value) }
    }

    /// Parses an expression of the one variable `variable`, numbers in SI units.
    pub fn parse(text: &str, variable: &str) -> Result<Self, ExpressionError> {
        let expression = Expression::parse_with_variable(text, variable)?;
        let lowered = expression.lower(&mut |reference| {
            if reference.name() == Some(variable) {
                Ok(Binding::Variable(Kind::Plain))
            } else {
                Err(unknown(reference, text, variable))
            }
        })?;
        Ok(lowered.function())
    }

    /// f(x).
    pub fn value(&self, x: f64) -> f64 {
        self.program.run(x, &[])
    }

    /// f(x) and its first three derivatives, exact (truncated Taylor arithmetic).
    pub fn jet(&self, x: f64) -> [f64; 4] {
        self.program.run(Jet::variable(x), &[]).derivatives()
    }

    /// The value if the function does not depend on its variable.
    pub fn as_constant(&self) -> Option<f64> {
        self.program.as_constant()
    }

    /// The text it was parsed from.
    pub fn text(&self) -> &str {
        &self.text
    }
}

fn unknown(reference: &Reference, text: &str, variable: &str) -> ExpressionError {
    let name = &text[reference.span.clone()];
    ExpressionError::new(format!("`{name}` is not known here"), reference.span.clone())
        .with_hint(format!("the variable is `{variable}`"))
}

/// An expression over numbered slots, compiled: what an output is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub(crate) text: String,
    pub(crate) program: Program,
}

impl Formula {
    /// The formula that is the slot of this number.
    pub fn slot(slot: usize) -> Self {
        let instructions = vec![crate::program::Instruction::Slot(slot)];
        Self { text: format!("slot {slot}"), program: Program { instructions } }
    }

    /// The slot, if it is nothing else.
    pub fn as_slot(&self) -> Option<usize> {
        match self.program.instructions.as_slice() {
            [crate::program::Instruction::Slot(slot)] => Some(*slot),
            _ => None,
        }
    }

    /// The same formula with slot k renamed to `slots[k]`.
    pub fn renamed(&self, slots: &[usize]) -> Self {
        let mut renamed = self.clone();
        for instruction in &mut renamed.program.instructions {
            if let crate::program::Instruction::Slot(slot) = instruction {
                *slot = slots.get(*slot).copied().unwrap_or(usize::MAX);
            }
        }
        renamed
    }

    /// The formula that is `value` whatever the slots are.
    pub fn constant(value: f64) -> Self {
        Self { text: value.to_string(), program: Program::constant(value) }
    }

    /// Where the slots run along the line `slots + t rates`: the value at t = 0 and its first three derivatives by t, exact
    /// (truncated Taylor arithmetic).
    pub fn along(&self, slots: &[f64], rates: &[f64]) -> [f64; 4] {
        let line: Vec<Jet> = slots.iter().zip(rates).map(|(value, rate)| Jet::line(*value, *rate)).collect();
        self.program.run(Jet::constant(0.0), &line).derivatives()
    }

    /// The numbers of its slots, each as often as it stands there.
    pub fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        self.program.slots()
    }

    /// Is it a polynomial of at most first degree in these slots, whatever the others are? What only happens to be straight
    /// somewhere, as an absolute value is, does not count.
    pub fn is_linear_in(&self, moving: &dyn Fn(usize) -> bool) -> bool {
        self.program.degree(moving).is_some_and(|degree| degree <= 1)
    }

    /// The value with the given slot values; NaN where a slot is missing.
    pub fn evaluate(&self, slots: &[f64]) -> f64 {
        self.program.run(0.0, slots)
    }

    /// The text it was parsed from.
    pub fn text(&self) -> &str {
        &self.text
    }
}
