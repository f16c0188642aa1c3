//! The second integrator: a beam from one station to the next, from the model's own numbers.
//!
//! ```text
//! p' = R ν   R' = R hat(k)   F' = -q   M' = -m - p' × F        (ν, k) = (ν0, k0) + C (Rᵀ F_own, Rᵀ M_own)
//! ```
//!
//! F and M are carried by section and tendons together; the tendons' part is Σ T (u, d × u), u the direction of the channel
//! p + R d. What the beam itself carries follows from it by Newton's method.

use super::answer::{Answer, Station, V};
use super::dormand::integrate;
use super::section;
use flexura::geometry::RestShape;
use flexura::model::{Beam, CableLaw, Curve, FoundationLaw, Guide, LoadAxes, Model, Profile};
use flexura::spatial::{Pose, Quaternion, UnitQuaternion, Wrench, hat};
use nalgebra::{Matrix6, Vector6};

/// Most tendons in one beam.
const TENDONS: usize = 4;
/// Pose, wrench, energy, lengths of channels.
const N: usize = 14 + TENDONS;
const TOLERANCE: f64 = 1e-13;

/// A channel of a cable along a beam.
#[derive(Clone, Copy)]
pub struct Channel<'a> {
    pub cable: usize,
    pub between: [f64; 2],
    offset: &'a [Profile; 2],
    pub tension: f64,
}

/// A beam with its laws.
pub struct Rod<'a> {
    model: &'a Model,
    pub beam: &'a Beam,
    pub shape: RestShape,
    pub length: f64,
    /// What forces and moments are measured by: the largest there, or EI/L² and EI/L.
    pub force: f64,
    pub moment: f64,
    uniform: Option<Matrix6<f64>>,
    pub channels: Vec<Channel<'a>>,
    rest: Option<Pose>,
}

/// What came out of an interval.
pub struct Carried {
    pub pose: Pose,
    /// Section and tendons together.
    pub total: Wrench,
    pub energy: f64,
    pub lengths: [f64; TENDONS],
}

impl<'a> Rod<'a> {
    pub fn new(answer: &Answer<'a>, index: usize) -> Result<Self, String> {
        let model = answer.model;
        let beam = &model.beams[index];
        let shape = RestShape::new(&beam.curve, &beam.frame).map_err(|error| error.to_string())?;
        let length = shape.length();
        let mut channels = Vec::new();
        for (i, cable) in model.cables.iter().enumerate() {
            let tension = match cable.law {
                CableLaw::Tension(tension) => tension,
                CableLaw::Length(_) => answer.document.cables.get(&cable.name).map_or(0.0, |c| c.tension),
            };
            for guide in &cable.route {
                if let Guide::Channel { beam: id, between, offset } = guide
                    && id.0 == index
                {
                    let between = between.map(|at| at.arc_length(length));
                    channels.push(Channel { cable: i, between, offset, tension });
                }
            }
        }
        if channels.len() > TENDONS {
            return Err(format!("beam.{} has more tendons than are followed here", beam.name));
        }
        let uniform = flexura::geometry::is_uniform(&model[beam.section]);
        let mut rod =
            Self { model, beam, shape, length, force: 0.0, moment: 0.0, uniform: None, channels, rest: None };
        if uniform {
            rod.uniform = rod.compliance(0.0);
        }
        rod.rest = rod.home(answer, 0);
        Ok(rod)
    }

    /// What differences are measured by.
    pub fn measure(&mut self, stations: &[Station]) {
        let places = (0..=8).map(|i| self.length * (f64::from(i) / 8.0).clamp(1e-9, 1.0 - 1e-9));
        let soft = places.filter_map(|s| self.compliance(s)).map(|c| c[(3, 3)].max(c[(4, 4)]).max(c[(5, 5)]));
        let bending = 1.0 / soft.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let tendons: f64 = self.channels.iter().map(|channel| channel.tension.abs()).sum();
        self.force = stations.iter().map(|station| station.wrench.force.norm()).fold(tendons, f64::max);
        self.force = self.force.max(bending / (self.length * self.length));
        self.moment = stations.iter().map(|station| station.wrench.moment.norm()).fold(0.0, f64::max);
        self.moment = self.moment.max(self.force * self.length).max(bending / self.length);
    }

    /// The pose of its start in the undeformed mechanism.
    pub fn home(&self, answer: &Answer, depth: usize) -> Option<Pose> {
        if let Some(rest) = self.rest {
            return Some(rest);
        }
        if depth > answer.model.beams.len() {
            return None;
        }
        if let Some(start) = &self.beam.start {
            return Some(answer.at_rest(&start.mount, depth)? * start.placement.unwrap_or(Pose::identity()));
        }
        let end = self.beam.end.as_ref()?;
        Some(answer.at_rest(&end.mount, depth)? * end.placement? * self.far_end().inverse())
    }

    /// The pose of its end in that of its start where nothing is loaded. Of a beam that is given by its curvatures it is
    /// integrated here.
    pub fn far_end(&self) -> Pose {
        let Curve::Curvature { curvature, length } = &self.beam.curve else {
            return self.shape.pose(self.length);
        };
        let rate = |s: f64, y: &[f64; 7]| {
            let k = V::from_iterator(curvature.iter().map(|profile| profile.value(s, *length)));
            let q = Quaternion::new(y[3], y[4], y[5], y[6]);
            let slope = UnitQuaternion::from_quaternion(q) * V::x();
            let turn = q * Quaternion::from_imag(k) * 0.5;
            [slope.x, slope.y, slope.z, turn.w, turn.i, turn.j, turn.k]
        };
        let scale = [*length, *length, *length, 1.0, 1.0, 1.0, 1.0];
        let mut y = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        // In parts, so that no jump hides between two stages of a long step.
        let parts = 64;
        for i in 0..parts {
            let ends = [i, i + 1].map(|i| length * f64::from(i) / f64::from(parts));
            match integrate(rate, ends, y, &scale, TOLERANCE) {
                Ok(next) => y = next,
                Err(_) => return self.shape.pose(self.length),
            }
        }
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(y[3], y[4], y[5], y[6]));
        Pose::new(rotation, V::new(y[0], y[1], y[2]))
    }

    /// Rest curvatures at `s`.
    fn rest_curvature(&self, s: f64) -> V {
        match &self.beam.curve {
            Curve::Curvature { curvature, length } => {
                V::from_iterator(curvature.iter().map(|profile| profile.value(s, *length)))
            }
            _ => self.shape.curvature(s),
        }
    }

    fn compliance(&self, s: f64) -> Option<Matrix6<f64>> {
        if let Some(uniform) = self.uniform {
            return Some(uniform);
        }
        let material = self.beam.material.map(|id| &self.model[id]);
        section::compliance(&self.model[self.beam.section], material, self.beam.theory, s, self.length)
    }

    /// Strains of the beam (ν, k) that carries `own` in its section's axes.
    fn strain(&self, s: f64, own: &Vector6<f64>) -> Option<(Matrix6<f64>, Vector6<f64>)> {
        let c = self.compliance(s)?;
        let k0 = self.rest_curvature(s);
        Some((c, Vector6::new(1.0, 0.0, 0.0, k0.x, k0.y, k0.z) + c * own))
    }

    /// The channels that run beside `s`.
    fn beside(&self, s: f64) -> impl Iterator<Item = (usize, &Channel<'a>)> {
        let inside = move |(_, channel): &(usize, &Channel)| {
            let [a, b] = channel.between;
            s > a.min(b) && s < a.max(b)
        };
        self.channels.iter().enumerate().filter(inside)
    }

    /// Σ T (u, d × u) at a strain, its derivative, and |w| of every channel.
    fn tendons(&self, s: f64, strain: &Vector6<f64>) -> (Vector6<f64>, Matrix6<f64>, [f64; TENDONS]) {
        let (nu, k) = (V::new(strain[0], strain[1], strain[2]), V::new(strain[3], strain[4], strain[5]));
        let (mut pull, mut change, mut rates) = (Vector6::zeros(), Matrix6::zeros(), [0.0; TENDONS]);
        for (i, channel) in self.beside(s) {
            let d =
                V::new(0.0, channel.offset[0].value(s, self.length), channel.offset[1].value(s, self.length));
            let slope =
                V::new(0.0, channel.offset[0].slope(s, self.length), channel.offset[1].slope(s, self.length));
            let w = nu + k.cross(&d) + slope;
            let norm = w.norm();
            let u = w / norm;
            let arm = d.cross(&u);
            pull += channel.tension * Vector6::new(u.x, u.y, u.z, arm.x, arm.y, arm.z);
            let across = (nalgebra::Matrix3::identity() - u * u.transpose()) * (channel.tension / norm);
            let mut by_strain = nalgebra::Matrix3x6::zeros();
            by_strain.fixed_view_mut::<3, 3>(0, 0).copy_from(&across);
            by_strain.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-across * hat(&d)));
            let mut rows = change.fixed_view_mut::<3, 6>(0, 0);
            rows += by_strain;
            let mut rows = change.fixed_view_mut::<3, 6>(3, 0);
            rows += hat(&d) * by_strain;
            rates[i] = norm;
        }
        (pull, change, rates)
    }

    /// What beam and tendons carry together at a station, where the beam carries what the document tells; global. The
    /// tendons are those that run beside `inside`.
    pub fn total(&self, station: &Station, inside: f64) -> Option<Wrench> {
        if self.beside(inside).next().is_none() {
            return Some(station.wrench);
        }
        let own = in_section(&station.pose.rotation, &station.wrench);
        let (_, strain) = self.strain(inside, &own)?;
        let (pull, _, _) = self.tendons(inside, &strain);
        Some(globally(&station.pose.rotation, &(own + pull)))
    }

    /// What the beam itself carries of `total`, in the section's axes.
    fn own(&self, s: f64, total: &Vector6<f64>) -> Option<(Vector6<f64>, Vector6<f64>, [f64; TENDONS])> {
        let (c, strain) = self.strain(s, total)?;
        if self.beside(s).next().is_none() {
            return Some((*total, strain, [0.0; TENDONS]));
        }
        // Newton on own + pull(strain(own)) = total, shortened where it does not come nearer.
        let unit = |v: &Vector6<f64>| {
            let (force, moment) = (self.force, self.moment);
            v.rows(0, 3).norm() / force + v.rows(3, 3).norm() / moment
        };
        let rest = |own: &Vector6<f64>| {
            let (_, strain) = self.strain(s, own)?;
            let (pull, change, rates) = self.tendons(s, &strain);
            Some((own + pull - total, change, strain, rates))
        };
        let start = self.tendons(s, &Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)).0;
        let mut own = total - start;
        let (mut left, mut change, mut strain, mut rates) = rest(&own)?;
        for _ in 0..60 {
            if unit(&left) < 1e-15 {
                break;
            }
            let step = (Matrix6::identity() + change * c).lu().solve(&left)?;
            let mut part = 1.0;
            loop {
                let tried = own - step * part;
                let next = rest(&tried)?;
                if unit(&next.0) < unit(&left) || part < 1e-6 {
                    own = tried;
                    let before = unit(&left);
                    (left, change, strain, rates) = next;
                    if part < 1e-6 || unit(&left) > 0.5 * before && unit(&left) < 1e-12 {
                        return Some((own, strain, rates));
                    }
                    break;
                }
                part *= 0.5;
            }
        }
        Some((own, strain, rates))
    }

    /// From `start`, which carries `total`, to arc length `to`.
    ///
    /// # Errors
    /// Where it could not go on.
    pub fn carry(&self, start: &Station, total: &Wrench, to: f64) -> Result<Carried, f64> {
        let from = start.s;
        let q = start.pose.rotation.quaternion();
        let (p, f, m) = (start.pose.position, total.force, total.moment);
        let mut y = [0.0; N];
        y[..13].copy_from_slice(&[p.x, p.y, p.z, q.w, q.i, q.j, q.k, f.x, f.y, f.z, m.x, m.y, m.z]);
        let mut scale = [0.0; N];
        for (i, value) in scale.iter_mut().enumerate().take(13) {
            *value = match i {
                0..=2 => self.length,
                3..=6 => 1.0,
                7..=9 => self.force,
                _ => self.moment,
            };
        }
        for i in 0..self.channels.len() {
            scale[14 + i] = self.length;
        }
        // Laws may jump at the interval's ends; inside they are taken.
        let inset = 1e-12 * self.length;
        let inside = |s: f64| s.clamp(from + inset, (to - inset).max(from + inset));
        let y = integrate(|s, y| self.rates(inside(s), y), [from, to], y, &scale, TOLERANCE)?;
        let mut lengths = [0.0; TENDONS];
        lengths.copy_from_slice(&y[14..]);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(y[3], y[4], y[5], y[6]));
        Ok(Carried {
            pose: Pose::new(rotation, V::new(y[0], y[1], y[2])),
            total: Wrench::new(V::new(y[7], y[8], y[9]), V::new(y[10], y[11], y[12])),
            energy: y[13],
            lengths,
        })
    }

    fn rates(&self, s: f64, y: &[f64; N]) -> [f64; N] {
        let quaternion = Quaternion::new(y[3], y[4], y[5], y[6]);
        let rotation = UnitQuaternion::from_quaternion(quaternion);
        let (position, force) = (V::new(y[0], y[1], y[2]), V::new(y[7], y[8], y[9]));
        let total = in_section(&rotation, &Wrench::new(force, V::new(y[10], y[11], y[12])));
        let Some((own, strain, lengths)) = self.own(s, &total) else { return [f64::NAN; N] };
        let k0 = self.rest_curvature(s);
        let relative = strain - Vector6::new(1.0, 0.0, 0.0, k0.x, k0.y, k0.z);
        let slope = rotation * V::new(strain[0], strain[1], strain[2]);
        let turn = quaternion * Quaternion::from_imag(V::new(strain[3], strain[4], strain[5])) * 0.5;
        let (q, couple) = self.distributed(s, &rotation);
        let (bed, stored) = self.foundation(s, &position);
        let df = -q - bed;
        let dm = -couple - slope.cross(&force);
        let energy = 0.5 * own.dot(&relative) + stored;
        let mut rates = [0.0; N];
        rates[..14].copy_from_slice(&[
            slope.x, slope.y, slope.z, turn.w, turn.i, turn.j, turn.k, df.x, df.y, df.z, dm.x, dm.y, dm.z,
            energy,
        ]);
        rates[14..].copy_from_slice(&lengths);
        rates
    }

    /// Force and moment per length, global: loads and weight.
    fn distributed(&self, s: f64, rotation: &UnitQuaternion<f64>) -> (V, V) {
        let material = self.beam.material.map(|id| &self.model[id]);
        let mass = section::mass(&self.model[self.beam.section], material, s, self.length);
        let (mut force, mut moment) = (self.model.gravity * mass, V::zeros());
        for load in &self.beam.distributed {
            let at = |profiles: &[Profile; 3]| {
                V::from_iterator(profiles.iter().map(|profile| profile.value(s, self.length)))
            };
            let (f, m) = (at(&load.force), at(&load.moment));
            match load.axes {
                LoadAxes::Global => (force, moment) = (force + f, moment + m),
                LoadAxes::Section => (force, moment) = (force + rotation * f, moment + rotation * m),
            }
        }
        (force, moment)
    }

    /// Force of the foundations per length, global, and what they store per length.
    fn foundation(&self, s: f64, position: &V) -> (V, f64) {
        let (mut force, mut energy) = (V::zeros(), 0.0);
        let Some(rest) = self.rest.filter(|_| !self.beam.foundation.is_empty()) else {
            return (force, energy);
        };
        let place = rest * self.shape.pose(s);
        let moved = position - place.position;
        for bed in &self.beam.foundation {
            let [from, to] = bed.between.map(|at| at.arc_length(self.length));
            if s < from || s > to {
                continue;
            }
            let directions = match (bed.direction, bed.axes) {
                (Some(direction), LoadAxes::Global) => vec![direction],
                (Some(direction), LoadAxes::Section) => vec![place.rotation * direction],
                (None, _) => vec![V::x(), V::y(), V::z()],
            };
            for direction in directions {
                let u = direction.dot(&moved);
                match &bed.law {
                    FoundationLaw::Linear(profile) => {
                        let k = profile.value(s, self.length);
                        force -= direction * (k * u);
                        energy += 0.5 * k * u * u;
                    }
                    FoundationLaw::Force(law) => {
                        force -= direction * law.value(u);
                        // Simpson's rule on parts; laws are cubic or nearly.
                        let h = u / 32.0;
                        let f = |i: i32| law.value(h * f64::from(i));
                        energy += (0..16).map(|i| f(2 * i) + 4.0 * f(2 * i + 1) + f(2 * i + 2)).sum::<f64>()
                            * h
                            / 3.0;
                    }
                }
            }
        }
        (force, energy)
    }

    /// Where a channel is at arc length `s` of the beam in `pose`.
    pub fn channel_point(&self, channel: &[Profile; 2], s: f64, pose: &Pose) -> V {
        let inside = s.clamp(1e-12 * self.length, (1.0 - 1e-12) * self.length);
        pose.point(&V::new(0.0, channel[0].value(inside, self.length), channel[1].value(inside, self.length)))
    }
}

pub fn in_section(rotation: &UnitQuaternion<f64>, wrench: &Wrench) -> Vector6<f64> {
    let (f, m) = (rotation.inverse() * wrench.force, rotation.inverse() * wrench.moment);
    Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
}

fn globally(rotation: &UnitQuaternion<f64>, v: &Vector6<f64>) -> Wrench {
    Wrench::new(rotation * V::new(v[0], v[1], v[2]), rotation * V::new(v[3], v[4], v[5]))
}
