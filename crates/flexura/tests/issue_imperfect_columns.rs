//! Slightly imperfect columns used to end on the branch bent against their own side load.

use flexura::{Options, modelfile::Document, solution::Solution, solve};

const STRIP: &str = r#"
format = 1
[material.steel]
young = "200 GPa"
shear = "80 GPa"
[section.strip]
shape = "rectangle"
width = "20 mm"
height = "10 mm"
[beam.column]
material = "steel"
section = "strip"
length = "1 m"
start = { body = "ground", hold = "clamp" }
"#;

fn solved(text: &str) -> Solution {
    let model = Document::parse(text, "column.toml").expect("sound TOML").model(&[]).expect("a sound model");
    let solution = solve(&model, &Options::default(), &mut |_| {}).expect("a held mechanism");
    assert_eq!(solution.status, flexura::solution::Status::Converged, "{:?}", solution.reason);
    solution
}

/// Twice the Euler load 822 N; the tip bows with the side load, and by the same amount whatever its size: the elastica
/// at 2 P_E has it at 0.797 L.
#[test]
fn a_cantilever_column_bows_with_its_side_load() {
    for side in [1.0, 0.3, 0.1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let load = format!("[load.push]\nbeam = \"column\"\nat = 1\nforce = [-1645, 0, {side}]\n");
        let solution = solved(&format!("{STRIP}{load}"));
        let z = solution.beams[0].samples.last().expect("samples").pose.position.z;
        assert!((z - 0.797).abs() < 1e-4, "side load {side} N: tip at {z}");
    }
}

/// Both ends clamped and 1 % nearer: N is close to the buckling load 4π² EI/L² = 13.16 kN, not to EA times the strain.
#[test]
fn a_shortened_column_bows_with_its_side_load() {
    let end = "end = { body = \"ground\", hold = \"clamp\", at = [0.99, 0, 0] }\n";
    for side in [1.0, 0.3, 1e-2, 1e-3, 1e-5] {
        let load = format!("[load.side]\nbeam = \"column\"\nat = 0.5\nforce = [0, 0, {side}]\n");
        let solution = solved(&format!("{STRIP}{end}{load}"));
        let sample = solution.beams[0].samples.iter().find(|s| (s.s - 0.5).abs() < 1e-9).expect("a sample");
        assert!((sample.pose.position.z - 0.0624).abs() < 1e-4, "side load {side} N: {:?}", sample.pose);
        assert!((sample.wrench.force.x + 13_227.0).abs() < 10.0, "side load {side} N: {:?}", sample.wrench);
    }
}
