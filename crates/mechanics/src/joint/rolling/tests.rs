//! Rolling joints against the thesis's examples, and their derivatives.

use super::super::{ContactError, Joint, Kinematics};
use super::*;
use flexura_model::{
    Boundary, BoundaryCurve, Contact, JointKind, JointLaw, Rolling as Description, RollingCoordinate, Slide,
};
use flexura_spatial::log;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn ellipse(a: f64, b: f64, range: Option<[f64; 2]>) -> Boundary {
    Boundary { curve: BoundaryCurve::Ellipse { semi_axes: [a, b], range }, outside: None }
}

fn floor() -> Boundary {
    let curve = BoundaryCurve::Line { point: [0.3, -0.2], normal: [0.3, 1.0], range: None };
    Boundary { curve, outside: None }
}

fn function(text: &str) -> flexura_expression::Function {
    flexura_expression::Function::parse(text, "q").unwrap()
}

fn description(child: Boundary, parent: Boundary, slide: Slide) -> Description {
    Description { child, parent, concave: false, start: Some([-FRAC_PI_2, FRAC_PI_2]), slide, close: true }
}

fn joint(description: Description, coordinate: RollingCoordinate) -> Result<Joint, ContactError> {
    let kind = JointKind::Rolling(coordinate);
    let mut law = JointLaw::free(kind, Vector3::z());
    law.second_axis = Vector3::x();
    law.contact = Some(Box::new(Contact::Rolling(description)));
    Joint::new(&law, 1.0, &Pose::identity())
}

fn at(joint: &Joint, q: f64) -> (ContactState, f64, Vector3<f64>) {
    let configuration = joint.configuration(&[q]);
    let pose = joint.pose(&configuration);
    let angle = log(&pose.rotation).z;
    (joint.contact(&configuration).unwrap(), angle.rem_euclid(TAU), pose.position)
}

/// Example 3.1.1 of the thesis, corrected: an ellipse (2, 1) rolls on a circle of 1 without slip. After a turn of 90 degrees against the
/// normal it touches with the end of its major axis.
#[test]
fn an_ellipse_rolls_on_a_circle() {
    let joint = joint(
        description(ellipse(2.0, 1.0, None), ellipse(1.0, 1.0, None), Slide::None),
        RollingCoordinate::Turning,
    )
    .unwrap();
    let (contact, angle, position) = at(&joint, FRAC_PI_2);
    assert!((contact.parameters[0][0] + PI).abs() < 1e-12);
    assert!((contact.travel[0] - 2.422_112_055_1).abs() < 1e-10);
    let phi = contact.parameters[1][0] - FRAC_PI_2;
    assert!((phi.to_degrees() - 138.776_798_267).abs() < 1e-9);
    assert!((angle.to_degrees() - 228.776_798_267).abs() < 1e-9);
    assert!((position.norm() - 3.0).abs() < 1e-12);
}

/// Example 3.1.2: with the sliding velocity b²/a per turning.
#[test]
fn sliding_takes_travel_from_the_roll() {
    let slide = Slide::Velocity { velocity: 0.5 * PI / 12.0, rate: PI / 12.0 };
    let joint = joint(
        description(ellipse(2.0, 1.0, None), ellipse(1.0, 1.0, None), slide),
        RollingCoordinate::Turning,
    )
    .unwrap();
    let (contact, angle, _) = at(&joint, PI / 6.0);
    assert!((contact.travel[0] - 1.305_506_584_7).abs() < 1e-10);
    assert!(((contact.parameters[1][0] - FRAC_PI_2).to_degrees() - 74.800_017_434).abs() < 1e-9);
    assert!((angle.to_degrees() - 104.800_017_434).abs() < 1e-9);
    // Pure sliding for an instant where the radius of the child is v_r/ω.
    let (contact, ..) = at(&joint, FRAC_PI_2);
    assert!(contact.rates[0].abs() < 1e-12 && (contact.rates[1] - 0.5).abs() < 1e-12);
}

/// Example 3.1.3, case 1: on the outside and in a half bowl.
#[test]
fn a_bowl_turns_the_other_way_and_ends() {
    let outside = joint(
        description(ellipse(2.0, 1.0, None), ellipse(2.5, 1.0, None), Slide::None),
        RollingCoordinate::Turning,
    )
    .unwrap();
    let (contact, angle, position) = at(&outside, FRAC_PI_2);
    assert!(((contact.parameters[1][0] - FRAC_PI_2).to_degrees() - 66.848_561_540).abs() < 1e-8);
    assert!((angle.to_degrees() - 133.090_082_098).abs() < 1e-8);
    assert!((position.norm() - 4.107_100_566_7).abs() < 1e-9);
    let bowl = Description {
        concave: true,
        start: Some([-FRAC_PI_2, -FRAC_PI_2]),
        ..description(ellipse(2.0, 1.0, None), ellipse(2.5, 1.0, Some([-PI, 0.0])), Slide::None)
    };
    let inside = joint(bowl, RollingCoordinate::Turning).unwrap();
    let (_, angle, position) = at(&inside, FRAC_PI_2);
    assert!((angle.to_degrees() - 46.909_917_902).abs() < 1e-8);
    assert!((position.norm() - 1.417_274_499_3).abs() < 1e-9);
    let range = inside.range().unwrap();
    assert!((range[0] + range[1]).abs() < 1e-9, "{range:?}");
    // The arcs end before the child gets through, but the tip of the bowl is too narrow for its flank.
    for (q, fits) in [(FRAC_PI_2, true), (range[1] * (1.0 - 1e-12), false)] {
        let (contact, ..) = at(&inside, q);
        assert_eq!(contact.fits, fits);
        assert!(
            fits || contact.parameters[1][0].abs() < 1e-9 || (contact.parameters[1][0] + PI).abs() < 1e-9
        );
    }
    assert!(inside.pose(&inside.configuration(&[range[1] + 1e-6])).position.x.is_nan());
}

/// Case 2(b): concentric circles leave the contact open, unless they only slide.
#[test]
fn a_hollow_that_is_too_narrow_is_refused() {
    let of = |radius: f64, slide: Slide| Description {
        concave: true,
        start: Some([-FRAC_PI_2, -FRAC_PI_2]),
        ..description(ellipse(1.0, 1.0, None), ellipse(radius, radius, None), slide)
    };
    for radius in [0.8, 1.0] {
        let error = joint(of(radius, Slide::None), RollingCoordinate::Turning).unwrap_err();
        assert!(matches!(error, ContactError::TooCurved { .. }), "{error}");
    }
    let socket = joint(of(1.0, Slide::Pure), RollingCoordinate::Turning).unwrap();
    let (_, angle, position) = at(&socket, 0.7);
    assert!((angle - 0.7).abs() < 1e-12 && position.norm() < 1e-12);
    assert!(joint(of(1.2, Slide::None), RollingCoordinate::Turning).is_ok());
}

/// The thesis's explicit recipe converges to the exact arc with the first order.
#[test]
fn the_explicit_recipe_is_of_first_order() {
    let psi = |step: f64| {
        let slide = Slide::Stepped { step };
        let joint = joint(
            description(ellipse(2.0, 1.0, None), ellipse(1.0, 1.0, None), slide),
            RollingCoordinate::Turning,
        )
        .unwrap();
        let (contact, ..) = at(&joint, FRAC_PI_2);
        (-FRAC_PI_2 - contact.parameters[0][0]).to_degrees()
    };
    assert!((psi(PI / 12.0) - 98.532).abs() < 5e-4, "{}", psi(PI / 12.0));
    let (coarse, fine) = (psi(PI / 240.0) - 90.0, psi(PI / 480.0) - 90.0);
    assert!((coarse / fine - 2.0).abs() < 0.05, "{coarse} {fine}");
}

fn examples() -> Vec<(Description, RollingCoordinate, f64)> {
    let on = |slide| description(ellipse(2.0, 1.0, None), ellipse(1.5, 1.2, None), slide);
    let hollow = Description {
        concave: true,
        start: Some([-FRAC_PI_2, -1.3]),
        ..description(ellipse(1.0, 0.8, None), ellipse(2.5, 2.0, None), Slide::Ratio { ratio: 1.7 })
    };
    let wheel = Description {
        start: Some([-FRAC_PI_2, 0.1]),
        ..description(ellipse(0.5, 0.5, None), floor(), Slide::None)
    };
    let lobes = Boundary {
        curve: BoundaryCurve::Expression {
            position: [
                flexura_expression::Function::parse("(1+0.1*cos(2*t))*cos(t)", "t").unwrap(),
                flexura_expression::Function::parse("(1+0.1*cos(2*t))*sin(t)", "t").unwrap(),
            ],
            range: [0.0, TAU],
            closed: true,
        },
        outside: None,
    };
    let table = vec![[-1.0, -0.2], [0.0, 0.0], [0.5, 0.2], [1.0, 0.15]];
    let plank = Description {
        start: Some([0.2, FRAC_PI_2]),
        ..description(floor(), ellipse(1.0, 0.7, None), Slide::None)
    };
    vec![
        (on(Slide::None), RollingCoordinate::Turning, 0.7),
        (on(Slide::None), RollingCoordinate::Angle, -0.9),
        (on(Slide::Velocity { velocity: 0.3, rate: 1.0 }), RollingCoordinate::Angle, 0.8),
        (on(Slide::Function(function("0.2*q+0.1*q^3"))), RollingCoordinate::Angle, 0.8),
        (on(Slide::Function(function("0.2*sin(q)"))), RollingCoordinate::Arc, 1.1),
        (on(Slide::Table(table)), RollingCoordinate::Turning, 0.3),
        (
            on(Slide::Measured { roll: function("q-q^2"), slide: function("q^2") }),
            RollingCoordinate::Angle,
            0.4,
        ),
        (hollow, RollingCoordinate::Angle, 0.6),
        (wheel, RollingCoordinate::Turning, 5.0),
        (plank.clone(), RollingCoordinate::Arc, 0.4),
        (plank, RollingCoordinate::Angle, 0.4),
        (description(lobes, ellipse(1.5, 1.2, None), Slide::None), RollingCoordinate::Turning, 1.2),
    ]
}

#[test]
fn subspace_and_its_change_are_derivatives() {
    for (description, coordinate, q) in examples() {
        let joint = joint(description.clone(), coordinate).unwrap();
        let here = joint.configuration(&[q]);
        let h = 1e-5;
        let moved = |x: f64| joint.moved(&here, &[x]);
        let (plus, minus) = (joint.pose(&moved(h)), joint.pose(&moved(-h)));
        let column = joint.subspace(&here, 0);
        let turning = log(&(plus.rotation * minus.rotation.inverse())) / (2.0 * h);
        let shift = (plus.position - minus.position) / (2.0 * h);
        assert!((turning - column.angular).norm() < 2e-9, "{coordinate:?} {description:?}");
        assert!((shift - column.linear).norm() < 2e-9, "{coordinate:?} {description:?}");
        let (plus, minus) = (joint.subspace(&moved(h), 0), joint.subspace(&moved(-h), 0));
        let change = joint.subspace_change(&here, 0, 0);
        assert!(
            ((plus.angular - minus.angular) / (2.0 * h) - change.angular).norm() < 5e-9,
            "{description:?}"
        );
        assert!(((plus.linear - minus.linear) / (2.0 * h) - change.linear).norm() < 5e-9, "{description:?}");
    }
}

/// The contact is one point for both, its normal is common, and the child's point there moves by the slide alone.
#[test]
fn the_boundaries_touch_and_slip_as_they_are_told() {
    for (description, coordinate, q) in examples() {
        let joint = joint(description, coordinate).unwrap();
        let here = joint.configuration(&[q]);
        let (pose, contact) = (joint.pose(&here), joint.contact(&here).unwrap());
        let point = pose.point(&contact.points[0]);
        assert!((point - contact.points[1]).norm() < 1e-12);
        let column = joint.subspace(&here, 0);
        let velocity = column.linear + column.angular.cross(&(point - pose.position));
        assert!((velocity + contact.direction * contact.rates[1]).norm() < 1e-12);
        // Turned by its own angle the child's normal is against the parent's.
        let ahead = joint.contact(&joint.configuration(&[q + 1e-6])).unwrap();
        assert!((ahead.points[1] - contact.points[1]).dot(&contact.normal).abs() < 1e-11);
    }
}

#[test]
fn a_coordinate_is_what_its_name_says() {
    for (description, coordinate, q) in examples() {
        let measured = matches!(description.slide, Slide::Measured { .. });
        let joint = joint(description, coordinate).unwrap();
        let [start, here] = [0.0, q].map(|q| joint.configuration(&[q]));
        let turn = log(&(joint.pose(&here).rotation * joint.pose(&start).rotation.inverse())).z;
        let contact = joint.contact(&here).unwrap();
        match coordinate {
            RollingCoordinate::Angle if !measured => assert!((turn - q).abs() < 1e-12),
            RollingCoordinate::Arc => assert!((contact.travel[0] + contact.travel[1] - q).abs() < 1e-12),
            _ => {}
        }
        let nearest = joint.nearest(&joint.pose(&here));
        let again = joint.pose(&nearest);
        let back = (again.position - joint.pose(&here).position).norm();
        assert!(measured || back < 1e-9 || q.abs() > PI, "{coordinate:?} {q}: {nearest:?}");
    }
}

/// A rough pose above the contact: the place is found, and the child's angle is kept.
#[test]
fn the_first_contact_is_found_from_a_rough_pose() {
    let find = |parent: Boundary, position: Vector3<f64>, angle: f64, concave: bool| {
        let mut law = JointLaw::free(JointKind::Rolling(RollingCoordinate::Angle), Vector3::z());
        law.second_axis = Vector3::x();
        let contact =
            Description { start: None, concave, ..description(ellipse(2.0, 1.0, None), parent, Slide::None) };
        law.contact = Some(Box::new(Contact::Rolling(contact)));
        let pose = Pose::new(exp(&(Vector3::z() * angle)), position);
        let joint = Joint::new(&law, 1.0, &pose).unwrap();
        let found = joint.pose(&joint.nearest(&pose));
        (joint.contact(&joint.home()).unwrap(), found)
    };
    for angle in [0.0, 0.4, -1.2, 2.0] {
        let (contact, pose) = find(ellipse(1.0, 1.0, None), Vector3::new(1.0, 3.5, 0.0), angle, false);
        assert!((log(&pose.rotation).z - angle).abs() < 1e-12);
        assert!((contact.points[1].norm() - 1.0).abs() < 1e-12);
        // The gap is along the common normal.
        let gap = Vector3::new(1.0, 3.5, 0.0) - pose.position;
        assert!(gap.cross(&contact.normal).norm() < 1e-10 && gap.dot(&contact.normal) > 0.0);
        let (_, pose) = find(floor(), Vector3::new(-4.0, 3.0, 0.0), angle, false);
        assert!((log(&pose.rotation).z - angle).abs() < 1e-12);
        let (contact, _) = find(ellipse(6.0, 5.0, None), Vector3::new(0.0, -3.8, 0.0), 0.2, true);
        assert!(contact.normal.y > 0.9);
    }
}

#[test]
fn nonsense_is_refused() {
    let on = |slide| description(ellipse(2.0, 1.0, None), ellipse(1.5, 1.2, None), slide);
    let error = |description, coordinate| joint(description, coordinate).unwrap_err();
    let turning = RollingCoordinate::Turning;
    assert!(matches!(
        error(description(ellipse(2.0, 0.0, None), floor(), Slide::None), turning),
        ContactError::Boundary { which: "child", .. }
    ));
    assert_eq!(error(description(floor(), floor(), Slide::None), turning), ContactError::BothStraight);
    assert_eq!(
        error(description(floor(), ellipse(1.0, 1.0, None), Slide::None), turning),
        ContactError::NotConvex
    );
    assert_eq!(
        error(on(Slide::Velocity { velocity: 1.0, rate: 1.0 }), RollingCoordinate::Arc),
        ContactError::VelocityByArc
    );
    assert!(matches!(
        error(on(Slide::Function(function("1+q"))), turning),
        ContactError::TravelAtZero { which: "slide", .. }
    ));
    assert_eq!(error(on(Slide::Table(vec![[0.0, 0.0], [0.0, 1.0]])), turning), ContactError::SlideTable);
    let outside = Description {
        start: Some([0.0, 2.0]),
        ..description(ellipse(2.0, 1.0, None), ellipse(1.0, 1.0, Some([0.0, 1.0])), Slide::None)
    };
    assert!(matches!(error(outside, turning), ContactError::StartOutside { which: "parent", .. }));
}
