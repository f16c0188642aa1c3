//! Bodies, poses on them, joints and their laws.

use crate::context::{Needed, Read, Reported};
use crate::format::Shape;
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::Dimension;
use flexura_model::{Body, CoordinateLaw, Drive, Frame, Joint, JointKind, JointLaw, Limits, Mount};
use flexura_spatial::{Matrix3, Pose, Quaternion, UnitQuaternion, Vector3, exp};

pub(super) fn body(reader: &Reader<'_, '_>, name: String) -> Read<Body> {
    let pose = pose(reader);
    let mass = reader.number("mass");
    let center_of_mass = reader.vector("center_of_mass");
    let inertia = inertia(reader);
    Ok(Body {
        name,
        pose: pose?,
        mass: mass?.unwrap_or(0.0),
        center_of_mass: center_of_mass?.unwrap_or_else(Vector3::zeros),
        inertia: inertia?,
    })
}

fn inertia(reader: &Reader<'_, '_>) -> Read<Matrix3<f64>> {
    let Some((entry, key)) = reader.entry("inertia") else { return Ok(Matrix3::zeros()) };
    let path = reader.key_path("inertia");
    let rows = match &entry.node.value {
        Value::List(rows)
            if rows.len() == 3 && rows.iter().all(|row| matches!(row.value, Value::List(_))) =>
        {
            rows
        }
        _ => {
            let numbers = reader.numbers_in(&entry.node, &path, key, &[Dimension::INERTIA; 3])?;
            return Ok(Matrix3::from_diagonal(&Vector3::from(numbers.map(|quantity| quantity.value))));
        }
    };
    let mut matrix = Matrix3::zeros();
    let mut result = Ok(());
    for (i, row) in rows.iter().enumerate() {
        match reader.numbers_in(row, &format!("{path}[{i}]"), key, &[Dimension::INERTIA; 3]) {
            Ok(numbers) => {
                numbers.iter().enumerate().for_each(|(j, quantity)| matrix[(i, j)] = quantity.value)
            }
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| matrix)
}

/// `at` and `rotation` of a table; what is not given is zero.
pub(super) fn pose(reader: &Reader<'_, '_>) -> Read<Pose> {
    let at = reader.vector("at");
    let rotation = rotation(reader);
    Ok(Pose::new(rotation?, at?.unwrap_or_else(Vector3::zeros)))
}

fn rotation(reader: &Reader<'_, '_>) -> Read<UnitQuaternion<f64>> {
    let Some(table) = reader.table("rotation")? else { return Ok(UnitQuaternion::identity()) };
    let axis = table.direction("axis");
    let angle = table.number("angle");
    let quaternion = table.numbers::<4>("quat_wxyz");
    let rpy = table.vector("rpy");
    match (axis?, angle?, quaternion?, rpy?) {
        (Some(axis), Some(angle), None, None) => Ok(exp(&(axis * angle))),
        (None, None, Some(wxyz), None) => {
            let [w, x, y, z] = wxyz.map(|quantity| quantity.value);
            let quaternion = Quaternion::new(w, x, y, z);
            let norm = quaternion.norm();
            // Printed quaternions are rounded; anything further off is a mistake.
            if norm.is_nan() || (norm - 1.0).abs() > 1e-3 {
                let message = format!("a quaternion must have length 1, this one has {norm}");
                return Err(table.wrong_at(
                    "quat_wxyz",
                    message,
                    "the order is w, x, y, z; no turn is [1, 0, 0, 0]",
                ));
            }
            Ok(UnitQuaternion::from_quaternion(quaternion))
        }
        (None, None, None, Some(rpy)) => {
            Ok(exp(&(Vector3::z() * rpy.z)) * exp(&(Vector3::y() * rpy.y)) * exp(&(Vector3::x() * rpy.x)))
        }
        (Some(_), None, None, None) => Err(table.missing_key("angle")),
        (None, Some(_), None, None) => Err(table.missing_key("axis")),
        (None, None, None, None) => Err(table
            .wrong_with_hint("the rotation is empty", "give `axis` and `angle`, or `quat_wxyz`, or `rpy`")),
        _ => Err(table.wrong_with_hint(
            "the rotation is given in more than one way",
            "give `axis` and `angle`, or `quat_wxyz`, or `rpy`",
        )),
    }
}

pub(super) fn joint(reader: &Reader<'_, '_>, name: String) -> Read<Joint> {
    let parent = placed(reader, "parent");
    let child = placed(reader, "child");
    let law = law(reader);
    let ((parent, parent_pose), (child, child_pose)) = (parent?, child?);
    if parent == child {
        return Err(reader.wrong_at(
            "child",
            "a joint must connect two different bodies",
            "name another body",
        ));
    }
    let parent = Frame { mount: parent, pose: parent_pose.unwrap_or_else(Pose::identity) };
    Ok(Joint { name, parent, child, child_pose, law: law? })
}

/// The name of a body, or a table that also says where on it.
fn placed(reader: &Reader<'_, '_>, key: &str) -> Read<(Mount, Option<Pose>)> {
    let (entry, format) = reader.entry(key).ok_or(Reported)?;
    let path = reader.key_path(key);
    let Shape::Placed(table) = format.shape else { return Err(Reported) };
    match &entry.node.value {
        Value::Text(text) => Ok((reader.body_in(&entry.node, &path, text)?, None)),
        Value::Table(_) => {
            let table = Reader::open(reader.context, entry, table, &path)?;
            let body = table.body("body").needed();
            let pose = pose(&table);
            let placed = table.has("at") || table.has("rotation");
            let pose = pose?;
            Ok((body?, placed.then_some(pose)))
        }
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
        "spherical" | "pin" => ball(reader),
        _ => Err(Reported),
    }
}

const BOTH: &str = "a driven coordinate finds its own effort";

fn one_coordinate(reader: &Reader<'_, '_>, kind: JointKind) -> Read<JointLaw> {
    let axis = reader.direction("axis").needed();
    let coordinate = reader.number("coordinate");
    let effort = reader.number("effort");
    let stiffness = reader.number("stiffness");
    let rest = reader.number("rest");
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
    let coordinate = CoordinateLaw {
        drive,
        stiffness: stiffness.unwrap_or(0.0),
        rest: rest.unwrap_or(0.0),
        limits: limits?,
    };
    Ok(JointLaw { coordinates: vec![coordinate], ..JointLaw::free(kind, axis?) })
}

fn ball(reader: &Reader<'_, '_>) -> Read<JointLaw> {
    let coordinate = reader.vector("coordinate");
    let effort = reader.vector("effort");
    let stiffness = reader.number("stiffness");
    let rest = reader.vector("rest");
    let (coordinate, effort, stiffness, rest) = (coordinate?, effort?, stiffness?, rest?);
    if coordinate.is_some() && effort.is_some() {
        return Err(reader.wrong_at("effort", "give `coordinate` or `effort`, not both", BOTH));
    }
    useless_rest(reader, stiffness, rest.is_some())?;
    let mut law = JointLaw::free(JointKind::Spherical, Vector3::x());
    for (k, each) in law.coordinates.iter_mut().enumerate() {
        *each = CoordinateLaw {
            drive: match coordinate {
                Some(coordinate) => Drive::Driven { coordinate: coordinate[k] },
                None => Drive::Free { effort: effort.map_or(0.0, |effort| effort[k]) },
            },
            stiffness: stiffness.unwrap_or(0.0),
            rest: rest.map_or(0.0, |rest| rest[k]),
            limits: None,
        };
    }
    Ok(law)
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
