//! The keys of a motion in time.

use super::tables::key;
use super::{Key, Need, Shape, Table};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension;

/// Keys of a study of the kind `inverse_dynamics`. One of `trapezoid`, `knots`, `value` and `rate` is the law.
pub(crate) static MOTION: [Key; 10] = [
    key("parameter", Shape::Parameter, Required, "\"theta\"", "The parameter that drives the mechanism."),
    key(
        "trapezoid",
        Shape::Table(&TRAPEZOID),
        Optional,
        "{ from = \"-5 deg\", to = \"115 deg\", speed = \"80 deg/s\", ramp = \"0.5 s\" }",
        "From rest to rest: speeding up, a constant speed, slowing down.",
    ),
    key(
        "knots",
        Shape::Knots,
        Optional,
        "[[\"0 s\", \"0 deg\"], [\"1 s\", \"60 deg\"], [\"2 s\", \"0 deg\"]]",
        "Times and values that the parameter passes on a cubic spline, at rest at both ends.",
    ),
    key(
        "value",
        Shape::AnyFunction,
        Optional,
        "\"30 deg * sin(2*pi*t)\"",
        "The parameter as a function of the time t in seconds, from t = 0; with `duration`.",
    ),
    key(
        "rate",
        Shape::AnyRate,
        Optional,
        "\"80 deg/s\"",
        "A constant rate of the parameter; with `to` or `duration`.",
    ),
    key(
        "from",
        Shape::AnyNumber,
        Default("the parameter's own value"),
        "\"0 deg\"",
        "Where a constant rate begins.",
    ),
    key("to", Shape::AnyNumber, Optional, "\"360 deg\"", "Where a constant rate ends."),
    key("duration", Shape::Number(Dimension::TIME), Optional, "\"2 s\"", "How long `value` or `rate` last."),
    key(
        "samples",
        Shape::Count,
        Default("101"),
        "201",
        "At how many times the mechanism is looked at, both ends included. Where the acceleration jumps there are two more, before and after.",
    ),
    key(
        "step",
        Shape::Number(Dimension::TIME),
        Optional,
        "\"10 ms\"",
        "In place of `samples`: times are not farther apart than this.",
    ),
];

static TRAPEZOID: Table = Table {
    doc: "A motion from rest to rest whose speed is a trapezoid over time.",
    keys: &[
        key("from", Shape::AnyNumber, Default("the parameter's own value"), "\"-5 deg\"", "The first value."),
        key("to", Shape::AnyNumber, Required, "\"115 deg\"", "The last value."),
        key(
            "speed",
            Shape::AnyRate,
            Optional,
            "\"80 deg/s\"",
            "The constant speed between the ramps, positive whichever way it goes.",
        ),
        key(
            "duration",
            Shape::Number(Dimension::TIME),
            Optional,
            "\"2 s\"",
            "In place of `speed`: the time that all of it takes.",
        ),
        key(
            "ramp",
            Shape::Number(Dimension::TIME),
            Required,
            "\"0.5 s\"",
            "The time of speeding up, and of slowing down.",
        ),
    ],
    variants: None,
};
