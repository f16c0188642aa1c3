//! Bodies that touch: points coincide, normals oppose, travels add up, and nothing acts across a smooth contact.

use super::answer::{Answer, Check, V};
use super::joints::{Along, effort};
use flexura::model::{
    BoundaryCurve, Contact, Joint, JointKind, Rolling, RollingCoordinate, Slide, Surface, SurfaceMotion,
};
use flexura::output::{ContactDocument, JointDocument};
use flexura::spatial::{Pose, Wrench, left_jacobian, log};

/// A joint that touches, with what is known of it.
pub struct Touching<'a> {
    pub joint: &'a Joint,
    pub told: &'a JointDocument,
    /// Poses of F and M, global.
    pub fixed: Pose,
    pub moving: Pose,
    /// Of the parent on the child at M's origin, in F's axes.
    pub wrench: Wrench,
    pub geared: f64,
}

impl Touching<'_> {
    pub fn check(&self, answer: &Answer, checks: &mut Vec<Check>) {
        let Some(contact) = &self.told.contact else { return };
        let mut say = |what: &str, difference: f64| {
            checks.push(Check { what: format!("{what} of joint.{}", self.joint.name), difference });
        };
        let point = V::from(contact.point);
        let [on_child, on_parent] = [&contact.child, &contact.parent].map(|side| V::from(side.point));
        let unit = answer.length.max(on_parent.norm()).max(on_child.norm());
        say("contact point on the parent", (self.fixed.point(&on_parent) - point).norm() / unit);
        say("contact point on the child", (self.moving.point(&on_child) - point).norm() / unit);
        let normal = self.fixed.rotation.inverse() * V::from(contact.normal);
        let seen = self.moving.rotation.inverse() * V::from(contact.normal);
        match self.joint.law.contact.as_deref() {
            Some(Contact::Rolling(rolling)) => {
                self.curves(rolling, contact, &normal, &seen, &mut say);
                self.rolling_effort(answer, rolling, contact, checks);
            }
            Some(Contact::Surfaces(surfaces)) => {
                let inward = if surfaces.concave { -1.0 } else { 1.0 };
                for (surface, at, outward, name) in [
                    (&surfaces.parent, &on_parent, normal * inward, "parent"),
                    (&surfaces.child, &on_child, -seen, "child"),
                ] {
                    if let Some((height, direction)) = implicit(surface, at) {
                        say(&format!("surface of the {name}"), height);
                        say(&format!("normal of the {name}"), (direction - outward).norm());
                    }
                }
                if surfaces.motion == SurfaceMotion::Sliding {
                    self.sliding_effort(answer, contact, &on_parent, checks);
                }
            }
            None => {}
        }
    }

    /// Points, normals and travels on curves of a closed form.
    fn curves(
        &self,
        rolling: &Rolling,
        contact: &ContactDocument,
        normal: &V,
        seen: &V,
        say: &mut impl FnMut(&str, f64),
    ) {
        let (x, n) = (self.joint.law.second_axis, self.joint.law.axis);
        let y = n.cross(&x);
        let flat = |v: &V| [x.dot(v), y.dot(v)];
        let inward = if rolling.concave { -1.0 } else { 1.0 };
        let sides = [
            (&rolling.child.curve, &contact.child, flat(&-seen), "child"),
            (&rolling.parent.curve, &contact.parent, flat(&(normal * inward)), "parent"),
        ];
        let start = rolling.start;
        for (i, (curve, side, outward, name)) in sides.into_iter().enumerate() {
            let t = side.parameters[0];
            let Some((point, direction)) = on_curve(curve, t) else { continue };
            let here = flat(&V::from(side.point));
            let unit = point[0].hypot(point[1]).max(f64::MIN_POSITIVE);
            say(&format!("curve of the {name}"), (point[0] - here[0]).hypot(point[1] - here[1]) / unit);
            say(
                &format!("normal of the {name}"),
                (direction[0] - outward[0]).hypot(direction[1] - outward[1]),
            );
            if let Some(start) = start {
                let travel = arc(curve, start[i], t).abs();
                let wanted = if i == 0 { contact.roll + contact.slide } else { contact.roll };
                say(&format!("travel on the {name}"), (travel - wanted.abs()).abs() / unit.max(travel));
            }
        }
        self.slide(rolling, contact, say);
    }

    /// The slide that belongs to the coordinate, and what the coordinate counts.
    fn slide(&self, rolling: &Rolling, contact: &ContactDocument, say: &mut impl FnMut(&str, f64)) {
        let q = self.told.coordinates.first().copied().unwrap_or(0.0);
        let slide = match &rolling.slide {
            Slide::None => Some(0.0),
            Slide::Ratio { ratio } => Some(contact.roll / ratio),
            Slide::Velocity { velocity, rate } => Some(velocity / rate * q),
            Slide::Function(law) => Some(law.value(q)),
            Slide::Pure => {
                say("pure slide", contact.roll.abs() / contact.slide.abs().max(f64::MIN_POSITIVE));
                None
            }
            Slide::Table(_) | Slide::Measured { .. } | Slide::Stepped { .. } => None,
        };
        if let Some(slide) = slide {
            let unit = contact.roll.abs().max(contact.slide.abs()).max(f64::MIN_POSITIVE);
            // Nothing has moved to speak of.
            if unit > 1e-14 {
                say("slide law", (slide - contact.slide).abs() / unit);
            }
        }
        let angle = log(&(self.fixed.rotation.inverse() * self.moving.rotation)).norm();
        if self.joint.law.kind == JointKind::Rolling(RollingCoordinate::Arc) {
            say("arc", (q - contact.roll - contact.slide).abs() / q.abs().max(f64::MIN_POSITIVE).max(1e-14));
        }
        if angle < 3.0
            && self.joint.law.kind == JointKind::Rolling(RollingCoordinate::Angle)
            && rolling.start.is_some()
        {
            self.angle(rolling, q, say);
        }
    }

    /// The coordinate is the angle by which the child has turned since the two touched at `start`.
    fn angle(&self, rolling: &Rolling, q: f64, say: &mut impl FnMut(&str, f64)) {
        let Some(start) = rolling.start else { return };
        let normals = (on_curve(&rolling.child.curve, start[0]), on_curve(&rolling.parent.curve, start[1]));
        let (Some((_, child)), Some((_, parent))) = normals else { return };
        let inward = if rolling.concave { -1.0 } else { 1.0 };
        // At coordinate zero the child's outward normal is turned onto minus the parent's.
        let zero = (-parent[1] * inward).atan2(-parent[0] * inward) - child[1].atan2(child[0]);
        let (x, n) = (self.joint.law.second_axis, self.joint.law.axis);
        let turned = (self.fixed.rotation.inverse() * self.moving.rotation) * x;
        let now = n.cross(&x).dot(&turned).atan2(x.dot(&turned));
        let off = (now - zero - q).rem_euclid(std::f64::consts::TAU);
        say("angle", off.min(std::f64::consts::TAU - off));
    }

    /// Virtual work of a joint whose coordinate is the child's angle: it turns about the contact and slides along it.
    fn rolling_effort(
        &self,
        answer: &Answer,
        rolling: &Rolling,
        contact: &ContactDocument,
        checks: &mut Vec<Check>,
    ) {
        if self.joint.law.kind != JointKind::Rolling(RollingCoordinate::Angle) {
            return;
        }
        let n = self.joint.law.axis;
        let offset = self.fixed.rotation.inverse() * (self.moving.position - V::from(contact.point));
        let moment = self.wrench.moment + offset.cross(&self.wrench.force);
        let normal = self.fixed.rotation.inverse() * V::from(contact.normal);
        let tangent = n.cross(&normal);
        let slip = contact.slide_rate * tangent.dot(&self.wrench.force);
        let law = &self.joint.law.coordinates[0];
        let mut best: Option<Vec<Check>> = None;
        let signs: &[f64] = if matches!(rolling.slide, Slide::None) { &[0.0] } else { &[1.0, -1.0] };
        for sign in signs {
            let along = Along {
                value: self.told.coordinates[0],
                effort: n.dot(&moment) + sign * slip,
                is_angle: true,
            };
            let mut found = Vec::new();
            effort(answer, &format!("joint.{}", self.joint.name), &along, law, self.geared, &mut found);
            let worst = |checks: &[Check]| checks.iter().map(|check| check.difference).fold(0.0, f64::max);
            if best.as_ref().is_none_or(|best| worst(&found) < worst(best)) {
                best = Some(found);
            }
        }
        checks.extend(best.unwrap_or_default());
    }

    /// No force but along the normal, and about the contact only what the springs of the turning give.
    fn sliding_effort(&self, answer: &Answer, contact: &ContactDocument, at: &V, checks: &mut Vec<Check>) {
        let normal = self.fixed.rotation.inverse() * V::from(contact.normal);
        let pressed = normal.dot(&self.wrench.force);
        let across = self.wrench.force - normal * pressed;
        checks.push(Check {
            what: format!("friction of joint.{}", self.joint.name),
            difference: across.norm() / answer.force,
        });
        let relative = self.fixed.inverse() * self.moving;
        let moment = self.wrench.moment + (relative.position - at).cross(&self.wrench.force);
        let v = match self.told.coordinates[..] {
            [x, y, z, ..] => V::new(x, y, z),
            _ => log(&relative.rotation),
        };
        let along = left_jacobian(&v).transpose() * moment;
        for i in 0..3 {
            let along = Along { value: v[i], effort: along[i], is_angle: true };
            let name = format!("joint.{} [{i}]", self.joint.name);
            effort(answer, &name, &along, &self.joint.law.coordinates[i], 0.0, checks);
        }
    }
}

/// The point of a curve at its parameter, and the outward normal of what it bounds.
fn on_curve(curve: &BoundaryCurve, t: f64) -> Option<([f64; 2], [f64; 2])> {
    match curve {
        BoundaryCurve::Ellipse { semi_axes: [a, b], .. } => {
            let (sin, cos) = t.sin_cos();
            let (x, y) = (b * cos, a * sin);
            let norm = x.hypot(y);
            Some(([a * cos, b * sin], [x / norm, y / norm]))
        }
        BoundaryCurve::Line { point, normal, .. } => {
            let norm = normal[0].hypot(normal[1]);
            let (x, y) = (normal[0] / norm, normal[1] / norm);
            Some(([point[0] - t * y, point[1] + t * x], [x, y]))
        }
        BoundaryCurve::Arcs { .. } | BoundaryCurve::Points { .. } | BoundaryCurve::Expression { .. } => None,
    }
}

/// Length along a curve between two parameters, by Gauss's rule on parts.
fn arc(curve: &BoundaryCurve, from: f64, to: f64) -> f64 {
    match curve {
        BoundaryCurve::Ellipse { semi_axes: [a, b], .. } => {
            let parts = 400;
            let h = (to - from) / f64::from(parts);
            let speed = |t: f64| (a * t.sin()).hypot(b * t.cos());
            let node = 0.5 / 3f64.sqrt();
            let part = |i: i32| {
                let middle = from + h * (f64::from(i) + 0.5);
                0.5 * h * (speed(middle - node * h) + speed(middle + node * h))
            };
            (0..parts).map(part).sum()
        }
        _ => to - from,
    }
}

/// How far a point is from a surface, relative to its size, and the outward normal there.
fn implicit(surface: &Surface, at: &V) -> Option<(f64, V)> {
    match surface {
        Surface::Ellipsoid { semi_axes } => {
            let scaled = at.component_div(semi_axes);
            let gradient = scaled.component_div(semi_axes);
            Some(((scaled.norm() - 1.0).abs(), gradient.normalize()))
        }
        Surface::Cylinder { semi_axes: [a, b] } => {
            let (x, y) = (at.x / a, at.y / b);
            Some(((x.hypot(y) - 1.0).abs(), V::new(x / a, y / b, 0.0).normalize()))
        }
        Surface::Plane => Some((at.z.abs() / at.norm().max(f64::MIN_POSITIVE), V::z())),
        Surface::Revolution { .. } | Surface::Heights { .. } => None,
    }
}
