//! CSV, VTK and SVG of a known solution.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{model, rich, solution};
use flexura_output::{beams_csv, document, model_vtp, shape_svg, solution_of, to_json};
use flexura_post::evaluate;
use flexura_solution::Status;
use std::process::Command;

#[test]
fn the_table_has_a_row_for_each_sample() {
    let (model, solution) = (model(), solution());
    let text = beams_csv(&model, &solution, &evaluate(&model, &solution).unwrap()).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(rows.len(), 1 + 21 + 5);
    let columns = rows[0].split(',').count();
    assert_eq!(columns, 21);
    assert!(rows[0].starts_with("beam,s[m],x[m]"));
    let first: Vec<&str> = rows[1].split(',').collect();
    assert_eq!(first.len(), columns);
    assert_eq!(first[0], "strip");
    assert!((first[19].parse::<f64>().unwrap() - 3e-3).abs() < 1e-12);
    // The second beam's name holds quotes, and it has no stress.
    assert!(rows[22].starts_with("\"wire <\"\"b\"\">\",0.0,"));
    assert!(rows[22].ends_with(",,"));
}

/// The model and its solution with the strip on a foundation along its second half.
fn founded() -> (flexura_model::Model, flexura_solution::Solution) {
    use flexura_model::{At, Foundation, FoundationLaw, LoadAxes};
    let (mut model, mut solution) = (model(), solution());
    model.beams[0].foundation.push(Foundation {
        law: FoundationLaw::Linear(30.0.into()),
        direction: None,
        axes: LoadAxes::Global,
        between: [At::Fraction(0.5), At::Fraction(1.0)],
    });
    solution.beams[0].foundation_force = flexura_spatial::Vector3::new(0.0, 0.5, -0.25);
    for (i, sample) in solution.beams[0].samples.iter_mut().enumerate() {
        sample.foundation = flexura_spatial::Vector3::new(0.5 * i as f64, 0.0, -1.0);
    }
    (model, solution)
}

#[test]
fn foundations_have_columns_a_band_and_lists_only_where_there_are_any() {
    let (model, solution) = founded();
    let evaluation = evaluate(&model, &solution).unwrap();
    let text = beams_csv(&model, &solution, &evaluation).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert!(rows[0].ends_with(",stress[Pa],qx[N/m],qy[N/m],qz[N/m]"));
    assert!(rows.iter().all(|row| row.split(',').count() == 24));
    assert!(rows[3].ends_with(",1.0,0.0,-1.0"));
    assert!(rows[22].ends_with(",,,,,"));

    let text = shape_svg(&model, &solution);
    assert!(text.contains(">foundation<"));
    // One band in the one view of a plane mechanism, and one in the legend.
    assert_eq!(text.matches("stroke=\"#ece0c8\"").count(), 2);

    let document = document(&model, &solution, &evaluation).unwrap();
    let value: serde_json::Value = serde_json::from_str(&to_json(&document).unwrap()).unwrap();
    let strip = &value["beams"]["strip"];
    assert_eq!(strip["foundation"][3], serde_json::json!([1.5, 0.0, -1.0]));
    assert_eq!(strip["foundation_force"], serde_json::json!([0.0, 0.5, -0.25]));
    assert!(value["beams"]["wire <\"b\">"].get("foundation").is_none());
    let back = solution_of(&document, &model).unwrap();
    assert_eq!(back.beams[0].samples[3].foundation, solution.beams[0].samples[3].foundation);
    assert_eq!(back.beams[0].foundation_force, solution.beams[0].foundation_force);
}

#[test]
fn the_vtk_file_holds_one_line_a_beam() {
    let (model, solution) = (model(), solution());
    let text = model_vtp(&model, &solution, &evaluate(&model, &solution).unwrap());
    assert!(text.contains("NumberOfPoints=\"26\"") && text.contains("NumberOfLines=\"2\""));
    for field in ["displacement", "force", "moment", "curvature", "director_e2", "director_e3", "stress"] {
        assert!(text.contains(&format!("Name=\"{field}\"")), "{field}");
    }
}

#[test]
fn the_vtk_file_holds_tubes_and_cables_behind_the_beams() {
    let (model, solution) = rich();
    let text = model_vtp(&model, &solution, &evaluate(&model, &solution).unwrap());
    assert!(text.contains("NumberOfPoints=\"59\"") && text.contains("NumberOfLines=\"5\""));
    assert!(text.contains("Name=\"tubes_names\" NumberOfTuples=\"1\"") && text.contains("Name=\"tubes\""));
    assert!(text.contains("Name=\"cable_names\" NumberOfTuples=\"2\"") && text.contains("Name=\"tension\""));
}

#[test]
#[ignore = "needs Python with PyVista; FLEXURA_PYTHON names the interpreter"]
fn the_vtk_file_opens_in_pyvista() {
    let (model, solution) = (model(), solution());
    let text = model_vtp(&model, &solution, &evaluate(&model, &solution).unwrap());
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("arc.vtp");
    std::fs::write(&path, text).unwrap();
    let python = std::env::var("FLEXURA_PYTHON").unwrap_or_else(|_| "python3".into());
    let script = r#"
import sys, math, pyvista
mesh = pyvista.read(sys.argv[1])
assert mesh.n_points == 26 and mesh.n_lines == 2, mesh
tip = mesh.points[20]
assert abs(tip[0] - math.sin(1.2) / 6) < 1e-15 and tip[2] < 0, tip
assert abs(mesh["displacement"][20][0] - (math.sin(1.2) / 6 - 0.2)) < 1e-15
assert list(mesh.cell_data["beam"]) == [0, 1]
assert list(mesh.field_data["beam_names"]) == ["strip", 'wire <"b">'], list(mesh.field_data["beam_names"])
assert list(mesh.field_data["status"]) == ["converged"], list(mesh.field_data["status"])
assert abs(mesh["strain"][3] - 3e-3) < 1e-12 and math.isnan(mesh["stress"][25])
assert abs(mesh.compute_arc_length()["arc_length"].max() - 0.2) < 1e-3
"#;
    let run = |script: &str, path: &std::path::Path| {
        let output = Command::new(&python).args(["-c", script]).arg(path).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    run(script, &path);

    let (model, solution) = rich();
    let path = path.with_file_name("rich.vtp");
    std::fs::write(&path, model_vtp(&model, &solution, &evaluate(&model, &solution).unwrap())).unwrap();
    let script = r#"
import sys, math, pyvista
mesh = pyvista.read(sys.argv[1])
assert mesh.n_points == 59 and mesh.n_lines == 5, mesh
assert list(mesh.cell_data["beam"]) == [0, 1, -1, -1, -1] and list(mesh.cell_data["tubes"]) == [-1, -1, 0, -1, -1]
assert list(mesh.cell_data["cable"]) == [-1, -1, -1, 0, 1] and list(mesh.field_data["tubes_names"]) == ["robot"]
assert list(mesh.cell_data["tension"])[3:] == [3.0, 1.5] and math.isnan(mesh.cell_data["tension"][0])
assert list(mesh.field_data["cable_names"]) == ["puller", "bowden"]
assert list(mesh.points[36]) == [0.1, 0.0, 0.06] and math.isnan(mesh["stress"][36])
assert list(mesh.points[26]) == [0.0, 0.08, 0.0] and list(mesh["curvature"][34]) == [0.0, 0.0, 5.0]
assert abs(mesh["s"][34] - 0.08) < 1e-15 and math.isnan(mesh["stretch"][26]) and math.isnan(mesh["displacement"][26][0])
"#;
    run(script, &path);
}

/// May a character stand in XML 1.0 (production 2), and can it be seen?
fn is_seen(character: char) -> bool {
    let is_legal =
        matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
    is_legal && !matches!(character, '\u{7f}'..='\u{9f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[test]
fn names_break_no_file_whatever_they_hold() {
    const NASTY: &str = "=a\u{1b}[2J\u{9b}2J\u{202e}b\u{2066}\u{ffff}\u{0}<c>&\r\n";
    let (mut model, solution) = rich();
    model.name = NASTY.into();
    model.beams[0].name = NASTY.into();
    model.bodies[0].name = NASTY.into();
    let evaluation = evaluate(&model, &solution).unwrap();
    let picture = shape_svg(&model, &solution);
    assert!(
        picture.contains("=a\\u001B[2J\\u009B2J\\u202Eb\\u2066\\uFFFF\\u0000&lt;c&gt;&amp;\\u000D\\u000A")
    );
    let document = to_json(&document(&model, &solution, &evaluation).unwrap()).unwrap();
    let table = beams_csv(&model, &solution, &evaluation).unwrap();
    for text in [&picture, &document, &table, &model_vtp(&model, &solution, &evaluation)] {
        assert_eq!(text.chars().find(|character| !is_seen(*character)), None);
    }
    let value: serde_json::Value = serde_json::from_str(&document).unwrap();
    assert_eq!(value["model"], NASTY);
    // As many rows as before, whose first cell is no formula.
    let rows = beams_csv(&rich().0, &solution, &evaluation).unwrap().lines().count();
    assert_eq!(table.lines().count(), rows);
    assert!(table.lines().nth(1).unwrap().starts_with("'=a\\u001B"), "{table}");
}

#[test]
fn a_long_name_stays_on_the_sheet() {
    let (mut model, solution) = rich();
    let name = "n".repeat(200);
    model.name = name.repeat(5);
    model.beams[0].name.clone_from(&name);
    model.bodies[0].name = name;
    let picture = shape_svg(&model, &solution);
    let longest = picture.split("</text>").filter_map(|text| Some(text.rsplit_once('>')?.1.chars().count()));
    assert!(longest.max().unwrap() < 160 && picture.contains("nnn…<"), "{picture}");
}

#[test]
fn a_picture_of_what_did_not_converge_says_so() {
    let (model, mut solution) = (model(), solution());
    assert!(!shape_svg(&model, &solution).contains("not converged"));
    (solution.status, solution.load_fraction) = (Status::Stalled, 0.43);
    assert!(shape_svg(&model, &solution).contains("not converged, stalled; 43.000 % of the load"));
    let evaluation = evaluate(&model, &solution).unwrap();
    let before = model_vtp(&model, &common::solution(), &evaluation);
    assert!(before.contains("Name=\"status\"") && before != model_vtp(&model, &solution, &evaluation));
}

#[test]
fn the_picture_of_a_plane_mechanism_has_one_view_and_names_what_it_shows() {
    let text = shape_svg(&model(), &solution());
    for words in ["front view (xz)", "bent &amp; held", ">strip<", ">lever<", ">return<", ">spring<", ">1 N<"]
    {
        assert!(text.contains(words), "{words}");
    }
    for words in ["top view (xy)", "side view (yz)", "isometric view"] {
        assert!(!text.contains(words), "{words}");
    }
    assert!(text.contains("wire &lt;&quot;b&quot;&gt;"));
    assert!(!text.contains("NaN") && !text.contains("inf"));
    // FLEXURA_PICTURES keeps the picture for a look.
    if let Ok(folder) = std::env::var("FLEXURA_PICTURES") {
        std::fs::write(std::path::Path::new(&folder).join("arc.svg"), text).unwrap();
    }
}

#[test]
fn the_picture_shows_cables_tubes_and_every_kind_of_joint() {
    let (model, solution) = rich();
    let text = shape_svg(&model, &solution);
    assert!(text.contains(">cable<"));
    for words in
        ["top view (xy)", "front view (xz)", "side view (yz)", "isometric view", ">puller<", ">bowden<"]
    {
        assert!(text.contains(words), "{words}");
    }
    // Two cables in four views, and one line in the legend; three eyelets in four views, and one.
    assert_eq!(text.matches("stroke=\"#7b3294\" stroke-width=\"1.2\"").count(), 9);
    assert_eq!(text.matches("r=\"2.4\"").count(), 13);
    // The robot is the third line: its whole axis in four views and the legend, and the outer tube's part in four.
    assert!(text.contains(">robot<"));
    assert_eq!(text.matches("stroke=\"#009e73\" stroke-width=\"2.4\"").count(), 5);
    assert_eq!(text.matches("stroke=\"#009e73\" stroke-width=\"4.2\"").count(), 4);
    assert!(!text.contains("NaN") && !text.contains("inf"));
    if let Ok(folder) = std::env::var("FLEXURA_PICTURES") {
        std::fs::write(std::path::Path::new(&folder).join("rich.svg"), text).unwrap();
    }
}

#[test]
fn the_picture_tells_masses_and_gravity_where_there_are_any() {
    use flexura_model::{At, BeamId, BeamPoint, PointMass};
    use flexura_spatial::Vector3;
    let (mut model, solution) = (model(), solution());
    let plain = shape_svg(&model, &solution);
    assert!(!plain.contains(">mass<") && !plain.contains("gravity"));
    model.gravity = Vector3::new(0.0, 0.0, -9.81);
    model.bodies[0].mass = 2.5;
    model.masses.push(PointMass {
        name: "sensor".to_owned(),
        point: BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) },
        mass: 0.05,
        inertia: flexura_spatial::Matrix3::zeros(),
    });
    let text = shape_svg(&model, &solution);
    for words in [">sensor 50 g<", ">2.5 kg<", ">mass<", ">gravity (0, 0, −9.81) m/s²<"] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn the_picture_shows_the_course_of_a_spring_that_runs_over_something() {
    let (model, mut solution) = rich();
    let points = |text: &str| -> Vec<usize> {
        text.split("<polyline points=\"")
            .skip(1)
            .map(|rest| rest.split('>').next().unwrap_or_default())
            .filter(|element| element.contains("stroke=\"#666666\""))
            .map(|element| element.split('"').next().unwrap_or_default().split(' ').count())
            .collect()
    };
    let ends = solution.springs[0].ends;
    let middle = (ends[0] + ends[1]) * 0.5;
    let over = middle + flexura_spatial::Vector3::new(0.0, 0.02, 0.03);
    solution.springs[0].course = vec![ends[0], over, middle + (over - middle) * 0.9, ends[1]];
    let text = shape_svg(&model, &solution);
    assert_eq!(points(&text).iter().filter(|count| **count == 4).count(), 4, "{:?}", points(&text));
}
