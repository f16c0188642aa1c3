//! Two concentric tubes of uniform curvature without load: the angle between them is a pendulum's.
//!
//! P. E. Dupont, J. Lock, B. Itkowitz and E. Butler, "Design and control of concentric-tube robots", IEEE Trans.
//! Robotics 26 (2010) 209-225, section III; R. J. Webster, J. M. Romano and N. J. Cowan, "Mechanics of
//! precurved-tube continuum robots", IEEE Trans. Robotics 25 (2009) 67-78. With the tubes' bending and
//! torsional stiffnesses B_i, C_i and curvatures κ_i in planes that make the angle θ,
//!
//! ```text
//! θ'' = c sin θ,   c = κ_1 κ_2 (1/C_1 + 1/C_2) B_1 B_2/(B_1 + B_2),   θ'(L) = 0
//! ```
//!
//! so χ = θ - π swings as a pendulum that turns back at L, at χ_L:
//! sin(χ/2) = k cd(√c (L - s) | k²), k = sin(χ_L/2), cd = cn/dn (DLMF 22.19(i)).

use crate::elliptic::jacobi;

/// Two tubes of uniform curvature from s = 0 to their common end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoTubes {
    /// EI of both, N·m².
    pub bending: [f64; 2],
    /// GJ of both, N·m².
    pub torsion: [f64; 2],
    /// Curvatures κ, 1/m.
    pub curvature: [f64; 2],
    /// L, m.
    pub length: f64,
    /// θ(L), rad, between 0 and 2π.
    pub tip_angle: f64,
}

impl TwoTubes {
    /// c, 1/m².
    pub fn rate(&self) -> f64 {
        let ([b1, b2], [c1, c2], [k1, k2]) = (self.bending, self.torsion, self.curvature);
        k1 * k2 * (1.0 / c1 + 1.0 / c2) * b1 * b2 / (b1 + b2)
    }

    /// θ(s), rad.
    pub fn angle(&self, s: f64) -> f64 {
        let (k, m1) = self.modulus();
        let at = jacobi(self.rate().sqrt() * (self.length - s), m1);
        std::f64::consts::PI + 2.0 * (k * at.cn / at.dn).asin()
    }

    /// θ'(s), rad/m.
    pub fn twist(&self, s: f64) -> f64 {
        let (k, m1) = self.modulus();
        let root = self.rate().sqrt();
        let at = jacobi(root * (self.length - s), m1);
        // cd' = -(1 - k²) sd nd, and cos(χ/2) χ'/2 = k √c (1 - k²) sd nd.
        let half = k * at.cn / at.dn;
        2.0 * k * root * m1 * at.sn / (at.dn * at.dn) / (1.0 - half * half).sqrt()
    }

    /// The length at which tubes held opposite at s = 0 (θ = π) begin to snap: √c L = π/2.
    pub fn snapping_length(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 / self.rate().sqrt()
    }

    /// k = sin(χ_L/2) and 1 - k².
    fn modulus(&self) -> (f64, f64) {
        let (sin, cos) = (0.5 * (self.tip_angle - std::f64::consts::PI)).sin_cos();
        (sin, cos * cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    const TUBES: TwoTubes = TwoTubes {
        bending: [1.0, 2.5],
        torsion: [0.8, 1.9],
        curvature: [1.5, 1.1],
        length: 0.9,
        tip_angle: 1.3,
    };

    #[test]
    fn the_angle_solves_the_pendulums_equation() {
        assert_close(TUBES.angle(TUBES.length), TUBES.tip_angle, 1e-15, "θ(L)");
        assert_close(TUBES.twist(TUBES.length), 0.0, 1e-15, "θ'(L)");
        for s in [0.0, 0.2, 0.55] {
            let h = 1e-2;
            let slope = |f: &dyn Fn(f64) -> f64| {
                (45.0 * (f(s + h) - f(s - h)) - 9.0 * (f(s + 2.0 * h) - f(s - 2.0 * h)) + f(s + 3.0 * h)
                    - f(s - 3.0 * h))
                    / (60.0 * h)
            };
            assert_close(slope(&|s| TUBES.angle(s)), TUBES.twist(s), 1e-10, "θ'");
            let bent = TUBES.rate() * TUBES.angle(s).sin();
            assert_close(slope(&|s| TUBES.twist(s)), bent, 1e-9, "θ''");
            let energy = |s: f64| 0.5 * TUBES.twist(s).powi(2) + TUBES.rate() * TUBES.angle(s).cos();
            assert_close(energy(s), energy(TUBES.length), 1e-14, "the pendulum's energy");
        }
    }

    #[test]
    fn the_snapping_length_is_a_quarter_of_the_period_of_small_swings() {
        let near = TwoTubes { tip_angle: std::f64::consts::PI - 1e-6, ..TUBES };
        let edge = TwoTubes { length: near.snapping_length(), ..near };
        assert_close(edge.angle(0.0), std::f64::consts::PI, 1e-15, "θ(0)");
    }
}
