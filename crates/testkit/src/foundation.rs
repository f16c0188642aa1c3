//! Straight beams on a linear (Winkler) foundation under small deflections, in units of L and EI.
//!
//! ```text
//! y'''' = -k y        b = (k/4)^¼
//! y = p sin bx sinh bx + r (sin bx cosh bx - cos bx sinh bx)        clamped at x = 0
//! ```
//!
//! (M. Hetényi, *Beams on Elastic Foundation*, 1946, ch. 1 and 2.) A hinged column on it that is pushed with P buckles in m half waves, the
//! m that makes m² π² + k/(m² π²) least (S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed. (1961), §2.10).

use std::f64::consts::PI;

/// A cantilever under a force and a moment on its tip, both towards +y.
#[derive(Clone, Copy, Debug)]
pub struct Cantilever {
    b: f64,
    p: f64,
    r: f64,
}

impl Cantilever {
    /// k in EI/L⁴, the force in EI/L², the moment in EI/L.
    ///
    /// With c, s, C, S the cos, sin, cosh, sinh of b: `2b² [p cC + r (cS + sC)] = M` and `2b³ p (cS - sC) + 4b³ r cC = -F`.
    pub fn new(k: f64, force: f64, moment: f64) -> Self {
        let b = (0.25 * k).powf(0.25);
        let ((s, c), (big_s, big_c)) = (b.sin_cos(), (b.sinh(), b.cosh()));
        let (square, cube) = (2.0 * b * b, 2.0 * b * b * b);
        let rows = [
            [square * c * big_c, square * (c * big_s + s * big_c), moment],
            [cube * (c * big_s - s * big_c), 2.0 * cube * c * big_c, -force],
        ];
        let [[a, d, e], [f, g, h]] = rows;
        let det = a * g - d * f;
        Self { b, p: (e * g - d * h) / det, r: (a * h - e * f) / det }
    }

    /// y in L at x in L.
    pub fn deflection(&self, x: f64) -> f64 {
        let z = self.b * x;
        self.p * z.sin() * z.sinh() + self.r * (z.sin() * z.cosh() - z.cos() * z.sinh())
    }
}

/// Tip of a cantilever under the given load q = -k x and a force and moment on the tip: (40 F + 60 M - 11 k)/120.
pub fn tip_under_ramp(k: f64, force: f64, moment: f64) -> f64 {
    (40.0 * force + 60.0 * moment - 11.0 * k) / 120.0
}

/// The `count` smallest buckling loads in one plane of a hinged column, in EI/L², each with its number of half waves, and k in EI/L⁴.
pub fn hinged_column(k: f64, count: usize) -> Vec<(f64, usize)> {
    let load = |m: usize| {
        let wave = (m as f64 * PI).powi(2);
        wave + k / wave
    };
    // Beyond the least, loads grow with m; twenty more half waves are enough for a few of them.
    let most = 20 + (k.powf(0.25) / PI).ceil() as usize + count;
    let mut all: Vec<(f64, usize)> = (1..=most).map(|m| (load(m), m)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.truncate(count);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    /// Derivative of order 1 to 4 by central differences of high order.
    fn derivative(f: &dyn Fn(f64) -> f64, x: f64, order: usize, h: f64) -> f64 {
        if order == 0 {
            return f(x);
        }
        let g = |x: f64| derivative(f, x, order - 1, h);
        let d = |n: f64| g(x + n * h) - g(x - n * h);
        (672.0 * d(1.0) - 168.0 * d(2.0) + 32.0 * d(3.0) - 3.0 * d(4.0)) / (840.0 * h)
    }

    #[test]
    fn the_closed_form_satisfies_its_equation_and_its_ends() {
        for (k, force, moment) in [(1.0, 1.0, 0.0), (40.0, -0.7, 1.3), (3000.0, 2.0, 0.4)] {
            let beam = Cantilever::new(k, force, moment);
            let y = |x: f64| beam.deflection(x);
            let h = 0.2 / beam.b.max(4.0);
            for x in [0.3, 0.5, 0.8] {
                let size = k * y(1.0).abs().max(y(x).abs());
                assert_close(derivative(&y, x, 4, h), -k * y(x), 1e-6 * size, "y'''' = -k y");
            }
            assert_close(y(0.0), 0.0, 1e-15, "y(0)");
            assert_close(derivative(&y, 0.0, 1, h), 0.0, 1e-9, "y'(0)");
            let scale = force.abs() + moment.abs();
            assert_close(derivative(&y, 1.0, 2, h), moment, 1e-7 * scale, "y''(1)");
            assert_close(derivative(&y, 1.0, 3, h), -force, 1e-6 * scale, "y'''(1)");
        }
    }

    #[test]
    fn the_values_that_are_compared_elsewhere() {
        assert_close(
            Cantilever::new(1.0, 1.0, 0.0).deflection(1.0),
            0.309_101_618_168,
            5e-13,
            "on the foundation",
        );
        assert_close(tip_under_ramp(1.0, 1.0, 0.0), 0.241_666_666_667, 5e-13, "under the ramp");
        // Without a foundation both are L³ F/3EI + L² M/2EI.
        assert_close(Cantilever::new(1e-9, 1.0, 2.0).deflection(1.0), 4.0 / 3.0, 1e-8, "none");
        assert_close(tip_under_ramp(0.0, 1.0, 2.0), 4.0 / 3.0, 1e-15, "none");
    }

    #[test]
    fn a_ramp_is_the_polynomial_with_its_ends() {
        // y = -k x⁵/120 + a x³ + b x² with y''(1) = M, y'''(1) = -F.
        let (k, force, moment) = (0.8, 1.1, -0.3);
        let a = (-force + 0.5 * k) / 6.0;
        let b = 0.5 * (moment - 6.0 * a + k / 6.0);
        assert_close(tip_under_ramp(k, force, moment), -k / 120.0 + a + b, 1e-15, "tip");
    }

    #[test]
    fn columns_change_their_number_of_half_waves_at_the_known_stiffnesses() {
        for m in 1..5_usize {
            // m and m + 1 half waves have the same load at k = m² (m + 1)² π⁴.
            let k = ((m * (m + 1)) as f64).powi(2) * PI.powi(4);
            assert_eq!(hinged_column(0.99 * k, 1)[0].1, m);
            assert_eq!(hinged_column(1.01 * k, 1)[0].1, m + 1);
            let (load, _) = hinged_column(k, 1)[0];
            assert_close(load, ((m * m + (m + 1) * (m + 1)) as f64) * PI * PI, 1e-11 * load, "load");
        }
    }
}
