//! Units: names, prefixes, factors to SI.
//!
//! Factors are those of NIST Special Publication 811 (2008 edition), appendix B.8; the ones that are exact
//! by definition are written exactly.

use crate::Dimension;

/// A unit: its value in SI units and its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// One of it, in SI units.
    pub factor: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

/// A row of the table of units.
#[derive(Clone, Copy, Debug)]
pub struct UnitEntry {
    /// Its symbol as written behind a number.
    pub symbol: &'static str,
    /// The prefixes it takes.
    pub prefixes: &'static [(&'static str, f64)],
    /// One of it, in SI units.
    pub factor: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

type Prefixes = &'static [(&'static str, f64)];
const NONE: Prefixes = &[];
const LENGTHS: Prefixes = &[
    ("k", 1e3),
    ("d", 1e-1),
    ("c", 1e-2),
    ("m", 1e-3),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("n", 1e-9),
    ("p", 1e-12),
];
const SMALL: Prefixes = &[("m", 1e-3), ("u", 1e-6), ("µ", 1e-6), ("μ", 1e-6), ("n", 1e-9)];
const MASSES: Prefixes =
    &[("k", 1e3), ("M", 1e6), ("m", 1e-3), ("u", 1e-6), ("µ", 1e-6), ("μ", 1e-6), ("n", 1e-9)];
const FORCES: Prefixes = &[
    ("M", 1e6),
    ("k", 1e3),
    ("da", 1e1),
    ("c", 1e-2),
    ("m", 1e-3),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("n", 1e-9),
    ("p", 1e-12),
];
const PRESSURES: Prefixes = &[
    ("T", 1e12),
    ("G", 1e9),
    ("M", 1e6),
    ("k", 1e3),
    ("h", 1e2),
    ("m", 1e-3),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
];
// No giga: GJ is the torsional stiffness.
const ENERGIES: Prefixes =
    &[("M", 1e6), ("k", 1e3), ("m", 1e-3), ("u", 1e-6), ("µ", 1e-6), ("μ", 1e-6), ("n", 1e-9)];
const POWERS: Prefixes =
    &[("G", 1e9), ("M", 1e6), ("k", 1e3), ("m", 1e-3), ("u", 1e-6), ("µ", 1e-6), ("μ", 1e-6), ("n", 1e-9)];
const LARGE: Prefixes = &[("G", 1e9), ("M", 1e6), ("k", 1e3), ("m", 1e-3)];

const fn row(symbol: &'static str, prefixes: Prefixes, factor: f64, dimension: Dimension) -> UnitEntry {
    UnitEntry { symbol, prefixes, factor, dimension }
}

use std::f64::consts::PI;
type D = Dimension;
const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const GRAVITY: f64 = 9.806_65;
const POUND_FORCE: f64 = POUND * GRAVITY;

const UNITS: &[UnitEntry] = &[
    row("m", LENGTHS, 1.0, D::LENGTH),
    row("in", NONE, INCH, D::LENGTH),
    row("inch", NONE, INCH, D::LENGTH),
    row("ft", NONE, 12.0 * INCH, D::LENGTH),
    row("yd", NONE, 36.0 * INCH, D::LENGTH),
    row("mil", NONE, 1e-3 * INCH, D::LENGTH),
    row("thou", NONE, 1e-3 * INCH, D::LENGTH),
    row("micron", NONE, 1e-6, D::LENGTH),
    row("angstrom", NONE, 1e-10, D::LENGTH),
    row("g", MASSES, 1e-3, D::MASS),
    row("tonne", NONE, 1e3, D::MASS),
    row("lb", NONE, POUND, D::MASS),
    row("lbm", NONE, POUND, D::MASS),
    row("oz", NONE, POUND / 16.0, D::MASS),
    row("slug", NONE, POUND_FORCE / (12.0 * INCH), D::MASS),
    row("s", SMALL, 1.0, D::TIME),
    row("min", NONE, 60.0, D::TIME),
    row("hour", NONE, 3600.0, D::TIME),
    row("day", NONE, 86400.0, D::TIME),
    row("K", SMALL, 1.0, D::TEMPERATURE),
    row("N", FORCES, 1.0, D::FORCE),
    row("dyn", NONE, 1e-5, D::FORCE),
    row("kgf", NONE, GRAVITY, D::FORCE),
    row("gf", NONE, 1e-3 * GRAVITY, D::FORCE),
    row("lbf", NONE, POUND_FORCE, D::FORCE),
    row("ozf", NONE, POUND_FORCE / 16.0, D::FORCE),
    row("kip", NONE, 1e3 * POUND_FORCE, D::FORCE),
    row("Pa", PRESSURES, 1.0, D::PRESSURE),
    row("bar", SMALL, 1e5, D::PRESSURE),
    row("atm", NONE, 101_325.0, D::PRESSURE),
    row("psi", NONE, POUND_FORCE / (INCH * INCH), D::PRESSURE),
    row("ksi", NONE, 1e3 * POUND_FORCE / (INCH * INCH), D::PRESSURE),
    row("Msi", NONE, 1e6 * POUND_FORCE / (INCH * INCH), D::PRESSURE),
    row("J", ENERGIES, 1.0, D::MOMENT),
    row("erg", NONE, 1e-7, D::MOMENT),
    row("W", POWERS, 1.0, D::POWER),
    row("Hz", LARGE, 1.0, D::FREQUENCY),
    row("rpm", NONE, 2.0 * PI / 60.0, D::ANGULAR_VELOCITY),
    row("rad", SMALL, 1.0, D::ANGLE),
    row("deg", NONE, PI / 180.0, D::ANGLE),
    row("°", NONE, PI / 180.0, D::ANGLE),
    row("arcmin", NONE, PI / 10_800.0, D::ANGLE),
    row("arcsec", NONE, PI / 648_000.0, D::ANGLE),
    row("turn", NONE, 2.0 * PI, D::ANGLE),
    row("rev", NONE, 2.0 * PI, D::ANGLE),
    row("%", NONE, 1e-2, D::NUMBER),
];

/// All units, without their prefixed forms.
pub fn unit_table() -> &'static [UnitEntry] {
    UNITS
}

/// The unit of this symbol, prefixed or not.
pub fn unit(symbol: &str) -> Option<Unit> {
    for entry in UNITS {
        if entry.symbol == symbol {
            return Some(Unit { factor: entry.factor, dimension: entry.dimension });
        }
    }
    for entry in UNITS {
        let Some(prefix) = symbol.strip_suffix(entry.symbol) else { continue };
        if let Some((_, scale)) = entry.prefixes.iter().find(|(name, _)| *name == prefix) {
            // kg is the SI unit itself: 1e3 * 1e-3 must give exactly one.
            return Some(Unit { factor: scale * entry.factor, dimension: entry.dimension });
        }
    }
    None
}

/// Every symbol, prefixed forms included.
pub(crate) fn symbols() -> Vec<String> {
    let mut all: Vec<String> = UNITS.iter().map(|entry| entry.symbol.to_string()).collect();
    for entry in UNITS {
        all.extend(entry.prefixes.iter().map(|(prefix, _)| format!("{prefix}{}", entry.symbol)));
    }
    all
}
