//! No constraint: any position of M's origin in F and any turning, kept as a ball joint keeps it. H is the identity on shifts and
//! turnings in F's axes; a user reads the position and the rotation vector.

use super::{Configuration, Kinematics, MAX_FREEDOMS, spherical::Spherical};
use flexura_spatial::{Pose, Twist, Vector3};

pub(super) struct Free;

/// The part of a configuration that is a rotation, as the configuration of a spherical joint.
fn ball(q: &Configuration) -> Configuration {
    [q[3], q[4], q[5], 0.0, 0.0, 0.0, 0.0]
}

fn joined(position: [f64; 3], ball: &Configuration) -> Configuration {
    [position[0], position[1], position[2], ball[0], ball[1], ball[2], 0.0]
}

impl Kinematics for Free {
    fn home(&self) -> Configuration {
        joined([0.0; 3], &Spherical.home())
    }
    fn pose(&self, q: &Configuration) -> Pose {
        Pose::new(Spherical.pose(&ball(q)).rotation, Vector3::new(q[0], q[1], q[2]))
    }
    fn subspace(&self, q: &Configuration, i: usize) -> Twist {
        if i >= 3 {
            return Spherical.subspace(&ball(q), i - 3);
        }
        let mut linear = Vector3::zeros();
        linear[i] = 1.0;
        Twist { angular: Vector3::zeros(), linear }
    }
    fn moved(&self, q: &Configuration, step: &[f64]) -> Configuration {
        let turned = Spherical.moved(&ball(q), &step[3..6]);
        joined([q[0] + step[0], q[1] + step[1], q[2] + step[2]], &turned)
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        let turn = Spherical.step(&ball(from), &ball(to));
        [to[0] - from[0], to[1] - from[1], to[2] - from[2], turn[0], turn[1], turn[2]]
    }
    fn coordinates(&self, q: &Configuration) -> [f64; MAX_FREEDOMS] {
        let turn = Spherical.coordinates(&ball(q));
        [q[0], q[1], q[2], turn[0], turn[1], turn[2]]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        let turn = Spherical.configuration(&coordinates[3..6]);
        joined([coordinates[0], coordinates[1], coordinates[2]], &turn)
    }
    fn generalised(
        &self,
        q: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let last = |v: &[f64; MAX_FREEDOMS]| [v[3], v[4], v[5], 0.0, 0.0, 0.0];
        let (turning, by_turning) = Spherical.generalised(&ball(q), &last(tau), &last(slope));
        let mut value = *tau;
        let mut tangent = [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS];
        for i in 0..3 {
            tangent[i][i] = slope[i];
            value[3 + i] = turning[i];
            tangent[3 + i][3..6].copy_from_slice(&by_turning[i][..3]);
        }
        (value, tangent)
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        joined(pose.position.into(), &Spherical.nearest(pose))
    }
}
