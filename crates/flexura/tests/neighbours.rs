//! A neighbouring model of which only what differs is made anew is the same to the last bit as one that is lowered whole.
#![allow(clippy::unwrap_used)]

use flexura::modelfile::Document;
use flexura::{Equilibrium, Prepared};
use flexura_nonlinear::System;

/// What a problem says at its present state, as text: residual, everything that is read off, and the model.
fn told(problem: &mut Equilibrium) -> String {
    let solution = problem.solution(3);
    let model = problem.model();
    format!(
        "{:?} {solution:?} {:?}",
        solution.residual.to_bits(),
        (
            (&model.parameters, &model.materials, &model.sections, &model.beams),
            (&model.bodies, &model.joints, &model.springs, &model.loads, &model.targets),
        )
    )
}

#[test]
fn what_differs_alone_is_as_good_as_a_model_lowered_whole() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let (mut compared, mut moved_laws) = (0, 0);
    for path in files {
        let name = path.display().to_string();
        let Ok(model) = Document::read(&path).and_then(|file| file.model(&[])) else { continue };
        let Ok(mut prepared) = Prepared::new(&model) else { continue };
        // Far from an equilibrium, so that the residual has something to tell.
        prepared.problem().set_load(0.7);
        let before = told(prepared.problem());
        for (position, parameter) in model.parameters.iter().enumerate() {
            if parameter.is_structural || !model.depends_on(position) {
                continue;
            }
            let value = parameter.value * (1.0 + 1e-3) + 1e-7;
            let Ok(neighbour) = model.at(&[(position, value)]) else { continue };
            let mut whole = prepared.problem().clone();
            let mut changed = prepared.problem().clone();
            let (Ok(lowered), Ok(law)) = (whole.neighbour_whole(&neighbour), changed.neighbour(&neighbour))
            else {
                continue;
            };
            whole.exchange(lowered);
            let own = changed.exchange(law);
            let there = told(&mut changed);
            assert_eq!(there, told(&mut whole), "{name}: `{}`", parameter.name);
            moved_laws += usize::from(there != before);
            changed.exchange(own);
            // A driven coordinate has moved, and goes back with the law.
            assert_eq!(told(&mut changed), before, "{name}: `{}` there and back", parameter.name);
            compared += 1;
        }
    }
    assert!(compared > 100 && moved_laws > 100, "{compared} compared, of which {moved_laws} differ");
}
