//! Round shafts and rings that buckle under torsion.
//!
//! Seen from a frame that does not twist with it, a straight round shaft under the torque T bends by `EI i τ' + T τ = m - i F s`,
//! τ = y' + i z' its slope, m the moment across at the start and F the force across. So τ = A e^{iTs} + B + C s in units of EI and L,
//! and any solution turned about the shaft is one more: supports that are alike in all directions make every critical
//! torque double. (A. G. Greenhill, *Proc. Inst. Mech. Eng.* 34 (1883) 182; H. Ziegler, *Principles of Structural Stability* (1968).)

use crate::columns::Ends;
use crate::roots::first_roots;
use nalgebra::Matrix6;
use std::f64::consts::TAU;

/// The torque, in EI/L, at which a shaft hockles whose ends can neither turn across the axis nor move across it, one of
/// them free to twist and to come nearer: T = 2x with tan x = x, 8.986819.
///
/// A torque about a fixed axis on an end that turns about that axis only is conservative. The critical direction is
/// double if the section is round; the slide makes the force along the axis vanish. (J. C. Simo and L. Vu-Quoc, *Comput.
/// Methods Appl. Mech. Eng.* 58 (1986) 79, example 5.5: L = 240, E = 71240, G = 27190, I = 0.0833, J = 2.16.)
pub fn hockling() -> f64 {
    2.0 * Ends::ClampedPinned.roots(1)[0]
}

/// Greenhill's torque, in EI/L: 2π, for ends that are held on the axis, free to turn in every direction and loaded by moments
/// that keep the direction of the undeformed axis, so that no moment acts across it.
///
/// Such a moment is not conservative: no joint that only passes a torque on transmits it. The critical direction is
/// double. Ends in universal joints are another case, see [`universal`].
pub fn greenhill() -> f64 {
    TAU
}

/// The torque, in EI/L, at which a shaft between two universal joints buckles; `between` is the angle from the fork that
/// the drive holds at the one end to that at the other as they stand, the twist of the shaft TL/GJ included.
///
/// The cross of a universal joint passes on a moment at right angles to both its axes. With n across the shaft, at right
/// angles to the drive's fork, its part across is T n (n·τ): it follows one of the two slopes and not the other. (Ziegler's
/// quasi-tangential torque, conservative.) With parallel forks sin T = 0 follows, so that the shaft buckles at π, a
/// half of Greenhill's torque, which comes out as the second critical one; every critical direction is simple.
pub fn universal(between: f64) -> Option<f64> {
    first_roots(|torque| universal_determinant(torque, between), 0.5, 0.1, 1, 100).first().copied()
}

/// The six real equations for A, B, C: moment across at both ends, no deflection of the far end.
pub fn universal_determinant(torque: f64, between: f64) -> f64 {
    let t = torque;
    let (sine, cosine) = t.sin_cos();
    // As pairs of real rows over (A, B, C), each a pair of real columns: z ↦ (re, im).
    let mut rows = Matrix6::zeros();
    let times = |re: f64, im: f64| [[re, -im], [im, re]];
    let one = times(1.0, 0.0);
    let i = times(0.0, 1.0);
    let turn = times(cosine, sine);
    let mut add = |row: usize, column: usize, factor: f64, z: [[f64; 2]; 2]| {
        for a in 0..2 {
            for b in 0..2 {
                rows[(2 * row + a, 2 * column + b)] += factor * z[a][b];
            }
        }
    };
    // z ↦ n (n·z) for n at the angle between.
    let (s, c) = between.sin_cos();
    let project = [[c * c, c * s], [c * s, s * s]];
    let first = [[1.0, 0.0], [0.0, 0.0]];
    let product = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| -> [[f64; 2]; 2] {
        std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
    };
    // i C + T B = T n0 (n0·(A + B))
    add(0, 2, 1.0, i);
    add(0, 1, t, one);
    add(0, 0, -t, first);
    add(0, 1, -t, first);
    // i C + T B + T C = T n1 (n1·(A e^{iT} + B + C))
    add(1, 2, 1.0, i);
    add(1, 1, t, one);
    add(1, 2, t, one);
    add(1, 0, -t, product(project, turn));
    add(1, 1, -t, project);
    add(1, 2, -t, project);
    // A (e^{iT} - 1)/iT + B + C/2 = 0
    add(2, 0, 1.0, times(sine / t, (1.0 - cosine) / t));
    add(2, 1, 1.0, one);
    add(2, 2, 0.5, one);
    rows.determinant()
}

/// The angle by which the ends of a rod are turned against each other before they are joined to a ring, at which the ring
/// leaves its plane: 2π√3 EI/GJ.
///
/// The rod is round and straight at rest; the ring is free. Its torsional moment is then √3 EI/R. The critical direction is
/// double, the wave with two crests may lie anywhere along the ring; and the ring can roll about its axis without effort, at
/// any twist. Half a ring whose ends slide and turn on a common axis across it is the same ring with one of the two, and rolls
/// no more. (J. H. Michell, *Messenger of Mathematics* 11 (1889) 181; E. E. Zajac, *J. Appl. Mech.* 29 (1962) 136.)
pub fn michell_twist(bending: f64, torsion: f64) -> f64 {
    TAU * 3f64.sqrt() * bending / torsion
}

#[cfg(test)]
#[path = "torsion_tests.rs"]
mod tests;
