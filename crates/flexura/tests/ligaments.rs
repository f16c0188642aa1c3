//! Ligaments in mechanisms: slack, printed and measured laws, and paths over what moves.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Equilibrium, Options, solve};
use flexura_testkit::roots::root;

fn model(text: &str) -> flexura::model::Model {
    match Document::parse(text, "model.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(report) => panic!("{report}\n{text}"),
    }
}

fn solved(text: &str) -> Solution {
    let options = Options { samples: 5, tolerance: 1e-12, ..Options::default() };
    let solution =
        solve(&model(text), &options, &mut |_| {}).unwrap_or_else(|e| panic!("{}\n{text}", e.message));
    assert_eq!(solution.status, Status::Converged, "{:?}\n{text}", solution.reason);
    solution
}

fn refused(text: &str) -> String {
    let options = Options::default();
    let error = match Equilibrium::new(&model(text)) {
        Err(error) => error,
        Ok(_) => match solve(&model(text), &options, &mut |_| {}) {
            Err(error) => error,
            Ok(solution) => panic!("{:?}", solution.status),
        },
    };
    format!("{}: {}", error.path, error.message)
}

/// Stiffness of what the point lies on: toes alone would leave it loose at rest.
const BED: f64 = 0.05;

/// A point that moves on a soft bed in a plane, pulled, held by bands in four directions that are just slack at rest.
fn cross(law: &str, force: [f64; 2]) -> String {
    let mut text = format!(
        r#"
format = 1
[body.point]
[joint.plane]
kind = "planar"
axis = [0, 0, 1]
parent = "ground"
child = "point"
x = {{ stiffness = {BED} }}
y = {{ stiffness = {BED} }}
angle = {{ stiffness = 1 }}
[load.pull]
body = "point"
force = [{}, {}, 0]
"#,
        force[0], force[1]
    );
    for (name, at) in [("east", [1, 0]), ("north", [0, 1]), ("west", [-1, 0]), ("south", [0, -1])] {
        text += &format!(
            "[spring.{name}]\n{law}\nfrom = {{ body = \"ground\", at = [{}, {}, 0] }}\nto = {{ body = \"point\" }}\n",
            at[0], at[1]
        );
    }
    text
}

const LAWS: [&str; 4] = [
    "stiffness = 2\ntension_only = true",
    "law = \"exponential\"\narea = 1\nexponent = 3\nstress = 0.5",
    "law = \"toe\"\naxial_stiffness = 2\ntoe_strain = 0.001",
    "law = \"table\"\nrows = [[0, 0], [0.1, 0.3], [0.3, 1]]",
];

/// The tension of those by its own formula.
fn tension(law: usize, strain: f64) -> f64 {
    if strain <= 0.0 {
        return 0.0;
    }
    match law {
        0 => 2.0 * strain,
        1 => 0.5 * ((3.0 * strain).exp() - 1.0) / (1.0 + strain),
        2 if strain < 1e-3 => 2.0 * strain * strain / 2e-3,
        2 => 2.0 * (strain - 5e-4),
        _ => {
            // Widths 0.1 and 0.2, chords 3 and 3.5: slopes (0.4·3 - 0.1·3.5)/0.3, 1.5/(... ) and straight on at the end.
            let inner = 0.9 / (0.5 / 3.0 + 0.4 / 3.5);
            let slopes = [(0.4 * 3.0 - 0.1 * 3.5) / 0.3, inner, (0.5 * 3.5 - 0.2 * 3.0) / 0.3];
            let (x, f) = ([0.0, 0.1, 0.3], [0.0, 0.3, 1.0]);
            if strain > 0.3 {
                return 1.0 + slopes[2] * (strain - 0.3);
            }
            let i = usize::from(strain > 0.1);
            let h = x[i + 1] - x[i];
            let t = (strain - x[i]) / h;
            // Hermite's basis.
            let (a, b) = (2.0 * t.powi(3) - 3.0 * t * t + 1.0, t.powi(3) - 2.0 * t * t + t);
            let (c, d) = (3.0 * t * t - 2.0 * t.powi(3), t.powi(3) - t * t);
            a * f[i] + b * h * slopes[i] + c * f[i + 1] + d * h * slopes[i + 1]
        }
    }
}

#[test]
fn bands_that_go_slack_leave_the_others_to_carry() {
    for (i, law) in LAWS.iter().enumerate() {
        for pull in [0.3, -0.7] {
            let solution = solved(&cross(law, [pull, 0.0]));
            // By symmetry it moves along x, away from one band and across two.
            let balance = |x: f64| {
                let across = x.hypot(1.0);
                let [east, west] = [tension(i, -x), tension(i, x)];
                west - east + 2.0 * tension(i, across - 1.0) * x / across + BED * x - pull
            };
            let x = root(balance, -1.0, 1.0).unwrap();
            let at = solution.bodies[0].position;
            assert!((at.x - x).abs() < 1e-10 && at.y.abs() < 1e-10, "{law} {pull}: {at:?} against {x}");
            let slack: Vec<bool> = solution.springs.iter().map(|spring| spring.is_slack).collect();
            assert_eq!(slack, [pull > 0.0, false, pull < 0.0, false], "{law}");
            assert_eq!(solution.unstable_directions, Some(0));
        }
    }
}

#[test]
fn a_slanting_pull_ends_in_balance_of_what_is_taut() {
    for (i, law) in LAWS.iter().enumerate() {
        for pull in [[0.3, 0.2], [-0.1, 0.6], [-0.5, -0.45]] {
            let solution = solved(&cross(law, pull));
            let at = solution.bodies[0].position;
            let mut sum = [pull[0] - BED * at.x, pull[1] - BED * at.y];
            for (from, spring) in
                [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].iter().zip(&solution.springs)
            {
                let (dx, dy) = (from[0] - at.x, from[1] - at.y);
                let length = dx.hypot(dy);
                let pulls = tension(i, length - 1.0);
                assert!((pulls - spring.tension).abs() < 1e-12, "{law} {pull:?}");
                sum[0] += pulls * dx / length;
                sum[1] += pulls * dy / length;
            }
            assert!(sum[0].hypot(sum[1]) < 1e-10, "{law} {pull:?}: {sum:?}");
        }
    }
}

/// A slider between a coil and a ligament whose rest length is given.
fn slider(law: &str, force: f64) -> String {
    format!(
        r#"
format = 1
[body.block]
at = [0.5, 0, 0]
[joint.way]
kind = "prismatic"
axis = [1, 0, 0]
parent = {{ body = "ground", at = [0.5, 0, 0] }}
child = "block"
stiffness = 4
[load.pull]
body = "block"
force = [{force}, 0, 0]
[spring.ligament]
{law}
from = {{ body = "ground" }}
to = {{ body = "block" }}
"#
    )
}

#[test]
fn a_ligament_that_is_too_long_at_the_start_is_slack_until_it_is_stretched() {
    let law = "law = \"exponential\"\narea = 1\nexponent = 3\nstress = 0.5\nrest_length = 0.6";
    let slack = solved(&slider(law, 0.3));
    assert!((slack.bodies[0].position.x - 0.575).abs() < 1e-12 && slack.springs[0].is_slack);
    assert!(slack.springs[0].tension == 0.0 && slack.springs[0].strain.unwrap() < 0.0);
    let taut = solved(&slider(law, 1.0));
    let x = root(|x| 4.0 * x + tension(1, (0.5 + x) / 0.6 - 1.0) - 1.0, 0.0, 1.0).unwrap();
    assert!((taut.bodies[0].position.x - 0.5 - x).abs() < 1e-11 && !taut.springs[0].is_slack);
}

#[test]
fn a_ligament_that_is_too_short_pulls_from_the_start() {
    let law = "law = \"toe\"\naxial_stiffness = 2\ntoe_strain = 0.001\nrest_length = 0.4";
    let solution = solved(&slider(law, 0.0));
    let x = root(|x| 4.0 * x + tension(2, (0.5 + x) / 0.4 - 1.0), -0.1, 0.0).unwrap();
    assert!((solution.bodies[0].position.x - 0.5 - x).abs() < 1e-11);
}

/// The jump of the printed law comes with the load, so that the state of rest is relaxed; where it is slack it is nothing.
#[test]
fn the_printed_law_starts_from_rest_and_jumps_at_slack() {
    let law = "law = \"exponential\"\nform = \"printed\"\narea = 1\nexponent = 3\nstress = 0.5";
    let stretched = solved(&slider(law, 1.0));
    let printed = |strain: f64| 0.5 * (3.0 * strain).exp() / (1.0 + strain);
    let x = root(|x| 4.0 * x + printed(2.0 * x) - 1.0, 0.0, 1.0).unwrap();
    assert!((stretched.bodies[0].position.x - 0.5 - x).abs() < 1e-11);
    assert!(stretched.warnings.iter().any(|w| w.contains("jumps from nothing to 0.5000 N")));
    let pushed = solved(&slider(law, -0.2));
    assert!((pushed.bodies[0].position.x - 0.45).abs() < 1e-12 && pushed.springs[0].tension == 0.0);
    // Stress on the area that is left.
    let spring = &stretched.springs[0];
    let stress = 0.5 * (3.0 * spring.strain.unwrap()).exp();
    assert!((spring.stress.unwrap() - stress).abs() < 1e-12);
}

#[test]
fn a_table_warns_where_it_is_left() {
    let law = "law = \"table\"\nrows = [[0, 0], [0.1, 0.3], [0.3, 1]]";
    let warned = |force| {
        let solution = solved(&slider(law, force));
        let x = root(|x| 4.0 * x + tension(3, x) - force, -1.0, 2.0).unwrap();
        assert!((solution.bodies[0].position.x - 0.5 - x).abs() < 1e-11);
        solution.warnings.iter().any(|w| w.contains("spring.ligament") && w.contains("beyond the last row"))
    };
    assert!(!warned(1.5) && warned(3.0));
}

/// A table without a relaxed row: T = 1 + 5 x, relaxed at -0.2; the load path starts there.
#[test]
fn a_table_that_pulls_at_its_rest_length_starts_relaxed() {
    let solution = solved(&slider("law = \"table\"\nrows = [[0, 1], [0.1, 1.5]]", 0.0));
    assert!((solution.bodies[0].position.x - 0.5 + 1.0 / 9.0).abs() < 1e-12);
    let refusal = refused(&slider("law = \"table\"\nrows = [[0, 1], [0.1, 1]]", 0.0));
    assert!(refusal.contains("spring.ligament.rows") && refusal.contains("vanishes nowhere"), "{refusal}");
}

/// At size s the same strain takes s² the force, with every law.
#[test]
fn a_larger_animal_takes_more_force_by_the_square_of_its_size() {
    let law = |i: usize| match i {
        0 => "stiffness = 3",
        1 => "law = \"exponential\"\narea = 1\nexponent = 3\nstress = 0.5",
        2 => "law = \"toe\"\naxial_stiffness = 2\ntoe_strain = 0.1",
        _ => "law = \"table\"\nrows = [[0, 0], [0.1, 0.3], [0.3, 1]]",
    };
    for i in 0..4 {
        let text = |size: f64| {
            let (at, to) = (0.5 * size, 0.62 * size - 0.5 * size);
            format!(
                r#"
format = 1
[body.block]
at = [{at}, 0, 0]
[joint.way]
kind = "prismatic"
axis = [1, 0, 0]
parent = {{ body = "ground", at = [{at}, 0, 0] }}
child = "block"
coordinate = {to}
[spring.ligament]
{}
size = {size}
rest_length = 0.48
from = {{ body = "ground" }}
to = {{ body = "block" }}
"#,
                law(i)
            )
        };
        let [one, more] = [1.0, 1.1].map(|size| solved(&text(size)).springs[0].clone());
        assert!((more.strain.unwrap() - one.strain.unwrap()).abs() < 1e-12, "{i}");
        assert!((more.tension / one.tension - 1.21).abs() < 1e-11, "{i}: {}", more.tension / one.tension);
    }
}

/// A pulley hangs in a band between two points: 2 T sin(half the contact) carries it. The path goes on beyond half a turn.
#[test]
fn a_pulley_hangs_in_a_band() {
    for weight in [0.5, 3.0] {
        let text = format!(
            r#"
format = 1
[body.pulley]
at = [0, 0.1, 0]
[joint.way]
kind = "prismatic"
axis = [0, 1, 0]
parent = {{ body = "ground", at = [0, 0.1, 0] }}
child = "pulley"
[load.weight]
body = "pulley"
force = [0, -{weight}, 0]
[spring.band]
stiffness = 4
from = {{ body = "ground", at = [-1, 0, 0] }}
to = {{ body = "ground", at = [1, 0, 0] }}
wrap = {{ body = "pulley", cylinder = 0.2, turn = "positive" }}
"#
        );
        let solution = solved(&text);
        let shape = |y: f64| {
            let distance = y.hypot(1.0);
            // From the left end about the centre, below, to the right end.
            let angle = std::f64::consts::PI - 2.0 * y.atan();
            let contact = angle - 2.0 * (0.2 / distance).acos();
            (2.0 * (distance * distance - 0.04).sqrt() + 0.2 * contact, contact)
        };
        let balance = |y: f64| {
            let (length, contact) = shape(y);
            8.0 * (length - shape(0.1).0) * (0.5 * contact).sin() - weight
        };
        let y = root(balance, -3.0, 0.1).unwrap();
        let pulley = solution.bodies[0].position;
        assert!((pulley.y - y).abs() < 1e-10, "{weight}: {} against {y}", pulley.y);
        let course = &solution.springs[0].course;
        let far = course.iter().map(|p| (p - pulley).norm()).fold(f64::INFINITY, f64::min);
        assert!((far - 0.2).abs() < 1e-12 && course.len() > 4);
        assert_eq!(solution.unstable_directions, Some(0));
    }
}

/// A lever stands upright between two tight bands that run over rods: E'' = 2 (k ℓ'² + T ℓ'') - P.
#[test]
fn a_lever_between_bands_over_rods_falls_at_its_critical_load() {
    let (k, rest) = (2.0, 0.9);
    let length = |turn: f64| {
        let (x, y) = (-turn.sin() + 0.35, turn.cos() - 0.6);
        let (a, b): ([f64; 2], [f64; 2]) = ([-0.25, -0.5], [x, y]);
        let (da, db) = (a[0].hypot(a[1]), b[0].hypot(b[1]));
        let angle = ((a[0] * b[0] + a[1] * b[1]) / (da * db)).acos();
        let r = 0.15;
        (da * da - r * r).sqrt() + (db * db - r * r).sqrt() + r * (angle - (r / da).acos() - (r / db).acos())
    };
    let h = 2e-2;
    let at = |i: f64| length(i * h);
    let slope = (0.8 * (at(1.0) - at(-1.0)) - 0.2 * (at(2.0) - at(-2.0))
        + 4.0 / 105.0 * (at(3.0) - at(-3.0))
        - (at(4.0) - at(-4.0)) / 280.0)
        / h;
    let bend = (1.6 * (at(1.0) + at(-1.0)) - 0.2 * (at(2.0) + at(-2.0)) + 8.0 / 315.0 * (at(3.0) + at(-3.0))
        - (at(4.0) + at(-4.0)) / 560.0
        - 205.0 / 72.0 * at(0.0))
        / (h * h);
    let critical = 2.0 * (k * slope * slope + k * (at(0.0) - rest) * bend);
    assert!(critical > 0.1, "{critical}");
    for (part, wanted) in [(0.5, 0), (0.9999, 0), (1.0001, 1), (1.5, 1)] {
        let mut text = format!(
            r#"
format = 1
[body.lever]
[joint.foot]
kind = "revolute"
axis = [0, 0, 1]
parent = "ground"
child = "lever"
[load.weight]
body = "lever"
at = [0, 1, 0]
force = [0, {}, 0]
"#,
            -part * critical
        );
        for (name, side) in [("left", -1.0), ("right", 1.0)] {
            text += &format!(
                r#"
[spring.{name}]
stiffness = {k}
rest_length = {rest}
from = {{ body = "ground", at = [{}, 0.1, 0] }}
to = {{ body = "lever", at = [0, 1, 0] }}
wrap = {{ body = "ground", at = [{}, 0.6, 0], cylinder = 0.15 }}
"#,
                0.6 * side,
                0.35 * side
            );
        }
        let solution = solved(&text);
        assert!(!solution.springs[0].course.is_empty(), "it does not touch");
        assert_eq!(solution.unstable_directions, Some(wanted), "{part} of {critical}");
    }
}

#[test]
fn ends_inside_or_opposite_and_springs_without_length_are_refused() {
    let over =
        |wrap: &str| refused(&slider(&format!("stiffness = 1\nwrap = {{ body = \"ground\", {wrap} }}"), 0.0));
    let inside = over("at = [0.4, 0, 0], sphere = 0.2");
    assert!(inside.contains("spring.ligament.to"), "{inside}");
    assert!(inside.contains("100.000000 mm") && inside.contains("0.200000 m"), "{inside}");
    let inside = over("at = [0, 0, 0.4], cylinder = 0.2");
    assert!(inside.contains("spring.ligament.from"), "{inside}");
    let opposite = over("at = [0.25, 0, 0], sphere = 0.1");
    assert!(opposite.contains("spring.ligament.wrap") && opposite.contains("opposite"), "{opposite}");
    let nothing = slider("stiffness = 1", 0.0)
        .replace("from = { body = \"ground\" }", "from = { body = \"ground\", at = [0.5, 0, 0] }");
    assert!(refused(&nothing).contains("has length zero"));
}

/// The block is driven into the sphere: the path ends at its surface.
#[test]
fn an_end_that_is_driven_into_the_obstacle_stops_the_path() {
    let text = slider("stiffness = 1\nwrap = { body = \"ground\", at = [0.9, 0.05, 0], sphere = 0.2 }", 0.0)
        .replace("stiffness = 4", "coordinate = 0.4");
    let solution = solve(&model(&text), &Options::default(), &mut |_| {}).unwrap();
    assert_ne!(solution.status, Status::Converged);
    assert!(solution.load_fraction > 0.3 && solution.load_fraction < 0.7, "{}", solution.load_fraction);
}

#[test]
fn what_slack_ligaments_or_toes_alone_hold_is_loose_as_long_as_nothing_pulls() {
    for law in [
        "stiffness = 4\ntension_only = true\nrest_length = 0.6",
        "law = \"toe\"\naxial_stiffness = 2\ntoe_strain = 0.1",
    ] {
        let text = slider(law, 0.0);
        let loose = text.replacen("stiffness = 4\n[load", "[load", 1);
        assert_ne!(loose, text);
        assert!(refused(&loose).contains("can move without resistance"), "{law}");
    }
}
