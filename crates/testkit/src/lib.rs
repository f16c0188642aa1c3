//! Closed forms and reference solutions with citations, and the assertions that compare against them.
//!
//! Nothing here uses flexura's own solver: it is the second method. Every reference is itself tested
//! against a published number or a limit.

pub mod arches;
pub mod bend45;
pub mod bow;
pub mod chebyshev;
pub mod collocation;
pub mod columns;
pub mod elastica;
pub mod elliptic;
pub mod exoskeleton;
pub mod foundation;
pub mod four_bar;
pub mod frames;
pub mod helix;
pub mod ivp;
pub mod lateral;
pub mod least_norm;
pub mod leg;
pub mod path;
pub mod perturbation;
pub mod planar;
pub mod recipe;
pub mod rod;
pub mod roll_up;
pub mod roots;
pub mod shoot;
pub mod slide_law;
pub mod slope;
pub mod snaps;
pub mod spring;
pub mod strip;
pub mod taper;
pub mod taylor;
pub mod torsion;
pub mod tubes;

mod assert;
mod jacobian;

pub use assert::{assert_close, assert_close_all, assert_close_vec};
pub use jacobian::{check_jacobian, check_jacobian_complex, numerical_jacobian};
