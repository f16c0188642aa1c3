//! A number along a path of equilibria: where it is greatest or least, or at a fold.
//!
//! Within a range of the path's parameter p the greatest value stands where ∂g/∂p = 0, so that it changes with a design parameter x
//! as g itself at fixed p does: d max g/dx = ∂g/∂x. The place is found by the secant method on the exact ∂g/∂p, from the point of the
//! path at which g is greatest; at an end of the range p is fixed anyway. Where that point is not found again, as beside a branch
//! point, the path is followed again with five places about it, through which a polynomial of degree four has its top, and for
//! neighbouring designs at the place of the top: differences of order six. So it is at a fold, and where a branch ends otherwise.

use crate::evaluate::{READING, at_equilibrium};
use flexura_expression::Formula;
use flexura_model::{Model, Output, Probe, ProbeTarget, Quantity, Stop, Target, TraceStudy, Varied, Wanted};
use flexura_solution::{DesignWork, PointKind, Solution, Status, Trace, TracePoint};
use flexura_study::{Evaluator, Options};
use std::cell::RefCell;
use std::rc::Rc;

/// Samples of the states from which a point between two others is found.
const SHAPES: usize = 31;
/// Most steps to it, and how near it is wanted, relative to the range.
const STEPS: usize = 25;
const NEAR: f64 = 1e-10;
/// What a further step would gain, relative to the value, that is none; and what the round-off of slopes may hide.
const NOTHING: f64 = 1e-14;
const LITTLE: f64 = 1e-10;
/// Accuracy of the folds of which differences are taken, and the step of those relative to the parameter's size.
const FOLD_ACCURACY: f64 = 1e-11;
const STEP: f64 = 1e-2;
/// Distance of the places about a top, relative to that of the points of the path beside it.
const ABOUT: f64 = 0.1;
/// Places and weights of central differences of order six.
const SIXTH: [(f64, f64); 6] =
    [(1.0, 0.75), (-1.0, -0.75), (2.0, -0.15), (-2.0, 0.15), (3.0, 1.0 / 60.0), (-3.0, -1.0 / 60.0)];

/// A path that several numbers are read along.
pub(crate) struct SharedPath {
    /// Its outputs are these numbers.
    model: Model,
    /// What they are, as the file writes it.
    names: Vec<String>,
    study: TraceStudy,
    options: Options,
    /// The path that was followed last.
    last: Option<Followed>,
}

/// For which values, how accurately, and what came out.
type Followed = (Vec<(usize, f64)>, f64, Rc<Result<Trace, String>>);

impl SharedPath {
    /// The path of a study, cut off at the fold that is wanted.
    pub fn new(model: &Model, trace: &TraceStudy, point: Wanted, options: &Options) -> Self {
        let study = asked(trace, point);
        let options = Options { shapes: SHAPES, samples: SHAPES, ..options.clone() };
        let model = Model { outputs: Vec::new(), ..model.clone() };
        Self { model, names: Vec::new(), study, options, last: None }
    }

    /// Is it the path of this study?
    pub fn is_of(&self, trace: &TraceStudy, point: Wanted) -> bool {
        self.study == asked(trace, point)
    }

    fn add(&mut self, output: &Output) -> usize {
        // The text of a formula is no name that an output can have.
        let name = format!("{READING}_{}", self.names.len());
        self.model.outputs.push(Output { name, ..output.clone() });
        self.names.push(output.name.clone());
        self.names.len() - 1
    }

    fn follow(
        &mut self,
        given: &[(usize, f64)],
        tolerance: f64,
        work: &mut DesignWork,
    ) -> Rc<Result<Trace, String>> {
        if let Some((values, accuracy, path)) = &self.last
            && values == given
            && *accuracy == tolerance
        {
            return path.clone();
        }
        work.paths += 1;
        let options = Options { tolerance, ..self.options.clone() };
        let path = Rc::new(self.trace(given, &self.study, &options));
        self.last = Some((given.to_vec(), tolerance, path.clone()));
        path
    }

    fn trace(&self, given: &[(usize, f64)], study: &TraceStudy, options: &Options) -> Result<Trace, String> {
        let model = self.model.at(given).map_err(|issue| issue.message)?;
        if let Some(issue) = model.validate_mechanism().into_iter().next() {
            return Err(format!("{} {}", issue.path, issue.message));
        }
        let trace =
            flexura_study::trace(&model, study, options, &mut |_| {}).map_err(|error| error.message)?;
        match trace.status {
            Status::Converged => Ok(trace),
            status => Err(trace.reason.unwrap_or_else(|| status.word().to_string())),
        }
    }
}

fn asked(trace: &TraceStudy, point: Wanted) -> TraceStudy {
    let mut trace =
        TraceStudy { branches: 0, guesses: 0, imperfection: None, critical: None, ..trace.clone() };
    trace.events.clear();
    if let Wanted::Fold(number) = point {
        trace.stops = vec![Stop::Fold(number)];
    }
    trace
}

/// One number along one path.
pub(crate) struct PathReading {
    path: Rc<RefCell<SharedPath>>,
    /// Position among the outputs of the path.
    column: usize,
    /// The model with this number as its only output.
    model: Model,
    names: Vec<String>,
    trace: TraceStudy,
    point: Wanted,
    vary: Vec<usize>,
    /// Of the ranges of what is varied.
    widths: Vec<f64>,
    options: Options,
    /// Made at the first point that is looked for.
    evaluator: Option<Evaluator>,
}

/// Where a number is read.
enum Place {
    /// At this value of the path's parameter, with derivatives.
    Fixed(f64, Vec<f64>),
    /// At this value of the path's parameter, found again on the path alone.
    Along { value: f64, at: f64, arc: f64 },
    /// At a fold, or where a branch ends.
    Special(f64),
}

impl PathReading {
    pub fn new(
        path: Rc<RefCell<SharedPath>>,
        output: &Output,
        point: Wanted,
        vary: &[Varied],
        options: &Options,
    ) -> Self {
        let column = path.borrow_mut().add(output);
        let (mut model, trace) = (path.borrow().model.clone(), path.borrow().study.clone());
        model.outputs = vec![Output { name: READING.to_string(), ..output.clone() }];
        let names = vec![output.name.clone()];
        let options = options.clone();
        let widths = vary.iter().map(|varied| varied.range[1] - varied.range[0]).collect();
        let vary = vary.iter().map(|varied| varied.parameter).collect();
        Self { path, column, model, names, trace, point, vary, widths, options, evaluator: None }
    }

    /// The number, and its derivatives by the varied parameters where they are wanted.
    ///
    /// # Errors
    /// The path has no such point, or does not get to its end.
    pub fn read(
        &mut self,
        given: &[(usize, f64)],
        slopes: bool,
        work: &mut DesignWork,
    ) -> Result<(f64, Option<Vec<f64>>), String> {
        match self.place(given, self.options.tolerance, work)? {
            Place::Fixed(value, rates) => Ok((value, Some(rates))),
            Place::Along { value, at, arc } if slopes => {
                let place = Some((at, arc));
                let rates = (0..given.len()).map(|k| self.difference(given, k, place, work));
                Ok((value, Some(rates.collect::<Result<_, _>>()?)))
            }
            Place::Special(value) if slopes => {
                let rates = (0..given.len()).map(|k| self.difference(given, k, None, work));
                Ok((value, Some(rates.collect::<Result<_, _>>()?)))
            }
            Place::Along { value, .. } | Place::Special(value) => Ok((value, None)),
        }
    }

    /// The derivative by the k-th varied parameter by differences of order six, at a place of the path or where the number is special.
    fn difference(
        &mut self,
        given: &[(usize, f64)],
        k: usize,
        along: Option<(f64, f64)>,
        work: &mut DesignWork,
    ) -> Result<f64, String> {
        let size = given[k].1.abs();
        let h = STEP * if size > 0.0 { size } else { self.widths[k] };
        let mut slope = 0.0;
        for (place, weight) in SIXTH {
            let mut beside = given.to_vec();
            beside[k].1 += place * h;
            let value = match along {
                Some((at, arc)) => self.met(&beside, &[at], arc, work)?[0],
                None => match self.place(&beside, FOLD_ACCURACY.min(self.options.tolerance), work)? {
                    Place::Fixed(value, _) | Place::Along { value, .. } | Place::Special(value) => value,
                },
            };
            slope += weight / h * value;
        }
        Ok(slope)
    }

    fn place(
        &mut self,
        given: &[(usize, f64)],
        tolerance: f64,
        work: &mut DesignWork,
    ) -> Result<Place, String> {
        let parameter = self.model.parameters[self.trace.parameter].name.clone();
        let along = |reason: String| format!("along `{parameter}`: {reason}");
        let followed = self.path.borrow_mut().follow(given, tolerance, work);
        let trace = followed.as_ref().as_ref().map_err(|reason| along(reason.clone()))?;
        let value_of = |point: &TracePoint| value_of(point, self.column);
        let points = trace.branches.first().map_or(&[][..], |branch| &branch.points);
        if let Wanted::Fold(number) = self.point {
            let fold = points.iter().filter(|point| point.kind == PointKind::Fold).nth(number - 1);
            let fold = fold.ok_or_else(|| along(format!("the path has no fold {number}")))?;
            return value_of(fold).map(Place::Special).map_err(along);
        }
        let sign = if self.point == Wanted::Least { -1.0 } else { 1.0 };
        let values: Vec<f64> = points.iter().map(value_of).collect::<Result<_, _>>().map_err(along)?;
        let top = (0..values.len()).max_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b])));
        let top = top.ok_or_else(|| along("the path has no points".to_string()))?;
        if points[top].kind == PointKind::Fold {
            return Ok(Place::Special(values[top]));
        }
        let at = |i: usize| points[i].parameter;
        let is_end = top == 0 || top + 1 == points.len();
        let range = self.trace.range;
        let is_range_end =
            range.iter().any(|end| (at(top) - end).abs() <= 1e-9 * (range[1] - range[0]).abs());
        let is_start = at(top) == self.trace.start;
        let between = !is_end && (at(top + 1) - at(top)) * (at(top) - at(top - 1)) > 0.0;
        if !(between || (is_end && (is_range_end || is_start))) {
            return Ok(Place::Special(values[top]));
        }
        let bracket = between.then(|| [at(top - 1), at(top + 1)]);
        let guess = bracket.map(|_| vertex([0, 1, 2].map(|i| (at(top + i - 1), values[top + i - 1]))));
        // A branch point itself is not found again; the point next to it is.
        let is_plain = |i: &usize| !matches!(points[*i].kind, PointKind::Branch(_));
        let near = [top, top.saturating_sub(1), (top + 1).min(points.len() - 1)].into_iter().find(is_plain);
        let near = near.unwrap_or(top);
        let refined = self.refine(given, &points[near], values[near], bracket.zip(guess), sign);
        match (refined, bracket.zip(guess)) {
            (Err(_), Some((bracket, guess))) if !self.options.interrupt.is_raised() => {
                self.about(given, bracket, guess, points[top].arc, work)
            }
            (Err(_), None) if !self.options.interrupt.is_raised() => {
                Ok(Place::Along { value: values[top], at: at(top), arc: points[top].arc })
            }
            (refined, _) => refined,
        }
    }

    /// The top of the polynomial through five places of the path about a guess.
    fn about(
        &mut self,
        given: &[(usize, f64)],
        [low, high]: [f64; 2],
        mut at: f64,
        arc: f64,
        work: &mut DesignWork,
    ) -> Result<Place, String> {
        let mut step = ABOUT * (high - low).abs();
        let range = self.trace.range;
        let (least, most) = (range[0].min(range[1]), range[0].max(range[1]));
        let mut value = f64::NAN;
        for _ in 0..2 {
            at = at.clamp(least + 2.0 * step, most - 2.0 * step);
            let places = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|place| at + place * step);
            let found = self.met(given, &places, arc, work)?;
            let (place, top) = top_of(&found);
            (at, value) = (at + place * step, top);
            step *= 0.5;
        }
        Ok(Place::Along { value, at, arc })
    }

    /// The number at values of the path's parameter, each where the path passes it nearest to a place along it.
    fn met(
        &mut self,
        given: &[(usize, f64)],
        places: &[f64],
        arc: f64,
        work: &mut DesignWork,
    ) -> Result<Vec<f64>, String> {
        work.paths += 1;
        let component = self.trace.parameter;
        let probe = Probe { target: ProbeTarget::Model, quantity: Quantity::Parameter, component };
        let own = Output {
            name: READING.to_string(),
            unit: String::new(),
            formulas: vec![Formula::slot(0)],
            probes: vec![probe],
        };
        let events = places.iter().map(|value| Target { output: own.clone(), value: *value }).collect();
        let study = TraceStudy { events, ..self.trace.clone() };
        let tolerance = FOLD_ACCURACY.min(self.options.tolerance);
        let path = self.path.borrow();
        let trace = path.trace(given, &study, &Options { tolerance, shapes: 0, ..path.options.clone() })?;
        let points = trace.branches.first().map_or(&[][..], |branch| &branch.points);
        let at = |event: usize| {
            let there = points.iter().filter(|point| point.kind == PointKind::Event(event));
            let near = there.min_by(|a, b| (a.arc - arc).abs().total_cmp(&(b.arc - arc).abs()));
            near.ok_or_else(|| format!("the path does not pass {}", places[event]))
                .and_then(|point| value_of(point, self.column))
        };
        (0..places.len()).map(at).collect()
    }

    /// The top between two points of the path, with its derivatives; without a bracket, the point itself.
    fn refine(
        &mut self,
        given: &[(usize, f64)],
        point: &TracePoint,
        value: f64,
        between: Option<([f64; 2], f64)>,
        sign: f64,
    ) -> Result<Place, String> {
        let from = point.solution.as_deref().or(point.shape.as_deref());
        let from: &Solution = from.ok_or("a point of the path kept no state")?;
        let p = self.trace.parameter;
        if self.evaluator.is_none() {
            let mut parameters = self.vary.clone();
            parameters.push(p);
            let mut model = self.model.clone();
            model.set(given).map_err(|issue| issue.message)?;
            let made = Evaluator::new(&model, &parameters, self.options.tolerance);
            let mut made = made.map_err(|error| error.message)?;
            made.heed(&self.options.interrupt);
            made.go_in_parts();
            self.evaluator = Some(made);
        }
        let evaluator = self.evaluator.as_mut().ok_or("no equilibrium")?;
        let with = |at: f64| given.iter().copied().chain([(p, at)]).collect::<Vec<_>>();
        let stands = evaluator.stand(&with(point.parameter), from).map_err(|error| error.message)?;
        if !stands {
            return Err(format!("a point of the path cannot be found again at {}", point.parameter));
        }
        let mut read = |at: f64| -> Result<(f64, Vec<f64>, f64), String> {
            let (values, slopes) = at_equilibrium(evaluator, &with(at), true, &self.names)?;
            let (value, mut slopes) = (values[0], slopes.into_iter().next().unwrap_or_default());
            let along = slopes.pop().unwrap_or(0.0);
            Ok((value, slopes, along))
        };
        let first = read(point.parameter)?;
        if (first.0 - value).abs() > 1e-5 * value.abs().max(1e-30) {
            return Err("beside the path another equilibrium was found".to_string());
        }
        let Some(([low, high], guess)) = between else { return Ok(Place::Fixed(first.0, first.1)) };
        let (mut a, mut b) = ((point.parameter, first), (guess, read(guess)?));
        let width = (high - low).abs();
        for _ in 0..STEPS {
            // The better of the two is kept as the one to go on from.
            if b.1.2.abs() > a.1.2.abs() {
                std::mem::swap(&mut a, &mut b);
            }
            let bend = (b.1.2 - a.1.2) / (b.0 - a.0);
            let step = -b.1.2 / bend;
            let gain = (0.5 * step * b.1.2).abs();
            if b.1.2 == 0.0 || step.abs() <= NEAR * width || gain <= NOTHING * b.1.0.abs() {
                break;
            }
            if sign * bend >= 0.0 || !step.is_finite() {
                // Round-off of the slopes: what is left to be gained is known from the width.
                if 0.5 * b.1.2.abs() * (b.0 - a.0).abs() <= LITTLE * b.1.0.abs() {
                    break;
                }
                return Err("the greatest value between points of the path cannot be told".to_string());
            }
            let next = (b.0 + step).clamp(low.min(high), low.max(high));
            a = std::mem::replace(&mut b, (next, read(next)?));
            if a.0 == b.0 {
                break;
            }
        }
        Ok(Place::Fixed(b.1.0, b.1.1))
    }
}

/// Where the polynomial through values at -2, -1, 0, 1, 2 has its stationary point nearest to the middle, and its value there.
fn top_of(values: &[f64]) -> (f64, f64) {
    let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|i| values.get(i).copied().unwrap_or(f64::NAN));
    let first = (a - 8.0 * b + 8.0 * d - e) / 12.0;
    let second = (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / 24.0;
    let third = (-a + 2.0 * b - 2.0 * d + e) / 12.0;
    let fourth = (a - 4.0 * b + 6.0 * c - 4.0 * d + e) / 24.0;
    let mut x = 0.0;
    for _ in 0..20 {
        let slope = first + x * (2.0 * second + x * (3.0 * third + x * 4.0 * fourth));
        let bend = 2.0 * second + x * (6.0 * third + x * 12.0 * fourth);
        x = (x - slope / bend).clamp(-2.0, 2.0);
    }
    (x, c + x * (first + x * (second + x * (third + x * fourth))))
}

fn value_of(point: &TracePoint, column: usize) -> Result<f64, String> {
    let value = point.outputs.get(column).and_then(|output| output.as_ref()?.first().copied());
    value.ok_or_else(|| {
        let reason = point.output_reasons.first().map_or("no value", |(_, reason)| reason.as_str());
        format!("at {}: {reason}", point.parameter)
    })
}

/// Where the parabola through three points has its top, within them.
fn vertex([a, b, c]: [(f64, f64); 3]) -> f64 {
    let (before, after) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let bend = (after - before) / (0.5 * (c.0 - a.0));
    let slope = before + bend * 0.5 * (b.0 - a.0);
    let top = b.0 - slope / bend;
    let (low, high) = (a.0.min(c.0), a.0.max(c.0));
    // A top on the point itself would leave no secant.
    if top.is_finite() && top > low && top < high && top != b.0 { top } else { 0.5 * (b.0 + c.0) }
}
