//! Where there is no energy, or it is not built, no verdict is given, and the reason is.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Options, solve};

/// Number of unstable directions, or why it is not known.
fn verdict(text: &str) -> Result<usize, String> {
    let model = match Document::parse(text, "model.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(report) => panic!("{report}\n{text}"),
    };
    let solution = solve(&model, &Options { samples: 3, ..Options::default() }, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert_eq!(solution.stable, solution.unstable_directions.map(|count| count == 0));
    match solution.unstable_directions {
        Some(count) => {
            assert_eq!(solution.stability_reason, None);
            Ok(count)
        }
        None => Err(solution.stability_reason.unwrap()),
    }
}

fn cantilever(beam: &str, rest: &str) -> String {
    format!(
        r#"
format = 1
[section.rod]
shape = "stiffness"
EA = 1e4
GJ = 0.8
EI2 = 1
EI3 = 1.4
[beam.arm]
section = "rod"
length = 1
start = {{ body = "ground", hold = "clamp" }}
{beam}
{rest}
"#
    )
}

fn on_tip(load: &str) -> String {
    format!("[load.tip]\nbeam = \"arm\"\nat = 1\n{load}\n")
}

#[test]
fn loads_without_an_energy_are_named() {
    let cases = [
        (
            cantilever("", &on_tip("force = [0.3, 0.2, 0]\nframe = \"local\"")),
            "load.tip: a force that follows",
        ),
        (cantilever("", &on_tip("moment = [0, 0.2, 0.1]")), "load.tip: a moment that keeps its direction"),
        (
            cantilever("", &on_tip("moment = [0, 0.2, 0.1]\nframe = \"local\"")),
            "load.tip: a moment that follows",
        ),
        (
            cantilever("distributed = { force = [0, 0.2, 0], frame = \"section\" }", ""),
            "beam.arm: its distributed load follows",
        ),
        (
            cantilever("distributed = { moment = [0, 0.2, 0], frame = \"section\" }", ""),
            "beam.arm: its distributed load follows",
        ),
        (cantilever("distributed = { moment = [0, 0.2, 0] }", ""), "beam.arm: its distributed moment"),
        (
            cantilever(
                "",
                "[cable.tendon]\nlength = 0.995\nroute = [{ beam = \"arm\", from = 0, to = 1, offset = [0.05, 0] }]\n",
            ),
            "beam.arm: the stability of a beam with a tendon of given length",
        ),
    ];
    for (text, reason) in cases {
        let found = verdict(&text);
        assert!(found.as_ref().is_err_and(|why| why.starts_with(reason)), "{found:?}\n{text}");
    }
}

#[test]
fn loads_with_an_energy_are_decided() {
    let head = "end = { body = \"head\", hold = \"clamp\" }";
    let body = |joint: &str, load: &str| {
        format!(
            "[body.head]\nat = [1, 0, 0]\n[joint.guide]\nparent = {{ body = \"ground\", at = [1, 0, 0] }}\nchild = \"head\"\n{joint}\n[load.tip]\nbody = \"head\"\n{load}\n"
        )
    };
    let dead_moment = "moment = [0.1, 0.2, 0.3]";
    let following = "moment = [0.1, 0.2, 0.3]\nframe = \"local\"";
    let cases = [
        cantilever("", &on_tip("force = [0.3, 0.2, 0]")),
        cantilever("distributed = { force = [0, 0.2, 0] }", ""),
        // About one axis, fixed in space, a moment has the angle beside it.
        cantilever(head, &body("kind = \"cylindrical\"\naxis = [1, 0, 0]", dead_moment)),
        cantilever(head, &body("kind = \"planar\"\naxis = [0, 1, 0]", dead_moment)),
        cantilever(head, &body("kind = \"planar\"\naxis = [0, 1, 0]", following)),
        // What does not turn.
        cantilever(
            head,
            &body("kind = \"prismatic\"\naxis = [1, 0, 0]", "force = [0.1, 0.1, 0]\nframe = \"local\""),
        ),
        cantilever(head, &body("kind = \"prismatic\"\naxis = [1, 0, 0]", dead_moment)),
        cantilever(
            "",
            "[cable.tendon]\ntension = 0.5\nroute = [{ beam = \"arm\", from = 0, to = 1, offset = [0.05, 0] }]\n",
        ),
        cantilever(
            "",
            "[cable.tendon]\nlength = 0.41\nroute = [{ body = \"ground\", at = [1, 0.42, 0] }, { beam = \"arm\", at = 1 }]\n",
        ),
    ];
    for text in cases {
        assert_eq!(verdict(&text), Ok(0), "{text}");
    }
}

#[test]
fn a_moment_on_a_body_that_turns_about_two_axes_has_no_energy() {
    let text = cantilever(
        "end = { body = \"head\", hold = \"clamp\" }",
        r#"
[body.head]
at = [1, 0, 0]
[joint.cross]
kind = "universal"
axis = [0, 1, 0]
second_axis = [0, 0, 1]
parent = { body = "ground", at = [1, 0, 0] }
child = "head"
[load.tip]
body = "head"
moment = [0, 0.2, 0.1]
"#,
    );
    let found = verdict(&text);
    assert!(found.as_ref().is_err_and(|why| why.contains("more than one axis")), "{found:?}");
}

/// On an axis that a turning body carries along, a dead moment does work that depends on the way.
#[test]
fn an_axis_that_is_carried_along_is_not_fixed() {
    let text = r#"
format = 1
[body.first]
[body.second]
at = [0, 0, 1]
[joint.foot]
kind = "revolute"
axis = [0, 1, 0]
stiffness = 2
parent = "ground"
child = "first"
[joint.knee]
kind = "revolute"
axis = [1, 0, 0]
stiffness = 2
parent = { body = "first", at = [0, 0, 1] }
child = "second"
[load.twist]
body = "second"
moment = [0.1, 0.1, 0]
"#;
    assert!(verdict(text).is_err());
    // The first body turns about a fixed axis.
    let first = text.replace("body = \"second\"\nmoment", "body = \"first\"\nmoment");
    assert_eq!(verdict(&first), Ok(0));
}

#[test]
fn concentric_tubes_are_not_decided() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/concentric_tubes.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let found = verdict(&text);
    assert!(found.as_ref().is_err_and(|why| why.contains("concentric tubes")), "{found:?}");
}
