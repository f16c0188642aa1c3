//! The map must be the territory: `docs/architecture.md` lists the folders that exist, and links lead somewhere.

use crate::step::{Outcome, entries, files, read, root};
use std::collections::BTreeSet;
use std::path::Path;

/// The table's rows name each room as `` | `crates/room` | ``.
pub fn check_rooms() -> Outcome {
    let map = read(&root().join("docs/architecture.md"))?;
    let mut drawn = BTreeSet::new();
    for line in map.lines().filter(|line| line.starts_with('|')) {
        if let Some((_, rest)) = line.split_once("`crates/")
            && let Some((room, _)) = rest.split_once('`')
            && !drawn.insert(room.to_owned())
        {
            return Err(format!("docs/architecture.md lists crates/{room} twice"));
        }
    }
    let built: BTreeSet<String> = entries(&root().join("crates"))?
        .iter()
        .filter(|path| path.is_dir())
        .filter_map(|path| path.file_name().and_then(|name| name.to_str()).map(str::to_owned))
        .collect();
    let missing: Vec<_> = built.difference(&drawn).collect();
    let gone: Vec<_> = drawn.difference(&built).collect();
    if missing.is_empty() && gone.is_empty() {
        return Ok(());
    }
    Err(format!("docs/architecture.md lacks {missing:?} and lists {gone:?}, which do not exist"))
}

/// Relative links in our pages lead to files.
pub fn check_links() -> Outcome {
    let mut pages = files(&root().join("docs"), &["md"])?;
    pages.extend(["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root().join(name)));
    let mut dead = Vec::new();
    for page in pages {
        let folder = page.parent().unwrap_or(Path::new("."));
        for link in links(&read(&page)?) {
            if !folder.join(&link).exists() {
                dead.push(format!("{}: {link}", page.strip_prefix(root()).unwrap_or(&page).display()));
            }
        }
    }
    if dead.is_empty() { Ok(()) } else { Err(format!("links that lead nowhere\n{}", dead.join("\n"))) }
}

/// Targets of `](target)` that are files of ours, without their fragment.
fn links(page: &str) -> Vec<String> {
    page.split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
        .filter(|target| !target.contains("://") && !target.starts_with('#') && !target.contains(' '))
        .filter_map(|target| target.split('#').next().map(str::to_owned))
        .collect()
}

/// Files of ours past this many lines should be split; said, not refused.
const LONGEST: usize = 600;

pub fn warn_of_long_files() -> Outcome {
    for folder in ["crates", "xtask"] {
        for path in files(&root().join(folder), &["rs"])? {
            let lines = read(&path)?.lines().count();
            if lines > LONGEST {
                let name = path.strip_prefix(root()).unwrap_or(&path).display().to_string();
                println!("    warning: {name} has {lines} lines; split it");
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_of_ours_are_found_and_others_left_alone() {
        let page = "[a](docs/a.md) [b](https://b.c) ![c](images/c.svg) [d](e.md#part) [f](#here)";
        assert_eq!(links(page), ["docs/a.md", "images/c.svg", "e.md"]);
    }

    #[test]
    fn the_map_lists_the_rooms() {
        assert_eq!(check_rooms(), Ok(()));
    }
}
