//! What a good file becomes, and that no mutilated one makes the reader panic.
#![allow(clippy::unwrap_used)]

use flexura_model::{
    At, Attachment, Curve, Drive, FoundationLaw, JointKind, LoadAxes, Model, Mount, Profile, Quantity,
    SectionFrame, Shape, SpringLaw,
};
use flexura_modelfile::{Document, reference_markdown, schema};
use proptest::prelude::*;

const ALL: &str = r#"
format = 1
name = "everything"
gravity = [0, 0, "-9.80665 m/s^2"]

[parameter]
push = "2*pull + 1 N"       # in any order
pull = "1 N"
slope = "30 deg"
size = 0.004                # bare: SI where a length is wanted

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7630 kg/m^3"
yield_strength = "1.1 GPa"

[section]
strip = { shape = "rectangle", width = "20.32 mm", height = "0.254 mm", plane_strain = true }
wire = { shape = "circle", diameter = "size/2" }
pipe = { shape = "tube", outer_diameter = "3 mm", inner_diameter = 0.002 }
oval = { shape = "ellipse", width = "3 mm - 0.01*s", height = "2 mm" }
taper = { shape = "rectangle", height = "1 mm", along = [{ at = 0, width = "20 mm" }, { at = "50 mm", width = 0.01 }] }
direct = { shape = "stiffness", EA = inf, GJ = "0.5 N*m^2", EI2 = 0.7, EI3 = "0.7 + 0.1*s", GA2 = "inf", GA3 = 4e5, mass_per_length = "20 g/m" }
full = { shape = "stiffness", matrix = [["9 N", 0, 0, 0, 0, "1 N*m"], [0, 9, 0, 0, 0, 0], [0, 0, 9, 0, 0, 0], [0, 0, 0, 9, 0, 0], [0, 0, 0, 0, 9, 0], ["1 N*m", 0, 0, 0, 0, "9 N*m^2"]] }

[beam.straight]
material = "steel"
section = "strip"
length = "152.4 mm"
shear = true
extension = false
start = { body = "ground", hold = "clamp", at = [0, 0, "10 mm"], rotation = { rpy = ["10 deg", "20 deg", "30 deg"] } }
end = { body = "slider", hold = "revolute", axis = [0, 0, 2], stiffness = "0.69 N*m/rad", rest = "slope" }
distributed = [
  { force = [0, 0, "-2 N/m"] },
  { moment = ["0.1 N*m/m", 0, "1e-3*s"], frame = "section" },
]

foundation = [
  { stiffness = "2 kN/m^2 + 1 kN/m^3*s", direction = [0, 0, 2] },
  { force = "1 kN/m^2*u + 5e7 N/m^4*u^3", direction = [0, 1, 0], axes = "section", from = 0.25, to = "100 mm" },
]

[beam.arc]
material = "steel"
section = "wire"
curve = { kind = "arc", radius = "50 mm", angle = "90 deg" }
frame = { kind = "direction", along = [0, 0, 1] }
start = { body = "ground", hold = "pin" }

[beam.helix]
material = "steel"
section = "pipe"
[beam.helix.curve]
kind = "helix"
radius = "7.239 mm"
pitch = "5.715 mm"
turns = 10
[beam.helix.frame]
kind = "frenet"
offset = "slope"

[beam.parametric]
material = "steel"
section = "oval"
curve = { kind = "parametric", x = "10 mm*cos(t)", y = "0.005*sin(t)", range = [0, "2*pi"] }
frame = { kind = "rotation_minimising", start = [0, 0, 3], twist = "10*s" }

[beam.spline]
material = "steel"
section = "taper"
curve = { kind = "points", points = [[0, 0, 0], ["10 mm", 0, 0], ["20 mm", "5 mm", 0]] }

[beam.bent]
section = "direct"
curve = { kind = "curvature", k3 = "2 + 30*s", k1 = "5 1/m", length = "100 mm" }

[beam.coupled]
section = "full"
length = 1

[body.slider]
at = ["152.4 mm", 0, 0]
rotation = { axis = [0, 0, 3], angle = "slope" }
mass = "0.3 kg"
center_of_mass = [0, 0, "5 mm"]
inertia = [1e-5, 1e-5, "20 kg*mm^2"]

[body.frame]
rotation = { quat_wxyz = [0.7071, 0, 0.7071, 0] }

[joint.way]
kind = "prismatic"
parent = { body = "ground", at = ["10 mm", 0, 0] }
child = "slider"
axis = [3, 0, 4]
effort = "3 N"
stiffness = "200 N/m"
limits = { range = [0, "20 mm"], stiffness = "10 N/mm" }

[joint.ball]
kind = "spherical"
parent = "slider"
child = { body = "frame", at = [0, 0, "1 mm"] }
coordinate = [0, 0, "30 deg"]

[spring.band]
from = { body = "ground", at = [0, 0, "50 mm"] }
to = { beam = "straight", at = 0.5 }
stiffness = "200 N/m"

[mass.sensor]
beam = "straight"
at = "76.2 mm"
mass = "50 g"

[load.push]
body = "slider"
force = ["-push", 0, 0]
frame = "local"

[load.tip]
beam = "helix"
at = 1
moment = [0, 0, "0.1 lbf*in"]

[output]
u1 = "body.slider.position.x - 152.4 mm"
w = "beam.straight[0.5].position"
s = "beam.straight[\"30 mm\"].stress/1.1 GPa"
f = "joint.way.effort/push"
q = "joint.ball.coordinate.z"
e = "model.energy + spring.band.tension*spring.band.length"
k = "max(beam.bent.start.curvature.k3, 1)"
"#;

fn model() -> Model {
    Document::parse(ALL, "all.toml").unwrap().model(&[]).unwrap_or_else(|report| panic!("{report}"))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * a.abs().max(b.abs()), "{a} is not {b}");
}

#[test]
fn every_table_arrives_in_the_model() {
    let model = model();
    assert_eq!(model.name, "everything");
    close(model.gravity.z, -9.80665);
    close(model.materials[0].shear, 207e9 / 2.6);
    let names: Vec<&str> = model.beams.iter().map(|beam| beam.name.as_str()).collect();
    assert_eq!(names, ["straight", "arc", "helix", "parametric", "spline", "bent", "coupled"]);
    assert!(model.sections[0].plane_strain);
    let Shape::Circle { diameter } = &model.sections[1].shape else { panic!() };
    assert_eq!(*diameter, Profile::Constant(0.002));
    let Shape::Ellipse { width, .. } = &model.sections[3].shape else { panic!() };
    close(width.value(0.1, 1.0), 0.002);
    let Shape::Rectangle { width, .. } = &model.sections[4].shape else { panic!() };
    assert_eq!(
        *width,
        Profile::Table { at: vec![At::Fraction(0.0), At::Length(0.05)], value: vec![0.02, 0.01] }
    );
    let Shape::Stiffness { ea, ga2, ei3, .. } = &model.sections[5].shape else { panic!() };
    assert_eq!(ea.as_constant(), Some(f64::INFINITY));
    assert_eq!(ga2.as_ref().unwrap().as_constant(), Some(f64::INFINITY));
    close(ei3.value(1.0, 1.0), 0.8);

    let straight = &model.beams[0];
    assert!(straight.theory.shear && !straight.theory.extension);
    let start = straight.start.as_ref().unwrap();
    assert_eq!((start.mount, start.hold.kind), (Mount::Ground, JointKind::Weld));
    let (roll, pitch, yaw) = start.placement.unwrap().rotation.euler_angles();
    close(roll, 10f64.to_radians());
    close(pitch, 20f64.to_radians());
    close(yaw, 30f64.to_radians());
    let end = straight.end.as_ref().unwrap();
    assert!(end.placement.is_none());
    close(end.hold.axis.z, 1.0);
    close(end.hold.coordinates[0].rest, 30f64.to_radians());
    assert_eq!(straight.distributed.len(), 2);
    close(straight.distributed[1].moment[2].value(0.1, 1.0), 1e-4);
    let [across, aside] = &straight.foundation[..] else { panic!() };
    let FoundationLaw::Linear(stiffness) = &across.law else { panic!() };
    close(stiffness.value(0.1, 0.1524), 2100.0);
    assert_eq!((across.direction, across.axes), (Some(flexura_spatial::Vector3::z()), LoadAxes::Global));
    assert_eq!(across.between, [At::Fraction(0.0), At::Fraction(1.0)]);
    let FoundationLaw::Force(force) = &aside.law else { panic!() };
    close(force.value(0.01), 60.0);
    close(force.jet(0.01)[1], 16000.0);
    assert_eq!((aside.axes, aside.between), (LoadAxes::Section, [At::Fraction(0.25), At::Length(0.1)]));

    let Curve::Helix { turns, .. } = model.beams[2].curve else { panic!() };
    assert_eq!(turns, 10.0);
    let Curve::Parametric { position, range } = &model.beams[3].curve else { panic!() };
    close(position[1].jet(0.0)[1], 0.005);
    close(range[1], std::f64::consts::TAU);
    let SectionFrame::RotationMinimising { start, twist } = &model.beams[3].frame else { panic!() };
    close(start.unwrap().z, 1.0);
    close(twist.as_ref().unwrap().value(0.1), 1.0);
    let Curve::Curvature { curvature, .. } = &model.beams[5].curve else { panic!() };
    close(curvature[2].value(0.1, 0.1), 5.0);

    close(model.bodies[0].inertia[(2, 2)], 2e-5);
    close(model.bodies[1].pose.rotation.norm(), 1.0);
    let way = &model.joints[0];
    close(way.law.axis.x, 0.6);
    close(way.parent.pose.position.x, 0.01);
    assert!(way.child_pose.is_none());
    assert_eq!(way.law.coordinates[0].drive, Drive::Free { effort: 3.0 });
    assert_eq!(way.law.coordinates[0].limits.unwrap().stiffness, Some(1e4));
    assert_eq!(model.joints[1].law.coordinates.len(), 3);
    assert!(
        matches!(model.springs[0].to, Attachment { mount: Mount::Beam(point), .. } if point.at == At::Fraction(0.5))
    );
    assert!(matches!(model.springs[0].law, SpringLaw::Linear { tension_only: false, .. }));
    assert_eq!((model.springs[0].rest_length, model.springs[0].size), (None, 1.0));
    assert_eq!(model.masses[0].point.at, At::Length(0.0762));
    close(model.loads[0].force.x, -3.0);
    let units: Vec<&str> = model.parameters.iter().map(|parameter| parameter.unit.as_str()).collect();
    assert_eq!(units, ["N", "N", "rad", ""]);
}

#[test]
fn outputs_become_formulas_over_probes() {
    let model = model();
    let output = |name: &str| model.outputs.iter().find(|output| output.name == name).unwrap();
    assert_eq!((output("u1").unit.as_str(), output("u1").probes.len()), ("m", 1));
    close(output("u1").formulas[0].evaluate(&[0.2]), 0.2 - 0.1524);
    let w = output("w");
    assert_eq!((w.formulas.len(), w.probes.len()), (3, 3));
    assert_eq!([0, 1, 2].map(|k| w.formulas[k].evaluate(&[7.0, 8.0, 9.0])), [7.0, 8.0, 9.0]);
    assert_eq!(output("s").unit, "");
    close(output("s").formulas[0].evaluate(&[1.1e9]), 1.0);
    // A parameter stays open, so that outputs follow it along a path.
    let f = output("f");
    assert_eq!(f.probes.iter().filter(|probe| probe.quantity == Quantity::Parameter).count(), 1);
    close(f.formulas[0].evaluate(&[6.0, 3.0]), 2.0);
    assert_eq!(output("q").probes[0].component, 2);
    assert_eq!((output("e").unit.as_str(), output("e").probes.len()), ("N*m", 3));
    assert_eq!(output("k").unit, "1/m");
}

fn set(overrides: &[(&str, &str)]) -> Result<Model, String> {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect();
    Document::parse(ALL, "all.toml").unwrap().model(&overrides).map_err(|report| report.render(false))
}

#[test]
fn overrides_reach_everything_that_depends_on_them() {
    close(set(&[("pull", "2 N")]).unwrap().loads[0].force.x, -5.0);
    close(set(&[("pull", "2")]).unwrap().loads[0].force.x, -5.0);
    close(set(&[("pull", "0.5 lbf")]).unwrap().parameters[0].value, 1.0 + 2.0 * 0.5 * 4.4482216152605);
    close(set(&[("push", "3*pull"), ("pull", "2 N")]).unwrap().loads[0].force.x, -6.0);
    close(set(&[("slope", "90 deg")]).unwrap().parameters[2].value, std::f64::consts::FRAC_PI_2);
    assert_eq!(
        set(&[("pusj", "2 N")]).unwrap_err(),
        "error: there is no parameter `pusj`\n --> --set:1:1\n  |\n1 | pusj=2 N\n  | ^^^^\n  |\n  = help: did you mean `push`?\n"
    );
    let error = set(&[("pull", "2 mm")]).unwrap_err();
    assert!(
        error.contains("expected a force (N), found a length (m)")
            && error.contains("1 | pull=2 mm\n  |      ^^^^"),
        "{error}"
    );
    let error = set(&[("pull", "push")]).unwrap_err();
    assert!(error.contains("in a circle"), "{error}");
    assert!(set(&[("pull", "")]).unwrap_err().contains("the expression is empty"));
    assert!(set(&[("pull", "1/0")]).unwrap_err().contains("gives no finite number"));
    assert!(set(&[("size", "0")]).unwrap_err().contains("must be finite and positive"));
}

#[test]
fn problems_know_line_column_key_value_and_hint() {
    let text = "format = 1\n[parameter]\n\"µ\" = \"2 Nn\" # ü\n";
    let report = Document::parse(text, "x.toml").unwrap().model(&[]).unwrap_err();
    let problem = &report.problems()[0];
    assert_eq!(
        (problem.line, problem.column, problem.path.as_str(), problem.value.as_str()),
        (3, 10, "parameter.µ", "Nn")
    );
    assert_eq!(&text[problem.span.clone()], "Nn");
    assert_eq!(problem.hint.as_deref(), Some("did you mean `nN`?"));
    assert!(report.render(true).contains("\u{1b}["));
    assert!(!report.render(false).contains('\u{1b}'));
}

#[test]
fn every_bundled_model_is_read() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let model = Document::read(&path).and_then(|document| document.model(&[]));
            model.unwrap_or_else(|report| panic!("{report}"));
        }
    }
}

#[test]
fn several_toml_mistakes_are_told_at_once() {
    for (text, count) in [("format = 1\nx = 20.32 mm\n", 1), ("format = 1\nx = 20 mm\n\n[a]\ny = \n", 2)] {
        let report = Document::parse(text, "x.toml").unwrap_err();
        assert_eq!(report.problems().len(), count, "{report}");
    }
}

#[test]
fn what_nothing_uses_is_a_warning() {
    let text = ALL.replace("pull = \"1 N\"", "pull = \"1 N\"\nspare = 3");
    let warnings = Document::parse(&text, "all.toml").unwrap().warnings();
    let messages: Vec<&str> = warnings.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(messages, ["the parameter `spare` is never used"]);
    assert!(warnings[0].render(false).starts_with("warning: the parameter"));
}

#[test]
fn ten_thousand_parameters_in_a_chain_are_no_stack_overflow() {
    let mut text = String::from("format = 1\n[parameter]\n");
    for i in 0..10_000 {
        text.push_str(&format!("p{i} = \"p{} + 1\"\n", i + 1));
    }
    text.push_str("p10000 = 0\n");
    let model = Document::parse(&text, "chain.toml").unwrap().model(&[]).unwrap();
    assert_eq!(model.parameters[0].value, 10_000.0);
    let text = text.replace("p10000 = 0\n", "p10000 = \"p0\"\n");
    let report = Document::parse(&text, "chain.toml").unwrap().model(&[]).unwrap_err();
    assert_eq!(report.problems().len(), 1);
}

#[test]
fn hostile_nesting_and_many_mistakes_are_answered_quickly() {
    for text in [
        format!("format = 1\nx = {}", "[".repeat(100_000)),
        format!("format = 1\nx = {}", "{a=".repeat(100_000)),
        format!("format = 1\n{}", "[a.".repeat(50_000)),
        format!("format = 1\n{}=1\n", vec!["a"; 50_000].join(".")),
        format!(
            "format = 1\n[parameter]\n{}",
            (0..50_000).map(|i| format!("p{i} = \"q\"\n")).collect::<String>()
        ),
        format!("format = 1\n{}", (0..50_000).map(|i| format!("p{i} = 1\n")).collect::<String>()),
    ] {
        let report = Document::parse(&text, "x.toml").and_then(|document| document.model(&[])).unwrap_err();
        assert!(report.render(false).len() < 200_000);
    }
}

#[test]
fn the_schema_is_json_and_knows_every_table() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).unwrap();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["additionalProperties"], false);
    for table in [
        "parameter",
        "material",
        "section",
        "beam",
        "body",
        "joint",
        "coupling",
        "spring",
        "cable",
        "tubes",
        "mass",
        "load",
        "output",
        "unknown",
        "target",
    ] {
        assert!(schema["properties"][table]["description"].is_string(), "{table}");
    }
    let repeat =
        &schema["properties"]["coupling"]["allOf"][0]["additionalProperties"]["properties"]["repeat"];
    assert!(repeat["description"].is_string());
    let page = reference_markdown();
    for word in [
        "`[",
        "yield_strength",
        "quat_wxyz",
        "inner_diameter",
        "| `lbf` |",
        "`beam.NAME.curve`",
        "## Repeating",
        "`compliance.ROW.COLUMN`",
        "`tubes.NAME.tube`",
        "| `tubes.NAME` |",
    ] {
        assert!(page.contains(word) || word == "`[", "{word}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn mutilated_files_never_panic(
        edits in prop::collection::vec((0usize..ALL.len(), 0u8..4, any::<u8>(), 0usize..ALL.len()), 1..8)
    ) {
        let mut bytes = ALL.as_bytes().to_vec();
        for (place, what, byte, other) in edits {
            let place = place % bytes.len();
            match what {
                0 => { bytes.remove(place); }
                1 => bytes.insert(place, byte),
                2 => bytes[place] = byte,
                _ => {
                    // A piece of the file in another place: more often still TOML than single bytes.
                    let from = other % bytes.len();
                    let piece: Vec<u8> = bytes[from..(from + 20).min(bytes.len())].to_vec();
                    bytes.splice(place..place, piece);
                }
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        match Document::parse(&text, "mutilated.toml").and_then(|document| document.model(&[])) {
            Ok(model) => prop_assert!(model.validate().is_empty()),
            Err(report) => {
                prop_assert!(!report.problems().is_empty());
                prop_assert!(!report.render(true).is_empty());
            }
        }
    }

    #[test]
    fn values_exchanged_for_others_never_panic(
        line in 0usize..ALL.lines().count(),
        value in prop::sample::select(vec![
            "1", "-1", "0", "inf", "nan", "\"\"", "\"x\"", "\"1 N\"", "\"s\"", "\"1/s\"", "[]", "[1, 2, 3]", "[[1]]", "{}",
            "{ at = 1 }", "true", "1979-05-27", "\"((\"", "\"inf - inf\"", "\"beam.arc[2]\"", "\"1e400\"", "[{}]", "0x7fffffffffffffffffff",
        ]),
    ) {
        let text: Vec<String> = ALL.lines().enumerate().map(|(i, old)| match old.split_once(" = ") {
            Some((key, _)) if i == line => format!("{key} = {value}"),
            _ => old.to_string(),
        }).collect();
        let text = text.join("\n");
        if let Err(report) = Document::parse(&text, "exchanged.toml").and_then(|document| document.model(&[])) {
            for problem in report.problems() {
                prop_assert!(text.get(problem.span.clone()).is_some());
            }
            prop_assert!(report.render(false).starts_with("error: "));
        }
    }
}
