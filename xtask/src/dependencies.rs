//! Libraries that are named are used.

use crate::step::{Outcome, entries, files, read, root};
use std::collections::BTreeSet;

/// Every dependency of a room is named in its sources, and every one of the workspace in a room.
pub fn check_use() -> Outcome {
    let mut idle = Vec::new();
    let mut used = BTreeSet::new();
    let rooms = entries(&root().join("crates"))?.into_iter().chain([root().join("xtask")]);
    for room in rooms.filter(|room| room.join("Cargo.toml").exists()) {
        let manifest = read(&room.join("Cargo.toml"))?;
        let mut sources = String::new();
        for file in files(&room, &["rs"])? {
            sources.push_str(&read(&file)?);
        }
        for name in dependencies(&manifest, "dependencies]") {
            // A feature may switch one on for what stands below.
            let is_named =
                sources.contains(&name.replace('-', "_")) || manifest.contains(&format!("\"{name}/"));
            if !is_named {
                idle.push(format!("{}: {name}", room.strip_prefix(root()).unwrap_or(&room).display()));
            }
            used.insert(name);
        }
    }
    let workspace = dependencies(&read(&root().join("Cargo.toml"))?, "[workspace.dependencies]");
    idle.extend(
        workspace.into_iter().filter(|name| !used.contains(name)).map(|name| format!("Cargo.toml: {name}")),
    );
    if idle.is_empty() { Ok(()) } else { Err(format!("dependencies that nothing uses\n{}", idle.join("\n"))) }
}

/// Names in the tables of a manifest whose heads end like this.
fn dependencies(manifest: &str, head: &str) -> Vec<String> {
    let mut is_inside = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            is_inside = line.ends_with(head);
        } else if is_inside && let Some((name, _)) = line.split_once(['.', '=', ' ']) {
            let name = name.trim();
            if !name.is_empty() && !name.starts_with('#') {
                names.push(name.to_owned());
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::dependencies;

    #[test]
    fn names_are_read_from_every_table_of_dependencies() {
        let manifest = "[package]\nname = \"room\"\n[dependencies]\n# why\na-b.workspace = true\nc = \"1\"\n\n\
                        [dev-dependencies]\nd = { path = \"d\" }\n[features]\ne = []\n";
        assert_eq!(dependencies(manifest, "dependencies]"), ["a-b", "c", "d"]);
    }
}
