//! What rolls and slides on what.

use super::curve::{from_file, parametric};
use super::joint::{across_axis, coordinate};
use crate::context::{Needed, Read, Reported};
use crate::format::{Key, Need, Shape};
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::{Dimension, Function, Kind, Quantity};
use flexura_model::{
    Boundary, BoundaryCurve, Contact, CoordinateLaw, Curve, JointKind, JointLaw, Rolling, RollingCoordinate,
    Side, Slide,
};
use flexura_spatial::Vector3;

/// The coordinate's name in expressions.
const VARIABLE: &str = "q";

pub(super) fn rolling(reader: &Reader<'_, '_>) -> Read<JointLaw> {
    let by = match reader.choice("by")? {
        Some("turning") => RollingCoordinate::Turning,
        Some("arc") => RollingCoordinate::Arc,
        _ => RollingCoordinate::Angle,
    };
    let axis = reader.direction("axis");
    let coordinate = coordinate_of(reader, by);
    let curves = ["child_curve", "parent_curve"].map(|key| match reader.table(key) {
        Ok(Some(table)) => boundary(&table),
        // A missing curve was recorded on opening the joint's table.
        Ok(None) | Err(Reported) => Err(Reported),
    });
    let slide = slide(reader, by);
    let (concave, close) = (reader.flag("concave"), reader.flag("close"));
    let axis = axis?.unwrap_or_else(Vector3::z);
    let law = across_axis(reader, JointKind::Rolling(by), axis, "x_axis", coordinate.map(|law| vec![law]));
    let [child, parent] = curves;
    let (child, parent) = (child?, parent?);
    let start = start(reader, [&child, &parent])?;
    let rolling = Rolling {
        child,
        parent,
        concave: concave?.unwrap_or(false),
        start,
        slide: slide?,
        close: close?.unwrap_or(false),
    };
    Ok(JointLaw { contact: Some(Box::new(Contact::Rolling(rolling))), ..law? })
}

/// What acts on the coordinate: in the joint's own table for an angle, in `arc` for an arc.
fn coordinate_of(reader: &Reader<'_, '_>, by: RollingCoordinate) -> Read<CoordinateLaw> {
    if by != RollingCoordinate::Arc {
        if reader.has("arc") {
            let message = "the coordinate is an angle, so `arc` has no use";
            return Err(reader.wrong_at(
                "arc",
                message,
                "write its keys into the joint's own table, or add `by = \"arc\"`",
            ));
        }
        return coordinate(reader);
    }
    if let Some(key) =
        ["coordinate", "effort", "stiffness", "rest", "limits"].into_iter().find(|key| reader.has(key))
    {
        let message = format!("the coordinate is an arc, so `{key}` is out of place here");
        return Err(reader.wrong_at(
            key,
            message,
            format!("write it into the table: `arc = {{ {key} = ... }}`"),
        ));
    }
    match reader.table("arc")? {
        Some(table) => coordinate(&table),
        None => Ok(CoordinateLaw::default()),
    }
}

fn boundary(reader: &Reader<'_, '_>) -> Read<Boundary> {
    let two = |key: &str| -> Read<Option<[f64; 2]>> {
        Ok(reader.numbers::<2>(key)?.map(|numbers| numbers.map(|quantity| quantity.value)))
    };
    let outside = match reader.keys().iter().any(|key| key.name == "outside") {
        true => reader.choice("outside")?.map(|word| if word == "left" { Side::Left } else { Side::Right }),
        false => None,
    };
    let curve = match reader.variant {
        "ellipse" => {
            let (semi_axes, range) = (two("semi_axes").needed(), two("range"));
            BoundaryCurve::Ellipse { semi_axes: semi_axes?, range: range? }
        }
        "circle" => {
            let (radius, range) = (reader.number("radius").needed(), two("range"));
            let radius = radius?;
            let both = [0, 1].map(|i| reader.key_path(&format!("semi_axes[{i}]")));
            reader.context.rules.rename(&reader.key_path("radius"), &both);
            BoundaryCurve::Ellipse { semi_axes: [radius; 2], range: range? }
        }
        "line" => {
            let (point, normal, range) = (two("point"), two("normal").needed(), two("range"));
            BoundaryCurve::Line { point: point?.unwrap_or([0.0; 2]), normal: normal?, range: range? }
        }
        "arcs" => {
            let (point, direction) = (two("point"), two("direction"));
            let arcs = pairs(reader, "arcs", [Dimension::LENGTH, Dimension::ANGLE])?;
            BoundaryCurve::Arcs {
                point: point?.unwrap_or([0.0; 2]),
                direction: direction?.unwrap_or([1.0, 0.0]),
                arcs,
            }
        }
        "points" => {
            let closed = reader.flag("closed");
            BoundaryCurve::Points { points: plane_points(reader)?, closed: closed?.unwrap_or(true) }
        }
        "expression" => {
            let closed = reader.flag("closed");
            let Curve::Parametric { position: [x, y, _], range } = parametric(reader)? else {
                return Err(Reported);
            };
            BoundaryCurve::Expression { position: [x, y], range, closed: closed?.unwrap_or(false) }
        }
        _ => return Err(Reported),
    };
    Ok(Boundary { curve, outside })
}

fn plane_points(reader: &Reader<'_, '_>) -> Read<Vec<[f64; 2]>> {
    match (reader.has("points"), reader.text("file")?) {
        (true, None) => {
            if reader.has("unit") {
                let message = "`unit` is for the numbers of a file";
                return Err(reader.wrong_at(
                    "unit",
                    message,
                    "write the unit behind each number, or use a file",
                ));
            }
            pairs(reader, "points", [Dimension::LENGTH; 2])
        }
        (false, Some(file)) => {
            Ok(from_file(reader, file, ["x", "y"])?.into_iter().map(|point| [point.x, point.y]).collect())
        }
        (false, None) => Err(reader.wrong_with_hint(
            "the key `points` (or `file`) is missing",
            "for example `file = \"outline.csv\"`",
        )),
        (true, Some(_)) => {
            Err(reader.wrong_at("file", "give `points` or `file`, not both", "remove one of the two"))
        }
    }
}

/// Rows of two numbers.
pub(super) fn pairs(reader: &Reader<'_, '_>, name: &str, dimensions: [Dimension; 2]) -> Read<Vec<[f64; 2]>> {
    let (entry, key) = reader.entry(name).ok_or(Reported)?;
    let path = reader.key_path(name);
    let Value::List(list) = &entry.node.value else {
        let message = format!("expected {}, found {}", key.shape.describe(), entry.node.kind());
        let hint = format!("for example `{name} = {}`", key.example);
        return Err(reader.context.wrong_with_hint(&entry.node.span, &path, message, hint));
    };
    let row_key = Key {
        name: key.name,
        shape: Shape::Range(Dimension::LENGTH),
        need: Need::Required,
        doc: "",
        example: key.example,
    };
    let mut rows = Vec::with_capacity(list.len());
    let mut result = Ok(());
    for (i, row) in list.iter().enumerate() {
        match reader.numbers_in(row, &format!("{path}[{i}]"), &row_key, &dimensions) {
            Ok(numbers) => rows.push(numbers.map(|quantity| quantity.value)),
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| rows)
}

/// The dimension of a curve's parameter; None where it is whatever the user made it.
fn parameter_dimension(curve: &BoundaryCurve) -> Option<Dimension> {
    match curve {
        BoundaryCurve::Ellipse { .. } => Some(Dimension::ANGLE),
        BoundaryCurve::Line { .. } | BoundaryCurve::Arcs { .. } | BoundaryCurve::Points { .. } => {
            Some(Dimension::LENGTH)
        }
        BoundaryCurve::Expression { .. } => None,
    }
}

fn start(reader: &Reader<'_, '_>, curves: [&Boundary; 2]) -> Read<Option<[f64; 2]>> {
    let Some((entry, key)) = reader.entry("start") else { return Ok(None) };
    let path = reader.key_path("start");
    let list = reader.list_of(&entry.node, &path, key, 2)?;
    let mut values = [0.0; 2];
    for (i, (node, boundary)) in list.iter().zip(curves).enumerate() {
        let path = format!("{path}[{i}]");
        let wrong = |message: String| {
            let hint = format!("for example `start = {}`", key.example);
            reader.context.wrong_with_hint(&node.span, &path, message, hint)
        };
        let quantity: Quantity = reader
            .context
            .quantity(node, &path, false)?
            .ok_or_else(|| wrong(format!("expected a number, found {}", node.kind())))?;
        if let (Some(wanted), Kind::Of(found)) = (parameter_dimension(&boundary.curve), quantity.kind)
            && !found.agrees(&wanted)
        {
            return Err(wrong(format!("the curve's parameter is {wanted}, found {found}")));
        }
        values[i] = quantity.value;
    }
    Ok(Some(values))
}

fn slide(reader: &Reader<'_, '_>, by: RollingCoordinate) -> Read<Slide> {
    let Some(table) = reader.table("slide")? else { return Ok(Slide::None) };
    let dimension = if by == RollingCoordinate::Arc { Dimension::LENGTH } else { Dimension::ANGLE };
    let function = |key: &str| -> Read<Function> {
        let (entry, format) = table.entry(key).ok_or(Reported)?;
        let path = table.key_path(key);
        table.function_in(&entry.node, &path, &format.shape.dimension(), VARIABLE, Kind::Of(dimension))
    };
    match table.variant {
        "none" => Ok(Slide::None),
        "pure" => Ok(Slide::Pure),
        "velocity" => {
            let (velocity, rate) = (table.number("velocity").needed(), table.number("rate").needed());
            Ok(Slide::Velocity { velocity: velocity?, rate: rate? })
        }
        "ratio" => Ok(Slide::Ratio { ratio: table.number("ratio").needed()? }),
        "law" => Ok(Slide::Function(function("slide")?)),
        "table" => Ok(Slide::Table(pairs(&table, "rows", [dimension, Dimension::LENGTH])?)),
        "measured" => {
            let (roll, slide) = (function("roll"), function("slide"));
            Ok(Slide::Measured { roll: roll?, slide: slide? })
        }
        "stepped" => Ok(Slide::Stepped { step: table.number("step").needed()? }),
        _ => Err(Reported),
    }
}
