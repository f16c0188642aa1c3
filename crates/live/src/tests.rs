//! What the page may rely on: the same answers as a solve's, from wherever it stands.

use crate::Live;
use serde_json::{Value, json};

fn model(name: &str) -> String {
    let path = format!("{}/../../models/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("the model is there")
}

fn ask(live: &mut Live, request: &Value) -> Value {
    serde_json::from_str(&live.answer(&request.to_string())).expect("answers are JSON")
}

fn opened(name: &str) -> Live {
    let mut live = Live::default();
    let answer =
        ask(&mut live, &json!({ "do": "open", "text": model(name), "name": format!("{name}.toml") }));
    assert!(answer["opened"].is_object(), "{answer}");
    live
}

fn output(answer: &Value, name: &str) -> f64 {
    answer["document"]["outputs"][name].as_f64().unwrap_or_else(|| panic!("no {name} in {answer}"))
}

/// Tip of a cantilever under a force at its tip, P L²/EI = 1 ... 10 (K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145):
/// rise and shortening over L.
const MATTIASSON: [(f64, f64, f64); 3] =
    [(1.0, 0.30172, 0.05643), (5.0, 0.71379, 0.38763), (10.0, 0.81061, 0.55500)];

/// Rise under a force of 2.
const MATTIASSON_2: f64 = 0.49346;

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().expect("a list").iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

#[test]
fn warm_steps_meet_the_published_elastica() {
    let mut live = opened("elastica");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    for (force, rise, shortening) in MATTIASSON {
        let answer = ask(&mut live, &json!({ "do": "step", "values": [["force", force]] }));
        assert_eq!(answer["way"], "near");
        assert!((output(&answer, "rise") - rise).abs() < 1e-5, "{force}");
        assert!((output(&answer, "shortening") - shortening).abs() < 1e-5, "{force}");
    }
}

#[test]
fn a_value_may_be_typed_with_its_unit() {
    let mut live = opened("elastica");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let answer = ask(&mut live, &json!({ "do": "step", "set": [["force", "0.005 kN"]] }));
    assert!((output(&answer, "rise") - MATTIASSON[1].1).abs() < 1e-5);
    let answer = ask(&mut live, &json!({ "do": "step", "set": [["force", "5 m"]] }));
    let message = answer["problems"][0]["message"].as_str().unwrap_or_default();
    assert!(message.contains("expected"), "{message}");
    // Nothing has moved.
    let answer = ask(&mut live, &json!({ "do": "step" }));
    assert!((output(&answer, "rise") - MATTIASSON[1].1).abs() < 1e-5);
}

#[test]
fn a_mistake_is_told_with_its_line_and_leaves_what_was_open() {
    let mut live = opened("elastica");
    let text = model("elastica").replace("length = \"1 m\"", "lenght = \"1 m\"");
    let line = text.lines().position(|line| line.contains("lenght")).expect("it is in the text") + 1;
    let answer = ask(&mut live, &json!({ "do": "open", "text": text, "name": "elastica.toml" }));
    assert!(answer["opened"].is_null());
    let problems = answer["problems"].as_array().expect("a list");
    let own = problems.iter().find(|problem| problem["line"] == line).expect("one at the line");
    let (from, to) = (own["from"].as_u64().unwrap_or(0) as usize, own["to"].as_u64().unwrap_or(0) as usize);
    assert!(text[from..to].contains("lenght"), "{own}");
    let answer = ask(&mut live, &json!({ "do": "solve" }));
    assert_eq!(answer["document"]["status"], "converged");
}

#[test]
fn places_in_a_text_are_counted_as_the_page_counts_them() {
    // Before the mistake stands a letter of one unit in JavaScript but two bytes, and one of two units but four bytes.
    let text = format!("# \u{e9} \u{1d4a7}\n{}", model("elastica").replace("rise = ", "rise == "));
    let answer = ask(&mut Live::default(), &json!({ "do": "open", "text": text, "name": "elastica.toml" }));
    let own = &answer["problems"][0];
    let from = own["from"].as_u64().expect("a place") as usize;
    let units: Vec<u16> = text.encode_utf16().collect();
    let before = String::from_utf16(&units[..from]).expect("a whole letter");
    assert_eq!(before.matches('\n').count() + 1, own["line"].as_u64().unwrap_or(0) as usize);
    assert!(
        before.ends_with("rise =") || before.ends_with("rise = ") || before.ends_with("rise "),
        "{before}"
    );
}

/// Lee's frame has no equilibrium near its first one beyond the fold at a load of 1.85567 (Lee, Manuel and Rossow, 1968).
#[test]
fn past_a_fold_nothing_is_near_and_that_is_said() {
    let mut live = opened("lee_frame");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let below = ask(&mut live, &json!({ "do": "step", "values": [["load", 1.855]], "samples": 0 }));
    assert_eq!(below["way"], "near");
    let beyond = ask(&mut live, &json!({ "do": "step", "values": [["load", 1.857]], "samples": 0 }));
    assert!(beyond["way"] == "kept" || beyond["way"] == "rest", "{beyond}");
    if beyond["way"] == "kept" {
        assert!(beyond["reason"].as_str().is_some_and(|reason| reason.contains("fold")), "{beyond}");
        assert_eq!(beyond["values"][0], json!(["load", 1.855]));
    }
}

#[test]
fn a_dragged_tip_comes_under_the_pointer_by_the_force_that_holds_it_there() {
    let mut live = opened("elastica");
    ask(&mut live, &json!({ "do": "step", "values": [["force", 1.0]], "samples": 0 }));
    let grips = ask(&mut live, &json!({ "do": "grips" }));
    assert_eq!(grips["grips"][0]["parameters"], json!(["force"]));
    // Under a force of 5 the tip stands at (1 - 0.38763, 0.71379); of its path that is the nearest point to itself.
    let (_, rise, shortening) = MATTIASSON[1];
    let to = [1.0 - shortening, rise, 0.0];
    let mut answer = Value::Null;
    for _ in 0..6 {
        answer = ask(&mut live, &json!({ "do": "drag", "grip": 0, "to": to, "eye": [0.0, 0.0, 1.0] }));
    }
    assert!((output(&answer, "rise") - rise).abs() < 2e-4, "{}", output(&answer, "rise"));
    let force = answer["values"][0][1].as_f64().unwrap_or(f64::NAN);
    assert!((force - 5.0).abs() < 1e-2, "{force}");
}

#[test]
fn a_load_without_a_parameter_is_dragged_by_its_own_force() {
    let text = model("elastica").replace("force = [0, \"force\", 0]", "force = [0, \"1 N\", 0]");
    let mut live = Live::default();
    ask(&mut live, &json!({ "do": "open", "text": text, "name": "elastica.toml" }));
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let grips = ask(&mut live, &json!({ "do": "grips" }));
    assert_eq!(grips["grips"][0]["parameters"], json!([]));
    // Seen along the axis and led out of the plane, as far as a force of 2 leads it.
    let rise = MATTIASSON_2;
    let to = [1.0, 0.8 * rise, 0.6 * rise];
    let mut answer = Value::Null;
    for _ in 0..12 {
        answer = ask(&mut live, &json!({ "do": "drag", "grip": 0, "to": to, "eye": [1.0, 0.0, 0.0] }));
        if answer["is_there"] == true {
            break;
        }
    }
    assert_eq!(answer["is_there"], true);
    let tip = numbers(&answer["document"]["beams"]["rod"]["position"].as_array().expect("samples")[100]);
    let force = numbers(&answer["document"]["scene"]["loads"]["tip"]["force"]);
    assert!((tip[1] - to[1]).hypot(tip[2] - to[2]) < 2e-4, "{tip:?}");
    // A rod that is as stiff in all directions bends in the plane of its axis and the force.
    assert!((force[1] / force[2] - 0.8 / 0.6).abs() < 1e-3, "{force:?}");
    // Force and moment at the clamp balance.
    let moment = tip[0] * force[1] - tip[1] * force[0];
    assert!((output(&answer, "clamp_moment") - moment).abs() < 1e-8);
    let back = ask(&mut live, &json!({ "do": "release" }));
    assert!((output(&back, "rise") - MATTIASSON[0].1).abs() < 1e-5);
}

#[test]
fn a_driven_crank_follows_the_pointer() {
    let mut live = opened("four_bar");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let grips = ask(&mut live, &json!({ "do": "grips" }));
    let position =
        grips["grips"].as_array().and_then(|list| list.iter().position(|own| own["name"] == "pivot_a"));
    let grip = position.expect("the crank can be dragged");
    // The pin of the crank, 40 mm from its axis, at 10 degrees from where it is at rest.
    let angle = 10f64.to_radians();
    let to = [-0.04 * angle.sin(), 0.04 * angle.cos(), 0.0];
    let mut answer = Value::Null;
    for _ in 0..6 {
        answer = ask(
            &mut live,
            &json!({ "do": "drag", "grip": grip, "to": to, "eye": [0.0, 0.0, 1.0], "samples": 0 }),
        );
    }
    let values = answer["values"].as_array().expect("values").clone();
    let crank = values.iter().find(|pair| pair[0] == "crank").and_then(|pair| pair[1].as_f64());
    assert!((crank.unwrap_or(f64::NAN) - angle).abs() < 1e-2, "{crank:?}");
}

#[test]
fn the_robots_plate_is_led_by_its_targets_and_the_rods_follow() {
    let mut live = opened("six_rod_robot");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let grips = ask(&mut live, &json!({ "do": "grips" }));
    assert_eq!(grips["grips"][0]["body"], "plate");
    let answer = ask(&mut live, &json!({ "do": "step", "values": [["y", 0.03]] }));
    assert_eq!(answer["way"], "near");
    let place = &answer["document"]["bodies"]["plate"]["position"];
    assert!((place[1].as_f64().unwrap_or(f64::NAN) - 0.03).abs() < 1e-8, "{place}");
}

#[test]
fn a_trace_and_critical_loads_start_from_the_present_values() {
    let mut live = opened("lee_frame");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let answer = ask(&mut live, &json!({ "do": "trace", "parameter": "load", "range": [0.0, 2.5] }));
    let points = answer["document"]["branches"][0]["points"].as_array().expect("points").clone();
    let fold = points.iter().find(|point| point["kind"] == "fold").expect("a fold");
    assert!((fold["parameter"].as_f64().unwrap_or(f64::NAN) - 1.85567).abs() < 1e-5);
    let mut live = opened("euler_clamped_pinned");
    ask(&mut live, &json!({ "do": "solve", "samples": 0 }));
    let answer = ask(&mut live, &json!({ "do": "stability" }));
    assert_eq!(answer["document"]["study"], "buckle", "{answer}");
}

#[test]
fn a_request_that_makes_no_sense_is_answered() {
    let mut live = Live::default();
    for request in [
        "",
        "{}",
        "[1",
        r#"{"do":"fly"}"#,
        r#"{"do":"solve"}"#,
        r#"{"do":"drag","grip":3,"to":[0,0,0],"eye":[0,0,0]}"#,
    ] {
        let answer: Value = serde_json::from_str(&live.answer(request)).expect("JSON");
        assert_eq!(answer["problems"].as_array().map(Vec::len), Some(1), "{request}: {answer}");
    }
}

/// The lattice of n columns and rows has 2 n (n - 1) beams between its nodes and n at its side.
#[test]
fn a_parameter_that_decides_of_which_parts_a_mechanism_is_made_is_stepped_from_rest() {
    let mut live = opened("lattice");
    for n in [4, 3] {
        let answer = ask(&mut live, &json!({ "do": "step", "values": [["n", n]], "samples": 5 }));
        assert_eq!(answer["way"], "rest", "{answer}");
        let beams = answer["document"]["beams"].as_object().expect("beams").len();
        assert_eq!(beams, 2 * n * (n - 1) + n);
    }
}
