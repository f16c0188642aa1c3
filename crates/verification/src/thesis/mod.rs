//! `docs/thesis.md`: what the thesis prints beside what is computed.
//!
//! The page is the text of `page.md` with every `{{name, digits}}` replaced by a number that is computed when the page is made: a
//! fact of [`facts`], or `case/quantity`, our value in a row of a verification case. `digits` is how many stand behind the point.

mod facts;
mod fitted;
mod laws;
mod node;
mod rolling;

use crate::{cases, outcomes};
use std::collections::BTreeMap;

const PAGE: &str = include_str!("page.md");
const OPEN: &str = "{{";
const CLOSE: &str = "}}";

/// Something that is computed for the page, with its name.
type Fact = (String, f64);

/// The page.
///
/// # Errors
/// Something named in it is not computed, or cannot be.
pub fn thesis() -> Result<String, String> {
    let mut numbers: BTreeMap<String, f64> = BTreeMap::new();
    for group in [facts::facts, fitted::facts, laws::facts, node::facts, rolling::facts] {
        numbers.extend(group()?);
    }
    let wanted: Vec<&str> =
        names(PAGE)?.into_iter().filter_map(|name| name.split_once('/')).map(|(case, _)| case).collect();
    let chosen: Vec<_> = cases().into_iter().filter(|case| wanted.contains(&case.id)).collect();
    for outcome in outcomes(&chosen, &|_| {}) {
        let id = outcome.case.id;
        for row in outcome.rows.map_err(|why| format!("{id}: {why}"))? {
            numbers.insert(format!("{id}/{}", row.quantity), row.ours);
        }
    }
    filled(PAGE, &numbers)
}

/// What the page names.
fn names(page: &str) -> Result<Vec<&str>, String> {
    let mut names = Vec::new();
    let mut rest = page;
    while let Some((_, behind)) = rest.split_once(OPEN) {
        let (inside, behind) = behind.split_once(CLOSE).ok_or("a brace is not closed")?;
        names.push(inside.rsplit_once(',').map_or(inside, |(name, _)| name));
        rest = behind;
    }
    Ok(names)
}

fn filled(page: &str, numbers: &BTreeMap<String, f64>) -> Result<String, String> {
    let mut text = String::with_capacity(page.len());
    let mut rest = page;
    while let Some((before, behind)) = rest.split_once(OPEN) {
        let (inside, behind) = behind.split_once(CLOSE).ok_or("a brace is not closed")?;
        let (name, digits) = inside.rsplit_once(',').ok_or_else(|| format!("`{inside}` has no digits"))?;
        let digits: usize = digits.trim().parse().map_err(|_| format!("`{inside}` has no digits"))?;
        let value = numbers.get(name).ok_or_else(|| format!("`{name}` is not computed"))?;
        if !value.is_finite() {
            return Err(format!("`{name}` is no number"));
        }
        text.push_str(before);
        // No minus in front of zeros.
        let shown = format!("{value:.digits$}");
        let is_zero = shown.chars().all(|c| "-0.".contains(c));
        text.push_str(if is_zero { shown.trim_start_matches('-') } else { &shown });
        rest = behind;
    }
    text.push_str(rest);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_shows_numbers_with_their_digits() {
        let numbers = BTreeMap::from([("a".to_string(), 1.23456), ("b/c, d".to_string(), -0.0001)]);
        assert_eq!(filled("x {{a,2}} y {{b/c, d,3}}.", &numbers), Ok("x 1.23 y 0.000.".to_string()));
        assert_eq!(names("x {{a,2}} y {{b/c, d,3}}."), Ok(vec!["a", "b/c, d"]));
        assert!(filled("{{e,1}}", &numbers).is_err());
    }

    /// What is written by hand to three places and more: as the thesis prints it, or given.
    const PRINTED: &[&str] = &[
        "0.0001", "0.00005", "0.0002", "0.0025", "0.0036", "0.0051", "0.0094", "0.0612", "0.0624", "0.0672",
        "0.0851", "0.0999", "0.011", "0.017", "0.025", "0.1069", "0.1309", "0.1543", "0.1559", "0.194",
        "0.1948", "0.2009", "0.2169", "0.866", "0.9762", "1.009", "1.1298", "1.1803", "2.7816", "4.626",
        "5.715", "9.4377", "10.757", "71.973", "0.001",
    ];

    #[test]
    fn numbers_of_ours_are_computed_when_the_page_is_made() {
        let mut text = String::new();
        let mut rest = PAGE;
        while let Some((before, behind)) = rest.split_once(OPEN) {
            text.push_str(before);
            rest = behind.split_once(CLOSE).unwrap().1;
        }
        text.push_str(rest);
        let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.');
        let long = |number: &&str| {
            number.split_once('.').is_some_and(|(_, places)| places.len() > 2 && !places.contains('.'))
        };
        let strangers: Vec<&str> = numbers
            .map(|number| number.trim_end_matches('.'))
            .filter(long)
            .filter(|number| !PRINTED.contains(number))
            .collect();
        assert_eq!(strangers, Vec::<&str>::new());
        for printed in PRINTED {
            assert!(text.contains(printed), "{printed} is not on the page any more");
        }
    }
}
