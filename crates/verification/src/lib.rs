//! flexura's answers beside references: closed forms, published numbers, and other methods of solution.
//!
//! A [`Case`] is one line of `docs/verification.md`. It builds a model, solves it the way a user would, and
//! returns [`Row`]s: what was compared, with what, and how far the two are apart. The references come from
//! `flexura-testkit`, which knows nothing of this solver.
//!
//! The tests of this crate let no row exceed its tolerance, and hold the solver's own error estimate against
//! the true error wherever there is a closed form.

mod build;
mod case;
mod cases;
mod file;
mod measure;
mod outcome;
mod path;
mod table;
mod thesis;

pub use case::{Case, Estimate, Row, Run, Weigh};
pub use cases::{cases, find};
pub use measure::solve;
pub use outcome::{Outcome, outcomes};
pub use table::{is_current, markdown};
pub use thesis::thesis;
