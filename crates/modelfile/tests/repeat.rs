//! Tables that stand for many.
#![allow(clippy::unwrap_used)]

use flexura_model::{Model, Mount};
use flexura_modelfile::Document;
use std::time::Instant;

const HEAD: &str = r#"
format = 1
[parameter]
cells = 3
[material.steel]
young = "207 GPa"
poisson = 0.3
[section.wire]
shape = "circle"
diameter = "1 mm"
"#;

const GRID: &str = r#"
[body."n_{i}_{j}"]
repeat = { i = "cells + 1", j = [1, 2] }
at = ["{i}*10 mm", "{j - 2}*10 mm", 0]

[beam."h_{i}_{j}"]
repeat = { i = "cells", j = [1, 2] }
material = "steel"
section = "wire"
length = "10 mm"
start = { body = "n_{i}_{j}", hold = "clamp" }
end = { body = "n_{i+1}_{j}", hold = "clamp" }

[joint."foot_{j}"]
repeat = { j = [1, 2] }
kind = "weld"
parent = { body = "ground", at = [0, "({j} - 2)*10 mm", 0] }
child = "n_0_{j}"
"#;

fn model(text: &str, overrides: &[(String, String)]) -> Model {
    Document::parse(text, "x.toml").unwrap().model(overrides).unwrap_or_else(|report| panic!("{report}"))
}

#[test]
fn every_combination_becomes_a_table_of_its_own() {
    let model = model(&format!("{HEAD}{GRID}"), &[]);
    let names: Vec<&str> = model.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["n_0_1", "n_0_2", "n_1_1", "n_1_2", "n_2_1", "n_2_2", "n_3_1", "n_3_2"]);
    let position = model.bodies[4].pose.position;
    assert_eq!([position.x, position.y], [0.02, -0.01]);
    assert_eq!((model.beams.len(), model.joints.len()), (6, 2));
    let last = model.beams.last().unwrap();
    assert_eq!(last.name, "h_2_2");
    assert!(matches!(last.end.as_ref().unwrap().mount, Mount::Body(id) if id.0 == 7));
}

#[test]
fn counts_follow_their_parameters_and_may_be_zero() {
    let text = format!("{HEAD}{GRID}");
    let cells = |count: &str| model(&text, &[("cells".to_string(), count.to_string())]);
    assert_eq!(cells("5").beams.len(), 10);
    assert_eq!((cells("0").beams.len(), cells("0").bodies.len()), (0, 2));
    let error = Document::parse(&text, "x.toml")
        .unwrap()
        .model(&[("cells".to_string(), "2.5".to_string())])
        .unwrap_err();
    assert!(error.to_string().contains("expected a whole number, found 3.5"), "{error}");
}

#[test]
fn a_finished_copy_is_found_where_its_template_stands() {
    let text = format!("{HEAD}{GRID}");
    let document = Document::parse(&text, "x.toml").unwrap();
    let problem = document.problem("beam.h_2_1.end.hold", "cannot be", None);
    assert_eq!(&text[problem.span.clone()], "\"clamp\"");
    assert!(text[..problem.span.start].ends_with("end = { body = \"n_{i+1}_{j}\", hold = "));
    let elsewhere = document.problem("beam.h_x_1", "cannot be", None);
    assert_eq!(&text[elsewhere.span], "beam");
}

#[test]
fn an_unused_template_is_one_warning() {
    let text = format!("{HEAD}{GRID}\n[body.\"spare_{{i}}\"]\nrepeat = {{ i = 50 }}\n");
    let warnings = Document::parse(&text, "x.toml").unwrap().warnings();
    let messages: Vec<&str> = warnings.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(messages, ["the body `spare_0` is never used and nothing holds or loads it (for i = 0)"]);
}

#[test]
fn twenty_thousand_copies_take_well_under_a_second() {
    let text = format!("{HEAD}{GRID}").replace("[1, 2]", "100");
    let begin = Instant::now();
    let model = model(&text, &[("cells".to_string(), "100".to_string())]);
    let time = begin.elapsed();
    assert_eq!((model.beams.len(), model.bodies.len(), model.joints.len()), (10_000, 10_100, 100));
    println!("{time:?}");
    assert!(time.as_secs_f64() < 2.0, "{time:?}");
}

#[test]
fn the_same_mistake_in_every_copy_is_told_once_and_quickly() {
    let text =
        format!("{HEAD}{GRID}").replace("[1, 2]", "100").replace("\"wire\"\nlength", "\"wird\"\nlength");
    let begin = Instant::now();
    let report = Document::parse(&text, "x.toml")
        .unwrap()
        .model(&[("cells".to_string(), "100".to_string())])
        .unwrap_err();
    assert_eq!((report.problems().len(), report.omitted()), (1, 0));
    let message = &report.problems()[0].message;
    assert_eq!(message, "there is no section `wird` (for i = 0, j = 0; and so in 9999 more copies)");
    assert!(begin.elapsed().as_secs_f64() < 2.0);
}

#[test]
fn a_name_that_every_copy_misses_is_told_once_and_quickly() {
    let text = format!("{HEAD}{GRID}")
        .replace("[1, 2]", "100")
        .replace("body = \"n_{i+1}_{j}\"", "body = \"m_{i}_{j}\"");
    let begin = Instant::now();
    let report = Document::parse(&text, "x.toml")
        .unwrap()
        .model(&[("cells".to_string(), "100".to_string())])
        .unwrap_err();
    assert_eq!(report.problems().len(), 1);
    assert!(begin.elapsed().as_secs_f64() < 2.0);
}

#[test]
fn copies_that_would_not_fit_into_memory_are_refused() {
    let points = "[0, 0, 0], ".repeat(10_000);
    let text = format!(
        "{HEAD}[beam.\"b_{{i}}\"]\nrepeat = {{ i = 100000 }}\nsection = \"wire\"\nmaterial = \"steel\"\n\
         curve = {{ kind = \"points\", points = [{points}] }}\n"
    );
    let report = Document::parse(&text, "x.toml").unwrap().model(&[]).unwrap_err();
    assert!(report.problems()[0].message.starts_with("the copies of this table would hold"), "{report}");
}
