//! The thesis's own multiple shooting beside flexura, on the thesis's own example: the laminate of 5.3.1 with 50 g at its tip.
//!
//! `cargo bench -p flexura --bench recipe` prints medians of both in one run, and their ratio. The thesis took 95 s.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::median;
use flexura::model::{Model, Shape};
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::spatial::Vector3;
use flexura::{Options, solve};
use flexura_testkit::recipe::Recipe;
use std::hint::black_box;

const LENGTH: f64 = 0.1524;
const WIDTH: f64 = 20.32e-3;
const HEIGHT: f64 = 0.254e-3;
const GRAVITY: f64 = 9.80665;

fn main() {
    let bending = 207e9 * WIDTH * HEIGHT.powi(3) / 12.0;
    let weight = |mass: f64| Vector3::new(0.0, 0.0, -mass * GRAVITY * LENGTH * LENGTH / bending);
    let theirs = |factor: f64| {
        let recipe = Recipe {
            compliance: [1.0 / 1.52, 1.0, 1.0 / 6400.0],
            load: weight(7630.0 * WIDTH * HEIGHT * LENGTH),
            steps: 50,
            factor,
        };
        recipe.cantilever(weight(0.06), Vector3::zeros(), 1e-9, 200).expect("it gets there")
    };
    let formula = laminate(false);
    let plain = laminate(true);
    let options = Options { tolerance: 1e-9, ..Options::default() };
    let ours = |model: &Model| {
        let solution = solve(model, &options, &mut |_| {}).expect("a sound model");
        assert_eq!(solution.status, Status::Converged);
        solution
    };
    let [own, shaped] = [&plain, &formula].map(|model| {
        median(|| {
            black_box(ours(model));
        })
    });
    println!("| laminate of 5.3.1 | steps of Newton's method | time | over flexura's |\n|---|---|---|---|");
    for factor in [1.0, 0.5] {
        let time = median(|| {
            black_box(theirs(factor));
        });
        let steps = theirs(factor).iterations;
        println!(
            "| the thesis's recipe, α = {factor} | {steps} | {:.1} ms | {:.0} |",
            1e3 * time,
            time / own
        );
    }
    for (name, model, time) in
        [("a constant width", &plain, own), ("the width a formula with steep flanks", &formula, shaped)]
    {
        let steps = ours(model).work.newton_steps;
        println!("| flexura, all of a solve, {name} | {steps} | {:.2} ms | {:.1} |", 1e3 * time, time / own);
    }
}

/// The uniform laminate, whose width the model writes as a formula that could widen it for a holder; or as a number.
fn laminate(is_plain: bool) -> Model {
    let path = format!("{}/../../models/node_laminate.toml", env!("CARGO_MANIFEST_DIR"));
    let values = [("holder", "20.32 mm"), ("holes", "0"), ("u_arm", "0 mm")];
    let values = values.map(|(name, value)| (name.to_string(), value.to_string()));
    let mut model = Document::read(path).and_then(|file| file.model(&values)).expect("a good model");
    if is_plain {
        let section = model.beams[0].section;
        let Shape::Rectangle { width, .. } = &mut model.sections[section.0].shape else {
            unreachable!("it is one")
        };
        *width = WIDTH.into();
    }
    model
}
