//! The count of unstable directions: how beams are cut does not matter, and its parity is the sign of the tangent's determinant.

use crate::Equilibrium;
use crate::stability::Stability;
use crate::tests::{beam, body, disturbed, end, everything, section};
use flexura_model::*;
use flexura_nonlinear::{NewtonEnd, NewtonOptions, System, converge};
use flexura_spatial::{Pose, Vector3};

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
    model
        .cables
        .retain(|cable| !(matches!(cable.law, CableLaw::Length(_)) && cable.route.iter().any(in_channel)));
    model
}

fn count(problem: &mut Equilibrium, parts: usize) -> usize {
    problem.residual().unwrap();
    let (multipliers, ..) = problem.second_variation(parts, None).unwrap();
    let inertia = problem.second.symmetric.factorise().unwrap();
    assert_eq!(inertia.zero, 0);
    inertia.negative - multipliers
}

#[test]
fn what_has_an_energy_is_decided() {
    let verdict = |model: &Model| {
        let mut problem = Equilibrium::new(model).unwrap();
        disturbed(&mut problem, 0.05);
        problem.residual().unwrap();
        problem.stability().unwrap()
    };
    assert!(matches!(verdict(&conservative()), Stability::Unstable(_)));
    assert!(matches!(verdict(&everything()), Stability::Undecided(_)));
}

/// Inside beams every state is in balance, so that poses between stretches can be eliminated exactly, wherever the nodes are.
#[test]
fn the_count_does_not_depend_on_how_beams_are_cut() {
    let mut seen = Vec::new();
    let mut model = conservative();
    // So far from rest, ends lie inside what their springs run over.
    model.springs.iter_mut().for_each(|spring| spring.wrap = None);
    for segments in [None, Some(2), Some(5)] {
        let mut own = Vec::new();
        for size in [0.1, 0.5, 1.0, 2.0, 4.0, 8.0] {
            let mut problem = Equilibrium::new(&model).unwrap();
            disturbed(&mut problem, size);
            // Cut after it was disturbed: the segments' own states lie on the same curve then.
            problem.residual().unwrap();
            if segments.is_some() {
                problem.forced_segments = segments;
                problem.renew();
            }
            let counts = [1, 3, 7].map(|parts| count(&mut problem, parts));
            assert!(counts.iter().all(|c| *c == counts[0]), "{segments:?} {size}: {counts:?}");
            own.push(counts[0]);
        }
        seen.push(own);
    }
    assert!(seen.iter().all(|own| own == &seen[0]), "{seen:?}");
    assert!(seen[0].iter().any(|count| *count > 2), "{seen:?}");
}

/// A bent beam and one on a ball joint hold a body that is pushed.
fn bracket(push: [f64; 3], curve: Curve) -> Model {
    let mut model = Model::default();
    model.sections.push(section("s", 1.0));
    model.bodies.push(body("a", [1.0, 0.4, 0.2], [0.2, -0.4, 0.1]));
    let a = Mount::Body(BodyId(0));
    let ground = Mount::Ground;
    for (name, joint) in [("first", JointKind::Weld), ("second", JointKind::Spherical)] {
        let mut arm =
            beam(name, Some(end(ground, None, JointKind::Weld, 0.0)), Some(end(a, None, joint, 0.7)));
        arm.curve = curve.clone();
        model.beams.push(arm);
    }
    if let Some(start) = &mut model.beams[1].start {
        start.placement = Some(Pose::translation(Vector3::new(0.3, 1.5, -0.2)));
    }
    model.loads.push(Load {
        name: "push".into(),
        target: LoadTarget::Body { body: BodyId(0), point: Vector3::new(0.1, 0.0, -0.2) },
        force: Vector3::from(push),
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    model
}

#[test]
fn the_sign_of_the_determinant_follows_the_parity_of_the_count() {
    let mut seen = Vec::new();
    for push in [[-25.0, 3.0, 5.0], [-20.0, -15.0, 10.0], [10.0, -25.0, 0.0], [0.0, 0.0, 25.0]] {
        for curve in [Curve::Straight { length: 1.1 }, Curve::Arc { radius: 1.3, angle: 0.8 }] {
            let mut problem = Equilibrium::new(&bracket(push, curve)).unwrap();
            let mut parity = None;
            // Whatever equilibrium Newton's method finds, from wherever it starts: unstable ones among them.
            for i in 0..=240 {
                problem.rest();
                problem.set_load(f64::from(i) / 240.0);
                let seed = f64::from(i);
                let step: Vec<f64> =
                    (0..problem.unknowns()).map(|k| 2.0 * (seed * (1.0 + k as f64)).sin()).collect();
                problem.retract(&step);
                let newton = NewtonOptions { tolerance: 1e-11, iterations: 60, nearest: f64::INFINITY };
                if !matches!(converge(&mut problem, &newton), NewtonEnd::Converged { .. }) {
                    continue;
                }
                // The count sees the beams themselves: the equilibrium must be theirs.
                problem.set_mesh_accuracy(1e-10);
                if !matches!(converge(&mut problem, &newton), NewtonEnd::Converged { .. }) {
                    continue;
                }
                assert!(problem.meshes.iter().all(|mesh| mesh.segments.len() == 1), "one layout");
                let unstable = count(&mut problem, 1);
                problem.linearise().unwrap();
                let here = problem.orientation() == unstable.is_multiple_of(2);
                assert_eq!(*parity.get_or_insert(here), here, "{push:?} {i}: {unstable}");
                seen.push(unstable);
            }
        }
    }
    for wanted in 0..=1 {
        let times = seen.iter().filter(|count| **count == wanted).count();
        assert!(times > 3, "{times} times {wanted} of {}", seen.len());
    }
}
