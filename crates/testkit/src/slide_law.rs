//! How far the slider must come in for a wanted deflection of the strip's middle, whatever the slope: one curve for all, and
//! a cubic through it.
//!
//! The strip of [`crate::slope`] with a weight at its middle that is small against the push bends as the weightless one:
//! u1 = -π²w²/4 for small deflections, since the mode w (1 - cos 2πs)/2 shortens by ½∫y'² = π²w²/4. At W = 0.8 all slopes and both
//! directions of the weight lie within ±0.00174 of their middle up to w = 0.39, where u1 = -0.6.
//!
//! A cubic without constant term is a rough description: fitted to evenly spaced deflections up to 0.39 it is wrong by up to
//! 0.033, and its coefficients depend much on where the points lie, being larger the more of them are near the end. The printed
//! one, 18 w³ + 5.3 w² + 0.85 w with w counted negative, is wrong by up to 0.028 over the same range.

use crate::path::PathError;
use crate::slope::Slope;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// The slides u1/L at the deflections `middles`, of a strip with the weight `weight` on the slopes `angles` (rad, 0 to π/2), each
/// with the weight against the deflection and with it: a row for every deflection.
///
/// # Errors
/// Newton's method fails.
pub fn slides(weight: f64, middles: &[f64], angles: &[f64]) -> Result<Vec<Vec<f64>>, PathError> {
    let row = |middle: f64| {
        let both = angles.iter().flat_map(|angle| [*angle, PI - angle]);
        both.map(|angle| Slope::new(weight, angle).at_middle(middle).map(|shape| shape.slide)).collect()
    };
    middles.iter().map(|middle| row(*middle)).collect()
}

/// The greatest difference in a row.
pub fn spread(rows: &[Vec<f64>]) -> f64 {
    let width = |row: &Vec<f64>| {
        let least = row.iter().copied().fold(f64::INFINITY, f64::min);
        row.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
    };
    rows.iter().map(width).fold(0.0, f64::max)
}

/// A cubic u1/L = c1 w + c2 w² + c3 w³ with w >= 0 the deflection w/L.
#[derive(Clone, Copy, Debug)]
pub struct Cubic {
    /// c1, c2, c3.
    pub coefficients: [f64; 3],
}

impl Cubic {
    /// The least-squares fit to rows of slides at the deflections `middles`.
    pub fn fit(middles: &[f64], rows: &[Vec<f64>]) -> Option<Self> {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (w, row) in middles.iter().zip(rows) {
            let powers = Vector3::new(*w, w * w, w * w * w);
            normal += powers * powers.transpose() * row.len() as f64;
            right += powers * row.iter().sum::<f64>();
        }
        let c = normal.cholesky()?.solve(&right);
        Some(Self { coefficients: [c.x, c.y, c.z] })
    }

    /// Its value.
    pub fn at(&self, w: f64) -> f64 {
        let [c1, c2, c3] = self.coefficients;
        w * (c1 + w * (c2 + w * c3))
    }

    /// The greatest difference from rows of slides.
    pub fn error(&self, middles: &[f64], rows: &[Vec<f64>]) -> f64 {
        let all =
            middles.iter().zip(rows).flat_map(|(w, row)| row.iter().map(|slide| (slide - self.at(*w)).abs()));
        all.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::strip::weightless;

    #[test]
    fn the_slide_hardly_depends_on_the_slope() {
        let angles = [0.0, 0.25 * PI, 0.5 * PI];
        for (middle, wide) in [(0.1, 1.71e-4), (0.3, 8.3e-4), (0.38, 2.46e-3), (0.39, 3.48e-3)] {
            let rows = slides(0.8, &[middle], &angles).unwrap();
            assert_eq!(rows[0].len(), 6);
            assert_close(spread(&rows), wide, 1e-5, "spread");
        }
        // Small deflections, without weight.
        let shape = weightless(16.01).unwrap();
        assert_close(shape.slide / -(0.5 * PI * shape.middle).powi(2), 1.0, 1e-3, "π²w²/4");
        let rows = slides(0.0, &[shape.middle], &[0.0]).unwrap();
        assert_close(rows[0][0], shape.slide, 1e-12, "weightless");
    }

    #[test]
    fn the_cubic_is_a_rough_fit() {
        // (5.5) with its sign mended: -18 w³ + 5.3 w² - 0.85 w for w >= 0.
        let printed = Cubic { coefficients: [-0.85, 5.3, -18.0] };
        let middles: Vec<f64> = (1..=39).map(|i| 0.01 * f64::from(i)).collect();
        let rows = slides(0.8, &middles, &[0.0, 0.25 * PI, 0.5 * PI]).unwrap();
        let fit = Cubic::fit(&middles, &rows).unwrap();
        for (found, wanted) in fit.coefficients.iter().zip([-0.307_424, 1.209_394, -10.671_961]) {
            assert_close(*found, wanted, 1e-6 * wanted.abs(), "coefficient");
        }
        assert_close(fit.error(&middles, &rows), 0.0331, 2e-4, "error of the fit");
        assert_close(printed.error(&middles, &rows), 0.0275, 2e-4, "error of the printed cubic");
    }

    #[test]
    fn a_cubic_is_fitted_by_itself() {
        let cubic = Cubic { coefficients: [0.5, -2.0, 3.0] };
        let middles = [0.1, 0.2, 0.3, 0.4];
        let rows: Vec<Vec<f64>> = middles.iter().map(|w| vec![cubic.at(*w)]).collect();
        let fit = Cubic::fit(&middles, &rows).unwrap();
        assert_close(fit.error(&middles, &rows), 0.0, 1e-13, "error");
    }
}
