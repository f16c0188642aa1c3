//! The number of unstable directions does not depend on how a mechanism is described.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::spatial::{UnitQuaternion, Vector3, exp};
use flexura::{Options, solve};

type V = Vector3<f64>;

/// A table of two unlike columns under a plate that is pushed down, a little off its middle.
#[derive(Clone)]
struct Table {
    /// Turned and shifted as a whole.
    rotation: UnitQuaternion<f64>,
    shift: V,
    /// Units of length and force.
    units: [f64; 2],
    /// How each column is made.
    columns: [Column; 2],
    /// Tables of the file in the reverse order.
    backwards: bool,
    further: String,
}

#[derive(Clone, Copy, PartialEq)]
enum Column {
    Whole,
    /// From the plate to the ground.
    Reversed,
    /// Two beams, one held by the other's end.
    Spliced,
    /// Two beams that a body without mass joins.
    Joined,
}

fn table() -> Table {
    Table {
        rotation: UnitQuaternion::identity(),
        shift: V::zeros(),
        units: [1.0, 1.0],
        columns: [Column::Whole; 2],
        backwards: false,
        further: String::new(),
    }
}

impl Table {
    fn place(&self, p: V) -> String {
        let p = (self.rotation * p + self.shift) * self.units[0];
        format!("[{:?}, {:?}, {:?}]", p.x, p.y, p.z)
    }

    fn turn(&self, local: UnitQuaternion<f64>) -> String {
        let q = self.rotation * local;
        format!("{{ quat_wxyz = [{:?}, {:?}, {:?}, {:?}] }}", q.w, q.i, q.j, q.k)
    }

    fn text(&self, (at, push): (f64, f64)) -> String {
        let [length, force] = self.units;
        let up = exp(&V::new(0.0, -std::f64::consts::FRAC_PI_2, 0.0));
        let down = up * exp(&V::new(0.0, 0.0, std::f64::consts::PI));
        let mut tables = Vec::new();
        for (i, (x, ei, height)) in [(0.0, [1.0, 2.1], 1.0), (0.8, [1.6, 0.9], 1.0)].iter().enumerate() {
            let bend = force * length * length;
            tables.push(format!(
                "[section.rod_{i}]\nshape = \"stiffness\"\nEA = {:?}\nGJ = {:?}\nEI2 = {:?}\nEI3 = {:?}\n",
                900.0 * force,
                0.6 * bend,
                ei[0] * bend,
                ei[1] * bend
            ));
            let foot = V::new(*x, 0.0, 0.0);
            let ground = |turn| {
                format!(
                    "{{ body = \"ground\", hold = \"clamp\", at = {}, rotation = {} }}",
                    self.place(foot),
                    self.turn(turn)
                )
            };
            // The plate's own axes are turned with everything, its origin over the first column.
            let on_plate = |turn: UnitQuaternion<f64>| {
                format!(
                    "{{ body = \"plate\", hold = \"clamp\", at = [{:?}, 0, 0], rotation = {{ quat_wxyz = [{:?}, {:?}, {:?}, {:?}] }} }}",
                    x * length,
                    turn.w,
                    turn.i,
                    turn.j,
                    turn.k
                )
            };
            let beam = |name: &str, part: f64, start: &str, end: &str| {
                format!(
                    "[beam.{name}]\nsection = \"rod_{i}\"\nlength = {:?}\nstart = {start}\n{}\n",
                    part * height * length,
                    if end.is_empty() { String::new() } else { format!("end = {end}") }
                )
            };
            match self.columns[i] {
                Column::Whole => tables.push(beam(&format!("column_{i}"), 1.0, &ground(up), &on_plate(up))),
                Column::Reversed => {
                    tables.push(beam(&format!("column_{i}"), 1.0, &on_plate(down), &ground(down)));
                }
                Column::Spliced => {
                    tables.push(beam(&format!("column_{i}"), 0.37, &ground(up), ""));
                    let on = format!("{{ beam = \"column_{i}\", at = 1.0, hold = \"clamp\" }}");
                    tables.push(beam(&format!("rest_{i}"), 0.63, &on, &on_plate(up)));
                }
                Column::Joined => {
                    let body = format!("{{ body = \"link_{i}\", hold = \"clamp\" }}");
                    tables.push(format!(
                        "[body.link_{i}]\nat = {}\nrotation = {}\n",
                        self.place(foot + V::new(0.0, 0.0, 0.6)),
                        self.turn(up)
                    ));
                    tables.push(beam(&format!("column_{i}"), 0.6, &ground(up), &body));
                    tables.push(beam(&format!("rest_{i}"), 0.4, &body, &on_plate(up)));
                }
            }
        }
        let plate = self.place(V::new(0.0, 0.0, 1.0));
        tables.push(format!(
            "[body.plate]\nat = {plate}\nrotation = {}\n",
            self.turn(UnitQuaternion::identity())
        ));
        let pull = self.rotation * V::new(0.0, 0.0, -push) * force;
        tables.push(format!(
            "[load.push]\nbody = \"plate\"\nat = [{:?}, 0, 0]\nforce = [{:?}, {:?}, {:?}]\n",
            at * length,
            pull.x,
            pull.y,
            pull.z
        ));
        tables.push(self.further.clone());
        if self.backwards {
            tables.reverse();
        }
        format!("format = 1\n{}", tables.join(""))
    }

    /// Number of unstable directions and strain energy in the units of the file.
    fn solve(&self, push: (f64, f64)) -> (usize, f64) {
        let text = self.text(push);
        let model = match Document::parse(&text, "table.toml").and_then(|document| document.model(&[])) {
            Ok(model) => model,
            Err(report) => panic!("{report}\n{text}"),
        };
        let options = Options { samples: 3, tolerance: 1e-9, ..Options::default() };
        let solution = solve(&model, &options, &mut |_| {}).unwrap();
        assert_eq!(solution.status, Status::Converged, "{push:?}: {:?}", solution.reason);
        let count = solution.unstable_directions.unwrap_or_else(|| panic!("{:?}", solution.stability_reason));
        (count, solution.energy / (self.units[0] * self.units[1]))
    }
}

/// Where the plate is pushed, and how: in the middle the columns stay straight, whatever the push.
const PUSHES: [(f64, f64); 8] = [
    (0.3, -60.0),
    (0.3, 10.0),
    (0.3, 24.0),
    (0.4, 15.0),
    (0.4, 40.0),
    (0.4, 70.0),
    (0.4, 120.0),
    (0.4, 250.0),
];

/// The same counts, and the same equilibrium as the energy tells.
fn agrees(table: &Table, what: &str) {
    let base = self::table();
    let mut seen = Vec::new();
    for push in PUSHES {
        let (wanted, energy) = base.solve(push);
        let (found, other) = table.solve(push);
        assert!(
            (energy - other).abs() <= 1e-6 * energy.abs().max(1e-3),
            "{what}, {push:?}: {energy} and {other}"
        );
        assert_eq!(found, wanted, "{what}, {push:?}");
        seen.push(wanted);
    }
    assert!(seen[0] == 0 && *seen.iter().max().unwrap() > 1, "{seen:?}");
}

#[test]
fn a_mechanism_turned_and_shifted_as_a_whole_is_as_stable() {
    let rotation = exp(&V::new(0.7, -1.9, 2.2));
    agrees(&Table { rotation, shift: V::new(3.0, -1.0, 5.0), ..table() }, "moved");
}

#[test]
fn other_units_change_nothing() {
    for units in [[1e-3, 1.0], [40.0, 1e-4], [2e-3, 5e3]] {
        agrees(&Table { units, ..table() }, "units");
    }
}

#[test]
fn the_order_of_the_file_changes_nothing() {
    agrees(&Table { backwards: true, ..table() }, "backwards");
}

#[test]
fn beams_may_be_spliced_joined_or_reversed() {
    use Column::{Joined, Reversed, Spliced, Whole};
    for columns in
        [[Reversed, Whole], [Reversed, Reversed], [Spliced, Whole], [Joined, Spliced], [Whole, Joined]]
    {
        agrees(&Table { columns, ..table() }, "columns");
    }
}

#[test]
fn springs_without_stiffness_on_beams_change_nothing() {
    let mut further = String::new();
    for (i, at) in [0.2, 0.5, 0.85].iter().enumerate() {
        for column in 0..2 {
            further += &format!(
                "[spring.none_{i}_{column}]\nstiffness = 1e-9\nfrom = {{ body = \"ground\", at = [5, 0, 5] }}\nto = {{ beam = \"column_{column}\", at = {at} }}\n"
            );
        }
    }
    agrees(&Table { further, ..table() }, "springs");
}
