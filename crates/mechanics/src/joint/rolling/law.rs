//! The geometry of two boundaries that roll and slide on each other, in the plane of the joint, in metres.
//!
//! The child's boundary A has its body on the left along growing arc length, as the parent's B. In contact the points
//! coincide and the outward normals are opposite, T_A = -T_B, or equal where the child lies within the parent's curve,
//! T_A = T_B. As the child turns counter-clockwise against the contact normal, the contact travels backwards on A by a, and on B by
//! b, forwards where B is convex (ε = 1) and backwards where it is hollow (ε = -1):
//!
//! ```text
//!   s_A = s_A0 - a        α = α_0 + [Θ_B(s_B) - Θ_B(s_B0)] - [Θ_A(s_A) - Θ_A(s_A0)]
//!   s_B = s_B0 + ε b      p = P_B(s_B) - R(α) P_A(s_A)
//! ```
//!
//! so that dα = κ_A da + ε κ_B db, and the child's point in contact moves by -ε T_B (da - db): not at all without slip.

use super::touch;
use super::travel::{Jet, Slip, Travel, outwards};
use crate::joint::ContactError;
use flexura_geometry::{Contour, ContourPoint};
use flexura_model::{Rolling, RollingCoordinate};
use std::f64::consts::{PI, TAU};

/// Coordinates further than this from the start are not looked at when the range of motion is sought, in turns.
const TURNS: f64 = 4.0;

/// A pair of boundaries with the law of their travel.
#[derive(Clone, Debug)]
pub struct RollingLaw {
    pub(super) child: Contour,
    pub(super) parent: Contour,
    /// 1 on a convex parent, -1 within a hollow.
    pub(super) sense: f64,
    pub(super) coordinate: RollingCoordinate,
    slip: Slip,
    /// Arc lengths of the first contact.
    pub(super) start: [f64; 2],
    /// Angle of the child at the first contact.
    pub(super) angle: f64,
    first: [ContourPoint; 2],
    /// Coordinates between which there is contact; infinite where no end was found.
    pub(super) range: [f64; 2],
    step: f64,
}

/// Everything at one coordinate, with derivatives by it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub travel: Travel,
    pub child: ContourPoint,
    pub parent: ContourPoint,
    pub angle: Jet,
    pub position: [[f64; 2]; 3],
}

fn turned(v: [f64; 2]) -> [f64; 2] {
    [-v[1], v[0]]
}

fn rotated(angle: f64, v: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

impl RollingLaw {
    /// The law of a joint whose child is at `position` (m) under `angle` in the plane of the parent.
    ///
    /// # Errors
    /// [`ContactError`]: boundaries, a first contact or a slide law that make no sense.
    pub fn new(
        rolling: &Rolling,
        coordinate: RollingCoordinate,
        position: [f64; 2],
        angle: f64,
    ) -> Result<Self, ContactError> {
        let contour = |which, boundary| {
            Contour::new(boundary).map_err(|source| ContactError::Boundary { which, source })
        };
        let (child, parent) = (contour("child", &rolling.child)?, contour("parent", &rolling.parent)?);
        if child.is_straight() && parent.is_straight() {
            return Err(ContactError::BothStraight);
        }
        if coordinate == RollingCoordinate::Turning && !child.is_convex() {
            return Err(ContactError::NotConvex);
        }
        let slip = Slip::new(&rolling.slide, coordinate)?;
        let sense = if rolling.concave { -1.0 } else { 1.0 };
        let start = match rolling.start {
            Some(parameters) => {
                let arc = |which, contour: &Contour, parameter: f64| {
                    contour.arc_of(parameter).ok_or(ContactError::StartOutside { which, parameter })
                };
                [arc("child", &child, parameters[0])?, arc("parent", &parent, parameters[1])?]
            }
            None => touch::closest(&child, &parent, sense, position, angle).ok_or(ContactError::NoContact)?,
        };
        let [a, b] = [child.at(start[0]), parent.at(start[1])];
        let first = match (a, b) {
            (Some(a), Some(b)) => [a, b],
            _ => return Err(ContactError::NoContact),
        };
        // The child's own angle, whole turns aside, as near as can be to that of its initial pose.
        let opposite = if rolling.concave { 0.0 } else { PI };
        let own = first[1].angle + opposite - first[0].angle;
        let angle = own - TAU * ((own - angle) / TAU).round();
        let conforming = first[0].curvature + sense * first[1].curvature;
        let tight = 1e-9 * (first[0].curvature.abs() + first[1].curvature.abs());
        let pure = matches!(slip, Slip::Relative { share: 0.0, .. });
        if rolling.concave && (conforming < -tight || (conforming <= tight && !pure)) {
            let [child, parent] = first.map(|place| 1.0 / place.curvature);
            return Err(ContactError::TooCurved { child, parent });
        }
        if conforming.abs() <= tight && !pure && coordinate == RollingCoordinate::Angle {
            return Err(ContactError::Conforming { coordinate: "angle" });
        }
        let step = 0.5 * child.step().min(parent.step());
        let mut law = Self {
            child,
            parent,
            sense,
            coordinate,
            slip,
            start,
            angle,
            first,
            range: [f64::NEG_INFINITY, f64::INFINITY],
            step,
        };
        law.range = [law.end(-1.0), law.end(1.0)];
        Ok(law)
    }

    /// Radius of the tightest curve, m, for looking at steps.
    fn unit(&self) -> f64 {
        match self.coordinate {
            RollingCoordinate::Arc => self.step,
            _ => 0.25,
        }
    }

    /// The last coordinate in a direction at which the boundaries touch.
    fn end(&self, sign: f64) -> f64 {
        let known = self.slip.range().map(|range| if sign < 0.0 { range[0] } else { range[1] });
        let unlimited = self.child.range().is_none() && self.parent.range().is_none() && self.sense > 0.0;
        if unlimited && known.is_none() {
            return sign * f64::INFINITY;
        }
        let most = match self.coordinate {
            RollingCoordinate::Arc => {
                let length = |contour: &Contour| contour.length().unwrap_or(0.0);
                TURNS * length(&self.child).max(length(&self.parent))
            }
            _ => TURNS * TAU,
        };
        let (mut inner, mut width) = (0.0, self.unit());
        while inner < most {
            let next: f64 = (inner + width).min(most);
            let inside = known.is_none_or(|end| sign * (end - sign * next) >= 0.0);
            if inside && self.place(sign * next).is_some() {
                inner = next;
            } else if width > 1e-13 * self.unit() {
                width *= 0.25;
            } else {
                return sign * inner;
            }
        }
        sign * f64::INFINITY
    }

    /// Travel and geometry at a coordinate; None where there is no contact.
    pub(super) fn place(&self, q: f64) -> Option<Placed> {
        let travel = self.travel(q)?;
        let ([a, da, dda], [b, db, ddb]) = (travel.child, travel.parent);
        let child = self.child.at(self.start[0] - a)?;
        let parent = self.parent.at(self.start[1] + self.sense * b)?;
        let (ka, kb) = (child.curvature, parent.curvature);
        let angle = [
            self.angle + (parent.angle - self.first[1].angle) - (child.angle - self.first[0].angle),
            ka * da + self.sense * kb * db,
            ka * dda - child.curvature_rate * da * da
                + self.sense * kb * ddb
                + parent.curvature_rate * db * db,
        ];
        let arm = rotated(angle[0], child.point);
        let along = rotated(angle[0], child.tangent());
        let tangent = parent.tangent();
        let (inward, spin) = (turned(tangent), angle[1]);
        // W = R P_A and its derivatives.
        let arm_rate = sum(&[(spin, turned(arm)), (-da, along)]);
        let arm_bend = sum(&[
            (angle[2], turned(arm)),
            (spin, turned(arm_rate)),
            (-dda, along),
            (-da * (spin - ka * da), turned(along)),
        ]);
        let position = [
            sum(&[(1.0, parent.point), (-1.0, arm)]),
            sum(&[(self.sense * db, tangent), (-1.0, arm_rate)]),
            sum(&[(kb * db * db, inward), (self.sense * ddb, tangent), (-1.0, arm_bend)]),
        ];
        Some(Placed { travel, child, parent, angle, position })
    }

    fn travel(&self, q: f64) -> Option<Travel> {
        match &self.slip {
            Slip::Measured { roll, slide } => {
                let (roll, slide) = (roll.jet(q), slide.jet(q));
                let child = std::array::from_fn(|i| roll[i] + slide[i]);
                Some(Travel { child, parent: [roll[0], roll[1], roll[2]] })
            }
            Slip::Stepped { step } => {
                let child = self.stepped(q, *step)?;
                Some(Travel { child, parent: child })
            }
            Slip::Relative { share, slide } => {
                let s = slide.jet(q);
                let child = match self.coordinate {
                    RollingCoordinate::Arc => [q, 1.0, 0.0],
                    RollingCoordinate::Turning => self.by_turning(q)?,
                    RollingCoordinate::Angle => self.by_angle(q, *share, &s)?,
                };
                let parent = std::array::from_fn(|i| share * child[i] - s[i]);
                Some(Travel { child, parent })
            }
        }
    }

    /// ∫κ_A da = q, so that a' = 1/κ_A.
    fn by_turning(&self, q: f64) -> Option<Jet> {
        // Whole turns of a closed boundary are known.
        let (whole, rest) = match self.child.length().filter(|_| self.child.range().is_none()) {
            Some(length) => {
                let turns = (q / TAU).trunc();
                (turns * length, q - turns * TAU)
            }
            None => (0.0, q),
        };
        let a = whole
            + outwards(rest, self.step, |a| {
                let place = self.child.at(self.start[0] - a)?;
                Some((self.first[0].angle - place.angle, place.curvature))
            })?;
        let place = self.child.at(self.start[0] - a)?;
        let da = 1.0 / place.curvature;
        Some([a, da, place.curvature_rate * da.powi(3)])
    }

    /// ∫κ_A da + ε ∫κ_B db = q with b = c a - S(q).
    fn by_angle(&self, q: f64, share: f64, s: &Jet) -> Option<Jet> {
        let places = |a: f64| {
            let child = self.child.at(self.start[0] - a)?;
            let parent = self.parent.at(self.start[1] + self.sense * (share * a - s[0]))?;
            Some((child, parent))
        };
        let turn = |child: &ContourPoint, parent: &ContourPoint| {
            (self.first[0].angle - child.angle) + (parent.angle - self.first[1].angle)
        };
        let (child, parent) = places(0.0)?;
        let already = turn(&child, &parent);
        let a = outwards(q - already, self.step, |a| {
            let (child, parent) = places(a)?;
            let slope = child.curvature + self.sense * share * parent.curvature;
            (slope > 0.0).then(|| (turn(&child, &parent) - already, slope))
        })?;
        let (child, parent) = places(a)?;
        let (ka, kb) = (child.curvature, self.sense * parent.curvature);
        let total = ka + kb * share;
        let da = (1.0 + kb * s[1]) / total;
        let db = share * da - s[1];
        let dda = (child.curvature_rate * da * da + kb * s[2] - parent.curvature_rate * db * db) / total;
        Some([a, da, dda])
    }

    /// The thesis's recipe: in every step of q the travel has the radius at its beginning.
    fn stepped(&self, q: f64, step: f64) -> Option<Jet> {
        let sign = q.signum();
        let mut a = 0.0;
        let radius = |a: f64| self.child.at(self.start[0] - a).map(|place| 1.0 / place.curvature);
        let whole = (q.abs() / step + 1e-12).floor();
        for _ in 0..whole as usize {
            a += sign * step * radius(a)?;
        }
        let rate = radius(a)?;
        Some([a + sign * (q.abs() - whole * step).max(0.0) * rate, rate, 0.0])
    }

    /// Is the parent's hollow wider than the child where they touch?
    pub(super) fn fits(&self, placed: &Placed) -> bool {
        self.sense > 0.0 || placed.child.curvature >= placed.parent.curvature * (1.0 - 1e-9)
    }

    /// The coordinate at which the child has an angle near that of its first contact; the end of its range where it has not.
    pub(super) fn with_angle(&self, angle: f64) -> f64 {
        let turn = angle - self.angle;
        let turn = turn - TAU * (turn / TAU).round();
        let found = outwards(turn, self.unit(), |q| {
            let placed = self.place(q)?;
            (placed.angle[1] > 0.0).then_some((placed.angle[0] - self.angle, placed.angle[1]))
        });
        found.unwrap_or(0.0)
    }
}

fn sum(parts: &[(f64, [f64; 2])]) -> [f64; 2] {
    let component = |i: usize| parts.iter().map(|(factor, v)| factor * v[i]).sum();
    [component(0), component(1)]
}
