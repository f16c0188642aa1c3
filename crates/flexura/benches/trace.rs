//! Wall time of paths and of stability alone, printed as a table.
//!
//! `cargo bench -p flexura --bench trace` prints medians and the work of one run; `-- strip`, `-- branch`, `-- event`, `-- count` run
//! one kind. The path of the strip has about a hundred points, with the number of unstable directions at each.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::{document, median};
use flexura::model::{Model, StudyKind, TraceStudy};
use flexura::modelfile::Document;
use flexura::solution::{Status, Trace};
use flexura::{Options, Prepared, trace};

fn position(model: &Model, name: &str) -> usize {
    model.parameters.iter().position(|parameter| parameter.name == name).expect("a parameter")
}

fn follow(model: &Model, study: &TraceStudy) -> Trace {
    let options = Options { tolerance: 1e-8, ..Options::default() };
    let trace = trace(model, study, &options, &mut |_| {}).expect("a sound model");
    assert_eq!(trace.status, Status::Converged, "{:?}", trace.reason);
    trace
}

fn report(name: &str, mut run: impl FnMut() -> Trace) {
    let work = run().work;
    let seconds = median(|| {
        run();
    });
    println!(
        "| {name} | {:.2} ms | {} | {:.1} | {:.1} | {:.1} |",
        1e3 * seconds,
        work.points,
        work.factorisations as f64 / work.points as f64,
        work.residuals as f64 / work.points as f64,
        work.inertias as f64 / work.points as f64
    );
}

/// A strip between clamps, one of which slides and is pushed: along the push and its bow, and along its thickness.
fn strips(kind: &str) {
    let document = document("strip_on_slope.toml");
    let model = document.model(&[]).expect("a good model");
    let push = position(&model, "push");
    let mut study =
        TraceStudy { parameter: push, range: [0.0, 25.0], start: 0.0, steps: 90, ..TraceStudy::default() };
    if kind == "strip" {
        report("push of a strip", || follow(&model, &study));
        let thickness = position(&model, "height");
        let bent = document.model(&[("push".into(), "18".into())]).expect("a good model");
        let slimmer =
            TraceStudy { parameter: thickness, range: [0.254e-3, 0.2e-3], start: 0.254e-3, ..study };
        report("thickness of a strip", || follow(&bent, &slimmer));
        return;
    }
    let upright = [("slope".to_string(), "90 deg".to_string())];
    let model = document.model(&upright).expect("a good model");
    if kind == "branch" {
        study.branches = 1;
        study.steps = 40;
        report("upright strip with the branch that crosses", || follow(&model, &study));
        return;
    }
    let path = format!("{}/../../models/strip_on_slope.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a bundled model");
    let more = "[study.path]\nkind = \"trace\"\nparameter = \"push\"\nrange = [0, 25]\nevent = \"output.w = -push/100\"\n";
    let document = Document::parse(&format!("{text}\n{more}"), "strip.toml").expect("a good file");
    let model = document.model(&[]).expect("a good model");
    let StudyKind::Trace(study) = model.studies[0].kind.clone() else { return };
    report("strip with an event", || follow(&model, &study));
}

/// The number of unstable directions alone, at a solved state.
fn counts() {
    println!("| stability of | time |\n|---|---|");
    let cases = [
        ("a strip", "strip_on_slope.toml", "push", "18"),
        ("the six-rod robot", "six_rod_robot.toml", "z", "480 mm"),
        ("a lattice of 12 by 12 cells", "lattice.toml", "n", "12"),
        ("a lattice of 40 by 40 cells", "lattice.toml", "n", "40"),
    ];
    for (name, file, parameter, value) in cases {
        let overrides = [(parameter.to_string(), value.to_string())];
        let mut model = document(file).model(&overrides).expect("a good model");
        (model.unknowns, model.targets) = (Vec::new(), Vec::new());
        let mut prepared = Prepared::new(&model).expect("a sound model");
        assert_eq!(prepared.solve(1e-8, &mut |_| {}).status, Status::Converged, "{name}");
        let problem = prepared.problem();
        let seconds = median(|| {
            for _ in 0..10 {
                problem.stability().expect("a regular state");
            }
        });
        println!("| {name} | {:.1} µs |", 1e5 * seconds);
    }
}

fn main() {
    let only: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    println!(
        "| path | time | points | factorisations a point | residuals | counts |\n|---|---|---|---|---|---|"
    );
    for kind in ["strip", "branch", "event"] {
        if wanted(kind) {
            strips(kind);
        }
    }
    if wanted("count") {
        counts();
    }
}
