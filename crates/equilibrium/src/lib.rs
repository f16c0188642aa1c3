//! From a model to its square system of equations, and back to a solution.
//!
//! Everything inside is nondimensional: lengths by the longest beam L, forces by EI/L² of its softest
//! bending stiffness. [`Equilibrium`] is the prepared problem; it implements `nonlinear::System`.
//!
//! - `lower`: model -> nodes, spans, joints, couplings, springs, cables;
//! - `beam`: the law of one beam at any place, as pieces that can be integrated;
//! - `channel`: tendons in channels along beams;
//! - `mesh`: how many steps and shooting segments a span gets, by `course`, how hard it is loaded along it, and `look`, what its law
//!   is like there;
//! - `layout`: which number of the state and which unknown belongs to what;
//! - `shooting`: spans carried from node to node with their derivatives;
//! - `prepare`: the state at rest, and when mesh and layout change; `reach`: what would be too much;
//! - `assembly`: residual and tangent of spans, `head` and `held` of what their starts hang on, `couplings` of joints, loads,
//!   springs and cables; `system`: the `System` trait on it;
//! - `accuracy`: the error estimate; `diagnose`: what is loose or held twice; `redundancy`: loops that close nonetheless;
//! - `tangents`: compliances and motions; `neighbour`: other numbers under the same state; `stand`: an earlier result as state;
//! - `footing`: what holds the mechanism at rest; `regime`: where laws change their form;
//! - `moving`: what a motion of rigid parts asks;
//! - `stability`: how many directions an equilibrium is unstable in; `vibration`: its stiffness and inertia;
//! - `extract` and `samples`: the solution.

mod accuracy;
mod assembly;
mod beam;
mod channel;
mod coordinates;
mod couplings;
mod course;
mod diagnose;
mod error;
mod extract;
mod footing;
mod foundation;
mod head;
mod held;
mod layout;
mod leaves;
mod lift;
mod look;
mod lower;
mod mesh;
mod moving;
mod neighbour;
mod patch;
mod prepare;
mod reach;
mod redundancy;
mod regime;
mod samples;
mod scale;
mod shooting;
mod spin;
mod springs;
mod stability;
mod stand;
mod system;
mod tangents;
#[cfg(test)]
mod tests;
mod touch;
mod tubes;
mod vibration;

pub use moving::Mover;
pub use neighbour::Law;
pub use tangents::CENTRAL;

pub use accuracy::{Finish, Mesh};
pub use diagnose::Census;
pub use error::ProblemError;
pub use flexura_nonlinear::Interrupt;
pub use footing::Footing;
pub use regime::Edge;
pub use stability::{Rate, Stability, Variation};
pub use system::{Counts, Equilibrium};
pub use vibration::{Detail, Swing, Vibration};
