//! What is read off a beam as a whole: its peaks and its mass.

use crate::BeamStress;
use flexura_geometry::{mass_per_length, section_breaks};
use flexura_model::{Beam, Model, Quantity};
use flexura_solution::{BeamSample, Solution};

/// Points and weights of Gauss-Legendre quadrature on [-1, 1], exact up to degree nine.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Panels between two breaks of a section.
const PANELS: usize = 16;
/// By how much more the slope turns at a corner than beside it.
const CORNER: f64 = 3.0;

/// m = ∫ μ ds of a beam of that length, kg; None where its section has no sound dimensions.
pub fn beam_mass(model: &Model, beam: &Beam, length: f64) -> Option<f64> {
    let section = &model[beam.section];
    let material = beam.material.map(|id| &model[id]);
    let mut ends = vec![0.0];
    ends.extend(section_breaks(section, length).into_iter().filter(|s| *s > 0.0 && *s < length));
    ends.push(length);
    let mut mass = 0.0;
    for pair in ends.windows(2) {
        let h = (pair[1] - pair[0]) / PANELS as f64;
        for panel in 0..PANELS {
            let middle = pair[0] + h * (panel as f64 + 0.5);
            for (place, weight) in GAUSS {
                let s = middle + 0.5 * h * place;
                mass += 0.5 * h * weight * mass_per_length(section, material, s, length).ok()?;
            }
        }
    }
    Some(mass)
}

/// Mass of all beams, bodies and point masses, kg.
pub fn model_mass(model: &Model, solution: &Solution) -> Option<f64> {
    let beams = model.beams.iter().zip(&solution.beams);
    let beams: Option<f64> = beams.map(|(beam, result)| beam_mass(model, beam, result.length)).sum();
    let bodies: f64 = model.bodies.iter().map(|body| body.mass).sum();
    let points: f64 = model.masses.iter().map(|mass| mass.mass).sum();
    Some(beams? + bodies + points)
}

/// The largest stress or strain of a beam, or its least safety; None without a yield strength.
pub fn beam_peak(
    model: &Model,
    beam: &Beam,
    samples: &[BeamSample],
    stress: &BeamStress,
    quantity: Quantity,
) -> Option<f64> {
    let along = |pick: fn(&flexura_geometry::SectionStress) -> f64| {
        let places: Vec<f64> = samples.iter().map(|sample| sample.s).collect();
        let values: Vec<f64> = stress.samples.iter().map(|stress| pick(stress).abs()).collect();
        peak_between(&places, &values)
    };
    match quantity {
        Quantity::MaxStrain => Some(along(|stress| stress.strain)),
        Quantity::MaxStress => Some(along(|stress| stress.von_mises)),
        Quantity::MinSafety => {
            let strength = beam.material.and_then(|id| model[id].yield_strength)?;
            Some(strength / along(|stress| stress.von_mises))
        }
        _ => None,
    }
}

/// The largest of values along a line, between the places too: the top of the polynomial through the largest and two neighbours on
/// either side, or, next to an end, of the parabola through it and its neighbours. At an end, and at a corner, where the slope turns much more than beside it, the largest value itself.
pub fn peak_between(places: &[f64], values: &[f64]) -> f64 {
    let Some(top) = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])) else {
        return f64::NAN;
    };
    if top == 0 || top + 1 >= values.len() {
        return values[top];
    }
    let bend = |i: usize| {
        let (h, k) = (places[i] - places[i - 1], places[i + 1] - places[i]);
        ((values[i + 1] - values[i]) / k - (values[i] - values[i - 1]) / h) / (0.5 * (h + k))
    };
    let beside = [top.checked_sub(1).filter(|i| *i > 0), Some(top + 1).filter(|i| i + 1 < values.len())];
    let largest = beside.into_iter().flatten().map(|i| bend(i).abs()).fold(0.0, f64::max);
    let curvature = bend(top);
    if curvature >= 0.0 || curvature.abs() > CORNER * largest {
        return values[top];
    }
    if top >= 2 && top + 2 < values.len() {
        let five = top - 2..top + 3;
        return quartic_top(&places[five.clone()], &values[five]);
    }
    let (h, k) = (places[top] - places[top - 1], places[top + 1] - places[top]);
    let (before, after) = ((values[top] - values[top - 1]) / h, (values[top + 1] - values[top]) / k);
    // The slope of the parabola at the top value, by the three-point rule.
    let slope = (before * k + after * h) / (h + k);
    values[top] - 0.5 * slope * slope / curvature
}

/// The stationary value, next to the middle, of the polynomial through five points, by divided differences.
fn quartic_top(places: &[f64], values: &[f64]) -> f64 {
    let mut c = values.to_vec();
    for order in 1..c.len() {
        for i in (order..c.len()).rev() {
            c[i] = (c[i] - c[i - 1]) / (places[i] - places[i - order]);
        }
    }
    let at = |x: f64| {
        let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
        for i in (0..c.len()).rev() {
            bend = bend * (x - places[i]) + 2.0 * slope;
            slope = slope * (x - places[i]) + value;
            value = value * (x - places[i]) + c[i];
        }
        (value, slope, bend)
    };
    let mut x = places[2];
    for _ in 0..10 {
        let (_, slope, bend) = at(x);
        x = (x - slope / bend).clamp(places[1], places[3]);
    }
    // A polynomial that is no fit has no top here.
    let top = at(x).0;
    if top.is_finite() { top.max(values[2]) } else { values[2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_peak_is_found_between_the_places() {
        let places: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
        let values: Vec<f64> = places.iter().map(|s| (3.0 * (s - 0.123)).cos()).collect();
        assert!((peak_between(&places, &values) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_corner_is_not_rounded_off() {
        let places: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
        let values: Vec<f64> =
            places.iter().map(|s| if *s < 0.4 { 2.5 * s } else { (1.0 - s) / 0.6 }).collect();
        assert_eq!(peak_between(&places, &values), values[40]);
    }

    #[test]
    fn a_peak_at_an_end_is_the_value_there() {
        assert_eq!(peak_between(&[0.0, 1.0, 2.0], &[3.0, 2.0, 1.0]), 3.0);
    }
}
