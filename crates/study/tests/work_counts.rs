//! Work counts of three solves, exact: a change that makes the solver work more, or less, shows here.

use flexura_model::*;
use flexura_solution::{Status, Work};
use flexura_spatial::{Pose, Vector3, exp};
use flexura_study::{Options, solve};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

fn solved(ei: f64, curve: Curve, start: Pose, force: Vector3<f64>) -> Work {
    let p = Profile::Constant;
    let mut model = Model::default();
    let shape = Shape::Stiffness {
        ea: p(1e9 * ei),
        gj: p(ei),
        ei2: p(ei),
        ei3: p(ei),
        ga2: None,
        ga3: None,
        mass_per_length: None,
        rotary_inertia: None,
    };
    model.sections.push(Section { name: "section".into(), shape, plane_strain: false });
    model.beams.push(Beam {
        name: "beam".into(),
        material: None,
        section: SectionId(0),
        curve,
        frame: SectionFrame::Natural,
        theory: BeamTheory { shear: false, extension: false },
        damping: 0.0,
        added_mass: 0.0,
        start: Some(End { mount: Mount::Ground, placement: Some(start), hold: JointLaw::weld() }),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    let point = BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) };
    model.loads.push(Load {
        name: "tip".into(),
        target: LoadTarget::Beam(point),
        force,
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    let solution = solve(&model, &Options::default(), &mut |_| {}).expect("the model is sound");
    assert_eq!(solution.status, Status::Converged);
    solution.work
}

#[test]
fn a_gentle_load_is_reached_in_one_load_step() {
    let curve = Curve::Straight { length: 1.0 };
    let work = solved(1.0, curve, Pose::identity(), Vector3::new(0.0, 0.5, 0.0));
    assert_eq!((work.load_steps, work.rejected_steps, work.segments), (1, 0, 1), "{work:?}");
    assert!(work.factorisations <= 3 && work.integration_steps <= 4, "{work:?}");
}

#[test]
fn the_elastica_and_the_bend_take_no_more_work_than_they_did() {
    let curve = Curve::Straight { length: 1.0 };
    let elastica = solved(1.0, curve, Pose::identity(), Vector3::new(0.0, 10.0, 0.0));
    assert!(elastica.factorisations <= 15 && elastica.residuals <= 17, "{elastica:?}");
    assert!(elastica.load_steps + elastica.rejected_steps <= 9, "{elastica:?}");
    let turned = exp(&Vector3::new(0.0, 0.0, FRAC_PI_2)) * exp(&Vector3::new(PI, 0.0, 0.0));
    let bend = solved(
        1e7 / 12.0,
        Curve::Arc { radius: 100.0, angle: FRAC_PI_4 },
        Pose::new(turned, Vector3::zeros()),
        Vector3::new(0.0, 0.0, 600.0),
    );
    assert!(bend.factorisations <= 9 && bend.residuals <= 11 && bend.integration_steps <= 8, "{bend:?}");
}
