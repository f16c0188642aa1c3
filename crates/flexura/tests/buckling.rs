//! Linear buckling: columns in any state and with their shapes, a round shaft, and what has no energy.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::model::BuckleStudy;
use flexura::modelfile::Document;
use flexura::solution::{Buckling, BucklingMode};
use flexura::{Options, ProblemError, buckle};
use flexura_testkit::columns::Ends;
use std::f64::consts::{PI, TAU};

fn buckled(text: &str, parameter: Option<&str>, at: f64, count: usize) -> Result<Buckling, ProblemError> {
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}\n{text}"));
    let model = document.model(&[]).unwrap_or_else(|report| panic!("{report}\n{text}"));
    let position = |name: &str| model.parameters.iter().position(|p| p.name == name).unwrap();
    let study = BuckleStudy { parameter: parameter.map(position), at, count };
    buckle(&model, &study, &Options { samples: 21, ..Options::default() })
}

/// A bundled column; its parameter `push` is in EI/L².
fn column(file: &str) -> String {
    std::fs::read_to_string(format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

const COLUMNS: [(&str, Ends); 4] = [
    ("euler_clamped_free.toml", Ends::ClampedFree),
    ("euler_pinned_pinned.toml", Ends::PinnedPinned),
    ("euler_clamped_pinned.toml", Ends::ClampedPinned),
    ("euler_clamped_clamped.toml", Ends::ClampedClamped),
];

/// The true error is below the estimate, and the estimate is small.
fn honest(mode: &BucklingMode, wanted: f64, what: &str) {
    let error = (mode.value - wanted).abs();
    assert!(error <= mode.error_estimate + 1e-12 * wanted, "{what}: {error:e} for {:e}", mode.error_estimate);
    assert!(mode.error_estimate < 1e-4 * wanted, "{what}: {:e}", mode.error_estimate);
}

#[test]
fn columns_buckle_at_eulers_loads_whatever_they_bear_already() {
    for (file, ends) in COLUMNS {
        let loads = ends.loads(3);
        // Between two loads the nearer one comes first, whichever side it lies on.
        for at in [0.0, 0.4 * loads[0], 0.9 * loads[0], 0.4 * loads[0] + 0.6 * loads[1]] {
            let found = buckled(&column(file), Some("push"), at, 2).unwrap();
            let mut nearest = loads.clone();
            nearest.sort_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            assert_eq!(found.modes.len(), 2);
            for (mode, wanted) in found.modes.iter().zip(&nearest) {
                honest(mode, *wanted, &format!("{file} at {at}"));
            }
        }
    }
}

#[test]
fn fractions_of_the_load_are_the_same_problem() {
    for (file, ends) in COLUMNS {
        let text = column(file);
        let push = Document::parse(&text, file).unwrap().model(&[]).unwrap();
        let push = push.parameters.iter().find(|p| p.name == "push").unwrap().value;
        for at in [0.0, 0.3] {
            let found = buckled(&text, None, at, 1).unwrap();
            honest(&found.modes[0], ends.loads(1)[0] / push, file);
        }
    }
}

/// Displacements across along the column, at its samples.
fn across(mode: &BucklingMode) -> Vec<f64> {
    mode.direction.beams[0].iter().map(|twist| twist.linear.z).collect()
}

#[test]
fn shapes_are_those_of_the_textbooks() {
    type Shape = fn(f64) -> f64;
    let shapes: [(&str, Shape); 3] = [
        ("euler_clamped_free.toml", |t| 1.0 - (0.5 * PI * t).cos()),
        ("euler_pinned_pinned.toml", |t| (PI * t).sin()),
        ("euler_clamped_clamped.toml", |t| 0.5 * (1.0 - (TAU * t).cos())),
    ];
    for (file, shape) in shapes {
        let found = buckled(&column(file), Some("push"), 0.0, 1).unwrap();
        let z = across(&found.modes[0]);
        let sign = z.iter().sum::<f64>().signum();
        let last = (z.len() - 1) as f64;
        let kept: Vec<f64> =
            found.solution.beams[0].samples.iter().map(|s| s.s / found.solution.beams[0].length).collect();
        assert_eq!(kept.len() as f64, last + 1.0);
        let error = z.iter().zip(&kept).map(|(z, t)| (sign * z - shape(*t)).abs()).fold(0.0, f64::max);
        assert!(error < 1e-5, "{file}: {error:e}, {z:?}");
    }
}

/// A round column between the same pins has every load twice, with two shapes at right angles.
#[test]
fn a_round_column_has_every_load_twice() {
    let text = r#"
format = 1
[parameter]
push = 1
[section.rod]
shape = "stiffness"
EA = "inf"
GJ = 0.8
EI2 = 1
EI3 = 1
[body.head]
at = [1, 0, 0]
[joint.way]
kind = "prismatic"
axis = [1, 0, 0]
effort = "-push*1 N"
parent = { body = "ground", at = [1, 0, 0] }
child = "head"
[beam.column]
section = "rod"
length = 1
extension = false
start = { body = "ground", hold = "universal", axis = [0, 1, 0], second_axis = [0, 0, 1] }
end = { body = "head", hold = "universal", axis = [0, 1, 0], second_axis = [0, 0, 1] }
"#;
    let found = buckled(text, Some("push"), 2.0, 4).unwrap();
    let loads = Ends::PinnedPinned.loads(2);
    for (mode, wanted) in found.modes.iter().zip([loads[0], loads[0], loads[1], loads[1]]) {
        honest(mode, wanted, "round");
    }
    let middle = |k: usize| found.modes[k].direction.beams[0][10].linear;
    let area = middle(0).cross(&middle(1)).norm();
    assert!(area > 0.1, "two shapes: {:?} {:?}", middle(0), middle(1));
}

/// Swaying portal, clamped feet, a rigid beam on top: both columns as clamped-guided, P = π² EI/L² each.
#[test]
fn a_portal_sways_when_each_column_bears_its_own_load() {
    let column = |name: &str, x: f64| {
        format!(
            "[beam.{name}]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", hold = \"clamp\", at = [{x}, 0, 0], rotation = {{ axis = [0, 1, 0], angle = \"-90 deg\" }} }}\nend = {{ body = \"top\", hold = \"clamp\", at = [{x}, 0, 0], rotation = {{ axis = [0, 1, 0], angle = \"-90 deg\" }} }}\n"
        )
    };
    let text = format!(
        "format = 1\n[parameter]\npush = 1\n[section.rod]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = 1\nEI2 = 1\nEI3 = 50\n[body.top]\nat = [0, 0, 1]\n[load.push]\nbody = \"top\"\nat = [0.4, 0, 0]\nforce = [0, 0, \"-push*1 N\"]\n{}{}",
        column("left", 0.0),
        column("right", 0.8)
    );
    for at in [0.0, 9.0] {
        let found = buckled(&text, Some("push"), at, 1).unwrap();
        honest(&found.modes[0], 2.0 * PI * PI, "portal");
    }
}

#[test]
fn what_has_no_energy_is_refused() {
    let text = "format = 1\n[parameter]\npush = 1\n[section.rod]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = 1\nEI2 = 1\nEI3 = 2\n[beam.arm]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = { body = \"ground\", hold = \"clamp\" }\n[load.tip]\nbeam = \"arm\"\nat = 1\nLOAD\n";
    for load in ["force = [\"-push*1 N\", 0, 0]\nframe = \"local\"", "moment = [\"push*1 N*m\", 0, 0]"] {
        for at in [0.3, 0.0] {
            let error = buckled(&text.replace("LOAD", load), Some("push"), at, 1).unwrap_err();
            let why = error.message;
            assert!(why.contains("has no energy") && why.contains("load.tip"), "{load}, at {at}: {why}");
        }
    }
}

/// A cantilever column with bending stiffnesses EI and 2 EI; `along` is the force at its head per unit of `push`.
fn two_stiffnesses(along: &str) -> String {
    format!(
        "format = 1\n[parameter]\npush = 0\n[section.s]\nshape = \"stiffness\"\nEA = 1e6\nGJ = 1\nEI2 = 2\nEI3 = 1\n\
         [beam.column]\nsection = \"s\"\nlength = 1\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n\
         [load.head]\nbeam = \"column\"\nat = 1\nforce = [\"{along}\", 0, 0]\n"
    )
}

/// (2n - 1)² π²/4 EI/L² and its double. The column is shortened by P/EA, 10⁻⁶ P, which the tolerance allows for at the value and at the
/// state about which it is linearised.
#[test]
fn critical_values_come_nearest_first_from_either_side() {
    let all = [1.0, 2.0, 9.0, 18.0, 25.0, 49.0, 50.0, 98.0].map(|factor| factor * PI * PI / 4.0);
    for (along, sign) in [("-push", 1.0), ("push", -1.0)] {
        for at in [0.0, 2.4, 2.5, 4.9, 20.0, 30.0] {
            let found = buckled(&two_stiffnesses(along), Some("push"), sign * at, 4).unwrap();
            let mut wanted = all;
            wanted.sort_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            assert_eq!(found.modes.len(), 4, "{along} at {at}: {:?}", found.solution.warnings);
            for (mode, wanted) in found.modes.iter().zip(&wanted) {
                let error = (sign * mode.value - wanted).abs();
                let shortened = 1e-6 * (wanted * wanted + at * at);
                assert!(error < 1e-5 * wanted + shortened, "{along} at {at}: {}", mode.value);
            }
        }
    }
}

/// π² EI/(4 L²) = 479,772 N, in both planes.
#[test]
fn critical_values_do_not_depend_on_the_size_of_the_load_that_is_named() {
    let text = |load: f64| {
        format!(
            "format = 1\n[parameter]\npush = {load}\n[section.s]\nshape = \"stiffness\"\nEA = 2.1e9\nGJ = 1.15e6\nEI2 = 1.75e6\nEI3 = 1.75e6\n\
             [beam.column]\nsection = \"s\"\nlength = 3\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n\
             [load.head]\nbeam = \"column\"\nat = 1\nforce = [\"-push\", 0, 0]\n"
        )
    };
    let critical = PI * PI * 1.75e6 / 36.0;
    for load in [1e-9, 1e-3, 1.0, 1e3, 4e5] {
        for (parameter, wanted) in [(None, critical / load), (Some("push"), critical)] {
            let found = buckled(&text(load), parameter, 0.0, 2).unwrap();
            assert_eq!(found.modes.len(), 2, "{load} {parameter:?}: {:?}", found.solution.warnings);
            for mode in &found.modes {
                // The column is shortened by P/EA = 2.3e-4.
                assert!((mode.value / wanted - 1.0).abs() < 5e-4, "{load} {parameter:?}: {}", mode.value);
            }
        }
    }
}

/// Lateral buckling by an end force, 4.0126 √(EI GJ)/L² (S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed., 1961, art.
/// 6.3), takes the strip as unbent. A round wire bends as easily in either plane, and never turns over.
#[test]
fn a_value_that_the_bent_path_does_not_bear_out_is_called_linearised() {
    let wire = column("../crates/flexura/tests/models/round_wire_pulled_sideways.toml");
    let found = buckled(&wire, Some("pull"), 0.0, 1).unwrap();
    let bending = 200e9 * PI / 64.0 * 1e-12;
    let torsion = 2.0 * bending / 2.6;
    let wanted = 4.0126 * (bending * torsion).sqrt() / 0.04;
    assert!((found.modes[0].value - wanted).abs() < 1e-4 * wanted, "{}", found.modes[0].value);
    let said = found.solution.warnings.join("\n");
    assert!(said.contains("linearised") && said.contains("0 unstable directions there and 0"), "{said}");
    // A column that stays straight until it buckles needs no such word.
    let found = buckled(&column("euler_clamped_free.toml"), Some("push"), 0.0, 1).unwrap();
    assert!(found.solution.warnings.is_empty(), "{:?}", found.solution.warnings);
}
