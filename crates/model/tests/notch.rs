//! The heights of notches against the closed forms of flexure hinges.
#![allow(clippy::unwrap_used)]

use flexura_model::{At, Notch, NotchShape, Profile};

/// Nodes and weights of the rule of order 8 on [-1, 1].
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// ∫ f(h) ds along the beam, every piece between breaks cut into equal steps.
fn integral(profile: &Profile, length: f64, steps: usize, f: impl Fn(f64) -> f64) -> f64 {
    let mut ends = vec![0.0];
    ends.extend(profile.breaks(length));
    ends.push(length);
    let mut sum = 0.0;
    for pair in ends.windows(2) {
        let h = (pair[1] - pair[0]) / steps as f64;
        for i in 0..steps {
            let middle = pair[0] + (i as f64 + 0.5) * h;
            for (node, weight) in GAUSS {
                sum += 0.5 * h * weight * f(profile.value(middle + 0.5 * h * node, length));
            }
        }
    }
    sum
}

/// ∫ ds/h³ over a circular notch of radius r and least thickness t. Paros and Weisbord, "How to design flexure
/// hinges", Machine Design 37 (1965) 151, their compliance θ/M = 12/(E b) ∫ ds/h³ with the notch cut in full.
fn cubed(r: f64, t: f64) -> f64 {
    let beta = t / (2.0 * r);
    let q = beta * (2.0 + beta);
    let bracket = 1.0 / (1.0 + beta)
        + (3.0 + q) / ((1.0 + beta) * q)
        + 6.0 * (1.0 + beta) / q.powf(1.5) * ((2.0 + beta) / beta).sqrt().atan();
    bracket / (8.0 * r * r * q)
}

/// ∫ ds/h over the same, the axial compliance times E b (Paros and Weisbord, the same place).
fn inverse(r: f64, t: f64) -> f64 {
    let beta = t / (2.0 * r);
    let q = beta * (2.0 + beta);
    2.0 * (1.0 + beta) / q.sqrt() * ((2.0 + beta) / beta).sqrt().atan() - std::f64::consts::FRAC_PI_2
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() < tolerance, "{a} against {b}: {:.1e}", a / b - 1.0);
}

#[test]
fn the_compliance_of_a_circular_notch_is_that_of_paros_and_weisbord() {
    for (radius, thickness) in [(2e-3, 0.5e-3), (5e-3, 0.1e-3), (2e-3, 20e-6), (1e-3, 2e-3)] {
        let notch = Notch { shape: NotchShape::Circular { radius }, thickness, center: None };
        let profile = Profile::Notch(notch);
        let length = 2.0 * radius;
        assert!(profile.breaks(length).len() < 60);
        close(integral(&profile, length, 4, |h| h.powi(-3)), cubed(radius, thickness), 1e-9);
        close(integral(&profile, length, 4, |h| 1.0 / h), inverse(radius, thickness), 1e-9);
        close(integral(&profile, length, 1, |h| h.powi(-3)), cubed(radius, thickness), 1e-5);
    }
}

/// An ellipse is a circle stretched along the beam (Smith, Badami, Dale and Xu, "Elliptical flexure hinges",
/// Rev. Sci. Instrum. 68 (1997) 1474): ds grows by a/b, the heights stay those of the circle of radius b.
#[test]
fn an_elliptic_notch_is_a_stretched_circular_one() {
    let (along, across, thickness) = (4e-3, 1e-3, 0.2e-3);
    let shape = NotchShape::Elliptic { along, across };
    let profile = Profile::Notch(Notch { shape, thickness, center: None });
    let found = integral(&profile, 2.0 * along, 4, |h| h.powi(-3));
    close(found, along / across * cubed(across, thickness), 1e-9);
}

/// Lobontiu, "Compliant Mechanisms: Design of Flexure Hinges" (2003): a straight part between two halves of a
/// circular notch.
#[test]
fn a_corner_filleted_notch_is_a_strip_between_two_halves_of_a_circular_one() {
    let (radius, thickness, length) = (1e-3, 0.3e-3, 8e-3);
    let shape = NotchShape::CornerFilleted { radius, length: None };
    let profile = Profile::Notch(Notch { shape, thickness, center: None });
    let strip = (length - 2.0 * radius) / thickness.powi(3);
    close(integral(&profile, length, 4, |h| h.powi(-3)), strip + cubed(radius, thickness), 1e-9);
}

#[test]
fn outside_of_a_notch_the_height_is_that_of_the_rim() {
    let shape = NotchShape::Circular { radius: 2e-3 };
    let profile = Profile::Notch(Notch { shape, thickness: 1e-3, center: Some(At::Length(6e-3)) });
    let length = 20e-3;
    for (s, height) in [(0.0, 5e-3), (4e-3, 5e-3), (6e-3, 1e-3), (8e-3, 5e-3), (20e-3, 5e-3)] {
        close(profile.value(s, length), height, 1e-12);
    }
    close(profile.value(7e-3, length), 1e-3 + 4e-3 * (1.0 - 0.75f64.sqrt()), 1e-12);
    let straight = 16e-3 / 5e-3f64.powi(3);
    close(integral(&profile, length, 4, |h| h.powi(-3)), straight + cubed(2e-3, 1e-3), 1e-9);
    let shape = NotchShape::CornerFilleted { radius: 1e-3, length: Some(6e-3) };
    let profile = Profile::Notch(Notch { shape, thickness: 1e-3, center: Some(At::Fraction(0.5)) });
    for (s, height) in [(6.9e-3, 3e-3), (8e-3, 1e-3), (10e-3, 1e-3), (12e-3, 1e-3), (13.1e-3, 3e-3)] {
        close(profile.value(s, length), height, 1e-12);
    }
}

#[test]
fn the_breaks_of_a_notch_increase_and_lie_inside_the_beam() {
    let shape = NotchShape::Circular { radius: 2e-3 };
    for center in [None, Some(At::Length(2e-3)), Some(At::Fraction(0.5))] {
        let profile = Profile::Notch(Notch { shape, thickness: 1e-3, center });
        let length = if center.is_none() { 4e-3 } else { 5e-3 };
        let breaks = profile.breaks(length);
        assert!(breaks.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(breaks[0] > 0.0 && *breaks.last().unwrap() < length);
    }
}
