//! Modes of every bundled model: the number of those that grow is the number of directions in which the stability verdict, which
//! cuts beams otherwise and knows of no inertia, counts the equilibrium unstable.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{Model, ModesStudy};
use flexura::modelfile::Document;
use flexura::solution::{ModeKind, Status};
use flexura::{Options, modes};
use std::path::Path;

/// The bundled models, with a density where materials have none and a mass per length where sections have none.
fn models() -> Vec<(String, Model)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let model = |path: &std::path::PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let mut model = Document::read(path).and_then(|file| file.model(&[])).unwrap();
        let weightless = model.gravity.norm() == 0.0;
        for material in model.materials.iter_mut().filter(|_| weightless) {
            material.density.get_or_insert(7850.0);
        }
        for section in model.sections.iter_mut().filter(|_| weightless) {
            if let flexura::model::Shape::Stiffness { mass_per_length, rotary_inertia, .. } =
                &mut section.shape
            {
                mass_per_length.get_or_insert(0.01.into());
                rotary_inertia.get_or_insert_with(|| Box::new([1e-8; 3].map(Into::into)));
            }
        }
        for body in model.bodies.iter_mut().filter(|_| weightless) {
            body.mass += 0.01;
            for i in 0..3 {
                body.inertia[(i, i)] += 1e-6;
            }
        }
        (name, model)
    };
    files.iter().map(model).collect()
}

#[test]
fn as_many_modes_grow_as_the_verdict_counts() {
    let mut compared = 0;
    let mut wrong = Vec::new();
    for (name, model) in models() {
        if !model.unknowns.is_empty() || !model.targets.is_empty() {
            continue;
        }
        let study = ModesStudy { count: 4, ..ModesStudy::default() };
        let found = match modes(&model, &study, &Options::default(), &mut |_| {}) {
            Ok(found) => found,
            Err(error) => {
                assert!(error.message.contains("not built yet"), "{name}: {error}");
                continue;
            }
        };
        assert_eq!(found.solution.status, Status::Converged, "{name}");
        assert!(found.modes.iter().all(|mode| mode.error_estimate < 1e-6), "{name}");
        let has_energy = found.modes.iter().all(|mode| mode.shares.is_some());
        if let Some(counted) = found.solution.unstable_directions.filter(|_| has_energy) {
            compared += 1;
            let grow = found.modes.iter().filter(|mode| mode.kind == ModeKind::Diverging).count();
            if grow != counted.min(found.modes.len()) {
                wrong.push(format!("{name}: {grow} modes grow, {counted} counted"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(compared > 40, "{compared}");
}

#[test]
fn a_column_has_a_mode_that_grows_for_every_load_that_it_has_passed() {
    let file =
        Document::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/euler_clamped_free.toml"))
            .unwrap();
    let mut before = f64::INFINITY;
    // Euler's loads are (2n - 1)² π²/4: 2.467, 22.21, 61.69.
    for (push, wanted) in [("1", 0), ("2.4", 0), ("2.5", 1), ("22", 1), ("22.4", 2), ("61", 2), ("62", 3)] {
        let mut model = file.model(&[("push".to_owned(), push.to_owned())]).unwrap();
        model.materials[0].density = Some(7850.0);
        let study = ModesStudy { count: 5, ..ModesStudy::default() };
        let found = modes(&model, &study, &Options::default(), &mut |_| {}).unwrap();
        assert_eq!(found.solution.unstable_directions, Some(wanted), "{push}");
        assert_eq!(found.unstable(), wanted, "{push}");
        assert!(found.modes.windows(2).all(|pair| pair[0].square() <= pair[1].square()));
        let lowest = found.modes[0].square();
        assert!(lowest < before, "{push}: {lowest}");
        before = lowest;
    }
}

#[test]
fn what_has_no_modes_says_why() {
    let file = |text: &str| Document::parse(text, "test.toml").and_then(|file| file.model(&[])).unwrap();
    let study = ModesStudy::default();
    let why =
        |text: &str| modes(&file(text), &study, &Options::default(), &mut |_| {}).unwrap_err().to_string();
    let rod = "format = 1\nname = \"rod\"\n[section.rod]\nshape = \"stiffness\"\nGJ = 1\nEI2 = 1\nEI3 = 1\n";
    let beam = "[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = { body = \"ground\", hold = \"clamp\" }\n";
    let text = why(&format!("{rod}{beam}"));
    assert!(text.contains("nothing that moves has a mass"), "{text}");
    let wheel = "[body.wheel]\nat = [1, 0, 0]\nmass = 1\n[joint.axle]\nkind = \"revolute\"\nparent = \"ground\"\nchild = \"wheel\"\naxis = [1, 0, 0]\n";
    let text = why(&format!("{rod}mass_per_length = 1\n{beam}{wheel}"));
    assert!(text.contains("body.wheel moves without stiffness and without inertia"), "{text}");
    let pendulum = file(&format!("{rod}{}", wheel.replace("mass = 1", "mass = 1\ninertia = [1, 1, 1]")));
    let found = modes(&pendulum, &study, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(found.modes.len(), 1);
    assert!(found.modes[0].is_rigid());
    assert!(
        found.solution.warnings[0].contains("6 modes were asked for; there are 0"),
        "{:?}",
        found.solution.warnings
    );
}

#[test]
fn effective_masses_of_all_modes_add_up_to_what_moves() {
    // Three masses on springs along x: all modes are there.
    let text = "format = 1\nname = \"chain\"\n[body.a]\nmass = 1\nat = [1, 0, 0]\n[body.b]\nmass = 2\nat = [2, 0, 0]\n[body.c]\nmass = 3\nat = [3, 0, 0]\n\
                [joint.a]\nkind = \"prismatic\"\nparent = \"ground\"\nchild = \"a\"\naxis = [1, 0, 0]\nstiffness = 10\n\
                [joint.b]\nkind = \"prismatic\"\nparent = \"a\"\nchild = \"b\"\naxis = [1, 0, 0]\nstiffness = 20\n\
                [joint.c]\nkind = \"prismatic\"\nparent = \"b\"\nchild = \"c\"\naxis = [1, 0, 0]\nstiffness = 30\n";
    let model = Document::parse(text, "test.toml").and_then(|file| file.model(&[])).unwrap();
    let study = ModesStudy { count: 3, ..ModesStudy::default() };
    let found = modes(&model, &study, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(found.modes.len(), 3);
    let sum: f64 = found.modes.iter().filter_map(|mode| mode.shares.map(|own| own.effective[0])).sum();
    assert!((sum - 6.0).abs() < 1e-9 && (found.mass[0] - 6.0).abs() < 1e-12, "{sum} {:?}", found.mass);
    // Vieta: the product of all ω² is det K / det M = 10·20·30/(1·2·3), their sum the trace of M⁻¹K.
    let squares: Vec<f64> = found.modes.iter().map(flexura::solution::Mode::square).collect();
    assert!((squares.iter().product::<f64>() / 1000.0 - 1.0).abs() < 1e-10, "{squares:?}");
    assert!((squares.iter().sum::<f64>() / (30.0 + 25.0 + 10.0) - 1.0).abs() < 1e-10, "{squares:?}");
}
