//! `flexura sweep FILE --vary P=A:B:N`

use super::{file_failure, warn_about};
use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::progress::Counter;
use crate::screen;
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{Named, Value, to_json};
use flexura::post::OutputValue;
use flexura::{Axis, Options, Sample, Sweep};
use serde::Serialize;
use std::fs::{self, OpenOptions};
use std::path::Path;

pub fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let overrides = &arguments.model.overrides;
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let model = file.model(overrides).map_err(|report| file_failure(&report))?;
    let mut options = Options::default();
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }
    let axes = arguments.vary.iter().map(|text| Axis::parse(&model, text)).collect::<Result<Vec<_>, _>>();
    let sweep = axes.and_then(|axes| Sweep::new(&file, overrides, axes, &options)).map_err(Failure::Input)?;
    if let Some(path) = &arguments.output {
        // Hours of work should not end at a folder that is not there.
        OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|error| unwritable(path, &error))?;
    }
    if !arguments.model.quiet {
        warn_about(&file, &[]);
    }

    let counter = Counter::new(arguments.model.quiet, sweep.count());
    let jobs = arguments.jobs.map(usize::from);
    let samples = sweep.run(jobs, &|| counter.count()).map_err(Failure::Machine)?;
    counter.finish();

    let table = csv(&model, sweep.axes(), &samples);
    if let Some(path) = &arguments.output {
        fs::write(path, &table).map_err(|error| unwritable(path, &error))?;
    }
    if arguments.model.json {
        let document = SweepDocument::new(&model, sweep.axes(), &samples);
        screen::print(&to_json(&document).map_err(|error| Failure::Machine(error.to_string()))?)?;
    } else if arguments.output.is_none() {
        screen::print(&table)?;
    }
    if !arguments.model.quiet {
        tell(arguments, &samples);
    }
    match complaint(&samples) {
        Some(complaint) => Err(Failure::NotConverged(complaint)),
        None => Ok(()),
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Machine(format!("cannot write {}: {error}", path.display()))
}

/// What became of it, on standard error.
fn tell(arguments: &SweepArguments, samples: &[Sample]) {
    let without_value =
        samples.iter().filter(|sample| sample.outputs.iter().any(Option::is_none)).collect::<Vec<_>>();
    if let Some(reason) = without_value.first().and_then(|sample| sample.reason.as_deref()) {
        let count = without_value.len();
        let plural = if count == 1 { "sample lacks" } else { "samples lack" };
        screen::warn(&format!("{count} converged {plural} the value of an output: {reason}"));
    }
    for warning in common_warnings(samples) {
        screen::warn(warning);
    }
    let warned = samples.iter().filter(|s| !own_warnings(s, &common_warnings(samples)).is_empty()).count();
    if warned > 0 {
        screen::warn(&format!(
            "{warned} of {} samples have warnings, which stand in their rows",
            samples.len()
        ));
    }
    if let Some(path) = &arguments.output {
        screen::note(&format!("wrote {} samples into {}", samples.len(), path.display()));
    }
}

/// How many samples ended in which way, unless all converged.
fn complaint(samples: &[Sample]) -> Option<String> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for word in samples.iter().filter(|sample| !sample.status.is_converged()).map(|s| s.status.word()) {
        match counts.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += 1,
            None => counts.push((word, 1)),
        }
    }
    if counts.is_empty() {
        return None;
    }
    let failed: usize = counts.iter().map(|(_, count)| count).sum();
    let list: Vec<String> = counts.iter().map(|(word, count)| format!("{count} {word}")).collect();
    Some(format!("{failed} of {} samples did not converge: {}", samples.len(), list.join(", ")))
}

/// The table: varied parameters, status, what was found, outputs, energy, error estimate, reason.
fn csv(model: &Model, axes: &[Axis], samples: &[Sample]) -> String {
    let headed = |name: &str, unit: &str| {
        if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
    };
    let mut header: Vec<String> = axes.iter().map(|axis| headed(&axis.parameter, &axis.unit)).collect();
    header.push("status".into());
    for unknown in &model.unknowns {
        let parameter = &model.parameters[unknown.parameter];
        header.push(headed(&parameter.name, &parameter.unit));
    }
    for output in &model.outputs {
        match output.formulas.len() {
            3 => {
                header.extend(["x", "y", "z"].map(|c| headed(&format!("{}.{c}", output.name), &output.unit)))
            }
            _ => header.push(headed(&output.name, &output.unit)),
        }
    }
    header.extend(["energy [J]", "error_estimate", "reason", "warnings"].map(str::to_owned));

    let mut text = line(header);
    // Debug prints the shortest text that reads back as the same number.
    let cell = |value: Option<f64>| {
        value.filter(|value| value.is_finite()).map_or_else(String::new, |value| format!("{value:?}"))
    };
    let common = common_warnings(samples);
    for sample in samples {
        let mut row: Vec<String> = sample.values.iter().map(|value| cell(Some(*value))).collect();
        row.push(sample.status.word().to_owned());
        row.extend((0..model.unknowns.len()).map(|i| cell(sample.found.get(i).copied())));
        for (i, output) in model.outputs.iter().enumerate() {
            let value = sample.outputs.get(i).and_then(Option::as_ref).map(|result| result.value);
            match value {
                Some(OutputValue::Number(value)) => row.push(cell(Some(value))),
                Some(OutputValue::Vector(values)) => row.extend(values.map(|value| cell(Some(value)))),
                None => row.extend(output.formulas.iter().map(|_| String::new())),
            }
        }
        row.extend([cell(sample.energy), cell(sample.error_estimate)]);
        row.push(sample.reason.clone().unwrap_or_default());
        row.push(own_warnings(sample, &common).join("; "));
        text += &line(row);
    }
    text
}

/// Warnings that every sample has: they are about the mechanism, and said once.
fn common_warnings(samples: &[Sample]) -> Vec<&str> {
    let first = samples.first().map_or(&[][..], |sample| &sample.warnings);
    let everywhere = |warning: &String| samples.iter().all(|sample| sample.warnings.contains(warning));
    if samples.len() < 2 {
        return Vec::new();
    }
    first.iter().filter(|warning| everywhere(warning)).map(String::as_str).collect()
}

/// The warnings that are a sample's own.
fn own_warnings<'a>(sample: &'a Sample, common: &[&str]) -> Vec<&'a str> {
    sample.warnings.iter().map(String::as_str).filter(|warning| !common.contains(warning)).collect()
}

/// Cells with commas between them, in quotes where they hold one.
fn line(cells: Vec<String>) -> String {
    let quoted = cells.into_iter().map(|cell| {
        if cell.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell
        }
    });
    quoted.collect::<Vec<_>>().join(",") + "\n"
}

#[derive(Serialize)]
struct SweepDocument<'a> {
    flexura: &'static str,
    model: &'a str,
    study: &'static str,
    status: &'static str,
    vary: Named<&'a [f64]>,
    samples: Vec<SampleDocument<'a>>,
}

#[derive(Serialize)]
struct SampleDocument<'a> {
    parameters: Named<f64>,
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unknowns: Option<Named<f64>>,
    outputs: Named<Value>,
    energy: Option<f64>,
    error_estimate: Option<f64>,
}

impl<'a> SweepDocument<'a> {
    fn new(model: &'a Model, axes: &'a [Axis], samples: &'a [Sample]) -> Self {
        let is_complete = samples.iter().all(|sample| sample.status.is_converged());
        let name = |axis: &Axis| axis.parameter.clone();
        let common = common_warnings(samples);
        let document = |sample: &'a Sample| SampleDocument {
            parameters: Named(axes.iter().map(name).zip(sample.values.iter().copied()).collect()),
            status: sample.status.word(),
            reason: sample.reason.as_deref(),
            warnings: own_warnings(sample, &common),
            unknowns: (!sample.found.is_empty()).then(|| {
                let names = model.unknowns.iter().map(|u| model.parameters[u.parameter].name.clone());
                Named(names.zip(sample.found.iter().copied()).collect())
            }),
            outputs: Named(
                sample
                    .outputs
                    .iter()
                    .flatten()
                    .map(|output| {
                        let value = match output.value {
                            OutputValue::Number(value) => Value::Number(value),
                            OutputValue::Vector(values) => Value::Vector(values),
                        };
                        (output.name.clone(), value)
                    })
                    .collect(),
            ),
            energy: sample.energy,
            error_estimate: sample.error_estimate,
        };
        Self {
            flexura: env!("CARGO_PKG_VERSION"),
            model: &model.name,
            study: "sweep",
            status: if is_complete { "converged" } else { "incomplete" },
            vary: Named(axes.iter().map(|axis| (axis.parameter.clone(), axis.values.as_slice())).collect()),
            samples: samples.iter().map(document).collect(),
        }
    }
}
