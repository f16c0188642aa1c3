//! What is wrong with a text that is no TOML, in the words of who writes a mechanism.

use crate::report::{Problem, Source};
use flexura_expression::{respelled, unit};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

/// Most mistakes that are told.
const MOST: usize = 10;

/// A problem for each of the parser's errors, but for those that follow from another one.
pub(crate) fn problems(source: &Arc<Source>, errors: &[(Range<usize>, &str)]) -> Vec<Problem> {
    let text = source.text.as_str();
    let mut told: BTreeSet<usize> = BTreeSet::new();
    let mut list = Vec::new();
    for (span, message) in errors {
        if list.len() == MOST {
            break;
        }
        let line = line_of(text, span.start);
        let problem = if message.starts_with("duplicate key") {
            let Some(problem) = duplicate(source, span, &mut told) else { continue };
            problem
        } else {
            // One mistake makes the parser stumble several times within its line.
            if !told.insert(line.start) {
                continue;
            }
            let problem = match unquoted(text, &line, span) {
                Some((span, message, hint)) => Problem::at(source, span, "", message).hint(hint),
                None => Problem::at(source, span.clone(), "", format!("this is no valid TOML: {message}")),
            };
            match hint(text, &line, span, message) {
                Some(hint) if problem.hint.is_none() => problem.hint(hint),
                _ => problem,
            }
        };
        list.push(problem);
    }
    list
}

fn line_of(text: &str, at: usize) -> Range<usize> {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let start = text[..at].rfind('\n').map_or(0, |i| i + 1);
    let end = text[at..].find('\n').map_or(text.len(), |i| at + i);
    start..end
}

/// The name in a header such as `[beam.link]`, without blanks and quotes.
fn header(line: &str) -> Option<String> {
    let inner = line.trim_start().strip_prefix('[')?;
    let inner = inner.split(']').next()?.trim_start_matches('[');
    Some(inner.chars().filter(|c| !c.is_whitespace() && *c != '"' && *c != '\'').collect())
}

/// The key in front of an equals sign, without blanks and quotes.
fn key(line: &str) -> Option<String> {
    let (key, _) = line.split_once('=')?;
    let key = key.trim();
    let plain = key.chars().all(|c| c.is_alphanumeric() || "_-.\"'{} ".contains(c));
    (plain && !key.is_empty()).then(|| key.replace(['"', '\'', ' '], ""))
}

/// A name that stands twice, with the line where it stands first. None: it follows from a table that was told.
fn duplicate(source: &Arc<Source>, span: &Range<usize>, told: &mut BTreeSet<usize>) -> Option<Problem> {
    let text = source.text.as_str();
    let line = line_of(text, span.start);
    let own = &text[line.clone()];
    let lines = || text[..line.start].lines().enumerate();
    if let Some(name) = header(own) {
        told.insert(line.start);
        let first = lines().find(|(_, earlier)| header(earlier).as_deref() == Some(name.as_str()));
        let message = format!("the table `[{name}]` is given twice");
        let problem = Problem::at(source, span.clone(), "", message);
        return Some(match first {
            Some((number, _)) => problem.hint(format!(
                "it stands first in line {}; take another name, or put all of it there",
                number + 1
            )),
            None => problem.hint("it stands before as a key of another table; take another name"),
        });
    }
    // The table that the line belongs to.
    let mut offset = 0;
    let mut table: Option<(usize, String)> = None;
    for earlier in text[..line.start].split_inclusive('\n') {
        if let Some(name) = header(earlier) {
            table = Some((offset, name));
        }
        offset += earlier.len();
    }
    if table.as_ref().is_some_and(|(start, _)| told.contains(start)) {
        return None;
    }
    let name = text.get(span.clone()).unwrap_or_default().trim_matches(['"', '\'']);
    let mut current: Option<String> = None;
    let mut first = None;
    for (number, earlier) in lines() {
        if let Some(name) = header(earlier) {
            current = Some(name);
        } else if current.as_ref() == table.as_ref().map(|(_, name)| name)
            && key(earlier).is_some_and(|key| key == name || key.starts_with(&format!("{name}.")))
        {
            first = Some(number + 1);
            break;
        }
    }
    let problem = Problem::at(source, span.clone(), "", format!("the key `{name}` is given twice"));
    Some(match first {
        Some(number) => problem.hint(format!("it stands first in line {number}; remove one of the two")),
        None => problem.hint("remove one of the two"),
    })
}

/// A value at `span` that misses its quotes or bears a comma for its point: where, what and what to write.
fn unquoted(text: &str, line: &Range<usize>, span: &Range<usize>) -> Option<(Range<usize>, String, String)> {
    let piece = piece(text, line, span.start)?;
    let value = &text[piece.clone()];
    if value.starts_with(['"', '\'']) {
        return None;
    }
    let name = text[line.start..piece.start].trim_end().strip_suffix('=').map(str::trim_end);
    let name = name.map(|front| front.rsplit(['{', ',', ' ']).next().unwrap_or(front));
    let written = |value: &str| match name {
        Some(name) if !name.is_empty() => format!("write `{name} = {value}`"),
        _ => format!("write `{value}`"),
    };
    if value.starts_with(['“', '”', '„', '‘', '’', '«', '`', '´']) {
        let bare: String = value.chars().filter(|c| !"“”„‘’«»`´".contains(*c)).collect();
        let message = "quotes are straight in TOML".to_string();
        return Some((piece, message, written(&format!("\"{bare}\""))));
    }
    let comma = text[piece.end..line.end].strip_prefix(',').filter(|_| is_digits(value));
    if let (Some(rest), true) = (comma, name.is_some()) {
        let end = rest.find(['#', ',', '}']).unwrap_or(rest.len());
        let part = rest[..end].trim_end();
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        if digits > 0 && !part[..digits].is_empty() {
            let number = format!("{value}.{part}");
            let quoted = if digits < part.len() { format!("\"{number}\"") } else { number };
            let place = piece.start..piece.end + 1 + part.len();
            return Some((place, "a number has a point, not a comma".to_string(), written(&quoted)));
        }
    }
    match value.to_lowercase().as_str() {
        "" => None,
        flag @ ("true" | "false" | "yes" | "no" | "on" | "off") => {
            let flag = matches!(flag, "true" | "yes" | "on");
            Some((piece, format!("`{value}` is no value in TOML"), written(&flag.to_string())))
        }
        _ if value.parse::<f64>().is_ok() => None,
        _ if value.len() <= 200 && !value.contains(['"', '\\']) => {
            let what = if begins_with_number(value) { "a number with a unit" } else { "a text" };
            Some((piece, format!("{what} needs quotes"), written(&format!("\"{value}\""))))
        }
        _ => None,
    }
}

/// The value around a place in a line: between an equals sign, bracket or comma, and the next of these or a comment.
fn piece(text: &str, line: &Range<usize>, at: usize) -> Option<Range<usize>> {
    let at = at.clamp(line.start, line.end);
    let mut start = None;
    let mut quote = None;
    for (i, c) in text[line.clone()].char_indices() {
        let i = line.start + i;
        match (quote, c) {
            (Some(open), c) if open == c => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '#') if i <= at => return None,
            (None, '=' | '[' | ',' | '{') if i < at || start.is_none() => start = Some(i + 1),
            (None, ',' | ']' | '}' | '#') if i >= at && start.is_some() => {
                return Some(trimmed(text, start?..i));
            }
            _ => {}
        }
    }
    Some(trimmed(text, start?..line.end))
}

fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let piece = &text[range.clone()];
    let start = range.start + piece.len() - piece.trim_start().len();
    start..start + piece.trim().len()
}

fn is_digits(text: &str) -> bool {
    let digits = text.trim_start_matches(['-', '+']);
    !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit())
}

/// Does it begin with a number, behind which a unit may stand?
fn begins_with_number(text: &str) -> bool {
    let rest = text.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.eE".contains(c)).trim_start();
    let word = rest.split(|c: char| !(c.is_alphanumeric() || c == '°' || c == '%')).next().unwrap_or("");
    rest.len() < text.len() && (unit(word).is_some() || respelled(word).is_some())
}

/// What else to write, by the parser's message.
fn hint(text: &str, line: &Range<usize>, span: &Range<usize>, message: &str) -> Option<String> {
    let own = text[line.clone()].trim();
    if own.ends_with('=') {
        return Some("there is no value behind the equals sign".to_string());
    }
    if message.starts_with("invalid basic string") || message.starts_with("invalid literal string") {
        let after = text.get(span.start..line.end).unwrap_or_default();
        return (after.trim().is_empty())
            .then(|| "the quote that opens here is not closed in this line".to_string());
    }
    if message.starts_with("key with no value") {
        return Some(match own.split_once(':') {
            Some((name, value)) if !name.contains(' ') => {
                format!("write `{name} = {}`: TOML has an equals sign", value.trim())
            }
            _ => {
                "a line is `key = value`, a header such as `[beam.link]`, or a comment behind `#`".to_string()
            }
        });
    }
    if own.starts_with("//") || own.starts_with('%') || own.starts_with(';') {
        return Some("a comment begins with `#`".to_string());
    }
    None
}
