//! Motions in time: laws that go somewhere in a time that is long enough.

use super::Issues;
use super::study::{at_least, shown};
use crate::{InverseDynamicsStudy, Model, MotionLaw, Pace, Parameter, Sampling, Until};
use flexura_expression::Function;

/// Most times at which a motion is looked at.
const MOST_SAMPLES: usize = 1_000_000;
/// Times at which a function is tried.
const TRIED: usize = 64;

impl Model {
    pub(super) fn check_motion(&self, study: &InverseDynamicsStudy, path: &str, issues: &mut Issues) {
        let Some(parameter) = self.parameter_of(study.parameter, path, issues) else { return };
        let before = issues.0.len();
        match &study.law {
            MotionLaw::Trapezoid { from, to, pace, ramp } => {
                check_trapezoid([*from, *to], *pace, *ramp, parameter, &format!("{path}.trapezoid"), issues);
            }
            MotionLaw::Knots(knots) => check_knots(knots, &format!("{path}.knots"), issues),
            MotionLaw::Function { value, duration } => {
                if positive_time(issues, &format!("{path}.duration"), *duration) {
                    check_function(value, *duration, &format!("{path}.value"), issues);
                }
            }
            MotionLaw::Constant { from, rate, until } => {
                check_constant(*from, *rate, *until, parameter, path, issues);
            }
        }
        if issues.0.len() == before {
            check_sampling(study, path, issues);
        }
    }
}

/// Is it a time that something can take?
fn positive_time(issues: &mut Issues, path: &str, time: f64) -> bool {
    if !issues.finite(path, time) {
        return false;
    }
    if time <= 0.0 {
        issues.add_with_hint(
            path,
            format!("a motion cannot take {time} s"),
            "give a time that is longer than nothing, such as \"2 s\"",
        );
    }
    time > 0.0
}

fn check_trapezoid(
    [from, to]: [f64; 2],
    pace: Pace,
    ramp: f64,
    parameter: &Parameter,
    path: &str,
    issues: &mut Issues,
) {
    let finite = [("from", from), ("to", to), ("ramp", ramp)];
    if !finite.iter().all(|(key, value)| issues.finite(format_args!("{path}.{key}"), *value)) {
        return;
    }
    if from == to {
        issues.add_with_hint(
            format!("{path}.to"),
            format!("the motion begins and ends at {}", shown(from, parameter)),
            "give two different values; the first may be the larger",
        );
        return;
    }
    if ramp <= 0.0 {
        issues.add_with_hint(
            format!("{path}.ramp"),
            format!("no speed can be reached in {ramp} s"),
            "give the time of speeding up, such as \"0.5 s\"; for a constant speed from the start write `rate` in place of `trapezoid`",
        );
        return;
    }
    let way = (to - from).abs();
    match pace {
        Pace::Speed(speed) => {
            let path = format!("{path}.speed");
            if !issues.finite(path.clone(), speed) {
                return;
            }
            if speed <= 0.0 {
                let message = format!("the speed is {}/s", shown(speed, parameter));
                let hint = "a speed is positive: `from` and `to` say which way the parameter goes";
                issues.add_with_hint(path, message, hint);
            } else if way < speed * ramp * (1.0 - 1e-12) {
                let message = format!(
                    "there is no room for two ramps of {ramp} s: they cover {} at this speed, but the way is {}",
                    shown(speed * ramp, parameter),
                    shown(way, parameter)
                );
                let hint = format!(
                    "with these ramps the motion takes at least {} s: choose a speed of at most {}/s, or ramps of at most {} s",
                    2.0 * ramp,
                    shown(way / ramp, parameter),
                    way / speed
                );
                issues.add_with_hint(path, message, hint);
            }
        }
        Pace::Duration(duration) => {
            let path = format!("{path}.duration");
            if positive_time(issues, &path, duration) && duration < 2.0 * ramp * (1.0 - 1e-12) {
                issues.add_with_hint(
                    path,
                    format!("there is no room for two ramps of {ramp} s in {duration} s"),
                    format!("give it at least {} s, or ramps of at most {} s", 2.0 * ramp, 0.5 * duration),
                );
            }
        }
    }
}

fn check_knots(knots: &[[f64; 2]], path: &str, issues: &mut Issues) {
    if knots.len() < 2 {
        let message = format!("a motion needs at least two knots, found {}", knots.len());
        issues.add_with_hint(
            path,
            message,
            "each is a time and a value: [[\"0 s\", \"0 deg\"], [\"1 s\", \"90 deg\"]]",
        );
        return;
    }
    for (i, [time, value]) in knots.iter().enumerate() {
        if !issues.finite(format_args!("{path}[{i}][0]"), *time)
            || !issues.finite(format_args!("{path}[{i}][1]"), *value)
        {
            return;
        }
    }
    for (i, pair) in knots.windows(2).enumerate() {
        let [before, after] = [pair[0][0], pair[1][0]];
        if after <= before {
            issues.add_with_hint(
                format!("{path}[{}][0]", i + 1),
                format!("the knot at {after} s follows one at {before} s"),
                "write the knots in the order of their times, each later than the one before",
            );
            return;
        }
    }
}

fn check_function(value: &Function, duration: f64, path: &str, issues: &mut Issues) {
    let times = (0..=TRIED).map(|i| duration * i as f64 / TRIED as f64);
    for time in times {
        let [value, rate, acceleration, _] = value.jet(time);
        if !(value.is_finite() && rate.is_finite() && acceleration.is_finite()) {
            let what = if !value.is_finite() {
                "value"
            } else if !rate.is_finite() {
                "rate"
            } else {
                "acceleration"
            };
            issues.add_with_hint(
                path,
                format!("the motion has no finite {what} at t = {time} s"),
                "use a function that is smooth from 0 to `duration`",
            );
            return;
        }
    }
}

fn check_constant(
    from: f64,
    rate: f64,
    until: Until,
    parameter: &Parameter,
    path: &str,
    issues: &mut Issues,
) {
    let path_of = |key: &str| format!("{path}.{key}");
    if !issues.finite(path_of("from"), from) || !issues.finite(path_of("rate"), rate) {
        return;
    }
    if rate == 0.0 {
        issues.add_with_hint(
            path_of("rate"),
            "nothing moves at a rate of zero",
            "use `flexura solve` for what stands still",
        );
        return;
    }
    match until {
        Until::Duration(duration) => {
            positive_time(issues, &path_of("duration"), duration);
        }
        Until::Value(to) => {
            if !issues.finite(path_of("to"), to) {
                return;
            }
            if to == from {
                let message = format!("the motion begins and ends at {}", shown(from, parameter));
                issues.add_with_hint(path_of("to"), message, "give another end, or a `duration`");
            } else if (to - from) / rate < 0.0 {
                issues.add_with_hint(
                    path_of("rate"),
                    format!(
                        "at {}/s the parameter never comes from {} to {}",
                        shown(rate, parameter),
                        shown(from, parameter),
                        shown(to, parameter)
                    ),
                    "change the sign of the rate, or exchange the two ends",
                );
            }
        }
    }
}

fn check_sampling(study: &InverseDynamicsStudy, path: &str, issues: &mut Issues) {
    match study.sampling {
        Sampling::Count(count) => {
            at_least(count, 2, &format!("{path}.samples"), issues);
            if count > MOST_SAMPLES {
                issues.add(format!("{path}.samples"), format!("must be at most {MOST_SAMPLES}, is {count}"));
            }
        }
        Sampling::Step(step) => {
            let path = format!("{path}.step");
            let [start, end] = study.law.times();
            if issues.positive(path.clone(), step) && (end - start) / step > MOST_SAMPLES as f64 {
                issues.add_with_hint(
                    path,
                    format!(
                        "the motion of {} s would be looked at more than {MOST_SAMPLES} times",
                        end - start
                    ),
                    "give a longer step",
                );
            }
        }
    }
}
