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
        }
    }
}

/// Where the path ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathEnd {
    /// At the full load.
    Complete,
    /// Before it: no shorter step was possible.
    Stalled {
        /// Load fraction reached.
        load: f64,
    },
    /// Before it: too many steps.
    StepLimit {
        /// Load fraction reached.
        load: f64,
    },
    /// The tangent has no inverse at rest.
    SingularAtRest,
    /// Before it: somebody asked for the end.
    Interrupted {
        /// Load fraction reached.
        load: f64,
    },
}

/// A first correction that is never too large: where the response is small for reasons of symmetry, curvature is
/// all there is, and the comparison of tangents guards against unstable branches nearby.
const SMALL: f64 = 0.03;

/// A correction too small for its direction to mean anything.
const SAME: f64 = 1e-9;

/// One try at a point of the path.
enum Try {
    Good { first: f64 },
    Far { first: f64 },
    NotContracting,
    Broken,
    Crossed,
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
}

struct Point {
    load: f64,
    state: Vec<f64>,
}

/// Leads `system` from its solution at load 0, where its state must be, to load 1.
///
/// `progress(load, steps)` is called at each point reached.
pub fn follow(
    system: &mut impl System,
    options: &PathOptions,
    progress: &mut dyn FnMut(f64, usize),
) -> (PathEnd, PathWork) {
    let n = system.unknowns();
    let mut step = vec![0.0; n];
    let mut work = PathWork::default();
    let mut points: Vec<Point> = Vec::with_capacity(4);
    points.push(Point { load: 0.0, state: snapshot(system) });

    // The response to a small part of the load is the tangent of the path at rest.
    let mut response = vec![0.0; n];
    let mut orientation = match rest_response(system, &mut step, &mut response) {
        Some(orientation) => orientation,
        None if system.is_interrupted() => return (PathEnd::Interrupted { load: 0.0 }, work),
        None => return (PathEnd::SingularAtRest, work),
    };
    system.expect(&response);
    let mut width = (options.first_response / system.size(&response)).min(1.0);
    let mut slope = Some(response);

    while work.taken + work.refused < options.steps {
        let last = points[points.len() - 1].load;
        if last >= 1.0 {
            return (PathEnd::Complete, work);
        }
        if system.is_interrupted() {
            system.set_load(last);
            system.restore(&points[points.len() - 1].state);
            return (PathEnd::Interrupted { load: last }, work);
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
        let mut outcome = try_point(system, options, !may_cross, reach, &mut step);
        if matches!(outcome, Try::Good { .. }) && system.orientation() != orientation {
            if may_cross {
                orientation = system.orientation();
                work.crossing.get_or_insert(load);
            } else {
                outcome = Try::Crossed;
            }
        }
        let growth = match outcome {
            Try::Good { first } => {
                work.taken += 1;
                if system.renew() {
                    points.clear();
                    step = vec![0.0; system.unknowns()];
                    if system.linearise().is_err() {
                        return (PathEnd::Stalled { load }, work);
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
                width * (0.5 * reach / first).powf(1.0 / order.max(1) as f64).clamp(0.1, 0.6)
            }
            Try::NotContracting | Try::Broken | Try::Crossed => {
                work.refused += 1;
                0.4 * width
            }
        };
        width = growth;
        let reached = &points[points.len() - 1];
        if reached.load < 1.0 && width < options.shortest_step {
            let load = reached.load;
            system.set_load(load);
            system.restore(&reached.state);
            return (PathEnd::Stalled { load }, work);
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
    let reached = &points[points.len() - 1];
    system.set_load(reached.load);
    system.restore(&reached.state);
    (PathEnd::StepLimit { load: reached.load }, work)
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
    system.residual().ok()?;
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

/// Newton from the predicted point. With `compare`, its first step must agree in direction with the step by the
/// tangent of the last point: between two points of one path the tangent changes little, but where an
/// eigenvalue has changed sign in between, the two steps point away from each other. Unlike the sign of the
/// determinant this also sees two eigenvalues that change sign together, as they do for a round column.
fn try_point(
    system: &mut impl System,
    options: &PathOptions,
    compare: bool,
    reach: f64,
    step: &mut [f64],
) -> Try {
    let mut first = None;
    let mut other = vec![0.0; if compare { step.len() } else { 0 }];
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
        if compare && other.len() == step.len() && before > SAME {
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
