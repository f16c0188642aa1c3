//! Conformance of every law and every obstacle: force from energy, tangent from force, frame invariance.
#![allow(clippy::unwrap_used)]

use super::*;
use flexura_model::Turn;
use flexura_testkit::check_jacobian;
use nalgebra::{DMatrix, UnitQuaternion};

type V = Vector3<f64>;

fn table(rows: &[[f64; 2]]) -> TensionLaw {
    TensionLaw::Table(MonotoneTable::new(rows).unwrap().into())
}

/// Every law, with lengths on either side of what is special about it.
fn laws() -> Vec<(&'static str, Spring, Vec<f64>)> {
    let spring = |law| Spring { law, rest_length: 0.8, is_loose: false };
    let stretched = vec![0.83, 0.92, 1.1, 1.5, 0.6];
    let exponential = |jump| TensionLaw::Exponential { force: 0.17, exponent: 9.4377, jump };
    vec![
        ("linear", spring(TensionLaw::Linear { stiffness: 3.0, tension_only: false }), stretched.clone()),
        ("band", spring(TensionLaw::Linear { stiffness: 3.0, tension_only: true }), stretched.clone()),
        ("exponential", spring(exponential(0.0)), stretched.clone()),
        ("partly jumping", spring(exponential(0.3)), stretched.clone()),
        ("printed", spring(exponential(1.0)), stretched.clone()),
        ("toe", spring(TensionLaw::Toe { axial_stiffness: 5.0, toe_strain: 0.1 }), stretched.clone()),
        ("table", spring(table(&[[0.0, 0.0], [0.1, 0.5], [0.2, 2.0], [0.4, 5.0]])), stretched.clone()),
        ("late table", spring(table(&[[0.05, 0.0], [0.1, 0.5], [0.15, 0.5], [0.4, 5.0]])), stretched.clone()),
        ("pushing table", spring(table(&[[-0.1, -1.0], [0.1, 0.5], [0.4, 5.0]])), stretched),
    ]
}

/// The derivative at zero by central differences of order eight over ±4e-3, which none of the kinks above is near to.
fn slope(f: &dyn Fn(f64) -> f64) -> f64 {
    let h = 1e-3;
    let part = |i: f64, w: f64| w * (f(i * h) - f(-i * h)) / h;
    part(1.0, 0.8) + part(2.0, -0.2) + part(3.0, 4.0 / 105.0) + part(4.0, -1.0 / 280.0)
}

#[test]
fn the_tension_of_every_law_is_the_slope_of_its_energy_and_the_rate_that_of_the_tension() {
    for (name, spring, lengths) in laws() {
        for length in lengths {
            let pull = spring.pull(length);
            let slope = |f: &dyn Fn(f64) -> f64| slope(&|x| f(length + x));
            let tension = slope(&|l| spring.energy(l));
            let size = pull.tension.abs().max(1.0);
            assert!((tension - pull.tension).abs() < 1e-11 * size, "{name} at {length}: {tension} {pull:?}");
            let rate = slope(&|l| spring.pull(l).tension);
            let size = pull.rate.abs().max(1.0);
            assert!((rate - pull.rate).abs() < 1e-10 * size, "{name} at {length}: {rate} {pull:?}");
        }
        assert!(spring.energy(0.5) >= 0.0, "{name}");
    }
}

#[test]
fn the_tangent_of_every_law_is_the_derivative_of_its_force() {
    let from = V::new(0.1, 0.2, -0.3);
    for (name, spring, lengths) in laws() {
        for length in lengths {
            let to = from + V::new(0.6, -0.35, 0.5).normalize() * length;
            let force = |to: &V| spring.between(&from, to).unwrap();
            let tangent = DMatrix::from_fn(3, 3, |i, j| force(&to).tangent[(i, j)]);
            let numerical = DMatrix::from_fn(3, 3, |i, j| slope(&|x| force(&(to + V::ith(j, x))).force[i]));
            let size = tangent.amax().max(1.0);
            assert!((numerical - tangent).amax() < 1e-10 * size, "{name} at {length}");
        }
        assert!(spring.between(&from, &from).is_none());
    }
}

#[test]
fn turning_everything_turns_the_force_of_every_law() {
    let turn = UnitQuaternion::from_euler_angles(0.4, -1.1, 2.0);
    let (from, to) = (V::new(0.1, 0.2, -0.3), V::new(0.8, -0.3, 0.3));
    for (name, spring, _) in laws() {
        let here = spring.between(&from, &to).unwrap();
        let there = spring.between(&(turn * from), &(turn * to)).unwrap();
        assert!((there.force - turn * here.force).norm() < 1e-13, "{name}");
        let turned = turn.to_rotation_matrix() * here.tangent * turn.inverse().to_rotation_matrix();
        assert!((there.tangent - turned).norm() < 1e-12 * turned.norm().max(1.0), "{name}");
    }
}

#[test]
fn what_only_pulls_is_nothing_when_slack() {
    for (name, spring, _) in laws() {
        let pushes = matches!(name, "linear" | "pushing table");
        let pull = spring.pull(0.7);
        assert_eq!(pull.tension != 0.0, pushes, "{name}");
        assert_eq!(spring.is_slack(0.7), !pushes, "{name}");
        assert_eq!(spring.energy(0.7) > 0.0, pushes, "{name}");
    }
}

#[test]
fn a_spring_that_is_just_slack_counts_as_taut_unless_it_is_loosening() {
    let law = TensionLaw::Linear { stiffness: 3.0, tension_only: true };
    for length in [0.8, 0.8 * (1.0 - 1e-14), 0.8 * (1.0 + 1e-14)] {
        let spring = Spring { law: law.clone(), rest_length: 0.8, is_loose: false };
        assert_eq!(spring.pull(length).rate, 3.0);
        assert!(spring.pull(length).tension >= 0.0);
        assert_eq!(Spring { is_loose: true, ..spring }.pull(length).rate, 0.0);
    }
}

/// (4.12) to (4.15) of the thesis, worked by hand at ε = 0.5: stress k2 exp(k1/2), area A0/1.5.
#[test]
fn the_printed_law_is_stress_times_the_area_that_is_left() {
    let (area, k1, k2) = (69.04e-6, 9.4377, 2500.0);
    let law = |jump| TensionLaw::Exponential { force: area * k2, exponent: k1, jump };
    let by_hand = k2 * (k1 * 0.5f64).exp() * area / 1.5;
    let printed = law(1.0).pull(0.01, 0.02, false).tension;
    assert!((printed / by_hand - 1.0).abs() < 1e-14);
    // Its jump at slack is A0 k2, and it is all that tells it from the continuous one.
    assert!((law(1.0).pull(0.0, 0.02, false).tension - area * k2).abs() < 1e-16);
    let continuous = law(0.0).pull(0.01, 0.02, false).tension;
    assert!((printed - continuous - area * k2 / 1.5).abs() < 1e-14);
}

/// ∫ (exp(k t) - 1)/(1 + t) dt by the exponential integral's series: exp(-k) [Ei(k (1 + e)) - Ei(k)] - ln(1 + e).
#[test]
fn the_exponential_laws_energy_is_the_exponential_integral() {
    // Ei(x) = γ + ln x + Σ x^n/(n n!) (Abramowitz and Stegun 5.1.10).
    let ei = |x: f64| {
        let (mut sum, mut term) = (0.577_215_664_901_532_9 + x.ln(), 1.0);
        for n in 1..200 {
            term *= x / f64::from(n);
            sum += term / f64::from(n);
        }
        sum
    };
    for (k, strain) in [(9.4377f64, 0.5f64), (3.0, 1.5), (1.0, 0.3), (20.0, 0.9)] {
        let law = TensionLaw::Exponential { force: 2.0, exponent: k, jump: 0.0 };
        let closed = 2.0 * 0.7 * ((-k).exp() * (ei(k * (1.0 + strain)) - ei(k)) - strain.ln_1p());
        let ours = law.energy(0.7 * strain, 0.7);
        assert!((ours - closed).abs() < 1e-12 * closed, "{k} {strain}: {ours} {closed}");
    }
}

#[test]
fn the_toe_meets_the_straight_part_in_value_and_slope() {
    let law = TensionLaw::Toe { axial_stiffness: 2000.0, toe_strain: 0.06 };
    // Blankevoort's ε_l = 0.03: k ε²/(4 ε_l) and k (ε - ε_l).
    let at = |strain: f64| law.pull(strain * 0.05, 0.05, false);
    assert!((at(0.04).tension - 2000.0 * 0.04f64.powi(2) / 0.12).abs() < 1e-12);
    assert!((at(0.10).tension - 2000.0 * 0.07).abs() < 1e-12);
    let (below, above) = (at(0.06 - 1e-9), at(0.06 + 1e-9));
    assert!((below.tension - above.tension).abs() < 1e-5 && (below.rate - above.rate).abs() < 2e-3);
}

#[test]
fn a_table_rises_where_its_rows_do_and_goes_through_them() {
    let rows = [[0.0, 0.0], [1.0, 0.1], [2.0, 5.0], [3.0, 5.0], [4.0, 9.0]];
    let table = MonotoneTable::new(&rows).unwrap();
    for [x, force] in rows {
        assert!((table.at(x).0 - force).abs() < 1e-14);
        let (below, above) = (table.at(x - 1e-9), table.at(x + 1e-9));
        if x > 0.0 {
            assert!((below.1 - above.1).abs() < 1e-6, "slope at {x}");
        }
    }
    for i in 0..500 {
        assert!(table.at(0.01 * f64::from(i)).1 >= 0.0);
    }
    // Rows on a line are that line, also beyond.
    let line = MonotoneTable::new(&[[-1.0, -2.0], [0.5, 1.0], [2.0, 4.0]]).unwrap();
    for x in [-3.0, -0.2, 1.7, 9.0] {
        assert!((line.at(x).0 - 2.0 * x).abs() < 1e-13);
    }
    assert!(MonotoneTable::new(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
    assert!(MonotoneTable::new(&[[0.0, 1.0], [1.0, 0.5]]).is_none());
}

/// The means of Fritsch and Butland and the three-point formula, worked by hand.
#[test]
fn slopes_of_a_table_are_weighted_harmonic_means() {
    let table = MonotoneTable::new(&[[0.0, 0.0], [1.0, 1.0], [3.0, 2.0], [4.0, 6.0]]).unwrap();
    // Widths 1, 2, 1; chords 1, 1/2, 4. At x = 1: weights 2·2 + 1 = 5 and 2 + 2·1 = 4, 9/(5/1 + 4/0.5) = 9/13.
    assert!((table.at(1.0).1 - 9.0 / 13.0).abs() < 1e-14);
    // At x = 3: weights 2·1 + 2 = 4 and 1 + 2·2 = 5, 9/(4/0.5 + 5/4).
    assert!((table.at(3.0).1 - 9.0 / 9.25).abs() < 1e-14);
    // At the start ((2·1 + 2)·1 - 1·0.5)/3.
    assert!((table.at(0.0).1 - 3.5 / 3.0).abs() < 1e-14);
}

#[test]
fn a_table_tells_where_its_force_vanishes() {
    let relaxed = |rows: &[[f64; 2]]| MonotoneTable::new(rows).unwrap().relaxed();
    assert_eq!(relaxed(&[[0.0, 0.0], [1.0, 1.0]]), Some(0.0));
    assert_eq!(relaxed(&[[0.2, 0.0], [1.0, 1.0]]), Some(0.0));
    assert!((relaxed(&[[0.0, 1.0], [1.0, 3.0]]).unwrap() + 0.5).abs() < 1e-15);
    assert!((relaxed(&[[-1.0, 0.0], [1.0, 3.0]]).unwrap() + 1.0).abs() < 1e-12);
    assert!((relaxed(&[[-1.0, -3.0], [2.0, 6.0], [3.0, 9.0]]).unwrap()).abs() < 1e-12);
    assert!((relaxed(&[[-1.0, -3.0], [-0.5, -1.0]]).unwrap() + 0.25).abs() < 1e-12);
    assert_eq!(relaxed(&[[0.0, 1.0], [1.0, 1.0]]), None);
}

/// Obstacles with ends between which the path goes around them.
fn wrapped() -> Vec<(&'static str, Obstacle, V, V)> {
    let axis = V::new(0.2, -0.1, 1.0).normalize();
    let cylinder = |turn| Obstacle::Cylinder { radius: 0.5, axis, turn };
    let (a, b) = (V::new(1.1, 0.2, -0.4), V::new(-0.9, 0.5, 0.7));
    vec![
        ("sphere", Obstacle::Sphere { radius: 0.5 }, a, V::new(-0.9, 0.5, 0.3)),
        ("cylinder", cylinder(None), a, b),
        ("to the left", cylinder(Some(Turn::Positive)), a, b),
        ("the long way", cylinder(Some(Turn::Negative)), a, b),
    ]
}

#[test]
fn gradients_and_second_derivatives_of_wrapped_lengths_are_those_of_the_length() {
    for (name, obstacle, a, b) in wrapped() {
        let at = |x: &[f64]| {
            obstacle.around(&V::new(x[0], x[1], x[2]), &V::new(x[3], x[4], x[5])).unwrap().expect(name)
        };
        let x: Vec<f64> = a.iter().chain(b.iter()).copied().collect();
        let path = at(&x);
        let gradient = DMatrix::from_fn(1, 6, |_, j| path.gradient[j / 3][j % 3]);
        check_jacobian(|x| vec![at(x).length], &x, &gradient, 1e-10);
        let hessian = DMatrix::from_fn(6, 6, |i, j| path.hessian[i / 3][j / 3][(i % 3, j % 3)]);
        let slopes = |x: &[f64]| at(x).gradient.iter().flat_map(|g| g.iter().copied()).collect();
        check_jacobian(slopes, &x, &hessian, 1e-9);
        assert!((hessian.transpose() - &hessian).amax() < 1e-14, "{name}");
        // The rope leaves both ends with the same tension.
        for gradient in path.gradient {
            assert!((gradient.norm() - 1.0).abs() < 1e-14, "{name}");
        }
    }
}

#[test]
fn the_course_is_as_long_as_the_path_and_stays_on_the_surface() {
    for (name, obstacle, a, b) in wrapped() {
        let path = obstacle.around(&a, &b).unwrap().unwrap();
        let course = path.course(&a, &b);
        let polygon: f64 = course.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        // Chords of 5 degrees at most: shorter by 5²/24 at most.
        assert!(polygon <= path.length + 1e-14 && polygon > path.length * (1.0 - 3.2e-4), "{name}");
        for point in &course[1..course.len() - 1] {
            let from_axis = match obstacle {
                Obstacle::Sphere { .. } => point.norm(),
                Obstacle::Cylinder { axis, .. } => (point - axis * axis.dot(point)).norm(),
            };
            assert!((from_axis - 0.5).abs() < 1e-14, "{name}");
        }
        // Ends leave along the tangents.
        let last = course.len() - 1;
        for (end, next, gradient) in [(0, 1, path.gradient[0]), (last, last - 1, path.gradient[1])] {
            let way = (course[next] - course[end]).normalize();
            assert!((way + gradient).norm() < 1e-12, "{name}");
        }
    }
}

/// The unrolled path: tangents and arc as one straight line, its length from the two legs; and on the sphere by the closed
/// form with arc cosines.
#[test]
fn wrapped_lengths_are_the_closed_forms() {
    let (a, b) = (V::new(1.3, 0.0, 0.0), V::new(-0.7, 0.1, 0.0));
    let r = 0.4f64;
    let (da, db) = (a.norm(), b.norm());
    let angle = a.angle(&b);
    let flat =
        (da * da - r * r).sqrt() + (db * db - r * r).sqrt() + r * (angle - (r / da).acos() - (r / db).acos());
    let length = |obstacle: Obstacle, b: &V| obstacle.around(&a, b).unwrap().unwrap().length;
    assert!((length(Obstacle::Sphere { radius: r }, &b) - flat).abs() < 1e-14);
    let cylinder = |turn| Obstacle::Cylinder { radius: r, axis: V::z(), turn };
    for rise in [0.0, 0.6, -2.0] {
        let b = b + V::z() * rise;
        assert!((length(cylinder(None), &b) - flat.hypot(rise)).abs() < 1e-14);
        assert!((length(cylinder(Some(Turn::Positive)), &b) - flat.hypot(rise)).abs() < 1e-14);
        let long = flat + r * (std::f64::consts::TAU - 2.0 * angle);
        assert!((length(cylinder(Some(Turn::Negative)), &b) - long.hypot(rise)).abs() < 1e-14);
    }
}

/// No neighbouring course on the cylinder is shorter: broken lines through points of the surface, their heights and angles
/// disturbed.
#[test]
fn no_course_near_the_geodesic_is_shorter() {
    let obstacle = Obstacle::Cylinder { radius: 0.5, axis: V::z(), turn: None };
    let (a, b) = (V::new(1.0, 0.1, -0.3), V::new(-0.8, 0.3, 0.9));
    let path = obstacle.around(&a, &b).unwrap().unwrap();
    // Lengths of fine polygons on the surface between given contact angles with a straight or bent height.
    let polygon = |from: f64, to: f64, z0: f64, z1: f64, bulge: f64| {
        let n = 4000;
        let point = |i: usize| {
            let t = i as f64 / f64::from(n);
            let turn = from + (to - from) * t;
            let z = z0 + (z1 - z0) * t + bulge * (std::f64::consts::PI * t).sin();
            V::new(0.5 * turn.cos(), 0.5 * turn.sin(), z)
        };
        let on: f64 = (0..n as usize).map(|i| (point(i + 1) - point(i)).norm()).sum();
        (point(0) - a).norm() + on + (b - point(n as usize)).norm()
    };
    let course = path.course(&a, &b);
    let (first, last) = (course[1], course[course.len() - 2]);
    let angles = [first.y.atan2(first.x), last.y.atan2(last.x)];
    let best = polygon(angles[0], angles[1], first.z, last.z, 0.0);
    assert!((best - path.length).abs() < 1e-7);
    for (d0, d1, h0, h1, bulge) in [
        (0.05, 0.0, 0.0, 0.0, 0.0),
        (0.0, -0.05, 0.0, 0.0, 0.0),
        (0.0, 0.0, 0.05, 0.0, 0.0),
        (0.0, 0.0, -0.05, 0.0, 0.0),
        (0.0, 0.0, 0.0, 0.05, 0.0),
        (0.0, 0.0, 0.0, -0.05, 0.0),
        (0.0, 0.0, 0.0, 0.0, 0.05),
        (0.0, 0.0, 0.0, 0.0, -0.05),
    ] {
        let other = polygon(angles[0] + d0, angles[1] + d1, first.z + h0, last.z + h1, bulge);
        assert!(other > path.length + 1e-5, "{d0} {d1} {h0} {h1} {bulge}: {other} {}", path.length);
    }
}

#[test]
fn a_line_that_clears_the_obstacle_is_straight_and_touching_is_smooth() {
    let sphere = Obstacle::Sphere { radius: 0.5 };
    let along = |y: f64| sphere.around(&V::new(-1.0, y, 0.0), &V::new(1.0, y, 0.0)).unwrap();
    assert!(along(0.51).is_none());
    let touching = along(0.5 - 1e-9).unwrap();
    assert!((touching.length - 2.0).abs() < 1e-12);
    assert!((touching.gradient[1] - V::x()).norm() < 1e-7);
    // With a side given, a line that is clear on that side is straight; on the other the path is hung around.
    let below = Obstacle::Cylinder { radius: 0.5, axis: V::z(), turn: Some(Turn::Positive) };
    let at = |y: f64| below.around(&V::new(-1.0, y, 0.0), &V::new(1.0, y, 0.0)).unwrap();
    assert!(at(-0.6).is_none());
    assert!(at(0.6).unwrap().contact() > 1.0);
    // Nothing happens where the line passes the axis, or where it gets clear of the other side.
    for y in [0.0, 0.5] {
        let (before, after) = (at(y - 1e-9).unwrap(), at(y + 1e-9).unwrap());
        assert!((before.length - after.length).abs() < 1e-8);
        assert!((before.gradient[0] - after.gradient[0]).norm() < 1e-8);
    }
}

#[test]
fn ends_inside_or_opposite_have_no_path() {
    let sphere = Obstacle::Sphere { radius: 0.5 };
    let inside = sphere.around(&V::new(1.0, 0.0, 0.0), &V::new(0.0, 0.3, 0.0)).unwrap_err();
    assert_eq!(inside, PathError::Inside { end: 1, distance: 0.3 });
    let opposite = sphere.around(&V::new(1.0, 0.0, 0.0), &V::new(-2.0, 0.0, 0.0)).unwrap_err();
    assert_eq!(opposite, PathError::Opposite);
    let cylinder = Obstacle::Cylinder { radius: 0.5, axis: V::z(), turn: None };
    let inside = cylinder.around(&V::new(0.1, 0.0, 3.0), &V::new(0.0, 1.0, 0.0)).unwrap_err();
    assert_eq!(inside, PathError::Inside { end: 0, distance: 0.1 });
}

/// From the top of a circle of radius r to a point at the distance d from the middle, at the angle γ from it:
/// r (γ - acos(r/d)) along the rim and then √(d² - r²).
#[test]
fn an_end_on_the_rim_leaves_along_the_tangent() {
    let (radius, far, angle) = (0.05f64, 0.08f64, 2.0f64);
    let expected = radius * (angle - (radius / far).acos()) + (far * far - radius * radius).sqrt();
    let end = V::new(far * angle.cos(), far * angle.sin(), 0.0);
    let obstacles = [Obstacle::Sphere { radius }, Obstacle::Cylinder { radius, axis: V::z(), turn: None }];
    for obstacle in obstacles {
        for slip in [0.0, 1e-15, -1e-15, -1e-12] {
            let path = obstacle.around(&V::new(radius * (1.0 + slip), 0.0, 0.0), &end).unwrap().unwrap();
            assert!((path.length - expected).abs() < 1e-12, "{slip}: {} {expected}", path.length);
            // The pull on the end is a unit vector along the rim.
            assert!((path.gradient[0] + V::y()).norm() < 1e-6, "{:?}", path.gradient[0]);
            assert!(path.hessian.iter().flatten().all(|block| block.iter().all(|x| x.is_finite())));
        }
        let inside = obstacle.around(&V::new(radius * (1.0 - 1e-6), 0.0, 0.0), &end);
        assert!(matches!(inside, Err(PathError::Inside { end: 0, .. })));
    }
}
