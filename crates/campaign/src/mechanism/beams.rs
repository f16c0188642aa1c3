//! Beams: sections, shapes, where they begin and end.

use super::{BodyDraft, Draft, list};
use crate::random::number;

impl Draft {
    /// A beam from what is there to a free end or to a new body.
    pub(super) fn chain(&mut self) {
        let start = self.mount(true);
        let to_body = self.random.chance(60);
        if !to_body {
            self.beam(&start, None);
            return;
        }
        let body = self.new_body();
        // A new body is held in every direction: what the hold leaves free has a spring.
        let hold = if self.random.chance(70) { "hold = \"clamp\"".to_owned() } else { self.hold(true) };
        self.beam(&start, Some(&format!("{{ body = \"{body}\", {hold} }}")));
    }

    /// A beam between two things that are there.
    pub(super) fn loop_beam(&mut self) {
        if self.bodies.is_empty() {
            return self.chain();
        }
        let start = self.mount(true);
        let end = self.random.below(self.bodies.len());
        let body = self.bodies[end].name.clone();
        let hold = if self.random.chance(50) { "hold = \"clamp\"".to_owned() } else { self.hold(false) };
        self.beam(&start, Some(&format!("{{ body = \"{body}\", {hold} }}")));
    }

    /// Two bodies on parallel beams: a stage.
    pub(super) fn frame(&mut self) {
        // The starts come first: a beam from the new body to itself would hold nothing.
        let starts: Vec<String> = (0..2 + self.random.below(2)).map(|_| self.mount(true)).collect();
        let body = self.new_body();
        for start in starts {
            self.beam(&start, Some(&format!("{{ body = \"{body}\", hold = \"clamp\" }}")));
        }
    }

    /// A body somewhere about the mechanism, not held by anything yet.
    pub(super) fn new_body(&mut self) -> String {
        let name = self.name("b");
        let reach = self.size;
        let at = self.point([0.0; 3], reach);
        let mut text = format!("[body.{name}]\nat = {}\n", list(&at));
        let straight = self.random.chance(75);
        if !straight {
            text.push_str(&format!("rotation = {}\n", self.rotation()));
        }
        if self.is_heavy && self.random.chance(60) {
            let weight = self.strength() * self.force();
            text.push_str(&format!("mass = {}\n", number(weight / 9.81)));
            if self.random.chance(40) {
                let center = self.vector(0.2 * self.size, "");
                text.push_str(&format!("center_of_mass = {center}\n"));
            }
        }
        self.line(&text);
        self.outputs.push(format!("{name}_at = \"body.{name}.position\""));
        self.outputs.push(format!("{name}_turned = \"body.{name}.turning\""));
        self.bodies.push(BodyDraft { name: name.clone(), at, straight });
        name
    }

    /// Where a beam may begin: `body = ...` or `beam = ...` with a place, clamped or on springs.
    pub(super) fn mount(&mut self, may_be_beam: bool) -> String {
        let hold = if self.random.chance(85) { "hold = \"clamp\"".to_owned() } else { self.hold(true) };
        if may_be_beam && !self.beams.is_empty() && self.random.chance(20) {
            let beam = self.beams[self.random.below(self.beams.len())].clone();
            let at = self.random.pick(&["0.25", "0.5", "0.6", "0.8", "1"]);
            return format!("{{ beam = \"{beam}\", at = {at}, rotation = {}, {hold} }}", self.rotation());
        }
        let (body, place) = self.carrier();
        format!("{{ body = \"{body}\", at = {place}, rotation = {}, {hold} }}", self.rotation())
    }

    /// A body or the ground, and a point on it.
    pub(super) fn carrier(&mut self) -> (String, String) {
        let count = self.bodies.len();
        if count > 0 && self.random.chance(60) {
            let body = self.random.below(count);
            let place = self.vector(0.3 * self.size, "");
            (self.bodies[body].name.clone(), place)
        } else {
            ("ground".to_owned(), self.vector(self.size, ""))
        }
    }

    fn beam(&mut self, start: &str, end: Option<&str>) {
        let name = self.name("k");
        let length = self.size * self.random.between(0.3, 1.5);
        let shears = self.random.chance(12);
        let section = self.section(length, shears);
        let shape = self.shape(&name, length);
        let mut text = format!("[beam.{name}]\nmaterial = \"m\"\nsection = \"{section}\"\nstart = {start}\n");
        if let Some(end) = end {
            text.push_str(&format!("end = {end}\n"));
        }
        if shears {
            text.push_str("shear = true\n");
        }
        if self.random.chance(8) {
            text.push_str("extension = false\n");
        }
        if self.random.chance(15) {
            let bed = self.foundation(length);
            text.push_str(&format!("foundation = {bed}\n"));
        }
        if self.random.chance(25) {
            let load = self.distributed(length);
            text.push_str(&format!("distributed = {load}\n"));
        }
        text.push_str(&shape);
        self.line(&text);
        self.outputs.push(format!("{name}_tip = \"beam.{name}.end.position\""));
        self.outputs.push(format!("{name}_root = \"beam.{name}.start.moment\""));
        self.beams.push(name);
    }

    /// The keys of a beam's stress-free shape; a table of its own comes last.
    fn shape(&mut self, beam: &str, length: f64) -> String {
        let head = format!("\n[beam.{beam}.curve]\n");
        let l = number(length);
        match self.random.below(12) {
            0..=4 => format!("length = {l}\n"),
            5 => {
                let angle = self.random.between(0.1, 5.0);
                format!(
                    "{head}kind = \"arc\"\nradius = {}\nangle = {}\n",
                    number(length / angle),
                    number(angle)
                )
            }
            6 => {
                let turns = self.random.between(0.3, 3.0);
                let radius = length / (7.0 * turns);
                let pitch = self.random.sign() * radius * self.random.between(0.2, 3.0);
                let (radius, pitch, turns) = (number(radius), number(pitch), number(turns));
                format!("{head}kind = \"helix\"\nradius = {radius}\npitch = {pitch}\nturns = {turns}\n")
            }
            7 => {
                let y =
                    self.random.pick(&["t^2", "t^3", "sin(3*t)", "t^2.5", "(1 - cos(2*pi*t))/8", "t^4/3"]);
                let z = self.random.pick(&["0*t", "t^3/4", "sin(2*t)/3", "0*t"]);
                let bow = number(length * self.random.between(0.02, 0.6));
                format!(
                    "{head}kind = \"parametric\"\nx = \"{l}*t\"\ny = \"{bow}*({y})\"\nz = \"{bow}*({z})\"\nrange = [0, 1]\n"
                )
            }
            8 => {
                let mut points = vec![[0.0; 3]];
                for i in 1..4 {
                    let x = length * f64::from(i) / 3.0;
                    points.push([
                        x,
                        0.2 * length * self.random.between(-1.0, 1.0),
                        0.1 * length * self.random.between(-1.0, 1.0),
                    ]);
                }
                let points: Vec<String> = points.iter().map(list).collect();
                format!("{head}kind = \"points\"\npoints = [{}]\n", points.join(", "))
            }
            _ => self.curvatures(&head, length),
        }
    }

    fn curvatures(&mut self, head: &str, length: f64) -> String {
        let l = number(length);
        let mut text = format!("{head}kind = \"curvature\"\nlength = {l}\n");
        for key in ["k1", "k2", "k3"] {
            if self.random.chance(50) {
                continue;
            }
            let k = number(self.random.between(-2.0, 2.0) / length);
            let expression = match self.random.below(7) {
                0 => k,
                1 => format!("{k}*(1 + s/{l})"),
                2 => format!("{k}*sin(6.2832*s/{l})"),
                3 => format!("{k}*cos(12.566*s/{l})/5"),
                4 => format!("{k}*sign(s - {}*{l})", self.random.pick(&["0.3", "0.5", "0.71"])),
                5 => format!("{k}*abs(s/{l} - 0.4)"),
                _ => format!("{k}*max(0, s/{l} - 0.5)"),
            };
            text.push_str(&format!("{key} = \"{expression}\"\n"));
        }
        text
    }

    /// A section for a beam of that length; its name.
    fn section(&mut self, length: f64, shears: bool) -> String {
        let name = self.name("s");
        let spread = if self.random.chance(10) { self.random.pick(&[0.2, 5.0]) } else { 1.0 };
        let h = self.thick * spread * self.random.between(0.5, 1.5);
        let w = h * self.random.between(0.4, 4.0);
        let (h, w) = (number(h), number(w));
        let l = number(length);
        let keys = match self.random.below(14) {
            0..=2 => format!("shape = \"rectangle\"\nwidth = {w}\nheight = {h}"),
            3 | 4 => format!("shape = \"circle\"\ndiameter = {h}"),
            5 => format!(
                "shape = \"tube\"\nouter_diameter = {h}\ninner_diameter = \"{h}*{}\"",
                self.random.between(0.3, 0.9)
            ),
            6 => format!("shape = \"ellipse\"\nwidth = {w}\nheight = {h}"),
            7 => {
                let slim = self.random.pick(&[0.5, 0.3, 0.8, 0.1, 0.03]);
                format!(
                    "shape = \"circle\"\nalong = [{{ at = 0, diameter = {h} }}, {{ at = 1, diameter = \"{slim}*{h}\" }}]"
                )
            }
            8 => {
                let step = self.random.pick(&[0.2, 0.5, 0.77]);
                format!(
                    "shape = \"rectangle\"\nheight = {h}\nalong = [{{ at = 0, width = {w} }}, {{ at = {step}, width = \"0.7*{w}\" \
                     }}, {{ at = 1, width = \"2*{w}\" }}]"
                )
            }
            9 => format!(
                "shape = \"rectangle\"\nwidth = \"{w}*(1 + 0.4*sin(9*s/{l}))\"\nheight = \"{h}*(1 - 0.5*s/{l})\""
            ),
            10 => {
                let t = self.random.between(0.1, 0.6);
                format!(
                    "shape = \"rectangle\"\nwidth = {w}\nheight = {{ notch = \"circular\", radius = {h}, thickness = \"{t}*{h}\", at = \
                     {} }}",
                    self.random.pick(&["0.5", "0.4"])
                )
            }
            _ => self.stiffness(shears),
        };
        self.line(&format!("[section.{name}]\n{keys}\n"));
        name
    }

    /// A section given by its stiffnesses, now and then coupled.
    fn stiffness(&mut self, shears: bool) -> String {
        let (bending, thick) = (self.bending(), self.thick);
        let axial = 12.0 * bending / (thick * thick);
        let mut about = |unit: f64| unit * self.random.between(0.4, 2.5);
        let (ea, gj, ei2, ei3) = (about(axial), about(bending), about(bending), about(bending));
        let (ga2, ga3) = (about(axial), about(axial));
        if self.random.chance(25) {
            let mut rows = vec![vec!["0".to_owned(); 6]; 6];
            for (i, value) in [ea, ga2, ga3, gj, ei2, ei3].into_iter().enumerate() {
                rows[i][i] = number(value);
            }
            // Twist and stretch, and the two bendings, are coupled as in a rope and in a section that is not symmetric.
            let wound = number(0.3 * (super::read_back(ea) * super::read_back(gj)).sqrt());
            let skew = number(0.4 * (super::read_back(ei2) * super::read_back(ei3)).sqrt());
            for (i, j, value) in [(0, 3, wound), (4, 5, skew)] {
                rows[i][j] = value.clone();
                rows[j][i] = value;
            }
            let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", row.join(", "))).collect();
            return format!("shape = \"stiffness\"\nmatrix = [{}]", rows.join(", "));
        }
        let [ea, gj, ei2, ei3, ga2, ga3] = [ea, gj, ei2, ei3, ga2, ga3].map(number);
        let shear = if shears { format!("\nGA2 = {ga2}\nGA3 = {ga3}") } else { String::new() };
        format!("shape = \"stiffness\"\nEA = {ea}\nGJ = {gj}\nEI2 = {ei2}\nEI3 = {ei3}{shear}")
    }

    fn foundation(&mut self, length: f64) -> String {
        // About EI/L⁴.
        let unit = self.bending() / (length * length * length * length);
        let k = unit * self.random.between(1.0, 200.0);
        let direction = if self.random.chance(60) {
            let axes = self.random.pick(&["global", "section"]);
            format!(", direction = {}, axes = \"{axes}\"", self.axis())
        } else {
            String::new()
        };
        let part = if self.random.chance(40) { ", from = 0.2, to = 0.7" } else { "" };
        if !direction.is_empty() && self.random.chance(30) {
            let cubic = number(k / (0.05 * length * length));
            return format!("{{ force = \"{}*u + {cubic}*u^3\"{direction}{part} }}", number(k));
        }
        let k = number(k);
        let law = self.random.pick(&["", "*(1 + s/L)"]).replace('L', &number(length));
        format!("{{ stiffness = \"{k}{law}\"{direction}{part} }}")
    }

    /// A load per length, with jumps and flanks.
    fn distributed(&mut self, length: f64) -> String {
        let unit = self.strength() * self.bending() / (length * length * length);
        let l = number(length);
        let lone = self.random.below(3);
        let mut parts = Vec::new();
        for i in 0..3 {
            let q = number(unit * self.random.between(-2.0, 2.0));
            if i != lone && self.random.chance(60) {
                parts.push("0".to_owned());
                continue;
            }
            let at = self.random.pick(&["0.33", "0.5", "0.718"]);
            let expression = match self.random.below(8) {
                0..=2 => String::new(),
                3 => format!("*sign(s - {at}*{l})"),
                4 => format!("*tanh((s/{l} - {at})/{})", self.random.pick(&["0.1", "0.01", "0.001"])),
                5 => format!("*max(0, s/{l} - {at})"),
                6 => format!("*abs(s/{l} - {at})"),
                _ => format!("*sin(7*s/{l})"),
            };
            parts.push(format!("\"factor*{q}{expression}\""));
        }
        let frame = self.random.pick(&["global", "global", "section"]);
        let key = if self.random.chance(85) { "force" } else { "moment" };
        if key == "moment" {
            parts = parts.iter().map(|part| part.replace("factor*", &format!("factor*{l}*0.3*"))).collect();
        }
        format!("{{ {key} = [{}], frame = \"{frame}\" }}", parts.join(", "))
    }
}
