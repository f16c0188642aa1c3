//! Points at which several directions give way at once, and the branches that leave them.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchOrigin, Crossing};
use support::{Run, crossings, run, traced};

/// Links of length 1 on springs of stiffness 1, side by side, under the same push: each is in balance upright, and where
/// push sin θ = θ.
fn links(stiffnesses: &[f64]) -> String {
    let mut text = "format = 1\n[parameter]\npush = 0\n".to_string();
    for (i, stiffness) in stiffnesses.iter().enumerate() {
        text += &format!(
            "[body.b{i}]\nat = [{i}, 1, 0]\n[joint.j{i}]\nkind = \"revolute\"\naxis = [0, 0, 1]\nstiffness = {stiffness}\n\
             parent = {{ body = \"ground\", at = [{i}, 0, 0] }}\nchild = {{ body = \"b{i}\", at = [0, -1, 0] }}\n\
             [load.p{i}]\nbody = \"b{i}\"\nforce = [0, \"-push\", 0]\n"
        );
    }
    text
}

fn study(stiffnesses: &[f64], keys: &str) -> String {
    let outputs: String =
        (0..stiffnesses.len()).map(|i| format!("t{i} = \"joint.j{i}.coordinate\"\n")).collect();
    format!(
        "{}[output]\n{outputs}[study.path]\nkind = \"trace\"\nparameter = \"push\"\nrange = [0, 2]\n{keys}\n",
        links(stiffnesses)
    )
}

/// The turnings at both ends of every branch that was switched to, in units of the root of 2 sin θ = θ, with the verdict there.
fn ends(found: &Run, count: usize) -> Vec<(Vec<i32>, Option<usize>)> {
    let root = 1.895_494_267_033_981;
    let mut ends = Vec::new();
    for branch in &found.trace.branches {
        if !matches!(branch.origin, BranchOrigin::Switched { .. }) {
            continue;
        }
        for point in [branch.points.first().unwrap(), branch.points.last().unwrap()] {
            assert!((point.parameter - 2.0).abs() < 1e-9, "{}", point.parameter);
            let turned = (0..count).map(|i| found.value(point, &format!("t{i}")) / root);
            let turned: Vec<i32> = turned
                .map(|t| {
                    assert!((t - t.round()).abs() < 1e-7, "{t}");
                    t.round() as i32
                })
                .collect();
            ends.push((turned, point.unstable_directions));
        }
    }
    ends.sort();
    ends
}

/// All ways in which every link leans, each of which is stable.
fn all_lean(count: usize) -> Vec<(Vec<i32>, Option<usize>)> {
    let mut ways = vec![Vec::new()];
    for _ in 0..count {
        let longer = |way: &Vec<i32>| [-1, 1].map(|t| way.iter().copied().chain([t]).collect::<Vec<i32>>());
        ways = ways.iter().flat_map(longer).collect();
    }
    ways.sort();
    ways.into_iter().map(|way| (way, Some(0))).collect()
}

#[test]
fn links_alike_lean_in_all_ways_that_are_stable() {
    let found = traced(&study(&[1.0, 1.0], "branches = 12"), &[], 1e-8);
    assert_eq!(crossings(&found.trace.branches[0]).len(), 1);
    let (at, crossing) = crossings(&found.trace.branches[0])[0];
    assert!((at - 1.0).abs() < 1e-7 && crossing == Crossing::Multiple(2), "{at} {crossing:?}");
    let stable = |found: &Run, count: usize| -> Vec<_> {
        ends(found, count).into_iter().filter(|(_, unstable)| *unstable == Some(0)).collect()
    };
    assert_eq!(stable(&found, 2), all_lean(2));
    assert!(found.trace.warnings.is_empty(), "{:?}", found.trace.warnings);
    let found = traced(&study(&[1.0, 1.0, 1.0], "branches = 20"), &[], 1e-8);
    assert_eq!(stable(&found, 3), all_lean(3));
}

/// A round column may bend in any direction: a family of branches, which is said and not followed.
#[test]
fn a_round_column_has_a_family_of_branches() {
    let text = "format = 1\n[parameter]\npush = 0\n[section.s]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = 1\nEI2 = 1\nEI3 = 1\n\
         [beam.column]\nsection = \"s\"\nlength = 1\nextension = false\nstart = { body = \"ground\", hold = \"clamp\" }\n\
         [load.head]\nbeam = \"column\"\nat = 1\nforce = [\"-push\", 0, 0]\n\
         [study.path]\nkind = \"trace\"\nparameter = \"push\"\nrange = [0, 5]\nbranches = 12\n";
    let found = run(text, &[], 1e-8);
    let said = found.trace.warnings.join("\n");
    assert!(said.contains("any mixture of them"), "{said}");
    assert_eq!(found.trace.branches.len(), 1);
}

/// Two halves of a bistable beam, alike but for their side, give way and turn back together, each with its own fold: the symmetric path
/// goes on through all of that, and is stable again behind the snap.
#[test]
fn a_path_passes_folds_of_two_halves_at_once() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/models/cosine_beam_of_two_halves.toml"
    ));
    let found = traced(&text.unwrap(), &[], 1e-8);
    let branch = &found.trace.branches[0];
    let last = branch.points.last().unwrap();
    assert!((last.parameter - 1.32e-4).abs() < 1e-12 && last.unstable_directions == Some(0));
    // Counts go by twos: what one half does the other does.
    assert!(branch.points.iter().all(|point| point.unstable_directions.is_none_or(|count| count % 2 == 0)));
    assert!(crossings(branch).iter().all(|(_, crossing)| *crossing == Crossing::Multiple(2)));
    let turns = branch
        .points
        .windows(3)
        .filter(|p| (p[1].parameter - p[0].parameter) * (p[2].parameter - p[1].parameter) < 0.0);
    assert!(turns.count() >= 2);
}
