//! What the picture of a sweep shows.

use super::table::Table;
use flexura::Sample;
use flexura::output::{SampleColumn, SweepView};
use flexura::post::OutputValue;

/// The samples by columns: parameters, unknowns and outputs; of a sweep without either, the strain energy.
pub fn view<'a>(table: &Table<'a>, samples: &[Sample]) -> SweepView<'a> {
    let column = |name: &str, unit: &str, values: &dyn Fn(&Sample) -> Option<f64>| SampleColumn {
        name: name.to_owned(),
        unit: unit.to_owned(),
        values: samples.iter().map(|sample| values(sample).filter(|value| value.is_finite())).collect(),
    };
    let model = table.model;
    let unit = |name: &str| {
        let known = model.parameters.iter().find(|parameter| parameter.name == name);
        known.map_or("", |parameter| parameter.unit.as_str())
    };
    let varied = table.axes.iter().enumerate().map(|(i, axis)| {
        column(&axis.parameter, unit(&axis.parameter), &|sample| sample.values.get(i).copied())
    });
    let mut found: Vec<SampleColumn> = Vec::new();
    for (i, unknown) in model.unknowns.iter().enumerate() {
        let parameter = &model.parameters[unknown.parameter];
        found.push(column(&parameter.name, &parameter.unit, &|sample| sample.found.get(i).copied()));
    }
    for (i, output) in model.outputs.iter().enumerate() {
        let value = |sample: &Sample, k: usize| match sample.outputs.get(i)?.as_ref()?.value {
            OutputValue::Number(value) => Some(value),
            OutputValue::Vector(values) => values.get(k).copied(),
        };
        match output.formulas.len() {
            3 => found.extend(["x", "y", "z"].iter().enumerate().map(|(k, axis)| {
                column(&format!("{}.{axis}", output.name), &output.unit, &|sample| value(sample, k))
            })),
            _ => found.push(column(&output.name, &output.unit, &|sample| value(sample, 0))),
        }
    }
    if found.is_empty() {
        found.push(column("strain energy", "J", &|sample| sample.energy));
    }
    let failed = samples.iter().filter(|sample| !sample.status.is_converged()).count();
    SweepView { model: &model.name, varied: varied.collect(), found, failed }
}
