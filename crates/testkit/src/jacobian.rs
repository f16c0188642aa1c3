//! Numerical Jacobians to check analytic ones by.

use nalgebra::{Complex, DMatrix};

/// Weights of the central difference of order eight, for ±h, ±2h, ±3h, ±4h (Fornberg, *Math. Comp.* 51
/// (1988) 699).
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// ∂f_i/∂x_j by central differences of order eight with steps `step` times max(1, |x_j|).
///
/// The truncation error is of the order of step⁸, the round-off of 1e-16/step: 1e-2 suits functions that
/// vary over lengths of order one.
pub fn numerical_jacobian(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64], step: f64) -> DMatrix<f64> {
    let rows = f(x).len();
    let mut jacobian = DMatrix::zeros(rows, x.len());
    for j in 0..x.len() {
        let h = step * x[j].abs().max(1.0);
        for (i, weight) in WEIGHTS.iter().enumerate() {
            let offset = h * (i as f64 + 1.0);
            let at = |offset: f64| {
                let mut moved = x.to_vec();
                moved[j] += offset;
                f(&moved)
            };
            let (plus, minus) = (at(offset), at(-offset));
            for row in 0..rows {
                jacobian[(row, j)] += weight * (plus[row] - minus[row]) / h;
            }
        }
    }
    jacobian
}

/// Fails unless the analytic Jacobian agrees with [`numerical_jacobian`] (step 1e-2) to `tolerance`
/// relative to its largest entry (at least 1).
#[track_caller]
pub fn check_jacobian(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64], analytic: &DMatrix<f64>, tolerance: f64) {
    compare(&numerical_jacobian(f, x, 1e-2), analytic, tolerance);
}

/// As [`check_jacobian`], by the complex step ∂f/∂x = Im f(x + ih)/h, exact to round-off, for functions that
/// are written for complex numbers (Squire and Trapp, *SIAM Review* 40 (1998) 110).
#[track_caller]
pub fn check_jacobian_complex(
    f: impl Fn(&[Complex<f64>]) -> Vec<Complex<f64>>,
    x: &[f64],
    analytic: &DMatrix<f64>,
    tolerance: f64,
) {
    const STEP: f64 = 1e-100;
    let columns: Vec<Vec<f64>> = (0..x.len())
        .map(|j| {
            let mut moved: Vec<_> = x.iter().map(|x| Complex::new(*x, 0.0)).collect();
            moved[j].im = STEP;
            f(&moved).iter().map(|value| value.im / STEP).collect()
        })
        .collect();
    let rows = columns.first().map_or(0, Vec::len);
    compare(&DMatrix::from_fn(rows, x.len(), |i, j| columns[j][i]), analytic, tolerance);
}

#[track_caller]
fn compare(numerical: &DMatrix<f64>, analytic: &DMatrix<f64>, tolerance: f64) {
    assert_eq!(numerical.shape(), analytic.shape(), "the Jacobian has a different shape");
    let scale = numerical.amax().max(1.0);
    for i in 0..numerical.nrows() {
        for j in 0..numerical.ncols() {
            let (n, a) = (numerical[(i, j)], analytic[(i, j)]);
            let error = (n - a).abs() / scale;
            assert!(
                error <= tolerance,
                "Jacobian entry ({i}, {j}): analytic {a:.15e}, numerical {n:.15e}, relative error {error:.2e}"
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(x: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[x[0].cos() * x[1], x[0].sin(), x[0].exp(), 2.0 * x[1]])
    }

    #[test]
    fn both_ways_agree_with_the_exact_derivative() {
        let x = [0.7, -1.3];
        check_jacobian(|x| vec![x[0].sin() * x[1], x[0].exp() + x[1] * x[1]], &x, &exact(&x), 1e-12);
        check_jacobian_complex(|x| vec![x[0].sin() * x[1], x[0].exp() + x[1] * x[1]], &x, &exact(&x), 1e-15);
    }

    #[test]
    #[should_panic(expected = "Jacobian entry (1, 0)")]
    fn a_wrong_entry_is_named() {
        let x = [0.7, -1.3];
        let mut wrong = exact(&x);
        wrong[(1, 0)] += 1e-6;
        check_jacobian(|x| vec![x[0].sin() * x[1], x[0].exp() + x[1] * x[1]], &x, &wrong, 1e-10);
    }
}
