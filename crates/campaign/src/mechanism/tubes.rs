//! Concentric tubes.

use super::Draft;
use crate::random::number;

impl Draft {
    /// One to three tubes in each other, turned and shifted.
    pub(super) fn nest(&mut self, base: &str) {
        let name = self.name("n");
        let count = 1 + self.random.below(3);
        let mut rows = Vec::new();
        let mut reach = self.size * self.random.between(0.6, 1.2);
        for i in 0..count {
            let section = self.name("s");
            let outer = self.thick * (1.0 + 0.5 * i as f64);
            let inner = 0.8 * outer;
            self.line(&format!(
                "[section.{section}]\nshape = \"tube\"\nouter_diameter = {}\ninner_diameter = {}\n",
                number(outer),
                number(inner)
            ));
            let curved = reach * self.random.between(0.2, 0.6);
            let back = reach * self.random.pick(&[0.0, 0.0, 0.1, 0.3]);
            let straight = reach - curved + back;
            // Short of snapping: curvatures times lengths stay small where tubes oppose each other.
            let bend = number(self.random.between(0.1, 1.0) / self.size);
            let turn = self.random.below(13) as f64 * 15.0 - 90.0;
            rows.push(format!(
                "{{ material = \"m\", section = \"{section}\", straight = {}, curved = {}, curvature = {bend}, rotation = \
                 \"factor*{turn} deg\", translation = {} }}",
                number(straight),
                number(curved),
                number(-back)
            ));
            reach *= self.random.between(0.5, 0.9);
        }
        let mut text =
            format!("[tubes.{name}]\nbase = {{ body = \"{base}\", rotation = {} }}\n", self.rotation());
        text.push_str(&format!("tube = [\n  {},\n]\n", rows.join(",\n  ")));
        if self.random.chance(50) {
            let unit = self.strength() * self.force();
            text.push_str(&format!("force = {}\n", self.vector(unit, "factor*")));
        }
        if self.random.chance(30) {
            let unit = 0.5 * self.strength() * self.moment();
            text.push_str(&format!("moment = {}\n", self.vector(unit, "factor*")));
        }
        self.line(&text);
        self.outputs.push(format!("{name}_tip = \"tubes.{name}.position\""));
    }
}
