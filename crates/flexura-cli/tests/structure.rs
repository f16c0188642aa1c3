//! What is said of mechanisms that are held too little, too much, not at all or twice: the exit code of `solve` and the
//! first error, or else the first warning, word for word. Each names the joints and bodies that are meant.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, stderr};

/// A model, how `solve` ends, and what it says first; nothing said where the text is empty.
struct Structure {
    name: &'static str,
    code: i32,
    says: &'static str,
    model: &'static str,
}

/// The section of all beams.
const ROD: &str = "[section.rod]\nshape = \"stiffness\"\nEA = 1e4\nGJ = 1\nEI2 = 1\nEI3 = 1\n";

#[test]
fn what_holds_too_little_or_too_much_is_named() {
    let folder = folder("structures");
    let mut wrong = Vec::new();
    for Structure { name, code: wanted, says, model } in STRUCTURES {
        let path = folder.join("model.toml");
        let rod = if model.contains("\"rod\"") { ROD } else { "" };
        std::fs::write(&path, format!("format = 1\n{model}\n{rod}")).unwrap();
        let output = flexura().arg("solve").arg(&path).output().unwrap();
        let text = stderr(&output);
        let find = |word: &str| text.lines().find(|line| line.starts_with(word));
        let said = find("error").or_else(|| find("warning"));
        if code(&output) != *wanted || said.unwrap_or_default() != *says {
            wrong.push(format!("{name}: code {}, says\n{text}", code(&output)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(STRUCTURES.len() >= 20);
}

const STRUCTURES: &[Structure] = &[
    Structure {
        name: "body held by nothing",
        code: 2,
        says: "error: can move without resistance: body.cork",
        model: r#"
[body.cork]
[beam.rod]
section = "rod"
length = 1
start = { body = "ground", hold = "clamp" }
"#,
    },
    Structure {
        name: "two bodies joined, held by nothing",
        code: 2,
        says: "error: can move without resistance: body.a, body.b, joint.hinge",
        model: r#"
[body.a]
[body.b]
[joint.hinge]
kind = "revolute"
parent = "a"
child = "b"
axis = [0, 0, 1]
"#,
    },
    Structure {
        name: "beam held by nothing",
        code: 2,
        says: "error: is held nowhere: it has neither a start nor an end",
        model: r#"
[beam.rod]
section = "rod"
length = 1
"#,
    },
    Structure {
        name: "beam on a ball",
        code: 2,
        says: "error: can move without resistance: beam.rod.start",
        model: r#"
[beam.rod]
section = "rod"
length = 1
start = { body = "ground", hold = "pin" }
"#,
    },
    Structure {
        name: "beam on a hinge",
        code: 2,
        says: "error: can move without resistance: beam.rod.start",
        model: r#"
[beam.rod]
section = "rod"
length = 1
start = { body = "ground", hold = "revolute", axis = [0, 0, 1] }
"#,
    },
    Structure {
        name: "slider without a spring",
        code: 2,
        says: "error: can move without resistance: body.slider, joint.way",
        model: r#"
[body.slider]
[joint.way]
kind = "prismatic"
parent = "ground"
child = "slider"
axis = [1, 0, 0]
"#,
    },
    Structure {
        name: "beam between two balls",
        code: 0,
        says: "warning: beam.rod: two ball pins leave it free to spin about the line between them; that motion is held at zero",
        model: r#"
[beam.rod]
section = "rod"
length = 1
start = { body = "ground", hold = "pin" }
end = { body = "ground", hold = "pin" }
"#,
    },
    Structure {
        name: "four-bar without a drive",
        code: 2,
        says: "error: can move without resistance: body.crank, body.coupler, body.rocker, joint.a, joint.b, joint.c, joint.d",
        model: r#"
[body.crank]
[body.coupler]
at = [0, 1, 0]
[body.rocker]
at = [2, 0, 0]
[joint.a]
kind = "revolute"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
[joint.b]
kind = "revolute"
parent = { body = "crank", at = [0, 1, 0] }
child = "coupler"
axis = [0, 0, 1]
[joint.c]
kind = "revolute"
parent = { body = "coupler", at = [2, 0, 0] }
child = { body = "rocker", at = [0, 1, 0] }
axis = [0, 0, 1]
[joint.d]
kind = "revolute"
parent = { body = "ground", at = [2, 0, 0] }
child = "rocker"
axis = [0, 0, 1]
"#,
    },
    Structure {
        name: "four-bar with two drives",
        code: 1,
        says: "error: not converged, inconsistent: the loop does not close: at joint.c its two sides are 195.2934 mm and 0.0000 deg apart; free one of its joints, or correct the places and axes of joint.a, joint.b, joint.c, joint.d",
        model: r#"
[body.crank]
[body.coupler]
at = [0, 1, 0]
[body.rocker]
at = [2, 0, 0]
[joint.a]
kind = "revolute"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
coordinate = 0.1
[joint.b]
kind = "revolute"
parent = { body = "crank", at = [0, 1, 0] }
child = "coupler"
axis = [0, 0, 1]
[joint.c]
kind = "revolute"
parent = { body = "coupler", at = [2, 0, 0] }
child = { body = "rocker", at = [0, 1, 0] }
axis = [0, 0, 1]
[joint.d]
kind = "revolute"
parent = { body = "ground", at = [2, 0, 0] }
child = "rocker"
axis = [0, 0, 1]
coordinate = 0.3
"#,
    },
    Structure {
        name: "two welds that disagree",
        code: 1,
        says: "error: not converged, inconsistent: the loop does not close: at joint.left its two sides are 20.0000 mm and 0.0000 deg apart; free one of its joints, or correct the places and axes of joint.left, joint.right",
        model: r#"
[body.frame]
[joint.left]
kind = "weld"
parent = "ground"
child = "frame"
[joint.right]
kind = "weld"
parent = { body = "ground", at = [0.02, 0, 0] }
child = { body = "frame", at = [0, 0, 0] }
"#,
    },
    Structure {
        name: "weld repeated",
        code: 0,
        says: "warning: joint.left, joint.right hold each other more often than the loop needs; it closes nonetheless, and among all forces in balance those of least norm are given",
        model: r#"
[body.frame]
[joint.left]
kind = "weld"
parent = "ground"
child = "frame"
[joint.right]
kind = "weld"
parent = { body = "ground", at = [0.02, 0, 0] }
child = "frame"
"#,
    },
    Structure {
        name: "hinge driven twice, differently",
        code: 1,
        says: "error: not converged, inconsistent: the loop does not close: at joint.two its two sides are 0.0000 mm and 5.7296 deg apart; free one of its joints, or correct the places and axes of joint.one, joint.two",
        model: r#"
[body.arm]
[joint.one]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
coordinate = 0.1
[joint.two]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
coordinate = 0.2
"#,
    },
    Structure {
        name: "hinge driven twice, alike",
        code: 0,
        says: "warning: joint.one, joint.two hold each other more often than the loop needs; it closes nonetheless, and among all forces in balance those of least norm are given",
        model: r#"
[body.arm]
[joint.one]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
coordinate = 0.1
[joint.two]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
coordinate = 0.1
"#,
    },
    Structure {
        name: "joint from a body to itself",
        code: 2,
        says: "error: a joint must connect two different bodies",
        model: r#"
[body.arm]
[joint.self]
kind = "revolute"
parent = "arm"
child = "arm"
axis = [0, 0, 1]
"#,
    },
    Structure {
        name: "joint from ground to ground",
        code: 2,
        says: "error: a joint must connect two different bodies",
        model: r#"
[body.arm]
[joint.fix]
kind = "weld"
parent = "ground"
child = "arm"
[joint.none]
kind = "revolute"
parent = "ground"
child = "ground"
axis = [0, 0, 1]
"#,
    },
    Structure {
        name: "coupling that contradicts drives",
        code: 2,
        says: "error: every coordinate of the coupling is driven, so it can do nothing",
        model: r#"
[body.a]
[body.b]
[joint.one]
kind = "revolute"
parent = "ground"
child = "a"
axis = [0, 0, 1]
coordinate = 0.1
[joint.two]
kind = "revolute"
parent = "ground"
child = "b"
axis = [0, 0, 1]
coordinate = 0.1
[coupling.mesh]
relation = "joint.one.coordinate = 2*joint.two.coordinate"
"#,
    },
    Structure {
        name: "coupling twice",
        code: 2,
        says: "error: over-constrained loop; the forces cannot be told apart of: coupling.mesh, coupling.again",
        model: r#"
[body.a]
[body.b]
[joint.one]
kind = "revolute"
parent = "ground"
child = "a"
axis = [0, 0, 1]
stiffness = 1
[joint.two]
kind = "revolute"
parent = "ground"
child = "b"
axis = [0, 0, 1]
[coupling.mesh]
relation = "joint.one.coordinate = 2*joint.two.coordinate"
[coupling.again]
relation = "2*joint.one.coordinate = 4*joint.two.coordinate"
"#,
    },
    Structure {
        name: "couplings that leave nothing",
        code: 0,
        says: "",
        model: r#"
[body.a]
[body.b]
[joint.one]
kind = "revolute"
parent = "ground"
child = "a"
axis = [0, 0, 1]
effort = 1
[joint.two]
kind = "revolute"
parent = "ground"
child = "b"
axis = [0, 0, 1]
[coupling.mesh]
relation = "joint.one.coordinate = 2*joint.two.coordinate"
[coupling.other]
relation = "joint.one.coordinate = 3*joint.two.coordinate"
"#,
    },
    Structure {
        name: "straight unstretchable beam between clamps",
        code: 2,
        says: "error: over-constrained loop; the forces cannot be told apart of: beam.rod",
        model: r#"
[beam.rod]
section = "rod"
length = 1
extension = false
start = { body = "ground", hold = "clamp" }
end = { body = "ground", hold = "clamp" }
"#,
    },
    Structure {
        name: "slider on crossing ways",
        code: 1,
        says: "error: not converged, inconsistent: the loop does not close: at joint.x its two sides are 100.0000 mm and 0.0000 deg apart; free one of its joints, or correct the places and axes of joint.x, joint.y",
        model: r#"
[body.slider]
[joint.x]
kind = "prismatic"
parent = "ground"
child = "slider"
axis = [1, 0, 0]
[joint.y]
kind = "prismatic"
parent = "ground"
child = "slider"
axis = [0, 1, 0]
coordinate = 0.1
"#,
    },
    Structure {
        name: "ring of beams held by nothing",
        code: 2,
        says: "error: can move without resistance: body.a, body.b",
        model: r#"
[body.a]
[body.b]
at = [1, 0, 0]
[beam.one]
section = "rod"
length = 1
start = { body = "a", hold = "clamp" }
end = { body = "b", hold = "clamp" }
[beam.two]
section = "rod"
length = 1
start = { body = "a", hold = "clamp" }
end = { body = "b", hold = "clamp" }
"#,
    },
    Structure {
        name: "spring alone",
        code: 2,
        says: "error: can move without resistance: body.a",
        model: r#"
[body.a]
at = [1, 0, 0]
[spring.coil]
from = { body = "ground" }
to = { body = "a" }
stiffness = 10
"#,
    },
    Structure {
        name: "body on three cables",
        code: 2,
        says: "error: can move without resistance: body.a",
        model: r#"
[body.a]
at = [0, 0, -1]
[cable.c0]
tension = 1
route = [{ body = "ground", at = [1,0,0] }, { body = "a" }]
[cable.c1]
tension = 1
route = [{ body = "ground", at = [-1,1,0] }, { body = "a" }]
[cable.c2]
tension = 1
route = [{ body = "ground", at = [-1,-1,0] }, { body = "a" }]
"#,
    },
    Structure {
        name: "cable kept on fixed points",
        code: 2,
        says: "error: over-constrained loop; the forces cannot be told apart of: joint.fix, cable.rope",
        model: r#"
[body.a]
[joint.fix]
kind = "weld"
parent = "ground"
child = "a"
[cable.rope]
length = 2
route = [{ body = "ground", at = [1, 0, 0] }, { body = "a" }]
"#,
    },
    Structure {
        name: "two hinges on different axes",
        code: 0,
        says: "warning: joint.one, joint.two hold each other more often than the loop needs; it closes nonetheless, and among all forces in balance those of least norm are given",
        model: r#"
[body.a]
[joint.one]
kind = "revolute"
parent = "ground"
child = "a"
axis = [0, 0, 1]
[joint.two]
kind = "revolute"
parent = "ground"
child = "a"
axis = [1, 0, 0]
"#,
    },
];
