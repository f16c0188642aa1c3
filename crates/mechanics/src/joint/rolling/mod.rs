//! A boundary of the child that rolls and slides on one of the parent, in a plane: the thesis's bio-joint in its planar
//! form (Chapter III), with the arc lengths matched exactly.

mod law;
mod touch;
mod travel;

pub use law::RollingLaw;

use super::{Configuration, ContactState, Kinematics, MAX_FREEDOMS};
use flexura_model::RollingCoordinate;
use flexura_spatial::{Pose, Twist, Vector3, exp};
use std::sync::Arc;

/// A law in the plane across an axis, in units of a length.
#[derive(Clone, Debug)]
pub(super) struct Rolling {
    pub law: Arc<RollingLaw>,
    /// The plane's normal and its x axis, in F's axes where M's coincide with them.
    pub axis: Vector3<f64>,
    pub x: Vector3<f64>,
    /// Lengths are in units of this many metres.
    pub unit: f64,
}

/// The angle of a pose about an axis, and its place in the plane across it.
pub(super) fn in_plane(pose: &Pose, axis: &Vector3<f64>, x: &Vector3<f64>) -> ([f64; 2], f64) {
    let q = pose.rotation.quaternion();
    let along = Vector3::new(q.i, q.j, q.k).dot(axis);
    let y = axis.cross(x);
    ([pose.position.dot(x), pose.position.dot(&y)], 2.0 * along.atan2(q.w))
}

impl Rolling {
    fn space(&self, v: [f64; 2]) -> Vector3<f64> {
        self.x * v[0] + self.axis.cross(&self.x) * v[1]
    }

    /// SI units of the coordinate.
    fn coordinate_unit(&self) -> f64 {
        if self.law.coordinate == RollingCoordinate::Arc { self.unit } else { 1.0 }
    }

    /// Coordinates between which there is contact.
    pub fn range(&self) -> [f64; 2] {
        self.law.range.map(|q| q / self.coordinate_unit())
    }

    /// Where and how the boundaries touch, SI.
    pub fn contact(&self, configuration: &Configuration) -> Option<ContactState> {
        let unit = self.coordinate_unit();
        let placed = self.law.place(configuration[0] * unit)?;
        let tangent = placed.parent.tangent();
        let outward = [tangent[1], -tangent[0]];
        let sense = self.law.sense;
        let (a, b) = (placed.travel.child, placed.travel.parent);
        let radius = |curvature: f64| if curvature == 0.0 { None } else { Some(1.0 / curvature) };
        Some(ContactState {
            points: [self.space(placed.child.point), self.space(placed.parent.point)],
            normal: self.space(outward) * sense,
            direction: self.space(tangent) * sense,
            parameters: [[placed.child.parameter, 0.0], [placed.parent.parameter, 0.0]],
            radii: [radius(placed.child.curvature), radius(sense * placed.parent.curvature)],
            travel: [b[0], a[0] - b[0]],
            rates: [b[1], a[1] - b[1]],
            fits: self.law.fits(&placed),
        })
    }
}

fn nowhere() -> Twist {
    Twist { angular: Vector3::repeat(f64::NAN), linear: Vector3::repeat(f64::NAN) }
}

impl Kinematics for Rolling {
    fn home(&self) -> Configuration {
        Configuration::default()
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        // Beyond the end of a boundary there is no pose; the state is refused.
        match self.law.place(configuration[0] * self.coordinate_unit()) {
            Some(placed) => {
                Pose::new(exp(&(self.axis * placed.angle[0])), self.space(placed.position[0]) / self.unit)
            }
            None => Pose::translation(Vector3::repeat(f64::NAN)),
        }
    }
    fn subspace(&self, configuration: &Configuration, _: usize) -> Twist {
        let unit = self.coordinate_unit();
        self.law.place(configuration[0] * unit).map_or_else(nowhere, |placed| Twist {
            angular: self.axis * (placed.angle[1] * unit),
            linear: self.space(placed.position[1]) * (unit / self.unit),
        })
    }
    fn subspace_change(&self, configuration: &Configuration, _: usize, _: usize) -> Twist {
        let unit = self.coordinate_unit();
        self.law.place(configuration[0] * unit).map_or_else(nowhere, |placed| Twist {
            angular: self.axis * (placed.angle[2] * unit * unit),
            linear: self.space(placed.position[2]) * (unit * unit / self.unit),
        })
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        [configuration[0] + step[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        [to[0] - from[0], 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        [configuration[0], 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        [coordinates[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        let (_, angle) = in_plane(pose, &self.axis, &self.x);
        [self.law.with_angle(angle) / self.coordinate_unit(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}

#[cfg(test)]
mod tests;
