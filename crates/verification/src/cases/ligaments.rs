//! Ligaments: the forces of Table 4.3, the size of the animal, and paths around bones.

use crate::file::{Answer, File};
use crate::{Case, Row};
use flexura_testkit::roots::root;
use std::f64::consts::{FRAC_PI_2, PI};

pub const CASES: [Case; 5] = [
    Case {
        id: "ligament_projection",
        title: "Table 4.3: forces of the three ligaments under a pull of 10 mm, stretched by its projection on each",
        citation: "(4.15) as (4.12) has it, f = A0/(1 + ε) k2 exp(k1 ε), worked by hand",
        needed: "1e-6 N",
        run: projection,
        closed_form: None,
    },
    Case {
        id: "ligament_geometry",
        title: "`wing_ligaments.toml`: the same with the ends where they really go",
        citation: "distance of the displaced ends less that at rest, in the same law; effort of the drive by virtual work",
        needed: "1e-10",
        run: geometry,
        closed_form: None,
    },
    Case {
        id: "ligament_size",
        title: "`wing_ligaments.toml`: an animal 1.1 times as large, pulled 1.1 times as far",
        citation: "the same strain on s² the area: 21 % more force",
        needed: "1e-12",
        run: size,
        closed_form: None,
    },
    Case {
        id: "wrapped_paths",
        title: "Ligaments over a sphere and a cylinder: lengths, and the force on the bone",
        citation: "two tangents and an arc; the cylinder unrolled; 2 T sin(half the angle of contact)",
        needed: "1e-12",
        run: paths,
        closed_form: None,
    },
    Case {
        id: "wrapped_lever",
        title: "A lever held by a band over a cylinder, for the shorter way and beyond half a turn",
        citation: "moment balance with the band's tangent as lever arm, its one root by bracketing",
        needed: "1e-10",
        run: lever,
        closed_form: None,
    },
];

const K1: f64 = 9.4377;
/// N/mm².
const K2: f64 = 0.0025;
/// Vectors (mm) and areas (mm²) of Table 4.3.
const LIGAMENTS: [([f64; 3], f64); 3] =
    [([-7.23, 12.46, -19.02], 69.04), ([-7.8, 18.09, -5.46], 50.68), ([-3.59, 13.05, -0.77], 22.29)];
/// As printed: its length is 0.99998.
const PULL: [f64; 3] = [0.0, 0.5, -0.866];

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// One ligament on a slider that follows its own line, stretched by the projection of the pull.
fn slider([x, y, z]: [f64; 3], area: f64) -> String {
    let [u, v, w] = PULL;
    format!(
        r#"
format = 1
[parameter]
pull = "10 mm"
[body.end]
at = ["{x} mm", "{y} mm", "{z} mm"]
[joint.way]
kind = "prismatic"
parent = {{ body = "ground", at = ["{x} mm", "{y} mm", "{z} mm"] }}
child = "end"
axis = [{x}, {y}, {z}]
coordinate = "pull*({u}*({x}) + {v}*({y}) + {w}*({z}))/sqrt(({x})^2 + ({y})^2 + ({z})^2)"
[spring.ligament]
law = "exponential"
form = "printed"
area = "{area} mm^2"
exponent = {K1}
stress = "{K2} N/mm^2"
from = {{ body = "ground" }}
to = {{ body = "end" }}
[output]
tension = "spring.ligament.tension"
"#
    )
}

fn projection() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    let mut along = 0.0;
    for ((vector, area), (name, wanted)) in
        LIGAMENTS.into_iter().zip([("A", 5.317970), ("B", 2.137692), ("C", 1.608953)])
    {
        let answer = File::new(&slider(vector, area))?.solve(&[], 1e-12)?;
        let tension = answer.number("tension");
        rows.push(Row::absolute(format!("f_{name}, N"), wanted, tension, 1e-6));
        along += tension * vector[1] / norm(&vector);
    }
    rows.push(Row::absolute("F_c: sum of their y components, N", 6.217647, along, 1e-6));
    Ok(rows)
}

const WING: &str = include_str!("../../../../models/wing_ligaments.toml");

fn geometry() -> Result<Vec<Row>, String> {
    let file = File::new(WING)?;
    let mut rows = Vec::new();
    for pull in [10.0, 4.0] {
        let answer = file.solve(&[("pull", pull * 1e-3)], 1e-12)?;
        let mut effort = 0.0;
        for ((vector, area), name) in LIGAMENTS.into_iter().zip(["a", "b", "c"]) {
            let moved: [f64; 3] = std::array::from_fn(|i| vector[i] + pull * PULL[i]);
            let strain = norm(&moved) / norm(&vector) - 1.0;
            let force = area / (1.0 + strain) * K2 * (K1 * strain).exp();
            effort += force * dot(&moved, &PULL) / (norm(&moved) * norm(&PULL));
            let ours = answer.number(&format!("tension_{name}"));
            rows.push(Row::relative(format!("tension of {name}, pulled by {pull} mm"), force, ours, 1e-10));
            let ours = answer.number(&format!("strain_{name}"));
            rows.push(Row::absolute(format!("its strain, {name}"), strain, ours, 1e-10));
        }
        rows.push(Row::relative("effort of the manipulator", effort, answer.number("force"), 1e-10));
    }
    Ok(rows)
}

fn size() -> Result<Vec<Row>, String> {
    let file = File::new(WING)?;
    let [small, large] = [1.0, 1.1].map(|size| file.solve(&[("size", size)], 1e-12));
    let (small, large) = (small?, large?);
    let mut rows = Vec::new();
    for name in ["tension_a", "tension_b", "tension_c", "force"] {
        let ratio = large.number(name) / small.number(name);
        rows.push(Row::relative(format!("{name}, large over small"), 1.21, ratio, 1e-12));
    }
    for name in ["strain_c", "stress_c"] {
        rows.push(Row::relative(name, small.number(name), large.number(name), 1e-12));
    }
    Ok(rows)
}

/// A band of the tension 2 N, on a body, over an obstacle welded to the ground.
fn over(obstacle: &str, from: [f64; 3], to: [f64; 3]) -> Result<Answer, String> {
    let text = format!(
        r#"
format = 1
[body.end]
at = {to:?}
[body.bone]
[joint.bolt]
kind = "weld"
parent = "ground"
child = "bone"
[joint.held]
kind = "weld"
parent = {{ body = "ground", at = {to:?} }}
child = "end"
[spring.band]
stiffness = 10
rest_length = 0.8
tension_only = true
from = {{ body = "ground", at = {from:?} }}
to = {{ body = "end" }}
wrap = {{ body = "bone", {obstacle} }}
[output]
length = "spring.band.length"
tension = "spring.band.tension"
bone = "-joint.bolt.force"
bone_moment = "-joint.bolt.moment"
end = "-joint.held.force"
"#
    );
    File::new(&text)?.solve(&[], 1e-12)
}

/// Tangents, arc and the angle of contact in the plane.
fn planar(a: [f64; 2], b: [f64; 2], radius: f64, long: bool) -> (f64, f64) {
    let (da, db) = (a[0].hypot(a[1]), b[0].hypot(b[1]));
    let short = ((a[0] * b[0] + a[1] * b[1]) / (da * db)).acos();
    let angle = if long { 2.0 * PI - short } else { short };
    let contact = angle - (radius / da).acos() - (radius / db).acos();
    let tangents = (da * da - radius * radius).sqrt() + (db * db - radius * radius).sqrt();
    (tangents + radius * contact, contact)
}

fn paths() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    let (from, to, radius) = ([-0.7, 0.1, 0.0], [0.5, 0.2, 0.0], 0.3);
    let flat = |v: [f64; 3]| [v[0], v[1]];
    let mut push = |what: &str, length: f64, force: f64, answer: &Answer| {
        rows.push(Row::relative(format!("{what}: length"), length, answer.number("length"), 1e-12));
        let tension = 10.0 * (length - 0.8);
        rows.push(Row::relative("tension", tension, answer.number("tension"), 1e-12));
        let on_bone = norm(&answer.vector("bone"));
        rows.push(Row::relative("force on the bone", tension * force, on_bone, 1e-12));
        rows.push(Row::relative("force on the end", tension, norm(&answer.vector("end")), 1e-12));
    };
    let (length, contact) = planar(flat(from), flat(to), radius, false);
    let resultant = 2.0 * (0.5 * contact).sin();
    push("sphere", length, resultant, &over("sphere = 0.3", from, to)?);
    let (long, far) = planar(flat(from), flat(to), radius, true);
    let below = over("cylinder = 0.3, turn = \"positive\"", from, to)?;
    push("cylinder, below", long, 2.0 * (0.5 * far).sin().abs(), &below);
    // Unrolled, the helix is a straight line; across the axis its tension counts λ/ℓ times.
    let lifted = [to[0], to[1], 0.9];
    let helix = over("cylinder = 0.3", from, lifted)?;
    let unrolled = length.hypot(0.9);
    push("cylinder, rising", unrolled, resultant * length / unrolled, &helix);
    let spin = helix.vector("bone_moment")[2];
    rows.push(Row::absolute("moment about the cylinder's axis", 0.0, spin, 1e-12));
    let push_along = helix.vector("bone")[2];
    rows.push(Row::absolute("force along the cylinder's axis", 0.0, push_along, 1e-12));
    let clear = over("sphere = 0.05", from, to)?;
    let straight = (1.2f64 * 1.2 + 0.1 * 0.1).sqrt();
    rows.push(Row::relative("straight where it clears", straight, clear.number("length"), 1e-12));
    rows.push(Row::absolute("force on the bone then", 0.0, norm(&clear.vector("bone")), 1e-12));
    Ok(rows)
}

/// A lever of length 0.5 about z at the origin, its spring, and a band from above to its tip over a cylinder.
fn lever() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    let (radius, stiffness, hinge, foot, center) = (0.1, 8.0, 0.6, [0.2, 0.7], [0.3, 0.35]);
    let left = ", turn = \"positive\"";
    for (turn, effort) in [("", -0.7), ("", 0.2), (left, -0.5), (left, -1.0)] {
        let text = format!(
            r#"
format = 1
[body.lever]
[joint.hinge]
kind = "revolute"
axis = [0, 0, 1]
parent = "ground"
child = "lever"
stiffness = {hinge}
effort = {effort}
[spring.band]
stiffness = {stiffness}
tension_only = true
from = {{ body = "ground", at = [{x}, {y}, 0] }}
to = {{ body = "lever", at = [0.5, 0, 0] }}
wrap = {{ body = "ground", at = [{cx}, {cy}, 0], cylinder = {radius}{turn} }}
[output]
angle = "joint.hinge.coordinate"
tension = "spring.band.tension"
"#,
            x = foot[0],
            y = foot[1],
            cx = center[0],
            cy = center[1]
        );
        let side = if turn.is_empty() { None } else { Some(1.0) };
        let band = |angle: f64| {
            let tip = [0.5 * angle.cos(), 0.5 * angle.sin()];
            tangent(minus(foot, center), minus(tip, center), radius, side)
                .map(|(length, way)| (length, tip[0] * way[1] - tip[1] * way[0]))
        };
        let rest = band(0.0).ok_or("no path")?.0;
        let moment = |angle: f64| {
            let Some((length, arm)) = band(angle) else { return f64::NAN };
            effort - hinge * angle + stiffness * (length - rest).max(0.0) * arm
        };
        let angle = root(moment, -1.2, 0.4).ok_or("no root")?;
        let tension = stiffness * (band(angle).ok_or("no path")?.0 - rest).max(0.0);
        let answer = File::new(&text)?.solve(&[], 1e-12)?;
        let what = format!("effort {effort}, {}", if turn.is_empty() { "right" } else { "left" });
        rows.push(Row::absolute(format!("angle, {what}"), angle, answer.number("angle"), 1e-10));
        rows.push(Row::absolute("tension", tension, answer.number("tension"), 1e-10));
    }
    Ok(rows)
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Length of the path from a to b about a circle at the origin, and the way in which it leaves b, found by the touching points
/// themselves: -90° and +90° from the radii, measured by their angles. `side`: of the turn, -1 clockwise.
fn tangent(a: [f64; 2], b: [f64; 2], radius: f64, side: Option<f64>) -> Option<(f64, [f64; 2])> {
    let span = [b[0] - a[0], b[1] - a[1]];
    let straight = span[0].hypot(span[1]);
    let t = (-(a[0] * span[0] + a[1] * span[1]) / (straight * straight)).clamp(0.0, 1.0);
    let right_side = side.is_none_or(|side| side * (a[0] * b[1] - a[1] * b[0]) >= 0.0);
    if right_side && (a[0] + t * span[0]).hypot(a[1] + t * span[1]) >= radius {
        return Some((straight, [-span[0] / straight, -span[1] / straight]));
    }
    let polar = |p: [f64; 2]| (p[0].hypot(p[1]), p[1].atan2(p[0]));
    let ((da, ta), (db, tb)) = (polar(a), polar(b));
    let sign = side.unwrap_or_else(|| if a[0] * b[1] - a[1] * b[0] < 0.0 { -1.0 } else { 1.0 });
    let (la, lb) = ((da * da - radius * radius).sqrt(), (db * db - radius * radius).sqrt());
    let first = ta + sign * FRAC_PI_2 - sign * (radius / la).atan();
    let last = tb - sign * FRAC_PI_2 + sign * (radius / lb).atan();
    let contact = (sign * (last - first)).rem_euclid(2.0 * PI);
    let touch = [radius * last.cos(), radius * last.sin()];
    Some((la + lb + radius * contact, [(touch[0] - b[0]) / lb, (touch[1] - b[1]) / lb]))
}
