//! Random mechanisms, written as model files.
//!
//! A mechanism grows from the ground: every part that is added is held by what is there already, so that the whole is held too,
//! whatever is drawn. Lengths are drawn about a size L, thicknesses about L over a slenderness, loads about EI/L² and stiffnesses
//! of springs about EI/L³, L and E themselves over many decades. All loads and drives stand in proportion to the parameter
//! `factor`, which is one.

mod beams;
mod contacts;
mod hanging;
mod joints;
mod loads;
mod pulls;
mod tubes;

use crate::random::{Random, number};

/// What a mechanism is meant to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// Held by beams, joints and springs: it must be solved, or stall for a reason.
    Held,
    /// Held by its loads only: pendulums, weights on ligaments.
    Hanging,
    /// Something in it is held by nothing: it must be refused by name.
    Loose,
}

/// A random mechanism.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// The model file.
    pub text: String,
    /// What it is meant to be.
    pub sort: Sort,
}

/// The mechanism of a seed.
pub fn mechanism(seed: u64) -> Mechanism {
    let mut draft = Draft::new(seed);
    let drawn = draft.random.below(100);
    let sort = match drawn {
        0..=7 => Sort::Hanging,
        8 | 9 => Sort::Loose,
        _ => Sort::Held,
    };
    match sort {
        Sort::Hanging => draft.hang(),
        Sort::Loose => draft.leave_loose(),
        Sort::Held => draft.grow(),
    }
    Mechanism { text: draft.finish(seed), sort }
}

/// A body that may carry something.
#[derive(Clone, Debug)]
struct BodyDraft {
    name: String,
    /// Where its origin is initially, m.
    at: [f64; 3],
    /// Are its axes those of the ground?
    straight: bool,
}

/// A mechanism while it is made.
struct Draft {
    random: Random,
    /// L, m.
    size: f64,
    /// Thickness of its beams, m.
    thick: f64,
    /// Young's modulus, Pa.
    young: f64,
    /// Tables that are finished.
    tables: String,
    bodies: Vec<BodyDraft>,
    beams: Vec<String>,
    /// Coordinates that may be coupled: as a relation names them, and whether they are angles.
    coordinates: Vec<(String, bool)>,
    outputs: Vec<String>,
    parts: usize,
    is_heavy: bool,
}

impl Draft {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let size = random.decade(-4, 1);
        let thick = size / random.between(15.0, 150.0);
        let young = random.decade(5, 12);
        let is_heavy = random.chance(30);
        Self {
            random,
            size,
            thick,
            young,
            tables: String::new(),
            bodies: Vec::new(),
            beams: Vec::new(),
            coordinates: Vec::new(),
            outputs: Vec::new(),
            parts: 0,
            is_heavy,
        }
    }

    /// EI of a square of that thickness, N·m².
    fn bending(&self) -> f64 {
        let square = self.thick * self.thick;
        self.young * square * square / 12.0
    }

    /// EI/L², N.
    fn force(&self) -> f64 {
        self.bending() / (self.size * self.size)
    }

    /// EI/L, N·m.
    fn moment(&self) -> f64 {
        self.bending() / self.size
    }

    /// How strong something is against its unit: mostly about one, now and then much less or more.
    fn strength(&mut self) -> f64 {
        let common = self.random.between(0.05, 1.5);
        match self.random.below(20) {
            0 => common * 1e-6,
            1 | 2 => common * 1e-2,
            3 => common * 8.0,
            _ => common,
        }
    }

    /// A name that no other part has.
    fn name(&mut self, kind: &str) -> String {
        self.parts += 1;
        format!("{kind}{}", self.parts)
    }

    fn line(&mut self, text: &str) {
        self.tables.push_str(text);
        self.tables.push('\n');
    }

    /// A mechanism that holds together.
    fn grow(&mut self) {
        if self.random.chance(5) {
            self.nest("ground");
        }
        let parts = 1 + self.random.below(5);
        for _ in 0..parts {
            match self.random.below(100) {
                0..=44 => self.chain(),
                45..=64 => self.jointed_body(),
                65..=76 => self.loop_beam(),
                77..=84 => self.rolling_body(),
                85..=92 => self.touching_body(),
                93..=94 => self.frame(),
                _ => self.chain(),
            }
        }
        self.decorate();
    }

    /// What acts on a mechanism that stands.
    fn decorate(&mut self) {
        for _ in 0..self.random.below(3) {
            self.spring();
        }
        if self.random.chance(25) {
            self.cable();
        }
        if self.random.chance(25) {
            self.coupling();
        }
        if self.random.chance(20) {
            self.point_mass();
        }
        for _ in 0..1 + self.random.below(3) {
            self.load();
        }
    }

    /// A vector of three numbers about `unit`, some of them zero.
    fn vector(&mut self, unit: f64, factor: &str) -> String {
        let flat = self.random.chance(40);
        let lone = self.random.below(3);
        let parts: Vec<String> = (0..3)
            .map(|i| {
                let value = self.random.between(-1.0, 1.0) * unit;
                let left_out = if flat { i != lone } else { self.random.chance(25) };
                if left_out || value == 0.0 {
                    "0".to_owned()
                } else if factor.is_empty() {
                    number(value)
                } else {
                    format!("\"{factor}{}\"", number(value))
                }
            })
            .collect();
        format!("[{}]", parts.join(", "))
    }

    /// A place about the mechanism, m, as it is read back from the file.
    fn point(&mut self, about: [f64; 3], reach: f64) -> [f64; 3] {
        about.map(|x| read_back(x + self.random.between(-reach, reach)))
    }

    /// A rotation, as a table.
    fn rotation(&mut self) -> String {
        let axis = self.axis();
        let angle = self.random.below(37) as f64 * 10.0 - 180.0;
        format!("{{ axis = {axis}, angle = \"{angle} deg\" }}")
    }

    fn axis(&mut self) -> &'static str {
        self.random.pick(&["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "[1, 1, 0]", "[1, -2, 2]", "[0, 1, 1]"])
    }

    /// The whole file.
    fn finish(mut self, seed: u64) -> String {
        if self.outputs.is_empty() {
            self.outputs.push("energy = \"model.energy\"".to_owned());
        }
        let mut text = format!(
            "# Drawn from the seed {seed}.\nformat = 1\nname = \"seed {seed}\"\n{}\n[parameter]\nfactor = 1\n\n",
            if self.is_heavy { "gravity = [0, 0, \"-9.81*factor\"]\n" } else { "" }
        );
        text.push_str(&format!("[material.m]\nyoung = {}\npoisson = 0.3\n", number(self.young)));
        if self.is_heavy {
            // A beam weighs about EI/L².
            let weight = self.random.between(0.05, 1.0) * self.force();
            let volume = self.thick * self.thick * self.size;
            text.push_str(&format!("density = {}\n", number(weight / (9.81 * volume))));
        }
        text.push('\n');
        text.push_str(&self.tables);
        text.push_str(&format!("\n[output]\n{}\n", self.outputs.join("\n")));
        text.push_str("\n[study.answer]\nkind = \"solve\"\n\n[study.loads]\nkind = \"buckle\"\ncount = 2\n");
        if seed.is_multiple_of(4) {
            text.push_str(
                "\n[study.path]\nkind = \"trace\"\nparameter = \"factor\"\nrange = [0, 1]\nsteps = 12\n",
            );
        }
        text
    }
}

/// The number that a file holds for this one.
fn read_back(value: f64) -> f64 {
    number(value).parse().unwrap_or(value)
}

/// A point as a list.
fn list(point: &[f64; 3]) -> String {
    format!("[{}]", point.map(number).join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_always_writes_the_same_file() {
        for seed in 0..50 {
            assert_eq!(mechanism(seed).text, mechanism(seed).text);
        }
        assert_ne!(mechanism(1).text, mechanism(2).text);
    }

    #[test]
    fn every_file_reads_well() {
        for seed in 0..500 {
            let text = mechanism(seed).text;
            let document = flexura::modelfile::Document::parse(&text, "drawn.toml");
            let model = document.and_then(|document| document.model(&[]));
            if let Err(report) = model {
                panic!("seed {seed}:\n{}\n{text}", report.render(false));
            }
        }
    }
}
