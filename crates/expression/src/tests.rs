//! Behaviour of the whole way from text to value.

use crate::*;
use proptest::prelude::*;

fn evaluate(text: &str) -> Result<Quantity, ExpressionError> {
    Expression::parse(text)?.evaluate(&mut |reference| match reference.name() {
        Some("push") => Ok(Quantity { value: 3.0, kind: Kind::Of(Dimension::FORCE) }),
        Some("ratio") => Ok(Quantity::plain(0.25)),
        _ => Err(ExpressionError::new("unknown", reference.span.clone())),
    })
}

fn value(text: &str) -> f64 {
    evaluate(text).unwrap_or_else(|error| panic!("{text}: {error:?}")).value
}

fn message(text: &str) -> String {
    let error = evaluate(text).expect_err(text);
    assert!(error.span.end <= text.len() && error.span.start <= error.span.end, "{text}: {error:?}");
    match error.hint {
        Some(hint) => format!("{}..{}: {}; {hint}", error.span.start, error.span.end, error.message),
        None => format!("{}..{}: {}", error.span.start, error.span.end, error.message),
    }
}

#[test]
fn operators_bind_as_in_mathematics() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("-3^2", -9.0),
        ("(-3)^2", 9.0),
        ("2^3^2", 512.0),
        ("2^-2", 0.25),
        ("2*-3", -6.0),
        ("8/4/2", 1.0),
        ("7 - 2 - 1", 4.0),
        ("+5", 5.0),
        ("--5", 5.0),
        ("1e-3*ratio", 0.25e-3),
        (".5 + 5.", 5.5),
        ("2 · 3", 6.0),
        ("max(1, 5, 3) + min(4, 2)", 7.0),
        ("hypot(2, 3, 6)", 7.0),
        ("atan2(1, 1)*4 - pi", 0.0),
        ("sin(30 deg)", 0.5),
        ("ln(e) + log10(100) + exp(0)", 4.0),
        ("sqrt(16) + cbrt(27) + abs(-2) + sign(-7)", 8.0),
        ("tau/pi", 2.0),
    ] {
        let found = value(text);
        assert!(
            (found - expected).abs() <= 1e-15 * expected.abs().max(1.0),
            "{text} = {found}, not {expected}"
        );
    }
}

#[test]
fn a_unit_binds_directly_behind_a_number_only() {
    for (text, expected, dimension) in [
        ("2*push + 1 N", 7.0, Dimension::FORCE),
        ("1 N*push", 3.0, Dimension::FORCE.times(&Dimension::FORCE)),
        ("0.69 N*m/rad", 0.69, Dimension::ANGULAR_STIFFNESS),
        ("7630 kg/m^3", 7630.0, Dimension::DENSITY),
        ("9.81 m/s^2", 9.81, Dimension::ACCELERATION),
        ("9.81 m/s/s", 9.81, Dimension::ACCELERATION),
        ("9.81 m*s^-2", 9.81, Dimension::ACCELERATION),
        ("3 N m", 3.0, Dimension::MOMENT),
        ("0.0851/mm", 85.1, Dimension::CURVATURE),
        ("2 1/m", 2.0, Dimension::CURVATURE),
        ("152.4 mm", 0.1524, Dimension::LENGTH),
        ("152.4mm", 0.1524, Dimension::LENGTH),
        ("5 mm^2", 5e-6, Dimension::AREA),
        ("sqrt(4 mm^2)", 2e-3, Dimension::LENGTH),
        ("(2 m)^3", 8.0, Dimension::VOLUME),
        ("1 m + 1", 2.0, Dimension::LENGTH),
        ("2 m*2", 4.0, Dimension::LENGTH),
        ("min(2 m, 1 m)", 1.0, Dimension::LENGTH),
        ("2 min", 120.0, Dimension::TIME),
    ] {
        let found = evaluate(text).unwrap_or_else(|error| panic!("{text}: {error:?}"));
        assert!((found.value - expected).abs() <= 1e-15 * expected, "{text} = {}", found.value);
        assert_eq!(found.kind, Kind::Of(dimension), "{text}");
    }
}

#[test]
fn errors_say_what_and_where() {
    for (text, expected) in [
        ("", "0..0: the expression is empty"),
        ("   ", "3..3: the expression is empty"),
        ("1 +", "3..3: expected a value, found the end"),
        ("(1", "0..1: `(` is not closed"),
        ("1)", "1..2: `)` closes nothing"),
        ("2 ** 3", "3..4: expected a value, found `*`; a power is written `^`"),
        ("1 N + 1 m", "0..9: cannot add a length (m) to a force (N)"),
        ("push - 3 Pa", "0..11: cannot subtract a pressure (Pa) from a force (N)"),
        ("sin(3 m)", "0..8: `sin` takes an angle, found a length (m)"),
        ("exp(push)", "0..9: `exp` takes a plain number, found a force (N)"),
        ("2^(1 m)", "0..7: an exponent must be a plain number, found a length (m)"),
        ("3 gpa", "2..5: there is no unit `gpa`; did you mean `GPa`?"),
        ("3 MM", "2..4: there is no unit `MM`; did you mean `mm`?"),
        ("3 push", "2..6: there is no unit `push`; to multiply, write `3*push`"),
        ("3 pi", "2..4: expected an operator (+ - * / ^), found `pi`; write `3*pi`"),
        ("2*m", "2..3: `m` is a unit and must stand directly behind a number; write `1 m`"),
        (
            "log(3)",
            "0..3: there is no function `log`; write `ln` for the natural logarithm, `log10` for the decimal one",
        ),
        ("sine(3)", "0..4: there is no function `sine`; did you mean `sin`?"),
        ("atan2(1)", "0..8: `atan2` takes 2 arguments, found 1"),
        ("sin + 1", "0..3: `sin` is a function and needs its arguments; write `sin(...)`"),
        ("1 $ 2", "2..3: `$` has no meaning in an expression"),
        ("1 2", "2..3: expected an operator (+ - * / ^), found `2`"),
        ("1e999", "0..5: `1e999` is too large for a number"),
        ("beam.", "5..5: expected a name behind the dot"),
        ("x[1", "1..2: `[` is not closed"),
        ("x['1", "2..4: the quote ' is not closed"),
    ] {
        assert_eq!(message(text), expected, "{text}");
    }
}

#[test]
fn deep_or_long_texts_are_refused_and_not_a_stack_overflow() {
    for text in [
        format!("{}1{}", "(".repeat(9_000), ")".repeat(9_000)),
        format!("{}1", "-".repeat(15_000)),
        format!("1{}", "^1".repeat(9_000)),
        format!("{}1{}", "x[".repeat(6_000), "]".repeat(6_000)),
        format!("{}1{}", "sin(".repeat(3_000), ")".repeat(3_000)),
    ] {
        assert!(message(&text).contains("nested more than 100 deep"), "{}", message(&text));
    }
    assert!(message(&"1".repeat(30_000)).contains("at most 20000"));
    assert_eq!(value(&format!("1{}", "+1".repeat(9_000))), 9_001.0);
    let right = format!("{}push{}", "(push + ".repeat(45), ")".repeat(45));
    assert_eq!(value(&right), 138.0);
    let right = format!("{}s{}", "(s + ".repeat(45), ")".repeat(45));
    assert!(Function::parse(&right, "s").unwrap_err().message.contains("unfinished operations"));
}

#[test]
fn references_keep_their_parts() {
    let expression =
        Expression::parse("beam.link[\"30 mm\"].position.z - body.\"left-arm\".rotation").unwrap();
    let references = expression.references();
    assert_eq!(references.len(), 2);
    let names: Vec<String> = references
        .iter()
        .flat_map(|reference| &reference.segments)
        .map(|(segment, _)| match segment {
            Segment::Name(name) => name.clone(),
            Segment::Index(index) => format!("{:?}", index.evaluate(&mut |_| unreachable!()).unwrap().value),
        })
        .collect();
    assert_eq!(names, ["beam", "link", "0.03", "position", "z", "body", "left-arm", "rotation"]);
    assert_eq!(references[0].span, 0..29);
}

#[test]
fn division_by_zero_is_located() {
    let expression = Expression::parse("1 + 2/(1 - 1)").unwrap();
    let lowered = expression.lower(&mut |_| unreachable!()).unwrap();
    assert_eq!(lowered.not_finite, Some(4..13));
}

/// NIST SP 811 (2008), appendix B.8, all printed digits.
#[test]
fn units_agree_with_the_published_conversion_factors() {
    for (text, expected) in [
        ("1 inch", 2.54e-2),
        ("1 in", 2.54e-2),
        ("1 ft", 3.048e-1),
        ("1 yd", 9.144e-1),
        ("1 mil", 2.54e-5),
        ("1 lb", 4.535924e-1),
        ("1 oz", 2.834952e-2),
        ("1 slug", 1.459390e1),
        ("1 lbf", 4.448222),
        ("1 ozf", 2.780139e-1),
        ("1 kip", 4.448222e3),
        ("1 kgf", 9.80665),
        ("1 dyn", 1e-5),
        ("1 psi", 6.894757e3),
        ("1 ksi", 6.894757e6),
        ("1 lbf/ft^2", 4.788026e1),
        ("1 lbf*in", 1.129848e-1),
        ("1 lbf*ft", 1.355818),
        ("1 ozf*in", 7.061552e-3),
        ("1 lbf/in", 1.751268e2),
        ("1 lb/in^3", 2.767990e4),
        ("1 lb/ft^3", 1.601846e1),
        ("1 atm", 1.01325e5),
        ("1 bar", 1e5),
        ("1 mbar", 1e2),
        ("1 dyn*cm", 1e-7),
        ("1 erg", 1e-7),
        ("1 deg", 1.745329e-2),
        ("1 arcmin", 2.908882e-4),
        ("1 arcsec", 4.848137e-6),
        ("1 arcsec", 4.848137e-6),
        ("1 rpm", 1.047198e-1),
        ("1 in^4", 4.162314e-7),
        ("1 ft^3", 2.831685e-2),
        ("1 angstrom", 1e-10),
        ("1 micron", 1e-6),
        ("1 kgf/cm^2", 9.80665e4),
        ("1 kip/in^2", 6.894757e6),
        ("1 g/cm^3", 1e3),
        ("1 ft/s^2", 3.048e-1),
        ("1 lb*in^2", 2.926397e-4),
    ] {
        let found = value(text);
        assert!((found / expected - 1.0).abs() < 5e-7, "{text} = {found}, not {expected}");
    }
    // Exact ones, to the last bit.
    for (text, expected) in [
        ("1 kg", 1.0),
        ("207 GPa", 207e9),
        ("0.254 mm", 0.254e-3),
        ("5 um", 5e-6),
        ("1 µm", 1e-6),
        ("50 g", 0.05),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn no_two_units_share_a_symbol() {
    let mut symbols = crate::unit::symbols();
    symbols.sort();
    let count = symbols.len();
    symbols.dedup();
    assert_eq!(symbols.len(), count);
    for free in ["h", "L", "t", "A", "F", "E", "G", "EI", "GJ", "EA", "k", "d", "P", "M"] {
        assert_eq!(reserved(free), None, "{free}");
    }
}

const SMOOTH: &[&str] = &[
    "sin(x)",
    "cos(2*x)",
    "tan(x)",
    "asin(x/3)",
    "acos(x/3)",
    "atan(3*x)",
    "sinh(x)",
    "cosh(x)",
    "tanh(x)",
    "exp(-x^2)",
    "ln(x)",
    "log10(x + 1)",
    "sqrt(x)",
    "cbrt(x)",
    "abs(-x)",
    "x^2.5",
    "x^-3",
    "2^x",
    "x^x",
    "atan2(x, 2 - x^2)",
    "hypot(x, 2, x^2)",
    "1/(1 + x^2)",
    "max(x, x^2/7)",
    "-x^3 + 4*x",
    "sqrt(1 + sin(x)^2)/x",
];

#[test]
fn each_derivative_is_the_slope_of_the_one_before() {
    for text in SMOOTH {
        let function = Function::parse(text, "x").unwrap();
        for x in [0.3, 0.7, 1.1] {
            let jet = function.jet(x);
            assert_eq!(jet[0], function.value(x), "{text}");
            let h = 1e-4;
            let at = |shift: f64| function.jet(x + shift * h);
            for order in 0..3 {
                // Central differences of fourth order: error about h^4 = 1e-16 and round-off 1e-12.
                let slope = (8.0 * (at(1.0)[order] - at(-1.0)[order]) - (at(2.0)[order] - at(-2.0)[order]))
                    / (12.0 * h);
                let error = (slope - jet[order + 1]).abs();
                assert!(
                    error < 1e-8 * jet[order + 1].abs().max(1.0),
                    "{text} at {x}, order {order}: {slope} {jet:?}"
                );
            }
        }
    }
}

#[test]
fn powers_and_roots_are_right_where_they_begin() {
    assert_eq!(Function::parse("x^2", "x").unwrap().jet(0.0), [0.0, 0.0, 2.0, 0.0]);
    assert_eq!(Function::parse("x^3", "x").unwrap().jet(-2.0), [-8.0, 12.0, -12.0, 6.0]);
    assert_eq!(Function::parse("x^0", "x").unwrap().jet(0.0), [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(Function::parse("sqrt(0)*x", "x").unwrap().jet(1.0), [0.0; 4]);
    assert_eq!(Function::parse("x^2.5", "x").unwrap().jet(0.0)[..3], [0.0, 0.0, 0.0]);
}

#[test]
fn a_variable_may_bear_the_name_of_a_unit() {
    assert_eq!(Function::parse("1e-3*s", "s").unwrap().value(2.0), 2e-3);
    assert_eq!(Function::parse("2 N/m^2*s", "s").unwrap().value(3.0), 6.0);
    assert_eq!(Function::parse("-s^2", "s").unwrap().value(3.0), -9.0);
    assert_eq!(Function::parse("2 + 3", "s").unwrap().as_constant(), Some(5.0));
    assert_eq!(Function::parse("s", "s").unwrap().as_constant(), None);
    assert_eq!(Function::constant(4.0).jet(1.0), [4.0, 0.0, 0.0, 0.0]);
    assert!(Function::parse("2 N + s*1 m", "s").is_err());
    let error = Function::parse("2*u", "s").unwrap_err();
    assert_eq!((error.message.as_str(), error.span), ("`u` is not known here", 2..3));
}

#[test]
fn formulas_read_slots() {
    let expression = Expression::parse("2*a - b/a").unwrap();
    let formula = expression
        .lower(&mut |reference| {
            let slot = if reference.name() == Some("a") { 0 } else { 1 };
            Ok(Binding::Slot(slot, Kind::Plain))
        })
        .unwrap()
        .formula();
    assert_eq!(formula.evaluate(&[2.0, 6.0]), 1.0);
    assert!(formula.evaluate(&[]).is_nan());
    assert_eq!(Formula::slot(1).evaluate(&[1.0, 5.0]), 5.0);
}

proptest! {
    #[test]
    fn any_text_parses_or_fails_but_never_panics(text in "\\PC{0,60}") {
        let _ = evaluate(&text);
        let _ = Function::parse(&text, "s");
    }

    #[test]
    fn texts_of_our_own_words_never_panic(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "1", "2.5e3", "push", "s", "N", "m", "mm", "(", ")", "[", "]", "+", "-", "*", "/", "^", ",", ".", "sin",
                "max", "'", "\"", " ", "deg", "%", "beam", "inf", "0", "atan2", "1e", "°", "µm",
            ]),
            0..40,
        )
    ) {
        let text = words.concat();
        if let Err(error) = evaluate(&text) {
            prop_assert!(text.get(error.span.clone()).is_some(), "{text}: {error:?}");
        }
        if let Ok(function) = Function::parse(&text, "s") {
            let jet = function.jet(0.7);
            let value = function.value(0.7);
            prop_assert!(jet[0] == value || value.is_nan(), "{text}: {jet:?} {value}");
        }
    }

    #[test]
    fn a_printed_number_reads_back(value in prop::num::f64::NORMAL | prop::num::f64::ZERO) {
        prop_assert_eq!(super::tests::value(&format!("{value:?}")), value);
    }
}

#[test]
fn a_moment_times_an_angular_velocity_is_a_power() {
    let power = Dimension::MOMENT.times(&Dimension::ANGULAR_VELOCITY);
    assert_eq!(power.unit(), "W");
    assert!(power.agrees(&Dimension::FORCE.times(&Dimension::VELOCITY)));
}

#[test]
fn units_in_other_spellings_are_told_as_they_are_written_here() {
    for (word, written) in [
        ("Nm", Some("N*m")),
        ("Nmm", Some("N*mm")),
        ("kNm", Some("kN*m")),
        ("mNm", Some("mN*m")),
        ("lbfin", Some("lbf*in")),
        ("Ns", Some("N*s")),
        ("kgm2", Some("kg*m^2")),
        ("gcm²", Some("g*cm^2")),
        ("mm2", Some("mm^2")),
        ("mm²", Some("mm^2")),
        ("m³", Some("m^3")),
        ("mm4", Some("mm^4")),
        ("s2", Some("s^2")),
        ("millimetres", Some("mm")),
        ("Newtons", Some("N")),
        ("kilonewton", Some("kN")),
        ("degrees", Some("deg")),
        ("inches", Some("in")),
        ("seconds", Some("s")),
        ("mm", None),
        ("mmm", None),
        ("lbs", None),
        ("push", None),
        ("m1", None),
        ("", None),
    ] {
        assert_eq!(respelled(word).as_deref(), written, "{word}");
        // What is suggested can be read.
        if let Some(written) = written {
            let kind = value_kind(&format!("1 {written}"));
            assert!(matches!(kind, Kind::Of(_)), "{written}");
        }
    }
}

fn value_kind(text: &str) -> Kind {
    evaluate(text).unwrap_or_else(|error| panic!("{text}: {error:?}")).kind
}

#[test]
fn a_comma_between_digits_is_told_to_be_a_point() {
    let hint = "a number has a point, not a comma: write";
    assert_eq!(message("0,5 N"), format!("1..2: expected an operator (+ - * / ^), found `,`; {hint} `0.5`"));
    assert_eq!(message("2*(1,25)"), format!("4..5: expected `)` or an operator, found `,`; {hint} `1.25`"));
    assert_eq!(message("sin(0,5)"), format!("0..8: `sin` takes 1 argument, found 2; {hint} `0.5`"));
    // Arguments are divided by commas, and a comma behind a number need not be meant for a point.
    assert_eq!(value("max(0, 5)"), 5.0);
    assert_eq!(message("1 N, 2"), "3..4: expected an operator (+ - * / ^), found `,`");
}

#[test]
fn radians_are_no_dimension_of_what_people_read() {
    for (text, unit) in [
        ("1 kg*rad", "kg"),
        ("1600 kg/m^3*1 m^3*150 deg", "kg"),
        ("2 N*m*rad", "N*m"),
        ("1 rad^2", ""),
        ("1 N/rad^2", "N"),
        ("3 m^5*rad", "m^5"),
        // Where people know the quantity by its radian, it stays.
        ("3 N*m/rad", "N*m/rad"),
        ("3 rad/s", "rad/s"),
        ("30 deg", "rad"),
        ("3 mm/rad", "m/rad"),
    ] {
        assert_eq!(value_kind(text).dimension().unit(), unit, "{text}");
    }
}

#[test]
fn a_name_to_take_is_free() {
    let symbols = unit_table().iter().map(|entry| entry.symbol);
    let prefixed = ["mm", "kg", "kN", "MPa", "mg"];
    let calls = function_table().map(|(name, _)| name);
    let constants = constant_table().map(|(name, _)| name);
    for name in symbols.chain(prefixed).chain(calls).chain(constants) {
        let free = free_name(name);
        assert_eq!(reserved(&free), None, "{name}: {free}");
        let starts = free.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_');
        assert!(starts && free.chars().all(|c| c.is_alphanumeric() || c == '_'), "{name}: {free}");
    }
}
