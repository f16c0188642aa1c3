//! Joints: the pose X_FM(q) of the moving frame in the fixed frame, and the motion subspace H.
//!
//! One kind a file. H is taken at M's origin in F's axes: the columns say how M turns and how its origin
//! moves when a coordinate moves. The wrench W that the parent exerts on the child at M's origin then
//! satisfies Hᵀ W = τ.

mod cylindrical;
mod free;
mod planar;
mod prismatic;
mod revolute;
mod spherical;
mod universal;
mod weld;

use flexura_model::{JointKind, JointLaw};
use flexura_spatial::{Pose, Twist, Vector3};

/// Most numbers that the configuration of a joint takes (a position and a quaternion).
pub const MAX_CONFIGURATION: usize = 7;
/// Most coordinates that a joint has.
pub const MAX_FREEDOMS: usize = 6;

/// The configuration of a joint: coordinates, or a quaternion where coordinates would be singular.
pub type Configuration = [f64; MAX_CONFIGURATION];

/// The kinematics of one kind of joint.
pub trait Kinematics {
    /// The configuration in which F and M coincide.
    fn home(&self) -> Configuration;

    /// X_FM.
    fn pose(&self, configuration: &Configuration) -> Pose;

    /// Column `i` of H: turning (rad per unit) and motion of M's origin (m per unit), in F's axes.
    fn subspace(&self, configuration: &Configuration, i: usize) -> Twist;

    /// How column `i` of H changes along coordinate `j`, in F's axes.
    fn subspace_change(&self, _configuration: &Configuration, _i: usize, _j: usize) -> Twist {
        Twist { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }

    /// The configuration after the coordinates have moved by `step` along H.
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration;

    /// The step along H that leads from one configuration to another: the inverse of [`Kinematics::moved`].
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS];

    /// The coordinates as a user reads them (m, rad).
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS];

    /// The configuration with the given coordinates.
    fn configuration(&self, coordinates: &[f64]) -> Configuration;

    /// The generalised force along H, and its tangent along H, of efforts `tau` on the coordinates that change
    /// by `slope` per coordinate: τ_H = (dq/dh)ᵀ τ. Coordinates that are their own steps along H pass through.
    fn generalised(
        &self,
        _configuration: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let mut tangent = [[0.0; MAX_FREEDOMS]; MAX_FREEDOMS];
        for i in 0..MAX_FREEDOMS {
            tangent[i][i] = slope[i];
        }
        (*tau, tangent)
    }

    /// The configuration whose X_FM is nearest to `pose` in the joint's own motions.
    fn nearest(&self, pose: &Pose) -> Configuration;
}

/// A joint of any kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    kind: JointKind,
    axis: Vector3<f64>,
    second_axis: Vector3<f64>,
}

impl Joint {
    /// The kinematics of a law; its axes must be of unit length.
    pub fn new(law: &JointLaw) -> Self {
        Self { kind: law.kind, axis: law.axis, second_axis: law.second_axis }
    }

    /// Number of coordinates.
    pub fn freedoms(&self) -> usize {
        self.kind.freedoms()
    }

    fn with<T>(&self, f: impl FnOnce(&dyn Kinematics) -> T) -> T {
        match self.kind {
            JointKind::Weld => f(&weld::Weld),
            JointKind::Revolute => f(&revolute::Revolute { axis: self.axis }),
            JointKind::Prismatic => f(&prismatic::Prismatic { axis: self.axis }),
            JointKind::Cylindrical => f(&cylindrical::Cylindrical { axis: self.axis }),
            JointKind::Universal => f(&universal::Universal { first: self.axis, second: self.second_axis }),
            JointKind::Spherical => f(&spherical::Spherical),
            JointKind::Planar => f(&planar::Planar { normal: self.axis, x: self.second_axis }),
            JointKind::Free => f(&free::Free),
        }
    }
}

impl Kinematics for Joint {
    fn home(&self) -> Configuration {
        self.with(|k| k.home())
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        self.with(|k| k.pose(configuration))
    }
    fn subspace(&self, configuration: &Configuration, i: usize) -> Twist {
        self.with(|k| k.subspace(configuration, i))
    }
    fn subspace_change(&self, configuration: &Configuration, i: usize, j: usize) -> Twist {
        self.with(|k| k.subspace_change(configuration, i, j))
    }
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        self.with(|k| k.moved(configuration, step))
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        self.with(|k| k.step(from, to))
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        self.with(|k| k.coordinates(configuration))
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        self.with(|k| k.configuration(coordinates))
    }
    fn generalised(
        &self,
        configuration: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        self.with(|k| k.generalised(configuration, tau, slope))
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        self.with(|k| k.nearest(pose))
    }
}

#[cfg(test)]
mod tests;
