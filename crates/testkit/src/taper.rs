//! Small deflections of tapered cantilevers under a tip force and a tip moment.
//!
//! With EI(s) = EI0 (1 - c s/L)ⁿ: n = 1 for a linear taper of the width, 3 of the height, 4 for a cone; the
//! tip keeps the fraction g = 1 - c of the dimension. Everything is an integral
//! `I_j = ∫₀¹ (1 - x)ʲ/(1 - c x)ⁿ dx`, with t = 1 - c x a sum of powers of t and one logarithm.
//! Compare Young and Budynas, *Roark's Formulas for Stress and Strain*, 7th ed. (2002), table 8.11.

/// How the stiffness falls along the beam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taper {
    /// The width falls linearly: EI like the dimension.
    Width,
    /// The height falls linearly: EI like its cube.
    Height,
    /// A cone: EI like the fourth power of the diameter.
    Cone,
}

/// Displacement and rotation of the tip, per unit of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliances {
    /// Deflection by a force: times F L³/EI0.
    pub deflection_by_force: f64,
    /// Rotation by a force, and deflection by a moment: times F L²/EI0 or M L²/EI0.
    pub rotation_by_force: f64,
    /// Rotation by a moment: times M L/EI0.
    pub rotation_by_moment: f64,
}

/// The tip compliances of a tapered cantilever whose tip keeps the fraction 0 < `tip` < 1 of the clamped
/// end's dimension; EI0 at the clamp.
///
/// The closed forms cancel like (1 - tip)³ as the taper vanishes: keep `tip` below 0.9 for 1e-12.
pub fn tapered_cantilever(taper: Taper, tip: f64) -> Compliances {
    let power = match taper {
        Taper::Width => 1,
        Taper::Height => 3,
        Taper::Cone => 4,
    };
    Compliances {
        deflection_by_force: integral(2, power, tip),
        rotation_by_force: integral(1, power, tip),
        rotation_by_moment: integral(0, power, tip),
    }
}

/// ∫₀¹ (1 - x)ʲ (1 - c x)⁻ⁿ dx = c^{-j-1} ∫_g^1 (t - g)ʲ t⁻ⁿ dt, g = 1 - c.
fn integral(j: i32, n: i32, g: f64) -> f64 {
    let binomial = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 1.0]][j as usize];
    let mut sum = 0.0;
    for (i, factor) in binomial.iter().enumerate().take(j as usize + 1) {
        // The term factor · t^{j-i} (-g)^i · t⁻ⁿ.
        let exponent = j - i as i32 - n + 1;
        let primitive = if exponent == 0 { -g.ln() } else { (1.0 - g.powi(exponent)) / f64::from(exponent) };
        sum += factor * (-g).powi(i as i32) * primitive;
    }
    sum / (1.0 - g).powi(j + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    #[test]
    fn the_closed_forms_are_the_integrals() {
        for (taper, n) in [(Taper::Width, 1), (Taper::Height, 3), (Taper::Cone, 4)] {
            for g in [0.1, 0.3, 0.5, 0.8] {
                let closed = tapered_cantilever(taper, g);
                // Simpson's rule on 2000 intervals.
                let simpson = |j: i32| {
                    let f = |x: f64| (1.0 - x).powi(j) / (1.0 - (1.0 - g) * x).powi(n);
                    (0..1000)
                        .map(|i| {
                            let (a, h) = (f64::from(i) / 1000.0, 1e-3);
                            (f(a) + 4.0 * f(a + 0.5 * h) + f(a + h)) * h / 6.0
                        })
                        .sum::<f64>()
                };
                assert_close(closed.deflection_by_force, simpson(2), 1e-8, "deflection");
                assert_close(closed.rotation_by_force, simpson(1), 1e-7, "rotation");
                assert_close(closed.rotation_by_moment, simpson(0), 1e-6, "moment");
            }
        }
    }

    #[test]
    fn a_cone_deflects_by_its_ratio_of_diameters_more() {
        // δ = F L³/(3 E I0) · d0/d1 (Roark).
        for g in [0.2, 0.5, 0.8] {
            let cone = tapered_cantilever(Taper::Cone, g);
            assert_close(cone.deflection_by_force, 1.0 / (3.0 * g), 1e-13, "cone");
        }
    }

    #[test]
    fn a_sharp_triangular_spring_deflects_half_as_much_again() {
        // A leaf whose width falls to nothing has constant stress: δ = F L³/2EI0.
        let leaf = tapered_cantilever(Taper::Width, 1e-12);
        assert_close(leaf.deflection_by_force, 0.5, 1e-11, "triangular leaf");
    }
}
