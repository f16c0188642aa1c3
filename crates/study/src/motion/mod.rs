//! Motions in time: `profile` is the parameter over time, `walk` leads the mechanism along it and differentiates its
//! configurations, `inertia` balances the forces of inertia; here they come together.
//!
//! With X(p) the configuration and p(t) the parameter, velocities are X' ṗ and accelerations X' p̈ + X'' ṗ². By d'Alembert's
//! principle the mechanism is then in equilibrium under the forces -m a and the moments -(I α + ω × I ω) besides all others.

mod inertia;
mod profile;
#[cfg(test)]
mod tests;
mod walk;

use crate::family::{Family, ModelFamily};
use crate::{Options, ProblemError};
use flexura_model::{InverseDynamicsStudy, Model, StudyKind};
use flexura_solution::{InverseDynamics, MotionWork, Status};
use profile::Profile;
use walk::{Halt, Rates, Walker};

/// How far a motion has come.
#[derive(Clone, Copy, Debug)]
pub struct MotionProgress {
    /// Times that were looked at.
    pub done: usize,
    /// All of them.
    pub of: usize,
    /// The last of them, s.
    pub time: f64,
}

/// Relative error of the derivatives above which it is told.
const ROUGH: f64 = 1e-6;
/// Motion over the whole range of the parameter, in units of length and radians, that counts as none.
const NOTHING: f64 = 1e-9;

/// Velocities, accelerations, wrenches and efforts of a rigid mechanism that one parameter leads along a motion in time.
///
/// A motion that cannot be gone through to its end returns what was found before that; the status says so.
///
/// # Errors
/// The study does not fit the model: beams, a parameter that moves nothing, or does not decide the whole motion.
pub fn inverse_dynamics(
    model: &Model,
    study: &InverseDynamicsStudy,
    options: &Options,
    progress: &mut dyn FnMut(MotionProgress),
) -> Result<InverseDynamics, ProblemError> {
    inverse_dynamics_family(model, &mut ModelFamily::new(model), study, options, progress)
}

/// [`inverse_dynamics`] where something else than the model's own rules makes the models with other values of its parameters.
///
/// # Errors
/// As [`inverse_dynamics`].
pub fn inverse_dynamics_family(
    model: &Model,
    family: &mut dyn Family,
    study: &InverseDynamicsStudy,
    options: &Options,
    progress: &mut dyn FnMut(MotionProgress),
) -> Result<InverseDynamics, ProblemError> {
    crate::trace::check_study(model, StudyKind::InverseDynamics(study.clone()))?;
    check_rigid(model)?;
    let moments = Profile::new(&study.law).moments(study);
    let values = || moments.iter().map(|moment| moment.at[0]);
    let start = moments.first().map_or(0.0, |moment| moment.at[0]);
    let span = values().map(|value| (value - start).abs()).fold(0.0, f64::max);
    // What stands still is still differentiated by its parameter.
    let size = crate::family::size_of(model, study.parameter, (1.0, 1.0), 1.0);
    let reach = if span > 0.0 { span } else { size };

    let mut result = InverseDynamics {
        parameter: study.parameter,
        status: Status::Converged,
        reason: None,
        warnings: Vec::new(),
        instants: Vec::new(),
        error_estimate: 0.0,
        work: MotionWork::default(),
    };
    let mut walker = Walker::new(family, study.parameter, start, reach)?;
    walker.prepared.heed(&options.interrupt);
    let outcome = walker.prepared.solve(options.tolerance, &mut |_| {});
    result.warnings = walker.problem().warnings().to_vec();
    if outcome.status == Status::Interrupted {
        (result.status, result.reason) = (outcome.status, outcome.reason);
        return Ok(result);
    }
    if outcome.status != Status::Converged {
        result.status = outcome.status;
        result.reason = outcome.reason.map(|reason| format!("the motion cannot begin: {reason}"));
        return Ok(result);
    }
    let mut moved = 0.0_f64;
    let mut rates: Option<Rates> = None;
    for (done, moment) in moments.iter().enumerate() {
        let arrived = match rates.take() {
            Some(before) if before.value == moment.at[0] => Ok(before),
            Some(before) => walker.advance(&before, moment.at[0]).and_then(|()| walker.rates()),
            None if walker.settle().is_some() => walker.rates(),
            None => Err(Halt::Singular(moment.at[0])),
        };
        let here = match arrived {
            Ok(here) => here,
            // What a step makes of the end is told below.
            Err(_) if options.interrupt.is_raised() => break,
            Err(Halt::Model(error)) => return Err(error),
            Err(halt) => {
                let (status, reason) = halted(model, study, moment.time, &halt);
                (result.status, result.reason) = (status, Some(reason));
                break;
            }
        };
        moved = moved.max(walker.problem().motion_size(&here.steps[0]) * reach);
        moved = moved.max(walker.problem().motion_size(&here.steps[1]) * reach * reach);
        result.error_estimate = result.error_estimate.max(here.error);
        let balanced = inertia::balanced(&mut walker, &here, moment, model, study)?;
        if options.interrupt.is_raised() {
            break;
        }
        if let Some(reason) = balanced.inconsistent {
            result.status = Status::Inconsistent;
            result.reason = Some(format!("at t = {} s {reason}", told(moment.time)));
            break;
        }
        for warning in balanced.warnings {
            if !result.warnings.contains(&warning) {
                result.warnings.push(warning);
            }
        }
        result.instants.push(balanced.instant);
        rates = Some(here);
        progress(MotionProgress { done: done + 1, of: moments.len(), time: moment.time });
    }
    if let Some(next) = moments.get(result.instants.len())
        && options.interrupt.is_raised()
    {
        let reason = format!("interrupted before t = {} s", told(next.time));
        (result.status, result.reason) = (Status::Interrupted, Some(reason));
    }
    let counts = walker.problem().counts();
    result.work = MotionWork {
        instants: result.instants.len(),
        newton_steps: counts.newton_steps,
        factorisations: counts.factorisations,
        residuals: counts.residuals,
    };
    let name = &model.parameters[study.parameter].name;
    if moved <= NOTHING && result.status == Status::Converged {
        return Err(ProblemError::new(
            "study",
            format!("`{name}` moves nothing: no body and no joint is elsewhere when it has another value"),
            format!("drive a joint with it, for example `coordinate = \"{name}\"` in [joint.NAME]"),
        ));
    }
    if result.error_estimate > ROUGH {
        result.warnings.push(format!(
            "accelerations are good to {:.0e} of their size only: something hangs on `{name}` in a way that is not smooth, \
             or the mechanism comes near a singular position",
            result.error_estimate
        ));
    }
    Ok(result)
}

/// A beam bends under the forces of its motion, and has inertia all along it.
fn check_rigid(model: &Model) -> Result<(), ProblemError> {
    let hint = "put bodies, joints and springs in its place, or `trace` the parameter for equilibria without inertia";
    if let Some(beam) = model.beams.first() {
        let message = "would bend under the forces of its motion, which this study takes no account of";
        return Err(ProblemError::new(format!("beam.{}", beam.name), message, hint));
    }
    if let Some(tubes) = model.tubes.first() {
        let message = "would bend under the forces of their motion, which this study takes no account of";
        return Err(ProblemError::new(format!("tubes.{}", tubes.name), message, hint));
    }
    Ok(())
}

/// Why a motion ends early.
fn halted(model: &Model, study: &InverseDynamicsStudy, time: f64, halt: &Halt) -> (Status, String) {
    let parameter = &model.parameters[study.parameter];
    let at = |value: f64| match parameter.unit.as_str() {
        "rad" => format!("{} = {} deg", parameter.name, told(value.to_degrees())),
        unit => format!("{} = {} {unit}", parameter.name, told(value)).trim_end().to_string(),
    };
    match halt {
        Halt::Lost(value) => (
            Status::Stalled,
            format!(
                "before t = {} s, near {}, the mechanism locks or comes to a singular position, where its links line up; \
                 end the motion before it, or choose times that step over it",
                told(time),
                at(*value)
            ),
        ),
        Halt::Singular(value) => (
            Status::Singular,
            format!(
                "at t = {} s, {}, the mechanism is in a singular position: the parameter does not decide how it moves on; \
                 choose times that step over it",
                told(time),
                at(*value)
            ),
        ),
        Halt::Model(error) => (Status::Stalled, error.message.clone()),
    }
}

/// A number as a sentence wants it.
fn told(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_string() } else { text.to_string() }
}
