//! Places: what carries something, a body or the section of a beam, and where on it.

use super::body::rotation;
use crate::context::{Needed, Read};
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Dimension;
use flexura_model::{Attachment, BeamId, BeamPoint, Mount};
use flexura_spatial::{Pose, Vector3};

pub(super) enum On {
    Body,
    Beam,
}

pub(super) fn either(reader: &Reader<'_, '_>) -> Read<On> {
    match (reader.has("body"), reader.has("beam")) {
        (true, false) => Ok(On::Body),
        (false, true) => Ok(On::Beam),
        (true, true) => {
            Err(reader.wrong_at("beam", "give `body` or `beam`, not both", "remove one of the two"))
        }
        (false, false) => Err(reader
            .wrong_with_hint("the key `body` (or `beam`) is missing", "for example `body = \"slider\"`")),
    }
}

/// A frame: what carries it, and its pose there; None where nothing but the carrier is given.
pub(super) fn frame(table: &Reader<'_, '_>) -> Read<(Mount, Option<Pose>)> {
    let rotation = rotation(table);
    let (mount, origin) = carrier(table)?;
    let placed = origin.is_some() || table.has("rotation");
    let pose = Pose::new(rotation?, origin.unwrap_or_else(Vector3::zeros));
    Ok((mount, placed.then_some(pose)))
}

/// A point, the origin of what carries it unless given.
pub(super) fn attachment(table: &Reader<'_, '_>) -> Read<Attachment> {
    let (mount, point) = carrier(table)?;
    Ok(Attachment { mount, point: point.unwrap_or_else(Vector3::zeros) })
}

/// What carries the thing, and the point on it if that is given.
fn carrier(table: &Reader<'_, '_>) -> Read<(Mount, Option<Vector3<f64>>)> {
    match either(table)? {
        On::Body => {
            let body = table.body("body").needed();
            if table.has("offset") {
                let hint = "on a body the point is `at`, in the body's axes";
                return Err(table.wrong_at("offset", "`offset` is for a place on a beam", hint));
            }
            let at = if table.has("at") { point(table).map(Some) } else { Ok(None) };
            Ok((body?, at?))
        }
        On::Beam => {
            let point = beam_point(table);
            let offset = table.vector("offset");
            Ok((Mount::Beam(point?), offset?))
        }
    }
}

/// `at` on a body: a point, the origin if it is not given.
pub(super) fn point(reader: &Reader<'_, '_>) -> Read<Vector3<f64>> {
    let Some((entry, key)) = reader.entry("at") else { return Ok(Vector3::zeros()) };
    let path = reader.key_path("at");
    if !matches!(entry.node.value, Value::List(_)) {
        let message = format!("on a body, `at` is a point: expected 3 numbers, found {}", entry.node.kind());
        return Err(reader.context.wrong_with_hint(
            &entry.node.span,
            &path,
            message,
            "for example `at = [\"20 mm\", 0, 0]`",
        ));
    }
    let numbers = reader.numbers_in(&entry.node, &path, key, &[Dimension::LENGTH; 3])?;
    Ok(Vector3::from(numbers.map(|quantity| quantity.value)))
}

pub(super) fn beam_point(reader: &Reader<'_, '_>) -> Read<BeamPoint> {
    let beam = reader.name("beam").needed();
    let at = match reader.entry("at") {
        None => Err(reader
            .wrong_with_hint("the key `at` is missing", "it says where along the beam: `at = 1` is its end")),
        Some((entry, _)) if matches!(entry.node.value, Value::List(_)) => Err(reader.wrong_at(
            "at",
            "on a beam, `at` is a place along it: expected a number, found a list",
            "for example `at = 0.5`; a point of the section is `offset = [0, \"2 mm\", 0]`",
        )),
        Some(_) => reader.station("at").needed(),
    };
    Ok(BeamPoint { beam: BeamId(beam?), at: at? })
}
