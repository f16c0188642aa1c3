//! A thousand cantilevers with random spatial end wrenches, each from the straight rod: none may fail and none
//! may end on another branch than the one that fine continuation from rest leads to.

use flexura_model::{
    At, Beam, BeamId, BeamPoint, BeamTheory, Curve, End, JointLaw, Load, LoadFrame, LoadId, LoadTarget,
    Model, Mount, Section, SectionFrame, SectionId, Shape,
};
use flexura_solution::Status;
use flexura_spatial::Vector3;
use flexura_study::Prepared;

/// L = 1, EI = 1, GJ = EI/1.3, neither shear nor stretch.
fn cantilever() -> Model {
    let mut model = Model::default();
    model.sections.push(Section {
        name: "rod".into(),
        shape: Shape::Stiffness {
            ea: 1.0.into(),
            gj: (1.0 / 1.3).into(),
            ei2: 1.0.into(),
            ei3: 1.0.into(),
            ga2: None,
            ga3: None,
            mass_per_length: None,
            rotary_inertia: None,
        },
        plane_strain: false,
    });
    model.beams.push(Beam {
        name: "rod".into(),
        material: None,
        section: SectionId(0),
        curve: Curve::Straight { length: 1.0 },
        frame: SectionFrame::Natural,
        theory: BeamTheory { shear: false, extension: false },
        damping: 0.0,
        added_mass: 0.0,
        start: Some(End { mount: Mount::Ground, placement: None, hold: JointLaw::weld() }),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model.loads.push(Load {
        name: "end".into(),
        target: LoadTarget::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) }),
        force: Vector3::zeros(),
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    model
}

/// xorshift64 with the shifts of G. Marsaglia, "Xorshift RNGs", J. Stat. Softw. 8 (2003).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| 2.0 * self.unit() - 1.0);
            if v.norm() < 1.0 && v.norm() > 0.1 {
                return v.normalize();
            }
        }
    }
}

#[test]
fn a_thousand_random_wrenches_find_the_branch_that_fine_continuation_finds() {
    let mut random = Random(0x1234_5678_9abc_def1);
    let mut quick = Prepared::new(&cantilever()).unwrap();
    let mut fine = Prepared::new(&cantilever()).unwrap();
    let options = fine.path_options();
    options.largest_correction = 0.01;
    options.largest_contraction = 0.02;
    options.first_response = 0.1;
    options.point_tolerance = 1e-9;
    fine.problem().refine_path(1e-9);
    let (mut folds, mut largest) = (0, 0.0_f64);
    for i in 0..1000 {
        // Force to 10 EI/L², moment to EI/L.
        let force = random.direction() * (10.0 * random.unit());
        let moment = random.direction() * random.unit();
        fine.set_point_load(LoadId(0), force, moment);
        if fine.solve(1e-10, &mut |_| {}).status != Status::Converged {
            folds += 1;
            continue;
        }
        quick.set_point_load(LoadId(0), force, moment);
        let outcome = quick.solve(1e-6, &mut |_| {});
        assert_eq!(outcome.status, Status::Converged, "load {i}: {force:?} {moment:?} {:?}", outcome.reason);
        let error = (quick.problem().tip() - fine.problem().tip()).norm();
        assert!(error < 1e-6, "load {i}: {force:?} {moment:?}: tip off by {error}");
        largest = largest.max(error);
    }
    println!("{folds} loads pass a fold and are left out; largest tip difference {largest:.1e} L");
    assert!(folds < 20, "{folds} folds");
}
