//! Is a design an optimum? The conditions of Karush, Kuhn and Tucker.
//!
//! Multipliers λ ≥ 0 of active inequalities and bounds, and μ of equalities, must balance the gradient of the objective:
//!
//! ```text
//!   ∇f + Σ λ_i ∇c_i + Σ μ_j ∇h_j = 0.
//! ```
//!
//! They are found by least squares over what is active, of which a multiplier of the wrong sign is taken out, the worst first.

use nalgebra::{DMatrix, DVector};

/// What may hold the objective back: its gradient, and whether its multiplier may have any sign.
pub(crate) struct Row {
    pub gradient: Vec<f64>,
    pub is_equality: bool,
}

/// Multipliers parallel to the rows, and the largest component of what they leave of the gradient.
pub(crate) fn multipliers(gradient: &[f64], rows: &[Row]) -> (Vec<f64>, f64) {
    let n = gradient.len();
    let mut taken: Vec<usize> = (0..rows.len()).collect();
    let target = DVector::from_iterator(n, gradient.iter().map(|g| -g));
    loop {
        let mut all = vec![0.0; rows.len()];
        if taken.is_empty() {
            return (all, target.amax());
        }
        let matrix = DMatrix::from_fn(n, taken.len(), |i, k| rows[taken[k]].gradient[i]);
        let svd = matrix.clone().svd(true, true);
        let largest = svd.singular_values.amax();
        let Ok(solved) = svd.solve(&target, 1e-12 * largest.max(f64::MIN_POSITIVE)) else {
            return (all, f64::INFINITY);
        };
        let wrong = (0..taken.len())
            .filter(|k| !rows[taken[*k]].is_equality && solved[*k] < 0.0)
            .min_by(|a, b| solved[*a].total_cmp(&solved[*b]));
        if let Some(k) = wrong {
            taken.remove(k);
            continue;
        }
        for (k, row) in taken.iter().enumerate() {
            all[*row] = solved[k];
        }
        return (all, (matrix * solved - target).amax());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// min x + y under x² + y² ≤ 2: at (-1, -1) the multiplier is 1/2.
    #[test]
    fn the_multiplier_of_a_disc_is_a_half() {
        let row = Row { gradient: vec![-2.0, -2.0], is_equality: false };
        let (found, rest) = multipliers(&[1.0, 1.0], &[row]);
        assert!((found[0] - 0.5).abs() < 1e-14 && rest < 1e-14);
    }

    #[test]
    fn a_bound_that_pulls_the_wrong_way_holds_nothing() {
        let row = Row { gradient: vec![1.0, 0.0], is_equality: false };
        let (found, rest) = multipliers(&[1.0, 0.0], &[row]);
        assert_eq!((found[0], rest), (0.0, 1.0));
    }
}
