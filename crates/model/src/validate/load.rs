//! Cables, masses and loads.

use super::Issues;
use super::beam::known_length;
use super::section::{check_table, worst};
use crate::{Attachment, CableLaw, Guide, LoadTarget, Model, Mount, Profile};

/// Where the point of an attachment is written.
pub(super) fn point_path(attachment: &Attachment, path: &str) -> String {
    match attachment.mount {
        Mount::Beam(_) => format!("{path}.offset"),
        _ => format!("{path}.at"),
    }
}

impl Model {
    pub(super) fn check_cables(&self, issues: &mut Issues) {
        for cable in &self.cables {
            let path = format!("cable.{}", cable.name);
            match cable.law {
                CableLaw::Tension(tension) => issues.not_negative(format_args!("{path}.tension"), tension),
                CableLaw::Length(length) => {
                    issues.positive(format_args!("{path}.length"), length);
                }
            }
            let path = format!("{path}.route");
            let channel = cable.route.iter().any(|guide| matches!(guide, Guide::Channel { .. }));
            if cable.route.len() < 2 && !channel {
                issues.add_with_hint(
                    path.clone(),
                    format!("a cable needs at least two points or a channel, has {}", cable.route.len()),
                    "it runs from its first point, where it is anchored, to its last",
                );
            }
            for (i, guide) in cable.route.iter().enumerate() {
                self.check_guide(guide, &format!("{path}[{i}]"), issues);
            }
            if let Some(i) = cable.route.windows(2).position(|pair| pair[0] == pair[1]) {
                issues.add(
                    format!("{path}[{}]", i + 1),
                    format!("the guides {} and {} of the cable are the same", i + 1, i + 2),
                );
            }
        }
    }

    fn check_guide(&self, guide: &Guide, path: &str, issues: &mut Issues) {
        match guide {
            Guide::Point(attachment) => {
                self.check_mount(attachment.mount, path, issues);
                issues.finite_vector(point_path(attachment, path), &attachment.point);
            }
            Guide::Channel { beam, between, offset } => {
                self.check_station(*beam, between[0], &format!("{path}.from"), issues);
                self.check_station(*beam, between[1], &format!("{path}.to"), issues);
                if between[0] == between[1] {
                    issues.add(format!("{path}.to"), "a channel must lead from one place to another");
                }
                let length = self.beams.get(beam.0).and_then(|beam| known_length(&beam.curve));
                for (k, profile) in offset.iter().enumerate() {
                    let path = format!("{path}.offset[{k}]");
                    check_table(profile, &path, issues);
                    if matches!(profile, Profile::Notch(_)) {
                        issues.add(path, "a channel cannot follow a notch");
                        continue;
                    }
                    if let Some((s, value)) = worst(profile, length, |value| value.is_finite()) {
                        issues.add(path, format!("must be finite along the beam, is {value} at s = {s} m"));
                    }
                }
            }
        }
    }

    pub(super) fn check_loads(&self, issues: &mut Issues) {
        for mass in &self.masses {
            let path = format!("mass.{}", mass.name);
            self.check_at(&mass.point, &format!("{path}.at"), issues);
            issues.not_negative(format_args!("{path}.mass"), mass.mass);
            super::check_inertia(&mass.inertia, &format!("{path}.inertia"), issues);
        }
        for load in &self.loads {
            let path = format!("load.{}", load.name);
            match &load.target {
                LoadTarget::Body { body, point } => {
                    self.check_mount(Mount::Body(*body), &path, issues);
                    issues.finite_vector(format_args!("{path}.at"), point);
                }
                LoadTarget::Beam(point) => self.check_at(point, &format!("{path}.at"), issues),
            }
            issues.finite_vector(format_args!("{path}.force"), &load.force);
            issues.finite_vector(format_args!("{path}.moment"), &load.moment);
        }
    }
}
