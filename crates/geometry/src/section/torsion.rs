//! Saint-Venant torsion of the rectangle, summed to round-off for every aspect ratio.
//!
//! Timoshenko and Goodier, *Theory of Elasticity*, 3rd ed. (1970), art. 109, with long side a and short
//! side b. Every sum is split into a known constant and a rest that falls like exp(-π n a/b), a ≥ b, so a
//! handful of terms reaches round-off.

use std::f64::consts::PI;

/// Σ over odd n of 1/n⁵ = (31/32) ζ(5).
const SUM_FIFTH: f64 = 1.004_523_762_795_139_6;
/// Σ over odd n of ±1/n²: Catalan's constant.
const CATALAN: f64 = 0.915_965_594_177_219;
/// exp(-π n a/b) is below round-off for n past this.
const LAST: u32 = 25;

/// The torsion constant J of a rectangle, m⁴: GJ is the torsional stiffness.
///
/// `J = a b³ [1/3 - (64/π⁵)(b/a) Σ tanh(nπa/2b)/n⁵]`, n odd.
pub(super) fn rectangle_constant(width: f64, height: f64) -> f64 {
    let (a, b) = (width.max(height), width.min(height));
    // tanh x = 1 - 2/(exp 2x + 1); of a strip the first term is nothing already.
    let terms = odd().map(|n| 2.0 / ((n * PI * a / b).exp() + 1.0) / n.powi(5));
    let rest: f64 = terms.take_while(|term| *term > 1e-18).sum();
    let sum = SUM_FIFTH - rest;
    a * b.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * (b / a) * sum)
}

/// Shear stress over Gθ' b in the middle of the long sides, where it is largest (θ' = M1/GJ).
///
/// `1 - (8/π²) Σ 1/(n² cosh(nπa/2b))`, n odd.
pub(super) fn rectangle_long_side(a: f64, b: f64) -> f64 {
    1.0 - 8.0 / (PI * PI) * odd().map(|n| 1.0 / (n * n * (0.5 * n * PI * a / b).cosh())).sum::<f64>()
}

/// Shear stress over Gθ' b in the middle of the short sides.
///
/// `(8/π²) Σ ± tanh(nπa/2b)/n²`, n odd; 0.7425 for a thin strip.
pub(super) fn rectangle_short_side(a: f64, b: f64) -> f64 {
    let rest: f64 = odd()
        .zip([1.0, -1.0].into_iter().cycle())
        .map(|(n, sign)| sign * 2.0 / ((n * PI * a / b).exp() + 1.0) / (n * n))
        .sum();
    8.0 / (PI * PI) * (CATALAN - rest)
}

/// Distances from the corner over b, and (8/π²) Σ exp(-nπd/b)/n² there: what a long side lacks near its end.
const LONG_SIDE: [(f64, f64); 10] = [
    (0.05, 0.774_328_835_264_801_7),
    (0.1, 0.636_651_235_792_828_2),
    (0.2, 0.447_751_995_198_674_04),
    (0.35, 0.273_401_665_442_544_24),
    (0.5, 0.169_322_774_057_850_65),
    (0.75, 0.076_902_888_995_758_64),
    (1.0, 0.035_035_155_740_089_36),
    (1.5, 0.007_281_646_727_135_465),
    (2.0, 0.001_513_692_650_217_37),
    (3.0, 6.541256516404381e-05),
];

/// Places 2x/b on a short side, and (8/π²) Σ ± cos(nπx/b)/n² there: the short side of an endless strip.
const SHORT_SIDE: [(f64, f64); 7] = [
    (0.2, 0.722_286_486_54),
    (0.4, 0.659_632_118_72),
    (0.55, 0.580_390_217_68),
    (0.7, 0.465_875_858_61),
    (0.8, 0.362_650_620_55),
    (0.9, 0.225_583_898_16),
    (0.95, 0.134_871_889_22),
];

/// Shear stress over Gθ'b along half a long side: (distance from its middle, m; stress), from the middle to
/// the corner, where it vanishes.
///
/// `1 - (8/π²) Σ cosh(nπy/b)/(n² cosh(nπa/2b))`, n odd, y from the middle.
pub(super) fn rectangle_long_profile(a: f64, b: f64) -> Vec<(f64, f64)> {
    let mut profile = vec![(0.0, rectangle_long_side(a, b))];
    for (place, universal) in LONG_SIDE.iter().rev() {
        let d = place * b;
        if d < 0.45 * a {
            let rest: f64 = odd()
                .map(|n| {
                    let decay = |distance: f64| (-n * PI * distance / b).exp();
                    (decay(a - d) - decay(a + d)) / (1.0 + decay(a)) / (n * n)
                })
                .take_while(|term| *term > 1e-17)
                .sum();
            profile.push((0.5 * a - d, 1.0 - universal - 8.0 / (PI * PI) * rest));
        }
    }
    profile.push((0.5 * a, 0.0));
    profile
}

/// Shear stress over Gθ'b along half a short side, as [`rectangle_long_profile`].
///
/// `(8/π²) Σ ± tanh(nπa/2b) cos(nπx/b)/n²`, n odd, x from the middle.
pub(super) fn rectangle_short_profile(a: f64, b: f64) -> Vec<(f64, f64)> {
    let mut profile = vec![(0.0, rectangle_short_side(a, b))];
    for (place, universal) in SHORT_SIDE {
        let rest: f64 = odd()
            .zip([1.0, -1.0].into_iter().cycle())
            .map(|(n, sign)| (n, sign * 2.0 / ((n * PI * a / b).exp() + 1.0) / (n * n)))
            .take_while(|(_, term)| term.abs() > 1e-17)
            .map(|(n, term)| term * (0.5 * n * PI * place).cos())
            .sum();
        profile.push((0.5 * b * place, universal - 8.0 / (PI * PI) * rest));
    }
    profile.push((0.5 * b, 0.0));
    profile
}

fn odd() -> impl Iterator<Item = f64> {
    (1..=LAST).step_by(2).map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Timoshenko and Goodier (1970), table of art. 109: a/b, k1/2 (here τ/(Gθ'b)), k2 = J/(a b³).
    #[test]
    fn the_published_table_comes_back() {
        for (ratio, shear, constant) in [
            (1.0, 0.675, 0.1406),
            (1.2, 0.759, 0.166),
            (1.5, 0.848, 0.196),
            (2.0, 0.930, 0.229),
            (3.0, 0.985, 0.263),
            (5.0, 0.999, 0.291),
            (10.0, 1.0, 0.312),
        ] {
            assert!((rectangle_constant(1.0, ratio) / ratio - constant).abs() < 7e-4, "{ratio}");
            assert!((rectangle_long_side(ratio, 1.0) - shear).abs() < 1.1e-3, "{ratio}");
        }
    }

    #[test]
    fn the_square_and_the_thin_strip_have_their_known_constants() {
        assert!((rectangle_constant(1.0, 1.0) - 0.140_577_014_955_153_7).abs() < 1e-15);
        let (a, b) = (1e6, 1.0);
        assert!((rectangle_constant(a, b) / (a * b.powi(3)) - 1.0 / 3.0).abs() < 1e-6);
        assert!((rectangle_short_side(1e3, 1.0) - 8.0 * CATALAN / (PI * PI)).abs() < 1e-15);
        // On the square both sides are alike.
        assert!((rectangle_short_side(1.0, 1.0) - rectangle_long_side(1.0, 1.0)).abs() < 1e-15);
    }

    #[test]
    fn the_profiles_are_the_series_summed_by_brute_force() {
        for a in [1.0, 1.3, 3.0, 40.0] {
            let b = 1.0;
            for (y, tau) in rectangle_long_profile(a, b) {
                let sum: f64 = (1..20_000)
                    .step_by(2)
                    .map(f64::from)
                    .map(|n| {
                        let grow = |x: f64| 1.0 + (-2.0 * n * PI * x / b).exp();
                        (n * PI * (y - 0.5 * a) / b).exp() * grow(y) / grow(0.5 * a) / (n * n)
                    })
                    .sum();
                assert!((tau - (1.0 - 8.0 / (PI * PI) * sum)).abs() < 5e-5, "long {a} {y}");
            }
            for (x, tau) in rectangle_short_profile(a, b) {
                let sum: f64 = (1..20_000)
                    .step_by(2)
                    .zip([1.0, -1.0].into_iter().cycle())
                    .map(|(n, sign)| (f64::from(n), sign))
                    .map(|(n, sign)| sign * (0.5 * n * PI * a / b).tanh() * (n * PI * x / b).cos() / (n * n))
                    .sum();
                assert!((tau - 8.0 / (PI * PI) * sum).abs() < 1e-7, "short {a} {x}");
            }
        }
        // The sides of a square are alike: the two series must give the same function.
        let long = rectangle_long_profile(1.0, 1.0);
        let short = rectangle_short_profile(1.0, 1.0);
        for (y, tau) in &long {
            if let Some((_, other)) = short.iter().find(|(x, _)| (x - y).abs() < 1e-12) {
                assert!((tau - other).abs() < 1e-10, "{y}");
            }
        }
    }

    #[test]
    fn the_constant_does_not_care_which_side_is_called_width() {
        assert_eq!(rectangle_constant(0.3, 2.0), rectangle_constant(2.0, 0.3));
    }
}
