//! Point loads and lumped masses.

use super::Draft;
use crate::random::number;

impl Draft {
    /// A force, a moment or both, on a body or along a beam.
    pub(super) fn load(&mut self) {
        if self.bodies.is_empty() && self.beams.is_empty() {
            return;
        }
        let name = self.name("l");
        let mut text = format!("[load.{name}]\n");
        let on_beam = self.bodies.is_empty() || (!self.beams.is_empty() && self.random.chance(55));
        if on_beam {
            let beam = self.beams[self.random.below(self.beams.len())].clone();
            let at = self.random.pick(&["1", "1", "0.5", "0.25", "0.63", "0.9"]);
            text.push_str(&format!("beam = \"{beam}\"\nat = {at}\n"));
        } else {
            let body = self.bodies[self.random.below(self.bodies.len())].name.clone();
            text.push_str(&format!("body = \"{body}\"\n"));
            if self.random.chance(40) {
                let at = self.vector(0.3 * self.size, "");
                text.push_str(&format!("at = {at}\n"));
            }
        }
        let what = self.random.below(3);
        if what != 1 {
            let unit = self.strength() * self.force() * 2.0;
            text.push_str(&format!("force = {}\n", self.vector(unit, "factor*")));
        }
        if what != 0 {
            let unit = self.strength() * self.moment();
            text.push_str(&format!("moment = {}\n", self.vector(unit, "factor*")));
        }
        if self.random.chance(20) {
            text.push_str("frame = \"local\"\n");
        }
        self.line(&text);
    }

    /// A lump on a beam, which weighs where there is gravity.
    pub(super) fn point_mass(&mut self) {
        if self.beams.is_empty() {
            return;
        }
        let beam = self.beams[self.random.below(self.beams.len())].clone();
        let name = self.name("m");
        let mass = number(self.strength() * self.force() / 9.81);
        let at = self.random.pick(&["0.4", "0.75", "1"]);
        self.line(&format!("[mass.{name}]\nbeam = \"{beam}\"\nat = {at}\nmass = {mass}\n"));
    }
}
