//! Springs between two points: tension against length, the path between the ends, and the tangent of the forces.
//!
//! - [`law`]: tension against stretch, one law a variant; [`table`]: the law that is measured;
//! - [`wrap`]: the shortest path around a sphere or a cylinder.

pub mod law;
pub mod table;
pub mod wrap;

pub use law::{Pull, TensionLaw};
pub use table::MonotoneTable;
pub use wrap::{Around, Obstacle, PathError};

use flexura_spatial::{Matrix3, Vector3};

/// A law with the length from which the stretch counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Tension against stretch.
    pub law: TensionLaw,
    /// ℓ0, m.
    pub rest_length: f64,
    /// At slack itself, within round-off: does the tangent count the spring as slack? Else as taut.
    pub is_loose: bool,
}

/// The force of a spring on its `from` end, and how it depends on the vector between its ends.
#[derive(Clone, Copy, Debug)]
pub struct SpringForce {
    /// Distance of the ends.
    pub length: f64,
    /// Tension, positive when pulling.
    pub tension: f64,
    /// Force on the `from` end; the `to` end gets the opposite.
    pub force: Vector3<f64>,
    /// d force / d (to - from).
    pub tangent: Matrix3<f64>,
}

impl Spring {
    /// Tension and its derivative at a length.
    pub fn pull(&self, length: f64) -> Pull {
        self.law.pull(length - self.rest_length, self.rest_length, self.is_loose)
    }

    /// The spring stretched from one point to another along a straight line: force T u with u the unit vector, and
    /// tangent T' u uᵀ + T/ℓ (I - u uᵀ). None when the ends coincide: the direction is then undefined.
    pub fn between(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<SpringForce> {
        let (u, length) = direction(from, to)?;
        let Pull { tension, rate } = self.pull(length);
        Some(straight(&u, length, tension, rate))
    }

    /// Stored energy: the integral of the tension from where it vanishes, J.
    pub fn energy(&self, length: f64) -> f64 {
        self.law.energy(length - self.rest_length, self.rest_length)
    }

    /// (ℓ - ℓ0)/ℓ0. None where ℓ0 is zero.
    pub fn strain(&self, length: f64) -> Option<f64> {
        let strain = (length - self.rest_length) / self.rest_length;
        strain.is_finite().then_some(strain)
    }

    /// Does it carry nothing because it is too long?
    pub fn is_slack(&self, length: f64) -> bool {
        self.law.is_slack(length - self.rest_length)
    }
}

fn direction(from: &Vector3<f64>, to: &Vector3<f64>) -> Option<(Vector3<f64>, f64)> {
    let span = to - from;
    let length = span.norm();
    (length != 0.0).then(|| (span / length, length))
}

fn straight(u: &Vector3<f64>, length: f64, tension: f64, rate: f64) -> SpringForce {
    let along = u * u.transpose();
    let tangent = along * rate + (Matrix3::identity() - along) * (tension / length);
    SpringForce { length, tension, force: u * tension, tangent }
}

/// A line under a tension that does not depend on its length: force T u, tangent T/ℓ (I - u uᵀ). None when the
/// ends coincide.
pub fn constant_tension(tension: f64, ends: &[Vector3<f64>; 2]) -> Option<SpringForce> {
    let (u, length) = direction(&ends[0], &ends[1])?;
    Some(straight(&u, length, tension, 0.0))
}

#[cfg(test)]
mod tests;
