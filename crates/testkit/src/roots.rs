//! Roots of functions of one variable.

/// The root of `f` between `a` and `b`, where it has different signs, to the last digits. None if the signs are equal
/// or a value is NaN.
///
/// Inverse quadratic interpolation wherever it is safe, halving elsewhere (T. R. Chandrupatla, *Adv. Eng. Softw.* 28
/// (1997) 145).
pub fn root(f: impl FnMut(f64) -> f64, a: f64, b: f64) -> Option<f64> {
    root_within(f, a, b, 0.0)
}

/// As [`root`], but content with an interval of the width `tolerance`.
pub fn root_within(mut f: impl FnMut(f64) -> f64, a: f64, b: f64, tolerance: f64) -> Option<f64> {
    let (mut here, mut there) = (b, a);
    let (mut at_here, mut at_there) = (f(here), f(there));
    if at_here.is_nan() || at_there.is_nan() {
        return None;
    }
    if at_here == 0.0 || at_there == 0.0 {
        return Some(if at_here == 0.0 { here } else { there });
    }
    if at_here.signum() == at_there.signum() {
        return None;
    }
    let mut part = 0.5;
    for _ in 0..200 {
        let new = here + part * (there - here);
        let at_new = f(new);
        if at_new.is_nan() {
            return None;
        }
        // The root stays between `here`, the newest point, and `there`; `old` is what one of them was before.
        let (old, at_old);
        if at_new.signum() == at_here.signum() {
            (old, at_old) = (here, at_here);
        } else {
            (old, at_old) = (there, at_there);
            (there, at_there) = (here, at_here);
        }
        (here, at_here) = (new, at_new);
        let best = if at_here.abs() < at_there.abs() { here } else { there };
        let width = (there - here).abs();
        let least = tolerance.max(2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE);
        if at_here == 0.0 || width <= least {
            return Some(best);
        }
        let x = (here - there) / (old - there);
        let y = (at_here - at_there) / (at_old - at_there);
        part = if y * y < x && (1.0 - y) * (1.0 - y) < 1.0 - x {
            at_here / (at_there - at_here) * at_old / (at_there - at_old)
                + (old - here) / (there - here) * at_here / (at_old - at_here) * at_there
                    / (at_old - at_there)
        } else {
            0.5
        };
        let edge = (0.5 * least / width).min(0.5);
        part = part.clamp(edge, 1.0 - edge);
    }
    None
}

/// The first `count` roots of `f` past `from`, each where the sign changes within a step of `step`; fewer if they do
/// not come within `limit` steps. Two roots in one step are overlooked.
pub fn first_roots(
    mut f: impl FnMut(f64) -> f64,
    from: f64,
    step: f64,
    count: usize,
    limit: usize,
) -> Vec<f64> {
    let mut found = Vec::new();
    let (mut low, mut at_low) = (from, f(from));
    for i in 1..=limit {
        if found.len() == count {
            break;
        }
        let high = from + step * i as f64;
        let at_high = f(high);
        if at_low * at_high < 0.0 || (at_high == 0.0 && at_low != 0.0) {
            found.extend(root(&mut f, low, high));
        }
        (low, at_low) = (high, at_high);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    #[test]
    fn roots_have_all_digits_and_no_sign_change_has_none() {
        assert_close(root(|x| x * x - 2.0, 0.0, 2.0).unwrap(), 2f64.sqrt(), 3e-16, "√2");
        assert_close(root(|x: f64| (x - 0.3).powi(9), -1.0, 4.0).unwrap(), 0.3, 1e-15, "a flat one");
        assert_close(root(|x: f64| 1e-8 - x.exp(), -60.0, 3.0).unwrap(), 1e-8f64.ln(), 1e-13, "a steep one");
        assert!(root(|x| x * x + 1.0, -1.0, 1.0).is_none());
        assert!(root(|_| f64::NAN, -1.0, 1.0).is_none());
    }

    #[test]
    fn few_evaluations_are_needed() {
        let mut count = 0;
        let f = |x: f64| {
            count += 1;
            x.cos() - x
        };
        assert_close(root(f, 0.0, 1.0).unwrap(), 0.739_085_133_215_160_6, 2e-16, "cos x = x");
        assert!(count < 12, "{count}");
    }

    #[test]
    fn the_first_roots_come_in_order() {
        let found = first_roots(f64::sin, 0.5, 0.4, 3, 100);
        for (i, x) in found.iter().enumerate() {
            assert_close(*x, std::f64::consts::PI * (i + 1) as f64, 2e-15, "iπ");
        }
        assert!(first_roots(|x| x + 1.0, 0.0, 1.0, 1, 50).is_empty());
    }
}
