//! A bow pushed together at its ends: a circular arc, clamped at both ends or hinged, that stays symmetric.
//!
//! With t the arc length from the middle and ω² = P/EI, `θ'' = -ω² sin θ` is a pendulum whatever the rest
//! curvature κ, and `sin(θ/2) = k sn ωt`, `θ' = 2ωk cn ωt`, `x = (2 E(am ωt) - ωt)/ω`, `y = -2k (1 - cn ωt)/ω` from the
//! middle. The ends give k: `θ' = κ` there if hinged (no moment), `θ = κL/2` if clamped. (Love, *A Treatise on the
//! Mathematical Theory of Elasticity*, 4th ed. (1927), §263.)

use crate::elliptic::{jacobi, second};

/// A bent bow.
#[derive(Clone, Copy, Debug)]
pub struct Bow {
    length: f64,
    rate: f64,
    modulus: f64,
    curvature: f64,
}

impl Bow {
    /// A bow of rest curvature `curvature` (1/m) under P/EI = `load` (1/m²), its ends hinged. The load must lie below
    /// that at which k reaches one.
    pub fn hinged(length: f64, curvature: f64, load: f64) -> Self {
        let rate = load.sqrt();
        let end = |k: f64| 2.0 * rate * k * jacobi(0.5 * rate * length, 1.0 - k * k).cn - curvature;
        Self { length, rate, modulus: root(&end), curvature }
    }

    /// The same with its ends kept in their directions.
    pub fn clamped(length: f64, curvature: f64, load: f64) -> Self {
        let rate = load.sqrt();
        let wanted = (0.25 * curvature * length).sin();
        let end = |k: f64| k * jacobi(0.5 * rate * length, 1.0 - k * k).sn - wanted;
        Self { length, rate, modulus: root(&end), curvature }
    }

    /// The distance of the ends.
    pub fn chord(&self) -> f64 {
        let u = 0.5 * self.rate * self.length;
        let j = jacobi(u, 1.0 - self.modulus.powi(2));
        2.0 * (2.0 * second(j.am, 1.0 - self.modulus.powi(2)) - u) / self.rate
    }

    /// How far the middle stands off the chord.
    pub fn rise(&self) -> f64 {
        let j = jacobi(0.5 * self.rate * self.length, 1.0 - self.modulus.powi(2));
        2.0 * self.modulus * (1.0 - j.cn) / self.rate
    }

    /// Half the angle between the ends' tangents.
    pub fn end_angle(&self) -> f64 {
        let j = jacobi(0.5 * self.rate * self.length, 1.0 - self.modulus.powi(2));
        2.0 * (self.modulus * j.sn).asin()
    }

    /// (θ' - κ) at the ends, that is M/EI.
    pub fn end_bending(&self) -> f64 {
        let j = jacobi(0.5 * self.rate * self.length, 1.0 - self.modulus.powi(2));
        2.0 * self.rate * self.modulus * j.cn - self.curvature
    }
}

/// The least root of a function that rises from a negative value at k = 0: where it first changes sign, then halving.
fn root(f: &dyn Fn(f64) -> f64) -> f64 {
    let grid = 400;
    let at = |i: usize| i as f64 / grid as f64 * (1.0 - 1e-12);
    let first = (1..=grid).find(|&i| f(at(i)) >= 0.0).unwrap_or(grid);
    let (mut low, mut high) = (at(first - 1), at(first));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::planar::{self, Beam, Body, End, Mechanism};

    fn pushed(hinged: bool, load: f64) -> planar::Equilibrium {
        let (length, curvature) = (1.0, 0.4);
        let half: f64 = 0.5 * curvature * length;
        let chord = 2.0 * half.sin() / curvature;
        // The arc bends clockwise, from +half to -half.
        let at = |fraction: f64| Mechanism {
            beams: vec![Beam {
                length,
                bending: 1.0,
                stretch: 0.0,
                curvature: -curvature,
                start: End { body: None, place: [0.0, 0.0, half], hinged },
                end: End { body: Some(0), place: [0.0, 0.0, -half], hinged },
            }],
            bodies: vec![Body {
                rest: [chord, 0.0, 0.0],
                held: [None, Some(0.0), Some(0.0)],
                load: [-load * fraction, 0.0, 0.0],
            }],
        };
        planar::solve(&at, 20).unwrap()
    }

    #[test]
    fn the_closed_forms_agree_with_integration() {
        let (bow, found) = (Bow::hinged(1.0, 0.4, 8.0), pushed(true, 8.0));
        assert_close(found.poses[0][0], bow.chord(), 1e-11, "hinged chord");
        assert_close(bow.end_bending(), 0.0, 1e-12, "no moment");
        let (bow, found) = (Bow::clamped(1.0, 0.4, 12.0), pushed(false, 12.0));
        assert_close(found.poses[0][0], bow.chord(), 1e-11, "clamped chord");
        assert_close(bow.end_angle(), 0.2, 1e-13, "end angle");
        assert_close(found.wrenches[0][2], -bow.end_bending(), 1e-10, "end moment");
    }
}
