//! The branches of a trace: the one from rest, those that it meets, and those that are searched for.

use super::leg::{FINER, First, Follower, Leg, Met};
use super::problem::{Axis, Traced};
use super::record::{Reader, without_value};
use super::{TraceProgress, critical, search};
use crate::{Family, ModelFamily, Options, Prepared, ProblemError};
use flexura_continuation::{Leaving, Problem, Refusal, Spread, WalkOptions, Walker, spread};
use flexura_model::{Model, Stop, StudyKind, TraceStudy};
use flexura_nonlinear::{NewtonOptions, System, converge};
use flexura_solution::{Branch, BranchEnd, BranchOrigin, PointKind, Status, Trace, TraceWork};
use std::collections::VecDeque;

/// A critical point of a branch, for later.
pub(crate) struct Known {
    pub branch: usize,
    pub at: usize,
    pub met: Met,
    /// Its branches have been followed, or need not be.
    pub done: bool,
}

/// All that a trace collects.
pub(crate) struct Collection {
    pub branches: Vec<Branch>,
    pub known: Vec<Known>,
    pub warnings: Vec<String>,
    /// Of the parameter, with a space before it.
    pub unit: String,
    pub work: TraceWork,
}

/// Two critical points are the same where their parameters agree to this part of the range.
const SAME: f64 = 1e-6;

/// Follows equilibria as a parameter changes: from rest, on to the ends of the range, with the folds, branch points and
/// events on the way, and, if asked for, the branches that cross it.
///
/// # Errors
/// A model that describes no solvable mechanism, or an inverse problem.
pub fn trace(
    model: &Model,
    study: &TraceStudy,
    options: &Options,
    progress: &mut dyn FnMut(TraceProgress<'_>),
) -> Result<Trace, ProblemError> {
    trace_family(model, &mut ModelFamily::new(model), study, options, progress)
}

/// [`trace`] where something else than the model's own rules makes the models with other values of its parameters.
///
/// # Errors
/// As [`trace`].
pub fn trace_family(
    model: &Model,
    family: &mut dyn Family,
    study: &TraceStudy,
    options: &Options,
    progress: &mut dyn FnMut(TraceProgress<'_>),
) -> Result<Trace, ProblemError> {
    super::check_study(model, StudyKind::Trace(study.clone()))?;
    let span = study.range[1] - study.range[0];
    let axis = Axis { parameter: study.parameter, origin: study.range[0], span };
    let mut watched = study.events.clone();
    watched.extend(study.stops.iter().filter_map(|stop| match stop {
        Stop::Value(target) => Some(target.clone()),
        _ => None,
    }));
    let samples =
        options.samples.min((MOST_SAMPLES / model.beams.len().max(1)).clamp(FEWEST_SAMPLES, KEPT_SAMPLES));
    let reader = Reader { watched, samples, shapes: options.shapes.min(samples), shaped: Default::default() };
    let start = family.model(&[(study.parameter, study.start)])?;
    let mut prepared = Prepared::new(&start)?;
    prepared.heed(&options.interrupt);
    prepared.problem.watch(reader.places());
    let outcome = prepared.solve(options.tolerance, &mut |_| {});
    let mut follower = Follower {
        study,
        events: study.events.len(),
        reader,
        tolerance: options.tolerance,
        progress,
        branch: 0,
        told: 0,
        interrupt: options.interrupt.clone(),
        missed: Default::default(),
        remarks: Default::default(),
    };
    let unit = match model.parameters[study.parameter].unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    let mut collection = Collection {
        branches: Vec::new(),
        known: Vec::new(),
        warnings: Vec::new(),
        unit,
        work: TraceWork::default(),
    };
    let parameter = &model.parameters[study.parameter];
    let mut trace = Trace {
        parameter: study.parameter,
        range: study.range,
        status: outcome.status,
        reason: outcome.reason.map(|reason| {
            format!("the path has no start, from rest to {} = {:.6e} {}: {reason}; or let it start at another value in its range",
                parameter.name, study.start, parameter.unit)
        }),
        warnings: prepared.problem.warnings().to_vec(),
        stability_reason: None,
        branches: Vec::new(),
        critical: None,
        work: TraceWork::default(),
    };
    if outcome.status != Status::Converged {
        return Ok(trace);
    }
    let second = critical::second_axis(study, axis);
    let at = [axis.scaled(study.start), second.scaled_or_zero(model)];
    let mut traced = Traced::new(prepared, family, [axis, second], at, study.critical.is_some());
    from_here(&mut traced, &mut follower, BranchOrigin::Rest, &mut collection);
    switch(&mut traced, &mut follower, study.branches, &mut collection);
    search::find(&mut traced, &mut follower, model, options, &mut collection);
    switch(&mut traced, &mut follower, study.branches, &mut collection);
    if let Some(wanted) = &study.critical {
        trace.critical = critical::follow(&mut traced, &mut follower, wanted, &mut collection);
    }
    let counts = traced.problem().counts();
    match traced.undecided.take() {
        Some(reason) if traced.by_motion => trace.warnings.push(crate::solve::by_motion(&reason)),
        reason => trace.stability_reason = reason,
    }
    trace.warnings.append(&mut collection.warnings);
    trace.work = TraceWork {
        points: collection.branches.iter().map(|branch| branch.points.len()).sum(),
        newton_steps: counts.newton_steps,
        factorisations: counts.factorisations,
        residuals: counts.residuals,
        inertias: counts.inertias,
        ..collection.work
    };
    trace.branches = collection.branches;
    trace.warnings.extend(without_value(&trace.branches));
    for (value, warning) in follower.remarks.take() {
        trace
            .warnings
            .push(format!("first where {} = {value:.6e}{}: {warning}", parameter.name, collection.unit));
    }
    if follower.missed.get() > 0 && !options.interrupt.is_raised() {
        trace.warnings.push(format!(
            "{} events or stops were passed but could not be placed; take more steps",
            follower.missed.get()
        ));
    }
    (trace.status, trace.reason) = verdict(&trace);
    if options.interrupt.is_raised() && trace.status != Status::Interrupted {
        // Between two branches, or in what is done beside them.
        (trace.status, trace.reason) = (Status::Interrupted, Some("interrupted".to_string()));
    }
    if study.critical.is_some() && trace.critical.is_none() && trace.status == Status::Converged {
        (trace.status, trace.reason) = (
            Status::Stalled,
            Some("there is no critical point to follow in a second parameter; widen the range".to_string()),
        );
    }
    Ok(trace)
}

/// Samples of all beams together, and of each at least, in a state that is kept.
const MOST_SAMPLES: usize = 20_000;
const FEWEST_SAMPLES: usize = 5;
const KEPT_SAMPLES: usize = 31;

/// The path's own limits.
pub(crate) fn walk_options(follower: &Follower<'_>) -> WalkOptions {
    let steps = follower.study.steps.max(2) as f64;
    WalkOptions {
        tolerance: (0.1 * follower.tolerance).clamp(1e-12, 1e-9),
        largest_parameter: 1.0 / steps,
        largest_change: (10.0 / steps).clamp(0.02, 0.3),
        ..WalkOptions::default()
    }
}

/// Follows the branch on which the problem stands, in the directions that lie inside the range.
pub(crate) fn from_here(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    origin: BranchOrigin,
    collection: &mut Collection,
) {
    follower.branch = collection.branches.len();
    let options = walk_options(follower);
    mesh(traced, follower.tolerance);
    let snapshot = traced.snapshot();
    let at = traced.parameters()[0];
    let mut legs: [Option<Leg>; 2] = [None, None];
    for (leg, direction) in legs.iter_mut().zip([-1.0, 1.0]) {
        let outside = if direction < 0.0 { at <= 1e-9 } else { at >= 1.0 - 1e-9 };
        if outside {
            continue;
        }
        traced.go_back(&snapshot);
        let walker = Walker::start(traced, options, direction);
        *leg = Some(match walker {
            Ok(mut walker) => follower.follow(traced, &mut walker, First::Start),
            Err(refusal) => Leg {
                points: Vec::new(),
                met: Vec::new(),
                end: follower.ended(BranchEnd::Stalled(match refusal {
                    Refusal::Parameter(why) => why,
                    Refusal::Broken(_) => "the tangent has no inverse at its start".to_string(),
                })),
                refused: 0,
            },
        });
    }
    let [minus, plus] = legs;
    match (minus, plus) {
        (Some(mut minus), Some(mut plus)) if !minus.points.is_empty() && !plus.points.is_empty() => {
            // The start was reported twice.
            minus.points.remove(0);
            minus.met.iter_mut().for_each(|met| met.at -= 1);
            if let Some(start) = plus.points.first_mut() {
                start.kind = PointKind::Regular;
            }
            add(origin, Some(minus), plus, None, collection);
        }
        (None, Some(leg)) | (Some(leg), None) => add(origin, None, leg, None, collection),
        (Some(minus), Some(plus)) => {
            let leg = if plus.points.is_empty() { minus } else { plus };
            add(origin, None, leg, None, collection);
        }
        (None, None) => {}
    }
}

/// Makes a mesh on which the present equilibrium has the wanted accuracy; the parameters stay.
fn mesh(traced: &mut Traced<'_>, tolerance: f64) {
    let mut accuracy = (tolerance * FINER).min(SYMMETRIC);
    for _ in 0..MESHES {
        traced.refine(accuracy);
        traced.problem().weigh();
        let newton = NewtonOptions { tolerance: 1e-11, iterations: 20, nearest: f64::INFINITY };
        converge(traced.problem(), &newton);
        let mut step = vec![0.0; traced.problem().unknowns()];
        if traced.problem().linearise().is_err() || traced.problem().mesh_correction(&mut step).is_err() {
            return;
        }
        let error = traced.problem().size(&step);
        if error <= tolerance || error.is_nan() {
            return;
        }
        accuracy *= (0.3 * tolerance / error).clamp(1e-4, 0.5);
    }
}

/// Accuracy of a mesh at least, whatever the tolerance: its error breaks symmetries, and what unfolds a branch point by ε moves paths near by
/// by ε to the power 1/3.
const SYMMETRIC: f64 = 2e-11;

/// Most meshes that are tried at the start of a branch.
const MESHES: usize = 6;

/// Joins two legs that leave the same point; `middle` is that point if neither of them has it.
fn add(
    origin: BranchOrigin,
    minus: Option<Leg>,
    plus: Leg,
    middle: Option<flexura_solution::TracePoint>,
    collection: &mut Collection,
) {
    let branch = collection.branches.len();
    let mut points = Vec::new();
    let mut met: Vec<Met> = Vec::new();
    let mut first = BranchEnd::Start;
    collection.work.refused += plus.refused;
    if let Some(minus) = minus {
        collection.work.refused += minus.refused;
        let count = minus.points.len();
        points.extend(minus.points.into_iter().rev());
        points.iter_mut().for_each(|point: &mut flexura_solution::TracePoint| point.arc = -point.arc);
        met.extend(minus.met.into_iter().map(|m| Met { at: count - 1 - m.at, ..m }));
        met.reverse();
        first = minus.end;
    }
    if let Some(middle) = middle {
        points.push(flexura_solution::TracePoint { arc: 0.0, ..middle });
    }
    let shift = points.len();
    points.extend(plus.points);
    met.extend(plus.met.into_iter().map(|m| Met { at: m.at + shift, ..m }));
    let start = points.first().map_or(0.0, |point| point.arc);
    points.iter_mut().for_each(|point| point.arc -= start);
    collection.branches.push(Branch { origin, points, ends: [first, plus.end] });
    for met in met {
        let mut done = met.fold;
        let branches = &mut collection.branches;
        for known in collection.known.iter_mut().filter(|known| !known.met.fold) {
            if same_point(branches, (known.branch, known.at), (branch, met.at)) {
                // Both branches through it are known by now; how they cross is seen best from the first.
                known.done = true;
                done = true;
                branches[branch].points[met.at].kind = branches[known.branch].points[known.at].kind.clone();
            }
        }
        collection.known.push(Known { branch, at: met.at, met, done });
    }
}

fn same_point(branches: &[Branch], a: (usize, usize), b: (usize, usize)) -> bool {
    if a == b {
        return false;
    }
    let (p, q) = (&branches[a.0].points[a.1], &branches[b.0].points[b.1]);
    let size =
        branches[a.0].points.iter().map(|point| (point.parameter - p.parameter).abs()).fold(0.0, f64::max);
    (p.parameter - q.parameter).abs() <= SAME * size.max(f64::MIN_POSITIVE)
        && match (&p.solution, &q.solution) {
            (Some(p), Some(q)) => crate::search::same(p, q),
            _ => false,
        }
}

/// Follows the branches that cross those known, and those that cross these, until there are no more or as many as wanted.
fn switch(traced: &mut Traced<'_>, follower: &mut Follower<'_>, most: usize, collection: &mut Collection) {
    let mut queue: VecDeque<usize> = (0..collection.known.len()).collect();
    let options = walk_options(follower);
    let switched = |collection: &Collection| {
        let is_switched = |branch: &&Branch| matches!(branch.origin, BranchOrigin::Switched { .. });
        collection.branches.iter().filter(is_switched).count()
    };
    while let Some(position) = queue.pop_front() {
        if collection.known[position].done {
            continue;
        }
        if switched(collection) >= most || follower.interrupt.is_raised() {
            return;
        }
        collection.known[position].done = true;
        let Known { branch, at, met, .. } = &collection.known[position];
        let (branch, at, met) = (*branch, *at, met.clone());
        let leaving = if met.kernel.len() > 1 {
            several(traced, &options, &met, branch, at, collection)
        } else {
            met.branches.iter().cloned().map(Leaving::from).collect()
        };
        for leaving in &leaving {
            follower.branch = collection.branches.len();
            let mut legs: Vec<Leg> = Vec::new();
            for sense in [-1.0, 1.0] {
                let Some(snapshot) = &met.snapshot else { continue };
                if legs.first().is_some_and(|leg| leg.end == BranchEnd::Closed) {
                    // A loop is one leg.
                    legs.push(Leg {
                        points: Vec::new(),
                        met: Vec::new(),
                        end: BranchEnd::Closed,
                        refused: 0,
                    });
                    continue;
                }
                traced.go_back(snapshot);
                let reading = follower.reader.read(traced);
                legs.push(match Walker::switch(traced, options, &met.point, leaving, sense) {
                    Ok(mut walker) => follower.follow(traced, &mut walker, First::Beyond(reading)),
                    Err(stall) => Leg {
                        points: Vec::new(),
                        met: Vec::new(),
                        end: follower.ended(super::ends::stalled(&stall)),
                        refused: 0,
                    },
                });
            }
            let before = collection.known.len();
            let middle = collection.branches[branch].points[at].clone();
            if let (Some(plus), Some(minus)) = (legs.pop(), legs.pop()) {
                add(
                    BranchOrigin::Switched { branch, point: at },
                    Some(minus),
                    plus,
                    Some(middle),
                    collection,
                );
            }
            queue.extend(before..collection.known.len());
        }
    }
}

/// The branches at a point where several directions become critical at once.
fn several(
    traced: &mut Traced<'_>,
    options: &WalkOptions,
    met: &Met,
    branch: usize,
    at: usize,
    collection: &mut Collection,
) -> Vec<Leaving> {
    let Some(snapshot) = &met.snapshot else { return Vec::new() };
    traced.go_back(snapshot);
    let value = collection.branches[branch].points[at].parameter;
    let place = format!(
        "{} directions give way at once where the parameter is {value:.6e}{}",
        met.kernel.len(),
        collection.unit
    );
    match spread(traced, options, &met.point, &met.kernel, &met.tangent) {
        Spread::Branches(found) if found.is_empty() => {
            collection.warnings.push(format!(
                "{place}, and no branch was found that leaves there; give a small imperfection to tell them apart"
            ));
            Vec::new()
        }
        Spread::Branches(found) => found,
        Spread::Family => {
            collection.warnings.push(format!(
                "{place}, and it may give way along any mixture of them, as something round does: none of these branches is followed; give \
                 sections two different stiffnesses, or a small imperfection, to choose one"
            ));
            Vec::new()
        }
    }
}

/// Converged where every branch ended as it should.
fn verdict(trace: &Trace) -> (Status, Option<String>) {
    for (i, branch) in trace.branches.iter().enumerate() {
        for end in &branch.ends {
            match end {
                BranchEnd::Stalled(why) => {
                    return (
                        Status::Stalled,
                        Some(format!("branch {} cannot be followed further: {why}", i + 1)),
                    );
                }
                BranchEnd::Interrupted => {
                    return (Status::Interrupted, Some(format!("interrupted on branch {}", i + 1)));
                }
                BranchEnd::PointLimit => {
                    return (
                        Status::IterationLimit,
                        Some(format!(
                            "branch {} has as many points as are allowed; raise `most_points` (`--most-points`)",
                            i + 1
                        )),
                    );
                }
                _ => {}
            }
        }
    }
    for end in trace.critical.iter().flat_map(|curve| &curve.ends) {
        if let BranchEnd::Stalled(why) = end {
            return (Status::Stalled, Some(format!("the critical curve ends before its range does: {why}")));
        }
    }
    (Status::Converged, None)
}
