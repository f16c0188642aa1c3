//! Comparisons by magnitude: a NaN never passes, a signed error cannot slip through.

use nalgebra::Vector3;

/// Fails unless |actual - expected| <= tolerance (an absolute one). NaN fails.
#[track_caller]
pub fn assert_close(actual: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (actual - expected).abs();
    assert!(
        error <= tolerance,
        "{what}: {actual:.17e} is {error:.3e} away from {expected:.17e}, allowed {tolerance:.1e}"
    );
}

/// Fails unless the distance |actual - expected| <= tolerance. NaN fails.
#[track_caller]
pub fn assert_close_vec(actual: &Vector3<f64>, expected: &Vector3<f64>, tolerance: f64, what: &str) {
    let error = (actual - expected).norm();
    assert!(
        error <= tolerance,
        "{what}: {:?} is {error:.3e} away from {:?}, allowed {tolerance:.1e}",
        actual.as_slice(),
        expected.as_slice()
    );
}

/// Fails unless both have the same length and every entry agrees to the tolerance. NaN fails.
#[track_caller]
pub fn assert_close_all(actual: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(actual.len(), expected.len(), "{what}: different lengths");
    for (i, (a, e)) in actual.iter().zip(expected).enumerate() {
        assert_close(*a, *e, tolerance, &format!("{what}[{i}]"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "away from")]
    fn a_result_that_is_too_small_fails() {
        assert_close(-5.0, 1.0, 0.1, "too small");
    }

    #[test]
    #[should_panic(expected = "away from")]
    fn a_nan_fails() {
        assert_close(f64::NAN, 1.0, 0.1, "nan");
    }

    #[test]
    #[should_panic(expected = "away from")]
    fn a_nan_in_a_vector_fails() {
        assert_close_vec(&Vector3::new(0.0, f64::NAN, 0.0), &Vector3::zeros(), 1.0, "nan");
    }

    #[test]
    fn what_agrees_passes() {
        assert_close(1.0, 1.0 + 1e-13, 1e-12, "close");
        assert_close_all(&[1.0, 2.0], &[1.0, 2.0], 0.0, "equal");
        assert_close_vec(&Vector3::x(), &Vector3::x(), 0.0, "equal");
    }
}
