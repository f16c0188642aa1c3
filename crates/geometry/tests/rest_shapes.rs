//! The rest shapes of the seed's examples, and every curve against an independent integration.

mod support;

use flexura_expression::Function;
use flexura_geometry::{RestShape, ShapeError};
use flexura_model::{At, Curve, Profile, SectionFrame};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use support::{integrate, minimising, mismatch, parametric, shape};

fn ellipse() -> Curve {
    parametric(["10*sin(t)", "5 - 5*cos(t)", "0"], [0.0, TAU])
}

fn example_2_3_3() -> Curve {
    parametric(["25*sin(t)", "10 - 10*cos(2*t)", "20 - 20*cos(3*t)"], [0.0, FRAC_PI_2])
}

fn wiggle() -> Curve {
    parametric(["t", "sin(t)", "0.2*t*t - 0.05*t*t*t"], [-1.0, 4.0])
}

fn assert_consistent(shape: &RestShape, what: &str) {
    let (distance, angle) = mismatch(shape, 3000);
    assert!(distance < 2e-13, "{what}: position off by {distance:e} L");
    assert!(angle < 4e-13, "{what}: orientation off by {angle:e} rad");
}

/// Complete elliptic integral of the second kind by the arithmetic-geometric mean (Abramowitz and Stegun
/// 17.6), parameter m.
fn complete_e(m: f64) -> f64 {
    let (mut a, mut b, mut sum, mut power) = (1.0f64, (1.0 - m).sqrt(), 0.5 * m, 0.5);
    while (a - b).abs() > 1e-16 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        power *= 2.0;
        sum += power * c * c;
    }
    PI / (2.0 * a) * (1.0 - sum)
}

#[test]
fn the_ellipse_of_example_2_3_1_has_its_length_and_closes() {
    let shape = shape(&ellipse(), SectionFrame::Natural);
    assert!((shape.length() - 48.4422).abs() < 5e-5);
    let exact = 40.0 * complete_e(0.75);
    assert!((shape.length() - exact).abs() < 1e-14 * exact, "{} against {exact}", shape.length());
    assert!(shape.pose(shape.length()).position.norm() < 1e-13);
    // Planar: bends in the plane of e1 and e2 only; the vertex at t = π/2 has radius b²/a = 2.5.
    let k = shape.curvature(0.25 * exact);
    assert!((k.z - 0.4).abs() < 1e-13 && k.x.abs() < 1e-15 && k.y.abs() < 1e-15, "{k}");
    assert_consistent(&shape, "ellipse");
}

#[test]
fn the_helix_of_example_2_3_2_has_its_curvature_and_torsion() {
    let pitch = TAU * 5.715;
    let curve = Curve::Helix { radius: 7.239, pitch, turns: 10.0 };
    let helix = shape(&curve, SectionFrame::Natural);
    let k = helix.uniform().expect("a helix is uniform");
    assert!((k.z - 0.0851).abs() < 5e-5 && (k.x - 0.0672).abs() < 5e-5 && k.y == 0.0, "{k}");
    assert_consistent(&helix, "helix");
    // The axis runs along (τ e1 + κ e3)/√(κ²+τ²) at distance r towards e2; ten turns rise ten pitches.
    let axis = Vector3::new(k.x, 0.0, k.z) / k.x.hypot(k.z);
    let end = helix.pose(helix.length());
    assert!((end.position - axis * (10.0 * pitch)).norm() < 1e-12 * helix.length());
    for i in 0..50 {
        let p = helix.pose(helix.length() * f64::from(i) / 50.0).position - Vector3::y() * 7.239;
        assert!(((p - axis * p.dot(&axis)).norm() - 7.239).abs() < 1e-12);
    }
    // The same helix as a parametric curve.
    let same = parametric(["7.239*cos(t)", "7.239*sin(t)", "5.715*t"], [0.0, 20.0 * PI]);
    let same = shape(&same, SectionFrame::Frenet { offset: 0.0 });
    assert!((same.length() - helix.length()).abs() < 1e-14 * helix.length());
    for s in [0.0, 3.0, 77.7, helix.length()] {
        assert!((same.curvature(s) - k).norm() < 1e-15);
        assert!((same.pose(s).position - helix.pose(s).position).norm() < 1e-12);
    }
}

#[test]
fn a_negative_pitch_is_a_left_handed_helix() {
    let left = shape(&Curve::Helix { radius: 2.0, pitch: -3.0, turns: 1.5 }, SectionFrame::Natural);
    assert!(left.uniform().expect("uniform").x < 0.0);
    assert_consistent(&left, "left-handed helix");
    let ring = shape(&Curve::Helix { radius: 2.0, pitch: 0.0, turns: 1.0 }, SectionFrame::Natural);
    assert!(ring.pose(ring.length()).position.norm() < 1e-14);
}

#[test]
fn the_curve_of_example_2_3_3_has_its_length_and_first_normal() {
    let curve = example_2_3_3();
    let frenet = shape(&curve, SectionFrame::Frenet { offset: 0.0 });
    assert!((frenet.length() - 71.978).abs() < 5e-4, "{}", frenet.length());
    // Seen from the curve's own axes e_N = (0, .2169, .9762): with e2 towards y, φ0 is its angle.
    let offset = 0.9762f64.atan2(0.2169);
    let seen = shape(&curve, SectionFrame::Direction { along: Vector3::y() });
    let k = seen.curvature(0.0);
    let normal = Vector3::new(0.0, k.z, -k.y) / k.z.hypot(k.y);
    assert!((normal - Vector3::new(0.0, 0.2169, 0.9762)).norm() < 1e-4, "{normal}");
    assert!(((-k.y).atan2(k.z) - offset).abs() < 1e-4);
    // κ at the start: |ẍ| / |ẋ|² = √(40² + 180²)/25².
    assert!((frenet.curvature(0.0).z - 40f64.hypot(180.0) / 625.0).abs() < 1e-15);
    for frame in [
        SectionFrame::Frenet { offset: 0.0 },
        SectionFrame::Frenet { offset: 0.7 },
        SectionFrame::Natural,
        SectionFrame::Direction { along: Vector3::new(0.3, 1.0, -0.2) },
    ] {
        assert_consistent(&shape(&curve, frame.clone()), &format!("{frame:?}"));
    }
}

#[test]
fn frenet_offsets_turn_the_curvatures() {
    let curve = example_2_3_3();
    let plain = shape(&curve, SectionFrame::Frenet { offset: 0.0 });
    let turned = shape(&curve, SectionFrame::Frenet { offset: 0.4 });
    for s in [0.0, 10.0, 33.3, 70.0] {
        let (k, t) = (plain.curvature(s), turned.curvature(s));
        assert!((t.x - k.x).abs() < 1e-15);
        assert!((t.y + k.z * 0.4f64.sin()).abs() < 1e-15 && (t.z - k.z * 0.4f64.cos()).abs() < 1e-15);
    }
}

#[test]
fn every_frame_works_on_every_curve() {
    let twist = Function::parse("0.3*s + 0.1*sin(s)", "s").expect("good");
    let curves = [
        ("straight", Curve::Straight { length: 3.0 }),
        ("arc", Curve::Arc { radius: 2.0, angle: 4.0 }),
        ("helix", Curve::Helix { radius: 1.5, pitch: 2.0, turns: 2.25 }),
        ("wiggle", wiggle()),
        ("points", Curve::Points { points: points() }),
    ];
    let frames = [
        SectionFrame::Natural,
        minimising(),
        SectionFrame::RotationMinimising { start: Some(Vector3::new(0.2, 0.3, 1.0)), twist: Some(twist) },
        SectionFrame::Direction { along: Vector3::new(0.1, 0.2, 3.0) },
    ];
    for (name, curve) in &curves {
        for frame in &frames {
            let shape = shape(curve, frame.clone());
            assert_consistent(&shape, &format!("{name}, {frame:?}"));
            assert!(shape.pose(0.0).position.norm() < 1e-15);
            assert!(shape.pose(0.0).rotation.angle() < 1e-15);
        }
    }
}

fn points() -> Vec<Vector3<f64>> {
    [0.0f64, 0.4, 1.0, 1.3, 2.0, 2.4, 3.1]
        .iter()
        .map(|t| Vector3::new(t.cos(), 1.2 * t.sin(), 0.3 * t + 0.05 * t * t))
        .collect()
}

#[test]
fn rotation_minimising_frames_turn_about_the_tangent_only_by_the_twist() {
    let twist = Function::parse("0.5*s*s", "s").expect("good");
    let frame = SectionFrame::RotationMinimising { start: None, twist: Some(twist) };
    for curve in
        [wiggle(), Curve::Helix { radius: 1.0, pitch: 5.0, turns: 2.0 }, Curve::Points { points: points() }]
    {
        let plain = shape(&curve, minimising());
        let twisted = shape(&curve, frame.clone());
        for i in 0..=20 {
            let s = plain.length() * f64::from(i) / 20.0;
            assert_eq!(plain.curvature(s).x, 0.0);
            assert!((twisted.curvature(s).x - s).abs() < 1e-15 * (1.0 + s));
            let turn = plain.pose(s).rotation.inverse() * twisted.pose(s).rotation;
            let wanted = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5 * s * s);
            assert!(turn.angle_to(&wanted) < 1e-13);
        }
    }
}

#[test]
fn a_rotation_minimising_helix_turns_back_by_its_torsion() {
    let curve = Curve::Helix { radius: 7.0, pitch: 9.0, turns: 3.0 };
    let traced = parametric(["7*cos(t)", "7*sin(t)", "9/(2*pi)*t"], [0.0, 6.0 * PI]);
    // The helix starts towards its axis (e2 = normal), that is -x in the traced curve's own axes.
    let start = SectionFrame::RotationMinimising { start: Some(Vector3::y()), twist: None };
    let start_traced = SectionFrame::RotationMinimising { start: Some(-Vector3::x()), twist: None };
    let (exact, traced) = (shape(&curve, start), shape(&traced, start_traced));
    for i in 0..=40 {
        let s = exact.length() * f64::from(i) / 40.0;
        assert!((exact.curvature(s) - traced.curvature(s)).norm() < 1e-14, "{s}");
        assert!(exact.pose(s).rotation.angle_to(&traced.pose(s).rotation) < 1e-13, "{s}");
    }
}

#[test]
fn inflections_and_straight_stretches_break_only_frenet_which_says_where() {
    let s_curve = parametric(["t", "t*t*t", "0"], [-1.0, 1.0]);
    let natural = shape(&s_curve, SectionFrame::Natural);
    assert_consistent(&natural, "S-curve");
    let middle = 0.5 * natural.length();
    assert!(natural.curvature(middle).norm() < 1e-13);
    assert!(natural.curvature(middle - 0.3).z < 0.0 && natural.curvature(middle + 0.3).z > 0.0);
    let frenet = SectionFrame::Frenet { offset: 0.0 };
    for curve in [s_curve, parametric(["t", "sin(t)", "0"], [-0.7, 2.0])] {
        let error = RestShape::new(&curve, &frenet).unwrap_err();
        let whole = shape(&curve, SectionFrame::Natural);
        let ShapeError::FrenetUndefined { s } = error else { panic!("{error}") };
        assert!(whole.curvature(s).norm() < 1e-5, "{s}");
        assert!(error.to_string().contains("rotation-minimising"));
    }
    let straight = Curve::Straight { length: 1.0 };
    assert_eq!(RestShape::new(&straight, &frenet).unwrap_err(), ShapeError::FrenetUndefined { s: 0.0 });
    let line = parametric(["1 + 2*t", "t", "-t"], [0.0, 3.0]);
    assert!(matches!(RestShape::new(&line, &frenet), Err(ShapeError::FrenetUndefined { .. })));
    let line = shape(&line, SectionFrame::Natural);
    assert_eq!(line.uniform(), Some(Vector3::zeros()));
    assert!((line.length() - 3.0 * 6f64.sqrt()).abs() < 1e-14);
}

#[test]
fn a_spline_with_a_straight_piece_keeps_its_frame_through_it() {
    let mut points: Vec<Vector3<f64>> = (0..8).map(|i| Vector3::new(f64::from(i) * 0.5, 0.0, 0.0)).collect();
    points.extend((1..8).map(|i| {
        let a = 0.2 * f64::from(i);
        Vector3::new(3.5 + a.sin(), 1.0 - a.cos(), 0.1 * a * a)
    }));
    let spline = shape(&Curve::Points { points: points.clone() }, SectionFrame::Natural);
    assert_consistent(&spline, "spline with a straight piece");
    assert_eq!(spline.breaks().len(), points.len() - 2);
    assert!(miss(&spline, &points) < 1e-14);
}

/// How far the spline is from its points, judged by their mutual distances, which no start frame changes.
fn miss(shape: &RestShape, points: &[Vector3<f64>]) -> f64 {
    let mut places = vec![0.0];
    places.extend_from_slice(shape.breaks());
    places.push(shape.length());
    let positions: Vec<_> = places.iter().map(|s| shape.pose(*s).position).collect();
    let mut worst = 0.0f64;
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate() {
            worst = worst.max(((positions[i] - positions[j]).norm() - (a - b).norm()).abs());
        }
    }
    worst
}

#[test]
fn two_points_are_a_straight_line() {
    let points = vec![Vector3::new(1.0, 1.0, 1.0), Vector3::new(2.0, 3.0, 3.0)];
    let line = shape(&Curve::Points { points }, SectionFrame::Natural);
    assert!((line.length() - 3.0).abs() < 1e-15);
    assert_eq!(line.uniform(), Some(Vector3::zeros()));
    assert!((line.pose(1.2).position - Vector3::new(1.2, 0.0, 0.0)).norm() < 1e-15);
}

#[test]
fn the_spline_through_points_of_a_curve_converges_with_the_fourth_order() {
    let error = |n: u32| {
        let points = (0..=n)
            .map(|i| {
                let t = 2.0 * f64::from(i) / f64::from(n);
                Vector3::new(t.cos(), t.sin(), 0.0)
            })
            .collect();
        (shape(&Curve::Points { points }, SectionFrame::Natural).length() - 2.0).abs()
    };
    let (coarse, fine) = (error(160), error(320));
    assert!(fine < 1e-11 && coarse / fine > 13.0, "{coarse:e} {fine:e}");
}

#[test]
fn curvature_profiles_give_the_shape_that_integrates_them() {
    let function = |text: &str| Profile::Function(Function::parse(text, "s").expect("good"));
    let table = Profile::Table {
        at: vec![At::Fraction(0.0), At::Fraction(0.3), At::Length(2.0)],
        value: vec![0.0, 1.5, -0.5],
    };
    let curve =
        Curve::Curvature { curvature: [function("0.2*s"), table, function("1 + sin(3*s)")], length: 2.5 };
    let profile = shape(&curve, SectionFrame::Natural);
    assert_eq!(profile.breaks(), &[0.75, 2.0]);
    assert_consistent(&profile, "profiles");
    let uniform = Curve::Curvature { curvature: [0.1.into(), 0.0.into(), 2.0.into()], length: 1.0 };
    let uniform = shape(&uniform, SectionFrame::Natural);
    assert_eq!(uniform.uniform(), Some(Vector3::new(0.1, 0.0, 2.0)));
    assert_consistent(&uniform, "uniform profiles");
}

#[test]
fn an_arc_bends_towards_e2() {
    let arc = shape(&Curve::Arc { radius: 100.0, angle: PI / 4.0 }, SectionFrame::Natural);
    assert_eq!(arc.uniform(), Some(Vector3::new(0.0, 0.0, 0.01)));
    let tip = arc.pose(arc.length()).position;
    let exact = Vector3::new(100.0 * (PI / 4.0).sin(), 100.0 * (1.0 - (PI / 4.0).cos()), 0.0);
    assert!((tip - exact).norm() < 1e-13);
    // An arc whose e2 starts along its own z axis bends towards -e3.
    let frame = SectionFrame::RotationMinimising { start: Some(Vector3::z()), twist: None };
    let k = shape(&Curve::Arc { radius: 2.0, angle: 1.0 }, frame).uniform().expect("uniform");
    assert!((k - Vector3::new(0.0, 0.5, 0.0)).norm() < 1e-16);
}

#[test]
fn a_parametric_curve_may_be_traced_at_any_speed() {
    let slow = shape(&ellipse(), SectionFrame::Natural);
    let odd = parametric(["10*sin(2*pi*t^2)", "5 - 5*cos(2*pi*t^2)", "0"], [0.05, 1.0]);
    let odd = shape(&odd, SectionFrame::Natural);
    let skipped = slow.length() - odd.length();
    for s in [0.0, 1.0, 20.0, 40.0] {
        assert!((odd.curvature(s) - slow.curvature(s + skipped)).norm() < 1e-13, "{s}");
    }
}

#[test]
fn wrong_curves_are_refused_with_their_values() {
    let refused = |curve: Curve, frame: SectionFrame| RestShape::new(&curve, &frame).unwrap_err();
    let natural = || SectionFrame::Natural;
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(Curve::Straight { length }, natural());
        assert!(matches!(error, ShapeError::NotPositive { what: "length", .. }), "{error}");
    }
    let error = refused(Curve::Arc { radius: -2.0, angle: 1.0 }, natural());
    assert_eq!(error, ShapeError::NotPositive { what: "radius", value: -2.0 });
    let error = refused(Curve::Helix { radius: 1.0, pitch: f64::NAN, turns: 1.0 }, natural());
    assert!(matches!(error, ShapeError::NotFinite { what: "pitch", .. }));
    for range in [[0.0, 3.0], [-1.0, 1.0], [-1.0, 2.0f64.sqrt()]] {
        // y² = x³ has a cusp at the origin; with an offset it lies inside, at no special place.
        let offset = if range[0] == 0.0 { "0" } else { "0.1234" };
        let x = format!("(t - {offset})^2");
        let y = format!("(t - {offset})^3");
        let error = refused(parametric([&x, &y, "0"], range), natural());
        let ShapeError::Cusp { parameter, .. } = error else { panic!("{error}") };
        assert!((parameter - offset.parse::<f64>().unwrap()).abs() < 1e-6, "{error}");
    }
    assert_eq!(refused(parametric(["1", "2", "3"], [0.0, 1.0]), natural()), ShapeError::NoLength);
    for range in [[-1.0, 1.0], [-1.0, 1.7], [0.0, 1.0]] {
        let result = RestShape::new(&parametric(["1/t", "t", "0"], range), &natural());
        assert!(matches!(result, Err(ShapeError::Undefined { .. })), "{range:?}");
    }
    assert!(matches!(
        refused(parametric(["t", "0", "0"], [1.0, 1.0]), natural()),
        ShapeError::Range { from: 1.0, to: 1.0 }
    ));
    let along = |along| SectionFrame::Direction { along };
    let error = refused(Curve::Straight { length: 1.0 }, along(Vector3::x() * 2.0));
    assert_eq!(error, ShapeError::DirectionParallel { s: 0.0 });
    let error = refused(Curve::Arc { radius: 2.0, angle: 3.0 }, along(Vector3::y()));
    let ShapeError::DirectionParallel { s } = error else { panic!("{error}") };
    assert!((s - PI).abs() < 1e-12, "{s}");
    let error = refused(ellipse(), along(Vector3::new(1.0, 1.0, 0.0)));
    assert!(matches!(error, ShapeError::DirectionParallel { .. }));
    let error = refused(ellipse(), along(Vector3::zeros()));
    assert!(matches!(error, ShapeError::DirectionInvalid { .. }));
    let nan = Profile::Function(Function::parse("1/(s - 0.5)", "s").expect("good"));
    let error =
        refused(Curve::Curvature { curvature: [0.0.into(), nan, 0.0.into()], length: 1.0 }, natural());
    assert_eq!(error, ShapeError::LawNotFinite { what: "k2", s: 0.5 });
}

#[test]
fn a_spline_integrates_to_the_same_end_piece_by_piece_and_at_once() {
    let spline = shape(&Curve::Points { points: points() }, SectionFrame::Natural);
    let path = integrate(|s| spline.curvature(s), spline.length(), 20_000);
    let (_, p, q) = path[path.len() - 1];
    let end = spline.pose(spline.length());
    assert!((end.position - p).norm() < 1e-9 && end.rotation.angle_to(&q) < 1e-9);
}

#[test]
fn corners_are_refused_and_tight_bends_are_not() {
    let natural = SectionFrame::Natural;
    for (y, at) in [("abs(t)", 0.0), ("abs(t - 0.3)", 0.3), ("0.01*abs(t + 0.777)", -0.777)] {
        let error = RestShape::new(&parametric(["t", y, "0"], [-1.0, 1.0]), &natural).unwrap_err();
        let ShapeError::Corner { parameter, .. } = error else { panic!("{y}: {error}") };
        assert!((parameter - at).abs() < 1e-9, "{error}");
    }
    for width in ["0.1", "0.003", "0.0001"] {
        let bend = parametric(["t", &format!("sqrt((t - 0.2)^2 + {width}^2)"), "0"], [-1.0, 1.0]);
        let bend = RestShape::new(&bend, &natural).expect("smooth");
        let (start, end) = (bend.pose(0.0), bend.pose(bend.length()));
        // It turns by nearly a right angle, at the latest within the width.
        assert!((start.rotation.angle_to(&end.rotation) - FRAC_PI_2).abs() < 0.02);
    }
    // A kink of the curvature is no corner: two arcs of different radius.
    let kink = parametric(["t", "t*t + abs(t)*t", "0"], [-1.0, 1.3]);
    assert!(RestShape::new(&kink, &natural).is_ok());
}

#[test]
fn curves_that_are_not_smooth_at_an_end_are_refused() {
    for expressions in [["sqrt(t)", "t", "0"], ["t", "t^1.5", "0"], ["ln(t)", "t", "0"]] {
        let result = RestShape::new(&parametric(expressions, [0.0, 1.0]), &SectionFrame::Natural);
        assert!(matches!(result, Err(ShapeError::Undefined { .. })), "{expressions:?}");
    }
}
