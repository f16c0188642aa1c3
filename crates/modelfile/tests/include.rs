//! Files that include others: what comes of it, and what is said where it goes wrong.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::{Document, to_toml};

const STEEL: &str =
    "format = 1\n[parameter]\nyoung = \"207 GPa\"\n[material.steel]\nyoung = \"young\"\npoisson = 0.3\n";
const WIRE: &str = "format = 1\ninclude = \"steel.toml\"\n[parameter]\nlength = \"100 mm\"\npush = \"2 N\"\n\
                    [section.wire]\nshape = \"circle\"\ndiameter = \"1 mm\"\n[beam.link]\nlength = \"length\"\n";
const MAIN: &str = "format = 1\nname = \"link\"\ninclude = [\"parts/wire.toml\", \"parts/steel.toml\"]\n\
                    [beam.link]\nmaterial = \"steel\"\nsection = \"wire\"\nstart = { body = \"ground\", hold = \"clamp\" }\n\
                    [load.tip]\nbeam = \"link\"\nat = 1\nforce = [0, 0, \"-push\"]\n\
                    [output]\nlow = \"beam.link.end.position.z\"\n";
const PARTS: &[(&str, &str)] = &[("parts/steel.toml", STEEL), ("parts/wire.toml", WIRE)];

fn link() -> Document {
    Document::parse_with(MAIN, "link.toml", PARTS).unwrap_or_else(|report| panic!("{report}"))
}

/// What is said of a file that cannot be read, or whose model cannot be made.
fn refused(text: &str, parts: &[(&str, &str)]) -> String {
    let made = Document::parse_with(text, "link.toml", parts).and_then(|document| document.model(&[]));
    made.expect_err("it should be refused").render(false)
}

#[test]
fn tables_of_included_files_are_tables_of_the_file() {
    let document = link();
    assert_eq!(document.parameter_names(), ["young", "length", "push"]);
    assert_eq!(document.included().collect::<Vec<_>>(), ["parts/wire.toml", "parts/steel.toml"]);
    let model = document.model(&[]).unwrap();
    assert_eq!((model.beams.len(), model.materials.len(), model.name.as_str()), (1, 1, "link"));
    assert_eq!(model.loads[0].force.z, -2.0);
}

#[test]
fn a_parameter_of_an_included_file_can_be_overridden() {
    let overrides = [("push".to_string(), "3 N".to_string()), ("young".to_string(), "70 GPa".to_string())];
    let model = link().model(&overrides).unwrap();
    assert_eq!((model.loads[0].force.z, model.materials[0].young), (-3.0, 70e9));
}

#[test]
fn the_same_written_out_is_the_same_model() {
    let document = link();
    let model = document.model(&[]).unwrap();
    let text = document.whole_text();
    assert!(!text.contains("include"), "{text}");
    let again = Document::parse(&text, "link.toml").unwrap_or_else(|report| panic!("{report}\n{text}"));
    let again = again.model(&[]).unwrap();
    assert_eq!(to_toml(&again).unwrap(), to_toml(&model).unwrap());
    let again = Document::parse(&to_toml(&model).unwrap(), "link.toml").unwrap().model(&[]).unwrap();
    assert_eq!(again.outputs, model.outputs);
    assert_eq!(again.beams, model.beams);
}

#[test]
fn a_file_without_parts_is_its_own_text() {
    let text = "# A remark\nformat = 1\n";
    assert_eq!(Document::parse(text, "a.toml").unwrap().whole_text(), text);
}

#[test]
fn what_a_part_offers_need_not_be_used() {
    let parts = [("parts/wire.toml", WIRE), ("parts/steel.toml", STEEL)];
    let text = MAIN.replace("\"-push\"", "-1") + "[parameter]\nidle = 1\n";
    let document = Document::parse_with(&text, "link.toml", &parts).unwrap();
    let warnings: Vec<String> = document.warnings().iter().map(|warning| warning.message.clone()).collect();
    assert_eq!(warnings, ["the parameter `idle` is never used"]);
}

#[test]
fn a_mistake_is_shown_in_the_file_in_which_it_stands() {
    let wire = WIRE.replace("\"1 mm\"", "\"1 N\"");
    let text = refused(MAIN, &[("parts/steel.toml", STEEL), ("parts/wire.toml", &wire)]);
    assert!(text.contains("--> parts/wire.toml:8:12") && text.contains("section.wire.diameter"), "{text}");
}

#[test]
fn a_mistake_of_a_repeated_table_in_a_part_is_told_once() {
    let part = "format = 1\n[body.\"n_{i}\"]\nrepeat = { i = 3 }\nat = [\"1 N\", 0, 0]\n";
    let text = refused(
        &format!("{MAIN}[body.other]\nat = [0, 0, \"1 N\"]\n")
            .replace("\"parts/steel.toml\"", "\"grid.toml\""),
        &[("parts/steel.toml", STEEL), ("parts/wire.toml", WIRE), ("grid.toml", part)],
    );
    assert_eq!(text.matches("error:").count(), 2, "{text}");
    assert!(text.contains("and so in 2 more copies"), "{text}");
}

#[test]
fn a_missing_file_is_told_with_the_way_to_it() {
    let text = refused(MAIN, &[("parts/wire.toml", WIRE)]);
    assert!(text.contains("cannot read `steel.toml`: there is no such file"), "{text}");
    assert!(text.contains("--> parts/wire.toml:2:11"), "{text}");
    assert!(text.contains("the way here is link.toml -> parts/wire.toml"), "{text}");
}

#[test]
fn a_circle_is_told_with_all_its_files() {
    let steel = "format = 1\ninclude = \"wire.toml\"\n";
    let text = refused(MAIN, &[("parts/wire.toml", WIRE), ("parts/steel.toml", steel)]);
    let circle = "in a circle: parts/wire.toml -> parts/steel.toml -> parts/wire.toml";
    assert!(text.contains(circle), "{text}");
}

#[test]
fn a_key_that_is_given_twice_is_told_with_both_places() {
    let text = refused(&MAIN.replace("[output]", "[parameter]\nlength = \"90 mm\"\n[output]"), PARTS);
    assert!(text.contains("the key `parameter.length` is given twice"), "{text}");
    assert!(text.contains("it stands first in parts/wire.toml, line 4"), "{text}");
    assert!(text.contains("--> link.toml:13:1"), "{text}");
}

#[test]
fn a_study_typed_behind_parts_is_shown_as_typed() {
    let document = link();
    let typed = document.with_study("trace", &[("parameter", Some("pusch".to_string()))]).unwrap();
    let text = typed.model(&[]).expect_err("there is no such parameter").render(false);
    assert!(text.contains("command line") && text.contains("push"), "{text}");
}

#[test]
fn files_that_a_part_names_are_looked_for_beside_the_part() {
    let folder =
        std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("include-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    std::fs::write(folder.join("parts/way.csv"), "0, 0, 0\n0.05, 0.01, 0\n0.1, 0, 0\n").unwrap();
    let part = format!("{STEEL}[beam.link.curve]\nkind = \"points\"\nfile = \"way.csv\"\n");
    std::fs::write(folder.join("parts/way.toml"), part).unwrap();
    let text = "format = 1\ninclude = \"parts/way.toml\"\n[section.wire]\nshape = \"circle\"\ndiameter = \"1 mm\"\n\
                [beam.link]\nmaterial = \"steel\"\nsection = \"wire\"\nstart = { body = \"ground\", hold = \"clamp\" }\n";
    std::fs::write(folder.join("link.toml"), text).unwrap();
    let model = Document::read(folder.join("link.toml")).and_then(|document| document.model(&[]));
    assert_eq!(model.unwrap_or_else(|report| panic!("{report}")).beams.len(), 1);
    std::fs::remove_dir_all(folder).unwrap();
}
