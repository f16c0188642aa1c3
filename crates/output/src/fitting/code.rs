//! A formula as TOML, CSV, C and Rust.

use super::FormulaView;
use crate::csv::{csv_line, quoted};
use flexura_model::{FormulaFactor, FormulaTerm};
use std::fmt::Write;

/// The formula as a table of TOML: units, ranges, pieces with their terms and coefficients, and how well it repeats the model.
pub fn formula_toml(view: &FormulaView<'_>) -> String {
    let found = view.formula;
    let mut text = format!("# {}\n", title(view));
    let quote = |text: &str| format!("{text:?}");
    let _ = writeln!(text, "output = {}\nunit = {}", quote(&view.output()), quote(&view.study.unit.text));
    let names = view.variables();
    let list = |items: Vec<String>| format!("[{}]", items.join(", "));
    let _ = writeln!(text, "of = {}", list(names.iter().map(|name| quote(name)).collect()));
    let units = view.study.variables.iter().map(|variable| quote(&variable.unit.text));
    let _ = writeln!(text, "units = {}", list(units.collect()));
    let ranges = view.ranges().into_iter().map(|[low, high]| format!("[{low:?}, {high:?}]"));
    let _ = writeln!(text, "ranges = {}", list(ranges.collect()));
    if let Some(r_squared) = found.r_squared {
        let _ = writeln!(text, "r_squared = {r_squared:?}");
    }
    let _ = writeln!(text, "deviation = {:?}\nlargest_error = {:?}", found.deviation, found.largest.0);
    for (i, piece) in found.pieces.iter().enumerate() {
        let [from, to] = piece.range;
        let _ = writeln!(text, "\n[[pieces]]\nfrom = {from:?}\nto = {to:?}");
        let terms = view.terms(i);
        let _ = writeln!(text, "terms = {}", list(terms.iter().map(|term| quote(term)).collect()));
        let coefficients = piece.coefficients.iter().map(|c| format!("{c:?}"));
        let _ = writeln!(text, "coefficients = {}", list(coefficients.collect()));
    }
    text
}

/// One line for each term: piece, its ends, the term, its coefficient.
pub fn formula_csv(view: &FormulaView<'_>) -> String {
    let mut text = String::from("piece,from,to,term,coefficient\n");
    for (i, piece) in view.formula.pieces.iter().enumerate() {
        let [from, to] = piece.range;
        for (term, coefficient) in view.terms(i).iter().zip(&piece.coefficients) {
            let _ = writeln!(text, "{},{from:?},{to:?},{},{coefficient:?}", i + 1, quoted(term));
        }
    }
    text
}

/// The points as a table: what goes in, the model's value, the formula's.
pub(super) fn points(view: &FormulaView<'_>) -> String {
    let headed = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name}[{unit}]"),
    };
    let names = view.variables();
    let variables = names.iter().zip(&view.study.variables);
    let mut cells: Vec<String> =
        variables.map(|(name, variable)| headed(name, &variable.unit.text)).collect();
    let output = headed(&view.output(), &view.study.unit.text);
    cells.extend([output.clone(), format!("formula of {output}")]);
    let mut text = csv_line(&cells);
    for point in &view.formula.points {
        let numbers = point.variables.iter().chain([&point.value, &point.formula]);
        let _ = writeln!(text, "{}", numbers.map(|v| format!("{v:?}")).collect::<Vec<_>>().join(","));
    }
    text
}

/// What a language writes differently.
struct Language {
    /// A number of the language's widest type; always with a point or an exponent.
    absolute: fn(&str) -> String,
}

const C: Language = Language { absolute: |base| format!("fabs({base})") };
const RUST: Language = Language { absolute: |base| format!("{base}.abs()") };

/// A header that defines `static inline double NAME(double ...)` and `int NAME_is_known(...)`, which is 0 outside the values to which the
/// formula was fitted.
pub fn formula_c(view: &FormulaView<'_>) -> String {
    let name = identifier(view.name);
    let guard = format!("FLEXURA_{}_H", name.to_uppercase());
    let variables = identifiers(&view.variables());
    let arguments: Vec<String> = variables.iter().map(|variable| format!("double {variable}")).collect();
    let arguments = arguments.join(", ");
    let mut text = format!("/* {}\n", title(view).replace("*/", "* /"));
    for line in explained(view) {
        let _ = writeln!(text, " * {}", line.replace("*/", "* /"));
    }
    let _ = write!(
        text,
        " */\n#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n\nstatic inline double {name}({arguments})\n{{\n"
    );
    let last = view.formula.pieces.len() - 1;
    for (i, piece) in view.formula.pieces.iter().enumerate() {
        let sum = sum(view, i, &variables, &C);
        if i < last {
            let _ =
                writeln!(text, "    if ({} <= {:?})\n        return {sum};", variables[0], piece.range[1]);
        } else {
            let _ = writeln!(text, "    return {sum};");
        }
    }
    let known = known(view, &variables, " && ");
    let _ = write!(
        text,
        "}}\n\n/* Was the formula fitted there? */\nstatic inline int {name}_is_known({arguments})\n{{\n    return {known};\n}}\n\n#endif\n"
    );
    text
}

/// The same as functions of Rust, without a dependency.
pub fn formula_rust(view: &FormulaView<'_>) -> String {
    let name = identifier(view.name);
    let variables = identifiers(&view.variables());
    let arguments: Vec<String> = variables.iter().map(|variable| format!("{variable}: f64")).collect();
    let arguments = arguments.join(", ");
    let mut text = format!("/// {}\n///\n", title(view));
    for line in explained(view) {
        let _ = writeln!(text, "/// {line}");
    }
    let _ = writeln!(text, "pub fn {name}({arguments}) -> f64 {{");
    let last = view.formula.pieces.len() - 1;
    for (i, piece) in view.formula.pieces.iter().enumerate() {
        let sum = sum(view, i, &variables, &RUST);
        if i < last {
            let _ = writeln!(
                text,
                "    if {} <= {:?} {{\n        return {sum};\n    }}",
                variables[0], piece.range[1]
            );
        } else {
            let _ = writeln!(text, "    {sum}");
        }
    }
    let known = known(view, &variables, " && ");
    let _ = write!(
        text,
        "}}\n\n/// Was the formula fitted there?\npub fn {name}_is_known({arguments}) -> bool {{\n    {known}\n}}\n"
    );
    text
}

fn title(view: &FormulaView<'_>) -> String {
    let unit = |unit: &str| if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
    let names = view.variables();
    let of: Vec<String> = names
        .iter()
        .zip(&view.study.variables)
        .map(|(name, variable)| format!("{name}{}", unit(&variable.unit.text)))
        .collect();
    let model = if view.model.name.is_empty() { "a mechanism" } else { &view.model.name };
    format!("{}{} of {}, of {model}", view.output(), unit(&view.study.unit.text), of.join(", "))
}

fn explained(view: &FormulaView<'_>) -> Vec<String> {
    let found = view.formula;
    let fit = found.r_squared.map_or(String::new(), |r| format!("R\u{b2} = {r:.6}, "));
    let mut lines =
        vec![format!("fitted to {} points: {fit}largest error {:.3e}", found.points.len(), found.largest.0)];
    for (name, [low, high]) in view.variables().iter().zip(view.ranges()) {
        lines.push(format!("{low} <= {name} <= {high}"));
    }
    lines
}

/// A piece as an expression: of one variable by Horner's rule, of several as a sum of products.
fn sum(view: &FormulaView<'_>, piece: usize, variables: &[String], language: &Language) -> String {
    let (terms, found) = (&view.study.pieces[piece].terms, &view.formula.pieces[piece]);
    if let [variable] = variables
        && terms.iter().all(|term| plain_power(term).is_some())
    {
        return horner(terms, &found.coefficients, variable);
    }
    let product = |(term, coefficient): (&FormulaTerm, &f64)| {
        let mut text = literal(*coefficient);
        for factor in &term.factors {
            let base = base(factor, variables, language);
            for _ in 0..factor.power {
                text += &format!("*{base}");
            }
        }
        text
    };
    terms.iter().zip(&found.coefficients).map(product).collect::<Vec<_>>().join(" + ")
}

fn base(factor: &FormulaFactor, variables: &[String], language: &Language) -> String {
    let name = &variables[factor.variable];
    if factor.is_absolute { (language.absolute)(name) } else { name.clone() }
}

/// The power of a term of one variable without absolute values.
fn plain_power(term: &FormulaTerm) -> Option<u32> {
    match term.factors[..] {
        [] => Some(0),
        [factor] if !factor.is_absolute => Some(factor.power),
        _ => None,
    }
}

/// ((a x + b) x + c) x + d, from the highest power on.
fn horner(terms: &[FormulaTerm], coefficients: &[f64], variable: &str) -> String {
    let highest = terms.iter().filter_map(plain_power).max().unwrap_or(0);
    let mut powers = vec![0.0; highest as usize + 1];
    for (term, coefficient) in terms.iter().zip(coefficients) {
        powers[plain_power(term).unwrap_or(0) as usize] += coefficient;
    }
    let mut text = literal(powers[highest as usize]);
    for coefficient in powers[..highest as usize].iter().rev() {
        if text.contains(" + ") {
            text = format!("({text})");
        }
        text += &format!("*{variable}");
        if *coefficient != 0.0 {
            text += &format!(" + {}", literal(*coefficient));
        }
    }
    text
}

/// The shortest text that reads back as the same number; a negative one in brackets.
fn literal(value: f64) -> String {
    if value < 0.0 { format!("({value:?})") } else { format!("{value:?}") }
}

fn known(view: &FormulaView<'_>, variables: &[String], and: &str) -> String {
    let part = |(name, [low, high]): (&String, [f64; 2])| format!("{name} >= {low:?} && {name} <= {high:?}");
    variables.iter().zip(view.ranges()).map(part).collect::<Vec<_>>().join(and)
}

/// A name that any language takes.
fn identifier(name: &str) -> String {
    let mut text: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if text.is_empty() || text.starts_with(|c: char| c.is_ascii_digit()) {
        text.insert(0, '_');
    }
    // Reserved in C or Rust, or functions of both.
    let reserved = [
        "in", "as", "if", "do", "for", "int", "let", "mut", "fn", "ref", "use", "mod", "pub", "type", "move",
    ];
    if reserved.contains(&text.as_str()) {
        text.push('_');
    }
    text
}

/// Such names, all different.
fn identifiers(names: &[String]) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for name in names {
        let mut own = identifier(name);
        while all.contains(&own) {
            own.push('_');
        }
        all.push(own);
    }
    all
}
