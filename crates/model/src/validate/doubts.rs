//! What can be solved but is hardly meant.

use super::beam::known_length;
use super::{Issue, Issues};
use crate::{Beam, Model, Profile, Shape};
use flexura_spatial::Vector3;

/// A section is no longer that of a beam if its smaller dimension is more than this part of the length,
const THICK: f64 = 0.6;
/// or its larger one more than so many lengths.
const WIDE: f64 = 4.0;
/// Places along a beam at which its section is looked at.
const PLACES: usize = 8;

impl Model {
    /// What looks unintended although the description is sound, as [`Model::validate`] tells what is not.
    pub fn doubts(&self) -> Vec<Issue> {
        let mut issues = Issues(Vec::new());
        self.doubt_gravity(&mut issues);
        self.doubt_materials(&mut issues);
        self.doubt_sections(&mut issues);
        issues.0
    }

    /// Gravity that finds no mass.
    fn doubt_gravity(&self, issues: &mut Issues) {
        if self.gravity == Vector3::zeros() {
            return;
        }
        if !self.tubes.is_empty() {
            issues.add_with_hint(
                "gravity",
                "gravity does not act on concentric tubes",
                "leave it out, or put the weight that matters on the tip as a load",
            );
        }
        let heavy = |beam: &Beam| match self.sections.get(beam.section.0).map(|section| &section.shape) {
            Some(
                Shape::Stiffness { mass_per_length, .. } | Shape::StiffnessMatrix { mass_per_length, .. },
            ) => mass_per_length.as_ref().is_some_and(|mass| mass.as_constant() != Some(0.0)),
            _ => {
                let material = beam.material.and_then(|id| self.materials.get(id.0));
                material.and_then(|material| material.density).is_some_and(|density| density > 0.0)
            }
        };
        let is_heavy = self.bodies.iter().any(|body| body.mass > 0.0)
            || self.masses.iter().any(|mass| mass.mass > 0.0)
            || self.beams.iter().any(heavy);
        for beam in &self.beams {
            let Some(section) = self.sections.get(beam.section.0) else { continue };
            let is_light = matches!(
                section.shape,
                Shape::Stiffness { mass_per_length: None, .. }
                    | Shape::StiffnessMatrix { mass_per_length: None, .. }
            );
            if !is_light {
                continue;
            }
            let material = beam.material.and_then(|id| self.materials.get(id.0));
            if let Some(material) = material.filter(|material| material.density.is_some()) {
                issues.add_with_hint(
                    format!("material.{}.density", material.name),
                    format!(
                        "does not act on beam `{}`: its section `{}` is given as a stiffness and has no area",
                        beam.name, section.name
                    ),
                    "give the section its `mass_per_length`",
                );
                break;
            }
        }
        let has_parts = !(self.bodies.is_empty() && self.beams.is_empty());
        if has_parts && !is_heavy {
            issues.add_with_hint(
                "gravity",
                "gravity has nothing to act on: no body has a mass and no beam a density",
                if self.beams.is_empty() {
                    "give the bodies a `mass`"
                } else {
                    "give the material a `density`, for example `density = \"7800 kg/m^3\"`"
                },
            );
        }
    }

    /// Moduli that no isotropic material has, as a fibre composite does.
    fn doubt_materials(&self, issues: &mut Issues) {
        for material in &self.materials {
            if !material.is_isotropic() {
                let ratio = material.young / (2.0 * material.shear) - 1.0;
                issues.add_with_hint(
                    format!("material.{}.shear", material.name),
                    format!(
                        "the two moduli go with no isotropic material (Poisson's ratio {ratio:.3}); they are taken as \
                         they stand, as along the fibres of a composite"
                    ),
                    "leave it so for a composite or wood; otherwise give `poisson` in the place of `shear`",
                );
            }
        }
    }

    /// Sections as thick as their beam is long, once a section.
    fn doubt_sections(&self, issues: &mut Issues) {
        for (i, section) in self.sections.iter().enumerate() {
            let mut worst: Option<(f64, f64, f64, &Beam)> = None;
            let mut count = 0;
            for beam in self.beams.iter().filter(|beam| beam.section.0 == i) {
                let Some(length) = known_length(&beam.curve) else { continue };
                let Some((thin, wide)) = extent(&section.shape, length) else { continue };
                let excess = (thin / (THICK * length)).max(wide / (WIDE * length));
                if excess > 1.0 {
                    count += 1;
                    if worst.is_none_or(|(most, ..)| excess > most) {
                        let size = if thin > THICK * length { thin } else { wide };
                        worst = Some((excess, size, length, beam));
                    }
                }
            }
            let Some((_, size, length, beam)) = worst else { continue };
            let others = match count {
                1 => String::new(),
                2 => " (and so of another beam)".to_string(),
                _ => format!(" (and so of {} other beams)", count - 1),
            };
            issues.add_with_hint(
                format!("section.{}.{}", section.name, first_key(&section.shape)),
                format!(
                    "the section measures {} and beam `{}` is {} long: that is no beam{others}",
                    length_text(size),
                    beam.name,
                    length_text(length)
                ),
                "a number without a unit is in metres; is one missing?",
            );
        }
    }
}

/// The smaller and the larger dimension of a section (m), each where it is least along the beam: a notch counts by
/// what it leaves. None of a stiffness.
fn extent(shape: &Shape, length: f64) -> Option<(f64, f64)> {
    let least = |profile: &Profile| match profile {
        Profile::Notch(notch) => notch.thickness,
        _ => (0..=PLACES)
            .map(|k| profile.value(length * k as f64 / PLACES as f64, length))
            .fold(f64::INFINITY, f64::min),
    };
    match shape {
        Shape::Rectangle { width, height } | Shape::Ellipse { width, height } => {
            let (width, height) = (least(width), least(height));
            Some((width.min(height), width.max(height)))
        }
        Shape::Circle { diameter } | Shape::Tube { outer_diameter: diameter, .. } => {
            let diameter = least(diameter);
            Some((diameter, diameter))
        }
        Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. } => None,
    }
}

fn first_key(shape: &Shape) -> &'static str {
    match shape {
        Shape::Circle { .. } => "diameter",
        Shape::Tube { .. } => "outer_diameter",
        Shape::Rectangle { .. } | Shape::Ellipse { .. } => "width",
        Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. } => "matrix",
    }
}

/// A length as a person writes it.
fn length_text(length: f64) -> String {
    // Six digits, without needless zeros.
    let digits = |value: f64| format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    if length >= 1.0 { format!("{} m", digits(length)) } else { format!("{} mm", digits(length * 1e3)) }
}
