//! Branches that hang together with no other: found by pushes and deflation, or by leading an imperfection away.

use super::branches::{Collection, from_here};
use super::leg::Follower;
use super::problem::{Axis, Traced};
use crate::search::{equilibria, same};
use crate::{Options, Prepared};
use flexura_continuation::{Advance, Problem, WalkOptions, Walker};
use flexura_model::Model;
use flexura_solution::{Branch, BranchOrigin, PointKind, Status, TracePoint};

/// Seed of the pushes: the same trace finds the same branches.
const SEED: u64 = 1;
/// Where along the range an imperfection is led away, one after another until a branch is found.
const PLACES: [f64; 3] = [1.0, 0.75, 0.5];
/// Where an imperfection may lead to.
const KNOWN: &str = "it ends on a branch that is known";
/// Most steps with an imperfection.
const STEPS: usize = 4000;

/// Adds branches that are not among those known.
pub(crate) fn find(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    model: &Model,
    options: &Options,
    collection: &mut Collection,
) {
    if let Some((parameter, from)) = follower.study.imperfection {
        let mut told = Vec::new();
        for place in PLACES {
            if follower.interrupt.is_raised() {
                return;
            }
            match imperfection(traced, follower, model, (parameter, from), place, collection) {
                Ok(()) => {
                    told.clear();
                    break;
                }
                Err(why) => {
                    let is_known = why == KNOWN;
                    told.push(format!("at {:.6e}{}: {why}", traced.axes[0].value(place), collection.unit));
                    if is_known {
                        break;
                    }
                }
            }
        }
        if !told.is_empty() && !follower.interrupt.is_raised() {
            let name = &model.parameters[parameter].name;
            collection
                .warnings
                .push(format!("the imperfection `{name}` led to no further branch; {}", told.join("; ")));
        }
    }
    if follower.study.guesses > 0 {
        for end in [1.0, 0.0] {
            if follower.interrupt.is_raised() {
                return;
            }
            guesses(traced, follower, options, end, collection);
        }
    }
}

/// Is a state at one end of the range on a branch that is known?
fn is_known(
    collection: &Collection,
    (value, span): (f64, f64),
    solution: &flexura_solution::Solution,
) -> bool {
    collection.branches.iter().flat_map(|branch| &branch.points).any(|point| {
        (point.parameter - value).abs() <= 1e-9 * span.abs()
            && point.solution.as_ref().is_some_and(|other| same(other, solution))
    })
}

fn guesses(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    options: &Options,
    end: f64,
    collection: &mut Collection,
) {
    let parameters = [end, traced.parameters()[1]];
    let value = traced.axes[0].value(end);
    let Ok(model) = traced.model_at(parameters) else { return };
    // The samples of the branches' ends, so that states can be compared.
    let options = Options { samples: follower.reader.samples, ..options.clone() };
    let Ok(found) = equilibria(&model, &options, follower.study.guesses, SEED) else { return };
    for solution in found.iter().filter(|solution| solution.status == Status::Converged) {
        let Ok(mut prepared) = Prepared::new(&model) else { return };
        prepared.heed(&follower.interrupt);
        prepared.problem.watch(follower.reader.places());
        if prepared.solve_near(solution, options.tolerance).is_none() {
            continue;
        }
        let here = prepared.problem.solution(follower.reader.samples);
        if is_known(collection, (value, traced.axes[0].span), &here) {
            continue;
        }
        traced.take(prepared, parameters);
        from_here(traced, follower, BranchOrigin::Search, collection);
        drop_if_known(collection);
    }
}

/// With the imperfection the main parameter goes to a place in its range; there the imperfection is led to its own value;
/// the branch that this ends on is followed.
fn imperfection(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    model: &Model,
    (parameter, from): (usize, f64),
    place: f64,
    collection: &mut Collection,
) -> Result<(), String> {
    let own = model.parameters[parameter].value;
    if from == own {
        return Err("it starts at the value that it is to be led to".to_string());
    }
    let main = traced.axes[0];
    let aside = Axis { parameter, origin: from, span: own - from };
    let start = main.scaled(follower.study.start);
    let changed = traced.model_with(&[(main.parameter, follower.study.start), (parameter, from)])?;
    let mut prepared = Prepared::new(&changed).map_err(|error| error.message)?;
    prepared.heed(&follower.interrupt);
    prepared.problem.watch(follower.reader.places());
    let outcome = prepared.solve(follower.tolerance, &mut |_| {});
    if outcome.status != Status::Converged {
        return Err(outcome.reason.unwrap_or_default());
    }
    let second = traced.axes[1];
    let both = traced.both;
    let other = traced.parameters()[1];
    let kept = traced.exchange(prepared, [main, aside], [start, 0.0], true);
    let outcome = lead(traced, follower, place).and_then(|()| {
        let here = traced.prepared.clone();
        traced.exchange(here, [aside, main], [0.0, place], true);
        lead(traced, follower, 1.0)
    });
    let arrived = traced.prepared.clone();
    traced.exchange(kept, [main, second], [place, other], both);
    outcome?;
    // The same mechanism, with nothing left of the second parameter's change.
    let model = traced.model_at([place, other]).map_err(|_| "the model cannot be made again".to_string())?;
    let mut prepared = arrived;
    prepared.adopt(&model).map_err(|error| error.message)?;
    let finished = prepared.finish(follower.tolerance, flexura_nonlinear::PathWork::default(), 0.5);
    if finished.status != Status::Converged {
        return Err(finished.reason.unwrap_or_default());
    }
    let here = prepared.problem.solution(follower.reader.samples);
    if is_known(collection, (main.value(place), main.span), &here) {
        return Err(KNOWN.to_string());
    }
    traced.take(prepared, [place, other]);
    from_here(traced, follower, BranchOrigin::Imperfection, collection);
    if drop_if_known(collection) {
        return Err(KNOWN.to_string());
    }
    Ok(())
}

/// Takes the last branch away if it arrives at an end of the range where another one does.
fn drop_if_known(collection: &mut Collection) -> bool {
    let Some((last, others)) = collection.branches.split_last() else { return false };
    let arrives = |branch: &Branch| -> Vec<TracePoint> {
        let ends = [branch.points.first(), branch.points.last()];
        let at_end = |point: &&TracePoint| point.kind == PointKind::End && point.solution.is_some();
        ends.into_iter().flatten().filter(at_end).cloned().collect()
    };
    let own = arrives(last);
    let is_known = others.iter().flat_map(arrives).any(|other| {
        own.iter().any(|point| {
            let (Some(p), Some(q)) = (&point.solution, &other.solution) else { return false };
            let apart = (point.parameter - other.parameter).abs();
            apart <= 1e-9 * point.parameter.abs().max(1e-300) && same(p, q)
        })
    });
    if is_known {
        let dropped = collection.branches.len() - 1;
        collection.branches.pop();
        collection.known.retain(|known| known.branch != dropped);
    }
    is_known
}

/// Follows the first parameter to a value, whatever lies on the way.
fn lead(traced: &mut Traced<'_>, follower: &Follower<'_>, to: f64) -> Result<(), String> {
    let options = WalkOptions { tolerance: 1e-9, ..super::branches::walk_options(follower) };
    let from = traced.parameters()[0];
    let mut walker =
        Walker::start(traced, options, to - from).map_err(|_| "its path cannot be started".to_string())?;
    for _ in 0..STEPS {
        if let Advance::Stalled(_) = walker.advance(traced) {
            let value = traced.axes[0].value(walker.here().point.parameters[0]);
            return Err(format!("its path cannot be followed beyond {value:.6e} (SI)"));
        }
        let at = walker.here().point.parameters[0];
        if (at - to) * (from - to) <= 0.0 {
            walker.at_parameter(traced, to).map_err(|_| "its path's end is not found".to_string())?;
            return Ok(());
        }
        if (at - from) * (to - from) < 0.0 {
            return Err("its path turns back".to_string());
        }
        let tangent = traced.renew(&walker.here().tangent);
        if tangent.is_some() {
            walker.polish(traced, tangent).map_err(|_| "its path is lost".to_string())?;
        }
    }
    Err("its path is too long".to_string())
}
