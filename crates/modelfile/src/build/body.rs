//! Bodies and rotations.

use crate::context::{Read, Reported};
use crate::reader::Reader;
use crate::tree::Value;
use flexura_expression::{Dimension, Formula, Quantity};
use flexura_model::{Body, Rule, roll_pitch_yaw};
use flexura_spatial::{Matrix3, Pose, Quaternion, UnitQuaternion, Vector3, exp};

pub(super) fn body(reader: &Reader<'_, '_>, name: String) -> Read<Body> {
    let at = reader.vector("at");
    let rotation = rotation(reader);
    let mass = reader.number("mass");
    let center_of_mass = reader.vector("center_of_mass");
    let inertia = inertia(reader);
    Ok(Body {
        name,
        pose: Pose::new(rotation?, at?.unwrap_or_else(Vector3::zeros)),
        mass: mass?.unwrap_or(0.0),
        center_of_mass: center_of_mass?.unwrap_or_else(Vector3::zeros),
        inertia: inertia?,
    })
}

pub(super) fn inertia(reader: &Reader<'_, '_>) -> Read<Matrix3<f64>> {
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
            for i in 0..3 {
                reader.context.rules.rename(&format!("{path}[{i}]"), &[format!("{path}[{i}][{i}]")]);
            }
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

/// Joins the formulas of a rotation's numbers.
fn bind_rotation(
    table: &Reader<'_, '_>,
    axis: &Read<Option<Vector3<f64>>>,
    angle: &Read<Option<f64>>,
    quaternion: &Read<Option<[Quantity; 4]>>,
    rpy: &Read<Option<Vector3<f64>>>,
) {
    let rules = &table.context.rules;
    let rule = match (axis, angle, quaternion, rpy) {
        (Ok(Some(axis)), Ok(Some(angle)), _, _) => {
            let turning = rules.take_direction(&table.key_path("axis"));
            let angle_formula = rules.join([table.key_path("angle")], [*angle]);
            let constants = || <[f64; 3]>::from(*axis).map(Formula::constant);
            (turning.is_some() || angle_formula.is_some()).then(|| Rule::Turn {
                axis: turning.unwrap_or_else(constants),
                angle: angle_formula.map_or_else(|| Formula::constant(*angle), |[formula]| formula),
            })
        }
        (_, _, Ok(Some(wxyz)), _) => {
            let path = table.key_path("quat_wxyz");
            rules.join_list(&path, wxyz.map(|quantity| quantity.value)).map(Rule::Quaternion)
        }
        (_, _, _, Ok(Some(rpy))) => {
            rules.join_list(&table.key_path("rpy"), (*rpy).into()).map(Rule::RollPitchYaw)
        }
        _ => None,
    };
    if let Some(rule) = rule {
        rules.put(table.path.clone(), rule);
    }
}

pub(super) fn rotation(reader: &Reader<'_, '_>) -> Read<UnitQuaternion<f64>> {
    let Some(table) = reader.table("rotation")? else { return Ok(UnitQuaternion::identity()) };
    let axis = table.direction("axis");
    let angle = table.number("angle");
    let quaternion = table.numbers::<4>("quat_wxyz");
    let rpy = table.vector("rpy");
    bind_rotation(&table, &axis, &angle, &quaternion, &rpy);
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
        (None, None, None, Some(rpy)) => Ok(roll_pitch_yaw(&rpy)),
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
