//! Joint coordinates that turn on beyond half a turn.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};

fn solved(text: &str) -> Solution {
    let model = Document::parse(text, "model.toml").and_then(|file| file.model(&[]));
    let model = model.unwrap_or_else(|report| panic!("{report}\n{text}"));
    let solution = solve(&model, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    solution
}

/// What is driven reads what it was driven to, and a leaf about whose stiff plane it is bent bears EI θ/L.
#[test]
fn a_free_joint_reads_the_turning_that_it_was_driven_to() {
    for degrees in [170.0_f64, 190.0, 540.0, 1000.0, 1080.0, -1000.0] {
        let text = format!(
            "format = 1\n[section.leaf]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = 1\nEI2 = 1\nEI3 = 1\n[body.s]\nat = [1, 0, 0]\n\
             [beam.l]\nsection = \"leaf\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n\
             end = {{ body = \"s\", hold = \"clamp\" }}\n[joint.j]\nkind = \"free\"\nparent = \"ground\"\nchild = \"s\"\n\
             rotation = {{ coordinate = [0, \"{degrees} deg\", 0] }}\n"
        );
        let joint = &solved(&text).joints[0];
        let turned = degrees.to_radians();
        assert_eq!(joint.coordinates[3..], [0.0, turned, 0.0], "{degrees}");
        assert!((joint.efforts[4] - turned).abs() < 1e-6 * turned.abs(), "{degrees}: {:?}", joint.efforts);
    }
    for kind in ["spherical", "free"] {
        let key = if kind == "free" { "rotation = { coordinate = V }" } else { "coordinate = V" };
        let text = format!(
            "format = 1\n[body.b]\n[joint.j]\nkind = \"{kind}\"\nparent = \"ground\"\nchild = \"b\"\n{key}\n"
        );
        let text = text.replace('V', "[0, \"1080 deg\", 0]");
        let held = "x = { coordinate = 0 }\ny = { coordinate = 0 }\nz = { coordinate = 0 }\n";
        let text = if kind == "free" { text + held } else { text };
        let solution = solved(&text);
        let last = solution.joints[0].coordinates.len() - 2;
        assert_eq!(solution.joints[0].coordinates[last], 1080.0_f64.to_radians(), "{kind}");
    }
}

/// A spring k on the rotation vector of a ball, turned by a moment M about an axis: M/k, beyond half a turn too.
#[test]
fn a_sprung_ball_turns_on_beyond_half_a_turn() {
    for moment in [1.0_f64, 3.0, 3.3, 4.5, 6.0, -5.0] {
        let text = format!(
            "format = 1\n[body.b]\n[joint.j]\nkind = \"spherical\"\nparent = \"ground\"\nchild = \"b\"\nstiffness = 1\n\
             effort = [0, 0, {moment}]\n"
        );
        let read = &solved(&text).joints[0].coordinates;
        assert!((read[2] - moment).abs() < 1e-9 && read[0].hypot(read[1]) < 1e-9, "{moment}: {read:?}");
    }
}
