//! Sliding in a plane and turning about its normal: X_FM = (exp(q2 n), q0 x + q1 n × x).

use super::{Configuration, Kinematics, MAX_FREEDOMS, revolute::Revolute};
use flexura_spatial::{Pose, Twist, Vector3, exp};

pub(super) struct Planar {
    pub normal: Vector3<f64>,
    pub x: Vector3<f64>,
}

impl Planar {
    fn y(&self) -> Vector3<f64> {
        self.normal.cross(&self.x)
    }
}

impl Kinematics for Planar {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, q: &Configuration) -> Pose {
        Pose::new(exp(&(self.normal * q[2])), self.x * q[0] + self.y() * q[1])
    }
    fn subspace(&self, _: &Configuration, i: usize) -> Twist {
        let none = Vector3::zeros();
        match i {
            0 => Twist { angular: none, linear: self.x },
            1 => Twist { angular: none, linear: self.y() },
            _ => Twist { angular: self.normal, linear: none },
        }
    }
    fn moved(&self, q: &Configuration, step: &[f64]) -> Configuration {
        let mut moved = *q;
        for i in 0..3 {
            moved[i] += step[i];
        }
        moved
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        [to[0] - from[0], to[1] - from[1], to[2] - from[2], 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, q: &Configuration) -> [f64; MAX_FREEDOMS] {
        [q[0], q[1], q[2], 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], coordinates[1], coordinates[2], 0.0, 0.0, 0.0, 0.0]
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        let angle = Revolute { axis: self.normal }.nearest(pose)[0];
        [self.x.dot(&pose.position), self.y().dot(&pose.position), angle, 0.0, 0.0, 0.0, 0.0]
    }
}
