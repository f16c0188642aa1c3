//! Turning about a point. The configuration is the rotation vector, which a user reads; turns beyond half a turn count on, for of all
//! rotation vectors of an orientation the one next to the last is kept. H is the identity on turnings in F's axes, which are added to the
//! orientation itself, so none is singular.

use super::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Twist, UnitQuaternion, Vector3, exp, left_jacobian_inverse, log};
use std::f64::consts::TAU;

pub(super) struct Spherical;

/// Turning (rad) of which no axis can be told.
const NO_AXIS: f64 = 1e-13;

pub(super) fn vector(configuration: &Configuration) -> Vector3<f64> {
    let [x, y, z, ..] = *configuration;
    Vector3::new(x, y, z)
}

fn stored(v: &Vector3<f64>) -> Configuration {
    [v.x, v.y, v.z, 0.0, 0.0, 0.0, 0.0]
}

/// The rotation vector of a rotation that is next to another: of all (θ + 2πk) a, those whose length is next to the last one's, so that as
/// many turns are counted, one each way about a; of these two the nearer.
fn next_to(rotation: &UnitQuaternion<f64>, last: &Vector3<f64>) -> Vector3<f64> {
    let shortest = log(rotation);
    let (angle, reached) = (shortest.norm(), last.norm());
    if angle <= NO_AXIS {
        // Whole turns, about the same axis as before.
        let turns = (reached / TAU).round();
        return if turns > 0.0 { last * (turns * TAU / reached) } else { shortest };
    }
    let axis = shortest / angle;
    let turned = [reached, -reached].map(|length| angle + TAU * ((length - angle) / TAU).round());
    let apart = |turned: f64| (axis * turned - last).norm();
    let [one, other] = turned;
    let turned = if apart(one) <= apart(other) { one } else { other };
    if turned == angle { shortest } else { axis * turned }
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
        Configuration::default()
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        Pose::new(exp(&vector(configuration)), Vector3::zeros())
    }
    fn subspace(&self, _: &Configuration, i: usize) -> Twist {
        let mut angular = Vector3::zeros();
        angular[i] = 1.0;
        Twist { angular, linear: Vector3::zeros() }
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        let (last, step) = (vector(configuration), Vector3::new(step[0], step[1], step[2]));
        if step == Vector3::zeros() {
            return *configuration;
        }
        stored(&next_to(&(exp(&step) * exp(&last)), &last))
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        let v = log(&(exp(&vector(to)) * exp(&vector(from)).inverse()));
        [v.x, v.y, v.z, 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        let [x, y, z, ..] = *configuration;
        [x, y, z, 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], coordinates[1], coordinates[2], 0.0, 0.0, 0.0, 0.0]
    }
    /// The rotation vector v moves by `δv = J⁻¹(v) δθ` (J the left Jacobian), so efforts on v act as
    /// `J⁻ᵀ(v) τ = τ + ½ v×τ + c v×(v×τ)` with `c = 1/θ² - cot(θ/2)/(2θ)`, θ = |v|.
    fn generalised(
        &self,
        configuration: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let v = vector(configuration);
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
        stored(&log(&pose.rotation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_counts_on_beyond_half_a_turn_and_whole_turns() {
        let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        for (step, count) in [(0.3, 70), (-0.3, 70), (TAU / 12.0, 36)] {
            let mut here = Spherical.home();
            for i in 1..=count {
                here = Spherical.moved(&here, (axis * step).as_slice());
                let wanted = axis * (step * f64::from(i));
                assert!((vector(&here) - wanted).norm() < 1e-12, "{step} {i}: {here:?}");
            }
        }
    }

    #[test]
    fn it_is_left_past_whole_turns_about_another_axis_without_a_jump_of_the_pose() {
        let driven = Spherical.configuration(&[0.0, 3.0 * TAU, 0.0]);
        let moved = Spherical.moved(&driven, &[1e-3, 0.0, 0.0]);
        assert!((log(&Spherical.pose(&moved).rotation) - Vector3::new(1e-3, 0.0, 0.0)).norm() < 1e-14);
        assert!((vector(&moved).norm() - 3.0 * TAU).abs() < 0.01, "as many turns: {moved:?}");
        assert_eq!(Spherical.moved(&driven, &[0.0; 3]), driven);
    }
}
