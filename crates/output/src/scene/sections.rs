//! The dimensions of sections along a beam.

use crate::OutputError;
use crate::document::finite;
use flexura_model::{Profile, Shape};

/// Fewest places at which dimensions that vary are told.
const STATIONS: usize = 25;
/// Most places at which dimensions that vary are told.
const MOST: usize = 160;

/// Dimensions of a section at places along a beam, m.
pub(super) struct Dimensions {
    pub shape: &'static str,
    pub stations: Vec<f64>,
    pub width: Vec<f64>,
    pub height: Vec<f64>,
    pub inner: Vec<f64>,
}

/// The dimensions of a shape along a beam of the given length; none of a section given as a stiffness.
pub(super) fn dimensions(path: &str, shape: &Shape, length: f64) -> Result<Dimensions, OutputError> {
    let (word, width, height, inner) = match shape {
        Shape::Rectangle { width, height } => ("rectangle", width, height, None),
        Shape::Ellipse { width, height } => ("ellipse", width, height, None),
        Shape::Circle { diameter } => ("circle", diameter, diameter, None),
        Shape::Tube { outer_diameter, inner_diameter } => {
            ("tube", outer_diameter, outer_diameter, Some(inner_diameter))
        }
        Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. } => {
            let none = Vec::new;
            return Ok(Dimensions {
                shape: "stiffness",
                stations: none(),
                width: none(),
                height: none(),
                inner: none(),
            });
        }
    };
    let profiles = || [Some(width), Some(height), inner].into_iter().flatten();
    let stations = stations(profiles(), length);
    let along = |profile: &Profile, field: &str| -> Result<Vec<f64>, OutputError> {
        let value = |s: &f64| finite(profile.value(*s, length), || format!("{path}.{field}"));
        stations.iter().map(value).collect()
    };
    Ok(Dimensions {
        shape: word,
        width: along(width, "width")?,
        height: along(height, "height")?,
        inner: inner.map(|inner| along(inner, "inner")).transpose()?.unwrap_or_default(),
        stations,
    })
}

/// One place where nothing varies; else evenly spread ones and those between which the profiles are smooth.
fn stations<'a>(profiles: impl Iterator<Item = &'a Profile>, length: f64) -> Vec<f64> {
    let varying: Vec<&Profile> = profiles.filter(|profile| profile.as_constant().is_none()).collect();
    if varying.is_empty() {
        return vec![0.0];
    }
    let mut places: Vec<f64> = (0..STATIONS).map(|i| length * i as f64 / (STATIONS - 1) as f64).collect();
    places.extend(varying.iter().flat_map(|profile| profile.breaks(length)));
    places.sort_by(f64::total_cmp);
    // Nearer than this they cannot be told apart in a picture.
    let near = length / MOST as f64;
    let mut kept: Vec<f64> = Vec::with_capacity(places.len());
    for place in places {
        if kept.last().is_none_or(|last| place - last >= near || place == length) {
            kept.push(place);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura_model::{At, Notch, NotchShape};

    #[test]
    fn a_constant_section_is_told_once() {
        let shape = Shape::Rectangle { width: 0.02.into(), height: 0.001.into() };
        let told = dimensions("", &shape, 0.3).map(|told| (told.stations, told.width, told.height));
        assert_eq!(told.ok(), Some((vec![0.0], vec![0.02], vec![0.001])));
    }

    #[test]
    fn a_taper_and_a_notch_are_met_at_their_ends_and_thinnest() {
        let taper =
            Profile::Table { at: vec![At::Fraction(0.0), At::Fraction(1.0)], value: vec![0.02, 0.01] };
        let notch = Notch { shape: NotchShape::Circular { radius: 0.005 }, thickness: 0.0005, center: None };
        let shape = Shape::Rectangle { width: taper, height: Profile::Notch(notch) };
        let Ok(told) = dimensions("", &shape, 0.01) else { panic!("dimensions are finite") };
        assert!(told.stations.len() > STATIONS - 1 && told.stations.len() <= MOST + 2);
        assert_eq!((told.width[0], told.width[told.width.len() - 1]), (0.02, 0.01));
        let thinnest = told.height.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((thinnest - 0.0005).abs() < 1e-12, "{thinnest}");
    }
}
