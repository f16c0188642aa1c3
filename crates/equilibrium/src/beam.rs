//! The law of one beam at any place along it, and pieces of it that can be integrated.

use crate::error::ProblemError;
use crate::extract::GAUSS;
use crate::foundation::Founded;
use crate::scale::Scale;
use flexura_geometry::{
    Compliance, RestShape, compliance, is_uniform, mass_per_length, rotary_inertia, section_breaks,
};
use flexura_mechanics::ode::{NODES, STAGES};
use flexura_mechanics::rod::{Coupled, LawTable, LoadSample, Piece, Shearable, Slender};
use flexura_model::{Beam, BeamId, LoadAxes, Material, Model, Profile, Section, Spin};
use flexura_spatial::{Matrix6, Vector3};

/// Rest curvature and compliance at one place, SI.
#[derive(Clone, Debug)]
pub(crate) struct LocalLaw {
    pub k0: Vector3<f64>,
    pub compliance: Compliance,
}

/// The same, nondimensional.
pub(crate) struct ScaledLaw {
    pub k0: Vector3<f64>,
    pub compliance: Matrix6<f64>,
}

impl LocalLaw {
    /// `(ν - ν0, k)` for the section force and moment, SI.
    pub fn strain(&self, n: &Vector3<f64>, m: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let c = self.compliance.to_matrix();
        let e = c * flexura_spatial::Vector6::new(n.x, n.y, n.z, m.x, m.y, m.z);
        (Vector3::new(e[0], e[1], e[2]), self.k0 + Vector3::new(e[3], e[4], e[5]))
    }
}

/// Where stage `i` of `steps` steps from `a` to `b` lies: a hair inside, so that a jump at an end is seen from the
/// piece's own side. Where something jumps is known to a few digits of the arc length at best.
pub(crate) fn stage(a: f64, b: f64, steps: usize, i: usize) -> f64 {
    let inset = (1e-12 * (b - a)).max(8.0 * f64::EPSILON * b).min(0.01 * (b - a));
    let x = ((i / STAGES) as f64 + NODES[i % STAGES]) / steps as f64;
    (a + (b - a) * x).clamp(a + inset, b - inset)
}

/// Parts from `a` to `b` that get shorter towards both ends.
pub(crate) fn graded(a: f64, b: f64, halvings: i32) -> Vec<[f64; 2]> {
    let at = |x: f64| a + (b - a) * x;
    let mut ends = vec![0.0];
    ends.extend((1..=halvings).rev().map(|k| 0.5f64.powi(k)));
    ends.extend((2..=halvings).map(|k| 1.0 - 0.5f64.powi(k)));
    ends.push(1.0);
    ends.windows(2).map(|pair| [at(pair[0]), at(pair[1])]).collect()
}

/// One beam of the model, ready to be cut into pieces.
#[derive(Clone, Debug)]
pub(crate) struct BeamLaw {
    pub shape: RestShape,
    pub length: f64,
    beam: Beam,
    section: Section,
    material: Option<Material>,
    gravity: Vector3<f64>,
    spin: Option<Spin>,
    uniform: bool,
    loaded: bool,
    loads_uniform: bool,
    coupled: bool,
    /// Arc lengths inside the beam where something is not smooth, increasing.
    breaks: Vec<f64>,
    pub founded: Founded,
    pub scale: Scale,
    /// Largest of the bending and torsional compliances found on a scan, SI.
    softest: f64,
    /// What that compliance counts for along the whole beam, SI; the same where it is the same everywhere.
    supple: f64,
    /// The mean of that compliance along the beam, SI.
    mean_soft: f64,
    /// Largest of the compliances in stretching and shear, SI.
    yielding: f64,
    /// Compliance in stretching besides that of the section, SI; zero but on the way to an equilibrium.
    softening: f64,
    /// Nondimensional units of force and moment of this beam, EI/L² and EI/L of its softest bending.
    pub wrench_unit: [f64; 2],
}

impl BeamLaw {
    pub fn new(model: &Model, id: BeamId) -> Result<Self, ProblemError> {
        let beam = model[id].clone();
        let path = format!("beam.{}", beam.name);
        let shape = RestShape::new(&beam.curve, &beam.frame).map_err(|error| {
            ProblemError::new(format!("{path}.curve"), error.to_string(), "check the curve's numbers")
        })?;
        let section = model[beam.section].clone();
        let material = beam.material.map(|m| model[m].clone());
        let length = shape.length();
        let mut law = Self {
            uniform: shape.uniform().is_some() && is_uniform(&section),
            loaded: false,
            loads_uniform: beam
                .distributed
                .iter()
                .all(|d| d.force.iter().chain(&d.moment).all(|p| p.as_constant().is_some()))
                && is_uniform(&section),
            coupled: false,
            breaks: Vec::new(),
            gravity: model.gravity,
            spin: model.spin,
            scale: Scale { length: 1.0, force: 1.0 },
            softest: 0.0,
            supple: 0.0,
            mean_soft: 0.0,
            yielding: 0.0,
            softening: 0.0,
            founded: Founded::new(&beam, length)?,
            wrench_unit: [1.0; 2],
            shape,
            length,
            beam,
            section,
            material,
        };
        law.breaks = law.find_breaks();
        law.scan(&path)?;
        (law.supple, law.mean_soft) = law.find_supple();
        Ok(law)
    }

    /// Is it the law of this beam of a model, too? How the beam is held does not enter it.
    pub fn is_of(&self, model: &Model, id: BeamId) -> bool {
        let (own, other) = (&self.beam, &model[id]);
        self.softening == 0.0
            && self.gravity == model.gravity
            && self.spin == model.spin
            && (own.start.is_some(), own.end.is_some()) == (other.start.is_some(), other.end.is_some())
            && own.theory == other.theory
            && own.curve == other.curve
            && own.frame == other.frame
            && own.distributed == other.distributed
            && own.foundation == other.foundation
            && self.section == model[other.section]
            && self.material.as_ref() == other.material.map(|material| &model[material])
            && own.name == other.name
    }

    /// Looks at the whole beam once, so that later evaluations cannot fail.
    fn scan(&mut self, path: &str) -> Result<(), ProblemError> {
        let same = self.uniform && self.loads_uniform && self.beam.distributed.is_empty();
        let places = if same { vec![0.5 * self.length] } else { self.scanned() };
        self.loaded = self
            .beam
            .distributed
            .iter()
            .any(|d| d.force.iter().chain(&d.moment).any(|profile| profile.as_constant() != Some(0.0)));
        for s in places {
            let law = self.try_law_at(s).map_err(|error| {
                ProblemError::new(format!("section.{}", self.section.name), error, format!("used by {path}"))
            })?;
            let c = law.compliance.to_matrix();
            for j in 3..6 {
                if c[(j, j)] < 0.0 || !c[(j, j)].is_finite() {
                    return Err(ProblemError::new(
                        format!("section.{}", self.section.name),
                        "gives a stiffness that is not positive",
                        "give positive dimensions and stiffnesses",
                    ));
                }
            }
            self.yielding = self.yielding.max(c[(0, 0)]).max(c[(1, 1)]).max(c[(2, 2)]);
            self.softest = self.softest.max(c[(4, 4)]).max(c[(5, 5)]).max(c[(3, 3)]);
            self.coupled |= matches!(law.compliance, Compliance::Full(_));
            let load = self.load_at(s);
            self.loaded |= load != LoadSample::default();
            let numbers = [load.dead_force, load.dead_moment, load.section_force, load.section_moment];
            if numbers.iter().flatten().any(|v| !v.is_finite()) {
                return Err(ProblemError::new(
                    format!("{path}.distributed"),
                    format!("gives no finite number at s = {s} m"),
                    "check the expression",
                ));
            }
        }
        if self.softest == 0.0 {
            return Err(ProblemError::new(
                path,
                "neither bends nor twists: all its stiffnesses are infinite",
                "make it a body, or give it a finite stiffness",
            ));
        }
        Ok(())
    }

    /// Places all along, and some of every interval between breaks.
    fn scanned(&self) -> Vec<f64> {
        let mut places: Vec<f64> = (0..=64).map(|i| self.length * f64::from(i) / 64.0).collect();
        let mut from = 0.0;
        for to in self.breaks.iter().copied().chain([self.length]) {
            places.extend([0.1, 0.5, 0.9].map(|x| from + (to - from) * x));
            from = to;
        }
        places
    }

    /// EI of the softest bending or torsion, N·m², averaged where it varies.
    pub fn stiffness(&self) -> f64 {
        1.0 / self.supple
    }

    /// The compliance by which the beam as a whole bends: ∫c w ds/∫w ds, weighted by how a moment runs along it. A tip that is
    /// thin and that carries nothing does not make a beam soft.
    /// Returns the plain mean, too.
    fn find_supple(&self) -> (f64, f64) {
        if is_uniform(&self.section) {
            return (self.softest, self.softest);
        }
        let power = match (&self.beam.end, self.loaded) {
            (Some(_), _) => 0,
            (None, false) => 1,
            (None, true) => 2,
        };
        let mut ends = vec![0.0];
        ends.extend(&self.breaks);
        ends.push(self.length);
        // Few breaks: parts that get shorter towards both ends of every interval.
        let halvings = if ends.len() > 12 { 1 } else { 16 };
        let (mut sums, mut means, mut whole) = ([0.0; 3], [0.0; 3], 0.0);
        for pair in ends.windows(2) {
            for [a, b] in graded(pair[0], pair[1], halvings) {
                for (node, weight) in GAUSS {
                    let s = a + (b - a) * node;
                    let c = self.law_at(s).compliance.to_matrix();
                    let (part, weight) = (weight * (b - a), (1.0 - s / self.length).powi(power));
                    for i in 0..3 {
                        sums[i] += weight * part * c[(3 + i, 3 + i)];
                        means[i] += part * c[(3 + i, 3 + i)];
                    }
                    whole += weight * part;
                }
            }
        }
        let largest = |sums: [f64; 3]| sums.into_iter().fold(0.0, f64::max);
        let sound = |value: f64| if value > 0.0 && value.is_finite() { value } else { self.softest };
        (sound(largest(sums) / whole), sound(largest(means) / self.length))
    }

    pub fn set_scale(&mut self, scale: Scale) {
        self.scale = scale;
        self.wrench_unit = [
            self.stiffness() / (self.length * self.length) / scale.force,
            self.stiffness() / self.length / scale.moment(),
        ];
    }

    /// Does a distributed load act?
    pub fn is_loaded(&self) -> bool {
        self.loaded
    }

    /// Does a distributed load follow the section?
    pub fn follows(&self) -> bool {
        self.beam.distributed.iter().any(|d| {
            d.axes == LoadAxes::Section
                && d.force.iter().chain(&d.moment).any(|p| p.as_constant() != Some(0.0))
        })
    }

    /// Is a distributed load written in the section's axes, whatever its value?
    pub fn may_follow(&self) -> bool {
        self.beam.distributed.iter().any(|d| d.axes == LoadAxes::Section)
    }

    /// Is there a distributed moment in fixed axes?
    pub fn turns(&self) -> bool {
        self.beam
            .distributed
            .iter()
            .any(|d| d.axes == LoadAxes::Global && d.moment.iter().any(|p| p.as_constant() != Some(0.0)))
    }

    /// How the frame spins in which it is described.
    pub fn spin(&self) -> Option<Spin> {
        self.spin
    }

    /// Are curvature and section the same all along?
    pub fn is_uniform(&self) -> bool {
        self.uniform
    }

    /// Arc lengths inside the beam where something is not smooth, SI, increasing.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Is everything the same all along: curvature, section, loads and foundations?
    pub fn is_even(&self) -> bool {
        self.uniform && (self.loads_uniform || !self.loaded) && self.founded.is_even()
    }

    pub fn is_coupled(&self) -> bool {
        self.coupled
    }

    pub fn section(&self) -> &Section {
        &self.section
    }

    fn find_breaks(&self) -> Vec<f64> {
        let mut breaks = self.shape.breaks().to_vec();
        breaks.extend(section_breaks(&self.section, self.length));
        for load in &self.beam.distributed {
            breaks.extend(load.breaks(self.length));
        }
        breaks.extend(self.founded.breaks(self.length));
        breaks.retain(|s| *s > 0.0 && *s < self.length);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| (*a - *b).abs() < 1e-13 * self.length);
        breaks
    }

    fn try_law_at(&self, s: f64) -> Result<LocalLaw, String> {
        let compliance = compliance(&self.section, self.material.as_ref(), self.beam.theory, s, self.length)
            .map_err(|error| error.to_string())?;
        let k0 = self.shape.curvature(s);
        if !(k0.x.is_finite() && k0.y.is_finite() && k0.z.is_finite()) {
            return Err(format!("the rest curvature is not finite at s = {s} m"));
        }
        Ok(LocalLaw { k0, compliance })
    }

    /// The law at `s`, SI. NaN where an expression gives no sound section: Newton then refuses the state.
    pub fn law_at(&self, s: f64) -> LocalLaw {
        let mut law = self.try_law_at(s).unwrap_or_else(|_| LocalLaw {
            k0: Vector3::repeat(f64::NAN),
            compliance: Compliance::Diagonal([f64::NAN; 6]),
        });
        match &mut law.compliance {
            Compliance::Diagonal(diagonal) => diagonal[0] += self.softening,
            Compliance::Full(rows) => rows[0][0] += self.softening,
        }
        law
    }

    /// Lets the beam stretch more than its section does, 1/N.
    pub fn soften(&mut self, compliance: f64) {
        self.softening = compliance;
    }

    /// Does it stretch more than its section does?
    pub fn is_softened(&self) -> bool {
        self.softening != 0.0
    }

    /// Distributed load at `s`, SI, gravity among it.
    fn load_at(&self, s: f64) -> LoadSample {
        let mut sample = LoadSample::default();
        let at = |profiles: &[Profile; 3], into: &mut [f64; 3]| {
            for (value, profile) in into.iter_mut().zip(profiles) {
                *value += profile.value(s, self.length);
            }
        };
        for load in self.beam.distributed.iter().filter(|load| load.acts_at(s, self.length)) {
            match load.axes {
                LoadAxes::Global => {
                    at(&load.force, &mut sample.dead_force);
                    at(&load.moment, &mut sample.dead_moment);
                }
                LoadAxes::Section => {
                    at(&load.force, &mut sample.section_force);
                    at(&load.moment, &mut sample.section_moment);
                }
            }
        }
        if self.gravity != Vector3::zeros() {
            let mass = mass_per_length(&self.section, self.material.as_ref(), s, self.length);
            let mass = mass.unwrap_or(f64::NAN);
            for i in 0..3 {
                sample.dead_force[i] += mass * self.gravity[i];
            }
        }
        sample
    }

    /// Mass per length (kg/m), with what is added to the section's, and moments of inertia per length about the section's axes (kg·m)
    /// at `s`; NaN where an expression gives no sound section.
    pub fn mass_at(&self, s: f64) -> (f64, [f64; 3]) {
        let (section, material) = (&self.section, self.material.as_ref());
        let mass = mass_per_length(section, material, s, self.length).unwrap_or(f64::NAN);
        let rotary = rotary_inertia(section, material, s, self.length).unwrap_or([f64::NAN; 3]);
        (mass + self.beam.added_mass, rotary)
    }

    /// The law at `s`, nondimensional.
    pub fn scaled_law(&self, s: f64) -> ScaledLaw {
        let law = self.law_at(s);
        let (length, force) = (self.scale.length, self.scale.force);
        let unit = |i: usize| if i < 3 { 1.0 } else { length };
        let c = law.compliance.to_matrix();
        ScaledLaw {
            k0: law.k0 * length,
            compliance: Matrix6::from_fn(|i, j| c[(i, j)] * force * unit(i) * unit(j)),
        }
    }

    /// Force and moment per length, nondimensional, that may act between two arc lengths without that a few places show it.
    pub fn hidden_load(&self, a: f64, b: f64) -> [f64; 2] {
        let (per_force, per_moment) = (self.scale.length / self.scale.force, 1.0 / self.scale.force);
        let hidden = |profiles: &[Profile; 3]| -> f64 {
            profiles.iter().filter_map(|p| p.variation(a, b)).map(|v| v.hidden()).sum()
        };
        let here = || self.beam.distributed.iter().filter(|d| d.acts_at(0.5 * (a + b), self.length));
        let force: f64 = here().map(|d| hidden(&d.force)).sum();
        let moment: f64 = here().map(|d| hidden(&d.moment)).sum();
        [force * per_force, moment * per_moment]
    }

    pub fn scaled_load(&self, s: f64) -> LoadSample {
        let (per_force, per_moment) = (self.scale.length / self.scale.force, 1.0 / self.scale.force);
        let load = self.load_at(s);
        LoadSample {
            dead_force: load.dead_force.map(|v| v * per_force),
            dead_moment: load.dead_moment.map(|v| v * per_moment),
            section_force: load.section_force.map(|v| v * per_force),
            section_moment: load.section_moment.map(|v| v * per_moment),
        }
    }

    /// The stretch from `a` to `b` (m) in equal steps, nondimensional. Nothing may be unsmooth inside.
    pub fn piece(&self, a: f64, b: f64, steps: usize) -> Piece {
        let place = |i: usize| stage(a, b, steps, i);
        let middle = 0.5 * (a + b);
        let entries = |uniform: bool| if uniform { 1 } else { steps * STAGES };
        let laws: Vec<LocalLaw> = (0..entries(self.uniform))
            .map(|i| self.law_at(if self.uniform { middle } else { place(i) }))
            .collect();
        let loads = if self.loaded {
            (0..entries(self.loads_uniform))
                .map(|i| self.scaled_load(if self.loads_uniform { middle } else { place(i) }))
                .collect()
        } else {
            Vec::new()
        };
        let foundation = self.foundation(a, b, steps);
        Piece { length: (b - a) / self.scale.length, steps, laws: self.table(&laws), loads, foundation }
    }

    fn table(&self, laws: &[LocalLaw]) -> LawTable {
        let (length, force) = (self.scale.length, self.scale.force);
        let (stretch, bend) = (force, force * length * length);
        let k0 = |law: &LocalLaw| [law.k0.x * length, law.k0.y * length, law.k0.z * length];
        if self.coupled {
            return LawTable::Coupled(
                laws.iter()
                    .map(|law| {
                        let c = law.compliance.to_matrix();
                        let unit = |i: usize| if i < 3 { 1.0 } else { length };
                        Coupled {
                            k0: k0(law),
                            compliance: std::array::from_fn(|i| {
                                std::array::from_fn(|j| c[(i, j)] * force * unit(i) * unit(j))
                            }),
                        }
                    })
                    .collect(),
            );
        }
        let diagonal = |law: &LocalLaw| {
            let c = law.compliance.to_matrix();
            (
                [c[(0, 0)] * stretch, c[(1, 1)] * stretch, c[(2, 2)] * stretch],
                [c[(3, 3)] * bend, c[(4, 4)] * bend, c[(5, 5)] * bend],
            )
        };
        if self.beam.theory.shear {
            LawTable::Shearable(
                laws.iter()
                    .map(|law| {
                        let (shear, bend) = diagonal(law);
                        Shearable { k0: k0(law), shear, bend }
                    })
                    .collect(),
            )
        } else {
            LawTable::Slender(
                laws.iter()
                    .map(|law| {
                        let (stretch, bend) = diagonal(law);
                        Slender { k0: k0(law), stretch: stretch[0], bend }
                    })
                    .collect(),
            )
        }
    }

    /// Rest curvature, nondimensional, where it is the same everywhere.
    pub fn rest_rate(&self) -> f64 {
        self.shape.uniform().map_or(0.0, |k0| k0.norm() * self.scale.length)
    }

    /// Largest of the compliances in stretching and shear, nondimensional.
    pub fn yields(&self) -> f64 {
        self.yielding * self.scale.force
    }

    /// ∫ of the compliance in bending along the beam, nondimensional.
    pub fn soft_all_along(&self) -> f64 {
        self.mean_soft * self.scale.force * self.scale.length * self.length
    }

    /// Largest of the compliances in bending and torsion, nondimensional.
    pub fn soft(&self) -> f64 {
        self.softest * self.scale.force * self.scale.length * self.scale.length
    }
}
