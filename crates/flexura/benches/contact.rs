//! Wall time of mechanisms with rolling and contact joints, from rest, preparation included, printed as a table.
//!
//! `cargo bench -p flexura --bench contact` prints medians.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Options, solve};
use std::hint::black_box;
use std::time::Instant;

fn read(file: &str) -> Model {
    let document = Document::read(format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR")));
    document.and_then(|document| document.model(&[])).expect("a bundled model")
}

/// Median of seconds of one call, over some runs of `times` calls, after one to warm up.
fn median(times: usize, mut call: impl FnMut()) -> f64 {
    let mut run = || {
        let start = Instant::now();
        (0..times).for_each(|_| call());
        start.elapsed().as_secs_f64() / times as f64
    };
    run();
    let mut seconds: Vec<f64> = (0..9).map(|_| run()).collect();
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

fn main() {
    println!("| mechanism | time |");
    println!("|---|---|");
    for file in [
        "ellipse_on_circle.toml",
        "cam_follower.toml",
        "rolling_beam.toml",
        "coracoid_keel.toml",
        "ellipsoid_in_dish.toml",
        "wing.toml",
    ] {
        let model = read(file);
        let seconds = median(10, || {
            let solution = solve(&model, &Options::default(), &mut |_| {}).expect("a sound model");
            assert_eq!(solution.status, Status::Converged, "{file}");
            black_box(solution);
        });
        println!("| `{file}` | {:.2} ms |", 1e3 * seconds);
    }
}
