//! Scaling of a symmetric matrix on both sides: S A S, S diagonal and positive, has the inertia of A.

/// Sweeps of equilibration at most. Each halves the exponents that are left, so these bring 2^±500 to 2^±2.
pub(crate) const SWEEPS: usize = 8;

/// The power of two next to 1 / √`largest`, which costs no digit; one for zero and where less than a factor of two is
/// to be gained.
///
/// Rows multiplied by this for the largest magnitude in each, and columns likewise, have entries of at most about
/// one; repeated, the largest of each row tends to one (D. Ruiz, "A scaling algorithm to equilibrate both rows and
/// columns norms in matrices", RAL-TR-2001-034; P. A. Knight, D. Ruiz and B. Uçar, "A symmetry preserving algorithm for
/// matrix scaling", SIAM J. Matrix Anal. Appl. 35 (2014) 931-955).
#[inline(always)]
pub(crate) fn correction(largest: f64) -> f64 {
    if largest == 0.0 {
        return 1.0;
    }
    let exponent = (largest.to_bits() >> 52) as i64 - 1023;
    f64::from_bits(((1023 - exponent / 2) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_corrections_bring_any_number_to_about_one() {
        for number in [0.3, 0.9, 1.0, 3.9, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE, 1e-310] {
            let factor = correction(number);
            assert_eq!(factor.to_bits() << 12, 0);
            assert!((0.25..4.0).contains(&(number * factor * factor)) || number < 1e-308);
        }
        assert_eq!(correction(0.0), 1.0);
        assert_eq!(correction(2.5), 1.0);
    }
}
