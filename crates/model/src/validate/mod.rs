//! Is the description sound? Everything that can be said without solving.

use crate::{
    At, Beam, BeamId, BeamPoint, Curve, Drive, JointKind, JointLaw, LoadTarget, Model, Mount, SectionFrame,
    Shape, SpringLaw,
};
use flexura_spatial::{Pose, Vector3};

mod section;

use section::{check_section_alone, check_section_along, check_table, worst};

/// Something in a model that makes no sense.
#[derive(Clone, Debug, PartialEq)]
pub struct Issue {
    /// Where, in the words of the model file: `section.strip.width`.
    pub path: String,
    /// What is wrong, one sentence.
    pub message: String,
    /// What to do about it, if that is clear.
    pub hint: Option<String>,
}

/// Issues found so far.
struct Issues(Vec<Issue>);

impl Issues {
    fn add(&mut self, path: impl Into<String>, message: impl Into<String>) {
        self.0.push(Issue { path: path.into(), message: message.into(), hint: None });
    }

    fn add_with_hint(
        &mut self,
        path: impl Into<String>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.0.push(Issue { path: path.into(), message: message.into(), hint: Some(hint.into()) });
    }

    fn finite(&mut self, path: impl Into<String>, value: f64) -> bool {
        if !value.is_finite() {
            self.add(path, format!("must be a finite number, is {value}"));
        }
        value.is_finite()
    }

    fn positive(&mut self, path: impl Into<String>, value: f64) -> bool {
        let path = path.into();
        if !self.finite(path.clone(), value) {
            return false;
        }
        if value <= 0.0 {
            self.add(path, format!("must be positive, is {value}"));
        }
        value > 0.0
    }

    fn not_negative(&mut self, path: impl Into<String>, value: f64) {
        let path = path.into();
        if self.finite(path.clone(), value) && value < 0.0 {
            self.add(path, format!("must not be negative, is {value}"));
        }
    }

    fn finite_vector(&mut self, path: impl Into<String>, vector: &Vector3<f64>) {
        if !vector.iter().all(|x| x.is_finite()) {
            let [x, y, z] = [vector.x, vector.y, vector.z];
            self.add(path, format!("must be finite numbers, is [{x}, {y}, {z}]"));
        }
    }

    fn pose(&mut self, path: &str, pose: &Pose) {
        self.finite_vector(format!("{path}.at"), &pose.position);
        if !pose.rotation.coords.iter().all(|x| x.is_finite()) || (pose.rotation.norm() - 1.0).abs() > 1e-9 {
            self.add(format!("{path}.rotation"), "must be a unit quaternion");
        }
    }

    /// Are the names of one list all there, different and speakable?
    fn names<'a>(&mut self, kind: &str, names: impl Iterator<Item = &'a str>) {
        let mut seen: Vec<&str> = Vec::new();
        for name in names {
            if let Some(problem) = name_problem(name) {
                self.add(format!("{kind}.{name}"), format!("the name `{name}` {problem}"));
            }
            seen.push(name);
        }
        seen.sort_unstable();
        for pair in seen.windows(2) {
            if pair[0] == pair[1] {
                self.add(format!("{kind}.{}", pair[0]), format!("the name `{}` is given twice", pair[0]));
            }
        }
    }
}

/// What is wrong with a name, as the end of a sentence; names are letters, digits, `_` and `-`.
pub fn name_problem(name: &str) -> Option<&'static str> {
    if name.is_empty() {
        return Some("is empty");
    }
    if name.len() > 200 {
        return Some("is longer than 200 bytes");
    }
    let speakable = name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-');
    if speakable { None } else { Some("may only hold letters, digits, `_` and `-`") }
}

impl Model {
    /// Everything that is wrong with the description, in the order of its lists. Empty: it can be solved,
    /// as far as can be told without solving.
    pub fn validate(&self) -> Vec<Issue> {
        let mut issues = Issues(Vec::new());
        self.check_names(&mut issues);
        issues.finite_vector("gravity", &self.gravity);
        for parameter in &self.parameters {
            issues.finite(format!("parameter.{}", parameter.name), parameter.value);
        }
        self.check_materials(&mut issues);
        for section in &self.sections {
            let path = format!("section.{}", section.name);
            check_section_alone(&section.shape, &path, &mut issues);
        }
        for body in &self.bodies {
            let path = format!("body.{}", body.name);
            issues.pose(&path, &body.pose);
            issues.not_negative(format!("{path}.mass"), body.mass);
            issues.finite_vector(format!("{path}.center_of_mass"), &body.center_of_mass);
            check_inertia(&body.inertia, &format!("{path}.inertia"), &mut issues);
        }
        for beam in &self.beams {
            self.check_beam(beam, &mut issues);
        }
        for joint in &self.joints {
            let path = format!("joint.{}", joint.name);
            self.check_mount(joint.parent.mount, &format!("{path}.parent"), &mut issues);
            self.check_mount(joint.child, &format!("{path}.child"), &mut issues);
            issues.pose(&format!("{path}.parent"), &joint.parent.pose);
            if let Some(pose) = &joint.child_pose {
                issues.pose(&format!("{path}.child"), pose);
            }
            if joint.parent.mount == joint.child {
                issues.add(format!("{path}.child"), "a joint must connect two different bodies");
            }
            check_law(&joint.law, &path, &mut issues);
        }
        self.check_loads(&mut issues);
        self.check_outputs(&mut issues);
        issues.0
    }

    fn check_names(&self, issues: &mut Issues) {
        issues.names("parameter", self.parameters.iter().map(|p| p.name.as_str()));
        issues.names("material", self.materials.iter().map(|m| m.name.as_str()));
        issues.names("section", self.sections.iter().map(|s| s.name.as_str()));
        issues.names("beam", self.beams.iter().map(|b| b.name.as_str()));
        issues.names("body", self.bodies.iter().map(|b| b.name.as_str()));
        issues.names("joint", self.joints.iter().map(|j| j.name.as_str()));
        issues.names("spring", self.springs.iter().map(|s| s.name.as_str()));
        issues.names("mass", self.masses.iter().map(|m| m.name.as_str()));
        issues.names("load", self.loads.iter().map(|l| l.name.as_str()));
        issues.names("output", self.outputs.iter().map(|o| o.name.as_str()));
        if self.bodies.iter().any(|body| body.name == "ground") {
            issues.add("body.ground", "`ground` is the fixed world and cannot be the name of a body");
        }
    }

    fn check_materials(&self, issues: &mut Issues) {
        for material in &self.materials {
            let path = format!("material.{}", material.name);
            let young = issues.positive(format!("{path}.young"), material.young);
            let shear = issues.positive(format!("{path}.shear"), material.shear);
            if young && shear {
                let poisson = material.young / (2.0 * material.shear) - 1.0;
                // G = E/3 of an incompressible material is no exact double.
                if poisson <= -1.0 || poisson > 0.5 + 1e-9 {
                    issues.add_with_hint(
                        format!("{path}.shear"),
                        format!("Young's and shear modulus give Poisson's ratio {poisson:.4}, which no isotropic material has"),
                        "it must lie above -1 and at most at 0.5",
                    );
                }
            }
            if let Some(density) = material.density {
                issues.not_negative(format!("{path}.density"), density);
            }
            if let Some(strength) = material.yield_strength {
                issues.positive(format!("{path}.yield_strength"), strength);
            }
        }
    }

    fn check_beam(&self, beam: &Beam, issues: &mut Issues) {
        let path = format!("beam.{}", beam.name);
        let length = check_curve(&beam.curve, &path, issues);
        check_frame(&beam.frame, &format!("{path}.frame"), issues);
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
            check_law(&end.hold, &path, issues);
        }
        for (i, distributed) in beam.distributed.iter().enumerate() {
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

    fn check_mount(&self, mount: Mount, path: &str, issues: &mut Issues) {
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

    fn check_at(&self, point: &BeamPoint, path: &str, issues: &mut Issues) {
        self.check_station(point.beam, point.at, path, issues);
    }

    fn check_station(&self, beam: BeamId, at: At, path: &str, issues: &mut Issues) {
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

    fn check_loads(&self, issues: &mut Issues) {
        for spring in &self.springs {
            let path = format!("spring.{}", spring.name);
            for (attachment, word) in [(&spring.from, "from"), (&spring.to, "to")] {
                self.check_mount(attachment.mount, &format!("{path}.{word}"), issues);
                issues.finite_vector(format!("{path}.{word}.at"), &attachment.point);
            }
            if spring.from == spring.to {
                issues.add(format!("{path}.to"), "a spring must connect two different points");
            }
            let SpringLaw::Linear { stiffness, rest_length } = &spring.law;
            issues.not_negative(format!("{path}.stiffness"), *stiffness);
            if let Some(rest_length) = rest_length {
                issues.not_negative(format!("{path}.rest_length"), *rest_length);
            }
        }
        for mass in &self.masses {
            let path = format!("mass.{}", mass.name);
            self.check_at(&mass.point, &format!("{path}.at"), issues);
            issues.not_negative(format!("{path}.mass"), mass.mass);
        }
        for load in &self.loads {
            let path = format!("load.{}", load.name);
            match &load.target {
                LoadTarget::Body { body, point } => {
                    self.check_mount(Mount::Body(*body), &path, issues);
                    issues.finite_vector(format!("{path}.at"), point);
                }
                LoadTarget::Beam(point) => self.check_at(point, &format!("{path}.at"), issues),
            }
            issues.finite_vector(format!("{path}.force"), &load.force);
            issues.finite_vector(format!("{path}.moment"), &load.moment);
        }
    }

    fn check_outputs(&self, issues: &mut Issues) {
        use crate::ProbeTarget;
        for output in &self.outputs {
            let path = format!("output.{}", output.name);
            if !matches!(output.formulas.len(), 1 | 3) {
                issues.add(path.clone(), "an output must have one formula, or three for a vector");
            }
            for probe in &output.probes {
                let exists = match probe.target {
                    ProbeTarget::Beam(beam, at) => {
                        self.check_station(beam, at, &path, issues);
                        true
                    }
                    ProbeTarget::Body(id) => id.0 < self.bodies.len(),
                    ProbeTarget::Joint(id) => id.0 < self.joints.len(),
                    ProbeTarget::Spring(id) => id.0 < self.springs.len(),
                    ProbeTarget::Cable(id) => id.0 < self.cables.len(),
                    ProbeTarget::Model => true,
                };
                if !exists || probe.component > 35 {
                    issues.add(path.clone(), "an output refers to something that does not exist");
                }
            }
        }
    }
}

/// The arc length (m), where it needs no quadrature.
fn known_length(curve: &Curve) -> Option<f64> {
    match curve {
        Curve::Straight { length } | Curve::Curvature { length, .. } => Some(*length),
        Curve::Arc { radius, angle } => Some(radius * angle),
        Curve::Helix { radius, pitch, turns } => Some(turns * (std::f64::consts::TAU * radius).hypot(*pitch)),
        Curve::Parametric { .. } | Curve::Points { .. } => None,
    }
}

/// Checks the rest shape; returns its length where that is known and sound.
fn check_curve(curve: &Curve, beam: &str, issues: &mut Issues) -> Option<f64> {
    let before = issues.0.len();
    let path = format!("{beam}.curve");
    match curve {
        Curve::Straight { length } => {
            issues.positive(format!("{beam}.length"), *length);
        }
        Curve::Arc { radius, angle } => {
            issues.positive(format!("{path}.radius"), *radius);
            issues.positive(format!("{path}.angle"), *angle);
        }
        Curve::Helix { radius, pitch, turns } => {
            issues.positive(format!("{path}.radius"), *radius);
            issues.finite(format!("{path}.pitch"), *pitch);
            issues.positive(format!("{path}.turns"), *turns);
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
                issues.finite_vector(format!("{path}.points[{i}]"), point);
            }
            if let Some(i) = points.windows(2).position(|pair| pair[0] == pair[1]) {
                issues.add(
                    format!("{path}.points[{}]", i + 1),
                    format!("the points {} and {} are the same", i + 1, i + 2),
                );
            }
        }
        Curve::Curvature { curvature, length } => {
            let sound = issues.positive(format!("{path}.length"), *length);
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

fn check_frame(frame: &SectionFrame, path: &str, issues: &mut Issues) {
    let direction = |vector: &Vector3<f64>, key: &str, issues: &mut Issues| {
        issues.finite_vector(format!("{path}.{key}"), vector);
        if *vector == Vector3::zeros() {
            issues.add(format!("{path}.{key}"), "a direction must not be zero");
        }
    };
    match frame {
        SectionFrame::Natural => {}
        SectionFrame::Frenet { offset } => {
            issues.finite(format!("{path}.offset"), *offset);
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

fn check_inertia(inertia: &nalgebra::Matrix3<f64>, path: &str, issues: &mut Issues) {
    if !inertia.iter().all(|x| x.is_finite()) {
        issues.add(path, "must be finite numbers");
        return;
    }
    let scale = inertia.norm();
    if (inertia - inertia.transpose()).norm() > 1e-9 * scale {
        issues.add(path, "must be symmetric");
    } else if inertia.symmetric_eigenvalues().iter().any(|value| *value < -1e-9 * scale) {
        issues.add(path, "must not have a negative principal moment");
    }
}

fn check_law(law: &JointLaw, path: &str, issues: &mut Issues) {
    let turning = !matches!(law.kind, JointKind::Weld | JointKind::Spherical | JointKind::Free);
    if turning && (!law.axis.norm().is_finite() || (law.axis.norm() - 1.0).abs() > 1e-9) {
        issues.add(format!("{path}.axis"), "the axis must be a unit vector");
    }
    if law.coordinates.len() != law.kind.freedoms() {
        let (found, expected) = (law.coordinates.len(), law.kind.freedoms());
        issues.add(path, format!("needs the laws of {expected} coordinates, found {found}"));
    }
    for coordinate in &law.coordinates {
        match coordinate.drive {
            Drive::Free { effort } => issues.finite(format!("{path}.effort"), effort),
            Drive::Driven { coordinate } => issues.finite(format!("{path}.coordinate"), coordinate),
        };
        issues.not_negative(format!("{path}.stiffness"), coordinate.stiffness);
        issues.finite(format!("{path}.rest"), coordinate.rest);
        if let Some(limits) = coordinate.limits {
            let [low, high] = limits.range;
            if low.is_nan() || high.is_nan() || low >= high {
                issues.add(format!("{path}.limits.range"), format!("must increase, is [{low}, {high}]"));
            }
            if let Some(stiffness) = limits.stiffness {
                issues.not_negative(format!("{path}.limits.stiffness"), stiffness);
            }
        }
    }
}

#[cfg(test)]
mod tests;
