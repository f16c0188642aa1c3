//! A strip between a clamp and a slider that keeps its direction, pushed together, with a weight at its middle: the bent
//! shapes by elliptic integrals.
//!
//! The strip neither stretches nor shears and stays in its plane; it bends to one side, symmetrically. Its quarters are
//! alike: from the clamp to the place without moment, `θ'' = -ω² sin(θ - δ)` with the force ω² EI = √(N² + V²) of push N and half
//! the weight V, tan δ = V/N. So `sin(χ/2) = k sn u`, χ = θ - δ, from u = -F(φ) with sin φ = sin(δ/2)/k at the clamp to the quarter period
//! K:
//!
//! ```text
//! ωL/4 = K + F(φ)    C = ∫cos χ du = 2E + 2E(φ) - K - F(φ)    S = ∫sin χ du = 2k cos φ
//! x = (C cos δ - S sin δ)/ω        y = (C sin δ + S cos δ)/ω
//! ```
//!
//! A weight against the deflection has δ > 0. Then n as a function of k has a least value, the fold at which the branch
//! begins that is not connected with the unloaded strip. (Love, *A Treatise on the Mathematical Theory of Elasticity*, 4th ed.
//! (1927), §263.)
//!
//! Forces are in units of π²EI/(4L²), in which the weightless strip buckles at 16; lengths in units of L.

use crate::elliptic::{complete_first, complete_second, first, second};
use crate::roots::root;
use std::f64::consts::{FRAC_PI_2, PI};

/// The unit of forces, in EI/L².
pub const UNIT: f64 = PI * PI / 4.0;

/// One bent shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// The push n on the slider.
    pub push: f64,
    /// The deflection of the middle, w/L >= 0.
    pub middle: f64,
    /// What the slider moves outwards, u1/L <= 0.
    pub slide: f64,
}

/// The weightless strip past its first buckling load: K(k) = π√n/8, w = 8k/(π√n), u1 = 2E/K - 2. None for n <= 16.
pub fn weightless(push: f64) -> Option<Shape> {
    if push <= 16.0 {
        return None;
    }
    let wanted = PI * push.sqrt() / 8.0;
    // K = ln(4/√m1) + .. for small m1: the logarithm of m1 is the unknown.
    let m1 = root(|y| complete_first(y.exp()) - wanted, -2.0 * wanted - 8.0, 0.0)?.exp();
    let modulus = (1.0 - m1).sqrt();
    let middle = 8.0 * modulus / (PI * push.sqrt());
    Some(Shape { push, middle, slide: 2.0 * complete_second(m1) / complete_first(m1) - 2.0 })
}

/// The strip with a weight at its middle, level: the weight acts straight across.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    /// The weight; against the deflection if positive, with it if negative.
    pub weight: f64,
}

impl Level {
    /// ω L and δ.
    fn force(&self, push: f64) -> (f64, f64) {
        let (n, v) = (push * UNIT, 0.5 * self.weight * UNIT);
        (n.hypot(v).sqrt(), v.atan2(n))
    }

    /// ωL/4 - K - F(φ): negative if the push is too small for the modulus.
    fn excess(&self, push: f64, modulus: f64) -> f64 {
        let (rate, tilt) = self.force(push);
        let m1 = 1.0 - modulus * modulus;
        0.25 * rate - complete_first(m1) - first(start(tilt, modulus), m1)
    }

    fn shape(&self, push: f64, modulus: f64) -> Shape {
        let (rate, tilt) = self.force(push);
        let (phi, m1) = (start(tilt, modulus), 1.0 - modulus * modulus);
        let cosine = 2.0 * (complete_second(m1) + second(phi, m1)) - complete_first(m1) - first(phi, m1);
        let sine = 2.0 * modulus * phi.cos();
        let (s, c) = tilt.sin_cos();
        let [x, y] = [(c * cosine - s * sine) / rate, (s * cosine + c * sine) / rate];
        Shape { push, middle: 2.0 * y, slide: 4.0 * x - 1.0 }
    }

    /// Against a weight there is one push for every modulus, but two moduli for a push past the fold.
    fn of_modulus(&self, modulus: f64) -> Option<Shape> {
        let push = root(|n| self.excess(n, modulus), 1e-3, 1e3)?;
        Some(self.shape(push, modulus))
    }

    /// The shape under a push that bends with the weight. None if the weight acts against.
    pub fn at_push(&self, push: f64) -> Option<Shape> {
        let least = (0.5 * self.force(push).1.abs()).sin();
        if self.weight >= 0.0 {
            return None;
        }
        // K - F rises from nothing to infinity with the modulus.
        let modulus = root(|k| self.excess(push, k), least, 1.0 - 1e-12)?;
        Some(self.shape(push, modulus))
    }

    /// The shape whose middle is at `middle`, up to 0.4.
    pub fn at_middle(&self, middle: f64) -> Option<Shape> {
        let miss = |shape: Option<Shape>| shape.map_or(f64::NAN, |shape| shape.middle - middle);
        if self.weight < 0.0 {
            return self.at_push(root(|n| miss(self.at_push(n)), 1e-6, 30.0)?);
        }
        // In small deflections k = πw/2 + V/2N.
        let modulus = root(|k| miss(self.of_modulus(k)), middle, (2.0 * middle + 0.1).min(0.95))?;
        self.of_modulus(modulus)
    }

    /// The fold: the least push of the branch that is bent against the weight. None if the weight is not against.
    pub fn fold(&self) -> Option<Shape> {
        // n'(k) = 0 where ∂(K + F(φ))/∂k = 0 at fixed n.
        let slope = |k: f64| {
            let Some(shape) = self.of_modulus(k) else { return f64::NAN };
            let (m, m1) = (k * k, 1.0 - k * k);
            let phi = start(self.force(shape.push).1, k);
            let half = (1.0 - m * phi.sin().powi(2)).sqrt();
            let complete = complete_second(m1) - m1 * complete_first(m1);
            let part = second(phi, m1) - m1 * first(phi, m1);
            (complete + part) / (k * m1) - k * phi.sin() * phi.cos() / (m1 * half) - phi.tan() / (k * half)
        };
        if self.weight <= 0.0 {
            return None;
        }
        // In small deflections w³ = W/2π⁴ at the fold.
        let guess = 0.5 * PI * (self.weight / (2.0 * PI.powi(4))).cbrt();
        self.of_modulus(root(slope, 0.5 * guess, (1.5 * guess).min(0.95))?)
    }
}

/// The fold's push n = 16 + 6 (W/2π)^(2/3) and deflection w = (W/2π⁴)^(1/3) for a small weight W against the deflection: the
/// pitchfork of the weightless strip, unfolded.
///
/// From n = 16 + 2π²w² + 2W/(π²w), the first terms of the strip's energy in the mode (1 - cos 2πs)/2. (W. T. Koiter, *On the
/// Stability of Elastic Equilibrium* (1945), on imperfections of a stable symmetric branch point.) What is left out is of
/// relative order W^(2/3).
pub fn unfolded(weight: f64) -> Shape {
    let middle = (0.5 * weight / PI.powi(4)).cbrt();
    let push = 16.0 + 6.0 * (weight / (2.0 * PI)).powf(2.0 / 3.0);
    Shape { push, middle, slide: -(0.5 * PI * middle).powi(2) }
}

/// φ at the clamp: sin φ = sin(δ/2)/k.
fn start(tilt: f64, modulus: f64) -> f64 {
    let sine = (0.5 * tilt).sin() / modulus;
    if sine.abs() >= 1.0 { FRAC_PI_2.copysign(sine) } else { sine.asin() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::elastica::Elastica;

    #[test]
    fn the_weightless_strip_has_its_known_shapes() {
        for (n, w, u) in [
            (17.0, 0.209_454_109_4, -0.116_769_100_3),
            (20.0, 0.345_598_294_0, -0.389_476_456_9),
            (25.0, 0.398_641_832_3, -0.684_471_073_3),
        ] {
            let shape = weightless(n).unwrap();
            assert_close(shape.middle, w, 5.1e-11, "w");
            assert_close(shape.slide, u, 5.1e-11, "u1");
        }
        assert!(weightless(16.0).is_none());
    }

    #[test]
    fn a_quarter_of_the_weightless_strip_is_a_cantilever() {
        for n in [16.5, 21.0, 40.0] {
            let tip = Elastica::dead(n * UNIT / 16.0, PI).tip();
            let shape = weightless(n).unwrap();
            assert_close(shape.middle, 0.5 * tip.position[1].abs(), 1e-14, "w");
            assert_close(shape.slide, tip.position[0] - 1.0, 1e-14, "u1");
        }
    }

    #[test]
    fn a_weight_with_the_deflection_bends_a_quarter_as_an_inclined_force_does() {
        let strip = Level { weight: -0.8 };
        for middle in [0.05, 0.2, 0.35] {
            let shape = strip.at_middle(middle).unwrap();
            assert_close(shape.middle, middle, 1e-14, "as wanted");
            let (n, v) = (shape.push * UNIT, 0.4 * UNIT);
            let tip = Elastica::dead(n.hypot(v) / 16.0, PI - v.atan2(n)).tip();
            assert_close(0.5 * tip.position[1], middle, 1e-13, "w");
            assert_close(tip.position[0] - 1.0, shape.slide, 1e-13, "u1");
        }
    }

    #[test]
    fn the_fold_has_its_known_place_and_tends_to_the_unfolded_pitchforks() {
        let fold = Level { weight: 0.8 }.fold().unwrap();
        assert_close(fold.push, 17.476_120_897_3, 5.1e-11, "n");
        assert_close(fold.middle, 0.156_164_927_0, 5.1e-11, "w");
        assert_close(fold.slide, -0.062_768_301_2, 5.1e-11, "u1");
        // What is left of the small weights' law falls as W^(2/3).
        let part = |weight: f64| {
            (Level { weight }.fold().unwrap().push - 16.0) / (unfolded(weight).push - 16.0) - 1.0
        };
        let order = (part(1e-3) / part(1e-4)).abs().log10();
        assert_close(order, 2.0 / 3.0, 0.01, "order");
        let small = Level { weight: 1e-7 }.fold().unwrap();
        assert_close(small.middle / unfolded(1e-7).middle, 1.0, 1e-4, "w");
        assert_close(small.slide / unfolded(1e-7).slide, 1.0, 1e-4, "u1");
        assert!(Level { weight: -0.8 }.fold().is_none());
    }
}
