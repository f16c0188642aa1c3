//! The page that shows results: built from `viewer/`, kept in `crates/report`, tried in a real browser, and photographed for the
//! documentation.
//!
//! What a machine lacks is brought by Debian's package manager where there is one: Node and npm, and Chromium.

use crate::step::{Outcome, Step, check as checked, entries, exists, read, root, target};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Vite wants at least this version of Node.
const NODE: (u32, u32) = (20, 19);
/// Where the built pages are kept: that of a result, and the one that solves.
const PAGES: [&str; 2] = ["crates/report/src/page.html", "crates/report/src/live.html"];
/// Pictures of the page that the README shows: name, camera and what is done first, and the study.
const SHOWN: &[(&str, &str, &[&str])] = &[
    ("page_lee_frame", "whole", &["run", "models/lee_frame.toml", "path"]),
    ("page_robot", "window", &["solve", "models/six_rod_robot.toml"]),
    ("page_wing", "window", &["run", "models/wing.toml", "twist"]),
];

/// Node's packages and Chromium, as the locked list says.
pub fn prepare() -> Outcome {
    if !exists("node --version") || !exists("npm --version") {
        debian(&["nodejs", "npm"])?;
    }
    let (lock, installed) =
        (viewer().join("package-lock.json"), viewer().join("node_modules/.package-lock.json"));
    let time = |path: &Path| std::fs::metadata(path).and_then(|data| data.modified()).ok();
    if time(&installed).is_none_or(|installed| time(&lock).is_some_and(|lock| installed < lock)) {
        npm("packages of the page", "ci --no-audit --no-fund").run()?;
    }
    Ok(())
}

/// Rebuilds the page.
pub fn build() -> Outcome {
    prepare()?;
    npm("the page", "run build").run()
}

/// The pages must be what a build of their sources gives, byte for byte.
pub fn check() -> Outcome {
    let pages = PAGES.map(|page| root().join(page));
    let kept = pages.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
    build()?;
    let mut stale = Vec::new();
    for ((path, kept), name) in pages.iter().zip(&kept).zip(PAGES) {
        if read(path)? != *kept {
            write(path, kept)?;
            stale.push(name);
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    Err(format!("out of date: {}; mend that with\n\n    cargo xtask page\n", stale.join(", ")))
}

/// Tests in a browser; the command must be built.
pub fn test() -> Outcome {
    checked("the page is up to date", "page", check)?;
    chromium()?;
    node("tests of the page in a browser", "--test --test-concurrency=1")
        .argument(viewer().join("test/page.test.mjs"))
        .argument(viewer().join("test/drawing.test.mjs"))
        .argument(viewer().join("test/studies.test.mjs"))
        .argument(viewer().join("test/safety.test.mjs"))
        .argument(viewer().join("test/pictures.test.mjs"))
        .argument(viewer().join("test/live.test.mjs"))
        .variable("FLEXURA", program().display().to_string())
        .run()?;
    checked("pictures of the page are up to date", "pictures", check_pictures)
}

/// Pictures of the page for the README, and the gallery: every example with its picture. The command must be built.
pub fn pictures() -> Outcome {
    let gallery = photograph("")?;
    write(&gallery_page(), &gallery)
}

/// The pictures must be those that would be made, but for how letters and edges are drawn.
fn check_pictures() -> Outcome {
    if photograph("--check")? == read(&gallery_page())? {
        return Ok(());
    }
    Err("docs/gallery.md is out of date; mend it with\n\n    cargo xtask pictures\n".to_owned())
}

fn gallery_page() -> PathBuf {
    root().join("docs/gallery.md")
}

/// Photographs everything that there is a picture of; the text of the gallery.
fn photograph(flags: &str) -> Result<String, String> {
    prepare()?;
    chromium()?;
    let images = root().join("docs/images");
    let mut jobs = Vec::new();
    for (name, part, words) in SHOWN {
        let page = page_of(name, words)?;
        jobs.push((page, images.join(format!("{name}.webp")), (*part).to_owned()));
    }
    let mut gallery = String::from(HEAD);
    for model in models()? {
        let (name, text) = (stem(&model), read(&model)?);
        let page = page_of(&name, &[study(&text), &model.display().to_string()])?;
        jobs.push((page, images.join(format!("gallery/{name}.webp")), "gallery".to_owned()));
        gallery += &format!(
            "## {}\n\n![{name}](images/gallery/{name}.webp)\n\n`flexura {} {name}.toml`\n\n",
            headline(&text, &name),
            study(&text)
        );
    }
    let list = target().join("pictures/jobs.txt");
    let lines = jobs
        .iter()
        .map(|(page, picture, part)| format!("{}\t{}\t{part}\n", page.display(), picture.display()));
    write(&list, &lines.collect::<String>())?;
    let mut step =
        node("pictures of the page", "").argument(viewer().join("test/photograph.mjs")).argument(&list);
    for flag in flags.split_whitespace() {
        step = step.argument(flag);
    }
    step.run()?;
    Ok(format!("{}\n", gallery.trim_end()))
}

const HEAD: &str = "# Gallery\n\nEvery example that `flexura examples` lists, as the page of its result shows it (`--report FILE`): beams coloured by their \
                    stress where they have one.\nThese pictures are made by `cargo xtask pictures`. Six of the examples can be moved and solved again in [one page](live.html), made by `cargo xtask live`.\n\n";

/// A model with studies whose states a page can show shows the first of them.
fn study(text: &str) -> &'static str {
    let kinds = ["solve", "trace", "buckle", "modes", "optimise", "inverse_dynamics"]
        .map(|word| format!("kind = \"{word}\""));
    let shows = |study: &str| {
        let has = |line: &str| study.lines().any(|own| own.starts_with(line));
        // Frequencies along a path are a picture of their own.
        kinds.iter().any(|kind| has(kind)) && !(has("kind = \"modes\"") && has("parameter ="))
    };
    if text.split("\n[").any(shows) { "run" } else { "solve" }
}

/// The first line of a model file says what it is.
fn headline<'t>(text: &'t str, name: &'t str) -> &'t str {
    let first = text.lines().next().unwrap_or_default().trim_start_matches('#').trim();
    if first.is_empty() { name } else { first }
}

fn models() -> Result<Vec<PathBuf>, String> {
    let all = entries(&root().join("models"))?;
    Ok(all.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect())
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The page of a study; where it does not converge, of what there is.
fn page_of(name: &str, words: &[&str]) -> Result<PathBuf, String> {
    let page = target().join("pictures").join(format!("{name}.html"));
    write(&page, "")?;
    let mut command = Command::new(program());
    command.args(words).arg("--quiet").arg("--report").arg(&page).current_dir(root());
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    let is_there = std::fs::metadata(&page).is_ok_and(|data| data.len() > 0);
    if is_there { Ok(page) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

fn write(path: &Path, text: &str) -> Outcome {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

fn viewer() -> PathBuf {
    root().join("viewer")
}

fn program() -> PathBuf {
    target().join("debug").join(format!("flexura{}", std::env::consts::EXE_SUFFIX))
}

/// Is the machine's own Node new enough?
fn has_node() -> bool {
    let Ok(output) = Command::new("node").arg("--version").output() else { return false };
    let text = String::from_utf8_lossy(&output.stdout);
    let mut numbers = text.trim().trim_start_matches('v').split('.').map(|part| part.parse().unwrap_or(0));
    (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0)) >= NODE
}

/// npm in the page's folder; with a newer Node from its registry where the machine's own is too old.
fn npm<'a>(title: &'a str, words: &str) -> Step<'a> {
    let folder = viewer();
    let start = if has_node() { "npm --prefix" } else { "npx --yes --package node@22 -- npm --prefix" };
    let mut step = Step::new(title, start).argument(folder);
    for word in words.split_whitespace() {
        step = step.argument(word);
    }
    step
}

fn node<'a>(title: &'a str, words: &str) -> Step<'a> {
    let start = if has_node() { "node" } else { "npx --yes --package node@22 -- node" };
    Step::new(title, &format!("{start} {words}"))
}

/// The browser, where the tests look for it.
fn chromium() -> Outcome {
    let is_named = std::env::var_os("FLEXURA_CHROMIUM").is_some();
    if is_named || Path::new("/usr/bin/chromium").exists() {
        return Ok(());
    }
    // It brings no letters of its own.
    debian(&["chromium", "fonts-dejavu-core"])
}

/// Installs packages of Debian.
pub fn debian(packages: &[&str]) -> Outcome {
    let wanted = packages.join(" ");
    if !exists("apt-get --version") {
        return Err(format!("install {wanted}: the tests need them"));
    }
    let root = if exists("sudo --version") { "sudo " } else { "" };
    Step::new("package lists", &format!("{root}apt-get update -qq")).run()?;
    let install = format!("{root}apt-get install -y -qq --no-install-recommends {wanted}");
    Step::new("packages", &install).variable("DEBIAN_FRONTEND", "noninteractive").run()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_told_by_its_first_line() {
        let text = "# Column on a foundation\n#\n# More.\n\nformat = 1\n[study.path]\nkind = \"trace\"\n";
        assert_eq!((headline(text, "column"), study(text)), ("Column on a foundation", "run"));
        let fit = "format = 1\n[study.bone]\nkind = \"fit\"\n";
        assert_eq!(study(fit), "solve");
        assert_eq!((headline("format = 1\n", "plain"), study("format = 1\n")), ("format = 1", "solve"));
        assert_eq!(headline("\n", "plain"), "plain");
    }
}
