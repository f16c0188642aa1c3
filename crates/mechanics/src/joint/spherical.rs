//! Turning about a point. The configuration is a unit quaternion, so no orientation is singular; H is the
//! identity on turnings in F's axes, and a user reads the rotation vector.

use super::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Quaternion, Twist, UnitQuaternion, Vector3, exp, left_jacobian_inverse, log};

pub(super) struct Spherical;

fn rotation(configuration: &Configuration) -> UnitQuaternion<f64> {
    let [w, x, y, z, ..] = *configuration;
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

fn stored(rotation: &UnitQuaternion<f64>) -> Configuration {
    let q = rotation.quaternion();
    [q.w, q.i, q.j, q.k, 0.0, 0.0, 0.0]
}

/// c(θ) and c'(θ)/θ, by their series where the closed forms cancel.
fn series(angle: f64) -> (f64, f64) {
    let a2 = angle * angle;
    if angle < 0.1 {
        return (
            1.0 / 12.0 + a2 / 720.0 + a2 * a2 / 30240.0 + a2 * a2 * a2 / 1_209_600.0,
            1.0 / 360.0 + a2 / 7560.0 + a2 * a2 / 201_600.0,
        );
    }
    let half = 0.5 * angle;
    let (sine, cosine) = half.sin_cos();
    let c = 1.0 / a2 - 0.5 * cosine / (sine * angle);
    // d/dθ of 1/θ² - cot(θ/2)/(2θ).
    let slope = -2.0 / (a2 * angle) + 0.25 / (sine * sine * angle) + 0.5 * cosine / (sine * a2);
    (c, slope / angle)
}

impl Kinematics for Spherical {
    fn home(&self) -> Configuration {
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        Pose::new(rotation(configuration), Vector3::zeros())
    }
    fn subspace(&self, _: &Configuration, i: usize) -> Twist {
        let mut angular = Vector3::zeros();
        angular[i] = 1.0;
        Twist { angular, linear: Vector3::zeros() }
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        stored(&(exp(&Vector3::new(step[0], step[1], step[2])) * rotation(configuration)))
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        let v = log(&(rotation(to) * rotation(from).inverse()));
        [v.x, v.y, v.z, 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        let v = log(&rotation(configuration));
        [v.x, v.y, v.z, 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        stored(&exp(&Vector3::new(coordinates[0], coordinates[1], coordinates[2])))
    }
    /// The rotation vector v moves by `δv = J⁻¹(v) δθ` (J the left Jacobian), so efforts on v act as
    /// `J⁻ᵀ(v) τ = τ + ½ v×τ + c v×(v×τ)` with `c = 1/θ² - cot(θ/2)/(2θ)`, θ = |v|.
    fn generalised(
        &self,
        configuration: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let v = log(&rotation(configuration));
        let t = Vector3::new(tau[0], tau[1], tau[2]);
        let (c, slope_of_c) = series(v.norm());
        let double = v.cross(&v.cross(&t));
        let value = t + v.cross(&t) * 0.5 + double * c;
        let to_v = left_jacobian_inverse(&v);
        let mut tangent = [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS];
        for j in 0..3 {
            let dv: Vector3<f64> = to_v.column(j).into();
            let dt = Vector3::new(slope[0] * dv.x, slope[1] * dv.y, slope[2] * dv.z);
            let change = dt
                + (dv.cross(&t) + v.cross(&dt)) * 0.5
                + double * (slope_of_c * v.dot(&dv))
                + (dv.cross(&v.cross(&t)) + v.cross(&dv.cross(&t)) + v.cross(&v.cross(&dt))) * c;
            for i in 0..3 {
                tangent[i][j] = change[i];
            }
        }
        ([value.x, value.y, value.z, 0.0, 0.0, 0.0], tangent)
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        stored(&pose.rotation)
    }
}
