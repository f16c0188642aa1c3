//! The law of a section, from its dimensions.

use flexura::geometry;
use flexura::model::{BeamTheory, Material, Section, Shape};
use nalgebra::{DMatrix, Matrix6};
use std::f64::consts::PI;

/// Strains (ε, γ2, γ3, κ1, κ2, κ3) per (F1, F2, F3, M1, M2, M3) at arc length `s` (m), SI; zero for strains that the theory
/// does not have.
pub fn compliance(
    section: &Section,
    material: Option<&Material>,
    theory: BeamTheory,
    s: f64,
    length: f64,
) -> Option<Matrix6<f64>> {
    let active = [theory.extension, theory.shear, theory.shear, true, true, true];
    if let Shape::StiffnessMatrix { matrix, .. } = &section.shape {
        return restricted(matrix, &active);
    }
    let mut diagonal = [0.0; 6];
    if let Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, .. } = &section.shape {
        let value = |profile: &flexura::model::Profile| profile.value(s, length);
        let shear = [ga2, ga3].map(|given| given.as_ref().map_or(f64::INFINITY, value));
        diagonal = [value(ea), shear[0], shear[1], value(gj), value(ei2), value(ei3)];
    } else {
        let material = material?;
        let solid = Solid::at(&section.shape, s, length)?;
        let (mut e2, mut e3) = (material.young, material.young);
        if section.plane_strain {
            let nu = 0.5 * material.young / material.shear - 1.0;
            let wide = 1.0 / (1.0 - nu * nu);
            if solid.is_wide { e2 *= wide } else { e3 *= wide }
        }
        diagonal[0] = material.young * solid.area;
        diagonal[3] = material.shear * solid.torsion;
        diagonal[4] = e2 * solid.second[0];
        diagonal[5] = e3 * solid.second[1];
        if theory.shear {
            // Shear factors are a convention, and that of the library.
            let shear = geometry::compliance(section, Some(material), theory, s, length).ok()?.to_matrix();
            (diagonal[1], diagonal[2]) = (1.0 / shear[(1, 1)], 1.0 / shear[(2, 2)]);
        }
    }
    Some(Matrix6::from_fn(|i, j| if i == j && active[i] { 1.0 / diagonal[i] } else { 0.0 }))
}

/// Mass per length, kg/m.
pub fn mass(section: &Section, material: Option<&Material>, s: f64, length: f64) -> f64 {
    match &section.shape {
        Shape::Stiffness { mass_per_length, .. } | Shape::StiffnessMatrix { mass_per_length, .. } => {
            mass_per_length.as_ref().map_or(0.0, |profile| profile.value(s, length))
        }
        shape => {
            let density = material.and_then(|material| material.density).unwrap_or(0.0);
            density * Solid::at(shape, s, length).map_or(0.0, |solid| solid.area)
        }
    }
}

struct Solid {
    area: f64,
    /// ∫z² dA and ∫y² dA.
    second: [f64; 2],
    torsion: f64,
    is_wide: bool,
}

impl Solid {
    fn at(shape: &Shape, s: f64, length: f64) -> Option<Self> {
        Some(match shape {
            Shape::Rectangle { width, height } => {
                let (w, h) = (width.value(s, length), height.value(s, length));
                Self {
                    area: w * h,
                    second: [w * h * h * h / 12.0, h * w * w * w / 12.0],
                    torsion: rectangle_torsion(w.max(h), w.min(h)),
                    is_wide: w >= h,
                }
            }
            Shape::Ellipse { width, height } => {
                let (w, h) = (width.value(s, length), height.value(s, length));
                Self {
                    area: 0.25 * PI * w * h,
                    second: [PI * w * h * h * h / 64.0, PI * h * w * w * w / 64.0],
                    torsion: PI * w * w * w * h * h * h / (16.0 * (w * w + h * h)),
                    is_wide: w >= h,
                }
            }
            Shape::Circle { diameter } => Self::round(diameter.value(s, length), 0.0),
            Shape::Tube { outer_diameter, inner_diameter } => {
                Self::round(outer_diameter.value(s, length), inner_diameter.value(s, length))
            }
            Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. } => return None,
        })
    }

    fn round(outer: f64, inner: f64) -> Self {
        let polar = PI * (outer.powi(4) - inner.powi(4)) / 32.0;
        Self {
            area: 0.25 * PI * (outer * outer - inner * inner),
            second: [0.5 * polar; 2],
            torsion: polar,
            is_wide: true,
        }
    }
}

/// a b³/3 (1 - 192 b/(π⁵ a) Σ tanh(n π a/2b)/n⁵), n odd, a the longer side (S. P. Timoshenko and J. N. Goodier, *Theory of
/// Elasticity*, 3rd ed., 1970, art. 109).
fn rectangle_torsion(a: f64, b: f64) -> f64 {
    // The rest of the sum, with every tanh one, is known: Σ 1/n⁵ over odd n = 31/32 ζ(5).
    const WHOLE: f64 = 31.0 / 32.0 * 1.036_927_755_143_37;
    let short: f64 = (0..40)
        .map(|i| {
            let n = f64::from(2 * i + 1);
            ((n * PI * a / (2.0 * b)).tanh() - 1.0) / n.powi(5)
        })
        .sum();
    a * b.powi(3) / 3.0 * (1.0 - 192.0 * b / (PI.powi(5) * a) * (WHOLE + short))
}

/// The inverse of the active block, zero elsewhere.
fn restricted(matrix: &Matrix6<f64>, active: &[bool; 6]) -> Option<Matrix6<f64>> {
    let kept: Vec<usize> = (0..6).filter(|i| active[*i]).collect();
    let unit: Vec<f64> = kept.iter().map(|i| matrix[(*i, *i)].sqrt()).collect();
    let n = kept.len();
    let block = DMatrix::from_fn(n, n, |a, b| matrix[(kept[a], kept[b])] / (unit[a] * unit[b]));
    let inverse = block.try_inverse()?;
    let mut whole = Matrix6::zeros();
    for a in 0..n {
        for b in 0..n {
            whole[(kept[a], kept[b])] = inverse[(a, b)] / (unit[a] * unit[b]);
        }
    }
    Some(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_torsion_constant_of_rectangles_is_the_tabulated_one() {
        // Timoshenko and Goodier, table in art. 109: k1 of a square 0.1406, of 2:1 0.229, of a thin strip 1/3.
        assert!((rectangle_torsion(1.0, 1.0) - 0.1406).abs() < 5e-5);
        assert!((rectangle_torsion(2.0, 1.0) / 2.0 - 0.229).abs() < 5e-4);
        assert!((rectangle_torsion(1e4, 1.0) / 1e4 - 1.0 / 3.0).abs() < 1e-4);
    }
}
