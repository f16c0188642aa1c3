//! Files that are made, not written: reference pages, the schema, pictures, and what commands answer in our pages.
//!
//! A page shows a command's answer as
//!
//! ````text
//! <!-- run: flexura solve models/elastica.toml -->
//! ```text
//! ...
//! ```
//! ````
//!
//! and everything between the fences is replaced by what the command writes to standard output and standard error.
//! A fence below `<!-- file: wire.toml -->` is a file that the commands of the page find; so are the models.
//! Pictures are written but not compared: their last digits differ from one kind of processor to the next.

use crate::step::{Outcome, Step, files, read, root, target};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Pictures: name, which of the files that are written it is, and the arguments of the command that draws it.
const PICTURES: &[(&str, &str, &[&str])] = &[
    ("bone_fit", "fit.svg", &["fit", "models/bone_bending.toml"]),
    ("compression_spring", "shape.svg", &["solve", "models/compression_spring.toml", "--set", "push=5 N"]),
    ("compression_spring_path", "bow/diagram.svg", &["run", "models/compression_spring.toml", "bow"]),
    ("ellipse_on_circle", "roll/shapes.svg", &["run", "models/ellipse_on_circle.toml", "roll"]),
    ("explicit_recipe", "compare/diagram.svg", &["run", "models/explicit_recipe.toml", "compare"]),
    ("four_bar", "shape.svg", &["solve", "models/four_bar.toml"]),
    ("half_ring", "shape.svg", &["solve", "models/half_ring.toml", "--set", "theta=60 deg"]),
    ("knee_leg", "flexion/motion.svg", &["run", "models/knee_leg.toml", "flexion"]),
    ("lee_frame", "path/diagram.svg", &["run", "models/lee_frame.toml", "path"]),
    ("lee_frame_shapes", "path/shapes.svg", &["run", "models/lee_frame.toml", "path"]),
    ("node_camera", "shape.svg", &["solve", "models/node_camera.toml"]),
    ("node_corner", "over/shapes.svg", &["run", "models/node_corner.toml", "over", "--set", "fall=0"]),
    ("node_narrow_corner", "over/shapes.svg", &["run", "models/node_narrow_corner.toml", "over"]),
    ("strip_on_slope", "fold/diagram.svg", &["run", "models/strip_on_slope.toml", "fold"]),
];

/// The commands that the reference page of the command line describes.
const VERBS: &[&str] = &[
    "",
    "solve",
    "trace",
    "buckle",
    "fit",
    "formula",
    "optimise",
    "modes",
    "run",
    "sweep",
    "check",
    "examples",
    "verify",
    "view",
    "schema",
    "completions",
];

/// A file and what it should hold.
type Page = (PathBuf, String);

/// Rewrites everything.
pub fn write() -> Outcome {
    build()?;
    let put = |path: &Path, text: &str| -> Outcome {
        println!("    {}", path.strip_prefix(root()).unwrap_or(path).display());
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    println!("\n==> generated files");
    for (path, text) in pages()? {
        if std::fs::read_to_string(&path).ok().as_deref() != Some(&text) {
            put(&path, &text)?;
        }
    }
    for (name, file, arguments) in PICTURES {
        let folder = target().join("pictures").join(name);
        let mut command = flexura();
        command.args(*arguments).arg("--quiet").arg("-o").arg(&folder);
        answer(command)?;
        put(&root().join(format!("docs/images/{name}.svg")), &read(&folder.join(file))?)?;
    }
    Ok(())
}

/// Compares what is there with what would be written.
pub fn check() -> Outcome {
    let mut stale = Vec::new();
    for (path, wanted) in pages()? {
        let present = std::fs::read_to_string(&path).unwrap_or_default();
        let (a, b) = (comparable(&present), comparable(&wanted));
        if a != b {
            let name = path.strip_prefix(root()).unwrap_or(&path).display().to_string();
            let at = a.iter().zip(&b).position(|(a, b)| a != b).unwrap_or(a.len().min(b.len()));
            let line = |lines: &[&str]| lines.get(at).copied().unwrap_or("(end of file)").to_owned();
            stale.push(format!("{name}\n  holds   {}\n  but is  {}", line(&a), line(&b)));
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    Err(format!("out of date:\n{}\nmend it with `cargo xtask generate`", stale.join("\n")))
}

/// Lines that must agree. Counts of work and residuals hang on the last bit of a processor's arithmetic, and so may the
/// number of a path's points and where the points of a critical curve lie.
fn comparable(text: &str) -> Vec<&str> {
    let mut in_points = false;
    let agrees = |line: &&str| {
        if line.is_empty() || line.starts_with("```") {
            in_points = false;
        }
        let is_count = line.contains("Newton steps")
            || line.contains(" degrees of freedom, ")
            || in_points && !line.contains("stalled");
        in_points |= line.starts_with("branches  from") || line.starts_with("critical ");
        !is_count
    };
    text.lines().filter(agrees).collect()
}

/// Builds what the pages are made with, with the settings of the tests.
pub fn build() -> Outcome {
    Step::new("the command", "cargo build --quiet --profile test --workspace --exclude xtask --bins").run()
}

fn pages() -> Result<Vec<Page>, String> {
    let reference = root().join("docs/reference");
    let model_file = Step::new(
        "model_file.md",
        "cargo run --quiet --profile test --package xtask --example model_reference",
    );
    let mut schema = flexura();
    schema.arg("schema");
    let mut pages = vec![
        (reference.join("model_file.md"), model_file.output()?),
        (reference.join("schema.json"), answer(schema)?),
        (reference.join("command.md"), command_page()?),
    ];
    let mut written = files(&root().join("docs"), &["md"])?;
    written.push(root().join("README.md"));
    for path in written {
        let text = read(&path)?;
        if text.contains(RUN) {
            let stem = path.file_stem().unwrap_or_default();
            let filled = filled(&text, &target().join("pages").join(stem));
            let filled = filled.map_err(|why| format!("{}: {why}", path.display()))?;
            pages.push((path, filled));
        }
    }
    Ok(pages)
}

fn flexura() -> Command {
    let program = target().join("debug").join(format!("flexura{}", std::env::consts::EXE_SUFFIX));
    let mut command = Command::new(program);
    command.current_dir(root()).env("NO_COLOR", "1");
    command
}

/// What a command says, its results first and its remarks after them; the exit code does not matter.
fn answer(mut command: Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    let both = [output.stdout, output.stderr].concat();
    String::from_utf8(both).map_err(|error| format!("{command:?}: {error}"))
}

fn command_page() -> Result<String, String> {
    let mut page = String::from("# The command\n\nWhat `flexura --help` and the help of each verb say.\n");
    for verb in VERBS {
        let mut command = flexura();
        if !verb.is_empty() {
            command.arg(verb);
        }
        command.arg("--help");
        let title = format!("flexura {verb}");
        page.push_str(&format!("\n## `{}`\n\n```text\n{}\n```\n", title.trim(), tidied(&answer(command)?)));
    }
    Ok(page)
}

fn tidied(text: &str) -> String {
    text.trim_end().lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
}

const RUN: &str = "<!-- run: flexura ";
const FILE: &str = "<!-- file: ";
const CLOSE: &str = " -->";

/// A page with the answers of its commands filled in. They run in `folder`.
fn filled(page: &str, folder: &Path) -> Result<String, String> {
    copy_models(&folder.join("models")).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut out = String::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        out.push_str(line);
        out.push('\n');
        let named = |opening: &str| line.strip_prefix(opening).and_then(|rest| rest.strip_suffix(CLOSE));
        let (file, arguments) = (named(FILE), named(RUN));
        if file.is_none() && arguments.is_none() {
            continue;
        }
        let fence = lines.next().filter(|fence| fence.starts_with("```"));
        let fence = fence.ok_or_else(|| format!("no fence follows `{line}`"))?;
        let mut inside = String::new();
        loop {
            match lines.next() {
                Some("```") => break,
                Some(line) => inside.push_str(&format!("{line}\n")),
                None => return Err(format!("the fence after `{line}` does not end")),
            }
        }
        if let Some(name) = file {
            std::fs::write(folder.join(name), &inside).map_err(|error| format!("{name}: {error}"))?;
        }
        if let Some(arguments) = arguments {
            let mut command = flexura();
            command.args(words(arguments)).current_dir(folder);
            inside = tidied(&answer(command)?) + "\n";
        }
        out.push_str(&format!("{fence}\n{inside}```\n"));
    }
    Ok(out)
}

fn copy_models(to: &Path) -> std::io::Result<()> {
    for folder in ["", "parts", "wrong", "wrong/parts"] {
        std::fs::create_dir_all(to.join(folder))?;
        for entry in std::fs::read_dir(root().join("models").join(folder))? {
            let entry = entry?;
            if entry.path().is_file() {
                std::fs::copy(entry.path(), to.join(folder).join(entry.file_name()))?;
            }
        }
    }
    Ok(())
}

/// Splits at spaces, but not inside double quotes.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().into_iter().for_each(|word| word.push(c)),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_hold_words_together() {
        assert_eq!(words("solve a.toml --set push=\"5 N\""), ["solve", "a.toml", "--set", "push=5 N"]);
    }

    #[test]
    fn numbers_of_points_and_steps_are_not_compared() {
        let page = |points: u32, end: &str| {
            format!(
                "lee: converged\n  1 branch, {points} points, {points} Newton steps\n\nspecial points  load\n  fold  1\n\n\
                 branches  from  points  last end\n  1  rest  {points}  {end}\n\n\
                 critical push by weight: fold\nweight  push\n  {points}  1\n```\ntext\n"
            )
        };
        let (a, b) = (page(40, "3, end of the range"), page(41, "3, end of the range"));
        assert_eq!(comparable(&a), comparable(&b));
        assert!(comparable(&a).contains(&"  fold  1") && comparable(&a).last() == Some(&"text"));
        assert_ne!(comparable(&a), comparable(&page(40, "2, stalled")));
    }

    #[test]
    fn a_page_without_commands_stays() {
        let folder = target().join("pages/test");
        let page = "# A\n\n```text\nb\n```\n<!-- file: a.toml -->\n```toml\nformat = 1\n```\n";
        assert_eq!(filled(page, &folder), Ok(page.to_owned()));
        assert_eq!(read(&folder.join("a.toml")), Ok("format = 1\n".to_owned()));
        assert!(filled("<!-- run: flexura schema -->\ntext\n", &folder).is_err());
        assert!(filled("<!-- run: flexura schema -->\n```\ntext\n", &folder).is_err());
    }
}
