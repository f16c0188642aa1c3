//! The rod: how strain follows from the internal wrench, how the wrench balances, and how a rod's state is
//! carried from one end of a piece to the other; tendons in a rod's channels, and tubes in tubes.

pub mod balance;
mod compiled;
pub mod constitutive;
pub mod foundation;
pub mod propagate;
mod straighten;
pub mod tendon;
pub mod tubes;

pub use compiled::{RodKernel, TubeKernel, advance, advance_tendons, advance_tubes};
pub use constitutive::{Coupled, Law, Shearable, Slender};
pub use foundation::{Foundation, FoundationSample, Resistance, Spinning};
pub use propagate::{LawTable, LoadSample, Piece, RodState};
pub use tendon::{Channel, ChannelSample, Tension, rod_share};
pub use tubes::{Guided, TUBES, Tube, TubePiece, TubeState};
