//! flexura's chores.
//!
//! ```text
//! cargo xtask test       everything that must hold: the checks, the tests, the documentation
//! cargo xtask generate   rewrite the files that are generated
//! cargo xtask python     the wheel of the Python package, built, installed where nothing else is, and tested
//! cargo xtask page       rebuild the page that shows results, from viewer/
//! cargo xtask pictures   photograph the page: the gallery, and the pictures of the README
//! cargo xtask live       build the solver for the live page (minutes)
//! cargo xtask tidy       the checks that compile nothing
//! cargo xtask campaign   random mechanisms and damaged files for every verb, their answers verified by other means
//! ```
//!
//! Each step prints one line before it starts; the first failure ends the run with the command to repeat it.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "chores talk to a terminal")]

mod campaign;
mod dependencies;
mod generate;
mod layers;
mod live;
mod map;
mod prose;
mod python;
mod step;
mod test;
mod tidy;
mod viewer;

use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask <test | generate | python | page | pictures | live | tidy | campaign [--seed S] [--count N] [--jobs J]>";

fn main() -> ExitCode {
    let verb = std::env::args().nth(1).unwrap_or_default();
    let result = match verb.as_str() {
        "test" => test::run(),
        "generate" => generate::write(),
        "python" => python::prepare().and_then(|python| python::test_package(&python)),
        "page" => viewer::build(),
        "pictures" => generate::build().and_then(|()| viewer::pictures()),
        "live" => live::build(),
        "tidy" => tidy::run(),
        "campaign" => campaign::run(std::env::args().skip(2)),
        _ => Err(USAGE.to_string()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("\nxtask: {message}");
            ExitCode::FAILURE
        }
    }
}
