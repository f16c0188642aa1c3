//! Outputs, unknowns and targets.

use super::Issues;
use crate::{Model, Probe, ProbeTarget, Quantity};

impl Model {
    pub(super) fn check_outputs(&self, issues: &mut Issues) {
        for output in &self.outputs {
            let path = format!("output.{}", output.name);
            if !matches!(output.formulas.len(), 1 | 3) {
                issues.add(path.clone(), "an output must have one formula, or three for a vector");
            }
            self.check_probes(&output.probes, &path, issues);
        }
    }

    pub(super) fn check_probes(&self, probes: &[Probe], path: &str, issues: &mut Issues) {
        for probe in probes {
            let exists = match probe.target {
                ProbeTarget::Beam(beam, at) => {
                    self.check_station(beam, at, path, issues);
                    true
                }
                ProbeTarget::Body(id) => id.0 < self.bodies.len(),
                ProbeTarget::Joint(id) => id.0 < self.joints.len(),
                ProbeTarget::Spring(id) => id.0 < self.springs.len(),
                ProbeTarget::Tubes(id) => id.0 < self.tubes.len(),
                ProbeTarget::Cable(id) => id.0 < self.cables.len(),
                ProbeTarget::Model => true,
            };
            let components = match probe.quantity {
                Quantity::Parameter => self.parameters.len(),
                _ => 36,
            };
            if !exists || probe.component >= components {
                issues.add(path, "an output refers to something that does not exist");
            }
        }
    }

    pub(super) fn check_inverse(&self, issues: &mut Issues) {
        let mut seen = vec![false; self.parameters.len()];
        for unknown in &self.unknowns {
            let Some(parameter) = self.parameters.get(unknown.parameter) else {
                issues.add("unknown", "refers to a parameter that does not exist");
                continue;
            };
            let path = format!("unknown.{}", parameter.name);
            if std::mem::replace(&mut seen[unknown.parameter], true) {
                issues.add(path.clone(), "the parameter is unknown twice");
            }
            let Some([low, high]) = unknown.range else { continue };
            let path = format!("{path}.range");
            if !low.is_finite() || !high.is_finite() || low >= high {
                issues.add(path, format!("must increase, is [{low}, {high}]"));
            } else if parameter.value < low - 0.05 * (high - low)
                || parameter.value > high + 0.05 * (high - low)
            {
                // Derivatives at a bound look a little beyond it.
                let unit =
                    if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
                let message =
                    format!("the search begins at {}{unit}, which is not in the range", parameter.value);
                issues.add_with_hint(path, message, "give a `guess` within the range");
            }
        }
        for target in &self.targets {
            // The name is the text of a formula, which may hold dots: the table is all that can be pointed at.
            let path = "target";
            let name = &target.output.name;
            if target.output.formulas.len() != 1 {
                issues.add(path, format!("the target `{name}` must have one formula"));
            }
            self.check_probes(&target.output.probes, path, issues);
            issues.finite(path, target.value);
        }
        let (unknowns, targets) = (self.unknowns.len(), self.targets.len());
        if unknowns != targets {
            issues.add(
                if unknowns > targets { "unknown" } else { "target" },
                format!("there must be as many targets as unknowns: unknowns {unknowns}, targets {targets}"),
            );
        }
    }
}
