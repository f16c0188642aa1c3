//! Stress, safety and outputs of a strip in pure bending, against the formulas of a handbook.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura_expression::Formula;
use flexura_model::*;
use flexura_post::{OutputValue, PostError, evaluate, place_name, summarise};
use flexura_solution::*;
use flexura_spatial::{Matrix3, Pose, Vector3, Wrench, exp};

const YOUNG: f64 = 200e9;
const WIDTH: f64 = 0.02;
const HEIGHT: f64 = 0.001;
const LENGTH: f64 = 0.3;

/// A strip under a moment that grows from the tip to the clamp, turned by half a turn about z at its end,
/// with an axial force of its own.
fn strip(force: f64, moment: f64) -> (Model, Solution) {
    let mut model = Model::default();
    model.materials.push(Material {
        name: "steel".into(),
        young: YOUNG,
        shear: 80e9,
        density: None,
        yield_strength: Some(1e9),
    });
    model.sections.push(Section {
        name: "strip".into(),
        shape: Shape::Rectangle { width: WIDTH.into(), height: HEIGHT.into() },
        plane_strain: false,
    });
    model.beams.push(Beam {
        name: "strip".into(),
        material: Some(MaterialId(0)),
        section: SectionId(0),
        curve: Curve::Straight { length: LENGTH },
        frame: SectionFrame::Natural,
        theory: BeamTheory::default(),
        damping: 0.0,
        added_mass: 0.0,
        start: None,
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model.bodies.push(Body {
        name: "tip".into(),
        pose: Pose::identity(),
        mass: 0.0,
        center_of_mass: Vector3::zeros(),
        inertia: Matrix3::zeros(),
    });
    let samples = (0..=10).map(|i| {
        let t = f64::from(i) / 10.0;
        let rotation = exp(&Vector3::new(0.0, 0.0, std::f64::consts::PI * t));
        BeamSample {
            s: LENGTH * t,
            pose: Pose::new(rotation, Vector3::new(LENGTH * t, 0.0, 0.0)),
            rest_pose: Pose::identity(),
            wrench: Wrench::new(
                rotation * Vector3::new(force, 0.0, 0.0),
                rotation * Vector3::new(0.0, moment * (1.0 - t), 0.0),
            ),
            curvature: Vector3::new(0.1, 0.2, 0.3),
            rest_curvature: Vector3::zeros(),
            strain: Vector3::new(0.5e-3, 0.0, 0.0),
            foundation: Vector3::zeros(),
        }
    });
    let solution = Solution {
        status: Status::Converged,
        reason: None,
        load_fraction: 1.0,
        residual: 0.0,
        error_estimate: 0.0,
        warnings: Vec::new(),
        work: Work::default(),
        beams: vec![BeamSolution { samples: samples.collect(), length: LENGTH, ..BeamSolution::default() }],
        bodies: vec![Pose::new(exp(&Vector3::new(0.3, 0.0, 0.0)), Vector3::new(0.0, 4.0, 3.0))],
        joints: Vec::new(),
        springs: Vec::new(),
        couplings: Vec::new(),
        cables: Vec::new(),
        tubes: Vec::new(),
        tangents: Vec::new(),
        sensitivities: None,
        found: Vec::new(),
        energy: 7.0,
        stable: None,
        unstable_directions: None,
        stability_reason: None,
        rates: None,
    };
    (model, solution)
}

fn output(name: &str, target: ProbeTarget, quantity: Quantity, components: usize) -> Output {
    Output {
        name: name.into(),
        unit: String::new(),
        formulas: (0..components).map(Formula::slot).collect(),
        probes: (0..components).map(|component| Probe { target, quantity, component }).collect(),
    }
}

fn assert_close(value: f64, wanted: f64) {
    assert!((value - wanted).abs() <= 1e-12 * wanted.abs(), "{value} is not {wanted}");
}

#[test]
fn bending_and_axial_stress_add_up_at_the_outer_fibre() {
    let (force, moment) = (100.0, 0.5);
    let (model, solution) = strip(force, moment);
    let evaluation = evaluate(&model, &solution).unwrap();
    let peaks = evaluation.beams[0].as_ref().unwrap().peaks;
    let axial = force / (WIDTH * HEIGHT);
    let bending = 6.0 * moment / (WIDTH * HEIGHT * HEIGHT);
    assert_close(peaks.axial.value, axial);
    assert_close(peaks.bending.value, bending);
    assert_close(peaks.von_mises.value, axial + bending);
    assert_close(peaks.strain.value, (axial + bending) / YOUNG);
    assert_eq!(peaks.von_mises.s, 0.0);
    assert!(peaks.torsion.value.abs() < 1e-6 * bending);
    assert_close(peaks.safety_factor.unwrap(), 1e9 / (axial + bending));
}

#[test]
fn an_inextensible_beam_has_axial_stress_but_no_axial_strain() {
    let (mut model, solution) = strip(100.0, 0.5);
    model.beams[0].theory.extension = false;
    let peaks = evaluate(&model, &solution).unwrap().beams[0].as_ref().unwrap().peaks;
    assert_close(peaks.axial.value, 100.0 / (WIDTH * HEIGHT));
    assert_close(peaks.strain.value, 6.0 * 0.5 / (WIDTH * HEIGHT * HEIGHT) / YOUNG);
}

#[test]
fn an_unloaded_beam_has_no_safety_factor() {
    let (model, solution) = strip(0.0, 0.0);
    let peaks = evaluate(&model, &solution).unwrap().beams[0].as_ref().unwrap().peaks;
    assert_eq!(peaks.safety_factor, None);
}

#[test]
fn outputs_read_beams_bodies_and_the_whole() {
    let (mut model, solution) = strip(100.0, 0.5);
    let middle = ProbeTarget::Beam(BeamId(0), At::Fraction(0.5));
    let body = ProbeTarget::Body(BodyId(0));
    model.outputs = vec![
        output("position", body, Quantity::Position, 3),
        output("rotation", body, Quantity::Rotation, 1),
        output("tangent", middle, Quantity::Tangent, 3),
        output("stretch", ProbeTarget::Beam(BeamId(0), At::Length(0.15)), Quantity::Stretch, 1),
        output("energy", ProbeTarget::Model, Quantity::Energy, 1),
        output("strain", middle, Quantity::Strain, 1),
    ];
    let evaluation = evaluate(&model, &solution).unwrap();
    let values: Vec<OutputValue> = evaluation.outputs.iter().map(|output| output.value).collect();
    assert_eq!(values[0], OutputValue::Vector([0.0, 4.0, 3.0]));
    let OutputValue::Number(rotation) = values[1] else { panic!() };
    assert_close(rotation, 0.3);
    let OutputValue::Vector([_, y, _]) = values[2] else { panic!() };
    assert_close(y, 1.0);
    assert_eq!(values[3], OutputValue::Number(0.5e-3));
    assert_eq!(values[4], OutputValue::Number(7.0));
    let is_strain: Vec<bool> = evaluation.outputs.iter().map(|output| output.is_strain).collect();
    assert_eq!(is_strain, [false, false, false, true, false, true]);
    let summary = summarise(&model, &solution, &evaluation);
    assert_eq!(summary.bodies[0].displacement, 5.0);
}

#[test]
fn outputs_and_summary_read_the_tip_of_concentric_tubes() {
    let (mut model, mut solution) = strip(0.0, 0.0);
    let tube = Tube {
        material: None,
        section: SectionId(0),
        straight: 0.1,
        curved: 0.1,
        curvature: 5.0,
        rotation: 0.0,
        translation: 0.0,
    };
    model.tubes.push(Tubes {
        name: "robot".into(),
        base: Frame { mount: Mount::Ground, pose: Pose::identity() },
        tubes: vec![tube.clone(), tube.clone(), Tube { translation: -0.3, ..tube }],
        force: Vector3::zeros(),
        moment: Vector3::zeros(),
    });
    let sample = |s: f64, torque: f64| TubesSample {
        s,
        pose: Pose::new(exp(&Vector3::new(0.0, 0.0, 2.0 * s)), Vector3::new(4.0 * s, s, 0.0)),
        wrench: Wrench::zero(),
        curvature: Vector3::zeros(),
        angles: vec![(0, 0.0), (1, 0.3)],
        torques: vec![(0, -torque), (1, torque)],
    };
    solution.tubes.push(TubesSolution { samples: vec![sample(0.0, 0.02), sample(0.2, 0.0)] });
    let tip = ProbeTarget::Tubes(TubesId(0));
    assert_eq!(place_name(&model, &tip), "tubes.robot");
    model.outputs = vec![
        output("position", tip, Quantity::Position, 3),
        output("rotation", tip, Quantity::Rotation, 3),
        output("tangent", tip, Quantity::Tangent, 3),
    ];
    let evaluation = evaluate(&model, &solution).unwrap();
    let wanted = [[0.8, 0.2, 0.0], [0.0, 0.0, 0.4], [0.4f64.cos(), 0.4f64.sin(), 0.0]];
    for (output, wanted) in evaluation.outputs.iter().zip(wanted) {
        let OutputValue::Vector(value) = output.value else { panic!() };
        assert!((Vector3::from(value) - Vector3::from(wanted)).norm() < 1e-15, "{}", output.name);
    }
    let summary = summarise(&model, &solution, &evaluation);
    let tubes = &summary.tubes[0];
    assert_eq!((tubes.name.as_str(), tubes.length, tubes.tip), ("robot", 0.2, Vector3::new(0.8, 0.2, 0.0)));
    // The third ends inside the guide.
    assert_eq!(tubes.torques, [-0.02, 0.02, 0.0]);
    assert_eq!(summary.scales.moment, 0.02);

    model.outputs = vec![output("w", tip, Quantity::Displacement, 3)];
    assert!(matches!(evaluate(&model, &solution), Err(PostError::NoSuchQuantity { .. })));
}

#[test]
fn an_output_that_is_no_number_is_an_error_with_its_name() {
    let (mut model, mut solution) = strip(100.0, 0.5);
    model.outputs = vec![output("w", ProbeTarget::Body(BodyId(0)), Quantity::Position, 3)];
    solution.bodies[0].position.z = f64::NAN;
    let error = evaluate(&model, &solution).unwrap_err();
    assert!(matches!(error, PostError::NotFinite { ref output, .. } if output == "w"), "{error}");
}

#[test]
fn stress_of_a_section_given_as_a_stiffness_is_an_error_with_the_beams_name() {
    let (mut model, solution) = strip(100.0, 0.5);
    model.sections[0].shape = Shape::Stiffness {
        ea: 1.0.into(),
        gj: 1.0.into(),
        ei2: 1.0.into(),
        ei3: 1.0.into(),
        ga2: None,
        ga3: None,
        mass_per_length: None,
        rotary_inertia: None,
    };
    assert!(evaluate(&model, &solution).unwrap().beams[0].is_none());
    model.outputs = vec![output("w", ProbeTarget::Beam(BeamId(0), At::Fraction(1.0)), Quantity::Stress, 1)];
    let error = evaluate(&model, &solution).unwrap_err();
    assert!(matches!(error, PostError::NoStress { ref beam, .. } if beam == "strip"), "{error}");
}

#[test]
fn a_place_between_samples_is_not_guessed() {
    let (mut model, solution) = strip(100.0, 0.5);
    model.outputs =
        vec![output("w", ProbeTarget::Beam(BeamId(0), At::Fraction(0.55)), Quantity::Position, 1)];
    assert!(matches!(evaluate(&model, &solution), Err(PostError::NoSample { .. })));
}

#[test]
fn quantities_that_a_target_lacks_are_errors() {
    let (mut model, solution) = strip(100.0, 0.5);
    for (target, quantity) in [
        (ProbeTarget::Body(BodyId(0)), Quantity::Tension),
        (ProbeTarget::Joint(JointId(0)), Quantity::Effort),
        (ProbeTarget::Spring(SpringId(3)), Quantity::Length),
        (ProbeTarget::Model, Quantity::Position),
        (ProbeTarget::Tubes(TubesId(0)), Quantity::Position),
    ] {
        model.outputs = vec![output("w", target, quantity, 1)];
        assert!(matches!(evaluate(&model, &solution), Err(PostError::NoSuchQuantity { .. })));
    }
}
