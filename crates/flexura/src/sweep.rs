//! Many solves of one model over a grid of its parameters.
//!
//! Every sample is a solve of its own, from rest, so that its numbers depend neither on its neighbours nor on how many
//! threads share the work.

use crate::expression::{Dimension, Expression, ExpressionError, Kind, split};
use crate::model::Model;
use crate::modelfile::{Document, suggestion};
use crate::post::{OutputResult, each_output};
use crate::solution::{Solution, Status};
use crate::{Options, solve_model};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A sweep of more samples than this is taken for a mistake.
const MOST_SAMPLES: usize = 10_000_000;

/// Sections of all shapes together, and of each beam in a shape at least and at most.
const MOST_SECTIONS: usize = 20_000;
const FEWEST_SECTIONS: usize = 5;
const SECTIONS: usize = 17;

/// One parameter of a sweep with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name of the parameter.
    pub parameter: String,
    /// Its SI unit as text.
    pub unit: String,
    /// SI.
    pub values: Vec<f64>,
    /// The unit in which they were typed, the SI unit where they were typed in several.
    pub typed_unit: String,
    /// The values in that unit.
    pub typed: Vec<f64>,
}

impl Axis {
    /// Reads `push=0 N:10 N:11` (from, to, how many, ends included) or `push=1 N,2 N,5 N` for a parameter of the model.
    ///
    /// # Errors
    /// One sentence that says what is wrong and what to write.
    pub fn parse(model: &Model, text: &str) -> Result<Self, String> {
        let Some((name, range)) = text.split_once('=') else {
            return Err(format!(
                "`{text}` says not what to vary: write push=\"0 N:10 N:11\" or push=\"1 N,2 N,5 N\""
            ));
        };
        let name = name.trim();
        let names: Vec<&str> = model.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let Some(position) = names.iter().position(|known| *known == name) else {
            let hint = suggestion(name, &names, "parameter");
            return Err(format!("there is no parameter `{name}` to vary; {hint}"));
        };
        if model.unknowns.iter().any(|unknown| unknown.parameter == position) {
            return Err(format!(
                "`{name}` is an unknown of the file, which every solve finds; vary another parameter"
            ));
        }
        let unit = &model.parameters[position].unit;
        let parts = |separator: char| split(range, separator).into_iter().map(|part| range[part].trim());
        match parts(':').collect::<Vec<_>>()[..] {
            [_] => {
                let texts: Vec<&str> = parts(',').collect();
                let values =
                    texts.iter().map(|text| number(name, unit, text)).collect::<Result<Vec<_>, _>>()?;
                let typed = common_unit(&texts);
                Ok(Self::of(name, unit, values, typed))
            }
            [from, to, count] => {
                let ends = [number(name, unit, from)?, number(name, unit, to)?];
                let count: usize = count
                    .parse()
                    .ok()
                    .filter(|count| (2..=MOST_SAMPLES).contains(count))
                    .ok_or_else(|| {
                        format!("`{count}` is no number of values for `{name}`: a whole number from 2 on is wanted")
                    })?;
                let Some((typed_unit, typed_ends)) = common_unit(&[from, to]) else {
                    return Ok(Self::of(name, unit, between(&ends, count), None));
                };
                let typed = between(&typed_ends, count);
                let si = |value: &f64| number(name, unit, &format!("{value:e} {typed_unit}"));
                let values = typed.iter().map(si).collect::<Result<Vec<_>, _>>()?;
                Ok(Self::of(name, unit, values, Some((typed_unit, typed))))
            }
            _ => Err(format!(
                "`{range}` is no range for `{name}`: write from, to and how many, as in {name}=\"0:1:11\""
            )),
        }
    }

    fn of(name: &str, unit: &str, values: Vec<f64>, typed: Option<(String, Vec<f64>)>) -> Self {
        let (typed_unit, typed) = typed.unwrap_or_else(|| (unit.to_owned(), values.clone()));
        Self { parameter: name.to_owned(), unit: unit.to_owned(), values, typed_unit, typed }
    }
}

/// `count` values from one end to the other in equal steps. Both ends are met exactly, and no value between them has
/// more than 15 digits, so that a third step of 1 mm is 3 mm and not 3.0000000000000004.
fn between(ends: &[f64], count: usize) -> Vec<f64> {
    let (from, to) = (ends[0], ends[1]);
    let last = (count - 1) as f64;
    let value = |i: usize| match i {
        0 => from,
        _ if i + 1 == count => to,
        _ => {
            let value = (from * (last - i as f64) + to * i as f64) / last;
            format!("{value:.14e}").parse().unwrap_or(value)
        }
    };
    (0..count).map(value).collect()
}

/// The unit that all of the texts have behind their number, and the numbers. None where they differ, or one is an
/// expression; a zero goes with any unit.
fn common_unit(texts: &[&str]) -> Option<(String, Vec<f64>)> {
    let mut unit: Option<&str> = None;
    let mut numbers = Vec::with_capacity(texts.len());
    for text in texts {
        let end = text.char_indices().map(|(i, c)| i + c.len_utf8()).rev().chain([0]).find(|end| {
            text[..*end].parse::<f64>().is_ok_and(f64::is_finite)
                && text[..*end].ends_with(|c: char| c.is_ascii_digit() || c == '.')
        })?;
        let number: f64 = text[..end].parse().ok()?;
        let own = text[end..].trim();
        numbers.push(number);
        match unit {
            _ if own.is_empty() && number == 0.0 => {}
            None => unit = Some(own),
            Some(known) if known == own => {}
            Some(_) => return None,
        }
    }
    let unit = unit.unwrap_or_default();
    // Nothing but a unit: `2*a` would be an expression.
    let is_unit = !unit.is_empty() && unit.chars().all(|c| !"+-()[],".contains(c));
    is_unit.then(|| (unit.to_owned(), numbers))
}

/// A number with an optional unit that fits the parameter's.
fn number(name: &str, unit: &str, text: &str) -> Result<f64, String> {
    let text = text.trim();
    let fail = |error: ExpressionError| format!("`{text}` is no value for `{name}`: {}", error.message);
    let unbound =
        |span: std::ops::Range<usize>| ExpressionError::new("only numbers and units can stand here", span);
    let evaluate =
        |text: &str| Expression::parse(text)?.evaluate(&mut |reference| Err(unbound(reference.span.clone())));
    let quantity = evaluate(text).map_err(fail)?;
    if !quantity.value.is_finite() {
        return Err(format!("`{text}` is no value for `{name}`: it is not finite"));
    }
    // A parameter declared without a unit takes any, as in the file.
    let wanted: Option<Dimension> = match evaluate(&format!("1 {unit}")) {
        Ok(one) if !unit.is_empty() => Some(one.kind.dimension()),
        _ => None,
    };
    match wanted {
        Some(wanted) if !quantity.kind.fits(&wanted) => Err(format!(
            "`{text}` is no value for `{name}`: expected {wanted}, found {}",
            match quantity.kind {
                Kind::Plain => Dimension::NUMBER,
                Kind::Of(dimension) => dimension,
            }
        )),
        _ => Ok(quantity.value),
    }
}

/// How one sample ended.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleStatus {
    /// As a solve ends.
    Solved(Status),
    /// These values make no sound model.
    InputError,
}

impl SampleStatus {
    /// The word that stands in tables and documents.
    pub fn word(&self) -> &'static str {
        match self {
            SampleStatus::Solved(status) => status.word(),
            SampleStatus::InputError => "input_error",
        }
    }

    /// Is there an equilibrium?
    pub fn is_converged(&self) -> bool {
        *self == SampleStatus::Solved(Status::Converged)
    }
}

/// One sample. Of one that did not converge everything but status and reason is empty.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Value of each varied parameter, SI.
    pub values: Vec<f64>,
    /// The same in the units in which they were typed.
    pub typed: Vec<f64>,
    /// How it ended.
    pub status: SampleStatus,
    /// Values of the model's unknowns, SI.
    pub found: Vec<f64>,
    /// One for each output of the model; None where it has no value.
    pub outputs: Vec<Option<OutputResult>>,
    /// Strain energy, J.
    pub energy: Option<f64>,
    /// Number of unstable directions; None where that is not decided.
    pub unstable_directions: Option<usize>,
    /// Its state with few samples and the model that it belongs to, where shapes were asked for.
    pub shape: Option<Box<(Model, Solution)>>,
    /// Estimated largest relative error.
    pub error_estimate: Option<f64>,
    /// Outputs without a value, by their positions, and why.
    pub output_reasons: Vec<(usize, String)>,
    /// Why it did not converge, or why an output has no value.
    pub reason: Option<String>,
    /// What to know though it went well.
    pub warnings: Vec<String>,
}

impl Sample {
    /// Is it what it would be if nobody asked for the end?
    fn is_whole(&self) -> bool {
        self.status != SampleStatus::Solved(Status::Interrupted) && self.output_reasons.is_empty()
    }
}

/// Makes a model again with other values (SI) of parameters, by their positions; an error is one sentence.
pub type Remake<'a> = dyn Fn(&[(usize, f64)]) -> Result<Model, String> + Sync + 'a;

/// A [`Remake`] by a file and what is overridden in it.
pub fn remake<'a>(
    file: &'a Document,
    overrides: &'a [(String, String)],
    model: &'a Model,
) -> impl Fn(&[(usize, f64)]) -> Result<Model, String> + Sync + 'a {
    move |values| {
        let mut overrides = overrides.to_vec();
        for (position, value) in values {
            let parameter = &model.parameters[*position];
            overrides.retain(|(name, _)| *name != parameter.name);
            // The shortest text that reads back as the same number, with the SI unit.
            overrides.push((parameter.name.clone(), format!("{value:e} {}", parameter.unit)));
        }
        file.model(&overrides).map_err(|report| {
            report.problems().first().map(|problem| told(&problem.path, &problem.message)).unwrap_or_default()
        })
    }
}

/// The full grid over some parameters of a model.
pub struct Sweep<'a> {
    model: &'a Model,
    /// Positions of the axes' parameters.
    varied: Vec<usize>,
    /// For parameters that decide of which parts the mechanism is made.
    remake: Option<&'a Remake<'a>>,
    axes: Vec<Axis>,
    options: Options,
    /// Some(n): every n-th sample keeps its shape.
    shapes: Option<usize>,
}

impl<'a> Sweep<'a> {
    /// All combinations of the axes' values, those of the last axis next to each other.
    ///
    /// # Errors
    /// One sentence: a parameter that is not there or is varied twice; too many samples.
    pub fn new(model: &'a Model, axes: Vec<Axis>, options: &Options) -> Result<Self, String> {
        let mut varied = Vec::with_capacity(axes.len());
        for axis in &axes {
            let name = &axis.parameter;
            let names: Vec<&str> = model.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
            let position = names.iter().position(|known| known == name).ok_or_else(|| {
                format!("there is no parameter `{name}` to vary; {}", suggestion(name, &names, "parameter"))
            })?;
            if varied.contains(&position) {
                return Err(format!("`{name}` is varied twice"));
            }
            varied.push(position);
        }
        let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.values.len()));
        match count {
            Some(count) if count <= MOST_SAMPLES => {}
            _ => return Err(format!("a sweep may have at most {MOST_SAMPLES} samples; take fewer values")),
        }
        // Only outputs are read, and every place that one asks for is sampled anyway.
        let options =
            Options { samples: 2, sensitivities: false, compliances: Vec::new(), ..options.clone() };
        Ok(Self { model, varied, remake: None, axes, options, shapes: None })
    }

    /// What makes the models where a varied parameter is [`crate::model::Parameter::is_structural`]: how often something is
    /// repeated, say, which whatever read the model knows.
    #[must_use]
    pub fn remade_by(mut self, remake: &'a Remake<'a>) -> Self {
        self.remake = Some(remake);
        self
    }

    /// Keeps shapes of the samples of a model with so many beams: of all of them, or evenly of so many that they do not fill the
    /// memory.
    pub fn with_shapes(mut self, beams: usize) -> Self {
        let sections = self.count() * beams.max(1);
        self.options.samples = (MOST_SECTIONS / sections).clamp(FEWEST_SECTIONS, SECTIONS);
        self.shapes = Some((sections * FEWEST_SECTIONS).div_ceil(MOST_SECTIONS).max(1));
        self
    }

    /// What is varied, the slowest first.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// How many samples there are.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// Solves all samples on `jobs` threads (None: as many as the machine has); `done` is called with each and its position in
    /// the grid, as they come. Where the options' flag is raised, those that are not solved by then are left as they are:
    /// [`Status::Interrupted`].
    ///
    /// # Errors
    /// The machine gives no threads.
    pub fn run(
        &self,
        jobs: Option<usize>,
        done: &(dyn Fn(usize, &Sample) + Sync),
    ) -> Result<Vec<Sample>, String> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(jobs.unwrap_or(0))
            .build()
            .map_err(|error| format!("cannot start threads: {error}"))?;
        // In the order of the grid, so that one that is ended has solved its beginning.
        let next = AtomicUsize::new(0);
        let samples: Vec<OnceLock<Sample>> = (0..self.count()).map(|_| OnceLock::new()).collect();
        pool.broadcast(|_| {
            loop {
                let position = next.fetch_add(1, Ordering::Relaxed);
                let Some(place) = samples.get(position).filter(|_| !self.options.interrupt.is_raised())
                else {
                    break;
                };
                let sample = self.sample(position);
                if self.options.interrupt.is_raised() && !sample.is_whole() {
                    break;
                }
                done(position, place.get_or_init(|| sample));
            }
        });
        let samples = samples.into_iter().enumerate();
        Ok(samples
            .map(|(position, sample)| sample.into_inner().unwrap_or_else(|| self.unsolved(position)))
            .collect())
    }

    /// Which of its values each axis has in a sample.
    fn places(&self, position: usize) -> Vec<usize> {
        let mut rest = position;
        let mut places: Vec<usize> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            places.push(rest % axis.values.len());
            rest /= axis.values.len();
        }
        places.reverse();
        places
    }

    /// A sample that nobody has looked at.
    fn unsolved(&self, position: usize) -> Sample {
        let places = self.places(position);
        let of = |values: fn(&Axis) -> &Vec<f64>| -> Vec<f64> {
            self.axes.iter().zip(&places).map(|(axis, place)| values(axis)[*place]).collect()
        };
        Sample {
            values: of(|axis| &axis.values),
            typed: of(|axis| &axis.typed),
            status: SampleStatus::Solved(Status::Interrupted),
            found: Vec::new(),
            outputs: Vec::new(),
            output_reasons: Vec::new(),
            energy: None,
            unstable_directions: None,
            shape: None,
            error_estimate: None,
            reason: None,
            warnings: Vec::new(),
        }
    }

    fn sample(&self, position: usize) -> Sample {
        let mut sample = Sample { status: SampleStatus::InputError, ..self.unsolved(position) };
        let values: Vec<(usize, f64)> =
            self.varied.iter().copied().zip(sample.values.iter().copied()).collect();
        let structural = |position: &usize| self.model.parameters[*position].is_structural;
        let model = match self.remake.filter(|_| self.varied.iter().any(structural)) {
            Some(remake) => remake(&values),
            None => self.model.at(&values).map_err(|issue| told(&issue.path, &issue.message)),
        };
        let model = match model {
            Ok(model) => model,
            Err(reason) => {
                sample.reason = Some(reason);
                return sample;
            }
        };
        let (solution, model) = match solve_model(&model, &self.options, &mut |_| {}) {
            Ok(solved) => solved,
            Err(error) => {
                sample.reason = Some(told(&error.path, &error.message));
                return sample;
            }
        };
        sample.status = SampleStatus::Solved(solution.status);
        sample.warnings.clone_from(&solution.warnings);
        if solution.status != Status::Converged {
            sample.reason = solution.reason;
            return sample;
        }
        sample.found = solution.found.iter().map(|(_, value)| *value).collect();
        for output in each_output(&model, &solution) {
            match output {
                Ok(output) => sample.outputs.push(Some(output)),
                Err(error) => {
                    sample.output_reasons.push((sample.outputs.len(), error.to_string()));
                    sample.reason.get_or_insert(error.to_string());
                    sample.outputs.push(None);
                }
            }
        }
        sample.energy = Some(solution.energy);
        sample.unstable_directions = solution.unstable_directions;
        sample.error_estimate = Some(solution.error_estimate);
        if self.shapes.is_some_and(|every| position.is_multiple_of(every)) {
            sample.shape = Some(Box::new((model, solution)));
        }
        sample
    }
}

fn told(path: &str, message: &str) -> String {
    if path.is_empty() { message.to_owned() } else { format!("{path}: {message}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameter;

    fn axis(text: &str) -> Result<Vec<f64>, String> {
        let parameter = |name: &str, unit: &str| Parameter {
            name: name.into(),
            value: 1.0,
            unit: unit.into(),
            ..Parameter::default()
        };
        let parameters = vec![parameter("push", "N"), parameter("turns", ""), parameter("slope", "rad")];
        Axis::parse(&Model { parameters, ..Model::default() }, text).map(|axis| axis.values)
    }

    #[test]
    fn ranges_meet_both_ends_and_lists_keep_their_order() {
        assert_eq!(axis("push=0.1:0.3:3").unwrap(), [0.1, 0.2, 0.3]);
        assert_eq!(axis(" push = 1 kN : -1 kN : 2 ").unwrap(), [1000.0, -1000.0]);
        assert_eq!(axis("push=3,min(1 N, 2 N),2 N").unwrap(), [3.0, 1.0, 2.0]);
        assert_eq!(axis("turns=1:5:5").unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert!((axis("slope=90 deg").unwrap()[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }

    #[test]
    fn values_are_kept_in_the_unit_that_was_typed_with_the_fewest_digits() {
        let parameter = |name: &str, unit: &str| Parameter {
            name: name.into(),
            value: 1.0,
            unit: unit.into(),
            ..Parameter::default()
        };
        let parameters = vec![parameter("length", "m"), parameter("slope", "rad"), parameter("turns", "")];
        let model = Model { parameters, ..Model::default() };
        let typed = |text: &str| Axis::parse(&model, text).map(|axis| (axis.typed_unit, axis.typed)).unwrap();
        assert_eq!(typed("length=1 mm:5 mm:5"), ("mm".into(), vec![1.0, 2.0, 3.0, 4.0, 5.0]));
        assert_eq!(typed("length=0.001:0.005:5").1, [0.001, 0.002, 0.003, 0.004, 0.005]);
        assert_eq!(typed("slope=0:90 deg:4"), ("deg".into(), vec![0.0, 30.0, 60.0, 90.0]));
        assert_eq!(typed("slope=10 deg,-2e1 deg"), ("deg".into(), vec![10.0, -20.0]));
        assert_eq!(typed("length=1 mm:1 cm:2"), ("m".into(), vec![0.001, 0.01]));
        assert_eq!(typed("length=1 mm,min(1 mm, 2 mm)").0, "m");
        assert_eq!(typed("turns=1:2:3"), (String::new(), vec![1.0, 1.5, 2.0]));
        let axis = Axis::parse(&model, "length=1 mm:5 mm:5").unwrap();
        assert_eq!(axis.values, [0.001, 0.002, 0.003, 0.004, 0.005]);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for text in [
            "push",
            "pull=1",
            "push=1:2",
            "push=1:2:1",
            "push=1:2:2.5",
            "push=1 m",
            "push=",
            "push=a",
            "push=1,,2",
        ] {
            assert!(axis(text).is_err(), "{text}");
        }
    }
}
