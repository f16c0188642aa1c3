//! Rotations, poses, twists and wrenches.
//!
//! Notation (the same as in `docs/notation.md`): `R_AB` takes components in frame B to components in
//! frame A, `p_AB` is the vector from A's origin to B's origin, `X_AB = (R_AB, p_AB)` is the pose of B in
//! A, and a wrench is a force with a moment about a stated point. Lengths in metres, angles in radians.
//!
//! Quaternions are stored as `(w, x, y, z)` wherever they appear as four numbers.

mod decomposition;
mod pose;
mod so3;

pub use decomposition::{eigenvalues, singular_values};
pub use pose::{Pose, Twist, Wrench};
pub use so3::{exp, hat, left_jacobian, left_jacobian_inverse, log, rotation_from_axes};

pub use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};
