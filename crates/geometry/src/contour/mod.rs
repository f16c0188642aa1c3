//! The boundary of a body in a plane, by its arc length.
//!
//! The arc length s grows so that the body lies to the left and the outside to the right: counter-clockwise around a
//! closed boundary. The tangent has the angle Θ(s), the curvature κ = dΘ/ds is positive where the boundary is convex.
//! Lengths in metres.

mod check;
mod error;
mod function;

pub use error::BoundaryError;
pub use function::FunctionSpline;

use crate::cells::{self, Cell};
use crate::path::{Arcs, Path};
use crate::smooth::{refuse_corners, refuse_cusps, samples};
use crate::spline::Spline;
use flexura_expression::Function;
use flexura_model::{Boundary, BoundaryCurve, Side};
use flexura_spatial::Vector3;
use std::f64::consts::{PI, TAU};

/// The geometry of a boundary at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourPoint {
    /// The curve's own parameter; beyond a closed curve's range after a turn.
    pub parameter: f64,
    /// (x, y), m.
    pub point: [f64; 2],
    /// Θ, rad: the tangent's angle, continuous in s.
    pub angle: f64,
    /// κ = dΘ/ds, 1/m.
    pub curvature: f64,
    /// dκ/ds, 1/m².
    pub curvature_rate: f64,
}

impl ContourPoint {
    /// The unit tangent, towards growing arc length.
    pub fn tangent(&self) -> [f64; 2] {
        [self.angle.cos(), self.angle.sin()]
    }
}

/// A boundary curve as a function of its arc length.
#[derive(Clone, Debug)]
pub struct Contour {
    kind: Kind,
    /// Arc lengths between which it is known; None: a closed curve, or a line without end.
    range: Option<[f64; 2]>,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Point at s = 0 and angle of the tangent; s is minus the parameter where `reversed`.
    Line {
        point: [f64; 2],
        angle: f64,
    },
    Curve(Box<Curve>),
}

#[derive(Clone, Debug)]
struct Curve {
    path: Path,
    cells: Vec<Cell>,
    /// Tangent angle of the path at the cells' starts, continuous.
    angles: Vec<f64>,
    length: f64,
    closed: bool,
    /// The arc length runs against the parameter.
    reversed: bool,
}

impl Contour {
    /// # Errors
    /// A boundary that is no smooth simple curve: see [`BoundaryError`].
    pub fn new(boundary: &Boundary) -> Result<Self, BoundaryError> {
        let (path, closed, side) = match &boundary.curve {
            BoundaryCurve::Line { point, normal, range } => return line(*point, *normal, *range),
            BoundaryCurve::Ellipse { semi_axes, range } => {
                for (value, what) in semi_axes.iter().zip(["semi-axis along x", "semi-axis along y"]) {
                    if !(value.is_finite() && *value > 0.0) {
                        return Err(BoundaryError::NotPositive { what, value: *value });
                    }
                }
                let span = checked_range(range.unwrap_or([0.0, TAU]))?;
                if span[1] - span[0] > TAU * (1.0 + 1e-12) {
                    return Err(BoundaryError::MoreThanATurn { from: span[0], to: span[1] });
                }
                (Path::Ellipse { semi_axes: *semi_axes, range: span }, range.is_none(), boundary.outside)
            }
            BoundaryCurve::Arcs { point, direction, arcs } => {
                for [radius, angle] in arcs {
                    let sound = radius.is_finite() && *radius > 0.0 && angle.is_finite() && *angle != 0.0;
                    if !sound {
                        return Err(BoundaryError::Arc { radius: *radius, angle: *angle });
                    }
                }
                let start = direction[1].atan2(direction[0]);
                if arcs.is_empty() || !start.is_finite() || direction == &[0.0; 2] {
                    return Err(BoundaryError::NoDirection);
                }
                (Path::Arcs(Arcs::new(*point, start, arcs)), false, boundary.outside)
            }
            BoundaryCurve::Points { points, closed } => {
                let points: Vec<_> = points.iter().map(|[x, y]| Vector3::new(*x, *y, 0.0)).collect();
                let spline = if *closed { Spline::closed(&points) } else { Spline::new(&points) };
                (Path::Spline(spline?), *closed, boundary.outside)
            }
            BoundaryCurve::Expression { position: [x, y], range, closed } => {
                let range = checked_range(*range)?;
                let position = [x.clone(), y.clone(), Function::constant(0.0)];
                (Path::parametric(&position, range), *closed, boundary.outside)
            }
        };
        let (cells, length) = cells::cut(&path)?;
        let places = samples(&path, &cells);
        refuse_cusps(&path, &places, length)?;
        refuse_corners(&path, &places)?;
        let ordinary = matches!(boundary.curve, BoundaryCurve::Ellipse { .. });
        if !ordinary {
            check::refuse_crossings(&places, closed)?;
        }
        if closed && !ordinary {
            check::refuse_gap(&path, length)?;
        }
        let counter_clockwise = !closed || check::signed_area(&places) > 0.0;
        let reversed = match side {
            Some(Side::Left) => true,
            Some(Side::Right) => false,
            None => !counter_clockwise,
        };
        if closed && reversed == counter_clockwise {
            return Err(BoundaryError::OutsideWithin);
        }
        let mut angles = Vec::with_capacity(cells.len() + 1);
        let first = path.local(cells[0].range[0]).tangent;
        angles.push(first.y.atan2(first.x));
        for (i, cell) in cells.iter().enumerate() {
            let ends = cell.range.map(|t| path.local(t).tangent);
            angles.push(angles[i] + angle_between(&ends[0], &ends[1]));
        }
        let range = (!closed).then_some([0.0, length]);
        let curve = Curve { path, cells, angles, length, closed, reversed };
        Ok(Self { kind: Kind::Curve(Box::new(curve)), range })
    }

    /// Arc lengths of its ends; None without end.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range
    }

    /// Length of one turn of a closed boundary, of the whole of an open one; None of a line without end.
    pub fn length(&self) -> Option<f64> {
        match &self.kind {
            Kind::Line { .. } => self.range.map(|[a, b]| b - a),
            Kind::Curve(curve) => Some(curve.length),
        }
    }

    /// Is it a straight line?
    pub fn is_straight(&self) -> bool {
        matches!(self.kind, Kind::Line { .. })
    }

    /// Is it curved outwards everywhere?
    pub fn is_convex(&self) -> bool {
        match &self.kind {
            Kind::Line { .. } => false,
            Kind::Curve(curve) => {
                let sign = if curve.reversed { -1.0 } else { 1.0 };
                samples(&curve.path, &curve.cells)
                    .iter()
                    .all(|sample| sign * curvature(&curve.path.jet(sample.parameter))[0] > 0.0)
            }
        }
    }

    /// The geometry at arc length `s`; None beyond an end.
    pub fn at(&self, s: f64) -> Option<ContourPoint> {
        if let Some([from, to]) = self.range {
            // Round-off may lead a hair beyond an end.
            let slack = 1e-12 * (to - from);
            if !(s >= from - slack && s <= to + slack) {
                return None;
            }
        } else if !s.is_finite() {
            return None;
        }
        match &self.kind {
            Kind::Line { point, angle } => {
                let (sin, cos) = angle.sin_cos();
                Some(ContourPoint {
                    parameter: s,
                    point: [point[0] + s * cos, point[1] + s * sin],
                    angle: *angle,
                    curvature: 0.0,
                    curvature_rate: 0.0,
                })
            }
            Kind::Curve(curve) => Some(curve.at(s)),
        }
    }

    /// The arc length at a parameter value; None outside an open curve.
    pub fn arc_of(&self, parameter: f64) -> Option<f64> {
        match &self.kind {
            Kind::Line { .. } => {
                let inside = self.range.is_none_or(|[a, b]| parameter >= a && parameter <= b);
                (inside && parameter.is_finite()).then_some(parameter)
            }
            Kind::Curve(curve) => curve.arc_of(parameter),
        }
    }

    /// A length to take steps by: the smallest radius of curvature, or what there is of a straight one.
    pub fn step(&self) -> f64 {
        match &self.kind {
            Kind::Line { .. } => self.range.map_or(f64::INFINITY, |[a, b]| b - a),
            Kind::Curve(curve) => {
                let tightest = samples(&curve.path, &curve.cells)
                    .iter()
                    .map(|sample| curvature(&curve.path.jet(sample.parameter))[0].abs())
                    .fold(0.0, f64::max);
                (1.0 / tightest).min(curve.length)
            }
        }
    }

    /// Points along it, for looking at: of one turn, of the whole, or of `reach` to both sides of the place `middle` on a line
    /// without end.
    pub fn polyline(&self, count: usize, middle: f64, reach: f64) -> Vec<[f64; 2]> {
        let [from, to] = self.range.unwrap_or(match self.length() {
            Some(length) => [0.0, length],
            None => [middle - reach, middle + reach],
        });
        let place = |i: usize| from + (to - from) * i as f64 / count as f64;
        (0..=count).filter_map(|i| self.at(place(i))).map(|place| place.point).collect()
    }
}

impl Curve {
    fn at(&self, s: f64) -> ContourPoint {
        let turns = if self.closed { (s / self.length).floor() } else { 0.0 };
        let within = (s - turns * self.length).clamp(0.0, self.length);
        let along = if self.reversed { self.length - within } else { within };
        let i = self.cells.partition_point(|cell| cell.start <= along).saturating_sub(1);
        let cell = &self.cells[i];
        let t = cell.parameter(cell.place(along));
        let jet = self.path.jet(t);
        let start = self.path.local(cell.range[0]).tangent;
        let own = self.angles[i] + angle_between(&start, &jet[1]);
        let [curvature, curvature_rate] = curvature(&jet);
        let period = self.cells[self.cells.len() - 1].range[1] - self.cells[0].range[0];
        let (sign, half) = if self.reversed { (-1.0, PI) } else { (1.0, 0.0) };
        ContourPoint {
            parameter: t + sign * turns * period,
            point: [jet[0].x, jet[0].y],
            angle: own + half + TAU * turns,
            curvature: sign * curvature,
            curvature_rate,
        }
    }

    fn arc_of(&self, parameter: f64) -> Option<f64> {
        let (first, last) = (self.cells[0].range[0], self.cells[self.cells.len() - 1].range[1]);
        let period = last - first;
        let turns = if self.closed { ((parameter - first) / period).floor() } else { 0.0 };
        let t = parameter - turns * period;
        if !(t >= first - 1e-12 * period && t <= last + 1e-12 * period) {
            return None;
        }
        let t = t.clamp(first, last);
        let i = self.cells.partition_point(|cell| cell.range[0] <= t).saturating_sub(1);
        let cell = &self.cells[i];
        let [a, b] = cell.range;
        let along = cell.arc_length((2.0 * (t - a) / (b - a) - 1.0).clamp(-1.0, 1.0));
        Some(if self.reversed {
            self.length - along - turns * self.length
        } else {
            along + turns * self.length
        })
    }
}

/// A line's tangent has its outside, where the normal points, to the right.
fn line(point: [f64; 2], normal: [f64; 2], range: Option<[f64; 2]>) -> Result<Contour, BoundaryError> {
    let size = normal[0].hypot(normal[1]);
    if !(size.is_finite() && size > 0.0 && point.iter().all(|x| x.is_finite())) {
        return Err(BoundaryError::NoNormal);
    }
    let range = range.map(checked_range).transpose()?;
    let angle = normal[0].atan2(-normal[1]);
    Ok(Contour { kind: Kind::Line { point, angle }, range })
}

fn checked_range([from, to]: [f64; 2]) -> Result<[f64; 2], BoundaryError> {
    if from.is_finite() && to.is_finite() && from < to {
        Ok([from, to])
    } else {
        Err(BoundaryError::Range { from, to })
    }
}

/// The angle from one direction in the plane to another, between -π and π.
fn angle_between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y)
}

/// κ and dκ/ds of a plane curve along growing parameter.
fn curvature(jet: &[Vector3<f64>; 4]) -> [f64; 2] {
    let [_, d1, d2, d3] = jet;
    let square = d1.norm_squared();
    let speed = square.sqrt();
    let cross = d1.x * d2.y - d1.y * d2.x;
    let rate = (d1.x * d3.y - d1.y * d3.x) - 3.0 * cross * d1.dot(d2) / square;
    [cross / (square * speed), rate / (square * square)]
}

#[cfg(test)]
mod tests;
