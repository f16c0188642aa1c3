//! Natural frequencies along paths of equilibria.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{Model, ModesPath, ModesStudy, Shape, StudyKind};
use flexura::modelfile::Document;
use flexura::solution::{Followed, ModesAlong, PointKind, Status};
use flexura::{Options, modes_along};
use std::path::Path;

/// A bundled model whose beams and bodies have a mass.
fn model(name: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models").join(name);
    let mut model = Document::read(path).and_then(|file| file.model(&[])).unwrap();
    for material in &mut model.materials {
        material.density = Some(7850.0);
    }
    for section in &mut model.sections {
        if let Shape::Stiffness { mass_per_length, rotary_inertia, .. } = &mut section.shape {
            *mass_per_length = Some(0.01.into());
            *rotary_inertia = Some(Box::new([1e-8; 3].map(Into::into)));
        }
    }
    model
}

fn followed(model: &Model, name: &str, range: [f64; 2], count: usize) -> ModesAlong {
    let parameter = model.parameters.iter().position(|own| own.name == name).unwrap();
    let study = ModesStudy { count, ..ModesStudy::default() };
    let path = ModesPath { parameter, range, steps: 20 };
    let along = modes_along(model, &study, path, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(along.trace.status, Status::Converged);
    along
}

fn square(mode: &Followed) -> f64 {
    mode.rate.powi(2) - mode.growth.powi(2)
}

/// The first trace of a file, without what is special about it.
fn path_of(model: &Model) -> Option<(usize, [f64; 2])> {
    model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::Trace(trace) if trace.start == trace.range[0] => Some((trace.parameter, trace.range)),
        _ => None,
    })
}

#[test]
fn as_many_modes_grow_as_directions_are_unstable_all_along_ten_paths() {
    let (mut paths, mut points, mut unstable) = (0, 0, 0);
    for name in [
        "euler_clamped_free.toml",
        "euler_pinned_pinned.toml",
        "euler_clamped_pinned.toml",
        "euler_clamped_clamped.toml",
        "strip_on_slope.toml",
        "shallow_arch.toml",
        "sensor_clamp.toml",
        "right_angle_frame.toml",
        "lateral_strip.toml",
        "bistable_beam.toml",
        "ends_pinned.toml",
        "deep_arch.toml",
        "michell_ring.toml",
        "hinged_beams.toml",
    ] {
        let model = model(name);
        if model.gravity.norm() > 0.0 {
            continue;
        }
        let Some((parameter, range)) = path_of(&model) else { continue };
        let study = ModesStudy { count: 4, ..ModesStudy::default() };
        let path = ModesPath { parameter, range, steps: 20 };
        let Ok(along) = modes_along(&model, &study, path, &Options::default(), &mut |_| {}) else { continue };
        paths += 1;
        for (branch, rows) in along.trace.branches.iter().zip(&along.followed) {
            for (point, row) in branch.points.iter().zip(rows) {
                let regular = matches!(point.kind, PointKind::Regular | PointKind::End);
                let (Some(counted), true, false) = (point.unstable_directions, regular, row.is_empty())
                else {
                    continue;
                };
                let grow = row.iter().flatten().filter(|mode| mode.growth > 0.0).count();
                let found = row.iter().flatten().count();
                assert_eq!(grow, counted.min(found), "{name} at {}", point.parameter);
                points += 1;
                unstable += counted;
            }
        }
    }
    assert!(paths >= 8 && points > 150 && unstable > 50, "{paths} {points} {unstable}");
}

/// At a fold ω² goes through zero in a straight line of the way along the path: ω like its square root, and like the fourth root of
/// the load that is left.
#[test]
fn the_lowest_frequency_vanishes_at_a_fold() {
    let along = followed(&model("lee_frame.toml"), "load", [0.0, 2.5], 3);
    let (branch, rows) = (&along.trace.branches[0], &along.followed[0]);
    let fold = branch.points.iter().position(|point| point.kind == PointKind::Fold).unwrap();
    // Lee, Manuel and Rossow (1968).
    assert!((branch.points[fold].parameter - 1.85567).abs() < 1e-4);
    let lowest = |i: usize| rows[i].iter().flatten().map(square).fold(f64::INFINITY, f64::min);
    let known: Vec<(f64, f64)> = [fold - 2, fold - 1, fold + 1, fold + 2]
        .map(|i| (branch.points[i].arc - branch.points[fold].arc, lowest(i)))
        .to_vec();
    assert!(known[1].1 > 0.0 && known[2].1 < 0.0, "{known:?}");
    // The cubic through all four at the fold.
    let at_fold: f64 = (0..4)
        .map(|i| {
            let others = (0..4).filter(|j| *j != i);
            known[i].1 * others.map(|j| -known[j].0 / (known[i].0 - known[j].0)).product::<f64>()
        })
        .sum();
    assert!(at_fold.abs() < 0.03 * known[1].1.min(-known[2].1), "{at_fold} {known:?}");
}

/// A hinged column whose planes differ in stiffness, under a growing push: frequencies kπ √(B k²π² - P) of both planes cross.
#[test]
fn frequencies_that_cross_keep_their_numbers() {
    let text = "format = 1\nname = \"column\"\n[parameter]\npush = 0\n[section.rod]\nshape = \"stiffness\"\nGJ = 1\nEI2 = 14.5\nEI3 = 1\nmass_per_length = 1\n\
                [body.head]\nat = [1, 0, 0]\n[joint.way]\nkind = \"prismatic\"\nparent = { body = \"ground\", at = [1, 0, 0] }\nchild = \"head\"\naxis = [-1, 0, 0]\neffort = \"push\"\n\
                [beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = { body = \"ground\", hold = \"universal\", axis = [0, 0, 1], second_axis = [0, 1, 0] }\n\
                end = { body = \"head\", hold = \"universal\", axis = [0, 0, 1], second_axis = [0, 1, 0] }\n";
    let model = Document::parse(text, "test.toml").and_then(|file| file.model(&[])).unwrap();
    let along = followed(&model, "push", [0.0, 9.0], 4);
    let pi2 = std::f64::consts::PI.powi(2);
    let wanted = |k: f64, b: f64, push: f64| (k * k * pi2 * (b * k * k * pi2 - push)).sqrt();
    let branch = &along.trace.branches[0];
    // In the order at rest: the first across the stiff plane is below the second in the soft one, and above it from P = π²/2 on.
    for (point, row) in branch.points.iter().zip(&along.followed[0]) {
        let order = [(1.0, 1.0), (1.0, 14.5), (2.0, 1.0), (3.0, 1.0)];
        for (mode, (k, b)) in row.iter().zip(order) {
            let mode = mode.expect("all are there");
            assert!(
                (mode.rate / wanted(k, b, point.parameter) - 1.0).abs() < 1e-7,
                "{k} {b} at {}",
                point.parameter
            );
        }
    }
    let rows = &along.followed[0];
    let ends = [rows.first(), rows.last()].map(|row| [1, 2].map(|i| row.unwrap()[i].unwrap().rate));
    assert!(ends[0][0] < ends[0][1] && ends[1][0] > ends[1][1], "{ends:?}");
}
