//! The checks that compile nothing of ours.

use crate::step::{Outcome, Step, check, exists};
use crate::{dependencies, layers, map, prose};

pub fn run() -> Outcome {
    Step::new("format", "cargo fmt --all --check").run()?;
    check("floors: a room imports only from rooms below it", "tidy", layers::check)?;
    check("map: docs/architecture.md lists the rooms", "tidy", map::check_rooms)?;
    check("links in the documentation", "tidy", map::check_links)?;
    check("prose wraps", "tidy", prose::check_width)?;
    check("dependencies are used", "tidy", dependencies::check_use)?;
    check("lengths of files", "tidy", map::warn_of_long_files)?;
    check("one nalgebra", "tidy", one_nalgebra)?;
    if exists("cargo deny --version") {
        Step::new("licences and sources", "cargo deny --offline check licenses bans sources").run()?;
    } else {
        println!("\n==> licences and sources: left out, cargo-deny is not installed");
    }
    Ok(())
}

/// Two versions of the linear algebra would make two incompatible kinds of vectors.
fn one_nalgebra() -> Outcome {
    let list =
        Step::new("one nalgebra", "cargo tree --workspace --duplicates --depth 0 --prefix none").output()?;
    let versions: Vec<&str> = list.lines().filter(|line| line.starts_with("nalgebra v")).collect();
    if versions.is_empty() { Ok(()) } else { Err(format!("the tree holds {versions:?}")) }
}
