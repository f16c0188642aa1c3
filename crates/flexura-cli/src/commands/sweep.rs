//! `flexura sweep FILE --vary P=A:B:N`

use super::{file_failure, warn_about};
use crate::answer::json;
use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::files::{self, Growing};
use crate::progress::Counter;
use crate::{interrupt, page, screen};
use flexura::model::{Model, visible};
use flexura::modelfile::Document;
use flexura::output::{
    LoadDocument, Named, OutputError, SceneDocument, StateDocument, Value, csv_line, loads, scene,
    scene_beside, shape_of,
};
use flexura::post::{OutputResult, OutputValue};
use flexura::solution::Status;
use flexura::{Axis, Interrupt, Options, Sample, SampleStatus, Sweep};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};

pub fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let overrides = &arguments.model.overrides;
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let model = file.model(overrides).map_err(|report| file_failure(&report))?;
    let mut options = Options { interrupt: interrupt::listen(), ..Options::default() };
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }
    let axes = arguments.vary.iter().map(|text| Axis::parse(&model, text)).collect::<Result<Vec<_>, _>>();
    let mut sweep =
        axes.and_then(|axes| Sweep::new(&file, overrides, axes, &options)).map_err(Failure::Input)?;
    if let Some(path) = &arguments.report {
        page::begin(path)?;
    }
    if arguments.report.is_some() || arguments.model.json {
        sweep = sweep.with_shapes(model.beams.len());
    }
    let table = Table::new(&model, sweep.axes());
    // Hours of work should not end at a folder that is not there.
    let rows = match arguments.output.as_deref() {
        Some(path) => Rows::File(Growing::begin(path, &table.header())?),
        None if arguments.model.json => Rows::None,
        None => Rows::Screen(Ordered::begin(&table.header(), &options.interrupt)),
    };
    if !arguments.model.quiet {
        warn_about(&file, &[]);
    }

    // Rows on a terminal show how far it has come, and a bar would run into them.
    let shows_rows = matches!(rows, Rows::Screen(_)) && std::io::stdout().is_terminal();
    let counter = Counter::new(arguments.model.quiet || shows_rows, sweep.count());
    let rows = Mutex::new(rows);
    let jobs = arguments.jobs.map(usize::from);
    let samples = sweep.run(jobs, &|position, sample| {
        counter.count();
        // A thread that panicked while it wrote has left nothing that another could spoil.
        rows.lock().unwrap_or_else(PoisonError::into_inner).add(position, || table.row(sample));
    });
    let samples = samples.map_err(Failure::Machine)?;
    counter.finish();

    let rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    deliver(arguments, &file, &table, &samples, rows)
}

/// Writes the whole table, prints what is to be printed, and ends as the samples did.
fn deliver(
    arguments: &SweepArguments,
    file: &Document,
    table: &Table<'_>,
    samples: &[Sample],
    rows: Rows,
) -> Result<(), Failure> {
    let path = arguments.output.as_deref();
    let whole = || samples.iter().fold(table.header(), |text, sample| text + &table.row(sample));
    let unwritten = path.and_then(|path| files::replace(path, &whole()).err());
    if unwritten.is_none() {
        rows.finish(samples, |sample| table.row(sample))?;
    }
    if arguments.model.json || arguments.report.is_some() {
        let document = SweepDocument::new(file, table, samples);
        let text = json(&document.map_err(|error| Failure::Machine(error.to_string()))?)?;
        if let Some(path) = &arguments.report {
            files::replace(path, &page::of_text(&text)?)?;
        }
        if arguments.model.json {
            screen::print_table(&text)?;
        }
    }
    if unwritten.is_some() && !arguments.model.json {
        // What has no room on the disk is shown nevertheless.
        screen::print_table(&whole())?;
    }
    if !arguments.model.quiet {
        tell(table, samples);
    }
    if let Some(failure) = unwritten {
        return Err(failure);
    }
    if let (Some(path), false) = (path, arguments.model.quiet) {
        let path = path.to_string_lossy();
        screen::note(&format!("wrote {} samples into {}", samples.len(), visible(&path)));
    }
    if let (Some(path), false) = (&arguments.report, arguments.model.quiet) {
        screen::note(&format!("wrote {}", visible(&path.to_string_lossy())));
    }
    complaint(samples).map_or(Ok(()), Err)
}

/// Where rows go while they are found.
enum Rows {
    None,
    /// As they come, beside the table that will hold all of them.
    File(Growing),
    /// In the order of the grid.
    Screen(Ordered),
}

impl Rows {
    fn add(&mut self, position: usize, row: impl FnOnce() -> String) {
        match self {
            Rows::None => {}
            Rows::File(growing) => growing.add(&row()),
            Rows::Screen(ordered) => ordered.add(position, row()),
        }
    }

    /// All samples are known, those that were not solved too.
    fn finish(self, samples: &[Sample], row: impl Fn(&Sample) -> String) -> Result<(), Failure> {
        match self {
            Rows::None => Ok(()),
            Rows::File(growing) => {
                growing.finish();
                Ok(())
            }
            Rows::Screen(ordered) => ordered.finish(samples, row),
        }
    }
}

/// Rows on standard output. One that comes before its turn waits for those before it.
struct Ordered {
    next: usize,
    waiting: BTreeMap<usize, String>,
    failure: Option<Failure>,
    /// Raised when nothing can be written any more: then nothing needs to be solved.
    interrupt: Interrupt,
}

impl Ordered {
    fn begin(header: &str, interrupt: &Interrupt) -> Self {
        let waiting = BTreeMap::new();
        let mut ordered = Self { next: 0, waiting, failure: None, interrupt: interrupt.clone() };
        ordered.print(header);
        ordered
    }

    fn add(&mut self, position: usize, row: String) {
        self.waiting.insert(position, row);
        while let Some(row) = self.waiting.remove(&self.next) {
            self.next += 1;
            self.print(&row);
        }
    }

    fn print(&mut self, text: &str) {
        if self.failure.is_none()
            && let Err(failure) = screen::print_table(text)
        {
            self.failure = Some(failure);
            self.interrupt.raise();
        }
    }

    fn finish(mut self, samples: &[Sample], row: impl Fn(&Sample) -> String) -> Result<(), Failure> {
        for sample in samples.iter().skip(self.next) {
            if self.failure.is_some() {
                break;
            }
            self.print(&row(sample));
        }
        self.failure.map_or(Ok(()), Err)
    }
}

/// What became of it, on standard error.
fn tell(table: &Table<'_>, samples: &[Sample]) {
    let without_value = samples.iter().filter(|sample| !sample.output_reasons.is_empty()).collect::<Vec<_>>();
    if let Some((_, reason)) = without_value.first().and_then(|sample| sample.output_reasons.first()) {
        let count = without_value.len();
        let plural = if count == 1 { "sample lacks" } else { "samples lack" };
        screen::warn(&format!("{count} converged {plural} the value of an output: {reason}"));
    }
    for warning in &table.known {
        screen::warn(warning);
    }
    let warned = samples.iter().filter(|sample| !table.own_warnings(sample).is_empty()).count();
    if warned > 0 {
        screen::warn(&format!(
            "{warned} of {} samples have warnings, which stand in their rows",
            samples.len()
        ));
    }
}

/// How many samples ended in which way, unless all converged.
fn complaint(samples: &[Sample]) -> Option<Failure> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    let solved = samples.iter().filter(|sample| !is_interrupted(sample)).count();
    let failed = samples.iter().filter(|sample| !sample.status.is_converged() && !is_interrupted(sample));
    for word in failed.map(|sample| sample.status.word()) {
        match counts.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += 1,
            None => counts.push((word, 1)),
        }
    }
    let failed: usize = counts.iter().map(|(_, count)| count).sum();
    let list: Vec<String> = counts.iter().map(|(word, count)| format!("{count} {word}")).collect();
    let failed =
        (failed > 0).then(|| format!("{failed} of {solved} samples did not converge: {}", list.join(", ")));
    if solved == samples.len() {
        return failed.map(Failure::NotConverged);
    }
    let interrupted = format!("interrupted when {solved} of {} samples were solved", samples.len());
    let parts: Vec<String> = std::iter::once(interrupted).chain(failed).collect();
    Some(Failure::Interrupted(parts.join("; ")))
}

fn is_interrupted(sample: &Sample) -> bool {
    sample.status == SampleStatus::Solved(Status::Interrupted)
}

/// The table: varied parameters, status, what was found, outputs, stability, energy, error estimate, reason.
struct Table<'a> {
    model: &'a Model,
    axes: &'a [Axis],
    /// Warnings about the mechanism, which are said once and stand in no row.
    known: Vec<String>,
}

impl<'a> Table<'a> {
    fn new(model: &'a Model, axes: &'a [Axis]) -> Self {
        let known = flexura::check(model).map(|census| census.warnings).unwrap_or_default();
        Self { model, axes, known }
    }

    fn header(&self) -> String {
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

    fn row(&self, sample: &Sample) -> String {
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
    fn own_warnings<'s>(&self, sample: &'s Sample) -> Vec<&'s str> {
        sample.warnings.iter().filter(|warning| !self.known.contains(warning)).map(String::as_str).collect()
    }
}

#[derive(Serialize)]
struct SweepDocument<'a> {
    flexura: &'static str,
    model: &'a str,
    study: &'static str,
    status: &'static str,
    /// Of the mechanism; those of samples stand there.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    warnings: &'a [String],
    vary: Named<&'a [f64]>,
    samples: Vec<SampleDocument<'a>>,
    /// What a picture needs besides; where shapes are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<SceneDocument>,
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
    outputs: Named<Option<Value>>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    output_reasons: Named<&'a str>,
    stable: Option<bool>,
    unstable_directions: Option<usize>,
    energy: Option<f64>,
    error_estimate: Option<f64>,
    /// The state with few samples, rounded, for pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<StateDocument>,
    /// Where more than loads is varied: what a picture of this sample needs besides.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<SceneDocument>,
    /// Loads that are not as in the scene.
    #[serde(skip_serializing_if = "Named::is_empty")]
    loads: Named<LoadDocument>,
}

impl<'a> SweepDocument<'a> {
    fn new(file: &Document, table: &'a Table<'a>, samples: &'a [Sample]) -> Result<Self, OutputError> {
        let first = samples.iter().find_map(|sample| sample.shape.as_deref());
        let scene = first.map(|(model, solution)| scene(model, solution)).transpose()?;
        let beside = first.map(|(model, _)| model).zip(scene.as_ref());
        let name = |axis: &Axis| axis.parameter.clone();
        Ok(Self {
            flexura: env!("CARGO_PKG_VERSION"),
            model: &table.model.name,
            study: "sweep",
            status: match () {
                () if samples.iter().any(is_interrupted) => "interrupted",
                () if samples.iter().all(|sample| sample.status.is_converged()) => "converged",
                () => "incomplete",
            },
            warnings: &table.known,
            vary: Named(table.axes.iter().map(|axis| (name(axis), axis.values.as_slice())).collect()),
            samples: samples
                .iter()
                .map(|sample| SampleDocument::new(table, sample, beside))
                .collect::<Result<_, _>>()?,
            scene: scene.map(|scene| SceneDocument { text: Some(file.text().to_owned()), ..scene }),
        })
    }
}

impl<'a> SampleDocument<'a> {
    fn new(
        table: &Table<'a>,
        sample: &'a Sample,
        first: Option<(&Model, &SceneDocument)>,
    ) -> Result<Self, OutputError> {
        let shape = sample.shape.as_deref();
        let (scene, loads) = match (first, shape) {
            (Some((first, scene)), Some((model, solution))) => {
                match scene_beside(scene, model, solution)? {
                    Some(scene) => (Some(scene), Named::default()),
                    None => (None, loads(first, model)?),
                }
            }
            _ => (None, Named::default()),
        };
        let model = table.model;
        let output_name = |position: usize| model.outputs[position].name.clone();
        let value = |output: &OutputResult| match output.value {
            OutputValue::Number(value) => Value::Number(value),
            OutputValue::Vector(values) => Value::Vector(values),
        };
        let outputs = sample.outputs.iter().enumerate();
        let names = table.axes.iter().map(|axis| axis.parameter.clone());
        Ok(Self {
            parameters: Named(names.zip(sample.values.iter().copied()).collect()),
            status: sample.status.word(),
            reason: sample.reason.as_deref(),
            warnings: table.own_warnings(sample),
            unknowns: (!sample.found.is_empty()).then(|| {
                let names = model.unknowns.iter().map(|u| model.parameters[u.parameter].name.clone());
                Named(names.zip(sample.found.iter().copied()).collect())
            }),
            outputs: Named(outputs.map(|(i, output)| (output_name(i), output.as_ref().map(value))).collect()),
            output_reasons: Named(
                sample.output_reasons.iter().map(|(i, reason)| (output_name(*i), reason.as_str())).collect(),
            ),
            stable: sample.unstable_directions.map(|count| count == 0),
            unstable_directions: sample.unstable_directions,
            energy: sample.energy,
            error_estimate: sample.error_estimate,
            shape: shape.map(|(model, solution)| shape_of(model, solution)).transpose()?,
            scene,
            loads,
        })
    }
}
