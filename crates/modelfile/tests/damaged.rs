//! Bundled models with damage: every file is read or refused, without a panic, in bounded time, and with a place in every
//! message. The damage is drawn from a seed, so that a failure can be repeated.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::{Document, Report};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Damaged files of each bundled model.
const OF_EACH: u64 = 60;
/// Reading one takes milliseconds; this is for a machine with much else to do.
const LONGEST: Duration = Duration::from_secs(10);

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    fn of<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }
}

const VALUES: &[&str] = &[
    "1e308",
    "-1e308",
    "1e999",
    "99999999999999999999999999999999999999999999",
    "-0",
    "0",
    "nan",
    "-inf",
    "inf",
    "1e-320",
    "true",
    "[]",
    "{}",
    "[[[[]]]]",
    "1979-05-27",
    "\"\"",
    "\" \"",
    "\"1e308 km*1e308\"",
    "\"1/0\"",
    "\"0/0 N\"",
    "\"((((\"",
    "\"a\"",
    "\"1 N^1e9\"",
    "\"s\"",
    "\"t\"",
    "\"q\"",
    "\"-1 mm\"",
    "\"1e300 m\"",
    "\"10^400\"",
    "\"max(\"",
    "\"ground\"",
    "\"\\u001b[31m\"",
    "\"{i}\"",
    "\"../../../../etc/passwd\"",
    "[1, 2]",
    "[1, 2, 3, 4, 5, 6, 7]",
    "{ repeat = 1e9 }",
    "{ body = \"ground\" }",
    "'''\n'''",
];
const LETTERS: &[&str] = &[
    "\0",
    "\u{1b}",
    "\u{7f}",
    "\u{85}",
    "\u{202e}",
    "\u{feff}",
    "\u{ffff}",
    "\r",
    "\t",
    "\"",
    "'",
    "\\",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    ".",
    "#",
    "é",
    "²",
    "\u{10ffff}",
    "-",
    "9",
    "e",
];

fn models() -> Vec<(String, String)> {
    let folder: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut models: Vec<(String, String)> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    models.sort();
    assert!(models.len() >= 60, "only {} models", models.len());
    models
}

/// One blow to the text, at a place drawn at random.
fn damage(text: &str, random: &mut Random) -> String {
    if text.trim().is_empty() {
        return text.to_owned();
    }
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let (here, there) = (random.below(lines.len()), random.below(lines.len()));
    let mut characters: Vec<char> = text.chars().collect();
    let place = random.below(characters.len());
    match random.below(12) {
        0 => drop(lines.remove(here)),
        1 => lines.insert(there, lines[here].clone()),
        2 => lines.swap(here, there),
        3 => {
            // A table moved to another place, or its header lost.
            let headers: Vec<usize> = (0..lines.len()).filter(|i| lines[*i].starts_with('[')).collect();
            if !headers.is_empty() {
                let header = headers[random.below(headers.len())];
                let line = lines.remove(header);
                lines.insert(there.min(lines.len()), line);
            }
        }
        4 | 5 => {
            if let Some((key, _)) = lines[here].split_once('=') {
                lines[here] = format!("{key}= {}", random.of(VALUES));
            }
        }
        6 => {
            // A number within a line becomes another one.
            let number = |c: char| c.is_ascii_digit();
            if let Some(start) = lines[here].find(number) {
                let length = lines[here][start..].find(|c| !number(c)).unwrap_or(lines[here].len() - start);
                let other = random.of(&["1e300", "0", "-1", "1e-300", "99999999999", "nan", "1,5", ""]);
                lines[here].replace_range(start..start + length, other);
            }
        }
        7 => {
            // A name within a line becomes another line's.
            let word = |line: &str| {
                line.split(|c: char| !c.is_alphanumeric()).map(str::to_owned).max_by_key(String::len)
            };
            if let (Some(a), Some(b)) = (word(&lines[here]), word(&lines[there]))
                && !a.is_empty()
            {
                lines[here] = lines[here].replace(&a, &b);
            }
        }
        8 => lines.truncate(here),
        9 => {
            characters.remove(place);
            return characters.into_iter().collect();
        }
        10 => {
            let other = random.below(characters.len());
            characters.swap(place, other);
            return characters.into_iter().collect();
        }
        _ => {
            characters.splice(place..place, random.of(LETTERS).chars());
            return characters.into_iter().collect();
        }
    }
    lines.join("\n")
}

fn look_at(report: &Report, text: &str, what: &str) {
    assert!(!report.problems().is_empty(), "{what}");
    for problem in report.problems() {
        assert!(!problem.message.trim().is_empty() && !problem.message.contains("``"), "{what}: {problem:?}");
        let is_of_file = problem.message == "the file is empty";
        assert!(is_of_file || problem.line > 0, "{what}: no place: {problem:?}");
        // What is told of an included file lies in that.
        let is_of_part = problem.file.contains("/parts/");
        assert!(is_of_part || text.get(problem.span.clone()).is_some(), "{what}: {problem:?}");
    }
    assert!(report.render(true).len() < 200_000, "{what}");
}

#[test]
fn damaged_models_are_read_or_refused_with_a_place() {
    let (mut refused, mut read) = (0, 0);
    for (index, (name, text)) in models().iter().enumerate() {
        for number in 0..OF_EACH {
            let mut random = Random(index as u64 * 1000 + number);
            let mut damaged = text.clone();
            for _ in 0..1 + random.below(3) {
                damaged = damage(&damaged, &mut random);
            }
            let what = format!("{name}, damage {number}");
            let start = Instant::now();
            match Document::parse(&damaged, name) {
                Ok(document) => match document.model(&[]) {
                    Ok(model) => {
                        assert!(model.validate().is_empty(), "{what}");
                        for warning in document.warnings() {
                            assert!(!warning.message.is_empty() && warning.line > 0, "{what}: {warning:?}");
                        }
                        read += 1;
                    }
                    Err(report) => {
                        look_at(&report, &damaged, &what);
                        refused += 1;
                    }
                },
                Err(report) => {
                    look_at(&report, &damaged, &what);
                    refused += 1;
                }
            }
            assert!(start.elapsed() < LONGEST, "{what} takes {:?}", start.elapsed());
        }
    }
    // The damage is neither harmless nor always deadly.
    assert!(refused > 1000 && read > 500, "{refused} refused, {read} read");
}
