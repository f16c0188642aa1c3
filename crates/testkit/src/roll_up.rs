//! The cantilever rolled up by a tip moment: its axis is a circle.

/// Position (x/L, y/L) and angle (rad) at s = `fraction` L of a cantilever under a tip moment of
/// M L/EI = `turn` (rad).
///
/// `x = (EI/M) sin(Ms/EI), y = (EI/M)(1 - cos(Ms/EI)), θ = Ms/EI`: EI θ' = M everywhere, since nothing
/// but the moment acts. Full turns at M L/EI = 2πn (e.g. Bathe and Bolourchi, *Int. J. Numer. Meth. Eng.*
/// 14 (1979) 961).
pub fn roll_up(turn: f64, fraction: f64) -> ([f64; 2], f64) {
    let angle = turn * fraction;
    let half = 0.5 * angle;
    // sin x/x and (1 - cos x)/x without cancellation; both have limits at zero.
    if angle == 0.0 {
        return ([fraction, 0.0], 0.0);
    }
    ([fraction * angle.sin() / angle, fraction * half.sin() * half.sin() / half], angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn full_turns_close_the_circle() {
        for turns in 1..=5 {
            let ([x, y], angle) = roll_up(TAU * f64::from(turns), 1.0);
            assert_close(x, 0.0, 1e-16, "x");
            assert_close(y, 0.0, 1e-30, "y");
            assert_close(angle, TAU * f64::from(turns), 0.0, "angle");
        }
    }

    #[test]
    fn half_a_turn_ends_a_diameter_above_and_a_small_moment_bends_a_little() {
        let ([x, y], _) = roll_up(PI, 1.0);
        assert_close(x, 0.0, 1e-16, "x");
        assert_close(y, 2.0 / PI, 1e-15, "y");
        let ([x, y], _) = roll_up(1e-8, 1.0);
        assert_close(x, 1.0, 1e-15, "x");
        assert_close(y, 0.5e-8, 1e-23, "ML²/2EI");
    }
}
