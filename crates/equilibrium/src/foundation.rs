//! The elastic foundations of one beam, and what they do where the beam is.

use crate::beam::{BeamLaw, stage};
use crate::error::ProblemError;
use crate::extract::GAUSS;
use flexura_mechanics::ode::STAGES;
use flexura_mechanics::rod::{Foundation, FoundationSample, Resistance};
use flexura_model::{Beam, FoundationLaw, LoadAxes};
use flexura_spatial::{Matrix3, Pose, Vector3};

type V = Vector3<f64>;

/// Places at which a stretch is looked at.
const PLACES: usize = 17;
/// Parts into which a displacement is cut for the energy of a law that is not linear.
const PARTS: usize = 16;

/// The foundations of a beam.
#[derive(Clone, Debug)]
pub(crate) struct Founded {
    parts: Vec<flexura_model::Foundation>,
    /// The beam's start frame in the undeformed mechanism, m.
    pub rest: Pose,
}

/// What one foundation does to an axis that has left its place.
struct Push {
    /// Restoring force per length (N/m), its slope by the displacement (N/m²), and its energy (J/m).
    force: f64,
    slope: f64,
    energy: f64,
    direction: V,
    linear: bool,
}

impl Founded {
    /// # Errors
    /// A stiffness that is negative or no number; the length is known only here for some curves.
    pub fn new(beam: &Beam, length: f64) -> Result<Self, ProblemError> {
        for part in &beam.foundation {
            let FoundationLaw::Linear(profile) = &part.law else { continue };
            let ends = part.between.map(|at| at.arc_length(length));
            let places = (0..=64).map(|i| ends[0] + (ends[1] - ends[0]) * f64::from(i) / 64.0);
            let bad =
                places.map(|s| (s, profile.value(s, length))).find(|(_, k)| !(k.is_finite() && *k >= 0.0));
            if let Some((s, k)) = bad {
                return Err(ProblemError::new(
                    format!("beam.{}.foundation", beam.name),
                    format!("has the stiffness {k} N/m^2 at s = {s} m"),
                    "a stiffness must be finite and not negative; what pushes away is written as `force`",
                ));
            }
        }
        Ok(Self { parts: beam.foundation.clone(), rest: Pose::identity() })
    }

    /// Is there one between two arc lengths (m)?
    pub fn holds(&self, [a, b]: [f64; 2], length: f64) -> bool {
        self.parts.iter().any(|part| covers(part, 0.5 * (a + b), length))
    }

    /// Is there one anywhere between two arc lengths?
    pub fn meets(&self, [a, b]: [f64; 2], length: f64) -> bool {
        self.parts.iter().any(|part| {
            let [from, to] = part.between.map(|at| at.arc_length(length));
            from < b - 1e-12 * length && to > a + 1e-12 * length
        })
    }

    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Is every stiffness the same along the beam? A law of the displacement is.
    pub fn is_even(&self) -> bool {
        self.parts.iter().all(|part| match &part.law {
            FoundationLaw::Linear(profile) => profile.as_constant().is_some(),
            FoundationLaw::Force(_) => true,
        })
    }

    /// Does a law depend on the displacement otherwise than in proportion?
    pub fn is_nonlinear(&self) -> bool {
        self.parts.iter().any(|part| matches!(part.law, FoundationLaw::Force(_)))
    }

    /// Arc lengths where something begins, ends or is not smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        let mut breaks = Vec::new();
        for part in &self.parts {
            breaks.extend(part.between.map(|at| at.arc_length(length)));
            if let FoundationLaw::Linear(profile) = &part.law {
                breaks.extend(profile.breaks(length));
            }
        }
        breaks
    }
}

fn covers(part: &flexura_model::Foundation, s: f64, length: f64) -> bool {
    let [from, to] = part.between.map(|at| at.arc_length(length));
    from <= s && s <= to
}

impl BeamLaw {
    /// Where the section at `s` lies in the undeformed mechanism; SI.
    pub fn place(&self, s: f64) -> Pose {
        self.founded.rest * self.shape.pose(s)
    }

    /// What acts at `s` (m) on an axis that is `moved` (m) from its place. An isotropic foundation acts once for each axis.
    fn pushes(&self, s: f64, moved: &V) -> Vec<Push> {
        let mut pushes = Vec::new();
        for part in self.founded.parts.iter().filter(|part| covers(part, s, self.length)) {
            let directions = match part.direction {
                Some(direction) if part.axes == LoadAxes::Section => vec![self.place(s).rotation * direction],
                Some(direction) => vec![direction],
                None => vec![V::x(), V::y(), V::z()],
            };
            for direction in directions {
                let u = direction.dot(moved);
                pushes.push(match &part.law {
                    FoundationLaw::Linear(profile) => {
                        let k = profile.value(s, self.length);
                        Push { force: k * u, slope: k, energy: 0.5 * k * u * u, direction, linear: true }
                    }
                    FoundationLaw::Force(function) => {
                        let [force, slope, ..] = function.jet(u);
                        let h = u / PARTS as f64;
                        let each =
                            (0..PARTS).flat_map(|i| GAUSS.map(|(node, weight)| (i as f64 + node, weight)));
                        let energy = each.map(|(place, weight)| h * weight * function.value(h * place)).sum();
                        Push { force, slope, energy, direction, linear: false }
                    }
                });
            }
        }
        pushes
    }

    /// Force per length (N/m, global) and energy (J/m) of the foundations at `s` (m), the axis being at `position` (m).
    pub fn foundation_at(&self, s: f64, position: &V) -> (V, f64) {
        if self.founded.is_empty() {
            return (V::zeros(), 0.0);
        }
        let pushes = self.pushes(s, &(position - self.place(s).position));
        let zero = (V::zeros(), 0.0);
        pushes.iter().fold(zero, |(q, energy), push| (q - push.direction * push.force, energy + push.energy))
    }

    /// By how much laws that are not linear push back and pull away at most there, per displacement: (Σ of positive slopes,
    /// Σ of negative ones), nondimensional. `position` is nondimensional, too.
    pub fn foundation_slopes(&self, s: f64, position: &V) -> [f64; 2] {
        let unit = self.foundation_unit();
        let moved = position * self.scale.length - self.place(s).position;
        let bent = self.pushes(s, &moved).into_iter().filter(|push| !push.linear);
        bent.fold([0.0; 2], |[up, down], push| {
            [up + unit * push.slope.max(0.0), down + unit * push.slope.min(0.0)]
        })
    }

    /// Stiffness of the foundations at `s` (m), the axis being at `position`; both nondimensional, global axes.
    pub fn foundation_slope(&self, s: f64, position: &V) -> Matrix3<f64> {
        if self.founded.is_empty() {
            return Matrix3::zeros();
        }
        let moved = position * self.scale.length - self.place(s).position;
        let each = self.pushes(s, &moved).into_iter();
        each.map(|push| push.direction * push.direction.transpose() * (push.slope * self.foundation_unit()))
            .sum()
    }

    /// Nondimensional stiffness of 1 N/m².
    fn foundation_unit(&self) -> f64 {
        self.scale.length * self.scale.length / self.scale.force
    }

    /// L over the length in which what a foundation under a beam feels dies away: (k/4EI)^¼ L along the beam, or √(k/EA) L.
    pub fn foundation_growth(&self) -> f64 {
        let push = self.foundation_stiffness([0.0, self.length]);
        let length = self.length / self.scale.length;
        // The mean of a root is at most the root of the mean.
        let soft = self.soft_all_along() / length;
        length * (0.25 * push * soft).powf(0.25).max((push * self.yields()).sqrt())
    }

    /// Stiffness at rest at `s` (m), nondimensional.
    pub fn stiffness_at_rest(&self, s: f64) -> f64 {
        let unit = self.foundation_unit();
        self.pushes(s, &V::zeros()).iter().map(|push| unit * push.slope.abs()).sum()
    }

    /// Stiffness, nondimensional, that may act between two arc lengths without that a few places show it.
    pub fn hidden_stiffness(&self, a: f64, b: f64) -> f64 {
        let here = self.founded.parts.iter().filter(|part| covers(part, 0.5 * (a + b), self.length));
        let hidden = here.filter_map(|part| match &part.law {
            FoundationLaw::Linear(profile) => profile.variation(a, b).map(|v| v.hidden()),
            FoundationLaw::Force(_) => None,
        });
        self.foundation_unit() * hidden.sum::<f64>()
    }

    /// Largest stiffness at rest between two arc lengths, nondimensional.
    pub fn foundation_stiffness(&self, [a, b]: [f64; 2]) -> f64 {
        let outward = self.outward_slope(0.5 * (a + b));
        if !self.founded.meets([a, b], self.length) {
            return outward;
        }
        let inset = 1e-9 * (b - a);
        let places = (0..PLACES).map(|i| a + inset + (b - a - 2.0 * inset) * i as f64 / (PLACES - 1) as f64);
        let slope = |s: f64| self.pushes(s, &V::zeros()).iter().map(|push| push.slope.abs()).sum::<f64>();
        outward + self.foundation_unit() * places.map(slope).fold(0.0, f64::max)
    }

    /// What the kernel reads of them between `a` and `b` (m), nondimensional.
    pub fn foundation(&self, a: f64, b: f64, steps: usize) -> Option<Foundation> {
        let spin = self.spinning(a, b, steps);
        if spin.is_none() && !self.founded.holds([a, b], self.length) {
            return None;
        }
        let unit = self.foundation_unit();
        let nonlinear = |part: &&flexura_model::Foundation| {
            matches!(part.law, FoundationLaw::Force(_)) && covers(part, 0.5 * (a + b), self.length)
        };
        let laws = self.founded.parts.iter().filter(nonlinear).filter_map(|part| match &part.law {
            FoundationLaw::Force(force) => {
                let (length, unit) = (self.scale.length, self.scale.length / self.scale.force);
                Some((Resistance { force: force.clone(), length, unit }, Vec::with_capacity(steps * STAGES)))
            }
            FoundationLaw::Linear(_) => None,
        });
        let mut resistances: Vec<(Resistance, Vec<[f64; 3]>)> = laws.collect();
        let mut samples = Vec::with_capacity(steps * STAGES);
        for i in 0..steps * STAGES {
            let s = stage(a, b, steps, i);
            let mut stiffness = Matrix3::zeros();
            let mut next = resistances.iter_mut();
            for push in self.pushes(s, &V::zeros()) {
                if push.linear {
                    stiffness += push.direction * push.direction.transpose() * (push.slope * unit);
                } else if let Some((_, directions)) = next.next() {
                    directions.push(push.direction.into());
                }
            }
            samples.push(FoundationSample {
                rest: (self.place(s).position / self.scale.length).into(),
                stiffness: std::array::from_fn(|i| std::array::from_fn(|j| stiffness[(i, j)])),
            });
        }
        Some(Foundation { samples, resistances, spin })
    }
}
