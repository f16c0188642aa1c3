//! Elastic foundations.

use super::Issues;
use super::section::{check_table, worst};
use crate::{At, Beam, Foundation, FoundationLaw, Profile};
use flexura_spatial::Vector3;

/// Displacements, as parts of the beam's length, at which a law must give a number.
const TRIED: [f64; 4] = [1e-6, 1e-3, -1e-6, -1e-3];
/// By how much of a millimetre's force a law may miss zero at rest, for round-off.
const AT_REST: f64 = 1e-9;

/// Checks the foundations of a beam whose length is known, or not.
pub(super) fn check_foundations(beam: &Beam, length: Option<f64>, issues: &mut Issues) {
    for (i, foundation) in beam.foundation.iter().enumerate() {
        // In the words of the file: a single one stands there as a table.
        let index = if beam.foundation.len() == 1 { String::new() } else { format!("[{i}]") };
        let path = format!("beam.{}.foundation{index}", beam.name);
        check_law(foundation, length, &path, issues);
        if let Some(direction) = &foundation.direction {
            issues.finite_vector(format_args!("{path}.direction"), direction);
            if *direction == Vector3::zeros() {
                issues.add(format!("{path}.direction"), "a direction must not be zero");
            }
        }
        let Some(length) = length else { continue };
        check_reach(&foundation.between, length, "foundation", &path, issues);
    }
}

/// Checks where something along a beam of the given length begins and ends.
pub(super) fn check_reach(between: &[At; 2], length: f64, what: &str, path: &str, issues: &mut Issues) {
    let ends = between.map(|at| at.arc_length(length));
    for (s, word) in ends.iter().zip(["from", "to"]) {
        if !(-1e-9 * length..=(1.0 + 1e-9) * length).contains(s) {
            issues
                .add(format!("{path}.{word}"), format!("is {s} m along the beam, which is {length} m long"));
        }
    }
    if ends[0] >= ends[1] {
        issues.add_with_hint(
            format!("{path}.to"),
            format!("the {what} ends where it begins, or before"),
            "`from` must be nearer to the beam's start than `to`",
        );
    }
}

fn check_law(foundation: &Foundation, length: Option<f64>, path: &str, issues: &mut Issues) {
    match &foundation.law {
        FoundationLaw::Linear(profile) => {
            let path = format!("{path}.stiffness");
            check_table(profile, &path, issues);
            if matches!(profile, Profile::Notch(_)) {
                issues.add(path, "a stiffness cannot be a notch");
            } else if let Some((s, value)) = worst(profile, length, |k| k.is_finite() && k >= 0.0) {
                issues.add_with_hint(
                    path,
                    format!("must be finite and not negative along the beam, is {value} N/m^2 at s = {s} m"),
                    "a positive stiffness pushes the beam back; what pushes it away is written as a law, for example `force = \"-1e3*u\"`",
                );
            }
        }
        FoundationLaw::Force(function) => {
            let path = format!("{path}.force");
            if foundation.direction.is_none() {
                issues.add_with_hint(
                    path.clone(),
                    "a force that depends on the displacement needs a direction",
                    "for example `direction = [0, 1, 0]`",
                );
            }
            let [value, slope, ..] = function.jet(0.0);
            if !value.is_finite() || !slope.is_finite() {
                issues.add_with_hint(
                    path,
                    format!("must have a value and a slope at u = 0, has {value} N/m and {slope} N/m^2"),
                    "write a law that is smooth there, for example `\"2e3*u + 5e7*u^3\"`",
                );
            } else if value.abs() > AT_REST * slope.abs() * 1e-3 {
                issues.add_with_hint(
                    path,
                    format!("must vanish at u = 0, is {value} N/m there"),
                    "the foundation is relaxed where the undeformed beam lies; a constant force is a `distributed` load",
                );
            } else {
                let bad = TRIED.iter().map(|part| part * length.unwrap_or(0.0));
                if let Some(u) = bad.into_iter().find(|u| !function.value(*u).is_finite()) {
                    issues.add_with_hint(
                        path,
                        format!("gives no finite number at u = {u} m"),
                        "the law must hold on both sides, for displacements with the direction and against it",
                    );
                }
            }
        }
    }
}
