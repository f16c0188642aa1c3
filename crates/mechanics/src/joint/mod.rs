//! Joints: the pose X_FM(q) of the moving frame in the fixed frame, and the motion subspace H.
//!
//! One kind a file. H is taken at M's origin in F's axes: the columns say how M turns and how its origin
//! moves when a coordinate moves. The wrench W that the parent exerts on the child at M's origin then
//! satisfies Hᵀ W = τ.

mod contact_error;
mod cylindrical;
mod free;
mod planar;
mod prismatic;
mod revolute;
mod rolling;
mod spherical;
mod touching;
mod universal;
mod weld;

pub use contact_error::ContactError;
pub use rolling::RollingLaw;
pub use touching::{RollingPath, TouchingLaw};

#[cfg(test)]
use flexura_geometry::ImplicitSurface;
use flexura_model::{Contact, JointKind, JointLaw, SurfaceMotion, Surfaces};
use flexura_spatial::{Pose, Twist, Vector3};
use std::sync::Arc;

/// Most numbers that the configuration of a joint takes (a rotation vector and a place), and one.
pub const MAX_CONFIGURATION: usize = 7;
/// Most coordinates that a joint has.
pub const MAX_FREEDOMS: usize = 6;

/// The configuration of a joint: coordinates, or the place itself where coordinates would be singular.
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

/// Where and how two bodies touch. SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactState {
    /// The contact in the axes of M and of F.
    pub points: [Vector3<f64>; 2],
    /// Unit normal from the parent to the child, in F's axes.
    pub normal: Vector3<f64>,
    /// Unit tangent in which the contact travels on the parent as the coordinate grows, in F's axes.
    pub direction: Vector3<f64>,
    /// The boundaries' own parameters there, of child and parent; one of a curve, two of a surface.
    pub parameters: [[f64; 2]; 2],
    /// Radii of curvature of child and parent, negative where hollow; None where straight.
    pub radii: [Option<f64>; 2],
    /// How far the contact has rolled on the parent, and the child slid on it, since coordinate zero.
    pub travel: [f64; 2],
    /// Their derivatives by the coordinate.
    pub rates: [f64; 2],
    /// The parent's hollow is there wider than the child; otherwise they would cut into each other.
    pub fits: bool,
}

/// A joint of any kind.
#[derive(Clone, Debug)]
pub struct Joint {
    kind: JointKind,
    axis: Vector3<f64>,
    second_axis: Vector3<f64>,
    contact: Option<Touch>,
}

/// What a joint needs that is more than axes.
#[derive(Clone, Debug)]
enum Touch {
    Curves(rolling::Rolling),
    Sliding(touching::Touching),
    Path(touching::Path),
}

impl Joint {
    /// The kinematics of a law, whose axes must be of unit length, with lengths in units of `unit` metres. `offset` is X_FM in
    /// the initial poses (SI), from which a contact is found.
    ///
    /// # Errors
    /// A contact that makes no sense.
    pub fn new(law: &JointLaw, unit: f64, offset: &Pose) -> Result<Self, ContactError> {
        let contact = match (law.kind, law.contact.as_deref()) {
            (JointKind::Rolling(coordinate), Some(Contact::Rolling(contact))) => {
                let (axis, x) = (law.axis, law.second_axis);
                let (position, angle) = rolling::in_plane(offset, &axis, &x);
                let law = Arc::new(RollingLaw::new(contact, coordinate, position, angle)?);
                Some(Touch::Curves(rolling::Rolling { law, axis, x, unit }))
            }
            (JointKind::Contact | JointKind::SurfaceRolling, Some(Contact::Surfaces(surfaces))) => {
                Some(Touch::new(surfaces, unit, offset)?)
            }
            (JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling, _) => {
                return Err(ContactError::Missing);
            }
            _ => None,
        };
        Ok(Self { kind: law.kind, axis: law.axis, second_axis: law.second_axis, contact })
    }

    /// No motion at all.
    pub fn weld() -> Self {
        let JointLaw { kind, axis, second_axis, .. } = JointLaw::weld();
        Self { kind, axis, second_axis, contact: None }
    }

    /// Values of the coordinate between which a rolling joint is in contact; in the joint's units.
    pub fn range(&self) -> Option<[f64; 2]> {
        match &self.contact {
            Some(Touch::Curves(rolling)) => Some(rolling.range()),
            Some(Touch::Path(path)) => Some(path.range()),
            Some(Touch::Sliding(_)) | None => None,
        }
    }

    /// Where and how a joint of two boundaries touches; None of others, and beyond the boundaries' ends.
    pub fn contact(&self, configuration: &Configuration) -> Option<ContactState> {
        match &self.contact {
            Some(Touch::Curves(rolling)) => rolling.contact(configuration),
            Some(Touch::Sliding(touching)) => touching.contact(configuration),
            Some(Touch::Path(path)) => path.contact(configuration),
            None => None,
        }
    }

    /// The surfaces of child and parent that touch.
    #[cfg(test)]
    pub(crate) fn surfaces(&self) -> Option<[&ImplicitSurface; 2]> {
        match &self.contact {
            Some(Touch::Sliding(touching)) => Some(touching.law.surfaces()),
            Some(Touch::Path(path)) => Some(path.law.surfaces()),
            Some(Touch::Curves(_)) | None => None,
        }
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
            JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling => match &self.contact {
                Some(Touch::Curves(rolling)) => f(rolling),
                Some(Touch::Sliding(touching)) => f(touching),
                Some(Touch::Path(path)) => f(path),
                // A model that is sound has a law here.
                None => f(&weld::Weld),
            },
        }
    }
}

impl Touch {
    fn new(surfaces: &Surfaces, unit: f64, offset: &Pose) -> Result<Self, ContactError> {
        Ok(match surfaces.motion {
            SurfaceMotion::Sliding => {
                let law = Arc::new(TouchingLaw::new(surfaces)?);
                Touch::Sliding(touching::Touching::new(law, unit, offset)?)
            }
            SurfaceMotion::Rolling { .. } | SurfaceMotion::Osculating { .. } => {
                let law = Arc::new(RollingPath::new(surfaces, offset)?);
                Touch::Path(touching::Path { law, unit })
            }
        })
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
