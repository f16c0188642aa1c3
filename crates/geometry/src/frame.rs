//! How the section's axes e2, e3 run along a traced curve.
//!
//! Every rule gives e2 ⟂ T; then e3 = T × e2 and, from R' = R hat(k): k1 = e2'·e3, k2 = -T'·e3,
//! k3 = T'·e2.

use crate::ShapeError;
use crate::cells::Cell;
use crate::legendre::{Integral, RULE};
use crate::path::{Local, Path};
use crate::smooth::{golden_minimum, samples};
use flexura_expression::Function;
use flexura_model::SectionFrame;
use flexura_spatial::Vector3;

/// A rotation-minimising frame and a direction are ill-posed below this sine of their angle to the tangent.
const PARALLEL: f64 = 1e-6;
/// A curvature below this fraction of the largest is no curvature.
const STRAIGHT: f64 = 1e-9;

/// A rule for e2 along a path.
#[derive(Clone, Debug)]
pub(crate) enum Rule {
    /// e_N = cos φ0 e2 + sin φ0 e3.
    Frenet { offset: f64 },
    /// e2 turns about the tangent only by the twist.
    Minimising { cells: Vec<Roll>, twist: Twist },
    /// e2 as near as possible to a direction.
    Along { direction: Vector3<f64> },
}

/// The rotation-minimising frame over one cell.
///
/// Its e2 at the cell's start is taken as a fixed direction d. The frame that keeps e2 as near to d as
/// possible turns about the tangent at a known rate k1(d), so the rotation-minimising frame is that frame
/// turned back by ∫k1(d) ds: an integral, no differential equation.
#[derive(Clone, Debug)]
pub(crate) struct Roll {
    /// e2 of the untwisted frame at the cell's start.
    start: Vector3<f64>,
    /// -∫k1(d) ds, rad.
    angle: Integral,
}

/// A given turning of the section about e1, zero at the start.
#[derive(Clone, Debug, Default)]
pub(crate) struct Twist {
    function: Option<Function>,
}

impl Twist {
    /// The twist of a user's function, of which only the difference from the start counts.
    pub fn new(function: Option<Function>, length: f64) -> Result<Self, ShapeError> {
        if let Some(function) = &function {
            for i in 0..=64 {
                let s = length * i as f64 / 64.0;
                if !function.jet(s)[..2].iter().all(|x| x.is_finite()) {
                    return Err(ShapeError::LawNotFinite { what: "twist", s });
                }
            }
        }
        Ok(Self { function })
    }

    /// Angle (rad) and rate (rad/m) at `s`.
    pub fn at(&self, s: f64) -> (f64, f64) {
        match &self.function {
            None => (0.0, 0.0),
            Some(function) => {
                let jet = function.jet(s);
                (jet[0] - function.value(0.0), jet[1])
            }
        }
    }

    /// Arc lengths at which its rate is not smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        self.function.as_ref().map_or(Vec::new(), |function| function.breaks(0.0, length))
    }

    /// By how much (rad) it may turn back and forth between two arc lengths without that a few places show it.
    pub fn hidden_turn(&self, a: f64, b: f64) -> f64 {
        self.function.as_ref().map_or(0.0, |function| function.variation(a, b).hidden_slope() * (b - a))
    }

    /// Does it never turn?
    pub fn is_none(&self) -> bool {
        self.function.as_ref().is_none_or(|function| function.as_constant().is_some())
    }
}

impl Rule {
    /// Arc lengths at which a twist is not smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        match self {
            Rule::Minimising { twist, .. } => twist.breaks(length),
            Rule::Frenet { .. } | Rule::Along { .. } => Vec::new(),
        }
    }

    /// As [`Twist::hidden_turn`].
    pub fn hidden_turn(&self, a: f64, b: f64) -> f64 {
        match self {
            Rule::Minimising { twist, .. } => twist.hidden_turn(a, b),
            Rule::Frenet { .. } | Rule::Along { .. } => 0.0,
        }
    }

    /// The rule for a traced path that has been cut into `cells`.
    pub fn new(frame: &SectionFrame, path: &Path, cells: &[Cell], length: f64) -> Result<Self, ShapeError> {
        match frame {
            SectionFrame::Natural => Self::minimising(path, cells, None, Twist::default()),
            SectionFrame::RotationMinimising { start, twist } => {
                Self::minimising(path, cells, start.as_ref(), Twist::new(twist.clone(), length)?)
            }
            SectionFrame::Frenet { offset } => {
                if !offset.is_finite() {
                    return Err(ShapeError::NotFinite { what: "Frenet offset", value: *offset });
                }
                refuse_straight(path, cells)?;
                Ok(Rule::Frenet { offset: *offset })
            }
            SectionFrame::Direction { along } => {
                let direction = unit(along)?;
                refuse_parallel(path, cells, &direction)?;
                Ok(Rule::Along { direction })
            }
        }
    }

    fn minimising(
        path: &Path,
        cells: &[Cell],
        start: Option<&Vector3<f64>>,
        twist: Twist,
    ) -> Result<Self, ShapeError> {
        let mut rolls: Vec<Roll> = Vec::with_capacity(cells.len());
        let mut e2 = Vector3::zeros();
        for (i, cell) in cells.iter().enumerate() {
            let tangent = path.local(cell.range[0]).tangent;
            // Projecting again removes the round-off of the cells before.
            e2 = if i == 0 { start_direction(start, &tangent)? } else { across(&e2, &tangent).normalize() };
            let half = 0.5 * (cell.range[1] - cell.range[0]);
            let angle = Integral::new(&RULE.nodes.map(|x| {
                let local = path.local(cell.parameter(x));
                reference_rate(&local, &e2) * local.speed * half
            }));
            let roll = Roll { start: e2, angle };
            e2 = roll.axis(1.0, &path.local(cell.range[1]).tangent);
            rolls.push(roll);
        }
        Ok(Rule::Minimising { cells: rolls, twist })
    }

    /// Does the section never turn about a straight axis?
    pub fn is_untwisted(&self) -> bool {
        match self {
            Rule::Frenet { .. } => false,
            Rule::Minimising { twist, .. } => twist.is_none(),
            Rule::Along { .. } => true,
        }
    }

    /// e2 and k1 at a place: cell number, x in [-1, 1] in it, arc length, local geometry.
    pub fn axis(&self, cell: usize, x: f64, s: f64, local: &Local) -> (Vector3<f64>, f64) {
        match self {
            Rule::Frenet { offset } => {
                let normal = local.bend.normalize();
                (turned(&normal, &local.tangent, -offset), local.torsion)
            }
            Rule::Minimising { cells, twist } => {
                let (angle, rate) = twist.at(s);
                (turned(&cells[cell].axis(x, &local.tangent), &local.tangent, angle), rate)
            }
            Rule::Along { direction } => {
                let e2 = across(direction, &local.tangent).normalize();
                (e2, -reference_rate(local, direction))
            }
        }
    }
}

impl Roll {
    /// e2 of the untwisted frame at x in [-1, 1] of its cell.
    fn axis(&self, x: f64, tangent: &Vector3<f64>) -> Vector3<f64> {
        turned(&across(&self.start, tangent).normalize(), tangent, self.angle.to(x))
    }
}

/// `d` without its part along the unit vector `t`.
pub(crate) fn across(d: &Vector3<f64>, t: &Vector3<f64>) -> Vector3<f64> {
    t.cross(&d.cross(t))
}

/// `a` (across the unit tangent) turned about the tangent by `angle`.
pub(crate) fn turned(a: &Vector3<f64>, tangent: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    a * angle.cos() + tangent.cross(a) * angle.sin()
}

/// -k1 of the frame whose e2 is as near as possible to `d`: (d·T)(T'·e3)/|d - (d·T)T|, rad/m.
///
/// From w = d - (d·T)T, e2 = w/|w|: k1 = e2'·e3 = w'·e3/|w| and w' = -(d·T')T - (d·T)T'.
pub(crate) fn reference_rate(local: &Local, d: &Vector3<f64>) -> f64 {
    let w = across(d, &local.tangent);
    d.dot(&local.tangent) * local.bend.dot(&local.tangent.cross(&w)) / w.norm_squared()
}

/// Some unit vector across the unit vector `t`.
pub(crate) fn any_normal(t: &Vector3<f64>) -> Vector3<f64> {
    let axis = if t.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    across(&axis, t).normalize()
}

/// A user's direction as a unit vector.
pub(crate) fn unit(d: &Vector3<f64>) -> Result<Vector3<f64>, ShapeError> {
    let norm = d.norm();
    if norm.is_finite() && norm > 0.0 {
        Ok(d / norm)
    } else {
        Err(ShapeError::DirectionInvalid { x: d.x, y: d.y, z: d.z })
    }
}

/// e2 at the start: the wanted direction, or y, or z where the tangent runs along y.
pub(crate) fn start_direction(
    wanted: Option<&Vector3<f64>>,
    tangent: &Vector3<f64>,
) -> Result<Vector3<f64>, ShapeError> {
    let direction = match wanted {
        Some(wanted) => unit(wanted)?,
        None if across(&Vector3::y(), tangent).norm() > 1e-3 => Vector3::y(),
        None => Vector3::z(),
    };
    let e2 = across(&direction, tangent);
    if e2.norm() < PARALLEL { Err(ShapeError::DirectionParallel { s: 0.0 }) } else { Ok(e2.normalize()) }
}

/// Refuses a path that is straight somewhere, or whose normal flips (an inflection).
fn refuse_straight(path: &Path, cells: &[Cell]) -> Result<(), ShapeError> {
    let samples = samples(path, cells);
    let largest = samples.iter().map(|sample| sample.local.bend.norm()).fold(0.0, f64::max);
    let straight = |local: &Local| !(local.bend.norm() > STRAIGHT * largest);
    if let Some(sample) = samples.iter().find(|sample| straight(&sample.local)) {
        return Err(ShapeError::FrenetUndefined { s: sample.s });
    }
    // Between two samples whose normals differ by more than a right angle the curvature may vanish.
    for cell in cells {
        let nodes = places();
        for pair in nodes.windows(2) {
            let bends = [path.local(cell.parameter(pair[0])).bend, path.local(cell.parameter(pair[1])).bend];
            if bends[0].dot(&bends[1]) > 0.0 {
                continue;
            }
            let x = golden_minimum(pair[0], pair[1], |x| path.local(cell.parameter(x)).bend.norm());
            if path.local(cell.parameter(x)).bend.norm() < 1e-6 * largest {
                return Err(ShapeError::FrenetUndefined { s: cell.arc_length(x) });
            }
        }
    }
    Ok(())
}

/// Refuses a path whose tangent runs along the direction somewhere.
fn refuse_parallel(path: &Path, cells: &[Cell], direction: &Vector3<f64>) -> Result<(), ShapeError> {
    let rest = |cell: &Cell, x: f64| across(direction, &path.local(cell.parameter(x)).tangent);
    for cell in cells {
        let nodes = places();
        for pair in nodes.windows(2) {
            let ends = [rest(cell, pair[0]), rest(cell, pair[1])];
            for (x, end) in pair.iter().zip(&ends) {
                if end.norm() < PARALLEL {
                    return Err(ShapeError::DirectionParallel { s: cell.arc_length(*x) });
                }
            }
            if ends[0].dot(&ends[1]) > 0.0 {
                continue;
            }
            let x = golden_minimum(pair[0], pair[1], |x| rest(cell, x).norm());
            if rest(cell, x).norm() < PARALLEL {
                return Err(ShapeError::DirectionParallel { s: cell.arc_length(x) });
            }
        }
    }
    Ok(())
}

/// The sampled places x in [-1, 1] of a cell, its ends included.
fn places() -> Vec<f64> {
    std::iter::once(-1.0).chain(RULE.nodes).chain(std::iter::once(1.0)).collect()
}
