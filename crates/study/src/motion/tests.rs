#![allow(clippy::unwrap_used, reason = "a test may fail where it stands")]

use super::profile::{Profile, Side};
use flexura_expression::Function;
use flexura_model::{InverseDynamicsStudy, MotionLaw, Pace, Sampling, Until};

fn times(law: MotionLaw, sampling: Sampling) -> Vec<f64> {
    let study = InverseDynamicsStudy { parameter: 0, law, sampling };
    Profile::new(&study.law).moments(&study).iter().map(|moment| moment.time).collect()
}

fn trapezoid(pace: Pace) -> MotionLaw {
    MotionLaw::Trapezoid { from: 2.0, to: -4.0, pace, ramp: 0.5 }
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn speed_and_duration_tell_the_same_trapezoid() {
    // 6 at 4 a second: 1.5 s and a ramp.
    let [by_speed, by_duration] =
        [Pace::Speed(4.0), Pace::Duration(2.0)].map(|pace| Profile::new(&trapezoid(pace)));
    assert!((by_speed.ends()[1] - 2.0).abs() < 1e-15);
    for i in 0..=40 {
        let time = 0.05 * f64::from(i) + 1e-3;
        assert!(apart(by_speed.at(time, Side::After), by_duration.at(time, Side::After)) < 1e-12);
    }
    assert!(apart(by_speed.at(0.5, Side::Before), [1.0, -4.0, -8.0]) < 1e-12);
    assert!(apart(by_speed.at(0.5, Side::After), [1.0, -4.0, 0.0]) < 1e-12);
    assert!(apart(by_speed.at(2.0, Side::After), [-4.0, 0.0, 8.0]) < 1e-12);
}

#[test]
fn jumps_have_two_times_and_take_the_place_of_the_one_that_is_there() {
    let found = times(trapezoid(Pace::Speed(4.0)), Sampling::Count(5));
    assert_eq!(found, [0.0, 0.5, 0.5, 1.0, 1.5, 1.5, 2.0]);
    let found = times(trapezoid(Pace::Speed(4.0)), Sampling::Count(2));
    assert_eq!(found, [0.0, 0.5, 0.5, 1.5, 1.5, 2.0]);
}

#[test]
fn a_step_is_never_exceeded_and_taken_as_it_is_where_it_divides_the_time() {
    let law = |duration: f64| MotionLaw::Constant { from: 1.0, rate: 3.0, until: Until::Duration(duration) };
    assert_eq!(times(law(1.0), Sampling::Step(0.1)).len(), 11);
    assert_eq!(times(law(1.0), Sampling::Step(0.3)), [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert_eq!(times(law(0.2), Sampling::Step(5.0)), [0.0, 0.2]);
}

#[test]
fn a_spline_is_smooth_to_its_second_derivative_and_rests_at_its_ends() {
    let knots = vec![[-1.0, 0.3], [0.2, 1.0], [0.9, -0.4], [2.5, 0.1], [3.0, 0.0]];
    let profile = Profile::new(&MotionLaw::Knots(knots.clone()));
    assert_eq!(profile.ends(), [-1.0, 3.0]);
    for [time, value] in &knots {
        let (before, after) = (profile.at(*time, Side::Before), profile.at(*time, Side::After));
        assert!(apart(before, after) < 1e-12, "{time}: {before:?} {after:?}");
        assert!((after[0] - value).abs() < 1e-14);
    }
    for end in profile.ends() {
        assert!(profile.at(end, Side::After)[1].abs() < 1e-13);
    }
    let study =
        InverseDynamicsStudy { parameter: 0, law: MotionLaw::Knots(knots), sampling: Sampling::Count(9) };
    assert_eq!(profile.moments(&study).len(), 9);
}

#[test]
fn two_knots_make_the_cubic_from_rest_to_rest() {
    let profile = Profile::new(&MotionLaw::Knots(vec![[1.0, 5.0], [3.0, 7.0]]));
    let t = 0.3;
    let expected = [5.0 + 2.0 * t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t), 3.0 * (1.0 - 2.0 * t)];
    assert!(apart(profile.at(1.6, Side::After), expected) < 1e-13);
}

#[test]
fn a_function_has_its_exact_derivatives() {
    let value = Function::parse("3*t^2 + sin(2*t)", "t").unwrap();
    let profile = Profile::new(&MotionLaw::Function { value, duration: 4.0 });
    assert_eq!(profile.ends(), [0.0, 4.0]);
    let t: f64 = 0.7;
    let expected =
        [3.0 * t * t + (2.0 * t).sin(), 6.0 * t + 2.0 * (2.0 * t).cos(), 6.0 - 4.0 * (2.0 * t).sin()];
    assert!(apart(profile.at(t, Side::After), expected) < 1e-14);
}
