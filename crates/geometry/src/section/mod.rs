//! The laws of a cross section: what it weighs, how stiff it is, how hard it is worked.
//!
//! e2 runs along the width, e3 along the height; y and z are the coordinates along them.

mod compliance;
mod outline;
mod properties;
mod stress;
mod torsion;

pub use compliance::{Compliance, compliance, stiffness};
pub use outline::outline;
pub use properties::{Properties, mass_per_length, properties, rotary_inertia};
pub use stress::{SectionStress, peak_stress};

use flexura_model::{Profile, Section, Shape};

/// Every profile of a section.
fn profiles(shape: &Shape) -> Vec<&Profile> {
    match shape {
        Shape::Rectangle { width, height } | Shape::Ellipse { width, height } => vec![width, height],
        Shape::Circle { diameter } => vec![diameter],
        Shape::Tube { outer_diameter, inner_diameter } => vec![outer_diameter, inner_diameter],
        Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, mass_per_length, rotary_inertia } => {
            let given = [ga2, ga3, mass_per_length].into_iter().flatten();
            let given = given.chain(rotary_inertia.iter().flat_map(|three| three.iter()));
            [ea, gj, ei2, ei3].into_iter().chain(given).collect()
        }
        Shape::StiffnessMatrix { mass_per_length, rotary_inertia, .. } => {
            mass_per_length.iter().chain(rotary_inertia.iter().flat_map(|three| three.iter())).collect()
        }
    }
}

/// Is the section the same everywhere along the beam?
pub fn is_uniform(section: &Section) -> bool {
    profiles(&section.shape).iter().all(|profile| profile.as_constant().is_some())
}

/// By which part the dimensions may vary between two arc lengths (m), none of their breaks between them, without that a few places
/// there show it.
pub fn section_hidden(section: &Section, a: f64, b: f64, length: f64) -> f64 {
    let part = |profile: &Profile| {
        let hidden = profile.variation(a, b)?.hidden();
        let size = profile.value(0.5 * (a + b), length).abs();
        Some(if hidden > 0.0 { hidden / size } else { 0.0 })
    };
    profiles(&section.shape).into_iter().filter_map(part).sum()
}

/// Arc lengths (m) strictly inside a beam of the given length at which the section's dimensions have a
/// kink. Increasing.
pub fn section_breaks(section: &Section, length: f64) -> Vec<f64> {
    let mut breaks: Vec<f64> =
        profiles(&section.shape).iter().flat_map(|profile| profile.breaks(length)).collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    breaks
}
