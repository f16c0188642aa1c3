//! A leg that swings at a knee which turns and shifts, and the trapezoidal speed with which it does so.
//!
//! Source: the thesis *Effects of Joint Constraints on Deformation of Multi-Body Compliant Mechanisms*, section 3.2, equations 3.11 to
//! 3.13 and Table 3.5. Polar coordinates about the knee: e_r along the leg, θ from the horizontal downwards, so that gravity is
//! m g (sin θ, cos θ) along (e_r, e_θ).

/// Mass of lower leg and foot, kg.
pub const MASS: f64 = 3.62;
/// m/s².
pub const GRAVITY: f64 = 9.81;

/// Distance of the centre of mass from the knee's first point of contact, m, and its first two derivatives by θ (rad), (3.13).
pub fn radius(theta: f64) -> [f64; 3] {
    let [a, b, c, d, e] = [1.078e-3, -11.184e-3, 26.542e-3, -0.825e-3, 263.59e-3];
    [
        (((a * theta + b) * theta + c) * theta + d) * theta + e,
        ((4.0 * a * theta + 3.0 * b) * theta + 2.0 * c) * theta + d,
        (12.0 * a * theta + 6.0 * b) * theta + 2.0 * c,
    ]
}

/// What the knee must do at an angle (rad), its rate and its second derivative: f_r and f_θ (N) of (3.12a, b), and the moment τ_a
/// (N·m) of (3.12c) with J = `inertia` + m r² about the knee, `inertia` being that about the centre of mass (kg·m²).
///
/// ```text
/// m (r̈ - r θ̇²)     = m g sin θ + f_r
/// m (2 ṙ θ̇ + r θ̈)   = m g cos θ + f_θ
/// J θ̈ + 2 m r ṙ θ̇   = m g r cos θ + τ_a
/// ```
pub fn forces([theta, rate, acceleration]: [f64; 3], inertia: f64) -> [f64; 3] {
    let [r, slope, bend] = radius(theta);
    let (speed, along) = (slope * rate, slope * acceleration + bend * rate * rate);
    let (sin, cos) = theta.sin_cos();
    [
        MASS * (along - r * rate * rate) - MASS * GRAVITY * sin,
        MASS * (2.0 * speed * rate + r * acceleration) - MASS * GRAVITY * cos,
        (inertia + MASS * r * r) * acceleration + 2.0 * MASS * r * speed * rate - MASS * GRAVITY * r * cos,
    ]
}

/// Angle (rad), rate and second derivative at a time (s) of the swing from -5° over 15° and 95° to 115°: speeding up for 0.5 s to
/// 80°/s, 1 s at that speed, slowing down for 0.5 s. The second derivative is that after a jump, at the end that before it.
pub fn swing(time: f64) -> [f64; 3] {
    let [angle, rate, acceleration] = if time < 0.5 {
        [-5.0 + 80.0 * time * time, 160.0 * time, 160.0]
    } else if time < 1.5 {
        [15.0 + 80.0 * (time - 0.5), 80.0, 0.0]
    } else {
        let left = 2.0 - time;
        [115.0 - 80.0 * left * left, 160.0 * left, -160.0]
    };
    [angle.to_radians(), rate.to_radians(), acceleration.to_radians()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    #[test]
    fn the_radius_is_differentiated_as_differences_say() {
        let h = 1e-4;
        for theta in [-0.05, 0.3, 1.2, 2.0] {
            let [before, here, after] = [-h, 0.0, h].map(|by| radius(theta + by));
            assert_close(here[1], (after[0] - before[0]) / (2.0 * h), 1e-9, "first");
            assert_close(here[2], (after[1] - before[1]) / (2.0 * h), 1e-9, "second");
        }
    }

    /// The same by Newton's law in fixed axes: the path (r cos θ, -r sin θ) differentiated twice in time by differences.
    #[test]
    fn the_forces_are_those_of_newtons_law_in_fixed_axes() {
        let place = |time: f64| {
            let [theta, ..] = swing(time);
            let [r, ..] = radius(theta);
            [r * theta.cos(), -r * theta.sin()]
        };
        let h = 1e-3;
        for time in [0.1, 0.3, 0.7, 1.2, 1.8] {
            let [x, y] = [0, 1].map(|i| {
                let at = |k: f64| place(time + k * h)[i];
                (-at(-2.0) + 16.0 * at(-1.0) - 30.0 * at(0.0) + 16.0 * at(1.0) - at(2.0)) / (12.0 * h * h)
            });
            let [fx, fy] = [MASS * x, MASS * y + MASS * GRAVITY];
            let at = swing(time);
            let (sin, cos) = at[0].sin_cos();
            let [f_r, f_theta, _] = forces(at, 0.0);
            assert_close(fx * cos - fy * sin, f_r, 1e-7, "along");
            assert_close(-fx * sin - fy * cos, f_theta, 1e-7, "across");
        }
    }

    #[test]
    fn the_moment_is_that_of_the_force_across_where_the_leg_is_a_point() {
        for time in [0.2, 0.9, 1.7] {
            let at = swing(time);
            let [_, f_theta, moment] = forces(at, 0.0);
            assert_close(moment, radius(at[0])[0] * f_theta, 1e-14, "moment");
        }
    }

    #[test]
    fn the_swing_passes_its_knots_without_a_jump_of_angle_or_speed() {
        for (time, angle) in [(0.0, -5.0), (0.5, 15.0), (1.5, 95.0), (2.0, 115.0)] {
            assert_close(swing(time)[0].to_degrees(), angle, 1e-13, "angle");
        }
        for time in [0.5, 1.5] {
            let (before, after) = (swing(time - 1e-12), swing(time + 1e-12));
            assert_close(before[1], after[1], 1e-10, "speed");
        }
    }
}
