//! Springs, their laws, and what they run over.

use super::place::{attachment, frame};
use crate::context::{Needed, Read, Reported};
use crate::format::Key;
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Dimension;
use flexura_model::{ExponentialForm, Frame, Obstacle, Spring, SpringLaw, Turn, Wrap};
use flexura_spatial::{Pose, Vector3};

pub(super) fn spring(reader: &Reader<'_, '_>, name: String) -> Read<Spring> {
    let from = reader.table("from").needed().and_then(|table| attachment(&table));
    let to = reader.table("to").needed().and_then(|table| attachment(&table));
    let law = law(reader);
    let rest_length = reader.number("rest_length");
    let size = reader.number("size");
    let damping = reader.number("damping");
    let wrap = match reader.table("wrap") {
        Ok(Some(table)) => wrap(&table).map(Some),
        Ok(None) => Ok(None),
        Err(Reported) => Err(Reported),
    };
    Ok(Spring {
        name,
        from: from?,
        to: to?,
        law: law?,
        rest_length: rest_length?,
        size: size?.unwrap_or(1.0),
        damping: damping?.unwrap_or(0.0),
        wrap: wrap?,
    })
}

fn law(reader: &Reader<'_, '_>) -> Read<SpringLaw> {
    match reader.variant {
        "exponential" => {
            let area = reader.number("area").needed();
            let exponent = reader.number("exponent").needed();
            let stress = reader.number("stress").needed();
            let form = match reader.choice("form")? {
                Some("printed") => ExponentialForm::Printed,
                _ => ExponentialForm::Continuous,
            };
            Ok(SpringLaw::Exponential { area: area?, exponent: exponent?, stress: stress?, form })
        }
        "toe" => {
            let axial_stiffness = reader.number("axial_stiffness").needed();
            let toe_strain = reader.number("toe_strain").needed();
            Ok(SpringLaw::Toe { axial_stiffness: axial_stiffness?, toe_strain: toe_strain? })
        }
        "table" => Ok(SpringLaw::Table { rows: rows(reader)? }),
        _ => {
            let stiffness = reader.number("stiffness").needed();
            let tension_only = reader.flag("tension_only");
            Ok(SpringLaw::Linear { stiffness: stiffness?, tension_only: tension_only?.unwrap_or(false) })
        }
    }
}

fn rows(reader: &Reader<'_, '_>) -> Read<Vec<[f64; 2]>> {
    let Some((entry, key)) = reader.entry("rows") else { return Err(Reported) };
    let path = reader.key_path("rows");
    let Value::List(list) = &entry.node.value else {
        let message = format!("expected a list of rows, found {}", entry.node.kind());
        return Err(reader.wrong_at("rows", message, format!("for example `rows = {}`", key.example)));
    };
    let row = Key { name: "rows", shape: key.shape, need: key.need, doc: "", example: key.example };
    let dimensions = [Dimension::LENGTH, Dimension::FORCE];
    let mut result = Ok(());
    let mut rows = Vec::with_capacity(list.len());
    for (i, node) in list.iter().enumerate() {
        match reader.numbers_in(node, &format!("{path}[{i}]"), &row, &dimensions) {
            Ok(numbers) => rows.push(numbers.map(|quantity| quantity.value)),
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| rows)
}

fn wrap(table: &Reader<'_, '_>) -> Read<Wrap> {
    let sphere = table.number("sphere");
    let cylinder = table.number("cylinder");
    let axis = table.direction("axis");
    let turn = table.choice("turn");
    let (mount, pose) = frame(table)?;
    let obstacle = match (sphere?, cylinder?) {
        (Some(radius), None) => {
            if let Some(key) = ["axis", "turn"].into_iter().find(|key| table.has(key)) {
                let message = format!("`{key}` belongs to a cylinder");
                return Err(table.wrong_at(key, message, "a sphere has a radius only"));
            }
            Obstacle::Sphere { radius }
        }
        (None, Some(radius)) => Obstacle::Cylinder {
            radius,
            axis: axis?.unwrap_or_else(Vector3::z),
            turn: turn?.map(|turn| if turn == "positive" { Turn::Positive } else { Turn::Negative }),
        },
        (Some(_), Some(_)) => {
            let hint = "remove one of the two; a spring runs over one thing";
            return Err(table.wrong_at("cylinder", "give `sphere` or `cylinder`, not both", hint));
        }
        (None, None) => {
            return Err(table.wrong_with_hint(
                "the key `sphere` (or `cylinder`) is missing",
                "it gives the radius, for example `sphere = \"8 mm\"`",
            ));
        }
    };
    Ok(Wrap { frame: Frame { mount, pose: pose.unwrap_or_else(Pose::identity) }, obstacle })
}
