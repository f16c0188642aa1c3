//! A mechanism whose solution is written down in closed form: a strip clamped to the ground and bent by a
//! moment into an arc, with a rigid body at its tip, a hinge that holds a second, straight beam, and a spring.

#![allow(dead_code, clippy::unwrap_used)]

use flexura_expression::{Binding, Expression, Kind};
use flexura_model::*;
use flexura_solution::*;
use flexura_spatial::{Matrix3, Matrix6, Pose, Twist, Vector3, Wrench, exp};

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
        damping: 0.0,
        added_mass: 0.0,
        start: clamp(Mount::Ground),
        end: clamp(Mount::Body(BodyId(0))),
        distributed: Vec::new(),
        foundation: Vec::new(),
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
        parameters: vec![Parameter {
            name: "turn".into(),
            value: 1.2,
            unit: "rad".into(),
            ..Parameter::default()
        }],
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
                    rotary_inertia: None,
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
        springs: vec![Spring::linear(
            "return",
            Attachment { mount: Mount::Ground, point: Vector3::new(0.0, 0.0, -0.15) },
            Attachment { mount: Mount::Body(BodyId(0)), point: Vector3::zeros() },
            1.0,
        )],
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
            foundation: Vector3::zeros(),
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
            foundation: Vector3::zeros(),
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
            BeamSolution { samples: strip.collect(), length: LENGTH, ..BeamSolution::default() },
            BeamSolution { samples: wire.collect(), length: 0.1, ..BeamSolution::default() },
        ],
        bodies: vec![tip, lever],
        joints: vec![JointSolution {
            coordinates: vec![-0.8],
            efforts: vec![0.0],
            wrench: Wrench::zero(),
            contact: None,
        }],
        couplings: Vec::new(),
        cables: Vec::new(),
        tubes: Vec::new(),
        tangents: Vec::new(),
        sensitivities: None,
        found: Vec::new(),
        springs: vec![SpringSolution {
            ends: [spring_start, tip.position],
            length: (tip.position - spring_start).norm(),
            tension: 0.0,
            ..SpringSolution::default()
        }],
        rates: None,
        energy: 0.5 * bending_stiffness() * CURVATURE * CURVATURE * LENGTH,
        stable: None,
        unstable_directions: None,
        stability_reason: Some("not decided yet".into()),
    }
}

/// Two concentric tubes on an arc about z, the outer one half as long, with a force on the tip.
pub fn robot() -> (Tubes, TubesSolution) {
    let tube = |curved: f64, rotation: f64| Tube {
        material: None,
        section: SectionId(1),
        straight: 0.02,
        curved,
        curvature: 12.0,
        rotation,
        translation: -0.02,
    };
    let base = Frame { mount: Mount::Ground, pose: Pose::translation(Vector3::new(0.0, 0.08, 0.0)) };
    let samples = (0..=8).map(|i| {
        let s = 0.01 * f64::from(i);
        let angle = 5.0 * s;
        let position = Vector3::new(angle.sin(), 1.0 - angle.cos(), 0.0) / 5.0;
        let numbers = if i <= 4 { 0..2 } else { 0..1 };
        let turn = 0.5 - 2.0 * s;
        TubesSample {
            s,
            pose: base.pose * Pose::new(exp(&Vector3::new(0.0, 0.0, angle)), position),
            wrench: Wrench::new(Vector3::new(0.0, 0.0, -0.1), Vector3::new(0.0, 0.1 * (0.08 - s), 0.0)),
            curvature: Vector3::new(0.0, 0.0, 5.0),
            angles: numbers.clone().map(|tube| (tube, tube as f64 * turn)).collect(),
            torques: numbers.map(|tube| (tube, (0.04 - s) * [-0.25, 0.25][tube])).collect(),
        }
    });
    let result = TubesSolution { samples: samples.collect() };
    let tubes = Tubes {
        name: "robot".into(),
        base,
        tubes: vec![tube(0.08, 0.0), tube(0.04, 0.5)],
        force: Vector3::new(0.0, 0.0, -0.1),
        moment: Vector3::zeros(),
    };
    (tubes, result)
}

/// The same with what few mechanisms have: a bevel of two universal coordinates, a planar and a cylindrical joint, a
/// coupling, two cables, two concentric tubes, a compliance, sensitivities and a parameter that was found.
pub fn rich() -> (Model, Solution) {
    let (mut model, mut solution) = (model(), solution());
    let kinds = [
        ("bevel", JointKind::Universal, Vector3::x()),
        ("table", JointKind::Planar, Vector3::z()),
        ("bush", JointKind::Cylindrical, Vector3::x()),
        ("loose", JointKind::Free, Vector3::x()),
        ("ball", JointKind::Spherical, Vector3::x()),
        ("slide", JointKind::Prismatic, Vector3::z()),
    ];
    for (i, (name, kind, axis)) in kinds.into_iter().enumerate() {
        let place = Vector3::new(0.02 + 0.04 * i as f64, 0.03, -0.06);
        model.bodies.push(Body {
            name: format!("b{i}"),
            pose: Pose::translation(place),
            ..model.bodies[0].clone()
        });
        solution.bodies.push(Pose::translation(place));
        model.joints.push(Joint {
            name: name.into(),
            parent: Frame { mount: Mount::Ground, pose: Pose::translation(place) },
            child: Mount::Body(BodyId(2 + i)),
            child_pose: None,
            law: JointLaw::free(kind, axis),
        });
        solution.joints.push(JointSolution {
            coordinates: vec![0.0; kind.freedoms()],
            efforts: vec![0.5; kind.freedoms()],
            wrench: Wrench::zero(),
            contact: None,
        });
    }
    let term = |coordinate, factor| CouplingTerm { joint: JointId(1), coordinate, factor };
    model.couplings.push(Coupling {
        name: "gear".into(),
        terms: vec![term(0, 1.0), term(1, -2.0)],
        offset: 0.0,
    });
    solution.couplings.push(0.25);
    let point = |mount, x, y, z| Guide::Point(Attachment { mount, point: Vector3::new(x, y, z) });
    let tip = Mount::Body(BodyId(0));
    model.cables.push(Cable {
        name: "puller".into(),
        route: vec![
            point(Mount::Ground, 0.0, 0.0, 0.05),
            point(Mount::Ground, 0.1, 0.0, 0.06),
            point(tip, 0.0, 0.0, 0.01),
        ],
        law: CableLaw::Tension(3.0),
    });
    let end = arc(LENGTH).point(&Vector3::new(0.0, 0.0, 0.01));
    solution.cables.push(CableSolution {
        course: vec![Vector3::new(0.0, 0.0, 0.05), Vector3::new(0.1, 0.0, 0.06), end],
        length: 0.25,
        tension: 3.0,
    });
    model.cables.push(Cable {
        name: "bowden".into(),
        route: vec![Guide::Channel {
            beam: BeamId(0),
            between: [At::Fraction(0.0), At::Fraction(1.0)],
            offset: [0.0.into(), (-0.006).into()],
        }],
        law: CableLaw::Length(0.2),
    });
    let channel = (0..=20).map(|i| arc(LENGTH * f64::from(i) / 20.0).point(&Vector3::new(0.0, 0.0, -0.006)));
    solution.cables.push(CableSolution { course: channel.collect(), length: 0.2, tension: 1.5 });

    let (tubes, result) = robot();
    model.tubes.push(tubes);
    solution.tubes.push(result);

    let matrix = |i: usize, j: usize| if i == j { 1.0 + i as f64 } else { 0.01 * (i + j) as f64 };
    let motion = Twist { angular: Vector3::new(0.0, 1.2, 0.0), linear: Vector3::new(-0.05, 0.0, -0.1) };
    for target in [
        ProbeTarget::Body(BodyId(0)),
        ProbeTarget::Beam(BeamId(0), At::Fraction(0.5)),
        ProbeTarget::Beam(BeamId(1), At::Length(0.03)),
    ] {
        solution.tangents.push(TangentSolution {
            target,
            compliance: Some(Matrix6::from_fn(matrix)),
            motion,
        });
    }
    let sum = |name: &str, unit: &str, components: &[usize]| {
        let probe = |component| Probe {
            target: ProbeTarget::Body(BodyId(0)),
            quantity: Quantity::Position,
            component,
        };
        let formula = |slot: usize| {
            let whole = Expression::parse("q").unwrap();
            let lowered = whole.lower(&mut |_| Ok(Binding::Slot(slot, Kind::Plain))).unwrap();
            lowered.formula()
        };
        Output {
            name: name.into(),
            unit: unit.into(),
            formulas: (0..components.len()).map(formula).collect(),
            probes: components.iter().map(|component| probe(*component)).collect(),
        }
    };
    model.outputs = vec![sum("sink", "m", &[2]), sum("place", "m", &[0, 1, 2])];
    model.parameters.push(Parameter {
        name: "push".into(),
        value: 3.2,
        unit: "N".into(),
        ..Parameter::default()
    });
    solution.sensitivities = Some(Sensitivities {
        unknowns: Vec::new(),
        left_out: Vec::new(),
        parameters: vec![0, 1],
        outputs: [&[[-0.1, 0.02]][..], &[[0.05, 0.0], [0.0, 0.0], [-0.1, 0.02]]]
            .map(|output| output.iter().map(|by| by.map(Some).to_vec()).collect())
            .to_vec(),
        bodies: vec![vec![motion; 2]; 8],
    });
    solution.found = vec![(1, 3.2)];
    (model, solution)
}
