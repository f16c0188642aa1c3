//! A mechanism whose solution is written down in closed form: a strip clamped to the ground and bent by a
//! moment into an arc, with a rigid body at its tip, a hinge that holds a second, straight beam, and a spring.

#![allow(dead_code)]

use flexura_model::*;
use flexura_solution::*;
use flexura_spatial::{Matrix3, Pose, Vector3, Wrench, exp};

pub const LENGTH: f64 = 0.2;
/// Curvature k2 of the bent strip: it turns by 1.2 rad.
pub const CURVATURE: f64 = 6.0;
pub const YOUNG: f64 = 207e9;
pub const WIDTH: f64 = 0.02;
pub const HEIGHT: f64 = 0.001;

pub fn bending_stiffness() -> f64 {
    YOUNG * WIDTH * HEIGHT.powi(3) / 12.0
}

/// Pose of the strip at arc length s: e1 turns from x towards -z about y.
pub fn arc(s: f64) -> Pose {
    let angle = CURVATURE * s;
    let position = Vector3::new(angle.sin() / CURVATURE, 0.0, (angle.cos() - 1.0) / CURVATURE);
    Pose::new(exp(&Vector3::new(0.0, angle, 0.0)), position)
}

fn clamp(body: Mount) -> Option<End> {
    Some(End { mount: body, placement: None, hold: JointLaw::weld() })
}

fn beam(name: &str, section: SectionId, material: Option<MaterialId>, length: f64) -> Beam {
    Beam {
        name: name.into(),
        material,
        section,
        curve: Curve::Straight { length },
        frame: SectionFrame::Natural,
        theory: BeamTheory::default(),
        start: clamp(Mount::Ground),
        end: clamp(Mount::Body(BodyId(0))),
        distributed: Vec::new(),
    }
}

pub fn model() -> Model {
    let body = |name: &str, position| Body {
        name: name.into(),
        pose: Pose::translation(position),
        mass: 0.0,
        center_of_mass: Vector3::zeros(),
        inertia: Matrix3::zeros(),
    };
    let mut wire = beam("wire <\"b\">", SectionId(1), None, 0.1);
    wire.start = clamp(Mount::Body(BodyId(1)));
    wire.end = None;
    Model {
        name: "bent & held".into(),
        parameters: vec![Parameter { name: "turn".into(), value: 1.2, unit: "rad".into() }],
        materials: vec![Material {
            name: "steel".into(),
            young: YOUNG,
            shear: 79.3e9,
            density: None,
            yield_strength: Some(1.1e9),
        }],
        sections: vec![
            Section {
                name: "strip".into(),
                shape: Shape::Rectangle { width: WIDTH.into(), height: HEIGHT.into() },
                plane_strain: false,
            },
            Section {
                name: "wire".into(),
                shape: Shape::Stiffness {
                    ea: 1e3.into(),
                    gj: 1e-3.into(),
                    ei2: 1e-3.into(),
                    ei3: 1e-3.into(),
                    ga2: None,
                    ga3: None,
                    mass_per_length: None,
                },
                plane_strain: false,
            },
        ],
        beams: vec![beam("strip", SectionId(0), Some(MaterialId(0)), LENGTH), wire],
        bodies: vec![
            body("tip", Vector3::new(LENGTH, 0.0, 0.0)),
            body("lever", Vector3::new(LENGTH + 0.02, 0.0, 0.0)),
        ],
        joints: vec![Joint {
            name: "hinge".into(),
            parent: Frame {
                mount: Mount::Body(BodyId(0)),
                pose: Pose::translation(Vector3::new(0.02, 0.0, 0.0)),
            },
            child: Mount::Body(BodyId(1)),
            child_pose: None,
            law: JointLaw::free(JointKind::Revolute, Vector3::y()),
        }],
        springs: vec![Spring {
            name: "return".into(),
            from: Attachment { mount: Mount::Ground, point: Vector3::new(0.0, 0.0, -0.15) },
            to: Attachment { mount: Mount::Body(BodyId(0)), point: Vector3::zeros() },
            law: SpringLaw::Linear { stiffness: 1.0, rest_length: None },
        }],
        loads: vec![Load {
            name: "bend".into(),
            target: LoadTarget::Body { body: BodyId(0), point: Vector3::zeros() },
            force: Vector3::new(0.0, 0.0, -1.0),
            moment: Vector3::new(0.0, 1.0, 0.0),
            frame: LoadFrame::Global,
        }],
        ..Model::default()
    }
}

pub fn solution() -> Solution {
    let moment = Vector3::new(0.0, bending_stiffness() * CURVATURE, 0.0);
    let strip = (0..=20).map(|i| {
        let s = LENGTH * f64::from(i) / 20.0;
        BeamSample {
            s,
            pose: arc(s),
            rest_pose: Pose::translation(Vector3::new(s, 0.0, 0.0)),
            wrench: Wrench::new(Vector3::zeros(), moment),
            curvature: Vector3::new(0.0, CURVATURE, 0.0),
            rest_curvature: Vector3::zeros(),
            strain: Vector3::zeros(),
        }
    });
    let tip = arc(LENGTH);
    let hinge = tip * Pose::translation(Vector3::new(0.02, 0.0, 0.0));
    let lever = Pose::new(exp(&Vector3::new(0.0, 0.4, 0.0)), hinge.position);
    let wire = (0..=4).map(|i| {
        let s = 0.1 * f64::from(i) / 4.0;
        let along = Pose::translation(Vector3::new(s, 0.0, 0.0));
        BeamSample {
            s,
            pose: lever * along,
            rest_pose: Pose::translation(Vector3::new(LENGTH + 0.02, 0.0, 0.0)) * along,
            wrench: Wrench::zero(),
            curvature: Vector3::zeros(),
            rest_curvature: Vector3::zeros(),
            strain: Vector3::zeros(),
        }
    });
    let spring_start = Vector3::new(0.0, 0.0, -0.15);
    Solution {
        status: Status::Converged,
        reason: None,
        load_fraction: 1.0,
        residual: 2.5e-14,
        error_estimate: 3e-11,
        warnings: vec!["hinge is free to turn".into()],
        work: Work { newton_steps: 4, load_steps: 1, ..Work::default() },
        beams: vec![
            BeamSolution { samples: strip.collect(), length: LENGTH },
            BeamSolution { samples: wire.collect(), length: 0.1 },
        ],
        bodies: vec![tip, lever],
        joints: vec![JointSolution { coordinates: vec![-0.8], efforts: vec![0.0], wrench: Wrench::zero() }],
        couplings: Vec::new(),
        cables: Vec::new(),
        tangents: Vec::new(),
        sensitivities: None,
        found: Vec::new(),
        springs: vec![SpringSolution {
            ends: [spring_start, tip.position],
            length: (tip.position - spring_start).norm(),
            tension: 0.0,
        }],
        energy: 0.5 * bending_stiffness() * CURVATURE * CURVATURE * LENGTH,
        stable: None,
        unstable_directions: None,
        stability_reason: Some("not decided yet".into()),
    }
}
