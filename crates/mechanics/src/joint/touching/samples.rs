//! Surfaces and joints that tests look at, of sizes about one metre.

use crate::joint::{ContactError, Joint};
use flexura_model::{Contact, JointKind, JointLaw, RevolutionProfile, Surface, SurfaceMotion, Surfaces};
use flexura_spatial::{Pose, Vector3, exp};
use std::f64::consts::PI;

pub fn axes(x: f64, y: f64, z: f64) -> Surface {
    Surface::Ellipsoid { semi_axes: Vector3::new(x, y, z) }
}

pub fn ellipsoid() -> Surface {
    axes(1.1, 0.8, 1.5)
}

pub fn other() -> Surface {
    axes(1.6, 1.2, 0.9)
}

/// A hollow with room for all the others.
pub fn wide() -> Surface {
    axes(4.0, 3.5, 4.5)
}

pub fn cylinder() -> Surface {
    Surface::Cylinder { semi_axes: [0.7, 1.2] }
}

pub fn pear() -> Surface {
    let radius = flexura_expression::Function::parse("sqrt(1.2 - z^2)*(1 + 0.15*z)", "z").unwrap();
    let end = 1.2_f64.sqrt();
    Surface::Revolution { profile: RevolutionProfile::Radius { radius, range: [-end, end] } }
}

/// Points of a bumpy ellipsoid.
pub fn heights() -> Surface {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let count = 150;
    let point = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / f64::from(count);
        let (sin, cos) = (golden * i as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        let d = Vector3::new(across * cos, across * sin, z);
        let far = 1.0 + 0.03 * d.x - 0.02 * d.y * d.z + 0.02 * d.x * d.x * d.y;
        Vector3::new(1.2 * d.x, 0.9 * d.y, 1.4 * d.z) * far
    };
    let points = (0..count as usize).map(point).collect();
    Surface::Heights { semi_axes: Vector3::new(1.2, 0.9, 1.4), points, degree: 4 }
}

pub fn described(child: Surface, parent: Surface, concave: bool, motion: SurfaceMotion) -> Surfaces {
    Surfaces { child, parent, concave, motion, range: [-PI, PI], close: true }
}

pub fn made(surfaces: Surfaces, unit: f64, offset: &Pose) -> Result<Joint, ContactError> {
    let kind = match surfaces.motion {
        SurfaceMotion::Sliding => JointKind::Contact,
        SurfaceMotion::Rolling { .. } | SurfaceMotion::Osculating { .. } => JointKind::SurfaceRolling,
    };
    let mut law = JointLaw::free(kind, Vector3::z());
    law.contact = Some(Box::new(Contact::Surfaces(surfaces)));
    Joint::new(&law, unit, offset)
}

/// A joint that starts turned a little, to the side of the parent that looks along (1, 0.4, 0.6).
pub fn sample(child: Surface, parent: Surface, concave: bool, motion: SurfaceMotion, unit: f64) -> Joint {
    let turn = exp(&Vector3::new(0.3, -0.2, 0.1));
    let offset = Pose::new(turn, Vector3::new(1.0, 0.4, 0.6) * 2.2);
    made(described(child, parent, concave, motion), unit, &offset).unwrap()
}
