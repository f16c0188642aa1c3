//! Joints of several coordinates, places on beams, couplings, cables and inverse problems.
#![allow(clippy::unwrap_used)]

use flexura_model::{
    At, CableLaw, Coupling, Drive, Guide, JointKind, Model, Mount, NotchShape, ProbeTarget, Profile,
    Quantity, Shape,
};
use flexura_modelfile::Document;

const BASE: &str = r#"
format = 1
[parameter]
radius = "20 mm"
[material.steel]
young = "207 GPa"
poisson = 0.3
[section.wire]
shape = "circle"
diameter = "1 mm"
[beam.left]
material = "steel"
section = "wire"
length = "100 mm"
start = { body = "ground", hold = "clamp" }
[beam.right]
material = "steel"
section = "wire"
length = "100 mm"
start = { beam = "left", at = 1, hold = "clamp" }
end = { beam = "left", at = "30 mm", offset = [0, "2 mm", 0], rotation = { rpy = [0, 0, "90 deg"] }, hold = "revolute", axis = [0, 0, 1] }
[body.nut]
"#;

fn read(more: &str, overrides: &[(&str, &str)]) -> Result<Model, String> {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect();
    let text = format!("{BASE}{more}");
    Document::parse(&text, "x.toml")
        .and_then(|document| document.model(&overrides))
        .map_err(|r| r.to_string())
}

fn model(more: &str) -> Model {
    read(more, &[]).unwrap_or_else(|report| panic!("{report}"))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs().max(b.abs())), "{a} is not {b}");
}

#[test]
fn a_joint_of_several_coordinates_has_a_table_for_each() {
    let model = model(
        r#"
[joint.screw]
kind = "cylindrical"
parent = "ground"
child = "nut"
axis = [0, 0, 2]
angle = { coordinate = "30 deg" }
position = { stiffness = "200 N/m", rest = "3 mm", effort = "1 N", limits = { range = [0, "5 mm"] } }
[joint.cardan]
kind = "universal"
parent = "ground"
child = "nut"
axis = [1, 0, 0]
second_axis = ["1e-4", 1, 0]
second = { effort = "2 N*m" }
[joint.table]
kind = "planar"
parent = "ground"
child = "nut"
axis = [0, 0, 1]
x_axis = [0, 1, 0]
y = { coordinate = "4 mm" }
[joint.bushing]
kind = "free"
parent = "ground"
child = "nut"
z = { stiffness = "100 N/m" }
rotation = { stiffness = "3 N*m/rad", rest = [0, 0, "10 deg"] }
"#,
    );
    let kinds: Vec<JointKind> = model.joints.iter().map(|joint| joint.law.kind).collect();
    assert_eq!(kinds, [JointKind::Cylindrical, JointKind::Universal, JointKind::Planar, JointKind::Free]);
    let screw = &model.joints[0].law;
    close(screw.axis.z, 1.0);
    assert_eq!(screw.coordinates[0].drive, Drive::Driven { coordinate: 30f64.to_radians() });
    assert_eq!(screw.coordinates[1].drive, Drive::Free { effort: 1.0 });
    assert_eq!((screw.coordinates[1].stiffness, screw.coordinates[1].rest), (200.0, 0.003));
    assert_eq!(screw.coordinates[1].limits.unwrap().range, [0.0, 0.005]);
    // An axis that is nearly at right angles is made so.
    let cardan = &model.joints[1].law;
    close(cardan.second_axis.x, 0.0);
    assert_eq!(cardan.coordinates[1].drive, Drive::Free { effort: 2.0 });
    let table = &model.joints[2].law;
    close(table.second_axis.y, 1.0);
    assert_eq!(table.coordinates[1].drive, Drive::Driven { coordinate: 0.004 });
    let bushing = &model.joints[3].law;
    assert_eq!(bushing.coordinates.len(), 6);
    assert_eq!(
        bushing.coordinates.iter().map(|c| c.stiffness).collect::<Vec<_>>(),
        [0.0, 0.0, 100.0, 3.0, 3.0, 3.0]
    );
    close(bushing.coordinates[5].rest, 10f64.to_radians());
}

#[test]
fn holds_know_the_same_kinds_as_joints() {
    let ends = [
        ("planar", "axis = [0, 1, 0], x = { stiffness = 3.0 }", JointKind::Planar),
        ("cylindrical", "axis = [0, 1, 0], angle = { coordinate = 0.1 }", JointKind::Cylindrical),
        ("universal", "axis = [0, 1, 0], second_axis = [1, 0, 0]", JointKind::Universal),
        (
            "free",
            "turning = { stiffness = 2.0 }, rotation = { axis = [0, 0, 1], angle = 0.3 }",
            JointKind::Free,
        ),
    ];
    for (hold, more, kind) in ends {
        let model = model(&format!(
            "[beam.third]\nmaterial = \"steel\"\nsection = \"wire\"\nlength = 0.1\n\
             start = {{ body = \"nut\", hold = \"{hold}\", {more} }}\n"
        ));
        let start = model.beams[2].start.as_ref().unwrap();
        assert_eq!(start.hold.kind, kind);
        assert_eq!(start.placement.is_some(), hold == "free");
    }
}

#[test]
fn a_section_of_a_beam_holds_what_a_body_holds() {
    let model = model(
        r#"
[joint.way]
kind = "prismatic"
parent = { beam = "left", at = 0.5, offset = [0, "2 mm", 0] }
child = { beam = "right", at = "20 mm" }
axis = [1, 0, 0]
[spring.band]
from = { beam = "left", at = 1, offset = [0, 0, "-3 mm"] }
to = { body = "nut", at = ["1 mm", 0, 0] }
stiffness = 5.0
"#,
    );
    let right = &model.beams[1];
    let Mount::Beam(start) = right.start.as_ref().unwrap().mount else { panic!() };
    assert_eq!((start.beam.0, start.at), (0, At::Fraction(1.0)));
    assert!(right.start.as_ref().unwrap().placement.is_none());
    let end = right.end.as_ref().unwrap();
    let Mount::Beam(point) = end.mount else { panic!() };
    assert_eq!((point.beam.0, point.at), (0, At::Length(0.03)));
    close(end.placement.unwrap().position.y, 0.002);
    close(end.placement.unwrap().rotation.angle(), 90f64.to_radians());
    let way = &model.joints[0];
    close(way.parent.pose.position.y, 0.002);
    assert!(matches!(way.child, Mount::Beam(point) if point.beam.0 == 1));
    assert!(way.child_pose.is_none());
    close(model.springs[0].from.point.z, -0.003);
}

const GEARS: &str = r#"
[body.wheel]
[joint.rack]
kind = "prismatic"
parent = "ground"
child = "nut"
axis = [1, 0, 0]
[joint.pinion]
kind = "revolute"
parent = "ground"
child = "wheel"
axis = [0, 0, 1]
[joint.screw]
kind = "cylindrical"
parent = "ground"
child = "wheel"
axis = [0, 0, 1]
"#;

fn coupling(relation: &str) -> Coupling {
    let more = format!("{GEARS}[coupling.mesh]\nrelation = \"{relation}\"\n");
    model(&more).couplings.remove(0)
}

#[test]
fn a_relation_becomes_factors_and_an_offset() {
    let terms = |coupling: &Coupling| -> Vec<(usize, usize, f64)> {
        coupling.terms.iter().map(|term| (term.joint.0, term.coordinate, term.factor)).collect()
    };
    let mesh = coupling("joint.rack.coordinate = radius*joint.pinion.angle");
    assert_eq!(terms(&mesh), [(0, 0, 1.0), (1, 0, -0.02)]);
    assert_eq!(mesh.offset.to_bits(), 0f64.to_bits());
    let mesh = coupling("joint.screw.position = 2 mm/turn*joint.screw.angle + 3 mm");
    assert_eq!((mesh.terms[0].coordinate, mesh.terms[1].coordinate), (1, 0));
    close(mesh.terms[1].factor, -0.002 / std::f64::consts::TAU);
    close(mesh.offset, 0.003);
    let mesh = coupling("2*(joint.pinion.angle - 30 deg)/3 + joint.screw.angle = joint.rack.position/radius");
    let found = terms(&mesh);
    assert_eq!(found.len(), 3);
    close(found[0].2, 2.0 / 3.0);
    close(found[2].2, -50.0);
    close(mesh.offset, 20f64.to_radians());
    // A coordinate that falls out is no term.
    let mesh =
        coupling("joint.pinion.angle - joint.pinion.angle + joint.screw.angle = joint.rack.position/radius");
    assert_eq!(mesh.terms.len(), 2);
}

#[test]
fn what_is_not_linear_is_refused_whatever_it_is_made_of() {
    for right in [
        "joint.pinion.angle^2",
        "joint.pinion.angle*joint.screw.angle",
        "abs(joint.pinion.angle)",
        "max(joint.pinion.angle, joint.screw.angle)",
        "1/joint.pinion.angle",
        "sqrt(joint.pinion.angle)",
        "joint.pinion.angle + 1e-6*sin(joint.pinion.angle)",
    ] {
        let more = format!("{GEARS}[coupling.mesh]\nrelation = \"joint.rack.coordinate/radius = {right}\"\n");
        let error = read(&more, &[]).unwrap_err();
        assert!(error.contains("not linear"), "{right}: {error}");
    }
}

const INVERSE: &str = r#"
[joint.way]
kind = "prismatic"
parent = "ground"
child = "nut"
axis = [1, 0, 0]
effort = "push + 1 N"
[output]
tip = "beam.left.end.position"
twice = "2*body.nut.position.x"
"#;

#[test]
fn unknowns_begin_with_their_guess_and_targets_are_formulas() {
    let more = format!(
        "{INVERSE}[unknown]\npush = {{ guess = \"3 N\", range = [\"0 N\", \"10 N\"] }}\n\
         radius = {{ guess = \"25 mm\" }}\n[target]\n\"body.nut.position.x\" = \"140 mm\"\n\
         \"output.tip.y - output.twice/2\" = \"radius/5\"\n"
    );
    let solved = model(&more);
    let names: Vec<&str> = solved.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    assert_eq!(names, ["radius", "push"]);
    assert_eq!((solved.parameters[1].value, solved.parameters[1].unit.as_str()), (3.0, "N"));
    close(solved.parameters[0].value, 0.025);
    assert_eq!((solved.unknowns[0].parameter, solved.unknowns[0].range), (1, Some([0.0, 10.0])));
    assert_eq!((solved.unknowns[1].parameter, solved.unknowns[1].range), (0, None));
    assert_eq!(solved.joints[0].law.coordinates[0].drive, Drive::Free { effort: 4.0 });
    close(solved.targets[0].value, 0.14);
    let second = &solved.targets[1];
    assert_eq!(second.output.name, "output.tip.y - output.twice/2");
    close(second.value, 0.005);
    assert_eq!(second.output.formulas.len(), 1);
    // The y of the tip, then the x of the body: only what the formula needs, whatever its slots are called.
    let values: Vec<f64> = second
        .output
        .probes
        .iter()
        .map(|probe| match (probe.target, probe.component) {
            (ProbeTarget::Beam(..), component) => [100.0, 7.0, 100.0][component],
            (ProbeTarget::Body(_), 0) => 2.0,
            other => panic!("{other:?}"),
        })
        .collect();
    close(second.output.formulas[0].evaluate(&values), 5.0);

    let overridden = read(&more, &[("push", "5 N")]).unwrap();
    close(overridden.parameters[1].value, 5.0);
    let bare = read(&more, &[("push", "5")]).unwrap();
    assert_eq!((bare.parameters[1].value, bare.parameters[1].unit.as_str()), (5.0, "N"));
    assert!(read(&more, &[("push", "5 mm")]).unwrap_err().contains("expected a force (N), found a length"));
}

#[test]
fn a_cable_runs_through_points_and_channels() {
    let model = model(
        r#"
[cable.flexor]
tension = "10 N"
route = [
  { body = "ground", at = ["-10 mm", 0, 0] },
  { beam = "left", at = 0.3, offset = [0, "4 mm", 0] },
  { beam = "left", from = 0.4, to = 1, offset = ["5 mm*cos(30*s)", "5 mm*sin(30*s)"] },
]
[cable.extensor]
length = "2*radius"
route = { beam = "right", from = 1, to = 0, offset = ["-4 mm", 0] }
[output]
pull = "cable.extensor.tension"
length = "cable.flexor.length"
"#,
    );
    let flexor = &model.cables[0];
    assert_eq!(flexor.law, CableLaw::Tension(10.0));
    let Guide::Point(point) = &flexor.route[1] else { panic!() };
    close(point.point.y, 0.004);
    let Guide::Channel { between, offset, .. } = &flexor.route[2] else { panic!() };
    assert_eq!(*between, [At::Fraction(0.4), At::Fraction(1.0)]);
    close(offset[1].value(0.05, 0.1), 0.005 * 1.5f64.sin());
    let extensor = &model.cables[1];
    assert_eq!(extensor.law, CableLaw::Length(0.04));
    let [Guide::Channel { offset, .. }] = &extensor.route[..] else { panic!() };
    assert_eq!(*offset, [Profile::Constant(-0.004), Profile::Constant(0.0)]);
    assert_eq!(model.outputs[0].probes[0].quantity, Quantity::Tension);
    assert!(matches!(model.outputs[1].probes[0].target, ProbeTarget::Cable(id) if id.0 == 0));
}

#[test]
fn quantities_have_their_dimensions_and_components() {
    let cases = [
        ("body.nut.displacement.y", "m", Quantity::Displacement, 1),
        ("beam.left.end.turning.z", "rad", Quantity::Turning, 2),
        ("body.nut.screw.axis.x", "", Quantity::ScrewAxis, 0),
        ("body.nut.screw.point.z", "m", Quantity::ScrewPoint, 2),
        ("body.nut.screw.pitch", "m/rad", Quantity::ScrewPitch, 0),
        ("body.nut.screw.angle", "rad", Quantity::ScrewAngle, 0),
        ("body.nut.motion.point.y", "m", Quantity::MotionPoint, 1),
        ("body.nut.motion.pitch", "m/rad", Quantity::MotionPitch, 0),
        ("body.nut.compliance.x.fx", "m/N", Quantity::Compliance, 0),
        ("beam.left[0.5].compliance.rz.fy", "rad/N", Quantity::Compliance, 31),
        ("body.nut.compliance.y.mz", "1/N", Quantity::Compliance, 11),
        ("body.nut.compliance.rx.my", "rad/N/m", Quantity::Compliance, 22),
        ("body.nut.stiffness.fx.y", "N/m", Quantity::Stiffness, 1),
        ("body.nut.stiffness.fz.rx", "N/rad", Quantity::Stiffness, 15),
        ("body.nut.stiffness.mx.y", "N", Quantity::Stiffness, 19),
        ("beam.left.start.stiffness.mz.rz", "N*m/rad", Quantity::Stiffness, 35),
        ("body.nut.center_of_compliance.x", "m", Quantity::CenterOfCompliance, 0),
        ("joint.rack.position", "m", Quantity::Coordinate, 0),
        ("joint.pinion.angle", "rad", Quantity::Coordinate, 0),
        ("joint.screw.position", "m", Quantity::Coordinate, 1),
        ("joint.screw.effort.angle", "N*m", Quantity::Effort, 0),
        ("joint.screw.effort.position", "N", Quantity::Effort, 1),
        ("joint.screw.moment.x", "N*m", Quantity::Moment, 0),
    ];
    let mut more = format!("{GEARS}[output]\n");
    for (i, (text, ..)) in cases.iter().enumerate() {
        more.push_str(&format!("o{i} = \"{text}\"\n"));
    }
    let model = model(&more);
    for (output, (text, unit, quantity, component)) in model.outputs.iter().zip(cases) {
        assert_eq!(output.unit, unit, "{text}");
        let probe = output.probes[0];
        assert_eq!((probe.quantity, probe.component), (quantity, component), "{text}");
    }
}

#[test]
fn a_dimension_may_be_a_notch() {
    let sections = r#"
[section.a]
shape = "rectangle"
width = "10 mm"
height = { notch = "circular", thickness = "0.5 mm", radius = "2 mm", at = 0.5 }
[section.b]
shape = "rectangle"
width = { notch = "elliptic", thickness = "0.5 mm", semi_axis_along = "4 mm", semi_axis_across = "1 mm" }
height = "5 mm"
[section.c]
shape = "circle"
diameter = { notch = "corner_filleted", thickness = "radius/10", radius = "1 mm", length = "8 mm", at = "10 mm" }
"#;
    let model = model(sections);
    let Shape::Rectangle { height: Profile::Notch(notch), .. } = &model.sections[1].shape else { panic!() };
    assert_eq!(
        (notch.shape, notch.center),
        (NotchShape::Circular { radius: 0.002 }, Some(At::Fraction(0.5)))
    );
    let Shape::Rectangle { width: Profile::Notch(notch), .. } = &model.sections[2].shape else { panic!() };
    assert_eq!((notch.shape, notch.center), (NotchShape::Elliptic { along: 0.004, across: 0.001 }, None));
    let Shape::Circle { diameter: Profile::Notch(notch) } = &model.sections[3].shape else { panic!() };
    assert_eq!(notch.shape, NotchShape::CornerFilleted { radius: 0.001, length: Some(0.008) });
    close(notch.thickness, 0.002);
    close(notch.rim(), 0.004);
}

const ROBOT: &str = r#"
[section.inner]
shape = "tube"
outer_diameter = "1.6 mm"
inner_diameter = "1.2 mm"
[section.outer]
shape = "stiffness"
EA = "inf"
GJ = 0.02
EI2 = 0.03
EI3 = 0.03
[tubes.robot]
base = { body = "nut", at = [0, 0, "50 mm"], rotation = { axis = [0, 1, 0], angle = "-90 deg" } }
force = [0, 0, "-0.2 N"]
tube = [
  { material = "steel", section = "inner", straight = "200 mm", curved = "60 mm", radius = "4*radius", rotation = "30 deg", translation = "-20 mm" },
  { section = "outer", straight = "100 mm" },
]
[tubes.bare]
base = "ground"
moment = ["2 N*mm", 0, 0]
[[tubes.bare.tube]]
section = "outer"
curved = "100 mm"
curvature = "-12 1/m"
[output]
height = "tubes.robot.position.z - 50 mm"
turn = "tubes.bare.rotation"
tangent = "tubes.robot.tangent.x"
"#;

#[test]
fn tubes_arrive_with_their_base_and_rest_curvature() {
    let model = model(ROBOT);
    let [robot, bare] = &model.tubes[..] else { panic!() };
    assert!(matches!(robot.base.mount, Mount::Body(id) if id.0 == 0));
    close(robot.base.pose.position.z, 0.05);
    let axis = robot.base.pose.rotation * nalgebra::Vector3::x();
    close(axis.z, 1.0);
    close(robot.force.z, -0.2);
    assert_eq!(robot.moment.norm(), 0.0);
    let [inner, outer] = &robot.tubes[..] else { panic!() };
    assert_eq!((inner.section.0, inner.material.map(|id| id.0)), (1, Some(0)));
    close(inner.curvature, 12.5);
    close(inner.rotation, 30f64.to_radians());
    close(inner.reach(), 0.24);
    assert_eq!((outer.material, outer.curved, outer.curvature, outer.translation), (None, 0.0, 0.0, 0.0));
    assert_eq!(bare.base.mount, Mount::Ground);
    close(bare.moment.x, 0.002);
    assert_eq!((bare.tubes.len(), bare.tubes[0].curvature, bare.tubes[0].straight), (1, -12.0, 0.0));

    let [height, turn, tangent] = &model.outputs[..] else { panic!() };
    assert!(matches!(height.probes[0].target, ProbeTarget::Tubes(id) if id.0 == 0));
    assert_eq!((height.probes[0].quantity, height.probes[0].component), (Quantity::Position, 2));
    assert_eq!((turn.unit.as_str(), turn.formulas.len()), ("rad", 3));
    assert!(matches!(turn.probes[0].target, ProbeTarget::Tubes(id) if id.0 == 1));
    assert_eq!((tangent.unit.as_str(), tangent.probes[0].quantity), ("", Quantity::Tangent));
}

#[test]
fn tubes_that_make_no_sense_are_refused() {
    let refused = |old: &str, new: &str, message: &str| {
        assert!(ROBOT.contains(old), "{old}");
        let error = read(&ROBOT.replacen(old, new, 1), &[]).unwrap_err();
        assert!(error.contains(message), "{error}");
    };
    refused("radius = \"4*radius\"", "radius = 0", "must be positive, is 0");
    refused("curved = \"100 mm\"", "straight = \"100 mm\"", "but there is no `curved`");
    refused("body = \"nut\", at = [0, 0, \"50 mm\"]", "beam = \"left\", at = 1", "not on a beam");
    refused("body = \"nut\", ", "", "the key `body` is missing");
    refused("base = \"ground\"", "base = 3", "expected the name of a body, or a table");
    refused("base = \"ground\"\n", "", "the key `base` is missing");
    refused("tubes.robot.position", "tubes.robut.position", "there is no set of tubes `robut`");
    refused("tubes.robot.position", "tubes.robot.tension", "there is no quantity `tension` here");
}
