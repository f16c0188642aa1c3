//! What parameters cost: other values, sensitivities, a sample of a sweep, a warm inverse solve. Run by hand:
//! `cargo bench -p flexura --bench parameters`.
#![allow(clippy::expect_used, clippy::print_stdout)]

mod common;

use common::{document, median, read};
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Axis, Family, ModelFamily, Options, Prepared, Sweep, solve_model};
use std::hint::black_box;

/// Other values of the first parameter on which the mechanism depends: in place, as a checked model, by text.
fn values() {
    println!(
        "| other values of a parameter | rules | in place | a checked model | by text |\n|---|---|---|---|---|"
    );
    for file in ["sensor_clamp.toml", "cantilever_strip.toml", "six_rod_robot.toml", "wing_ligaments.toml"] {
        let document = document(file);
        let model = document.model(&[]).expect("a good model");
        let Some(position) = (0..model.parameters.len()).find(|i| model.depends_on(*i)) else { continue };
        let parameter = &model.parameters[position];
        let mut scratch = model.clone();
        let mut part = 0.0;
        let mut value = || {
            part = if part > 1e-3 { 0.0 } else { part + 1e-5 };
            parameter.value * (1.0 + part)
        };
        let set = median(|| {
            scratch.set(&[(position, value())]).expect("a sound value");
            black_box(&scratch);
        });
        let made = median(|| {
            black_box(ModelFamily::new(&model).model(&[(position, value())]).expect("a sound value"));
        });
        let text = median(|| {
            let overrides = [(parameter.name.clone(), format!("{:e} {}", value(), parameter.unit))];
            black_box(document.model(&overrides).expect("a sound value"));
        });
        println!(
            "| {file} | {} | {:.2} us | {:.1} us | {:.0} us |",
            model.bindings.iter().count(),
            1e6 * set,
            1e6 * made,
            1e6 * text
        );
    }
}

/// All sensitivities beside the solve that they belong to.
fn sensitivities() {
    println!(
        "\n| sensitivities | parameters | solve | with them | they cost, in solves |\n|---|---|---|---|---|"
    );
    for file in ["knee_leg.toml", "wing_ligaments.toml", "six_rod_robot.toml", "sensor_clamp.toml"] {
        let model = read(file);
        let plain = Options { samples: 2, ..Options::default() };
        let all = Options { sensitivities: true, ..plain.clone() };
        let time = |options: &Options| {
            median(|| {
                let (solution, _) = solve_model(&model, options, &mut |_| {}).expect("a sound model");
                assert_eq!(solution.status, Status::Converged);
                black_box(solution);
            })
        };
        let (plain, all) = (time(&plain), time(&all));
        let count = (0..model.parameters.len()).filter(|i| model.depends_on(*i)).count();
        println!(
            "| {file} | {count} | {:.3} ms | {:.3} ms | {:.1} |",
            1e3 * plain,
            1e3 * all,
            (all - plain) / plain
        );
    }
}

fn samples() {
    let model = read("cantilever_strip.toml");
    let axis = Axis::parse(&model, "payload=1 g:20 g:400").expect("a good axis");
    let sweep = Sweep::new(&model, vec![axis], &Options::default()).expect("a good sweep");
    let time = median(|| {
        black_box(sweep.run(Some(1), &|_, _| {}).expect("threads"));
    });
    println!(
        "\na sample of a sweep over the payload of cantilever_strip, one core: {:.0} us",
        1e6 * time / 400.0
    );
}

/// A strip that is to be pushed to a wanted deflection.
const STRIP: &str = r#"
format = 1
[material.steel]
young = "207 GPa"
poisson = 0.3
[section.strip]
shape = "rectangle"
width = "20 mm"
height = "0.25 mm"
[beam.strip]
material = "steel"
section = "strip"
length = "150 mm"
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "strip"
at = 1
force = [0, 0, "-push"]
[unknown]
push = { guess = "0.1 N" }
[target]
"beam.strip.end.position.z" = "-50 mm"
"#;

/// Targets that move a little: parameters found again from where they were.
fn inverse() {
    println!("\n| warm inverse solve | a step |\n|---|---|");
    let strip = Document::parse(STRIP, "strip.toml").expect("a good file").model(&[]).expect("a good model");
    let robot = read("six_rod_robot.toml");
    for (name, model, target) in
        [("a strip to a wanted deflection", strip, 0), ("the six-rod robot", robot, 2)]
    {
        let mut prepared = Prepared::new(&model).expect("a sound model");
        let outcome = prepared.solve_inverse(&mut ModelFamily::new(&model), 1e-8, &mut |_| {});
        assert_eq!(outcome.status, Status::Converged, "{:?}", outcome.reason);
        let mut moved = model.clone();
        let (mut count, wanted) = (0, model.targets[target].value);
        let time = median(|| {
            count += 1;
            moved.targets[target].value = wanted + 1e-3 * f64::from(count % 8);
            let outcome = prepared.solve_inverse_from_here(&mut ModelFamily::new(&moved), 1e-8);
            assert_eq!(outcome.status, Status::Converged, "{:?}", outcome.reason);
        });
        println!("| {name} | {:.3} ms |", 1e3 * time);
    }
}

fn main() {
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let parts: [(&str, fn()); 4] =
        [("values", values), ("sensitivities", sensitivities), ("samples", samples), ("inverse", inverse)];
    for (name, part) in parts {
        if asked.is_empty() || asked.iter().any(|one| one == name) {
            part();
        }
    }
}
