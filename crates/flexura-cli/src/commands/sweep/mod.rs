//! `flexura sweep FILE --vary P=A:B:N`

mod document;
mod picture;
mod table;

use super::{file_failure, warn_about};
use crate::answer::json;
use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::files::{self, Growing};
use crate::progress::Counter;
use crate::shown::Shown;
use crate::{interrupt, screen};
use document::SweepDocument;
use flexura::model::visible;
use flexura::modelfile::Document;
use flexura::output::sweep_svg;
use flexura::solution::Status;
use flexura::{Axis, Interrupt, Options, Sample, SampleStatus, Sweep, remake};
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use table::Table;

pub fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let overrides = &arguments.model.overrides;
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let model = file.model(overrides).map_err(|report| file_failure(&report))?;
    let mut options = Options { interrupt: interrupt::listen(), ..Options::default() };
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }
    let axes = arguments.vary.iter().map(|text| Axis::parse(&model, text)).collect::<Result<Vec<_>, _>>();
    let axes = axes.map_err(Failure::Input)?;
    if let Some(both) = axes.iter().find(|axis| overrides.iter().any(|(set, _)| *set == axis.parameter)) {
        return Err(Failure::Input(format!("`{}` is both set and varied", both.parameter)));
    }
    let remake = remake(&file, overrides, &model);
    let mut sweep = Sweep::new(&model, axes, &options).map_err(Failure::Input)?.remade_by(&remake);
    let shown = Shown::new(&arguments.shown, false)?;
    if shown.wants_page() || arguments.model.json {
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
    deliver(arguments, &file, &table, &samples, (rows, &shown))
}

/// Writes the whole table, prints what is to be printed, and ends as the samples did.
fn deliver(
    arguments: &SweepArguments,
    file: &Document,
    table: &Table<'_>,
    samples: &[Sample],
    (rows, shown): (Rows, &Shown),
) -> Result<(), Failure> {
    let path = arguments.output.as_deref();
    let whole = || samples.iter().fold(table.header(), |text, sample| text + &table.row(sample));
    let unwritten = path.and_then(|path| files::replace(path, whole()).err());
    if unwritten.is_none() {
        rows.finish(samples, |sample| table.row(sample))?;
    }
    let mut text = None;
    if arguments.model.json || shown.wants_page() {
        let document = SweepDocument::new(file, table, samples);
        text = Some(json(&document.map_err(|error| Failure::Machine(error.to_string()))?)?);
    }
    if let (Some(text), true) = (&text, arguments.model.json) {
        screen::print_table(text)?;
    }
    let picture = shown.wants_picture().then(|| sweep_svg(&picture::view(table, samples)));
    let unwritten = unwritten.or(shown.write(text.as_deref(), picture.as_slice()).err());
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
    if !arguments.model.quiet {
        shown.tell();
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
