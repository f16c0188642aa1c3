//! `motion.csv`: a row for every time.

use super::{MotionView, per_second};
use crate::OutputError;
use crate::trace::{cell, headed, line, output_headings, reasons};
use flexura_model::CoordinateKind;

/// The table of a motion: the parameter, the outputs, coordinates, velocities and efforts of joints, and powers.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn motion_csv(view: &MotionView<'_>) -> Result<String, OutputError> {
    let (name, unit) = view.parameter();
    let mut header = vec![
        headed("time", "s"),
        headed(name, unit),
        headed("rate", &per_second(unit, 1)),
        headed("acceleration", &per_second(unit, 2)),
    ];
    header.extend(output_headings(view.model));
    let coordinates = view.coordinates();
    for (name, joint, k) in &coordinates {
        let angle = view.model.joints[*joint].law.kind.coordinate_kinds()[*k] == CoordinateKind::Angle;
        let (unit, effort) = if angle { ("rad", "N*m") } else { ("m", "N") };
        header.push(headed(&format!("{name}.coordinate"), unit));
        header.push(headed(&format!("{name}.velocity"), &per_second(unit, 1)));
        header.push(headed(&format!("{name}.effort"), effort));
    }
    header.extend([headed("drive_power", "W"), headed("kinetic_energy", "J"), "reason".to_owned()]);
    let mut text = line(header);
    for (t, instant) in view.motion.instants.iter().enumerate() {
        let field = |name: &str| format!("{name}[{t}]");
        let mut row = Vec::new();
        for (name, value) in [
            ("times", instant.time),
            ("value", instant.value),
            ("rate", instant.rate),
            ("acceleration", instant.acceleration),
        ] {
            row.push(cell(value, || field(name))?);
        }
        for (output, values) in view.model.outputs.iter().zip(&instant.outputs) {
            for component in 0..output.formulas.len() {
                row.push(match values.as_ref().and_then(|values| values.get(component)) {
                    Some(value) => cell(*value, || field(&format!("outputs.{}", output.name)))?,
                    None => String::new(),
                });
            }
        }
        for (name, joint, k) in &coordinates {
            let (state, motion) = (&instant.state.joints[*joint], &instant.joints()[*joint]);
            for value in [state.coordinates[*k], motion.velocities[*k], state.efforts[*k]] {
                row.push(cell(value, || field(&format!("joints.{name}")))?);
            }
        }
        row.push(cell(instant.drive_power, || field("drive_power"))?);
        row.push(cell(instant.kinetic_energy, || field("kinetic_energy"))?);
        row.push(reasons(&instant.output_reasons));
        text += &line(row);
    }
    Ok(text)
}
