//! What the path to a critical value of linear buckling says of it.
//!
//! Linear buckling keeps the shape. Where the path bends on the way, its own count of unstable directions, before the value and
//! beyond, says whether anything gives way there.

use super::buckle::bent;
use crate::{Family, Options, Prepared};
use flexura_equilibrium::Stability;
use flexura_model::{BuckleStudy, Model};
use flexura_solution::{BucklingMode, Status};

/// Where the path is looked at, as parts of the way to the value.
const BEFORE: f64 = 0.9;
const BEYOND: f64 = 1.1;
/// Angle by which a beam is bent (rad) beyond which the way to a value counts as bent.
const BENDS: f64 = 0.02;

/// An equilibrium of the path.
struct Seen {
    /// Angle by which a beam is bent at most, rad.
    bent: f64,
    unstable: Option<usize>,
}

/// What is to be said of the nearest value; nothing of a path that bends and becomes unstable as it should where a bent start was told of.
pub(super) fn compared(
    model: &Model,
    family: &mut dyn Family,
    study: &BuckleStudy,
    (modes, is_told): (&[BucklingMode], bool),
    options: &Options,
) -> Option<String> {
    let nearest = modes.first()?.value - study.at;
    let mut at = |part: f64| see(model, family, study, study.at + part * nearest, options);
    let Some(before) = at(BEFORE) else {
        return Some(
            "the nearest value is linearised, and the path from rest does not reach nine tenths of it: something else gives way \
             before; trace the parameter"
                .to_string(),
        );
    };
    if before.bent <= BENDS {
        return None;
    }
    let bends = format!(
        "the nearest value is linearised: it takes the shape as it is, but at nine tenths of it a beam is bent by {:.3} deg",
        before.bent.to_degrees()
    );
    let within = |mode: &&BucklingMode| (BEFORE..=BEYOND).contains(&((mode.value - study.at) / nearest));
    let told = modes.iter().filter(within).count();
    let beyond = at(BEYOND).and_then(|beyond| beyond.unstable);
    Some(match (before.unstable, beyond) {
        (Some(a), Some(b)) if b >= a + told && is_told => return None,
        (Some(a), Some(b)) if b >= a + told => bends,
        (Some(a), Some(b)) => format!(
            "{bends}, and the path itself has {a} unstable directions there and {b} at eleven tenths: nothing of the kind gives way on it; \
             trace the parameter"
        ),
        _ => format!("{bends}; trace the parameter to see what the path itself does"),
    })
}

/// The equilibrium on the path at a value; None where the path does not get there.
fn see(
    model: &Model,
    family: &mut dyn Family,
    study: &BuckleStudy,
    value: f64,
    options: &Options,
) -> Option<Seen> {
    let mut prepared = match study.parameter {
        Some(parameter) => Prepared::new(&family.model(&[(parameter, value)]).ok()?).ok()?,
        None => Prepared::new(model).ok()?,
    };
    prepared.heed(&options.interrupt);
    let outcome = match study.parameter {
        Some(_) => prepared.solve(options.tolerance, &mut |_| {}),
        None => prepared.part_of_load(value, options.tolerance).ok()?,
    };
    if outcome.status != Status::Converged {
        return None;
    }
    let unstable = match prepared.problem.stability() {
        Ok(Stability::Unstable(count)) => Some(count),
        _ => None,
    };
    Some(Seen { bent: bent(&prepared.problem.solution(options.samples.min(FEW))), unstable })
}

/// Samples along each beam.
const FEW: usize = 21;
