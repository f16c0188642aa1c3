//! A campaign: random mechanisms and damaged files are put to every verb of the built command, and every converged answer is
//! verified by other means.
//!
//! * [`mechanism`] draws a mechanism from a seed and writes it as a model file: the same seed, the same file.
//! * [`verify`] holds a result document against the model: a second integrator along every beam, the balance of every body and of
//!   the whole, the closure of joints and beams' ends, the laws of coordinates, springs and cables, the strain energy.
//! * [`run`] puts files to the command as a child with bounds on time and memory, compares what its verbs say, and writes
//!   every file that something was found in.
//!
//! What it finds becomes a test where the fault is mended.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a NaN must take the same way as a value that is too large"
)]

mod campaign;
mod command;
mod compare;
mod damage;
mod finding;
mod mechanism;
mod random;
mod trial;
mod verify;

pub use campaign::{Found, Progress, Settings, Summary, run};
pub use finding::{Finding, Kind};
pub use mechanism::{Mechanism, Sort, mechanism};
pub use verify::{Check, Verdict, verify};
