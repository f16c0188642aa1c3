//! The result document.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CURVATURE, HEIGHT, LENGTH, model, rich, robot, solution};
use flexura_output::{OutputError, ReadError, document, read_document, solution_of, to_json};
use flexura_post::{OutputResult, OutputValue, PostError, evaluate};
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
        "couplings",
        "cables",
        "tubes",
        "energy",
        "stable",
        "unstable_directions",
        "stability_reason",
        "scene",
    ];
    assert_eq!(keys, promised);
    assert_eq!(value["status"], "converged");
    assert_eq!(value["study"], "solve");
    assert_eq!(value["parameters"], json!({ "turn": 1.2 }));
    assert_eq!(value["tubes"], json!({}));
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

#[test]
fn an_output_without_a_value_is_null_in_its_place_with_the_reason() {
    let (model, solution) = rich();
    let mut evaluation = evaluate(&model, &solution).unwrap();
    assert_eq!(evaluation.outputs.remove(0).name, "sink");
    let error = PostError::NotFinite { output: "sink".into(), value: f64::INFINITY };
    evaluation.without_value.push(error.clone());
    let text = to_json(&document(&model, &solution, &evaluation).unwrap()).unwrap();
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["outputs"].get("sink"), Some(&Value::Null));
    assert!(value["outputs"]["place"].is_array());
    assert_eq!(value["output_reasons"], json!({ "sink": error.to_string() }));
    assert!(error.to_string().contains("is inf, not a finite number"));
    assert!(text.find("\"sink\": null") < text.find("\"place\": ["), "in the order of the model");
    // The sensitivities of the others are not affected.
    assert_eq!(value["sensitivities"]["place"]["turn"], json!([0.05, 0.0, -0.1]));
    let back = read_document(&text).unwrap();
    assert_eq!(back.outputs.get("sink"), Some(&None));
}

#[test]
fn joints_of_several_coordinates_name_them() {
    let (model, solution) = rich();
    let (_, value) = written(&model, &solution);
    assert_eq!(value["joints"]["bevel"]["names"], json!(["first", "second"]));
    assert_eq!(value["joints"]["table"]["names"], json!(["x", "y", "angle"]));
    assert_eq!(value["joints"]["loose"]["coordinates"].as_array().unwrap().len(), 6);
    assert_eq!(value["joints"]["hinge"].get("names"), None);
    assert_eq!(value["couplings"], json!({ "gear": { "multiplier": 0.25 } }));
    assert_eq!(value["cables"]["puller"]["tension"], 3.0);
    assert_eq!(value["cables"]["puller"]["course"].as_array().unwrap().len(), 3);
    assert_eq!(value["unknowns"], json!({ "push": 3.2 }));
    assert_eq!(value["parameters"]["push"], 3.2);
}

#[test]
fn lists_of_a_tube_end_where_it_does() {
    let (model, solution) = rich();
    let (_, value) = written(&model, &solution);
    let tubes = &value["tubes"]["robot"];
    let fields: Vec<&String> = tubes.as_object().unwrap().keys().collect();
    assert_eq!(fields, ["angles", "curvature", "force", "moment", "position", "rotation", "s", "torques"]);
    for field in ["s", "position", "rotation", "force", "moment", "curvature"] {
        assert_eq!(tubes[field].as_array().unwrap().len(), 9, "{field}");
    }
    let samples = &robot().1.samples;
    let tip = samples[8].pose.position;
    assert_eq!(tubes["position"][8], json!([tip.x, tip.y, tip.z]));
    assert_eq!(tubes["rotation"][0], json!([1.0, 0.0, 0.0, 0.0]));
    assert_eq!(tubes["force"][2], json!([0.0, 0.0, -0.1]));
    assert_eq!(tubes["curvature"][3], json!([0.0, 0.0, 5.0]));
    assert_eq!(tubes["angles"][0], json!(vec![0.0; 9]));
    let angles: Vec<f64> = samples[..5].iter().map(|sample| sample.angles[1].1).collect();
    assert_eq!(tubes["angles"][1], json!(angles));
    let torques: Vec<f64> = samples[..5].iter().map(|sample| sample.torques[1].1).collect();
    assert_eq!(tubes["torques"][1], json!(torques));
    assert_eq!(tubes["torques"][0].as_array().unwrap().len(), 9);
}

#[test]
fn nan_in_a_tube_is_refused_by_name() {
    let (model, mut solution) = rich();
    let evaluation = evaluate(&model, &solution).unwrap();
    solution.tubes[0].samples[2].torques[1].1 = f64::NAN;
    let error = document(&model, &solution, &evaluation).unwrap_err();
    assert!(error.to_string().contains("tubes.robot.torques[1][2]"), "{error}");
}

#[test]
fn compliances_stand_under_the_name_that_an_output_would_give_the_place() {
    let (model, solution) = rich();
    let (_, value) = written(&model, &solution);
    let places: Vec<&String> = value["compliance"].as_object().unwrap().keys().collect();
    assert_eq!(places, ["beam.\"wire <\"b\">\"[0.03 m]", "beam.strip[0.5]", "body.tip"]);
    assert_eq!(value["compliance"]["body.tip"][3][1], 0.04);
    assert_eq!(value["compliance_rows"], json!(["x", "y", "z", "rx", "ry", "rz"]));
    assert_eq!(value["compliance_columns"], json!(["fx", "fy", "fz", "mx", "my", "mz"]));
    assert_eq!(value["motion"]["body.tip"], json!([-0.05, 0.0, -0.1, 0.0, 1.2, 0.0]));
}

#[test]
fn sensitivities_are_numbers_or_vectors_and_elasticities_leave_out_what_is_zero() {
    let (model, solution) = rich();
    let (_, value) = written(&model, &solution);
    assert_eq!(value["sensitivities"]["sink"], json!({ "turn": -0.1, "push": 0.02 }));
    assert_eq!(value["sensitivities"]["place"]["turn"], json!([0.05, 0.0, -0.1]));
    let sink = common::arc(LENGTH).position.z;
    let elasticity = value["elasticities"]["sink"]["turn"].as_f64().unwrap();
    assert!((elasticity - -0.1 * 1.2 / sink).abs() < 1e-15);
    assert_eq!(value["elasticities"]["place"]["turn"][1], Value::Null);
}

#[test]
fn a_document_is_read_back_into_the_solution_that_it_was_made_of() {
    let (model, solution) = rich();
    let (text, _) = written(&model, &solution);
    let back = solution_of(&read_document(&text).unwrap(), &model).unwrap();
    assert_eq!(back.status, Status::Converged);
    assert_eq!(back.bodies.len(), solution.bodies.len());
    for (a, b) in back.beams.iter().zip(&solution.beams) {
        assert_eq!(a.length, b.length);
        for (a, b) in a.samples.iter().zip(&b.samples) {
            assert!((a.pose.position - b.pose.position).norm() < 1e-15);
            assert!(a.pose.rotation.angle_to(&b.pose.rotation) < 1e-14);
            assert!((a.wrench.moment - b.wrench.moment).norm() < 1e-15 * (1.0 + b.wrench.moment.norm()));
        }
    }
    assert_eq!(back.joints[1].coordinates, [0.0, 0.0]);
    assert_eq!(back.found, [(1, 3.2)]);
    assert!((back.springs[0].ends[1] - solution.springs[0].ends[1]).norm() < 1e-15);
    assert_eq!(back.tubes[0].samples.len(), 9);
    for (a, b) in back.tubes[0].samples.iter().zip(&solution.tubes[0].samples) {
        assert!((a.s - b.s).abs() < 1e-15 && (a.pose.position - b.pose.position).norm() < 1e-15);
        assert!((a.wrench.moment - b.wrench.moment).norm() < 1e-15 && a.wrench.force == b.wrench.force);
        assert_eq!(a.curvature, b.curvature);
        for (a, b) in [(&a.angles, &b.angles), (&a.torques, &b.torques)] {
            assert_eq!(a.len(), b.len());
            assert!(a.iter().zip(b).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-15));
        }
        assert!(a.pose.rotation.angle_to(&b.pose.rotation) < 1e-14);
    }
    let (again, _) = written(&model, &solution);
    assert_eq!(again, text);

    // An older document knows of no tubes.
    let mut older = read_document(&text).unwrap();
    older.tubes.0.clear();
    assert!(solution_of(&older, &model).unwrap().tubes[0].samples.is_empty());

    // The order of the model counts, not that of the document.
    let mut turned = model.clone();
    turned.bodies.swap(0, 1);
    let other = solution_of(&read_document(&text).unwrap(), &turned).unwrap();
    assert_eq!(other.bodies[1].position, back.bodies[0].position);
}

#[test]
fn what_is_no_result_of_this_mechanism_is_refused_with_the_reason() {
    let (model, solution) = rich();
    let (text, value) = written(&model, &solution);
    let read = |text: &str| read_document(text).and_then(|document| solution_of(&document, &model));
    let message = |text: &str| read(text).unwrap_err().to_string();
    for foreign in ["", "x = 1", "[]", "{}", "3", "{\"flexura\": \"0.1\"}"] {
        assert!(matches!(read(foreign), Err(ReadError::NoDocument(_))), "{foreign}");
    }
    assert!(message(&text.replace("\"solve\"", "\"check\"")).contains("`check`"));
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut value = value.clone();
        change(&mut value);
        message(&value.to_string())
    };
    let missing = changed(&|value| drop(value["beams"].as_object_mut().unwrap().remove("strip")));
    assert!(missing.contains("another mechanism") && missing.contains("`strip`"), "{missing}");
    let further = changed(&|value| value["bodies"]["extra"] = value["bodies"]["tip"].clone());
    assert!(further.contains("`extra`"), "{further}");
    let short = changed(&|value| drop(value["beams"]["strip"]["force"].as_array_mut().unwrap().pop()));
    assert!(short.contains("broken") && short.contains("`force` has 20"), "{short}");
    let thin = changed(&|value| drop(value["tubes"]["robot"]["moment"].as_array_mut().unwrap().pop()));
    assert!(thin.contains("tubes.robot") && thin.contains("`moment` has 8"), "{thin}");
    let long = changed(&|value| value["tubes"]["robot"]["angles"][1] = json!(vec![0.0; 10]));
    assert!(long.contains("further than `s`"), "{long}");
    let skewed = changed(&|value| value["bodies"]["tip"]["rotation"] = json!([1.0, 1.0, 0.0, 0.0]));
    assert!(skewed.contains("unit quaternion"), "{skewed}");
    let jointed = changed(&|value| value["joints"]["table"] = value["joints"]["hinge"].clone());
    assert!(jointed.contains("has 1 coordinates, that of the model file has 3"), "{jointed}");
    let worded = changed(&|value| value["status"] = json!("fine"));
    assert!(worded.contains("`fine`"), "{worded}");
}

#[test]
fn a_spring_tells_its_strain_its_stress_and_its_course_and_is_read_back() {
    let (model, mut solution) = rich();
    let ends = solution.springs[0].ends;
    let spring = &mut solution.springs[0];
    (spring.strain, spring.stress, spring.is_slack) = (Some(-0.25), Some(3e5), true);
    spring.course = vec![ends[0], (ends[0] + ends[1]) * 0.4, ends[1]];
    let (text, value) = written(&model, &solution);
    let told = &value["springs"]["return"];
    assert_eq!((told["strain"].as_f64(), told["slack"].as_bool()), (Some(-0.25), Some(true)));
    assert_eq!(told["course"].as_array().unwrap().len(), 3);
    let back = solution_of(&read_document(&text).unwrap(), &model).unwrap();
    let back = &back.springs[0];
    assert_eq!((back.strain, back.stress, back.is_slack), (Some(-0.25), Some(3e5), true));
    assert!((back.course[1] - solution.springs[0].course[1]).norm() < 1e-15);
    // A straight one has no course, and a law without an area no stress.
    solution.springs[0].course.clear();
    solution.springs[0].stress = None;
    let (_, value) = written(&model, &solution);
    assert!(value["springs"]["return"].get("course").is_none());
    assert!(value["springs"]["return"].get("stress").is_none());
}

#[test]
fn the_scene_tells_what_a_picture_needs() {
    let (_, value) = written(&model(), &solution());
    let scene = &value["scene"];
    let strip = &scene["beams"]["strip"];
    assert_eq!(strip["shape"], "rectangle");
    assert_eq!(strip["width"], json!([common::WIDTH]));
    assert_eq!(strip["height"], json!([HEIGHT]));
    // Straight along x at rest.
    let rest: Vec<[f64; 3]> = serde_json::from_value(strip["position"].clone()).unwrap();
    assert_eq!(rest.len(), strip["s"].as_array().unwrap().len());
    assert!(rest.iter().all(|[_, y, z]| *y == 0.0 && *z == 0.0) && (rest[20][0] - LENGTH).abs() < 1e-15);
    assert_eq!(strip["start"]["kind"], "weld");
    assert!(strip["start"]["place"].get("body").is_none());
    assert_eq!(scene["beams"]["wire <\"b\">"]["width"], json!([]));
    let load = &scene["loads"]["bend"];
    assert_eq!((&load["force"], &load["frame"]), (&json!([0.0, 0.0, -1.0]), &json!("global")));
    assert_eq!(load["place"]["body"], model().bodies[0].name.as_str());
    let joint = scene["joints"].as_object().unwrap().values().next().unwrap();
    assert_eq!((&joint["kind"], &joint["axis"]), (&json!("revolute"), &json!([0.0, 1.0, 0.0])));
    assert_eq!(scene["springs"]["return"]["from"]["position"], json!([0.0, 0.0, -0.15]));
    assert_eq!(scene["units"]["parameters"], json!({ "turn": "rad" }));
}

#[test]
fn a_document_without_a_scene_is_still_read() {
    let (_, mut value) = written(&model(), &solution());
    value.as_object_mut().unwrap().remove("scene");
    let document = read_document(&value.to_string()).unwrap();
    assert!(document.scene.beams.is_empty());
    assert!(solution_of(&document, &model()).is_ok());
}

#[test]
fn another_state_has_a_scene_of_its_own_only_where_more_than_loads_differs() {
    let (first, state) = (model(), solution());
    let scene = flexura_output::scene(&first, &state).unwrap();
    let beside = |model: &flexura_model::Model, state: &flexura_solution::Solution| {
        flexura_output::scene_beside(&scene, model, state).unwrap()
    };
    let changed = |change: &dyn Fn(&mut flexura_model::Model)| {
        let mut other = model();
        change(&mut other);
        beside(&other, &state)
    };
    assert!(beside(&first, &state).is_none());
    assert!(changed(&|model| model.loads[0].force *= 2.0).is_none());
    // Fewer samples of the same rest shape, bent otherwise.
    let mut thin = state.clone();
    thin.beams[0].samples = [0, 7, 20].map(|i| state.beams[0].samples[i]).to_vec();
    thin.beams[0].samples[1].pose.position.z += 0.01;
    assert!(beside(&first, &thin).is_none());

    assert!(changed(&|model| model.bodies[0].pose.position.x += 1e-3).is_some());
    assert!(changed(&|model| model.gravity.z = -9.81).is_some());
    let mut longer = state.clone();
    for sample in &mut longer.beams[0].samples {
        sample.s *= 1.5;
        sample.rest_pose.position *= 1.5;
    }
    let own = beside(&first, &longer).unwrap();
    let strip = own.beams.get("strip").unwrap();
    assert!((strip.s[20] - 1.5 * LENGTH).abs() < 1e-9);
    assert!(own.units.outputs.is_empty() && own.text.is_none());
}
