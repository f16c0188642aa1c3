//! Sections and profiles.

use super::Issues;
use crate::{At, Notch, NotchShape, Profile, Shape};
use flexura_spatial::Matrix6;

/// Lengths that differ by less, relatively, are the same.
const ROUND_OFF: f64 = 1e-9;

/// The dimensions and stiffnesses of a shape with their keys; may they be zero, may they be infinite?
fn profiles(shape: &Shape) -> Vec<(&'static str, &Profile, bool, bool)> {
    match shape {
        Shape::Rectangle { width, height } | Shape::Ellipse { width, height } => {
            vec![("width", width, false, false), ("height", height, false, false)]
        }
        Shape::Circle { diameter } => vec![("diameter", diameter, false, false)],
        Shape::Tube { outer_diameter, inner_diameter } => {
            vec![
                ("outer_diameter", outer_diameter, false, false),
                ("inner_diameter", inner_diameter, true, false),
            ]
        }
        Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, mass_per_length, rotary_inertia } => {
            let mut all = vec![
                ("EA", ea, false, true),
                ("GJ", gj, false, true),
                ("EI2", ei2, false, true),
                ("EI3", ei3, false, true),
            ];
            all.extend(ga2.iter().map(|profile| ("GA2", profile, false, true)));
            all.extend(ga3.iter().map(|profile| ("GA3", profile, false, true)));
            all.extend(masses(mass_per_length, rotary_inertia));
            all
        }
        Shape::StiffnessMatrix { mass_per_length, rotary_inertia, .. } => {
            masses(mass_per_length, rotary_inertia).collect()
        }
    }
}

/// The inertia of a section that is given by its stiffness.
fn masses<'a>(
    per_length: &'a Option<Profile>,
    rotary: &'a Option<Box<[Profile; 3]>>,
) -> impl Iterator<Item = (&'static str, &'a Profile, bool, bool)> {
    let rotary = rotary.iter().flat_map(|three| three.iter());
    let keys = ["rotary_inertia[0]", "rotary_inertia[1]", "rotary_inertia[2]"];
    per_length
        .iter()
        .map(|profile| ("mass_per_length", profile, true, false))
        .chain(keys.into_iter().zip(rotary).map(|(key, profile)| (key, profile, true, false)))
}

fn sound(value: f64, zero: bool, infinite: bool) -> bool {
    (value > 0.0 || (zero && value == 0.0)) && (infinite || value.is_finite())
}

fn wanted(zero: bool, infinite: bool) -> &'static str {
    match (zero, infinite) {
        (true, _) => "must be finite and not negative",
        (false, true) => "must be positive (`inf` is rigid)",
        (false, false) => "must be finite and positive",
    }
}

/// What can be said of a section without a beam: constants and tables.
pub(super) fn check_section_alone(shape: &Shape, path: &str, issues: &mut Issues) {
    for (key, profile, zero, infinite) in profiles(shape) {
        let path = format!("{path}.{key}");
        check_table(profile, &path, issues);
        let values: &[f64] = match profile {
            Profile::Constant(value) => std::slice::from_ref(value),
            Profile::Table { value, .. } => value,
            Profile::Function(_) => &[],
            Profile::Notch(notch) => {
                check_notch(notch, &path, issues);
                &[]
            }
        };
        if let Some(bad) = values.iter().find(|value| !sound(**value, zero, infinite)) {
            issues.add(path, format!("{}, is {bad}", wanted(zero, infinite)));
        }
    }
    if let Shape::Tube { outer_diameter, inner_diameter } = shape
        && let (Some(outer), Some(inner)) = (outer_diameter.as_constant(), inner_diameter.as_constant())
        && inner >= outer
        && outer > 0.0
    {
        let message =
            format!("the inner diameter ({inner} m) must be smaller than the outer diameter ({outer} m)");
        issues.add(format!("{path}.inner_diameter"), message);
    }
    if let Shape::StiffnessMatrix { matrix, .. } = shape {
        check_matrix(matrix, &format!("{path}.matrix"), issues);
    }
}

fn check_notch(notch: &Notch, path: &str, issues: &mut Issues) {
    issues.positive(format_args!("{path}.thickness"), notch.thickness);
    match notch.shape {
        NotchShape::Circular { radius } => {
            issues.positive(format_args!("{path}.radius"), radius);
        }
        NotchShape::Elliptic { along, across } => {
            issues.positive(format_args!("{path}.semi_axis_along"), along);
            issues.positive(format_args!("{path}.semi_axis_across"), across);
        }
        NotchShape::CornerFilleted { radius, length } => {
            let radius_is_sound = issues.positive(format_args!("{path}.radius"), radius);
            if let Some(length) = length
                && issues.positive(format_args!("{path}.length"), length)
                && radius_is_sound
                && 2.0 * radius > length * (1.0 + ROUND_OFF)
            {
                issues.add(
                    format!("{path}.length"),
                    format!("a notch {length} m long has no room for two fillets of radius {radius} m"),
                );
            }
        }
    }
}

/// A notch must lie on the beam, and be the beam where it has no place of its own.
fn check_notch_along(notch: &Notch, path: &str, length: f64, beam: &str, issues: &mut Issues) {
    let own = notch.length(length);
    let (from, to) = (notch.middle(length) - 0.5 * own, notch.middle(length) + 0.5 * own);
    let margin = ROUND_OFF * length;
    if let (NotchShape::CornerFilleted { radius, length: None }, None) = (notch.shape, notch.center) {
        if 2.0 * radius > length + margin {
            issues.add(
                format!("{path}.radius"),
                format!("beam `{beam}` is {length} m long, too short for two fillets of radius {radius} m"),
            );
        }
    } else if notch.center.is_none() && (own - length).abs() > margin {
        issues.add_with_hint(
            path,
            format!("the notch is {own} m long, but beam `{beam}` is {length} m"),
            "make the beam as long as the notch, or say by `at` where its middle is",
        );
    } else if from < -margin || to > length + margin {
        let middle = notch.middle(length);
        issues.add_with_hint(
            path,
            format!(
                "a notch {own} m long with its middle at {middle} m does not lie on beam `{beam}`, which is {length} m long"
            ),
            "move it by `at`, or make the beam longer",
        );
    }
}

fn check_matrix(matrix: &Matrix6<f64>, path: &str, issues: &mut Issues) {
    if !matrix.iter().all(|x| x.is_finite()) {
        issues.add(path, "must be finite numbers");
        return;
    }
    for i in 0..6 {
        for j in 0..i {
            let (a, b) = (matrix[(i, j)], matrix[(j, i)]);
            if (a - b).abs() > 1e-9 * (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt() {
                let message = format!("must be symmetric, but [{i}][{j}] is {a} and [{j}][{i}] is {b}");
                issues.add(path, message);
                return;
            }
        }
    }
    if matrix.cholesky().is_none() {
        issues.add(path, "must be positive definite: some strain would cost no energy");
    }
}

/// What needs the beam's length: functions of s, and the tube's wall.
pub(super) fn check_section_along(
    shape: &Shape,
    section: &str,
    length: f64,
    beam: &str,
    issues: &mut Issues,
) {
    for (key, profile, zero, infinite) in profiles(shape) {
        if let Profile::Notch(notch) = profile {
            let name = beam.trim_start_matches("beam.");
            check_notch_along(notch, &format!("section.{section}.{key}"), length, name, issues);
        }
        if !matches!(profile, Profile::Function(_)) {
            continue;
        }
        if let Some((s, value)) = worst(profile, Some(length), |value| sound(value, zero, infinite)) {
            let name = beam.trim_start_matches("beam.");
            issues.add(
                format!("section.{section}.{key}"),
                format!("{}, is {value} at s = {s} m of beam `{name}`", wanted(zero, infinite)),
            );
        }
    }
    if let Shape::Tube { outer_diameter, inner_diameter } = shape
        && (outer_diameter.as_constant().is_none() || inner_diameter.as_constant().is_none())
        && outer_diameter.is_sound_table()
        && inner_diameter.is_sound_table()
        && let Some(s) =
            stations(length).find(|s| inner_diameter.value(*s, length) >= outer_diameter.value(*s, length))
    {
        issues.add(
            format!("section.{section}.inner_diameter"),
            format!("the inner diameter must be smaller than the outer diameter, is not at s = {s} m"),
        );
    }
}

fn stations(length: f64) -> impl Iterator<Item = f64> {
    (0..=64).map(move |i| length * f64::from(i) / 64.0)
}

/// The first of some places where a function of s is not as it should be. Constants and tables pass.
pub(super) fn worst(
    profile: &Profile,
    length: Option<f64>,
    good: impl Fn(f64) -> bool,
) -> Option<(f64, f64)> {
    match profile {
        Profile::Constant(value) => (!good(*value)).then_some((0.0, *value)),
        Profile::Table { .. } | Profile::Notch(_) => None,
        Profile::Function(function) => {
            stations(length?).map(|s| (s, function.value(s))).find(|(_, value)| !good(*value))
        }
    }
}

impl Profile {
    /// Can the profile be evaluated? Tables need as many values as rows, and at least one.
    fn is_sound_table(&self) -> bool {
        match self {
            Profile::Table { at, value } => !at.is_empty() && at.len() == value.len(),
            _ => true,
        }
    }
}

pub(super) fn check_table(profile: &Profile, path: &str, issues: &mut Issues) {
    let Profile::Table { at, value } = profile else { return };
    if !profile.is_sound_table() {
        issues.add(
            path,
            format!(
                "a table needs as many values as places and at least one, has {} and {}",
                value.len(),
                at.len()
            ),
        );
        return;
    }
    for (i, pair) in at.windows(2).enumerate() {
        let rises = match (pair[0], pair[1]) {
            (At::Fraction(a), At::Fraction(b)) | (At::Length(a), At::Length(b)) => a < b,
            // Mixed rows can only be compared on a beam.
            _ => true,
        };
        if !rises {
            issues.add(
                path,
                format!("the places of a table must increase, but rows {} and {} do not", i + 1, i + 2),
            );
        }
    }
    let outside = at.iter().find(|row| match row {
        At::Fraction(x) => !(0.0..=1.0).contains(x),
        At::Length(s) => !s.is_finite() || *s < 0.0,
    });
    if let Some(row) = outside {
        issues.add(path, format!("the place {} of a table is not on the beam", row.arc_length(1.0)));
    }
}
