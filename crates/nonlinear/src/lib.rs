//! Square systems of nonlinear equations: Newton's method, the way from rest to the full load, and the
//! factorisations behind them. Nothing here knows of beams.

mod chain;
mod deflation;
mod dense;
mod homotopy;
mod interrupt;
mod lanes;
mod matrix;
mod newton;
mod sparse;
mod symmetric;
mod system;

pub use chain::{BLOCK, Block, Chain};
pub use deflation::converge_deflated;
pub use dense::Dense;
pub use homotopy::{Block as PathBlock, PathEnd, PathOptions, PathWork, follow, follow_on};
pub use interrupt::Interrupt;
pub use matrix::Matrix;
pub use newton::{NewtonEnd, NewtonOptions, converge};
pub use sparse::{BlockPlace, Sparse, SparseSymmetric};
pub use symmetric::{DenseSymmetric, Inertia, Symmetric};
pub use system::{Breakdown, Lift, Liftable, System};
