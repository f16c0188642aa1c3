//! Beams with their ends and distributed loads.

use super::curve::{curve, frame};
use super::foundation::foundations;
use super::joint::law;
use super::place;
use crate::context::{Needed, Read, Reported};
use crate::reader::Reader;
use crate::tree::Value;
use flexura_model::{
    At, Beam, BeamTheory, Curve, Distributed, End, LoadAxes, MaterialId, Profile, SectionId,
};

pub(super) fn beam(reader: &Reader<'_, '_>, name: String) -> Read<Beam> {
    let material = reader.name("material");
    let section = reader.name("section").needed();
    let curve = shape(reader);
    let frame = frame(reader);
    let start = end(reader, "start", &name);
    let end = end(reader, "end", &name);
    let shear = reader.flag("shear");
    let extension = reader.flag("extension");
    let damping = reader.number("damping");
    let added_mass = reader.number("added_mass");
    let distributed = distributed(reader);
    let foundation = foundations(reader);
    Ok(Beam {
        name,
        material: material?.map(MaterialId),
        section: SectionId(section?),
        curve: curve?,
        frame: frame?,
        theory: BeamTheory { shear: shear?.unwrap_or(false), extension: extension?.unwrap_or(true) },
        damping: damping?.unwrap_or(0.0),
        added_mass: added_mass?.unwrap_or(0.0),
        start: start?,
        end: end?,
        distributed: distributed?,
        foundation: foundation?,
    })
}

fn shape(reader: &Reader<'_, '_>) -> Read<Curve> {
    let length = reader.number("length");
    let table = reader.table("curve")?;
    match (length?, table) {
        (Some(length), None) => Ok(Curve::Straight { length }),
        (None, Some(table)) => curve(&table),
        (None, None) => Err(reader.wrong_with_hint(
            "the key `length` (or `curve`) is missing",
            "for example `length = \"152.4 mm\"`",
        )),
        (Some(_), Some(table)) => {
            let hint = match table.variant {
                "curvature" => "give the length within `curve`",
                _ => "the curve has its own length; `length` makes a straight beam",
            };
            Err(reader.wrong_at("length", "give `length` or `curve`, not both", hint))
        }
    }
}

fn end(reader: &Reader<'_, '_>, key: &str, beam: &str) -> Read<Option<End>> {
    let Some(table) = reader.table(key)? else { return Ok(None) };
    let frame = place::frame(&table);
    let hold = law(&table);
    if let Some((entry, _)) = table.entry("beam")
        && matches!(&entry.node.value, Value::Text(name) if name == beam)
    {
        return Err(table.wrong_at(
            "beam",
            "a beam cannot hold its own end",
            "name another beam, or a body; a joint may connect two places of one beam",
        ));
    }
    let (mount, placement) = frame?;
    Ok(Some(End { mount, placement, hold: hold? }))
}

fn distributed(reader: &Reader<'_, '_>) -> Read<Vec<Distributed>> {
    let mut loads = Vec::new();
    let mut result = Ok(());
    for table in reader.tables("distributed")? {
        match one(&table) {
            Ok(load) => loads.push(load),
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| loads)
}

fn one(table: &Reader<'_, '_>) -> Read<Distributed> {
    let force = table.profiles("force");
    let moment = table.profiles("moment");
    let axes = table.choice("frame");
    let [from, to] = ["from", "to"].map(|key| table.station(key));
    let (force, moment) = (force?, moment?);
    if force.is_none() && moment.is_none() {
        return Err(table.wrong_with_hint(
            "a distributed load needs `force` or `moment`",
            "for example `force = [0, 0, \"-2 N/m\"]`",
        ));
    }
    let none = || [0.0; 3].map(Profile::from);
    Ok(Distributed {
        force: force.unwrap_or_else(none),
        moment: moment.unwrap_or_else(none),
        axes: if axes? == Some("section") { LoadAxes::Section } else { LoadAxes::Global },
        between: [from?.unwrap_or(At::Fraction(0.0)), to?.unwrap_or(At::Fraction(1.0))],
    })
}
