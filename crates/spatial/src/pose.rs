//! Poses (elements of SE(3)), twists and wrenches.

use crate::so3;
use nalgebra::{UnitQuaternion, Vector3};
use std::ops::{Add, Mul, Neg, Sub};

/// The pose `X_AB` of a frame B in a frame A: B's axes (`rotation` = R_AB) and origin (`position` = p_AB).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// R_AB, takes components in B to components in A.
    pub rotation: UnitQuaternion<f64>,
    /// p_AB in A's axes, metres.
    pub position: Vector3<f64>,
}

impl Pose {
    /// The pose that changes nothing.
    pub fn identity() -> Self {
        Self { rotation: UnitQuaternion::identity(), position: Vector3::zeros() }
    }

    /// A pose of the given rotation and position.
    pub fn new(rotation: UnitQuaternion<f64>, position: Vector3<f64>) -> Self {
        Self { rotation, position }
    }

    /// A shift without rotation.
    pub fn translation(position: Vector3<f64>) -> Self {
        Self { rotation: UnitQuaternion::identity(), position }
    }

    /// `X_BA` of `X_AB`.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, position: -(rotation * self.position) }
    }

    /// Where the point `p_B` (in B's axes) lies in A.
    pub fn point(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * p + self.position
    }

    /// The pose after the screw motion `twist` in SE(3): `exp` of rotation vector and translation.
    pub fn exp(twist: &Twist) -> Self {
        Self {
            rotation: so3::exp(&twist.angular),
            position: so3::left_jacobian(&twist.angular) * twist.linear,
        }
    }

    /// The twist whose [`Pose::exp`] is this pose; its rotation is at most π.
    pub fn log(&self) -> Twist {
        let angular = so3::log(&self.rotation);
        Twist { angular, linear: so3::left_jacobian_inverse(&angular) * self.position }
    }
}

impl Mul for Pose {
    type Output = Pose;
    /// `X_AC = X_AB X_BC`.
    fn mul(self, other: Pose) -> Pose {
        Pose { rotation: self.rotation * other.rotation, position: self.point(&other.position) }
    }
}

/// An infinitesimal motion, or a rate of one: rotation and translation of a frame's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Rotation vector, rad.
    pub angular: Vector3<f64>,
    /// Translation, m.
    pub linear: Vector3<f64>,
}

/// A force with the moment about a stated point, both in stated axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: Vector3<f64>,
    /// Moment about the point, N·m.
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// No load at all.
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }

    /// A wrench of the given force and moment.
    pub fn new(force: Vector3<f64>, moment: Vector3<f64>) -> Self {
        Self { force, moment }
    }

    /// The same load with its moment taken about the point that lies at `offset` from the present one.
    pub fn about(&self, offset: &Vector3<f64>) -> Self {
        Self { force: self.force, moment: self.moment - offset.cross(&self.force) }
    }

    /// The same load in the axes that `rotation` leads to: `R_AB` takes a wrench in B to one in A.
    pub fn rotated(&self, rotation: &UnitQuaternion<f64>) -> Self {
        Self { force: rotation * self.force, moment: rotation * self.moment }
    }
}

impl Add for Wrench {
    type Output = Wrench;
    fn add(self, other: Wrench) -> Wrench {
        Wrench { force: self.force + other.force, moment: self.moment + other.moment }
    }
}

impl Sub for Wrench {
    type Output = Wrench;
    fn sub(self, other: Wrench) -> Wrench {
        self + -other
    }
}

impl Neg for Wrench {
    type Output = Wrench;
    fn neg(self) -> Wrench {
        Wrench { force: -self.force, moment: -self.moment }
    }
}

impl Mul<f64> for Wrench {
    type Output = Wrench;
    fn mul(self, factor: f64) -> Wrench {
        Wrench { force: self.force * factor, moment: self.moment * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_undoes_exp_on_poses() {
        let twist = Twist { angular: Vector3::new(0.4, -1.1, 0.7), linear: Vector3::new(3.0, 0.2, -5.0) };
        let back = Pose::exp(&twist).log();
        assert!((back.angular - twist.angular).norm() < 1e-14);
        assert!((back.linear - twist.linear).norm() < 1e-13);
    }

    #[test]
    fn inverse_undoes_a_pose() {
        let pose = Pose::new(so3::exp(&Vector3::new(0.3, 0.2, 2.0)), Vector3::new(1.0, 2.0, 3.0));
        let unit = pose * pose.inverse();
        assert!(unit.position.norm() < 1e-14 && unit.rotation.angle() < 1e-14);
    }

    #[test]
    fn a_force_keeps_its_power_when_its_moment_is_moved() {
        let wrench = Wrench::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(-1.0, 0.5, 2.0));
        let (omega, v) = (Vector3::new(0.1, 0.7, -0.3), Vector3::new(2.0, -1.0, 0.4));
        let offset = Vector3::new(0.5, -2.0, 1.5);
        let moved = wrench.about(&offset);
        let power = wrench.force.dot(&v) + wrench.moment.dot(&omega);
        let moved_power = moved.force.dot(&(v + omega.cross(&offset))) + moved.moment.dot(&omega);
        assert!((power - moved_power).abs() < 1e-14);
    }
}
