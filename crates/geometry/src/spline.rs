//! The C² cubic spline through points, over chord length, with not-a-knot ends.
//!
//! Not-a-knot (the first two and the last two pieces are one cubic) keeps fourth-order accuracy up to
//! the ends; natural ends would force the curvature to zero there. Three points give the parabola through
//! them, two points a straight line. Source: de Boor, *A Practical Guide to Splines* (2001), ch. IV.

use crate::ShapeError;
use flexura_spatial::Vector3;
use nalgebra::DMatrix;

/// A cubic spline curve.
#[derive(Clone, Debug)]
pub(crate) struct Spline {
    /// Cumulative chord length at the points, m.
    knots: Vec<f64>,
    points: Vec<Vector3<f64>>,
    /// First derivative at the points.
    slopes: Vec<Vector3<f64>>,
}

impl Spline {
    /// The spline through the points (metres).
    pub fn new(points: &[Vector3<f64>]) -> Result<Self, ShapeError> {
        if points.len() < 2 {
            return Err(ShapeError::TooFewPoints { count: points.len() });
        }
        if let Some(index) = points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(ShapeError::PointNotFinite { index });
        }
        let extent = points.iter().map(|p| (p - points[0]).norm()).fold(0.0, f64::max);
        let mut knots = vec![0.0];
        for (i, pair) in points.windows(2).enumerate() {
            let chord = (pair[1] - pair[0]).norm();
            if chord <= 1e-14 * extent || chord == 0.0 {
                return Err(ShapeError::DuplicatePoint { first: i });
            }
            knots.push(knots[i] + chord);
        }
        let slopes = slopes(&knots, points);
        Ok(Self { knots, points: points.to_vec(), slopes })
    }

    /// The spline with the given values at given, increasing knots.
    pub fn over(knots: &[f64], points: &[Vector3<f64>]) -> Self {
        Self { knots: knots.to_vec(), points: points.to_vec(), slopes: slopes(knots, points) }
    }

    /// The closed spline through the points (metres), which leads from the last back to the first and is smooth there too.
    pub fn closed(points: &[Vector3<f64>]) -> Result<Self, ShapeError> {
        if points.len() < 3 {
            return Err(ShapeError::TooFewPoints { count: points.len() });
        }
        let mut around = points.to_vec();
        around.push(points[0]);
        let mut spline = Self::new(&around)?;
        spline.slopes = closed_slopes(&spline.knots, &around);
        Ok(spline)
    }

    /// Cumulative chord length at the points: the parameter's range and where the third derivative jumps.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The point and its first three derivatives at parameter `t`.
    pub fn jet(&self, t: f64) -> [Vector3<f64>; 4] {
        let last = self.knots.len() - 2;
        let i = self.knots.partition_point(|knot| *knot <= t).saturating_sub(1).min(last);
        let h = self.knots[i + 1] - self.knots[i];
        let u = t - self.knots[i];
        let secant = (self.points[i + 1] - self.points[i]) / h;
        let (d0, d1) = (self.slopes[i], self.slopes[i + 1]);
        let c2 = (secant * 3.0 - d0 * 2.0 - d1) / h;
        let c3 = (d0 + d1 - secant * 2.0) / (h * h);
        [
            self.points[i] + (d0 + (c2 + c3 * u) * u) * u,
            d0 + (c2 * 2.0 + c3 * (3.0 * u)) * u,
            c2 * 2.0 + c3 * (6.0 * u),
            c3 * 6.0,
        ]
    }
}

/// First derivatives at the points that make the second derivative continuous.
///
/// Inner rows: h_i d_{i-1} + 2 (h_{i-1} + h_i) d_i + h_{i-1} d_{i+1} = 3 (h_i m_{i-1} + h_{i-1} m_i),
/// with the secant slopes m. The not-a-knot end rows have two entries each, so the system is tridiagonal.
fn slopes(knots: &[f64], points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let n = points.len();
    let h: Vec<f64> = knots.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let m: Vec<Vector3<f64>> = (0..n - 1).map(|i| (points[i + 1] - points[i]) / h[i]).collect();
    if n == 2 {
        return vec![m[0]; 2];
    }
    if n == 3 {
        // The parabola: its slope at the middle is the weighted mean of the secants.
        let middle = (m[0] * h[1] + m[1] * h[0]) / (h[0] + h[1]);
        return vec![m[0] * 2.0 - middle, middle, m[1] * 2.0 - middle];
    }
    let (mut lower, mut diagonal, mut upper) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut right = DMatrix::<f64>::zeros(n, 3);
    let mut set = |row: usize, value: Vector3<f64>| right.set_row(row, &value.transpose());
    let span = h[0] + h[1];
    diagonal[0] = h[1];
    upper[0] = span;
    set(0, (m[0] * (h[1] * (h[0] + 2.0 * span)) + m[1] * (h[0] * h[0])) / span);
    for i in 1..n - 1 {
        lower[i] = h[i];
        diagonal[i] = 2.0 * (h[i - 1] + h[i]);
        upper[i] = h[i - 1];
        set(i, (m[i - 1] * h[i] + m[i] * h[i - 1]) * 3.0);
    }
    let (a, b) = (h[n - 2], h[n - 3]);
    let span = a + b;
    lower[n - 1] = span;
    diagonal[n - 1] = b;
    set(n - 1, (m[n - 2] * (b * (a + 2.0 * span)) + m[n - 3] * (a * a)) / span);
    // Elimination without exchange, as for every diagonally dominant inner block (de Boor, ch. IV).
    for i in 1..n {
        let factor = lower[i] / diagonal[i - 1];
        diagonal[i] -= factor * upper[i - 1];
        let above = right.row(i - 1) * factor;
        let mut row = right.row_mut(i);
        row -= above;
    }
    let mut slopes = vec![Vector3::zeros(); n];
    for i in (0..n).rev() {
        let mut value = right.row(i).transpose().fixed_rows::<3>(0).into_owned();
        if i + 1 < n {
            value -= slopes[i + 1] * upper[i];
        }
        slopes[i] = value / diagonal[i];
    }
    slopes
}

/// The same where the last point is the first: the rows are cyclic, and Sherman and Morrison's formula leads them back to
/// tridiagonal ones (Press et al., *Numerical Recipes*, 2.7).
fn closed_slopes(knots: &[f64], points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let n = points.len() - 1;
    let h: Vec<f64> = knots.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let m: Vec<Vector3<f64>> = (0..n).map(|i| (points[i + 1] - points[i]) / h[i]).collect();
    let before = |i: usize| (i + n - 1) % n;
    let mut diagonal: Vec<f64> = (0..n).map(|i| 2.0 * (h[before(i)] + h[i])).collect();
    // The corners: row 0 holds h_0 at d_{n-1}, row n-1 holds h_{n-2} at d_0.
    let (top, bottom) = (h[0], h[before(n - 1)]);
    let gamma = -diagonal[0];
    diagonal[0] -= gamma;
    diagonal[n - 1] -= top * bottom / gamma;
    // Row by row: three components of the slope, and the correction vector (gamma, 0, .., bottom).
    let mut right: Vec<[f64; 4]> = (0..n)
        .map(|i| {
            let value = (m[before(i)] * h[i] + m[i] * h[before(i)]) * 3.0;
            let corner = if i == 0 {
                gamma
            } else if i == n - 1 {
                bottom
            } else {
                0.0
            };
            [value.x, value.y, value.z, corner]
        })
        .collect();
    for i in 1..n {
        // Lower entry of row i is h_i, upper entry of the row before is h_{i-2}.
        let factor = h[i] / diagonal[i - 1];
        diagonal[i] -= factor * h[before(i - 1)];
        for c in 0..4 {
            right[i][c] -= factor * right[i - 1][c];
        }
    }
    for i in (0..n).rev() {
        for c in 0..4 {
            let above = if i + 1 < n { right[i + 1][c] * h[before(i)] } else { 0.0 };
            right[i][c] = (right[i][c] - above) / diagonal[i];
        }
    }
    let ratio = top / gamma;
    let denominator = 1.0 + right[0][3] + ratio * right[n - 1][3];
    let mut slopes: Vec<Vector3<f64>> = (0..n)
        .map(|i| {
            let part =
                |c: usize| right[i][c] - right[i][3] * (right[0][c] + ratio * right[n - 1][c]) / denominator;
            Vector3::new(part(0), part(1), part(2))
        })
        .collect();
    slopes.push(slopes[0]);
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_spline_is_twice_continuously_differentiable_everywhere() {
        for count in [3, 4, 7] {
            let points: Vec<_> = (0..count)
                .map(|i| {
                    let t = f64::from(i) * 5.9 / f64::from(count);
                    Vector3::new(2.0 * t.cos(), t.sin(), 0.0)
                })
                .collect();
            let spline = Spline::closed(&points).expect("good points");
            let knots = spline.knots().to_vec();
            let last = knots[knots.len() - 1];
            for (i, knot) in knots.iter().enumerate() {
                let after = if i + 1 == knots.len() { spline.jet(1e-12) } else { spline.jet(knot + 1e-12) };
                let before = if i == 0 { spline.jet(last - 1e-12) } else { spline.jet(knot - 1e-12) };
                for order in 0..3 {
                    assert!((before[order] - after[order]).norm() < 1e-10, "{count} {i} {order}");
                }
            }
        }
    }

    #[test]
    fn the_spline_interpolates_and_is_twice_continuously_differentiable() {
        let points: Vec<_> = [0.0f64, 0.7, 1.1, 2.3, 2.9, 4.0, 4.4]
            .iter()
            .map(|t| Vector3::new(t.cos(), t.sin(), 0.3 * t * t))
            .collect();
        let spline = Spline::new(&points).expect("good points");
        for (i, knot) in spline.knots().to_vec().iter().enumerate() {
            assert!((spline.jet(*knot)[0] - points[i]).norm() < 1e-14);
            let (before, after) = (spline.jet(knot - 1e-9), spline.jet(knot + 1e-9));
            assert!((before[1] - after[1]).norm() < 1e-7 && (before[2] - after[2]).norm() < 1e-7);
        }
        // Not-a-knot: the first two pieces are one cubic, the last two as well.
        for (a, b) in [(0, 1), (4, 5)] {
            let middle = |i: usize| 0.5 * (spline.knots()[i] + spline.knots()[i + 1]);
            assert!((spline.jet(middle(a))[3] - spline.jet(middle(b))[3]).norm() < 1e-11);
        }
    }

    #[test]
    fn three_points_give_a_parabola_and_four_a_single_cubic() {
        let cubic = |t: f64| Vector3::new(t, 0.0, 0.0);
        let spline = Spline::new(&[cubic(0.0), cubic(1.0), cubic(2.5), cubic(3.0)]).expect("points");
        assert!((spline.jet(1.7)[0].x - 1.7).abs() < 1e-14 && spline.jet(1.7)[3].norm() < 1e-13);
        let three = [Vector3::zeros(), Vector3::new(1.0, 1.0, 0.0), Vector3::new(2.0, 0.0, 0.0)];
        let spline = Spline::new(&three).expect("points");
        assert!(
            spline.jet(0.4)[3].norm() < 1e-14 && (spline.jet(0.4)[2] - spline.jet(2.0)[2]).norm() < 1e-13
        );
    }

    #[test]
    fn coinciding_or_missing_points_are_refused() {
        let p = Vector3::new(1.0, 2.0, 3.0);
        assert_eq!(Spline::new(&[p]).unwrap_err(), ShapeError::TooFewPoints { count: 1 });
        let twice = [Vector3::zeros(), p, p];
        assert_eq!(Spline::new(&twice).unwrap_err(), ShapeError::DuplicatePoint { first: 1 });
        let nan = [Vector3::zeros(), Vector3::new(f64::NAN, 0.0, 0.0)];
        assert_eq!(Spline::new(&nan).unwrap_err(), ShapeError::PointNotFinite { index: 1 });
    }
}
