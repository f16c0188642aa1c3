//! Springs, ligaments, what they run over, and cables.

use super::{Draft, list, read_back};
use crate::random::number;

/// An end of a spring: how the file writes it, and where it is initially, if that is plain.
struct Place {
    text: String,
    at: Option<[f64; 3]>,
}

impl Draft {
    /// A place on a body, on the ground or on a beam.
    fn place(&mut self, may_be_beam: bool) -> Place {
        let size = self.size;
        if may_be_beam && !self.beams.is_empty() && self.random.chance(40) {
            let beam = self.beams[self.random.below(self.beams.len())].clone();
            let at = self.random.pick(&["0.3", "0.5", "0.7", "1"]);
            let offset = if self.random.chance(30) {
                let offset = self.vector(0.05 * size, "");
                format!(", offset = {offset}")
            } else {
                String::new()
            };
            return Place { text: format!("{{ beam = \"{beam}\", at = {at}{offset} }}"), at: None };
        }
        if self.bodies.is_empty() || self.random.chance(30) {
            let at = self.point([0.0; 3], 1.5 * size);
            return Place { text: format!("{{ body = \"ground\", at = {} }}", list(&at)), at: Some(at) };
        }
        let body = self.bodies[self.random.below(self.bodies.len())].clone();
        let offset = self.point([0.0; 3], 0.2 * size);
        let at = [0, 1, 2].map(|i| body.at[i] + offset[i]);
        Place {
            text: format!("{{ body = \"{}\", at = {} }}", body.name, list(&offset)),
            at: body.straight.then_some(at),
        }
    }

    /// A spring or ligament between two places, perhaps over something round.
    pub(super) fn spring(&mut self) {
        let (from, to) = (self.place(true), self.place(true));
        if from.text == to.text {
            return;
        }
        let name = self.name("f");
        let mut text = format!("[spring.{name}]\nfrom = {}\nto = {}\n", from.text, to.text);
        let apart = match (from.at, to.at) {
            (Some(a), Some(b)) => Some(distance(&a, &b)),
            _ => None,
        };
        text.push_str(&self.tension_law());
        match apart {
            Some(length) if length < 1e-3 * self.size => return,
            Some(length) if self.random.chance(40) => {
                text.push_str(&format!("rest_length = {}\n", number(length * self.random.between(0.8, 1.1))));
            }
            _ => {}
        }
        if let (Some(a), Some(b)) = (from.at, to.at)
            && self.random.chance(35)
        {
            text.push_str(&self.wrap(&a, &b));
        }
        self.line(&text);
        self.outputs.push(format!("{name}_pull = \"spring.{name}.tension\""));
        self.outputs.push(format!("{name}_long = \"spring.{name}.length\""));
    }

    fn tension_law(&mut self) -> String {
        let (force, size) = (self.force(), self.size);
        let k = number(force / size * self.random.decade(-2, 2));
        match self.random.below(8) {
            0..=2 => format!("stiffness = {k}\n"),
            3 => format!("stiffness = {k}\ntension_only = true\n"),
            4 => {
                let area = self.thick * self.thick;
                let stress = number(force * self.random.between(0.01, 1.0) / area);
                let form = self.random.pick(&["continuous", "continuous", "printed"]);
                format!(
                    "law = \"exponential\"\narea = {}\nexponent = {}\nstress = {stress}\nform = \"{form}\"\n",
                    number(area),
                    self.random.between(2.0, 15.0)
                )
            }
            5 | 6 => {
                let k = number(force * self.random.decade(-1, 2));
                format!(
                    "law = \"toe\"\naxial_stiffness = {k}\ntoe_strain = {}\n",
                    self.random.between(0.02, 0.1)
                )
            }
            _ => {
                let (x, f) = (0.1 * size, force * self.random.between(0.1, 1.0));
                let rows = format!(
                    "[[0, 0], [{}, {}], [{}, {}], [{}, {}]]",
                    number(x),
                    number(f),
                    number(2.0 * x),
                    number(2.5 * f),
                    number(3.0 * x),
                    number(6.0 * f)
                );
                format!("law = \"table\"\nrows = {rows}\n")
            }
        }
    }

    /// Something round on the ground between the ends, which lie outside of it.
    fn wrap(&mut self, a: &[f64; 3], b: &[f64; 3]) -> String {
        let length = distance(a, b);
        let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        let center = self.point(middle, 0.25 * length);
        let near = distance(a, &center).min(distance(b, &center));
        if self.random.chance(50) {
            let radius = number(near * self.random.between(0.1, 0.85));
            return format!("wrap = {{ body = \"ground\", at = {}, sphere = {radius} }}\n", list(&center));
        }
        let (axis, across) =
            self.random.pick(&[("[0, 0, 1]", [0, 1]), ("[0, 1, 0]", [0, 2]), ("[1, 0, 0]", [1, 2])]);
        let from_axis = |p: &[f64; 3]| {
            let (x, y) = (p[across[0]] - center[across[0]], p[across[1]] - center[across[1]]);
            (x * x + y * y).sqrt()
        };
        let near = from_axis(a).min(from_axis(b));
        let radius = number(near * self.random.between(0.1, 0.85));
        let turn = self.random.pick(&["", "", ", turn = \"positive\"", ", turn = \"negative\""]);
        format!(
            "wrap = {{ body = \"ground\", at = {}, cylinder = {radius}, axis = {axis}{turn} }}\n",
            list(&center)
        )
    }

    /// A cable through eyelets, or a tendon in a channel.
    pub(super) fn cable(&mut self) {
        let name = self.name("t");
        if !self.beams.is_empty() && self.random.chance(50) {
            return self.tendon(&name);
        }
        let places: Vec<Place> = (0..2 + self.random.below(3)).map(|_| self.place(true)).collect();
        for pair in places.windows(2) {
            if let (Some(a), Some(b)) = (pair[0].at, pair[1].at)
                && distance(&a, &b) < 1e-2 * self.size
            {
                return;
            }
            if pair[0].text == pair[1].text {
                return;
            }
        }
        let mut length = Some(0.0);
        for pair in places.windows(2) {
            length = match (length, pair[0].at, pair[1].at) {
                (Some(sum), Some(a), Some(b)) => Some(sum + distance(&a, &b)),
                _ => None,
            };
        }
        let law = match length {
            Some(length) if self.random.chance(50) => {
                let shorter = self.random.between(-0.01, 0.03);
                format!("length = \"{}*(1 - factor*{shorter})\"", number(length))
            }
            _ => format!("tension = \"factor*{}\"", number(self.strength() * self.force())),
        };
        let route: Vec<&str> = places.iter().map(|place| place.text.as_str()).collect();
        self.line(&format!("[cable.{name}]\n{law}\nroute = [{}]\n", route.join(", ")));
        self.outputs.push(format!("{name}_pull = \"cable.{name}.tension\""));
        self.outputs.push(format!("{name}_long = \"cable.{name}.length\""));
    }

    fn tendon(&mut self, name: &str) {
        let beam = self.beams[self.random.below(self.beams.len())].clone();
        let arm = read_back(self.thick * self.random.between(1.0, 4.0));
        let (from, to) = self.random.pick(&[("0", "1"), ("0", "0.7"), ("0.2", "1"), ("0.1", "0.6")]);
        let offset = match self.random.below(3) {
            0 => format!("[{}, 0]", number(arm)),
            1 => format!("[{}, {}]", number(0.5 * arm), number(-arm)),
            _ => {
                let wave = number(6.0 / self.size);
                format!("[\"{a}*cos({wave}*s)\", \"{a}*sin({wave}*s)\"]", a = number(arm))
            }
        };
        let mut route = format!("{{ beam = \"{beam}\", from = {from}, to = {to}, offset = {offset} }}");
        if self.random.chance(30) {
            let anchor = self.point([0.0; 3], 2.0 * self.size);
            let anchor = format!("{{ body = \"ground\", at = {} }}", list(&anchor));
            route = if self.random.chance(50) {
                format!("{anchor}, {route}")
            } else {
                format!("{route}, {anchor}")
            };
        }
        // What bends by a moment of EI/L is a tension of that moment over the arm.
        let tension = number(self.strength() * self.moment() / arm);
        self.line(&format!("[cable.{name}]\ntension = \"factor*{tension}\"\nroute = [{route}]\n"));
        self.outputs.push(format!("{name}_long = \"cable.{name}.length\""));
    }
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt()
}
