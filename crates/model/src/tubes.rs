//! Concentric pre-curved tubes: continuum robots whose shape follows from turning and shifting tubes in each other.

use crate::{Frame, MaterialId, SectionId};
use flexura_spatial::Vector3;

/// Round tubes, each inside the next, that share one axis and turn in each other without friction. They neither stretch
/// nor shear.
#[derive(Clone, Debug, PartialEq)]
pub struct Tubes {
    /// Its name, unique among these.
    pub name: String,
    /// Where they leave their guide, along the frame's x axis.
    pub base: Frame,
    /// One to four, the innermost first; it must reach at least as far as any other.
    pub tubes: Vec<Tube>,
    /// Dead force on the tip of the first, global axes, N.
    pub force: Vector3<f64>,
    /// Dead moment there, N·m.
    pub moment: Vector3<f64>,
}

/// One tube: straight at its back, of constant rest curvature in front.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// Its material; may be absent only when the section is given as a stiffness.
    pub material: Option<MaterialId>,
    /// Its cross section, as stiff in one direction as in the other.
    pub section: SectionId,
    /// Length of the straight part, m; may be zero.
    pub straight: f64,
    /// Length of the curved part, m; may be zero.
    pub curved: f64,
    /// Rest curvature of the curved part, 1/m: towards +y of the base where the tube is not turned.
    pub curvature: f64,
    /// Turn of its back end about the axis, rad.
    pub rotation: f64,
    /// Where its back end is on the axis, m: zero or negative, in the guide, which keeps it straight.
    pub translation: f64,
}

impl Tube {
    /// Where it ends on the common axis, m from the guide's mouth.
    pub fn reach(&self) -> f64 {
        self.straight + self.curved + self.translation
    }
}
