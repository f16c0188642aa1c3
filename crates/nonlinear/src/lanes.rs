//! Loops over numbers in eight lanes side by side, so that they compile to vector instructions and give equal bits on
//! every processor.

/// The largest magnitude; what is not a number does not count.
#[inline(always)]
pub(crate) fn largest(v: &[f64]) -> f64 {
    let (chunks, rest) = v.as_chunks::<8>();
    let mut lanes = [0.0_f64; 8];
    for chunk in chunks {
        for i in 0..8 {
            let x = chunk[i].abs();
            lanes[i] = if x > lanes[i] { x } else { lanes[i] };
        }
    }
    lanes.iter().chain(rest).fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m })
}

/// The largest |v| w.
#[inline(always)]
pub(crate) fn largest_product(v: &[f64], w: &[f64]) -> f64 {
    let ((v, v_rest), (w, w_rest)) = (v.as_chunks::<8>(), w.as_chunks::<8>());
    let mut lanes = [0.0_f64; 8];
    for (v, w) in v.iter().zip(w) {
        for i in 0..8 {
            let x = v[i].abs() * w[i];
            lanes[i] = if x > lanes[i] { x } else { lanes[i] };
        }
    }
    let rest = v_rest.iter().zip(w_rest).fold(0.0, |m, (v, w)| if v.abs() * w > m { v.abs() * w } else { m });
    lanes.iter().fold(rest, |m, &x| if x > m { x } else { m })
}

/// Zero times anything that is not finite is not a number.
#[inline(always)]
pub(crate) fn all_finite(v: &[f64]) -> bool {
    let (chunks, rest) = v.as_chunks::<8>();
    let mut lanes = [0.0; 8];
    for chunk in chunks {
        for i in 0..8 {
            lanes[i] += 0.0 * chunk[i];
        }
    }
    lanes.iter().all(|&v| v == 0.0) && rest.iter().all(|v| v.is_finite())
}

/// to -= factor * from
#[inline(always)]
pub(crate) fn subtract(to: &mut [f64], factor: f64, from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to -= factor * from;
    }
}

/// The scalar product, in eight sums side by side.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut lanes = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for i in 0..8 {
            lanes[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7])) + rest
}
