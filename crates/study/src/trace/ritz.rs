//! The largest eigenvalues of an operator, by a block Krylov space and Ritz values.
//!
//! A start of several vectors finds eigenvalues that occur several times, as those of round columns do. (Y. Saad, *Numerical Methods for
//! Large Eigenvalue Problems*, 2nd ed., 2011, ch. 6.)

use nalgebra::{DMatrix, DVector};

/// Vectors of the start, and most of the space.
const BLOCK: usize = 3;
const LARGEST: usize = 150;
/// Part of an eigenvalue that may be imaginary by round-off.
const REAL: f64 = 1e-5;
/// Part of the largest eigenvalue below which one is nothing.
const NOTHING: f64 = 1e-9;
/// How well a Ritz pair must satisfy its equation.
const RESIDUAL: f64 = 1e-6;

/// Real 1/θ, smallest first, with eigenvectors, for up to `count` of the largest eigenvalues θ of `operator`.
pub(crate) fn smallest(operator: &mut dyn FnMut(&mut [f64]), n: usize, count: usize) -> Vec<(f64, Vec<f64>)> {
    let dimension = (4 * count + 30).min(LARGEST).min(n);
    let mut space: Vec<DVector<f64>> = Vec::with_capacity(dimension);
    let mut images: Vec<DVector<f64>> = Vec::with_capacity(dimension);
    let mut seed = 0;
    let mut next = 0;
    while space.len() < dimension {
        // A new direction: the image of one that has none yet, or a start vector, taken through the operator once so that it
        // holds nothing that the operator forgets.
        let mut candidate = if seed < BLOCK.min(n) {
            seed += 1;
            let mut start = DVector::from_fn(n, |i, _| ((i * (2 * seed + 1) + seed) as f64 * 1.37).sin());
            operator(start.as_mut_slice());
            start
        } else if next < images.len() {
            next += 1;
            images[next - 1].clone()
        } else {
            break;
        };
        let before = candidate.norm();
        for _ in 0..2 {
            for v in &space {
                let along = v.dot(&candidate);
                candidate.axpy(-along, v, 1.0);
            }
        }
        let length = candidate.norm();
        if length.is_nan() || length <= 1e-10 * before {
            continue;
        }
        candidate /= length;
        let mut image = candidate.clone();
        operator(image.as_mut_slice());
        space.push(candidate);
        images.push(image);
    }
    let m = space.len();
    if m == 0 {
        // Nothing is there to be moved, or the operator forgets everything.
        return Vec::new();
    }
    let small = DMatrix::from_fn(m, m, |i, j| space[i].dot(&images[j]));
    let eigenvalues = small.complex_eigenvalues();
    let largest = eigenvalues.iter().map(|e| e.re.hypot(e.im)).fold(0.0, f64::max);
    let mut real: Vec<f64> = eigenvalues
        .iter()
        .filter(|e| e.re.abs() > NOTHING * largest && e.im.abs() <= REAL * e.re.abs())
        .map(|e| e.re)
        .collect();
    real.sort_by(|a, b| b.abs().total_cmp(&a.abs()));
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    let mut position = 0;
    while position < real.len() && found.len() < count {
        let theta = real[position];
        let together =
            real[position..].iter().take_while(|t| (**t - theta).abs() <= 1e-7 * theta.abs()).count();
        position += together;
        let shifted = &small - DMatrix::identity(m, m) * theta;
        let svd = shifted.svd(false, true);
        let Some(vt) = svd.v_t else { continue };
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]));
        for &row in order.iter().take(together) {
            let weights = vt.row(row);
            let mut x = DVector::zeros(n);
            let mut image = DVector::zeros(n);
            for (j, w) in weights.iter().enumerate() {
                x.axpy(*w, &space[j], 1.0);
                image.axpy(*w, &images[j], 1.0);
            }
            if (&image - &x * theta).norm() <= RESIDUAL * theta.abs() * x.norm() {
                found.push((1.0 / theta, x.as_slice().to_vec()));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_operator_that_forgets_everything_has_no_eigenvalues() {
        for n in [0, 7] {
            assert!(smallest(&mut |x: &mut [f64]| x.fill(0.0), n, 3).is_empty(), "{n}");
        }
    }

    #[test]
    fn finds_the_largest_eigenvalues_double_ones_twice() {
        // Diagonal in a turned basis, with a null space.
        let n = 120;
        let values = |i: usize| match i {
            0 => 5.0,
            1 | 2 => -3.0,
            3 => 2.0,
            i if i < 40 => 1.0 / (1.0 + i as f64),
            _ => 0.0,
        };
        let axis = DVector::from_fn(n, |i, _| 1.0 + (i as f64).cos()).normalize();
        let reflect = |x: &mut DVector<f64>| {
            let along = 2.0 * axis.dot(x);
            x.axpy(-along, &axis, 1.0);
        };
        let mut operator = |x: &mut [f64]| {
            let mut v = DVector::from_column_slice(x);
            reflect(&mut v);
            v.iter_mut().enumerate().for_each(|(i, v)| *v *= values(i));
            reflect(&mut v);
            x.copy_from_slice(v.as_slice());
        };
        let found = smallest(&mut operator, n, 4);
        let wanted = [0.2, -1.0 / 3.0, -1.0 / 3.0, 0.5];
        assert_eq!(found.len(), 4);
        for ((value, x), wanted) in found.iter().zip(wanted) {
            assert!((value - wanted).abs() < 1e-9);
            let mut image = x.clone();
            operator(&mut image);
            let rest = image.iter().zip(x).map(|(i, x)| (i * value - x).abs()).fold(0.0, f64::max);
            assert!(rest < 1e-6);
        }
    }
}
