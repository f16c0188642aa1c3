//! Models in a few words.

use flexura_model::{
    At, Beam, BeamId, BeamPoint, BeamTheory, Curve, End, JointLaw, Load, LoadFrame, LoadTarget, Model, Mount,
    Section, SectionFrame, SectionId, Shape,
};
use flexura_spatial::{Pose, Vector3};

/// Bending, torsion and stretch, nothing else: the default theory.
pub const UNSHEARABLE: BeamTheory = BeamTheory { shear: false, extension: true };
/// Bending and torsion only.
pub const INEXTENSIBLE: BeamTheory = BeamTheory { shear: false, extension: false };
/// All six strains.
pub const SHEARABLE: BeamTheory = BeamTheory { shear: true, extension: true };

/// Stiffnesses of a section, N and N·m².
#[derive(Clone, Copy, Debug)]
pub struct Stiffness {
    /// EA.
    pub ea: f64,
    /// GA along e2 and e3.
    pub ga: f64,
    /// GJ.
    pub gj: f64,
    /// EI2.
    pub ei2: f64,
    /// EI3.
    pub ei3: f64,
}

impl Stiffness {
    /// Equal bending stiffnesses of one, GJ = 1/1.3, and no stretch or shear.
    pub fn unit() -> Self {
        Self { ea: f64::INFINITY, ga: f64::INFINITY, gj: 1.0 / 1.3, ei2: 1.0, ei3: 1.0 }
    }

    /// The section that has them.
    pub fn section(&self) -> Section {
        Section {
            name: "stiffness".to_string(),
            shape: Shape::Stiffness {
                ea: self.ea.into(),
                gj: self.gj.into(),
                ei2: self.ei2.into(),
                ei3: self.ei3.into(),
                ga2: self.ga.is_finite().then(|| self.ga.into()),
                ga3: self.ga.is_finite().then(|| self.ga.into()),
                mass_per_length: None,
                rotary_inertia: None,
            },
            plane_strain: false,
        }
    }

    /// (1/EA, 1/GA2, 1/GA3, 1/GJ, 1/EI2, 1/EI3) as the reference methods want it.
    pub fn compliance(&self) -> [f64; 6] {
        [self.ea, self.ga, self.ga, self.gj, self.ei2, self.ei3].map(|stiffness| 1.0 / stiffness)
    }

    /// The softest of bending and torsion, by which wrenches are measured.
    pub fn softest(&self) -> f64 {
        self.gj.min(self.ei2).min(self.ei3)
    }
}

/// A beam clamped to the ground at `place`, its other end free, without any load.
pub fn cantilever(section: Section, curve: Curve, theory: BeamTheory, place: Pose) -> Model {
    let mut model = Model::default();
    model.sections.push(section);
    model.beams.push(Beam {
        name: "beam".to_string(),
        material: None,
        section: SectionId(0),
        curve,
        frame: SectionFrame::Natural,
        theory,
        damping: 0.0,
        added_mass: 0.0,
        start: Some(clamped(Mount::Ground, Some(place))),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model
}

/// A clamp on a body.
pub fn clamped(body: Mount, placement: Option<Pose>) -> End {
    End { mount: body, placement, hold: JointLaw::weld() }
}

/// Adds a force and a moment at the far end of the first beam.
pub fn load_tip(model: &mut Model, force: Vector3<f64>, moment: Vector3<f64>, frame: LoadFrame) {
    let point = BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) };
    model.loads.push(Load {
        name: format!("load_{}", model.loads.len()),
        target: LoadTarget::Beam(point),
        force,
        moment,
        frame,
    });
}

/// A straight beam of length one with the stiffnesses of [`Stiffness::unit`], loaded at its end.
pub fn unit_cantilever(force: Vector3<f64>, moment: Vector3<f64>, frame: LoadFrame) -> Model {
    let section = Stiffness::unit().section();
    let mut model = cantilever(section, Curve::Straight { length: 1.0 }, INEXTENSIBLE, Pose::identity());
    load_tip(&mut model, force, moment, frame);
    model
}
