//! Joints and holds: do the frames fit, and do the efforts obey the laws of the coordinates?

use super::answer::{Answer, Check, V};
use flexura::model::{CoordinateLaw, Drive, JointKind, JointLaw};
use flexura::spatial::{Pose, Wrench, exp, left_jacobian, log};
use std::f64::consts::TAU;

/// What a law is held against.
pub struct Held<'a> {
    pub name: String,
    pub law: &'a JointLaw,
    /// X_FM.
    pub pose: Pose,
    /// Of the parent on the child at M's origin, in F's axes.
    pub wrench: Wrench,
    /// As the document tells them, if it does.
    pub coordinates: Option<&'a [f64]>,
    /// Of couplings on each coordinate.
    pub geared: Vec<f64>,
}

/// One coordinate: its value, and what the wrench does along it.
pub struct Along {
    pub value: f64,
    pub effort: f64,
    pub is_angle: bool,
}

fn angle_about(axis: &V, pose: &Pose) -> f64 {
    let q = pose.rotation.quaternion();
    let half = V::new(q.i, q.j, q.k).dot(axis).atan2(q.w);
    // Of an angle and the same a turn on, the one within half a turn.
    2.0 * half - TAU * (2.0 * half / TAU).round()
}

fn driven_to(law: &CoordinateLaw) -> Option<f64> {
    match law.drive {
        Drive::Driven { coordinate } => Some(coordinate),
        Drive::Free { .. } => None,
    }
}

/// The angle a turn or more on that is nearest to the one that is told.
fn counted(angle: f64, told: Option<f64>) -> f64 {
    told.map_or(angle, |told| angle + TAU * ((told - angle) / TAU).round())
}

impl Held<'_> {
    /// About where an angle is: as it is told or driven; else, since a turn on looks alike, where its spring would carry the
    /// effort that there is.
    fn told(&self, i: usize, effort: f64) -> Option<f64> {
        let law = self.law.coordinates.get(i)?;
        self.coordinates.and_then(|q| q.get(i).copied()).or(match law.drive {
            Drive::Driven { coordinate } => Some(coordinate),
            Drive::Free { effort: given } if law.stiffness > 0.0 => {
                Some(law.rest + (given - effort) / law.stiffness)
            }
            Drive::Free { .. } => None,
        })
    }

    /// The coordinates that X_FM has, with the efforts, and the X_FM that they make.
    fn resolve(&self) -> Option<(Vec<Along>, Pose)> {
        let (axis, second) = (self.law.axis, self.law.second_axis);
        let (p, f, m) = (self.pose.position, self.wrench.force, self.wrench.moment);
        let turn = |axis: &V, pose: &Pose, i: usize, effort: f64| Along {
            value: counted(angle_about(axis, pose), self.told(i, effort)),
            effort,
            is_angle: true,
        };
        let slide = |along: &V| Along { value: along.dot(&p), effort: along.dot(&f), is_angle: false };
        let about = |axis: &V, angle: f64, position: V| Pose::new(exp(&(axis * angle)), position);
        Some(match self.law.kind {
            JointKind::Weld => (Vec::new(), Pose::identity()),
            JointKind::Revolute => {
                let q = turn(&axis, &self.pose, 0, axis.dot(&m));
                let pose = about(&axis, q.value, V::zeros());
                (vec![q], pose)
            }
            JointKind::Prismatic => {
                let q = slide(&axis);
                let pose = Pose::translation(axis * q.value);
                (vec![q], pose)
            }
            JointKind::Cylindrical => {
                let (q, z) = (turn(&axis, &self.pose, 0, axis.dot(&m)), slide(&axis));
                let pose = about(&axis, q.value, axis * z.value);
                (vec![q, z], pose)
            }
            JointKind::Universal => {
                let carried = self.pose.rotation * second;
                let first = axis.cross(&second).dot(&carried).atan2(second.dot(&carried));
                let first = counted(first, self.told(0, axis.dot(&m)));
                let rest = Pose::new(exp(&(axis * -first)) * self.pose.rotation, V::zeros());
                let q = Along { value: first, effort: axis.dot(&m), is_angle: true };
                let r = turn(&second, &rest, 1, (exp(&(axis * first)) * second).dot(&m));
                let pose = Pose::new(exp(&(axis * first)) * exp(&(second * r.value)), V::zeros());
                (vec![q, r], pose)
            }
            JointKind::Planar => {
                let across = axis.cross(&second);
                let (x, y) = (slide(&second), slide(&across));
                let q = turn(&axis, &self.pose, 2, axis.dot(&m));
                let pose = about(&axis, q.value, second * x.value + across * y.value);
                (vec![x, y, q], pose)
            }
            JointKind::Spherical | JointKind::Free => self.ball(),
            JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling => return None,
        })
    }

    /// The rotation vector of a spherical or free joint, with the position of the latter.
    fn ball(&self) -> (Vec<Along>, Pose) {
        let free = self.law.kind == JointKind::Free;
        let first = if free { 3 } else { 0 };
        let told = self.coordinates.and_then(|q| q.get(first..first + 3)).map(<[f64]>::to_vec);
        let driven = || -> Option<Vec<f64>> {
            let laws = self.law.coordinates.get(first..first + 3)?;
            laws.iter().map(driven_to).collect()
        };
        let told = told.or_else(driven);
        let v = told.map_or_else(|| self.turned_by(first), |q| V::new(q[0], q[1], q[2]));
        // δX turns by J(v) δv in F's axes, J the left Jacobian.
        let effort = left_jacobian(&v).transpose() * self.wrench.moment;
        let mut all = Vec::new();
        if free {
            let linear = (0..3).map(|i| Along {
                value: self.pose.position[i],
                effort: self.wrench.force[i],
                is_angle: false,
            });
            all.extend(linear);
        }
        all.extend((0..3).map(|i| Along { value: v[i], effort: effort[i], is_angle: true }));
        (all, Pose::new(exp(&v), if free { self.pose.position } else { V::zeros() }))
    }

    /// The rotation vector where no one tells it: of all that turn alike, whole turns more or less, the one that its springs fit best.
    fn turned_by(&self, first: usize) -> V {
        let least = log(&self.pose.rotation);
        let Some(axis) = least.try_normalize(1e-12) else { return least };
        let misfit = |v: &V| -> f64 {
            let effort = left_jacobian(v).transpose() * self.wrench.moment;
            let off = |i: usize| match self.law.coordinates.get(first + i) {
                Some(CoordinateLaw { drive: Drive::Free { effort: given }, stiffness, rest, .. }) => {
                    given - stiffness * (v[i] - rest) - effort[i]
                }
                _ => 0.0,
            };
            (0..3).map(|i| off(i).powi(2)).sum()
        };
        let whole = |k: i32| least + axis * (std::f64::consts::TAU * f64::from(k));
        (-2..=2).map(whole).min_by(|a, b| misfit(a).total_cmp(&misfit(b))).unwrap_or(least)
    }

    /// Closure, drives and efforts.
    pub fn check(&self, answer: &Answer, checks: &mut Vec<Check>) {
        let Some((along, wanted)) = self.resolve() else { return };
        let apart = wanted.inverse() * self.pose;
        let turned = log(&apart.rotation).norm();
        let moved = apart.position.norm() / answer.length;
        checks.push(Check { what: format!("closure of {}", self.name), difference: turned.max(moved) });
        for (i, (q, law)) in along.iter().zip(&self.law.coordinates).enumerate() {
            // A rotation vector that no one tells may be any of several.
            let is_ball = matches!(self.law.kind, JointKind::Spherical | JointKind::Free);
            if is_ball && q.is_angle && self.coordinates.is_none() && self.turned() > 3.0 {
                continue;
            }
            let geared = self.geared.get(i).copied().unwrap_or(0.0);
            effort(answer, &format!("{} [{i}]", self.name), q, law, geared, checks);
        }
    }
}

/// τ = effort - k (q - rest) - what a stop pushes + what couplings add; a driven coordinate is where it is driven.
pub fn effort(
    answer: &Answer,
    name: &str,
    along: &Along,
    law: &CoordinateLaw,
    geared: f64,
    checks: &mut Vec<Check>,
) {
    let (unit, stretch) = if along.is_angle { (answer.moment, 1.0) } else { (answer.force, answer.length) };
    if let (Some(told), Drive::Driven { coordinate }) = (Some(along.value), law.drive) {
        let off = (told - coordinate).abs() / stretch;
        checks.push(Check { what: format!("drive of {name}"), difference: off });
        return;
    }
    let Drive::Free { effort } = law.drive else { return };
    let spring = law.stiffness * (along.value - law.rest);
    let mut wanted = effort - spring + geared;
    let mut stiff = law.stiffness;
    if let Some(limits) = law.limits
        && let Some(stop) = limits.stiffness
    {
        let beyond = along.value - along.value.clamp(limits.range[0], limits.range[1]);
        wanted -= stop * beyond;
        stiff += stop;
    }
    // What a coordinate that is right to the last digits leaves open of the effort is no fault of it.
    let unit = unit + stiff * stretch;
    let off = (wanted - along.effort).abs() / unit;
    checks.push(Check { what: format!("effort law of {name}"), difference: off });
}

/// What the springs of its coordinates store.
pub fn energy(law: &JointLaw, values: &[f64]) -> f64 {
    let stored = law.coordinates.iter().zip(values).map(|(law, q)| {
        let spring = 0.5 * law.stiffness * (q - law.rest).powi(2);
        let stop = law.limits.and_then(|limits| {
            let beyond = q - q.clamp(limits.range[0], limits.range[1]);
            Some(0.5 * limits.stiffness? * beyond * beyond)
        });
        match law.drive {
            Drive::Free { .. } => spring + stop.unwrap_or(0.0),
            Drive::Driven { .. } => spring,
        }
    });
    stored.sum()
}

impl Held<'_> {
    fn turned(&self) -> f64 {
        log(&self.pose.rotation).norm()
    }

    /// Its coordinates, where they can be told.
    pub fn values(&self) -> Option<Vec<f64>> {
        if matches!(self.law.kind, JointKind::Spherical | JointKind::Free) && self.turned() > 3.0 {
            return None;
        }
        Some(self.resolve()?.0.iter().map(|along| along.value).collect())
    }
}
