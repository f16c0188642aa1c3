//! Springs between two points: tension against length, and the tangent of the force vector.

use flexura_spatial::{Matrix3, Vector3};

/// Tension k (ℓ - ℓ0) along the line between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSpring {
    /// k, N/m.
    pub stiffness: f64,
    /// ℓ0, m.
    pub rest_length: f64,
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

impl LinearSpring {
    /// The spring stretched from one point to another: force T u with u the unit vector, and
    /// tangent k u uᵀ + T/ℓ (I - u uᵀ). None when the ends coincide: the direction is then undefined.
    pub fn between(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<SpringForce> {
        let span = to - from;
        let length = span.norm();
        if length == 0.0 {
            return None;
        }
        let u = span / length;
        let tension = self.stiffness * (length - self.rest_length);
        let along = u * u.transpose();
        let tangent = along * self.stiffness + (Matrix3::identity() - along) * (tension / length);
        Some(SpringForce { length, tension, force: u * tension, tangent })
    }

    /// ½ k (ℓ - ℓ0)², J.
    pub fn energy(&self, length: f64) -> f64 {
        0.5 * self.stiffness * (length - self.rest_length).powi(2)
    }
}

/// A line under a tension that does not depend on its length: force T u, tangent T/ℓ (I - u uᵀ). None when the
/// ends coincide.
pub fn constant_tension(tension: f64, ends: &[Vector3<f64>; 2]) -> Option<SpringForce> {
    let span = ends[1] - ends[0];
    let length = span.norm();
    if length == 0.0 {
        return None;
    }
    let u = span / length;
    let tangent = (Matrix3::identity() - u * u.transpose()) * (tension / length);
    Some(SpringForce { length, tension, force: u * tension, tangent })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangent_is_the_derivative_of_the_force_and_the_force_of_the_energy() {
        let spring = LinearSpring { stiffness: 3.0, rest_length: 0.8 };
        let (from, to) = (Vector3::new(0.1, 0.2, -0.3), Vector3::new(1.0, -0.5, 0.6));
        let force = |to: &Vector3<f64>| spring.between(&from, to).unwrap();
        let h = 1e-5;
        for i in 0..3 {
            let mut d = Vector3::zeros();
            d[i] = h;
            let central = (force(&(to + d)).force - force(&(to - d)).force) / (2.0 * h);
            assert!((force(&to).tangent.column(i) - central).norm() < 1e-9);
            let energy = |to: &Vector3<f64>| spring.energy(force(to).length);
            // The `to` end is pulled back by minus the force: dE/d(to) = +force.
            let slope = (energy(&(to + d)) - energy(&(to - d))) / (2.0 * h);
            assert!((slope - force(&to).force[i]).abs() < 1e-9);
        }
        assert!(spring.between(&from, &from).is_none());
    }
}
