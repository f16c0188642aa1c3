//! The coordinates of a joint or hold as unknowns: free, driven, sprung, limited.

use crate::scale::Scale;
use flexura_mechanics::joint::{Configuration, ContactError, Joint, Kinematics, MAX_FREEDOMS};
use flexura_model::{CoordinateKind, CoordinateLaw, Drive, JointKind, JointLaw};
use flexura_spatial::{Pose, Twist, Vector3};
use std::f64::consts::TAU;

/// A joint's kinematics with what acts on its coordinates, nondimensional.
#[derive(Clone, Debug)]
pub(crate) struct Coordinates {
    pub joint: Joint,
    pub kind: JointKind,
    laws: Vec<CoordinateLaw>,
    /// Configuration at rest.
    pub initial: Configuration,
    /// Indices of the coordinates that are found.
    free: Vec<usize>,
    /// A ball whose turning about one line (in M's axes) is held: the two lines left.
    pub spin_held: Option<[Vector3<f64>; 2]>,
    /// Does a coupling act on a coordinate?
    pub coupled: bool,
    /// What to multiply each coordinate with to get its SI value.
    pub units: [f64; MAX_FREEDOMS],
}

impl Coordinates {
    /// `initial_pose` is X_FM in the initial poses, nondimensional.
    pub fn new(law: &JointLaw, scale: &Scale, initial_pose: &Pose) -> Result<Self, ContactError> {
        let joint = Joint::new(law, scale.length, &scale.pose_out(initial_pose))?;
        Ok(Self::with(joint, law, scale, initial_pose))
    }

    /// No motion at all.
    pub fn weld(scale: &Scale) -> Self {
        Self::with(Joint::weld(), &JointLaw::weld(), scale, &Pose::identity())
    }

    fn with(joint: Joint, law: &JointLaw, scale: &Scale, initial_pose: &Pose) -> Self {
        let mut units = [1.0; MAX_FREEDOMS];
        for (unit, kind) in units.iter_mut().zip(law.kind.coordinate_kinds()) {
            *unit = if *kind == CoordinateKind::Length { scale.length } else { 1.0 };
        }
        let laws: Vec<CoordinateLaw> = law
            .coordinates
            .iter()
            .zip(units)
            .map(|(c, length)| scaled(c, length, scale.moment() / length))
            .collect();
        let free =
            (0..laws.len()).filter(|&i| matches!(laws[i].drive, Drive::Free { .. })).collect::<Vec<_>>();
        Self {
            kind: law.kind,
            initial: joint.nearest(initial_pose),
            joint,
            laws,
            free,
            spin_held: None,
            coupled: false,
            units,
        }
    }

    /// A driven coordinate beyond where a rolling joint's boundaries end, with the range; SI.
    pub fn driven_beyond(&self) -> Option<(f64, [f64; 2])> {
        let range = self.joint.range()?;
        let Drive::Driven { coordinate } = self.laws.first()?.drive else { return None };
        let outside = !(coordinate >= range[0] && coordinate <= range[1]);
        outside.then(|| (coordinate * self.units[0], range.map(|q| q * self.units[0])))
    }

    /// Changes what acts on a coordinate, which stays driven or free as it is; SI.
    pub fn set_law(&mut self, coordinate: usize, law: &CoordinateLaw, scale: &Scale) {
        let length = self.units[coordinate];
        self.laws[coordinate] = scaled(law, length, scale.moment() / length);
    }

    /// Number of unknown coordinates.
    pub fn unknowns(&self) -> usize {
        if self.spin_held.is_some() { 2 } else { self.free.len() }
    }

    /// Is a coordinate driven to a value that is not its initial one?
    pub fn is_driven(&self) -> bool {
        let start = self.joint.coordinates(&self.initial);
        let moved = |(law, start): (&CoordinateLaw, f64)| matches!(law.drive, Drive::Driven { coordinate } if coordinate != start);
        self.laws.iter().zip(start).any(moved)
    }

    /// Which of the unknown coordinates coordinate `i` is; None where it is driven.
    pub fn unknown_of(&self, i: usize) -> Option<usize> {
        self.free.iter().position(|free| *free == i)
    }

    /// Is nothing acting on the coordinates, and none driven?
    pub fn is_plain(&self) -> bool {
        self.laws.iter().all(|c| {
            c.drive == Drive::Free { effort: 0.0 }
                && c.stiffness == 0.0
                && c.limits.is_none_or(|l| l.stiffness.is_none())
        })
    }

    /// Column `i` of H for the unknown coordinates, in F's axes.
    pub fn subspace(&self, configuration: &Configuration, i: usize) -> Twist {
        match &self.spin_held {
            Some(lines) => Twist {
                angular: self.joint.pose(configuration).rotation * lines[i],
                linear: Vector3::zeros(),
            },
            None => self.joint.subspace(configuration, self.free[i]),
        }
    }

    /// How column `i` of H changes along unknown coordinate `j`, in F's axes. The lines of a held spin turn with M,
    /// along whatever turns it.
    pub fn subspace_change(&self, configuration: &Configuration, i: usize, j: usize) -> Twist {
        match &self.spin_held {
            Some(_) => {
                let (line, axis) = (self.subspace(configuration, i), self.subspace(configuration, j));
                Twist { angular: axis.angular.cross(&line.angular), linear: Vector3::zeros() }
            }
            None => self.joint.subspace_change(configuration, self.free[i], self.free[j]),
        }
    }

    pub fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        let mut full = [0.0; MAX_FREEDOMS];
        match &self.spin_held {
            Some(lines) => {
                let v = self.joint.pose(configuration).rotation * (lines[0] * step[0] + lines[1] * step[1]);
                full[..3].copy_from_slice(v.as_slice());
            }
            None => {
                for (i, s) in self.free.iter().zip(step) {
                    full[*i] = *s;
                }
            }
        }
        self.joint.moved(configuration, &full)
    }

    /// The step from one configuration to another; of an angle on which nothing depends the shorter way round.
    pub fn step(&self, from: &Configuration, to: &Configuration, out: &mut [f64]) {
        let full = self.joint.step(from, to);
        match &self.spin_held {
            Some(lines) => {
                let local =
                    self.joint.pose(from).rotation.inverse() * Vector3::new(full[0], full[1], full[2]);
                out[0] = lines[0].dot(&local);
                out[1] = lines[1].dot(&local);
            }
            None => {
                for (o, i) in out.iter_mut().zip(&self.free) {
                    *o = if self.comes_round(*i) {
                        full[*i] - TAU * (full[*i] / TAU).round()
                    } else {
                        full[*i]
                    };
                }
            }
        }
    }

    /// Is the mechanism the same after coordinate `i` has gone round once?
    fn comes_round(&self, i: usize) -> bool {
        let law = &self.laws[i];
        let acts = law.stiffness != 0.0 || law.limits.is_some_and(|limits| limits.stiffness.is_some());
        let about_an_axis = matches!(
            self.kind,
            JointKind::Revolute | JointKind::Cylindrical | JointKind::Universal | JointKind::Planar
        );
        about_an_axis && self.kind.coordinate_kinds()[i] == CoordinateKind::Angle && !acts && !self.coupled
    }

    /// The configuration with the driven coordinates at `load` times the way from rest to their values.
    pub fn driven(&self, configuration: &Configuration, load: f64) -> Configuration {
        if self.laws.iter().all(|c| matches!(c.drive, Drive::Free { .. })) {
            return *configuration;
        }
        let start = self.joint.coordinates(&self.initial);
        let mut q = self.joint.coordinates(configuration);
        for (i, law) in self.laws.iter().enumerate() {
            if let Drive::Driven { coordinate } = law.drive {
                q[i] = start[i] + load * (coordinate - start[i]);
            }
        }
        self.joint.configuration(&q[..self.laws.len()])
    }

    /// Efforts on the unknown coordinates along H, and their tangent: `τ = load effort - k (q - rest(load))`
    /// plus the push of a limit. The rest value moves from the initial coordinate, so that rest is relaxed.
    pub fn efforts(
        &self,
        configuration: &Configuration,
        load: f64,
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let q = self.joint.coordinates(configuration);
        let start = self.joint.coordinates(&self.initial);
        let (mut tau, mut slope) = ([0.0; MAX_FREEDOMS], [0.0; MAX_FREEDOMS]);
        for (i, law) in self.laws.iter().enumerate() {
            if let Drive::Free { effort } = law.drive {
                let rest = start[i] + load * (law.rest - start[i]);
                tau[i] = load * effort - law.stiffness * (q[i] - rest);
                slope[i] = -law.stiffness;
                if let Some((beyond, k)) = push(law, q[i], start[i], load) {
                    tau[i] -= k * beyond;
                    slope[i] -= k;
                }
            }
        }
        let (value, tangent) = self.joint.generalised(configuration, &tau, &slope);
        if self.spin_held.is_some() {
            // Only a plain ball has its spin held: nothing acts on it.
            return ([0.0; MAX_FREEDOMS], [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS]);
        }
        let mut out = [0.0; MAX_FREEDOMS];
        let mut d = [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS];
        for (a, &i) in self.free.iter().enumerate() {
            out[a] = value[i];
            for (b, &j) in self.free.iter().enumerate() {
                d[a][b] = tangent[i][j];
            }
        }
        (out, d)
    }

    /// Does a damper act on a coordinate that is found?
    pub fn is_damped(&self) -> bool {
        self.free.iter().any(|i| self.laws[*i].damping != 0.0)
    }

    /// Efforts against the rates of the unknown coordinates along H, per unit of these; in units of effort times s.
    pub fn drag(&self, configuration: &Configuration) -> [[f64; MAX_FREEDOMS]; MAX_FREEDOMS] {
        let mut slope = [0.0; MAX_FREEDOMS];
        for (slope, law) in slope.iter_mut().zip(&self.laws) {
            *slope = law.damping;
        }
        let (_, tangent) = self.joint.generalised(configuration, &[0.0; MAX_FREEDOMS], &slope);
        let mut out = [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS];
        match &self.spin_held {
            Some(lines) => {
                // Of a ball all dampers are alike.
                for (a, x) in lines.iter().enumerate() {
                    for (b, y) in lines.iter().enumerate() {
                        out[a][b] = self.laws.first().map_or(0.0, |law| law.damping) * x.dot(y);
                    }
                }
            }
            None => {
                for (a, &i) in self.free.iter().enumerate() {
                    for (b, &j) in self.free.iter().enumerate() {
                        out[a][b] = tangent[i][j];
                    }
                }
            }
        }
        out
    }

    /// ½ Σ k (q - rest)², nondimensional.
    pub fn energy(&self, configuration: &Configuration, load: f64) -> f64 {
        let start = self.joint.coordinates(&self.initial);
        let q = self.coordinates(configuration, load);
        self.laws
            .iter()
            .enumerate()
            .map(|(i, law)| {
                let limit =
                    push(law, q[i], start[i], load).map_or(0.0, |(beyond, k)| 0.5 * k * beyond * beyond);
                0.5 * law.stiffness * (q[i] - law.rest).powi(2) + limit
            })
            .sum()
    }

    /// What stiffnesses and limits push with along each coordinate, nondimensional: `k (q - rest)`.
    pub fn push_back(&self, configuration: &Configuration, load: f64) -> [f64; MAX_FREEDOMS] {
        let start = self.joint.coordinates(&self.initial);
        let q = self.coordinates(configuration, load);
        let mut force = [0.0; MAX_FREEDOMS];
        for (i, law) in self.laws.iter().enumerate() {
            force[i] = law.stiffness * (q[i] - law.rest)
                + push(law, q[i], start[i], load).map_or(0.0, |(beyond, k)| k * beyond);
        }
        force
    }

    /// The coordinates; driven ones as they were driven, beyond half a turn too.
    fn coordinates(&self, configuration: &Configuration, load: f64) -> [f64; MAX_FREEDOMS] {
        let start = self.joint.coordinates(&self.initial);
        let mut q = self.joint.coordinates(configuration);
        for ((value, law), start) in q.iter_mut().zip(&self.laws).zip(start) {
            if let Drive::Driven { coordinate } = law.drive {
                *value = start + load * (coordinate - start);
            }
        }
        q
    }

    /// Is one of these coordinates within `near` of where a limit begins to push?
    pub fn is_at_limit(&self, q: &[f64; MAX_FREEDOMS], load: f64, near: f64) -> bool {
        let start = self.joint.coordinates(&self.initial);
        self.laws.iter().enumerate().any(|(i, law)| {
            let pushes = |q: f64| push(law, q, start[i], load).is_some();
            matches!(law.drive, Drive::Free { .. }) && pushes(q[i] - near) != pushes(q[i] + near)
        })
    }

    /// Coordinates that lie outside their limits: number, value and range, SI.
    pub fn beyond_limits(&self, configuration: &Configuration) -> Vec<(usize, f64, [f64; 2])> {
        let q = self.joint.coordinates(configuration);
        self.laws
            .iter()
            .enumerate()
            .filter_map(|(i, law)| {
                let limits = law.limits?;
                let outside = q[i] < limits.range[0] || q[i] > limits.range[1];
                outside.then(|| (i, q[i] * self.units[i], limits.range.map(|v| v * self.units[i])))
            })
            .collect()
    }

    /// Coordinates as a user reads them, SI.
    pub fn values(&self, configuration: &Configuration, load: f64) -> Vec<f64> {
        self.coordinates(configuration, load)[..self.laws.len()]
            .iter()
            .zip(self.units)
            .map(|(q, unit)| q * unit)
            .collect()
    }
}

/// A law in units of a coordinate and of its effort: force along a length, or moment about an axis.
fn scaled(law: &CoordinateLaw, length: f64, effort: f64) -> CoordinateLaw {
    CoordinateLaw {
        drive: match law.drive {
            Drive::Free { effort: e } => Drive::Free { effort: e / effort },
            Drive::Driven { coordinate } => Drive::Driven { coordinate: coordinate / length },
        },
        stiffness: law.stiffness * length / effort,
        rest: law.rest / length,
        damping: law.damping * length / effort,
        limits: law.limits.map(|l| flexura_model::Limits {
            range: l.range.map(|v| v / length),
            stiffness: l.stiffness.map(|k| k * length / effort),
        }),
    }
}

/// How far `q` lies beyond a limit that pushes, and the stiffness of the push.
/// A limit that the rest state passes moves in from there with the load, so that rest is relaxed.
fn push(law: &CoordinateLaw, q: f64, start: f64, load: f64) -> Option<(f64, f64)> {
    let limits = law.limits?;
    let stiffness = limits.stiffness?;
    let [low, high] = limits.range;
    let low = if start < low { start + load * (low - start) } else { low };
    let high = if start > high { start + load * (high - start) } else { high };
    let beyond = if q < low {
        q - low
    } else if q > high {
        q - high
    } else {
        return None;
    };
    Some((beyond, stiffness))
}
