//! Turning about an axis and sliding along it: X_FM = (exp(q0 axis), q1 axis).

use super::{Configuration, Kinematics, MAX_FREEDOMS, revolute::Revolute};
use flexura_spatial::{Pose, Twist, Vector3, exp};

pub(super) struct Cylindrical {
    pub axis: Vector3<f64>,
}

impl Kinematics for Cylindrical {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, q: &Configuration) -> Pose {
        Pose::new(exp(&(self.axis * q[0])), self.axis * q[1])
    }
    fn subspace(&self, _: &Configuration, i: usize) -> Twist {
        match i {
            0 => Twist { angular: self.axis, linear: Vector3::zeros() },
            _ => Twist { angular: Vector3::zeros(), linear: self.axis },
        }
    }
    fn moved(&self, q: &Configuration, step: &[f64]) -> Configuration {
        let mut moved = *q;
        moved[0] += step[0];
        moved[1] += step[1];
        moved
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        [to[0] - from[0], to[1] - from[1], 0.0, 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, q: &Configuration) -> [f64; MAX_FREEDOMS] {
        [q[0], q[1], 0.0, 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], coordinates[1], 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        let mut q = Revolute { axis: self.axis }.nearest(pose);
        q[1] = self.axis.dot(&pose.position);
        q
    }
}
