//! Branches that leave a point at which several directions become critical at once.
//!
//! How they leave is decided by as many equations as there are directions. These are not made; the path is pushed along many directions
//! of the kernel instead, and from each of them Newton's method goes in the plane across it to the branch that is nearest: every branch
//! that leaves at an angle below a right one to the push crosses that plane. Branches on which all directions take part draw Newton's
//! method most; those on which some stay out may be missed.

use crate::corrector::between;
use crate::problem::{Point, Problem, Tangent, slope};
use crate::walker::{WalkOptions, largest};
use flexura_nonlinear::System;

/// What the pushes found.
#[derive(Clone, Debug)]
pub enum Spread {
    /// Directions of the branches, each of which leaves both ways.
    Branches(Vec<Tangent>),
    /// So many that they form a family, as the directions in which a round column may bend do.
    Family,
}

/// Pushes around the circle of two directions.
const AROUND: usize = 12;
/// Most pushes where more than two directions are critical.
const MOST_PUSHES: usize = 80;
/// Length of a push, and of a change of the parameter with it, beside the largest step.
const LENGTH: f64 = 0.15;
/// A push that leads nowhere is halved once.
const WIDTHS: [f64; 2] = [1.0, 0.5];
/// Changes of the parameter: where branches leave on one side only, or lie as straight as the path, none is no start.
const SHIFTS: [f64; 3] = [0.0, 1.0, -1.0];
/// Newton steps of one push.
const STEPS: usize = 30;
/// How far from its push a branch may be found, beside the push.
const FARTHEST: f64 = 3.0;
/// Cosine of the angle between two directions that are one.
const SAME: f64 = 0.99;

/// Finds the branches at a point whose tangent vanishes along `kernel`, but for the path itself, which runs along `path`.
pub fn spread<P: Problem>(
    problem: &mut P,
    options: &WalkOptions,
    from: &Point,
    kernel: &[Vec<f64>],
    path: &Tangent,
) -> Spread {
    let mut known = vec![path.clone().normalised(problem.system())];
    let generic = (3_usize.saturating_pow(kernel.len() as u32) - 1) / 2;
    for shift in SHIFTS {
        for push in pushes(kernel.len()) {
            let mut across = vec![0.0; path.step.len()];
            for (weight, direction) in push.iter().zip(kernel) {
                across.iter_mut().zip(direction).for_each(|(a, d)| *a += weight * d);
            }
            let across = Tangent { step: across, parameter: 0.0 }.normalised(problem.system());
            let Some(direction) = pushed(problem, options, from, &across, shift) else { continue };
            let system = problem.system();
            let same =
                |other: &Tangent| other.product(system, &direction.step, direction.parameter).abs() > SAME;
            if !known.iter().any(same) {
                known.push(direction);
            }
            if known.len() > generic + 1 {
                return Spread::Family;
            }
        }
        if known.len() == generic + 1 {
            break;
        }
    }
    Spread::Branches(known.split_off(1))
}

/// Weights of the kernel's directions: around the circle of two, else all of -1, 0, 1 with few of them not zero first.
fn pushes(count: usize) -> Vec<Vec<f64>> {
    if count == 2 {
        let angle = |i: usize| std::f64::consts::TAU * (i as f64 + 0.25) / (AROUND as f64);
        return (0..AROUND).map(|i| vec![angle(i).cos(), angle(i).sin()]).collect();
    }
    let mut all: Vec<Vec<f64>> = vec![Vec::new()];
    for _ in 0..count.min(7) {
        all = all
            .iter()
            .flat_map(|start| [0.0, 1.0, -1.0].map(|w| start.iter().copied().chain([w]).collect()))
            .collect();
    }
    let used = |push: &Vec<f64>| push.iter().filter(|w| **w != 0.0).count();
    all.retain(|push| used(push) > 0);
    all.sort_by_key(used);
    all.truncate(MOST_PUSHES);
    all
}

/// The direction of the branch to which a push leads with a change of the parameter.
fn pushed<P: Problem>(
    problem: &mut P,
    options: &WalkOptions,
    from: &Point,
    across: &Tangent,
    shift: f64,
) -> Option<Tangent> {
    let width = LENGTH * largest(problem.system(), across, options);
    WIDTHS.iter().find_map(|part| {
        let shift = part * shift * LENGTH * options.largest_parameter;
        arrived(problem, options, from, across, (part * width, shift))
    })
}

fn arrived<P: Problem>(
    problem: &mut P,
    options: &WalkOptions,
    from: &Point,
    across: &Tangent,
    (width, shift): (f64, f64),
) -> Option<Tangent> {
    from.restore(problem).ok()?;
    let step: Vec<f64> = across.step.iter().map(|t| width * t).collect();
    let reach = width * across.size(problem.system());
    problem.system().retract(&step);
    problem.set_parameters([from.parameters[0] + shift, from.parameters[1]]).ok()?;
    let mut step = vec![0.0; problem.system().unknowns()];
    for _ in 0..STEPS {
        problem.system().linearise().ok()?;
        problem.system().newton_step(&mut step);
        let along = slope(problem, 0).ok()?;
        let system = problem.system();
        let mut dp = -across.product(system, &step, 0.0) / across.product(system, &along, 0.0);
        step.iter_mut().zip(&along).for_each(|(s, v)| *s += v * dp);
        let size = system.size(&step).max(dp.abs());
        if !size.is_finite() {
            return None;
        }
        if size > reach {
            // The tangent hardly has an inverse near the point: long steps lead anywhere.
            let part = reach / size;
            step.iter_mut().for_each(|s| *s *= part);
            dp *= part;
        }
        system.retract(&step);
        let mut parameters = problem.parameters();
        parameters[0] += dp;
        problem.set_parameters(parameters).ok()?;
        if size <= options.tolerance {
            let point = Point::here(problem);
            let gone = between(problem, from, &point);
            let near = gone.size(problem.system()) <= FARTHEST * reach;
            return near.then(|| gone.normalised(problem.system()));
        }
    }
    None
}
