//! What the command leaves on the disk when it is ended, killed, or finds no room; and that nothing that it shows or writes
//! steers a terminal.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, models, stderr, stdout};
use serde_json::Value;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_default()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&text(path)).unwrap()
}

/// Starts a study, waits until a file has so many lines, and sends a signal.
#[cfg(unix)]
fn ended(command: &mut Command, file: &Path, lines: usize, signal: &str) -> Output {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while text(file).lines().count() < lines {
        assert!(begun.elapsed() < Duration::from_secs(120), "{} does not grow", file.display());
        std::thread::sleep(Duration::from_millis(10));
    }
    kill(&child, signal);
    child.wait_with_output().unwrap()
}

#[cfg(unix)]
fn kill(child: &Child, signal: &str) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[cfg(unix)]
#[test]
fn a_trace_that_is_ended_keeps_its_points() {
    let folder = folder("a_trace_that_is_ended");
    let partial = folder.join("path.csv.partial");
    let mut command = flexura();
    command.args(["trace", "elastica.toml", "--parameter", "force", "--range", "0 N:100 N", "--steps"]);
    command.args(["100000", "--most-points", "1000000", "-o"]).arg(&folder);
    let output = ended(&mut command, &partial, 100, "-INT");
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
    assert!(stdout(&output).contains("interrupted"), "{}", stdout(&output));
    assert_eq!(names(&folder), ["diagram.svg", "path.csv", "report.html", "result.json", "shapes.svg"]);
    let document = json(&folder.join("result.json"));
    assert_eq!(document["status"], "interrupted");
    assert_eq!(document["branches"][0]["ends"][1], "interrupted");
    let points = document["branches"][0]["points"].as_array().unwrap();
    assert!(points.len() >= 99 && points.len() < 100_000, "{}", points.len());
    assert_eq!(text(&folder.join("path.csv")).lines().count(), points.len() + 1);
    // The last point is as good as any other.
    let last = points.last().unwrap();
    let force = format!("force={:e} N", last["parameter"].as_f64().unwrap());
    let solved = common::run(&["solve", "elastica.toml", "--set", &force, "--json"]);
    let solved: Value = serde_json::from_slice(&solved.stdout).unwrap();
    let rise = |document: &Value| document["outputs"]["rise"].as_f64().unwrap();
    assert!((rise(last) - rise(&solved)).abs() < 1e-7, "{} {}", rise(last), rise(&solved));
}

#[cfg(unix)]
#[test]
fn a_trace_that_is_killed_leaves_its_rows_and_the_earlier_result() {
    let folder = folder("a_trace_that_is_killed");
    let mut first = flexura();
    first.args(["solve", "elastica.toml", "--quiet", "-o"]).arg(&folder);
    assert_eq!(code(&first.output().unwrap()), 0);
    let before = text(&folder.join("result.json"));
    let partial = folder.join("path.csv.partial");
    let trace = |steps: &str| {
        let mut command = flexura();
        command.args(["trace", "elastica.toml", "--parameter", "force", "--range", "0 N:100 N", "--steps"]);
        command.args([steps, "--most-points", "1000000", "-o"]).arg(&folder);
        command
    };
    ended(&mut trace("100000"), &partial, 50, "-KILL");
    let rows = text(&partial);
    let columns = rows.lines().next().unwrap().split(',').count();
    assert!(rows.ends_with('\n') && rows.lines().all(|row| row.split(',').count() == columns), "{rows}");
    assert_eq!(text(&folder.join("result.json")), before);
    let solved = ["beams.csv", "model.vtp", "path.csv.partial", "report.html", "result.json", "shape.svg"];
    assert_eq!(names(&folder), solved);
    // The next one takes away what belongs to neither.
    assert_eq!(code(&trace("10").output().unwrap()), 0);
    assert_eq!(names(&folder), ["diagram.svg", "path.csv", "report.html", "result.json", "shapes.svg"]);
    assert_eq!(json(&folder.join("result.json"))["files"][0], "path.csv");
}

#[cfg(unix)]
#[test]
fn a_sweep_that_is_ended_keeps_its_rows() {
    let folder = folder("a_sweep_that_is_ended");
    let (table, partial) = (folder.join("table.csv"), folder.join("table.csv.partial"));
    let sweep = |count: &str| {
        let mut command = flexura();
        command.args(["sweep", "elastica.toml", "--vary", &format!("force=1 N:10 N:{count}"), "-o"]);
        command.arg(&table);
        command
    };
    assert_eq!(code(&sweep("3").output().unwrap()), 0);
    assert_eq!((text(&table).lines().count(), names(&folder).len()), (4, 1));
    let before = text(&table);
    ended(&mut sweep("200000"), &partial, 20, "-KILL");
    assert_eq!(text(&table), before);
    assert!(text(&partial).lines().count() >= 20);

    for signal in ["-INT", "-TERM"] {
        std::fs::remove_file(&partial).unwrap_or_default();
        let output = ended(&mut sweep("20000"), &partial, 20, signal);
        assert_eq!(code(&output), 130, "{}", stderr(&output));
        assert!(stderr(&output).contains("of 20000 samples were solved"), "{}", stderr(&output));
        assert_eq!(names(&folder), ["table.csv"]);
        let rows = text(&table);
        assert_eq!(rows.lines().count(), 20_001);
        let count = |word: &str| rows.lines().filter(|row| row.split(',').nth(1) == Some(word)).count();
        assert!(count("converged") >= 19 && count("converged") + count("interrupted") == 20_000);
        assert!(rows.lines().last().unwrap().starts_with("10.0,interrupted,,"), "{:?}", rows.lines().last());
    }
}

#[cfg(unix)]
#[test]
fn rows_of_a_sweep_are_on_standard_output_as_they_come() {
    let folder = folder("rows_on_standard_output");
    let table = folder.join("table.csv");
    let mut command = flexura();
    command.args(["sweep", "elastica.toml", "--vary", "force=1 N:10 N:200000"]);
    let child = command.stdout(std::fs::File::create(&table).unwrap()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    while text(&table).lines().count() < 20 && begun.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(10));
    }
    kill(&child, "-KILL");
    child.wait_with_output().unwrap();
    let rows = text(&table);
    let forces = rows.lines().skip(1).map(|row| row.split(',').next().unwrap().parse::<f64>().unwrap());
    let forces: Vec<f64> = forces.collect();
    assert!(forces.len() >= 19 && forces.is_sorted(), "{forces:?}");
}

#[cfg(unix)]
#[test]
fn a_search_that_is_ended_keeps_the_equilibria_that_it_found() {
    let folder = folder("a_search_that_is_ended");
    let mut command = flexura();
    command.args(["solve", "bistable_beam.toml", "--guesses", "1000000", "--json", "-o"]).arg(&folder);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    kill(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["status"], "converged");
    assert!(!document["equilibria"].as_array().unwrap().is_empty());
    assert_eq!(document, json(&folder.join("result.json")));
}

#[cfg(target_os = "linux")]
#[test]
fn a_table_without_room_ends_with_3_and_says_where() {
    let output = flexura()
        .args(["sweep", "elastica.toml", "--vary", "force=1,2", "-o", "/dev/full"])
        .output()
        .unwrap();
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains("/dev/full"), "{}", stderr(&output));
    assert!(!std::fs::metadata("/dev/full").unwrap().is_file());
    // Nothing more is solved for a reader that takes nothing.
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = flexura()
        .args(["sweep", "elastica.toml", "--vary", "force=1:10:100000", "--quiet"])
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains("standard output"), "{}", stderr(&output));
}

#[test]
fn an_example_that_cannot_be_written_leaves_the_older_one() {
    let folder = folder("an_example_that_cannot_be_written");
    std::fs::create_dir(folder.join("elastica.toml")).unwrap();
    let output = flexura().current_dir(&folder).args(["examples", "elastica", "--force"]).output().unwrap();
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains("elastica.toml"), "{}", stderr(&output));
}

/// Title, and a comment in the line of a mistake, with what steers terminals, turns writing round, and is no character.
const TITLE: &str = r"a\u001B]0;b\u0007\u001B[8m\u009B2J\u202Efed\uFFFF\u2028\nz";

fn nasty(folder: &Path, change: impl Fn(String) -> String) -> std::path::PathBuf {
    let text = std::fs::read_to_string(models().join("elastica.toml")).unwrap();
    let text: Vec<&str> = text.lines().filter(|line| !line.starts_with("name = ")).collect();
    let text = text.join("\n").replace("format = 1", &format!("format = 1\nname = \"{TITLE}\""));
    let path = folder.join("nasty.toml");
    std::fs::write(&path, change(text)).unwrap();
    path
}

/// Nothing but text, line breaks, and the styles that the command itself uses.
fn assert_harmless(what: &str, shown: &str) {
    let styles = ["\u{1b}[0m", "\u{1b}[1m", "\u{1b}[2m", "\u{1b}[4m", "\u{1b}[3", "\u{1b}[9"];
    let plain = styles.iter().fold(shown.to_owned(), |text, style| text.replace(style, ""));
    let is_harmless = |c: char| {
        matches!(c, '\n' | '\t')
            || !(c.is_control() || ('\u{2028}'..='\u{202e}').contains(&c) || c == '\u{ffff}')
    };
    let found = plain.chars().find(|c| !is_harmless(*c));
    assert_eq!(found, None, "{what}: {plain:?}");
}

#[test]
fn a_title_steers_no_terminal_and_breaks_no_file() {
    let folder = folder("a_title_steers_no_terminal");
    let file = nasty(&folder, |text| text);
    let verbs: [&[&str]; 5] = [
        &["solve"],
        &["check"],
        &["trace", "--parameter", "force", "--range", "0:5", "--steps", "5"],
        &["buckle"],
        &["sweep", "--vary", "force=1,2", "--json"],
    ];
    for verb in verbs {
        let out = folder.join(verb[0]);
        let mut command = flexura();
        // As on a terminal: styles are not taken away.
        command.env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1").arg(verb[0]).arg(&file).args(&verb[1..]);
        if !["check", "sweep"].contains(&verb[0]) {
            command.arg("-o").arg(&out);
        }
        let output = command.output().unwrap();
        assert_harmless(verb[0], &stdout(&output));
        assert_harmless(verb[0], &stderr(&output));
        assert!(
            verb[0] == "sweep" || stdout(&output).starts_with("a\\u001B]0;b\\u0007"),
            "{}",
            stdout(&output)
        );
        for name in if out.is_dir() { names(&out) } else { Vec::new() } {
            assert_harmless(&name, &text(&out.join(&name)));
        }
        if out.is_dir() {
            let title = json(&out.join("result.json"))["model"].as_str().unwrap().to_owned();
            assert_eq!(title, "a\u{1b}]0;b\u{7}\u{1b}[8m\u{9b}2J\u{202e}fed\u{ffff}\u{2028}\nz");
        }
    }
    assert!(text(&folder.join("solve/shape.svg")).contains("a\\u001B]0;b\\u0007"));
}

#[test]
fn a_message_that_shows_a_line_of_the_file_steers_no_terminal() {
    let folder = folder("a_message_that_shows_a_line");
    let lines = [
        "length = \"1 N\" # \u{9b}2J \u{202e}fed\u{2069}\u{feff}\u{ffff}",
        "# \u{1b}]0;title\u{7}",
        "length = \"1 \u{1b}[8mN\"",
        "\"\u{9b}2J\u{202e}\" = 1",
    ];
    for line in lines {
        let file = nasty(&folder, |text| text.replacen("length = ", &format!("{line}\nlength = "), 1));
        for plain in [true, false] {
            let mut command = flexura();
            if !plain {
                command.env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1");
            }
            let output = command.arg("check").arg(&file).output().unwrap();
            assert_eq!(code(&output), 2, "{line:?}: {}", stderr(&output));
            assert_harmless(line, &stderr(&output));
        }
    }
    let name = "\u{1b}[2J\u{202e}x.toml";
    for arguments in [vec!["solve", name], vec!["solve", "elastica.toml", "--set", name], vec![name]] {
        let output = flexura().env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1").args(&arguments).output();
        assert_harmless("arguments", &stderr(&output.unwrap()));
    }
}
