//! Materials and cross sections.

use crate::Profile;
use nalgebra::Matrix6;

/// A linear elastic material. Along the fibres of a composite E and G are independent of each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, unique among materials.
    pub name: String,
    /// Young's modulus E, Pa.
    pub young: f64,
    /// Shear modulus G, Pa.
    pub shear: f64,
    /// Density, kg/m³. None is massless.
    pub density: Option<f64>,
    /// Yield strength, Pa; enables the safety factor.
    pub yield_strength: Option<f64>,
}

impl Material {
    /// Do E and G go together as in an isotropic material, with Poisson's ratio above -1 and at most at 0.5?
    pub fn is_isotropic(&self) -> bool {
        let ratio = self.young / (2.0 * self.shear) - 1.0;
        // G = E/3 of an incompressible material is no exact double.
        ratio > -1.0 && ratio <= 0.5 + 1e-9
    }
}

/// The cross section of a beam. e2 runs along the width, e3 along the height.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its name, unique among sections.
    pub name: String,
    /// Its shape and dimensions.
    pub shape: Shape,
    /// A wide strip cannot contract sideways when bent: bending stiffnesses E/(1-ν²) instead of E.
    pub plane_strain: bool,
}

/// The shapes of cross sections; dimensions in metres, each may vary along the beam.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant)] // There are few sections; a box would only be in the way.
pub enum Shape {
    /// Solid rectangle.
    Rectangle {
        /// Along e2.
        width: Profile,
        /// Along e3.
        height: Profile,
    },
    /// Solid circle.
    Circle {
        /// Outer diameter.
        diameter: Profile,
    },
    /// Round tube.
    Tube {
        /// Outer diameter.
        outer_diameter: Profile,
        /// Inner diameter.
        inner_diameter: Profile,
    },
    /// Solid ellipse.
    Ellipse {
        /// Full axis along e2.
        width: Profile,
        /// Full axis along e3.
        height: Profile,
    },
    /// Stiffnesses given directly; `f64::INFINITY` is rigid. No stress is reported.
    Stiffness {
        /// EA, N.
        ea: Profile,
        /// GJ, N·m².
        gj: Profile,
        /// EI2 (bending about e2), N·m².
        ei2: Profile,
        /// EI3 (bending about e3), N·m².
        ei3: Profile,
        /// Shear stiffness ks2 G A along e2, N; needed when the beam shears.
        ga2: Option<Profile>,
        /// Shear stiffness ks3 G A along e3, N; needed when the beam shears.
        ga3: Option<Profile>,
        /// Mass per length, kg/m. None is massless.
        mass_per_length: Option<Profile>,
        /// Moments of inertia per length about e1, e2, e3, kg·m. None: none.
        rotary_inertia: Option<Box<[Profile; 3]>>,
    },
    /// The full symmetric stiffness in the order (ε, γ2, γ3, κ1, κ2, κ3) -> (F1, F2, F3, M1, M2, M3).
    StiffnessMatrix {
        /// 6 x 6, positive definite; N, N·m, N·m².
        matrix: Box<Matrix6<f64>>,
        /// Mass per length, kg/m. None is massless.
        mass_per_length: Option<Profile>,
        /// Moments of inertia per length about e1, e2, e3, kg·m. None: none.
        rotary_inertia: Option<Box<[Profile; 3]>>,
    },
}
