//! The laws of mechanics, one room each, without any global numbering.
//!
//! - [`ode`]: the Runge-Kutta stepper that everything here is integrated with;
//! - [`rod`]: strain, balance and propagation of a rod;
//! - [`joint`]: one kind a file, X_FM(q) and its motion subspace H;
//! - [`load`]: point wrenches, dead and follower; [`spring`]: force against length.

pub mod joint;
pub mod load;
pub mod ode;
pub mod rod;
pub mod spring;
