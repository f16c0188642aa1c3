//! Strain from the internal wrench: `(ν, k) = (ν0, k0) + C (n, m)`.
//!
//! n and m are the internal force and moment in the section's axes, ν = (1+ε, γ2, γ3) the strain of the axis
//! and k the curvature. Superposition k = k0 + C m holds for finite rotation: curvatures add where angles do
//! not. One type for each shape of the compliance C, so that zeros cost nothing in the hot loop.

/// A constitutive law at one cross section.
pub trait Law: Copy {
    /// `(ν, k)` for the section force `n` and moment `m`.
    fn strain(&self, n: &[f64; 3], m: &[f64; 3]) -> ([f64; 3], [f64; 3]);

    /// `C (δn, δm)` lane by lane, added to nothing: the change of `(ν, k)`.
    fn strain_change<const W: usize>(
        &self,
        dn: &[[f64; W]; 3],
        dm: &[[f64; W]; 3],
    ) -> ([[f64; W]; 3], [[f64; W]; 3]);
}

/// Unshearable rod: ε = n1/EA, κ = k0 + (m1/GJ, m2/EI2, m3/EI3).
#[derive(Clone, Copy, Debug)]
pub struct Slender {
    /// Rest curvature k0, 1/m.
    pub k0: [f64; 3],
    /// 1/EA; zero when inextensible.
    pub stretch: f64,
    /// (1/GJ, 1/EI2, 1/EI3).
    pub bend: [f64; 3],
}

/// Shearable rod with a diagonal compliance.
#[derive(Clone, Copy, Debug)]
pub struct Shearable {
    /// Rest curvature k0, 1/m.
    pub k0: [f64; 3],
    /// (1/EA, 1/GA2, 1/GA3).
    pub shear: [f64; 3],
    /// (1/GJ, 1/EI2, 1/EI3).
    pub bend: [f64; 3],
}

/// Any symmetric compliance, order (ε, γ2, γ3, κ1, κ2, κ3).
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    /// Rest curvature k0, 1/m.
    pub k0: [f64; 3],
    /// 6 x 6 compliance.
    pub compliance: [[f64; 6]; 6],
}

#[inline(always)]
fn scaled<const W: usize>(factor: f64, a: &[f64; W]) -> [f64; W] {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = factor * a[l];
    }
    out
}

impl Law for Slender {
    #[inline(always)]
    fn strain(&self, n: &[f64; 3], m: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
        (
            [1.0 + self.stretch * n[0], 0.0, 0.0],
            [
                self.k0[0] + self.bend[0] * m[0],
                self.k0[1] + self.bend[1] * m[1],
                self.k0[2] + self.bend[2] * m[2],
            ],
        )
    }

    #[inline(always)]
    fn strain_change<const W: usize>(
        &self,
        dn: &[[f64; W]; 3],
        dm: &[[f64; W]; 3],
    ) -> ([[f64; W]; 3], [[f64; W]; 3]) {
        (
            [scaled(self.stretch, &dn[0]), [0.0; W], [0.0; W]],
            [scaled(self.bend[0], &dm[0]), scaled(self.bend[1], &dm[1]), scaled(self.bend[2], &dm[2])],
        )
    }
}

impl Law for Shearable {
    #[inline(always)]
    fn strain(&self, n: &[f64; 3], m: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
        (
            [1.0 + self.shear[0] * n[0], self.shear[1] * n[1], self.shear[2] * n[2]],
            [
                self.k0[0] + self.bend[0] * m[0],
                self.k0[1] + self.bend[1] * m[1],
                self.k0[2] + self.bend[2] * m[2],
            ],
        )
    }

    #[inline(always)]
    fn strain_change<const W: usize>(
        &self,
        dn: &[[f64; W]; 3],
        dm: &[[f64; W]; 3],
    ) -> ([[f64; W]; 3], [[f64; W]; 3]) {
        (
            [scaled(self.shear[0], &dn[0]), scaled(self.shear[1], &dn[1]), scaled(self.shear[2], &dn[2])],
            [scaled(self.bend[0], &dm[0]), scaled(self.bend[1], &dm[1]), scaled(self.bend[2], &dm[2])],
        )
    }
}

impl Law for Coupled {
    #[inline(always)]
    fn strain(&self, n: &[f64; 3], m: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
        let load = [n[0], n[1], n[2], m[0], m[1], m[2]];
        let mut e = [1.0, 0.0, 0.0, self.k0[0], self.k0[1], self.k0[2]];
        for (value, row) in e.iter_mut().zip(&self.compliance) {
            for (c, x) in row.iter().zip(&load) {
                *value += c * x;
            }
        }
        ([e[0], e[1], e[2]], [e[3], e[4], e[5]])
    }

    #[inline(always)]
    fn strain_change<const W: usize>(
        &self,
        dn: &[[f64; W]; 3],
        dm: &[[f64; W]; 3],
    ) -> ([[f64; W]; 3], [[f64; W]; 3]) {
        let load = [&dn[0], &dn[1], &dn[2], &dm[0], &dm[1], &dm[2]];
        let mut e = [[0.0; W]; 6];
        for (value, row) in e.iter_mut().zip(&self.compliance) {
            for (c, x) in row.iter().zip(&load) {
                for l in 0..W {
                    value[l] += c * x[l];
                }
            }
        }
        ([e[0], e[1], e[2]], [e[3], e[4], e[5]])
    }
}
