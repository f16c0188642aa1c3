//! Where exactly a path folds or meets another.

use crate::corrector::{Miss, between};
use crate::multiple::{From, locate_multiple};
use crate::problem::{Point, Problem, Tangent};
use crate::reduced::{Choice, Surface, Value};
use crate::walker::Stall;
use flexura_nonlinear::System;

/// How branches cross at a branch point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// The other branch turns back in the parameter; it exists where the present branch has more unstable directions.
    SupercriticalPitchfork,
    /// The other branch turns back in the parameter; it exists where the present branch has fewer unstable directions.
    SubcriticalPitchfork,
    /// The other branch turns back in the parameter, and it is not known which side is more stable.
    Pitchfork,
    /// Neither branch turns back.
    Transcritical,
    /// So many directions are critical at once.
    Multiple(usize),
}

/// A fold or a branch point.
#[derive(Clone, Debug)]
pub struct Special {
    /// How branches cross; None at a fold.
    pub crossing: Option<Crossing>,
    /// Where it is.
    pub point: Point,
    /// Null directions of the tangent.
    pub kernel: Vec<Vec<f64>>,
    /// Directions of the other branches.
    pub branches: Vec<Tangent>,
    /// Part of the step at which it lies.
    pub part: f64,
    /// Of a simple branch point: |μ| there beside the second derivatives of μ, which is nothing but round-off and errors of the
    /// discretisation where branches really cross.
    pub imperfection: f64,
    /// Of a multiple point: from where it is found again.
    pub(crate) start: Option<Start>,
}

/// A point of the path before a multiple point.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub point: Point,
    pub tangent: Tangent,
    pub length: f64,
    pub tolerance: f64,
}

/// What is known at the two ends of the step that holds it.
pub(crate) struct Bracket<'a> {
    pub before: &'a Point,
    pub after: &'a Point,
    /// The path's direction, at the start of the step.
    pub tangent: &'a Tangent,
    /// Unstable directions at both ends.
    pub index: [Option<usize>; 2],
}

/// Corrections of ξ and p.
const MOST: usize = 12;
/// Size of a correction from which the next is below round-off.
const ENOUGH: f64 = 1e-8;
/// How far differences reach: the size of the change of the state, and of the parameter.
const STATE: f64 = 2e-4;
const PARAMETER: f64 = 2e-4;
/// μ, as a part of what the step changes it by, that counts as nothing.
const NOTHING: f64 = 1e-6;
/// Rate of the parameter beside that of the state, along the other branch, that counts as none.
const SYMMETRIC: f64 = 1e-3;

/// First and second derivatives of μ, and the third along ξ.
pub(crate) struct Shape {
    pub value: Value,
    pub xi_xi: f64,
    pub xi_p: f64,
    pub p_p: f64,
    pub xi_xi_xi: f64,
}

/// Steps of differences along ξ and p.
pub(crate) fn widths<P: Problem>(problem: &mut P, value: &Value) -> [f64; 2] {
    [STATE / problem.system().size(&value.along[0]).max(1e-6), PARAMETER]
}

impl Surface {
    /// Derivatives at a point of the surface, by differences of the first ones. The last time they are extrapolated: what vanishes by
    /// symmetry must come out as nothing.
    pub(crate) fn shape<P: Problem>(
        &self,
        problem: &mut P,
        value: Value,
        along_p: bool,
        is_last: bool,
    ) -> Result<Shape, Miss> {
        let [dx, dp] = widths(problem, &value);
        let mut sides = |width: f64| -> Result<[f64; 3], Miss> {
            let up = self.at(problem, &value, [width, 0.0, 0.0])?;
            let down = self.at(problem, &value, [-width, 0.0, 0.0])?;
            Ok([
                (up.slope[0] - down.slope[0]) / (2.0 * width),
                (up.slope[1] - down.slope[1]) / (2.0 * width),
                (up.slope[0] - 2.0 * value.slope[0] + down.slope[0]) / (width * width),
            ])
        };
        let mut along = sides(dx)?;
        if is_last {
            let wide = sides(2.0 * dx)?;
            for i in 0..2 {
                along[i] += (along[i] - wide[i]) / 3.0;
            }
        }
        let mut p_p = 0.0;
        if along_p {
            let more = self.at(problem, &value, [0.0, dp, 0.0])?;
            let less = self.at(problem, &value, [0.0, -dp, 0.0])?;
            p_p = (more.slope[1] - less.slope[1]) / (2.0 * dp);
        }
        value.point.restore(problem)?;
        Ok(Shape { xi_xi: along[0], xi_p: along[1], xi_xi_xi: along[2], p_p, value })
    }
}

/// Choices of the lift in the order in which they are tried.
fn choices(fold: bool) -> [Choice; 2] {
    if fold { [Choice::Largest, Choice::Null] } else { [Choice::Null, Choice::Largest] }
}

/// The fold or the simple branch point between two points of a path. None where there is none of that kind.
pub(crate) fn locate<P: Problem>(
    problem: &mut P,
    bracket: &Bracket<'_>,
    fold: bool,
) -> Result<Option<Special>, Miss> {
    let [first, second] = choices(fold);
    match locate_by(problem, bracket, fold, first) {
        Ok(Some(found)) => Ok(Some(found)),
        _ => locate_by(problem, bracket, fold, second),
    }
}

fn locate_by<P: Problem>(
    problem: &mut P,
    bracket: &Bracket<'_>,
    fold: bool,
    by: Choice,
) -> Result<Option<Special>, Miss> {
    let whole = between(problem, bracket.before, bracket.after);
    bracket.after.restore(problem)?;
    let Some(surface) = Surface::choose(problem, false, by) else { return Ok(None) };
    bracket.before.restore(problem)?;
    let first = surface.settle(problem)?;
    bracket.after.restore(problem)?;
    let second = surface.settle(problem)?;
    let part = (first.slope[0] / (first.slope[0] - second.slope[0])).clamp(0.02, 0.98);
    let part = if part.is_finite() { part } else { 0.5 };
    // Start between the two.
    bracket.before.restore(problem)?;
    let inside: Vec<f64> = whole.step.iter().map(|v| v * part).collect();
    problem.system().retract(&inside);
    let second_parameter = problem.parameters()[1];
    let guess = bracket.before.parameters[0] + part * whole.parameter;
    problem.set_parameters([guess, second_parameter])?;
    let value = surface.settle(problem)?;
    let reach = whole.size(problem.system());
    match solve(problem, &surface, value, fold, (bracket.before, reach))? {
        Some(shape) => finish(problem, bracket, &whole, shape, fold),
        None => Ok(None),
    }
}

/// Newton on the surface for the fold or branch point, which must not lie further than a few times `reach` from `home`.
fn solve<P: Problem>(
    problem: &mut P,
    surface: &Surface,
    mut value: Value,
    fold: bool,
    (home, reach): (&Point, f64),
) -> Result<Option<Shape>, Miss> {
    let mut last = false;
    for _ in 0..MOST {
        let shape = surface.shape(problem, value, !fold, last)?;
        if last {
            return Ok(Some(shape));
        }
        let [mu, xi, p] = [shape.value.mu, shape.value.slope[0], shape.value.slope[1]];
        // Newton for (μ, μ_ξ) = 0, or for (μ_ξ, μ_p) = 0.
        let (matrix, right) = if fold {
            ([[xi, p], [shape.xi_xi, shape.xi_p]], [mu, xi])
        } else {
            ([[shape.xi_xi, shape.xi_p], [shape.xi_p, shape.p_p]], [xi, p])
        };
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        let mut way = [
            -(right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant,
            -(right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant,
        ];
        let mut size = (way[0] * problem.system().size(&shape.value.along[0])).abs().max(way[1].abs());
        if !size.is_finite() {
            return Ok(None);
        }
        if size > reach {
            way.iter_mut().for_each(|w| *w *= reach / size);
            size = reach;
        }
        value = surface.at(problem, &shape.value, [way[0], way[1], 0.0])?;
        last = size < ENOUGH;
        if between(problem, home, &value.point).size(problem.system()) > 2.5 * reach {
            return Ok(None);
        }
    }
    Ok(None)
}

/// How far a point may move when the discretisation changes.
const NEAR: f64 = 0.05;

/// The same fold or branch point after the problem's discretisation has changed, but not its layout.
///
/// # Errors
/// It is not found again.
pub fn sharpen<P: Problem>(problem: &mut P, special: &Special) -> Result<Special, Stall> {
    let found = match &special.start {
        Some(Start { point, tangent, length, tolerance }) => {
            let from = From { point, tangent, length: *length, tolerance: *tolerance };
            locate_multiple(problem, &from, special.kernel.len())
        }
        None => match again(problem, special, choices(special.crossing.is_none())[0]) {
            Ok(Some(found)) => Ok(Some(found)),
            _ => again(problem, special, choices(special.crossing.is_none())[1]),
        },
    };
    match found {
        Ok(Some(found)) => Ok(Special { part: special.part, ..found }),
        _ => Err(Stall::Short),
    }
}

fn again<P: Problem>(problem: &mut P, special: &Special, by: Choice) -> Result<Option<Special>, Miss> {
    let fold = special.crossing.is_none();
    special.point.restore(problem)?;
    let Some(surface) = Surface::choose(problem, false, by) else { return Ok(None) };
    special.point.restore(problem)?;
    let value = surface.settle(problem)?;
    let Some(shape) = solve(problem, &surface, value, fold, (&special.point, NEAR))? else { return Ok(None) };
    let value = &shape.value;
    let system = problem.system();
    let mut branches = Vec::new();
    if let Some(before) = special.branches.first() {
        let Some(directions) = directions(&shape) else { return Ok(None) };
        let along = |t: &Tangent| t.product(system, &before.step, before.parameter);
        let mut best = tangents(system, value, &directions)
            .into_iter()
            .max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()))
            .unwrap_or_default();
        if along(&best) < 0.0 {
            best.scale(-1.0);
        }
        branches.push(best);
    }
    Ok(Some(Special {
        point: value.point.clone(),
        kernel: vec![value.along[0].clone()],
        branches,
        ..special.clone()
    }))
}

/// Directions (ξ, p) as directions of the path.
fn tangents<S: flexura_nonlinear::Liftable>(
    system: &S,
    value: &Value,
    directions: &[[f64; 2]; 2],
) -> Vec<Tangent> {
    directions
        .iter()
        .map(|[xi, p]| {
            let step = value.along[0].iter().zip(&value.along[1]).map(|(x, v)| xi * x + p * v).collect();
            Tangent { step, parameter: *p }.normalised(system)
        })
        .collect()
}

/// Is it what was looked for, and how do branches cross there?
fn finish<P: Problem>(
    problem: &mut P,
    bracket: &Bracket<'_>,
    whole: &Tangent,
    shape: Shape,
    fold: bool,
) -> Result<Option<Special>, Miss> {
    let value = &shape.value;
    let gone = between(problem, bracket.before, &value.point);
    let system = problem.system();
    let square = whole.product(system, &whole.step, whole.parameter);
    let part = whole.product(system, &gone.step, gone.parameter) / square;
    // What lies beyond belongs to another step.
    if !(-0.02..=1.02).contains(&part) {
        return Ok(None);
    }
    let kernel = vec![value.along[0].clone()];
    if fold {
        let point = value.point.clone();
        return Ok(Some(Special {
            crossing: None,
            point,
            kernel,
            branches: Vec::new(),
            part,
            imperfection: 0.0,
            start: None,
        }));
    }
    // The step's change of μ if it left the path by its own length.
    let bends = (shape.xi_p.abs() + shape.xi_xi.abs()).max(1e-300);
    let scale = bends * square;
    if value.mu.abs() > NOTHING * scale.max(1e-9) {
        return Ok(None);
    }
    let imperfection = value.mu.abs() / bends;
    let Some(directions) = directions(&shape) else { return Ok(None) };
    let mut tangents = tangents(system, value, &directions);
    // The present branch's own direction is the one nearest to the step.
    let nearness = |t: &Tangent| t.product(system, &bracket.tangent.step, bracket.tangent.parameter).abs();
    let own = if nearness(&tangents[0]) >= nearness(&tangents[1]) { 0 } else { 1 };
    tangents.swap_remove(own);
    let turns = |d: &[f64; 2]| d[1].abs() <= SYMMETRIC * d[0].abs() * system.size(&value.along[0]);
    let crossing = if turns(&directions[own]) {
        // Met along the side branch: what is stable on the other is not known here.
        Crossing::Pitchfork
    } else if turns(&directions[1 - own]) {
        // p = p* - μ_ξξξ/(6 μ_ξp) ξ² on the other branch.
        let bends = -shape.xi_xi_xi / shape.xi_p;
        match bracket.index {
            [Some(a), Some(b)] if a != b => {
                let towards_more =
                    (bracket.after.parameters[0] - bracket.before.parameters[0]) * (b as f64 - a as f64);
                if bends * towards_more > 0.0 {
                    Crossing::SupercriticalPitchfork
                } else {
                    Crossing::SubcriticalPitchfork
                }
            }
            _ => Crossing::Pitchfork,
        }
    } else {
        Crossing::Transcritical
    };
    Ok(Some(Special {
        crossing: Some(crossing),
        point: value.point.clone(),
        kernel,
        branches: tangents,
        part,
        imperfection,
        start: None,
    }))
}

/// The two directions (ξ, p) in which μ_ξξ ξ² + 2 μ_ξp ξ p + μ_pp p² vanishes.
fn directions(shape: &Shape) -> Option<[[f64; 2]; 2]> {
    let (a, b, c) = (shape.xi_xi, shape.xi_p, shape.p_p);
    let inside = b * b - a * c;
    if inside.is_nan() || inside <= 0.0 {
        return None;
    }
    // (a ξ + b p)² = (b² - ac) p²; the root without cancellation first.
    let q = -(b + b.signum() * inside.sqrt());
    Some([[q, a], [c, q]])
}
