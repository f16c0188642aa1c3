//! Studies that somebody ends: they keep what they have found, and that is what the whole study would have found.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{BuckleStudy, InverseDynamicsStudy, StudyKind, TraceStudy};
use flexura::modelfile::Document;
use flexura::solution::{BranchEnd, Status};
use flexura::{Axis, Family, Interrupt, ModelFamily, Options, Sweep};
use std::sync::atomic::{AtomicUsize, Ordering};

fn bundled(name: &str) -> Document {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models").join(name);
    Document::read(&path).unwrap()
}

fn heeding(interrupt: &Interrupt) -> Options {
    Options { interrupt: interrupt.clone(), ..Options::default() }
}

#[test]
fn a_solve_ends_at_the_last_point_that_it_reached() {
    let model = bundled("roll_up.toml").model(&[("turns".into(), "5".into())]).unwrap();
    let interrupt = Interrupt::new();
    let mut reached = 0.0;
    let solution = flexura::solve(&model, &heeding(&interrupt), &mut |progress| {
        reached = progress.load_fraction;
        interrupt.raise();
    });
    let solution = solution.unwrap();
    assert_eq!(solution.status, Status::Interrupted);
    assert!(reached > 0.0 && reached < 1.0 && solution.load_fraction == reached, "{reached}");
    assert!(solution.reason.as_ref().unwrap().contains("interrupted at"), "{:?}", solution.reason);
    assert_eq!(solution.stable, None);
    // Under a moment alone the strip is an arc whose turning is the load's part of the whole: five turns.
    let tip = solution.beams[0].samples.last().unwrap();
    let curvature = 10.0 * std::f64::consts::PI * reached / solution.beams[0].length;
    assert!((tip.curvature.norm() - curvature).abs() < 1e-6 * curvature, "{} {curvature}", tip.curvature);
    let evaluation = flexura::post::evaluate_each(&model, &solution);
    let document = flexura::output::document(&model, &solution, &evaluation).unwrap();
    assert_eq!(document.status, "interrupted");
    assert_eq!(document.load_fraction, Some(reached));
}

#[test]
fn a_flag_that_is_raised_beforehand_ends_every_study_at_once() {
    let interrupt = Interrupt::new();
    interrupt.raise();
    let options = heeding(&interrupt);
    let file = bundled("elastica.toml");
    let model = file.model(&[]).unwrap();
    let solution = flexura::solve(&model, &options, &mut |_| {}).unwrap();
    assert_eq!((solution.status, solution.load_fraction), (Status::Interrupted, 0.0));
    let trace = TraceStudy { parameter: 0, range: [0.0, 10.0], ..TraceStudy::default() };
    let traced = flexura::trace(&model, &trace, &options, &mut |_| {});
    assert_eq!(traced.unwrap().status, Status::Interrupted);
    let buckle = BuckleStudy { parameter: None, at: 0.0, count: 2 };
    let model = bundled("euler_pinned_pinned.toml").model(&[]).unwrap();
    let buckling = flexura::buckle(&model, &buckle, &options).unwrap();
    assert_eq!((buckling.solution.status, buckling.modes.len()), (Status::Interrupted, 0));
    assert_eq!(flexura::equilibria(&model, &options, 1_000_000, 0).unwrap().len(), 1);
}

#[test]
fn critical_values_that_were_not_found_are_no_error() {
    let file = bundled("euler_pinned_pinned.toml");
    let model = file.model(&[]).unwrap();
    let interrupt = Interrupt::new();
    let parameter = model.parameters.iter().position(|parameter| parameter.name == "push").unwrap();
    // The equilibrium is found; the first neighbouring model ends the study.
    let mut own = ModelFamily::new(&model);
    let mut asked = 0;
    let mut family = |values: &[(usize, f64)]| {
        asked += 1;
        if asked > 1 {
            interrupt.raise();
        }
        own.model(values)
    };
    let study = BuckleStudy { parameter: Some(parameter), at: 0.0, count: 2 };
    let buckling = flexura::buckle_family(&model, &mut family, &study, &heeding(&interrupt)).unwrap();
    assert_eq!(buckling.solution.status, Status::Interrupted);
    assert!(buckling.solution.reason.unwrap().contains("before the critical values were found"));
    assert!(buckling.modes.is_empty());
}

#[test]
fn what_an_ended_trace_has_found_is_how_the_whole_one_begins() {
    let file = bundled("lee_frame.toml");
    let model = file.model(&[]).unwrap();
    let load = model.parameters.iter().position(|parameter| parameter.name == "load").unwrap();
    let study = TraceStudy { parameter: load, range: [-2.0, 2.5], start: 0.0, ..TraceStudy::default() };
    let follow = |options: &Options, most: usize, interrupt: &Interrupt| {
        let (mut told, mut count) = (Vec::new(), 0);
        let trace = flexura::trace(&model, &study, options, &mut |progress| {
            told.extend(progress.found.iter().map(|point| point.parameter));
            count += 1;
            if count == most {
                interrupt.raise();
            }
        });
        (trace.unwrap(), told)
    };
    let never = Interrupt::new();
    let (whole, all) = follow(&Options::default(), usize::MAX, &never);
    assert_eq!(whole.status, Status::Converged);
    assert_eq!(all.len(), whole.branches[0].points.len() + 1, "each is told once, and the start both ways");
    // The path is followed downwards first, and its points are put in the order of the path.
    for most in [5, 30] {
        let interrupt = Interrupt::new();
        let (trace, told) = follow(&heeding(&interrupt), most, &interrupt);
        assert_eq!(trace.status, Status::Interrupted);
        assert!(trace.reason.as_ref().unwrap().contains("interrupted"), "{:?}", trace.reason);
        assert_eq!(told, all[..told.len()]);
        let branch = &trace.branches[0];
        assert!(branch.ends.contains(&BranchEnd::Interrupted), "{:?}", branch.ends);
        assert!(!branch.ends.iter().any(|end| matches!(end, BranchEnd::Stalled(_))), "{:?}", branch.ends);
        let known: Vec<f64> = whole.branches[0].points.iter().map(|point| point.parameter).collect();
        for point in &branch.points {
            assert!(known.contains(&point.parameter), "{} is no point of the whole path", point.parameter);
        }
        assert!(branch.points.len() >= told.len() - 1);
        let view = flexura::output::TraceView::new(&model, &study, &trace);
        assert!(flexura::output::path_csv(&view).unwrap().lines().count() == branch.points.len() + 1);
        assert!(flexura::output::diagram_svg(&view).contains("not converged, interrupted"));
    }
}

#[test]
fn an_ended_motion_keeps_its_times() {
    let file = bundled("rigid_four_bar.toml");
    let model = file.model(&[]).unwrap();
    let study = model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::InverseDynamics(motion) => Some(motion.clone()),
        _ => None,
    });
    let study: InverseDynamicsStudy = study.unwrap();
    let run = |most: usize| {
        let interrupt = Interrupt::new();
        flexura::inverse_dynamics(&model, &study, &heeding(&interrupt), &mut |progress| {
            if progress.done == most {
                interrupt.raise();
            }
        })
        .unwrap()
    };
    let (whole, ended) = (run(usize::MAX), run(7));
    assert_eq!((whole.status, ended.status), (Status::Converged, Status::Interrupted));
    assert_eq!(ended.instants.len(), 7);
    assert!(ended.reason.unwrap().contains("interrupted before t ="));
    for (a, b) in ended.instants.iter().zip(&whole.instants) {
        assert_eq!((a.time, &a.outputs), (b.time, &b.outputs));
    }
}

const TARGETS: &str = r#"
format = 1
[parameter]
force = "1 N"
young = "200 GPa"
[material.steel]
young = "young"
poisson = 0.3
[section.wire]
shape = "circle"
diameter = "1 mm"
[beam.wire]
material = "steel"
section = "wire"
length = "100 mm"
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "wire"
at = 1
force = [0, 0, "-force"]
[output]
sag = "-beam.wire.end.position.z"
[unknown]
force = { guess = "0.1 N" }
[target]
"beam.wire.end.position.z" = "-20 mm"
"#;

#[test]
fn an_inverse_problem_and_its_sensitivities_can_be_ended() {
    let file = Document::parse(TARGETS, "targets.toml").unwrap();
    let model = file.model(&[]).unwrap();
    // Ended when the first neighbour is asked for: on the way to the targets.
    let solve = |after: usize, sensitivities: bool| {
        let interrupt = Interrupt::new();
        let mut own = ModelFamily::new(&model);
        let mut asked = 0;
        let mut family = |values: &[(usize, f64)]| {
            asked += 1;
            if asked == after {
                interrupt.raise();
            }
            own.model(values)
        };
        let options = Options { sensitivities, ..heeding(&interrupt) };
        let solution = flexura::solve_family(&model, &mut family, &options, &mut |_| {}).unwrap().0;
        (solution, asked)
    };
    let (solution, _) = solve(3, false);
    assert_eq!(solution.status, Status::Interrupted);
    assert!(solution.reason.unwrap().contains("from the guess to the targets"));
    // Ended behind the equilibrium: what is found stays, what is missing is said.
    let (whole, asked) = solve(usize::MAX, false);
    assert_eq!(whole.status, Status::Converged);
    let (solution, _) = solve(asked + 2, true);
    assert_eq!((solution.status, solution.found), (Status::Converged, whole.found));
    assert!(
        solution.warnings.iter().any(|warning| warning.contains("interrupted")),
        "{:?}",
        solution.warnings
    );
}

#[test]
fn an_ended_sweep_has_its_beginning() {
    let file = bundled("elastica.toml");
    let model = file.model(&[]).unwrap();
    let axis = || vec![Axis::parse(&model, "force=1 N:10 N:40").unwrap()];
    let whole = Sweep::new(&model, axis(), &Options::default()).unwrap().run(Some(2), &|_, _| {}).unwrap();
    let interrupt = Interrupt::new();
    let count = AtomicUsize::new(0);
    let sweep = Sweep::new(&model, axis(), &heeding(&interrupt)).unwrap();
    let samples = sweep.run(Some(2), &|_, _| {
        if count.fetch_add(1, Ordering::Relaxed) == 9 {
            interrupt.raise();
        }
    });
    let samples = samples.unwrap();
    let solved = samples.iter().filter(|sample| sample.status.is_converged()).count();
    assert_eq!((samples.len(), solved), (40, count.into_inner()));
    assert!((10..=11).contains(&solved), "{solved}");
    for (sample, whole) in samples.iter().zip(&whole) {
        assert_eq!(sample.values, whole.values);
        if sample.status.is_converged() {
            assert_eq!((&sample.outputs, sample.energy), (&whole.outputs, whole.energy));
        } else {
            assert_eq!(sample.status.word(), "interrupted");
            assert!(sample.outputs.is_empty() && sample.energy.is_none());
        }
    }
    // One of the two workers may be behind with its sample.
    let behind = samples[..9].iter().filter(|sample| !sample.status.is_converged()).count();
    assert!(behind <= 1, "{behind}");
}
