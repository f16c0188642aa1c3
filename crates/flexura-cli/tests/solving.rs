//! The command with a solve: documents, files, summaries, exit codes.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{bundled, code, flexura, folder, run, stderr, stdout};
use serde_json::Value;
use std::io::Read;
use std::process::Stdio;

fn solved(arguments: &[&str]) -> Value {
    let output = flexura().arg("solve").args(arguments).arg("--json").output().unwrap();
    assert_eq!(code(&output), 0, "{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(document: &Value, output: &str) -> f64 {
    document["outputs"][output]
        .as_f64()
        .unwrap_or_else(|| panic!("no number {output} in {}", document["outputs"]))
}

fn assert_close(value: f64, wanted: f64, tolerance: f64) {
    assert!((value - wanted).abs() <= tolerance, "{value} is not {wanted}");
}

#[test]
fn every_bundled_model_converges_and_checks_out_square() {
    for name in bundled() {
        let document = solved(&[&name]);
        assert_eq!(document["status"], "converged", "{name}");
        assert!(document["error_estimate"].as_f64().unwrap() < 1e-6, "{name}");
        assert!(!document["outputs"].as_object().unwrap().is_empty(), "{name}");
        let output = run(&["check", &name, "--json"]);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        let census: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(census["unknowns"], census["equations"], "{name}");
    }
}

#[test]
fn the_strip_bends_as_the_elastica_does() {
    let document = solved(&["cantilever_strip.toml", "--tolerance", "1e-10"]);
    assert_close(number(&document, "x_over_length"), 0.841075234472, 1e-9);
    assert_close(number(&document, "z_over_length"), -0.491069989323, 1e-9);
    assert_close(number(&document, "slope").to_degrees(), 44.5483841, 1e-6);
    assert_close(number(&document, "mid_strain"), 621.664e-6, 1e-9);
}

#[test]
fn a_strip_rolled_up_five_times_comes_back_to_its_clamp() {
    let document = solved(&["roll_up.toml", "--set", "turns=5"]);
    for component in document["outputs"]["tip"].as_array().unwrap() {
        assert_close(component.as_f64().unwrap(), 0.0, 1e-8);
    }
}

#[test]
fn a_parameter_may_be_overridden_with_a_unit() {
    let plain = solved(&["elastica.toml", "--set", "force=2"]);
    let with_unit = solved(&["elastica.toml", "--set", "force=0.002 kN"]);
    assert_close(number(&plain, "rise"), number(&with_unit, "rise"), 1e-12);
    // Mattiasson (1981), P L^2 / EI = 2.
    assert_close(number(&plain, "rise"), 0.49346, 1e-5);
    assert_close(number(&plain, "shortening"), 0.16064, 1e-5);
    assert_eq!(plain["parameters"]["force"], 2.0);
}

#[test]
fn an_unknown_parameter_is_wrong_input() {
    let output = run(&["solve", "elastica.toml", "--set", "forze=2"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("force"), "{}", stderr(&output));
    assert!(output.stdout.is_empty());
}

#[test]
fn the_summary_is_in_units_that_a_person_reads() {
    let output = run(&["solve", "cantilever_strip.toml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in
        ["converged", "mid_strain", "621.664 µε", "44.548", "152.4 mm", "MPa", "safety", "strain energy"]
    {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
    assert!(!text.contains('\u{1b}'), "colours where there is no terminal");
}

#[test]
fn the_summary_says_whether_the_equilibrium_is_stable() {
    let says = |arguments: &[&str], words: &str| {
        let output = run(&[&["solve"], arguments].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(stdout(&output).ends_with(&format!("stability      {words}\n")), "{}", stdout(&output));
    };
    // Between pi^2/4 and 9 pi^2/4, and between that and 25 pi^2/4.
    says(&["euler_clamped_free.toml", "--set", "push=2"], "stable");
    says(&["euler_clamped_free.toml", "--set", "push=20"], "unstable in 1 direction");
    says(&["euler_clamped_free.toml", "--set", "push=30"], "unstable in 2 directions");
    let follows = "not decided: load.jet: a force that follows what it acts on has no energy";
    says(&["follower_cantilever.toml"], follows);
}

#[test]
fn quiet_says_nothing_when_all_is_well() {
    let output = run(&["solve", "elastica.toml", "--quiet"]);
    assert_eq!(code(&output), 0);
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
}

#[test]
fn a_folder_receives_the_four_files() {
    let folder = folder("a_folder_receives_the_four_files").join("made/on/the/way");
    let output = flexura().args(["solve", "half_ring.toml", "-o"]).arg(&folder).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let document: Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(document["status"], "converged");
    assert!(read("beams.csv").starts_with("beam,s[m]"));
    assert!(read("model.vtp").contains("PolyData"));
    assert!(read("shape.svg").contains("</svg>"));
}

#[test]
fn a_folder_that_cannot_be_made_is_a_failure_of_the_machine() {
    let file = folder("a_folder_that_cannot_be_made").join("file");
    std::fs::write(&file, "").unwrap();
    let output = flexura().args(["solve", "elastica.toml", "-o"]).arg(file.join("below")).output().unwrap();
    assert_eq!(code(&output), 3);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = flexura()
        .args(["solve", "compression_spring.toml", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0u8; 1];
    let mut pipe = child.stdout.take().unwrap();
    pipe.read_exact(&mut first).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn the_balance_of_the_sensor_clamp_holds() {
    let document = solved(&["sensor_clamp.toml"]);
    // The way carries the slider's weight and half of the strip's and the sensor's.
    let strip = 7630.0 * 20.32e-3 * 0.254e-3 * 152.4e-3;
    let weight = 9.80665 * (0.3 + 0.5 * (0.05 + strip));
    let force = &document["joints"]["way"]["force"];
    assert_close(force[2].as_f64().unwrap(), weight, 1e-7);
    assert!(number(&document, "slide") < 0.0 && number(&document, "sensor_height") < 0.0);
}

#[test]
fn the_wrench_of_the_half_ring_is_conserved_and_balances_its_grips() {
    let document = solved(&["half_ring.toml"]);
    let ring = &document["beams"]["ring"];
    let vectors = |field: &str| -> Vec<[f64; 3]> { serde_json::from_value(ring[field].clone()).unwrap() };
    let (positions, forces, moments) = (vectors("position"), vectors("force"), vectors("moment"));
    // Without distributed loads M + p x F is the same everywhere; here its y component.
    let about_y = |i: usize| moments[i][1] + positions[i][2] * forces[i][0] - positions[i][0] * forces[i][2];
    let torque = number(&document, "torque");
    for i in 0..positions.len() {
        assert_close(about_y(i), -torque, 1e-7 * torque.abs());
    }
}

/// Two shallow leaves that meet at an apex; pushed down, they snap through long before 60 N.
const SNAP: &str = r#"
format = 1
name = "snap"

[parameter]
push = "60 N"

[material.steel]
young = "207 GPa"
poisson = 0.3

[section.leaf]
shape = "rectangle"
width = "10 mm"
height = "0.5 mm"

[body.apex]
at = ["100 mm * cos(6 deg)", 0, "100 mm * sin(6 deg)"]

[beam.left]
material = "steel"
section = "leaf"
length = "100 mm"
start = { body = "ground", hold = "clamp", rotation = { axis = [0, 1, 0], angle = "-6 deg" } }
end = { body = "apex", hold = "clamp" }

[beam.right]
material = "steel"
section = "leaf"
length = "100 mm"
start = { body = "apex", hold = "clamp", rotation = { axis = [0, 1, 0], angle = "6 deg" } }
end = { body = "ground", hold = "clamp" }

[load.push]
body = "apex"
force = [0, 0, "-push"]

[output]
sink = "100 mm * sin(6 deg) - body.apex.position.z"
"#;

#[test]
fn a_load_past_a_fold_ends_with_code_one_and_still_writes_its_document() {
    let folder = folder("a_load_past_a_fold");
    let file = folder.join("snap.toml");
    std::fs::write(&file, SNAP).unwrap();
    let output = flexura().arg("solve").arg(&file).arg("--json").arg("-o").arg(&folder).output().unwrap();
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_ne!(document["status"], "converged");
    assert!(!document["reason"].as_str().unwrap().is_empty());
    let fraction = document["load_fraction"].as_f64().unwrap();
    assert!(fraction > 0.0 && fraction < 1.0, "{fraction}");
    assert!(stderr(&output).contains("not converged"), "{}", stderr(&output));
    let written: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.join("result.json")).unwrap()).unwrap();
    assert_eq!(written, document);

    let gentle = flexura().arg("solve").arg(&file).args(["--set", "push=5 N"]).output().unwrap();
    assert_eq!(code(&gentle), 0, "{}", stderr(&gentle));
}
