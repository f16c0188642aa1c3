//! More than one equilibrium under the same load, and starting from an earlier one.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, equilibria, solve};

/// Two inclined leaves that hold a shuttle between them: a switch that stays where it is pushed. Sideways and turning
/// motion is blocked by a slider, so the shuttle's travel tells the shape.
const SWITCH: &str = r#"
format = 1
[parameter]
push = "0 N"
[material.pp]
young = "1.4 GPa"
poisson = 0.4
[section.leaf]
shape = "rectangle"
width = "0.5 mm"
height = "5 mm"
[body.shuttle]
at = ["60 mm", "4 mm", 0]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = ["60 mm", "4 mm", 0] }
child = "shuttle"
axis = [0, 1, 0]
[beam.leaf]
material = "pp"
section = "leaf"
length = "sqrt((60 mm)^2 + (4 mm)^2)"
start = { body = "ground", hold = "clamp", rotation = { axis = [0, 0, 1], angle = "atan(4/60)" } }
end = { body = "shuttle", hold = "clamp" }
[load.push]
body = "shuttle"
force = [0, "-push", 0]
[output]
travel = "joint.way.coordinate"
"#;

fn travel(solution: &Solution) -> f64 {
    solution.joints[0].coordinates[0]
}

#[test]
fn random_pushes_find_the_other_shape_of_a_switch_and_the_shape_between() {
    let model = Document::parse(SWITCH, "switch.toml").unwrap().model(&[]).unwrap();
    let options = Options::default();
    let found = equilibria(&model, &options, 8, 1).unwrap();
    let mut travels: Vec<f64> = found.iter().map(travel).collect();
    assert!(travel(&found[0]).abs() < 1e-12, "the rest shape comes first");
    travels.sort_by(f64::total_cmp);
    // The other stable shape lies nearly as far beyond the middle; with a leaf clamped on both sides it is not quite.
    assert!(travels.len() >= 3, "{travels:?}");
    assert!(travels.iter().any(|t| (-8.1e-3..-6e-3).contains(t)), "{travels:?}");
    assert!(travels.iter().any(|t| (-6e-3..-2e-3).contains(t)), "{travels:?}");
    for solution in &found {
        assert_eq!(solution.status, Status::Converged);
        assert!(solution.residual < 1e-6);
    }
    // The same seed, the same answers.
    let again = equilibria(&model, &options, 8, 1).unwrap();
    assert_eq!(found.len(), again.len());
    assert!(found.iter().zip(&again).all(|(a, b)| travel(a).to_bits() == travel(b).to_bits()));
}

#[test]
fn a_result_given_as_start_keeps_the_solve_on_its_branch() {
    let document = Document::parse(SWITCH, "switch.toml").unwrap();
    let model = document.model(&[]).unwrap();
    let found = equilibria(&model, &Options::default(), 8, 1).unwrap();
    let other = found.iter().find(|s| travel(s) < -6e-3).expect("the other shape");
    let pushed = document.model(&[("push".into(), "0.02 N".into())]).unwrap();
    let options = Options { from: Some(Box::new(other.clone())), ..Options::default() };
    let solution = solve(&pushed, &options, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged);
    assert!(travel(&solution) < travel(other), "pushed a little further on the same side");
    assert!(travel(&solution) > travel(other) - 1e-3);
}
