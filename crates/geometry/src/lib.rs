//! Rest shapes and cross sections of beams: pure geometry and section laws, no numbering of unknowns.
//!
//! * [`RestShape`] turns a curve and a rule for the section's axes into rest curvatures k1, k2, k3 along
//!   the arc length, and into the stress-free pose of every section.
//! * [`Contour`] is the boundary of a body in a plane by its arc length: point, tangent angle, curvature.
//! * [`ImplicitSurface`] is the surface of a body in space: normal, shape operator, the place with a given normal; evaluated over
//!   [`dual`] numbers where exact derivatives are wanted.
//! * [`compliance`], [`stiffness`], [`properties`], [`mass_per_length`], [`peak_stress`] and [`outline`]
//!   are the laws of a cross section.
//!
//! Absent on purpose: loads, deformation, everything that needs to know other beams.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a NaN must take the same way as a value that is too small"
)]

mod cells;
mod constant;
mod contour;
pub mod dual;
mod error;
mod frame;
mod legendre;
mod path;
mod profiles;
mod rest_shape;
mod section;
mod smooth;
mod spline;
mod surface;

pub use contour::{BoundaryError, Contour, ContourPoint, FunctionSpline};
pub use error::{SectionError, ShapeError};
pub use rest_shape::RestShape;
pub use section::{
    Compliance, Properties, SectionStress, compliance, is_uniform, mass_per_length, outline, peak_stress,
    properties, rotary_inertia, section_breaks, section_hidden, stiffness,
};
pub use surface::{Curvatures, Fit, ImplicitSurface, SurfaceError, eigenvalues};
