//! The inert description of a compliant mechanism: what it is made of, not how it is solved.
//!
//! Every number is in SI units and radians. Things refer to each other by typed ids, which are positions
//! in the model's lists. A number may have a formula of parameters beside it, which is worked out here; the laws of
//! mechanics live in `flexura-mechanics`.
//!
//! Absent on purpose: solver settings, results, text positions, anything that depends on a file format.

mod beam;
mod binding;
mod body;
mod cable;
mod contact;
mod design;
mod fit;
mod foundation;
mod inverse;
mod joint;
mod load;
mod material;
mod materials;
mod motion;
mod notch;
mod output;
mod profile;
mod spin;
mod spring;
mod study;
mod text;
mod tubes;
mod validate;

pub use beam::{Beam, BeamTheory, Curve, Distributed, End, LoadAxes, SectionFrame};
pub use binding::{ALMOST_RIGHT, Binding, Bindings, Part, Rule, direction_of, roll_pitch_yaw};
pub use body::{Body, Frame, Mount};
pub use cable::{Cable, CableLaw, Guide};
pub use contact::{
    Boundary, BoundaryCurve, Contact, RevolutionProfile, Rolling, RollingCoordinate, Side, Slide, Surface,
    SurfaceMotion, Surfaces,
};
pub use design::{Condition, Front, OptimiseStudy, Optimiser, Reading, Varied, Wanted, Where};
pub use fit::{
    FitLoss, FitStudy, FitUnknown, FormulaFactor, FormulaPiece, FormulaQuantity, FormulaSource, FormulaStudy,
    FormulaTerm, FormulaUnit, FormulaVariable, MeasuredRow, Measurements,
};
pub use foundation::{Foundation, FoundationLaw};
pub use inverse::{Target, Unknown};
pub use joint::{
    CoordinateKind, CoordinateLaw, Coupling, CouplingTerm, Drive, Joint, JointKind, JointLaw, Limits, across,
};
pub use load::{Attachment, BeamPoint, Load, LoadFrame, LoadTarget, PointMass};
pub use material::{Material, Section, Shape};
pub use materials::{KnownMaterial, MATERIALS, Shear, known_material};
pub use motion::{InverseDynamicsStudy, MotionLaw, Pace, Sampling, Until};
pub use notch::{Notch, NotchShape};
pub use output::{Output, Probe, ProbeTarget, Quantity};
pub use profile::{At, Profile};
pub use spin::Spin;
pub use spring::{ExponentialForm, Obstacle, Spring, SpringLaw, Turn, Wrap};
pub use study::{BuckleStudy, CriticalStudy, ModesPath, ModesStudy, Stop, Study, StudyKind, TraceStudy};
pub use text::{is_unseen, visible, visible_lines};
pub use tubes::{Tube, Tubes};
pub use validate::{Issue, name_problem};

use flexura_expression::Formula;
use nalgebra::Vector3;
use std::sync::Arc;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident => $list:ident: $item:ty),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub usize);

        impl std::ops::Index<$name> for Model {
            type Output = $item;
            fn index(&self, id: $name) -> &$item {
                &self.$list[id.0]
            }
        }

        impl std::ops::IndexMut<$name> for Model {
            fn index_mut(&mut self, id: $name) -> &mut $item {
                &mut self.$list[id.0]
            }
        }
    )*};
}

ids! {
    /// Position of a material in [`Model::materials`].
    MaterialId => materials: Material,
    /// Position of a section in [`Model::sections`].
    SectionId => sections: Section,
    /// Position of a beam in [`Model::beams`].
    BeamId => beams: Beam,
    /// Position of a body in [`Model::bodies`].
    BodyId => bodies: Body,
    /// Position of a joint in [`Model::joints`].
    JointId => joints: Joint,
    /// Position of a spring in [`Model::springs`].
    SpringId => springs: Spring,
    /// Position of a cable in [`Model::cables`].
    CableId => cables: Cable,
    /// Position of a set of concentric tubes in [`Model::tubes`].
    TubesId => tubes: Tubes,
    /// Position of a load in [`Model::loads`].
    LoadId => loads: Load,
}

/// A named number that the model was built with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameter {
    /// Its name, unique.
    pub name: String,
    /// Its value, SI.
    pub value: f64,
    /// Its SI unit as text ("N", "m", "rad", "" for a plain number).
    pub unit: String,
    /// How it is written by other parameters, whose positions are the slots; None where it is a number.
    pub formula: Option<Arc<Formula>>,
    /// Does it decide of which parts the mechanism is made, as how often something is repeated does? Then only what read the model
    /// can make it with another value.
    pub is_structural: bool,
}

/// A compliant mechanism.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// A title for people; may be empty.
    pub name: String,
    /// Gravity in global axes, m/s². Zero unless given.
    pub gravity: Vector3<f64>,
    /// Damping in proportion to inertia, 1/s: everything that moves is held back by this times its momentum.
    pub mass_damping: f64,
    /// The whole mechanism turns, and is described in axes that turn with it.
    pub spin: Option<Spin>,
    /// The parameters and the values that the model was built with.
    pub parameters: Vec<Parameter>,
    /// How numbers follow from parameters; see [`Model::bind`].
    pub bindings: Arc<Bindings>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Cross sections.
    pub sections: Vec<Section>,
    /// Flexible beams.
    pub beams: Vec<Beam>,
    /// Rigid bodies, without the ground.
    pub bodies: Vec<Body>,
    /// Joints between bodies.
    pub joints: Vec<Joint>,
    /// Linear relations between joint coordinates.
    pub couplings: Vec<Coupling>,
    /// Springs between two points.
    pub springs: Vec<Spring>,
    /// Cables.
    pub cables: Vec<Cable>,
    /// Concentric tubes.
    pub tubes: Vec<Tubes>,
    /// Lumped masses on beams.
    pub masses: Vec<PointMass>,
    /// Point forces and moments.
    pub loads: Vec<Load>,
    /// What the user wants to read off.
    pub outputs: Vec<Output>,
    /// Parameters to be found, as many as there are targets.
    pub unknowns: Vec<Unknown>,
    /// Results with wanted values.
    pub targets: Vec<Target>,
    /// What is to be done with it.
    pub studies: Vec<Study>,
}

impl Model {
    /// Does it differ from another in more than what a neighbouring model may have another number in without that a part moves:
    /// parameters, materials, sections, beams, joints, springs, loads, and what targets want? These are for the caller to compare.
    pub fn differs_in_parts(&self, other: &Model) -> bool {
        // Taken apart whole, so that a field which is added does not compile before it is on one side or the other.
        let Model {
            name: _,
            gravity,
            mass_damping,
            spin,
            parameters: _,
            bindings: _,
            materials: _,
            sections: _,
            beams: _,
            bodies,
            joints: _,
            couplings,
            springs: _,
            cables,
            tubes,
            masses,
            loads: _,
            outputs,
            unknowns,
            targets,
            studies: _,
        } = self;
        *gravity != other.gravity
            || *mass_damping != other.mass_damping
            || *spin != other.spin
            || *bodies != other.bodies
            || *couplings != other.couplings
            || *cables != other.cables
            || *tubes != other.tubes
            || *masses != other.masses
            || *outputs != other.outputs
            || *unknowns != other.unknowns
            || targets.len() != other.targets.len()
            || targets.iter().zip(&other.targets).any(|(a, b)| a.output != b.output)
    }
}
