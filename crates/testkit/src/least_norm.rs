//! The least-norm solution of an underdetermined linear system.

use nalgebra::{DMatrix, DVector};

/// x = Aᵀ(A Aᵀ)⁻¹ b for the rows of A; None if they depend on each other. (Golub and Van Loan, *Matrix
/// Computations*, 4th ed. (2013), §5.6.2.)
pub fn least_norm(rows: &[Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
    let columns = rows.first().map_or(0, Vec::len);
    let a = DMatrix::from_fn(rows.len(), columns, |i, j| rows[i][j]);
    let y = (&a * a.transpose()).cholesky()?.solve(&DVector::from_column_slice(b));
    Some((a.transpose() * y).iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close_all;

    #[test]
    fn a_load_on_three_springs_in_line_is_shared() {
        let x = least_norm(&[vec![1.0, 1.0, 1.0]], &[6.0]).unwrap();
        assert_close_all(&x, &[2.0, 2.0, 2.0], 1e-14, "shares");
        assert!(least_norm(&[vec![1.0, 0.0], vec![2.0, 0.0]], &[1.0, 2.0]).is_none());
    }
}
