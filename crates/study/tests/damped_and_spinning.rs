//! Modes of what damps and spins, and where flutter sets in, of models made in code.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura_model::{
    At, Beam, BeamId, BeamPoint, BeamTheory, Body, Cable, CableLaw, CoordinateLaw, Curve, End, Frame, Guide,
    Joint, JointKind, JointLaw, Load, LoadFrame, LoadTarget, Model, ModesPath, ModesStudy, Mount, Parameter,
    PointMass, Profile, Section, SectionFrame, SectionId, Shape, Spin,
};
use flexura_solution::{Modes, ModesAlong, Onset, OnsetKind, Status};
use flexura_spatial::{Matrix3, Pose, Vector3};
use flexura_study::{Options, modes, modes_along, solve};

type V = Vector3<f64>;

/// EI3 = ρA = L = 1, clamped at the origin along x, without rotary inertia.
fn rod(ei: [f64; 2], gj: f64) -> Model {
    let mut model = Model::default();
    let p = Profile::from;
    let shape = Shape::Stiffness {
        ea: p(1e4),
        gj: p(gj),
        ei2: p(ei[0]),
        ei3: p(ei[1]),
        ga2: None,
        ga3: None,
        mass_per_length: Some(p(1.0)),
        rotary_inertia: None,
    };
    model.sections.push(Section { name: "section".into(), shape, plane_strain: false });
    model.beams.push(Beam {
        name: "rod".into(),
        material: None,
        section: SectionId(0),
        curve: Curve::Straight { length: 1.0 },
        frame: SectionFrame::Natural,
        theory: BeamTheory { shear: false, extension: false },
        damping: 0.0,
        added_mass: 0.0,
        start: Some(End { mount: Mount::Ground, placement: Some(Pose::identity()), hold: JointLaw::weld() }),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model
}

/// A load on the tip, `p` times (force, moment), in its own axes or in those of the ground.
fn loaded(mut model: Model, force: V, moment: V, frame: LoadFrame) -> Model {
    model.parameters.push(Parameter { name: "p".into(), value: 1.0, ..Parameter::default() });
    let point = BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) };
    model.loads.push(Load { name: "tip".into(), target: LoadTarget::Beam(point), force, moment, frame });
    for (key, vector) in [("force", force), ("moment", moment)] {
        for (i, value) in vector.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            model.bind(&format!("load.tip.{key}[{i}]"), &format!("{value}*p")).unwrap();
        }
    }
    model
}

fn found(model: &Model, count: usize) -> Modes {
    let study = ModesStudy { count, ..ModesStudy::default() };
    let found = modes(model, &study, &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(found.solution.status, Status::Converged);
    found
}

fn followed(model: &Model, range: [f64; 2], count: usize) -> ModesAlong {
    let path = ModesPath { parameter: 0, range, steps: 20 };
    let study = ModesStudy { count, path: Some(path), ..ModesStudy::default() };
    modes_along(model, &study, path, &Options::default(), &mut |_| {}).unwrap()
}

fn first(model: &Model, range: [f64; 2], count: usize) -> Onset {
    let along = followed(model, range, count);
    assert_eq!(along.trace.status, Status::Converged);
    along.onsets[0][0]
}

#[track_caller]
fn close(value: f64, wanted: f64, relative: f64) {
    assert!((value - wanted).abs() <= relative * wanted.abs(), "{value} against {wanted}");
}

#[test]
fn a_cantilever_with_damping_in_its_material_decays() {
    let mut model = rod([1e4, 1.0], 1e4);
    model.beams[0].damping = 0.01;
    let modes = found(&model, 2).modes;
    // (1 + γ s) ω² + s² = 0
    for (mode, [decay, rate]) in
        modes.iter().zip([[-0.061811816842, 3.5154718983], [-2.4275940926, 21.900356286]])
    {
        close(mode.growth, decay, 1e-9);
        close(mode.rate, rate, 1e-9);
    }
}

#[test]
fn flutter_is_found_where_two_frequencies_meet_or_damping_fails() {
    let push = |damping: f64| {
        let mut model = rod([1e4, 1.0], 1e4);
        model.beams[0].damping = damping;
        loaded(model, -V::x(), V::zeros(), LoadFrame::Local)
    };
    // M. Beck, ZAMP 3 (1952) 225; V. V. Bolotin and N. I. Zhinzher, Int. J. Solids Struct. 5 (1969) 965.
    for (damping, range, load, rate) in [
        (0.0, [5.0, 25.0], 20.050953619, 11.015557641),
        (0.01, [5.0, 15.0], 10.966111659, 5.3997091071),
        (1e-6, [5.0, 15.0], 10.938849346, 5.3986138277),
    ] {
        let onset = first(&push(damping), range, 2);
        assert_eq!((onset.kind, onset.begins), (OnsetKind::Flutter, true));
        close(onset.parameter, load, 1e-9);
        close(onset.rate, rate, 1e-9);
        assert!(onset.error_estimate < 1e-7, "{onset:?}");
    }
    let torque = loaded(rod([2.0, 1.0], 0.8), V::zeros(), V::x(), LoadFrame::Local);
    let onset = first(&torque, [0.8, 2.2], 2);
    close(onset.parameter, 1.6381405433, 2e-9);
    close(onset.rate, 4.1943608366, 2e-9);
}

#[test]
fn divergence_is_told_from_flutter() {
    let onset = first(&loaded(rod([1e4, 1.0], 1e4), -V::x(), V::zeros(), LoadFrame::Global), [1.0, 4.0], 2);
    assert_eq!((onset.kind, onset.begins), (OnsetKind::Divergence, true));
    // Euler.
    close(onset.parameter, 0.25 * std::f64::consts::PI.powi(2), 1e-9);
}

#[test]
fn small_dampers_take_stability_away_from_zieglers_pendulum() {
    let pendulum = |damping: f64| {
        let mut model = Model::default();
        model.parameters.push(Parameter { name: "p".into(), value: 1.0, ..Parameter::default() });
        for (name, x, mass) in [("first", 0.0, 2.0), ("second", 1.0, 1.0)] {
            model.bodies.push(Body {
                name: name.into(),
                pose: Pose::new(flexura_spatial::UnitQuaternion::identity(), V::new(x, 0.0, 0.0)),
                mass,
                center_of_mass: V::x(),
                inertia: Matrix3::zeros(),
            });
        }
        let law = || {
            let mut law = JointLaw::free(JointKind::Revolute, V::z());
            law.coordinates = vec![CoordinateLaw { stiffness: 1.0, damping, ..CoordinateLaw::default() }];
            law
        };
        let at = |mount, x: f64| Frame {
            mount,
            pose: Pose::new(flexura_spatial::UnitQuaternion::identity(), V::new(x, 0.0, 0.0)),
        };
        for (name, parent, child) in
            [("foot", at(Mount::Ground, 0.0), 0), ("knee", at(Mount::Body(flexura_model::BodyId(0)), 1.0), 1)]
        {
            let child = Mount::Body(flexura_model::BodyId(child));
            model.joints.push(Joint { name: name.into(), parent, child, child_pose: None, law: law() });
        }
        let target = LoadTarget::Body { body: flexura_model::BodyId(1), point: V::x() };
        let (force, moment) = (-V::x(), V::zeros());
        model.loads.push(Load { name: "tip".into(), target, force, moment, frame: LoadFrame::Local });
        model.bind("load.tip.force[0]", "-p").unwrap();
        model
    };
    // H. Ziegler, Ing.-Arch. 20 (1952) 49: 7/2 - √2, and by Hurwitz' criterion 41/28 + c²/2.
    close(first(&pendulum(0.0), [1.0, 2.5], 2).parameter, 3.5 - 2.0_f64.sqrt(), 1e-9);
    let c: f64 = 1e-3;
    close(first(&pendulum(c), [1.0, 2.5], 2).parameter, 41.0 / 28.0 + 0.5 * c * c, 1e-9);
}

#[test]
fn the_motion_decides_where_there_is_a_mass_and_no_energy() {
    let mut push = loaded(rod([1e4, 1.0], 1e4), -V::x(), V::zeros(), LoadFrame::Local);
    for (load, stable) in [(19.9, true), (20.2, false)] {
        let model = push.at(&[(0, load)]).unwrap();
        let solution = solve(&model, &Options::default(), &mut |_| {}).unwrap();
        assert_eq!(solution.stable, Some(stable), "at {load}: {:?}", solution.stability_reason);
        assert!(solution.warnings.iter().any(|warning| warning.contains("decided by the lowest modes")));
    }
    if let Shape::Stiffness { mass_per_length, .. } = &mut push.sections[0].shape {
        *mass_per_length = None;
    }
    let solution = solve(&push, &Options::default(), &mut |_| {}).unwrap();
    assert!(solution.stable.is_none() && solution.stability_reason.is_some());
}

#[test]
fn a_rotating_cantilever_flaps_faster() {
    // A. D. Wright and others, J. Appl. Mech. 49 (1982) 197.
    for (rate, wanted) in
        [(1.0, [3.681646814, 22.181011151, 61.841762587]), (12.0, [13.170150488, 37.603112331, 79.614478489])]
    {
        let mut model = rod([1.0, 1e4], 1e4);
        model.spin = Some(Spin { axis: V::z(), rate, through: V::zeros() });
        for (mode, wanted) in found(&model, 3).modes.iter().zip(wanted) {
            close(mode.rate, wanted, 1e-9);
            assert_eq!(mode.growth, 0.0);
        }
    }
}

#[test]
fn a_spinning_arm_stretches() {
    let mut model = rod([1.0, 1.0], 1.0);
    model.beams[0].theory.extension = true;
    model.spin = Some(Spin { axis: V::z(), rate: 20.0, through: V::zeros() });
    let end = |model: &Model| {
        let solution = solve(model, &Options::default(), &mut |_| {}).unwrap();
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        solution.beams[0].samples.last().unwrap().pose.position.x
    };
    // EA u'' + ρA Ω² (x + u) = 0
    let k = 20.0 * 1e-2_f64;
    close(end(&model), k.tan() / k, 1e-11);
    // EA u/L = m Ω² (L + u)
    if let Shape::Stiffness { mass_per_length, .. } = &mut model.sections[0].shape {
        *mass_per_length = None;
    }
    let point = BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) };
    model.masses.push(PointMass { name: "tip".into(), point, mass: 3.0, inertia: Matrix3::zeros() });
    close(end(&model), 1e4 / (1e4 - 1200.0), 1e-11);
}

/// A body of mass 2 with J = diag(0.3, 0.2, 0.1), its centre 1 away from a hinge along y, stands out at an angle from a frame that turns
/// at 3 about z, under gravity along z.
#[test]
fn a_body_on_a_hinge_stands_and_swings_as_its_energy_says() {
    let (g, rate, mass, angle) = (9.81, 3.0_f64, 2.0, 0.6_f64);
    let [a, b, c] = [0.3, 0.2, 0.1];
    let (sin, cos) = angle.sin_cos();
    let square = rate * rate;
    let away = (mass * g * sin - square * (a - c) * sin * cos) / (mass * square * cos) - sin;
    let bent = mass * (g * cos - square * cos * cos + square * (away + sin) * sin)
        - square * (a - c) * (cos * cos - sin * sin);
    let place = Pose::new(flexura_spatial::UnitQuaternion::identity(), V::new(away, 0.0, 0.0));
    let mut model = Model { gravity: V::z() * g, ..Model::default() };
    model.spin = Some(Spin { axis: V::z(), rate, through: V::zeros() });
    model.bodies.push(Body {
        name: "bob".into(),
        pose: place,
        mass,
        center_of_mass: V::z(),
        inertia: Matrix3::from_diagonal(&V::new(a, b, c)),
    });
    model.joints.push(Joint {
        name: "hinge".into(),
        parent: Frame { mount: Mount::Ground, pose: place },
        child: Mount::Body(flexura_model::BodyId(0)),
        child_pose: None,
        law: JointLaw::free(JointKind::Revolute, V::y()),
    });
    let found = found(&model, 1);
    close(found.solution.joints[0].coordinates[0], angle, 1e-9);
    close(found.modes[0].rate, (bent / (mass + b)).sqrt(), 1e-9);
}

/// The length of a tendon beside an axis that does not stretch is L + d θ(L): one of given tension changes nothing where another on the
/// other side balances it, and one of given length keeps the tip from turning.
#[test]
fn tendons_in_channels_hold_the_tip_or_do_nothing() {
    let tendon = |name: &str, law, offset: f64| Cable {
        name: name.into(),
        route: vec![Guide::Channel {
            beam: BeamId(0),
            between: [At::Fraction(0.0), At::Fraction(1.0)],
            offset: [Profile::from(offset), Profile::from(0.0)],
        }],
        law,
    };
    let with = |cables: Vec<Cable>| {
        let mut model = rod([1e4, 1.0], 1e4);
        model.cables = cables;
        found(&model, 3)
    };
    let free = [3.5160152685, 22.034491565, 61.697214414];
    let guided = [5.593321362, 30.225847932, 74.638883825];
    let sides =
        vec![tendon("up", CableLaw::Tension(5.0), 0.05), tendon("down", CableLaw::Tension(5.0), -0.05)];
    for (cables, wanted) in [
        (vec![tendon("axis", CableLaw::Tension(5.0), 0.0)], free),
        (sides, free),
        (vec![tendon("side", CableLaw::Length(1.0), 0.05)], guided),
    ] {
        for (mode, wanted) in with(cables).modes.iter().zip(wanted) {
            close(mode.rate, wanted, 1e-9);
        }
    }
}
