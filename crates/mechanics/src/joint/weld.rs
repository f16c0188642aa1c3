//! No motion: X_FM = I.

use super::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Twist, Vector3};

pub(super) struct Weld;

impl Kinematics for Weld {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, _: &Configuration) -> Pose {
        Pose::identity()
    }
    fn subspace(&self, _: &Configuration, _: usize) -> Twist {
        Twist { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }
    fn moved(&self, configuration: &Configuration, _: &[f64]) -> Configuration {
        *configuration
    }
    fn step(&self, _: &Configuration, _: &Configuration) -> [f64; MAX_FREEDOMS] {
        [0.0; MAX_FREEDOMS]
    }
    fn coordinates(&self, _: &Configuration) -> [f64; MAX_FREEDOMS] {
        [0.0; MAX_FREEDOMS]
    }
    fn configuration(&self, _: &[f64]) -> Configuration {
        Configuration::default()
    }
    fn nearest(&self, _: &Pose) -> Configuration {
        Configuration::default()
    }
}
