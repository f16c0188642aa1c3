//! Units as people write them elsewhere: `Nm`, `mm2`, `kg/m³`, `millimetres`.

use crate::{Dimension, unit};

/// Most units run together in one word.
const MOST_FACTORS: usize = 3;

/// Names of units, whose plurals end with s, and their symbols.
const WORDS: &[(&str, &str)] = &[
    ("metre", "m"),
    ("meter", "m"),
    ("gram", "g"),
    ("second", "s"),
    ("sec", "s"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("watt", "W"),
    ("hertz", "Hz"),
    ("kelvin", "K"),
    ("radian", "rad"),
    ("degree", "deg"),
    ("minute", "min"),
    ("hr", "hour"),
    ("inche", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("pound", "lb"),
    ("ounce", "oz"),
];

const PREFIXES: &[(&str, &str)] = &[
    ("giga", "G"),
    ("mega", "M"),
    ("kilo", "k"),
    ("deci", "d"),
    ("centi", "c"),
    ("milli", "m"),
    ("micro", "u"),
    ("nano", "n"),
    ("", ""),
];

/// How a word that is no unit here would be written, if it is one elsewhere: `N*m` for `Nm`, `mm^2` for `mm2`
/// or `mm²`, `mm` for `millimetres`.
pub fn respelled(word: &str) -> Option<String> {
    if word.is_empty() || word.len() > 24 || unit(word).is_some() {
        return None;
    }
    if let Some(symbol) = named(&word.to_lowercase()) {
        return Some(symbol);
    }
    let factors = factors(word, MOST_FACTORS)?;
    let is_force = |factor: &Factor<'_>| dimension(factor) == Some(Dimension::FORCE);
    let is_mass = |factor: &Factor<'_>| dimension(factor) == Some(Dimension::MASS);
    let sensible = match factors.as_slice() {
        [only] => only.power != 1,
        // `lbs` is a plural and `Ns` a product.
        [first, second] if second.symbol == "s" => is_force(first) && first.symbol.ends_with('N'),
        [first, second] if is_mass(first) => second.power != 1,
        [first, ..] => is_force(first),
        [] => false,
    };
    sensible.then(|| {
        let written = |factor: &Factor<'_>| match factor.power {
            1 => factor.symbol.to_string(),
            power => format!("{}^{power}", factor.symbol),
        };
        factors.iter().map(written).collect::<Vec<_>>().join("*")
    })
}

fn dimension(factor: &Factor<'_>) -> Option<Dimension> {
    unit(factor.symbol).map(|unit| unit.dimension)
}

fn named(word: &str) -> Option<String> {
    for word in [word, word.strip_suffix('s').unwrap_or(word)] {
        for (prefix, sign) in PREFIXES {
            let Some(rest) = word.strip_prefix(prefix) else { continue };
            let found = WORDS.iter().find(|(name, _)| *name == rest);
            if let Some(symbol) = found.map(|(_, symbol)| format!("{sign}{symbol}"))
                && unit(&symbol).is_some()
            {
                return Some(symbol);
            }
        }
    }
    None
}

struct Factor<'a> {
    symbol: &'a str,
    power: u32,
}

/// The word as units with exponents run together, the fewest there can be.
fn factors(word: &str, most: usize) -> Option<Vec<Factor<'_>>> {
    if word.is_empty() {
        return Some(Vec::new());
    }
    if most == 0 {
        return None;
    }
    let mut best: Option<Vec<Factor<'_>>> = None;
    for end in (1..=word.len()).rev().filter(|end| word.is_char_boundary(*end)) {
        let (symbol, rest) = word.split_at(end);
        if unit(symbol).is_none() {
            continue;
        }
        let digit = rest.chars().next().and_then(exponent);
        let skip = digit.and(rest.chars().next()).map_or(0, char::len_utf8);
        let Some(mut more) = factors(&rest[skip..], most - 1) else { continue };
        more.insert(0, Factor { symbol, power: digit.unwrap_or(1) });
        if best.as_ref().is_none_or(|best| more.len() < best.len()) {
            best = Some(more);
        }
    }
    best
}

/// The exponent that a digit behind a unit means, upright or raised.
fn exponent(digit: char) -> Option<u32> {
    match digit {
        '²' => Some(2),
        '³' => Some(3),
        '⁴' => Some(4),
        '2'..='9' => digit.to_digit(10),
        _ => None,
    }
}
