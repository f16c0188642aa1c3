//! Decompositions that end: nalgebra's iterate for ever on a matrix that is not finite.

use nalgebra::{Complex, DMatrix, DVector, Dyn, SVD, Schur};

/// Sweeps for each row; a sound matrix takes two or three.
const SWEEPS: usize = 100;

/// The singular value decomposition, with the vectors that are asked for. None of a matrix with a number that is not finite.
pub fn singular_values(matrix: DMatrix<f64>, left: bool, right: bool) -> Option<SVD<f64, Dyn, Dyn>> {
    let most = SWEEPS * matrix.nrows().max(matrix.ncols());
    is_finite(&matrix).then(|| matrix.try_svd(left, right, 5.0 * f64::EPSILON, most)).flatten()
}

/// All eigenvalues. None of a matrix with a number that is not finite.
pub fn eigenvalues(matrix: DMatrix<f64>) -> Option<DVector<Complex<f64>>> {
    let most = SWEEPS * matrix.nrows();
    let schur = is_finite(&matrix).then(|| Schur::try_new(matrix, f64::EPSILON, most)).flatten();
    schur.map(|schur| schur.complex_eigenvalues())
}

fn is_finite(matrix: &DMatrix<f64>) -> bool {
    matrix.iter().all(|value| value.is_finite())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail where it stands")]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_has_no_decomposition() {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut matrix = DMatrix::identity(4, 4);
            matrix[(1, 2)] = bad;
            assert!(singular_values(matrix.clone(), true, true).is_none());
            assert!(eigenvalues(matrix).is_none());
        }
    }

    #[test]
    fn a_turn_and_a_stretch_have_their_values() {
        let matrix = DMatrix::from_row_slice(2, 2, &[0.0, -2.0, 2.0, 0.0]);
        let svd = singular_values(matrix.clone(), false, true).unwrap();
        assert!((svd.singular_values.max() - 2.0).abs() < 1e-15);
        assert!(eigenvalues(matrix).unwrap().iter().all(|e| (e.im.abs() - 2.0).abs() < 1e-14));
    }
}
