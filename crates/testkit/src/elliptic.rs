//! Elliptic integrals and Jacobi's elliptic functions, by the parameter m = k².
//!
//! Integrals by Carlson's symmetric forms (B. C. Carlson, *Numerical Algorithms* 10 (1995) 13; DLMF 19.36),
//! complete ones by the arithmetic-geometric mean (Abramowitz and Stegun 17.6), functions by descending
//! Landen transformations (Abramowitz and Stegun 16.4). All to a few units of round-off.
//!
//! Where m is close to 1 its complement m1 = 1 - m carries the digits, so functions take both.

use std::f64::consts::FRAC_PI_2;

/// Carlson's R_F(x, y, z) = ½ ∫₀^∞ dt/√((t+x)(t+y)(t+z)); x, y, z >= 0, at most one of them zero.
pub fn rf(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let mean = (x + y + z) / 3.0;
    let (dx, dy) = (mean - x, mean - y);
    let mut spread = dx.abs().max(dy.abs()).max((mean - z).abs()) * 400.0;
    let (mut a, mut power) = (mean, 1.0);
    while spread > a {
        let lambda = (x * y).sqrt() + (y * z).sqrt() + (z * x).sqrt();
        (x, y, z, a) = (0.25 * (x + lambda), 0.25 * (y + lambda), 0.25 * (z + lambda), 0.25 * (a + lambda));
        power *= 0.25;
        spread *= 0.25;
    }
    let (u, v) = (dx * power / a, dy * power / a);
    let w = -u - v;
    let (e2, e3) = (u * v - w * w, u * v * w);
    (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0 - 5.0 * e2.powi(3) / 208.0
        + 3.0 * e3 * e3 / 104.0
        + e2 * e2 * e3 / 16.0)
        / a.sqrt()
}

/// Carlson's R_D(x, y, z) = (3/2) ∫₀^∞ dt/(√((t+x)(t+y)) (t+z)^{3/2}); x, y >= 0, not both zero, z > 0.
pub fn rd(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let mean = (x + y + 3.0 * z) / 5.0;
    let (dx, dy) = (mean - x, mean - y);
    let mut spread = dx.abs().max(dy.abs()).max((mean - z).abs()) * 500.0;
    let (mut a, mut power, mut sum) = (mean, 1.0, 0.0);
    while spread > a {
        let lambda = (x * y).sqrt() + (y * z).sqrt() + (z * x).sqrt();
        sum += power / (z.sqrt() * (z + lambda));
        (x, y, z, a) = (0.25 * (x + lambda), 0.25 * (y + lambda), 0.25 * (z + lambda), 0.25 * (a + lambda));
        power *= 0.25;
        spread *= 0.25;
    }
    let (u, v) = (dx * power / a, dy * power / a);
    let w = -(u + v) / 3.0;
    let (uv, ww) = (u * v, w * w);
    let e2 = uv - 6.0 * ww;
    let e3 = (3.0 * uv - 8.0 * ww) * w;
    let e4 = 3.0 * (uv - ww) * ww;
    let e5 = uv * ww * w;
    let series =
        1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
            + 3.0 * e5 / 26.0
            - e2.powi(3) / 16.0
            + 3.0 * e3 * e3 / 40.0
            + 3.0 * e2 * e4 / 20.0;
    power * series / (a * a.sqrt()) + 3.0 * sum
}

/// Complete elliptic integral of the first kind K(m), given m1 = 1 - m > 0.
pub fn complete_first(m1: f64) -> f64 {
    let (mut a, mut b) = (1.0f64, m1.sqrt());
    for _ in 0..40 {
        if (a - b).abs() <= 1e-16 * a {
            break;
        }
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    FRAC_PI_2 / a
}

/// Complete elliptic integral of the second kind E(m), given m1 = 1 - m >= 0.
pub fn complete_second(m1: f64) -> f64 {
    if m1 == 0.0 {
        return 1.0;
    }
    rf(0.0, m1, 1.0) - (1.0 - m1) / 3.0 * rd(0.0, m1, 1.0)
}

/// Incomplete elliptic integral of the first kind F(φ|m) = ∫₀^φ dθ/√(1 - m sin²θ), any φ, m < 1 given as
/// m1 = 1 - m.
pub fn first(phi: f64, m1: f64) -> f64 {
    let (turns, rest) = reduce(phi);
    let (s, c) = rest.sin_cos();
    let whole = if turns == 0.0 { 0.0 } else { 2.0 * turns * complete_first(m1) };
    whole + s * rf(c * c, c * c + m1 * s * s, 1.0)
}

/// Incomplete elliptic integral of the second kind E(φ|m) = ∫₀^φ √(1 - m sin²θ) dθ, any φ, m given as
/// m1 = 1 - m.
pub fn second(phi: f64, m1: f64) -> f64 {
    let (turns, rest) = reduce(phi);
    let (s, c) = rest.sin_cos();
    let whole = if turns == 0.0 { 0.0 } else { 2.0 * turns * complete_second(m1) };
    let (x, y) = (c * c, c * c + m1 * s * s);
    if x == 0.0 && y == 0.0 {
        return whole + s;
    }
    whole + s * (rf(x, y, 1.0) - (1.0 - m1) / 3.0 * s * s * rd(x, y, 1.0))
}

/// φ as a number of half turns and a rest of at most a quarter turn.
fn reduce(phi: f64) -> (f64, f64) {
    let turns = (phi / std::f64::consts::PI).round();
    (turns, phi - turns * std::f64::consts::PI)
}

/// Jacobi's amplitude and functions at one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobi {
    /// am u, rad, increasing without bound.
    pub am: f64,
    /// sn u = sin am u.
    pub sn: f64,
    /// cn u = cos am u.
    pub cn: f64,
    /// dn u = √(1 - m sn²u).
    pub dn: f64,
}

/// Jacobi's elliptic functions at `u`, 0 <= m < 1 given as m1 = 1 - m.
pub fn jacobi(u: f64, m1: f64) -> Jacobi {
    let (mut a, mut b) = (1.0f64, m1.sqrt());
    let mut ratios = Vec::new();
    let mut c = (1.0 - m1).max(0.0).sqrt();
    while c > 1e-17 && ratios.len() < 40 {
        c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        ratios.push(c / a);
    }
    let mut phi = a * u * 2f64.powi(ratios.len() as i32);
    for ratio in ratios.iter().rev() {
        phi = 0.5 * (phi + (ratio * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    Jacobi { am: phi, sn, cn, dn: (cn * cn + m1 * sn * sn).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    #[test]
    fn carlson_forms_have_their_published_values() {
        // B. C. Carlson, Numerical Algorithms 10 (1995), section 3.
        assert_close(rf(1.0, 2.0, 0.0), 1.311_028_777_146_059_9, 1e-15, "RF(1,2,0)");
        assert_close(rf(2.0, 3.0, 4.0), 0.584_082_841_677_15, 1e-14, "RF(2,3,4)");
        assert_close(rd(0.0, 2.0, 1.0), 1.797_210_352_103_388_3, 2e-15, "RD(0,2,1)");
        assert_close(rd(2.0, 3.0, 4.0), 0.165_105_272_942_61, 1e-14, "RD(2,3,4)");
    }

    #[test]
    fn complete_integrals_have_their_tabulated_values() {
        // Abramowitz and Stegun, table 17.1.
        for (m, k, e) in [
            (0.0, FRAC_PI_2, FRAC_PI_2),
            (0.1, 1.612_441_348_720_219, 1.530_757_637),
            (0.5, 1.854_074_677_301_372, 1.350_643_881),
            (0.9, 2.578_092_113_348_173, 1.104_774_733),
            (0.99, 3.695_637_362_989_875, 1.015_993_545),
        ] {
            assert_close(complete_first(1.0 - m), k, 4e-15, "K");
            assert_close(complete_second(1.0 - m), e, 6e-10, "E");
        }
    }

    #[test]
    fn legendres_relation_holds() {
        for m in [1e-9, 0.2, 0.5, 0.83, 1.0 - 1e-9] {
            let (k, e) = (complete_first(1.0 - m), complete_second(1.0 - m));
            let (k1, e1) = (complete_first(m), complete_second(m));
            assert_close(e * k1 + e1 * k - k * k1, FRAC_PI_2, 2e-14, "Legendre's relation");
        }
    }

    #[test]
    fn incomplete_integrals_have_their_tabulated_values() {
        // Abramowitz and Stegun, tables 17.5 and 17.6 (modular angle 30°: m = 1/4).
        let rad = f64::to_radians;
        assert_close(first(rad(30.0), 0.75), 0.529_428_63, 6e-9, "F(30°\\30°)");
        assert_close(first(rad(60.0), 0.25), 1.212_596_61, 6e-9, "F(60°\\60°)");
        assert_close(second(rad(60.0), 0.25), 0.918_393_29, 6e-9, "E(60°\\60°)");
        // Quasi-periodicity and the elementary limits.
        let m1 = 0.3;
        let whole = 2.0 * complete_first(m1);
        assert_close(first(0.7 + std::f64::consts::PI, m1), first(0.7, m1) + whole, 1e-14, "F + 2K");
        assert_close(second(0.7, 1.0), 0.7, 1e-15, "E(φ|0) = φ");
        assert_close(second(0.7, 0.0), 0.7f64.sin(), 1e-15, "E(φ|1) = sin φ");
        assert_close(first(0.7, 0.0), 0.7f64.sin().atanh(), 1e-15, "F(φ|1) = artanh sin φ");
    }

    #[test]
    fn jacobis_functions_invert_the_integral() {
        for m1 in [1.0, 0.9, 0.5, 0.1, 1e-5, 1e-12] {
            for u in [0.0, 0.3, 1.7, 5.0, 11.0] {
                let j = jacobi(u, m1);
                assert_close(first(j.am, m1), u, 3e-14 * (1.0 + u) / m1.sqrt().max(1e-3), "F(am u)");
                assert_close(j.sn * j.sn + j.cn * j.cn, 1.0, 1e-15, "sn² + cn²");
            }
        }
        // Abramowitz and Stegun 16.5.2: sn at half the quarter period is 1/√(1 + k').
        let m1: f64 = 0.36;
        let half = jacobi(0.5 * complete_first(m1), m1);
        assert_close(half.sn, 1.0 / (1.0 + m1.sqrt()).sqrt(), 1e-15, "sn(K/2)");
        assert_close(half.dn, m1.sqrt().sqrt(), 1e-15, "dn(K/2)");
    }
}
