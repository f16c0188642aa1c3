//! A room imports only from rooms below it.

use crate::step::{Outcome, entries, read, root};

/// Floors from the ground up. A crate may depend on crates of lower floors only.
const FLOORS: &[&[&str]] = &[
    &["spatial", "expression", "nonlinear"],
    &["model", "continuation"],
    &["geometry"],
    &["solution", "mechanics"],
    &["modelfile", "equilibrium", "post"],
    &["study"],
    &["output", "fitting", "design"],
    &["report", "raster"],
    &["flexura", "testkit"],
    &["verification"],
    &["flexura-cli", "live", "flexura-python", "flexura-c"],
];

/// Rooms that may use everything and that nothing may use except in tests.
const BESIDE: &[&str] = &["campaign"];

/// What gives results a meaning never looks at how they were found, and what solves knows no files.
const NEVER: &[(&str, &[&str])] = &[
    ("post", &["modelfile", "mechanics", "nonlinear", "continuation", "equilibrium", "study"]),
    ("output", &["modelfile", "mechanics", "nonlinear", "continuation", "equilibrium", "study"]),
    ("study", &["modelfile"]),
    ("fitting", &["modelfile", "mechanics", "equilibrium"]),
    ("design", &["modelfile"]),
    // The second method shares nothing with the solver, and only the command shows the two beside each other.
    ("testkit", &["modelfile", "nonlinear", "mechanics", "equilibrium", "study"]),
    ("live", &["testkit", "verification"]),
    ("flexura-python", &["testkit", "verification"]),
    ("flexura-c", &["testkit", "verification"]),
];

fn floor(room: &str) -> Option<usize> {
    FLOORS.iter().position(|rooms| rooms.contains(&room))
}

/// The crates of ours that a manifest names under `[dependencies]`.
fn imports(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut found = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            inside = line == "[dependencies]" || line == "[build-dependencies]";
        } else if inside {
            let name = line.split(['.', '=', ' ']).next().unwrap_or_default();
            if name == "flexura" || name.starts_with("flexura-") {
                found.push(room_of(name).to_owned());
            }
        }
    }
    found
}

fn room_of(package: &str) -> &str {
    match package.strip_prefix("flexura-") {
        Some("cli") => "flexura-cli",
        Some("python") => "flexura-python",
        Some("c") => "flexura-c",
        Some(room) => room,
        None => package,
    }
}

pub fn check() -> Outcome {
    let mut wrong = Vec::new();
    for folder in entries(&root().join("crates"))? {
        let manifest = folder.join("Cargo.toml");
        let room = folder.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if !manifest.is_file() {
            wrong.push(format!("crates/{room} has no Cargo.toml"));
            continue;
        }
        let beside = BESIDE.contains(&room.as_str());
        let own = floor(&room);
        if own.is_none() && !beside {
            wrong.push(format!("crates/{room} stands on no floor: add it to xtask/src/layers.rs"));
        }
        for import in imports(&read(&manifest)?) {
            let never = NEVER.iter().any(|(who, what)| *who == room && what.contains(&import.as_str()));
            let below = match (own, floor(&import)) {
                (Some(own), Some(other)) => other < own && !never,
                _ => beside,
            };
            if !below {
                wrong.push(format!("{room} must not import {import}"));
            }
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_dependencies_of_ours_count() {
        let manifest = "[package]\nname = \"flexura-model\"\n[dependencies]\nnalgebra.workspace = true\n\
                        flexura-spatial.workspace = true\nflexura-cli = { path = \"x\" }\nflexura.workspace = true\n\
                        [dev-dependencies]\nflexura-testkit.workspace = true\n";
        assert_eq!(imports(manifest), ["spatial", "flexura-cli", "flexura"]);
    }

    #[test]
    fn the_workspace_keeps_its_floors() {
        assert_eq!(check(), Ok(()));
    }
}
