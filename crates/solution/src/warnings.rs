//! Warnings that differ in nothing but the part that they name.

/// So many warnings that differ in their numbers too are told together.
const MANY: usize = 4;

/// Of warnings that say the same of several parts the first stays, with the count of the others behind it; so do those
/// that differ in their numbers, if they are many.
pub fn summed_up(warnings: Vec<String>) -> Vec<String> {
    if warnings.len() < 2 {
        return warnings;
    }
    let counted = gather(warnings.into_iter().map(|text| (text, 1)).collect(), false, 2);
    gather(counted, true, MANY)
        .into_iter()
        .map(|(text, count)| match count {
            1 => text,
            2 => format!("{text} (and so of 1 more)"),
            _ => format!("{text} (and so of {} more)", count - 1),
        })
        .collect()
}

/// Puts the texts of one pattern together, where there are `least` of them; each with how many it stands for.
fn gather(warnings: Vec<(String, usize)>, without_numbers: bool, least: usize) -> Vec<(String, usize)> {
    let patterns: Vec<String> = warnings.iter().map(|(text, _)| pattern(text, without_numbers)).collect();
    let mut totals: std::collections::BTreeMap<&str, usize> = std::collections::BTreeMap::new();
    for (pattern, (_, count)) in patterns.iter().zip(&warnings) {
        *totals.entry(pattern).or_insert(0) += count;
    }
    let mut kept = Vec::new();
    let mut told: std::collections::BTreeSet<&str> = std::collections::BTreeSet::new();
    for (pattern, (text, count)) in patterns.iter().zip(warnings) {
        let total = totals.get(pattern.as_str()).copied().unwrap_or(count);
        if total < least || total == count {
            kept.push((text, count));
        } else if told.insert(pattern) {
            kept.push((text, total));
        }
    }
    kept
}

/// The text with `#` for every name behind `beam.`, `joint.` and the like, and perhaps for every number.
fn pattern(text: &str, without_numbers: bool) -> String {
    const KINDS: [&str; 9] =
        ["beam.", "body.", "joint.", "section.", "spring.", "cable.", "mass.", "load.", "coupling."];
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let mut pattern = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let kind = KINDS.iter().find(|kind| rest.starts_with(**kind));
        if let Some(kind) = kind.filter(|_| !pattern.ends_with(is_name)) {
            pattern.push_str(kind);
            pattern.push('#');
            rest = rest[kind.len()..].trim_start_matches(is_name);
        } else if without_numbers && first.is_ascii_digit() && !pattern.ends_with(is_name) {
            pattern.push('#');
            rest = rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || "+-.".contains(c));
        } else {
            pattern.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    pattern
}

#[cfg(test)]
mod tests {
    use super::summed_up;

    fn of(warnings: &[&str]) -> Vec<String> {
        summed_up(warnings.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn what_is_said_of_several_parts_is_said_once() {
        let strip = |section: &str, beam: &str| {
            format!("section.{section}: the strip of beam.{beam} is 16 times wide")
        };
        let four: Vec<String> = ["ll", "lr", "rl", "rr"].map(|beam| strip("leaf", beam)).into();
        assert_eq!(summed_up(four), [strip("leaf", "ll") + " (and so of 3 more)"]);
        assert_eq!(
            of(&["joint.a: x", "joint.a: y", "joint.b: x"]),
            ["joint.a: x (and so of 1 more)", "joint.a: y"]
        );
    }

    #[test]
    fn numbers_that_differ_are_told_while_they_are_few() {
        let few = ["beam.a: 1.5 mm apart", "beam.b: 2.5 mm apart", "beam.c: 3 mm apart"];
        assert_eq!(of(&few), few);
        let many =
            ["beam.a: 1.5 mm apart", "beam.b: 2.5 mm apart", "beam.c: 3 mm apart", "beam.d: 3 mm apart"];
        assert_eq!(of(&many), ["beam.a: 1.5 mm apart (and so of 3 more)"]);
        assert_eq!(of(&["2 of 3 are loose", "one"]), ["2 of 3 are loose", "one"]);
    }
}
