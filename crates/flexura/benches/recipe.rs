//! The thesis's own multiple shooting beside flexura, on the thesis's own example: the laminate of 5.3.1 with 50 g at its tip.
//!
//! `cargo bench -p flexura --bench recipe` prints medians of both in one run, and their ratio. The thesis took 95 s.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::median;
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
    let path = format!("{}/../../models/node_laminate.toml", env!("CARGO_MANIFEST_DIR"));
    let values = [("holder", "20.32 mm"), ("holes", "0"), ("u_arm", "0 mm")];
    let values = values.map(|(name, value)| (name.to_string(), value.to_string()));
    let model = Document::read(path).expect("a bundled model").model(&values).expect("a good model");
    let options = Options { tolerance: 1e-9, ..Options::default() };
    let ours = || {
        let solution = solve(&model, &options, &mut |_| {}).expect("a sound model");
        assert_eq!(solution.status, Status::Converged);
        solution
    };
    let own = median(|| {
        black_box(ours());
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
    println!("| flexura, all of a solve | {} | {:.2} ms | 1 |", ours().work.newton_steps, 1e3 * own);
}
