//! The way from rest to the full load.
//!
//! The equilibrium that a user means is the one reached from rest under proportional load without passing a
//! fold. So the load is raised in steps, and each step must prove that it stays on the path: the predicted
//! point must lie close to the solution (a short first Newton correction) and Newton must contract at once
//! (Deuflhard, *Newton Methods for Nonlinear Problems*, section 5.2). A step that fails is halved, so that
//! Newton never jumps to another branch; a weak load passes both tests in one step. Prediction is by the
//! polynomial through the last points, up to order three, and the step length follows from how well it did.

use crate::System;

/// How carefully the path is followed.
#[derive(Clone, Copy, Debug)]
pub struct PathOptions {
    /// Size of the linear response that the first step may have.
    pub first_response: f64,
    /// Size of the first correction at which a step is refused.
    pub largest_correction: f64,
    /// Contraction of Newton at which a step is refused.
    pub largest_contraction: f64,
    /// Cosine between the first Newton step and that by the last point's tangent below which a step is refused.
    pub least_agreement: f64,
    /// Largest growth of [`System::phase`] in a step; less than π.
    pub largest_phase: f64,
    /// Size of the correction at which a point of the path is good enough to go on from.
    pub point_tolerance: f64,
    /// Largest turning (rad) of a prediction.
    pub largest_turning: f64,
    /// Shortest step in the load fraction; shorter means that the path goes no further.
    pub shortest_step: f64,
    /// Below this step, relative to the load fraction, a change of sign of det J is taken for a branch point that
    /// the path really passes; above, for a step that has left the path.
    pub crossing_step: f64,
    /// Size of the first correction, relative to the size of the predicted step, at which a step is refused.
    pub largest_deviation: f64,
    /// Most steps, taken and refused.
    pub steps: usize,
    /// Give up where det J keeps changing its sign, so that another method can look closer at what is passed there?
    pub leaves_crossings: bool,
    /// In so many steps the load fraction must grow by [`PathOptions::least_growth`], or the path counts as blocked.
    pub patience: usize,
    /// See [`PathOptions::patience`].
    pub least_growth: f64,
}

impl Default for PathOptions {
    fn default() -> Self {
        Self {
            first_response: 0.8,
            largest_correction: 0.7,
            largest_contraction: 0.4,
            least_agreement: 0.3,
            largest_phase: 2.5,
            point_tolerance: 1e-2,
            largest_turning: 1.0,
            shortest_step: 1e-10,
            crossing_step: 1e-6,
            largest_deviation: 0.5,
            steps: 5000,
            leaves_crossings: true,
            patience: 300,
            least_growth: 2e-3,
        }
    }
}

/// Where the path ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathEnd {
    /// At the full load.
    Complete,
    /// Before it.
    Blocked {
        /// Load fraction reached.
        load: f64,
        /// By what.
        by: Block,
    },
    /// The tangent has no inverse at the start.
    Singular,
}

/// What keeps a path from going on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// No shorter step was possible.
    Short,
    /// Steps across do not agree on the sign of det J: a branch point, or something steep.
    Crossing,
    /// Many steps led nearly nowhere.
    Slow,
    /// Too many steps.
    Steps,
    /// The system has done more work than it may.
    Work,
    /// Somebody asked for the end.
    Interrupted,
}

/// A first correction that is never too large: where the response is small for reasons of symmetry, curvature is
/// all there is, and the comparison of tangents guards against unstable branches nearby.
const SMALL: f64 = 0.03;

/// A correction too small for its direction to mean anything.
const SAME: f64 = 1e-9;

/// One try at a point of the path.
enum Try {
    Good {
        first: f64,
    },
    Far {
        first: f64,
    },
    NotContracting,
    Broken,
    /// The first step points away from that by the last point's tangent.
    Crossed,
    /// The sign of det J is another one than at the last point.
    Flipped,
}

/// Counts of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathWork {
    /// Steps taken.
    pub taken: usize,
    /// Steps refused.
    pub refused: usize,
    /// Load fraction at which det J first changed sign: a branch point.
    pub crossing: Option<f64>,
    /// Number of branch points that were passed, as far as they were seen.
    pub crossings: usize,
}

#[derive(Clone)]
struct Point {
    load: f64,
    state: Vec<f64>,
}

/// Refusals in a row, and how short steps have become by then beside the longest taken, from which such a path gives up too.
const REFUSALS: usize = 4;
const SHRUNK: f64 = 1e-3;

/// Sign changes of det J in a row from which a path that leaves them to others gives up.
const FLIPS: usize = 2;

/// Leads `system` from its solution at load 0, where its state must be, to load 1.
///
/// `progress(load, steps)` is called at each point reached.
pub fn follow(
    system: &mut impl System,
    options: &PathOptions,
    progress: &mut dyn FnMut(f64, usize),
) -> (PathEnd, PathWork) {
    let mut work = PathWork::default();
    let end = follow_on(system, 0.0, options, &mut work, progress);
    (end, work)
}

/// Leads `system` from its solution at the load fraction `from`, where its state must be, to load 1. Where the path is
/// blocked, the state is the last point that was reached.
pub fn follow_on(
    system: &mut impl System,
    from: f64,
    options: &PathOptions,
    work: &mut PathWork,
    progress: &mut dyn FnMut(f64, usize),
) -> PathEnd {
    let n = system.unknowns();
    let mut step = vec![0.0; n];
    let mut points: Vec<Point> = Vec::with_capacity(4);
    points.push(Point { load: from, state: snapshot(system) });
    let Some((response, mut orientation)) = first_response(system, &mut points[0], &mut step) else {
        return PathEnd::Singular;
    };
    if from == 0.0 {
        system.expect(&response);
    }
    let mut width = (options.first_response / system.size(&response)).min(1.0 - from);
    let mut slope = Some(response);
    let before = work.taken + work.refused;
    let (mut flips, mut flip_width) = (0, 0.0);
    let (mut refusals, mut longest) = (0, 0.0_f64);
    let mut mark = (before, from);

    while work.taken + work.refused < before + options.steps {
        let last = points[points.len() - 1].load;
        if last >= 1.0 {
            return PathEnd::Complete;
        }
        if work.taken + work.refused >= mark.0 + options.patience {
            if last < mark.1 + options.least_growth {
                return blocked(system, &points, options, Block::Slow);
            }
            mark = (work.taken + work.refused, last);
        }
        if system.is_exhausted() {
            return blocked(system, &points, options, Block::Work);
        }
        if system.is_interrupted() {
            return blocked(system, &points, options, Block::Interrupted);
        }
        let mut load = (last + width).min(1.0);
        let furthest = system.phase(last) + options.largest_phase;
        let phase = system.phase(load);
        if phase > furthest {
            // The phase grows like the square root of the load.
            load = (load * (furthest / phase).powi(2)).max(last + 0.01 * (load - last));
        }
        if points.len() == 1 && slope.is_none() {
            slope = tangent_at(system, &mut points[0], &mut step);
        }
        // The polynomial through the points, or the tangent, is exact to this power of the step.
        let order = if slope.is_some() { 1 } else { points.len() - 1 };
        // A prediction must not turn anything so far that the turning becomes ambiguous.
        for _ in 0..60 {
            match &slope {
                Some(slope) => step.iter_mut().zip(slope).for_each(|(s, r)| *s = (load - last) * r),
                None => predict(system, &points, load, &mut step),
            }
            let turning = system.turning(&step);
            if turning <= options.largest_turning {
                break;
            }
            load = last + (load - last) * (0.9 * options.largest_turning / turning).clamp(0.2, 0.95);
        }
        system.restore(&points[points.len() - 1].state);
        system.retract(&step);
        width = load - last;
        system.set_load(load);
        let may_cross = width <= options.crossing_step * load;
        let reach = options.largest_correction.min(options.largest_deviation * system.size(&step)).max(SMALL);
        let sign = (!may_cross).then_some(orientation);
        let outcome = try_point(system, options, sign, reach, &mut step);
        if matches!(outcome, Try::Good { .. }) && system.orientation() != orientation {
            orientation = system.orientation();
            work.crossing.get_or_insert(load);
            work.crossings += 1;
        }
        if matches!(outcome, Try::Flipped) {
            flips += 1;
            flip_width = if flips == 1 { width } else { flip_width };
            if options.leaves_crossings && flips >= FLIPS {
                work.refused += 1;
                return blocked(system, &points, options, Block::Crossing);
            }
        }
        let growth = match outcome {
            Try::Good { first } => {
                work.taken += 1;
                (refusals, longest) = (0, longest.max(width));
                if width >= flip_width {
                    flips = 0;
                }
                if system.renew() {
                    points.clear();
                    step = vec![0.0; system.unknowns()];
                    if system.linearise().is_err() {
                        return PathEnd::Blocked { load, by: Block::Short };
                    }
                } else if points.len() == 4 {
                    points.remove(0);
                }
                system.keep_tangent();
                points.push(Point { load, state: snapshot(system) });
                progress(load, work.taken);
                slope = None;
                width * (0.4 * reach / first.max(1e-12)).powf(1.0 / order.max(1) as f64).clamp(0.3, 6.0)
            }
            Try::Far { first } => {
                work.refused += 1;
                refusals += 1;
                width * (0.5 * reach / first).powf(1.0 / order.max(1) as f64).clamp(0.1, 0.6)
            }
            Try::NotContracting | Try::Broken | Try::Crossed | Try::Flipped => {
                work.refused += 1;
                refusals += 1;
                0.4 * width
            }
        };
        width = growth;
        let reached = &points[points.len() - 1];
        let short = options.leaves_crossings && refusals >= REFUSALS && width < SHRUNK * longest;
        if reached.load < 1.0 && (short || width < options.shortest_step) {
            return blocked(system, &points, options, Block::Short);
        }
        if reached.load < load {
            // Refused. Points far apart say little about a sharp bend; the tangent at the last point does.
            let newest = points.len() - 1;
            if slope.is_none() {
                slope = tangent_at(system, &mut points[newest], &mut step);
            }
            system.restore(&points[newest].state);
        }
    }
    if points[points.len() - 1].load >= 1.0 {
        return PathEnd::Complete;
    }
    blocked(system, &points, options, Block::Steps)
}

/// The end of a path at its last point, to which the system goes back; at one a few steps before, if another method is to go on
/// from there, for what blocks a path spoils the points next to it.
fn blocked(system: &mut impl System, points: &[Point], options: &PathOptions, by: Block) -> PathEnd {
    let first = options.leaves_crossings && by != Block::Interrupted;
    let reached = if first { &points[0] } else { &points[points.len() - 1] };
    system.set_load(reached.load);
    system.restore(&reached.state);
    PathEnd::Blocked { load: reached.load, by }
}

/// The tangent of the path at its first point, and the sign of det J there. None where J has no inverse.
fn first_response(system: &mut impl System, point: &mut Point, step: &mut [f64]) -> Option<(Vec<f64>, bool)> {
    if point.load > 0.0 {
        let slope = tangent_at(system, point, step)?;
        return Some((slope, system.orientation()));
    }
    // The response to a small part of the load is the tangent of the path at rest.
    let mut response = vec![0.0; step.len()];
    let orientation = rest_response(system, step, &mut response)?;
    Some((response, orientation))
}

/// The tangent of the path at rest, and the sign of det J there. None where J has no inverse.
fn rest_response(system: &mut impl System, step: &mut [f64], response: &mut [f64]) -> Option<bool> {
    const PART: f64 = 1e-4;
    system.set_load(0.0);
    system.linearise().ok()?;
    system.newton_step(step);
    system.keep_tangent();
    system.set_load(PART);
    system.residual().ok()?;
    system.newton_step(response);
    for (r, s) in response.iter_mut().zip(step.iter()) {
        *r = (*r - s) / PART;
    }
    system.size(response).is_finite().then(|| system.orientation())
}

/// The tangent of the path at a point, which is brought closer to the path by one Newton step on the way. None
/// where it cannot be had. Keeps the tangent of the equations there for comparison.
fn tangent_at(system: &mut impl System, point: &mut Point, step: &mut [f64]) -> Option<Vec<f64>> {
    let part = 1e-5 * point.load.max(1e-3);
    system.restore(&point.state);
    system.set_load(point.load);
    system.linearise().ok()?;
    system.newton_step(step);
    if system.size(step).is_nan() || system.size(step) > 0.1 {
        return None;
    }
    system.retract(step);
    system.keep_tangent();
    system.residual().ok()?;
    system.newton_step(step);
    point.state = snapshot(system);
    system.set_load(point.load + part);
    let beside = system.residual();
    system.set_load(point.load);
    beside.ok()?;
    let mut slope = vec![0.0; step.len()];
    system.newton_step(&mut slope);
    for (r, s) in slope.iter_mut().zip(step.iter()) {
        *r = (*r - s) / part;
    }
    system.size(&slope).is_finite().then_some(slope)
}

fn snapshot(system: &impl System) -> Vec<f64> {
    let mut state = Vec::new();
    system.store(&mut state);
    state
}

/// The step from the last point to the value at `load` of the polynomial through all points.
fn predict(system: &impl System, points: &[Point], load: f64, step: &mut [f64]) {
    let last = &points[points.len() - 1];
    let mut towards = vec![0.0; step.len()];
    step.fill(0.0);
    for (i, point) in points[..points.len() - 1].iter().enumerate() {
        // Lagrange's weight of this point; the last point is the origin and adds nothing.
        let weight: f64 = points
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != i)
            .map(|(_, other)| (load - other.load) / (point.load - other.load))
            .product();
        system.difference(&last.state, &point.state, &mut towards);
        for (out, t) in step.iter_mut().zip(&towards) {
            *out += weight * t;
        }
    }
}

/// Newton from the predicted point. With a `sign` that det J must have, its first step must also agree in direction with the
/// step by the tangent of the last point: between two points of one path the tangent changes little, but where an
/// eigenvalue has changed sign in between, the two steps point away from each other. Unlike the sign of the
/// determinant this also sees two eigenvalues that change sign together, as they do for a round column.
fn try_point(
    system: &mut impl System,
    options: &PathOptions,
    sign: Option<bool>,
    reach: f64,
    step: &mut [f64],
) -> Try {
    let mut first = None;
    let mut other = vec![0.0; if sign.is_some() { step.len() } else { 0 }];
    for _ in 0..4 {
        if system.linearise().is_err() {
            return Try::Broken;
        }
        system.newton_step(step);
        let before = system.size(step);
        let first = *first.get_or_insert(before);
        if !before.is_finite() || first > reach {
            return Try::Far { first: if before.is_finite() { first } else { 1e3 } };
        }
        if sign.is_some_and(|sign| sign != system.orientation()) {
            return Try::Flipped;
        }
        if other.len() == step.len() && before > SAME {
            system.kept_step(&mut other);
            let along = system.product(step, &other);
            let lengths = (system.product(step, step) * system.product(&other, &other)).sqrt();
            if along.is_nan() || along < options.least_agreement * lengths {
                return Try::Crossed;
            }
            other.clear();
        }
        system.retract(step);
        if before <= 0.1 * options.point_tolerance.min(0.2 * reach) {
            return Try::Good { first };
        }
        if system.residual().is_err() {
            return Try::Broken;
        }
        system.newton_step(step);
        let after = system.size(step);
        if after.is_nan() || after > options.largest_contraction * before {
            return Try::NotContracting;
        }
        system.retract(step);
        if after <= options.point_tolerance.min(0.2 * reach) {
            return Try::Good { first };
        }
    }
    Try::NotContracting
}

#[cfg(test)]
mod tests;
