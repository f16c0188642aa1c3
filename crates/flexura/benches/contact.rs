//! Wall time of mechanisms with rolling and contact joints, from rest, preparation included, printed as a table.
//!
//! `cargo bench -p flexura --bench contact` prints medians.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::{median, read};
use flexura::solution::Status;
use flexura::{Options, solve};
use std::hint::black_box;

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
        let seconds = median(|| {
            let solution = solve(&model, &Options::default(), &mut |_| {}).expect("a sound model");
            assert_eq!(solution.status, Status::Converged, "{file}");
            black_box(solution);
        });
        println!("| `{file}` | {:.2} ms |", 1e3 * seconds);
    }
}
