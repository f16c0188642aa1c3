//! Outputs, unknowns and targets.

use super::Writer;
use super::things::quoted;
use super::tree::{Table, Value};
use crate::build::name_of;
use flexura_expression::Formula;
use flexura_model::{At, Output, Probe, ProbeTarget, Quantity};

impl Writer<'_> {
    pub(super) fn results(&self, text: &mut String) {
        let model = self.model;
        let mut outputs = Table::default();
        for output in &model.outputs {
            outputs.put(&output.name, Value::text(&self.expression(output)));
        }
        if !outputs.is_empty() {
            text.push_str(&outputs.section("output", ""));
        }
        for unknown in &model.unknowns {
            let Some(name) = self.names.get(unknown.parameter) else { continue };
            let mut table = Table::default();
            let path = format!("unknown.{name}.range");
            table.put_some("range", unknown.range.map(|range| self.numbers(&path, &range)));
            text.push_str(&table.section("unknown", name));
        }
        let mut targets = Table::default();
        for target in &model.targets {
            let path = format!("target.\"{}\"", target.output.name);
            let expression = self.expression(&target.output);
            // What was read bears the expression as its name.
            let key = if self.is_bound(&path) { &target.output.name } else { &expression };
            targets.put(key, self.number(&path, target.value));
        }
        if !targets.is_empty() {
            text.push_str(&targets.section("target", ""));
        }
    }

    /// The text of an output; of one that is nothing but results, their names.
    pub(super) fn expression(&self, output: &Output) -> String {
        let first = output.formulas.first();
        let only = |formula: &Formula| {
            let slot = formula.as_slot()?;
            output.probes.get(slot).and_then(|probe| self.probe(probe, output.formulas.len() > 1))
        };
        // A text that was read stands for itself; that of a formula made in code may be none.
        match first {
            Some(formula) if formula.text().starts_with("slot ") => {
                only(formula).unwrap_or_else(|| formula.text().to_string())
            }
            Some(formula) => formula.text().to_string(),
            None => String::new(),
        }
    }

    /// The name of a result in expressions.
    fn probe(&self, probe: &Probe, is_vector: bool) -> Option<String> {
        let model = self.model;
        let place = match probe.target {
            ProbeTarget::Beam(beam, _) if probe.quantity.is_of_whole_beam() => {
                format!("beam.{}", quoted(&model[beam].name))
            }
            ProbeTarget::Beam(beam, at) => {
                let at = match at {
                    At::Fraction(fraction) => format!("{fraction:?}"),
                    At::Length(length) => format!("{length:?} m"),
                };
                format!("beam.{}[{at}]", quoted(&model[beam].name))
            }
            ProbeTarget::Body(body) => format!("body.{}", quoted(&model[body].name)),
            ProbeTarget::Joint(joint) => format!("joint.{}", quoted(&model[joint].name)),
            ProbeTarget::Spring(spring) => format!("spring.{}", quoted(&model[spring].name)),
            ProbeTarget::Cable(cable) => format!("cable.{}", quoted(&model[cable].name)),
            ProbeTarget::Tubes(tubes) => format!("tubes.{}", quoted(&model[tubes].name)),
            ProbeTarget::Model if probe.quantity == Quantity::Parameter => {
                return self.names.get(probe.component).map(ToString::to_string);
            }
            ProbeTarget::Model => "model".to_string(),
        };
        let law = match probe.target {
            ProbeTarget::Joint(joint) => Some(&model[joint].law),
            _ => None,
        };
        name_of(probe, law, is_vector).map(|name| format!("{place}.{name}"))
    }
}
