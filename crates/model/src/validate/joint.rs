//! What carries something, joints, couplings.

use super::Issues;
use super::beam::known_length;
use crate::{
    At, BeamId, BeamPoint, Contact, CoordinateLaw, Drive, Joint, JointKind, JointLaw, Model, Mount,
    SurfaceMotion,
};
use flexura_spatial::Vector3;

/// Axes count as perpendicular up to this cosine.
const RIGHT: f64 = 1e-9;

impl Model {
    pub(super) fn check_joint(&self, joint: &Joint, issues: &mut Issues) {
        let path = format!("joint.{}", joint.name);
        self.check_mount(joint.parent.mount, &format!("{path}.parent"), issues);
        self.check_mount(joint.child, &format!("{path}.child"), issues);
        issues.pose(&format!("{path}.parent"), &joint.parent.pose);
        if let Some(pose) = &joint.child_pose {
            issues.pose(&format!("{path}.child"), pose);
        }
        if self.same_mount(joint.parent.mount, joint.child) {
            let (what, hint) = match joint.child {
                Mount::Beam(_) => ("places", "name another beam, body or place along the beam"),
                _ => ("bodies", "name another body"),
            };
            let message = format!("a joint must connect two different {what}");
            issues.add_with_hint(format!("{path}.child"), message, hint);
        }
        check_law(&joint.law, &path, issues);
    }

    /// Is it the same body, or the same place of a beam, however that is written?
    fn same_mount(&self, a: Mount, b: Mount) -> bool {
        match (a, b) {
            (Mount::Beam(a), Mount::Beam(b)) if a.beam == b.beam => {
                let length = self.beams.get(a.beam.0).and_then(|beam| known_length(&beam.curve));
                match length {
                    Some(length) => {
                        (a.at.arc_length(length) - b.at.arc_length(length)).abs() <= 1e-12 * length.abs()
                    }
                    None => a.at == b.at,
                }
            }
            _ => a == b,
        }
    }

    pub(super) fn check_couplings(&self, issues: &mut Issues) {
        for coupling in &self.couplings {
            let path = format!("coupling.{}", coupling.name);
            issues.finite(path.clone(), coupling.offset);
            if coupling.terms.len() < 2 {
                let message =
                    format!("a coupling needs at least two coordinates, has {}", coupling.terms.len());
                issues.add(path.clone(), message);
            }
            let mut all_driven = !coupling.terms.is_empty();
            for (i, term) in coupling.terms.iter().enumerate() {
                let Some(joint) = self.joints.get(term.joint.0) else {
                    issues.add(path.clone(), "refers to a joint that does not exist");
                    all_driven = false;
                    continue;
                };
                let law = joint.law.coordinates.get(term.coordinate);
                let turning = match joint.law.kind {
                    JointKind::Spherical => true,
                    JointKind::Free => term.coordinate >= 3,
                    JointKind::Contact => true,
                    _ => false,
                };
                if law.is_none() {
                    let message = format!("joint `{}` has no coordinate {}", joint.name, term.coordinate);
                    issues.add(path.clone(), message);
                } else if turning {
                    let message = format!("the rotation vector of joint `{}` cannot be coupled", joint.name);
                    issues.add(path.clone(), message);
                }
                all_driven &= law.is_some_and(|law| matches!(law.drive, Drive::Driven { .. }));
                if issues.finite(path.clone(), term.factor) && term.factor == 0.0 {
                    issues.add(path.clone(), "a factor of a coupling must not be zero");
                }
                let same = |other: &&crate::CouplingTerm| {
                    (other.joint, other.coordinate) == (term.joint, term.coordinate)
                };
                if coupling.terms[..i].iter().any(|other| same(&other)) {
                    let message = format!("a coordinate of joint `{}` stands in it twice", joint.name);
                    issues.add(path.clone(), message);
                }
            }
            if all_driven {
                issues.add_with_hint(
                    path,
                    "every coordinate of the coupling is driven, so it can do nothing",
                    "leave at least one coordinate free",
                );
            }
        }
    }

    pub(super) fn check_mount(&self, mount: Mount, path: &str, issues: &mut Issues) {
        match mount {
            Mount::Ground => {}
            Mount::Body(id) => {
                if id.0 >= self.bodies.len() {
                    issues.add(format!("{path}.body"), "refers to a body that does not exist");
                }
            }
            Mount::Beam(point) => self.check_at(&point, &format!("{path}.at"), issues),
        }
    }

    pub(super) fn check_at(&self, point: &BeamPoint, path: &str, issues: &mut Issues) {
        self.check_station(point.beam, point.at, path, issues);
    }

    pub(super) fn check_station(&self, beam: BeamId, at: At, path: &str, issues: &mut Issues) {
        let Some(beam) = self.beams.get(beam.0) else {
            issues.add(path, "refers to a beam that does not exist");
            return;
        };
        match at {
            At::Fraction(fraction) if !(0.0..=1.0).contains(&fraction) => issues.add_with_hint(
                path,
                format!("the place {fraction} is not on beam `{}`", beam.name),
                "a plain number is a fraction of the length, from 0 to 1; a length needs a unit",
            ),
            At::Length(s) => {
                let length = known_length(&beam.curve);
                // A place at the very end may come out a rounding error beyond it.
                let beyond = length.is_some_and(|length| s > length * (1.0 + 1e-12));
                if !s.is_finite() || s < 0.0 || beyond {
                    let reach = length
                        .map_or(String::new(), |length| format!(", which reaches from 0 to {length} m"));
                    issues.add(path, format!("the place {s} m is not on beam `{}`{reach}", beam.name));
                }
            }
            At::Fraction(_) => {}
        }
    }
}

pub(super) fn check_law(law: &JointLaw, path: &str, issues: &mut Issues) {
    let unit = |axis: &Vector3<f64>| (axis.norm() - 1.0).abs() <= 1e-9;
    let has_axis = !matches!(
        law.kind,
        JointKind::Weld
            | JointKind::Spherical
            | JointKind::Free
            | JointKind::Contact
            | JointKind::SurfaceRolling
    );
    if has_axis && !unit(&law.axis) {
        issues.add(format!("{path}.axis"), "the axis must be a unit vector");
    }
    let second = match law.kind {
        JointKind::Universal => Some("second_axis"),
        JointKind::Planar | JointKind::Rolling(_) => Some("x_axis"),
        _ => None,
    };
    if let Some(second) = second {
        if !unit(&law.second_axis) {
            issues.add(format!("{path}.{second}"), "the axis must be a unit vector");
        } else if law.axis.dot(&law.second_axis).abs() > RIGHT {
            issues.add(format!("{path}.{second}"), "must be at right angles to `axis`");
        }
    }
    let fits = match (law.kind, law.contact.as_deref()) {
        (JointKind::Rolling(_), Some(Contact::Rolling(_))) => true,
        (JointKind::Contact, Some(Contact::Surfaces(surfaces))) => surfaces.motion == SurfaceMotion::Sliding,
        (JointKind::SurfaceRolling, Some(Contact::Surfaces(surfaces))) => {
            surfaces.motion != SurfaceMotion::Sliding
        }
        (JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling, _) => false,
        (_, contact) => contact.is_none(),
    };
    if !fits {
        issues.add(path, "what touches what does not belong to this kind of joint");
    }
    if law.coordinates.len() != law.kind.freedoms() {
        let (found, expected) = (law.coordinates.len(), law.kind.freedoms());
        issues.add(path, format!("needs the laws of {expected} coordinates, found {found}"));
    }
    for (i, coordinate) in law.coordinates.iter().enumerate() {
        let path = match (law.kind, law.kind.coordinate_names().get(i)) {
            (JointKind::Free, _) if i >= 3 => format!("{path}.rotation"),
            (JointKind::Contact, _) => format!("{path}.rotation"),
            (JointKind::Spherical, _) | (_, None) => path.to_string(),
            (_, Some(_)) if law.coordinates.len() == 1 => path.to_string(),
            (_, Some(name)) => format!("{path}.{name}"),
        };
        check_coordinate(coordinate, &path, issues);
    }
}

fn check_coordinate(coordinate: &CoordinateLaw, path: &str, issues: &mut Issues) {
    match coordinate.drive {
        Drive::Free { effort } => issues.finite(format_args!("{path}.effort"), effort),
        Drive::Driven { coordinate } => issues.finite(format_args!("{path}.coordinate"), coordinate),
    };
    issues.not_negative(format_args!("{path}.stiffness"), coordinate.stiffness);
    issues.finite(format_args!("{path}.rest"), coordinate.rest);
    issues.not_negative(format_args!("{path}.damping"), coordinate.damping);
    if let Some(limits) = coordinate.limits {
        let [low, high] = limits.range;
        if low.is_nan() || high.is_nan() || low >= high {
            issues.add(format!("{path}.limits.range"), format!("must increase, is [{low}, {high}]"));
        }
        if let Some(stiffness) = limits.stiffness {
            issues.not_negative(format_args!("{path}.limits.stiffness"), stiffness);
        }
    }
}
