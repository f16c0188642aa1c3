//! Turning about an axis through the common origin: X_FM = exp(q axis).

use super::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Twist, Vector3, exp};

pub(super) struct Revolute {
    pub axis: Vector3<f64>,
}

impl Kinematics for Revolute {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        Pose::new(exp(&(self.axis * configuration[0])), Vector3::zeros())
    }
    fn subspace(&self, _: &Configuration, _: usize) -> Twist {
        Twist { angular: self.axis, linear: Vector3::zeros() }
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        [configuration[0] + step[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        [to[0] - from[0], 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        [configuration[0], 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        // The swing-twist decomposition: the part of the rotation about the axis.
        let q = pose.rotation.quaternion();
        let along = Vector3::new(q.i, q.j, q.k).dot(&self.axis);
        let angle = 2.0 * along.atan2(q.w);
        let turn = std::f64::consts::TAU;
        [angle - turn * (angle / turn).round(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
