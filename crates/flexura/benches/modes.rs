//! Wall time of natural modes, printed as a table.
//!
//! `cargo bench -p flexura --bench modes` prints medians; `-- cantilever`, `-- robot`, `-- guide` run one kind. Each time is that of
//! the study alone, the file read and the model built.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use flexura::model::{Model, ModesPath, ModesStudy, TraceStudy};
use flexura::modelfile::Document;
use flexura::solution::Trace;
use flexura::{Options, modes, modes_along, trace};
use std::time::Instant;

/// A bundled model, of steel.
fn read(file: &str, overrides: &[(&str, &str)]) -> Model {
    let path = format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR"));
    let overrides: Vec<_> =
        overrides.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
    let mut model = Document::read(path).expect("a bundled model").model(&overrides).expect("a good model");
    model.materials.iter_mut().for_each(|material| material.density = Some(7850.0));
    (model.unknowns, model.targets) = (Vec::new(), Vec::new());
    model
}

/// Median of seconds over some runs, after one to warm up.
fn median(mut run: impl FnMut()) -> f64 {
    run();
    let mut times: Vec<f64> = (0..9)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn about(name: &str, model: &Model, study: &ModesStudy) {
    let options = Options::default();
    let found = modes(model, study, &options, &mut |_| {}).expect("a sound model");
    let seconds = median(|| {
        modes(model, study, &options, &mut |_| {}).expect("a sound model");
    });
    let worst = found.modes.iter().map(|mode| mode.error_estimate).fold(0.0, f64::max);
    let [elements, order] = found.elements;
    println!(
        "| {name} | {:.2} ms | {} | {elements} of order {order} | {worst:.0e} |",
        1e3 * seconds,
        found.modes.len()
    );
}

/// Three frequencies at each of a hundred points of the travel of a parallel guide, and its path alone.
fn guide() {
    let model = read("parallelogram_stage.toml", &[]);
    let options = Options::default();
    let path = ModesPath { parameter: 0, range: [0.0, 40.0], steps: 99 };
    let study = ModesStudy { count: 3, at_rest: false, path: Some(path) };
    let alone = TraceStudy { parameter: 0, range: path.range, steps: path.steps, ..TraceStudy::default() };
    let points = |trace: &Trace| trace.branches.iter().map(|branch| branch.points.len()).sum::<usize>();
    let run = || modes_along(&model, &study, path, &options, &mut |_| {}).expect("a sound model");
    let bare = || trace(&model, &alone, &options, &mut |_| {}).expect("a sound model");
    let [with, without] = [median(|| drop(run())), median(|| drop(bare()))];
    println!(
        "\n| path of the parallel guide | alone, {} points | with three frequencies, {} points | ratio |\n|---|---|---|---|\n| | {:.1} ms | {:.1} ms | {:.1} |",
        points(&bare()),
        points(&run().trace),
        1e3 * without,
        1e3 * with,
        with / without
    );
}

fn main() {
    let only: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    println!("| modes of | time | modes | elements | error |\n|---|---|---|---|---|");
    if wanted("cantilever") {
        let model = read("ends_cantilever.toml", &[]);
        let rest = ModesStudy { count: 6, at_rest: true, path: None };
        about("a cantilever at rest", &model, &rest);
        about("a cantilever under its load", &model, &ModesStudy { at_rest: false, ..rest });
    }
    if wanted("robot") {
        about("the six-rod platform", &read("six_rod_robot.toml", &[]), &ModesStudy::default());
    }
    if wanted("guide") {
        guide();
    }
}
