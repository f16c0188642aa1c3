//! The outline of a section, for drawing.

use super::properties::Solid;
use flexura_model::Section;

/// Corners of the polygon that stands for a curved outline.
const CORNERS: u32 = 48;

/// The outer outline at arc length `s` as a closed polygon of (y, z) in metres along e2 and e3,
/// counter-clockwise, the first point not repeated. None for stiffness sections and impossible dimensions.
pub fn outline(section: &Section, s: f64, length: f64) -> Option<Vec<[f64; 2]>> {
    let (width, height) = match Solid::at(&section.shape, s, length).ok()?? {
        Solid::Rectangle { width, height } => {
            let (y, z) = (0.5 * width, 0.5 * height);
            return Some(vec![[-y, -z], [y, -z], [y, z], [-y, z]]);
        }
        Solid::Ellipse { width, height } => (width, height),
        Solid::Tube { outer, .. } => (outer, outer),
    };
    let corner = |i: u32| {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(i) / f64::from(CORNERS)).sin_cos();
        [0.5 * width * cosine, 0.5 * height * sine]
    };
    Some((0..CORNERS).map(corner).collect())
}
