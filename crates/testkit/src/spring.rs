//! Small-load stiffness of helical springs, and the exact linear flexibility of any curved rod.

use crate::ivp::integrate;
use flexura_spatial::{Matrix6, Pose, hat};
use nalgebra::{Matrix3, SMatrix};

/// Wahl's axial stiffness G d⁴/(8 D³ n), N/m: torsion of a flat coil only.
///
/// `shear_modulus` Pa, `wire` diameter d and mean coil diameter `coil` D in m, `turns` n.
/// A. M. Wahl, *Mechanical Springs*, 2nd ed. (1963).
pub fn wahl_stiffness(shear_modulus: f64, wire: f64, coil: f64, turns: f64) -> f64 {
    shear_modulus * wire.powi(4) / (8.0 * coil.powi(3) * turns)
}

/// A helical spring whose ends turn freely about the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelicalSpring {
    /// Coil radius r, m.
    pub radius: f64,
    /// Rise per turn, m.
    pub pitch: f64,
    /// Number of turns.
    pub turns: f64,
    /// (1/EA, 1/GA, 1/GJ, 1/EI): stretch, shear, twist and bend per force or moment; zero suppresses one.
    pub compliance: [f64; 4],
}

impl HelicalSpring {
    /// The wire's length, m.
    pub fn length(&self) -> f64 {
        self.turns * (std::f64::consts::TAU * self.radius).hypot(self.pitch)
    }

    /// Axial displacement per axial force along the coil axis, m/N.
    ///
    /// With α the pitch angle, the wire carries torsion P r cos α and bending P r sin α, tension P sin α and
    /// shear P cos α:
    /// `δ/P = L [r² (cos²α/GJ + sin²α/EI) + sin²α/EA + cos²α/GA]` (Love, 1927, §271; Wahl, 1963, ch. 3).
    pub fn axial_flexibility(&self) -> f64 {
        let angle = self.pitch.atan2(std::f64::consts::TAU * self.radius);
        let (s2, c2) = (angle.sin().powi(2), angle.cos().powi(2));
        let [stretch, shear, twist, bend] = self.compliance;
        self.length() * (self.radius.powi(2) * (c2 * twist + s2 * bend) + s2 * stretch + c2 * shear)
    }
}

/// The exact linear flexibility of a clamped rod of any rest shape at its end: the end's (displacement,
/// rotation) per (force, moment) on it, in the start frame's axes, 6 x 6 and symmetric.
///
/// Castigliano's theorem: with the local wrench A(s) w at s under the end wrench w,
/// `A = [Rᵀ, 0; Rᵀ hat(p_L - p), Rᵀ]`, the flexibility is `∫ Aᵀ C A ds`. `rest` is the rest pose at s (m),
/// `compliance` = (1/EA, 1/GA2, 1/GA3, 1/GJ, 1/EI2, 1/EI3), `steps` the steps of an order-12 quadrature
/// (sixteen per turn give round-off).
pub fn end_flexibility(
    rest: impl Fn(f64) -> Pose,
    compliance: &[f64; 6],
    length: f64,
    steps: usize,
) -> Matrix6<f64> {
    let end = rest(length).position;
    let rate = |s: f64, _: &[f64; 36]| {
        let pose = rest(s);
        let back: Matrix3<f64> = pose.rotation.to_rotation_matrix().matrix().transpose();
        let mut a = SMatrix::<f64, 6, 6>::zeros();
        a.fixed_view_mut::<3, 3>(0, 0).copy_from(&back);
        a.fixed_view_mut::<3, 3>(3, 0).copy_from(&(back * hat(&(end - pose.position))));
        a.fixed_view_mut::<3, 3>(3, 3).copy_from(&back);
        let product = a.transpose() * SMatrix::<f64, 6, 6>::from_diagonal(&(*compliance).into()) * a;
        std::array::from_fn(|i| product[(i / 6, i % 6)])
    };
    let path = integrate(rate, [0.0; 36], 0.0, length, steps);
    Matrix6::from_fn(|i, j| path[steps].1[6 * i + j])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::ivp::rest_poses;
    use crate::rod::Rod;
    use flexura_spatial::Vector3;
    use nalgebra::Vector6;
    use std::f64::consts::{PI, TAU};

    fn spring(pitch: f64) -> HelicalSpring {
        // Wire radius 0.6985 mm, coil radius 7.239 mm, E 193, G 80.8 GPa.
        let (r, e, g) = (0.6985e-3f64, 193e9, 80.8e9);
        let (area, i) = (PI * r * r, PI * r.powi(4) / 4.0);
        HelicalSpring {
            radius: 7.239e-3,
            pitch,
            turns: 10.0,
            compliance: [1.0 / (e * area), 0.0, 1.0 / (g * 2.0 * i), 1.0 / (e * i)],
        }
    }

    fn rest(spring: &HelicalSpring) -> (Vector3<f64>, impl Fn(f64) -> Pose + use<>) {
        let c = spring.pitch / TAU;
        let d2 = spring.radius.powi(2) + c * c;
        let k = Vector3::new(c / d2, 0.0, spring.radius / d2);
        let helix = crate::helix::HelixByWrench {
            bending_stiffness: 1.0,
            torsion_stiffness: 1.0,
            axial_stiffness: f64::INFINITY,
            bend: k.z,
            torsion: k.x,
            twist: k.x,
        };
        (k, move |s| helix.pose(s))
    }

    #[test]
    fn a_flat_coil_has_wahls_stiffness() {
        let mut flat = spring(0.0);
        flat.compliance[0] = 0.0;
        let wahl = wahl_stiffness(80.8e9, 2.0 * 0.6985e-3, 2.0 * 7.239e-3, 10.0);
        assert_close(flat.axial_flexibility() * wahl, 1.0, 1e-14, "Wahl");
        // At the seed's pitch of 5.715 mm per turn the two differ by well under a percent.
        assert!((spring(5.715e-3).axial_flexibility() * wahl - 1.0).abs() < 0.01);
    }

    #[test]
    fn the_flexibility_along_the_axis_is_loves() {
        for pitch in [5.715e-3, TAU * 5.715e-3] {
            let spring = spring(pitch);
            let (k, pose) = rest(&spring);
            let [ea, ga, gj, ei] = spring.compliance;
            let flexibility = end_flexibility(&pose, &[ea, ga, ga, gj, ei, ei], spring.length(), 160);
            // A unit force along the axis, moved from the axis to the end of the wire.
            let axis = Vector3::new(k.x, 0.0, k.z).normalize();
            let lever = Vector3::new(0.0, spring.radius, 0.0) - pose(spring.length()).position;
            let moment = lever.cross(&axis);
            let wrench = Vector6::new(axis.x, axis.y, axis.z, moment.x, moment.y, moment.z);
            let found = wrench.dot(&(flexibility * wrench));
            assert_close(found / spring.axial_flexibility(), 1.0, 1e-12, "Love");
            assert_close(
                (flexibility - flexibility.transpose()).norm() / flexibility.norm(),
                0.0,
                1e-14,
                "symmetry",
            );
        }
    }

    #[test]
    fn a_straight_rod_has_the_flexibilities_of_the_textbook() {
        let c = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
        let rod = Rod::uniform(2.0, c, Vector3::zeros());
        assert_close(rest_poses(&rod, 4)[4].1.position.x, 2.0, 1e-14, "straight");
        let f = end_flexibility(|s| Pose::translation(Vector3::x() * s), &c, 2.0, 4);
        assert_close(f[(0, 0)], 2.0 * 0.1, 1e-14, "L/EA");
        assert_close(f[(1, 1)], 8.0 / 3.0 * 0.6 + 2.0 * 0.2, 1e-14, "L³/3EI3 + L/GA2");
        assert_close(f[(2, 2)], 8.0 / 3.0 * 0.5 + 2.0 * 0.3, 1e-14, "L³/3EI2 + L/GA3");
        assert_close(f[(1, 5)], 2.0 * 0.6, 1e-14, "L²/2EI3");
        assert_close(f[(2, 4)], -2.0 * 0.5, 1e-14, "-L²/2EI2");
        assert_close(f[(3, 3)], 2.0 * 0.4, 1e-14, "L/GJ");
    }
}
