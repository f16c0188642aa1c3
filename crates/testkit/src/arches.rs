//! Circular arches under a dead load at their crown: folds and branch points of the path on which the crown comes down.
//!
//! Both halves are carried by Taylor series and closed by Newton's method ([`crate::planar`]), the crown's height leading;
//! the folds of the load and the branch points are then those of a curve ([`crate::path`]).
//!
//! Which of them comes first decides how an arch fails: a flat, thick one snaps through symmetrically at its fold, a thin
//! hinged one sways to a side before (Y. C. Fung and A. Kaplan, NACA TN 2840 (1952); H. L. Schreyer and E. F. Masur, *J. Eng. Mech.
//! Div. ASCE* 92 (1966) EM4, 1, for clamped arches that keep their symmetry).

use crate::path::{Curve, PathError};
use crate::planar::{Beam, Body, End, Mechanism, curve};
use std::f64::consts::PI;

/// A circular arch with its crown at the top.
#[derive(Clone, Copy, Debug)]
pub struct Arch {
    /// Radius at rest.
    pub radius: f64,
    /// Half the angle that it spans, rad.
    pub half_angle: f64,
    /// EI.
    pub bending: f64,
    /// 1/EA; zero for an arch that does not stretch.
    pub stretch: f64,
    /// Whether the right end and the left end are hinged; clamped otherwise.
    pub hinged: [bool; 2],
}

/// The crown at one equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crown {
    /// The load, downwards.
    pub load: f64,
    /// What the crown has come down.
    pub drop: f64,
    /// What it has moved to the right.
    pub sway: f64,
}

/// What happens on the way down.
#[derive(Clone, Debug, Default)]
pub struct Snap {
    /// Where the load is greatest or least, in the order of the drop.
    pub folds: Vec<Crown>,
    /// Where paths that sway leave the symmetric one.
    pub branch_points: Vec<Crown>,
}

/// Positions of the crown's coordinates among the unknowns.
const X: usize = 0;
const Y: usize = 1;

impl Arch {
    fn mechanism(&self, load: f64) -> Mechanism {
        let (r, half) = (self.radius, self.half_angle);
        let rib = |start: End, end: End| Beam {
            length: r * half,
            bending: self.bending,
            stretch: self.stretch,
            curvature: 1.0 / r,
            start,
            end,
        };
        let (x, y) = (r * half.sin(), r * half.cos());
        let foot = |place: [f64; 3], hinged: bool| End { body: None, place, hinged };
        let crown = End::clamp(Some(0), [0.0, 0.0, PI]);
        let [right, left] = self.hinged;
        Mechanism {
            beams: vec![
                rib(foot([x, y, PI - half], right), crown),
                rib(crown, foot([-x, y, PI + half], left)),
            ],
            bodies: vec![Body { rest: [0.0, r, 0.0], held: [None; 3], load: [0.0, -load, 0.0] }],
        }
    }

    fn curve(self) -> (Curve<'static>, Vec<f64>) {
        curve(move |load| self.mechanism(load), self.bending / (self.radius * self.radius))
    }

    fn crown(&self, y: &[f64]) -> Crown {
        Crown { load: y[y.len() - 1], drop: self.radius - y[Y], sway: y[X] }
    }

    /// The equilibrium on the path from rest at which the crown has come down by `drop`, in steps of about a tenth of the
    /// rise.
    ///
    /// # Errors
    /// Newton's method fails on the way.
    pub fn at(&self, drop: f64) -> Result<Crown, PathError> {
        let (curve, start) = self.curve();
        let rise = self.radius * (1.0 - self.half_angle.cos());
        let steps = (10.0 * drop.abs() / rise).ceil().max(1.0) as usize;
        Ok(self.crown(&curve.lead(&start, Y, self.radius - drop, steps)?))
    }

    /// The folds and branch points on the path from rest until the crown has come down by `drop`.
    ///
    /// # Errors
    /// Newton's method fails on the way.
    pub fn snap(&self, drop: f64) -> Result<Snap, PathError> {
        let (curve, start) = self.curve();
        let load = start.len() - 1;
        let path = curve.trace(&start, load, 2.0, |y| self.radius - y[Y] > drop)?;
        let crowns = |points: Vec<Vec<f64>>| points.iter().map(|y| self.crown(y)).collect();
        Ok(Snap {
            folds: crowns(curve.folds(&path, load)?),
            branch_points: crowns(curve.branch_points(&path)?),
        })
    }
}

/// The deep arch of 215°, clamped on the right and hinged on the left, inextensible, with R = EI = 1: the greatest load
/// and where.
///
/// The load is 8.973089970 EI/R² at a drop of 1.137320631 R. Printed are 8.97 and 1.14 (D. DaDeppo and R. Schmidt, *J. Appl. Mech.* 42
/// (1975) 893); 8.973464, which is quoted as well, has four digits right. A stretch would lower the load (to 8.9717 at EA = 1e5
/// EI/R²), so that it is not the reason.
///
/// # Errors
/// Newton's method fails.
pub fn deep_arch() -> Result<Crown, PathError> {
    let arch = Arch {
        radius: 1.0,
        half_angle: 107.5 * PI / 180.0,
        bending: 1.0,
        stretch: 0.0,
        hinged: [false, true],
    };
    arch.snap(1.17)?.folds.first().copied().ok_or(PathError::NoSignChange)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::ivp::integrate;
    use crate::jacobian::numerical_jacobian;

    /// 15° to both sides, of a rectangular section of the thickness `thickness` R; R = EI = 1.
    fn shallow(thickness: f64, hinged: bool) -> Arch {
        Arch {
            radius: 1.0,
            half_angle: PI / 12.0,
            bending: 1.0,
            stretch: thickness * thickness / 12.0,
            hinged: [hinged; 2],
        }
    }

    fn rise() -> f64 {
        1.0 - (PI / 12.0).cos()
    }

    #[test]
    fn the_deep_arch_has_its_printed_limit() {
        let limit = deep_arch().unwrap();
        assert_close(limit.load, 8.97, 5e-3, "as printed");
        assert_close(limit.drop, 1.14, 5e-3, "as printed");
        assert_close(limit.load, 8.973_089_970, 5e-10, "load");
        assert_close(limit.drop, 1.137_320_631, 5e-10, "drop");
    }

    /// The left half of a symmetric arch from the crown to the foot, by extrapolation: x, y, θ, M there. At the crown the
    /// drop, the thrust, the moment and the shear are given, and motions that break the symmetry.
    fn half(arch: &Arch, drop: f64, thrust: f64, moment: f64, shear: f64, broken: [f64; 2]) -> [f64; 4] {
        let rates = |_: f64, y: &[f64; 4]| {
            let (s, c) = y[2].sin_cos();
            let length = 1.0 + arch.stretch * (thrust * c + shear * s);
            let (dx, dy) = (length * c, length * s);
            [dx, dy, 1.0 + y[3], dy * thrust - dx * shear]
        };
        let start = [broken[0], 1.0 - drop, PI + broken[1], moment];
        integrate(rates, start, 0.0, arch.half_angle, 16)[16].1
    }

    /// What is missed at the foot.
    fn foot(arch: &Arch, y: &[f64], broken: [f64; 3]) -> Vec<f64> {
        let (s, c) = arch.half_angle.sin_cos();
        let end = half(arch, y[3], y[0], y[1], 0.5 * y[2] + broken[2], [broken[0], broken[1]]);
        let third = if arch.hinged[1] { end[3] } else { end[2] - PI - arch.half_angle };
        vec![end[0] + s, end[1] - c, third]
    }

    #[test]
    fn half_an_arch_by_extrapolation_has_the_same_folds_and_branch_points() {
        for (thickness, hinged, drop, branches) in
            [(0.03, true, 1.7, 0), (0.02, true, 1.9, 2), (0.01, false, 1.3, 0)]
        {
            let arch = shallow(thickness, hinged);
            let snap = arch.snap(drop * rise()).unwrap();
            assert_eq!([snap.folds.len(), snap.branch_points.len()], [2, branches]);
            // (thrust, moment, load, drop).
            let curve = Curve::new(vec![1.0, 1.0, 1.0, 1.0], |y| foot(&arch, y, [0.0; 3]));
            let to = |drop: f64| curve.lead(&[0.0; 4], 3, drop, 12).unwrap();
            for fold in &snap.folds {
                let same = curve.fold(&to(0.98 * fold.drop), &to(1.02 * fold.drop), 3, 2).unwrap();
                assert_close(same[2], fold.load, 1e-9, "load");
                assert_close(same[3], fold.drop, 1e-10, "drop");
                assert_close(fold.sway, 0.0, 1e-14, "symmetric");
            }
            for branch in &snap.branch_points {
                // The other symmetry: the crown moves sideways and turns, its shear changes, load and moment stay.
                let swaying = |y: &[f64]| {
                    numerical_jacobian(
                        |broken| foot(&arch, y, [broken[0], broken[1], broken[2]]),
                        &[0.0; 3],
                        1e-3,
                    )
                    .determinant()
                };
                let (a, b) = (to(0.98 * branch.drop), to(1.02 * branch.drop));
                let same = curve.where_zero(&a, &b, 3, swaying).unwrap();
                assert_close(same[2], branch.load, 1e-8, "load");
                assert_close(same[3], branch.drop, 1e-10, "drop");
            }
        }
    }
}
