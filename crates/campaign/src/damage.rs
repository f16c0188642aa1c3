//! Damaged files: bytes and words of good ones changed.

use crate::random::Random;

/// What stands in for a number.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "-0.0",
    "1e300",
    "-1e300",
    "1e-300",
    "5e-324",
    "nan",
    "inf",
    "-inf",
    "99999999999999999999",
    "1_000_000",
    "0.1",
    "1e9",
    "1e-9",
    "2",
    "100",
    "true",
    "\"1 N\"",
    "\"3 deg\"",
    "\"1 m\"",
    "\"1e400\"",
    "\"factor\"",
    "\"s\"",
    "\"1/0\"",
    "\"sqrt(-1)\"",
    "[]",
    "[1]",
    "[0, 0, 0]",
    "{}",
    "\"\"",
    "\"-5 mm\"",
    "\"20 cm\"",
];
/// What is put anywhere.
const WORDS: &[&str] = &[
    "\"", "'", "[", "]", "{", "}", "=", ",", "\n", "#", ".", "\\", "\"\"\"", "\u{0}", "\u{202e}", "é", "1e",
    "e9", "-", "[[", "]]", "\r", "\t", "\u{feff}",
];

/// The file after one to three damages; it may no longer be UTF-8.
pub fn damaged(text: &str, random: &mut Random) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + random.below(3) {
        bytes = match random.below(10) {
            0 => flip(bytes, random),
            1 => cut(bytes, random),
            2 => insert(bytes, random),
            3..=5 => exchange_number(&bytes, random),
            6 => exchange_name(&bytes, random),
            _ => change_lines(&bytes, random),
        };
    }
    bytes
}

fn flip(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(bytes.len());
    let new = if random.chance(70) { 32 + random.below(95) as u8 } else { random.below(256) as u8 };
    if let Some(byte) = bytes.get_mut(at) {
        *byte = new;
    }
    bytes
}

fn cut(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let from = random.below(bytes.len());
    let to = if random.chance(10) { bytes.len() } else { (from + 1 + random.below(20)).min(bytes.len()) };
    bytes.drain(from..to);
    bytes
}

fn insert(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(bytes.len() + 1);
    let word = random.pick(WORDS);
    bytes.splice(at..at, word.bytes());
    bytes
}

/// Where words that `holds` says lie.
fn spans(bytes: &[u8], holds: impl Fn(&[u8]) -> bool) -> Vec<[usize; 2]> {
    let inside = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.' | b'-' | b'+');
    let mut found = Vec::new();
    let mut start = None;
    for (i, byte) in bytes.iter().chain(b" ").enumerate() {
        match (inside(*byte), start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                if holds(&bytes[from..i]) {
                    found.push([from, i]);
                }
                start = None;
            }
            _ => {}
        }
    }
    found
}

fn exchange_number(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let is_number = |word: &[u8]| std::str::from_utf8(word).is_ok_and(|word| word.parse::<f64>().is_ok());
    let numbers = spans(bytes, is_number);
    if numbers.is_empty() {
        return bytes.to_vec();
    }
    let [from, to] = numbers[random.below(numbers.len())];
    let mut new = bytes.to_vec();
    new.splice(from..to, random.pick(NUMBERS).bytes());
    new
}

/// One name or key in the place of another.
fn exchange_name(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let names = spans(bytes, |word| word[0].is_ascii_alphabetic());
    if names.is_empty() {
        return bytes.to_vec();
    }
    let [from, to] = names[random.below(names.len())];
    let [other, end] = names[random.below(names.len())];
    let mut new = bytes.to_vec();
    new.splice(from..to, bytes[other..end].iter().copied());
    new
}

/// A line left out, doubled, or in another place.
fn change_lines(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
    let (a, b) = (random.below(lines.len()), random.below(lines.len()));
    match random.below(3) {
        0 => {
            lines.remove(a);
        }
        1 => lines.insert(b, lines[a]),
        _ => lines.swap(a, b),
    }
    lines.join(&b'\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damages_are_the_same_for_the_same_seed_and_change_something() {
        let text = "format = 1\nname = \"a\"\n[beam.b]\nlength = \"20 mm\"\n";
        let mut changed = 0;
        for seed in 0..200 {
            let once = damaged(text, &mut Random::new(seed));
            assert_eq!(once, damaged(text, &mut Random::new(seed)));
            changed += usize::from(once != text.as_bytes());
        }
        assert!(changed > 150, "{changed}");
        // Even of nothing.
        for seed in 0..50 {
            damaged("", &mut Random::new(seed));
        }
    }
}
