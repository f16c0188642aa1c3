//! Initial value problems by an embedded pair that chooses its steps.
//!
//! The pair of order 5 with an estimate of order 4 of J. R. Dormand and P. J. Prince, *J. Comput. Appl. Math.* 6 (1980) 19.

const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const A: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Difference of the weights of order 5 and 4.
const E: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// The most steps on one interval.
const MOST: usize = 40_000;

/// The solution of y' = f(s, y) at `to`. Errors per step stay below `tolerance` times `scale`; an entry of zero is not
/// looked at.
///
/// # Errors
/// Where it broke off, for numbers that are none or too many steps.
pub fn integrate<const N: usize>(
    mut f: impl FnMut(f64, &[f64; N]) -> [f64; N],
    [from, to]: [f64; 2],
    start: [f64; N],
    scale: &[f64; N],
    tolerance: f64,
) -> Result<[f64; N], f64> {
    let whole = to - from;
    let (mut s, mut y, mut h) = (from, start, 0.1 * whole);
    // A jump is stepped over once steps are so short that it no longer matters.
    let shortest = 1e-13 * whole.abs();
    for _ in 0..MOST {
        if (to - s) * whole.signum() <= 0.5 * shortest {
            return Ok(y);
        }
        if (h.abs() - (to - s).abs()) > -1e-3 * h.abs() {
            h = to - s;
        }
        let mut k = [[0.0; N]; 7];
        let mut new = y;
        for stage in 0..7 {
            let mut at = y;
            for (j, weight) in A[stage].iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                for i in 0..N {
                    at[i] += h * weight * k[j][i];
                }
            }
            k[stage] = f(s + C[stage] * h, &at);
            new = at;
        }
        let mut error = 0.0_f64;
        for i in (0..N).filter(|i| scale[*i] > 0.0) {
            let difference: f64 = (0..7).map(|j| E[j] * k[j][i]).sum();
            let part = (h * difference).abs() / (tolerance * scale[i]);
            // `max` passes over what is no number.
            error = if part.is_nan() { f64::INFINITY } else { error.max(part) };
        }
        if !error.is_finite() && h.abs() <= shortest {
            return Err(s);
        }
        if error <= 1.0 || h.abs() <= shortest {
            s += h;
            y = new;
        }
        let factor = if error.is_finite() { 0.9 * error.max(1e-10).powf(-0.2) } else { 0.1 };
        h = whole.signum() * (h.abs() * factor.clamp(0.1, 4.0)).clamp(shortest, whole.abs());
    }
    Err(s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_comes_back() {
        let end = integrate(|_, y: &[f64; 2]| [-y[1], y[0]], [0.0, 10.0], [1.0, 0.0], &[1.0; 2], 1e-13);
        let end = end.expect("smooth");
        assert!((end[0] - 10f64.cos()).abs() < 1e-11 && (end[1] - 10f64.sin()).abs() < 1e-11);
    }

    #[test]
    fn a_jump_is_integrated_over() {
        let step = |s: f64, _: &[f64; 1]| [if s < 0.3 { 1.0 } else { -2.0 }];
        let end = integrate(step, [0.0, 1.0], [0.0], &[1.0], 1e-12).expect("bounded");
        assert!((end[0] - (0.3 - 1.4)).abs() < 1e-10, "{}", end[0]);
    }

    #[test]
    fn what_is_no_number_is_said() {
        assert!(integrate(|_, _: &[f64; 1]| [f64::NAN], [0.0, 1.0], [0.0], &[1.0], 1e-12).is_err());
    }
}
