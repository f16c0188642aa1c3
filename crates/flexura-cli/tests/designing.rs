//! Design optimisation from the command line.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, folder, models, run, stderr, stdout};
use serde_json::Value;

const MODEL: &str = "lightest_cantilever.toml";

fn document(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn the_optimum_is_told_written_and_solved_again() {
    let place = folder("optimum");
    let [written, out] = ["best.toml", "out"].map(|name| place.join(name).to_str().unwrap().to_owned());
    let output = run(&["optimise", MODEL, "--write", &written, "-o", &out]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in ["1 of 1 searches converged", "thickness  2.15443 mm", "at most 100 µm", "most"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let result = document(&std::fs::read_to_string(place.join("out/result.json")).unwrap());
    assert_eq!((&result["study"], &result["status"]), (&"optimise".into(), &"converged".into()));
    assert_eq!(result["optimum"]["active"][0], "output.sag.most");
    // The state of the optimum stands in the document as that of a solve does.
    assert_eq!(result["optimum"]["parameters"]["thickness"], result["parameters"]["thickness"]);
    assert!(result["beams"]["strip"]["position"].as_array().unwrap().len() > 10);
    let history = std::fs::read_to_string(place.join("out/history.csv")).unwrap();
    assert!(
        history.starts_with("start,step,thickness [m],model.mass [kg],violation\n")
            && history.lines().count() > 3
    );
    assert!(place.join("out/shape.svg").exists() && place.join("out/report.html").exists());
    let again = document(&stdout(&run(&["solve", &written, "--json"])));
    let sag = again["outputs"]["sag"].as_f64().unwrap();
    assert!((sag / 1e-4 - 1.0).abs() < 1e-6, "{sag}");
    // A result that was kept is drawn like one that was found just now.
    let picture = place.join("kept.svg").to_str().unwrap().to_owned();
    let kept = run(&["view", &format!("{out}/result.json"), "--svg", &picture, "--no-open"]);
    assert_eq!(code(&kept), 0, "{}", stderr(&kept));
    assert!(std::fs::read_to_string(&picture).unwrap().starts_with("<svg"));
}

#[test]
fn a_front_is_a_table_of_its_own() {
    let place = folder("front");
    let out = place.to_str().unwrap();
    let output = run(&["optimise", MODEL, "front", "-o", out]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("front  model.mass  output.sag"), "{}", stdout(&output));
    let table = std::fs::read_to_string(place.join("front.csv")).unwrap();
    assert_eq!(table.lines().count(), 10, "{table}");
}

#[test]
fn a_design_that_cannot_be_is_the_nearest_one_and_exit_code_one() {
    let place = folder("infeasible");
    let text = std::fs::read_to_string(models().join(MODEL)).unwrap().replace("\"0.1 mm\" }", "\"1 um\" }");
    let file = place.join("stiff.toml");
    std::fs::write(&file, text).unwrap();
    let output = run(&["optimise", file.to_str().unwrap(), "light", "--json"]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("did not lead to a design that meets all constraints"),
        "{}",
        stderr(&output)
    );
    let result = document(&stdout(&output));
    assert_eq!(result["status"], "infeasible");
    assert!(result["optimum"]["violation"].as_f64().unwrap() > 1.0);
}

#[test]
fn studies_that_are_not_there_are_told() {
    for (arguments, words) in [
        (&["optimise", "lee_frame.toml"][..], "the file has no study of the kind `optimise`"),
        (&["optimise", MODEL, "lihgt"], "did you mean `light`?"),
        (&["optimise", "bistable_design.toml", "path"], "the study `path` is not of the kind `optimise`"),
    ] {
        let output = run(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(words), "{arguments:?}: {}", stderr(&output));
    }
}
