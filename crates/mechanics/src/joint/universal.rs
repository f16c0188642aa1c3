//! Turning about an axis of F, then about an axis of M at right angles to it: X_FM = exp(q0 a) exp(q1 b).

use super::{Configuration, Kinematics, MAX_FREEDOMS, revolute::Revolute};
use flexura_spatial::{Pose, Twist, Vector3, exp};

pub(super) struct Universal {
    pub first: Vector3<f64>,
    pub second: Vector3<f64>,
}

impl Kinematics for Universal {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, q: &Configuration) -> Pose {
        Pose::new(exp(&(self.first * q[0])) * exp(&(self.second * q[1])), Vector3::zeros())
    }
    fn subspace(&self, q: &Configuration, i: usize) -> Twist {
        let angular = if i == 0 { self.first } else { exp(&(self.first * q[0])) * self.second };
        Twist { angular, linear: Vector3::zeros() }
    }
    /// The second axis turns with the first coordinate.
    fn subspace_change(&self, q: &Configuration, i: usize, j: usize) -> Twist {
        let angular = match (i, j) {
            (1, 0) => self.first.cross(&self.subspace(q, 1).angular),
            _ => Vector3::zeros(),
        };
        Twist { angular, linear: Vector3::zeros() }
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
        // The second axis shows where the first turning has led it.
        let carried = pose.rotation * self.second;
        let angle = self.first.cross(&self.second).dot(&carried).atan2(self.second.dot(&carried));
        let rest = Pose::new(exp(&(self.first * -angle)) * pose.rotation, Vector3::zeros());
        let second = Revolute { axis: self.second }.nearest(&rest)[0];
        [angle, second, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
