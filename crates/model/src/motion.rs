//! A motion that is prescribed in time.

use flexura_expression::Function;

/// A motion in time through which one parameter drives the mechanism; velocities, accelerations and the forces that it takes are
/// asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct InverseDynamicsStudy {
    /// Position in [`crate::Model::parameters`].
    pub parameter: usize,
    /// Its value over time.
    pub law: MotionLaw,
    /// At which times the mechanism is looked at.
    pub sampling: Sampling,
}

/// The times of a motion at which results are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// So many, evenly spread, both ends included.
    Count(usize),
    /// Not farther apart than this, s.
    Step(f64),
}

/// The value of a parameter (SI) over time (s).
#[derive(Clone, Debug, PartialEq)]
pub enum MotionLaw {
    /// From rest to rest: constant acceleration for the time `ramp`, constant speed, constant deceleration for the same time.
    Trapezoid {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// How fast.
        pace: Pace,
        /// Time of speeding up, and of slowing down, s.
        ramp: f64,
    },
    /// A cubic spline with continuous second derivative through times (increasing) and values, at rest at both ends.
    Knots(Vec<[f64; 2]>),
    /// A function of the time, from 0 on.
    Function {
        /// The value.
        value: Function,
        /// Last time, s.
        duration: f64,
    },
    /// At a constant rate.
    Constant {
        /// First value.
        from: f64,
        /// Change per second.
        rate: f64,
        /// Where it ends.
        until: Until,
    },
}

/// How fast a motion from rest to rest goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// The constant speed between the ramps, without its sign, per second.
    Speed(f64),
    /// The time that all of it takes, s.
    Duration(f64),
}

/// Where a motion at a constant rate ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// At this value.
    Value(f64),
    /// After this time, s.
    Duration(f64),
}

impl MotionLaw {
    /// First and last time, s. What is no sound law may have times that are none.
    pub fn times(&self) -> [f64; 2] {
        let duration = match self {
            MotionLaw::Knots(knots) => {
                let times = [knots.first(), knots.last()];
                return times.map(|knot| knot.map_or(0.0, |[time, _]| *time));
            }
            MotionLaw::Trapezoid { pace: Pace::Duration(duration), .. }
            | MotionLaw::Function { duration, .. }
            | MotionLaw::Constant { until: Until::Duration(duration), .. } => *duration,
            MotionLaw::Trapezoid { from, to, pace: Pace::Speed(speed), ramp } => {
                (to - from).abs() / speed + ramp
            }
            MotionLaw::Constant { from, rate, until: Until::Value(to) } => (to - from) / rate,
        };
        [0.0, duration]
    }
}

impl Sampling {
    /// Number of evenly spread times between `start` and `end`, both included.
    pub fn count(&self, [start, end]: [f64; 2]) -> usize {
        match self {
            Sampling::Count(count) => *count,
            // A step that divides the time up to round-off is taken as it is.
            Sampling::Step(step) => ((end - start) / step * (1.0 - 1e-12)).ceil().max(1.0) as usize + 1,
        }
    }
}
