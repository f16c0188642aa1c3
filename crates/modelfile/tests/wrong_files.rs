//! Every file in `models/wrong` gets exactly the message that stands beside it.
//!
//! After a change of wording: `UPDATE_EXPECTED=1 cargo test -p flexura-modelfile`, then read the difference.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::{Document, ReportKind};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/wrong")
}

fn message(name: &str) -> String {
    let text = std::fs::read_to_string(folder().join(name)).unwrap();
    // The name alone, so that the message does not depend on where the checkout lies.
    let path = folder().join(name);
    let report = match Document::read(&path) {
        Ok(document) => {
            assert_eq!(document.text(), text);
            document.model(&[]).expect_err(name)
        }
        Err(report) => report,
    };
    assert_eq!(report.kind(), ReportKind::Input, "{name}");
    for problem in report.problems() {
        let is_here = problem.file == path.display().to_string();
        assert!(!is_here || text.get(problem.span.clone()).is_some(), "{name}: {problem:?}");
        assert!(!problem.message.is_empty() && !problem.message.contains("``"), "{name}: {problem:?}");
    }
    report.render(false).replace(&format!("{}/", folder().display()), "")
}

#[test]
fn each_wrong_file_gets_its_message() {
    let mut names: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".toml") && !name.starts_with("physical_"))
        .collect();
    names.sort();
    assert!(names.len() >= 45, "only {} files", names.len());
    let update = std::env::var_os("UPDATE_EXPECTED").is_some();
    let mut differences = Vec::new();
    for name in &names {
        let found = message(name);
        let path = folder().join(name).with_extension("expected");
        if update {
            std::fs::write(&path, &found).unwrap();
        }
        let expected = std::fs::read_to_string(&path).unwrap_or_default();
        if found != expected {
            differences.push(format!("{name}\nexpected:\n{expected}\nfound:\n{found}"));
        }
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

#[test]
fn the_physically_wrong_files_are_well_formed() {
    for name in ["physical_floating_body.toml", "physical_impossible_cable.toml"] {
        let document = Document::read(folder().join(name)).unwrap();
        document.model(&[]).unwrap_or_else(|report| panic!("{report}"));
    }
}

fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-{name}", std::process::id()));
    if path.exists() {
        let _ = std::fs::remove_file(&path);
    }
    path
}

fn refusal(path: &Path) -> (ReportKind, String) {
    let report = Document::read(path).unwrap_err();
    (report.kind(), report.render(false).replace(&path.display().to_string(), "FILE"))
}

#[test]
fn a_file_of_200_megabytes_is_refused_before_it_is_read() {
    let path = scratch("large.toml");
    std::fs::File::create(&path).unwrap().set_len(200 << 20).unwrap();
    let (kind, message) = refusal(&path);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(kind, ReportKind::Input);
    let expected = "error: the file is 200 MiB large; a model file may have at most 16 MiB\n--> FILE\n = help: points of a curve belong in a CSV file\n";
    assert_eq!(message, expected);
}

#[test]
fn a_binary_file_a_directory_and_a_missing_file_are_named_as_what_they_are() {
    let path = scratch("binary.toml");
    std::fs::write(&path, b"format = 1\n\x00\x01").unwrap();
    assert_eq!(refusal(&path).0, ReportKind::Input);
    assert!(
        refusal(&path).1.starts_with("error: this is a binary file: byte 11 is zero\n"),
        "{}",
        refusal(&path).1
    );
    std::fs::write(&path, b"format = 1\nname = \"\xff\"\n").unwrap();
    assert!(
        refusal(&path).1.starts_with("error: this is no UTF-8 text: line 2, byte 19\n"),
        "{}",
        refusal(&path).1
    );
    std::fs::remove_file(&path).unwrap();
    let (kind, message) = refusal(&folder());
    assert_eq!(kind, ReportKind::Input);
    assert!(message.starts_with("error: this is a directory, not a model file\n"), "{message}");
    let (kind, message) = refusal(&folder().join("nowhere.toml"));
    assert_eq!(kind, ReportKind::Io);
    assert!(message.starts_with("error: cannot read the model file: there is no such file\n"), "{message}");
    std::fs::write(&path, b"").unwrap();
    assert!(refusal(&path).1.starts_with("error: the file is empty\n"));
    std::fs::remove_file(&path).unwrap();
}
