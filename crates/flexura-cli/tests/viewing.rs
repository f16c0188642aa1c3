//! The page that shows a result.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, folder, run, stderr, stdout};
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
fn a_page_is_refused_before_the_work_where_it_cannot_be_written() {
    let folder = folder("a_page_is_refused");
    for path in [folder.join("missing/page.html"), folder.clone()] {
        let output = run(&["solve", "cantilever_strip.toml", "--report", shown(&path)]);
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
