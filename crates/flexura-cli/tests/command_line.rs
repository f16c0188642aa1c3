//! The command without a solve: help, mistakes, examples, schema, completions, files that are not there.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, run, stderr, stdout};

#[test]
fn an_unknown_sub_command_is_met_with_the_nearest_one() {
    let output = run(&["solv", "elastica.toml"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("'solve'"), "{}", stderr(&output));
}

#[test]
fn an_unknown_flag_is_met_with_the_nearest_one() {
    let output = run(&["solve", "elastica.toml", "--tolerence", "1e-9"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--tolerance"), "{}", stderr(&output));
}

#[test]
fn a_tolerance_beyond_reason_is_refused_with_the_reason() {
    for value in ["1e-15", "0", "-1", "0.5", "nan", "tight"] {
        let output = run(&["solve", "elastica.toml", "--tolerance", value]);
        assert_eq!(code(&output), 2, "{value}");
        assert!(stderr(&output).contains("1e-13") || stderr(&output).contains("plain number"), "{value}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn an_override_without_a_value_is_refused() {
    let output = run(&["solve", "elastica.toml", "--set", "force"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("equals sign"), "{}", stderr(&output));
}

#[test]
fn a_file_that_is_not_there_leaves_standard_output_empty() {
    for verb in ["solve", "check", "sweep", "trace", "buckle", "modes", "run"] {
        let more: &[&str] = match verb {
            "sweep" => &["--vary", "force=1,2"],
            "trace" => &["--parameter", "force", "--range", "0:1"],
            _ => &[],
        };
        let output = run(&[&[verb, "no_such_file.toml", "--json"][..], more].concat());
        assert!([2, 3].contains(&code(&output)), "{verb}");
        assert!(output.stdout.is_empty());
        assert!(stderr(&output).contains("no_such_file.toml"), "{}", stderr(&output));
    }
}

#[test]
fn verify_compares_the_cases_that_are_named() {
    let output = run(&["verify", "elastica_push", "--quiet", "--json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let document: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["status"], "passed");
    let rows = document["cases"][0]["rows"].as_array().unwrap();
    assert!(!rows.is_empty());
    for row in rows {
        assert!(row["difference"].as_f64().unwrap() <= row["allowed"].as_f64().unwrap());
        assert_eq!(row["status"], "passed");
    }
    let output = run(&["verify", "elastica_push"]);
    assert!(stdout(&output).contains("1 of 1 cases passed"), "{}", stdout(&output));
}

#[test]
fn verify_meets_an_unknown_case_with_the_nearest_one() {
    let output = run(&["verify", "elastika"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("elastica"), "{}", stderr(&output));
}

#[test]
fn an_example_comes_with_the_parts_that_it_includes() {
    let folder = folder("an_example_comes_with_the_parts_that_it_includes");
    let here = |arguments: &[&str]| flexura().args(arguments).current_dir(&folder).output().unwrap();
    let output = here(&["examples", "node_camera_aim"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for file in
        ["node_camera_aim.toml", "node_camera.toml", "parts/flexonic_camera.toml", "parts/flexonic_node.toml"]
    {
        assert!(folder.join(file).is_file(), "{file}");
    }
    assert_eq!(code(&here(&["solve", "node_camera_aim.toml", "--quiet"])), 0);
    // Another one shares parts with it.
    assert_eq!(code(&here(&["examples", "node_corner"])), 0);
}

#[test]
fn examples_are_listed_with_their_titles() {
    let output = run(&["examples"]);
    assert_eq!(code(&output), 0);
    for name in common::bundled() {
        assert!(stdout(&output).contains(name.trim_end_matches(".toml")), "{name}");
    }
    assert!(stdout(&output).contains("Steel strip with a weight at its tip"));
}

#[test]
fn an_example_is_written_but_never_over_a_file() {
    let folder = folder("an_example_is_written");
    let write =
        |arguments: &[&str]| flexura().current_dir(&folder).arg("examples").args(arguments).output().unwrap();
    assert_eq!(code(&write(&["elastica"])), 0);
    let path = folder.join("elastica.toml");
    let bundled = std::fs::read(common::models().join("elastica.toml")).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), bundled);

    std::fs::write(&path, "mine").unwrap();
    let refused = write(&["elastica.toml"]);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("--force"));
    assert_eq!(std::fs::read(&path).unwrap(), b"mine");

    assert_eq!(code(&write(&["elastica", "--force"])), 0);
    assert_eq!(std::fs::read(&path).unwrap(), bundled);
}

#[test]
fn an_unknown_example_is_met_with_the_nearest_one() {
    let output = run(&["examples", "four_bra"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("`four_bar`"), "{}", stderr(&output));
}

#[test]
fn the_schema_is_json() {
    let output = run(&["schema"]);
    assert_eq!(code(&output), 0);
    let _: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
}

#[test]
fn completions_come_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = run(&["completions", shell]);
        assert_eq!(code(&output), 0, "{shell}");
        for word in [
            "tolerance",
            "sweep",
            "vary",
            "sensitivity",
            "compliance",
            "guesses",
            "trace",
            "imperfection",
            "buckle",
            "run",
        ] {
            assert!(stdout(&output).contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn help_names_every_verb_and_the_exit_codes() {
    let output = run(&["--help"]);
    assert_eq!(code(&output), 0);
    for word in [
        "solve",
        "trace",
        "buckle",
        "run",
        "sweep",
        "check",
        "examples",
        "view",
        "schema",
        "completions",
        "Exit codes",
    ] {
        assert!(stdout(&output).contains(word), "{word}");
    }
}

#[test]
fn the_library_of_materials_is_listed_with_its_sources() {
    let output = run(&["materials"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for words in ["spring-steel", "206", "81.5", "EN 10270-1", "carbon-epoxy-ud"] {
        assert!(stdout(&output).contains(words), "{words}: {}", stdout(&output));
    }
    let json: serde_json::Value =
        serde_json::from_str(&stdout(&run(&["materials", "peek", "--json"]))).unwrap();
    assert_eq!(json["peek"]["young"], 4e9);
    let refused = run(&["materials", "peak"]);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("did you mean `peek`?"), "{}", stderr(&refused));
}
