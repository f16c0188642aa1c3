//! The planar elastica: an inextensible, unshearable cantilever under a tip force, dead or follower.
//!
//! With θ the tangent's angle, α the force's direction, both from the clamped tangent, and
//! χ = θ - α - π: `EI θ'' = F sin(θ - α)`, so `χ'' = -(F/EI) sin χ`, a pendulum that rests at the tip
//! (χ' = 0 there, no moment). With u = √(F/EI) (L - s), k = |sin(χ_L/2)|, m = k² (Love, *A Treatise on the
//! Mathematical Theory of Elasticity*, 4th ed. (1927), §§262-263; DLMF 22.19(i)):
//!
//! ```text
//! sin(χ/2) = σ k cd u,   cos(χ/2) = k' nd u,   dχ/du = -2σ k k' sd u
//! ∫cos χ du = 2 E(am u) - u - 2 m sn u cd u,   ∫sin χ du = 2σ k k' sd u
//! ```
//!
//! Lengths are in units of L, curvatures in 1/L, the load is F L²/EI.

use crate::elliptic::{Jacobi, jacobi, rf, second};
use std::f64::consts::{PI, TAU};

/// A bent cantilever, clamped at the origin along x.
#[derive(Clone, Debug)]
pub struct Elastica {
    /// √(F L²/EI).
    rate: f64,
    /// Direction from which χ is measured, rad from x: that of the force unless the axis is straight.
    direction: f64,
    /// Direction of the force, rad from x.
    force: f64,
    /// k, k', and 1 - m.
    modulus: f64,
    complement: f64,
    m1: f64,
    /// Sign of χ at the tip.
    sign: f64,
    /// Values at the clamp, u = √(F L²/EI).
    root: Point,
    /// sn, cn, dn at the clamp where they are known without evaluating them.
    exact_root: Option<Jacobi>,
}

/// What the pendulum does at one place.
#[derive(Clone, Copy, Debug)]
struct Point {
    chi: f64,
    /// ∫cos χ du and ∫sin χ du from the tip.
    cosine: f64,
    sine: f64,
    /// dχ/du.
    rate: f64,
}

/// One place of the bent axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// x/L and y/L.
    pub position: [f64; 2],
    /// θ, rad.
    pub angle: f64,
    /// θ' L.
    pub curvature: f64,
}

impl Elastica {
    /// Under a dead tip force of F L²/EI = `load` >= 0 in the direction `angle` (rad from the undeformed
    /// axis; π/2 is a transverse load).
    ///
    /// It is the equilibrium without an inflection, which is the one reached from rest. Under pure
    /// compression (angle π) past F = π²EI/4L² it is the bent one, towards +y.
    pub fn dead(load: f64, angle: f64) -> Self {
        let rate = load.sqrt();
        // χ at the clamp, in (-π, π].
        let start = wrapped(-angle - PI);
        let sign = if start < 0.0 { -1.0 } else { 1.0 };
        let (s0, c0) = (0.5 * start.abs()).sin_cos();
        let (s2, c2) = (s0 * s0, c0 * c0);
        let straight = rate == 0.0 || c2 < 1e-31 || (s2 < 1e-31 && rate <= 0.5 * PI);
        if straight {
            return Self::straight(rate, angle);
        }
        // d = m - sin²(χ0/2) and m1 = 1 - m share out cos²(χ0/2); u = F(φ|m) from the tip to the clamp
        // with sin²φ = d/(m c²), cos²φ = s² m1/(m c²), 1 - m sin²φ = m1/c²: free of cancellation in
        // the unknown y = ln(d/m1), in which u increases.
        let shares = |y: f64| (c2 / (1.0 + (-y).exp()), c2 / (1.0 + y.exp()));
        let reach = |y: f64| {
            let (d, m1) = shares(y);
            let m = s2 + d;
            (d / (m * c2)).sqrt() * rf(s2 * m1 / (m * c2), m1 / c2, 1.0)
        };
        let (mut low, mut high) = (-75.0, 75.0 + 4.0 * rate);
        while high - low > 1e-16 * (1.0 + low.abs().max(high.abs())) {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if reach(middle) < rate { low = middle } else { high = middle }
        }
        let (d, m1) = shares(0.5 * (low + high));
        let m = s2 + d;
        let (sn, cn) = ((d / (m * c2)).sqrt(), (s2 * m1 / (m * c2)).sqrt());
        let at_clamp = Jacobi { am: sn.atan2(cn), sn, cn, dn: (m1 / c2).sqrt() };
        Self::new(rate, angle, m.sqrt(), m1, sign, Some(at_clamp))
    }

    /// Under a follower tip force of F L²/EI = `load` >= 0 that keeps the angle `angle` (rad) to the tip's
    /// tangent; π/2 is transverse.
    ///
    /// Then χ at the tip is known, and so the whole shape without solving for anything. Compare
    /// B. S. Shvartsman, *J. Sound Vib.* 304 (2007) 969.
    pub fn follower(load: f64, angle: f64) -> Self {
        let rate = load.sqrt();
        let tip = wrapped(-angle - PI);
        let sign = if tip < 0.0 { -1.0 } else { 1.0 };
        let (modulus, complement) = (0.5 * tip.abs()).sin_cos();
        if rate == 0.0 || complement * complement < 1e-31 {
            return Self::straight(rate, angle);
        }
        let mut shape = Self::new(rate, 0.0, modulus, complement * complement, sign, None);
        // θ = 0 at the clamp fixes the direction: θ_L = χ_L - χ_0 and α = θ_L + angle.
        shape.direction = tip - shape.root.chi + angle;
        shape.force = shape.direction;
        shape
    }

    fn new(rate: f64, direction: f64, modulus: f64, m1: f64, sign: f64, root: Option<Jacobi>) -> Self {
        let exact_root = root;
        let root = root.unwrap_or_else(|| jacobi(rate, m1));
        let nothing = Point { chi: 0.0, cosine: 0.0, sine: 0.0, rate: 0.0 };
        let mut shape = Self {
            rate,
            direction,
            force: direction,
            modulus,
            complement: m1.sqrt(),
            m1,
            sign,
            root: nothing,
            exact_root,
        };
        shape.root = shape.point(rate, &root);
        shape
    }

    /// The undeformed shape under a force along its axis.
    fn straight(rate: f64, direction: f64) -> Self {
        let mut shape = Self::new(rate, direction, 0.0, 1.0, 1.0, None);
        shape.direction = PI;
        shape
    }

    fn point(&self, u: f64, j: &Jacobi) -> Point {
        let (k, kc) = (self.modulus, self.complement);
        let (sd, cd) = (j.sn / j.dn, j.cn / j.dn);
        Point {
            chi: self.sign * 2.0 * (k * j.cn).atan2(kc),
            cosine: 2.0 * second(j.am, self.m1) - u - 2.0 * k * k * j.sn * cd,
            sine: self.sign * 2.0 * k * kc * sd,
            rate: -self.sign * 2.0 * k * kc * sd,
        }
    }

    /// sn, cn, dn at s = `fraction` L.
    ///
    /// Near the clamp of a strongly loaded beam cn and dn are tiny; the addition theorems from there (DLMF
    /// 22.8) are sums of positive terms and keep their digits.
    fn functions(&self, fraction: f64) -> Jacobi {
        let Some(root) = self.exact_root.filter(|_| fraction < 0.5) else {
            return jacobi(self.rate * (1.0 - fraction), self.m1);
        };
        let back = jacobi(self.rate * fraction, self.m1);
        let m = self.modulus * self.modulus;
        let below = root.dn.powi(2) + m * (root.sn * back.cn).powi(2);
        let sn = (root.sn * back.cn * back.dn - back.sn * root.cn * root.dn) / below;
        let cn = (root.cn * back.cn + root.sn * root.dn * back.sn * back.dn) / below;
        let dn = (root.dn * back.dn + m * root.sn * root.cn * back.sn * back.cn) / below;
        Jacobi { am: sn.atan2(cn), sn, cn, dn }
    }

    /// The place at arc length s = `fraction` L from the clamp.
    pub fn at(&self, fraction: f64) -> Station {
        if self.rate == 0.0 {
            return Station { position: [fraction, 0.0], angle: 0.0, curvature: 0.0 };
        }
        let u = self.rate * (1.0 - fraction);
        let point = self.point(u, &self.functions(fraction));
        // θ = χ + α + π: along the force the tangent has -cos χ, across it -sin χ.
        let along = -(self.root.cosine - point.cosine) / self.rate;
        let across = -(self.root.sine - point.sine) / self.rate;
        let (s, c) = self.direction.sin_cos();
        Station {
            position: [c * along - s * across, s * along + c * across],
            angle: point.chi - self.root.chi,
            curvature: -point.rate * self.rate,
        }
    }

    /// The tip.
    pub fn tip(&self) -> Station {
        self.at(1.0)
    }

    /// The direction of the force in fixed axes, rad from x; for a follower force where it has turned to.
    pub fn force_direction(&self) -> f64 {
        self.force
    }
}

/// The same angle in (-π, π].
fn wrapped(angle: f64) -> f64 {
    let rest = angle - TAU * (angle / TAU).round();
    if rest <= -PI { rest + TAU } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn mattiassons_table_comes_back() {
        // K. Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145: PL²/EI, w/L, u/L.
        for (load, w, u) in [
            (1.0, 0.30172, 0.05643),
            (2.0, 0.49346, 0.16064),
            (5.0, 0.71379, 0.38763),
            (10.0, 0.81061, 0.55500),
        ] {
            let tip = Elastica::dead(load, FRAC_PI_2).tip();
            assert_close(tip.position[1], w, 5.1e-6, "w/L");
            assert_close(1.0 - tip.position[0], u, 5.1e-6, "u/L");
        }
    }

    #[test]
    fn the_weighted_strip_has_its_tip_and_its_strain() {
        // 50 g on 20.32 x 0.254 x 152.4 mm of steel, E = 207 GPa: F L²/EI = 1.983330054...
        let stiffness = 207e9 * 20.32e-3 * 0.254e-3f64.powi(3) / 12.0;
        let load = 0.05 * 9.81 * 0.1524f64.powi(2) / stiffness;
        assert_close(load, 1.983_330_054, 5e-10, "load");
        let shape = Elastica::dead(load, -FRAC_PI_2);
        let tip = shape.tip();
        assert_close(tip.position[0], 0.841_075_234_472, 6e-13, "x/L");
        assert_close(tip.position[1], -0.491_069_989_323, 6e-13, "z/L");
        assert_close(-tip.angle.to_degrees(), 44.548_384_1, 6e-8, "slope");
        let strain = shape.at(0.5).curvature.abs() / 152.4 * 0.127;
        assert_close(strain * 1e6, 621.664, 6e-4, "surface strain at mid-length, µε");
    }

    #[test]
    fn small_loads_give_the_beam_of_small_deflections() {
        // Dead loads deviate with the square of the load, follower loads too.
        let load = 1e-5;
        for shape in [Elastica::dead(load, FRAC_PI_2), Elastica::follower(load, FRAC_PI_2)] {
            assert_close(shape.tip().position[1] / load, 1.0 / 3.0, 2e-10, "PL³/3EI");
            assert_close(shape.tip().angle / load, 0.5, 2e-10, "PL²/2EI");
            assert_close(shape.at(0.25).curvature / load, 0.75, 2e-10, "P(L - s)/EI");
        }
    }

    #[test]
    fn the_moment_is_force_times_lever_everywhere() {
        for load in [0.01, 1.0, 10.0, 50.0, 200.0] {
            for angle in [0.3, 1.0, FRAC_PI_2, 2.5, -0.7, -3.0, 3.1] {
                let shape = Elastica::dead(load, angle);
                let tip = shape.tip();
                let (s, c) = angle.sin_cos();
                for i in 0..=10 {
                    let here = shape.at(f64::from(i) / 10.0);
                    let lever = [0, 1].map(|i| tip.position[i] - here.position[i]);
                    let moment = load * (lever[0] * s - lever[1] * c);
                    assert_close(here.curvature, moment, 1e-12 * (1.0 + load), "M = lever x F");
                }
                assert_close(shape.at(0.0).angle, 0.0, 1e-13, "clamp");
                assert_close(shape.at(0.0).position[0], 0.0, 1e-13, "clamp");
                assert_close(tip.curvature, 0.0, 1e-15, "free tip");
            }
        }
    }

    #[test]
    fn the_shape_solves_the_differential_equation_from_the_tip() {
        use crate::ivp::integrate;
        for (load, angle) in [(1.0, FRAC_PI_2), (5.0, 2.0), (50.0, FRAC_PI_2), (50.0, 2.9)] {
            let shape = Elastica::dead(load, angle);
            let tip = shape.tip();
            let start = [tip.position[0], tip.position[1], tip.angle, 0.0];
            let rate = |_: f64, y: &[f64; 4]| [y[2].cos(), y[2].sin(), y[3], load * (y[2] - angle).sin()];
            for (s, y) in integrate(rate, start, 1.0, 0.0, 64) {
                let here = shape.at(s);
                assert_close(here.position[0], y[0], 1e-12, "x");
                assert_close(here.position[1], y[1], 1e-12, "y");
                assert_close(here.angle, y[2], 2e-11, "θ");
                assert_close(here.curvature, y[3], 2e-10, "θ'");
            }
        }
    }

    #[test]
    fn a_follower_force_is_a_dead_one_in_its_final_direction() {
        // Beyond half a turn of the force the dead load has another, nearer equilibrium.
        for load in [0.5, 1.0, 2.5] {
            let follower = Elastica::follower(load, FRAC_PI_2);
            assert!(follower.force_direction() < PI);
            let dead = Elastica::dead(load, follower.force_direction());
            for i in 0..=8 {
                let (a, b) = (follower.at(f64::from(i) / 8.0), dead.at(f64::from(i) / 8.0));
                assert_close(a.position[0], b.position[0], 2e-14, "x");
                assert_close(a.position[1], b.position[1], 2e-14, "y");
                assert_close(a.angle, b.angle, 2e-14, "θ");
            }
            assert_close(
                follower.force_direction() - follower.tip().angle,
                FRAC_PI_2,
                1e-15,
                "right angle to the tip",
            );
        }
    }

    #[test]
    fn a_column_buckles_past_eulers_load() {
        let euler = PI * PI / 4.0;
        assert_close(Elastica::dead(0.99 * euler, PI).tip().position[1], 0.0, 1e-15, "straight");
        // Timoshenko and Gere, Theory of Elastic Stability (1961), table 2-4: P/Pcr, tip angle, x/L, y/L.
        for (ratio, degrees, x, y) in [(1.015, 20.0, 0.970, 0.220), (1.293, 80.0, 0.560, 0.719)] {
            let tip = Elastica::dead(ratio * euler, PI).tip();
            assert_close(tip.angle.abs().to_degrees(), degrees, 0.4, "tip angle");
            assert_close(tip.position[0], x, 2e-3, "x/L");
            assert_close(tip.position[1].abs(), y, 4e-3, "y/L");
        }
    }

    #[test]
    fn pulling_along_the_axis_does_nothing() {
        let tip = Elastica::dead(7.0, 0.0).tip();
        assert_close(tip.position[0], 1.0, 1e-15, "x");
        assert_close(tip.position[1], 0.0, 1e-15, "y");
    }
}
