//! Strips on edge that buckle out of the plane in which they are bent.
//!
//! Bent by the moment m(s) about e3, which is stiff, a straight strip of EI2 and GJ turns by φ1, φ2 about e1, e2:
//! `GJ φ1' = g1 - m φ2`, `EI2 φ2' = g2 + m φ1` with the change g of the moment. (L. Prandtl, *Kipperscheinungen* (1899);
//! A. G. M. Michell, *Phil. Mag.* 48 (1899) 298; S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed. (1961), ch. 6.)

use crate::perturbation::{Condition, Loaded, Prestress, held};
use crate::roots::first_roots;
use flexura_spatial::Vector3;
use nalgebra::Matrix3;
use std::f64::consts::PI;

/// The tip load P L²/√(EI2 GJ) at which a clamped strip buckles sideways: 4.012599, twice the first zero of the Bessel function
/// J_{-1/4}.
///
/// A dead force at the middle of the end section, in the plane of the strip, which is free to leave it; EI3 without bound, so
/// that the strip stays straight until then. The critical direction is simple. (Timoshenko and Gere, §6.3: 4.013.)
pub fn cantilever() -> f64 {
    // J_ν(z) is (z/2)^ν/Γ(ν+1) times the sum of (-z²/4)^k/(k! (ν+1)..(ν+k)).
    let series = |z: f64| {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..30 {
            let k = f64::from(k);
            term *= -0.25 * z * z / (k * (k - 0.25));
            sum += term;
        }
        sum
    };
    first_roots(series, 0.5, 0.25, 1, 20).first().map_or(f64::NAN, |zero| 2.0 * zero)
}

/// The end moment at which a frame of two equal legs buckles out of its plane, (π/L) √(EI2 GJ), with EI3 without bound.
///
/// The legs, of length `length`, are joined rigidly at any angle. Their far ends can turn about the plane's normal, where
/// equal and opposite moments act, and come nearer to each other in the plane without force; they can neither turn otherwise
/// nor leave the plane. Both signs of the moment are alike and the critical direction is simple.
///
/// (J. H. Argyris et al., *Comput. Methods Appl. Mech. Eng.* 20 (1979) 105: 240 mm, 0.6 x 30 mm, E = 71240, ν = 0.31, GJ of
/// J = bh³/3 = 2.16 mm⁴: 622.21 N·mm, which takes G = E/(2 (1 + ν)); a rounded G = 27190 gives 622.20.)
pub fn frame(bending: f64, torsion: f64, length: f64) -> f64 {
    PI / length * (bending * torsion).sqrt()
}

/// The same for a finite EI3 = `bending[1]`, which lets the legs bend to arcs before they buckle; `corner` is the angle
/// between them at rest. Of both signs of the moment: that which closes the corner, then that which opens it, both positive.
///
/// With a = M (1/EI2 - 1/EI3), c = M (1/GJ - 1/EI3), x² = a c L², θ = ML/EI3 and β the angle from a leg to the bisector,
///
/// ```text
/// cos x sin θ + sin x [√(a/c) sin β sin(β+θ) + √(c/a) cos β cos(β+θ)] = 0
/// ```
///
/// expresses that the legs' turns and moments keep the symmetry about the bisector.
pub fn bent_frame(bending: [f64; 2], torsion: f64, length: f64, corner: f64) -> [Option<f64>; 2] {
    let usual = frame(bending[0], torsion, length);
    let beta = PI - 0.5 * corner;
    let [a, c] = [bending[0], torsion].map(|soft| 1.0 / soft - 1.0 / bending[1]);
    [1.0, -1.0].map(|sign| {
        let condition = |moment: f64| {
            let x = moment * length * (a * c).sqrt();
            let theta = sign * moment * length / bending[1];
            let ratio = (a / c).sqrt() * beta.sin() * (beta + theta).sin()
                + (c / a).sqrt() * beta.cos() * (beta + theta).cos();
            // x changes its sign with the moment.
            x.cos() * theta.sin() + sign * x.sin() * ratio
        };
        first_roots(condition, 0.5 * usual, 0.1 * usual, 1, 20).first().copied()
    })
}

/// The least end moment, of one sign (`1.0` closes the corner), at which both legs of the same frame move to opposite sides
/// and the corner turns about its bisector, up to twice the moment of [`frame`]. By the small motions of a leg ([`crate::perturbation`]).
pub fn twisted_frame(bending: [f64; 2], torsion: f64, length: f64, corner: f64, sign: f64) -> Option<f64> {
    let usual = frame(bending[0], torsion, length);
    let compliance = [0.0, 0.0, 0.0, 1.0 / torsion, 1.0 / bending[0], 1.0 / bending[1]];
    let condition = |moment: f64| leg(sign * moment, compliance, length, corner)[1];
    first_roots(condition, 0.05 * usual, 0.05 * usual, 1, 39).first().copied()
}

/// The determinants of one leg, from its far end to the corner, in a frame of the angle `corner` between the legs.
fn leg(moment: f64, compliance: [f64; 6], length: f64, corner: f64) -> [f64; 2] {
    let curvature = moment * compliance[5];
    let state = |_: f64| Prestress {
        strain: Vector3::x(),
        curvature: Vector3::new(0.0, 0.0, curvature),
        force: Vector3::zeros(),
        moment: Vector3::new(0.0, 0.0, moment),
    };
    let transfer = Loaded { length, compliance, state: &state }.transfer(16);
    // Far end: neither turning about e1, e2 nor motion across the plane; what else it does in the plane drops out. At
    // the corner, with the bisector b and its normal in the plane, of motions that are the same on both sides: no
    // turning about b, no moment about the normal, no force across, which both legs would exert with the same sign.
    // Of opposite motions: no turning about the normal, no moment about b, no motion across.
    let (s, c) = (PI - 0.5 * corner).sin_cos();
    let (bisector, normal) = ([c, s], [-s, c]);
    let row = |first: usize, [a, b]: [f64; 2]| -> Condition {
        std::array::from_fn(|i| {
            if i == first {
                a
            } else if i == first + 1 {
                b
            } else {
                0.0
            }
        })
    };
    let same = [row(3, bisector), row(9, normal), held([8])[0]];
    let opposite = [row(3, normal), row(9, bisector), held([2])[0]];
    [same, opposite].map(|rows| {
        let entry = |i: usize, j: usize| (0..12).map(|l| rows[i][l] * transfer[(l, [9, 10, 8][j])]).sum();
        Matrix3::from_fn(entry).determinant()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::roots::root;

    #[test]
    fn the_printed_numbers_come_out() {
        // Zero of J_{-1/4}: 2.0063.
        assert_close(cantilever(), 4.0126, 5e-5, "4.0126");
        let ei = 71240.0 * 30.0 * 0.6f64.powi(3) / 12.0;
        let gj = 71240.0 / 2.62 * 2.16;
        assert_close(frame(ei, gj, 240.0), 622.21, 5e-3, "622.21");
        // True EI3: both signs differ in the seventh digit.
        let [closing, opening] = bent_frame([ei, 71240.0 * 0.6 * 30f64.powi(3) / 12.0], gj, 240.0, 0.5 * PI);
        assert_close(closing.unwrap(), 622.2217, 5e-5, "closing");
        assert_close(opening.unwrap(), 622.2219, 5e-5, "opening");
    }

    #[test]
    fn the_cantilever_stands_still_at_its_load() {
        // EI2 = 1, GJ = 0.3, EI3 without bound.
        let load = cantilever() * 0.3f64.sqrt();
        let compliance = [0.0, 0.0, 0.0, 1.0 / 0.3, 1.0, 0.0];
        let ends = [held([0, 1, 2, 3, 4, 5]), held([6, 7, 8, 9, 10, 11])];
        let at = |load: f64| {
            let state = |s: f64| Prestress {
                strain: Vector3::x(),
                curvature: Vector3::zeros(),
                force: Vector3::new(0.0, load, 0.0),
                moment: Vector3::new(0.0, 0.0, load * (1.0 - s)),
            };
            Loaded { length: 1.0, compliance, state: &state }.determinant(&ends[0], &ends[1], 16)
        };
        assert_close(root(at, load - 0.2, load + 0.2).unwrap(), load, 1e-13, "critical");
        assert!((0..10).all(|i| at(0.0) * at(0.1 * f64::from(i) * load) > 0.0));
    }

    #[test]
    fn the_frame_stands_still_at_its_moment_whatever_its_corner() {
        let (length, torsion) = (1.3, 0.6);
        for stiff in [1e-9, 1.0 / 30.0] {
            let compliance = [0.0, 0.0, 0.0, 1.0 / torsion, 1.0, stiff];
            let usual = frame(1.0, torsion, length);
            for corner in [0.5 * PI, 1.0, 2.8] {
                let both = bent_frame([1.0, 1.0 / stiff], torsion, length, corner);
                for (sign, critical) in [1.0, -1.0].into_iter().zip(both) {
                    let critical = critical.unwrap();
                    let at = |moment: f64| leg(sign * moment, compliance, length, corner);
                    let found = root(|moment| at(moment)[0], 0.9 * critical, 1.1 * critical).unwrap();
                    assert_close(found, critical, 1e-12, "critical");
                    assert_close(critical, usual, if stiff < 1e-3 { 1e-8 } else { 0.2 }, "usual formula");
                    for (i, last) in [(0, 10), (1, 11)] {
                        let before = |part: i32| at(0.01)[i] * at(0.1 * f64::from(part) * critical)[i];
                        assert!((1..last).all(|part| before(part) > 0.0), "{i} {corner} {stiff} {sign}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_corner_twists_past_the_usual_moment_and_sooner_where_it_opens() {
        let usual = frame(1.0, 0.6, 1.3);
        let twisted = |length: f64, sign: f64| {
            twisted_frame([1.0, f64::INFINITY], 0.6, length, 0.5 * PI, sign).unwrap()
        };
        let [closing, opening] = [1.0, -1.0].map(|sign| twisted(1.3, sign));
        assert!(usual < opening && opening < closing, "{usual} {opening} {closing}");
        assert_close(2.0 * twisted(2.6, -1.0), opening, 1e-12, "in inverse proportion to the length");
    }
}
