//! The stress-free shape of a beam: curvatures and poses along its arc length.

use crate::ShapeError;
use crate::cells::{Cell, cut};
use crate::constant::Constant;
use crate::frame::Rule;
use crate::path::Path;
use crate::profiles::Profiles;
use crate::smooth::{refuse_corners, refuse_cusps, samples};
use crate::spline::Spline;
use flexura_model::{Curve, SectionFrame};
use flexura_spatial::{Pose, Vector3, rotation_from_axes};

/// The stress-free shape of a beam, moved rigidly so that its start frame is the identity.
///
/// Invariants: the length is positive and finite; the breaks increase and lie strictly inside.
#[derive(Clone, Debug)]
pub struct RestShape {
    length: f64,
    breaks: Vec<f64>,
    uniform: Option<Vector3<f64>>,
    kind: Kind,
    /// From the curve's own coordinates to the start frame.
    home: Pose,
}

#[derive(Clone, Debug)]
enum Kind {
    Constant(Constant),
    Profiles(Profiles),
    Traced { path: Path, cells: Vec<Cell>, rule: Rule },
}

/// A cell that is shorter than this part of a stretch may not show in it.
const SMALL: f64 = 0.25;

impl RestShape {
    /// The rest shape of a curve whose section axes run as `frame` says.
    ///
    /// `frame` is ignored for [`Curve::Curvature`]. `Natural` is the Frenet frame of the arc and the helix,
    /// no turn at all for the straight beam, and `RotationMinimising { start: None, twist: None }` otherwise.
    ///
    /// # Errors
    /// Lengths that are not positive and finite, cusps, coinciding points, frames that do not exist.
    pub fn new(curve: &Curve, frame: &SectionFrame) -> Result<Self, ShapeError> {
        match curve {
            Curve::Straight { length } => Self::constant(positive("length", *length)?, 0.0, 0.0, frame),
            Curve::Arc { radius, angle } => {
                let radius = positive("radius", *radius)?;
                Self::constant(radius * positive("angle", *angle)?, 1.0 / radius, 0.0, frame)
            }
            Curve::Helix { radius, pitch, turns } => {
                let radius = positive("radius", *radius)?;
                let turns = positive("turns", *turns)?;
                if !pitch.is_finite() {
                    return Err(ShapeError::NotFinite { what: "pitch", value: *pitch });
                }
                // Rise per radian c: κ = r/(r² + c²), τ = c/(r² + c²), one turn is 2π √(r² + c²) long.
                let rise = pitch / std::f64::consts::TAU;
                let slant = radius.hypot(rise);
                let length = std::f64::consts::TAU * turns * slant;
                Self::constant(length, radius / slant / slant, rise / slant / slant, frame)
            }
            Curve::Parametric { position, range } => {
                let [from, to] = *range;
                if !(from < to && (to - from).is_finite()) {
                    return Err(ShapeError::Range { from, to });
                }
                Self::traced(Path::parametric(position, *range), frame)
            }
            Curve::Points { points } => Self::traced(Path::Spline(Spline::new(points)?), frame),
            Curve::Curvature { curvature, length } => {
                let length = positive("length", *length)?;
                let mut breaks: Vec<f64> = curvature.iter().flat_map(|k| k.breaks(length)).collect();
                breaks.sort_by(f64::total_cmp);
                breaks.dedup();
                let profiles = Profiles::new(curvature, length, &breaks)?;
                let uniform = profiles.uniform();
                Ok(Self { length, breaks, uniform, kind: Kind::Profiles(profiles), home: Pose::identity() })
            }
        }
    }

    fn constant(length: f64, bend: f64, torsion: f64, frame: &SectionFrame) -> Result<Self, ShapeError> {
        let length = positive("length", length)?;
        let curve = Constant::new(bend, torsion, length, frame)?;
        let home = curve.pose(0.0).inverse();
        let breaks = curve.breaks(length);
        Ok(Self { length, breaks, uniform: curve.uniform(), kind: Kind::Constant(curve), home })
    }

    fn traced(path: Path, frame: &SectionFrame) -> Result<Self, ShapeError> {
        let (cells, length) = cut(&path)?;
        let length = positive("length", length)?;
        let samples = samples(&path, &cells);
        refuse_cusps(&path, &samples, length)?;
        refuse_corners(&path, &samples)?;
        let rule = Rule::new(frame, &path, &cells, length)?;
        let knots = path.knots();
        let inner = knots.get(1..knots.len() - 1).unwrap_or_default();
        // A cell starts at every knot.
        let mut breaks: Vec<f64> = inner
            .iter()
            .filter_map(|knot| cells.binary_search_by(|cell| cell.range[0].total_cmp(knot)).ok())
            .map(|i| cells[i].start)
            .collect();
        breaks.extend(rule.breaks(length));
        breaks.retain(|s| *s > 0.0 && *s < length);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let straight = samples.iter().all(|sample| sample.local.bend.norm() * length < 1e-15);
        let uniform = (straight && rule.is_untwisted()).then(Vector3::zeros);
        let mut shape = Self {
            length,
            breaks,
            uniform,
            kind: Kind::Traced { path, cells, rule },
            home: Pose::identity(),
        };
        shape.home = shape.own_pose(0.0).inverse();
        Ok(shape)
    }

    /// The length L of the undeformed axis, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Arc lengths (m) strictly inside the beam where the curvatures or their low derivatives jump: the
    /// points of a spline, the rows of a table. Increasing.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// (k1, k2, k3) in 1/m if they are the same everywhere.
    pub fn uniform(&self) -> Option<Vector3<f64>> {
        self.uniform
    }

    /// The rest curvatures (k1, k2, k3), 1/m, of the section frame at arc length `s` (m).
    ///
    /// `R' = R hat(k)`. At a break the value is that of the stretch after it.
    pub fn curvature(&self, s: f64) -> Vector3<f64> {
        if let Some(k) = self.uniform {
            return k;
        }
        match &self.kind {
            Kind::Constant(curve) => curve.curvature(s),
            Kind::Profiles(profiles) => profiles.curvature(s),
            Kind::Traced { path, cells, rule } => {
                let (i, x) = place(cells, s);
                let local = path.local(cells[i].parameter(x));
                let (e2, k1) = rule.axis(i, x, s, &local);
                let e3 = local.tangent.cross(&e2);
                Vector3::new(k1, -local.bend.dot(&e3), local.bend.dot(&e2))
            }
        }
    }

    /// By how much (rad) the shape may turn back and forth between two arc lengths, none of its breaks between them, without
    /// that a few places there show it: zero where that is ruled out.
    pub fn hidden_turn(&self, a: f64, b: f64) -> f64 {
        if self.uniform.is_some() {
            return 0.0;
        }
        match &self.kind {
            Kind::Constant(curve) => curve.hidden_turn(a, b),
            Kind::Profiles(profiles) => profiles.hidden_turn(a, b),
            Kind::Traced { cells, rule, .. } => {
                let first = cells.partition_point(|cell| cell.start <= a).saturating_sub(1);
                let here = cells[first..].iter().take_while(|cell| cell.start < b);
                let small = here.filter(|cell| cell.length() < SMALL * (b - a));
                small.map(|cell| cell.turning).sum::<f64>() + rule.hidden_turn(a, b)
            }
        }
    }

    /// The stress-free pose of the section at arc length `s` (m) in the start frame.
    pub fn pose(&self, s: f64) -> Pose {
        self.home * self.own_pose(s)
    }

    /// The pose in the curve's own coordinates.
    fn own_pose(&self, s: f64) -> Pose {
        match &self.kind {
            Kind::Constant(curve) => curve.pose(s),
            Kind::Profiles(profiles) => profiles.pose(s),
            Kind::Traced { path, cells, rule } => {
                let (i, x) = place(cells, s);
                let local = path.local(cells[i].parameter(x));
                let (e2, _) = rule.axis(i, x, s, &local);
                let e3 = local.tangent.cross(&e2);
                Pose::new(rotation_from_axes(&local.tangent, &e2, &e3), local.position)
            }
        }
    }
}

/// The cell that holds arc length `s`, and where in it.
fn place(cells: &[Cell], s: f64) -> (usize, f64) {
    let i = cells.partition_point(|cell| cell.start <= s).saturating_sub(1);
    (i, cells[i].place(s))
}

fn positive(what: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(ShapeError::NotPositive { what, value }) }
}
