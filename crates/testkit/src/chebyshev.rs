//! Chebyshev-Lobatto points, integration and interpolation.
//!
//! Trefethen, *Spectral Methods in MATLAB* (2000), ch. 6; Berrut and Trefethen, *SIAM Review* 46 (2004) 501.

use nalgebra::DMatrix;
use std::f64::consts::PI;

/// The `degree + 1` points -cos(iπ/degree), increasing from -1 to 1.
pub fn points(degree: usize) -> Vec<f64> {
    // The sine of the distance from the middle is exactly antisymmetric.
    (0..=degree).map(|i| (PI * (2.0 * i as f64 - degree as f64) / (2.0 * degree as f64)).sin()).collect()
}

/// Barycentric weights of [`points`]: ±1, halved at the ends.
fn weight(i: usize, degree: usize) -> f64 {
    let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    if i == 0 || i == degree { 0.5 * sign } else { sign }
}

/// The matrix Q with (Q f)_i = ∫ from -1 to x_i of the polynomial through f at [`points`].
///
/// The polynomial's Chebyshev coefficients are a discrete cosine sum, and
/// ∫T_k = ½ [T_{k+1}/(k+1) - T_{k-1}/(k-1)]: no entry suffers from cancellation.
pub fn integration(degree: usize) -> DMatrix<f64> {
    let x = points(degree);
    let half = |k: usize| if k == 0 || k == degree { 0.5 } else { 1.0 };
    // T_k(x_i) = cos(k (degree - i)π/degree) for increasing x_i.
    let chebyshev = |k: usize, i: usize| {
        let turn = (k * (degree - i)) % (2 * degree);
        (PI * turn as f64 / degree as f64).cos()
    };
    let primitive = |k: usize, i: usize| match k {
        0 => x[i] + 1.0,
        1 => 0.5 * (x[i] * x[i] - 1.0),
        _ => {
            let part = |n: usize, i: usize| chebyshev(n, i) / n as f64;
            0.5 * (part(k + 1, i) - part(k - 1, i) - part(k + 1, 0) + part(k - 1, 0))
        }
    };
    DMatrix::from_fn(degree + 1, degree + 1, |i, j| {
        let sum: f64 = (0..=degree).map(|k| half(k) * chebyshev(k, j) * primitive(k, i)).sum();
        2.0 / degree as f64 * half(j) * sum
    })
}

/// The polynomial through `values` at [`points`], at x in [-1, 1].
pub fn interpolate<const N: usize>(values: &[[f64; N]], x: f64) -> [f64; N] {
    let degree = values.len() - 1;
    let (mut above, mut below) = ([0.0; N], 0.0);
    for (i, node) in points(degree).iter().enumerate() {
        if x == *node {
            return values[i];
        }
        let share = weight(i, degree) / (x - node);
        below += share;
        for (sum, value) in above.iter_mut().zip(&values[i]) {
            *sum += share * value;
        }
    }
    above.map(|sum| sum / below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    #[test]
    fn smooth_functions_are_integrated_and_interpolated_to_round_off() {
        let degree = 24;
        let x = points(degree);
        let values = nalgebra::DVector::from_iterator(degree + 1, x.iter().map(|x| (2.0 * x).sin()));
        let integrals = integration(degree) * &values;
        for (i, x) in x.iter().enumerate() {
            assert_close(integrals[i], 0.5 * (2f64.cos() - (2.0 * x).cos()), 4e-16, "integral");
        }
        let rows: Vec<[f64; 1]> = values.iter().map(|v| [*v]).collect();
        for x in [-1.0f64, -0.31, 0.0, 0.9, 1.0] {
            assert_close(interpolate(&rows, x)[0], (2.0 * x).sin(), 1e-15, "value");
        }
    }
}
