//! Wall time of `flexura solve` as a whole process on a small model: start, read, solve, print.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use std::process::{Command, Stdio};
use std::time::Instant;

fn main() {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/cantilever_strip.toml");
    let mut times: Vec<f64> = (0..60)
        .map(|_| {
            let start = Instant::now();
            let status = Command::new(env!("CARGO_BIN_EXE_flexura"))
                .args(["solve", model])
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status();
            assert!(status.is_ok_and(|s| s.success()), "solve {model}");
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("| case | time |\n|---|---|");
    println!("| flexura solve, small model, whole process | {:.2} ms |", times[times.len() / 2] * 1e3);
}
