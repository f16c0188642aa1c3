//! Boundaries by arc length against closed forms.

use super::*;
use flexura_model::Side;

fn ellipse(a: f64, b: f64) -> Contour {
    let curve = BoundaryCurve::Ellipse { semi_axes: [a, b], range: None };
    Contour::new(&Boundary { curve, outside: None }).expect("an ellipse")
}

fn function(text: &str) -> Function {
    Function::parse(text, "t").expect("a function")
}

fn expression(x: &str, y: &str, range: [f64; 2], closed: bool) -> Boundary {
    let curve = BoundaryCurve::Expression { position: [function(x), function(y)], range, closed };
    Boundary { curve, outside: None }
}

/// Perimeter 4 a E(e²) with E(0.75) = 1.2110560275684594 (Abramowitz and Stegun, table 17.1, to its ten digits).
#[test]
fn the_perimeter_of_an_ellipse_is_its_elliptic_integral() {
    let length = ellipse(2.0, 1.0).length().expect("closed");
    assert!((length - 8.0 * 1.211_056_027_568_459_4).abs() < 1e-13);
}

#[test]
fn a_circle_is_known_everywhere_and_for_every_turn() {
    let circle = ellipse(1.5, 1.5);
    for s in [-20.0, -0.3, 0.0, 1.0, 7.7, 31.0] {
        let place = circle.at(s).expect("closed");
        let t = s / 1.5;
        assert!((place.parameter - t).abs() < 1e-13 * (1.0 + t.abs()));
        assert!((place.angle - (t + PI / 2.0)).abs() < 1e-13 * (1.0 + t.abs()));
        assert!((place.point[0] - 1.5 * t.cos()).abs() < 1e-12);
        assert!((place.curvature - 1.0 / 1.5).abs() < 1e-14 && place.curvature_rate.abs() < 1e-13);
        assert!((circle.arc_of(place.parameter).expect("closed") - s).abs() < 1e-12);
    }
}

#[test]
fn tangent_and_curvature_are_derivatives_along_the_arc() {
    let wavy = expression("(3 + 0.3*cos(3*t))*cos(t)", "(2 + 0.3*cos(3*t))*sin(t)", [0.0, TAU], true);
    let against = expression("(3 + 0.3*cos(3*t))*cos(t)", "-(2 + 0.3*cos(3*t))*sin(t)", [0.0, TAU], true);
    let open = Boundary { outside: Some(Side::Left), ..expression("t", "t^2 + 0.2*t^3", [-1.0, 1.3], false) };
    for boundary in [wavy, against, open] {
        let contour = Contour::new(&boundary).expect("a boundary");
        let h = 1e-5;
        for s in [0.31, 0.9, 1.7, 2.4] {
            let (before, here, after) =
                (contour.at(s - h).expect("in"), contour.at(s).expect("in"), contour.at(s + h).expect("in"));
            let slope = |a: f64, b: f64| (b - a) / (2.0 * h);
            let tangent = here.tangent();
            for i in 0..2 {
                assert!((slope(before.point[i], after.point[i]) - tangent[i]).abs() < 1e-9);
            }
            assert!((slope(before.angle, after.angle) - here.curvature).abs() < 1e-8);
            assert!((slope(before.curvature, after.curvature) - here.curvature_rate).abs() < 1e-7);
            assert!((contour.arc_of(here.parameter).expect("in") - s).abs() < 1e-12);
        }
    }
}

/// Whichever way a closed curve is written down, its arc length runs counter-clockwise.
#[test]
fn closed_boundaries_run_counter_clockwise() {
    let forth = Contour::new(&expression("2*cos(t)", "sin(t)", [0.0, TAU], true)).expect("closed");
    let back = Contour::new(&expression("2*cos(t)", "-sin(t)", [0.0, TAU], true)).expect("closed");
    for contour in [&forth, &back, &ellipse(2.0, 1.0)] {
        assert!(contour.is_convex());
        let length = contour.length().expect("closed");
        let turn = contour.at(length * 1.25).expect("closed").angle
            - contour.at(length * 0.25).expect("closed").angle;
        assert!((turn - TAU).abs() < 1e-12);
    }
    let inside = Boundary { outside: Some(Side::Left), ..expression("2*cos(t)", "sin(t)", [0.0, TAU], true) };
    assert_eq!(Contour::new(&inside).unwrap_err(), BoundaryError::OutsideWithin);
}

#[test]
fn a_line_has_its_outside_to_the_right() {
    let curve = BoundaryCurve::Line { point: [1.0, 2.0], normal: [0.0, 3.0], range: None };
    let floor = Contour::new(&Boundary { curve, outside: None }).expect("a line");
    let place = floor.at(0.5).expect("without end");
    assert!((place.point[0] - 0.5).abs() < 1e-15 && (place.point[1] - 2.0).abs() < 1e-15);
    // The tangent turned by -90 degrees is the normal.
    let [x, y] = place.tangent();
    assert!((y).abs() < 1e-15 && (x + 1.0).abs() < 1e-15);
}

#[test]
fn what_is_no_boundary_is_refused() {
    let zero = BoundaryCurve::Ellipse { semi_axes: [1.0, 0.0], range: None };
    assert!(matches!(
        Contour::new(&Boundary { curve: zero, outside: None }),
        Err(BoundaryError::NotPositive { what: "semi-axis along y", .. })
    ));
    let eight = expression("sin(2*t)", "sin(t)", [0.0, TAU], true);
    assert!(matches!(Contour::new(&eight), Err(BoundaryError::Crosses { .. })));
    let gap = expression("cos(t)", "sin(t)", [0.0, 6.0], true);
    assert!(matches!(Contour::new(&gap), Err(BoundaryError::NotClosed { .. })));
    let twice = BoundaryCurve::Ellipse { semi_axes: [1.0, 2.0], range: Some([0.0, 7.0]) };
    assert!(matches!(
        Contour::new(&Boundary { curve: twice, outside: None }),
        Err(BoundaryError::MoreThanATurn { .. })
    ));
}

/// A measured outline: points of an ellipse give it back at fourth order.
#[test]
fn a_spline_through_points_of_an_ellipse_converges_to_it() {
    let worst = |count: u32| {
        let points: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let t = TAU * f64::from(i) / f64::from(count);
                [2.0 * t.cos(), t.sin()]
            })
            .collect();
        let curve = BoundaryCurve::Points { points, closed: true };
        let contour = Contour::new(&Boundary { curve, outside: None }).expect("a boundary");
        (contour.length().expect("closed") - 8.0 * 1.211_056_027_568_459_4).abs()
    };
    let (coarse, fine) = (worst(40), worst(80));
    assert!(fine < 1e-5 && coarse / fine > 10.0, "{coarse} {fine}");
}

#[test]
fn arcs_join_smoothly() {
    let curve = BoundaryCurve::Arcs {
        point: [0.0, 0.0],
        direction: [1.0, 0.0],
        arcs: vec![[2.0, PI / 6.0], [1.0, PI / 3.0], [0.5, -PI / 4.0]],
    };
    let contour = Contour::new(&Boundary { curve, outside: None }).expect("arcs");
    let length = 2.0 * PI / 6.0 + PI / 3.0 + 0.5 * PI / 4.0;
    assert!((contour.length().expect("open") - length).abs() < 1e-14);
    let end = contour.at(2.0 * PI / 6.0 + PI / 3.0).expect("in");
    // The first arc's centre is (0, 2), the second's lies 1 nearer to their common point.
    let centre = [2.0 * (PI / 6.0).sin() * 0.5, 2.0 - (PI / 6.0).cos()];
    assert!((end.point[0] - centre[0] - 1.0).abs() < 1e-14 && (end.point[1] - centre[1]).abs() < 1e-14);
    for (s, curvature) in [(0.3, 0.5), (1.5, 1.0), (2.3, -2.0)] {
        assert!((contour.at(s).expect("in").curvature - curvature).abs() < 1e-14);
    }
    let none = BoundaryCurve::Arcs { point: [0.0; 2], direction: [1.0, 0.0], arcs: vec![[1.0, 0.0]] };
    assert!(matches!(Contour::new(&Boundary { curve: none, outside: None }), Err(BoundaryError::Arc { .. })));
}
