//! Formulas that repeat a model's answer: exact where it is a polynomial, the best where it is none, and the same in every language.

#![allow(clippy::unwrap_used)]

use flexura::model::{FormulaStudy, Model, StudyKind};
use flexura::modelfile::Document;
use flexura::output::{FormulaView, formula_c, formula_csv, formula_rust, formula_toml};
use flexura::solution::{ResponseFormula, Status};
use flexura::{Options, formula};
use flexura_testkit::slide_law;
use std::path::Path;
use std::process::Command;

/// A cantilever that bends into a circle: angle = moment reach/EI.
const CIRCLE: &str = r#"
format = 1
[parameter]
reach = "0.5 m"
moment = "1.2 N*m"
[section.rod]
shape = "stiffness"
EA = inf
GJ = "1 N*m^2"
EI2 = "3 N*m^2"
EI3 = "2 N*m^2"
[beam.rod]
section = "rod"
length = "reach"
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "rod"
at = 1
moment = [0, 0, "moment"]
[output]
angle = "beam.rod.end.rotation.z"
y = "beam.rod.end.position.y"
"#;

fn with_study(text: &str, study: &str) -> (Model, FormulaStudy) {
    let text = format!("{text}\n[study.law]\nkind = \"formula\"\n{study}\n");
    let model = Document::parse(&text, "law.toml").unwrap().model(&[]).unwrap();
    let study = match &model.studies.last().unwrap().kind {
        StudyKind::Formula(study) => study.clone(),
        other => panic!("{other:?}"),
    };
    (model, study)
}

fn found(model: &Model, study: &FormulaStudy) -> ResponseFormula {
    let found = formula(model, study, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
    found
}

#[test]
fn a_polynomial_is_found_as_it_is() {
    let grid = "vary = { reach = [\"0.1 m\", \"0.6 m\", 6], moment = [\"-1 N*m\", \"1 N*m\", 5] }";
    let of = "of = [\"reach [cm]\", \"moment [N*m]\"]";
    let (model, study) = with_study(CIRCLE, &format!("output = \"angle [deg]\"\n{of}\n{grid}\ndegree = 2"));
    let law = found(&model, &study);
    let names = ["1", "reach", "moment", "reach^2", "reach*moment", "moment^2"];
    let terms: Vec<String> = study.pieces[0].terms.iter().map(|t| t.text(&["reach", "moment"])).collect();
    assert_eq!(terms, names);
    // 1 cm · 1 N m/(2 N m²) = 0.005 rad.
    let wanted = [0.0, 0.0, 0.0, 0.0, 0.005_f64.to_degrees(), 0.0];
    for (own, wanted) in law.pieces[0].coefficients.iter().zip(wanted) {
        assert!((own - wanted).abs() < 1e-9, "{:?}", law.pieces);
    }
    assert!(law.r_squared.unwrap() > 1.0 - 1e-14 && law.largest.0 < 1e-6);
}

#[test]
fn absolute_values_are_terms_and_pieces_fit_piece_by_piece() {
    let grid = "vary = { moment = [\"-2 N*m\", \"2 N*m\", 41] }";
    let text = CIRCLE.replace("[output]\n", "[output]\nturned = \"abs(beam.rod.end.rotation.z)\"\n");
    let study = "output = \"turned\"\nof = \"moment\"\nterms = [\"abs(moment)\", \"moment^2\"]";
    let (model, study) = with_study(&text, &format!("{study}\n{grid}"));
    let law = found(&model, &study);
    assert!(
        (law.pieces[0].coefficients[0] - 0.25).abs() < 1e-9 && law.pieces[0].coefficients[1].abs() < 1e-9
    );

    // The same by two straight pieces that meet at zero.
    let study =
        "output = \"turned\"\nof = \"moment\"\npieces = [{ to = \"0 N*m\", degree = 1 }, { degree = 1 }]";
    let (model, study) = with_study(&text, &format!("{study}\n{grid}"));
    let law = found(&model, &study);
    for (piece, slope) in law.pieces.iter().zip([-0.25, 0.25]) {
        assert!(piece.coefficients[0].abs() < 1e-9 && (piece.coefficients[1] - slope).abs() < 1e-9);
    }
    assert_eq!(law.pieces.iter().map(|piece| piece.count).collect::<Vec<_>>(), [21, 20]);
}

#[test]
fn the_slide_of_a_deflection_is_the_least_squares_cubic_of_the_exact_curve() {
    // (5.5) of the thesis. The exact curve is that of Taylor series along both halves of the strip; 400 points of it, evenly over the
    // deflection, weigh as the trace's points by what they stand for.
    let path = format!("{}/../../models/strip_on_slope.toml", env!("CARGO_MANIFEST_DIR"));
    let mut model = Document::read(path).unwrap().model(&[]).unwrap();
    for study in &mut model.studies {
        if let StudyKind::Trace(trace) = &mut study.kind {
            trace.steps *= 4;
        }
    }
    let StudyKind::Formula(mut study) = model.studies.last().unwrap().kind.clone() else {
        panic!("no formula")
    };
    // The series begin where the strip has bowed.
    study.variables[0].range = Some([-0.39, -0.02]);
    let law = found(&model, &study);
    let middles: Vec<f64> = (1..=400).map(|i| 0.02 + 0.37 * (f64::from(i) - 0.5) / 400.0).collect();
    let exact = slide_law::slides(0.8, &middles, &[0.0]).unwrap();
    let with: Vec<Vec<f64>> = exact.into_iter().map(|row| vec![row[1]]).collect();
    let wanted = slide_law::Cubic::fit(&middles, &with).unwrap();
    let largest = wanted.error(&middles, &with);
    // Downwards w is negative. The two differ by how the ends of the range are met, beside what a cubic leaves.
    let [c1, c2, c3] = law.pieces[0].coefficients[..] else { panic!("three terms") };
    for w in &middles {
        let own = -w * (c1 - w * (c2 - w * c3));
        assert!((own - wanted.at(*w)).abs() < 0.03 * largest, "{w}: {own} {}", wanted.at(*w));
    }
    assert!((law.largest.0 - largest).abs() < 0.03 * largest, "{} {largest}", law.largest.0);
    // At its points the path is that of the series.
    for point in law.points.iter().step_by(40) {
        let exact = slide_law::slides(0.8, &[-point.variables[0]], &[0.0]).unwrap();
        assert!((point.value - exact[0][1]).abs() < 1e-8);
    }
}

/// Values of a formula at a few places, by the formula itself.
fn values(law: &ResponseFormula) -> Vec<(Vec<f64>, f64)> {
    let step = (law.points.len() / 7).max(1);
    law.points.iter().step_by(step).map(|point| (point.variables.clone(), point.formula)).collect()
}

fn agree(printed: &str, wanted: &[(Vec<f64>, f64)]) {
    let lines: Vec<f64> = printed.lines().map(|line| line.trim().parse().unwrap()).collect();
    assert_eq!(lines.len(), wanted.len() + 1, "{printed}");
    for (own, (_, wanted)) in lines.iter().zip(wanted) {
        assert!((own - wanted).abs() <= 1e-12 * (1.0 + wanted.abs()), "{own} {wanted}");
    }
    // What lies outside is not known.
    assert_eq!(lines.last(), Some(&0.0));
}

fn output_of(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn c_and_rust_give_the_same_numbers() {
    let (grid, of) = (
        "vary = { reach = [\"0.1 m\", \"0.6 m\", 5], moment = [\"-3 N*m\", \"2 N*m\", 9] }",
        "of = [\"reach\", \"moment [N*m]\"]",
    );
    let single = "vary = { moment = [\"-2 N*m\", \"3 N*m\", 21] }\nof = \"moment\"";
    let studies = [
        format!(
            "output = \"y [mm]\"\n{of}\n{grid}\nterms = [\"1\", \"reach^2*moment\", \"abs(moment)\", \"moment^3\"]"
        ),
        format!("output = \"y\"\n{single}\ndegree = 5"),
        format!(
            "output = \"y\"\n{single}\npieces = [{{ to = \"0.5 N*m\", degree = 2, constant = false }}, {{ degree = 3 }}]"
        ),
    ];
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("formula");
    std::fs::create_dir_all(&folder).unwrap();
    for (i, text) in studies.iter().enumerate() {
        let (model, study) = with_study(CIRCLE, text);
        let law = found(&model, &study);
        let view = FormulaView { name: "law", model: &model, study: &study, formula: &law };
        let wanted = values(&law);
        let call = |suffix: &str, place: &[f64]| {
            format!("law{suffix}({})", place.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", "))
        };
        let far = vec![1e3; study.variables.len()];

        std::fs::write(folder.join(format!("law{i}.h")), formula_c(&view)).unwrap();
        let lines: String = wanted
            .iter()
            .map(|(place, _)| format!("    printf(\"%.17g\\n\", {});\n", call("", place)))
            .collect();
        let source = format!(
            "#include <stdio.h>\n#include \"law{i}.h\"\nint main(void)\n{{\n{lines}    printf(\"%d\\n\", {});\n    return !{};\n}}\n",
            call("_is_known", &far),
            call("_is_known", &wanted[0].0)
        );
        let (source_path, program) = (folder.join(format!("c{i}.c")), folder.join(format!("c{i}")));
        std::fs::write(&source_path, source).unwrap();
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
        let flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];
        output_of(Command::new(compiler).args(flags).arg("-o").arg(&program).arg(&source_path).arg("-lm"));
        agree(&output_of(&mut Command::new(&program)), &wanted);

        let lines: String = wanted
            .iter()
            .map(|(place, _)| format!("    println!(\"{{}}\", law::{});\n", call("", place)))
            .collect();
        std::fs::write(folder.join(format!("law{i}.rs")), formula_rust(&view)).unwrap();
        let source = format!(
            "#[path = \"law{i}.rs\"]\nmod law;\nfn main() {{\n{lines}    println!(\"{{}}\", i32::from(law::{}));\n}}\n",
            call("_is_known", &far)
        );
        let (source_path, program) = (folder.join(format!("r{i}.rs")), folder.join(format!("r{i}")));
        std::fs::write(&source_path, source).unwrap();
        let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
        output_of(Command::new(compiler).args(["--edition", "2024", "-o"]).arg(&program).arg(&source_path));
        agree(&output_of(&mut Command::new(&program)), &wanted);

        // The table and the list hold the coefficients to the last bit.
        let table: toml::Table = formula_toml(&view).parse().unwrap();
        let pieces = table["pieces"].as_array().unwrap();
        let read: Vec<f64> = pieces
            .iter()
            .flat_map(|piece| piece["coefficients"].as_array().unwrap())
            .map(|value| value.as_float().unwrap())
            .collect();
        let own: Vec<f64> = law.pieces.iter().flat_map(|piece| piece.coefficients.clone()).collect();
        assert_eq!(read, own);
        let listed: Vec<f64> = formula_csv(&view)
            .lines()
            .skip(1)
            .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
            .collect();
        assert_eq!(listed, own);
    }
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let told = |study: &str| {
        let text = format!("{CIRCLE}\n[study.law]\nkind = \"formula\"\n{study}\n");
        let model = Document::parse(&text, "law.toml").unwrap().model(&[]);
        let model = match model {
            Ok(model) => model,
            Err(report) => return report.problems()[0].message.clone(),
        };
        let StudyKind::Formula(study) = &model.studies[0].kind else { panic!("no formula") };
        formula(&model, study, &Options::default(), &mut |_| {}).unwrap_err().message
    };
    let grid = "vary = { moment = [\"0 N*m\", \"2 N*m\", 4] }\nof = \"moment\"\noutput = \"y\"";
    for (study, words) in [
        (format!("{grid}\ndegree = 6"), "4 points are too few for 7 terms"),
        (format!("{grid}\nterms = [\"moment\", \"abs(moment)\"]"), "cannot be told apart"),
        (format!("{grid}\nterms = [\"reach\"]"), "`reach` does not go into the formula"),
        (
            format!("{grid}\ndegree = 2\nrange = {{ moment = [\"5 N*m\", \"6 N*m\"] }}"),
            "no point lies in the range",
        ),
        (format!("{grid}\ndegree = 2\nterms = [\"moment\"]"), "not both"),
        (
            "output = \"y\"\nof = \"reach\"\ndegree = 1\nvary = { moment = [0, \"1 N*m\", 3] }".into(),
            "`reach` is not varied",
        ),
        (
            "output = \"y [s]\"\nof = \"moment\"\ndegree = 1\nvary = { moment = [0, \"1 N*m\", 3] }".into(),
            "is a length",
        ),
        ("output = \"y\"\nof = \"moment\"\ndegree = 1\ntrace = \"path\"".into(), "there is no trace `path`"),
    ] {
        let message = told(&study);
        assert!(message.contains(words), "{study}: {message}");
    }
}
