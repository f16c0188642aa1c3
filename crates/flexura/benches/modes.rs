//! Wall time of natural modes, printed as a table.
//!
//! `cargo bench -p flexura --bench modes` prints medians; `-- cantilever`, `-- robot`, `-- guide` run one kind. Each time is that of
//! the study alone, the file read and the model built.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::{median, read};
use flexura::model::{Model, ModesPath, ModesStudy, TraceStudy};
use flexura::solution::Trace;
use flexura::{Options, modes, modes_along, trace};

/// A bundled model, of steel, with nothing unknown.
fn steel(file: &str) -> Model {
    let mut model = read(file);
    model.materials.iter_mut().for_each(|material| material.density = Some(7850.0));
    (model.unknowns, model.targets) = (Vec::new(), Vec::new());
    model
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
    let model = steel("parallelogram_stage.toml");
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
        let model = steel("ends_cantilever.toml");
        let rest = ModesStudy { count: 6, at_rest: true, path: None };
        about("a cantilever at rest", &model, &rest);
        about("a cantilever under its load", &model, &ModesStudy { at_rest: false, ..rest });
    }
    if wanted("robot") {
        about("the six-rod platform", &steel("six_rod_robot.toml"), &ModesStudy::default());
    }
    if wanted("guide") {
        guide();
    }
}
