//! A made-up trace that has everything a trace can have: a strip between a clamp and a slider that bows out.

#![allow(dead_code, clippy::unwrap_used)]

use flexura_expression::{Binding, Expression, Kind};
use flexura_model::*;
use flexura_solution::*;
use flexura_spatial::{Matrix3, Pose, Twist, Vector3, Wrench, exp};
use std::f64::consts::PI;

pub const LENGTH: f64 = 0.1524;
pub const CRITICAL: f64 = 9.757;
const SAMPLES: usize = 21;

pub fn output(name: &str, unit: &str, components: &[usize]) -> Output {
    let probe = |component| Probe {
        target: ProbeTarget::Beam(BeamId(0), At::Fraction(0.5)),
        quantity: Quantity::Position,
        component,
    };
    let formula = |slot: usize| {
        let whole = Expression::parse("q").unwrap();
        whole.lower(&mut |_| Ok(Binding::Slot(slot, Kind::Plain))).unwrap().formula()
    };
    Output {
        name: name.into(),
        unit: unit.into(),
        formulas: (0..components.len()).map(formula).collect(),
        probes: components.iter().map(|component| probe(*component)).collect(),
    }
}

pub fn model() -> Model {
    let end = |mount| Some(End { mount, placement: None, hold: JointLaw::weld() });
    Model {
        name: "clamped strip".into(),
        parameters: vec![
            Parameter { name: "push".into(), value: 2.0, unit: "N".into(), ..Parameter::default() },
            Parameter { name: "slope".into(), value: 1.0, unit: "rad".into(), ..Parameter::default() },
        ],
        materials: vec![Material {
            name: "steel".into(),
            young: 207e9,
            shear: 79.3e9,
            density: None,
            yield_strength: None,
        }],
        sections: vec![Section {
            name: "strip".into(),
            shape: Shape::Rectangle { width: 0.02032.into(), height: 0.254e-3.into() },
            plane_strain: false,
        }],
        beams: vec![Beam {
            name: "link".into(),
            material: Some(MaterialId(0)),
            section: SectionId(0),
            curve: Curve::Straight { length: LENGTH },
            frame: SectionFrame::Natural,
            theory: BeamTheory::default(),
            damping: 0.0,
            added_mass: 0.0,
            start: end(Mount::Ground),
            end: end(Mount::Body(BodyId(0))),
            distributed: Vec::new(),
            foundation: Vec::new(),
        }],
        bodies: vec![Body {
            name: "slider".into(),
            pose: Pose::translation(Vector3::new(LENGTH, 0.0, 0.0)),
            mass: 0.0,
            center_of_mass: Vector3::zeros(),
            inertia: Matrix3::zeros(),
        }],
        joints: vec![Joint {
            name: "way".into(),
            parent: Frame { mount: Mount::Ground, pose: Pose::translation(Vector3::new(LENGTH, 0.0, 0.0)) },
            child: Mount::Body(BodyId(0)),
            child_pose: None,
            law: JointLaw::free(JointKind::Prismatic, Vector3::x()),
        }],
        outputs: vec![
            output("w", "m", &[2]),
            output("slide", "m", &[0]),
            output("middle", "m", &[0, 1, 2]),
            output("ratio, odd", "", &[2]),
        ],
        ..Model::default()
    }
}

/// Place and angle of the bowed strip at s: a bow of two half waves whose height in the middle is `w`.
fn bow(w: f64, s: f64) -> (Vector3<f64>, f64) {
    let angle = |s: f64| -(PI * w / LENGTH) * (2.0 * PI * s / LENGTH).sin();
    let (steps, mut place) = (200, Vector3::zeros());
    for i in 0..steps {
        let turn = angle(s * (f64::from(i) + 0.5) / f64::from(steps));
        place += Vector3::new(turn.cos(), 0.0, -turn.sin()) * (s / f64::from(steps));
    }
    (place, angle(s))
}

pub fn state(w: f64) -> Solution {
    let sample = |i: usize| {
        let s = LENGTH * i as f64 / (SAMPLES - 1) as f64;
        let (place, turn) = bow(w, s);
        BeamSample {
            s,
            pose: Pose::new(exp(&Vector3::new(0.0, turn, 0.0)), place),
            rest_pose: Pose::translation(Vector3::new(s, 0.0, 0.0)),
            wrench: Wrench::new(Vector3::new(-5.0, 0.0, 0.0), Vector3::new(0.0, 0.1, 0.0)),
            curvature: Vector3::zeros(),
            rest_curvature: Vector3::zeros(),
            strain: Vector3::zeros(),
            foundation: Vector3::zeros(),
        }
    };
    let samples: Vec<BeamSample> = (0..SAMPLES).map(sample).collect();
    let end = samples[SAMPLES - 1].pose;
    Solution {
        status: Status::Converged,
        reason: None,
        load_fraction: 1.0,
        residual: 1e-13,
        error_estimate: 1e-10,
        warnings: Vec::new(),
        work: Work::default(),
        beams: vec![BeamSolution { samples, length: LENGTH, ..BeamSolution::default() }],
        bodies: vec![end],
        joints: vec![JointSolution {
            coordinates: vec![end.position.x - LENGTH],
            efforts: vec![0.0],
            wrench: Wrench::zero(),
            contact: None,
        }],
        springs: Vec::new(),
        couplings: Vec::new(),
        cables: Vec::new(),
        tubes: Vec::new(),
        tangents: Vec::new(),
        sensitivities: None,
        found: Vec::new(),
        energy: w * w,
        stable: Some(true),
        unstable_directions: Some(0),
        stability_reason: None,
        rates: None,
    }
}

/// The strip bows by one metre in its middle.
pub fn direction() -> Direction {
    let twist = |i: usize| {
        let phase = 2.0 * PI * i as f64 / (SAMPLES - 1) as f64;
        Twist {
            linear: Vector3::new(0.0, 0.0, 0.5 * (1.0 - phase.cos())),
            angular: Vector3::new(0.0, -(PI / LENGTH) * phase.sin(), 0.0),
        }
    };
    let still = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
    Direction { beams: vec![(0..SAMPLES).map(twist).collect()], bodies: vec![still] }
}

/// Why an output has no value where the strip is straight.
pub const NO_VALUE: &str = "output `ratio` is NaN, not a finite number";

pub fn point(parameter: f64, w: f64, arc: f64, kind: PointKind, unstable: Option<usize>) -> TracePoint {
    let solution = state(w);
    let middle = solution.beams[0].samples[SAMPLES / 2].pose.position;
    let is_kept = kind != PointKind::Regular;
    let is_critical = kind.is_critical();
    TracePoint {
        parameter,
        arc,
        outputs: vec![
            Some(vec![middle.z]),
            Some(vec![solution.joints[0].coordinates[0]]),
            Some(vec![middle.x, 0.0, middle.z]),
            (w != 0.0).then(|| vec![middle.z / LENGTH]),
        ],
        output_reasons: if w == 0.0 { vec![(3, NO_VALUE.into())] } else { Vec::new() },
        error_estimate: 3e-10,
        stable: unstable.map(|count| count == 0),
        unstable_directions: unstable,
        solution: is_kept.then(|| Box::new(solution)),
        shape: None,
        directions: if is_critical { vec![direction()] } else { Vec::new() },
        kind,
    }
}

/// The straight strip, which loses its stability at the first critical load.
fn straight() -> Branch {
    let mut points: Vec<TracePoint> = (0..=8)
        .map(|i| {
            let push = 5.0 * f64::from(i);
            let kind = if i == 0 || i == 8 { PointKind::End } else { PointKind::Regular };
            let unstable = if push < CRITICAL {
                0
            } else if push < 2.05 * CRITICAL {
                1
            } else {
                2
            };
            point(push, 0.0, push / 40.0, kind, Some(unstable))
        })
        .collect();
    let crossing = PointKind::Branch(Crossing::SupercriticalPitchfork);
    points.insert(2, point(CRITICAL, 0.0, CRITICAL / 40.0, crossing, None));
    let double = 2.05 * CRITICAL;
    points.insert(6, point(double, 0.0, double / 40.0, PointKind::Branch(Crossing::Multiple(2)), None));
    Branch { origin: BranchOrigin::Rest, points, ends: [BranchEnd::Start, BranchEnd::Range] }
}

/// The strip bowed out to one side: it holds more and more, turns back (as no strip does), and is lost.
fn bowed() -> Branch {
    let push = |w: f64| CRITICAL * (1.0 + 18.0 * w * w / (LENGTH * LENGTH) - 60.0 * (w / LENGTH).powi(4));
    // The push is largest at w/L = sqrt(0.15).
    let fold = LENGTH * 0.15f64.sqrt();
    let mut points = Vec::new();
    for i in 0..=12 {
        let w = LENGTH * 0.5 * f64::from(i) / 12.0;
        let kind = if i == 0 || i == 12 { PointKind::End } else { PointKind::Regular };
        points.push(point(push(w), w, w / LENGTH, kind, Some(usize::from(w > fold))));
    }
    points.insert(10, point(push(fold), fold, fold / LENGTH, PointKind::Fold, None));
    let w = 0.03;
    points.insert(5, point(push(w), w, w / LENGTH, PointKind::Event(0), Some(0)));
    points[0].stable = None;
    points[0].unstable_directions = None;
    points[0].kind = PointKind::Branch(Crossing::SupercriticalPitchfork);
    let reason = "the strip touches itself <here> & \"there\"".to_owned();
    Branch {
        origin: BranchOrigin::Switched { branch: 0, point: 2 },
        points,
        ends: [BranchEnd::Start, BranchEnd::Stalled(reason)],
    }
}

/// A branch to the other side, of which stability is not decided.
fn apart() -> Branch {
    let points = (0..=6).map(|i| {
        let w = -0.02 - 0.006 * f64::from(i);
        let kind = if i == 0 || i == 6 { PointKind::End } else { PointKind::Regular };
        point(12.0 + 3.0 * f64::from(i), w, f64::from(i), kind, None)
    });
    Branch {
        origin: BranchOrigin::Search,
        points: points.collect(),
        ends: [BranchEnd::Stop, BranchEnd::Range],
    }
}

pub fn study() -> TraceStudy {
    let event =
        Target { output: Output { name: "output.w = 30 mm".into(), ..output("", "m", &[2]) }, value: 0.03 };
    TraceStudy { range: [0.0, 40.0], events: vec![event], ..TraceStudy::default() }
}

pub fn trace() -> Trace {
    let critical = CriticalCurve {
        parameter: 1,
        kind: PointKind::Fold,
        points: (0..4)
            .map(|i| {
                let kind = if i == 0 { PointKind::Fold } else { PointKind::Regular };
                (0.5 + 0.25 * f64::from(i), point(18.0 - f64::from(i), 0.05, f64::from(i), kind, None))
            })
            .collect(),
        ends: [BranchEnd::Range, BranchEnd::PointLimit],
    };
    let branches = vec![straight(), bowed(), apart()];
    let points = branches.iter().map(|branch| branch.points.len()).sum();
    Trace {
        parameter: 0,
        range: [0.0, 40.0],
        status: Status::Stalled,
        reason: Some("branch 2 cannot be followed further".into()),
        warnings: vec!["the strip is thin".into()],
        stability_reason: None,
        branches,
        critical: Some(critical),
        work: TraceWork {
            points,
            refused: 1,
            newton_steps: 90,
            factorisations: 80,
            residuals: 7,
            inertias: 40,
        },
    }
}

pub fn buckling() -> Buckling {
    let turning = |i: usize| Twist {
        linear: Vector3::zeros(),
        angular: Vector3::new((PI * i as f64 / (SAMPLES - 1) as f64).sin(), 0.0, 0.0),
    };
    let turning = Direction {
        beams: vec![(0..SAMPLES).map(turning).collect()],
        bodies: vec![Twist { angular: Vector3::zeros(), linear: Vector3::zeros() }],
    };
    let mode = |value: f64, direction| BucklingMode { value, error_estimate: 1e-9 * value, direction };
    Buckling {
        parameter: Some(0),
        at: 0.0,
        solution: state(0.0),
        modes: vec![mode(CRITICAL, direction()), mode(2.05 * CRITICAL, turning)],
    }
}
