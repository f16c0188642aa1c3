//! The parsed form: a flat list in postfix order, so that nothing that walks it needs recursion.

use crate::{ExpressionError, Kind, parser};
use std::f64::consts::{E, PI, TAU};
use std::ops::Range;

pub(crate) const CONSTANTS: &[(&str, f64)] = &[("pi", PI), ("tau", TAU), ("e", E), ("inf", f64::INFINITY)];

/// A parsed expression whose references are not bound yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub(crate) text: String,
    pub(crate) items: Vec<Item>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Item {
    pub node: Node,
    /// The whole operation, operands included.
    pub span: Range<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Node {
    Number(f64, Kind),
    Reference(Reference),
    Negate,
    Binary(Binary),
    /// A call with this many arguments.
    Call(Call, usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

/// A name, a variable, or a dotted path such as `beam.link[0.5].position.z`.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Its parts, at least one; the first is a name.
    pub segments: Vec<(Segment, Range<usize>)>,
    /// Where it stands in the expression's text.
    pub span: Range<usize>,
}

impl Reference {
    /// The name, if it is nothing but a name.
    pub fn name(&self) -> Option<&str> {
        match self.segments.as_slice() {
            [(Segment::Name(name), _)] => Some(name),
            _ => None,
        }
    }
}

/// A part of a reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Segment {
    /// `.name` (or the first name), perhaps quoted.
    Name(String),
    /// `[expression]`.
    Index(Expression),
}

impl Expression {
    /// Parses an expression. A unit may stand directly behind a number.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        parser::parse(text, None)
    }

    /// Parses an expression of a variable. Where the variable bears the name of a unit (`s`), the name is
    /// the variable everywhere.
    pub fn parse_with_variable(text: &str, variable: &str) -> Result<Self, ExpressionError> {
        parser::parse(text, Some(variable))
    }

    /// The text it was parsed from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// All references, those within indices included.
    pub fn references(&self) -> Vec<&Reference> {
        let mut found = Vec::new();
        let mut open = vec![self];
        while let Some(expression) = open.pop() {
            for item in &expression.items {
                if let Node::Reference(reference) = &item.node {
                    found.push(reference);
                    open.extend(reference.segments.iter().filter_map(|(segment, _)| match segment {
                        Segment::Index(index) => Some(index),
                        Segment::Name(_) => None,
                    }));
                }
            }
        }
        found
    }

    /// From where to where it reaches in its text.
    pub(crate) fn span(&self) -> Range<usize> {
        self.items.last().map_or(0..0, |item| item.span.clone())
    }
}

/// The functions an expression may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
    Cbrt,
    Abs,
    Sign,
    Min,
    Max,
    Hypot,
}

pub(crate) struct CallEntry {
    pub call: Call,
    pub name: &'static str,
    /// Least and greatest number of arguments.
    pub arguments: (usize, usize),
    pub doc: &'static str,
}

const fn call(call: Call, name: &'static str, arguments: (usize, usize), doc: &'static str) -> CallEntry {
    CallEntry { call, name, arguments, doc }
}

impl Call {
    pub(crate) const TABLE: &[CallEntry] = &[
        call(Call::Sin, "sin", (1, 1), "sine of an angle"),
        call(Call::Cos, "cos", (1, 1), "cosine of an angle"),
        call(Call::Tan, "tan", (1, 1), "tangent of an angle"),
        call(Call::Asin, "asin", (1, 1), "inverse sine, an angle"),
        call(Call::Acos, "acos", (1, 1), "inverse cosine, an angle"),
        call(Call::Atan, "atan", (1, 1), "inverse tangent, an angle"),
        call(Call::Atan2, "atan2", (2, 2), "angle of the point (x, y): atan2(y, x)"),
        call(Call::Sinh, "sinh", (1, 1), "hyperbolic sine"),
        call(Call::Cosh, "cosh", (1, 1), "hyperbolic cosine"),
        call(Call::Tanh, "tanh", (1, 1), "hyperbolic tangent"),
        call(Call::Exp, "exp", (1, 1), "exponential"),
        call(Call::Ln, "ln", (1, 1), "natural logarithm"),
        call(Call::Log10, "log10", (1, 1), "decimal logarithm"),
        call(Call::Sqrt, "sqrt", (1, 1), "square root, of any dimension"),
        call(Call::Cbrt, "cbrt", (1, 1), "cube root, of any dimension"),
        call(Call::Abs, "abs", (1, 1), "absolute value"),
        call(Call::Sign, "sign", (1, 1), "-1, 0 or 1"),
        call(Call::Min, "min", (2, 100), "least of its arguments"),
        call(Call::Max, "max", (2, 100), "greatest of its arguments"),
        call(Call::Hypot, "hypot", (2, 3), "length of a vector: sqrt(x^2 + y^2 + ...)"),
    ];

    pub(crate) fn find(name: &str) -> Option<&'static CallEntry> {
        Self::TABLE.iter().find(|entry| entry.name == name)
    }

    pub(crate) fn name(self) -> &'static str {
        Self::TABLE.iter().find(|entry| entry.call == self).map_or("?", |entry| entry.name)
    }
}
