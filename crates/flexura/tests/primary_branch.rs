//! The documented branch: at a symmetric pitchfork a solve stays on the path from rest, whatever its steps, and says so.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};

fn solved(text: &str, load: f64) -> Solution {
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}"));
    let overrides = [("f".to_string(), format!("{load:e}"))];
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}"));
    solve(&model, &Options::default(), &mut |_| {}).unwrap_or_else(|error| panic!("{error}"))
}

fn is_warned(solution: &Solution) -> bool {
    solution.warnings.iter().any(|warning| warning.contains("passes a branch point"))
}

/// Solves at many loads on either side of a critical one: stable without a warning before it, unstable with one behind.
fn sweep(name: &str, text: &str, critical: f64) {
    let mut parts: Vec<f64> = (1..=40).map(|i| 0.9 + 0.005 * i as f64).collect();
    for exponent in 2..=6 {
        parts.extend([-1.0, 1.0].map(|side| 1.0 + side * 2.7 * 10.0_f64.powi(-exponent)));
    }
    parts.extend([1.15, 1.3, 1.5]);
    for part in parts.into_iter().filter(|part| (part - 1.0).abs() > 1e-7) {
        let solution = solved(text, part * critical);
        assert_eq!(solution.status, Status::Converged, "{name} at {part}: {:?}", solution.reason);
        let wanted = usize::from(part > 1.0);
        assert_eq!(solution.unstable_directions, Some(wanted), "{name} at {part} of the critical load");
        assert_eq!(is_warned(&solution), part > 1.0, "{name} at {part}: {:?}", solution.warnings);
    }
}

const STRUT: &str = r#"
format = 1
[parameter]
f = 1
[section.strip]
shape = "stiffness"
EA = 1e4
GJ = 10
EI2 = 50
EI3 = 1
[body.head]
at = [1, 0, 0]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = [1, 0, 0] }
child = "head"
axis = [-1, 0, 0]
effort = "f"
[beam.strut]
section = "strip"
length = 1
"#;

/// Euler's four cases with EI = 1; the strut of EA = 1e4 is shorter by ε = P/EA when it buckles, at P = n² (1 - ε)... of its deformed
/// length: in this theory of an axis that stretches P (1 - P/EA) = P_E.
fn of_a_strut_that_stretches(euler: f64) -> f64 {
    let ea = 1e4;
    0.5 * ea * (1.0 - (1.0 - 4.0 * euler / ea).sqrt())
}

#[test]
fn struts_stay_straight() {
    let pi = std::f64::consts::PI;
    let hinge = "hold = \"revolute\", axis = [0, 0, 1]";
    let cases = [
        ("hinged strut", hinge, hinge, pi * pi),
        ("clamped strut", "hold = \"clamp\"", "hold = \"clamp\"", 4.0 * pi * pi),
        ("strut clamped and hinged", "hold = \"clamp\"", hinge, 20.190_728_556_4),
    ];
    for (name, start, end, euler) in cases {
        let ends = format!("start = {{ body = \"ground\", {start} }}\nend = {{ body = \"head\", {end} }}\n");
        sweep(name, &format!("{STRUT}{ends}"), of_a_strut_that_stretches(euler));
    }
}

#[test]
fn a_strut_of_twice_the_length_and_one_that_hardly_stretches_stay_straight() {
    let pi = std::f64::consts::PI;
    let ends =
        "start = { body = \"ground\", hold = \"clamp\" }\nend = { body = \"head\", hold = \"clamp\" }\n";
    let stiff = format!("{STRUT}{ends}")
        .replace("EA = 1e4", "EA = \"inf\"")
        .replace("length = 1", "length = 1\nextension = false");
    sweep("strut that does not stretch, under a dead load", &cantilever(), 0.25 * pi * pi);
    let long = stiff.replace("at = [1, 0, 0]", "at = [2, 0, 0]").replace("length = 1", "length = 2");
    let long = long.replace("extension = false", "extension = true").replace("EA = \"inf\"", "EA = 1e7");
    sweep("long strut", &long, 0.5 * 1e7 * (1.0 - (1.0 - 4.0 * pi * pi / 1e7).sqrt()));
}

fn cantilever() -> String {
    r#"
format = 1
[parameter]
f = 1
[section.strip]
shape = "stiffness"
EA = "inf"
GJ = 10
EI2 = 50
EI3 = 1
[beam.column]
section = "strip"
length = 1
extension = false
start = { body = "ground", hold = "clamp" }
[load.push]
beam = "column"
at = 1
force = ["-f", 0, 0]
"#
    .to_string()
}

/// A rigid bar of 1 m on a hinge of 2 N·m/rad under a dead load buckles at 2 N.
#[test]
fn a_rigid_bar_on_a_sprung_hinge_stays_upright() {
    let text = r#"
format = 1
[parameter]
f = 1
[body.bar]
at = [1, 0, 0]
[joint.foot]
kind = "revolute"
parent = "ground"
child = { body = "bar", at = [-1, 0, 0] }
axis = [0, 0, 1]
stiffness = 2
[load.push]
body = "bar"
force = ["-f", 0, 0]
"#;
    sweep("rigid bar", text, 2.0);
}

/// Two rigid bars with three equal springs in their joints k, pushed along: P = k/L (3 - √3)... by a slider at the far end:
/// with bars of 1 m, hinge springs c at the middle only, P L = 4 c... here one spring in the middle of two bars.
#[test]
fn two_bars_with_a_spring_between_stay_in_line() {
    let text = r#"
format = 1
[parameter]
f = 1
[body.first]
[body.second]
at = [1, 0, 0]
[body.slider]
at = [2, 0, 0]
[joint.foot]
kind = "revolute"
parent = "ground"
child = "first"
axis = [0, 0, 1]
[joint.middle]
kind = "revolute"
parent = { body = "first", at = [1, 0, 0] }
child = "second"
axis = [0, 0, 1]
stiffness = 3
[joint.head]
kind = "revolute"
parent = { body = "second", at = [1, 0, 0] }
child = "slider"
axis = [0, 0, 1]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = [2, 0, 0] }
child = "slider"
axis = [-1, 0, 0]
effort = "f"
"#;
    // Energy ½ c (2 α)² - P (2 - 2 cos α): P = 2 c/L.
    sweep("two bars", text, 6.0);
}

/// Lateral buckling of a cantilever on edge: P = 4.0126 √(EI GJ)/L², twice the first zero of J_(-1/4) (L. Prandtl, A. G. M.
/// Michell, 1899).
#[test]
fn a_strip_on_edge_stays_in_its_plane() {
    let text = r#"
format = 1
[parameter]
f = 1
[section.strip]
shape = "stiffness"
EA = "inf"
GJ = 1
EI2 = 1
EI3 = "inf"
[beam.strip]
section = "strip"
length = 1
extension = false
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "strip"
at = 1
force = [0, "-f", 0]
"#;
    sweep("strip on edge", text, 4.012_599_3);
}

/// A column on a bed of stiffness k buckles at π² EI/L² + k L²/π² in one half wave.
#[test]
fn a_column_on_an_elastic_bed_stays_straight() {
    let pi = std::f64::consts::PI;
    let hinge = "hold = \"revolute\", axis = [0, 0, 1]";
    let ends = format!(
        "start = {{ body = \"ground\", {hinge} }}\nend = {{ body = \"head\", {hinge} }}\nfoundation = {{ stiffness = 40, direction = [0, 1, 0] }}\n"
    );
    let text = format!("{STRUT}{ends}").replace("EA = 1e4", "EA = 1e8");
    let critical = pi * pi + 40.0 / (pi * pi);
    sweep("column on a bed", &text, critical * (1.0 + critical / 1e8));
}

/// A strut between clamps whose head slides obliquely: the path from rest bends, and keeps its symmetry about the middle. Critical at
/// 0.7166 of the load by the trace, whose branch points are found on another way.
#[test]
fn a_strut_with_an_oblique_slider_keeps_its_symmetry() {
    let text = include_str!("from_rest/oblique_slider.toml");
    for i in 0..81 {
        let load = 0.70 + 0.0005 * i as f64;
        let solution = solved(text, load);
        assert_eq!(solution.status, Status::Converged, "at {load}: {:?}", solution.reason);
        let beyond = load > 0.716_613;
        assert_eq!(solution.unstable_directions, Some(usize::from(beyond)), "at {load}");
        assert_eq!(is_warned(&solution), beyond, "at {load}: {:?}", solution.warnings);
    }
}
