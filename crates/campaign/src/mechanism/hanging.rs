//! Mechanisms that only their loads hold, and such as nothing holds.

use super::{Draft, list, read_back};
use crate::random::number;

impl Draft {
    /// Weights on springs and pendulums.
    pub(super) fn hang(&mut self) {
        self.is_heavy = true;
        match self.random.below(4) {
            0 => self.weight_on_ligaments(),
            1 => self.pendulum(),
            2 => self.springs_in_line(),
            _ => self.weight_between_springs(),
        }
        if self.random.chance(30) {
            self.chain();
        }
    }

    fn weight(&mut self, at: &[f64; 3]) -> String {
        let name = self.name("b");
        let mass = number(self.random.between(0.05, 1.0) * self.force() / 9.81);
        self.line(&format!("[body.{name}]\nat = {}\nmass = {mass}\n", list(at)));
        self.outputs.push(format!("{name}_at = \"body.{name}.position\""));
        name
    }

    fn guided(&mut self, body: &str, axis: &str) {
        let name = self.name("j");
        self.line(&format!(
            "[joint.{name}]\nkind = \"prismatic\"\nparent = \"ground\"\nchild = \"{body}\"\naxis = {axis}\n"
        ));
    }

    fn between(&mut self, from: &str, to: &str, law: &str) {
        let name = self.name("f");
        self.line(&format!("[spring.{name}]\nfrom = {from}\nto = {to}\n{law}\n"));
        self.outputs.push(format!("{name}_pull = \"spring.{name}.tension\""));
    }

    fn soft_law(&mut self) -> String {
        let force = self.force();
        match self.random.below(4) {
            0 => format!("law = \"toe\"\naxial_stiffness = {}\ntoe_strain = 0.04", number(20.0 * force)),
            1 => format!("stiffness = {}\ntension_only = true", number(5.0 * force / self.size)),
            2 => {
                let area = self.thick * self.thick;
                format!(
                    "law = \"exponential\"\narea = {}\nexponent = 8\nstress = {}",
                    number(area),
                    number(2.0 * force / area)
                )
            }
            _ => format!(
                "law = \"table\"\nrows = [[0, 0], [{}, {}], [{}, {}]]",
                number(0.05 * self.size),
                number(0.3 * force),
                number(0.2 * self.size),
                number(4.0 * force)
            ),
        }
    }

    /// A weight on a slide under a ligament.
    fn weight_on_ligaments(&mut self) {
        let drop = read_back(-self.size);
        let body = self.weight(&[0.0, 0.0, drop]);
        self.guided(&body, "[0, 0, 1]");
        for _ in 0..1 + self.random.below(2) {
            let law = self.soft_law();
            self.between("{ body = \"ground\" }", &format!("{{ body = \"{body}\" }}"), &law);
        }
    }

    /// A body on a hinge or a ball above its centre of mass, hanging or off its rest.
    fn pendulum(&mut self) {
        let drop = self.size;
        let aside = if self.random.chance(50) { 0.0 } else { 0.4 * drop };
        let at = [aside, 0.0, -drop].map(read_back);
        let body = self.weight(&at);
        let name = self.name("j");
        let kind = self.random.pick(&[
            "kind = \"revolute\"\naxis = [0, 1, 0]",
            "kind = \"spherical\"",
            "kind = \"universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]",
        ]);
        self.line(&format!("[joint.{name}]\n{kind}\nparent = \"ground\"\nchild = \"{body}\"\n"));
        if self.random.chance(50) {
            let load = self.name("l");
            let side = number(self.strength() * self.force());
            self.line(&format!("[load.{load}]\nbody = \"{body}\"\nforce = [\"factor*{side}\", 0, 0]\n"));
        }
    }

    /// Two weights under each other on springs, each free to swing.
    fn springs_in_line(&mut self) {
        let drop = self.size;
        let k = self.force() / self.size;
        let mut above = "{ body = \"ground\" }".to_owned();
        for i in 1..=2 {
            let body = self.weight(&[0.0, 0.0, read_back(-drop * f64::from(i))]);
            let name = self.name("j");
            self.line(&format!(
                "[joint.{name}]\nkind = \"planar\"\naxis = [0, 1, 0]\nparent = \"ground\"\nchild = \"{body}\"\nangle = {{ coordinate = 0 }}\n"
            ));
            let here = format!("{{ body = \"{body}\" }}");
            let law = format!("stiffness = {}", number(k * self.random.between(2.0, 20.0)));
            self.between(&above, &here, &law);
            above = here;
        }
    }

    /// A weight between two springs that are just taut.
    fn weight_between_springs(&mut self) {
        let body = self.weight(&[0.0; 3]);
        let name = self.name("j");
        self.line(&format!(
            "[joint.{name}]\nkind = \"planar\"\naxis = [0, 1, 0]\nparent = \"ground\"\nchild = \"{body}\"\nangle = {{ coordinate = 0 }}\n"
        ));
        let k = self.force() / self.size;
        let loose = self.random.pick(&[1.0, 1.0, 0.9]);
        for side in [1.0, -1.0] {
            let at = [read_back(side * self.size), 0.0, 0.0];
            let law = format!(
                "stiffness = {}\nrest_length = {}",
                number(k * self.random.between(1.0, 20.0)),
                number(loose * read_back(self.size))
            );
            let from = format!("{{ body = \"ground\", at = {} }}", list(&at));
            self.between(&from, &format!("{{ body = \"{body}\" }}"), &law);
        }
    }

    /// A body that may move without resistance beside a mechanism that is held.
    pub(super) fn leave_loose(&mut self) {
        self.is_heavy = false;
        self.chain();
        let body = self.new_body();
        match self.random.below(3) {
            0 => {}
            1 => {
                let name = self.name("j");
                let kind = self.random.pick(&["prismatic", "revolute", "cylindrical"]);
                self.line(&format!(
                    "[joint.{name}]\nkind = \"{kind}\"\nparent = \"ground\"\nchild = \"{body}\"\naxis = [0, 0, 1]\n"
                ));
            }
            _ => {
                let name = self.name("j");
                self.line(&format!(
                    "[joint.{name}]\nkind = \"spherical\"\nparent = \"ground\"\nchild = \"{body}\"\n"
                ));
            }
        }
        let load = self.name("l");
        let force = number(self.force());
        let beam = self.beams[0].clone();
        self.line(&format!("[load.{load}]\nbeam = \"{beam}\"\nat = 1\nforce = [0, \"factor*{force}\", 0]\n"));
    }
}
