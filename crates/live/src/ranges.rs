//! Between which values it makes sense to move a parameter.

use crate::session::{Moved, Session};
use flexura::model::StudyKind;

/// Part of a parameter's value by which it is moved where it shapes the mechanism: half of it and as much again.
const SHAPE: f64 = 0.5;
/// The same for what only loads or drives it, which may change its sign.
const LOAD: f64 = 2.0;
/// Parts of the mechanism's size and of EI/L² for lengths and forces that are zero, or that something is to be led to.
const LENGTH: f64 = 0.25;
const FORCE: f64 = 2.0;
/// Of such angles, rad.
const ANGLE: f64 = std::f64::consts::FRAC_PI_2;

/// A range (SI) that holds the present value: the one that the file gives, to an unknown or to a study, or one by its size.
pub fn range_of(session: &Session, parameter: usize) -> [f64; 2] {
    let model = &session.base;
    let value = model.parameters[parameter].value;
    let held = |[a, b]: [f64; 2]| [a.min(b).min(value), a.max(b).max(value)];
    let of_unknown = model.unknowns.iter().find(|unknown| unknown.parameter == parameter);
    let of_study = model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::Trace(trace) if trace.parameter == parameter => Some(trace.range),
        _ => None,
    });
    if let Some(range) = of_unknown.and_then(|unknown| unknown.range).or(of_study) {
        return held(range);
    }
    let change = session.change(parameter).unwrap_or_default();
    let is_target = !change.is_empty() && change.iter().all(|own| matches!(own, Moved::Target(_)));
    if value != 0.0 && !is_target {
        return if change.is_empty() {
            held([(1.0 - SHAPE) * value, (1.0 + SHAPE) * value])
        } else {
            held([-LOAD * value, LOAD * value])
        };
    }
    let (length, force) = session.units();
    let reach = match model.parameters[parameter].unit.as_str() {
        "m" => LENGTH * length,
        "N" => FORCE * force,
        "N*m" => FORCE * force * length,
        "N/m" => FORCE * force / length,
        "rad" => ANGLE,
        _ => value.abs().max(1.0),
    };
    [value - reach, value + reach]
}
