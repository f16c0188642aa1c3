//! Cables and what they run through.

use super::place::{On, attachment, either};
use crate::context::{Needed, Read, Reported};
use crate::format::Key;
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Dimension;
use flexura_model::{BeamId, Cable, CableLaw, Guide, Profile};

pub(super) fn cable(reader: &Reader<'_, '_>, name: String) -> Read<Cable> {
    let tension = reader.number("tension");
    let length = reader.number("length");
    let route = route(reader);
    let law = match (tension?, length?) {
        (Some(tension), None) => CableLaw::Tension(tension),
        (None, Some(length)) => CableLaw::Length(length),
        (Some(_), Some(_)) => {
            return Err(reader.wrong_at(
                "length",
                "give `tension` or `length`, not both",
                "the tension of a cable of given length is found, and the other way round",
            ));
        }
        (None, None) => {
            return Err(reader.wrong_with_hint(
                "the key `tension` (or `length`) is missing",
                "for example `tension = \"10 N\"`",
            ));
        }
    };
    Ok(Cable { name, route: route?, law })
}

fn route(reader: &Reader<'_, '_>) -> Read<Vec<Guide>> {
    if !reader.has("route") {
        return Err(Reported);
    }
    let guides: Vec<Read<Guide>> = reader.tables("route")?.iter().map(guide).collect();
    guides.into_iter().collect()
}

fn guide(table: &Reader<'_, '_>) -> Read<Guide> {
    if !table.has("from") && !table.has("to") {
        if let Some((entry, _)) = table.entry("offset")
            && matches!(&entry.node.value, Value::List(list) if list.len() == 2)
            && table.has("beam")
        {
            return Err(table.wrong_at(
                "offset",
                "the offset of a point has 3 numbers, along e1, e2, e3; found 2",
                "a channel, whose offset has 2, needs `from` and `to` instead of `at`",
            ));
        }
        return attachment(table).map(Guide::Point);
    }
    if let On::Body = either(table)? {
        let key = if table.has("from") { "from" } else { "to" };
        let message = format!("`{key}` belongs to a channel, which runs along a beam");
        return Err(table.wrong_at(key, message, "on a body, name a point by `at`"));
    }
    if table.has("at") {
        let hint = "`at` makes a point, `from` and `to` make a channel";
        return Err(table.wrong_at("at", "give `at`, or `from` and `to`", hint));
    }
    let beam = table.name("beam").needed();
    let [from, to] = ["from", "to"].map(|key| match table.station(key) {
        Ok(None) => Err(table.missing_key(key)),
        Ok(Some(at)) => Ok(at),
        Err(Reported) => Err(Reported),
    });
    let offset = channel_offset(table);
    Ok(Guide::Channel { beam: BeamId(beam?), between: [from?, to?], offset: offset? })
}

fn channel_offset(table: &Reader<'_, '_>) -> Read<[Profile; 2]> {
    let Some((entry, key)) = table.entry("offset") else { return Ok([0.0, 0.0].map(Profile::from)) };
    let path = table.key_path("offset");
    let hint = "along e2 and e3, for example `offset = [\"4 mm\", 0]`";
    let Value::List(list) = &entry.node.value else {
        let message = format!("expected a list of 2 numbers, found {}", entry.node.kind());
        return Err(table.wrong_at("offset", message, hint));
    };
    let [y, z] = list.as_slice() else {
        let message = format!("the offset of a channel has 2 numbers, found {}", list.len());
        return Err(table.wrong_at("offset", message, hint));
    };
    let profile = Key {
        name: key.name,
        shape: crate::format::Shape::Profile(Dimension::LENGTH),
        need: key.need,
        doc: key.doc,
        example: "[\"4 mm\", 0]",
    };
    let y = table.profile_in(y, &format!("{path}[0]"), &profile);
    let z = table.profile_in(z, &format!("{path}[1]"), &profile);
    Ok([y?, z?])
}
