//! Models that meet data: parameters from measurements ([`fit()`]), and formulas that repeat a model's answer.
//!
//! Absent on purpose: reading tables, and writing results.

mod conditions;
mod fit;
mod formula;
mod least_squares;
mod problem;
mod profile;
mod report;
mod specimens;
mod statistics;

pub use fit::fit;
pub use formula::formula;
pub use least_squares::{LeastSquaresEnd, LeastSquaresOptions, Loss, Minimum, Residuals, least_squares};
