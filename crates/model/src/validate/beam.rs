//! Beams: rest shape, section along them, ends, distributed loads.

use super::Issues;
use super::joint::check_law;
use super::section::{check_section_along, check_table, worst};
use crate::{Beam, Curve, Model, Mount, SectionFrame, Shape};
use flexura_spatial::Vector3;

impl Model {
    /// A beam lies where its start is held, else where its end is. Beams that place each other lie nowhere.
    pub(super) fn check_circles(&self, issues: &mut Issues) {
        let holder = |i: usize| {
            let beam = self.beams.get(i)?;
            match beam.start.as_ref().or(beam.end.as_ref())?.mount {
                // A beam that holds itself is told where its end is checked.
                Mount::Beam(point) if point.beam.0 != i => Some(point.beam.0),
                _ => None,
            }
        };
        let mut trail_of = vec![usize::MAX; self.beams.len()];
        for first in 0..self.beams.len() {
            let mut trail = Vec::new();
            let mut at = Some(first);
            while let Some(i) = at.filter(|i| *i < self.beams.len() && trail_of[*i] == usize::MAX) {
                trail_of[i] = first;
                trail.push(i);
                at = holder(i);
            }
            let Some(begin) = at.and_then(|at| trail.iter().position(|i| *i == at)) else { continue };
            let mut names: Vec<&str> = trail[begin..].iter().map(|i| self.beams[*i].name.as_str()).collect();
            names.push(names[0]);
            let end = if self.beams[trail[begin]].start.is_some() { "start" } else { "end" };
            issues.add_with_hint(
                format!("beam.{}.{end}.beam", names[0]),
                format!("the beams hold each other in a circle, so none has a place: {}", names.join(" -> ")),
                "a beam lies where its `start` is held: begin one of them on a body, or close the circle by an `end`",
            );
        }
    }

    pub(super) fn check_beam(&self, beam: &Beam, issues: &mut Issues) {
        let path = format!("beam.{}", beam.name);
        let length = check_curve(&beam.curve, &path, issues);
        issues.not_negative(format_args!("{path}.damping"), beam.damping);
        issues.not_negative(format_args!("{path}.added_mass"), beam.added_mass);
        check_frame(beam, &format!("{path}.frame"), issues);
        let material = beam.material.and_then(|id| self.materials.get(id.0));
        if beam.material.is_some() && material.is_none() {
            issues.add(format!("{path}.material"), "refers to a material that does not exist");
        }
        match self.sections.get(beam.section.0) {
            None => issues.add(format!("{path}.section"), "refers to a section that does not exist"),
            Some(section) => {
                let direct = matches!(section.shape, Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. });
                if !direct && beam.material.is_none() {
                    issues.add_with_hint(
                        path.clone(),
                        format!("beam `{}` has no material", beam.name),
                        "only a beam whose section is given as a stiffness needs none",
                    );
                }
                if let Shape::Stiffness { ga2, ga3, .. } = &section.shape
                    && beam.theory.shear
                    && (ga2.is_none() || ga3.is_none())
                {
                    issues.add_with_hint(
                        format!("{path}.shear"),
                        format!(
                            "the beam shears, but its section `{}` gives no shear stiffness",
                            section.name
                        ),
                        "give the section GA2 and GA3",
                    );
                }
                if section.plane_strain && !direct && material.is_some_and(|m| !m.is_isotropic()) {
                    issues.add_with_hint(
                        format!("section.{}.plane_strain", section.name),
                        format!(
                            "needs Poisson's ratio, which the moduli of beam `{}`'s material do not give",
                            beam.name
                        ),
                        "leave `plane_strain` out, and give the material the modulus of a wide strip",
                    );
                }
                if let Some(length) = length {
                    check_section_along(&section.shape, &section.name, length, &path, issues);
                }
            }
        }
        for (end, word) in [(&beam.start, "start"), (&beam.end, "end")] {
            let Some(end) = end else { continue };
            let path = format!("{path}.{word}");
            self.check_mount(end.mount, &path, issues);
            if let Some(pose) = &end.placement {
                issues.pose(&path, pose);
            }
            if let Mount::Beam(point) = end.mount
                && self.beams.get(point.beam.0).is_some_and(|other| std::ptr::eq(other, beam))
            {
                issues.add(format!("{path}.beam"), "a beam cannot hold its own end");
            }
            check_law(&end.hold, &path, issues);
        }
        super::foundation::check_foundations(beam, length, issues);
        for (i, distributed) in beam.distributed.iter().enumerate() {
            if let Some(length) = length {
                // In the words of the file: a single one stands there as a table.
                let index = if beam.distributed.len() == 1 { String::new() } else { format!("[{i}]") };
                let path = format!("{path}.distributed{index}");
                super::foundation::check_reach(&distributed.between, length, "load", &path, issues);
            }
            for (profiles, word) in [(&distributed.force, "force"), (&distributed.moment, "moment")] {
                for (k, profile) in profiles.iter().enumerate() {
                    let path = format!("{path}.distributed[{i}].{word}[{k}]");
                    check_table(profile, &path, issues);
                    if let Some((s, value)) = worst(profile, length, |value| value.is_finite()) {
                        issues.add(path, format!("must be finite along the beam, is {value} at s = {s} m"));
                    }
                }
            }
        }
    }
}

/// The arc length (m), where it needs no quadrature.
pub(super) fn known_length(curve: &Curve) -> Option<f64> {
    match curve {
        Curve::Straight { length } | Curve::Curvature { length, .. } => Some(*length),
        Curve::Arc { radius, angle } => Some(radius * angle),
        Curve::Helix { radius, pitch, turns } => Some(turns * (std::f64::consts::TAU * radius).hypot(*pitch)),
        Curve::Parametric { .. } | Curve::Points { .. } => None,
    }
}

/// Checks the rest shape; returns its length where that is known and sound.
pub(super) fn check_curve(curve: &Curve, beam: &str, issues: &mut Issues) -> Option<f64> {
    let before = issues.0.len();
    let path = format!("{beam}.curve");
    match curve {
        Curve::Straight { length } => {
            issues.positive(format_args!("{beam}.length"), *length);
        }
        Curve::Arc { radius, angle } => {
            check_bent(*radius, &format!("{path}.radius"), "an arc", issues);
            check_bent(*angle, &format!("{path}.angle"), "an arc", issues);
        }
        Curve::Helix { radius, pitch, turns } => {
            check_bent(*radius, &format!("{path}.radius"), "a helix", issues);
            issues.finite(format_args!("{path}.pitch"), *pitch);
            if *turns < 0.0 && turns.is_finite() {
                issues.add_with_hint(
                    format!("{path}.turns"),
                    format!("must be positive, is {turns}"),
                    "a left-handed helix has a negative pitch",
                );
            } else {
                issues.positive(format_args!("{path}.turns"), *turns);
            }
        }
        Curve::Parametric { position, range } => {
            let [from, to] = *range;
            if !from.is_finite() || !to.is_finite() || from >= to {
                issues.add(
                    format!("{path}.range"),
                    format!("must be two finite, increasing numbers, is [{from}, {to}]"),
                );
            } else {
                for (function, axis) in position.iter().zip(["x", "y", "z"]) {
                    let bad = (0..=64)
                        .map(|i| from + (to - from) * f64::from(i) / 64.0)
                        .find(|t| !function.value(*t).is_finite());
                    if let Some(t) = bad {
                        issues.add(
                            format!("{path}.{axis}"),
                            format!("gives no finite number at the parameter {t}"),
                        );
                    }
                }
                if position.iter().all(|function| function.as_constant().is_some()) {
                    issues
                        .add(path.clone(), "the curve does not depend on its parameter, so it has no length");
                }
            }
        }
        Curve::Points { points } => {
            if points.len() < 2 {
                issues.add(path.clone(), format!("a curve needs at least 2 points, found {}", points.len()));
            }
            for (i, point) in points.iter().enumerate() {
                issues.finite_vector(format_args!("{path}.points[{i}]"), point);
            }
            if let Some(i) = points.windows(2).position(|pair| pair[0] == pair[1]) {
                issues.add(
                    format!("{path}.points[{}]", i + 1),
                    format!("the points {} and {} are the same", i + 1, i + 2),
                );
            }
        }
        Curve::Curvature { curvature, length } => {
            let sound = issues.positive(format_args!("{path}.length"), *length);
            for (profile, key) in curvature.iter().zip(["k1", "k2", "k3"]) {
                let path = format!("{path}.{key}");
                check_table(profile, &path, issues);
                if let Some((s, value)) = worst(profile, sound.then_some(*length), |value| value.is_finite())
                {
                    issues.add(path, format!("must be finite along the beam, is {value} at s = {s} m"));
                }
            }
        }
    }
    if issues.0.len() == before { known_length(curve) } else { None }
}

/// A radius or an angle, whose sign would be the side to which the curve bends.
fn check_bent(value: f64, path: &str, what: &str, issues: &mut Issues) {
    if value < 0.0 && value.is_finite() {
        issues.add_with_hint(
            path,
            format!("must be positive, is {value}: {what} bends towards +e2"),
            "to bend it the other way, turn the beam's start half round: \
             `rotation = { axis = [1, 0, 0], angle = \"180 deg\" }`",
        );
    } else {
        issues.positive(path, value);
    }
}

/// Does the rest shape lie on a straight line?
fn is_straight(curve: &Curve) -> bool {
    match curve {
        Curve::Straight { .. } => true,
        Curve::Points { points } => match points.as_slice() {
            [first, middle @ .., last] => {
                let along = last - first;
                let off = |point: &Vector3<f64>| (point - first).cross(&along).norm();
                middle.iter().all(|point| off(point) <= 1e-12 * along.norm_squared())
            }
            _ => true,
        },
        Curve::Arc { .. } | Curve::Helix { .. } | Curve::Parametric { .. } | Curve::Curvature { .. } => false,
    }
}

/// A frame that would change nothing: the start frame is that of the beam's start, whichever way the section points there.
fn check_frame_acts(beam: &Beam, path: &str, issues: &mut Issues) {
    let idle = match &beam.frame {
        SectionFrame::Natural => false,
        _ if matches!(beam.curve, Curve::Curvature { .. }) => {
            issues.add_with_hint(
                path,
                "changes nothing: a curve given by its curvature says itself how the section turns",
                "leave `frame` out; k1 turns the section about the axis",
            );
            return;
        }
        SectionFrame::Direction { .. } => true,
        SectionFrame::RotationMinimising { start, .. } => start.is_some(),
        // Where there is no curvature, this is refused with the shape.
        SectionFrame::Frenet { .. } => false,
    };
    if idle && is_straight(&beam.curve) {
        issues.add_with_hint(
            path,
            "changes nothing: the section of a straight beam points wherever its start is turned",
            "turn the start about the axis: `start = { ..., rotation = { axis = [1, 0, 0], angle = \"90 deg\" } }`",
        );
    }
}

fn check_frame(beam: &Beam, path: &str, issues: &mut Issues) {
    check_frame_acts(beam, path, issues);
    let direction = |vector: &Vector3<f64>, key: &str, issues: &mut Issues| {
        issues.finite_vector(format_args!("{path}.{key}"), vector);
        if *vector == Vector3::zeros() {
            issues.add(format!("{path}.{key}"), "a direction must not be zero");
        }
    };
    match &beam.frame {
        SectionFrame::Natural => {}
        SectionFrame::Frenet { offset } => {
            issues.finite(format_args!("{path}.offset"), *offset);
        }
        SectionFrame::RotationMinimising { start, twist } => {
            if let Some(start) = start {
                direction(start, "start", issues);
            }
            if let Some(twist) = twist
                && (twist.value(0.0).is_nan() || twist.value(0.0).abs() > 1e-9)
            {
                let message = format!("the twist must be zero at s = 0, is {}", twist.value(0.0));
                issues.add_with_hint(format!("{path}.twist"), message, "turn the start by `start`");
            }
        }
        SectionFrame::Direction { along } => direction(along, "along", issues),
    }
}
