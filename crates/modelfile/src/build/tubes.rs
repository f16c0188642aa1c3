//! Concentric tubes.

use super::body::rotation;
use crate::context::{Needed, Read, Reported};
use crate::format::Shape;
use crate::reader::Reader;
use crate::tree::Value;
use flexura_model::{Frame, MaterialId, Rule, SectionId, Tube, Tubes};
use flexura_spatial::{Pose, Vector3};

pub(super) fn tubes(reader: &Reader<'_, '_>, name: String) -> Read<Tubes> {
    let base = base(reader);
    let tubes = list(reader);
    let force = reader.vector("force");
    let moment = reader.vector("moment");
    Ok(Tubes {
        name,
        base: base?,
        tubes: tubes?,
        force: force?.unwrap_or_else(Vector3::zeros),
        moment: moment?.unwrap_or_else(Vector3::zeros),
    })
}

/// The name of a body, or a table that also says where on it.
fn base(reader: &Reader<'_, '_>) -> Read<Frame> {
    let (entry, format) = reader.entry("base").ok_or(Reported)?;
    let path = reader.key_path("base");
    let Shape::Placed(table) = format.shape else { return Err(Reported) };
    match &entry.node.value {
        Value::Text(text) => {
            let mount = reader.body_in(&entry.node, &path, text)?;
            Ok(Frame { mount, pose: Pose::identity() })
        }
        Value::Table(_) => {
            if let Some(beam) = entry.node.get("beam") {
                return Err(reader.context.wrong_with_hint(
                    &beam.node.span,
                    &format!("{path}.beam"),
                    "the guide of tubes is on a body or on the ground, not on a beam",
                    "for example `body = \"ground\"`",
                ));
            }
            let table = Reader::open(reader.context, entry, table, &path)?;
            let mount = table.body("body").needed();
            let at = table.vector("at");
            let rotation = rotation(&table);
            let origin = at?.unwrap_or_else(Vector3::zeros);
            Ok(Frame { mount: mount?, pose: Pose::new(rotation?, origin) })
        }
        _ => {
            let message = format!("expected {}, found {}", format.shape.describe(), entry.node.kind());
            Err(reader.wrong_at("base", message, format!("for example `base = {}`", format.example)))
        }
    }
}

fn list(reader: &Reader<'_, '_>) -> Read<Vec<Tube>> {
    if !reader.has("tube") {
        return Err(Reported);
    }
    let tubes: Vec<Read<Tube>> = reader.tables("tube")?.iter().map(tube).collect();
    tubes.into_iter().collect()
}

fn tube(table: &Reader<'_, '_>) -> Read<Tube> {
    let material = table.name("material");
    let section = table.name("section").needed();
    let [straight, curved] = ["straight", "curved"].map(|key| table.number(key));
    let curvature = curvature(table);
    let [rotation, translation] = ["rotation", "translation"].map(|key| table.number(key));
    Ok(Tube {
        material: material?.map(MaterialId),
        section: SectionId(section?),
        straight: straight?.unwrap_or(0.0),
        curved: curved?.unwrap_or(0.0),
        curvature: curvature?,
        rotation: rotation?.unwrap_or(0.0),
        translation: translation?.unwrap_or(0.0),
    })
}

fn curvature(table: &Reader<'_, '_>) -> Read<f64> {
    let radius = table.number("radius");
    let curvature = table.number("curvature");
    let (radius, curvature) = (radius?, curvature?);
    let key = if radius.is_some() { "radius" } else { "curvature" };
    if (radius.is_some() || curvature.is_some()) && !table.has("curved") {
        let message = format!("`{key}` is that of the curved part, but there is no `curved`");
        return Err(table.wrong_at(key, message, "give its length, for example `curved = \"60 mm\"`"));
    }
    match (radius, curvature) {
        (Some(_), Some(_)) => Err(table.wrong_at(
            "curvature",
            "give `radius` or `curvature`, not both",
            "one follows from the other: curvature = 1/radius",
        )),
        (Some(radius), None) if radius <= 0.0 => Err(table.wrong_at(
            "radius",
            format!("must be positive, is {radius}"),
            "to bend the other way, turn the tube by `rotation = \"180 deg\"`",
        )),
        (Some(radius), None) => {
            let rules = &table.context.rules;
            if let Some([formula]) = rules.join([table.key_path("radius")], [radius]) {
                rules.put(table.key_path("curvature"), Rule::Reciprocal(formula));
            }
            Ok(1.0 / radius)
        }
        (None, curvature) => Ok(curvature.unwrap_or(0.0)),
    }
}
