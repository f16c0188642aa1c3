//! Binding references, checking dimensions and compiling, in one walk over the postfix list.

use crate::emit::{Emitter, Folded};
use crate::expression::{Binary, Call, Node};
use crate::program::{Instruction, Program, STACK};
use crate::{Dimension, Expression, ExpressionError, Formula, Function, Kind, Quantity, Reference};
use std::ops::Range;

/// What a reference stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Binding {
    /// A known value.
    Value(Quantity),
    /// The variable of a function.
    Variable(Kind),
    /// A slot of a formula.
    Slot(usize, Kind),
    /// A formula over the same slots.
    Formula(Formula, Kind),
}

/// An expression with everything bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Lowered {
    pub(crate) program: Program,
    pub(crate) text: String,
    /// What is known of the result's dimension.
    pub kind: Kind,
    /// The first operation on constants that gave no finite number.
    pub not_finite: Option<Range<usize>>,
}

impl Lowered {
    /// The value, if it depends on neither variable nor slots.
    pub fn constant(&self) -> Option<f64> {
        self.program.as_constant()
    }

    /// As a function of its variable.
    pub fn function(self) -> Function {
        Function { text: self.text, program: self.program }
    }

    /// As a formula over its slots.
    pub fn formula(self) -> Formula {
        Formula { text: self.text, program: self.program }
    }
}

impl Expression {
    /// Binds every reference by `bind`, checks the dimensions and compiles.
    pub fn lower(
        &self,
        bind: &mut dyn FnMut(&Reference) -> Result<Binding, ExpressionError>,
    ) -> Result<Lowered, ExpressionError> {
        let mut lowering = Lowering::default();
        for item in &self.items {
            match &item.node {
                Node::Number(value, kind) => lowering.push(Instruction::Constant(*value), *kind),
                Node::Reference(reference) => match bind(reference)? {
                    Binding::Value(quantity) => {
                        lowering.push(Instruction::Constant(quantity.value), quantity.kind)
                    }
                    Binding::Variable(kind) => lowering.push(Instruction::Variable, kind),
                    Binding::Slot(slot, kind) => lowering.push(Instruction::Slot(slot), kind),
                    Binding::Formula(formula, kind) => {
                        lowering.kinds.push(kind);
                        lowering.emitter.push_all(formula.program);
                    }
                },
                Node::Negate => {
                    let kind = lowering.last(1)[0];
                    lowering.apply(Instruction::Negate, 1, kind, &item.span);
                }
                Node::Binary(binary) => lowering.binary(*binary, &item.span)?,
                Node::Call(call, count) => lowering.call(*call, *count, &item.span)?,
            }
        }
        let kind = lowering.last(1)[0];
        let program: Program = lowering.emitter.program();
        if program.depth() > STACK {
            return Err(ExpressionError::new(
                format!("the expression holds more than {STACK} unfinished operations at once"),
                self.span(),
            )
            .with_hint("put parts of it into parameters"));
        }
        Ok(Lowered { program, text: self.text.clone(), kind, not_finite: lowering.not_finite })
    }

    /// The value, where every reference is a known value.
    pub fn evaluate(
        &self,
        bind: &mut dyn FnMut(&Reference) -> Result<Quantity, ExpressionError>,
    ) -> Result<Quantity, ExpressionError> {
        let lowered = self.lower(&mut |reference| bind(reference).map(Binding::Value))?;
        match lowered.constant() {
            Some(value) => Ok(Quantity { value, kind: lowered.kind }),
            None => Err(ExpressionError::new("the expression is not constant", self.span())),
        }
    }
}

#[derive(Default)]
struct Lowering {
    emitter: Emitter,
    /// What is known of each operand's dimension.
    kinds: Vec<Kind>,
    not_finite: Option<Range<usize>>,
}

impl Lowering {
    fn push(&mut self, instruction: Instruction, kind: Kind) {
        self.kinds.push(kind);
        self.emitter.push(instruction);
    }

    /// Kinds of the last `count` operands. The parser's list is well formed, so there are as many.
    fn last(&self, count: usize) -> Vec<Kind> {
        let mut kinds: Vec<Kind> = self.kinds.iter().rev().take(count).copied().collect();
        kinds.resize(count, Kind::Plain);
        kinds.reverse();
        kinds
    }

    /// Puts the kind of the result in place of those of the `count` operands.
    fn done(&mut self, folded: Folded, count: usize, kind: Kind, span: &Range<usize>) {
        self.kinds.truncate(self.kinds.len().saturating_sub(count));
        self.kinds.push(kind);
        if folded == Folded::NotFinite && self.not_finite.is_none() {
            self.not_finite = Some(span.clone());
        }
    }

    fn apply(&mut self, instruction: Instruction, count: usize, kind: Kind, span: &Range<usize>) {
        let folded = self.emitter.apply(instruction, count);
        self.done(folded, count, kind, span);
    }

    fn binary(&mut self, binary: Binary, span: &Range<usize>) -> Result<(), ExpressionError> {
        let kinds = self.last(2);
        let (a, b) = (kinds[0], kinds[1]);
        let kind = match binary {
            Binary::Add => same(a, b).ok_or_else(|| unlike("add", b, "to", a, span))?,
            Binary::Subtract => same(a, b).ok_or_else(|| unlike("subtract", b, "from", a, span))?,
            Binary::Multiply if a == Kind::Plain && b == Kind::Plain => Kind::Plain,
            Binary::Divide if a == Kind::Plain && b == Kind::Plain => Kind::Plain,
            Binary::Multiply => Kind::Of(a.dimension().times(&b.dimension())),
            Binary::Divide => Kind::Of(a.dimension().over(&b.dimension())),
            Binary::Power => return self.power(a, b, span),
        };
        self.apply(Instruction::Binary(binary), 2, kind, span);
        Ok(())
    }

    fn power(&mut self, base: Kind, exponent: Kind, span: &Range<usize>) -> Result<(), ExpressionError> {
        if !exponent.dimension().is_number() {
            return Err(ExpressionError::new(
                format!("an exponent must be a plain number, found {}", exponent.dimension()),
                span.clone(),
            ));
        }
        let constant = self.emitter.constant();
        let kind = match base {
            Kind::Plain => Kind::Plain,
            Kind::Of(dimension) if dimension == Dimension::NUMBER => base,
            Kind::Of(dimension) => {
                let Some(power) = constant else {
                    return Err(ExpressionError::new(
                        format!("{dimension} can only be raised to a constant power"),
                        span.clone(),
                    ));
                };
                let Some(result) = dimension.power(power) else {
                    return Err(ExpressionError::new(
                        format!("{dimension} cannot be raised to the power {power}"),
                        span.clone(),
                    ));
                };
                Kind::Of(result)
            }
        };
        let folded = self.emitter.power();
        self.done(folded, 2, kind, span);
        Ok(())
    }

    fn call(&mut self, call: Call, count: usize, span: &Range<usize>) -> Result<(), ExpressionError> {
        let kinds = self.last(count);
        let name = call.name();
        let number = |result: Kind| {
            let dimension = kinds[0].dimension();
            if !dimension.is_number() {
                let wanted = if matches!(call, Call::Sin | Call::Cos | Call::Tan) {
                    "an angle"
                } else {
                    "a plain number"
                };
                return Err(ExpressionError::new(
                    format!("`{name}` takes {wanted}, found {dimension}"),
                    span.clone(),
                ));
            }
            Ok(if kinds[0] == Kind::Plain { Kind::Plain } else { result })
        };
        let root = |power: f64| match kinds[0] {
            Kind::Plain => Ok(Kind::Plain),
            Kind::Of(dimension) => dimension.power(power).map(Kind::Of).ok_or_else(|| {
                ExpressionError::new(format!("`{name}` of {dimension} makes no dimension"), span.clone())
            }),
        };
        let alike = || {
            let mut all = kinds[0];
            for kind in &kinds[1..] {
                all = same(all, *kind).ok_or_else(|| {
                    ExpressionError::new(
                        format!("`{name}` cannot compare {} with {}", all.dimension(), kind.dimension()),
                        span.clone(),
                    )
                })?;
            }
            Ok(all)
        };
        let kind = match call {
            Call::Asin | Call::Acos | Call::Atan => number(Kind::Of(Dimension::ANGLE))?,
            Call::Sin | Call::Cos | Call::Tan | Call::Sinh | Call::Cosh | Call::Tanh => {
                number(Kind::Of(Dimension::NUMBER))?
            }
            Call::Exp | Call::Ln | Call::Log10 => number(Kind::Of(Dimension::NUMBER))?,
            Call::Sqrt => root(0.5)?,
            Call::Cbrt => root(1.0 / 3.0)?,
            Call::Abs => kinds[0],
            Call::Sign => {
                if kinds[0] == Kind::Plain {
                    Kind::Plain
                } else {
                    Kind::Of(Dimension::NUMBER)
                }
            }
            Call::Min | Call::Max | Call::Hypot => alike()?,
            Call::Atan2 => {
                if alike()? == Kind::Plain {
                    Kind::Plain
                } else {
                    Kind::Of(Dimension::ANGLE)
                }
            }
        };
        let folded = self.emitter.call(call, count);
        self.done(folded, count, kind, span);
        Ok(())
    }
}

/// The common kind of two values that are added or compared.
fn same(a: Kind, b: Kind) -> Option<Kind> {
    match (a, b) {
        (Kind::Plain, other) | (other, Kind::Plain) => Some(other),
        // An angle wins over a plain number with a unit, so that it stays known as an angle.
        (Kind::Of(x), Kind::Of(y)) if x.agrees(&y) => Some(if x.is_number() && y.is_angle() { b } else { a }),
        _ => None,
    }
}

fn unlike(verb: &str, a: Kind, joint: &str, b: Kind, span: &Range<usize>) -> ExpressionError {
    ExpressionError::new(format!("cannot {verb} {} {joint} {}", a.dimension(), b.dimension()), span.clone())
}
