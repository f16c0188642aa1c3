//! Curves of constant curvature and torsion: the straight line, the arc, the helix.

use crate::ShapeError;
use crate::frame::{Twist, across, reference_rate, start_direction, unit};
use crate::path::Local;
use flexura_model::SectionFrame;
use flexura_spatial::{Pose, Vector3, exp, rotation_from_axes};

/// A curve of constant Frenet curvature κ and torsion τ, in its own coordinates: it starts at the origin
/// with tangent x, normal y, binormal z.
#[derive(Clone, Debug)]
pub(crate) struct Constant {
    /// κ, 1/m, not negative.
    bend: f64,
    /// τ, 1/m.
    torsion: f64,
    rule: Rule,
}

/// How e2 runs, measured by the angle ψ from the normal: e2 = cos ψ e_N + sin ψ e_B (ψ = -φ0).
#[derive(Clone, Debug)]
enum Rule {
    /// ψ constant.
    Fixed { angle: f64 },
    /// ψ = ψ0 - τ s + twist(s).
    Minimising { start: f64, twist: Twist },
    /// e2 as near as possible to a direction.
    Along { direction: Vector3<f64> },
}

impl Constant {
    /// The curve with its section frame.
    pub fn new(bend: f64, torsion: f64, length: f64, frame: &SectionFrame) -> Result<Self, ShapeError> {
        let rule = match frame {
            SectionFrame::Natural => Rule::Fixed { angle: 0.0 },
            SectionFrame::Frenet { offset } if !offset.is_finite() => {
                return Err(ShapeError::NotFinite { what: "Frenet offset", value: *offset });
            }
            SectionFrame::Frenet { .. } if bend == 0.0 => return Err(ShapeError::FrenetUndefined { s: 0.0 }),
            SectionFrame::Frenet { offset } => Rule::Fixed { angle: -offset },
            SectionFrame::RotationMinimising { start, twist } => {
                let e2 = start_direction(start.as_ref(), &Vector3::x())?;
                Rule::Minimising { start: e2.z.atan2(e2.y), twist: Twist::new(twist.clone(), length)? }
            }
            SectionFrame::Direction { along } => Rule::Along { direction: unit(along)? },
        };
        let rule = match rule {
            // Without torsion and twist the angle from the normal never changes.
            Rule::Minimising { start, twist } if torsion == 0.0 && twist.is_none() => {
                Rule::Fixed { angle: start }
            }
            rule => rule,
        };
        let curve = Self { bend, torsion, rule };
        if let Rule::Along { direction } = &curve.rule {
            curve.refuse_parallel(direction, length)?;
        }
        Ok(curve)
    }

    /// (k1, k2, k3) if they are the same everywhere.
    pub fn uniform(&self) -> Option<Vector3<f64>> {
        match &self.rule {
            Rule::Fixed { angle } => Some(self.curvatures(*angle, self.torsion)),
            _ if self.bend == 0.0 => match &self.rule {
                Rule::Minimising { twist, .. } if !twist.is_none() => None,
                _ => Some(Vector3::zeros()),
            },
            _ => None,
        }
    }

    /// Arc lengths at which a twist is not smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        match &self.rule {
            Rule::Minimising { twist, .. } => twist.breaks(length),
            Rule::Fixed { .. } | Rule::Along { .. } => Vec::new(),
        }
    }

    /// By how much (rad) the section may turn back and forth between two arc lengths without that a few places show it.
    pub fn hidden_turn(&self, a: f64, b: f64) -> f64 {
        match &self.rule {
            Rule::Minimising { twist, .. } => twist.hidden_turn(a, b),
            Rule::Fixed { .. } | Rule::Along { .. } => 0.0,
        }
    }

    /// (k1, k2, k3) at arc length `s`.
    pub fn curvature(&self, s: f64) -> Vector3<f64> {
        match &self.rule {
            Rule::Fixed { angle } => self.curvatures(*angle, self.torsion),
            Rule::Minimising { start, twist } => {
                let (angle, rate) = twist.at(s);
                self.curvatures(start - self.torsion * s + angle, rate)
            }
            Rule::Along { direction } => {
                let local = self.local(s);
                let e2 = across(direction, &local.tangent).normalize();
                let e3 = local.tangent.cross(&e2);
                Vector3::new(-reference_rate(&local, direction), -local.bend.dot(&e3), local.bend.dot(&e2))
            }
        }
    }

    /// The section's axes and place in the curve's own coordinates.
    pub fn pose(&self, s: f64) -> Pose {
        let frenet = uniform_pose(&Vector3::new(self.torsion, 0.0, self.bend), s);
        let angle = match &self.rule {
            Rule::Fixed { angle } => *angle,
            Rule::Minimising { start, twist } => start - self.torsion * s + twist.at(s).0,
            Rule::Along { direction } => {
                let e1 = frenet.rotation * Vector3::x();
                let e2 = across(direction, &e1).normalize();
                return Pose::new(rotation_from_axes(&e1, &e2, &e1.cross(&e2)), frenet.position);
            }
        };
        Pose::new(frenet.rotation * exp(&Vector3::new(angle, 0.0, 0.0)), frenet.position)
    }

    /// With ψ from the normal: k2 = κ sin ψ, k3 = κ cos ψ.
    fn curvatures(&self, angle: f64, k1: f64) -> Vector3<f64> {
        // An angle of exactly zero must leave k2 exactly zero.
        let (sine, cosine) = angle.sin_cos();
        Vector3::new(k1, self.bend * sine, self.bend * cosine)
    }

    fn local(&self, s: f64) -> Local {
        let frenet = uniform_pose(&Vector3::new(self.torsion, 0.0, self.bend), s);
        let bend = frenet.rotation * Vector3::y() * self.bend;
        Local {
            position: frenet.position,
            speed: 1.0,
            tangent: frenet.rotation * Vector3::x(),
            bend,
            torsion: self.torsion,
        }
    }

    /// The tangent circles about the Darboux axis, so its angle to the direction is least where they are in
    /// one plane with the axis: a closed form.
    fn refuse_parallel(&self, direction: &Vector3<f64>, length: f64) -> Result<(), ShapeError> {
        let rate = self.bend.hypot(self.torsion);
        let sine = |s: f64| across(direction, &self.local(s).tangent).norm();
        let mut places = vec![0.0, length];
        if rate > 0.0 {
            let axis = Vector3::new(self.torsion, 0.0, self.bend) / rate;
            let (a, b) = (across(&Vector3::x(), &axis), axis.cross(&Vector3::x()));
            let phase = direction.dot(&b).atan2(direction.dot(&a));
            // Nearest and farthest along the circle, once each: the turns after them are the same.
            for half in -1..4 {
                places.push((phase + f64::from(half) * std::f64::consts::PI) / rate);
            }
        }
        places.sort_by(f64::total_cmp);
        match places.into_iter().find(|s| (0.0..=length).contains(s) && sine(*s) < 1e-6) {
            Some(s) => Err(ShapeError::DirectionParallel { s }),
            None => Ok(()),
        }
    }
}

/// The pose reached after `s` along a curve of constant curvatures `k`: exp of s (k, e1) in SE(3).
///
/// p = s [sinc θ e1 + (1 - cos θ)/θ n×e1 + (1 - sinc θ)(n·e1) n], θ = |k| s, n = k/|k|, with
/// (1 - cos θ)/θ = sin²(θ/2)/(θ/2), free of cancellation.
pub(crate) fn uniform_pose(k: &Vector3<f64>, s: f64) -> Pose {
    let rate = k.norm();
    let angle = rate * s;
    if angle == 0.0 {
        return Pose::translation(Vector3::new(s, 0.0, 0.0));
    }
    let n = k / rate;
    let half = 0.5 * angle;
    let sinc = angle.sin() / angle;
    let across = half.sin() * half.sin() / half;
    let e1 = Vector3::x();
    let position = (e1 * sinc + n.cross(&e1) * across + n * (n.x * (1.0 - sinc))) * s;
    Pose::new(exp(&(k * s)), position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::turned;

    #[test]
    fn the_pose_of_an_arc_is_the_circle() {
        for s in [1e-9f64, 1e-3, 0.7, 25.0] {
            let pose = uniform_pose(&Vector3::new(0.0, 0.0, 2.0), s);
            let exact = Vector3::new((2.0 * s).sin() / 2.0, s.sin().powi(2), 0.0);
            assert!((pose.position - exact).norm() < 1e-15 * (1.0 + s), "{s}");
        }
    }

    #[test]
    fn turning_a_normal_keeps_its_length() {
        let t = Vector3::new(0.6, 0.0, 0.8);
        let a = turned(&Vector3::y(), &t, 0.7);
        assert!((a.norm() - 1.0).abs() < 1e-15 && a.dot(&t).abs() < 1e-16);
    }
}
