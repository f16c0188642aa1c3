//! A straight rod with equal bending stiffnesses that its end wrench bends into a helix.
//!
//! Love, *A Treatise on the Mathematical Theory of Elasticity*, 4th ed. (1927), §§270-271, with the rod's
//! stretch added. Let the helix have curvature κ and torsion τ and the section twist k1, all per
//! undeformed length, B = EI, C = GJ, Ω = √(κ²+τ²), a = (τ e_T + κ e_B)/Ω the helix axis. Then
//! `M = C k1 e_T + B κ e_B` and `F = N a`, and `M' = -p' × F` with p' = (1+ε) e_T gives
//!
//! ```text
//! N (1 + ε) = Ω (C k1 - B τ),    ε = F·e_T/EA = N τ/(Ω EA)
//! ```

use flexura_spatial::{Pose, Vector3, Wrench, exp};

/// The rod and the helix that it is bent into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixByWrench {
    /// EI2 = EI3, N·m².
    pub bending_stiffness: f64,
    /// GJ, N·m².
    pub torsion_stiffness: f64,
    /// EA, N; infinite for an inextensible rod.
    pub axial_stiffness: f64,
    /// κ > 0 per undeformed length, 1/m.
    pub bend: f64,
    /// τ per undeformed length, 1/m.
    pub torsion: f64,
    /// k1, the rate at which the section turns about e1, 1/m; free to choose. `torsion` keeps e2 towards
    /// the axis; B τ/C needs no force, only a moment.
    pub twist: f64,
}

impl HelixByWrench {
    /// The axial stretch ε, the same everywhere. The root of ε(1+ε) = τ(C k1 - B τ)/EA near zero.
    pub fn stretch(&self) -> f64 {
        let right = self.torsion * self.excess() / self.axial_stiffness;
        2.0 * right / (1.0 + (1.0 + 4.0 * right).sqrt())
    }

    /// The constant force (N, along the axis) in the start frame, whose e2 points to the axis.
    pub fn force(&self) -> Vector3<f64> {
        // N a = (C k1 - B τ)/(1 + ε) (τ, 0, κ).
        Vector3::new(self.torsion, 0.0, self.bend) * (self.excess() / (1.0 + self.stretch()))
    }

    /// The internal moment (N·m) at arc length `s`, in the start frame: C k1 e_T + B κ e_B.
    pub fn moment(&self, s: f64) -> Vector3<f64> {
        let frenet = self.frenet(s);
        frenet.rotation
            * Vector3::new(self.torsion_stiffness * self.twist, 0.0, self.bending_stiffness * self.bend)
    }

    /// The wrench that acts on the end of a rod of the given undeformed length, in the start frame, its
    /// moment about the end.
    pub fn tip_wrench(&self, length: f64) -> Wrench {
        Wrench::new(self.force(), self.moment(length))
    }

    /// The section's pose at undeformed arc length `s` in the start frame.
    pub fn pose(&self, s: f64) -> Pose {
        let frenet = self.frenet(s);
        let turn = exp(&Vector3::new((self.twist - self.torsion) * s, 0.0, 0.0));
        Pose::new(frenet.rotation * turn, frenet.position * (1.0 + self.stretch()))
    }

    fn excess(&self) -> f64 {
        self.torsion_stiffness * self.twist - self.bending_stiffness * self.torsion
    }

    /// Frenet frame and unstretched position: a turn by Ω s about the axis through (0, κ/Ω², 0).
    fn frenet(&self, s: f64) -> Pose {
        let rate = self.bend.hypot(self.torsion);
        let axis = Vector3::new(self.torsion, 0.0, self.bend) / rate;
        let rotation = exp(&(axis * (rate * s)));
        let center = Vector3::new(0.0, self.bend / (rate * rate), 0.0);
        let position = center - rotation * center + axis * (s * self.torsion / rate);
        Pose::new(rotation, position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{assert_close, assert_close_vec};

    fn helix() -> HelixByWrench {
        HelixByWrench {
            bending_stiffness: 2.0,
            torsion_stiffness: 1.6,
            axial_stiffness: 50.0,
            bend: 0.9,
            torsion: 0.5,
            twist: 1.1,
        }
    }

    #[test]
    fn the_moment_balances_the_force_about_the_end() {
        let helix = helix();
        let length = 7.3;
        let end = helix.pose(length);
        for i in 0..=20 {
            let s = length * f64::from(i) / 20.0;
            let lever = end.position - helix.pose(s).position;
            let balance = helix.moment(s) - helix.moment(length) - lever.cross(&helix.force());
            assert!(balance.norm() < 1e-13, "s = {s}: {balance}");
        }
    }

    #[test]
    fn the_strains_follow_from_the_wrench_by_the_law_of_the_section() {
        let helix = helix();
        for s in [0.0, 1.0, 6.6] {
            let rotation = helix.pose(s).rotation;
            let local = rotation.inverse() * helix.moment(s);
            assert_close(local.x / helix.torsion_stiffness, helix.twist, 1e-15, "twist");
            let bend = local.y.hypot(local.z) / helix.bending_stiffness;
            assert_close(bend, helix.bend, 1e-15, "curvature");
            let axial = (rotation.inverse() * helix.force()).x / helix.axial_stiffness;
            assert_close(axial, helix.stretch(), 1e-15, "stretch");
            // The tangent is the derivative of the position.
            let h = 1e-5;
            let slope = (helix.pose(s + h).position - helix.pose(s - h).position) / (2.0 * h);
            let tangent = rotation * Vector3::x() * (1.0 + helix.stretch());
            assert_close_vec(&slope, &tangent, 1e-9, "tangent");
        }
    }

    #[test]
    fn a_moment_alone_makes_a_helix_when_the_twist_is_right() {
        let mut helix = helix();
        helix.twist = helix.bending_stiffness * helix.torsion / helix.torsion_stiffness;
        assert!(helix.force().norm() < 1e-16);
        assert_close_vec(&helix.moment(0.0), &helix.moment(5.0), 1e-15, "constant moment");
    }

    #[test]
    fn a_helix_without_torsion_and_twist_is_the_rolled_up_beam() {
        let ring = HelixByWrench { torsion: 0.0, twist: 0.0, ..helix() };
        let ([x, y], _) = crate::roll_up::roll_up(0.9 * 2.0, 1.0);
        assert_close_vec(&ring.pose(2.0).position, &(Vector3::new(x, y, 0.0) * 2.0), 1e-15, "ring");
    }
}
