//! The leg of [`crate::leg`] with two links beside it: an upper one hinged at the hip, a lower one hinged to the leg, and a pin between
//! them. Planar, by the loop's equations differentiated by hand and the balance of each link.

use crate::leg;

/// The links and where they are hinged; lengths m, x along the thigh, y upwards, the origin at the knee's first point of contact.
#[derive(Clone, Copy, Debug)]
pub struct Exoskeleton {
    /// Length of the upper link; the hip is as far behind the knee.
    pub upper: f64,
    /// Length of the lower link.
    pub lower: f64,
    /// Mass of both per length, kg/m.
    pub density: f64,
    /// The hinge on the leg, from the leg's centre of mass along it and across it (towards y where the leg is level).
    pub hinge: [f64; 2],
    /// Moment of inertia of the leg about its centre of mass, kg·m².
    pub inertia: f64,
}

type Plane = [f64; 2];

fn dot(a: Plane, b: Plane) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Plane, b: Plane) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: Plane, b: Plane) -> Plane {
    [a[0] - b[0], a[1] - b[1]]
}

/// The two unknowns of a (2 x 2) = b, rows of the matrix given.
fn solve(rows: [Plane; 2], b: Plane) -> Plane {
    let determinant = cross(rows[0], rows[1]);
    [
        (b[0] * rows[1][1] - b[1] * rows[0][1]) / determinant,
        (rows[0][0] * b[1] - rows[1][0] * b[0]) / determinant,
    ]
}

impl Exoskeleton {
    /// Both links in line where θ = 0, and the hinge nowhere farther from the hip.
    pub fn lined_up(upper: f64, lower: f64, density: f64, inertia: f64) -> Self {
        let [r, slope, _] = leg::radius(0.0);
        let span = (upper + lower) / (slope / upper).hypot(1.0);
        Self { upper, lower, density, hinge: [span - upper - r, -slope * span / upper], inertia }
    }

    /// The hinge on the leg and its first two derivatives by θ.
    fn hinge_at(&self, theta: f64) -> [Plane; 3] {
        let [r, slope, bend] = leg::radius(theta);
        let (sin, cos) = theta.sin_cos();
        let along = [r + self.hinge[0], slope, bend];
        let aside = self.hinge[1];
        // e_r = (cos, -sin), across = (sin, cos); e_r' = -across, across' = e_r.
        let of = |e: f64, a: f64| [e * cos + a * sin, -e * sin + a * cos];
        [
            of(along[0], aside),
            of(along[1] + aside, -along[0]),
            of(along[2] - along[0], -2.0 * along[1] - aside),
        ]
    }

    /// The pin and its first two derivatives by θ, on the branch whose pin is below the line from the hip to the hinge for θ < 0 and
    /// above it for θ > 0, as the knee is.
    fn pin_at(&self, theta: f64, hinge: &[Plane; 3]) -> [Plane; 3] {
        let hip = [-self.upper, 0.0];
        let line = minus(hinge[0], hip);
        let reach = line[0].hypot(line[1]);
        let along = (self.upper * self.upper + reach * reach - self.lower * self.lower) / (2.0 * reach);
        let height = (self.upper * self.upper - along * along).sqrt().copysign(theta);
        let unit = [line[0] / reach, line[1] / reach];
        let pin = [hip[0] + along * unit[0] - height * unit[1], along * unit[1] + height * unit[0]];
        let rows = [minus(pin, hip), minus(pin, hinge[0])];
        let first = solve(rows, [0.0, dot(rows[1], hinge[1])]);
        let relative = minus(first, hinge[1]);
        let second = solve(rows, [-dot(first, first), dot(rows[1], hinge[2]) - dot(relative, relative)]);
        [pin, first, second]
    }

    /// f_r and f_θ (N) and the moment of the knee's drive (N·m) at an angle, its rate and its second derivative. Of the links each has
    /// its centre in its middle and turns as its two ends say.
    pub fn forces(&self, at: [f64; 3]) -> [f64; 3] {
        let [theta, rate, acceleration] = at;
        let hip = [-self.upper, 0.0];
        let hinge = self.hinge_at(theta);
        let pin = self.pin_at(theta, &hinge);
        let in_time =
            |point: &[Plane; 3]| [0, 1].map(|i| point[1][i] * acceleration + point[2][i] * rate * rate);
        let (pin_acceleration, hinge_acceleration) = (in_time(&pin), in_time(&hinge));
        // What each link lacks of balance without the pin: its rate of momentum less its weight, and the same for its moment about
        // the middle, I α with α from the ends: e × ë = |e|² α.
        let lack = |length: f64, ends: [Plane; 2], accelerations: [Plane; 2]| {
            let mass = self.density * length;
            let middle = [0, 1].map(|i| 0.5 * (accelerations[0][i] + accelerations[1][i]));
            let turn =
                cross(minus(ends[1], ends[0]), minus(accelerations[1], accelerations[0])) / (length * length);
            ([mass * middle[0], mass * (middle[1] + leg::GRAVITY)], mass * length * length / 12.0 * turn)
        };
        let upper = lack(self.upper, [hip, pin[0]], [[0.0; 2], pin_acceleration]);
        let lower = lack(self.lower, [pin[0], hinge[0]], [pin_acceleration, hinge_acceleration]);
        // The force at the pin on the lower link: moments of the upper link about the hip, of the lower one about the hinge.
        let half = |a: Plane, b: Plane| [0.5 * (b[0] - a[0]), 0.5 * (b[1] - a[1])];
        let arms = [minus(pin[0], hip), minus(pin[0], hinge[0])];
        let wanted = [
            -(upper.1 + cross(half(hip, pin[0]), upper.0)),
            lower.1 + cross(half(hinge[0], pin[0]), lower.0),
        ];
        // cross(arm, f) = (-arm_y, arm_x) · f.
        let force = solve(arms.map(|arm| [-arm[1], arm[0]]), wanted);
        // The hinge on the lower link, and the opposite on the leg.
        let on_leg = minus(force, lower.0);
        let (sin, cos) = theta.sin_cos();
        let [f_r, f_theta, moment] = leg::forces(at, self.inertia);
        [
            f_r - (on_leg[0] * cos - on_leg[1] * sin),
            f_theta - (-on_leg[0] * sin - on_leg[1] * cos),
            // θ turns clockwise.
            moment + cross(hinge[0], on_leg),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;

    fn usual(density: f64) -> Exoskeleton {
        Exoskeleton::lined_up(0.40, 0.37, density, 0.04)
    }

    #[test]
    fn derivatives_of_the_loop_are_those_of_differences() {
        let links = usual(0.5);
        let h = 1e-4;
        for theta in [-0.08, -0.01, 0.02, 0.4, 1.5] {
            let hinges = [-h, 0.0, h].map(|by| links.hinge_at(theta + by));
            let pins = [0, 1, 2].map(|i| links.pin_at(theta + [-h, 0.0, h][i], &hinges[i]));
            for points in [hinges, pins] {
                for order in 0..2 {
                    for i in 0..2 {
                        let slope = (points[2][order][i] - points[0][order][i]) / (2.0 * h);
                        assert_close(points[1][order + 1][i], slope, 1e-4, "derivative");
                    }
                }
            }
        }
    }

    #[test]
    fn the_links_keep_their_lengths_and_line_up_at_zero_only() {
        let links = usual(0.5);
        for theta in [-0.08, 0.001, 0.3, 2.0] {
            let hinge = links.hinge_at(theta);
            let pin = links.pin_at(theta, &hinge)[0];
            assert_close(minus(pin, [-0.4, 0.0])[0].hypot(pin[1]), 0.4, 1e-14, "upper");
            let lower = minus(pin, hinge[0]);
            assert_close(lower[0].hypot(lower[1]), 0.37, 1e-14, "lower");
        }
        let reach = |theta: f64| {
            let [x, y] = links.hinge_at(theta)[0];
            (x + 0.4).hypot(y)
        };
        assert_close(reach(0.0), 0.77, 1e-15, "in line");
        assert!(reach(-1e-3) < 0.77 && reach(1e-3) < 0.77);
    }

    /// Without mass the links change nothing.
    #[test]
    fn links_without_mass_leave_the_leg_alone() {
        let at = leg::swing(0.9);
        let (with, without) = (usual(0.0).forces(at), leg::forces(at, 0.04));
        for (with, without) in with.into_iter().zip(without) {
            assert_close(with, without, 1e-13, "force");
        }
    }

    /// At rest the drives hold the weight: their virtual work along θ is that of gravity.
    #[test]
    fn at_rest_the_drives_do_the_work_of_gravity() {
        let links = usual(0.8);
        let energy = |theta: f64| {
            let hinge = links.hinge_at(theta);
            let pin = links.pin_at(theta, &hinge);
            let r = leg::radius(theta)[0];
            let upper = 0.8 * 0.4 * 0.5 * pin[0][1];
            let lower = 0.8 * 0.37 * 0.5 * (pin[0][1] + hinge[0][1]);
            leg::GRAVITY * (upper + lower - leg::MASS * r * theta.sin())
        };
        let h = 1e-3;
        for theta in [-0.05, 0.1, 0.9, 1.8] {
            let at = |k: f64| energy(theta + k * h);
            let slope = (at(-2.0) - 8.0 * at(-1.0) + 8.0 * at(1.0) - at(2.0)) / (12.0 * h);
            let [f_r, _, moment] = links.forces([theta, 0.0, 0.0]);
            assert_close(moment + f_r * leg::radius(theta)[1], slope, 1e-8, "work");
        }
    }
}
