//! Expressions, units and dimensions, as they stand in a model file.

/// A real function of one variable in SI units, all parameters folded in.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    text: String,
}

impl Function {
    /// The function that is `value` everywhere.
    pub fn constant(_value: f64) -> Self {
        unimplemented!()
    }
    /// Parses an expression of the one variable `variable`, numbers in SI units.
    pub fn parse(_text: &str, _variable: &str) -> Result<Self, ExpressionError> {
        unimplemented!()
    }
    /// f(x).
    pub fn value(&self, _x: f64) -> f64 {
        unimplemented!()
    }
    /// f(x) and its first three derivatives, exact (truncated Taylor arithmetic).
    pub fn jet(&self, _x: f64) -> [f64; 4] {
        unimplemented!()
    }
    /// The value if the function does not depend on its variable.
    pub fn as_constant(&self) -> Option<f64> {
        unimplemented!()
    }
}

/// An expression over numbered slots, compiled: what an output is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
}

impl Formula {
    /// The value with the given slot values.
    pub fn evaluate(&self, _slots: &[f64]) -> f64 {
        unimplemented!()
    }
}

/// What is wrong with an expression, with the byte range in its text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong, one sentence.
    pub message: String,
    /// Where, as a byte range in the expression's text.
    pub span: std::ops::Range<usize>,
}
