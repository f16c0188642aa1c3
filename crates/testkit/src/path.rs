//! Curves of equilibria: m smooth equations in m + 1 unknowns, followed by one of the unknowns at a time.
//!
//! Which unknown leads is chosen anew at every point, the one that changes most (W. C. Rheinboldt, *Numerical Analysis of
//! Parametrized Nonlinear Equations* (1986), ch. 4). A fold of a coordinate is where its derivative by the leading unknown
//! vanishes, a branch point where the other columns of the Jacobian become dependent: both are roots of functions of the
//! leading unknown alone, each value of which takes a solution by Newton's method. No arc length, no extended system.

use crate::chebyshev::{interpolate, points};
use crate::jacobian::numerical_jacobian;
use crate::roots::{root, root_within};
use nalgebra::{DMatrix, DVector};

type Residual<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + 'a>;

/// The equations.
pub struct Curve<'a> {
    residual: Residual<'a>,
    scales: Vec<f64>,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathError {
    /// Newton's method did not converge where the leading unknown has this value; its last scaled step.
    NotConverged {
        /// The leading unknown.
        value: f64,
        /// Largest scaled change of the last step.
        step: f64,
    },
    /// Nothing changes sign between the two points.
    NoSignChange,
    /// The path was not left by the condition within the allowed number of points.
    TooLong,
}

/// A point of a path: the unknowns, the direction in which the path goes on, and the unknown that leads.
#[derive(Clone, Debug)]
pub struct Point {
    /// The unknowns.
    pub at: Vec<f64>,
    /// The direction; of length one in the unknowns divided by their sizes.
    pub slope: Vec<f64>,
    /// The unknown that leads from here to the next point.
    pub leading: usize,
}

impl<'a> Curve<'a> {
    /// The curve of `residual` = 0, which takes as many unknowns as there are `scales` (their sizes) and returns one value
    /// fewer, of sizes near one.
    pub fn new(scales: Vec<f64>, residual: impl Fn(&[f64]) -> Vec<f64> + 'a) -> Self {
        Self { residual: Box::new(residual), scales }
    }

    /// The point where the unknown `leading` has the value `value`, by Newton's method from `guess`.
    ///
    /// # Errors
    /// Newton's method fails.
    pub fn at(&self, guess: &[f64], leading: usize, value: f64) -> Result<Vec<f64>, PathError> {
        let mut y = guess.to_vec();
        y[leading] = value;
        let others: Vec<usize> = (0..y.len()).filter(|&j| j != leading).collect();
        let mut step = f64::INFINITY;
        for _ in 0..30 {
            let mut residual = DVector::from_vec((self.residual)(&y));
            let jacobian = self.rough_jacobian(&y).remove_column(leading);
            if !jacobian.lu().solve_mut(&mut residual) {
                break;
            }
            step = residual.amax();
            for (change, &j) in residual.iter().zip(&others) {
                y[j] -= change * self.scales[j];
            }
            // What is left is the product of this step and the error of the differences.
            if step < 1e-9 || !step.is_finite() || step > 1e6 {
                break;
            }
        }
        if step < 1e-9 { Ok(y) } else { Err(PathError::NotConverged { value, step }) }
    }

    /// The Jacobian by the scaled unknowns, differences of order two: good for Newton's method and for signs.
    fn rough_jacobian(&self, y: &[f64]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(y.len() - 1, y.len());
        for j in 0..y.len() {
            let h = 1e-5 * self.scales[j];
            let mut moved = y.to_vec();
            moved[j] += h;
            let plus = DVector::from_vec((self.residual)(&moved));
            moved[j] -= 2.0 * h;
            let minus = DVector::from_vec((self.residual)(&moved));
            jacobian.set_column(j, &((plus - minus) / 2e-5));
        }
        jacobian
    }

    /// The same by differences of order eight.
    fn jacobian(&self, y: &[f64]) -> DMatrix<f64> {
        let local = |x: &[f64]| {
            let moved: Vec<f64> = (0..y.len()).map(|j| y[j] + self.scales[j] * x[j]).collect();
            (self.residual)(&moved)
        };
        numerical_jacobian(local, &vec![0.0; y.len()], 2e-3)
    }

    /// The derivatives of all unknowns by the one that leads. None where that one has a fold.
    pub fn slope(&self, y: &[f64], leading: usize) -> Option<Vec<f64>> {
        let scaled = null_vector(self.jacobian(y), leading)?;
        Some(
            scaled
                .iter()
                .zip(&self.scales)
                .map(|(slope, scale)| slope * scale / self.scales[leading])
                .collect(),
        )
    }

    /// The determinant of the derivatives by the scaled unknowns, that of the leading one left out. With the load in
    /// the lead its zeros are the critical points, with another unknown that has no fold the branch points.
    pub fn determinant(&self, y: &[f64], leading: usize) -> f64 {
        self.jacobian(y).remove_column(leading).determinant()
    }

    /// The point between `a` and `b` where `f` vanishes; `leading` is monotone between them.
    ///
    /// # Errors
    /// `f` has the same sign at both, or Newton's method fails between.
    pub fn where_zero(
        &self,
        a: &[f64],
        b: &[f64],
        leading: usize,
        mut f: impl FnMut(&[f64]) -> f64,
    ) -> Result<Vec<f64>, PathError> {
        let (from, to) = (a[leading], b[leading]);
        let mut failure = None;
        // Every solution is the guess for the next.
        let mut last = a.to_vec();
        let value = |value: f64| {
            let far = (value - from).abs() > 0.5 * (to - from).abs();
            if last == a && far {
                last = b.to_vec();
            }
            match self.at(&last, leading, value) {
                Ok(y) => {
                    let result = f(&y);
                    last = y;
                    result
                }
                Err(error) => {
                    failure = Some(error);
                    f64::NAN
                }
            }
        };
        // The functions have noise of this size.
        let found = root_within(value, from, to, 1e-13 * (to - from).abs());
        match found {
            Some(value) => self.at(&last, leading, value),
            None => Err(failure.unwrap_or(PathError::NoSignChange)),
        }
    }

    /// The fold of the unknown `turning` between `a` and `b`; `leading` is monotone between them.
    ///
    /// # Errors
    /// There is none, or Newton's method fails.
    pub fn fold(&self, a: &[f64], b: &[f64], leading: usize, turning: usize) -> Result<Vec<f64>, PathError> {
        self.where_zero(a, b, leading, |y| self.slope(y, leading).map_or(f64::NAN, |slope| slope[turning]))
    }

    /// The branch point between `a` and `b`; `leading` is monotone between them and has no fold.
    ///
    /// Newton's method loses its digits close to a branch point, so that the path and the determinant are
    /// polynomials of degree 12 through points between `a` and `b`, which should lie near each other.
    ///
    /// # Errors
    /// There is none, or Newton's method fails.
    pub fn branch_point(&self, a: &[f64], b: &[f64], leading: usize) -> Result<Vec<f64>, PathError> {
        let mut columns = vec![Vec::new(); a.len() + 1];
        for x in points(12) {
            let part = 0.5 * (1.0 + x);
            let guess: Vec<f64> = a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect();
            let y = self.at(&guess, leading, guess[leading])?;
            columns[a.len()].push([self.determinant(&y, leading)]);
            y.iter().zip(&mut columns).for_each(|(value, column)| column.push([*value]));
        }
        let value = |column: &[[f64; 1]], x: f64| interpolate(column, x)[0];
        let place = root(|x| value(&columns[a.len()], x), -1.0, 1.0).ok_or(PathError::NoSignChange)?;
        Ok(columns[..a.len()].iter().map(|column| value(column, place)).collect())
    }

    /// Goes in `steps` equal steps of the leading unknown from `y` to where it is `to`.
    ///
    /// # Errors
    /// Newton's method fails on the way.
    pub fn lead(&self, y: &[f64], leading: usize, to: f64, steps: usize) -> Result<Vec<f64>, PathError> {
        let from = y[leading];
        let mut y = y.to_vec();
        for i in 1..=steps {
            y = self.at(&y, leading, from + (to - from) * i as f64 / steps as f64)?;
        }
        Ok(y)
    }

    /// Follows the path from a point on it, first with `leading` growing (or falling if `step` is negative), in steps of at most
    /// `|step|` of the scaled unknown that changes most, until `done`; at most 2000 points.
    ///
    /// # Errors
    /// Newton's method fails on ever smaller steps, or the path is too long.
    pub fn trace(
        &self,
        start: &[f64],
        leading: usize,
        step: f64,
        done: impl Fn(&[f64]) -> bool,
    ) -> Result<Vec<Point>, PathError> {
        let mut path: Vec<Point> = Vec::new();
        let stuck = |y: &[f64], leading: usize| PathError::NotConverged { value: y[leading], step: f64::NAN };
        let direction_at = |y: &[f64], leading: usize| {
            null_vector(self.rough_jacobian(y), leading).map(|direction| direction.normalize())
        };
        let mut direction =
            direction_at(start, leading).ok_or_else(|| stuck(start, leading))? * step.signum();
        let mut y = start.to_vec();
        let mut size = step.abs();
        while path.len() < 2000 {
            let leading = direction.iamax();
            let slope: Vec<f64> = direction.iter().zip(&self.scales).map(|(t, s)| t * s).collect();
            path.push(Point { at: y.clone(), slope: slope.clone(), leading });
            if done(&y) {
                return Ok(path);
            }
            size = (1.5 * size).min(step.abs());
            loop {
                let ahead: Vec<f64> = y.iter().zip(&slope).map(|(y, t)| y + size * t).collect();
                if let Ok(next) = self.at(&ahead, leading, ahead[leading]) {
                    let far = (0..y.len()).map(|j| ((next[j] - ahead[j]) / self.scales[j]).abs());
                    let turned = direction_at(&next, leading)
                        .map(|new| if new[leading] * direction[leading] < 0.0 { -new } else { new });
                    let near = far.fold(0.0, f64::max) < 0.3 * size;
                    if let Some(new) = turned.filter(|new| near && new.dot(&direction) > 0.9) {
                        (y, direction) = (next, new);
                        break;
                    }
                }
                size *= 0.5;
                if size < 1e-6 * step.abs() {
                    return Err(stuck(&y, leading));
                }
            }
        }
        Err(PathError::TooLong)
    }

    /// The folds of the unknown `turning` along a traced path, in order.
    ///
    /// # Errors
    /// Newton's method fails between two points of the path.
    pub fn folds(&self, path: &[Point], turning: usize) -> Result<Vec<Vec<f64>>, PathError> {
        let between = path.windows(2).filter(|pair| pair[0].slope[turning] * pair[1].slope[turning] < 0.0);
        between.map(|pair| self.fold(&pair[0].at, &pair[1].at, pair[0].leading, turning)).collect()
    }

    /// The branch points along a traced path, in order.
    ///
    /// # Errors
    /// Newton's method fails between two points of the path.
    pub fn branch_points(&self, path: &[Point]) -> Result<Vec<Vec<f64>>, PathError> {
        let mut found = Vec::new();
        for pair in path.windows(2) {
            let (a, b, leading) = (&pair[0].at, &pair[1].at, pair[0].leading);
            let rough = |y: &[f64]| self.rough_jacobian(y).remove_column(leading).determinant();
            if rough(a) * rough(b) < 0.0 {
                found.push(self.branch_point(a, b, leading)?);
            }
        }
        Ok(found)
    }
}

/// The vector with one in the place `leading` that the matrix, of one column more than rows, takes to nothing.
fn null_vector(jacobian: DMatrix<f64>, leading: usize) -> Option<DVector<f64>> {
    let right = -jacobian.column(leading).clone_owned();
    let others = jacobian.remove_column(leading).lu().solve(&right)?;
    Some(others.insert_row(leading, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    /// x³ - 3x = y: folds of y at x = ±1.
    fn cubic() -> Curve<'static> {
        Curve::new(vec![1.0, 2.0], |y| vec![y[0].powi(3) - 3.0 * y[0] - y[1]])
    }

    #[test]
    fn a_curve_is_followed_through_its_folds() {
        let curve = cubic();
        let path = curve.trace(&[-2.0, -2.0], 0, 0.2, |y| y[0] > 2.0).unwrap();
        let folds = curve.folds(&path, 1).unwrap();
        assert_eq!(folds.len(), 2);
        for (fold, (x, y)) in folds.iter().zip([(-1.0, 2.0), (1.0, -2.0)]) {
            assert_close(fold[0], x, 1e-12, "x");
            assert_close(fold[1], y, 1e-14, "y");
        }
    }

    #[test]
    fn a_closed_curve_has_folds_of_both_unknowns() {
        let curve = Curve::new(vec![1.0, 1.0], |y| vec![y[0] * y[0] + 4.0 * y[1] * y[1] - 1.0]);
        let path = curve.trace(&[0.6, 0.4], 0, -0.1, |y| y[0] > 0.6 && y[1] > 0.0 && y[1] < 0.399).unwrap();
        let folds = [0, 1].map(|turning| curve.folds(&path, turning).unwrap());
        assert_eq!(folds[0].len(), 2, "left and right");
        assert_close(folds[0][0][0], -1.0, 1e-12, "left");
        assert_close(folds[1][0][1], 0.5, 1e-12, "top");
    }

    #[test]
    fn a_pitchfork_is_found_on_its_handle() {
        // x (y - 1 - x²) = 0 along x = 0, and the fold of x (y - 1 - x²) = e at y = 1 + 3 (e/2)^(2/3).
        let curve = Curve::new(vec![1.0, 1.0], |y| vec![y[0] * (y[1] - 1.0 - y[0] * y[0])]);
        let found = curve.branch_point(&[0.0, 0.0], &[0.0, 2.5], 1).unwrap();
        assert_close(found[1], 1.0, 1e-12, "branch point");
        let bent = Curve::new(vec![1.0, 1.0], |y| vec![y[0] * (y[1] - 1.0 - y[0] * y[0]) - 1e-3]);
        let ends = [0.03, 0.5].map(|x| bent.at(&[x, 1.0 + x * x + 1e-3 / x], 0, x).unwrap());
        let fold = bent.fold(&ends[0], &ends[1], 0, 1).unwrap();
        assert_close(fold[1], 1.0 + 3.0 * 5e-4f64.powf(2.0 / 3.0), 1e-14, "fold");
    }

    #[test]
    fn what_is_not_there_is_said() {
        let curve = cubic();
        assert_eq!(curve.fold(&[1.5, -1.125], &[3.0, 18.0], 0, 1), Err(PathError::NoSignChange));
        let nowhere = Curve::new(vec![1.0, 1.0], |y| vec![y[0] * y[0] + 1.0 + y[1] * y[1]]);
        assert!(matches!(nowhere.at(&[0.3, 0.0], 1, 0.5), Err(PathError::NotConverged { .. })));
    }
}
