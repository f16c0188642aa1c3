//! Prose in our pages is wrapped, so that a change of a sentence is a change of a line.

use crate::step::{Outcome, files, read, root};

/// Columns of a line.
const WIDTH: usize = 120;

/// Pages that the build writes are as wide as what they show.
const WRITTEN_BY_THE_BUILD: [&str; 4] =
    ["docs/gallery.md", "docs/verification.md", "docs/thesis.md", "docs/reference/"];

/// No line of prose is longer than it may be; tables, code and single words may be.
pub fn check_width() -> Outcome {
    let mut pages = files(&root().join("docs"), &["md"])?;
    pages.extend(["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root().join(name)));
    let mut long = Vec::new();
    for page in pages {
        let name = page.strip_prefix(root()).unwrap_or(&page).display().to_string();
        if WRITTEN_BY_THE_BUILD.iter().any(|written| name.starts_with(written)) {
            continue;
        }
        long.extend(overlong(&read(&page)?).map(|line| format!("{name}:{line}")));
    }
    if long.is_empty() {
        return Ok(());
    }
    Err(format!("prose wraps at {WIDTH} columns; these lines do not\n{}", long.join("\n")))
}

/// Numbers of the lines that are too long.
fn overlong(page: &str) -> impl Iterator<Item = usize> + '_ {
    let mut is_code = false;
    page.lines().enumerate().filter_map(move |(i, line)| {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        }
        let is_table = line.starts_with('|') || line.starts_with("![") || line.starts_with("<!--");
        let words = line.split_whitespace().filter(|word| !matches!(*word, "-" | ">" | "*")).count();
        let is_long = line.chars().count() > WIDTH && words > 1;
        (is_long && !is_code && !is_table).then_some(i + 1)
    })
}

#[cfg(test)]
mod tests {
    use super::overlong;

    #[test]
    fn prose_is_told_from_tables_code_and_addresses() {
        let long = "word ".repeat(30);
        let page = format!("short\n{long}\n| {long} |\n```\n{long}\n```\n- {}\n{long}", "x".repeat(130));
        assert_eq!(overlong(&page).collect::<Vec<_>>(), [2, 8]);
    }
}
