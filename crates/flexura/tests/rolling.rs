//! Rolling and contact joints in mechanisms: work, energy, invariance, lift-off, and what is refused.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Equilibrium, Options, solve};
use support::{bundled, run};

fn model(text: &str) -> flexura::model::Model {
    match Document::parse(text, "model.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(report) => panic!("{report}\n{text}"),
    }
}

fn solved(text: &str) -> Solution {
    let options = Options { samples: 5, tolerance: 1e-12, ..Options::default() };
    let solution = solve(&model(text), &options, &mut |_| {})
        .unwrap_or_else(|e| panic!("{}: {}\n{text}", e.path, e.message));
    assert_eq!(solution.status, Status::Converged, "{:?}\n{text}", solution.reason);
    solution
}

fn refused(text: &str) -> String {
    match Equilibrium::new(&model(text)) {
        Err(error) => format!("{}: {} ({})", error.path, error.message, error.hint),
        Ok(_) => panic!("not refused\n{text}"),
    }
}

/// An ellipse with an eccentric mass and a spring to a fixed point, that rolls on another one; `place` puts all of it in space.
fn rocker(angle: f64, slide: &str, place: &str) -> String {
    format!(
        r#"
format = 1
gravity = [0, -9.81, 0]
[body.base]
{place}
[joint.fix]
kind = "weld"
parent = {{ body = "ground", {placed} }}
child = "base"
[body.rocker]
{place}
mass = 1.3
center_of_mass = [0.1, -0.2, 0.05]
[joint.roll]
kind = "rolling"
parent = "base"
child = "rocker"
child_curve = {{ kind = "ellipse", semi_axes = [0.4, 0.25] }}
parent_curve = {{ kind = "ellipse", semi_axes = [0.7, 0.5] }}
start = ["-90 deg", "90 deg"]
coordinate = {angle}
close = true
{slide}
[spring.tie]
from = {{ body = "base", at = [0.9, 0.3, 0.1] }}
to = {{ body = "rocker", at = [0.2, 0.1, 0] }}
stiffness = 12
rest_length = 0.4
"#,
        placed = place.replace('\n', ", "),
    )
}

const HERE: &str = "at = [0, 0, 0]";

/// Potential of weight and spring.
fn potential(solution: &Solution) -> f64 {
    let centre = solution.bodies[1].point(&flexura::spatial::Vector3::new(0.1, -0.2, 0.05));
    let tie = &solution.springs[0];
    1.3 * 9.81 * centre.y + 0.5 * 12.0 * (tie.length - 0.4).powi(2)
}

/// The contact does no work, slipping or not: what drives the angle is the slope of the potential.
#[test]
fn the_effort_is_the_slope_of_the_potential() {
    for slide in [
        "",
        "slide = { kind = \"ratio\", ratio = 2 }",
        "slide = { kind = \"law\", slide = \"0.05 m*sin(q)\" }",
    ] {
        for angle in [-0.8, 0.3, 1.1, 2.0] {
            let h = 1e-3;
            let at = |x: f64| potential(&solved(&rocker(angle + x, slide, HERE)));
            let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            let effort = solved(&rocker(angle, slide, HERE)).joints[1].efforts[0];
            assert!((effort - slope).abs() < 1e-9, "{slide} {angle}: {effort} {slope}");
        }
    }
}

/// Around the parent and back: the work of the drive over a closed path of the coordinate vanishes.
#[test]
fn no_work_is_left_on_a_closed_path() {
    // Both ellipses closed: forth and back over the same angles at Gauss points, and the difference of potentials between.
    let (from, to) = (-0.9, 1.4);
    let nodes = [
        (-0.906_179_845_938_664, 0.2369268850561891),
        (-0.5384693101056831, 0.4786286704993665),
        (0.0, 0.5688888888888889),
        (0.5384693101056831, 0.4786286704993665),
        (0.906_179_845_938_664, 0.2369268850561891),
    ];
    let panels = 8;
    let mut work = 0.0;
    for panel in 0..panels {
        let width = (to - from) / f64::from(panels);
        let middle = from + width * (f64::from(panel) + 0.5);
        for (x, weight) in nodes {
            let effort = solved(&rocker(middle + 0.5 * width * x, "", HERE)).joints[1].efforts[0];
            work += 0.5 * width * weight * effort;
        }
    }
    let gained = potential(&solved(&rocker(to, "", HERE))) - potential(&solved(&rocker(from, "", HERE)));
    assert!((work - gained).abs() < 1e-9, "{work} {gained}");
}

/// Turned and moved as a whole, gravity left out, the mechanism does the same in its own axes.
#[test]
fn a_turned_mechanism_does_the_same() {
    let plain = |text: String| text.replace("gravity = [0, -9.81, 0]", "");
    for slide in ["", "slide = { kind = \"pure\" }"] {
        let here = solved(&plain(rocker(0.7, slide, HERE)));
        for place in [
            "at = [1, 2, -3]\nrotation = { axis = [1, 2, 3], angle = \"70 deg\" }",
            "at = [0, 0.4, 0]\nrotation = { axis = [0, 0, 1], angle = \"140 deg\" }",
        ] {
            let there = solved(&plain(rocker(0.7, slide, place)));
            let relative = |s: &Solution| s.bodies[0].inverse() * s.bodies[1];
            let (a, b) = (relative(&here), relative(&there));
            assert!((a.position - b.position).norm() < 1e-11);
            assert!(a.rotation.angle_to(&b.rotation) < 1e-11);
            assert!((here.joints[1].efforts[0] - there.joints[1].efforts[0]).abs() < 1e-10);
            let (a, b) = (here.joints[1].contact.unwrap(), there.joints[1].contact.unwrap());
            assert!((a.force - b.force).abs() < 1e-10 && (a.travel[0] - b.travel[0]).abs() < 1e-12);
        }
    }
}

#[test]
fn a_contact_that_pulls_is_told() {
    let wheel = |force: f64| {
        format!(
            r#"
format = 1
[body.wheel]
at = [0, 0.02, 0]
[joint.roll]
kind = "rolling"
parent = "ground"
child = "wheel"
child_curve = {{ kind = "circle", radius = 0.02 }}
parent_curve = {{ kind = "line", normal = [0, 1] }}
stiffness = 1
[load.up]
body = "wheel"
force = [0.1, {force}, 0]
"#
        )
    };
    let pressed = solved(&wheel(-2.0));
    let contact = pressed.joints[0].contact.unwrap();
    assert!((contact.force - 2.0).abs() < 1e-12 && (contact.friction.x + 0.1).abs() < 1e-12);
    assert!(pressed.warnings.is_empty(), "{:?}", pressed.warnings);
    let lifted = solved(&wheel(2.0));
    assert!((lifted.joints[0].contact.unwrap().force + 2.0).abs() < 1e-12);
    assert!(lifted.warnings.iter().any(|warning| warning.contains("lift off")), "{:?}", lifted.warnings);
}

/// A ball in a dish, without friction: the force goes through both centres, and the ball hangs like a pendulum.
#[test]
fn a_ball_in_a_dish_is_a_pendulum() {
    let text = |pull: f64| {
        format!(
            r#"
format = 1
gravity = [0, 0, -10]
[body.ball]
at = [0, 0, -0.03]
mass = 0.2
[joint.dish]
kind = "contact"
parent = "ground"
child = "ball"
child_surface = {{ kind = "sphere", radius = 0.01 }}
parent_surface = {{ kind = "sphere", radius = 0.04 }}
concave = true
rotation = {{ stiffness = 0.01 }}
[spring.x]
from = {{ body = "ground", at = [10, 0, -0.03] }}
to = {{ body = "ball" }}
stiffness = 1e-4
[spring.y]
from = {{ body = "ground", at = [0, 10, -0.03] }}
to = {{ body = "ball" }}
stiffness = 1e-4
[load.pull]
body = "ball"
force = [{pull}, 0, 0]
"#
        )
    };
    for pull in [0.1, 0.7, 1.9] {
        let solution = solved(&text(pull));
        let centre = solution.bodies[0].position;
        assert!((centre.norm() - 0.03).abs() < 1e-12);
        // The soft springs carry at most 1e-4 times 30 mm.
        let tangent = -centre.x / centre.z;
        assert!((tangent - pull / 2.0).abs() < 1e-4, "{pull}: {tangent}");
        let contact = solution.joints[0].contact.unwrap();
        assert!(contact.friction.norm() < 1e-12 && (contact.force - 2.0f64.hypot(pull)).abs() < 1e-4);
        assert!(solution.joints[0].wrench.force.cross(&centre).norm() < 1e-13);
    }
}

#[test]
fn nonsense_gets_its_message() {
    let of = |child: &str, parent: &str, more: &str| {
        format!(
            "format = 1\n[body.wheel]\nat = [0, 0.03, 0]\n[joint.roll]\nkind = \"rolling\"\nparent = \"ground\"\nchild = \"wheel\"\n\
             child_curve = {child}\nparent_curve = {parent}\nstiffness = 1\n{more}\n"
        )
    };
    let circle = "{ kind = \"circle\", radius = 0.02 }";
    let floor = "{ kind = \"line\", normal = [0, 1] }";
    for (text, wanted) in [
        (of("{ kind = \"ellipse\", semi_axes = [0.02, 0] }", floor, ""), "semi-axis along y"),
        (
            of(
                "{ kind = \"expression\", x = \"sin(2*t)\", y = \"sin(t)\", range = [0, \"2*pi\"], closed = true }",
                floor,
                "",
            ),
            "crosses itself",
        ),
        (of(circle, floor, ""), "do not touch in the initial poses: they are 10.000000 mm apart"),
        (
            of(circle, "{ kind = \"circle\", radius = 0.01 }", "concave = true\nstart = [0, 0]"),
            "does not fit into it",
        ),
        (
            of(
                circle,
                "{ kind = \"line\", normal = [0, 1], range = [-0.01, 0.01] }",
                "close = true\ncoordinate = \"90 deg\"",
            )
            .replace("stiffness = 1\n", ""),
            "lies beyond the end",
        ),
        (
            of(circle, floor, "close = true\nslide = { kind = \"law\", slide = \"0.1 m + 0 m*q\" }"),
            "must be zero",
        ),
        (of(floor, floor, "close = true"), "both boundaries are straight lines"),
    ] {
        let message = refused(&text);
        assert!(message.starts_with("joint.roll") && message.contains(wanted), "{message}");
    }
    // What is apart is brought together on request.
    let closed = solved(&of(circle, floor, "close = true"));
    assert!((closed.bodies[0].position.y - 0.02).abs() < 1e-12);
}

#[test]
fn a_force_that_rolls_off_the_edge_stalls_there_and_says_so() {
    let text = r#"
format = 1
[body.wheel]
at = [0, 0.02, 0]
[joint.roll]
kind = "rolling"
parent = "ground"
child = "wheel"
child_curve = { kind = "circle", radius = 0.02 }
parent_curve = { kind = "line", normal = [0, 1], range = [-0.01, 0.01] }
stiffness = 0.01
[load.push]
body = "wheel"
force = [1, 0, 0]
"#;
    let solution = solve(&model(text), &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Stalled);
    let reason = solution.reason.unwrap();
    assert!(reason.contains("joint.roll") && reason.contains("boundaries ends"), "{reason}");
}

#[test]
fn a_path_that_comes_to_the_end_of_a_bowl_says_so() {
    let text = bundled("ellipse_in_bowl.toml", "parameter = \"turned\"\nrange = [\"0 deg\", \"150 deg\"]");
    let run = run(&text, &[], 1e-10);
    assert_eq!(run.trace.status, Status::Stalled);
    let branch = &run.trace.branches[0];
    // A quarter of the bowl's ellipse: see the case `ellipse_in_bowl`.
    let last = branch.points.last().unwrap().parameter.to_degrees();
    assert!((last - 131.837).abs() < 1e-2, "{last}");
    let end = format!("{:?}", branch.ends);
    assert!(end.contains("joint.roll") && end.contains("boundaries ends"), "{end}");
}

/// A travel in steps costs all of them at every place: as the step goes to nothing there is an end, and it is told.
#[test]
fn a_travel_in_steps_that_go_to_nothing_ends_and_says_where() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/explicit_recipe.toml");
    let document = flexura::modelfile::Document::read(file).unwrap();
    let rate = [("rate".to_string(), "1e-7 deg/s".to_string())];
    let refused = document.model(&rate).map(|model| flexura::Prepared::new(&model).map(|_| ()));
    let said = match refused {
        Err(report) => report.to_string(),
        Ok(Err(error)) => error.message,
        Ok(Ok(())) => String::new(),
    };
    assert!(said.contains("beyond the end of a boundary or of the slide law"), "{said}");
}
