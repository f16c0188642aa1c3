//! Section stiffness and compliance, with suppressed strains.

use super::properties::{Solid, poisson};
use crate::SectionError;
use flexura_model::{BeamTheory, Material, Section, Shape};
use nalgebra::{Cholesky, DMatrix, Matrix6};

/// Strains per wrench, in the order (ε, γ2, γ3, κ1, κ2, κ3) against (F1, F2, F3, M1, M2, M3), all in the
/// section's axes. Suppressed strains have zero rows and columns.
#[derive(Clone, Debug, PartialEq)]
pub enum Compliance {
    /// Uncoupled; 1/N, 1/N, 1/N, 1/(N·m²) three times.
    Diagonal([f64; 6]),
    /// Coupled; symmetric.
    Full(Box<[[f64; 6]; 6]>),
}

impl Compliance {
    /// As a full matrix.
    pub fn to_matrix(&self) -> Matrix6<f64> {
        match self {
            Compliance::Diagonal(diagonal) => Matrix6::from_diagonal(&(*diagonal).into()),
            Compliance::Full(rows) => Matrix6::from_fn(|i, j| rows[i][j]),
        }
    }
}

/// The compliance of a section at arc length `s` (m) of a beam of the given length.
///
/// Diagonal sections: `ε = F1/EA, γ2 = F2/(ks2 G A), γ3 = F3/(ks3 G A), κ1 = M1/GJ, κ2 = M2/EI2,
/// κ3 = M3/EI3`; an infinite stiffness gives zero. For a full matrix K the compliance is the inverse of K
/// restricted to the strains that the theory has; the forces of the others are reactions.
///
/// # Errors
/// Dimensions or stiffnesses that are not positive, a missing material or shear stiffness, a matrix that is
/// not symmetric positive definite, plane strain on a shape that has no wide side.
pub fn compliance(
    section: &Section,
    material: Option<&Material>,
    theory: BeamTheory,
    s: f64,
    length: f64,
) -> Result<Compliance, SectionError> {
    let active = [theory.extension, theory.shear, theory.shear, true, true, true];
    if let Shape::StiffnessMatrix { matrix, .. } = &section.shape {
        refuse_plane_strain(section, "stiffness matrix")?;
        return restricted_inverse(matrix, &active);
    }
    if let (true, Shape::Stiffness { ga2, ga3, .. }) = (theory.shear, &section.shape) {
        for (given, which) in [(ga2, "ga2"), (ga3, "ga3")] {
            if given.is_none() {
                return Err(SectionError::NoShearStiffness { which });
            }
        }
    }
    let stiffness = diagonal(section, material, s, length)?;
    Ok(Compliance::Diagonal(std::array::from_fn(|i| if active[i] { 1.0 / stiffness[i] } else { 0.0 })))
}

/// The stiffness of a section at arc length `s` (m): 6 x 6 in the order of [`Compliance`], every strain
/// active. Entries are infinite where the section is rigid or its shear stiffness is not given.
///
/// # Errors
/// As [`compliance`].
pub fn stiffness(
    section: &Section,
    material: Option<&Material>,
    s: f64,
    length: f64,
) -> Result<Matrix6<f64>, SectionError> {
    if let Shape::StiffnessMatrix { matrix, .. } = &section.shape {
        refuse_plane_strain(section, "stiffness matrix")?;
        restricted_inverse(matrix, &[true; 6])?;
        return Ok(**matrix);
    }
    Ok(Matrix6::from_diagonal(&diagonal(section, material, s, length)?.into()))
}

/// (EA, ks2 GA, ks3 GA, GJ, EI2, EI3).
fn diagonal(
    section: &Section,
    material: Option<&Material>,
    s: f64,
    length: f64,
) -> Result<[f64; 6], SectionError> {
    if let Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, .. } = &section.shape {
        refuse_plane_strain(section, "stiffness")?;
        let names = ["ea", "ga2", "ga3", "gj", "ei2", "ei3"];
        let given = [Some(ea), ga2.as_ref(), ga3.as_ref(), Some(gj), Some(ei2), Some(ei3)];
        let mut values = [f64::INFINITY; 6];
        for ((value, what), profile) in values.iter_mut().zip(names).zip(given) {
            let Some(profile) = profile else { continue };
            *value = profile.value(s, length);
            if !(*value > 0.0) {
                return Err(SectionError::NotPositive { what, value: *value, s });
            }
        }
        return Ok(values);
    }
    let material = material.ok_or(SectionError::NoMaterial)?;
    let nu = poisson(material);
    let Some(solid) = Solid::at(&section.shape, s, length)? else { return Err(SectionError::NoMaterial) };
    let p = solid.properties(nu);
    let (mut young2, mut young3) = (material.young, material.young);
    if section.plane_strain {
        match wide_axis(&solid)? {
            WideAxis::E2 => young2 /= 1.0 - nu * nu,
            WideAxis::E3 => young3 /= 1.0 - nu * nu,
        }
    }
    let (e, g) = (material.young, material.shear);
    Ok([e * p.area, p.shear2 * g * p.area, p.shear3 * g * p.area, g * p.j, young2 * p.i2, young3 * p.i3])
}

/// Along which axis a strip is wide; bending about it is plate bending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WideAxis {
    E2,
    E3,
}

/// The wide axis of a rectangle or an ellipse.
pub(super) fn wide_axis(solid: &Solid) -> Result<WideAxis, SectionError> {
    match *solid {
        Solid::Rectangle { width, height } | Solid::Ellipse { width, height } => {
            Ok(if width >= height { WideAxis::E2 } else { WideAxis::E3 })
        }
        Solid::Tube { inner: 0.0, .. } => Err(SectionError::PlaneStrain { shape: "circle" }),
        Solid::Tube { .. } => Err(SectionError::PlaneStrain { shape: "tube" }),
    }
}

fn refuse_plane_strain(section: &Section, shape: &'static str) -> Result<(), SectionError> {
    if section.plane_strain { Err(SectionError::PlaneStrain { shape }) } else { Ok(()) }
}

/// The inverse of the active block of a symmetric positive definite matrix, zero elsewhere.
fn restricted_inverse(matrix: &Matrix6<f64>, active: &[bool; 6]) -> Result<Compliance, SectionError> {
    let size = matrix.diagonal().map(|d| d.abs().sqrt());
    for i in 0..6 {
        for j in 0..i {
            let (value, mirrored) = (matrix[(i, j)], matrix[(j, i)]);
            if !((value - mirrored).abs() <= 1e-9 * size[i] * size[j]) {
                return Err(SectionError::NotSymmetric { row: i + 1, column: j + 1, value, mirrored });
            }
        }
    }
    if !matrix.diagonal().iter().all(|d| *d > 0.0 && d.is_finite()) {
        return Err(SectionError::NotPositiveDefinite);
    }
    // Scaled to a unit diagonal, so that newtons and newton metres² do not meet in the factorisation.
    let scaled = Matrix6::from_fn(|i, j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]) / (size[i] * size[j]));
    let whole = Cholesky::new(scaled).ok_or(SectionError::NotPositiveDefinite)?;
    if whole.l().diagonal().iter().any(|pivot| *pivot < 1e-7) {
        return Err(SectionError::NotPositiveDefinite);
    }
    let kept: Vec<usize> = (0..6).filter(|i| active[*i]).collect();
    let block = DMatrix::from_fn(kept.len(), kept.len(), |i, j| scaled[(kept[i], kept[j])]);
    let inverse = Cholesky::new(block).ok_or(SectionError::NotPositiveDefinite)?.inverse();
    let mut rows = [[0.0; 6]; 6];
    for (a, i) in kept.iter().enumerate() {
        for (b, j) in kept.iter().enumerate() {
            rows[*i][*j] = 0.5 * (inverse[(a, b)] + inverse[(b, a)]) / (size[*i] * size[*j]);
        }
    }
    Ok(Compliance::Full(Box::new(rows)))
}
