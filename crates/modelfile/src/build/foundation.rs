//! Elastic foundations along beams.

use crate::context::{Read, Reported};
use crate::reader::Reader;
use flexura_expression::{Dimension, Kind};
use flexura_model::{At, Foundation, FoundationLaw, LoadAxes};

/// The name of the displacement in laws.
const VARIABLE: &str = "u";

pub(super) fn foundations(reader: &Reader<'_, '_>) -> Read<Vec<Foundation>> {
    let list: Vec<Read<Foundation>> = reader.tables("foundation")?.iter().map(foundation).collect();
    list.into_iter().collect()
}

fn foundation(table: &Reader<'_, '_>) -> Read<Foundation> {
    let law = law(table);
    let direction = table.direction("direction");
    let axes = table.choice("axes");
    let ends = ["from", "to"].map(|key| table.station(key));
    let (law, direction, axes) = (law?, direction?, axes?);
    if direction.is_none() {
        if matches!(law, FoundationLaw::Force(_)) {
            return Err(table.wrong_at(
                "force",
                "a force that depends on the displacement needs a direction",
                "for example `direction = [0, 1, 0]`",
            ));
        }
        if axes.is_some() {
            return Err(table.wrong_at(
                "axes",
                "without `direction` the foundation acts in all directions alike, in whatever axes",
                "give the direction, for example `direction = [0, 1, 0]`, or leave `axes` out",
            ));
        }
    }
    let [from, to] = ends;
    Ok(Foundation {
        law,
        direction,
        axes: if axes == Some("section") { LoadAxes::Section } else { LoadAxes::Global },
        between: [from?.unwrap_or(At::Fraction(0.0)), to?.unwrap_or(At::Fraction(1.0))],
    })
}

fn law(table: &Reader<'_, '_>) -> Read<FoundationLaw> {
    match (table.has("stiffness"), table.has("force")) {
        (true, false) => Ok(FoundationLaw::Linear(table.profile("stiffness")?.ok_or(Reported)?)),
        (false, true) => {
            if table.context.parameters.contains_key(VARIABLE) {
                return Err(table.wrong_at(
                    "force",
                    "`u` is the displacement here and a parameter of the model",
                    "give the parameter another name",
                ));
            }
            let Some((entry, key)) = table.entry("force") else { return Err(Reported) };
            let (path, dimension) = (table.key_path("force"), key.shape.dimension());
            let kind = Kind::Of(Dimension::LENGTH);
            table.function_in(&entry.node, &path, &dimension, VARIABLE, kind).map(FoundationLaw::Force)
        }
        (true, true) => Err(table.wrong_at(
            "force",
            "give `stiffness` or `force`, not both",
            "put the linear part into the force, as in `force = \"2e3*u + 5e7*u^3\"`, or write two foundations",
        )),
        (false, false) => Err(table.wrong_with_hint(
            "a foundation needs `stiffness` or `force`",
            "for example `stiffness = \"1 kN/m^2\"`",
        )),
    }
}
