//! How far the contact has travelled on both boundaries when the coordinate has a value: (3.8) of the thesis.
//!
//! a is the travel on the child, b that on the parent, S the slide: a = b + S. Where S depends on the coordinate q alone,
//! b = a - S(q); where roll and slide keep a ratio ρ, b = a ρ/(1 + ρ); where the contact stays on the parent, b = 0. All
//! are b = c a - S(q).

use crate::joint::ContactError;
use flexura_expression::Function;
use flexura_geometry::FunctionSpline;
use flexura_model::{RollingCoordinate, Slide};

/// Steps of a travel in steps to either side: each place costs all steps that lead to it.
const MOST_STEPPED: f64 = 2e3;

/// A value with its first two derivatives by the coordinate.
pub(super) type Jet = [f64; 3];

/// a and b.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travel {
    pub child: Jet,
    pub parent: Jet,
}

/// What a slide law comes to.
#[derive(Clone, Debug)]
pub(super) enum Slip {
    /// b = c a - S(q).
    Relative { share: f64, slide: Offset },
    /// Both are given.
    Measured { roll: Function, slide: Function },
    /// a in steps of q.
    Stepped { step: f64 },
}

/// S(q).
#[derive(Clone, Debug)]
pub(super) enum Offset {
    Linear(f64),
    Function(Function),
    Spline(FunctionSpline),
}

impl Offset {
    pub fn jet(&self, q: f64) -> Jet {
        match self {
            Offset::Linear(slope) => [slope * q, *slope, 0.0],
            Offset::Function(function) => first_three(&function.jet(q)),
            Offset::Spline(spline) => first_three(&spline.jet(q)),
        }
    }
}

pub(super) fn first_three(jet: &[f64; 4]) -> Jet {
    [jet[0], jet[1], jet[2]]
}

impl Slip {
    pub fn new(slide: &Slide, coordinate: RollingCoordinate) -> Result<Self, ContactError> {
        let number = |what, value: f64| ContactError::SlideNumber { what, value };
        let relative = |share, slide| Ok(Slip::Relative { share, slide });
        let from_zero = |which, function: &Function| {
            let value = function.value(0.0);
            let size = function.value(1.0).abs().max(f64::MIN_POSITIVE);
            if value.abs() <= 1e-12 * size {
                Ok(())
            } else {
                Err(ContactError::TravelAtZero { which, value })
            }
        };
        match slide {
            Slide::None => relative(1.0, Offset::Linear(0.0)),
            Slide::Pure => relative(0.0, Offset::Linear(0.0)),
            Slide::Velocity { velocity, rate } => {
                if coordinate == RollingCoordinate::Arc {
                    return Err(ContactError::VelocityByArc);
                }
                let slope = velocity / rate;
                if !slope.is_finite() {
                    return Err(number("rate", *rate));
                }
                relative(1.0, Offset::Linear(slope))
            }
            Slide::Ratio { ratio } => {
                let share = ratio / (1.0 + ratio);
                if !share.is_finite() {
                    return Err(number("ratio of roll to slide", *ratio));
                }
                relative(share, Offset::Linear(0.0))
            }
            Slide::Function(function) => {
                from_zero("slide", function)?;
                relative(1.0, Offset::Function(function.clone()))
            }
            Slide::Table(rows) => {
                let spline = FunctionSpline::new(rows).ok_or(ContactError::SlideTable)?;
                let at_zero = spline.jet(0.0)[0];
                let size = rows.iter().map(|[_, y]| y.abs()).fold(f64::MIN_POSITIVE, f64::max);
                let starts_at_zero = at_zero.abs() <= 1e-9 * size;
                if !starts_at_zero {
                    return Err(ContactError::TravelAtZero { which: "slide", value: at_zero });
                }
                relative(1.0, Offset::Spline(spline))
            }
            Slide::Measured { roll, slide } => {
                from_zero("roll", roll)?;
                from_zero("slide", slide)?;
                Ok(Slip::Measured { roll: roll.clone(), slide: slide.clone() })
            }
            Slide::Stepped { step } => {
                if !(step.is_finite() && *step > 0.0) {
                    return Err(number("step", *step));
                }
                Ok(Slip::Stepped { step: *step })
            }
        }
    }

    /// Values of q in which the law is known.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self {
            Slip::Relative { slide: Offset::Spline(spline), .. } => Some(spline.range()),
            Slip::Stepped { step } => Some([-MOST_STEPPED * step, MOST_STEPPED * step]),
            _ => None,
        }
    }
}

/// The root of an increasing function with f(0) = 0: where f = target. `f` gives value and slope; None where it ends. The
/// search goes outwards in steps of `step`, then by Newton's method within a bracket.
pub(super) fn outwards(target: f64, step: f64, f: impl Fn(f64) -> Option<(f64, f64)>) -> Option<f64> {
    if target == 0.0 {
        return Some(0.0);
    }
    let sign = target.signum();
    let (mut inner, mut width) = (0.0, step);
    let mut outer = None;
    for _ in 0..100_000 {
        let next = inner + sign * width;
        match f(next) {
            Some((value, _)) if sign * (value - target) >= 0.0 => {
                outer = Some(next);
                break;
            }
            Some(_) => inner = next,
            // An end lies before: get closer to it.
            None if width > 1e-13 * step => width *= 0.25,
            None => return None,
        }
    }
    let mut outer = outer?;
    let mut x = outer;
    for _ in 0..100 {
        let (value, slope) = f(x)?;
        if sign * (value - target) >= 0.0 {
            outer = x;
        } else {
            inner = x;
        }
        let newton = x - (value - target) / slope;
        if (newton - x).abs() <= 4e-16 * x.abs() {
            return Some(newton);
        }
        let (low, high) = if inner < outer { (inner, outer) } else { (outer, inner) };
        x = if newton >= low && newton <= high { newton } else { 0.5 * (inner + outer) };
    }
    Some(x)
}
