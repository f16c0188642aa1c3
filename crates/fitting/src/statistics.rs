//! What residuals and their Jacobian say of the estimates: G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989), chapter 5; for
//! losses that are not squares P. J. Huber, Robust Statistics (1981), section 7.6.

use crate::least_squares::{Loss, Minimum};
use flexura_spatial::singular_values;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor, StudentsT};

/// Singular values below this part of the largest are none: the data do not see their direction.
const RANK: f64 = 1e-8;

/// Half the width of a two-sided interval in standard errors.
pub(crate) fn student(confidence: f64, freedom: usize) -> Option<f64> {
    let law = StudentsT::new(0.0, 1.0, freedom as f64).ok()?;
    Some(law.inverse_cdf(0.5 + 0.5 * confidence)).filter(|t| t.is_finite())
}

/// What a ratio of mean squares stays below with that probability.
pub(crate) fn fisher(confidence: f64, above: usize, below: usize) -> Option<f64> {
    let law = FisherSnedecor::new(above as f64, below as f64).ok()?;
    Some(law.inverse_cdf(confidence)).filter(|f| f.is_finite())
}

/// What is known of the variables at a minimum.
pub(crate) struct Knowledge {
    /// Variance of the residuals.
    pub variance: f64,
    /// Residuals less what they determine.
    pub freedom: usize,
    /// Covariance of the variables; of what the data do not see, and of what is held, nothing.
    pub covariance: DMatrix<f64>,
    /// Is each variable determined?
    pub is_seen: Vec<bool>,
    /// Directions that the data do not see.
    pub unseen: Vec<DVector<f64>>,
    /// Directions that are least determined among those that are seen, with their standard deviations.
    pub weak: Vec<(DVector<f64>, f64)>,
}

impl Knowledge {
    /// `held` variables stand at their bounds and are taken as known.
    pub fn of(minimum: &Minimum, loss: Loss, held: &[bool]) -> Option<Self> {
        let (n, all) = (minimum.residuals.len(), minimum.x.len());
        let free: Vec<usize> = (0..all).filter(|k| !held[*k]).collect();
        let p = free.len();
        let mut matrix = DMatrix::from_fn(n, p, |i, k| minimum.jacobian[(i, free[k])]);
        let weights: Vec<f64> = minimum.residuals.iter().map(|r| loss.weight(*r)).collect();
        // Huber's: the bent loss takes residuals for smaller, and slopes too.
        let bends: Vec<f64> = minimum.residuals.iter().map(|r| loss.bend(*r)).collect();
        let mean = bends.iter().sum::<f64>() / n.max(1) as f64;
        let freedom = n.saturating_sub(p);
        let sum: f64 = minimum.residuals.iter().zip(&weights).map(|(r, w)| (r * w).powi(2)).sum();
        let spare = freedom.max(1) as f64;
        let correction = if mean > 0.0 { 1.0 + p as f64 / n as f64 * (1.0 - mean) / mean } else { 1.0 };
        let variance = sum / spare / mean.max(1e-3).powi(2) * correction.powi(2);
        // Many rows: their triangle has the same singular values.
        if n > p && p > 0 {
            matrix = matrix.qr().r();
        }
        let mut covariance = DMatrix::zeros(all, all);
        let (mut unseen, mut weak) = (Vec::new(), Vec::new());
        let mut is_seen = vec![true; all];
        if p > 0 {
            let svd = singular_values(matrix, false, true)?;
            let vt = svd.v_t?;
            let largest = svd.singular_values.max();
            // Fewer rows than columns have no singular values for the rest.
            for k in 0..p {
                let sigma = svd.singular_values.get(k).copied().unwrap_or(0.0);
                let has_row = k < vt.nrows();
                let mut direction = DVector::zeros(all);
                if has_row {
                    free.iter().enumerate().for_each(|(j, place)| direction[*place] = vt[(k, j)]);
                }
                if sigma > RANK * largest {
                    covariance += &direction * direction.transpose() * (variance / (sigma * sigma));
                    weak.push((direction, variance.sqrt() / sigma));
                } else {
                    (0..all).filter(|j| direction[*j].abs() > 1e-6).for_each(|j| is_seen[j] = false);
                    unseen.push(direction);
                }
            }
        }
        Some(Self { variance, freedom, covariance, is_seen, unseen, weak })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Any table of Student's t and of F, 95 %.
        for (freedom, t) in [(1, 12.706), (7, 2.365), (30, 2.042)] {
            assert!((student(0.95, freedom).unwrap() - t).abs() < 1e-3);
        }
        for (above, below, f) in [(1, 7, 5.591), (5, 10, 3.326), (50, 343, 1.390)] {
            let own = fisher(0.95, above, below).unwrap();
            assert!((own - f).abs() < 1e-2, "{own} {f}");
        }
        assert_eq!(student(0.95, 0), None);
    }
}
