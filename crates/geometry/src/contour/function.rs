//! A function of one variable through given values.

use crate::spline::Spline;
use flexura_spatial::Vector3;

/// The C² cubic spline (not-a-knot) y(x) through points of increasing x.
#[derive(Clone, Debug)]
pub struct FunctionSpline {
    spline: Spline,
    range: [f64; 2],
}

impl FunctionSpline {
    /// None unless there are at least two points, finite, with increasing x.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let increasing = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        let finite = points.iter().flatten().all(|x| x.is_finite());
        if points.len() < 2 || !increasing || !finite {
            return None;
        }
        let knots: Vec<f64> = points.iter().map(|[x, _]| *x).collect();
        let values: Vec<_> = points.iter().map(|[_, y]| Vector3::new(*y, 0.0, 0.0)).collect();
        let range = [knots[0], knots[knots.len() - 1]];
        Some(Self { spline: Spline::over(&knots, &values), range })
    }

    /// First and last x.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// y and its first three derivatives; the end pieces go on beyond the range.
    pub fn jet(&self, x: f64) -> [f64; 4] {
        self.spline.jet(x).map(|v| v.x)
    }
}
