//! Springs, lumped masses and loads.

use crate::context::{Needed, Read, Reported};
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Dimension;
use flexura_model::{
    Attachment, BeamId, BeamPoint, BodyId, Load, LoadFrame, LoadTarget, PointMass, Spring, SpringLaw,
};
use flexura_spatial::Vector3;

pub(super) fn spring(reader: &Reader<'_, '_>, name: String) -> Read<Spring> {
    let from = attachment(reader, "from");
    let to = attachment(reader, "to");
    let stiffness = reader.number("stiffness").needed();
    let rest_length = reader.number("rest_length");
    Ok(Spring {
        name,
        from: from?,
        to: to?,
        law: SpringLaw::Linear { stiffness: stiffness?, rest_length: rest_length? },
    })
}

fn attachment(reader: &Reader<'_, '_>, key: &str) -> Read<Attachment> {
    let table = reader.table(key).needed()?;
    match either(&table)? {
        On::Body => {
            let body = table.body("body").needed();
            let point = point(&table);
            Ok(Attachment { mount: body?, point: point? })
        }
        On::Beam => beam_point(&table).map(Attachment::on_beam),
    }
}

enum On {
    Body,
    Beam,
}

fn either(reader: &Reader<'_, '_>) -> Read<On> {
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

/// `at` on a body: a point, the origin if it is not given.
fn point(reader: &Reader<'_, '_>) -> Read<Vector3<f64>> {
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

fn beam_point(reader: &Reader<'_, '_>) -> Read<BeamPoint> {
    let beam = reader.name("beam").needed();
    let at = match reader.entry("at") {
        None => Err(reader
            .wrong_with_hint("the key `at` is missing", "it says where along the beam: `at = 1` is its end")),
        Some(_) => reader.station("at").needed(),
    };
    Ok(BeamPoint { beam: BeamId(beam?), at: at? })
}

pub(super) fn mass(reader: &Reader<'_, '_>, name: String) -> Read<PointMass> {
    let beam = reader.name("beam").needed();
    let at = reader.station("at").needed();
    let mass = reader.number("mass").needed();
    Ok(PointMass { name, point: BeamPoint { beam: BeamId(beam?), at: at? }, mass: mass? })
}

pub(super) fn load(reader: &Reader<'_, '_>, name: String) -> Read<Load> {
    let target = target(reader);
    let force = reader.vector("force");
    let moment = reader.vector("moment");
    let frame = reader.choice("frame");
    let (force, moment) = (force?, moment?);
    if force.is_none() && moment.is_none() {
        return Err(reader
            .wrong_with_hint("a load needs `force` or `moment`", "for example `force = [0, 0, \"-2 N\"]`"));
    }
    Ok(Load {
        name,
        target: target?,
        force: force.unwrap_or_else(Vector3::zeros),
        moment: moment.unwrap_or_else(Vector3::zeros),
        frame: if frame? == Some("local") { LoadFrame::Local } else { LoadFrame::Global },
    })
}

fn target(reader: &Reader<'_, '_>) -> Read<LoadTarget> {
    match either(reader)? {
        On::Body => {
            let body = reader.name("body").needed();
            let point = point(reader);
            match body {
                Ok(body) => Ok(LoadTarget::Body { body: BodyId(body), point: point? }),
                Err(Reported) => Err(Reported),
            }
        }
        On::Beam => beam_point(reader).map(LoadTarget::Beam),
    }
}
