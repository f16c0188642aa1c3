//! A frame that turns at a steady rate.

use flexura_spatial::Vector3;

/// The whole mechanism, ground and all, turns about a fixed line; gravity and dead loads turn along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// Unit vector along the line, global axes.
    pub axis: Vector3<f64>,
    /// rad/s, right-handed about the axis.
    pub rate: f64,
    /// A point of the line, m.
    pub through: Vector3<f64>,
}

impl Spin {
    /// ω, rad/s.
    pub fn velocity(&self) -> Vector3<f64> {
        self.axis * self.rate
    }
}
