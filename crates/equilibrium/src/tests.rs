//! The whole tangent against differences of the residual, on a model that has one of everything.

use crate::Equilibrium;
use flexura_model::*;
use flexura_nonlinear::System;
use flexura_spatial::{Matrix3, Pose, Vector3, exp};

mod ligaments;

pub(crate) fn section(name: &str, factor: f64) -> Section {
    let p = |v: f64| Profile::Constant(v * factor);
    Section {
        name: name.into(),
        shape: Shape::Stiffness {
            ea: p(300.0),
            gj: p(0.8),
            ei2: p(1.0),
            ei3: p(2.5),
            ga2: Some(p(90.0)),
            ga3: Some(p(70.0)),
            mass_per_length: Some(Profile::Constant(0.1)),
            rotary_inertia: None,
        },
        plane_strain: false,
    }
}

pub(crate) fn beam(name: &str, start: Option<End>, end: Option<End>) -> Beam {
    Beam {
        name: name.into(),
        material: None,
        section: SectionId(0),
        curve: Curve::Arc { radius: 1.3, angle: 0.8 },
        frame: SectionFrame::Natural,
        theory: BeamTheory { shear: true, extension: true },
        damping: 0.0,
        added_mass: 0.0,
        start,
        end,
        distributed: Vec::new(),
        foundation: Vec::new(),
    }
}

pub(crate) fn end(body: Mount, placement: Option<Pose>, kind: JointKind, stiffness: f64) -> End {
    let mut hold = JointLaw::free(kind, Vector3::new(0.6, 0.0, 0.8));
    for c in &mut hold.coordinates {
        c.stiffness = stiffness;
        c.rest = 0.3;
    }
    End { mount: body, placement, hold }
}

pub(crate) fn body(name: &str, position: [f64; 3], turn: [f64; 3]) -> Body {
    Body {
        name: name.into(),
        pose: Pose::new(exp(&Vector3::from(turn)), Vector3::from(position)),
        mass: 0.2,
        center_of_mass: Vector3::new(0.1, -0.05, 0.2),
        inertia: Matrix3::identity(),
    }
}

fn constants(v: [f64; 3]) -> [Profile; 3] {
    v.map(Profile::Constant)
}

/// Beams between ground and bodies and free, every joint kind, springs on beams and bodies, all loads.
pub(crate) fn everything() -> Model {
    let mut m = Model { gravity: Vector3::new(0.3, -0.2, -1.0), ..Model::default() };
    m.sections.push(section("s", 1.0));
    m.bodies.push(body("a", [1.0, 0.4, 0.2], [0.2, -0.4, 0.1]));
    m.bodies.push(body("b", [0.3, 1.5, -0.4], [1.0, 0.3, 0.0]));
    m.bodies.push(body("c", [-0.3, 1.1, 0.4], [0.0, 0.3, 0.5]));
    m.bodies.push(body("d", [0.6, -0.2, 0.9], [0.4, 0.0, -0.5]));
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| Mount::Body(BodyId(i)));
    let ground = Mount::Ground;
    let placed = Pose::new(exp(&Vector3::new(0.0, 0.5, 0.2)), Vector3::new(0.1, 0.2, -0.1));
    let mut first = beam(
        "first",
        Some(end(ground, None, JointKind::Weld, 0.0)),
        Some(end(a, None, JointKind::Revolute, 0.4)),
    );
    first.distributed.push(Distributed {
        force: constants([0.2, -0.5, 0.3]),
        moment: constants([0.1, 0.05, 0.2]),
        axes: LoadAxes::Section,
        between: Distributed::EVERYWHERE,
    });
    m.beams.push(first);
    m.beams.push(beam(
        "second",
        Some(end(a, Some(placed), JointKind::Spherical, 0.7)),
        Some(end(b, Some(placed), JointKind::Weld, 0.0)),
    ));
    m.beams.push(beam("third", Some(end(c, None, JointKind::Prismatic, 0.9)), None));
    m.beams.push(beam("fourth", None, Some(end(b, None, JointKind::Weld, 0.0))));
    let joint = |name: &str, body, child, kind, drive, stiffness| {
        let mut law = JointLaw::free(kind, Vector3::new(0.0, 0.6, 0.8));
        for c in &mut law.coordinates {
            c.stiffness = stiffness;
            c.drive = drive;
        }
        let pose = Pose::new(exp(&Vector3::new(0.3, 0.0, -0.2)), Vector3::new(0.2, 0.0, 0.1));
        Joint { name: name.into(), parent: Frame { mount: body, pose }, child, child_pose: None, law }
    };
    let loaded = Drive::Free { effort: 0.3 };
    m.joints.push(joint("ball", ground, a, JointKind::Spherical, loaded, 0.5));
    m.joints.push(joint("slide", a, b, JointKind::Prismatic, loaded, 0.3));
    m.joints.push(joint("second_ball", ground, b, JointKind::Spherical, loaded, 0.2));
    m.joints.push(joint("turn", a, d, JointKind::Revolute, loaded, 0.2));
    m.joints.push(joint("crank", ground, c, JointKind::Revolute, Drive::Driven { coordinate: 0.2 }, 0.0));
    let on = |beam: usize, at: f64| BeamPoint { beam: BeamId(beam), at: At::Fraction(at) };
    let on_b = Attachment { mount: b, point: Vector3::new(0.2, 0.1, 0.0) };
    let s1 = Spring::linear("s1", Attachment::on_beam(on(0, 0.4)), on_b, 1.5);
    m.springs.push(Spring { rest_length: Some(0.7), ..s1 });
    let on_ground = Attachment { mount: Mount::Ground, point: Vector3::new(3.0, 0.0, 1.0) };
    m.springs.push(Spring::linear("s2", on_ground, Attachment::on_beam(on(2, 1.0)), 0.8));
    ligaments::add_ligaments(&mut m);
    add_mounts_couplings_and_cables(&mut m);
    add_tubes(&mut m);
    let load = |name: &str, target, frame| Load {
        name: name.into(),
        target,
        force: Vector3::new(0.3, -0.7, 0.5),
        moment: Vector3::new(-0.1, 0.2, 0.15),
        frame,
    };
    let at_body = LoadTarget::Body { body: BodyId(0), point: Vector3::new(0.3, 0.1, -0.2) };
    m.loads.push(load("l1", at_body, LoadFrame::Global));
    m.loads.push(load("l2", at_body, LoadFrame::Local));
    m.loads.push(load("l3", LoadTarget::Beam(on(1, 0.3)), LoadFrame::Local));
    m.loads.push(load("l4", LoadTarget::Beam(on(2, 1.0)), LoadFrame::Global));
    m.loads.push(load("l5", LoadTarget::Beam(on(3, 0.0)), LoadFrame::Local));
    m.masses.push(PointMass {
        name: "m".into(),
        point: on(3, 0.6),
        mass: 0.3,
        inertia: flexura_spatial::Matrix3::zeros(),
    });
    m
}

/// Joints of every other kind, between bodies, beams and ground, beams held by beams, gears and cables.
fn add_mounts_couplings_and_cables(m: &mut Model) {
    let on = |beam: usize, at: f64| Mount::Beam(BeamPoint { beam: BeamId(beam), at: At::Fraction(at) });
    let place = Pose::new(exp(&Vector3::new(-0.2, 0.1, 0.4)), Vector3::new(0.1, -0.2, 0.3));
    let mut joint = |name: &str, parent, child, kind, spare: f64| {
        let mut law = JointLaw::free(kind, Vector3::new(0.8, 0.0, 0.6));
        for (i, c) in law.coordinates.iter_mut().enumerate() {
            c.stiffness = 0.3 + 0.1 * i as f64;
            c.rest = 0.1 * i as f64 - spare;
            c.drive = Drive::Free { effort: 0.05 };
        }
        m.joints.push(Joint {
            name: name.into(),
            parent: Frame { mount: parent, pose: place },
            child,
            child_pose: Some(place.inverse()),
            law,
        });
    };
    let body = |i: usize| Mount::Body(BodyId(i));
    joint("plane", body(1), on(2, 1.0), JointKind::Planar, 0.2);
    joint("cross", Mount::Ground, on(3, 0.5), JointKind::Universal, 0.1);
    joint("sleeve", body(2), on(0, 0.7), JointKind::Cylindrical, 0.3);
    joint("bushing", on(1, 0.25), on(2, 0.8), JointKind::Free, 0.1);
    let sleeve = JointId(m.joints.len() - 2);
    let plane = JointId(m.joints.len() - 4);
    let crank = JointId(4);
    let term = |joint, coordinate, factor| CouplingTerm { joint, coordinate, factor };
    m.couplings.push(Coupling {
        name: "mesh".into(),
        terms: vec![term(sleeve, 0, 0.4), term(plane, 1, -1.5), term(crank, 0, 0.7)],
        offset: 0.3,
    });
    // Beams held by a beam, at its middle and where it is held itself.
    let hold = |mount, kind| Some(End { placement: Some(place), ..end(mount, None, kind, 0.6) });
    m.beams.push(beam("branch", hold(on(0, 0.7), JointKind::Universal), hold(body(3), JointKind::Free)));
    m.beams.push(beam("twig", hold(on(0, 1.0), JointKind::Weld), None));
    m.beams.push(beam("leaf", hold(on(1, 0.0), JointKind::Planar), None));
    let guide = |mount, y| Guide::Point(Attachment { mount, point: Vector3::new(0.1, y, -0.2) });
    for (name, law) in [("pulled", CableLaw::Tension(0.8)), ("held", CableLaw::Length(3.0))] {
        let route = vec![
            guide(Mount::Ground, 2.0),
            guide(on(1, 0.25), 0.1),
            guide(body(2), 0.0),
            guide(body(1), 0.4),
        ];
        m.cables.push(Cable { name: name.into(), route, law });
    }
    // Tendons: from the ground through two channels to a body, and anchored in channels, straight and winding.
    let function = |text: &str| {
        Profile::Function(flexura_expression::Function::parse(text, "s").expect("a function of s"))
    };
    let winding = || [function("0.1 * cos(3 * s)"), function("0.08 * sin(2 * s) + 0.02")];
    let channel = |beam: usize, from: f64, to: f64, offset| Guide::Channel {
        beam: BeamId(beam),
        between: [At::Fraction(from), At::Fraction(to)],
        offset,
    };
    let straight = |y: f64, z: f64| [Profile::Constant(y), Profile::Constant(z)];
    for (name, law) in [("pulled tendon", CableLaw::Tension(0.7)), ("held tendon", CableLaw::Length(3.0))] {
        let route = vec![
            guide(Mount::Ground, 0.5),
            channel(0, 0.1, 0.55, winding()),
            channel(0, 0.55, 0.9, winding()),
            channel(1, 0.8, 0.3, straight(0.1, -0.07)),
            guide(body(1), 0.3),
        ];
        m.cables.push(Cable { name: name.into(), route, law });
    }
    for (beam, law) in [(2, CableLaw::Length(0.9)), (5, CableLaw::Length(0.8)), (5, CableLaw::Tension(0.4))] {
        let route = vec![channel(beam, 0.0, 1.0, winding())];
        m.cables.push(Cable { name: format!("anchored {}", m.cables.len()), route, law });
    }
}

/// Concentric tubes on a body and on the ground; the second ends first, the third is straight.
fn add_tubes(m: &mut Model) {
    let round = |ei: f64| Section {
        name: format!("round{ei}"),
        shape: Shape::Stiffness {
            ea: f64::INFINITY.into(),
            gj: (0.7 * ei).into(),
            ei2: ei.into(),
            ei3: ei.into(),
            ga2: None,
            ga3: None,
            mass_per_length: None,
            rotary_inertia: None,
        },
        plane_strain: false,
    };
    let first = m.sections.len();
    m.sections.extend([round(0.5), round(0.9), round(1.4)]);
    let tube = |i: usize, straight: f64, curved: f64, curvature: f64, rotation: f64| Tube {
        material: None,
        section: SectionId(first + i),
        straight,
        curved,
        curvature,
        rotation,
        translation: -0.1 * i as f64,
    };
    let tubes = vec![tube(0, 0.6, 0.5, 0.9, 0.4), tube(1, 0.5, 0.4, 0.7, -0.8), tube(2, 0.4, 0.2, 0.0, 1.1)];
    let frame = |mount| Frame {
        mount,
        pose: Pose::new(exp(&Vector3::new(0.1, 0.4, -0.2)), Vector3::new(0.1, 0.0, 0.2)),
    };
    for (name, mount) in [("arm", Mount::Body(BodyId(1))), ("leg", Mount::Ground)] {
        m.tubes.push(Tubes {
            name: name.into(),
            base: frame(mount),
            tubes: tubes.clone(),
            force: Vector3::new(0.2, -0.3, 0.1),
            moment: Vector3::new(0.05, 0.1, -0.1),
        });
    }
}

/// A state away from every solution, the same at each call.
pub(crate) fn disturbed(problem: &mut Equilibrium, size: f64) {
    problem.set_load(0.7);
    let step: Vec<f64> = (0..problem.unknowns()).map(|i| size * ((3 * i + 1) as f64).sin()).collect();
    problem.retract(&step);
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual() {
    let mut problem = Equilibrium::new(&everything()).unwrap();
    disturbed(&mut problem, 0.05);
    for slot in problem.layout.ropes.clone().into_iter().flatten() {
        problem.x[slot.state] = 0.9;
    }
    problem.evaluate(true).unwrap();
    let n = problem.layout.interface;
    assert_eq!(n, problem.unknowns(), "one segment a span");
    let mut tangent = vec![vec![0.0; n]; n];
    problem.tangent.for_each(|i, j, value| tangent[i][j] += value);
    let r0 = problem.r.clone();
    let mut kept = Vec::new();
    problem.store(&mut kept);
    // Closure rows are differentiated before the inverse left Jacobian of their logarithm: bring it back.
    let closures: Vec<usize> = problem
        .layout
        .spans
        .iter()
        .zip(&problem.lowered.spans)
        .filter(|(_, span)| span.end.is_some())
        .map(|(slots, _)| slots.wrench.unknown)
        .chain(problem.layout.joints.iter().map(|j| j.wrench.unknown))
        .collect();
    for j in 0..n {
        let at = |problem: &mut Equilibrium, x: f64| {
            problem.restore(&kept);
            let mut step = vec![0.0; n];
            step[j] = x;
            problem.retract(&step);
            problem.evaluate(false).unwrap();
            problem.r.clone()
        };
        let h = 5e-4;
        let s = [h, -h, 2.0 * h, -2.0 * h, 3.0 * h, -3.0 * h].map(|x| at(&mut problem, x));
        let mut column: Vec<f64> = (0..n)
            .map(|i| {
                (45.0 * (s[0][i] - s[1][i]) - 9.0 * (s[2][i] - s[3][i]) + (s[4][i] - s[5][i])) / (60.0 * h)
            })
            .collect();
        for &row in &closures {
            let turn = Vector3::new(r0[row], r0[row + 1], r0[row + 2]);
            let moved = flexura_spatial::left_jacobian(&turn)
                * Vector3::new(column[row], column[row + 1], column[row + 2]);
            column[row..row + 3].copy_from_slice(moved.as_slice());
        }
        for i in 0..n {
            assert!(
                (tangent[i][j] - column[i]).abs() < 2e-10 * (1.0 + column[i].abs()),
                "row {i} column {j}: {} against {}",
                tangent[i][j],
                column[i]
            );
        }
    }
}

/// Along the Newton direction d every residual, the gaps between segments too, falls as r(x + t d) = (1 - t) r(x).
#[test]
fn the_newton_direction_closes_every_gap_of_many_segments() {
    for segments in [2, 3, 7] {
        let mut problem = Equilibrium::new(&everything()).unwrap();
        problem.force_segments(Some(segments));
        disturbed(&mut problem, 0.003);
        problem.linearise().unwrap();
        let n = problem.unknowns();
        let mut step = vec![0.0; n];
        problem.newton_step(&mut step);
        let mut kept = Vec::new();
        problem.store(&mut kept);
        let residual = |problem: &mut Equilibrium, t: f64| {
            problem.restore(&kept);
            problem.retract(&step.iter().map(|s| s * t).collect::<Vec<_>>());
            problem.evaluate(false).unwrap();
            let mut all = problem.r.clone();
            all.extend(problem.gaps.iter().flatten().flatten());
            all
        };
        let r0 = residual(&mut problem, 0.0);
        let h = 1e-3;
        let s = [h, -h, 2.0 * h, -2.0 * h].map(|t| residual(&mut problem, t));
        let largest = r0.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        for i in 0..r0.len() {
            let slope = (8.0 * (s[0][i] - s[1][i]) - (s[2][i] - s[3][i])) / (12.0 * h);
            assert!(
                (slope + r0[i]).abs() < 1e-8 * largest,
                "{segments} segments, row {i}: {slope} for {}",
                r0[i]
            );
        }
    }
}

#[test]
fn steps_and_differences_undo_each_other() {
    let mut problem = Equilibrium::new(&everything()).unwrap();
    problem.force_segments(Some(3));
    let (mut from, mut to) = (Vec::new(), Vec::new());
    problem.store(&mut from);
    let step: Vec<f64> = (0..problem.unknowns()).map(|i| 0.2 * ((i * i) as f64).cos()).collect();
    problem.retract(&step);
    problem.store(&mut to);
    let mut back = vec![0.0; step.len()];
    problem.difference(&from, &to, &mut back);
    for (a, b) in step.iter().zip(&back) {
        assert!((a - b).abs() < 1e-13);
    }
}
