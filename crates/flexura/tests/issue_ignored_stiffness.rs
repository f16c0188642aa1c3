//! The stiffness of a driven joint used to be ignored, and units in expressions of s refused.

use flexura::{Options, modelfile::Document, solve};

/// A drive must supply `Hᵀ W + k (q - rest)`: 1 N·m/rad over 400° is 6.981 N·m and 24.37 J.
#[test]
fn a_drive_works_against_the_stiffness_of_its_joint() {
    let text = r#"
format = 1
[body.arm]
[joint.motor]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 1, 0]
stiffness = 1
coordinate = "400 deg"
"#;
    let model = Document::parse(text, "motor.toml").expect("sound TOML").model(&[]).expect("a sound model");
    let solution = solve(&model, &Options::default(), &mut |_| {}).expect("a held mechanism");
    let angle = 400.0_f64.to_radians();
    assert!((solution.joints[0].coordinates[0] - angle).abs() < 1e-12);
    assert!((solution.joints[0].efforts[0] - angle).abs() < 1e-10, "{:?}", solution.joints[0].efforts);
    assert!((solution.energy - 0.5 * angle * angle).abs() < 1e-9, "{}", solution.energy);
}

#[test]
fn expressions_of_s_may_bear_units_throughout() {
    for width in ["20 mm - 5 mm/m*s", "20 mm*exp(-s/(1 m))", "20 mm*(1 - s/(2 m))", "0.02 - 0.005*s"] {
        let text = format!(
            "format = 1\n[material.m]\nyoung = 2e11\nshear = 8e10\n[section.s]\nshape = \"rectangle\"\nwidth = \"{width}\"\n\
             height = \"10 mm\"\n[beam.b]\nmaterial = \"m\"\nsection = \"s\"\nlength = \"1 m\"\n\
             start = {{ body = \"ground\", hold = \"clamp\" }}\n"
        );
        let model = Document::parse(&text, "taper.toml").expect("sound TOML").model(&[]);
        assert!(model.is_ok(), "{width}: {}", model.err().map(|r| r.render(false)).unwrap_or_default());
    }
}
