//! Maxwell-Betti: what one load does at the place of another, the other does at the place of the one; and the compliance
//! is the derivative of whole solves.
//!
//! The matrix is symmetric where the loads have a potential: dead forces do, whatever the deflection. A dead moment on a
//! part that turns freely in space has none (its work depends on the order of turns), nor has a follower; the
//! tangent's antisymmetric part is then half the moment's cross matrix, or worse.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::post::OutputValue;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};

const HEAD: &str = r#"
format = 1
[material.steel]
young = "200 GPa"
poisson = 0.3
[section.wire]
shape = "rectangle"
width = "1 mm"
height = "1.5 mm"
[body.stage]
at = ["100 mm", 0, 0]
[beam.curved]
material = "steel"
section = "wire"
curve = { kind = "arc", radius = "80 mm", angle = "60 deg" }
start = { body = "ground", hold = "clamp", at = [0, "20 mm", 0] }
end = { body = "stage", hold = "clamp" }
[output]
place = "body.stage.position"
"#;

const SECOND_LEG: &str = r#"
[beam.leg]
material = "steel"
section = "wire"
length = "120 mm"
start = { body = "ground", hold = "clamp", at = ["20 mm", "-30 mm", "40 mm"], rotation = { axis = [0, 1, 1], angle = "25 deg" } }
end = { body = "stage", hold = "pin" }
"#;

const SPRING: &str = r#"
[spring.coil]
from = { body = "ground", at = [0, 0, "150 mm"] }
to = { body = "stage", at = ["10 mm", "5 mm", 0] }
stiffness = "300 N/m"
rest_length = "120 mm"
"#;

fn load(force: [f64; 3], moment: [f64; 3], frame: &str) -> String {
    format!("[load.a]\nbody = \"stage\"\nforce = {force:?}\nmoment = {moment:?}\nframe = \"{frame}\"\n")
}

fn solved(model: &Model) -> Solution {
    let options = Options { tolerance: 1e-12, samples: 3, ..Options::default() };
    let solution = solve(model, &options, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    solution
}

/// The compliance of the stage with angles times L, scaled to a largest entry of one.
fn compliance(text: &str) -> Vec<Vec<f64>> {
    let (rows, columns) = (["x", "y", "z", "rx", "ry", "rz"], ["fx", "fy", "fz", "mx", "my", "mz"]);
    let mut text = text.to_string();
    let mut outputs = String::new();
    for row in rows {
        for column in columns {
            outputs += &format!("{row}_{column} = \"body.stage.compliance.{row}.{column}\"\n");
        }
    }
    text = text.replace("[output]\n", &format!("[output]\n{outputs}"));
    let model = Document::parse(&text, "model.toml").unwrap().model(&[]).unwrap();
    let evaluation = flexura::post::evaluate(&model, &solved(&model)).unwrap();
    let value = |name: String| {
        let output = evaluation.outputs.iter().find(|o| o.name == name).unwrap();
        let OutputValue::Number(value) = output.value else { panic!("{name} is a vector") };
        value
    };
    let size = |i: usize| if i < 3 { 1.0 } else { 0.1 };
    let matrix = |i: usize, j: usize| value(format!("{}_{}", rows[i], columns[j])) * size(i) * size(j);
    let full: Vec<Vec<f64>> = (0..6).map(|i| (0..6).map(|j| matrix(i, j)).collect()).collect();
    let largest = full.iter().flatten().fold(0.0f64, |a, b| a.max(b.abs()));
    full.into_iter().map(|row| row.into_iter().map(|c| c / largest).collect()).collect()
}

fn asymmetry(matrix: &[Vec<f64>]) -> f64 {
    let pairs = (0..6).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| (matrix[i][j] - matrix[j][i]).abs()).fold(0.0, f64::max)
}

#[test]
fn compliances_under_dead_forces_are_symmetric() {
    for parts in ["", SECOND_LEG, SPRING] {
        for force in [[0.0, 0.0, 0.0], [2.0, -1.0, 3.0], [-1.0, 4.0, -2.0]] {
            let text = format!("{HEAD}{parts}{}", load(force, [0.0; 3], "global"));
            let found = asymmetry(&compliance(&text));
            assert!(found < 1e-8, "{found:.1e} at {force:?} with {parts}");
        }
    }
}

#[test]
fn a_dead_moment_and_a_follower_have_no_potential() {
    let moment = format!("{HEAD}{}", load([0.0; 3], [0.1, 0.05, 0.1], "global"));
    assert!(asymmetry(&compliance(&moment)) > 1e-3);
    let follower = format!("{HEAD}{}", load([2.0, -1.0, 3.0], [0.0; 3], "local"));
    assert!(asymmetry(&compliance(&follower)) > 1e-3);
}

/// Translations by forces, against sixth-order differences of whole solves.
#[test]
fn the_compliance_is_the_derivative_of_whole_solves() {
    let force = [2.0, -1.0, 3.0];
    let text = |force| format!("{HEAD}{SECOND_LEG}{SPRING}{}", load(force, [0.0; 3], "global"));
    let matrix = compliance(&text(force));
    let place = |force: [f64; 3]| {
        let model = Document::parse(&text(force), "model.toml").unwrap().model(&[]).unwrap();
        solved(&model).bodies[0].position
    };
    // The matrix is scaled: compare columns by their ratio to the largest entry of the differences' own matrix.
    let h = 0.02;
    let mut differences = [[0.0; 3]; 3];
    for j in 0..3 {
        let at = |steps: f64| {
            let mut force = force;
            force[j] += steps * h;
            place(force)
        };
        for i in 0..3 {
            let d = |k: f64| at(k)[i] - at(-k)[i];
            differences[i][j] = (45.0 * d(1.0) - 9.0 * d(2.0) + d(3.0)) / (60.0 * h);
        }
    }
    let scale = differences[0][0] / matrix[0][0];
    for i in 0..3 {
        for j in 0..3 {
            let error = (differences[i][j] / scale - matrix[i][j]).abs();
            assert!(error < 1e-8, "({i}, {j}): off by {error:.1e}");
        }
    }
}
