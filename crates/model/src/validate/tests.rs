//! Models as a Rust user would build them, each wrong in one way.
#![allow(clippy::unwrap_used)]

use crate::*;
use flexura_expression::{Formula, Function};
use flexura_spatial::{Matrix3, Pose, Vector3};

fn good() -> Model {
    Model {
        materials: vec![Material {
            name: "steel".into(),
            young: 207e9,
            shear: 79.3e9,
            density: None,
            yield_strength: None,
        }],
        sections: vec![Section {
            name: "wire".into(),
            shape: Shape::Circle { diameter: 1e-3.into() },
            plane_strain: false,
        }],
        beams: vec![Beam {
            name: "link".into(),
            material: Some(MaterialId(0)),
            section: SectionId(0),
            curve: Curve::Straight { length: 0.1 },
            frame: SectionFrame::Natural,
            theory: BeamTheory::default(),
            damping: 0.0,
            added_mass: 0.0,
            start: Some(End { mount: Mount::Ground, placement: None, hold: JointLaw::weld() }),
            end: None,
            distributed: Vec::new(),
            foundation: Vec::new(),
        }],
        ..Model::default()
    }
}

fn paths(change: impl Fn(&mut Model)) -> Vec<String> {
    let mut model = good();
    change(&mut model);
    model.validate().into_iter().map(|issue| issue.path).collect()
}

#[test]
fn a_sound_model_has_no_issue() {
    assert_eq!(good().validate(), []);
}

#[test]
fn each_mistake_is_found_where_it_is() {
    let mass = |at| PointMass {
        name: "m".into(),
        point: BeamPoint { beam: BeamId(0), at },
        mass: 1.0,
        inertia: flexura_spatial::Matrix3::zeros(),
    };
    assert_eq!(paths(|m| m.materials[0].young = f64::NAN), ["material.steel.young"]);
    assert_eq!(paths(|m| m.materials[0].shear = 0.0), ["material.steel.shear"]);
    assert_eq!(paths(|m| m.materials[0].density = Some(-1.0)), ["material.steel.density"]);
    assert_eq!(paths(|m| m.beams[0].section = SectionId(7)), ["beam.link.section"]);
    assert_eq!(paths(|m| m.beams[0].material = None), ["beam.link"]);
    assert_eq!(paths(|m| m.beams[0].curve = Curve::Straight { length: 0.0 }), ["beam.link.length"]);
    assert_eq!(
        paths(|m| m.beams[0].start.as_mut().unwrap().mount = Mount::Body(BodyId(0))),
        ["beam.link.start.body"]
    );
    assert_eq!(paths(|m| m.beams.push(m.beams[0].clone())), ["beam.link"]);
    assert_eq!(paths(|m| m.beams[0].name = "a b".into()), ["beam.a b"]);
    assert_eq!(paths(|m| m.masses.push(mass(At::Length(0.2)))), ["mass.m.at"]);
    assert_eq!(paths(|m| m.masses.push(mass(At::Fraction(-0.1)))), ["mass.m.at"]);
    let taper = Function::parse("1e-3 - 0.02*s", "s").unwrap();
    let shape = Shape::Circle { diameter: Profile::Function(taper) };
    assert_eq!(paths(|m| m.sections[0].shape = shape.clone()), ["section.wire.diameter"]);
    let shape = Shape::Circle { diameter: Profile::Table { at: vec![], value: vec![] } };
    assert_eq!(paths(|m| m.sections[0].shape = shape.clone()), ["section.wire.diameter"]);
}

fn two_bodies(model: &mut Model) {
    let body = |name: &str| Body {
        name: name.into(),
        pose: Pose::identity(),
        mass: 0.0,
        center_of_mass: Vector3::zeros(),
        inertia: Matrix3::zeros(),
    };
    model.bodies = vec![body("a"), body("b")];
    let joint = |name: &str, child, law| Joint {
        name: name.into(),
        parent: Frame { mount: Mount::Ground, pose: Pose::identity() },
        child: Mount::Body(BodyId(child)),
        child_pose: None,
        law,
    };
    model.joints = vec![
        joint("cardan", 0, JointLaw::free(JointKind::Universal, Vector3::x())),
        joint("bushing", 1, JointLaw::free(JointKind::Free, Vector3::x())),
    ];
}

fn paths_with_bodies(change: impl Fn(&mut Model)) -> Vec<String> {
    paths(|model| {
        two_bodies(model);
        change(model);
    })
}

#[test]
fn joints_need_sound_axes_and_as_many_laws_as_coordinates() {
    assert_eq!(paths_with_bodies(|_| {}), [""; 0]);
    let tilt = |m: &mut Model, axis| m.joints[0].law.second_axis = axis;
    assert_eq!(paths_with_bodies(|m| m.joints[0].law.axis *= 2.0), ["joint.cardan.axis"]);
    assert_eq!(paths_with_bodies(|m| tilt(m, Vector3::x())), ["joint.cardan.second_axis"]);
    assert_eq!(paths_with_bodies(|m| tilt(m, Vector3::zeros())), ["joint.cardan.second_axis"]);
    assert_eq!(paths_with_bodies(|m| m.joints[0].law.kind = JointKind::Planar), ["joint.cardan"]);
    let stiff = |m: &mut Model, k: usize| m.joints[1].law.coordinates[k].stiffness = -1.0;
    assert_eq!(paths_with_bodies(|m| stiff(m, 2)), ["joint.bushing.z.stiffness"]);
    assert_eq!(paths_with_bodies(|m| stiff(m, 4)), ["joint.bushing.rotation.stiffness"]);
    let first = |m: &mut Model| m.joints[0].law.coordinates[0].rest = f64::INFINITY;
    assert_eq!(paths_with_bodies(first), ["joint.cardan.first.rest"]);
}

#[test]
fn places_on_beams_must_exist_and_differ() {
    let on = |beam, at| Mount::Beam(BeamPoint { beam: BeamId(beam), at });
    let middle = on(0, At::Fraction(0.5));
    assert_eq!(paths_with_bodies(|m| m.joints[0].child = middle), [""; 0]);
    assert_eq!(
        paths_with_bodies(|m| m.joints[0].child = on(3, At::Fraction(0.5))),
        ["joint.cardan.child.at"]
    );
    assert_eq!(paths_with_bodies(|m| m.joints[0].child = on(0, At::Length(1.0))), ["joint.cardan.child.at"]);
    let same = |m: &mut Model| {
        m.joints[0].parent.mount = middle;
        m.joints[0].child = on(0, At::Length(0.05));
    };
    assert_eq!(paths_with_bodies(same), ["joint.cardan.child"]);
    let end = |mount| Some(End { mount, placement: None, hold: JointLaw::weld() });
    assert_eq!(paths(|m| m.beams[0].end = end(middle)), ["beam.link.end.beam"]);
    let circle = |m: &mut Model| {
        m.beams.push(Beam { name: "other".into(), start: end(middle), ..m.beams[0].clone() });
        m.beams[0].start = end(on(1, At::Fraction(0.5)));
    };
    assert_eq!(paths(circle), ["beam.link.start.beam"]);
    // Only what places a beam counts: the ends may well close a loop.
    let closed = |m: &mut Model| {
        m.beams.push(Beam { name: "other".into(), start: end(middle), ..m.beams[0].clone() });
        m.beams[0].end = end(on(1, At::Fraction(0.5)));
    };
    assert_eq!(paths(closed), [""; 0]);
}

#[test]
fn couplings_relate_free_coordinates_of_joints() {
    let term = |joint, coordinate, factor| CouplingTerm { joint: JointId(joint), coordinate, factor };
    let with = |terms: &[CouplingTerm], offset| {
        paths_with_bodies(|m| {
            m.couplings = vec![Coupling { name: "mesh".into(), terms: terms.to_vec(), offset }];
        })
    };
    let good = [term(0, 0, 1.0), term(0, 1, -2.0), term(1, 2, 3.0)];
    assert_eq!(with(&good, 0.1), [""; 0]);
    let wrong = ["coupling.mesh"];
    assert_eq!(with(&good, f64::NAN), wrong);
    assert_eq!(with(&good[..1], 0.0), wrong);
    assert_eq!(with(&[good[0], term(1, 3, 1.0)], 0.0), wrong);
    assert_eq!(with(&[good[0], term(7, 0, 1.0)], 0.0), wrong);
    assert_eq!(with(&[good[0], term(0, 2, 1.0)], 0.0), wrong);
    assert_eq!(with(&[good[0], good[0]], 0.0), wrong);
    assert_eq!(with(&[good[0], term(0, 1, 0.0)], 0.0), wrong);
    let driven = |m: &mut Model| {
        m.couplings = vec![Coupling { name: "mesh".into(), terms: good[..2].to_vec(), offset: 0.0 }];
        for law in &mut m.joints[0].law.coordinates {
            law.drive = Drive::Driven { coordinate: 0.1 };
        }
    };
    assert_eq!(paths_with_bodies(driven), wrong);
}

#[test]
fn cables_need_a_way_and_never_push() {
    let point = |mount| Guide::Point(Attachment { mount, point: Vector3::zeros() });
    let beam = |at| point(Mount::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(at) }));
    let channel = |from, to| Guide::Channel {
        beam: BeamId(0),
        between: [At::Fraction(from), At::Fraction(to)],
        offset: [0.004.into(), 0.0.into()],
    };
    let with = |route: Vec<Guide>, law| {
        paths(|m| m.cables = vec![Cable { name: "flexor".into(), route: route.clone(), law }])
    };
    let pull = CableLaw::Tension(10.0);
    assert_eq!(with(vec![point(Mount::Ground), beam(1.0)], pull), [""; 0]);
    assert_eq!(with(vec![channel(1.0, 0.0)], CableLaw::Length(0.1)), [""; 0]);
    assert_eq!(with(vec![channel(0.0, 1.0)], CableLaw::Tension(-1.0)), ["cable.flexor.tension"]);
    assert_eq!(with(vec![channel(0.0, 1.0)], CableLaw::Length(0.0)), ["cable.flexor.length"]);
    assert_eq!(with(vec![beam(0.5)], pull), ["cable.flexor.route"]);
    assert_eq!(with(Vec::new(), pull), ["cable.flexor.route"]);
    assert_eq!(with(vec![beam(0.5), beam(0.5)], pull), ["cable.flexor.route[1]"]);
    assert_eq!(with(vec![channel(0.3, 0.3)], pull), ["cable.flexor.route[0].to"]);
    assert_eq!(with(vec![channel(0.3, 1.3)], pull), ["cable.flexor.route[0].to"]);
    let lost = point(Mount::Body(BodyId(0)));
    assert_eq!(with(vec![lost, beam(0.5)], pull), ["cable.flexor.route[0].body"]);
    let notch = Notch { shape: NotchShape::Circular { radius: 0.01 }, thickness: 0.001, center: None };
    let Guide::Channel { beam, between, .. } = channel(0.0, 1.0) else { panic!() };
    let notched = Guide::Channel { beam, between, offset: [0.0.into(), Profile::Notch(notch)] };
    assert_eq!(with(vec![notched], pull), ["cable.flexor.route[0].offset[1]"]);
}

#[test]
fn unknowns_and_targets_come_in_equal_numbers() {
    let probe = Probe { target: ProbeTarget::Model, quantity: Quantity::Energy, component: 0 };
    let output = |formulas| Output { name: "e".into(), unit: "N*m".into(), formulas, probes: vec![probe] };
    let with = |unknowns: &[Unknown], value: f64, formulas: usize| {
        let target = Target { output: output(vec![Formula::slot(0); formulas]), value };
        paths(|m| {
            m.parameters =
                vec![Parameter { name: "push".into(), value: 2.0, unit: "N".into(), ..Parameter::default() }];
            (m.unknowns, m.targets) = (unknowns.to_vec(), vec![target.clone()]);
        })
    };
    let push = |range| Unknown { parameter: 0, range };
    assert_eq!(with(&[push(Some([0.0, 10.0]))], 1.0, 1), [""; 0]);
    assert_eq!(with(&[push(Some([3.0, 10.0]))], 1.0, 1), ["unknown.push.range"]);
    assert_eq!(with(&[push(Some([3.0, 1.0]))], 1.0, 1), ["unknown.push.range"]);
    assert_eq!(with(&[push(None)], f64::NAN, 1), ["target"]);
    assert_eq!(with(&[push(None)], 1.0, 3), ["target"]);
    assert_eq!(with(&[], 1.0, 1), ["target"]);
    assert_eq!(with(&[push(None), push(None)], 1.0, 1), ["unknown.push", "unknown"]);
    assert_eq!(with(&[Unknown { parameter: 4, range: None }], 1.0, 1), ["unknown"]);
}

#[test]
fn notches_must_fit_their_beam() {
    let with = |shape, thickness, center| {
        let height = Profile::Notch(Notch { shape, thickness, center });
        paths(|m| m.sections[0].shape = Shape::Rectangle { width: 0.01.into(), height: height.clone() })
    };
    let circular = |radius| NotchShape::Circular { radius };
    let filleted = |radius, length| NotchShape::CornerFilleted { radius, length };
    let middle = Some(At::Fraction(0.5));
    assert_eq!(with(circular(0.05), 1e-3, None), [""; 0]);
    assert_eq!(with(circular(0.01), 1e-3, middle), [""; 0]);
    assert_eq!(with(filleted(0.01, None), 1e-3, None), [""; 0]);
    let height = ["section.wire.height"];
    assert_eq!(with(circular(0.01), 1e-3, None), height);
    assert_eq!(with(circular(0.01), 1e-3, Some(At::Length(0.095))), height);
    assert_eq!(with(circular(0.05), 0.0, None), ["section.wire.height.thickness"]);
    assert_eq!(with(filleted(0.06, None), 1e-3, None), ["section.wire.height.radius"]);
    assert_eq!(with(filleted(0.01, Some(0.015)), 1e-3, middle), ["section.wire.height.length"]);
    assert_eq!(
        with(NotchShape::Elliptic { along: 0.05, across: -1.0 }, 1e-3, None),
        ["section.wire.height.semi_axis_across"]
    );
}

#[test]
fn tubes_nest_and_the_innermost_reaches_farthest() {
    let tube = |section, straight: f64, curved: f64| Tube {
        material: Some(MaterialId(0)),
        section: SectionId(section),
        straight,
        curved,
        curvature: 12.5,
        rotation: 0.5,
        translation: -0.02,
    };
    let section = |name: &str, shape| Section { name: name.into(), shape, plane_strain: false };
    let pipe =
        |outer: f64, inner: f64| Shape::Tube { outer_diameter: outer.into(), inner_diameter: inner.into() };
    let direct = |ei2: f64, ei3: f64| Shape::Stiffness {
        ea: f64::INFINITY.into(),
        gj: 0.01.into(),
        ei2: ei2.into(),
        ei3: ei3.into(),
        ga2: None,
        ga3: None,
        mass_per_length: None,
        rotary_inertia: None,
    };
    let with = |change: &dyn Fn(&mut Tubes, &mut Vec<Section>)| {
        paths(|m| {
            let sections = [pipe(2e-3, 1.2e-3), pipe(3e-3, 2.2e-3), direct(0.02, 0.02)];
            m.sections.extend(["middle", "outer", "direct"].iter().zip(sections).map(|(n, s)| section(n, s)));
            let mut tubes = Tubes {
                name: "robot".into(),
                base: Frame { mount: Mount::Ground, pose: Pose::identity() },
                tubes: vec![tube(0, 0.2, 0.06), tube(1, 0.15, 0.05), tube(2, 0.1, 0.0)],
                force: Vector3::zeros(),
                moment: Vector3::zeros(),
            };
            change(&mut tubes, &mut m.sections);
            m.tubes = vec![tubes];
        })
    };
    let tubes = |change: &dyn Fn(&mut Vec<Tube>)| with(&|t, _| change(&mut t.tubes));
    assert_eq!(tubes(&|_| {}), [""; 0]);
    assert_eq!(tubes(&|t| t.truncate(1)), [""; 0]);
    assert_eq!(tubes(&|t| t.clear()), ["tubes.robot.tube"]);
    let five = |t: &mut Vec<Tube>| *t = vec![Tube { material: None, ..tube(3, 0.1, 0.0) }; 5];
    assert_eq!(tubes(&five), ["tubes.robot.tube"]);
    assert_eq!(with(&|t, _| t.base.mount = Mount::Body(BodyId(0))), ["tubes.robot.base.body"]);
    let section = Mount::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) });
    assert_eq!(with(&|t, _| t.base.mount = section), ["tubes.robot.base.beam"]);
    assert_eq!(with(&|t, _| t.base.pose.position.x = f64::NAN), ["tubes.robot.base.at"]);
    assert_eq!(with(&|t, _| t.force.y = f64::INFINITY), ["tubes.robot.force"]);
    assert_eq!(with(&|t, _| t.moment.y = f64::NAN), ["tubes.robot.moment"]);

    assert_eq!(tubes(&|t| t[1].straight = -0.1), ["tubes.robot.tube[1].straight"]);
    assert_eq!(tubes(&|t| t[0].curved = f64::NAN), ["tubes.robot.tube[0].curved"]);
    assert_eq!(tubes(&|t| t[0].curvature = f64::INFINITY), ["tubes.robot.tube[0].curvature"]);
    assert_eq!(tubes(&|t| t[2].rotation = f64::NAN), ["tubes.robot.tube[2].rotation"]);
    assert_eq!(tubes(&|t| t[2].translation = 0.001), ["tubes.robot.tube[2].translation"]);
    assert_eq!(tubes(&|t| t[2].translation = 0.0), [""; 0]);
    assert_eq!(tubes(&|t| t[2].translation = -0.1), ["tubes.robot.tube[2]"]);
    assert_eq!(tubes(&|t| t[0].translation = -0.17), ["tubes.robot.tube[1]"]);
    // Within the guide a curved part may begin, and tubes may end together.
    assert_eq!(tubes(&|t| t[0].translation = -0.08), [""; 0]);
    assert_eq!(tubes(&|t| t[1].straight = -0.02 - t[1].curved - t[1].translation + 0.26), [""; 0]);

    assert_eq!(tubes(&|t| t[1].section = SectionId(9)), ["tubes.robot.tube[1].section"]);
    assert_eq!(tubes(&|t| t[1].material = Some(MaterialId(9))), ["tubes.robot.tube[1].material"]);
    assert_eq!(tubes(&|t| t[1].material = None), ["tubes.robot.tube[1]"]);
    let direct_between = |t: &mut Vec<Tube>| (t[1].section, t[1].material) = (SectionId(3), None);
    assert_eq!(tubes(&direct_between), [""; 0]);
    // What is known on both sides of it must still fit.
    let too_wide = |t: &mut Vec<Tube>, s: &mut Vec<Section>| {
        direct_between(t);
        s[0].shape = Shape::Circle { diameter: 2.5e-3.into() };
    };
    let last = ["tubes.robot.tube[2].section"];
    assert_eq!(with(&|t, s| too_wide(&mut t.tubes, s)), last);
    assert_eq!(tubes(&|t| t[2].section = SectionId(0)), last);
    assert_eq!(with(&|_, s| s[2].shape = pipe(3e-3, 1.9e-3)), last);
    assert_eq!(with(&|_, s| s[2].shape = pipe(3e-3, 2e-3)), [""; 0]);
    let rectangle = Shape::Rectangle { width: 1e-3.into(), height: 1e-3.into() };
    assert_eq!(with(&|_, s| s[2].shape = rectangle.clone()), last);
    assert_eq!(with(&|_, s| s[2].shape = direct(0.02, 0.03)), last);
    assert_eq!(with(&|_, s| s[2].shape = direct(f64::INFINITY, f64::INFINITY)), last);
    assert_eq!(with(&|_, s| s[2].plane_strain = true), last);
    let taper = Profile::Function(Function::parse("3e-3 - 1e-6*s", "s").unwrap());
    let tapered = Shape::Tube { outer_diameter: taper, inner_diameter: 2.2e-3.into() };
    assert_eq!(with(&|_, s| s[2].shape = tapered.clone()), last);
}

fn doubts(change: impl Fn(&mut Model)) -> Vec<String> {
    let mut model = good();
    change(&mut model);
    assert_eq!(model.validate(), []);
    model.doubts().into_iter().map(|issue| issue.path).collect()
}

#[test]
fn the_moduli_of_a_composite_are_sound_and_noted() {
    assert!(doubts(|_| ()).is_empty());
    assert_eq!(doubts(|m| m.materials[0].shear = 1e9), ["material.steel.shear"]);
    // Rubber and cork lie within.
    assert!(doubts(|m| m.materials[0].shear = 207e9 / 3.0).is_empty());
    assert!(doubts(|m| m.materials[0].shear = 207e9 / 2.0).is_empty());
    // Plane strain divides by 1 - ν², of which nothing is known then.
    let strip = Shape::Rectangle { width: 0.02.into(), height: 1e-3.into() };
    let plane = |m: &mut Model| {
        m.sections[0].shape = strip.clone();
        m.sections[0].plane_strain = true;
    };
    assert!(paths(plane).is_empty());
    let composite = |m: &mut Model| {
        plane(m);
        m.materials[0].shear = 1e9;
    };
    assert_eq!(paths(composite), ["section.wire.plane_strain"]);
}

#[test]
fn a_section_as_thick_as_its_beam_is_long_is_doubted_once() {
    let wire = |diameter: f64| {
        move |m: &mut Model| m.sections[0].shape = Shape::Circle { diameter: diameter.into() }
    };
    assert!(doubts(wire(0.05)).is_empty());
    assert_eq!(doubts(wire(0.1)), ["section.wire.diameter"]);
    let strip = |width: f64, height: f64| {
        move |m: &mut Model| {
            m.sections[0].shape = Shape::Rectangle { width: width.into(), height: height.into() }
        }
    };
    assert!(doubts(strip(0.2, 1e-3)).is_empty());
    assert_eq!(doubts(strip(20.0, 1e-3)), ["section.wire.width"]);
    let four = |m: &mut Model| {
        wire(1.0)(m);
        for name in ["b", "c", "d"] {
            let beam = Beam { name: name.into(), ..m.beams[0].clone() };
            m.beams.push(beam);
        }
    };
    let mut model = good();
    four(&mut model);
    let told = model.doubts();
    assert_eq!(told.len(), 1);
    assert!(told[0].message.ends_with("(and so of 3 other beams)"), "{}", told[0].message);
}

#[test]
fn gravity_without_a_mass_is_doubted() {
    let heavy = |m: &mut Model| m.gravity = Vector3::new(0.0, 0.0, -9.81);
    assert_eq!(doubts(heavy), ["gravity"]);
    let dense = |m: &mut Model| {
        heavy(m);
        m.materials[0].density = Some(7800.0);
    };
    assert!(doubts(dense).is_empty());
    let carries = |m: &mut Model| {
        heavy(m);
        let point = BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) };
        m.masses.push(PointMass {
            name: "m".into(),
            point,
            mass: 1.0,
            inertia: flexura_spatial::Matrix3::zeros(),
        });
    };
    assert!(doubts(carries).is_empty());
}

#[test]
fn a_frame_that_changes_nothing_is_refused() {
    let along = SectionFrame::Direction { along: Vector3::z() };
    let start = SectionFrame::RotationMinimising { start: Some(Vector3::z()), twist: None };
    let twist = Function::constant(0.0);
    let twisted = SectionFrame::RotationMinimising { start: None, twist: Some(twist) };
    for (frame, idle) in [(along, true), (start, true), (twisted, false), (SectionFrame::Natural, false)] {
        let on =
            |curve: Curve| paths(|m| (m.beams[0].frame, m.beams[0].curve) = (frame.clone(), curve.clone()));
        let line: Vec<Vector3<f64>> = [0.0, 0.03, 0.1].map(|x| Vector3::new(x, 2.0 * x, 0.0)).into();
        for curve in [Curve::Straight { length: 0.1 }, Curve::Points { points: line }] {
            assert_eq!(on(curve).contains(&"beam.link.frame".to_string()), idle, "{frame:?}");
        }
        assert!(on(Curve::Arc { radius: 0.1, angle: 1.0 }).is_empty(), "{frame:?}");
        let given = Curve::Curvature { curvature: [0.0, 0.0, 1.0].map(Profile::from), length: 0.1 };
        assert_eq!(on(given).is_empty(), frame == SectionFrame::Natural, "{frame:?}");
    }
}
