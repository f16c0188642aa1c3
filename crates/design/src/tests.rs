//! Derivatives of what designs are judged by, against differences of order six of their values.

#![allow(clippy::unwrap_used)]

use crate::evaluate::Designs;
use flexura_model::{Model, OptimiseStudy, StudyKind};
use flexura_modelfile::Document;
use flexura_study::Options;

/// Places and weights of central differences of order six.
const SIXTH: [(f64, f64); 6] =
    [(1.0, 0.75), (-1.0, -0.75), (2.0, -0.15), (-2.0, 0.15), (3.0, 1.0 / 60.0), (-3.0, -1.0 / 60.0)];

fn read(name: &str) -> (Model, OptimiseStudy) {
    let path = format!("{}/../../models/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Document::read(path).unwrap().model(&[]).unwrap();
    let study = model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::Optimise(study) => Some(study.clone()),
        _ => None,
    });
    (model.clone(), study.unwrap())
}

/// The largest difference between a slope by some of the parameters and that of differences with relative step `h`, relative to the larger of the slope and the
/// value over the parameter.
fn worst(name: &str, at: &[f64], which: &[usize], h: f64, tolerance: f64) -> f64 {
    let (model, study) = read(name);
    let options = Options { tolerance, ..Options::default() };
    let mut designs = Designs::new(&model, &study, &options).unwrap();
    let here = designs.read(at, true).unwrap_or_else(|| panic!("{}", designs.last_reason()));
    let slopes = here.slopes.unwrap();
    let mut worst = 0.0_f64;
    for &k in which {
        let mut sums = vec![0.0; slopes.len()];
        for (place, weight) in SIXTH {
            let mut beside = at.to_vec();
            beside[k] += place * h * at[k];
            let there = designs.read(&beside, false).unwrap_or_else(|| panic!("{}", designs.last_reason()));
            sums.iter_mut().zip(&there.values).for_each(|(sum, value)| *sum += weight / (h * at[k]) * value);
        }
        for (i, sum) in sums.iter().enumerate() {
            let size = slopes[i][k].abs().max((here.values[i] / at[k]).abs());
            worst = worst.max((slopes[i][k] - sum).abs() / size);
        }
    }
    worst
}

#[test]
fn mass_and_sag_have_exact_slopes() {
    let found = worst("lightest_cantilever", &[0.0017], &[0], 3e-3, 1e-12);
    assert!(found < 1e-8, "{found:e}");
}

#[test]
fn thickness_force_and_safety_have_exact_slopes() {
    let found = worst("thinnest_clamp", &[0.21e-3, 7.3e-3], &[0, 1], 3e-3, 1e-12);
    assert!(found < 1e-8, "{found:e}");
}

#[test]
fn stresses_of_an_inverse_problem_have_exact_slopes() {
    let found = worst("robot_tilt", &[0.21, 0.081], &[0, 1], 1e-3, 1e-12);
    assert!(found < 1e-8, "{found:e}");
}

#[test]
fn greatest_and_least_along_a_path_have_exact_slopes() {
    let found = worst("bistable_design", &[0.71e-3, 0.08], &[0, 1], 1e-2, 1e-10);
    assert!(found < 1e-8, "{found:e}");
}
