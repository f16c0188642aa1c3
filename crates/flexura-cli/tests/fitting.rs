//! Parameters from measurements, and formulas, from the command line.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, folder, run, stderr, stdout};

fn refused(arguments: &[&str], words: &[&str]) {
    let output = run(arguments);
    assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", stdout(&output));
    for words in words {
        assert!(stderr(&output).contains(words), "{arguments:?}: {words}: {}", stderr(&output));
    }
}

const FIT: &str = "bone_bending.toml";

#[test]
fn a_fit_of_the_file_tells_estimates_and_specimens() {
    let output = run(&["fit", FIT]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in [
        "young of A",
        "95 % interval",
        "young over 8 specimens: 2.7",
        "± 1.",
        "R²",
        "times as much as the given noise",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let json: serde_json::Value = serde_json::from_str(&stdout(&run(&["fit", FIT, "--json"]))).unwrap();
    assert_eq!(json["study"], "fit");
    let own = &json["specimens"]["A"]["estimates"]["young"];
    let (value, low, high) = (
        own["value"].as_f64().unwrap(),
        own["interval"][0].as_f64().unwrap(),
        own["interval"][1].as_f64().unwrap(),
    );
    assert!(low < value && value < high && (value / 1.18e9 - 1.0).abs() < 0.02, "{own}");
    assert_eq!(json["lines"].as_array().unwrap().len(), json["residuals"]["tip"].as_array().unwrap().len());
}

#[test]
fn a_table_that_is_typed_is_fitted_and_written() {
    let place = folder("fit_typed");
    let data = place.join("pulls.csv");
    std::fs::write(&data, "pull [N],tip [mm]\n1,0.4\n2,0.81\n3,1.19\n4,1.62\n").unwrap();
    let [data, written, out, picture] =
        [data, place.join("fitted.toml"), place.join("out"), place.join("fit.png")]
            .map(|p| p.to_str().unwrap().to_owned());
    let arguments = [
        "fit",
        FIT,
        "--data",
        &data,
        "--unknown",
        "young",
        "--bounds",
        "young=1 GPa:9 GPa",
        "--noise",
        "tip=0.02 mm",
    ];
    let more = ["--intervals", "profile", "--write", &written, "-o", &out, "--png", &picture];
    let output = run(&[&arguments[..], &more].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("by profile"), "{}", stdout(&output));
    for name in ["result.json", "residuals.csv", "fit.svg", "fitted.toml"] {
        assert!(place.join("out").join(name).is_file(), "{name}");
    }
    assert!(!place.join("out/report.html").exists());
    assert!(std::fs::metadata(&picture).unwrap().len() > 1000);
    // What was written solves with what was found.
    let text = std::fs::read_to_string(&written).unwrap();
    let found = text.lines().find(|line| line.starts_with("young = ")).unwrap();
    let value: f64 =
        found.trim_start_matches("young = ").trim_matches('"').split(' ').next().unwrap().parse().unwrap();
    assert!(value > 1e9 && value != 2e9, "{found}");
    assert_eq!(code(&run(&["solve", &written])), 0);
    // Robust losses and left-out specimens, by flags.
    let output =
        run(&[&arguments[..], &["--loss", "cauchy", "--reject", "--confidence", "0.9", "--quiet"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn mistakes_of_a_fit_are_shown_where_they_are() {
    let place = folder("fit_mistakes");
    let csv = |name: &str, text: &str| {
        let path = place.join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let good = csv("good.csv", "pull [N],tip [mm]\n1,0.4\n2,0.81\n");
    let fit = |more: &[&'static str]| {
        [
            vec!["fit".to_owned(), FIT.to_owned(), "--data".to_owned(), good.clone()],
            more.iter().map(|s| (*s).to_owned()).collect(),
        ]
        .concat()
    };
    let cases: &[(Vec<String>, &[&str])] = &[
        (fit(&[]), &["nothing is to be found"]),
        (fit(&["--unknown", "yung"]), &["there is no parameter `yung`", "did you mean `young`?"]),
        (fit(&["--unknown", "young", "--bounds", "young=1 GPa"]), &["two ends"]),
        (fit(&["--unknown", "young", "--bounds", "young"]), &["no equals sign"]),
        (fit(&["--unknown", "young", "--bounds", "pull=1 N:2 N"]), &["`pull` is not to be found"]),
        (fit(&["--unknown", "young", "--noise", "tipp=1 mm"]), &["there is no output `tipp`"]),
        (fit(&["--unknown", "young", "--confidence", "2"]), &["between 0 and 1"]),
        (fit(&["--unknown", "young", "--report", "page.html"]), &["no states of the mechanism", "--svg"]),
        (vec!["fit".into(), FIT.into(), "--unknown".into(), "young".into()], &["the key `data` is missing"]),
        (vec!["fit".into(), FIT.into(), "each".into(), "--reject".into()], &["says itself what is fitted"]),
        (vec!["fit".into(), "lee_frame.toml".into()], &["no study of the kind \"fit\"", "--data"]),
        (vec!["fit".into(), "lee_frame.toml".into(), "path".into()], &["of the kind \"trace\", not \"fit\""]),
        (vec!["fit".into(), FIT.into(), "every".into()], &["there is no study `every`"]),
        (
            vec![
                "fit".into(),
                FIT.into(),
                "--data".into(),
                "none.csv".into(),
                "--unknown".into(),
                "young".into(),
            ],
            &["there is no such file"],
        ),
    ];
    for (arguments, words) in cases {
        refused(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), words);
    }
}

#[test]
fn a_fit_that_nothing_can_meet_ends_with_what_it_has() {
    let place = folder("fit_bounds");
    let data = place.join("far.csv");
    std::fs::write(&data, "pull [N],tip [mm]\n1,4\n2,8\n").unwrap();
    let arguments =
        ["fit", FIT, "--data", data.to_str().unwrap(), "--unknown", "young", "--bounds", "young=1 GPa:9 GPa"];
    let output = run(&arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("stands at one of its bounds"), "{}", stderr(&output));
    assert!(stdout(&output).contains("at its bound"), "{}", stdout(&output));
}

#[test]
fn a_formula_is_told_and_written() {
    let place = folder("formula");
    let paths = ["slide.h", "slide.rs", "slide.toml", "slide.csv"]
        .map(|name| place.join(name).to_str().unwrap().to_owned());
    let mut arguments = vec!["formula", "strip_on_slope.toml"];
    paths.iter().for_each(|path| arguments.extend(["--write", path]));
    let output = run(&arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for words in ["u1 = ", "*w^3", "R² = 0.9", "largest error"] {
        assert!(stdout(&output).contains(words), "{words}: {}", stdout(&output));
    }
    let read = |i: usize| std::fs::read_to_string(&paths[i]).unwrap();
    assert!(read(0).contains("static inline double slide(double w)"));
    assert!(read(1).contains("pub fn slide(w: f64) -> f64"));
    assert!(read(2).contains("terms = [\"w\", \"w^2\", \"w^3\"]"));
    assert_eq!(read(3).lines().count(), 4);
    refused(
        &["formula", "strip_on_slope.toml", "--write", "slide.m"],
        &[".toml, .csv, .h (C) or .rs (Rust)"],
    );
    refused(&["formula", "lee_frame.toml"], &["no study of the kind \"formula\"", "degree = 3"]);
    refused(&["formula", "strip_on_slope.toml", "fold"], &["of the kind \"trace\", not \"formula\""]);
}

#[test]
fn a_run_of_all_studies_shows_on_its_page_those_that_have_states() {
    let place = folder("run_with_formula");
    let page = place.join("all.html");
    let output = run(&["run", "strip_on_slope.toml", "--report", page.to_str().unwrap(), "--json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(json["studies"]["slide"]["study"], "formula");
    assert!(page.is_file());
    refused(&["run", FIT, "--quiet", "--report", page.to_str().unwrap()], &["no states of the mechanism"]);
}
