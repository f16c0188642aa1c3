//! Paths of equilibria, critical loads and the studies of a file.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, folder, run, stderr, stdout};
use std::path::{Path, PathBuf};

const TRACE: &[&str] = &["trace", "sensor_clamp.toml"];

fn refused(arguments: &[&str], words: &[&str]) {
    let output = run(arguments);
    assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", stdout(&output));
    for words in words {
        assert!(stderr(&output).contains(words), "{arguments:?}: {words}: {}", stderr(&output));
    }
}

#[test]
fn a_trace_needs_a_parameter_and_a_range() {
    refused(&[TRACE, &["--range", "0 N:20 N"]].concat(), &["--parameter <P>"]);
    refused(&[TRACE, &["--parameter", "push"]].concat(), &["--range <A:B>"]);
    refused(&[TRACE, &["--parametre", "push", "--range", "0:1"]].concat(), &["--parameter"]);
}

#[test]
fn mistakes_in_the_flags_of_a_trace_are_shown_where_they_are() {
    let cases: &[(&[&str], &[&str])] = &[
        (
            &["--parameter", "pusch"],
            &["there is no parameter `pusch`", "did you mean `push`?", "--parameter pusch"],
        ),
        (&["--range", "0 N"], &["two ends with a colon"]),
        (&["--range", "0 mm:20 mm"], &["expected a force (N), found a length (m)"]),
        (&["--range", "3 N:3 N"], &["both ends of the range are 3 N"]),
        (&["--range", "0 N:inf"], &["finite"]),
        (&["--start", "30 N"], &["not in the range 0 N to 20 N"]),
        (&["--start", "-1 N"], &["would start at -1 N"]),
        (&["--steps", "few"], &["there is no parameter `few`"]),
        (&["--steps", "0"], &["must be at least 1"]),
        (&["--most-points", "1"], &["must be at least 2"]),
        (&["--branches", "-3"], &["unexpected argument"]),
        (&["--branches", "all"], &["expected true, false or a whole number, found \"all\""]),
        (&["--event", "output.slide"], &["no equals sign"]),
        (&["--event", "output.slid = 1 mm"], &["there is no output `slid`", "did you mean `slide`?"]),
        (&["--event", "slide = 1 mm"], &["there is no parameter `slide`", "did you mean `output.slide`?"]),
        (&["--event", "output.way_force = 1 N"], &["this is a vector", "output.way_force.x"]),
        (&["--event", "output.slide = 1 N"], &["expected a length (m), found a force (N)"]),
        (&["--stop", "folds"], &["did you mean `fold`?"]),
        (&["--stop", "fold 0"], &["counted from 1"]),
        (&["--imperfection", "push=1 N"], &["`push` is the parameter that is traced"]),
        (&["--imperfection", "push"], &["no equals sign", "--imperfection slope"]),
        (&["--critical", "weight=0:1"], &["there is no parameter `weight`"]),
        (&["--critical-number", "2"], &["--critical <P=A:B>"]),
        (&["--tolerance", "1e-20"], &["1e-13"]),
        (&["--set", "posh=1"], &["there is no parameter `posh`"]),
    ];
    for (flags, words) in cases {
        let mut arguments = [TRACE, flags].concat();
        for (flag, value) in [("--parameter", "push"), ("--range", "0 N:20 N")] {
            if flags[0] != flag {
                arguments.extend([flag, value]);
            }
        }
        refused(&arguments, words);
    }
}

#[test]
fn mistakes_in_the_flags_of_buckling_are_shown_where_they_are() {
    let cases: &[(&[&str], &str)] = &[
        (&["--parameter", "pusch"], "did you mean `push`?"),
        (&["--at", "2 N"], "it is a fraction of the load"),
        (&["--parameter", "push", "--at", "2 mm"], "expected a force (N), found a length (m)"),
        (&["--count", "0"], "must be at least 1"),
        (&["--count", "2.5"], "expected a whole number"),
    ];
    for (flags, words) in cases {
        refused(&[&["buckle", "sensor_clamp.toml"], *flags].concat(), &[words]);
    }
}

#[test]
fn what_is_wrong_with_a_whole_study_is_shown_at_what_was_typed_or_at_its_table() {
    let follows = ["has no linear buckling: load.jet", "command line:1:1", "1 | buckle"];
    refused(&["buckle", "follower_cantilever.toml"], &follows);
    let path = folder("what_is_wrong_with_a_whole_study").join("jet.toml");
    let text = std::fs::read_to_string("../../models/follower_cantilever.toml").unwrap();
    let studies = "[study.first]\nkind = \"solve\"\n[study.second]\nkind = \"buckle\"\n";
    std::fs::write(&path, format!("{text}{studies}")).unwrap();
    refused(&["run", shown(&path), "second"], &["has no linear buckling: load.jet", "| [study.second]"]);
}

#[test]
fn events_that_are_not_met_are_told() {
    let range = ["--parameter", "push", "--range", "0 N:5 N", "--event", "output.slide = 3 m"];
    let output = run(&[TRACE, &range].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("not met: output.slide = 3 m"), "{}", stdout(&output));
}

/// A file of that name with these studies behind a cantilever.
fn file(name: &str, studies: &str) -> PathBuf {
    let text = std::fs::read_to_string(common::models().join("elastica.toml")).unwrap();
    let path = folder(name).join("model.toml");
    std::fs::write(&path, format!("{text}\n{studies}")).unwrap();
    path
}

fn shown(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn studies_are_run_by_their_names() {
    let two = "[study.equilibrium]\nkind = \"solve\"\n[study.again]\nkind = \"solve\"\n";
    let path = file("studies_are_run_by_their_names", two);
    refused(
        &["run", shown(&path), "equilibrum"],
        &["there is no study `equilibrum`", "did you mean `equilibrium`?"],
    );
    refused(&["run", "elastica.toml"], &["the file has no studies", "[study.path]"]);
    refused(&["run", "elastica.toml", "path"], &["there is no study `path`", "the file defines no study"]);

    let one = run(&["run", shown(&path), "again"]);
    assert_eq!(code(&one), 0, "{}", stderr(&one));
    let plain = run(&["solve", shown(&path)]);
    assert_eq!(stdout(&one), format!("study again\n{}", stdout(&plain)));

    let document = |arguments: &[&str]| -> serde_json::Value {
        let output = run(arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let solved = document(&["solve", shown(&path), "--json"]);
    assert_eq!(document(&["run", shown(&path), "again", "--json"]), solved);
    let all = document(&["run", shown(&path), "--json"]);
    assert_eq!((&all["study"], &all["status"]), (&"run".into(), &"converged".into()));
    let names: Vec<&String> = all["studies"].as_object().unwrap().keys().collect();
    assert_eq!(names.len(), 2);
    assert_eq!(all["studies"]["equilibrium"], solved);
}

#[test]
fn the_files_of_studies_lie_in_folders_of_their_names() {
    let path = file("the_files_of_studies", "[study.one]\nkind = \"solve\"\n[study.two]\nkind = \"solve\"\n");
    let folder = path.with_file_name("results");
    let output = run(&["run", shown(&path), "-o", shown(&folder), "--set", "force=2"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("wrote result.json, beams.csv, model.vtp, shape.svg and report.html into")
    );
    for study in ["one", "two"] {
        for name in ["result.json", "beams.csv", "model.vtp", "shape.svg", "report.html"] {
            assert!(folder.join(study).join(name).is_file(), "{study}/{name}");
        }
    }
    let quiet = run(&["run", shown(&path), "--quiet"]);
    assert!(code(&quiet) == 0 && quiet.stdout.is_empty() && quiet.stderr.is_empty());
}

#[test]
fn a_study_that_fails_does_not_keep_the_others_from_being_run() {
    // A path may not have so many points.
    let study = |name: &str| {
        format!("[study.{name}]\nkind = \"trace\"\nparameter = \"force\"\nrange = [0, 9]\nmost_points = 3\n")
    };
    let path = file("a_study_that_fails", &(study("one") + &study("two")));
    let output = run(&["run", shown(&path)]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("2 of 2 studies failed; one: "), "{}", stderr(&output));
    assert!(stdout(&output).contains("study two"));
}

#[test]
fn an_inverse_problem_is_not_traced() {
    let inverse = "[unknown]\nforce = {}\n[target]\n\"beam.rod.end.position.y\" = 0.5\n";
    let path = file("an_inverse_problem_is_not_traced", inverse);
    refused(
        &["trace", shown(&path), "--parameter", "force", "--range", "0:1"],
        &["an inverse problem cannot be traced", "--parameter force"],
    );
}

const COLUMN: &[&str] = &["trace", "euler_clamped_clamped.toml", "--parameter", "push", "--range", "0:45"];

fn document(arguments: &[&str]) -> serde_json::Value {
    let output = run(arguments);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{arguments:?}: {}", stderr(&output)))
}

#[test]
fn a_trace_tells_where_branches_cross_and_what_is_stable() {
    let output = run(COLUMN);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in
        ["converged", "pitchfork, supercritical", "39.4784", "stable → unstable (1)", "45, end of the range"]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    let document = document(&[COLUMN, &["--branches", "2", "--json", "--tolerance", "1e-9"]].concat());
    assert_eq!((&document["study"], &document["status"]), (&"trace".into(), &"converged".into()));
    let branches = document["branches"].as_array().unwrap();
    let points = branches[0]["points"].as_array().unwrap();
    let crossing = points.iter().find(|point| point["kind"] == "branch").unwrap();
    let critical = 4.0 * std::f64::consts::PI.powi(2);
    assert!((crossing["parameter"].as_f64().unwrap() - critical).abs() < 1e-7);
    for (point, stable) in [(&points[0], true), (&points[points.len() - 1], false)] {
        assert_eq!((&point["stable"], &point["kind"]), (&stable.into(), &"end".into()));
        assert!(point["outputs"]["middle"].is_number() && point["beams"].is_object());
    }
    assert!(branches.len() > 1 && branches[1]["origin"] == "branch_point");
}

#[test]
fn a_trace_writes_its_files() {
    let folder = folder("a_trace_writes_its_files").join("results");
    let output = run(&[COLUMN, &["--quiet", "-o", shown(&folder)]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let table = read("path.csv");
    assert!(table.starts_with("branch,point,kind,push,middle,"), "{table}");
    assert_eq!(table.lines().filter(|line| line.contains(",branch,")).count(), 1);
    let document: serde_json::Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(document["work"]["points"].as_u64().unwrap() as usize, table.lines().count() - 1);
    assert!(read("diagram.svg").contains("branch point") && read("shapes.svg").contains("initial shape"));
    assert!(!folder.join("critical.csv").exists());
}

#[test]
fn events_and_stops_are_met() {
    let flags =
        ["--branches", "1", "--event", "output.shortening = push/400", "--stop", "output.middle = 0.2"];
    let document = document(&[COLUMN, &flags, &["--json"]].concat());
    let branch = document["branches"][1]["points"].as_array().unwrap().clone();
    let event = branch.iter().find(|point| point["kind"] == "event").unwrap();
    assert_eq!(event["event"], "output.shortening = push/400");
    let (push, shortening) = (event["parameter"].as_f64().unwrap(), &event["outputs"]["shortening"]);
    assert!((shortening.as_f64().unwrap() - push / 400.0).abs() < 1e-7);
    let ends = document["branches"][1]["ends"].as_array().unwrap();
    assert!(ends.contains(&"stop".into()), "{ends:?}");
}

#[test]
fn a_path_that_is_cut_short_is_told_by_the_exit_code() {
    let output = run(&[COLUMN, &["--most-points", "4", "--json"]].concat());
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("most_points"), "{}", stderr(&output));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_ne!(document["status"], "converged");
    assert!(document["reason"].is_string());
}

#[test]
fn the_traces_of_a_file_are_run() {
    let study = "[study.path]\nkind = \"trace\"\nparameter = \"force\"\nrange = [\"0 N\", \"10 N\"]\n[study.end]\nkind = \"solve\"\n";
    let path = file("the_traces_of_a_file_are_run", study);
    let all = document(&["run", shown(&path), "--json"]);
    assert_eq!(all["status"], "converged");
    let last = all["studies"]["path"]["branches"][0]["points"].as_array().unwrap().last().unwrap().clone();
    let rise = |outputs: &serde_json::Value| outputs["rise"].as_f64().unwrap();
    assert!((rise(&last["outputs"]) - rise(&all["studies"]["end"]["outputs"])).abs() < 1e-7);
}
