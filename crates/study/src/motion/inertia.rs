//! Velocities and accelerations at one time of a motion, and the balance of the forces of inertia.

use super::profile::Moment;
use super::told;
use super::walk::{Rates, Walker};
use crate::ProblemError;
use flexura_model::{Drive, InverseDynamicsStudy, LoadId, Model};
use flexura_nonlinear::System;
use flexura_solution::{BodyMotion, Instant, JointMotion, Rates as Motion};
use flexura_spatial::{Twist, Vector3, Wrench};

/// Motion under the forces of inertia, in units of length and radians, that is not round-off.
const MOVED: f64 = 1e-9;
/// Corrections of wrenches: the equations are linear in them, so that the second only removes round-off.
const CORRECTIONS: usize = 2;

/// What was found at one time.
pub(super) struct Balanced {
    pub instant: Instant,
    pub warnings: Vec<String>,
    /// Why this is no state that the mechanism can be in.
    pub inconsistent: Option<String>,
}

/// Balances the forces of inertia at a configuration whose derivatives are known. The walker stands there afterwards, without
/// them.
pub(super) fn balanced(
    walker: &mut Walker<'_>,
    rates: &Rates,
    moment: &Moment,
    own: &Model,
    study: &InverseDynamicsStudy,
) -> Result<Balanced, ProblemError> {
    let [value, rate, acceleration] = moment.at;
    let problem = walker.problem();
    let slopes = problem.body_motions(&rates.steps[0]);
    let bends = problem.body_motions(&rates.steps[1]);
    let before = problem.sampled(2, false, |_| false);
    let first_load = own.loads.len();
    let model = problem.model().clone();
    let mut bodies = Vec::with_capacity(slopes.len());
    let (mut kinetic_energy, mut gravity_power) = (0.0, 0.0);
    for (i, body) in model.bodies.iter().enumerate() {
        let (slope, bend) = (&slopes[i], &bends[i]);
        let over_time = |slope: Vector3<f64>, bend: Vector3<f64>| {
            (slope * rate, slope * acceleration + bend * (rate * rate))
        };
        let (angular, turn) = over_time(slope.angular, bend.angular);
        let (linear, shift) = over_time(slope.linear, bend.linear);
        let rotation = before.bodies[i].rotation;
        let arm = rotation * body.center_of_mass;
        let center_velocity = linear + angular.cross(&arm);
        let center_acceleration = shift + turn.cross(&arm) + angular.cross(&angular.cross(&arm));
        // I ω and I α about the centre of mass; I is constant in the body's axes.
        let inertial = |vector: &Vector3<f64>| rotation * (body.inertia * (rotation.inverse() * vector));
        let spin = inertial(&angular);
        let inertia =
            Wrench::new(-center_acceleration * body.mass, -(inertial(&turn) + angular.cross(&spin)));
        kinetic_energy += 0.5 * (body.mass * center_velocity.norm_squared() + angular.dot(&spin));
        gravity_power += body.mass * model.gravity.dot(&center_velocity);
        bodies.push(BodyMotion {
            velocity: Twist { angular, linear },
            acceleration: Twist { angular: turn, linear: shift },
            center_acceleration,
            inertia,
        });
    }

    problem.restore(&rates.state);
    for (i, body) in bodies.iter().enumerate() {
        problem.set_point_load(LoadId(first_load + i), body.inertia.force, body.inertia.moment);
    }
    let mut step = vec![0.0; problem.unknowns()];
    let mut singular = false;
    for _ in 0..CORRECTIONS {
        if problem.linearise().is_err() {
            singular = true;
            break;
        }
        problem.newton_step(&mut step);
        problem.retract(&step);
    }
    let moved = problem.moved_since(&rates.state);
    if moved > MOVED {
        return Err(not_driven(walker, rates, moment, own, study));
    }
    let mut inconsistent = singular.then(|| "the mechanism is in a singular position".to_string());
    if let Some((cable, push)) = problem.slack_cable() {
        inconsistent =
            Some(format!("{cable} would have to push with {push:.6} N: it is slack, and decides nothing"));
    }
    if let Some((joint, shift, turn)) = problem.open_loop() {
        inconsistent = Some(format!(
            "the loop does not close: at {joint} its two sides are {:.4} mm and {:.4} deg apart",
            shift * 1e3,
            turn.to_degrees()
        ));
    }
    let mut state = problem.solution(2);
    state.stability_reason = Some("a motion is no equilibrium at rest".to_string());
    let joints = joint_motions(rates, rate, acceleration);
    state.rates = Some(Box::new(Motion { bodies, joints }));
    walker.prepared.add_tangents(&mut state, &[]);
    let model = walker.prepared.problem.model();
    let mut warnings = state.warnings.clone();
    let values = flexura_post::output_values(model, &state);
    warnings.extend(values.reasons.iter().map(|(_, reason)| reason.clone()));
    let joints = state.rates.as_ref().map_or(&[][..], |rates| &rates.joints);
    let mut drive_power = 0.0;
    for (j, joint) in model.joints.iter().enumerate() {
        for (k, law) in joint.law.coordinates.iter().enumerate() {
            if matches!(law.drive, Drive::Driven { .. }) {
                drive_power += state.joints[j].efforts[k] * joints[j].velocities[k];
            }
        }
    }
    // The next step starts from the configuration without the forces of inertia.
    let problem = walker.problem();
    for i in 0..own.bodies.len() {
        problem.set_point_load(LoadId(first_load + i), Vector3::zeros(), Vector3::zeros());
    }
    problem.restore(&rates.state);
    let instant = Instant {
        time: moment.time,
        value,
        rate,
        acceleration,
        outputs: values.outputs,
        output_reasons: values.reasons,
        state,
        drive_power,
        gravity_power,
        kinetic_energy,
    };
    Ok(Balanced { instant, warnings, inconsistent })
}

fn joint_motions(rates: &Rates, rate: f64, acceleration: f64) -> Vec<JointMotion> {
    let [slopes, bends] = &rates.coordinates;
    slopes
        .iter()
        .zip(bends)
        .map(|(slopes, bends)| JointMotion {
            velocities: slopes.iter().map(|slope| slope * rate).collect(),
            accelerations: slopes
                .iter()
                .zip(bends)
                .map(|(slope, bend)| slope * acceleration + bend * rate * rate)
                .collect(),
        })
        .collect()
}

/// The configuration gives way to the forces of inertia.
fn not_driven(
    walker: &mut Walker<'_>,
    rates: &Rates,
    moment: &Moment,
    own: &Model,
    study: &InverseDynamicsStudy,
) -> ProblemError {
    let mover = walker.problem().mover_since(&rates.state);
    let name = &own.parameters[study.parameter].name;
    let [shift, turn] = mover.motion;
    let body = mover.body.map_or("something", |body| own.bodies[body].name.as_str());
    let message = format!(
        "does not decide the whole motion: under the forces of inertia at t = {} s the body `{body}` would move by {shift:.2e} m and turn by {:.2e} deg",
        told(moment.time),
        turn.to_degrees()
    );
    let hint = match mover.coordinate {
        Some((joint, coordinate)) => {
            let joint = &own.joints[joint];
            let names = joint.law.kind.coordinate_names();
            let which =
                if names.len() > 1 { format!(" (its `{}`)", names[coordinate]) } else { String::new() };
            format!(
                "the joint `{}`{which} is free: drive it by an expression of `{name}`, weld it, or take the mass from what it carries",
                joint.name
            )
        }
        None => "drive all its joints by expressions of that parameter".to_string(),
    };
    ProblemError::new("study", format!("`{name}` {message}"), hint)
}
