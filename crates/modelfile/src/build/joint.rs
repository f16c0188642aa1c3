//! Joints, and their laws, which the holds of beam ends have too.

use super::contact;
use super::place::frame;
use super::surface;
use crate::context::{Needed, Read, Reported};
use crate::format::Shape;
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Formula;
use flexura_model::{
    ALMOST_RIGHT, CoordinateLaw, Drive, Frame, Joint, JointKind, JointLaw, Limits, Mount, Rule,
};
use flexura_spatial::{Pose, Vector3};

pub(super) fn joint(reader: &Reader<'_, '_>, name: String) -> Read<Joint> {
    let parent = placed(reader, "parent");
    let child = placed(reader, "child");
    let law = law(reader);
    let ((parent, parent_pose), (child, child_pose)) = (parent?, child?);
    if parent == child {
        let (message, hint) = match parent {
            Mount::Beam(_) => (
                "a joint must connect two different places",
                "name another beam, body or place along the beam",
            ),
            _ => ("a joint must connect two different bodies", "name another body"),
        };
        return Err(reader.wrong_at("child", message, hint));
    }
    let parent = Frame { mount: parent, pose: parent_pose.unwrap_or_else(Pose::identity) };
    let law = law?;
    // What touches is given in the child's own axes.
    let child_pose = child_pose.or_else(|| law.contact.as_ref().map(|_| Pose::identity()));
    Ok(Joint { name, parent, child, child_pose, law })
}

/// The name of a body, or a table that also says where on it, or on which beam.
fn placed(reader: &Reader<'_, '_>, key: &str) -> Read<(Mount, Option<Pose>)> {
    let (entry, format) = reader.entry(key).ok_or(Reported)?;
    let path = reader.key_path(key);
    let Shape::Placed(table) = format.shape else { return Err(Reported) };
    match &entry.node.value {
        Value::Text(text) => Ok((reader.body_in(&entry.node, &path, text)?, None)),
        Value::Table(_) => frame(&Reader::open(reader.context, entry, table, &path)?),
        _ => {
            let message = format!("expected {}, found {}", format.shape.describe(), entry.node.kind());
            Err(reader.context.wrong_with_hint(
                &entry.node.span,
                &path,
                message,
                format!("for example `{key} = {}`", format.example),
            ))
        }
    }
}

/// The law of a joint or of a beam's hold; the table's variant is its kind.
pub(super) fn law(reader: &Reader<'_, '_>) -> Read<JointLaw> {
    match reader.variant {
        "weld" | "clamp" => Ok(JointLaw::weld()),
        "revolute" => one_coordinate(reader, JointKind::Revolute),
        "prismatic" => one_coordinate(reader, JointKind::Prismatic),
        "spherical" | "pin" => {
            let coordinates = rotation_vector(reader)?;
            Ok(JointLaw { coordinates, ..JointLaw::free(JointKind::Spherical, Vector3::x()) })
        }
        "cylindrical" => {
            let axis = reader.direction("axis").needed();
            bind_second(reader, "second_axis", axis.as_ref().unwrap_or(&Vector3::x()), None);
            let coordinates = coordinates(reader, JointKind::Cylindrical);
            Ok(JointLaw { coordinates: coordinates?, ..JointLaw::free(JointKind::Cylindrical, axis?) })
        }
        "universal" => two_axes(reader, JointKind::Universal, "second_axis"),
        "planar" => two_axes(reader, JointKind::Planar, "x_axis"),
        "free" => free(reader),
        "rolling" => contact::rolling(reader),
        "contact" => surface::touching(reader),
        _ => Err(Reported),
    }
}

fn one_coordinate(reader: &Reader<'_, '_>, kind: JointKind) -> Read<JointLaw> {
    let axis = reader.direction("axis").needed();
    bind_second(reader, "second_axis", axis.as_ref().unwrap_or(&Vector3::x()), None);
    let law = coordinate(reader);
    Ok(JointLaw { coordinates: vec![law?], ..JointLaw::free(kind, axis?) })
}

/// A joint with a second axis across the first; where it is not given, the model chooses one.
fn two_axes(reader: &Reader<'_, '_>, kind: JointKind, second: &str) -> Read<JointLaw> {
    let axis = reader.direction("axis").needed();
    let coordinates = coordinates(reader, kind);
    across_axis(reader, kind, axis?, second, coordinates)
}

/// The law of a kind whose second axis is at right angles to the first.
pub(super) fn across_axis(
    reader: &Reader<'_, '_>,
    kind: JointKind,
    axis: Vector3<f64>,
    second: &str,
    coordinates: Read<Vec<CoordinateLaw>>,
) -> Read<JointLaw> {
    let across = reader.direction(second)?;
    bind_second(reader, second, &axis, across.as_ref());
    let mut law = JointLaw { coordinates: coordinates?, ..JointLaw::free(kind, axis) };
    if let Some(across) = across {
        let cosine = axis.dot(&across);
        if cosine.abs() > ALMOST_RIGHT {
            let angle = cosine.clamp(-1.0, 1.0).acos().to_degrees();
            let message =
                format!("`{second}` must be at right angles to `axis`, but the angle is {angle:.1} deg");
            let right = across - axis * cosine;
            let hint = if right.norm() < 1e-6 {
                "it must not run along `axis`".to_string()
            } else {
                let [x, y, z] = <[f64; 3]>::from(right / right.amax()).map(short);
                format!("the nearest direction at right angles is [{x}, {y}, {z}]")
            };
            return Err(reader.wrong_at(second, message, hint));
        }
        law.second_axis = (across - axis * cosine).normalize();
    } else if reader.keys().iter().any(|key| key.name == second && key.need == crate::format::Need::Required)
    {
        return Err(Reported);
    }
    Ok(law)
}

/// The rule of a second axis, which follows the first: that under the key and what it is given as, or the one that the model chooses.
fn bind_second(reader: &Reader<'_, '_>, key: &str, first: &Vector3<f64>, near: Option<&Vector3<f64>>) {
    let rules = &reader.context.rules;
    let axis = rules.direction(&reader.key_path("axis"));
    let path = reader.key_path(key);
    let constants = |vector: &Vector3<f64>| <[f64; 3]>::from(*vector).map(Formula::constant);
    let near_formulas = near.and_then(|_| rules.take_direction(&path));
    if axis.is_none() && near_formulas.is_none() {
        return;
    }
    let axis = axis.unwrap_or_else(|| constants(first));
    let near = near.map(|near| near_formulas.unwrap_or_else(|| constants(near)));
    rules.put(path, Rule::Across { axis, near });
}

/// A number to four decimals, without needless zeros.
fn short(value: f64) -> f64 {
    // Adding zero makes -0 a plain 0.
    (value * 1e4).round() / 1e4 + 0.0
}

fn free(reader: &Reader<'_, '_>) -> Read<JointLaw> {
    let mut laws = Vec::new();
    let mut result = Ok(());
    for name in ["x", "y", "z"] {
        match sub_coordinate(reader, name) {
            Ok(law) => laws.push(law),
            Err(Reported) => result = Err(Reported),
        }
    }
    // In the hold of a beam's end `rotation` is that of the fixed frame.
    let name = if reader.keys().iter().any(|key| key.name == "turning") { "turning" } else { "rotation" };
    match reader.table(name)? {
        Some(table) => laws.extend(rotation_vector(&table)?),
        None => laws.extend([CoordinateLaw::default(); 3]),
    }
    result?;
    Ok(JointLaw { coordinates: laws, ..JointLaw::free(JointKind::Free, Vector3::x()) })
}

/// Each coordinate's own table, by the names that the kind gives them.
fn coordinates(reader: &Reader<'_, '_>, kind: JointKind) -> Read<Vec<CoordinateLaw>> {
    let each: Vec<Read<CoordinateLaw>> =
        kind.coordinate_names().iter().map(|name| sub_coordinate(reader, name)).collect();
    each.into_iter().collect()
}

fn sub_coordinate(reader: &Reader<'_, '_>, name: &str) -> Read<CoordinateLaw> {
    match reader.table(name)? {
        Some(table) => coordinate(&table),
        None => Ok(CoordinateLaw::default()),
    }
}

const BOTH: &str = "a driven coordinate finds its own effort";

/// What acts on one coordinate.
pub(super) fn coordinate(reader: &Reader<'_, '_>) -> Read<CoordinateLaw> {
    let coordinate = reader.number("coordinate");
    let effort = reader.number("effort");
    let stiffness = reader.number("stiffness");
    let rest = reader.number("rest");
    let damping = reader.number("damping");
    let limits = limits(reader);
    let (coordinate, effort) = (coordinate?, effort?);
    let drive = match (coordinate, effort) {
        (Some(_), Some(_)) => {
            return Err(reader.wrong_at("effort", "give `coordinate` or `effort`, not both", BOTH));
        }
        (Some(coordinate), None) => Drive::Driven { coordinate },
        (None, effort) => Drive::Free { effort: effort.unwrap_or(0.0) },
    };
    let (stiffness, rest) = (stiffness?, rest?);
    useless_rest(reader, stiffness, rest.is_some())?;
    Ok(CoordinateLaw {
        drive,
        stiffness: stiffness.unwrap_or(0.0),
        rest: rest.unwrap_or(0.0),
        damping: damping?.unwrap_or(0.0),
        limits: limits?,
    })
}

/// What acts on the three components of a rotation vector.
pub(super) fn rotation_vector(reader: &Reader<'_, '_>) -> Read<Vec<CoordinateLaw>> {
    let coordinate = reader.vector("coordinate");
    let effort = reader.vector("effort");
    let stiffness = reader.number("stiffness");
    let rest = reader.vector("rest");
    let damping = reader.number("damping")?;
    let (coordinate, effort, stiffness, rest) = (coordinate?, effort?, stiffness?, rest?);
    if coordinate.is_some() && effort.is_some() {
        return Err(reader.wrong_at("effort", "give `coordinate` or `effort`, not both", BOTH));
    }
    useless_rest(reader, stiffness, rest.is_some())?;
    let law = |k: usize| CoordinateLaw {
        drive: match coordinate {
            Some(coordinate) => Drive::Driven { coordinate: coordinate[k] },
            None => Drive::Free { effort: effort.map_or(0.0, |effort| effort[k]) },
        },
        stiffness: stiffness.unwrap_or(0.0),
        rest: rest.map_or(0.0, |rest| rest[k]),
        damping: damping.unwrap_or(0.0),
        limits: None,
    };
    Ok((0..3).map(law).collect())
}

fn useless_rest(reader: &Reader<'_, '_>, stiffness: Option<f64>, rest: bool) -> Read<()> {
    if rest && stiffness.is_none() {
        return Err(reader.wrong_at(
            "rest",
            "`rest` says where a spring is relaxed, but there is no `stiffness`",
            "give `stiffness`, or remove `rest`",
        ));
    }
    Ok(())
}

fn limits(reader: &Reader<'_, '_>) -> Read<Option<Limits>> {
    let Some(table) = reader.table("limits")? else { return Ok(None) };
    let range = table.numbers::<2>("range").needed();
    let stiffness = table.number("stiffness");
    Ok(Some(Limits { range: range?.map(|quantity| quantity.value), stiffness: stiffness? }))
}
