//! Expressions, units and dimensions, as they stand in a model file.
//!
//! A text is parsed into an [`Expression`], whose every part knows its byte range. Its references are then
//! bound to values, to a variable or to slots, the dimensions are checked on the way, and what comes out is
//! a [`Quantity`], a [`Function`] of one variable with exact derivatives, or a [`Formula`] over slots.
//!
//! How plain numbers and units live together: a plain number is in SI units. It scales what it multiplies,
//! and takes over the dimension of what it is added to; two numbers that bear units must agree.
//!
//! Absent on purpose: electric units, affine temperatures (degrees Celsius), and the unit names `h`, `L`,
//! `t`, `A`, `F`, `GJ`, which users want as names of their own parameters.

mod bounds;
mod degree;
mod dimension;
mod emit;
mod error;
mod expression;
mod function;
mod interval;
mod jet;
mod lexer;
mod lower;
mod nearest;
mod parser;
mod program;
mod smoothness;
mod spelling;
mod split;
mod unit;

pub use dimension::{Dimension, Kind, Quantity};
pub use emit::Open;
pub use error::ExpressionError;
pub use expression::{Expression, Reference, Segment};
pub use function::{Formula, Function};
pub use lower::{Binding, Lowered};
pub use nearest::nearest;
pub use smoothness::Variation;
pub use spelling::respelled;
pub use split::split;
pub use unit::{Unit, UnitEntry, unit, unit_table};

/// The names of the functions that an expression may call, with what they are.
pub fn function_table() -> impl Iterator<Item = (&'static str, &'static str)> {
    expression::Call::TABLE.iter().map(|entry| (entry.name, entry.doc))
}

/// The named constants that an expression may use.
pub fn constant_table() -> impl Iterator<Item = (&'static str, f64)> {
    expression::CONSTANTS.iter().copied()
}

/// Why a name may not be given to a parameter: it already means something in an expression.
pub fn reserved(name: &str) -> Option<&'static str> {
    if unit(name).is_some() {
        return Some("a unit");
    }
    if expression::CONSTANTS.iter().any(|(constant, _)| *constant == name) {
        return Some("a constant");
    }
    if expression::Call::find(name).is_some() {
        return Some("a function");
    }
    if ["beam", "body", "joint", "spring", "cable", "tubes", "model", "nan"].contains(&name) {
        return Some("a word of the expressions");
    }
    None
}

/// A name that a parameter could bear in place of a reserved one; a good one says what it is.
pub fn free_name(reserved_name: &str) -> String {
    let word = match reserved_name {
        "m" | "kg" | "lb" => "mass",
        "g" => "gravity",
        "s" => "path",
        "N" => "count",
        "K" | "kN" => "stiffness",
        "J" => "inertia",
        "W" => "weight",
        "turn" | "rev" => "turning",
        "min" => "least",
        "max" => "greatest",
        "in" => "inlet",
        "day" | "hour" => "duration",
        "e" => "eccentricity",
        "deg" | "rad" => "angle",
        "mm" | "cm" | "km" => "length",
        "Pa" | "MPa" | "GPa" | "bar" => "pressure",
        "sign" => "sense",
        "%" | "°" => "part",
        _ => return format!("{reserved_name}_1"),
    };
    word.to_string()
}

#[cfg(test)]
mod tests;
