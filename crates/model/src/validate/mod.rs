//! Is the description sound? Everything that can be said without solving.

use crate::Model;
use flexura_spatial::{Matrix3, Pose, Vector3};
use std::fmt::Display;

mod beam;
mod design;
mod doubts;
mod fit;
mod foundation;
mod joint;
mod load;
mod motion;
mod result;
mod section;
mod spring;
mod study;
mod tubes;

use section::check_section_alone;

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

    fn finite(&mut self, path: impl Display, value: f64) -> bool {
        if !value.is_finite() {
            self.add(path.to_string(), format!("must be a finite number, is {value}"));
        }
        value.is_finite()
    }

    fn positive(&mut self, path: impl Display, value: f64) -> bool {
        if !self.finite(&path, value) {
            return false;
        }
        if value <= 0.0 {
            self.add(path.to_string(), format!("must be positive, is {value}"));
        }
        value > 0.0
    }

    fn not_negative(&mut self, path: impl Display, value: f64) {
        if self.finite(&path, value) && value < 0.0 {
            self.add(path.to_string(), format!("must not be negative, is {value}"));
        }
    }

    fn finite_vector(&mut self, path: impl Display, vector: &Vector3<f64>) {
        if !vector.iter().all(|x| x.is_finite()) {
            let [x, y, z] = [vector.x, vector.y, vector.z];
            self.add(path.to_string(), format!("must be finite numbers, is [{x}, {y}, {z}]"));
        }
    }

    fn pose(&mut self, path: &str, pose: &Pose) {
        self.finite_vector(format_args!("{path}.at"), &pose.position);
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
        let mut issues = Issues(self.validate_mechanism());
        self.check_studies(&mut issues);
        issues.0
    }

    /// The same without its studies: whether they make sense depends on the values that parameters have when they begin.
    pub fn validate_mechanism(&self) -> Vec<Issue> {
        let mut issues = Issues(Vec::new());
        self.check_names(&mut issues);
        issues.finite_vector("gravity", &self.gravity);
        issues.not_negative("mass_damping", self.mass_damping);
        if let Some(spin) = &self.spin {
            issues.finite("spin.rate", spin.rate);
            issues.finite_vector("spin.through", &spin.through);
            for mass in self.masses.iter().filter(|mass| mass.inertia != Matrix3::zeros()) {
                issues.add_with_hint(
                    format!("mass.{}.inertia", mass.name),
                    "a lumped mass that resists turning does not spin yet",
                    "make it a body that a beam's end holds, or leave out `inertia`",
                );
            }
            if (spin.axis.norm() - 1.0).is_nan() || (spin.axis.norm() - 1.0).abs() > 1e-9 {
                issues.add("spin.axis", "must be a unit vector");
            }
        }
        for parameter in &self.parameters {
            issues.finite(format_args!("parameter.{}", parameter.name), parameter.value);
        }
        self.check_materials(&mut issues);
        self.check_sections(&mut issues);
        for body in &self.bodies {
            let path = format!("body.{}", body.name);
            issues.pose(&path, &body.pose);
            issues.not_negative(format_args!("{path}.mass"), body.mass);
            issues.finite_vector(format_args!("{path}.center_of_mass"), &body.center_of_mass);
            check_inertia(&body.inertia, &format!("{path}.inertia"), &mut issues);
        }
        for beam in &self.beams {
            self.check_beam(beam, &mut issues);
        }
        self.check_circles(&mut issues);
        for joint in &self.joints {
            self.check_joint(joint, &mut issues);
        }
        self.check_couplings(&mut issues);
        self.check_springs(&mut issues);
        self.check_loads(&mut issues);
        self.check_cables(&mut issues);
        self.check_tubes(&mut issues);
        self.check_outputs(&mut issues);
        self.check_inverse(&mut issues);
        issues.0
    }

    /// [`Model::validate_mechanism`] of a model that was made from a sound one by other values of its parameters: what is as it was there
    /// is not looked at again.
    pub fn validate_beside(&self, sound: &Model) -> Vec<Issue> {
        let mut issues = Issues(Vec::new());
        for parameter in &self.parameters {
            issues.finite(format_args!("parameter.{}", parameter.name), parameter.value);
        }
        if self.differs_in_parts(sound) || self.beams != sound.beams || !issues.0.is_empty() {
            return self.validate_mechanism();
        }
        if self.materials != sound.materials || self.sections != sound.sections {
            self.check_materials(&mut issues);
            self.check_sections(&mut issues);
            self.beams.iter().for_each(|beam| self.check_beam(beam, &mut issues));
        }
        if self.joints.len() != sound.joints.len() {
            return self.validate_mechanism();
        }
        for (joint, _) in self.joints.iter().zip(&sound.joints).filter(|(a, b)| a != b) {
            self.check_joint(joint, &mut issues);
        }
        if self.springs != sound.springs {
            self.check_springs(&mut issues);
        }
        if self.loads != sound.loads {
            self.check_loads(&mut issues);
        }
        if self.targets != sound.targets {
            self.check_inverse(&mut issues);
        }
        issues.0
    }

    fn check_sections(&self, issues: &mut Issues) {
        for section in &self.sections {
            let path = format!("section.{}", section.name);
            check_section_alone(&section.shape, &path, issues);
        }
    }

    fn check_names(&self, issues: &mut Issues) {
        issues.names("parameter", self.parameters.iter().map(|p| p.name.as_str()));
        issues.names("material", self.materials.iter().map(|m| m.name.as_str()));
        issues.names("section", self.sections.iter().map(|s| s.name.as_str()));
        issues.names("beam", self.beams.iter().map(|b| b.name.as_str()));
        issues.names("body", self.bodies.iter().map(|b| b.name.as_str()));
        issues.names("joint", self.joints.iter().map(|j| j.name.as_str()));
        issues.names("coupling", self.couplings.iter().map(|c| c.name.as_str()));
        issues.names("spring", self.springs.iter().map(|s| s.name.as_str()));
        issues.names("cable", self.cables.iter().map(|c| c.name.as_str()));
        issues.names("tubes", self.tubes.iter().map(|t| t.name.as_str()));
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
            issues.positive(format_args!("{path}.young"), material.young);
            issues.positive(format_args!("{path}.shear"), material.shear);
            if let Some(density) = material.density {
                issues.not_negative(format_args!("{path}.density"), density);
            }
            if let Some(strength) = material.yield_strength {
                issues.positive(format_args!("{path}.yield_strength"), strength);
            }
        }
    }
}

fn check_inertia(inertia: &Matrix3<f64>, path: &str, issues: &mut Issues) {
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

#[cfg(test)]
mod tests;
