//! Sliding along an axis: X_FM = (I, q axis).

use super::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Twist, Vector3};

pub(super) struct Prismatic {
    pub axis: Vector3<f64>,
}

impl Kinematics for Prismatic {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        Pose::translation(self.axis * configuration[0])
    }
    fn subspace(&self, _: &Configuration, _: usize) -> Twist {
        Twist { angular: Vector3::zeros(), linear: self.axis }
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
        [pose.position.dot(&self.axis), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
