//! A program in C is compiled against the header, linked with the library and run.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::{Options, solve_file};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the library beside this test.
fn built() -> PathBuf {
    let own = std::env::current_exe().unwrap();
    own.parent().unwrap().to_path_buf()
}

#[test]
fn a_loop_in_c_finds_what_rust_finds() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Built with this test, beside it.
    let library = built();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("loop");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    let status = Command::new(compiler)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror"])
        .arg("-I")
        .arg(root.join("include"))
        .arg(root.join("tests/loop.c"))
        .arg("-o")
        .arg(&program)
        .arg("-L")
        .arg(&library)
        .args(["-lflexura_c", "-lm"])
        .arg(format!("-Wl,-rpath,{}", library.display()))
        .status();
    assert!(status.unwrap().success(), "the program does not compile");

    let model = root.join("../../models/lee_frame.toml");
    let output = Command::new(&program).arg(&model).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let down: f64 = String::from_utf8(output.stdout).unwrap().trim().parse().unwrap();
    let overrides = [("load".to_owned(), "1.8".to_owned())];
    let solved = solve_file(&model, &overrides, &Options::default()).unwrap();
    assert!((down - solved.number("down").unwrap()).abs() < 1e-6 * down);
}
