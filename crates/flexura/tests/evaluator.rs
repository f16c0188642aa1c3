//! A mechanism as a function of its parameters: values and derivatives against closed forms and against solves from rest.

#![allow(clippy::unwrap_used)]

use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Evaluator, Options, solve};

/// A cantilever that bends into a circle: EI κ = moment.
const CIRCLE: &str = r#"
format = 1
[parameter]
reach = "0.5 m"
moment = "1.2 N*m"
stiffness = "2 N*m^2"
[section.rod]
shape = "stiffness"
EA = inf
GJ = "1 N*m^2"
EI2 = "3 N*m^2"
EI3 = "stiffness"
[beam.rod]
section = "rod"
length = "reach"
start = { body = "ground", hold = "clamp" }
extension = false
shear = false
[load.tip]
beam = "rod"
at = 1
moment = [0, 0, "moment"]
[output]
angle = "beam.rod.end.rotation.z"
y = "beam.rod.end.position.y"
"#;

#[test]
fn values_and_derivatives_are_those_of_a_circle() {
    let model = Document::parse(CIRCLE, "circle.toml").unwrap().model(&[]).unwrap();
    let mut evaluator = Evaluator::new(&model, &[0, 1, 2], 1e-11).unwrap();
    for (l, m, b) in [(0.5, 1.2, 2.0), (0.52, 1.3, 2.0), (0.6, 6.0, 2.5), (0.6, -1.0, 2.5)] {
        let found = evaluator.at(&[(0, l), (1, m), (2, b)], true).unwrap();
        assert_eq!(found.status, Status::Converged);
        let angle = m * l / b;
        let y = b / m * (1.0 - angle.cos());
        // y = f(m/b, l): its derivatives by the curvature and the length.
        let k = m / b;
        let (by_k, by_l) = (-(1.0 - angle.cos()) / (k * k) + l * angle.sin() / k, angle.sin());
        let wanted = [(angle, [m / b, l / b, -m * l / (b * b)]), (y, [by_l, by_k / b, -by_k * m / (b * b)])];
        for (row, (value, slopes)) in wanted.iter().enumerate() {
            let own = found.values[row].unwrap();
            assert!((own - value).abs() < 1e-9 * (1.0 + value.abs()), "{own} {value}");
            for (own, slope) in found.slopes[row].iter().zip(slopes) {
                let own = own.unwrap();
                assert!((own - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{own} {slope}");
            }
        }
    }
}

#[test]
fn a_warm_answer_is_that_from_rest_and_what_is_unknown_follows() {
    let text = "format = 1\n[unknown.moment]\nguess = \"1 N*m\"\n[target]\n\"beam.rod.end.rotation.z\" = \"angle\"\n";
    let circle = CIRCLE.replace("format = 1\n", text).replace("moment = \"1.2 N*m\"\n", "angle = 0.3\n");
    let circle = circle.replace("[output]\n", "[output]\nfound = \"beam.rod.start.moment.z\"\n");
    let circle = circle.replace("\nangle = \"beam.rod.end.rotation.z\"", "");
    let model = Document::parse(&circle, "inverse.toml").unwrap().model(&[]).unwrap();
    let place = |name: &str| model.parameters.iter().position(|p| p.name == name).unwrap();
    let (angle, reach) = (place("angle"), place("reach"));
    let mut evaluator = Evaluator::new(&model, &[angle, reach], 1e-11).unwrap();
    for (a, l) in [(0.3, 0.5), (0.4, 0.5), (1.5, 0.55)] {
        let found = evaluator.at(&[(angle, a), (reach, l)], true).unwrap();
        assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
        // The moment is angle EI/l.
        let moment = 2.0 * a / l;
        assert!((found.values[0].unwrap() - moment).abs() < 1e-9 * moment);
        assert!((found.slopes[0][0].unwrap() - 2.0 / l).abs() < 1e-7);
        assert!((found.slopes[0][1].unwrap() + moment / l).abs() < 1e-7);
    }
}

#[test]
fn every_example_answers_as_its_solve_does_after_a_detour() {
    for name in ["six_rod_robot", "parallelogram_stage", "cantilever_strip", "wing_ligaments"] {
        let path = format!("{}/../../models/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let model = Document::read(path).unwrap().model(&[]).unwrap();
        let free = |p: &usize| {
            !model.parameters[*p].is_structural && model.unknowns.iter().all(|u| u.parameter != *p)
        };
        let all: Vec<usize> = (0..model.parameters.len()).filter(free).collect();
        let mut evaluator = Evaluator::new(&model, &all, 1e-9).unwrap();
        let home: Vec<(usize, f64)> = all.iter().map(|p| (*p, model.parameters[*p].value)).collect();
        let first = evaluator.at(&home, false).unwrap();
        let away: Vec<(usize, f64)> = home.iter().map(|(p, v)| (*p, 1.01 * v)).collect();
        evaluator.at(&away, false).unwrap();
        let back = evaluator.at(&home, true).unwrap();
        let options = Options { tolerance: 1e-9, sensitivities: true, ..Options::default() };
        let solved = solve(&model, &options, &mut |_| {}).unwrap();
        let results = flexura::post::each_output(&model, &solved);
        let mut wanted = Vec::new();
        for (result, output) in results.iter().zip(&model.outputs) {
            match result.as_ref().map(|r| r.value) {
                Ok(flexura::post::OutputValue::Number(v)) => wanted.push(Some(v)),
                Ok(flexura::post::OutputValue::Vector(v)) => wanted.extend(v.map(Some)),
                Err(_) => wanted.extend(output.formulas.iter().map(|_| None)),
            }
        }
        assert_eq!(back.values.len(), wanted.len());
        for ((a, b), c) in first.values.iter().zip(&back.values).zip(&wanted) {
            let (a, b, c) = (a.unwrap(), b.unwrap(), c.unwrap());
            let size = 1e-3 + c.abs();
            assert!((a - c).abs() < 1e-7 * size && (b - c).abs() < 1e-7 * size, "{name}: {a} {b} {c}");
        }
        let sensitivities = solved.sensitivities.unwrap();
        let rows: Vec<&Vec<Option<f64>>> = sensitivities.outputs.iter().flatten().collect();
        for (own, row) in back.slopes.iter().zip(rows) {
            for (k, parameter) in all.iter().enumerate() {
                let column = sensitivities.parameters.iter().position(|p| p == parameter).unwrap();
                let (a, b) = (own[k].unwrap(), row[column].unwrap());
                assert!((a - b).abs() < 1e-6 * (1e-3 + b.abs()), "{name}: {a} {b}");
            }
        }
    }
}

#[test]
fn what_no_solve_can_lead_is_refused() {
    let path = format!("{}/../../models/lattice.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Document::read(path).unwrap().model(&[]).unwrap();
    let n = model.parameters.iter().position(|p| p.is_structural).unwrap();
    let error = Evaluator::new(&model, &[n], 1e-8).unwrap_err();
    assert!(error.message.contains("of which parts"), "{error:?}");
    let model = Document::parse(CIRCLE, "circle.toml").unwrap().model(&[]).unwrap();
    let error = Evaluator::new(&model, &[], 1e-8).unwrap().at(&[(0, -1.0)], false).unwrap_err();
    assert!(error.path.contains("length"), "{error:?}");
}
