//! Rest shapes, section frames, and points from a CSV file.

use crate::context::{Needed, Read, Reported};
use crate::format::{Key, Shape};
use crate::reader::Reader;
use crate::tree::{Node, Value};
use flexura_expression::{Dimension, Function, Kind, Quantity, nearest, reserved};
use flexura_model::{Curve, Profile, Rule, SectionFrame};
use flexura_spatial::Vector3;
use std::f64::consts::TAU;
use std::io::Read as _;

/// Most points of a curve, and bytes of the file they come from.
const MOST_POINTS: usize = 100_000;
const LARGEST: u64 = 16 << 20;

pub(super) fn curve(reader: &Reader<'_, '_>) -> Read<Curve> {
    match reader.variant {
        "arc" => {
            let (radius, angle) = (reader.number("radius").needed(), reader.number("angle").needed());
            Ok(Curve::Arc { radius: radius?, angle: angle? })
        }
        "helix" => {
            let (radius, pitch) = (reader.number("radius").needed(), reader.number("pitch").needed());
            let turns = reader.quantity("turns").needed()?;
            let turns = match turns.kind {
                Kind::Of(dimension) if dimension.is_angle() => {
                    let (rules, path) = (&reader.context.rules, reader.key_path("turns"));
                    if let Some([formula]) = rules.join([path.clone()], [turns.value]) {
                        rules.put(path, Rule::Quotient(formula, TAU));
                    }
                    turns.value / TAU
                }
                _ => turns.value,
            };
            Ok(Curve::Helix { radius: radius?, pitch: pitch?, turns })
        }
        "parametric" => parametric(reader),
        "points" => points(reader),
        "curvature" => {
            let curvature = ["k1", "k2", "k3"].map(|key| reader.profile(key));
            let length = reader.number("length").needed();
            let [k1, k2, k3] = curvature;
            let zero = || Profile::Constant(0.0);
            let curvature = [k1?.unwrap_or_else(zero), k2?.unwrap_or_else(zero), k3?.unwrap_or_else(zero)];
            Ok(Curve::Curvature { curvature, length: length? })
        }
        _ => Err(Reported),
    }
}

pub(super) fn parametric(reader: &Reader<'_, '_>) -> Read<Curve> {
    let variable = reader.text("parameter")?.unwrap_or("t");
    if reader.context.parameters.contains_key(variable) {
        let message = format!("`{variable}` is the curve's parameter and a parameter of the model");
        let hint = "give the curve's another name, for example `parameter = \"u\"`";
        return Err(if reader.has("parameter") {
            reader.wrong_at("parameter", message, hint)
        } else {
            reader.wrong_with_hint(message, hint)
        });
    }
    let speakable = variable
        .chars()
        .enumerate()
        .all(|(i, c)| c == '_' || c.is_alphabetic() || (i > 0 && c.is_alphanumeric()));
    let taken = reserved(variable).filter(|what| *what != "a unit");
    if variable.is_empty() || !speakable || taken.is_some() {
        let message = format!("`{variable}` cannot be the name of the parameter");
        return Err(reader.wrong_at("parameter", message, "use a letter, for example `parameter = \"u\"`"));
    }
    let range = range(reader);
    // Without a good range nothing is known of the parameter's dimension, but the rest is still checked.
    let kind = range.map_or(Kind::Plain, |range| match (range[0].kind, range[1].kind) {
        (Kind::Plain, kind) | (kind, _) => kind,
    });
    // A curve in a plane has no z.
    let has = |key: &str| reader.keys().iter().any(|known| known.name == key);
    let [x, y, z] = ["x", "y", "z"].map(|key| match has(key).then(|| reader.entry(key)).flatten() {
        Some((entry, format)) => {
            reader.function_in(&entry.node, &reader.key_path(key), &format.shape.dimension(), variable, kind)
        }
        // A missing x or y was recorded on opening the table.
        None if key == "z" => Ok(Function::constant(0.0)),
        None => Err(Reported),
    });
    Ok(Curve::Parametric { position: [x?, y?, z?], range: range?.map(|quantity| quantity.value) })
}

/// The range of the parameter; its two ends must agree in their dimension, whatever that is.
fn range(reader: &Reader<'_, '_>) -> Read<[Quantity; 2]> {
    let (entry, key) = reader.entry("range").ok_or(Reported)?;
    let path = reader.key_path("range");
    let wrong = |message: String| {
        reader.context.wrong_with_hint(
            &entry.node.span,
            &path,
            message,
            format!("for example `range = {}`", key.example),
        )
    };
    let Value::List(list) = &entry.node.value else {
        return Err(wrong(format!("expected a list of 2 numbers, found {}", entry.node.kind())));
    };
    let [from, to] = list.as_slice() else {
        return Err(wrong(format!("expected 2 numbers, found {}", list.len())));
    };
    let [from, to] = [(0, from), (1, to)].map(|(i, node)| {
        let found = reader.context.quantity(node, &format!("{path}[{i}]"), false)?;
        found.ok_or_else(|| wrong(format!("expected a number, found {}", node.kind())))
    });
    let (from, to) = (from?, to?);
    if let (Kind::Of(a), Kind::Of(b)) = (from.kind, to.kind)
        && !a.agrees(&b)
    {
        return Err(wrong(format!("the range begins with {a} and ends with {b}")));
    }
    Ok([from, to])
}

pub(super) fn frame(reader: &Reader<'_, '_>) -> Read<SectionFrame> {
    let Some(table) = reader.table("frame")? else { return Ok(SectionFrame::Natural) };
    match table.variant {
        "natural" => Ok(SectionFrame::Natural),
        "frenet" => Ok(SectionFrame::Frenet { offset: table.number("offset")?.unwrap_or(0.0) }),
        "rotation_minimising" => {
            let start = table.direction("start");
            let twist = match table.profile("twist")? {
                None => None,
                Some(Profile::Constant(value)) => Some(Function::constant(value)),
                Some(Profile::Function(function)) => Some(function),
                Some(Profile::Table { .. } | Profile::Notch(_)) => return Err(Reported),
            };
            Ok(SectionFrame::RotationMinimising { start: start?, twist })
        }
        "direction" => Ok(SectionFrame::Direction { along: table.direction("along").needed()? }),
        _ => Err(Reported),
    }
}

pub(super) fn points(reader: &Reader<'_, '_>) -> Read<Curve> {
    match (reader.entry("points"), reader.text("file")?) {
        (Some((entry, key)), None) => {
            if reader.has("unit") {
                return Err(reader.wrong_at(
                    "unit",
                    "`unit` is for the numbers of a file",
                    "write the unit behind each number, or use a file",
                ));
            }
            Ok(Curve::Points { points: inline(reader, &entry.node, key)? })
        }
        (None, Some(file)) => Ok(Curve::Points { points: from_file(reader, file, ["x", "y", "z"])? }),
        (None, None) => Err(reader.wrong_with_hint(
            "the key `points` (or `file`) is missing",
            "for example `file = \"points.csv\"`",
        )),
        (Some(_), Some(_)) => {
            Err(reader.wrong_at("file", "give `points` or `file`, not both", "remove one of the two"))
        }
    }
}

fn inline(reader: &Reader<'_, '_>, node: &Node, key: &Key) -> Read<Vec<Vector3<f64>>> {
    let path = reader.key_path("points");
    let Value::List(list) = &node.value else {
        let message = format!("expected a list of points, found {}", node.kind());
        return Err(reader.context.wrong_with_hint(
            &node.span,
            &path,
            message,
            format!("for example `points = {}`", key.example),
        ));
    };
    let mut points = Vec::with_capacity(list.len());
    let mut result = Ok(());
    let row_key = Key {
        name: "points",
        shape: Shape::Vector(Dimension::LENGTH),
        need: key.need,
        doc: "",
        example: key.example,
    };
    for (i, row) in list.iter().enumerate() {
        match reader.numbers_in(row, &format!("{path}[{i}]"), &row_key, &[Dimension::LENGTH; 3]) {
            Ok(numbers) => points.push(Vector3::from(numbers.map(|quantity| quantity.value))),
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| points)
}

/// Points from the columns of a file; what has no column is zero.
pub(super) fn from_file<const N: usize>(
    reader: &Reader<'_, '_>,
    file: &str,
    names: [&str; N],
) -> Read<Vec<Vector3<f64>>> {
    let scale = match reader.text("unit")? {
        None => 1.0,
        Some(text) => match flexura_expression::unit(text) {
            Some(unit) if unit.dimension == Dimension::LENGTH => unit.factor,
            Some(unit) => {
                return Err(reader.wrong_at(
                    "unit",
                    format!("expected a unit of length, found {}", unit.dimension),
                    "for example `unit = \"mm\"`",
                ));
            }
            None => {
                return Err(reader.wrong_at(
                    "unit",
                    format!("there is no unit `{text}`"),
                    "for example `unit = \"mm\"`",
                ));
            }
        },
    };
    let text = read(reader, "file", file)?;
    let wrong = |line: usize, message: String| {
        let hint = format!(
            "each line holds {} numbers {}, divided by commas; the first may name the columns",
            if N == 2 { "two" } else { "three" },
            names.join(", ")
        );
        reader.wrong_at("file", format!("{file}, line {line}: {message}"), hint)
    };
    let mut points = Vec::new();
    let mut columns: [usize; N] = std::array::from_fn(|i| i);
    let mut first = true;
    for (i, line) in text.lines().enumerate() {
        let line_number = i + 1;
        let line = line.trim_start_matches('\u{feff}').trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> =
            line.split([',', ';', '\t']).map(|cell| cell.trim().trim_matches('"')).collect();
        if std::mem::take(&mut first) && cells.iter().all(|cell| cell.parse::<f64>().is_err()) {
            for (column, name) in columns.iter_mut().zip(names) {
                let Some(position) = cells.iter().position(|cell| cell.eq_ignore_ascii_case(name)) else {
                    // A column that is another coordinate is not meant for this one.
                    let others = cells
                        .iter()
                        .copied()
                        .filter(|cell| !names.iter().any(|other| cell.eq_ignore_ascii_case(other)));
                    let near =
                        nearest(name, others).map_or(String::new(), |near| format!(" (is it `{near}`?)"));
                    return Err(wrong(line_number, format!("there is no column `{name}`{near}")));
                };
                *column = position;
            }
            continue;
        }
        let mut point = [0.0; 3];
        for (coordinate, column) in point.iter_mut().zip(columns) {
            let Some(cell) = cells.get(column) else {
                return Err(wrong(line_number, format!("expected {N} numbers, found {}", cells.len())));
            };
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => *coordinate = value * scale,
                _ => {
                    return Err(wrong(
                        line_number,
                        format!("`{}` is not a finite number", cell.chars().take(40).collect::<String>()),
                    ));
                }
            }
        }
        points.push(Vector3::from(point));
        if points.len() > MOST_POINTS {
            return Err(wrong(line_number, format!("more than {MOST_POINTS} points")));
        }
    }
    if points.len() < 2 {
        return Err(wrong(
            text.lines().count(),
            format!("a curve needs at least 2 points, found {}", points.len()),
        ));
    }
    if let Some(i) = points.windows(2).position(|pair| pair[0] == pair[1]) {
        let message = format!("the points {} and {} of {file} are the same", i + 1, i + 2);
        return Err(reader.wrong_at("file", message, "consecutive points must differ"));
    }
    Ok(points)
}

/// The text of a file beside the model file, which the key at hand names.
pub(super) fn read(reader: &Reader<'_, '_>, key: &str, file: &str) -> Read<String> {
    let place = reader.entry(key).map_or(0..0, |(entry, _)| entry.node.span.clone());
    let path = reader.context.texts.folder(&place).join(file);
    let cannot = |why: String| {
        let hint = "the path is relative to the folder of the model file";
        reader.wrong_at(key, format!("cannot read `{file}`: {why}"), hint)
    };
    let reason = crate::file::reason;
    let metadata = std::fs::metadata(&path).map_err(|error| cannot(reason(&error)))?;
    if metadata.is_dir() {
        return Err(cannot("it is a directory".into()));
    }
    let mut bytes = Vec::new();
    let opened = std::fs::File::open(&path).and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes));
    opened.map_err(|error| cannot(reason(&error)))?;
    if bytes.len() as u64 > LARGEST {
        return Err(cannot(format!("it is larger than {} MiB", LARGEST >> 20)));
    }
    String::from_utf8(bytes).map_err(|_| cannot("it is not a text file".into()))
}
