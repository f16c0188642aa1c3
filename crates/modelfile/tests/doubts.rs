//! What can be solved but is hardly meant is a warning at its place.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::Document;

const WIRE: &str = r#"
format = 1
[material.steel]
young = "200 GPa"
poisson = 0.3
[section.round]
shape = "circle"
diameter = "1 mm"
[beam.wire]
material = "steel"
section = "round"
length = "20 cm"
start = { body = "ground", hold = "clamp" }
[load.pull]
beam = "wire"
at = 1
force = [0, "0.5 N", 0]
"#;

fn warnings(text: &str) -> Vec<(String, String)> {
    let document = Document::parse(text, "x.toml").unwrap();
    document.model(&[]).unwrap_or_else(|report| panic!("{report}"));
    let at = |span: std::ops::Range<usize>| text[span].to_string();
    document
        .warnings()
        .into_iter()
        .map(|w| (at(w.span), format!("{}; {}", w.message, w.hint.unwrap())))
        .collect()
}

#[test]
fn a_thin_wire_is_taken_without_a_word() {
    assert_eq!(warnings(WIRE), []);
}

#[test]
fn a_diameter_without_its_unit_is_told() {
    let told = warnings(&WIRE.replace("diameter = \"1 mm\"", "diameter = 1"));
    let message = "the section measures 1 m and beam `wire` is 200 mm long: that is no beam; a number without a unit is in \
                   metres; is one missing?";
    assert_eq!(told, [("1".to_string(), message.to_string())]);
}

#[test]
fn many_turns_without_a_unit_are_told_and_with_one_are_not() {
    let turned = |angle: &str| {
        WIRE.replace(
            "hold = \"clamp\"",
            &format!("hold = \"clamp\", rotation = {{ axis = [0, 1, 0], angle = {angle} }}"),
        )
    };
    let told = warnings(&turned("-90"));
    let message = "an angle without a unit is in radians: -90 is -14.3 turns; write `\"-90 deg\"`, or `\"-90 rad\"` if it is meant so";
    assert_eq!(told, [("-90".to_string(), message.to_string())]);
    for angle in ["\"-90 deg\"", "\"90 rad\"", "6.283", "\"2*pi\"", "0"] {
        assert_eq!(warnings(&turned(angle)), [], "{angle}");
    }
    // A helix counts turns by a plain number.
    let helix = "curve = { kind = \"helix\", radius = \"10 mm\", pitch = \"5 mm\", turns = 12 }";
    assert_eq!(warnings(&WIRE.replace("length = \"20 cm\"", helix)), []);
}

#[test]
fn gravity_that_finds_no_mass_is_told() {
    let gravity = "format = 1\ngravity = [0, 0, \"-9.81 m/s^2\"]";
    let text = WIRE.replace("format = 1", gravity);
    let told = warnings(&text);
    assert_eq!(told.len(), 1);
    assert_eq!(told[0].0, "[0, 0, \"-9.81 m/s^2\"]");
    assert!(told[0].1.starts_with("gravity has nothing to act on"), "{}", told[0].1);
    assert_eq!(warnings(&text.replace("poisson = 0.3", "poisson = 0.3\ndensity = \"7800 kg/m^3\"")), []);
    let body = "[body.bob]\nmass = \"1 kg\"\n[joint.weld]\nkind = \"weld\"\nparent = { beam = \"wire\", at = 1 }\nchild = \"bob\"";
    assert_eq!(warnings(&format!("{text}\n{body}\n")), []);
}

#[test]
fn the_moduli_of_a_composite_are_noted_and_taken() {
    // Unidirectional carbon fibre in epoxy: E along the fibres and G in their plane do not go together by 2(1 + ν).
    let text = WIRE.replace("young = \"200 GPa\"\npoisson = 0.3", "young = \"70 GPa\"\nshear = \"5 GPa\"");
    let told = warnings(&text);
    assert_eq!(told.len(), 1);
    assert_eq!(told[0].0, "\"5 GPa\"");
    assert!(told[0].1.contains("(Poisson's ratio 6.000)"), "{}", told[0].1);
    let model = Document::parse(&text, "x.toml").unwrap().model(&[]).unwrap();
    assert_eq!((model.materials[0].young, model.materials[0].shear), (70e9, 5e9));
}

#[test]
fn a_stiffness_without_ea_is_for_beams_that_do_not_stretch() {
    let direct = "shape = \"stiffness\"\nGJ = \"1 N*m^2\"\nEI2 = \"1 N*m^2\"\nEI3 = \"1 N*m^2\"";
    let text = WIRE.replace("shape = \"circle\"\ndiameter = \"1 mm\"", direct);
    let refused = Document::parse(&text, "x.toml").unwrap().model(&[]).unwrap_err().to_string();
    assert!(
        refused.contains("the key `EA` is missing: it resists stretching, and beam `wire` may stretch"),
        "{refused}"
    );
    let rigid = text.replace("length = \"20 cm\"", "length = \"20 cm\"\nextension = false");
    let model = Document::parse(&rigid, "x.toml").unwrap().model(&[]).unwrap();
    let flexura_model::Shape::Stiffness { ea, .. } = &model.sections[0].shape else { panic!() };
    assert_eq!(ea.as_constant(), Some(f64::INFINITY));
}
