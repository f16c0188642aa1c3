//! The command with many solves.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, run, stderr, stdout};
use serde_json::Value;

fn rows(table: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| line.split(',').map(str::to_owned).collect();
    table.lines().map(cells).collect()
}

fn cell(rows: &[Vec<String>], row: usize, column: &str) -> String {
    let position = rows[0].iter().position(|heading| heading == column).unwrap();
    rows[row][position].clone()
}

#[test]
fn a_sweep_is_one_solve_a_row() {
    let output = run(&["sweep", "elastica.toml", "--vary", "force=2 N:0.01 kN:5"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = rows(&stdout(&output));
    assert_eq!(rows.len(), 6);
    assert_eq!(rows[0][..2], ["force [N]", "status"]);
    assert_eq!(rows[0][rows[0].len() - 4..], ["energy [J]", "error_estimate", "reason", "warnings"]);
    let forces: Vec<String> = (1..=5).map(|row| cell(&rows, row, "force [N]")).collect();
    assert_eq!(forces, ["2.0", "4.0", "6.0", "8.0", "10.0"]);
    // Mattiasson (1981), P L^2 / EI = 2 and 10.
    for (row, rise) in [(1, 0.49346), (5, 0.81061)] {
        let found: f64 = cell(&rows, row, "rise [m]").parse().unwrap();
        assert!((found - rise).abs() < 1e-5, "{found}");
        assert_eq!(cell(&rows, row, "status"), "converged");
    }
    let solved = run(&["solve", "elastica.toml", "--set", "force=10", "--json"]);
    let document: Value = serde_json::from_slice(&solved.stdout).unwrap();
    let energy: f64 = cell(&rows, 5, "energy [J]").parse().unwrap();
    assert!((energy - document["energy"].as_f64().unwrap()).abs() < 1e-8 * energy);
}

/// Euler's clamped and free column, in EI/L²: straight above π²/4 = 2.47, where it is unstable in one direction, and above 9π²/4 = 22.2 in
/// two.
#[test]
fn every_row_says_whether_it_is_stable() {
    let output = run(&["sweep", "euler_clamped_free.toml", "--vary", "push=1,4,30"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = rows(&stdout(&output));
    for (row, stable, count) in [(1, "true", "0"), (2, "false", "1"), (3, "false", "2")] {
        assert_eq!(cell(&rows, row, "stable"), stable, "{row}");
        assert_eq!(cell(&rows, row, "unstable_directions"), count, "{row}");
    }
    assert!(rows[2].last().unwrap().contains("unstable in 1 direction"), "{:?}", rows[2]);
    let solved = run(&["solve", "euler_clamped_free.toml", "--set", "push=4"]);
    assert!(stderr(&solved).contains("unstable in 1 direction"), "{}", stderr(&solved));
}

#[test]
fn the_numbers_do_not_depend_on_how_many_threads_there_are() {
    let sweep = |jobs: &str| {
        let grid = ["--vary", "push=1 N,5 N", "--vary", "radius=7 mm:8 mm:3"];
        let output = flexura()
            .args(["sweep", "compression_spring.toml", "--jobs", jobs, "--tolerance", "1e-6"])
            .args(grid)
            .output()
            .unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stdout(&output)
    };
    let one = sweep("1");
    assert_eq!(one, sweep("4"));
    let rows = rows(&one);
    let pairs: Vec<String> =
        rows[1..].iter().map(|row| format!("{} {}", row[0], &row[1][..row[1].len().min(6)])).collect();
    assert_eq!(pairs, ["1.0 7.0", "1.0 7.5", "1.0 8.0", "5.0 7.0", "5.0 7.5", "5.0 8.0"]);
}

/// A stage on two leaves whose length is a parameter.
const LEAF: &str = r#"
format = 1
name = "leaf"
[parameter]
length = "100 mm"
push = "-1 N"
[material.steel]
young = "207 GPa"
poisson = 0.3
[section.leaf]
shape = "rectangle"
width = "10 mm"
height = "0.5 mm"
[beam.leaf]
material = "steel"
section = "leaf"
length = "length"
start = { body = "ground", hold = "clamp" }
[load.push]
beam = "leaf"
at = 1
force = [0, 0, "push"]
[output]
tip = "beam.leaf.end.position"
slope = "beam.leaf.end.rotation.y"
root = "sqrt(beam.leaf.end.position.z / (1 m))"
"#;

#[test]
fn a_sample_that_fails_is_a_row_and_not_the_end() {
    let folder = folder("a_sample_that_fails");
    let file = folder.join("leaf.toml");
    std::fs::write(&file, LEAF).unwrap();
    let table = folder.join("table.csv");
    let output = flexura()
        .arg("sweep")
        .arg(&file)
        .args(["--vary", "length=50 mm,-50 mm,100 mm", "--vary", "push=1 N", "--json", "-o"])
        .arg(&table)
        .output()
        .unwrap();
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("1 of 3 samples did not converge: 1 input_error"),
        "{}",
        stderr(&output)
    );
    let rows = rows(&std::fs::read_to_string(&table).unwrap());
    assert_eq!(
        rows[0],
        [
            "length [mm]",
            "push [N]",
            "status",
            "tip.x [m]",
            "tip.y [m]",
            "tip.z [m]",
            "slope [rad]",
            "root",
            "stable",
            "unstable_directions",
            "energy [J]",
            "error_estimate",
            "reason",
            "warnings"
        ]
    );
    assert_eq!(rows[2][..9], ["-50.0", "1.0", "input_error", "", "", "", "", "", ""]);
    assert_eq!(rows[2][12..].join(","), "\"beam.leaf.length: must be positive, is -0.05\",");
    assert_eq!(rows[3][2], "converged");

    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&document["study"], &document["status"]), (&"sweep".into(), &"incomplete".into()));
    assert_eq!(document["vary"]["length"][1], -0.05);
    assert_eq!(document["samples"].as_array().unwrap().len(), 3);
    assert_eq!(document["samples"][1]["energy"], Value::Null);
    assert_eq!(document["samples"][2]["outputs"]["tip"].as_array().unwrap().len(), 3);
    assert_eq!(document["samples"][2]["parameters"]["length"], 0.1);
}

#[test]
fn an_output_without_a_value_leaves_the_others() {
    let folder = folder("an_output_without_a_value");
    let file = folder.join("leaf.toml");
    std::fs::write(&file, LEAF).unwrap();
    // The root of a negative number.
    let output =
        flexura().arg("solve").arg(&file).args(["--set", "push=-1 N", "--json", "-o"]).arg(&folder).output();
    let output = output.unwrap();
    assert_eq!(code(&output), 0);
    // Told where the file asks for it.
    for words in ["warning", "output `root` is NaN", "leaf.toml:26:", "root = \"sqrt("] {
        assert!(stderr(&output).contains(words), "{words}: {}", stderr(&output));
    }
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["status"], "converged");
    assert_eq!(document["outputs"].get("root"), Some(&Value::Null));
    assert!(document["output_reasons"]["root"].as_str().unwrap().contains("not a finite number"));
    assert!(document["outputs"]["slope"].as_f64().unwrap() > 0.0);
    assert!(document["warnings"][0].as_str().unwrap().contains("`root`"), "{}", document["warnings"]);
    assert!(folder.join("result.json").is_file() && folder.join("shape.svg").is_file());

    let summary = flexura().arg("solve").arg(&file).output().unwrap();
    assert_eq!(code(&summary), 0);
    assert!(stdout(&summary).contains("slope") && !stdout(&summary).contains("root"));

    let sweep = flexura().arg("sweep").arg(&file).args(["--vary", "push=-1 N,1 N"]).output().unwrap();
    assert_eq!(code(&sweep), 0, "{}", stderr(&sweep));
    assert!(stderr(&sweep).contains("1 converged sample lacks"), "{}", stderr(&sweep));
    let rows = rows(&stdout(&sweep));
    assert_eq!(cell(&rows, 1, "root"), "");
    assert!(rows[1].join(",").contains("\"output `root` is NaN, not a finite number"), "{:?}", rows[1]);
    assert_ne!(cell(&rows, 2, "root"), "");
}

/// What an output lacks is lacking at the points of a path, too.
#[test]
fn a_point_of_a_path_says_why_an_output_has_no_value() {
    let folder = folder("a_point_without_a_value");
    let file = folder.join("leaf.toml");
    std::fs::write(&file, LEAF).unwrap();
    let output = flexura()
        .arg("trace")
        .arg(&file)
        .args(["--parameter", "push", "--range", "-1 N:1 N", "--steps", "5", "--json", "-o"])
        .arg(&folder)
        .output()
        .unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("output `root` is NaN"), "{}", stderr(&output));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    for point in document["branches"][0]["points"].as_array().unwrap() {
        let below = point["outputs"]["tip"][2].as_f64().unwrap() < 0.0;
        assert_eq!(point["outputs"]["root"].is_null(), below, "{point}");
        assert_eq!(point["output_reasons"]["root"].is_string(), below);
    }
    let path = std::fs::read_to_string(folder.join("path.csv")).unwrap();
    assert!(path.lines().nth(1).unwrap().ends_with("the root of a negative number?)\""), "{path}");
}

/// A part of an output that holds no result is a number before anything is solved; one sample where it is none is no mistake in
/// the file.
#[test]
fn a_quotient_of_parameters_without_a_value_leaves_the_others() {
    let folder = folder("a_quotient_of_parameters");
    let file = folder.join("leaf.toml");
    std::fs::write(
        &file,
        LEAF.replace("slope =", "ratio = \"(1 / push) * beam.leaf.end.rotation.y\"\nslope ="),
    )
    .unwrap();
    let sweep = flexura().arg("sweep").arg(&file).args(["--vary", "push=0 N,0.01 N"]).output().unwrap();
    assert_eq!(code(&sweep), 0, "{}", stderr(&sweep));
    let rows = rows(&stdout(&sweep));
    assert_eq!(cell(&rows, 1, "ratio [rad/N]"), "");
    let tip: f64 = cell(&rows, 1, "tip.x [m]").parse().unwrap();
    assert!((tip - 0.1).abs() < 1e-15);
    // L^2 / (2 E I), turning about -y.
    let ratio: f64 = cell(&rows, 2, "ratio [rad/N]").parse().unwrap();
    let slope = -0.1_f64.powi(2) / (2.0 * 207e9 * 10e-3 * 0.5e-3_f64.powi(3) / 12.0);
    assert!((ratio / slope - 1.0).abs() < 1e-4, "{ratio} {slope}");
}

/// One output without a value, and one parameter whose neighbour is no mechanism, take nothing else along.
#[test]
fn sensitivities_leave_out_only_what_has_none() {
    let folder = folder("sensitivities_leave_out");
    let file = folder.join("leaf.toml");
    // With a little more of `part` the load's place lies beyond the leaf.
    let text = LEAF
        .replace("push = \"-1 N\"", "push = \"-0.05 N\"\npart = 1")
        .replace("\nat = 1\n", "\nat = \"part\"\n")
        .replace("slope =", "ratio = \"1 / (push + 0.05 N)\"\nslope =");
    std::fs::write(&file, text).unwrap();
    let output = flexura().arg("solve").arg(&file).args(["--sensitivity", "--json"]).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["outputs"].get("ratio"), Some(&Value::Null));
    let sensitivities = &document["sensitivities"];
    assert_eq!(sensitivities.get("ratio"), None);
    let of_slope = sensitivities["slope"].as_object().unwrap();
    assert_eq!(of_slope.keys().collect::<Vec<_>>(), ["length", "push"]);
    // Under a small load the slope of a cantilever's tip grows with the load and with the square of the length.
    let slope = document["outputs"]["slope"].as_f64().unwrap();
    let elasticity = |p: &str| document["elasticities"]["slope"][p].as_f64().unwrap();
    assert!(
        slope > 0.0 && (elasticity("push") - 1.0).abs() < 1e-2 && (elasticity("length") - 2.0).abs() < 1e-2
    );
    assert!(stderr(&output).contains("no sensitivities to `part`"), "{}", stderr(&output));
    assert!(!stderr(&output).contains("no sensitivities:"), "{}", stderr(&output));
}

#[test]
fn what_cannot_be_varied_is_told_with_the_nearest_name() {
    let cases = [
        ("forse=1:2:3", "`force`"),
        ("force=1 m:2 N:3", "a length"),
        ("force=1:2", "from, to and how many"),
        ("force=1:2:1", "from 2 on"),
        ("force=1:2:many", "from 2 on"),
        ("force=", "empty"),
        ("force=1:2:3:4", "no range"),
        ("force", "what to vary"),
        ("force=inf", "not finite"),
        ("force=1:2:20000000", "number of values"),
    ];
    for (text, words) in cases {
        let output = run(&["sweep", "elastica.toml", "--vary", text]);
        assert_eq!(code(&output), 2, "{text}");
        assert!(stderr(&output).contains(words), "{text}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    let twice = run(&["sweep", "elastica.toml", "--vary", "force=1,2", "--vary", "force=1,2"]);
    assert!(code(&twice) == 2 && stderr(&twice).contains("varied twice"));
    let both = run(&["sweep", "elastica.toml", "--vary", "force=1,2", "--set", "force=1"]);
    assert!(code(&both) == 2 && stderr(&both).contains("both set and varied"));
    assert_eq!(code(&run(&["sweep", "elastica.toml"])), 2);
    assert_eq!(code(&run(&["sweep", "elastica.toml", "--vary", "force=1,2", "--jobs", "0"])), 2);
}

#[test]
fn a_table_that_cannot_be_written_is_told_before_anything_is_solved() {
    let output = run(&["sweep", "elastica.toml", "--vary", "force=1,2", "-o", "no/such/folder/table.csv"]);
    assert_eq!(code(&output), 3);
    assert!(output.stdout.is_empty() && stderr(&output).contains("table.csv"));
}
