//! The planar four-bar by its vector loop.
//!
//! Crank a, coupler b, rocker c and ground d: a e(θ2) + b e(θ3) = d e(0) + c e(θ4) with e(θ) = (cos θ, sin θ). Angles by circles that
//! meet, rates and accelerations by the loop differentiated once and twice. Source: R. L. Norton, *Design of Machinery*, chapters 4, 6
//! and 7.

/// Lengths of crank, coupler, rocker and ground, m.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    /// Turned by the drive.
    pub crank: f64,
    /// Between crank and rocker.
    pub coupler: f64,
    /// Turns about the other end of the ground.
    pub rocker: f64,
    /// Distance of the two pivots.
    pub ground: f64,
}

/// Angle (rad), rate and second derivative of coupler and rocker.
pub type Pair = [[f64; 3]; 2];

impl FourBar {
    /// Coupler and rocker at a crank's angle, rate and second derivative; of the two ways to assemble it the one with the rocker's
    /// tip on the left of the line from the crank's tip to the rocker's pivot.
    pub fn moved(&self, [angle, rate, acceleration]: [f64; 3]) -> Pair {
        let [a, b, c, d] = [self.crank, self.coupler, self.rocker, self.ground];
        let (sin, cos) = angle.sin_cos();
        let tip = [a * cos, a * sin];
        let [x, y] = [d - tip[0], -tip[1]];
        let span = x.hypot(y);
        let inner = ((b * b + span * span - c * c) / (2.0 * b * span)).acos();
        let coupler = y.atan2(x) + inner;
        let end = [tip[0] + b * coupler.cos(), tip[1] + b * coupler.sin()];
        let rocker = end[1].atan2(end[0] - d);
        let between = (rocker - coupler).sin();
        let coupler_rate = a * rate * (angle - rocker).sin() / (b * between);
        let rocker_rate = a * rate * (angle - coupler).sin() / (c * between);
        // b e'(θ3) θ3̈ - c e'(θ4) θ4̈ = what is known.
        let (sin3, cos3) = coupler.sin_cos();
        let (sin4, cos4) = rocker.sin_cos();
        let known = [
            a * (acceleration * sin + rate * rate * cos) + b * coupler_rate * coupler_rate * cos3
                - c * rocker_rate * rocker_rate * cos4,
            -a * (acceleration * cos - rate * rate * sin) + b * coupler_rate * coupler_rate * sin3
                - c * rocker_rate * rocker_rate * sin4,
        ];
        // -b sin3 u + c sin4 w = known[0],  b cos3 u - c cos4 w = known[1].
        let determinant = b * c * (sin3 * cos4 - cos3 * sin4);
        let coupler_acceleration = (-c * cos4 * known[0] - c * sin4 * known[1]) / determinant;
        let rocker_acceleration = (-b * sin3 * known[1] - b * cos3 * known[0]) / determinant;
        [[coupler, coupler_rate, coupler_acceleration], [rocker, rocker_rate, rocker_acceleration]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    const BARS: FourBar = FourBar { crank: 0.04, coupler: 0.102, rocker: 0.06, ground: 0.1 };

    #[test]
    fn the_loop_closes() {
        for i in 0..12 {
            let angle = f64::from(i) * 0.5;
            let [[coupler, ..], [rocker, ..]] = BARS.moved([angle, 0.0, 0.0]);
            let x = BARS.crank * angle.cos() + BARS.coupler * coupler.cos();
            let y = BARS.crank * angle.sin() + BARS.coupler * coupler.sin();
            assert_close(x, BARS.ground + BARS.rocker * rocker.cos(), 1e-15, "x");
            assert_close(y, BARS.rocker * rocker.sin(), 1e-15, "y");
        }
    }

    #[test]
    fn rates_and_accelerations_are_those_of_differences_in_time() {
        let crank = |t: f64| [0.7 + 2.0 * t + 1.5 * t * t, 2.0 + 3.0 * t, 3.0];
        let h = 1e-3;
        for time in [0.0, 0.3, 0.9] {
            let [before, here, after] = [-h, 0.0, h].map(|by| BARS.moved(crank(time + by)));
            for i in 0..2 {
                let rate = (after[i][0] - before[i][0]) / (2.0 * h);
                assert_close(here[i][1], rate, 1e-4, "rate");
                let acceleration = (after[i][1] - before[i][1]) / (2.0 * h);
                assert_close(here[i][2], acceleration, 1e-3, "acceleration");
            }
        }
    }

    /// A parallelogram: the coupler only shifts, the rocker turns as the crank does.
    #[test]
    fn a_parallelogram_turns_its_rocker_as_its_crank() {
        let bars = FourBar { crank: 1.0, coupler: 2.0, rocker: 1.0, ground: 2.0 };
        let [coupler, rocker] = bars.moved([1.1, 0.6, -0.4]);
        for (value, expected) in
            coupler.into_iter().zip([0.0; 3]).chain(rocker.into_iter().zip([1.1, 0.6, -0.4]))
        {
            assert_close(value, expected, 1e-14, "parallelogram");
        }
    }
}
