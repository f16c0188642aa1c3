//! Design optimisation: parameters of a mechanism that make an objective least or greatest under constraints.
//!
//! A design is a set of values of the varied parameters, and what is read off its equilibrium, or off a path of its equilibria, is
//! a smooth function of them with exact derivatives ([`flexura_study::Evaluator`]). In the unit box of the ranges
//!
//! ```text
//!   min f(u),   c_i(u) ≤ 0,   h_j(u) = 0,   0 ≤ u ≤ 1,
//! ```
//!
//! each scaled by its own size, is searched by sequential quadratic programming or by an evolution strategy (both of the crate
//! `basin`). What counts as an optimum is decided here, by the conditions of Karush, Kuhn and Tucker (`certificate`), not by what
//! made the search end.

mod certificate;
mod evaluate;
mod evolve;
mod front;
mod path;
mod problem;
mod search;
mod sqp;
mod starts;
mod study;
#[cfg(test)]
mod tests;

pub use starts::spread;
pub use study::{DesignProgress, optimise};
