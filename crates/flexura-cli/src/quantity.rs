//! Numbers as a person reads them: engineering prefixes and a sensible number of digits.

/// Prefixes in steps of a thousand, from nano to giga.
const PREFIXES: [&str; 7] = ["n", "µ", "m", "", "k", "M", "G"];
const UNITY: i32 = 3;
/// Units that people write with prefixes.
const PREFIXED: [&str; 8] = ["m", "N", "Pa", "J", "W", "Hz", "s", "g"];

/// A value with its unit: `31.2 mm`, `412 MPa`, `0.7775 rad (44.55°)`.
pub fn quantity(value: f64, unit: &str, digits: usize) -> String {
    if unit == "rad" {
        return format!("{} rad ({}°)", number(value, digits), number(value.to_degrees(), digits));
    }
    let (value, unit) = in_grams(value, unit);
    if takes_prefix(unit)
        && let Some((scale, prefix)) = prefix_for(value, digits)
    {
        return format!("{} {prefix}{}", fixed(value / scale, digits), printed(unit));
    }
    format!("{} {}", number(value, digits), printed(unit)).trim_end().to_owned()
}

/// Three components with one unit: `(128.2, 0, -74.84) mm`.
pub fn vector(values: [f64; 3], unit: &str, digits: usize) -> String {
    let largest = values.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
    let (scale, prefix) =
        if takes_prefix(unit) { prefix_for(largest, digits) } else { None }.unwrap_or((1.0, ""));
    let component = |value: f64| {
        if value.abs() < 1e-10 * largest {
            "0".to_owned()
        } else if prefix.is_empty() && scale == 1.0 {
            number(value, digits)
        } else {
            // As many decimals as the largest component shows.
            let whole = (largest / scale).abs().log10().floor().max(0.0) as usize + 1;
            trimmed(format!("{:.*}", digits.saturating_sub(whole), value / scale))
        }
    };
    let list = values.map(component).join(", ");
    format!("({list}) {prefix}{}", printed(unit)).trim_end().to_owned()
}

/// A strain in microstrain: `621.7 µε`; in per cent from one per cent on.
pub fn strain(value: f64, digits: usize) -> String {
    if value.abs() >= 0.01 {
        format!("{} %", number(100.0 * value, digits))
    } else if value != 0.0 && value.abs() < 1e-12 {
        format!("{} ε", number(value, 2))
    } else {
        format!("{} µε", number(1e6 * value, digits))
    }
}

/// A rotation vector as an angle about an axis.
pub fn rotation(vector: [f64; 3]) -> String {
    let angle = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    if angle < 1e-12 {
        return "none".to_owned();
    }
    let axis = vector.map(|component| {
        let component = component / angle;
        if component.abs() < 1e-9 { "0".to_owned() } else { number(component, 4) }
    });
    format!("{}° about ({})", number(angle.to_degrees(), 5), axis.join(", "))
}

/// A plain number with so many significant digits, with an exponent where it is very large or small.
pub fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if (1e-4..1e7).contains(&value.abs()) { fixed(value, digits) } else { exponential(value, digits) }
}

/// A small number of which only the size matters, such as an error estimate.
pub fn size(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { exponential(value, 2) }
}

fn exponential(value: f64, digits: usize) -> String {
    let text = format!("{:.*e}", digits.saturating_sub(1), value);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa.to_owned())),
        None => text,
    }
}

fn fixed(value: f64, digits: usize) -> String {
    let whole = value.abs().log10().floor() as i64 + 1;
    trimmed(format!("{:.*}", (digits as i64 - whole).max(0) as usize, value))
}

fn trimmed(text: String) -> String {
    if !text.contains('.') {
        return text;
    }
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The prefix that leaves one to three digits before the point. None beyond the prefixes.
fn prefix_for(value: f64, digits: usize) -> Option<(f64, &'static str)> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    // 999.96 shows as 1000 with four digits and takes the next prefix.
    let rounded = format!("{:.*e}", digits.saturating_sub(1), value).parse::<f64>().unwrap_or(value);
    let step = (rounded.abs().log10() / 3.0 + 1e-12).floor() as i32;
    let prefix = PREFIXES.get(usize::try_from(step + UNITY).ok()?)?;
    Some((1000f64.powi(step), prefix))
}

/// Does the unit start with one that people write with prefixes, to the first power?
fn takes_prefix(unit: &str) -> bool {
    let first = unit.split(['*', '/']).next().unwrap_or_default();
    PREFIXED.contains(&first)
}

fn in_grams(value: f64, unit: &str) -> (f64, &str) {
    if unit == "kg" { (1e3 * value, "g") } else { (value, unit) }
}

fn printed(unit: &str) -> String {
    unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴").replace('*', "·")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_read_like_an_engineers() {
        let cases = [
            (0.0312, "m", "31.2 mm"),
            (4.12e8, "Pa", "412 MPa"),
            (0.05, "kg", "50 g"),
            (1.9833, "N", "1.983 N"),
            (0.69, "N*m/rad", "690 mN·m/rad"),
            (-0.0074839, "m", "-7.484 mm"),
            (0.99996, "m", "1 m"),
            (0.0, "m", "0 m"),
            (2.5e-17, "m", "2.5e-17 m"),
            (3.0, "1/m", "3 1/m"),
            (2.5e-6, "m^2", "2.5e-6 m²"),
            (0.5, "", "0.5"),
            (9.80665, "m/s^2", "9.807 m/s²"),
            (0.77752, "rad", "0.7775 rad (44.55°)"),
        ];
        for (value, unit, text) in cases {
            assert_eq!(quantity(value, unit, 4), text);
        }
    }

    #[test]
    fn vectors_share_a_prefix_and_drop_rounding_noise() {
        assert_eq!(vector([0.12818, 1e-19, -0.074839], "m", 4), "(128.2, 0, -74.8) mm");
        assert_eq!(vector([0.0; 3], "N", 4), "(0, 0, 0) N");
        assert_eq!(vector([0.0, 0.2169, 0.9762], "", 4), "(0, 0.2169, 0.9762)");
    }

    #[test]
    fn strains_are_in_microstrain() {
        assert_eq!(strain(621.664e-6, 4), "621.7 µε");
        assert_eq!(strain(0.034, 4), "3.4 %");
    }

    #[test]
    fn rotations_name_their_axis() {
        assert_eq!(rotation([0.0, 0.777516, 0.0]), "44.548° about (0, 1, 0)");
        assert_eq!(rotation([0.0; 3]), "none");
    }
}
