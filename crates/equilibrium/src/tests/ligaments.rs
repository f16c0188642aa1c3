//! Springs of every law and over every obstacle, for the model that has one of everything.

use super::{disturbed, everything};
use crate::Equilibrium;
use flexura_model::*;
use flexura_nonlinear::System;
use flexura_spatial::{Pose, Vector3, exp};

/// On the ground, on bodies and on beams, all of them taut, and some around obstacles on a body, a beam and the ground.
pub(super) fn add_ligaments(m: &mut Model) {
    let global = |body: usize, x: f64, y: f64, z: f64| Attachment {
        mount: Mount::Body(BodyId(body)),
        point: m.bodies[body].pose.inverse().point(&Vector3::new(x, y, z)),
    };
    let ground = |x, y, z| Attachment { mount: Mount::Ground, point: Vector3::new(x, y, z) };
    let on =
        |beam: usize, at: f64| Attachment::on_beam(BeamPoint { beam: BeamId(beam), at: At::Fraction(at) });
    let exponential = |form| SpringLaw::Exponential { area: 1e-3, exponent: 3.0, stress: 200.0, form };
    let spring = |name: &str, from, to, law, rest_length, wrap| Spring {
        rest_length: Some(rest_length),
        size: 1.1,
        wrap,
        law,
        ..Spring::linear(name, from, to, 1.0)
    };
    let turn = exp(&Vector3::new(0.4, -0.3, 0.2));
    let on_body = |body: usize, x: f64, y: f64, z: f64, obstacle| {
        let pose = m.bodies[body].pose.inverse() * Pose::new(turn, Vector3::new(x, y, z));
        Some(Wrap { frame: Frame { mount: Mount::Body(BodyId(body)), pose }, obstacle })
    };
    let ball = Obstacle::Sphere { radius: 0.4 };
    let rod = |turn| Obstacle::Cylinder { radius: 0.3, axis: Vector3::z(), turn };
    let on_ground = Some(Wrap {
        frame: Frame { mount: Mount::Ground, pose: Pose::new(turn, Vector3::new(2.0, 2.0, 2.0)) },
        obstacle: rod(Some(Turn::Negative)),
    });
    let on_beam = Some(Wrap {
        frame: Frame { mount: on(1, 0.25).mount, pose: Pose::new(turn, Vector3::new(0.05, -0.05, 0.0)) },
        obstacle: Obstacle::Sphere { radius: 0.25 },
    });
    let toe = SpringLaw::Toe { axial_stiffness: 0.7, toe_strain: 0.2 };
    let table = SpringLaw::Table { rows: vec![[-0.1, 0.0], [0.2, 0.1], [0.5, 0.4], [1.5, 0.9]] };
    let band = SpringLaw::Linear { stiffness: 0.4, tension_only: true };
    let ligaments = vec![
        spring(
            "soft",
            ground(-1.0, 0.5, 0.0),
            global(2, -0.2, 1.0, 0.3),
            exponential(ExponentialForm::Continuous),
            0.5,
            None,
        ),
        spring("toe", on(0, 0.4), global(3, 0.5, -0.3, 1.0), toe, 0.4, None),
        spring("measured", global(0, 1.3, 0.2, 0.1), global(1, 0.3, 1.2, -0.2), table.clone(), 0.6, None),
        spring(
            "over a body",
            ground(1.2, 1.6, -0.4),
            global(2, -0.5, 1.5, -0.3),
            exponential(ExponentialForm::Printed),
            1.0,
            on_body(1, 0.3, 1.5, -0.4, ball),
        ),
        spring(
            "over a rod",
            global(0, 1.2, 0.2, 0.1),
            global(2, 0.2, 0.5, 0.6),
            table,
            0.5,
            on_body(3, 0.6, 0.3, 0.4, rod(None)),
        ),
        spring(
            "the long way",
            global(0, 2.6, 1.8, 2.1),
            global(1, 1.5, 2.4, 2.3),
            band.clone(),
            0.8,
            on_ground,
        ),
        spring("over a beam", ground(2.19, 0.78, 0.42), global(2, 0.6, 0.65, 0.1), band, 0.5, on_beam),
    ];
    m.springs.extend(ligaments);
}

#[test]
fn the_ligaments_of_the_model_of_everything_are_taut_and_go_around() {
    let mut problem = Equilibrium::new(&everything()).unwrap();
    disturbed(&mut problem, 0.05);
    let mut around = 0;
    for (i, spring) in problem.model.springs.iter().enumerate() {
        let course = problem.spring_course(i).unwrap_or_else(|e| panic!("{}: {e:?}", spring.name));
        let pull = problem.spring_law(i).pull(course.length);
        assert!(pull.tension != 0.0 && pull.rate != 0.0, "{}: {pull:?}", spring.name);
        if spring.wrap.is_some() {
            assert!(course.around.is_some(), "{}", spring.name);
            around += 1;
        }
    }
    assert_eq!(around, 4);
}

/// Forces on the ends and on what carries the obstacle: no net force, no net moment, and the power of a motion is the tension
/// times the rate of the length.
#[test]
fn what_acts_on_three_bodies_is_in_balance_and_does_the_work_of_the_tension() {
    let all = everything();
    for name in ["over a body", "over a rod", "the long way"] {
        let mut model = Model { bodies: all.bodies.clone(), ..Model::default() };
        model.bodies.iter_mut().for_each(|body| body.mass = 0.0);
        // What is on the ground in the model of everything is put on a fourth body.
        model.bodies.push(super::body("ground", [0.0; 3], [0.0; 3]));
        let carried = |mount: &mut Mount| {
            if *mount == Mount::Ground {
                *mount = Mount::Body(BodyId(4));
            }
        };
        let mut spring = all.springs.iter().find(|spring| spring.name == name).unwrap().clone();
        carried(&mut spring.from.mount);
        carried(&mut spring.to.mount);
        spring.wrap.iter_mut().for_each(|wrap| carried(&mut wrap.frame.mount));
        model.springs.push(spring);
        let mut problem = Equilibrium::new(&model).unwrap();
        disturbed(&mut problem, 0.05);
        problem.evaluate(false).unwrap();
        let course = problem.spring_course(0).unwrap();
        assert!(course.around.is_some(), "{name}");
        let tension = problem.spring_law(0).pull(course.length).tension;
        let r = problem.r.clone();
        let triple = |at: usize| Vector3::new(r[at], r[at + 1], r[at + 2]);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (i, slot) in problem.layout.nodes.clone().iter().enumerate() {
            let own = triple(slot.unknown + 3);
            force += own;
            moment += triple(slot.unknown) + problem.node_pose(Some(i)).position.cross(&own);
        }
        assert!(tension > 0.1 && force.norm() < 1e-14 && moment.norm() < 1e-14, "{name}: {force} {moment}");
        let mut kept = Vec::new();
        problem.store(&mut kept);
        let step: Vec<f64> = (0..problem.unknowns()).map(|i| ((5 * i + 2) as f64).cos()).collect();
        let mut length = |t: f64| {
            problem.restore(&kept);
            problem.retract(&step.iter().map(|s| s * t).collect::<Vec<_>>());
            problem.spring_course(0).unwrap().length
        };
        // Small, as a body's whole turn is one unit of the step and one end comes close to the surface.
        let h = 2e-5;
        let rate = (8.0 * (length(h) - length(-h)) - (length(2.0 * h) - length(-2.0 * h))) / (12.0 * h);
        let power: f64 = r.iter().zip(&step).map(|(r, s)| r * s).sum();
        assert!((power + tension * rate).abs() < 1e-9, "{name}: {power} {}", tension * rate);
    }
}
