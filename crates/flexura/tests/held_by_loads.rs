//! Mechanisms that have no stiffness at rest: what their loads, weights and preloads hold is found all the same.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, check, solve};

fn solved(text: &str, overrides: &[(&str, &str)]) -> Solution {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}"));
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}"));
    let solution = solve(&model, &Options::default(), &mut |_| {}).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert_ne!(solution.stable, Some(false), "{:?}", solution.unstable_directions);
    solution
}

fn refused(text: &str) -> String {
    let model = Document::parse(text, "model.toml").unwrap().model(&[]).unwrap();
    let solved = solve(&model, &Options::default(), &mut |_| {}).map(|solution| solution.status);
    let error = solved.expect_err("nothing holds it");
    assert_eq!(check(&model).expect_err("nothing holds it"), error, "`check` and `solve` say the same");
    error.to_string()
}

const WEIGHT: &str = r#"
format = 1
[parameter]
start = "-0.52 m"
gravity = "-9.81 m/s^2"
[body.w]
at = [0, 0, "start"]
mass = "1 kg"
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = [0, 0, "start"] }
child = "w"
axis = [0, 0, 1]
[spring.lig]
from = { body = "ground" }
to = { body = "w" }
rest_length = "0.5 m"
"#;

/// T = K (ε - ε_t/2) beyond the toe: ε = m g/K + ε_t/2, wherever the weight is let go, slack or taut.
#[test]
fn a_weight_hangs_on_a_ligament_that_is_slack_or_taut_at_first() {
    let text = format!(
        "gravity = [0, 0, \"gravity\"]\n{WEIGHT}law = \"toe\"\naxial_stiffness = \"500 N\"\ntoe_strain = 0.02\n"
    )
    .replace("\nformat = 1", "");
    let text = format!("format = 1\n{text}");
    for start in ["-0.52 m", "-0.5 m", "-0.45 m"] {
        let strain = solved(&text, &[("start", start)]).springs[0].strain.unwrap();
        assert!((strain - (9.81 / 500.0 + 0.01)).abs() < 1e-9, "from {start}: {strain}");
    }
}

/// A string of 1 kN/m under 9.81 N is 9.81 mm longer than relaxed.
#[test]
fn a_weight_hangs_on_a_string_that_only_pulls() {
    let text = format!(
        "format = 1\ngravity = [0, 0, \"gravity\"]\n{}stiffness = \"1000 N/m\"\ntension_only = true\n",
        WEIGHT.replace("\nformat = 1", "")
    );
    for start in ["-0.52 m", "-0.48 m"] {
        let length = solved(&text, &[("start", start)]).springs[0].length;
        assert!((length - 0.50981).abs() < 1e-9, "from {start}: {length}");
    }
}

/// Two relaxed springs in line resist nothing across the line at first. The place is where the potential energy
/// ½ Σ k (ℓ - 0.1 m)² - F·x is least, found by Newton's method in the plane from the side to which the force points.
#[test]
fn two_springs_in_line_hold_a_force_across() {
    let at = |x: f64| {
        format!(
            r#"
format = 1
[body.node]
at = [{x}, 0, 0]
[joint.plane]
kind = "planar"
parent = {{ body = "ground", at = [{x}, 0, 0] }}
child = "node"
axis = [0, 0, 1]
angle = {{ coordinate = 0 }}
[spring.one]
from = {{ body = "ground", at = [0, 0.1, 0] }}
to = {{ body = "node" }}
rest_length = 0.1
stiffness = 800
[spring.two]
from = {{ body = "ground", at = [0, -0.1, 0] }}
to = {{ body = "node" }}
rest_length = 0.1
stiffness = 100
[load.f]
body = "node"
force = [5, 5, 0]
"#
        )
    };
    let [x, y] = least_energy([0.09, 0.04]);
    assert!((x - 0.086_321).abs() < 1e-6 && (y - 0.045_319).abs() < 1e-6, "{x} {y}");
    // Exactly in line, and a tenth of a micrometre beside.
    for beside in [0.0, 1e-7, -1e-7] {
        let position = solved(&at(beside), &[]).bodies[0].position;
        assert!((position.x - x).abs() < 1e-8 && (position.y - y).abs() < 1e-8, "{beside}: {position:?}");
    }
}

fn least_energy(start: [f64; 2]) -> [f64; 2] {
    let slope = |p: [f64; 2]| {
        let mut g = [-5.0, -5.0];
        for (k, end) in [(800.0, 0.1), (100.0, -0.1)] {
            let d = [p[0], p[1] - end];
            let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
            for i in 0..2 {
                g[i] += k * (length - 0.1) * d[i] / length;
            }
        }
        g
    };
    let mut p = start;
    for _ in 0..50 {
        let (g, h) = (slope(p), 1e-7);
        let (a, b) = (slope([p[0] + h, p[1]]), slope([p[0], p[1] + h]));
        let m = [[(a[0] - g[0]) / h, (b[0] - g[0]) / h], [(a[1] - g[1]) / h, (b[1] - g[1]) / h]];
        let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        p[0] -= (m[1][1] * g[0] - m[0][1] * g[1]) / det;
        p[1] -= (m[0][0] * g[1] - m[1][0] * g[0]) / det;
    }
    p
}

/// tan α = F/(m g), about the pivot: from hanging, from the side, and from upside down, where the weight stands on its head at rest.
#[test]
fn a_pendulum_hangs_in_the_wind() {
    for (x, y) in [(0.0, -0.4), (0.4, 0.0), (0.3, -0.2), (0.0, 0.4), (-0.1, 0.38)] {
        for wind in [5.0, 0.0, -40.0] {
            let text = format!(
                r#"
format = 1
gravity = [0, "-9.81 m/s^2", 0]
[body.bob]
at = [{x}, {y}, 0]
mass = "1.5 kg"
[joint.pivot]
kind = "revolute"
parent = "ground"
child = {{ body = "bob", at = [{}, {}, 0] }}
axis = [0, 0, 1]
[load.wind]
body = "bob"
force = [{wind}, 0, 0]
"#,
                -x, -y
            );
            let bob = solved(&text, &[]).bodies[0].position;
            let (weight, length) = (1.5 * 9.81, f64::hypot(x, y));
            let whole = f64::hypot(wind, weight);
            let wanted = [length * wind / whole, -length * weight / whole];
            let off = f64::hypot(bob.x - wanted[0], bob.y - wanted[1]);
            assert!(off < 1e-7, "from {x}, {y} in {wind} N: {bob:?}, not {wanted:?}");
        }
    }
}

/// A spring of 10 N between the ground, 20 mm above the arm's end, and the arm of 60 mm centres it. Balance about the pivot with
/// the arm turned by α: F a cos α = T (moment arm), by bisection.
#[test]
fn a_stretched_spring_centres_an_arm() {
    let text = r#"
format = 1
[body.arm]
[joint.pivot]
kind = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
[spring.s]
from = { body = "ground", at = [0, "80 mm", 0] }
to = { body = "arm", at = [0, "60 mm", 0] }
rest_length = "10 mm"
stiffness = "1 N/mm"
[load.push]
body = "arm"
at = [0, "60 mm", 0]
force = ["0.1 N", 0, 0]
"#;
    let moment = |angle: f64| {
        let (x, y) = (-0.06 * angle.sin(), 0.06 * angle.cos());
        let (dx, dy) = (-x, 0.08 - y);
        let length = f64::hypot(dx, dy);
        let tension = 1000.0 * (length - 0.01);
        let pull = [tension * dx / length + 0.1, tension * dy / length];
        x * pull[1] - y * pull[0]
    };
    let (mut low, mut high) = (-0.1, 0.1);
    assert!(moment(low) * moment(high) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if moment(low) * moment(middle) > 0.0 { low = middle } else { high = middle }
    }
    let angle = solved(text, &[]).joints[0].coordinates[0];
    assert!((angle - low).abs() < 1e-9, "{angle}, not {low}");
}

/// Two links under a weight and a wind: each hangs along what pulls below it.
#[test]
fn a_chain_of_rigid_links_hangs() {
    let text = r#"
format = 1
gravity = [0, 0, "-9.81 m/s^2"]
[body.upper]
at = [0.1, 0, 0]
mass = "1 kg"
[body.lower]
at = [0.3, 0, 0]
mass = "2 kg"
[joint.top]
kind = "revolute"
parent = "ground"
child = { body = "upper", at = [-0.1, 0, 0] }
axis = [0, 1, 0]
[joint.middle]
kind = "revolute"
parent = { body = "upper", at = [0.1, 0, 0] }
child = { body = "lower", at = [-0.1, 0, 0] }
axis = [0, 1, 0]
[load.wind]
body = "lower"
at = [0.1, 0, 0]
force = ["3 N", 0, 0]
"#;
    let solution = solved(text, &[]);
    let along = |i: usize| solution.bodies[i].rotation * flexura::spatial::Vector3::x();
    // Moment of each link about its upper joint: weights act in the middle, what is below at the end.
    let lower = f64::atan2(3.0, 0.5 * 2.0 * 9.81);
    let upper = f64::atan2(3.0, (0.5 * 1.0 + 2.0) * 9.81);
    for (i, angle) in [(0, upper), (1, lower)] {
        let wanted = flexura::spatial::Vector3::new(angle.sin(), 0.0, -angle.cos());
        assert!((along(i) - wanted).norm() < 1e-7, "link {i}: {:?}, not {wanted:?}", along(i));
    }
}

/// What nothing holds is named, with and without a load, and what stands firmly beside it is not.
#[test]
fn what_nothing_holds_is_named() {
    let loop_on_a_body = r#"
format = 1
[section.a]
shape = "stiffness"
EA = 1e6
GJ = 1
EI2 = 1
EI3 = 2
[body.b]
at = [1, 0, 0]
[beam.loop]
section = "a"
curve = { kind = "arc", radius = 0.3, angle = 3 }
start = { body = "b", hold = "clamp" }
end = { body = "b", hold = "clamp" }
[beam.r]
section = "a"
curve = { kind = "arc", radius = 0.6, angle = 1.5 }
start = { body = "ground", hold = "clamp" }
end = { body = "b", hold = "free", z = { stiffness = 1 } }
"#;
    for load in ["", "[load.l]\nbody = \"b\"\nforce = [0.1, 0, 0]\n"] {
        let message = refused(&format!("{loop_on_a_body}{load}"));
        assert!(message.contains("can move without resistance") && message.contains("body.b"), "{message}");
    }
    let slider = WEIGHT
        .split("[spring")
        .next()
        .unwrap()
        .replace("format = 1", "format = 1\ngravity = [0, 0, \"gravity\"]");
    let message = refused(&slider);
    assert!(message.contains("joint.way"), "{message}");
}
