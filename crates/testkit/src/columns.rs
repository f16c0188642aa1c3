//! Straight columns that neither stretch nor shear, under a dead push along their axis: Euler's loads.
//!
//! In one plane, `EI w'''' + P w'' = 0`; with x = √(P L²/EI) the ends give an equation for x. (L. Euler, *De curvis elasticis*
//! (1744); S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed. (1961), §§2.1-2.4.) Every load is simple
//! where the two bending stiffnesses differ and the ends let the two planes be; a round column with ends that are
//! the same in both planes has every load twice. Below the first load no direction is unstable, past the i-th of
//! all planes together i are.

use crate::roots::first_roots;
use std::f64::consts::{PI, TAU};

/// How the two ends are held. The pushed end can always come nearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// One end clamped, the other free to move across and to turn: cos x = 0.
    ClampedFree,
    /// Both held on the axis and free to turn: sin x = 0.
    PinnedPinned,
    /// One clamped, the other held on the axis and free to turn: tan x = x.
    ClampedPinned,
    /// Both clamped, one of them sliding along the axis: sin(x/2) = 0, symmetric, or tan(x/2) = x/2, antisymmetric.
    ClampedClamped,
    /// One clamped, the other free to move across but not to turn: sin x = 0.
    ClampedGuided,
}

impl Ends {
    /// The first `count` values of √(P L²/EI), ascending.
    pub fn roots(self, count: usize) -> Vec<f64> {
        let series = |first: f64, step: f64| (0..count).map(|i| first + step * i as f64).collect::<Vec<_>>();
        // tan x = x without its poles.
        let tangent = || first_roots(|x: f64| x.sin() - x * x.cos(), 1.0, 0.5, count, 20 + 8 * count);
        match self {
            Self::ClampedFree => series(0.5 * PI, PI),
            Self::PinnedPinned | Self::ClampedGuided => series(PI, PI),
            Self::ClampedPinned => tangent(),
            Self::ClampedClamped => {
                let mut all = series(TAU, TAU);
                all.extend(tangent().iter().map(|x| 2.0 * x));
                all.sort_by(f64::total_cmp);
                all.truncate(count);
                all
            }
        }
    }

    /// The first `count` buckling loads in one plane, in EI/L².
    pub fn loads(self, count: usize) -> Vec<f64> {
        self.roots(count).iter().map(|x| x * x).collect()
    }

    /// How many directions are unstable under the load `load`, in EI/L², in one plane.
    pub fn unstable(self, load: f64) -> usize {
        let mut count = 4;
        loop {
            let below = self.loads(count).iter().filter(|critical| **critical < load).count();
            if below < count {
                return below;
            }
            count *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close_all;

    #[test]
    fn the_loads_are_those_of_the_textbooks() {
        let pi2 = PI * PI;
        assert_close_all(
            &Ends::ClampedFree.loads(3),
            &[pi2 / 4.0, 9.0 * pi2 / 4.0, 25.0 * pi2 / 4.0],
            1e-13,
            "free",
        );
        assert_close_all(&Ends::PinnedPinned.loads(3), &[pi2, 4.0 * pi2, 9.0 * pi2], 1e-13, "pinned");
        // Timoshenko and Gere, (2-28): 20.19 EI/L². Roots of tan x = x: Abramowitz and Stegun, table 4.19.
        assert_close_all(&Ends::ClampedPinned.roots(3), &[4.49341, 7.72525, 10.90412], 5.1e-6, "tan x = x");
        assert_close_all(&Ends::ClampedPinned.loads(1), &[20.1907], 5e-5, "clamped-pinned");
        assert_close_all(&Ends::ClampedClamped.loads(3), &[4.0 * pi2, 80.7629, 16.0 * pi2], 5e-5, "clamped");
    }

    #[test]
    fn the_unstable_directions_are_counted() {
        assert_eq!(Ends::PinnedPinned.unstable(9.8), 0);
        assert_eq!(Ends::PinnedPinned.unstable(9.9), 1);
        assert_eq!(Ends::ClampedClamped.unstable(100.0), 2);
        assert_eq!(Ends::ClampedFree.unstable(1e4), 32);
    }
}
