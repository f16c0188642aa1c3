//! Wrong input ends with exit code 2, a message, and nothing on standard output.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, flexura, folder, stderr};
use std::path::Path;

fn assert_refused(path: &Path) {
    for verb in ["solve", "check"] {
        let output = flexura().arg(verb).arg(path).arg("--json").output().unwrap();
        assert_eq!(code(&output), 2, "{verb} {}: {}", path.display(), stderr(&output));
        assert!(output.stdout.is_empty(), "{verb} {}", path.display());
        assert!(stderr(&output).contains("error"), "{verb} {}", path.display());
    }
}

#[test]
fn every_wrong_model_is_refused() {
    let mut count = 0;
    for entry in std::fs::read_dir(common::models().join("wrong")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            assert_refused(&path);
            count += 1;
        }
    }
    assert!(count >= 40, "only {count} wrong files");
}

#[test]
fn what_is_no_model_file_is_refused() {
    let folder = folder("what_is_no_model_file");
    assert_refused(&folder);
    let path = folder.join("binary.toml");
    std::fs::write(&path, [0x7f, b'E', b'L', b'F', 0, 0xff]).unwrap();
    assert_refused(&path);
    std::fs::write(&path, "").unwrap();
    assert_refused(&path);
    // A hole of 200 MB: it must be refused by its size, not read.
    std::fs::File::create(&path).unwrap().set_len(200 << 20).unwrap();
    assert_refused(&path);
    std::fs::remove_file(&path).unwrap();
}
