//! The result document.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CURVATURE, HEIGHT, LENGTH, model, solution};
use flexura_output::{OutputError, document, to_json};
use flexura_post::{OutputResult, OutputValue, evaluate};
use flexura_solution::Status;
use serde_json::{Value, json};

fn written(model: &flexura_model::Model, solution: &flexura_solution::Solution) -> (String, Value) {
    let evaluation = evaluate(model, solution).unwrap();
    let text = to_json(&document(model, solution, &evaluation).unwrap()).unwrap();
    let value = serde_json::from_str(&text).unwrap();
    (text, value)
}

#[test]
fn a_converged_document_has_the_promised_keys_in_their_order() {
    let (text, value) = written(&model(), &solution());
    let keys: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("  \""))
        .filter_map(|line| line.split('"').nth(1))
        .collect();
    let promised = [
        "flexura",
        "model",
        "study",
        "status",
        "residual",
        "error_estimate",
        "newton_steps",
        "warnings",
        "work",
        "parameters",
        "outputs",
        "beams",
        "bodies",
        "joints",
        "springs",
        "energy",
        "stable",
        "unstable_directions",
        "stability_reason",
    ];
    assert_eq!(keys, promised);
    assert_eq!(value["status"], "converged");
    assert_eq!(value["study"], "solve");
    assert_eq!(value["parameters"], json!({ "turn": 1.2 }));
    assert_eq!(value["stable"], Value::Null);
    let beam: Vec<&String> = value["beams"]["strip"].as_object().unwrap().keys().collect();
    let mut fields =
        ["s", "position", "rotation", "force", "moment", "curvature", "stretch", "stress", "strain"];
    fields.sort_unstable();
    assert_eq!(beam, fields);
}

#[test]
fn numbers_come_back_with_all_their_digits() {
    let solution = solution();
    let (_, value) = written(&model(), &solution);
    for (i, sample) in solution.beams[0].samples.iter().enumerate() {
        let position = &value["beams"]["strip"]["position"][i];
        for c in 0..3 {
            assert_eq!(position[c].as_f64().unwrap(), sample.pose.position[c]);
        }
    }
    assert_eq!(value["residual"].as_f64(), Some(2.5e-14));
}

#[test]
fn bending_strain_is_curvature_times_half_the_height() {
    let (_, value) = written(&model(), &solution());
    let strain = value["beams"]["strip"]["strain"][7].as_f64().unwrap();
    assert!((strain - CURVATURE * HEIGHT / 2.0).abs() < 1e-12, "{strain}");
}

#[test]
fn a_section_given_as_a_stiffness_has_null_for_stress() {
    let (_, value) = written(&model(), &solution());
    let wire = &value["beams"]["wire <\"b\">"];
    assert_eq!(wire["stress"], Value::Null);
    assert_eq!(wire["strain"], Value::Null);
    assert_eq!(wire["s"].as_array().unwrap().len(), 5);
}

#[test]
fn quaternions_run_smoothly_past_a_full_turn() {
    let mut solution = solution();
    for sample in &mut solution.beams[0].samples {
        sample.pose = common::arc(sample.s / LENGTH * 2.0);
    }
    let (_, value) = written(&model(), &solution);
    let rotation: Vec<Vec<f64>> =
        serde_json::from_value(value["beams"]["strip"]["rotation"].clone()).unwrap();
    for pair in rotation.windows(2) {
        let cosine: f64 = pair[0].iter().zip(&pair[1]).map(|(a, b)| a * b).sum();
        assert!(cosine > 0.9);
    }
    assert_eq!(rotation[0], [1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_study_that_broke_off_says_how_far_it_came_and_why() {
    let mut solution = solution();
    solution.status = Status::Stalled;
    solution.reason = Some("a fold".into());
    solution.load_fraction = 0.43;
    solution.error_estimate = f64::NAN;
    let (_, value) = written(&model(), &solution);
    assert_eq!(value["status"], "stalled");
    assert_eq!(value["reason"], "a fold");
    assert_eq!(value["load_fraction"], 0.43);
    assert_eq!(value["error_estimate"], Value::Null);
}

#[test]
fn nan_is_refused_by_name() {
    let model = model();
    let mut broken = solution();
    broken.beams[0].samples[3].wrench.moment.y = f64::NAN;
    let mut evaluation = evaluate(&model, &solution()).unwrap();
    let error = document(&model, &broken, &evaluation).unwrap_err();
    assert!(error.to_string().contains("beams.strip.moment[3]"), "{error}");

    evaluation.outputs.push(OutputResult {
        name: "w".into(),
        unit: "m".into(),
        value: OutputValue::Vector([0.0, f64::INFINITY, 0.0]),
        is_strain: false,
    });
    let error = document(&model, &solution(), &evaluation).unwrap_err();
    assert!(matches!(error, OutputError::NotFinite { ref field, .. } if field == "outputs.w"), "{error}");
}
