//! Wall time of larger mechanisms, printed as tables: the six-rod robot, and lattices from 10 to 10,000 beams.
//!
//! `cargo bench -p flexura --bench large`; `-- robot`, `-- planar`, `-- spatial` run one of the tables. The exponent is
//! the slope of the logarithms between the first and the last lattice of at least 300 beams.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

mod common;

use common::document;
use flexura::model::{Curve, Model};
use flexura::solution::Status;
use flexura::{Prepared, ProblemError};
use std::time::Instant;

const TOLERANCE: f64 = 1e-6;

fn main() {
    let only: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    if wanted("robot") {
        robot();
    }
    if wanted("planar") {
        lattices("planar", "lattice.toml", &[2, 4, 10, 15, 23, 36, 71]);
    }
    if wanted("spatial") {
        lattices("spatial", "lattice_3d.toml", &[2, 4, 6, 8, 11, 15]);
    }
}

/// The plate from (0, .02, .48) to (0, .12, .58) in 100 steps, there and back: inverse, then forward with the lengths found.
fn robot() {
    const STEPS: usize = 100;
    let base = document("six_rod_robot.toml").model(&[]).expect("a good model");
    let rods = base.unknowns.clone();
    let at = |model: &mut Model, lengths: &[(usize, f64)], step: usize| {
        let part = step as f64 / STEPS as f64;
        model.targets[1].value = 0.02 + 0.1 * part;
        model.targets[2].value = 0.48 + 0.1 * part;
        for (parameter, length) in lengths {
            model.parameters[*parameter].value = *length;
            let rod = rods.iter().position(|u| u.parameter == *parameter).expect("a length");
            model.beams[rod].curve = Curve::Straight { length: *length };
        }
    };
    let lengths_of = |model: &Model| -> Vec<(usize, f64)> {
        rods.iter().map(|u| (u.parameter, model.parameters[u.parameter].value)).collect()
    };
    let time = Instant::now();
    let mut cold = Prepared::new(&base).expect("a sound model");
    let forward = cold.solve(TOLERANCE, &mut |_| {});
    let forward_cold = time.elapsed().as_secs_f64();
    assert_eq!(forward.status, Status::Converged);

    let mut step = 0;
    let mut inverse = cold.clone();
    let time = Instant::now();
    let mut family = |values: &[(usize, f64)]| -> Result<Model, ProblemError> {
        let mut model = base.clone();
        at(&mut model, values, 0);
        Ok(model)
    };
    assert_eq!(inverse.solve_inverse(&mut family, TOLERANCE, &mut |_| {}).status, Status::Converged);
    let inverse_cold = time.elapsed().as_secs_f64();
    let mut all = vec![lengths_of(inverse.model())];
    let time = Instant::now();
    while step < STEPS {
        step += 1;
        let here = step;
        let mut family = |values: &[(usize, f64)]| -> Result<Model, ProblemError> {
            let mut model = base.clone();
            at(&mut model, values, here);
            Ok(model)
        };
        let outcome = inverse.solve_inverse_from_here(&mut family, TOLERANCE);
        assert_eq!(outcome.status, Status::Converged, "{:?}", outcome.reason);
        all.push(lengths_of(inverse.model()));
    }
    let inverse_warm = time.elapsed().as_secs_f64() / STEPS as f64;

    let mut forward = cold;
    let mut model = base.clone();
    let mut worst = 0.0_f64;
    let mut rates = Vec::new();
    for round in 0..20 {
        let time = Instant::now();
        for k in 0..=STEPS {
            let k = if round % 2 == 0 { k } else { STEPS - k };
            at(&mut model, &all[k], k);
            forward.adopt(&model).expect("the same parts");
            assert_eq!(forward.solve_from_here(TOLERANCE, &mut |_| {}).status, Status::Converged);
        }
        rates.push((STEPS + 1) as f64 / time.elapsed().as_secs_f64());
    }
    for (k, lengths) in all.iter().enumerate() {
        at(&mut model, lengths, k);
        forward.adopt(&model).expect("the same parts");
        forward.solve_from_here(TOLERANCE, &mut |_| {});
        let plate = forward.problem().sampled(2, false, |_| false).bodies[0].position;
        let wanted = [0.0, model.targets[1].value, model.targets[2].value];
        worst = wanted.iter().zip(plate.iter()).map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    rates.sort_by(f64::total_cmp);
    println!("six-rod robot, tolerance {TOLERANCE:.0e}");
    println!("  forward, from rest            {:9.1} us", forward_cold * 1e6);
    println!("  inverse, from a guess         {:9.1} us", inverse_cold * 1e6);
    println!("  inverse, warm step            {:9.1} us", inverse_warm * 1e6);
    println!("  forward, warm steps           {:9.0} a second (median of 20 rounds)", rates[rates.len() / 2]);
    println!("  forward of inverse, off by    {worst:9.1e} m");
}

fn lattices(name: &str, path: &str, sizes: &[usize]) {
    let document = document(path);
    println!("{name} lattice, tolerance {TOLERANCE:.0e}");
    println!("    n   beams  unknowns   read ms  prepare ms   solve ms   peak MiB");
    let mut rows = Vec::new();
    for n in sizes {
        let time = Instant::now();
        let model = document.model(&[("n".to_owned(), n.to_string())]).expect("a good model");
        let reading = time.elapsed().as_secs_f64();
        let time = Instant::now();
        let mut prepared = Prepared::new(&model).expect("a sound model");
        let preparing = time.elapsed().as_secs_f64();
        let time = Instant::now();
        let outcome = prepared.solve(TOLERANCE, &mut |_| {});
        let solving = time.elapsed().as_secs_f64();
        assert_eq!(outcome.status, Status::Converged, "{:?}", outcome.reason);
        let unknowns: usize = prepared.problem().census().unknowns.iter().map(|(_, count)| count).sum();
        let memory = peak_memory();
        println!(
            "{n:5} {:7} {unknowns:9} {:9.1} {:11.1} {:10.1} {memory:10.1}",
            model.beams.len(),
            reading * 1e3,
            preparing * 1e3,
            solving * 1e3
        );
        rows.push((model.beams.len() as f64, preparing + solving, memory));
    }
    let large: Vec<_> = rows.iter().filter(|row| row.0 >= 250.0).collect();
    if let (Some(first), Some(last)) = (large.first(), large.last()) {
        let slope = |a: f64, b: f64| (b / a).ln() / (last.0 / first.0).ln();
        println!(
            "  exponent of time {:.2}, of memory {:.2} ({:.0} to {:.0} beams)",
            slope(first.1, last.1),
            slope(first.2, last.2),
            first.0,
            last.0
        );
    }
}

/// Largest memory of this process so far, MiB; sizes run from small to large, so it belongs to the last one.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|l| l.trim().split(' ').next()).and_then(|n| n.parse::<f64>().ok());
    kib.unwrap_or(f64::NAN) / 1024.0
}
