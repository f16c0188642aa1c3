//! Paths of solutions of r(x; p) = 0: where they fold, where they cross, and what crosses them.
//!
//! - `problem`: what can be followed;
//! - `corrector`: from a predicted point to the path;
//! - `walker`: step by step along a path, with what was passed;
//! - `reduced`: the surface of two numbers on which a fold or branch point lies;
//! - `locate`: folds and simple branch points on it, and the directions of the branches;
//! - `multiple`: points where several directions become critical at once; `algebraic`: the equations of what leaves them; `spread`: the
//!   branches that do;
//! - `critical`: folds and branch points followed in a second parameter.
//!
//! Nothing here knows of beams.

mod algebraic;
mod corrector;
mod critical;
mod locate;
mod multiple;
mod problem;
mod reduced;
mod spread;
#[cfg(test)]
mod tests;
mod walker;

pub use corrector::between;
pub use critical::{CriticalEnd, CriticalWalker};
pub use locate::{Crossing, Special, sharpen};
pub use problem::{Parameters, Point, Problem, Refusal, Tangent, slope};
pub use spread::{Leaving, Spread, spread};
pub use walker::{Advance, Place, Stall, WalkOptions, WalkWork, Walker};
