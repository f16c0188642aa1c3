//! How many directions an equilibrium is unstable in.
//!
//! An equilibrium of a conservative mechanism is a stationary point of its energy under constraints. Its second variation
//! is assembled as one symmetric matrix over poses, joint coordinates and multipliers. Beams are cut into stretches so short that
//! each of them is stable by itself (`mesh`), and enter with their stiffness in the poses of their ends (`segment`):
//!
//! ```text
//!            poses, coordinates    multipliers
//!          [        K                  Bᵀ      ]
//!   Hess = [                                   ]
//!          [        B                  0       ]
//! ```
//!
//! The number of unstable directions is the number of negative eigenvalues of Hess less the number of multipliers (J. Nocedal and S. J.
//! Wright, *Numerical Optimization*, 2nd ed., 2006, theorem 16.3). For beams it is the count of W. H. Wittrick and F. W. Williams, *Q. J.
//! Mech. Appl. Math.* 24 (1971) 263, whose second term, what is unstable inside a stretch between fixed ends, is zero for short ones.
//!
//! Rotations are varied by small turnings; written so, second derivatives have an antisymmetric part ½ hat(M) for every moment M. At
//! a balanced node these parts add up to nothing, so the symmetric part of what the plain tangents give is the second variation.
//! What is left of them where a moment comes from outside is why a dead moment on something that turns freely has no energy.

mod assemble;
mod mesh;
mod segment;
#[cfg(test)]
mod tests;
mod undecided;
mod variation;

pub(crate) use assemble::{Motions, Second, vector};
pub use variation::{Rate, Variation};

use crate::system::Equilibrium;
use flexura_nonlinear::Breakdown;

/// What is known of an equilibrium's stability.
#[derive(Clone, Debug, PartialEq)]
pub enum Stability {
    /// The number of unstable directions.
    Unstable(usize),
    /// It is not decided, and why.
    Undecided(String),
}

impl Equilibrium {
    /// Counts the unstable directions of the present equilibrium.
    ///
    /// # Errors
    /// The state overflows, or is so near a critical point that the count cannot be told.
    pub fn stability(&mut self) -> Result<Stability, Breakdown> {
        if let Some(reason) = self.undecided() {
            return Ok(Stability::Undecided(reason));
        }
        self.counts.inertias += 1;
        let negative = self.unstable_directions()?;
        Ok(Stability::Unstable(negative))
    }
}
