//! A strip on a slope between a clamp and a slider, pushed together, with a weight at its middle and weight of its own.
//!
//! In the strip's plane x runs along it from the clamp and y is the wanted deflection. Gravity is g = -(cos α) y - (sin α) x: on
//! level ground (α = 0) it acts against the deflection, on a wall (α = 90°) along the strip, in the direction of the push, so
//! that it lowers the critical push: the half at the clamp carries the weight besides. Slopes past 90° have the weight
//! with the deflection. Both halves are carried by Taylor series ([`crate::taylor`]); what is unknown at the clamp
//! closes the slider's end: y = 0, θ = 0.
//!
//! Forces are in units of π²EI/(4L²), lengths in units of L.
//!
//! For α < 90° and some weight the branch bent against gravity is not connected with the unloaded strip: n falls along it from
//! infinity at small deflections to a fold and rises again. In small deflections, with the mode (1 - cos 2πs)/2,
//!
//! ```text
//! n = 16 - (W + Q)(sin α)/2 + 2π²w² + (2W + Q)(cos α)/(π²w)
//! ```
//!
//! so that the fold is at 6 (W cos α/2π)^(2/3) above the pitchfork of the perfect strip.
//!
//! Table 5.2 prints n = 17.5, 16.9, 15.5 for W = 0.8 and 18.3, 17.3, 15.1 for W = 1.6 at α = 0, 45° and 90°. A weightless strip
//! has 17.4761, 16.8954, 15.5994 and 18.3031, 17.2785, 15.1976, of which those at 90° would round otherwise; with Q = 0.1 all six
//! come out. The printed w at α = 0 (0.1559, 0.1948) are within 0.001 of the folds of the weightless strip, those at 45° (0.1543,
//! 0.2009 against 0.1399, 0.1741) lie well past them.

use crate::path::{Curve, PathError};
use crate::roots::root;
use crate::strip::{Shape, UNIT};
use crate::taylor::Section;
use std::f64::consts::PI;

/// The strip.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    /// W, the weight at the middle.
    pub weight: f64,
    /// Q, the weight of the whole strip, spread evenly.
    pub beam_weight: f64,
    /// α, rad.
    pub angle: f64,
    /// EI/(EA L²): zero for a strip that does not stretch.
    pub stretch: f64,
}

// Positions of the unknowns.
const MOMENT: usize = 0;
const SHEAR: usize = 1;
const PUSH: usize = 2;
const MIDDLE: usize = 3;
const STEPS: usize = 16;

impl Slope {
    /// An inextensible strip without weight of its own.
    pub fn new(weight: f64, angle: f64) -> Self {
        Self { weight, beam_weight: 0.0, angle, stretch: 0.0 }
    }

    /// From the moment and the force across at the clamp and the push (in EI/L, EI/L², the unit): the slider's x, y, θ and
    /// the middle's y.
    fn ends(&self, moment: f64, shear: f64, push: f64) -> [f64; 4] {
        let (s, c) = self.angle.sin_cos();
        let load = |weight: f64| [-weight * UNIT * s, -weight * UNIT * c];
        let (point, spread) = (load(self.weight), load(self.beam_weight));
        let section = Section { stretch: self.stretch, load: spread, ..Section::unit() };
        let along = -push * UNIT + point[0] + spread[0];
        let mut middle = section.carry([0.0, 0.0, 0.0, moment, along, shear], 0.5, STEPS);
        let height = middle[1];
        middle[4] -= point[0];
        middle[5] -= point[1];
        let end = section.carry(middle, 0.5, STEPS);
        [end[0], end[1], end[2], height]
    }

    /// The equations in (moment, shear, push, middle).
    fn curve(self) -> Curve<'static> {
        Curve::new(vec![1.0, 1.0, 1.0, 0.1], move |y| {
            let [_, height, angle, middle] = self.ends(y[MOMENT], y[SHEAR], y[PUSH]);
            vec![height, angle, middle - y[MIDDLE]]
        })
    }

    fn shape(&self, y: &[f64]) -> Shape {
        let end = self.ends(y[MOMENT], y[SHEAR], y[PUSH]);
        Shape { push: y[PUSH], middle: y[MIDDLE], slide: end[0] - 1.0 }
    }

    /// The solution of small deflections.
    fn guess(&self, middle: f64) -> Vec<f64> {
        let (s, c) = self.angle.sin_cos();
        let all = self.weight + self.beam_weight;
        let across = (2.0 * self.weight + self.beam_weight) * c;
        let push = 16.0 - 0.5 * all * s + 2.0 * (PI * middle).powi(2) + across / (PI * PI * middle);
        vec![2.0 * PI * PI * middle, -0.5 * all * c * UNIT, push, middle]
    }

    fn point(&self, curve: &Curve, middle: f64) -> Result<Vec<f64>, PathError> {
        let first = middle.clamp(-0.15, 0.15);
        let y = curve.at(&self.guess(first), MIDDLE, first)?;
        let steps = ((middle - first).abs() / 0.04).ceil() as usize;
        if steps == 0 { Ok(y) } else { curve.lead(&y, MIDDLE, middle, steps) }
    }

    /// The shape whose middle is at w/L = `middle`, not zero.
    ///
    /// # Errors
    /// Newton's method fails.
    pub fn at_middle(&self, middle: f64) -> Result<Shape, PathError> {
        Ok(self.shape(&self.point(&self.curve(), middle)?))
    }

    /// The least push of the branch that is bent against gravity.
    ///
    /// # Errors
    /// Newton's method fails, or there is no fold, as without weight across the strip.
    pub fn fold(&self) -> Result<Shape, PathError> {
        let curve = self.curve();
        // Of small deflections.
        let across = (self.weight + 0.5 * self.beam_weight) * self.angle.cos();
        let guess = (across.max(0.0) / (2.0 * PI.powi(4))).cbrt();
        let ends = [self.point(&curve, 0.6 * guess)?, self.point(&curve, 1.4 * guess)?];
        Ok(self.shape(&curve.fold(&ends[0], &ends[1], MIDDLE, PUSH)?))
    }

    /// dn/dW of the fold: the derivative of the push by the weight at the deflection of the fold, where the push does not
    /// depend on the deflection.
    ///
    /// # Errors
    /// As [`Slope::fold`].
    pub fn fold_by_weight(&self) -> Result<f64, PathError> {
        let fold = self.fold()?;
        let push = |weight: f64| Self { weight, ..*self }.at_middle(fold.middle).map(|shape| shape.push);
        // Differences of order four.
        let h = 0.02 * self.weight.abs();
        let near = push(self.weight + h)? - push(self.weight - h)?;
        let far = push(self.weight + 2.0 * h)? - push(self.weight - 2.0 * h)?;
        Ok((8.0 * near - far) / (12.0 * h))
    }

    /// The push at which the straight strip becomes unstable on a wall (α = 90°, where it stays straight).
    ///
    /// # Errors
    /// There is none near 16 - (W + Q)/2.
    pub fn pitchfork(&self) -> Result<f64, PathError> {
        let wall = Self { angle: 0.5 * PI, ..*self };
        let curve = Curve::new(vec![1.0, 1.0, 1.0], move |y| {
            let [_, height, angle, _] = wall.ends(y[MOMENT], y[SHEAR], y[PUSH]);
            vec![height, angle]
        });
        // The straight strip is a solution at every push.
        let push = 16.0 - 0.5 * (self.weight + self.beam_weight);
        root(|n| curve.determinant(&[0.0, 0.0, n], PUSH), push - 2.0, push + 2.0)
            .ok_or(PathError::NoSignChange)
    }
}

/// The slope between two (rad) at which two weights on an inextensible, weightless strip have their folds at the same push;
/// on steeper ones the heavier one needs less.
///
/// With the weights 0.8 and 1.6 of Table 5.2 it is 72.748°. It depends on the weights: small ones cross where (W cos α/2π)^(2/3)
/// outgrows W sin α, nearer to the wall. See [`turning_slope`].
pub fn crossing_slope(weights: [f64; 2], between: [f64; 2]) -> Option<f64> {
    let push = |weight: f64, angle: f64| Slope::new(weight, angle).fold().map_or(f64::NAN, |fold| fold.push);
    root(|angle| push(weights[0], angle) - push(weights[1], angle), between[0], between[1])
}

/// The weight between two at which the curve of folds in the (W, n) plane is highest on the slope `angle` (rad), dn/dW = 0.
/// 72.748° has its top between the two weights that cross there.
pub fn highest_weight(angle: f64, between: [f64; 2]) -> Option<f64> {
    let rate = |weight: f64| Slope::new(weight, angle).fold_by_weight().unwrap_or(f64::NAN);
    root(rate, between[0], between[1])
}

/// The slope between two (rad) at which a little more weight neither raises nor lowers the fold, dn/dW = 0: 75.748° at
/// W = 0.8, 69.810° at W = 1.6, and 90° as the weight vanishes.
pub fn turning_slope(weight: f64, between: [f64; 2]) -> Option<f64> {
    let rate = |angle: f64| Slope::new(weight, angle).fold_by_weight().unwrap_or(f64::NAN);
    root(rate, between[0], between[1])
}

#[cfg(test)]
#[path = "slope_tests.rs"]
mod tests;
