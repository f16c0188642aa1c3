//! A rod between two given poses, twist included: the forward kinematics of a rod held at both ends.

use crate::build::{Stiffness, UNSHEARABLE, cantilever, clamped};
use crate::measure::{Units, largest_deviation, parts, solve};
use crate::{Case, Row};
use flexura_model::{Curve, Model, Mount};
use flexura_spatial::{Pose, Twist, Vector3, exp};
use flexura_testkit::collocation::{self, Mesh, Solution, Tip};
use flexura_testkit::ivp::rest_poses;
use flexura_testkit::rod::Rod;

pub const CASES: [Case; 1] = [Case {
    id: "clamped_clamped",
    title: "Rod clamped at both ends, both poses and the twist given",
    citation: "Chebyshev collocation of the balance equations, a different method (Ascher, Mattheij and Russell, \
               *Numerical Solution of Boundary Value Problems for ODEs*, 1995, ch. 5)",
    needed: "1e-8, every pose and wrench",
    run,
    closed_form: None,
}];

/// A rod and where its far end is brought to, in the start's frame.
struct Held {
    name: &'static str,
    stiffness: Stiffness,
    /// Radius and angle of the arc at rest; None for a straight rod of length one.
    arc: Option<(f64, f64)>,
    end: Pose,
}

fn all() -> [Held; 3] {
    let round = Stiffness { ea: 1e4, ga: f64::INFINITY, gj: 1.0 / 1.3, ei2: 1.0, ei3: 1.0 };
    let flat = Stiffness { ei3: 1.0 / 0.6, ..round };
    [
        Held {
            name: "arc, strip-like",
            stiffness: flat,
            arc: Some((1.25, 0.8)),
            end: Pose::new(exp(&Vector3::new(0.9, 0.3, 1.6)), Vector3::new(0.7, 0.35, -0.1)),
        },
        Held {
            // Tilted, for a round rod between ends that differ by a twist and a shift alone is symmetric, and
            // meets a branch point when it buckles.
            name: "straight, twisted by 2.5 rad, tilted and brought nearer",
            stiffness: round,
            arc: None,
            end: Pose::new(
                exp(&Vector3::new(0.0, 0.4, 0.7)) * exp(&Vector3::new(2.5, 0.0, 0.0)),
                Vector3::new(0.85, 0.2, -0.15),
            ),
        },
        Held {
            name: "straight, ends at a right angle",
            stiffness: round,
            arc: None,
            end: Pose::new(exp(&Vector3::new(0.5, -1.2, 0.7)), Vector3::new(0.6, 0.25, 0.45)),
        },
    ]
}

impl Held {
    fn length(&self) -> f64 {
        self.arc.map_or(1.0, |(radius, angle)| radius * angle)
    }

    fn model(&self, place: Pose) -> Model {
        let curve = match self.arc {
            Some((radius, angle)) => Curve::Arc { radius, angle },
            None => Curve::Straight { length: 1.0 },
        };
        let mut model = cantilever(self.stiffness.section(), curve, UNSHEARABLE, place);
        model.beams[0].end = Some(clamped(Mount::Ground, Some(place * self.end)));
        model
    }

    /// The same way as a user thinks of it: the end is led from where it rests along one screw motion.
    fn reference(&self, place: Pose) -> Result<Solution, String> {
        let rest_curvature = Vector3::new(0.0, 0.0, self.arc.map_or(0.0, |(radius, _)| 1.0 / radius));
        let rod = Rod::uniform(self.length(), self.stiffness.compliance(), rest_curvature);
        let rest = rest_poses(&rod, 64)[64].1;
        let screw = (rest.inverse() * self.end).log();
        let tip = |fraction: f64| {
            let part = Twist { angular: screw.angular * fraction, linear: screw.linear * fraction };
            Tip::Pose(place * rest * Pose::exp(&part))
        };
        let mesh = Mesh { elements: 2, degree: 22 };
        collocation::solve(&rod, &place, &tip, 12, mesh).map_err(|error| format!("{}: {error:?}", self.name))
    }
}

fn run() -> Result<Vec<Row>, String> {
    let place = Pose::new(exp(&Vector3::new(0.4, -0.2, 1.0)), Vector3::new(0.3, -0.1, 0.2));
    let mut rows = Vec::new();
    for held in all() {
        let solution = solve(&held.model(place), 1e-10).map_err(|error| format!("{}: {error}", held.name))?;
        let reference = held.reference(place)?;
        let units = Units { length: held.length(), stiffness: held.stiffness.softest() };
        let off = largest_deviation(&solution.beams[0], &units, &|s| parts(&reference.at(s)));
        rows.push(
            Row::vanishing(format!("all poses and wrenches, scaled, {}", held.name), off, 1e-8)
                .with_estimate(solution.error_estimate),
        );
    }
    Ok(rows)
}
