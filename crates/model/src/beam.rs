//! Beams: rest shape, theory, ends and distributed loads.

use crate::{At, Foundation, JointLaw, MaterialId, Mount, Profile, SectionId};
use flexura_expression::Function;
use flexura_spatial::{Pose, Vector3};

/// A flexible beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Its name, unique among beams.
    pub name: String,
    /// Its material; may be absent only when the section is given as a stiffness.
    pub material: Option<MaterialId>,
    /// Its cross section.
    pub section: SectionId,
    /// The stress-free shape of its axis, in its start frame.
    pub curve: Curve,
    /// How the section's axes e2, e3 run along the stress-free shape.
    pub frame: SectionFrame,
    /// Which strains it has.
    pub theory: BeamTheory,
    /// Time τ by which wrenches run ahead of strains, n = C⁻¹ (γ + τ γ̇) (W. Voigt), s.
    pub damping: f64,
    /// Mass per length that moves with the beam besides its section's and does not weigh, kg/m.
    pub added_mass: f64,
    /// Where s = 0 is held. None is a free end.
    pub start: Option<End>,
    /// Where s = L is held. None is a free end.
    pub end: Option<End>,
    /// Forces and moments per undeformed length, summed.
    pub distributed: Vec<Distributed>,
    /// Elastic foundations along it, summed.
    pub foundation: Vec<Foundation>,
}

/// Which strains a beam has besides bending and torsion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BeamTheory {
    /// Sections may shear against the axis (Timoshenko, Reissner). Off by default.
    pub shear: bool,
    /// The axis may stretch. On by default.
    pub extension: bool,
}

impl Default for BeamTheory {
    fn default() -> Self {
        Self { shear: false, extension: true }
    }
}

/// How a beam's end is held.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// The ground, the body or the other beam that holds it.
    pub mount: Mount,
    /// X of the attachment frame in what holds it. None: a start sits at the body's origin in the body's axes;
    /// an end attaches stress-free where the rest beam ends.
    pub placement: Option<Pose>,
    /// Clamp = weld, pin = spherical, or any other joint; the beam's end frame is the moving frame.
    pub hold: JointLaw,
}

/// The stress-free shape of a beam's axis. A curve is moved rigidly so that its start frame, e1 its
/// tangent, is the beam's start frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// Straight along e1.
    Straight {
        /// Length, m.
        length: f64,
    },
    /// A circular arc that bends towards +e2.
    Arc {
        /// Radius, m.
        radius: f64,
        /// Angle swept, rad, positive.
        angle: f64,
    },
    /// A helix, e2 pointing to its axis; the axis runs along (τ e1 + κ e3)/√(κ²+τ²).
    Helix {
        /// Radius, m.
        radius: f64,
        /// Rise per turn, m; positive is right-handed.
        pitch: f64,
        /// Number of turns.
        turns: f64,
    },
    /// A curve (x(t), y(t), z(t)), any parameter, metres.
    Parametric {
        /// Coordinates as functions of the parameter.
        position: [Function; 3],
        /// First and last parameter value.
        range: [f64; 2],
    },
    /// A smooth curve (C² cubic spline over chord length) through points, metres.
    Points {
        /// At least two, consecutive ones distinct.
        points: Vec<Vector3<f64>>,
    },
    /// Rest curvatures as functions of the arc length, 1/m.
    Curvature {
        /// k1 (twist), k2, k3 (bending).
        curvature: [Profile; 3],
        /// Length, m.
        length: f64,
    },
}

/// How the section's axes run along the rest shape. Ignored for `Curve::Curvature`, which says it itself.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionFrame {
    /// The curve's own choice: Frenet for straight (no turn), arc and helix; rotation-minimising otherwise.
    Natural,
    /// e_N = cos φ0 e2 + sin φ0 e3 with a constant offset φ0. Fails where the curvature vanishes.
    Frenet {
        /// φ0, rad.
        offset: f64,
    },
    /// Starts with e2 as near as possible to `start`, then turns about e1 only by `twist`.
    RotationMinimising {
        /// Wanted direction of e2 at the start, in the curve's own coordinates. None: the curve's y axis
        /// (its z axis where the tangent runs along y).
        start: Option<Vector3<f64>>,
        /// Turning of the section about e1 as a function of s (rad), zero at the start.
        twist: Option<Function>,
    },
    /// e2 is everywhere as near as possible to a fixed direction (in the curve's own coordinates).
    Direction {
        /// The direction; must nowhere be parallel to the tangent.
        along: Vector3<f64>,
    },
}

/// The axes in which a distributed load is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadAxes {
    /// Global: a dead load.
    Global,
    /// The section's e1, e2, e3: it follows the beam.
    Section,
}

/// A load per undeformed length.
#[derive(Clone, Debug, PartialEq)]
pub struct Distributed {
    /// N/m.
    pub force: [Profile; 3],
    /// N·m/m.
    pub moment: [Profile; 3],
    /// In which axes.
    pub axes: LoadAxes,
    /// Where it begins and ends along the beam.
    pub between: [At; 2],
}

impl Distributed {
    /// All along the beam.
    pub const EVERYWHERE: [At; 2] = [At::Fraction(0.0), At::Fraction(1.0)];

    /// Does it act at arc length `s` (m) of a beam of the given length?
    pub fn acts_at(&self, s: f64, length: f64) -> bool {
        let [from, to] = self.between.map(|at| at.arc_length(length));
        from <= s && s <= to
    }

    /// Arc lengths (m) at which it begins, ends or is not smooth.
    pub fn breaks(&self, length: f64) -> Vec<f64> {
        let mut breaks = self.between.map(|at| at.arc_length(length)).to_vec();
        let profiles = self.force.iter().chain(&self.moment);
        breaks.extend(profiles.flat_map(|profile| profile.breaks(length)));
        breaks
    }
}
