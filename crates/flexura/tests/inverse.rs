//! Known and unknown exchanged, and how outputs depend on parameters.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{Model, Output, Probe, Target, Unknown};
use flexura::modelfile::Document;
use flexura::post::OutputValue;
use flexura::solution::Status;
use flexura::{Options, solve_model};

const MECHANISM: &str = r#"
format = 1
gravity = [0, 0, -9.81]
[parameter]
force = "0.3 N"
length = "150 mm"
thickness = "0.3 mm"
young = "200 GPa"
angle = "20 deg"
lead = "5 mm"
[material.steel]
young = "young"
poisson = 0.3
density = "7800 kg/m^3"
[section.strip]
shape = "rectangle"
width = "10 mm"
height = "thickness"
[body.stage]
at = ["length", 0, 0]
mass = "10 g"
[beam.leaf]
material = "steel"
section = "strip"
length = "length"
start = { body = "ground", hold = "revolute", axis = [0, 1, 0], coordinate = "angle" }
end = { body = "stage", hold = "clamp" }
[spring.coil]
from = { body = "ground", at = ["100 mm", 0, "200 mm"] }
to = { body = "stage", at = ["lead", 0, 0] }
stiffness = "12 N/m"
rest_length = "150 mm"
[load.push]
body = "stage"
force = ["force", "0.1*force", 0]
[output]
tip = "body.stage.position"
strain = "beam.leaf.start.strain"
energy = "model.energy"
tension = "spring.coil.tension"
mid = "beam.leaf[0.4].moment.y"
"#;

fn values(model: &Model, solution: &flexura::solution::Solution) -> Vec<f64> {
    let evaluation = flexura::post::evaluate(model, solution).unwrap();
    let flat = |value| match value {
        OutputValue::Number(v) => vec![v],
        OutputValue::Vector(v) => v.to_vec(),
    };
    evaluation.outputs.iter().flat_map(|o| flat(o.value)).collect()
}

fn options(sensitivities: bool) -> Options {
    Options { tolerance: 1e-12, samples: 3, sensitivities, ..Options::default() }
}

/// Every output by every parameter against sixth-order differences of whole solves.
#[test]
fn sensitivities_are_the_derivatives_of_whole_solves() {
    let document = Document::parse(MECHANISM, "mechanism.toml").unwrap();
    let solve = |overrides: &[(String, String)], sensitivities| {
        let model = document.model(overrides).unwrap();
        solve_model(&model, &options(sensitivities), &mut |_| {}).unwrap()
    };
    let (solution, model) = solve(&[], true);
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let base = values(&model, &solution);
    let found = solution.sensitivities.unwrap();
    let whole = |by: &Vec<Option<f64>>| by.iter().copied().collect::<Option<Vec<f64>>>().unwrap();
    let flat: Vec<Vec<f64>> = found.outputs.iter().flatten().map(whole).collect();
    for (p, parameter) in model.parameters.iter().enumerate() {
        let h = 2e-3 * parameter.value;
        let at = |factor: f64| {
            let text = format!("{:e} {}", parameter.value + factor * h, parameter.unit);
            let (solution, model) = solve(&[(parameter.name.clone(), text)], false);
            values(&model, &solution)
        };
        let s = [1.0, -1.0, 2.0, -2.0, 3.0, -3.0].map(at);
        for i in 0..base.len() {
            let difference =
                (45.0 * (s[0][i] - s[1][i]) - 9.0 * (s[2][i] - s[3][i]) + (s[4][i] - s[5][i])) / (60.0 * h);
            let error = (flat[i][p] - difference) * parameter.value;
            let size = (difference * parameter.value).abs().max(0.1 * base[i].abs());
            assert!(
                error.abs() <= 1e-8 * size.max(1e-6),
                "output {i} by {}: {} against {difference}",
                parameter.name,
                flat[i][p]
            );
        }
    }
}

fn target(model: &Model, output: usize, component: usize, value: f64) -> Target {
    let source = &model.outputs[output];
    let formula = source.formulas[component].clone();
    Target {
        output: Output {
            name: format!("{}.{component}", source.name),
            unit: source.unit.clone(),
            formulas: vec![formula],
            probes: source.probes.iter().map(|probe| Probe { ..*probe }).collect(),
        },
        value,
    }
}

/// Outputs of a forward solve become targets, three of its parameters unknown: they come back.
#[test]
fn what_was_given_comes_back_when_it_is_asked_for() {
    let document = Document::parse(MECHANISM, "mechanism.toml").unwrap();
    let model = document.model(&[]).unwrap();
    let (solution, _) = solve_model(&model, &options(false), &mut |_| {}).unwrap();
    let wanted = values(&model, &solution);
    let names = ["force", "length", "angle"];
    let position = |name: &str| model.parameters.iter().position(|p| p.name == name).unwrap();
    let exchange = |mut other: Model| {
        other.unknowns = names.map(|n| Unknown { parameter: position(n), range: None }).to_vec();
        other.targets = vec![
            target(&model, 0, 0, wanted[0]),
            target(&model, 0, 2, wanted[2]),
            target(&model, 3, 0, wanted[5]),
        ];
        other
    };
    let guess =
        [("force", "0.1 N"), ("length", "140 mm"), ("angle", "10 deg")].map(|(n, v)| (n.into(), v.into()));
    let guessed = exchange(document.model(&guess).unwrap());
    let (solution, found) = solve_model(&guessed, &options(false), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    for name in names {
        let (value, truth) = (found.parameters[position(name)].value, model.parameters[position(name)].value);
        assert!((value - truth).abs() < 1e-8 * truth, "{name}: {value} for {truth}");
    }
}
