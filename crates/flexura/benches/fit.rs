//! What fits cost beside the inverse problems that a formula would stand for. Run by hand: `cargo bench -p flexura --bench fit`.
#![allow(clippy::expect_used, clippy::print_stdout)]

mod common;

use common::median;
use flexura::model::{FitStudy, MeasuredRow, Measurements, Model, StudyKind};
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Evaluator, Options, Stepper, fit};
use std::hint::black_box;

const BONE: &str = r#"
format = 1
[parameter]
young = "2 GPa"
thickness = "3.2 mm"
pull = "1 N"
[material.bone]
young = "young"
poisson = 0.3
[section.oval]
shape = "ellipse"
width = "thickness"
height = "4.8 mm"
[beam.clavicle]
material = "bone"
section = "oval"
length = "30 mm"
start = { body = "ground", hold = "clamp" }
[load.wire]
beam = "clavicle"
at = 1
force = [0, "pull", 0]
[output]
tip = "beam.clavicle.end.displacement.y"
[study.bone]
kind = "fit"
unknown = ["young"]
data = { columns = ["pull [N]", "thickness [mm]", "tip [mm]", "specimen"], rows = [[1, 3, 0.1, "A"]] }
"#;

/// Eight specimens of fifty points, each of its own thickness, with 20 micrometres of noise.
fn bones(is_own: bool) -> (Model, FitStudy) {
    let model = Document::parse(BONE, "bone.toml").and_then(|file| file.model(&[])).expect("a good model");
    let StudyKind::Fit(mut study) = model.studies[0].kind.clone() else { unreachable!("it is a fit") };
    let mut evaluator = Evaluator::new(&model, &[], 1e-10).expect("a good model");
    let mut rows = Vec::new();
    let mut seed = 1_u32;
    for specimen in 0..8 {
        for i in 0..50 {
            let (pull, thickness) = (0.12 * f64::from(i + 1), (3.0 + 0.1 * specimen as f64) * 1e-3);
            let young = if is_own { (2.0 + 0.3 * specimen as f64) * 1e9 } else { 2.7816e9 };
            let answer = evaluator.at(&[(0, young), (1, thickness), (2, pull)], false).expect("sound values");
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = (f64::from(seed) / f64::from(u32::MAX) - 0.5) * 7e-5;
            let measured = vec![answer.values[0].map(|tip| tip + noise)];
            rows.push(MeasuredRow {
                line: rows.len() + 1,
                set: vec![pull, thickness],
                measured,
                specimen,
                weight: 1.0,
            });
        }
    }
    let specimens = ["A", "B", "C", "D", "E", "F", "G", "H"].map(String::from).to_vec();
    study.data = Measurements { rows, specimens, ..study.data };
    study.unknowns[0].is_per_specimen = is_own;
    (model, study)
}

fn fits() {
    println!(
        "| fit of eight specimens of fifty points | ms | solves | with derivatives | steps |\n|---|---|---|---|---|"
    );
    for (name, is_own) in [("one modulus", false), ("a modulus each", true)] {
        let (model, study) = bones(is_own);
        let mut work = None;
        let time = median(|| {
            let (found, _) = fit(&model, &study, &Options::default()).expect("a sound study");
            assert_eq!(found.status, Status::Converged);
            work = Some(found.work);
            black_box(&found);
        });
        if let Some(work) = work {
            println!(
                "| {name} | {:.1} | {} | {} | {} |",
                1e3 * time,
                work.solves,
                work.derivatives,
                work.iterations
            );
        }
    }
}

/// Steps of the inverse problem that the thesis's (5.5) stands for: the slide for a wanted deflection of the sensor.
fn inverse() {
    let path = format!("{}/../../models/sensor_clamp.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a bundled model");
    let text = text.split("[study").next().unwrap_or_default().replace("push = \"8 N\"", "low = \"-20 mm\"");
    let text = text.replace(
        "\n[output]",
        "\n[unknown.push]\nguess = \"10 N\"\n\n[target]\n\"beam.link[0.5].position.z\" = \"low\"\n\n[output]",
    );
    let model = Document::parse(&text, "sensor.toml").and_then(|file| file.model(&[])).expect("a good model");
    let mut stepper = Stepper::new(&model, &[], &["slide"], 1e-8).expect("an inverse problem");
    let mut out = [0.0];
    assert!(stepper.step(&[-20e-3], &mut out).is_converged());
    println!("\n| warm inverse steps of the pushed strip | a second |\n|---|---|");
    for (name, cycle) in [("5 mm up and down in 2000 steps", 2000), ("in 20,000 steps", 20_000)] {
        // The steepest part of it.
        let count = 1000;
        let time = median(|| {
            for i in (0..count).chain((0..count).rev()) {
                let low = -20e-3 - 5e-3 * (f64::from(i) / f64::from(cycle) * std::f64::consts::TAU).sin();
                assert!(stepper.step(&[low], &mut out).is_converged());
            }
            black_box(out);
        });
        println!("| {name} | {:.0} |", 2.0 * f64::from(count) / time);
    }
}

fn main() {
    fits();
    inverse();
}
