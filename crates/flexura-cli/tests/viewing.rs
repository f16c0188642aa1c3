//! The page that shows a result.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{bundled, code, folder, run, stderr, stdout};
use serde_json::Value;
use std::path::Path;

fn shown(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn is_page(path: &Path) -> bool {
    let text = std::fs::read_to_string(path).unwrap();
    text.starts_with("<!doctype html>") && !text.contains("@flexura-document@")
}

#[test]
fn every_study_writes_its_page_where_it_is_asked_to() {
    let folder = folder("every_study_writes_its_page");
    let page = folder.join("page.html");
    let studies: [&[&str]; 4] = [
        &["solve", "cantilever_strip.toml"],
        &["trace", "elastica.toml", "--parameter", "force", "--range", "0 N:10 N"],
        &["run", "rigid_four_bar.toml"],
        &["sweep", "cantilever_strip.toml", "--vary", "payload=10 g:50 g:3"],
    ];
    for study in studies {
        let _ = std::fs::remove_file(&page);
        let output = run(&[study, &["--report", shown(&page)]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(is_page(&page), "{study:?}");
        assert!(stderr(&output).contains("wrote ") && stderr(&output).contains("page.html"), "{study:?}");
    }
}

#[test]
fn every_study_draws_a_still_picture_as_svg_and_as_png() {
    let folder = folder("every_study_draws_a_still_picture");
    let (svg, png) = (folder.join("picture.svg"), folder.join("picture.png"));
    let studies: [(&[&str], &[&str]); 6] = [
        (&["solve", "tendon_robot.toml"], &[">backbone<", ">gripper", ">tendon_1<", "isometric view"]),
        (
            &["trace", "elastica.toml", "--parameter", "force", "--range", "0 N:10 N"],
            &["equilibria as force changes", "shapes as force changes"],
        ),
        (&["buckle", "euler_clamped_pinned.toml", "--parameter", "push"], &["critical values of push"]),
        (&["run", "rigid_four_bar.toml"], &["in time"]),
        (&["sweep", "cantilever_strip.toml", "--vary", "payload=10 g:50 g:3"], &["3 samples", "payload / g"]),
        (&["solve", "lee_frame.toml", "--set", "load=2.5"], &["not converged, stalled"]),
    ];
    for (study, words) in studies {
        let output = run(&[study, &["--svg", shown(&svg), "--png", shown(&png)]].concat());
        let converges = !words[0].starts_with("not converged");
        assert_eq!(code(&output), i32::from(!converges), "{}", stderr(&output));
        let text = std::fs::read_to_string(&svg).unwrap();
        for word in words {
            assert!(text.contains(word), "{study:?}: {word}");
        }
        let bytes = std::fs::read(&png).unwrap();
        assert!(bytes.starts_with(b"\x89PNG"), "{study:?}");
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        let side = |name: &str| -> f64 {
            let (_, rest) = text.split_once(&format!(" {name}=\"")).unwrap();
            rest.split_once('"').unwrap().0.parse().unwrap()
        };
        assert_eq!([number(16), number(20)].map(f64::from), [2.0 * side("width"), 2.0 * side("height")]);
        for path in [&svg, &png] {
            std::fs::remove_file(path).unwrap();
        }
    }
}

/// The numbers of a drawing, and what stands between them.
fn parts(svg: &str) -> (Vec<f64>, String) {
    let is_number = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let numbers = svg.split(|c| !is_number(c)).filter_map(|number| number.parse().ok()).collect();
    (numbers, svg.chars().filter(|c| !is_number(*c)).collect())
}

/// Rest shapes are read between the places at which a document tells them: pixels may differ by parts of one.
#[test]
fn a_kept_result_is_drawn_as_it_was_when_it_was_found() {
    let folder = folder("a_kept_result_is_drawn");
    let (svg, again, png) = (folder.join("a.svg"), folder.join("b.svg"), folder.join("b.png"));
    let result = folder.join("result.json");
    let studies: [&[&str]; 11] = [
        &["run", "lee_frame.toml"],
        &["solve", "tendon_robot.toml", "--set", "pull_1=3 N"],
        &["solve", "six_rod_robot.toml"],
        &["solve", "curved_hook.toml"],
        &["solve", "concentric_tubes.toml"],
        &["solve", "lee_frame.toml", "--set", "load=2.5"],
        &["trace", "lee_frame.toml", "--parameter", "load", "--range", "0:2.5"],
        &["trace", "euler_clamped_pinned.toml", "--parameter", "length", "--range", "200 mm:250 mm"],
        &["buckle", "euler_clamped_pinned.toml", "--parameter", "push"],
        &["run", "rigid_four_bar.toml"],
        &["sweep", "cantilever_strip.toml", "--vary", "payload=10 g:50 g:3"],
    ];
    for study in studies {
        let output = run(&[study, &["--svg", shown(&svg), "--json"]].concat());
        std::fs::write(&result, &output.stdout).unwrap();
        let output = run(&["view", shown(&result), "--svg", shown(&again), "--png", shown(&png)]);
        assert_eq!(code(&output), 0, "{study:?}: {}", stderr(&output));
        assert!(!folder.join("result.html").exists());
        assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
        let [first, second] = [&svg, &again].map(|path| parts(&std::fs::read_to_string(path).unwrap()));
        assert_eq!(first.1, second.1, "{study:?}");
        let far = first.0.iter().zip(&second.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(first.0.len() == second.0.len() && far < 0.3, "{study:?}: {far} px");
    }
}

#[test]
fn a_result_without_its_model_file_is_not_drawn_again() {
    let file = folder("without_its_model_file").join("result.json");
    std::fs::write(&file, r#"{"flexura": "0", "study": "solve"}"#).unwrap();
    let output = run(&["view", shown(&file), "--svg", shown(&file.with_extension("svg"))]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("does not hold its model file"), "{}", stderr(&output));
}

#[test]
fn a_live_page_holds_one_result_or_several() {
    let folder = folder("a_live_page");
    let page = folder.join("live.html");
    let output = run(&["solve", "cantilever_strip.toml", "--live", "--report", shown(&page)]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(
        text.contains("'wasm-unsafe-eval'") && !text.contains("@flexura-solver@") && text.len() < 4_000_000
    );
    for model in ["elastica", "lee_frame"] {
        let into = folder.join(model);
        let output = run(&["solve", &format!("{model}.toml"), "--live", "--quiet", "-o", shown(&into)]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(std::fs::read_to_string(into.join("report.html")).unwrap().contains("'wasm-unsafe-eval'"));
    }
    let results = ["elastica", "lee_frame"].map(|model| folder.join(model).join("result.json"));
    let both = ["view", shown(&results[0]), shown(&results[1]), "--no-open", "-o", shown(&page)];
    assert_eq!(code(&run(&both)), 2);
    let output = run(&[&both[..], &["--live"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let output = run(&["solve", "cantilever_strip.toml", "--live"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("say where to write that: --report FILE"), "{}", stderr(&output));
}

/// What our drawings are made of is known to the room that turns them into pixels.
#[test]
fn the_picture_of_every_example_can_be_turned_into_pixels() {
    let png = folder("the_picture_of_every_example").join("picture.png");
    for model in bundled().iter().filter(|model| !model.starts_with("lattice")) {
        let output = run(&["solve", model, "--quiet", "--png", shown(&png)]);
        assert!([0, 1].contains(&code(&output)), "{model}: {}", stderr(&output));
        assert!(png.metadata().unwrap().len() > 2000, "{model}");
    }
}

/// A length that is varied changes rest shapes and supports: each sample is drawn as its own mechanism.
#[test]
fn a_state_whose_mechanism_differs_from_the_first_tells_its_own_scene() {
    let model = folder("own_scene").join("model.toml");
    let text = std::fs::read_to_string(common::models().join("euler_clamped_pinned.toml")).unwrap();
    std::fs::write(&model, text).unwrap();
    let document = |words: &[&str]| -> Value {
        let output = run(&[words, &["--json"]].concat());
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let length = |scene: &Value| {
        let s = scene["beams"]["column"]["s"].as_array()?;
        s.last()?.as_f64()
    };
    let swept = document(&["sweep", shown(&model), "--vary", "length=100 mm:300 mm:3", "--set", "push=1"]);
    assert!((length(&swept["scene"]).unwrap() - 0.1).abs() < 1e-12);
    assert!(swept["samples"][0].get("scene").is_none());
    for (sample, wanted) in [(1, 0.2), (2, 0.3)] {
        assert!((length(&swept["samples"][sample]["scene"]).unwrap() - wanted).abs() < 1e-9, "{sample}");
    }
    let traced = document(&["trace", shown(&model), "--parameter", "length", "--range", "200 mm:250 mm"]);
    let points = traced["branches"][0]["points"].as_array().unwrap();
    for point in points.iter().filter(|point| point["beams"].is_object() || point["shape"].is_object()) {
        let parameter = point["parameter"].as_f64().unwrap();
        let own = length(&point["scene"]).or(length(&traced["scene"])).unwrap();
        assert!((own - parameter).abs() < 1e-7, "{own} {parameter}");
    }
    // Loads that differ are told as loads.
    let pushed = document(&["sweep", shown(&model), "--vary", "push=1:3:3"]);
    assert!(pushed["samples"].as_array().unwrap().iter().all(|sample| sample.get("scene").is_none()));
}

#[test]
fn equilibria_beside_the_one_from_rest_carry_their_shapes() {
    let output = run(&["solve", "bistable_beam.toml", "--set", "travel=2 mm", "--guesses", "12", "--json"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let equilibria = document["equilibria"].as_array().unwrap();
    assert!(equilibria.len() > 1);
    for own in equilibria {
        assert_eq!(
            own["shape"]["bodies"].as_object().unwrap().len(),
            own["bodies"].as_object().unwrap().len()
        );
        assert!(own["shape"]["beams"]["leaf"]["position"].is_array());
    }
}

#[test]
fn a_page_is_refused_before_the_work_where_it_cannot_be_written() {
    let folder = folder("a_page_is_refused");
    let paths = [folder.join("missing/page.html"), folder.clone()];
    for (path, flag) in paths.iter().flat_map(|path| ["--report", "--svg", "--png"].map(|flag| (path, flag)))
    {
        let output = run(&["solve", "cantilever_strip.toml", flag, shown(path)]);
        assert_eq!(code(&output), 3, "{}", stderr(&output));
        assert!(
            stdout(&output).is_empty() && stderr(&output).contains("cannot write"),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn an_earlier_result_is_viewed() {
    let folder = folder("an_earlier_result");
    assert_eq!(code(&run(&["solve", "cantilever_strip.toml", "--quiet", "-o", shown(&folder)])), 0);
    let output = run(&["view", shown(&folder.join("result.json")), "--no-open"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(is_page(&folder.join("result.html")));
}

#[test]
fn what_is_no_result_is_not_viewed() {
    let folder = folder("what_is_no_result");
    let file = folder.join("other.json");
    std::fs::write(&file, "{\"a\": 1}").unwrap();
    let output = run(&["view", shown(&file), "--no-open"]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("this is no result document: it has no key `flexura`"),
        "{}",
        stderr(&output)
    );
    let output = run(&["view", shown(&folder), "--no-open"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("name a result.json"), "{}", stderr(&output));
    assert_eq!(code(&run(&["view", shown(&folder.join("missing.json")), "--no-open"])), 3);
}

/// Along the path of a cantilever every regular point has a shape, with fewer sections than the states that are kept whole, and
/// the forces that act there.
#[test]
fn every_point_of_a_path_has_a_shape_and_its_loads() {
    let output = run(&["trace", "elastica.toml", "--parameter", "force", "--range", "0 N:10 N", "--json"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let points = document["branches"][0]["points"].as_array().unwrap();
    assert!(points.len() > 10);
    let name = document["scene"]["loads"].as_object().unwrap().keys().next().unwrap().clone();
    for point in points {
        let state = if point["beams"].is_object() { point } else { &point["shape"] };
        let (_, beam) = state["beams"].as_object().unwrap().iter().next().unwrap();
        assert!(beam["s"].as_array().unwrap().len() >= 17);
        let force = point["parameter"].as_f64().unwrap();
        let load = point["loads"].get(&name).unwrap_or(&document["scene"]["loads"][&name]);
        let size: f64 = load["force"].as_array().unwrap().iter().map(|c| c.as_f64().unwrap().powi(2)).sum();
        assert!((size.sqrt() - force.abs()).abs() < 1e-9 * (1.0 + force.abs()), "{size} {force}");
    }
}
