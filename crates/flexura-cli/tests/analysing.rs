//! `flexura solve` with what it can say besides the equilibrium: sensitivities, compliances, an earlier result, other
//! equilibria.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, run, stderr, stdout};
use serde_json::Value;

fn solved(arguments: &[&str]) -> Value {
    let output = flexura().arg("solve").args(arguments).arg("--json").output().unwrap();
    assert_eq!(code(&output), 0, "{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn sensitivities_are_the_differences_of_two_solves() {
    let document = solved(&["parallelogram_stage.toml", "--sensitivity", "--tolerance", "1e-11"]);
    let travel = |push: &str| {
        let solved = solved(&["parallelogram_stage.toml", "--set", push, "--tolerance", "1e-11"]);
        solved["outputs"]["travel"].as_f64().unwrap()
    };
    let difference = (travel("push=5.001") - travel("push=4.999")) / 0.002;
    let slope = document["sensitivities"]["travel"]["push"].as_f64().unwrap();
    assert!((slope - difference).abs() < 1e-6 * slope, "{slope} {difference}");
    let elasticity = document["elasticities"]["travel"]["push"].as_f64().unwrap();
    let wanted = slope * 5.0 / document["outputs"]["travel"].as_f64().unwrap();
    assert!((elasticity - wanted).abs() < 1e-12);

    let plain = solved(&["parallelogram_stage.toml"]);
    for key in ["sensitivities", "elasticities", "compliance", "motion", "equilibria", "unknowns"] {
        assert_eq!(plain.get(key), None, "{key}");
    }
}

#[test]
fn the_table_of_sensitivities_has_units_and_elasticities() {
    let output = run(&["solve", "parallelogram_stage.toml", "--sensitivity"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in ["sensitivities", "by push", "1.8083 mm/N (0.957)", "rad/N", "per cent"] {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
}

#[test]
fn a_compliance_is_the_motion_by_a_small_load() {
    let places = ["--compliance", "body.stage", "--compliance", "beam.upper[20 mm]"];
    let document = solved(&[&["parallelogram_stage.toml"][..], &places].concat());
    let compliance = &document["compliance"]["body.stage"];
    let slope = solved(&["parallelogram_stage.toml", "--sensitivity"]);
    let by_push = slope["sensitivities"]["travel"]["push"].as_f64().unwrap();
    assert!((compliance[2][2].as_f64().unwrap() - by_push).abs() < 1e-6 * by_push);
    for (i, j) in [(0, 2), (2, 4), (3, 5)] {
        let (a, b) = (compliance[i][j].as_f64().unwrap(), compliance[j][i].as_f64().unwrap());
        assert!((a - b).abs() < 1e-6 * a.abs(), "{i} {j}: {a} {b}");
    }
    assert_eq!(document["compliance"]["beam.upper[0.02 m]"].as_array().unwrap().len(), 6);
    assert_eq!(document["compliance_rows"][3], "rx");
    assert_eq!(document["motion"]["body.stage"].as_array().unwrap().len(), 6);

    let output = run(&[&["solve", "parallelogram_stage.toml"][..], &places].concat());
    let text = stdout(&output);
    for words in ["compliance of body.stage", "compliance of beam.upper[0.02 m]", "by fx [N]", "rz"] {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
}

#[test]
fn a_place_that_is_none_is_met_with_the_nearest_name() {
    let cases = [
        ("body.stge", "`stage`"),
        ("beam.uper.end", "`upper`"),
        ("beam.upper.ende", "`end`"),
        ("beam.upper", "a place on the beam is missing"),
        ("beam.upper[2]", "from 0 to 1"),
        ("beam.upper[70 mm]", "0.06 m long"),
        ("beam.upper[2 N]", "a force"),
        ("bod.stage", "`body`"),
        ("body.stage.position", "is no place"),
        ("1 + 1", "is no place"),
        ("", "is no place"),
    ];
    for (place, words) in cases {
        let output = run(&["solve", "parallelogram_stage.toml", "--compliance", place]);
        assert_eq!(code(&output), 2, "{place}");
        assert!(stderr(&output).contains(words), "{place}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_solve_may_start_from_an_earlier_result() {
    let folder = folder("a_solve_may_start");
    let first = flexura().args(["solve", "four_bar.toml", "-q", "-o"]).arg(&folder).output().unwrap();
    assert_eq!(code(&first), 0, "{}", stderr(&first));
    let path = folder.join("result.json");
    let earlier = path.to_str().unwrap();
    let again = solved(&["four_bar.toml", "--from", earlier]);
    let plain = solved(&["four_bar.toml"]);
    for (name, value) in plain["outputs"].as_object().unwrap() {
        let numbers = |value: &Value| match value.as_array() {
            Some(list) => list.iter().map(|v| v.as_f64().unwrap()).collect(),
            None => vec![value.as_f64().unwrap()],
        };
        for (a, b) in numbers(value).into_iter().zip(numbers(&again["outputs"][name])) {
            assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "{name}: {a} {b}");
        }
    }

    let refused = |arguments: &[&str], words: &str| {
        let output = flexura().arg("solve").args(arguments).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(words), "{arguments:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
    };
    refused(&["elastica.toml", "--from", earlier], "another mechanism");
    refused(&["elastica.toml", "--from", "elastica.toml"], "no result document");
    refused(&["elastica.toml", "--from", "no_such.json"], "no such file");
    refused(&["elastica.toml", "--from", "."], "directory");
    refused(&["elastica.toml", "--from", env!("CARGO_BIN_EXE_flexura")], "no text");
    let broken =
        std::fs::read_to_string(&path).unwrap().replace("\"curvature\": [[", "\"curvature\": [[0,0,0], [");
    std::fs::write(&path, broken).unwrap();
    refused(&["four_bar.toml", "--from", earlier], "broken");
}

#[test]
fn guesses_list_the_equilibria_beside_the_one_from_rest() {
    let document = solved(&["elastica.toml", "--guesses", "3", "--seed", "7"]);
    let list = document["equilibria"].as_array().unwrap();
    assert!(!list.is_empty());
    let mut last = f64::NEG_INFINITY;
    for equilibrium in list {
        let energy = equilibrium["energy"].as_f64().unwrap();
        assert!(energy >= last);
        last = energy;
        for key in ["outputs", "bodies", "joints", "residual", "error_estimate", "stable"] {
            assert!(equilibrium.get(key).is_some(), "{key}");
        }
    }
    let from_rest = &document["outputs"]["rise"];
    let has_it = list.iter().any(|equilibrium| {
        let difference = equilibrium["outputs"]["rise"].as_f64().unwrap() - from_rest.as_f64().unwrap();
        difference.abs() < 1e-7
    });
    assert!(has_it);
    let output = run(&["solve", "elastica.toml", "--guesses", "3"]);
    assert!(stdout(&output).contains("equilibria") && stdout(&output).contains("from rest"));
    let lonely = run(&["solve", "elastica.toml", "--seed", "3"]);
    assert_eq!(code(&lonely), 2);
}
