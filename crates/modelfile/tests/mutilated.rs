//! No mutilated file makes the reader panic: repeated tables, relations, cables, inverse problems, notches.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::Document;
use proptest::prelude::*;

const TEXT: &str = r#"
format = 1
[parameter]
cells = 3
pull = "1 N"
[material.steel]
young = "207 GPa"
poisson = 0.3
[section."strip_{i}"]
repeat = { i = 2 }
shape = "rectangle"
width = { notch = "circular", thickness = "{i+1}*1 mm", radius = "2 mm", at = 0.5 }
height = { notch = "corner_filleted", thickness = "0.5 mm", radius = "1 mm" }
[body."n_{i}_{j}"]
repeat = { i = "cells + 1", j = [1, 2] }
at = ["{i}*10 mm", "{j - 2}*10 mm", 0]
[beam."h_{i}_{j}"]
repeat = { i = "cells", j = [1, 2] }
material = "steel"
section = "strip_{j-1}"
length = "10 mm"
start = { body = "n_{i}_{j}", hold = "clamp" }
end = { body = "n_{i+1}_{j}", hold = "free", x = { stiffness = 3.0 }, turning = { coordinate = [0, 0, "3 deg"] } }
[beam.branch]
material = "steel"
section = "strip_0"
length = "20 mm"
start = { beam = "h_0_1", at = 0.5, offset = [0, "1 mm", 0], hold = "planar", axis = [0, 0, 1], y = { effort = "3 N" } }
[joint.screw]
kind = "cylindrical"
parent = "ground"
child = { beam = "branch", at = "10 mm", rotation = { axis = [0, 0, 1], angle = "90 deg" } }
axis = [1, 0, 0]
angle = { effort = "pull*1 mm" }
[joint.cardan]
kind = "universal"
parent = "n_0_1"
child = "n_0_2"
axis = [1, 0, 0]
second_axis = [0, 1, 0]
[coupling.mesh]
relation = "joint.screw.position = 2 mm/turn*joint.screw.angle + 3 mm*joint.cardan.first"
[cable."flexor_{k}"]
repeat = { k = [1, 2] }
tension = "{k}*10 N"
route = [{ body = "n_0_{k}" }, { beam = "branch", at = 1, offset = [0, "4 mm", 0] }, { beam = "branch", from = 0, to = 1, offset = ["5 mm*cos(30*s)", 0] }]
[output]
c = "body.n_1_1.compliance.x.fx + 1 m/N"
a = "body.n_1_1.screw.axis"
t = "cable.flexor_1.tension/pull"
[unknown]
pull = { guess = "2 N", range = ["0 N", "10 N"] }
push = { guess = 3 }
[target]
"body.n_3_1.displacement.x + output.a.x*1 mm" = "pull*1 m/N"
"output.t" = 2
"#;

fn check(text: &str) {
    match Document::parse(text, "mutilated.toml").and_then(|document| document.model(&[])) {
        Ok(model) => assert!(model.validate().is_empty()),
        Err(report) => {
            assert!(!report.problems().is_empty());
            for problem in report.problems() {
                assert!(text.get(problem.span.clone()).is_some());
            }
            assert!(report.render(true).len() < 200_000);
        }
    }
}

#[test]
fn the_file_itself_is_read() {
    let model =
        Document::parse(TEXT, "x.toml").unwrap().model(&[]).unwrap_or_else(|report| panic!("{report}"));
    assert_eq!((model.beams.len(), model.cables.len(), model.sections.len()), (7, 2, 2));
    assert_eq!(model.targets.len(), 2);
    assert_eq!(model.parameters.iter().map(|p| p.value).collect::<Vec<_>>(), [3.0, 2.0, 3.0]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn mutilated_files_never_panic(
        edits in prop::collection::vec((0usize..TEXT.len(), 0u8..4, any::<u8>(), 0usize..TEXT.len()), 1..6)
    ) {
        let mut bytes = TEXT.as_bytes().to_vec();
        for (place, what, byte, other) in edits {
            let place = place % bytes.len();
            match what {
                0 => { bytes.remove(place); }
                1 => bytes.insert(place, byte),
                2 => bytes[place] = byte,
                _ => {
                    let from = other % bytes.len();
                    let piece: Vec<u8> = bytes[from..(from + 20).min(bytes.len())].to_vec();
                    bytes.splice(place..place, piece);
                }
            }
        }
        check(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn values_exchanged_for_others_never_panic(
        line in 0usize..TEXT.lines().count(),
        value in prop::sample::select(vec![
            "1", "-1", "0", "inf", "nan", "1e300", "\"\"", "\"x\"", "\"1 N\"", "\"{i}\"", "\"{\"", "\"}\"", "\"{}\"", "\"{1/0}\"",
            "\"=\"", "\"a=b\"", "[]", "[1, 2, 3]", "[[1]]", "{}", "{ i = 1e9 }", "{ i = [0, -1] }", "{ beam = \"branch\", at = 1 }",
            "{ notch = \"circular\" }", "true", "1979-05-27", "\"output.c\"", "\"joint.screw\"", "\"beam.branch[2]\"",
        ]),
    ) {
        let text: Vec<String> = TEXT.lines().enumerate().map(|(i, old)| match old.split_once(" = ") {
            Some((key, _)) if i == line => format!("{key} = {value}"),
            _ => old.to_string(),
        }).collect();
        check(&text.join("\n"));
    }
}
