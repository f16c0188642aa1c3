//! Every study works from a model that is built in code, whose numbers follow parameters.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::expression::{Formula, Function};
use flexura::model::*;
use flexura::modelfile::{Document, to_toml};
use flexura::solution::{PointKind, Status};
use flexura::spatial::{Matrix3, Pose, Vector3};
use flexura::{Axis, Options, Sweep, buckle, inverse_dynamics, solve, solve_model, trace};
use std::f64::consts::{FRAC_PI_2, PI};

/// A cantilever along x under a moment about z and a push against x at its tip; with EI = stiffness it bends into a circle.
fn cantilever() -> Model {
    let mut model = Model::default();
    model.add_parameter("reach", 0.5, "m");
    model.add_parameter("moment", 1.2, "N*m");
    model.add_parameter("stiffness", 2.0, "N*m^2");
    model.add_parameter("push", 0.0, "N");
    let shape = Shape::Stiffness {
        ea: f64::INFINITY.into(),
        gj: 1.0.into(),
        ei2: 3.0.into(),
        ei3: 2.0.into(),
        ga2: None,
        ga3: None,
        mass_per_length: None,
        rotary_inertia: None,
    };
    model.sections.push(Section { name: "rod".into(), shape, plane_strain: false });
    model.beams.push(Beam {
        name: "rod".into(),
        material: None,
        section: SectionId(0),
        curve: Curve::Straight { length: 0.5 },
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
        name: "tip".into(),
        target: LoadTarget::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) }),
        force: Vector3::zeros(),
        moment: Vector3::new(0.0, 0.0, 1.2),
        frame: LoadFrame::Global,
    });
    let tip = ProbeTarget::Beam(BeamId(0), At::Fraction(1.0));
    let output = |name: &str, unit: &str, quantity, component| Output {
        name: name.into(),
        unit: unit.into(),
        formulas: vec![Formula::slot(0)],
        probes: vec![Probe { target: tip, quantity, component }],
    };
    model.outputs = vec![
        output("angle", "rad", Quantity::Rotation, 2),
        output("x", "m", Quantity::Position, 0),
        output("y", "m", Quantity::Position, 1),
    ];
    model.bind("beam.rod.length", "reach").unwrap();
    model.bind("section.rod.EI3", "stiffness").unwrap();
    model.bind("load.tip.moment[2]", "moment").unwrap();
    model.bind("load.tip.force[0]", "-push").unwrap();
    model
}

fn numbers(model: &Model, options: &Options) -> (Vec<f64>, flexura::solution::Solution) {
    let (solution, model) = solve_model(model, options, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let evaluation = flexura::post::evaluate(&model, &solution).unwrap();
    let number = |value| match value {
        flexura::post::OutputValue::Number(number) => number,
        flexura::post::OutputValue::Vector(_) => f64::NAN,
    };
    (evaluation.outputs.iter().map(|output| number(output.value)).collect(), solution)
}

fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within * exact.abs().max(1e-3), "{found} for {exact}");
}

#[test]
fn sensitivities_are_those_of_a_circle() {
    let model = cantilever();
    let options = Options { tolerance: 1e-11, sensitivities: true, ..Options::default() };
    let (values, solution) = numbers(&model, &options);
    let (reach, moment, stiffness) = (0.5, 1.2, 2.0);
    // θ = M L/EI, x = sin θ/κ, y = (1 - cos θ)/κ with κ = M/EI.
    let (k, angle) = (moment / stiffness, reach * moment / stiffness);
    let (sin, cos) = f64::sin_cos(angle);
    for (value, exact) in values.iter().zip([angle, sin / k, (1.0 - cos) / k]) {
        close(*value, exact, 1e-10);
    }
    let found = solution.sensitivities.unwrap();
    let by_k = [reach, (angle * cos - sin) / (k * k), (angle * sin - (1.0 - cos)) / (k * k)];
    let by_reach = [k, cos, sin];
    for (output, (by_k, by_reach)) in found.outputs.iter().zip(by_k.iter().zip(by_reach)) {
        let exact = [by_reach, by_k / stiffness, -by_k * moment / (stiffness * stiffness)];
        for (slope, exact) in output[0].iter().zip(exact) {
            close(slope.unwrap(), exact, 1e-10);
        }
    }
    assert!(found.left_out.is_empty());
}

#[test]
fn a_model_in_code_becomes_a_file() {
    let mut model = cantilever();
    model.unknowns.push(Unknown { parameter: 1, range: Some([0.0, 9.0]) });
    model.targets.push(Target { output: model.outputs[0].clone(), value: FRAC_PI_2 });
    let text = to_toml(&model).unwrap();
    let again = Document::parse(&text, "written.toml").unwrap().model(&[]).unwrap();
    let options = Options { tolerance: 1e-10, ..Options::default() };
    assert_eq!(numbers(&model, &options).0, numbers(&again, &options).0);
    assert_eq!(
        numbers(&model.at(&[(0, 0.4)]).unwrap(), &options).0,
        numbers(&again.at(&[(0, 0.4)]).unwrap(), &options).0
    );
    // A formula whose text names nothing.
    model.outputs[0].formulas[0] = Formula::constant(1.0);
    assert_eq!(to_toml(&model).unwrap_err().path, "output.angle");
}

#[test]
fn an_inverse_problem_finds_its_moment() {
    let mut model = cantilever();
    model.unknowns.push(Unknown { parameter: 1, range: None });
    model.targets.push(Target { output: model.outputs[0].clone(), value: FRAC_PI_2 });
    let (_, solution) = numbers(&model, &Options { tolerance: 1e-10, ..Options::default() });
    // A quarter of a circle.
    close(solution.found[0].1, 2.0 * FRAC_PI_2 / 0.5, 1e-9);
}

#[test]
fn a_sweep_is_its_samples() {
    let model = cantilever();
    let axes = ["reach=0.3:0.6:4", "moment=1,2"].map(|text| Axis::parse(&model, text).unwrap());
    let samples =
        Sweep::new(&model, axes.to_vec(), &Options::default()).unwrap().run(Some(2), &|_, _| {}).unwrap();
    assert_eq!(samples.len(), 8);
    for sample in &samples {
        let one = model.at(&[(0, sample.values[0]), (1, sample.values[1])]).unwrap();
        let solution = solve(&one, &Options { samples: 2, ..Options::default() }, &mut |_| {}).unwrap();
        assert_eq!(sample.energy, Some(solution.energy));
        // M² L/2 EI.
        close(solution.energy, sample.values[1].powi(2) * sample.values[0] / 4.0, 1e-7);
    }
    let twice = ["reach=1,2", "reach=1,2"].map(|text| Axis::parse(&model, text).unwrap());
    assert_eq!(
        Sweep::new(&model, twice.to_vec(), &Options::default()).err().unwrap(),
        "`reach` is varied twice"
    );
}

#[test]
fn a_trace_and_linear_buckling_find_the_load_of_euler() {
    let mut model = cantilever();
    model.set(&[(1, 0.0)]).unwrap();
    let euler = PI * PI * 2.0 / (4.0 * 0.25);
    let options = Options { tolerance: 1e-9, ..Options::default() };
    let study = TraceStudy { parameter: 3, range: [0.0, 1.3 * euler], ..TraceStudy::default() };
    let path = trace(&model, &study, &options, &mut |_| {}).unwrap();
    assert_eq!(path.status, Status::Converged, "{:?}", path.reason);
    let points = &path.branches[0].points;
    let branch: Vec<f64> = points
        .iter()
        .filter(|point| !matches!(point.kind, PointKind::Regular | PointKind::End))
        .map(|point| point.parameter)
        .collect();
    close(branch[0], euler, 1e-8);
    let linear = buckle(&model, &BuckleStudy { parameter: Some(3), at: 0.0, count: 1 }, &options).unwrap();
    close(linear.modes[0].value, euler, 1e-6);
    // Along the length, which no load is: the same load becomes critical where the rod is long enough.
    let loaded = model.at(&[(3, 0.5 * euler)]).unwrap();
    let study = TraceStudy { parameter: 0, range: [0.5, 0.8], start: 0.5, ..TraceStudy::default() };
    let longer = trace(&loaded, &study, &options, &mut |_| {}).unwrap();
    let critical = longer.branches[0]
        .points
        .iter()
        .find(|point| point.kind != PointKind::Regular && point.kind != PointKind::End);
    close(critical.unwrap().parameter, 0.5 * 2.0_f64.sqrt(), 1e-8);
}

#[test]
fn a_pendulum_in_code_is_driven_through_a_turn() {
    let mut model = Model { gravity: Vector3::new(0.0, -9.81, 0.0), ..Model::default() };
    model.add_parameter("angle", 0.0, "rad");
    model.add_parameter("mass", 2.0, "kg");
    model.bodies.push(Body {
        name: "bob".into(),
        pose: Pose::identity(),
        mass: 2.0,
        center_of_mass: Vector3::new(0.0, -0.3, 0.0),
        inertia: Matrix3::zeros(),
    });
    let mut law = JointLaw::free(JointKind::Revolute, Vector3::z());
    law.coordinates[0].drive = Drive::Driven { coordinate: 0.0 };
    model.joints.push(Joint {
        name: "pivot".into(),
        parent: Frame { mount: Mount::Ground, pose: Pose::identity() },
        child: Mount::Body(BodyId(0)),
        child_pose: None,
        law,
    });
    model.outputs.push(Output {
        name: "torque".into(),
        unit: "N*m".into(),
        formulas: vec![Formula::slot(0)],
        probes: vec![Probe {
            target: ProbeTarget::Joint(JointId(0)),
            quantity: Quantity::Effort,
            component: 0,
        }],
    });
    model.bind("joint.pivot.coordinate", "angle").unwrap();
    model.bind("body.bob.mass", "mass").unwrap();
    let study = InverseDynamicsStudy {
        parameter: 0,
        law: MotionLaw::Function { value: Function::parse("0.5*t^2", "t").unwrap(), duration: 1.5 },
        sampling: Sampling::Count(7),
    };
    let motion = inverse_dynamics(&model, &study, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(motion.status, Status::Converged, "{:?}", motion.reason);
    for instant in &motion.instants {
        let angle = 0.5 * instant.time * instant.time;
        // m l² a + m g l sin q.
        let exact = 2.0 * 0.3 * 0.3 + 2.0 * 9.81 * 0.3 * angle.sin();
        close(instant.outputs[0].as_ref().unwrap()[0], exact, 1e-9);
    }
}

#[test]
fn a_broken_value_is_refused_with_its_place() {
    let mut model = cantilever();
    model.bind("beam.rod.length", "reach - 0.4 m").unwrap();
    let study = TraceStudy { parameter: 0, range: [0.3, 0.6], start: 0.3, ..TraceStudy::default() };
    let error = trace(&model, &study, &Options::default(), &mut |_| {}).unwrap_err();
    assert_eq!(error.path, "parameter.reach");
    assert!(
        error.message.starts_with("other values make no sound model: must be positive, is -0.1"),
        "{}",
        error.message
    );
    let error = solve(&model.at(&[(0, 0.2)]).unwrap(), &Options::default(), &mut |_| {}).unwrap_err();
    assert_eq!(
        (error.path.as_str(), error.message.as_str()),
        ("beam.rod.length", "must be positive, is -0.2")
    );
    model.parameters[0].is_structural = true;
    let error = trace(&model, &study, &Options::default(), &mut |_| {}).unwrap_err();
    assert!(error.message.starts_with("decides of which parts the mechanism is made"), "{}", error.message);
}
