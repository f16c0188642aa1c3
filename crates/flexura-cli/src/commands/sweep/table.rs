//! The rows of a sweep.

use flexura::model::Model;
use flexura::output::csv_line;
use flexura::post::OutputValue;
use flexura::{Axis, Sample};

/// The table: varied parameters, status, what was found, outputs, stability, energy, error estimate, reason.
pub struct Table<'a> {
    pub model: &'a Model,
    pub axes: &'a [Axis],
    /// Warnings about the mechanism, which are said once and stand in no row.
    pub known: Vec<String>,
}

impl<'a> Table<'a> {
    pub fn new(model: &'a Model, axes: &'a [Axis]) -> Self {
        let known = flexura::check(model).map(|census| census.warnings).unwrap_or_default();
        Self { model, axes, known }
    }

    pub fn header(&self) -> String {
        let headed = |name: &str, unit: &str| {
            if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
        };
        let mut header: Vec<String> =
            self.axes.iter().map(|axis| headed(&axis.parameter, &axis.typed_unit)).collect();
        header.push("status".into());
        for unknown in &self.model.unknowns {
            let parameter = &self.model.parameters[unknown.parameter];
            header.push(headed(&parameter.name, &parameter.unit));
        }
        for output in &self.model.outputs {
            match output.formulas.len() {
                3 => header
                    .extend(["x", "y", "z"].map(|c| headed(&format!("{}.{c}", output.name), &output.unit))),
                _ => header.push(headed(&output.name, &output.unit)),
            }
        }
        let last = ["stable", "unstable_directions", "energy [J]", "error_estimate", "reason", "warnings"];
        header.extend(last.map(str::to_owned));
        csv_line(&header)
    }

    pub fn row(&self, sample: &Sample) -> String {
        // Debug prints the shortest text that reads back as the same number.
        let cell = |value: Option<f64>| {
            value.filter(|value| value.is_finite()).map_or_else(String::new, |value| format!("{value:?}"))
        };
        let mut row: Vec<String> = sample.typed.iter().map(|value| cell(Some(*value))).collect();
        row.push(sample.status.word().to_owned());
        row.extend((0..self.model.unknowns.len()).map(|i| cell(sample.found.get(i).copied())));
        for (i, output) in self.model.outputs.iter().enumerate() {
            let value = sample.outputs.get(i).and_then(Option::as_ref).map(|result| result.value);
            match value {
                Some(OutputValue::Number(value)) => row.push(cell(Some(value))),
                Some(OutputValue::Vector(values)) => row.extend(values.map(|value| cell(Some(value)))),
                None => row.extend(output.formulas.iter().map(|_| String::new())),
            }
        }
        let unstable = sample.unstable_directions;
        row.push(unstable.map_or_else(String::new, |count| (count == 0).to_string()));
        row.push(unstable.map_or_else(String::new, |count| count.to_string()));
        row.extend([cell(sample.energy), cell(sample.error_estimate)]);
        let reasons: Vec<&str> = match &sample.reason {
            Some(reason) if sample.output_reasons.is_empty() => vec![reason],
            _ => sample.output_reasons.iter().map(|(_, reason)| reason.as_str()).collect(),
        };
        row.push(reasons.join("; "));
        row.push(self.own_warnings(sample).join("; "));
        csv_line(&row)
    }

    /// The warnings that are a sample's own.
    pub fn own_warnings<'s>(&self, sample: &'s Sample) -> Vec<&'s str> {
        sample.warnings.iter().filter(|warning| !self.known.contains(warning)).map(String::as_str).collect()
    }
}
