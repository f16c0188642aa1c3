//! Rolling without slip and without spin, along a path: Montana's equations ("The kinematics of contact and grasp", Int. J.
//! Robotics Research 7 (1988)), with the shape operators S in F's axes.
//!
//! The contact travels with the same velocity w on both bodies, R ẋ_A = w = ẋ_B, and Ṙ = hat(ω) R. The rates of the normals
//! R m = -n_c, n_c = σ n, then say
//!
//! ```text
//!   K w = ω × n_c,   K = S_A + σ S_B   on the tangent plane,   ω·n = 0
//! ```
//!
//! With the axis a and its part a_T = a - (a·n) n in the tangent plane: *rolling* has ω = a_T. *Osculating* has w along
//! e = a × n_c/|a × n_c|, so that the path lies in the osculating plane across a_T (the thesis, 3.1): ω = n_c × K w, as large
//! as ω·a_T = |a_T|² makes it. Both are the same where e is a principal direction of K. M's origin has the velocity
//! -ω × R x_A.

use super::law::{Place, TouchingLaw, turning};
use super::{closest::closest, nowhere, radius, rows};
use crate::joint::{Configuration, ContactError, ContactState, Kinematics, MAX_FREEDOMS};
use crate::ode::{self, Rate, State};
use flexura_geometry::ImplicitSurface;
use flexura_geometry::dual::Scalar;
use flexura_geometry::dual::vector::{
    Rows, Triple, back, constant, cross, difference, dot, moving, norm, rates, scaled, sum, tangents, turned,
    unit,
};
use flexura_model::{SurfaceMotion, Surfaces};
use flexura_spatial::{Pose, Quaternion, Twist, UnitQuaternion, Vector3, exp, log};
use std::sync::Arc;

/// Longest panel, rad, and the shortest that is tried before the motion is said to end.
const LONGEST: f64 = 0.25;
const SHORTEST: f64 = 1e-9;
/// Most panels to each side.
const MOST: usize = 20_000;
/// Error of a panel, relative to the radius of the relative curvature.
const TOLERANCE: f64 = 1e-14;

/// Quaternion of R, x_A, x_B, travel of the contact.
type Numbers = State<11, 1>;

/// A rolling motion, integrated once.
#[derive(Clone, Debug)]
pub struct RollingPath {
    pub(super) law: TouchingLaw,
    /// a.
    axis: Triple<f64>,
    osculating: bool,
    /// Starts of panels, by growing angle.
    panels: Vec<(f64, Rolled)>,
    range: [f64; 2],
    /// Radius of the relative curvature at the first contact, m.
    scale: f64,
}

/// The state at one angle.
#[derive(Clone, Copy, Debug)]
struct Rolled {
    rotation: UnitQuaternion<f64>,
    child: Triple<f64>,
    parent: Triple<f64>,
    /// m since angle zero.
    travel: f64,
}

/// ω and w, per unit of the angle.
struct Flow<T> {
    omega: Triple<T>,
    velocity: Triple<T>,
}

impl Rolled {
    fn numbers(&self) -> Numbers {
        let q = self.rotation.quaternion();
        let ([a, b, c], [d, e, f]) = (self.child, self.parent);
        [q.w, q.i, q.j, q.k, a, b, c, d, e, f, self.travel].map(|x| [x])
    }

    fn from(y: &Numbers) -> Self {
        let q = Quaternion::new(y[0][0], y[1][0], y[2][0], y[3][0]);
        let three = |i: usize| [y[i][0], y[i + 1][0], y[i + 2][0]];
        Self {
            rotation: UnitQuaternion::from_quaternion(q),
            child: three(4),
            parent: three(7),
            travel: y[10][0],
        }
    }
}

impl Rate<11, 1> for RollingPath {
    #[inline(always)]
    fn rate(&self, _: usize, _: usize, state: &Numbers) -> Numbers {
        let at = Rolled::from(state);
        let rotation = rows(&at.rotation);
        let flow = self.flow(&rotation, &at.child, &at.parent);
        let [x, y, z] = flow.omega.map(|x| 0.5 * x);
        // q̇ = ½ (0, ω) q, with q as it is in the state.
        let q = Quaternion::new(state[0][0], state[1][0], state[2][0], state[3][0]);
        let dq = Quaternion::new(0.0, x, y, z) * q;
        let own = back(&rotation, &flow.velocity);
        let [a, b, c] = flow.velocity;
        [dq.w, dq.i, dq.j, dq.k, own[0], own[1], own[2], a, b, c, norm(&flow.velocity)].map(|x| [x])
    }
}

impl RollingPath {
    /// The motion from the contact nearest to the initial poses, `offset` in SI.
    ///
    /// # Errors
    /// [`ContactError`]: surfaces, a first contact, an axis or a range that make no sense.
    pub fn new(surfaces: &Surfaces, offset: &Pose) -> Result<Self, ContactError> {
        let law = TouchingLaw::new(surfaces)?;
        let (about, osculating) = match surfaces.motion {
            SurfaceMotion::Osculating { about } => (about, true),
            SurfaceMotion::Rolling { about } => (about, false),
            SurfaceMotion::Sliding => return Err(ContactError::NoAxis),
        };
        let long = about.norm();
        if !(long.is_finite() && long > 0.0) {
            return Err(ContactError::NoAxis);
        }
        let [from, to] = surfaces.range;
        if !(from <= 0.0 && to >= 0.0 && from < to && from.is_finite() && to.is_finite()) {
            return Err(ContactError::RollingRange { from, to });
        }
        let rotation = rows(&offset.rotation);
        let host = closest(&law, &rotation, &offset.position.into())?;
        let place = law.place(&rotation, &host).ok_or(ContactError::NoContact)?;
        let scale = 1.0 / law.relative(&rotation, &place).most;
        let axis: Triple<f64> = (about / long).into();
        if norm(&cross(&axis, &place.normal)) < 1e-6 {
            return Err(ContactError::AxisAlongNormal);
        }
        let start =
            Rolled { rotation: offset.rotation, child: place.child, parent: place.parent, travel: 0.0 };
        let mut made = Self { law, axis, osculating, panels: vec![(0.0, start)], range: [0.0; 2], scale };
        let (low, back) = made.integrated(start, from);
        let (high, forth) = made.integrated(start, to);
        made.range = [low, high];
        made.panels = back.into_iter().rev().chain([(0.0, start)]).chain(forth).collect();
        Ok(made)
    }

    /// The surfaces of child and parent.
    pub fn surfaces(&self) -> [&ImplicitSurface; 2] {
        self.law.surfaces()
    }

    /// Panels from angle zero to `end`, without the first; and the angle that was reached.
    fn integrated(&self, start: Rolled, end: f64) -> (f64, Vec<(f64, Rolled)>) {
        let sign = if end < 0.0 { -1.0 } else { 1.0 };
        let (mut at, mut q, mut h) = (start, 0.0_f64, LONGEST);
        let mut panels = Vec::new();
        while q < end.abs() && panels.len() < MOST {
            let last = q + h >= end.abs();
            let size = if last { end.abs() - q } else { h };
            let (full, halves) = (self.advanced(&at, sign * size), self.halved(&at, sign * size));
            let error = match (&full, &halves) {
                (Some(one), Some(two)) => self.distance(one, two),
                _ => f64::INFINITY,
            };
            // Short steps can only be as good as round-off in the surfaces lets them.
            let good = error <= TOLERANCE || size < 1e-4 && error <= 50.0 * TOLERANCE;
            if let (true, Some(next)) = (good, halves) {
                at = next;
                q = if last { end.abs() } else { q + size };
                panels.push((sign * q, at));
            } else if size < SHORTEST {
                break;
            }
            // The error of a step of order 8 grows with the ninth power of its size.
            let wanted = 0.85 * (TOLERANCE / error.max(1e-18)).powf(1.0 / 9.0);
            h = (size * wanted.clamp(0.25, 2.0)).min(LONGEST);
        }
        (sign * q, panels)
    }

    fn halved(&self, at: &Rolled, h: f64) -> Option<Rolled> {
        let middle = self.advanced(at, 0.5 * h)?;
        self.advanced(&middle, 0.5 * h)
    }

    /// The larger of turn and motion, beside what round-off leaves of numbers of their size.
    fn distance(&self, a: &Rolled, b: &Rolled) -> f64 {
        let turn = log(&(a.rotation * b.rotation.inverse())).norm();
        let apart = |a: &Triple<f64>, b: &Triple<f64>| {
            norm(&difference(a, b)) / (self.scale + 0.1 * norm(a).min(norm(b)))
        };
        turn.max(apart(&a.child, &b.child)).max(apart(&a.parent, &b.parent))
    }

    /// One step of the integration, with what must be kept restored. None where the contact ends on the way.
    fn advanced(&self, at: &Rolled, h: f64) -> Option<Rolled> {
        if h == 0.0 {
            return Some(*at);
        }
        let y = ode::step(&at.numbers(), h, 0, self, &mut ode::workspace());
        if !y.iter().all(|x| x[0].is_finite()) {
            return None;
        }
        let mut next = Rolled::from(&y);
        next.child = self.law.child.settled(next.child)?;
        next.parent = self.law.parent.settled(next.parent)?;
        // The least turn that makes the normals oppose.
        let own = turned(&rows(&next.rotation), &self.law.child.normal(&next.child));
        let wanted = scaled(-self.law.sense, &self.law.parent.normal(&next.parent));
        next.rotation = exp(&Vector3::from(cross(&own, &wanted))) * next.rotation;
        let place = self.place(&next);
        let ends = self.law.child.contains(&next.child) && self.law.parent.contains(&next.parent);
        (ends && self.law.fits(&rows(&next.rotation), &place)).then_some(next)
    }

    fn place(&self, at: &Rolled) -> Place<f64> {
        Place {
            child: at.child,
            parent: at.parent,
            child_normal: self.law.child.normal(&at.child),
            normal: self.law.parent.normal(&at.parent),
            arm: turned(&rows(&at.rotation), &at.child),
        }
    }

    /// ω and w.
    fn flow<T: Scalar>(&self, rotation: &Rows<T>, child: &Triple<T>, parent: &Triple<T>) -> Flow<T> {
        let a: Triple<T> = constant(&self.axis);
        let n = self.law.parent.normal(parent);
        let sense = T::from(self.law.sense);
        let contact = scaled(sense, &n);
        let tangential = difference(&a, &scaled(dot(&a, &n), &n));
        let relative = |v: &Triple<T>| {
            let own = turned(rotation, &self.law.child.normal_rate(child, &back(rotation, v)));
            sum(&own, &scaled(sense, &self.law.parent.normal_rate(parent, v)))
        };
        if self.osculating {
            let e = unit(&cross(&a, &contact));
            let turn = cross(&contact, &relative(&e));
            let speed = dot(&tangential, &tangential) / dot(&turn, &tangential);
            return Flow { omega: scaled(speed, &turn), velocity: scaled(speed, &e) };
        }
        let [t1, t2] = tangents(&n);
        let (k1, k2) = (relative(&t1), relative(&t2));
        let wanted = cross(&tangential, &contact);
        let (r1, r2) = (dot(&t1, &wanted), dot(&t2, &wanted));
        let (a11, a12, a22) = (dot(&t1, &k1), dot(&t1, &k2), dot(&t2, &k2));
        let determinant = a11 * a22 - a12 * a12;
        let w1 = (a22 * r1 - a12 * r2) / determinant;
        let w2 = (a11 * r2 - a12 * r1) / determinant;
        Flow { omega: tangential, velocity: sum(&scaled(w1, &t1), &scaled(w2, &t2)) }
    }

    /// The state at an angle; None beyond the range.
    fn at(&self, q: f64) -> Option<Rolled> {
        let [from, to] = self.range;
        if !(q >= from && q <= to) {
            return None;
        }
        // Forwards from zero on the positive side, backwards on the other, as the panels were made.
        let index = if q >= 0.0 {
            self.panels.partition_point(|(start, _)| *start <= q).saturating_sub(1)
        } else {
            self.panels.partition_point(|(start, _)| *start < q)
        };
        let (start, state) = self.panels.get(index)?;
        self.advanced(state, q - start)
    }

    fn contact(&self, q: f64) -> Option<ContactState> {
        let at = self.at(q)?;
        let rotation = rows(&at.rotation);
        let flow = self.flow(&rotation, &at.child, &at.parent);
        let speed = norm(&flow.velocity);
        let direction = scaled(1.0 / speed, &flow.velocity);
        let own = back(&rotation, &direction);
        let [child, parent] = self.law.surfaces();
        let bend = [
            dot(&own, &child.normal_rate(&at.child, &own)),
            self.law.sense * dot(&direction, &parent.normal_rate(&at.parent, &direction)),
        ];
        let place = self.place(&at);
        Some(ContactState {
            points: [at.child.into(), at.parent.into()],
            normal: Vector3::from(place.normal) * self.law.sense,
            direction: direction.into(),
            parameters: [child.parameters(&at.child), parent.parameters(&at.parent)],
            radii: bend.map(radius),
            travel: [at.travel, 0.0],
            rates: [speed, 0.0],
            fits: self.law.fits(&rotation, &place),
        })
    }

    /// The angle at which the child is turned most nearly as wanted: v·ω = 0 for the rotation vector v that is missing.
    fn with_rotation(&self, wanted: &UnitQuaternion<f64>) -> f64 {
        let missing = |at: &Rolled| log(&(wanted * at.rotation.inverse()));
        let mut best = (f64::INFINITY, 0.0);
        for (q, at) in &self.panels {
            let misfit = missing(at).norm();
            if misfit < best.0 {
                best = (misfit, *q);
            }
        }
        let mut q: f64 = best.1;
        for _ in 0..40 {
            let Some(at) = self.at(q) else { break };
            let omega = self.flow(&rows(&at.rotation), &at.child, &at.parent).omega;
            let step = missing(&at).dot(&Vector3::from(omega)) / dot(&omega, &omega);
            let next = (q + step.clamp(-LONGEST, LONGEST)).clamp(self.range[0], self.range[1]);
            if (next - q).abs() <= 1e-16 || !next.is_finite() {
                break;
            }
            q = next;
        }
        q
    }
}

/// A rolling motion in units of a length; its coordinate is the angle.
#[derive(Clone, Debug)]
pub struct Path {
    pub(in crate::joint) law: Arc<RollingPath>,
    /// Lengths are in units of this many metres.
    pub(in crate::joint) unit: f64,
}

impl Path {
    /// Angles between which there is contact.
    pub fn range(&self) -> [f64; 2] {
        self.law.range
    }

    /// Where and how the surfaces touch, SI.
    pub fn contact(&self, configuration: &Configuration) -> Option<ContactState> {
        self.law.contact(configuration[0])
    }
}

fn first(q: f64) -> [f64; MAX_FREEDOMS] {
    [q, 0.0, 0.0, 0.0, 0.0, 0.0]
}

impl Kinematics for Path {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        match self.law.at(configuration[0]) {
            Some(at) => Pose::new(at.rotation, Vector3::from(self.law.place(&at).position()) / self.unit),
            // Beyond the end of the motion there is no pose; the state is refused.
            None => Pose::translation(Vector3::repeat(f64::NAN)),
        }
    }
    fn subspace(&self, configuration: &Configuration, _: usize) -> Twist {
        self.law.at(configuration[0]).map_or_else(nowhere, |at| {
            let rotation = rows(&at.rotation);
            let omega = self.law.flow(&rotation, &at.child, &at.parent).omega;
            let linear = cross(&turned(&rotation, &at.child), &omega);
            Twist { angular: omega.into(), linear: Vector3::from(linear) / self.unit }
        })
    }
    /// (ω', -ω'×Y - ω×(ω×Y + w)), with ω' along the motion by dual numbers.
    fn subspace_change(&self, configuration: &Configuration, _: usize, _: usize) -> Twist {
        self.law.at(configuration[0]).map_or_else(nowhere, |at| {
            let rotation = rows(&at.rotation);
            let Flow { omega, velocity } = self.law.flow(&rotation, &at.child, &at.parent);
            let flow = self.law.flow(
                &turning(&rotation, &omega),
                &moving(&at.child, &back(&rotation, &velocity)),
                &moving(&at.parent, &velocity),
            );
            let change = rates(&flow.omega);
            let arm = Vector3::from(turned(&rotation, &at.child));
            let (omega, velocity) = (Vector3::from(omega), Vector3::from(velocity));
            let linear = arm.cross(&change) - omega.cross(&(omega.cross(&arm) + velocity));
            Twist { angular: change, linear: linear / self.unit }
        })
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        self.configuration(&[configuration[0] + step[0]])
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        first(to[0] - from[0])
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        first(configuration[0])
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        self.configuration(&[self.law.with_rotation(&pose.rotation)])
    }
}
