//! What is said of leaves whose torsion is not that of free warping and small twist.
#![allow(clippy::unwrap_used)]

use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Options, solve_model};

/// A tape 10 x 0.1 mm, 100 mm long, turned at its end, which is free to move along.
fn tape(width: &str, turn: &str, length: &str) -> String {
    format!(
        r#"
format = 1
[material.steel]
young = "210 GPa"
shear = "80 GPa"
[section.tape]
shape = "rectangle"
width = "{width}"
height = "0.1 mm"
[body.grip]
at = ["{length}", 0, 0]
[joint.chuck]
kind = "cylindrical"
parent = {{ body = "ground", at = ["{length}", 0, 0] }}
child = "grip"
axis = [1, 0, 0]
angle.coordinate = "{turn}"
[beam.tape]
material = "steel"
section = "tape"
length = "{length}"
start = {{ body = "ground", hold = "clamp" }}
end = {{ body = "grip", hold = "clamp" }}
"#
    )
}

fn warnings(text: &str) -> Vec<String> {
    let model = Document::parse(text, "leaf.toml").and_then(|file| file.model(&[])).unwrap();
    let (solution, _) = solve_model(&model, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged);
    solution.warnings
}

/// The helicoid's torque GJ k + ½ E In k³ with In = w⁵t/180 and J = w t³/3 of a thin strip: at 90° on 100 mm it is 6.40 times that of
/// GJ k alone (A. E. Green, Proc. R. Soc. A 154 (1936) 430).
#[test]
fn a_tape_that_is_twisted_far_is_said_to_take_more_torque() {
    let (width, thickness, twist) = (10e-3_f64, 0.1e-3_f64, std::f64::consts::FRAC_PI_2 / 0.1);
    let more = 0.5 * 210e9 * width.powi(5) * thickness / 180.0 * twist.powi(2)
        / (80e9 * width * thickness.powi(3) / 3.0);
    let said = warnings(&tape("10 mm", "90 deg", "100 mm"));
    let told = said.iter().find(|warning| warning.contains("fibres at its edges")).unwrap();
    let percent: f64 = told.split("about ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((percent / (100.0 * more) - 1.0).abs() < 0.02, "{told}, {more}");
    assert!(warnings(&tape("10 mm", "1 deg", "100 mm")).iter().all(|warning| !warning.contains("fibres")));
}

/// T L/(GJ θ) = 1/(1 - tanh(μ/2)/(μ/2)) between clamps, μ = 4 √(3G/E) L/w, here 8.552 and 1.305.
#[test]
fn clamps_that_keep_a_wide_leaf_from_warping_are_told_with_what_they_do() {
    let mu = 4.0 * (3.0 * 80.0 / 210.0_f64).sqrt() * 2.0;
    let factor = 1.0 / (1.0 - (0.5 * mu).tanh() / (0.5 * mu));
    let said = warnings(&tape("50 mm", "0.01 deg", "100 mm"));
    let told = said.iter().find(|warning| warning.contains("warping")).unwrap();
    assert!(told.contains(&format!("μ = 4 √(3G/E) L/w = {mu:.3}")), "{told}");
    assert!(told.contains(&format!("about {factor:.3} times")), "{told}");
    // Ten times as long as wide and more the layers at its ends do not matter.
    assert!(warnings(&tape("10 mm", "0.01 deg", "100 mm")).iter().all(|warning| !warning.contains("warp")));
}

/// Bent in its plane a leaf is not twisted; where stiffnesses are asked for, those out of the plane count.
#[test]
fn a_leaf_that_is_bent_only_is_left_alone_unless_stiffnesses_are_asked_for() {
    let leaf = r#"
format = 1
[material.steel]
young = "210 GPa"
poisson = 0.3
[section.leaf]
shape = "rectangle"
width = "50 mm"
height = "0.5 mm"
plane_strain = true
[body.stage]
at = ["50 mm", 0, 0]
[beam.leaf]
material = "steel"
section = "leaf"
length = "50 mm"
start = { body = "ground", hold = "clamp" }
end = { body = "stage", hold = "clamp" }
[load.push]
body = "stage"
force = [0, 0, "1 N"]
"#;
    assert_eq!(warnings(leaf), Vec::<String>::new());
    let asked = format!("{leaf}[output]\nside = \"body.stage.compliance.y.fy\"\n");
    assert!(warnings(&asked).iter().any(|warning| warning.contains("stiffnesses are asked for")));
}
