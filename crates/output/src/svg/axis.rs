//! Axes of charts: a range of values, the prefix that makes them readable, and round ticks.

use super::layout::nice_step;

/// Units that people write with prefixes.
const PREFIXED: [&str; 8] = ["m", "N", "Pa", "J", "W", "Hz", "s", "g"];
/// Prefixes in steps of a thousand, from nano to giga.
const PREFIXES: [&str; 7] = ["n", "µ", "m", "", "k", "M", "G"];
const UNITY: i32 = 3;

/// What values of one kind are shown in: a factor, and the unit that they have then.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    pub factor: f64,
    pub unit: String,
}

impl Shown {
    /// For values up to `largest` in an SI unit.
    pub fn of(largest: f64, unit: &str) -> Self {
        // Angles, and their rates.
        if let Some(over) = unit.strip_prefix("rad").filter(|over| over.is_empty() || over.starts_with("/s"))
        {
            return Self { factor: 1f64.to_degrees(), unit: format!("°{}", over.replace("^2", "²")) };
        }
        let (largest, unit, grams) =
            if unit == "kg" { (1e3 * largest, "g", 1e3) } else { (largest, unit, 1.0) };
        let step = if largest > 0.0 && largest.is_finite() {
            // What is a little less than a thousand of one prefix stays there.
            ((largest.log10() + 1e-9) / 3.0).floor() as i32
        } else {
            0
        };
        let printed = unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴").replace('*', "·");
        let first = unit.split(['*', '/']).next().unwrap_or_default();
        let prefix = usize::try_from(step + UNITY).ok().and_then(|position| PREFIXES.get(position));
        match prefix {
            Some(prefix) if PREFIXED.contains(&first) => {
                Self { factor: grams * 1000f64.powi(-step), unit: format!("{prefix}{printed}") }
            }
            // Numbers that need no help have none.
            _ if (-1..=1).contains(&step) => Self { factor: 1.0, unit: printed },
            _ => {
                let power: String = (3 * step).to_string().chars().map(superscript).collect();
                Self {
                    factor: 1000f64.powi(-step),
                    unit: format!("10{power} {printed}").trim_end().to_owned(),
                }
            }
        }
    }

    /// A value with its unit, to so many digits.
    pub fn value(&self, value: f64, digits: usize) -> String {
        let text = number(value * self.factor, digits);
        match self.unit.as_str() {
            "" => text,
            "°" => format!("{text}°"),
            unit => format!("{text} {unit}"),
        }
    }
}

fn superscript(character: char) -> char {
    match character {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        '-' => '⁻',
        // The others stand in a row.
        digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
    }
}

/// A value with the prefix that suits it: "9.757 N", "30°".
pub fn shown(value: f64, unit: &str, digits: usize) -> String {
    Shown::of(value.abs(), unit).value(value, digits)
}

/// A number with so many significant digits, without zeros behind them.
pub fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let whole = value.abs().log10().floor() as i64 + 1;
    let text = format!("{value:.*}", (digits as i64 - whole).max(0) as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

/// An axis of a chart.
pub struct Axis {
    /// First and last value, SI, with a margin.
    pub low: f64,
    pub high: f64,
    /// Name with the unit.
    pub label: String,
    shown: Shown,
    /// Distance of ticks, in the unit shown.
    step: f64,
}

impl Axis {
    /// For values between `low` and `high`, on `length` px with ticks `distance` px apart at least. Values that differ by less
    /// than `noise` count as one.
    pub fn new(
        [low, high]: [f64; 2],
        name: &str,
        unit: &str,
        length: f64,
        distance: f64,
        noise: f64,
    ) -> Self {
        let largest = low.abs().max(high.abs());
        let (low, high) = if high - low > noise.max(1e-9 * largest) {
            let margin = 0.05 * (high - low);
            (low - margin, high + margin)
        } else {
            let half = (0.1 * largest).max(1e4 * noise);
            let half = if half > 0.0 { half } else { 1.0 };
            (0.5 * (low + high) - half, 0.5 * (low + high) + half)
        };
        let shown = Shown::of(low.abs().max(high.abs()), unit);
        let name = super::shortened(name, super::LONG_NAME);
        let label = match shown.unit.as_str() {
            "" => name,
            unit => format!("{name} / {unit}"),
        };
        let step = nice_step((high - low) * shown.factor * distance / length);
        Self { low, high, label, shown, step }
    }

    /// Where a value lies between the ends, from 0 to 1.
    pub fn place(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Ticks: value (SI) and label.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let first = (self.low * self.shown.factor / self.step).ceil() as i64;
        let last = (self.high * self.shown.factor / self.step).floor() as i64;
        let decimals = (-self.step.log10() - 1e-9).ceil().max(0.0) as usize;
        let label = |i: i64| match i {
            0 => "0".to_owned(),
            i => format!("{:.decimals$}", i as f64 * self.step).replace('-', "−"),
        };
        (first..=last).map(|i| (i as f64 * self.step / self.shown.factor, label(i))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_get_the_prefix_that_suits_the_largest() {
        let cases = [
            (40.0, "N", "N", 1.0),
            (0.0312, "m", "mm", 1e3),
            (4e8, "Pa", "MPa", 1e-6),
            (0.05, "kg", "g", 1e3),
            (0.5, "N*m", "mN·m", 1e3),
            (1.0, "rad", "°", 180.0 / std::f64::consts::PI),
            (1.0, "rad/s^2", "°/s²", 180.0 / std::f64::consts::PI),
            (1.0, "rad/m", "rad/m", 1.0),
            (0.02, "", "", 1.0),
            (2e-6, "m^2", "10⁻⁶ m²", 1e6),
            (3e7, "1/m", "10⁶ 1/m", 1e-6),
            (1e15, "N", "10¹⁵ N", 1e-15),
        ];
        for (largest, unit, expected, factor) in cases {
            let shown = Shown::of(largest, unit);
            assert_eq!(shown.unit, expected);
            assert!((shown.factor / factor - 1.0).abs() < 1e-12, "{unit}: {}", shown.factor);
        }
        assert_eq!(shown(9.7571, "N", 4), "9.757 N");
        assert_eq!(shown(std::f64::consts::FRAC_PI_6, "rad", 3), "30°");
        assert_eq!(shown(-0.5, "", 3), "−0.5");
    }

    #[test]
    fn ticks_are_round_and_lie_on_the_axis() {
        let axis = Axis::new([0.0, 40.0], "push", "N", 500.0, 60.0, 0.0);
        let labels: Vec<String> = axis.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0", "10", "20", "30", "40"]);
        assert_eq!(axis.label, "push / N");
        assert!((axis.place(20.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn noise_is_a_line_and_no_landscape() {
        let axis = Axis::new([-1e-14, 1e-14], "w", "m", 300.0, 40.0, 1e-10);
        assert!(axis.high > 9e-7 && (axis.place(1e-14) - 0.5).abs() < 1e-6);
        for value in [0.0, 3.0] {
            let axis = Axis::new([value; 2], "w", "", 300.0, 40.0, 0.0);
            assert!(axis.low < value && axis.high > value && axis.ticks().len() > 2);
        }
    }
}
