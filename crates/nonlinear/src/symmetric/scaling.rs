//! Scaling of a symmetric matrix on both sides: S A S, S diagonal and positive, has the inertia of A.

/// Sweeps at most. Each halves the exponents that are left.
const SWEEPS: usize = 8;
/// A diagonal below this part of the largest number in its row is taken for round-off.
const SLIGHT: f64 = 1e-14;

/// Finds powers of two that bring the largest number of each row to about one.
///
/// Given weights w, `sweep` writes max_j |a_ij| w_j for each i. Where a row has a diagonal that one becomes one at
/// first, and other rows follow from those. So soft parts beside the constraints that hold them are not small in the
/// end, as they would be if the largest numbers alone decided. Then each row is divided by the root of its largest
/// number, and again (D. Ruiz, "A scaling algorithm to equilibrate both rows and columns norms in matrices",
/// RAL-TR-2001-034; P. A. Knight, D. Ruiz and B. Uçar, "A symmetry preserving algorithm for matrix scaling", SIAM J. Matrix
/// Anal. Appl. 35 (2014) 931-955).
#[inline(always)]
pub(crate) fn equilibrate(
    diagonal: impl Fn(usize) -> f64,
    sweep: impl Fn(&[f64], &mut [f64]),
    scale: &mut [f64],
    largest: &mut [f64],
) {
    scale.fill(1.0);
    sweep(scale, largest);
    for (i, scale) in scale.iter_mut().enumerate() {
        let own = diagonal(i).abs();
        *scale = inverse_root(if own > SLIGHT * largest[i] { own } else { largest[i] });
    }
    sweep(scale, largest);
    for (i, scale) in scale.iter_mut().enumerate() {
        if diagonal(i).abs() * *scale * *scale < 0.1 {
            *scale = inverse_root(largest[i]) * inverse_root(largest[i]);
        }
    }
    for _ in 0..SWEEPS {
        sweep(scale, largest);
        let mut done = true;
        for (scale, largest) in scale.iter_mut().zip(&*largest) {
            let factor = inverse_root(*scale * largest);
            // A zero or an infinity would not come back.
            *scale = (*scale * factor).clamp(f64::MIN_POSITIVE, 1.0 / f64::MIN_POSITIVE);
            done &= (0.5..=2.0).contains(&factor);
        }
        if done {
            break;
        }
    }
}

/// The power of two next to 1 / √x, which costs no digit; one for zero and where less than a factor of two is to be gained.
#[inline(always)]
fn inverse_root(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    let exponent = (x.to_bits() >> 52) as i64 - 1023;
    f64::from_bits(((1023 - exponent / 2) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_inverse_roots_bring_any_number_to_about_one() {
        for number in [0.3, 0.9, 1.0, 3.9, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE, 1e-310] {
            let factor = inverse_root(number);
            assert_eq!(factor.to_bits() << 12, 0);
            assert!((0.25..4.0).contains(&(number * factor * factor)) || number < 1e-308);
        }
        assert_eq!(inverse_root(0.0), 1.0);
        assert_eq!(inverse_root(2.5), 1.0);
    }
}
