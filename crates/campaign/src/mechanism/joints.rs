//! Joints, and the holds of beams' ends.

use super::Draft;
use crate::random::number;

/// What a kind leaves free: the tables of its coordinates, and whether each is an angle.
const KINDS: &[(&str, &[(&str, bool)])] = &[
    ("revolute", &[("", true)]),
    ("prismatic", &[("", false)]),
    ("cylindrical", &[("angle", true), ("position", false)]),
    ("universal", &[("first", true), ("second", true)]),
    ("planar", &[("x", false), ("y", false), ("angle", true)]),
    ("spherical", &[]),
    ("free", &[("x", false), ("y", false), ("z", false)]),
];

impl Draft {
    /// A new body on a joint whose coordinates all have springs or drives.
    pub(super) fn jointed_body(&mut self) {
        let (parent, place) = self.carrier();
        let rotation = self.rotation();
        let child = self.new_body();
        let name = self.name("j");
        let kind = self.random.below(KINDS.len() + 1);
        let head = format!(
            "[joint.{name}]\nparent = {{ body = \"{parent}\", at = {place}, rotation = {rotation} }}\nchild = \"{child}\"\n"
        );
        if kind == KINDS.len() {
            self.line(&format!("{head}kind = \"weld\"\n"));
            return;
        }
        let keys = self.law(kind, true, "rotation");
        self.line(&format!("{head}kind = \"{}\"\n{}\n", KINDS[kind].0, keys.join("\n")));
        self.tell_coordinates(&name, kind, &keys);
    }

    /// Outputs and couplings may name the coordinates that are not driven.
    fn tell_coordinates(&mut self, joint: &str, kind: usize, keys: &[String]) {
        for (coordinate, angle) in KINDS[kind].1 {
            let (word, driven) = match *coordinate {
                "" => ("coordinate", keys.iter().any(|key| key.starts_with("coordinate"))),
                word => {
                    let own = keys.iter().find(|key| key.starts_with(&format!("{word} ")));
                    (word, own.is_some_and(|key| key.contains("coordinate")))
                }
            };
            self.outputs.push(format!("{joint}_{word} = \"joint.{joint}.{word}\""));
            if !driven {
                self.coordinates.push((format!("joint.{joint}.{word}"), *angle));
            }
        }
    }

    /// The keys of a hold, for an inline table. Where it is `sprung`, nothing is left free without a spring.
    pub(super) fn hold(&mut self, sprung: bool) -> String {
        let kind = self.random.below(KINDS.len());
        let keys = self.law(kind, sprung, "turning");
        let word = KINDS[kind].0;
        let mut all = vec![format!("hold = \"{word}\"")];
        all.extend(keys);
        all.join(", ")
    }

    fn law(&mut self, kind: usize, sprung: bool, turning: &str) -> Vec<String> {
        let (word, coordinates) = KINDS[kind];
        let mut keys = Vec::new();
        match word {
            "spherical" | "free" => {}
            "universal" => {
                let axes = [
                    ("[1, 0, 0]", "[0, 1, 0]"),
                    ("[0, 1, 0]", "[0, 0, 1]"),
                    ("[1, 1, 0]", "[1, -1, 0]"),
                    ("[1, 2, 2]", "[2, 1, -2]"),
                ];
                let (first, second) = self.random.pick(&axes);
                keys.push(format!("axis = {first}"));
                keys.push(format!("second_axis = {second}"));
            }
            _ => keys.push(format!("axis = {}", self.axis())),
        }
        for (coordinate, angle) in coordinates {
            let law = self.coordinate(*angle, sprung);
            if coordinate.is_empty() {
                keys.extend(law);
            } else if !law.is_empty() {
                keys.push(format!("{coordinate} = {{ {} }}", law.join(", ")));
            }
        }
        if matches!(word, "spherical" | "free") {
            let law = self.ball(sprung);
            if word == "spherical" {
                keys.extend(law);
            } else if !law.is_empty() {
                keys.push(format!("{turning} = {{ {} }}", law.join(", ")));
            }
        }
        keys
    }

    /// What acts on one coordinate.
    fn coordinate(&mut self, angle: bool, sprung: bool) -> Vec<String> {
        let (force, stretch) = if angle { (self.moment(), 1.0) } else { (self.force(), self.size) };
        if self.random.chance(12) {
            let value = number(self.random.between(-0.4, 0.4) * stretch);
            return vec![format!("coordinate = \"factor*{value}\"")];
        }
        let mut keys = Vec::new();
        if sprung || self.random.chance(40) {
            let stiffness = force / stretch * self.random.decade(-1, 2);
            keys.push(format!("stiffness = {}", number(stiffness)));
            if self.random.chance(15) {
                keys.push(format!("rest = \"factor*{}\"", number(self.random.between(-0.2, 0.2) * stretch)));
            }
        }
        if sprung && self.random.chance(35) {
            keys.push(format!(
                "effort = \"factor*{}\"",
                number(self.random.sign() * self.strength() * force)
            ));
        }
        if self.random.chance(8) {
            let wide = number(self.random.between(0.01, 0.3) * stretch);
            let stop = number(force / stretch * self.random.decade(0, 3));
            keys.push(format!("limits = {{ range = [-{wide}, {wide}], stiffness = {stop} }}"));
        }
        keys
    }

    /// What acts on a rotation vector.
    fn ball(&mut self, sprung: bool) -> Vec<String> {
        let mut keys = Vec::new();
        if self.random.chance(8) {
            return vec![format!("coordinate = {}", self.vector(0.5, "factor*"))];
        }
        if sprung || self.random.chance(40) {
            let stiffness = self.moment() * self.random.decade(-1, 2);
            keys.push(format!("stiffness = {}", number(stiffness)));
        }
        if sprung && self.random.chance(25) {
            let unit = self.strength() * self.moment();
            keys.push(format!("effort = {}", self.vector(unit, "factor*")));
        }
        keys
    }

    /// A relation between two coordinates that have springs of their own.
    pub(super) fn coupling(&mut self) {
        if self.coordinates.len() < 2 {
            return;
        }
        let first = self.random.below(self.coordinates.len());
        let (a, a_is_angle) = self.coordinates.remove(first);
        let second = self.random.below(self.coordinates.len());
        let (b, b_is_angle) = self.coordinates.remove(second);
        let unit = match (a_is_angle, b_is_angle) {
            (true, false) => 1.0 / self.size,
            (false, true) => self.size,
            _ => 1.0,
        };
        let ratio = number(self.random.sign() * self.random.between(0.2, 3.0) * unit);
        let unit = match (a_is_angle, b_is_angle) {
            (true, false) => " rad/m",
            (false, true) => " m/rad",
            _ => "",
        };
        let name = self.name("c");
        self.line(&format!("[coupling.{name}]\nrelation = \"{a} = {ratio}{unit}*{b}\"\n"));
    }
}
