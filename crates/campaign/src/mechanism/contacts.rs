//! Bodies that roll and slide on the ground.

use super::{BodyDraft, Draft, list, read_back};
use crate::random::number;

impl Draft {
    /// A body whose outline rolls or slides on a line, a circle or an ellipse of the ground, or in a hole.
    pub(super) fn rolling_body(&mut self) {
        let size = self.size;
        let foot = self.point([0.0; 3], size);
        let a = read_back(size * self.random.between(0.05, 0.3));
        let b = read_back(a * self.random.between(0.5, 1.6));
        let is_circle = self.random.chance(50);
        let b = if is_circle { a } else { b };
        let outline = if is_circle {
            format!("{{ kind = \"circle\", radius = {} }}", number(a))
        } else {
            format!("{{ kind = \"ellipse\", semi_axes = [{}, {}] }}", number(a), number(b))
        };
        let (ground, down, start) = self.rolled_on([a, b]);
        let concave = down > 0.0;
        let body = self.placed_body([foot[0], foot[1] + b, foot[2]]);
        let frame = [foot[0], foot[1] + down, foot[2]];
        let name = self.name("j");
        let by = self.random.pick(&["angle", "angle", "turning", "arc"]);
        let mut text = format!(
            "[joint.{name}]\nkind = \"rolling\"\nparent = {{ body = \"ground\", at = {} }}\nchild = \"{body}\"\nchild_curve = \
             {outline}\nparent_curve = {ground}\nstart = {start}\nby = \"{by}\"\n",
            precise(&frame)
        );
        if concave {
            text.push_str("concave = true\n");
        }
        if by == "angle" {
            text.push_str(&self.slide(a));
        }
        let (force, stretch) = if by == "arc" { (self.force(), a) } else { (self.moment(), 1.0) };
        let law = if self.random.chance(20) {
            format!("coordinate = \"factor*{}\"", number(self.random.between(-0.5, 0.5) * stretch))
        } else {
            let stiffness = force / stretch * self.random.decade(-1, 2);
            let effort = number(self.random.sign() * self.strength() * force);
            format!("stiffness = {}, effort = \"factor*{effort}\"", number(stiffness))
        };
        if by == "arc" {
            text.push_str(&format!("arc = {{ {law} }}\n"));
        } else {
            text.push_str(&law.replace(", ", "\n"));
            text.push('\n');
        }
        self.line(&text);
        self.outputs.push(format!("{name}_roll = \"joint.{name}.contact.roll\""));
        self.outputs.push(format!("{name}_point = \"joint.{name}.contact.point\""));
    }

    /// What an ellipse rolls on: a curve, where its frame is above the first contact, and the parameters of that. Above the
    /// contact lies the middle of a hole.
    fn rolled_on(&mut self, [a, b]: [f64; 2]) -> (String, f64, &'static str) {
        let big = read_back(self.size * self.random.between(0.4, 2.0));
        let circle = |radius: f64| format!("{{ kind = \"circle\", radius = {} }}", number(radius));
        match self.random.below(4) {
            0 | 1 => ("{ kind = \"line\", normal = [0, 1] }".to_owned(), 0.0, "[\"-90 deg\", 0]"),
            2 => (circle(big), -big, "[\"-90 deg\", \"90 deg\"]"),
            _ => {
                // The hole is wider than the body everywhere.
                let hole = read_back(2.5 * (a * a / b).max(b * b / a).max(a).max(b));
                (circle(hole), hole, "[\"-90 deg\", \"-90 deg\"]")
            }
        }
    }

    fn slide(&mut self, radius: f64) -> String {
        let r = number(radius);
        match self.random.below(6) {
            0 => "slide = { kind = \"pure\" }\n".to_owned(),
            1 => format!("slide = {{ kind = \"ratio\", ratio = {} }}\n", self.random.between(0.5, 3.0)),
            2 => format!("slide = {{ kind = \"law\", slide = \"0.3*{r}*sin(q)\" }}\n"),
            3 => format!("slide = {{ kind = \"velocity\", velocity = \"0.2*{r}\", rate = 1 }}\n"),
            _ => String::new(),
        }
    }

    /// A body in a bowl or on a table in space, held by springs; or one that rolls by one angle.
    pub(super) fn touching_body(&mut self) {
        let size = self.size;
        let foot = self.point([0.0; 3], size);
        let axes: Vec<f64> = (0..3).map(|_| read_back(size * self.random.between(0.1, 0.3))).collect();
        let (a, b, c) = (axes[0], axes[1], axes[2]);
        let widest = (a * a / c).max(b * b / c).max(a).max(b).max(c);
        let bowl = read_back(widest * self.random.between(2.0, 5.0));
        let (surface, up, concave) = match self.random.below(3) {
            0 => ("{ kind = \"plane\" }".to_owned(), 0.0, false),
            1 => (format!("{{ kind = \"sphere\", radius = {} }}", number(bowl)), bowl, true),
            _ => (format!("{{ kind = \"sphere\", radius = {} }}", number(bowl)), -bowl, false),
        };
        let body = self.placed_body([foot[0], foot[1], foot[2] + c]);
        let frame = [foot[0], foot[1], foot[2] + up];
        let name = self.name("j");
        let mut text = format!(
            "[joint.{name}]\nkind = \"contact\"\nparent = {{ body = \"ground\", at = {} }}\nchild = \"{body}\"\nchild_surface = {{ kind = \
             \"ellipsoid\", semi_axes = [{}, {}, {}] }}\nparent_surface = {surface}\n",
            precise(&frame),
            number(a),
            number(b),
            number(c)
        );
        if concave {
            text.push_str("concave = true\n");
        }
        if self.random.chance(40) {
            let motion = self.random.pick(&["rolling", "osculating"]);
            let stiffness = number(self.moment() * self.random.decade(-1, 2));
            let effort = number(self.random.sign() * self.strength() * self.moment());
            text.push_str(&format!(
                "motion = \"{motion}\"\nabout = {}\nrange = [\"-60 deg\", \"60 deg\"]\nstiffness = {stiffness}\neffort = \"factor*{effort}\"\n",
                self.random.pick(&["[0, 1, 0]", "[1, 0, 0]", "[1, 2, 0]"])
            ));
            self.line(&text);
        } else {
            let stiffness = number(self.moment() * self.random.decade(0, 2));
            text.push_str(&format!("rotation = {{ stiffness = {stiffness} }}\n"));
            self.line(&text);
            // Slid sideways it must come back, and the springs press it on.
            let pull = self.force() / size * self.random.decade(0, 2);
            for direction in [[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8]] {
                let far = [
                    foot[0] + size * direction[0],
                    foot[1] + size * direction[1],
                    foot[2] + c - if self.random.chance(70) { 0.3 * size } else { 0.0 },
                ]
                .map(read_back);
                let spring = self.name("f");
                self.line(&format!(
                    "[spring.{spring}]\nfrom = {{ body = \"ground\", at = {} }}\nto = {{ body = \"{body}\" }}\nstiffness = {}\n",
                    list(&far),
                    number(pull)
                ));
            }
        }
        self.outputs.push(format!("{name}_point = \"joint.{name}.contact.point\""));
        self.outputs.push(format!("{name}_force = \"joint.{name}.contact.force\""));
    }

    /// A body at a place that must be met to the last digit.
    fn placed_body(&mut self, at: [f64; 3]) -> String {
        let name = self.name("b");
        let mut text = format!("[body.{name}]\nat = {}\n", precise(&at));
        if self.is_heavy && self.random.chance(50) {
            text.push_str(&format!("mass = {}\n", number(self.strength() * self.force() / 9.81)));
        }
        self.line(&text);
        self.outputs.push(format!("{name}_at = \"body.{name}.position\""));
        self.outputs.push(format!("{name}_turned = \"body.{name}.turning\""));
        self.bodies.push(BodyDraft { name: name.clone(), at, straight: true });
        name
    }
}

/// A point with all its digits.
fn precise(point: &[f64; 3]) -> String {
    let [x, y, z] = point.map(|value| format!("{value:e}"));
    format!("[{x}, {y}, {z}]")
}
