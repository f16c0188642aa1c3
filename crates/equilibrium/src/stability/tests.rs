//! The count of unstable directions on a mechanism that has one of everything with an energy.

use crate::Equilibrium;
use crate::stability::Stability;
use crate::tests::everything;
use flexura_model::{CableLaw, Guide, LoadAxes, LoadFrame, Model, Profile};
use flexura_nonlinear::{NewtonEnd, NewtonOptions, System, converge};
use flexura_spatial::Vector3;

/// Only what has an energy is left, and is decided: no tubes, no tendon of given length in a channel, loads that keep
/// their direction and have no moment.
fn conservative() -> Model {
    let mut model = everything();
    model.tubes.clear();
    for beam in &mut model.beams {
        for load in &mut beam.distributed {
            load.axes = LoadAxes::Global;
            load.moment = [0.0; 3].map(Profile::Constant);
        }
    }
    model.loads.retain(|load| load.frame == LoadFrame::Global);
    model.loads.iter_mut().for_each(|load| load.moment = Vector3::zeros());
    let in_channel = |guide: &Guide| matches!(guide, Guide::Channel { .. });
    model.cables.retain(|cable| {
        !(matches!(cable.law, CableLaw::Length(_)) && cable.route.iter().any(in_channel))
    });
    model
}

fn pushed(factor: f64) -> Model {
    let mut model = conservative();
    for load in &mut model.loads {
        load.force *= factor;
    }
    model
}

/// Stands at the equilibrium under a fraction of the load; false where Newton's method does not arrive.
fn stand(problem: &mut Equilibrium, load: f64) -> bool {
    problem.set_load(load);
    let newton = NewtonOptions { tolerance: 1e-11, iterations: 30, nearest: f64::INFINITY };
    matches!(converge(problem, &newton), NewtonEnd::Converged { .. })
}

fn count(problem: &mut Equilibrium, parts: usize) -> usize {
    let (multipliers, ..) = problem.second_variation(parts, None).unwrap();
    let inertia = problem.second.symmetric.factorise().unwrap();
    assert_eq!(inertia.zero, 0);
    inertia.negative - multipliers
}

/// Loads at which a mechanism stands, and its counts there.
fn walked(model: &Model, segments: Option<usize>, mut at: impl FnMut(&mut Equilibrium, f64)) -> usize {
    let mut problem = Equilibrium::new(model).unwrap();
    problem.force_segments(segments);
    let mut stood = 0;
    for i in 1..=40 {
        let load = f64::from(i) / 40.0;
        if !stand(&mut problem, load) {
            break;
        }
        stood += 1;
        at(&mut problem, load);
    }
    stood
}

#[test]
fn what_has_an_energy_is_decided() {
    let mut problem = Equilibrium::new(&conservative()).unwrap();
    assert!(stand(&mut problem, 0.1));
    assert!(matches!(problem.stability(), Ok(Stability::Unstable(_))));
    let mut whole = Equilibrium::new(&everything()).unwrap();
    assert!(matches!(whole.stability(), Ok(Stability::Undecided(_))));
}

#[test]
fn the_count_does_not_depend_on_how_beams_are_cut() {
    let mut seen = Vec::new();
    for factor in [1.0, -6.0, 25.0] {
        for segments in [None, Some(3)] {
            let stood = walked(&pushed(factor), segments, |problem, load| {
                let counts = [1, 3, 7].map(|parts| count(problem, parts));
                assert!(counts.iter().all(|c| *c == counts[0]), "{factor} {load}: {counts:?}");
                seen.push(counts[0]);
            });
            assert!(stood > 5, "{factor}: only {stood} steps");
        }
    }
    seen.sort_unstable();
    seen.dedup();
    assert!(seen.len() > 1, "always {seen:?}");
}

#[test]
fn the_sign_of_the_determinant_follows_the_parity_of_the_count() {
    for factor in [1.0, -6.0, 25.0, -60.0] {
        let mut parity = None;
        walked(&pushed(factor), None, |problem, load| {
            problem.linearise().unwrap();
            let here = problem.orientation() == (count(problem, 1) % 2 == 0);
            assert_eq!(*parity.get_or_insert(here), here, "{factor} {load}");
        });
    }
}

#[test]
fn segments_of_the_shooting_method_change_nothing() {
    let mut counts = Vec::new();
    for segments in [None, Some(2), Some(5)] {
        let mut own = Vec::new();
        walked(&pushed(-6.0), segments, |problem, _| own.push(count(problem, 1)));
        counts.push(own);
    }
    let least = counts.iter().map(Vec::len).min().unwrap();
    assert!(least > 5);
    assert!(counts.iter().all(|own| own[..least] == counts[0][..least]), "{counts:?}");
}
