//! Bars on standard error while load stepping or a sweep takes its time.

use crate::quantity::quantity;
use flexura::model::{Output, Parameter, visible};
use flexura::{DesignProgress, MotionProgress, Progress, TraceProgress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Nobody wants to see a bar that is gone at once.
const PATIENCE: Duration = Duration::from_millis(500);
const TICKS: u64 = 1000;

/// Shows how far the load has come. Costs nothing until it has something to show.
pub struct Meter {
    started: Instant,
    is_wanted: bool,
    bar: Option<ProgressBar>,
}

impl Meter {
    pub fn new(is_quiet: bool) -> Self {
        Self { started: Instant::now(), is_wanted: !is_quiet && std::io::stderr().is_terminal(), bar: None }
    }

    pub fn update(&mut self, progress: Progress) {
        if !self.is_wanted || self.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(new_bar);
        bar.set_message(format!("step {}", progress.load_steps));
        bar.set_position((progress.load_fraction.clamp(0.0, 1.0) * TICKS as f64) as u64);
    }

    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{percent:>3} % of the load {bar:40} {msg}, {elapsed}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Shows how far the path of a trace has come; nobody knows how long it is.
pub struct TraceMeter<'a> {
    meter: Meter,
    parameter: &'a Parameter,
}

impl<'a> TraceMeter<'a> {
    pub fn new(is_quiet: bool, parameter: &'a Parameter) -> Self {
        Self { meter: Meter::new(is_quiet), parameter }
    }

    pub fn update(&mut self, progress: &TraceProgress<'_>) {
        if !self.meter.is_wanted || self.meter.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.meter.bar.get_or_insert_with(new_spinner);
        let value = quantity(progress.parameter, &self.parameter.unit, 4);
        let (name, points) = (visible(&self.parameter.name), progress.points);
        bar.set_message(format!("branch {}, {points} points, {name} = {value}", progress.branch + 1));
        bar.tick();
    }

    pub fn finish(self) {
        self.meter.finish();
    }
}

fn new_spinner() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Shows how far a motion in time has come.
pub struct MotionMeter(Meter);

impl MotionMeter {
    pub fn new(is_quiet: bool) -> Self {
        Self(Meter::new(is_quiet))
    }

    pub fn update(&mut self, progress: MotionProgress) {
        if !self.0.is_wanted || self.0.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.0.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(Some(progress.of as u64), ProgressDrawTarget::stderr());
            match ProgressStyle::with_template("{pos} of {len} times {bar:40} {msg}, {elapsed}") {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        bar.set_message(format!("t = {}", quantity(progress.time, "s", 4)));
        bar.set_position(progress.done as u64);
    }

    pub fn finish(self) {
        self.0.finish();
    }
}

/// Shows how far an optimisation has come; nobody knows how many steps it takes.
pub struct DesignMeter<'a> {
    meter: Meter,
    objective: &'a Output,
}

impl<'a> DesignMeter<'a> {
    pub fn new(is_quiet: bool, objective: &'a Output) -> Self {
        Self { meter: Meter::new(is_quiet), objective }
    }

    pub fn update(&mut self, progress: &DesignProgress) {
        if !self.meter.is_wanted || self.meter.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.meter.bar.get_or_insert_with(new_spinner);
        let value = quantity(progress.objective, &self.objective.unit, 5);
        let which = match progress.start + 1 {
            start if start <= progress.starts => format!("search {start} of {}", progress.starts),
            _ => "front".to_owned(),
        };
        let (step, designs) = (progress.iteration, progress.evaluations);
        bar.set_message(format!(
            "{which}, step {step}, {designs} designs, {} = {value}",
            visible(&self.objective.name)
        ));
        bar.tick();
    }

    pub fn finish(self) {
        self.meter.finish();
    }
}

/// Shows how many samples of a sweep are done; may be told by several threads at once.
pub struct Counter {
    bar: ProgressBar,
}

impl Counter {
    pub fn new(is_quiet: bool, samples: usize) -> Self {
        if is_quiet || !std::io::stderr().is_terminal() {
            return Self { bar: ProgressBar::hidden() };
        }
        let bar = ProgressBar::with_draw_target(Some(samples as u64), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{pos} of {len} samples {bar:40} {elapsed}, {eta} to go");
        Self { bar: style.map_or_else(|_| bar.clone(), |style| bar.clone().with_style(style)) }
    }

    pub fn count(&self) {
        self.bar.inc(1);
    }

    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}
