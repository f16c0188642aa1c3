//! Every solve ends, and says truly what ended it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};

fn solved(text: &str, overrides: &[(&str, &str)]) -> Solution {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}"));
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}"));
    let solution = solve(&model, &Options::default(), &mut |_| {}).unwrap_or_else(|error| panic!("{error}"));
    assert!(solution.work.newton_steps < 60_000, "{:?}", solution.work);
    solution
}

fn reason(solution: &Solution) -> &str {
    assert_ne!(solution.status, Status::Converged);
    solution.reason.as_deref().unwrap()
}

/// A rod of 1 m that does not stretch, pinned 1.0021 m away.
const TOO_FAR: &str = r#"
format = 1
[parameter]
far = 1.002
[section.a]
shape = "stiffness"
EA = 1e6
GJ = 1
EI2 = 1
EI3 = 2
[beam.r]
section = "a"
length = 1
extension = false
start = { body = "ground", hold = "clamp" }
end = { body = "ground", at = ["far", 0.01, 0.01], hold = "pin", stiffness = 0.1 }
[load.l]
beam = "r"
at = 0.25
force = [0, 1, 0]
"#;

#[test]
fn a_rod_pulled_beyond_its_length_ends_and_is_no_fold() {
    for far in ["1.002", "1.0005", "1.2", "3"] {
        let solution = solved(TOO_FAR, &[("far", far)]);
        assert!(reason(&solution).contains("forces grow beyond all bounds"), "{far}: {:?}", solution.reason);
    }
    // √(0.9995² + 2·0.01²) is shorter than the rod: it bows, and reaches.
    assert_eq!(solved(TOO_FAR, &[("far", "0.9995")]).status, Status::Converged);
}

#[test]
fn huge_loads_and_tiny_stiffnesses_end_soon() {
    let models = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
    for (file, parameter, value) in [
        ("tendon_robot.toml", "pull_1", "1e300 N"),
        ("tendon_robot.toml", "pull_1", "1e30 N"),
        ("tendon_robot.toml", "pull_1", "1e9 N"),
        ("curved_hook.toml", "pull", "1e12 N"),
    ] {
        let text = std::fs::read_to_string(format!("{models}/{file}")).unwrap();
        let solution = solved(&text, &[(parameter, value)]);
        assert!(!reason(&solution).is_empty());
    }
    // As in a file in which the unit of Young's modulus is wrong: the load is not mistaken for a fold.
    let text = std::fs::read_to_string(format!("{models}/curved_hook.toml")).unwrap();
    let _ = solved(&text.replace("200 GPa", "200 kPa"), &[]);
}

const DRIVEN: &str = r#"
format = 1
[parameter]
d = 1.2
nudge = 0.01
[section.s]
shape = "stiffness"
EA = 1e6
GJ = 1e3
EI2 = 1e3
EI3 = 1
[body.end]
at = [1, 0, 0]
[joint.rail]
kind = "prismatic"
parent = { body = "ground", at = [1, 0, 0] }
child = "end"
axis = [-1, 0, 0]
coordinate = "d"
[beam.rod]
section = "s"
length = 1
start = { body = "ground", hold = "clamp" }
end = { body = "end", hold = "clamp" }
[load.nudge]
beam = "rod"
at = 0.5
force = [0, "nudge", 0]
"#;

/// Its end is driven past its start, and past a pitchfork where both meet. 117.530 would be the push of a strut that does not stretch;
/// with EA = 1e6 it is 117.517, the value of the path in d.
#[test]
fn a_strut_is_driven_past_a_pitchfork() {
    let solution = solved(DRIVEN, &[]);
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let push = -solution.joints[0].wrench.force.x;
    assert!((push.abs() - 117.516_85).abs() < 2e-5, "{push}");
    assert!(
        solution.warnings.iter().any(|warning| warning.contains("branch point")),
        "{:?}",
        solution.warnings
    );
}

/// Without the nudge it stays straight past one branch point after the other, each unstable in one more direction.
#[test]
fn a_straight_strut_that_passes_many_branch_points_is_told() {
    let solution = solved(DRIVEN, &[("nudge", "0")]);
    let reason = reason(&solution);
    assert!(reason.contains("branch points") && reason.contains("symmetry"), "{reason}");
    // Near its first critical load, 4π² EI/L² over EA, it is where it should be.
    let early = solved(DRIVEN, &[("nudge", "0"), ("d", "50e-6")]);
    assert_eq!(early.unstable_directions, Some(1), "{:?}", early.reason);
}

/// x - x³/3-like snap of two inclined springs: P = 2 k (L0/√(1+a²)...): the greatest load of a von Mises truss of two springs k with
/// rest length ℓ0 and half span b is 2 k (ℓ0^⅔ - b^⅔)^(3/2).
#[test]
fn a_fold_is_called_a_fold() {
    let text = r#"
format = 1
[parameter]
f = 2
[body.crown]
at = [0, 0.5, 0]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = [0, 0.5, 0] }
child = "crown"
axis = [0, -1, 0]
effort = "f"
[spring.left]
from = { body = "ground", at = [-1, 0, 0] }
to = { body = "crown" }
stiffness = 10
[spring.right]
from = { body = "ground", at = [1, 0, 0] }
to = { body = "crown" }
stiffness = 10
"#;
    let rest = 1.25_f64.sqrt();
    let greatest = 20.0 * (rest.powf(2.0 / 3.0) - 1.0).powf(1.5);
    let solution = solved(text, &[]);
    assert!(reason(&solution).contains("fold"), "{:?}", solution.reason);
    assert!(
        (2.0 * solution.load_fraction - greatest).abs() < 1e-6,
        "{} of {greatest}",
        solution.load_fraction
    );
    assert_eq!(solved(text, &[("f", &(0.9999 * greatest).to_string())]).status, Status::Converged);
}

#[test]
fn a_path_that_ends_where_a_spring_goes_slack_says_so() {
    let solution = solved(include_str!("from_rest/spring_goes_slack.toml"), &[]);
    let reason = reason(&solution);
    assert!(reason.contains("spring.k0") && reason.contains("slack"), "{reason}");
    assert!(solution.work.load_steps < 1000, "{} steps", solution.work.load_steps);
}

#[test]
fn a_loop_that_does_not_close_is_not_said_to_close() {
    let text = r#"
format = 1
[body.a]
[joint.j]
kind = "weld"
parent = "ground"
child = "a"
[joint.k]
kind = "revolute"
parent = "ground"
child = "a"
axis = [0, 0, 1]
coordinate = "20 deg"
"#;
    let solution = solved(text, &[]);
    assert_eq!(solution.status, Status::Inconsistent);
    assert!(reason(&solution).contains("joint.j, joint.k"), "{:?}", solution.reason);
    assert!(
        solution.warnings.iter().all(|warning| !warning.contains("closes nonetheless")),
        "{:?}",
        solution.warnings
    );
}

#[test]
fn what_is_loose_is_named_though_round_off_hides_it() {
    let text = include_str!("from_rest/body_on_a_hold_with_one_spring.toml");
    for load in ["1", "0"] {
        let overrides = [("f".to_string(), load.to_string())];
        let model = Document::parse(text, "model.toml").unwrap().model(&overrides).unwrap();
        let error = solve(&model, &Options::default(), &mut |_| {}).expect_err("nothing holds the body");
        let message = error.to_string();
        assert!(message.contains("can move without resistance") && message.contains("body.b0"), "{message}");
    }
}
