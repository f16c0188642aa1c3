//! The number of unstable directions where a closed form says it: columns, and rigid bodies on springs.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};
use flexura_testkit::columns::Ends;

fn solved(text: &str) -> Solution {
    let model = match Document::parse(text, "model.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(report) => panic!("{report}\n{text}"),
    };
    let options = Options { samples: 5, ..Options::default() };
    let solution = solve(&model, &options, &mut |_| {}).unwrap_or_else(|e| panic!("{}\n{text}", e.message));
    assert_eq!(solution.status, Status::Converged, "{:?}\n{text}", solution.reason);
    solution
}

fn count(text: &str) -> usize {
    let solution = solved(text);
    solution.unstable_directions.unwrap_or_else(|| panic!("{:?}\n{text}", solution.stability_reason))
}

const CLAMP: &str = "hold = \"clamp\"";
/// Of a pinned end all turnings are free but the one about the axis.
const CARDAN: &str = "hold = \"universal\", axis = [0, 1, 0], second_axis = [0, 0, 1]";
const WAY: &str = r#"
[joint.way]
kind = "prismatic"
axis = [1, 0, 0]
parent = { body = "ground", at = [1, 0, 0] }
child = "head"
"#;
/// The head may move across in one plane, too.
const SLIDE: &str = r#"
[joint.slide]
kind = "planar"
axis = [0, 1, 0]
angle = { coordinate = 0 }
parent = { body = "ground", at = [1, 0, 0] }
child = "head"
"#;

/// A column along x, 1 m long, with EI2 = 1 (it bends in xz) and another EI3, whose head is pushed back.
fn column(ei3: f64, joint: &str, start: &str, end: &str, push: f64) -> String {
    format!(
        r#"
format = 1
[section.rod]
shape = "stiffness"
EA = "inf"
GJ = 0.8
EI2 = 1
EI3 = {ei3}
[body.head]
at = [1, 0, 0]
{joint}
[beam.column]
section = "rod"
length = 1
extension = false
start = {{ body = "ground", {start} }}
end = {{ body = "head", {end} }}
[load.push]
body = "head"
force = [{}, 0, 0]
"#,
        -push
    )
}

#[test]
fn columns_lose_one_direction_at_every_load_of_euler() {
    let ends = [
        (Ends::ClampedFree, "", CLAMP, CLAMP),
        (Ends::PinnedPinned, WAY, CARDAN, CARDAN),
        (Ends::ClampedPinned, WAY, CLAMP, CARDAN),
        (Ends::ClampedClamped, WAY, CLAMP, CLAMP),
    ];
    let ei3 = 2.3;
    for (kind, joint, start, end) in ends {
        for push in [1.0, 2.4, 2.6, 9.8, 12.0, 20.1, 24.0, 39.0, 41.0, 59.0, 80.0, 95.0, 150.0, 300.0] {
            let wanted = kind.unstable(push) + kind.unstable(push / ei3);
            assert_eq!(count(&column(ei3, joint, start, end, push)), wanted, "{kind:?} under {push}");
        }
        assert_eq!(count(&column(ei3, joint, start, end, -200.0)), 0, "{kind:?}, pulled");
    }
}

#[test]
fn a_round_column_loses_two_at_once() {
    for push in [9.8, 9.95, 39.0, 40.0, 90.0] {
        let wanted = 2 * Ends::PinnedPinned.unstable(push);
        assert_eq!(count(&column(1.0, WAY, CARDAN, CARDAN, push)), wanted, "{push}");
    }
}

#[test]
fn a_head_that_moves_across_in_one_plane_lets_that_plane_sway() {
    for push in [9.0, 11.0, 25.0, 38.0, 45.0, 100.0] {
        let wanted = Ends::ClampedGuided.unstable(push) + Ends::ClampedClamped.unstable(push / 2.3);
        assert_eq!(count(&column(2.3, SLIDE, CLAMP, CLAMP, push)), wanted, "{push}");
    }
}

/// A column that stretches and shears, between pins. With θ the turning of its sections, y' = (1 - P/EA) θ + P θ/GA and EI θ' = -P y, so that
/// P (1 + P/GA - P/EA) takes the place of P; without stretch these are the loads of J. A. Haringx (S. P. Timoshenko and J. M. Gere,
/// *Theory of Elastic Stability*, 2nd ed., 1961, §2.18, helical springs).
#[test]
fn stretch_and_shear_shift_the_loads() {
    let (ea, ga) = (100.0, 40.0);
    for (push, wanted) in [(8.6, 0), (8.8, 1), (27.6, 1), (28.1, 2)] {
        let text = column(1e3, WAY, CARDAN, CARDAN, push)
            .replace("EA = \"inf\"", &format!("EA = {ea}\nGA2 = {ga}\nGA3 = {ga}"))
            .replace("extension = false", "shear = true");
        assert_eq!(Ends::PinnedPinned.unstable(push * (1.0 + push / ga - push / ea)), wanted);
        assert_eq!(count(&text), wanted, "{push}");
    }
}

/// A column under its own weight: q L³/EI = 7.8373 (A. G. Greenhill, *Proc. Camb. Phil. Soc.* 4 (1881) 65), then 55.98: the zeros of
/// J_{-1/3}(2/3 √(q L³/EI)), at 1.86635 and 4.98785.
#[test]
fn a_heavy_column_loses_its_stability_where_greenhill_says() {
    for (weight, wanted) in [(7.7, 0), (7.95, 1), (55.5, 1), (56.4, 2)] {
        let text = column(1e4, "", CLAMP, CLAMP, 0.0)
            .replace(
                "extension = false",
                &format!("extension = false\ndistributed = {{ force = [{}, 0, 0] }}", -weight),
            )
            .replace("[load.push]\nbody = \"head\"\nforce = [-0, 0, 0]\n", "");
        assert_eq!(count(&text), wanted, "{weight}");
    }
}

/// Bodies without beams: a bar of length 1 along z that stands on a joint.
fn bar(joint: &str, rest: &str) -> String {
    format!(
        "format = 1\n[body.bar]\nat = [0, 0, 0]\n[joint.foot]\nparent = \"ground\"\nchild = \"bar\"\n{joint}\n{rest}"
    )
}

fn dead(body: &str, push: f64) -> String {
    format!("[load.push_{body}]\nbody = \"{body}\"\nat = [0, 0, 1]\nforce = [0, 0, {}]\n", -push)
}

#[test]
fn an_inverted_pendulum_falls_where_its_load_overcomes_the_spring() {
    let foot = "kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 2";
    for (push, wanted) in [(-5.0, 0), (1.99, 0), (2.01, 1), (9.0, 1)] {
        assert_eq!(count(&bar(foot, &dead("bar", push))), wanted, "{push}");
    }
}

#[test]
fn each_axis_of_a_universal_joint_falls_by_itself() {
    let foot = "kind = \"universal\"\naxis = [0, 1, 0]\nsecond_axis = [1, 0, 0]\nfirst = { stiffness = 2 }\nsecond = { stiffness = 3 }";
    for (push, wanted) in [(1.9, 0), (2.1, 1), (2.9, 1), (3.1, 2)] {
        assert_eq!(count(&bar(foot, &dead("bar", push))), wanted, "{push}");
    }
}

#[test]
fn a_ball_joint_falls_about_two_axes_and_keeps_the_third() {
    let foot = "kind = \"spherical\"\nstiffness = 2";
    for (push, wanted) in [(1.9, 0), (2.1, 2)] {
        assert_eq!(count(&bar(foot, &dead("bar", push))), wanted, "{push}");
    }
}

/// Two bars, two springs k, lengths 1, a dead load: the energy's second derivatives [[2k - P, -k], [-k, k - P]] vanish at
/// P/k = (3 ∓ √5)/2. (H. Ziegler, *Principles of Structural Stability*, 1968, treats it beside the following load.)
#[test]
fn a_double_pendulum_falls_at_the_two_loads_of_its_energy() {
    for (push, wanted) in [(0.38, 0), (0.384, 1), (2.60, 1), (2.63, 2)] {
        let upper = r#"
[body.upper]
at = [0, 0, 1]
[joint.knee]
kind = "revolute"
axis = [0, 1, 0]
stiffness = 1
parent = { body = "bar", at = [0, 0, 1] }
child = "upper"
"#;
        let text = bar(
            "kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 1",
            &format!("{upper}{}", dead("upper", push)),
        );
        assert_eq!(count(&text), wanted, "{push}");
    }
}

/// A second pendulum whose angle is r times that of the first: k1 + r² k2 against P1 + r² P2.
#[test]
fn coupled_pendulums_fall_together() {
    let ratio = -1.5_f64;
    for factor in [0.99, 1.01] {
        let (k1, k2, p2) = (2.0, 0.7, 1.3);
        let p1 = factor * (k1 + ratio * ratio * k2) - ratio * ratio * p2;
        let other = format!(
            r#"
[body.other]
at = [3, 0, 0]
[joint.other_foot]
kind = "revolute"
axis = [0, 1, 0]
stiffness = {k2}
parent = {{ body = "ground", at = [3, 0, 0] }}
child = "other"
[coupling.mesh]
relation = "joint.other_foot.coordinate = {ratio}*joint.foot.coordinate"
"#
        );
        let foot = format!("kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = {k1}");
        let text = bar(&foot, &format!("{other}{}{}", dead("bar", p1), dead("other", p2)));
        // Its other directions are held by the joints and the coupling.
        assert_eq!(count(&text), usize::from(factor > 1.0), "{p1}");
    }
}

/// A parallelogram of four parallel hinges is held three times more often than needed. Both cranks carry half the load.
#[test]
fn a_parallelogram_of_redundant_hinges_falls_as_one_pendulum() {
    for (push, wanted) in [(1.98, 0), (2.02, 1)] {
        let rest = format!(
            r#"
[body.second]
at = [2, 0, 0]
[body.coupler]
at = [0, 0, 1]
[joint.second_foot]
kind = "revolute"
axis = [0, 1, 0]
parent = {{ body = "ground", at = [2, 0, 0] }}
child = "second"
[joint.left]
kind = "revolute"
axis = [0, 1, 0]
parent = {{ body = "bar", at = [0, 0, 1] }}
child = "coupler"
[joint.right]
kind = "revolute"
axis = [0, 1, 0]
parent = {{ body = "second", at = [0, 0, 1] }}
child = {{ body = "coupler", at = [2, 0, 0] }}
[load.push]
body = "coupler"
at = [0.7, 0, 0.4]
force = [0, 0, {}]
"#,
            -push
        );
        let text = bar("kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 2", &rest);
        assert_eq!(count(&text), wanted, "{push}");
    }
}

/// A cable under tension T from the top to a point d below the foot: T l d/(l + d) against the spring.
#[test]
fn a_cable_under_tension_pulls_a_bar_down_from_below_its_foot() {
    for (below, tension, wanted) in
        [(1.0, 3.9, 0), (1.0, 4.1, 1), (3.0, 2.6, 0), (3.0, 2.7, 1), (-0.5, 50.0, 0)]
    {
        let cable = format!(
            "[cable.stay]\ntension = {tension}\nroute = [{{ body = \"ground\", at = [0, 0, {}] }}, {{ body = \"bar\", at = [0, 0, 1] }}]\n",
            -below
        );
        let text = bar("kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 2", &cable);
        assert_eq!(count(&text), wanted, "{below} {tension}");
    }
}

/// Two bars whose tops a cable of given length keeps apart: they lean together, and the forces that keep it taut do no work.
#[test]
fn a_cable_of_given_length_makes_two_bars_one() {
    for (push, wanted) in [(1.98, 0), (2.02, 1)] {
        let rest = format!(
            r#"
[body.other]
at = [3, 0, 0]
[joint.other_foot]
kind = "revolute"
axis = [0, 1, 0]
stiffness = 1
parent = {{ body = "ground", at = [3, 0, 0] }}
child = "other"
[cable.rope]
length = 3
route = [{{ body = "bar", at = [0, 0, 1] }}, {{ body = "other", at = [0, 0, 1] }}]
[load.left]
body = "bar"
at = [0, 0, 1]
force = [-0.8, 0, {0}]
[load.right]
body = "other"
at = [0, 0, 1]
force = [0.8, 0, {0}]
"#,
            -push
        );
        // Stiffnesses 3 and 1 against twice the load.
        let text = bar("kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 3", &rest);
        assert_eq!(count(&text), wanted, "{push}");
    }
}

/// A point between two compressed springs on a line: k (1 - L0/b) of each across it, beside a weak spring of the carriage.
#[test]
fn a_point_between_compressed_springs_escapes_to_both_sides() {
    for (rest_length, wanted) in [(0.9, 0), (1.03, 0), (1.05, 1), (1.07, 2), (1.1, 2)] {
        let text = format!(
            r#"
format = 1
[body.point]
[joint.carriage]
kind = "free"
y = {{ stiffness = 0.4 }}
z = {{ stiffness = 0.6 }}
rotation = {{ stiffness = 1 }}
parent = "ground"
child = "point"
[spring.left]
stiffness = 5
rest_length = {rest_length}
from = {{ body = "ground", at = [-1, 0, 0] }}
to = {{ body = "point" }}
[spring.right]
stiffness = 5
rest_length = {rest_length}
from = {{ body = "ground", at = [1, 0, 0] }}
to = {{ body = "point" }}
"#
        );
        assert_eq!(count(&text), wanted, "{rest_length}");
    }
}

/// The bar leans on a stop: with the stop's stiffness it stands, as its angle shows.
#[test]
fn a_limit_that_pushes_back_holds_a_bar_that_would_fall() {
    let foot = |limits: &str| {
        format!("kind = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 1\neffort = 0.2\n{limits}")
    };
    let load = dead("bar", 1.5);
    let held = solved(&bar(&foot("limits = { range = [-0.1, 0.1], stiffness = 100 }"), &load));
    assert_eq!(held.unstable_directions, Some(0));
    // Without it the bar has fallen to where θ = 0.2 + 1.5 sin θ.
    let fallen = solved(&bar(&foot(""), &load));
    assert_eq!(fallen.unstable_directions, Some(0));
    assert!(fallen.bodies[0].rotation.angle() > 1.0 && held.bodies[0].rotation.angle() < 0.12);
}
