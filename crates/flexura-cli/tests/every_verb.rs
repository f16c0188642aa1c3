//! Every verb on every bundled model: an answer or a refusal in words, never a panic.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{bundled, code, models, run, stderr, stdout};
use flexura::modelfile::Document;

/// A parameter that a study may vary, as text: its name, its value, and one that is a little larger.
fn parameter(file: &str) -> Option<(String, String, String)> {
    let model = Document::read(models().join(file)).unwrap().model(&[]).unwrap();
    let is_unknown = |position: usize| model.unknowns.iter().any(|unknown| unknown.parameter == position);
    let (_, parameter) = model.parameters.iter().enumerate().find(|(position, _)| !is_unknown(*position))?;
    let text = |value: f64| format!("{value:e} {}", parameter.unit);
    let more = if parameter.value == 0.0 { 1e-3 } else { 1.02 * parameter.value };
    Some((parameter.name.clone(), text(parameter.value), text(more)))
}

/// Runs a verb on every model; `arguments` of a model, or None where the verb does not apply.
fn each(verb: &str, arguments: impl Fn(&str) -> Option<Vec<String>>) {
    for file in bundled() {
        let Some(further) = arguments(&file) else { continue };
        let mut all = vec![verb, file.as_str()];
        all.extend(further.iter().map(String::as_str));
        let output = run(&all);
        let said = format!("{all:?}\n{}{}", stdout(&output), stderr(&output));
        assert!((0..=2).contains(&code(&output)), "{said}");
        assert!(!said.contains("NaN") && !said.contains("inf "), "{said}");
    }
}

fn varied(flag: &str, file: &str) -> Option<Vec<String>> {
    let (name, from, to) = parameter(file)?;
    Some(vec![flag.to_owned(), format!("{name}={from},{to}")])
}

#[test]
fn check_answers() {
    each("check", |_| Some(Vec::new()));
}

#[test]
fn solve_answers() {
    each("solve", |_| Some(Vec::new()));
}

#[test]
fn sweep_answers() {
    each("sweep", |file| varied("--vary", file));
}

#[test]
fn trace_answers() {
    each("trace", |file| {
        let (name, from, to) = parameter(file)?;
        let flags = ["--parameter", &name, "--range", &format!("{from}:{to}"), "--steps", "3"];
        Some(
            flags.iter().map(|flag| (*flag).to_owned()).chain(["--most-points".into(), "8".into()]).collect(),
        )
    });
}

#[test]
fn buckle_answers_about_the_whole_load() {
    each("buckle", |_| Some(Vec::new()));
}

#[test]
fn buckle_answers_about_a_parameter() {
    each("buckle", |file| {
        let (name, from, _) = parameter(file)?;
        Some(["--parameter", &name, "--at", &from].iter().map(|flag| (*flag).to_owned()).collect())
    });
}

/// Studies that take many seconds; they are run where their pictures are made.
const LONG: [&str; 6] = [
    "column_on_foundation.toml",
    "knee_ellipses.toml",
    "knee_exoskeleton.toml",
    "knee_leg.toml",
    "shallow_arch.toml",
    "strip_on_slope.toml",
];

#[test]
fn run_answers() {
    each("run", |file| (!LONG.contains(&file)).then(Vec::new));
}

/// Rigid mechanisms that a drive leads, and such as beams hold without a load on them.
#[test]
fn what_cannot_buckle_is_said_to() {
    for (file, why) in [
        ("ellipse_on_circle.toml", "nothing in it can buckle"),
        ("rigid_four_bar.toml", "no value is critical"),
        ("coracoid_keel.toml", "nothing in it can buckle"),
    ] {
        let output = run(&["buckle", file]);
        assert_eq!(code(&output), 0, "{file}: {}", stderr(&output));
        assert!(stderr(&output).contains(why), "{file}: {}{}", stdout(&output), stderr(&output));
        assert!(stdout(&output).contains("no critical value was found"), "{file}: {}", stdout(&output));
    }
}

#[test]
fn modes_answers() {
    each("modes", |_| Some(vec!["--count".into(), "3".into()]));
}
