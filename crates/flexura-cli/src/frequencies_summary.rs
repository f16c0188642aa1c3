//! What a person reads of frequencies along a path.

use crate::quantity::quantity;
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::model::Model;
use flexura::solution::{Followed, ModeKind, ModesAlong, Onset, OnsetKind, PointKind, Status};
use std::f64::consts::TAU;

/// Points of a branch that are printed, at most.
const MOST: usize = 16;
/// Modes that are printed, at most.
const MODES: usize = 6;

/// The summary as text.
pub fn render(model: &Model, along: &ModesAlong) -> String {
    let trace = &along.trace;
    let state = match trace.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let parameter = &model.parameters[trace.parameter];
    let points: usize = trace.branches.iter().map(|branch| branch.points.len()).sum();
    let about = format!("natural frequencies over {}, {points} points", parameter.name);
    let mut text = format!("{}: {state}\n  {}\n", title(&model.name), styled(DIM, &about));
    for (branch, rows) in trace.branches.iter().zip(&along.followed) {
        let modes = rows.iter().map(Vec::len).max().unwrap_or(0).min(MODES);
        let mut heading = vec![parameter.name.clone(), String::new()];
        heading.extend((1..=modes).map(|mode| format!("mode {mode}")));
        let heading: Vec<&str> = heading.iter().map(String::as_str).collect();
        let mut table = Table::new(&heading);
        let step = branch.points.len().div_ceil(MOST).max(1);
        for (i, (point, row)) in branch.points.iter().zip(rows).enumerate() {
            let is_special = point.kind != PointKind::Regular;
            if i % step != 0 && !is_special {
                continue;
            }
            let mut cells = vec![quantity(point.parameter, &parameter.unit, 6)];
            cells.push(if is_special { point.kind.word().to_owned() } else { String::new() });
            cells.extend((0..modes).map(|mode| shown(row.get(mode).and_then(Option::as_ref))));
            table.row(cells);
        }
        text += &format!("\n{}", table.render());
    }
    for onset in along.onsets.iter().flatten() {
        text += &format!("\n{}\n", told(onset, &parameter.name, &parameter.unit));
    }
    text
}

/// "flutter sets in at force = 20.050954 N, 1.7532 Hz".
fn told(onset: &Onset, name: &str, unit: &str) -> String {
    let does = if onset.begins { "sets in" } else { "ends" };
    let at = quantity(onset.parameter, unit, 10);
    let rate = match onset.kind {
        OnsetKind::Flutter => format!(", {}", quantity(onset.rate / TAU, "Hz", 8)),
        OnsetKind::Divergence => String::new(),
    };
    let error = quantity(onset.error_estimate, "", 2);
    format!("{} {does} at {name} = {at}{rate} (relative error {error})", onset.kind.word())
}

fn shown(mode: Option<&Followed>) -> String {
    let Some(mode) = mode else { return "-".to_owned() };
    match mode.kind {
        ModeKind::Rigid => "0 Hz".to_owned(),
        ModeKind::Diverging => format!("grows {}", quantity(mode.growth, "1/s", 5)),
        ModeKind::Creeping => format!("creeps {}", quantity(-mode.growth, "1/s", 5)),
        ModeKind::Flutter => format!("{}, flutter", quantity(mode.rate / TAU, "Hz", 6)),
        ModeKind::Swinging | ModeKind::Decaying => quantity(mode.rate / TAU, "Hz", 6),
    }
}
