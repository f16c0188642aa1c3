//! Everything that must hold, cheapest first.

use crate::step::{Outcome, Step, check, exists};
use crate::{generate, live, python, tidy, viewer};
use std::path::Path;

pub fn run() -> Outcome {
    tidy::run()?;
    let python = python::prepare()?;
    viewer::prepare()?;
    // All targets: benches and examples must compile too.
    Step::new("lints", "cargo clippy --workspace --all-targets -- -D warnings").run()?;
    tests(&python)?;
    Step::new("documentation tests", "cargo test --doc --workspace").run()?;
    Step::new("documentation", "cargo doc --workspace --no-deps")
        .variable("RUSTDOCFLAGS", "-D warnings")
        .run()?;
    generate::build()?;
    viewer::test()?;
    check("the live page of the documentation is up to date", "live", live::check)?;
    check("generated files are up to date", "test", generate::check)?;
    python::check_schema(&python)?;
    python::test_package(&python)?;
    println!("\nall checks and tests passed");
    Ok(())
}

/// All tests, those that need Python among them. nextest where it is installed; the built-in runner runs the
/// same tests where it is not, since building nextest would take longer than running them.
fn tests(python: &Path) -> Outcome {
    let step = if exists("cargo nextest --version") {
        Step::new("tests", "cargo nextest run --workspace --no-fail-fast --run-ignored all")
    } else {
        Step::new(
            "tests",
            "cargo test --workspace --lib --bins --tests --examples --no-fail-fast -- --include-ignored",
        )
    };
    step.variable("FLEXURA_PYTHON", python.display().to_string()).run()
}
