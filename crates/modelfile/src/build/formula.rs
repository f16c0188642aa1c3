//! Formulas that repeat an output: what goes in, where the model is asked, and which terms there are.

use super::fit::{named, number, range, texts};
use super::measurements::{Known, split_unit, unit};
use super::result::Built;
use crate::context::{Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::{Node, Value};
use flexura_expression::Dimension;
use flexura_model::{
    FormulaFactor, FormulaPiece, FormulaQuantity, FormulaSource, FormulaStudy, FormulaTerm, FormulaUnit,
    FormulaVariable, Model,
};

/// Largest degree, and most values along an axis and on the whole grid.
const MOST_DEGREE: usize = 40;
const MOST_VALUES: usize = 100_000;

/// A variable with its name and dimension.
struct Named<'n> {
    name: &'n str,
    dimension: Option<Dimension>,
    variable: FormulaVariable,
}

/// `traces` are the studies before this one: name, and whether it is a trace.
pub(super) fn formula(
    reader: &Reader<'_, '_>,
    model: &Model,
    outputs: &[Built],
    traces: &[(&str, bool)],
) -> Read<FormulaStudy> {
    let known = Known::new(reader.context, model, outputs);
    let output = output(reader, &known);
    let variables = variables(reader, &known);
    let source = source(reader, &known, traces);
    let mut variables = variables?;
    ranges(reader, &mut variables)?;
    let pieces = pieces(reader, &variables)?;
    let (output, unit) = output?;
    let source = source?;
    Ok(FormulaStudy {
        output,
        unit,
        variables: variables.into_iter().map(|named| named.variable).collect(),
        source,
        pieces,
    })
}

/// A name with its unit, whose dimension is `wanted`: None: any will do.
fn in_unit(
    reader: &Reader<'_, '_>,
    (node, path): (&Node, &str),
    text: &str,
    wanted: Option<Dimension>,
) -> Read<FormulaUnit> {
    let (name, own) = split_unit(text);
    let Some(own) = own else {
        return Ok(FormulaUnit { text: wanted.map_or(String::new(), |wanted| wanted.unit()), factor: 1.0 });
    };
    let wrong = |message: String| {
        let unit = wanted.map_or(String::new(), |wanted| wanted.unit());
        let hint = format!("for example `{name} [{unit}]`");
        reader.context.wrong_with_hint(&node.span, path, message, hint)
    };
    let (factor, dimension) = unit(own).map_err(wrong)?;
    if let Some(wanted) = wanted
        && !wanted.agrees(&dimension)
    {
        return Err(wrong(format!("`{name}` is {wanted}, but `{own}` is {dimension}")));
    }
    Ok(FormulaUnit { text: own.to_string(), factor })
}

fn output(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<((usize, usize), FormulaUnit)> {
    let Some(text) = reader.text("output")? else { return Err(reader.missing_key("output")) };
    let (name, _) = split_unit(text);
    let Some(output) = known.output(name) else {
        let names = known.output_names();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let hint = suggest(name, &names, "output");
        return Err(reader.wrong_at("output", format!("there is no output `{name}`"), hint));
    };
    let Some((entry, _)) = reader.entry("output") else { return Err(Reported) };
    let place = (&entry.node, reader.key_path("output"));
    let unit = in_unit(reader, (place.0, &place.1), text, Some(known.output_dimension(output.0)))?;
    Ok((output, unit))
}

fn variables<'c>(reader: &Reader<'c, '_>, known: &Known<'_>) -> Read<Vec<Named<'c>>> {
    let mut all = Vec::new();
    for (node, path, text) in texts(reader, "of")? {
        let (name, _) = split_unit(text);
        let (of, dimension) = match (known.parameter(name), known.output(name)) {
            (Some(position), _) => {
                (FormulaQuantity::Parameter(position), known.parameter_dimension(position))
            }
            (None, Some((output, component))) => {
                (FormulaQuantity::Output(output, component), Some(known.output_dimension(output)))
            }
            (None, None) => {
                let mut names: Vec<String> =
                    known.parameter_names().into_iter().map(str::to_string).collect();
                names.extend(known.output_names());
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let message = format!("there is no parameter or output `{name}`");
                let hint = suggest(name, &names, "parameter or output");
                return Err(reader.context.wrong_with_hint(&node.span, &path, message, hint));
            }
        };
        let unit = in_unit(reader, (node, &path), text, dimension)?;
        all.push(Named { name, dimension, variable: FormulaVariable { of, unit, range: None } });
    }
    Ok(all)
}

fn ranges(reader: &Reader<'_, '_>, variables: &mut [Named<'_>]) -> Read<()> {
    for entry in named(reader, "range")? {
        let path = format!("{}.{}", reader.key_path("range"), entry.key);
        let Some(variable) = variables.iter_mut().find(|variable| variable.name == entry.key) else {
            let message = format!("`{}` does not go into the formula", entry.key);
            return Err(reader.context.wrong_with_hint(&entry.key_span, &path, message, "name it in `of`"));
        };
        variable.variable.range = Some(range(reader, &entry.node, &path, "range", variable.dimension)?);
    }
    Ok(())
}

fn source(reader: &Reader<'_, '_>, known: &Known<'_>, traces: &[(&str, bool)]) -> Read<FormulaSource> {
    match (reader.text("trace")?, reader.has("vary")) {
        (Some(name), false) => {
            match traces.iter().position(|(known, is_trace)| *known == name && *is_trace) {
                Some(position) => Ok(FormulaSource::Trace(position)),
                None => {
                    let names: Vec<&str> =
                        traces.iter().filter(|(_, is_trace)| *is_trace).map(|(name, _)| *name).collect();
                    let hint = match names.is_empty() {
                        true => "write a study of the kind \"trace\" before this one".to_string(),
                        false => format!("{}; it stands before this one", suggest(name, &names, "trace")),
                    };
                    Err(reader.wrong_at("trace", format!("there is no trace `{name}`"), hint))
                }
            }
        }
        (None, true) => grid(reader, known).map(FormulaSource::Grid),
        (None, false) => Err(reader.wrong_with_hint(
            "nothing says where the model is asked",
            "name a `trace`, or give a grid: `vary = { theta = [\"-40 deg\", \"40 deg\", 9] }`",
        )),
        (Some(_), true) => {
            Err(reader.wrong_at("vary", "give `trace` or `vary`, not both", "remove one of the two"))
        }
    }
}

fn grid(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<Vec<(usize, Vec<f64>)>> {
    let mut axes = Vec::new();
    let mut whole = 1_usize;
    for entry in named(reader, "vary")? {
        let path = format!("{}.{}", reader.key_path("vary"), entry.key);
        let wrong = |message: String, hint: String| {
            Err(reader.context.wrong_with_hint(&entry.node.span, &path, message, hint))
        };
        let Some(position) = known.parameter(&entry.key) else {
            let hint = suggest(&entry.key, &known.parameter_names(), "parameter");
            return wrong(format!("there is no parameter `{}`", entry.key), hint);
        };
        let list = match &entry.node.value {
            Value::List(list) if list.len() == 3 => list,
            _ => {
                let hint = format!("for example `{} = [\"-40 deg\", \"40 deg\", 9]`", entry.key);
                return wrong("expected from, to, and how many".to_string(), hint);
            }
        };
        let dimension = known.parameter_dimension(position);
        let [from, to] =
            [0, 1].map(|i| number(reader, &list[i], &format!("{path}[{i}]"), dimension.as_ref()));
        let (from, to) = (from?, to?);
        let count = number(reader, &list[2], &format!("{path}[2]"), Some(&Dimension::NUMBER))?;
        if count.fract() != 0.0 || count < 2.0 || count > MOST_VALUES as f64 {
            return wrong(
                format!("a number of values from 2 to {MOST_VALUES}, found {count}"),
                String::new(),
            );
        }
        let count = count as usize;
        whole = whole.saturating_mul(count);
        if whole > MOST_VALUES {
            return wrong(
                format!("a grid has at most {MOST_VALUES} points"),
                "take fewer values".to_string(),
            );
        }
        let last = (count - 1) as f64;
        let value = |i: usize| (from * (last - i as f64) + to * i as f64) / last;
        axes.push((position, (0..count).map(value).collect()));
    }
    Ok(axes)
}

fn pieces(reader: &Reader<'_, '_>, variables: &[Named<'_>]) -> Read<Vec<FormulaPiece>> {
    if !reader.has("pieces") {
        return Ok(vec![FormulaPiece { to: None, terms: terms(reader, variables)? }]);
    }
    if let Some(key) = ["degree", "terms", "constant"].into_iter().find(|key| reader.has(key)) {
        return Err(reader.wrong_at(key, "every piece has its own", "move it into `pieces`"));
    }
    let dimension = variables.first().and_then(|variable| variable.dimension);
    let piece = |table: &Reader<'_, '_>| {
        let to = match table.entry("to") {
            Some((entry, _)) => Some(number(table, &entry.node, &table.key_path("to"), dimension.as_ref())?),
            None => None,
        };
        Ok(FormulaPiece { to, terms: terms(table, variables)? })
    };
    reader.tables("pieces")?.iter().map(piece).collect()
}

fn terms(reader: &Reader<'_, '_>, variables: &[Named<'_>]) -> Read<Vec<FormulaTerm>> {
    let constant = reader.flag("constant")?;
    match (reader.count("degree")?, reader.has("terms")) {
        (Some(degree), false) if degree <= MOST_DEGREE => {
            Ok(FormulaTerm::up_to(degree as u32, variables.len(), constant.unwrap_or(true)))
        }
        (Some(_), false) => {
            Err(reader.wrong_at("degree", format!("must be at most {MOST_DEGREE}"), "cut it into `pieces`"))
        }
        (None, true) if constant.is_some() => {
            Err(reader.wrong_at("constant", "belongs to `degree`", "the term \"1\" is the constant"))
        }
        (None, true) => {
            let read = |(node, path, text): (&Node, String, &str)| {
                term(text, variables).map_err(|message| {
                    let hint = "for example \"theta^2*abs(psi)\"; \"1\" is the constant";
                    reader.context.wrong_with_hint(&node.span, &path, message, hint)
                })
            };
            texts(reader, "terms")?.into_iter().map(read).collect()
        }
        (None, false) => Err(reader.wrong_with_hint(
            "the formula has no terms",
            "for example `degree = 3`, or `terms = [\"theta\", \"theta^3\"]`",
        )),
        (Some(_), true) => {
            Err(reader.wrong_at("terms", "give `degree` or `terms`, not both", "remove one of the two"))
        }
    }
}

/// A product of powers: `x^2*abs(y)`; 1 is the constant.
fn term(text: &str, variables: &[Named<'_>]) -> Result<FormulaTerm, String> {
    if text.trim() == "1" {
        return Ok(FormulaTerm::default());
    }
    let mut term = FormulaTerm::default();
    for factor in text.split('*') {
        let (base, power) = match factor.split_once('^') {
            Some((base, power)) => (base.trim(), power.trim().parse::<u32>().ok()),
            None => (factor.trim(), Some(1)),
        };
        let Some(power) = power.filter(|power| (1..=MOST_DEGREE as u32).contains(power)) else {
            return Err(format!("`{}` has no whole power from 1 to {MOST_DEGREE}", factor.trim()));
        };
        let inner = base.strip_prefix("abs(").and_then(|rest| rest.strip_suffix(')')).map(str::trim);
        let name = inner.unwrap_or(base);
        let Some(variable) = variables.iter().position(|variable| variable.name == name) else {
            return Err(format!("`{name}` does not go into the formula"));
        };
        let is_absolute = inner.is_some();
        match term.factors.iter_mut().find(|f| (f.variable, f.is_absolute) == (variable, is_absolute)) {
            Some(known) => known.power += power,
            None => term.factors.push(FormulaFactor { variable, power, is_absolute }),
        }
    }
    term.factors.sort_by_key(|factor| (factor.variable, factor.is_absolute));
    Ok(term)
}
