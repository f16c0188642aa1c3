//! What a person reads after a motion in time.

use crate::quantity::{quantity, size};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::model::{CoordinateKind, Drive, Model};
use flexura::solution::{InverseDynamics, Status};

/// Most outputs that are listed.
const MOST: usize = 24;
/// Significant digits.
const DIGITS: usize = 5;

/// The summary as text.
pub fn render(model: &Model, motion: &InverseDynamics) -> String {
    let name = title(&model.name);
    let state = match motion.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let parameter = &model.parameters[motion.parameter];
    let mut text = format!("{name}: {state}\n");
    let (Some(first), Some(last)) = (motion.instants.first(), motion.instants.last()) else { return text };
    let about = format!(
        "{} from {} to {} in {}, {} times, relative error {}",
        parameter.name,
        quantity(first.value, &parameter.unit, DIGITS),
        quantity(last.value, &parameter.unit, DIGITS),
        quantity(last.time - first.time, "s", DIGITS),
        motion.instants.len(),
        size(motion.error_estimate)
    );
    text += &format!("  {}\n", styled(DIM, &about));

    let mut outputs = Table::new(&["outputs", "least", "at", "greatest", "at"]);
    for (i, output) in model.outputs.iter().enumerate() {
        let letters: &[&str] = if output.formulas.len() == 3 { &[".x", ".y", ".z"] } else { &[""] };
        for (k, letter) in letters.iter().enumerate() {
            let values = motion
                .instants
                .iter()
                .filter_map(|instant| Some((instant.time, *instant.outputs[i].as_ref()?.get(k)?)));
            row(&mut outputs, format!("{}{letter}", output.name), values, &output.unit);
        }
    }
    if !outputs.is_empty() {
        text += &format!("\n{}", outputs.shortened(MOST).render());
    }
    let mut drives = Table::new(&["drives", "least effort", "at", "greatest effort", "at"]);
    for (j, joint) in model.joints.iter().enumerate() {
        let names = joint.law.kind.coordinate_names();
        let driven = |k: &usize| matches!(joint.law.coordinates[*k].drive, Drive::Driven { .. });
        for k in (0..names.len()).filter(driven) {
            let shown =
                if names.len() > 1 { format!("{}.{}", joint.name, names[k]) } else { joint.name.clone() };
            let angle = joint.law.kind.coordinate_kinds()[k] == CoordinateKind::Angle;
            let values =
                motion.instants.iter().map(|instant| (instant.time, instant.state.joints[j].efforts[k]));
            row(&mut drives, shown, values, if angle { "N*m" } else { "N" });
        }
    }
    if !drives.is_empty() {
        text += &format!("\n{}", drives.shortened(MOST).render());
    }
    let peak = motion.instants.iter().map(|instant| instant.drive_power).fold(0.0, f64::max);
    text + &format!("\npeak power of all drives: {}\n", quantity(peak, "W", DIGITS))
}

/// The least and the greatest of values over time.
fn row(table: &mut Table, name: String, values: impl Iterator<Item = (f64, f64)>, unit: &str) {
    let values: Vec<(f64, f64)> = values.collect();
    let least = values.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let greatest = values.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let (Some(least), Some(greatest)) = (least, greatest) else { return };
    let mut cells = vec![name];
    for (time, value) in [least, greatest] {
        cells.push(quantity(*value, unit, DIGITS));
        cells.push(quantity(*time, "s", 4));
    }
    table.row(cells);
}
