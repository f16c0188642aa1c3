//! Joints, couplings and cables, against closed forms.

use crate::file::{Answer, File};
use crate::measure::worst;
use crate::{Case, Row};
use flexura_testkit::elastica::Elastica;
use flexura_testkit::least_norm::least_norm;
use std::f64::consts::{FRAC_PI_2, TAU};

pub const CASES: [Case; 7] = [
    Case {
        id: "couplings",
        title: "`rack_and_pinion.toml`: gear pair, rack and screw, a spring on each",
        citation: "turn = torque / Σ ratio² stiffness, by virtual work",
        needed: "1e-10",
        run: couplings,
        closed_form: None,
    },
    Case {
        id: "universal_joint",
        title: "`universal_shaft.toml`: angle passed on by a universal joint, and the ratio of the torques",
        citation: "tan β = tan α cos γ (J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and \
                   Mechanisms*, 4th ed., 2011, §3.13); torques by virtual work",
        needed: "1e-10",
        run: universal,
        closed_form: None,
    },
    Case {
        id: "rigid_four_bar",
        title: "`rigid_four_bar.toml`: position, torque, forces in the plane, and the forces across it that three \
                redundant conditions leave open",
        citation: "two circles' meeting (the closed form of F. Freudenstein, *Trans. ASME* 77 (1955) 853), virtual work, \
                   and the least norm Aᵀ(A Aᵀ)⁻¹b of forces and moments/L in balance, L = 68 mm, the reach of the bodies about their middle",
        needed: "1e-10 of 1 rad, of the largest force and moment",
        run: four_bar,
        closed_form: None,
    },
    Case {
        id: "bushings",
        title: "Cylindrical, planar and free joints with springs on their coordinates, under force and moment",
        citation: "displacement = force / stiffness, coordinate by coordinate; the rotation vector along the moment",
        needed: "1e-10",
        run: bushings,
        closed_form: None,
    },
    Case {
        id: "string_polygon",
        title: "`cable_polygon.toml`: cable over three sprung eyelets, its tension given; and its length given",
        citation: "the eyelets' balance, T Σ Δy/l = k y (string polygon)",
        needed: "1e-10",
        run: polygon,
        closed_form: None,
    },
    Case {
        id: "hinged_beams",
        title: "`hinged_beams.toml`: two strips joined end to end by a hinge, pushed there",
        citation: "two halves of elliptic integrals (Love, 1927, §§262-263)",
        needed: "1e-9 L",
        run: hinged,
        closed_form: None,
    },
    Case {
        id: "limits_and_rests",
        title: "A slider between a spring with a rest position and a limit that pushes back",
        citation: "F = k (x - rest) + k_stop (x - stop)",
        needed: "1e-10",
        run: limits,
        closed_form: None,
    },
];

const TOLERANCE: f64 = 1e-10;

fn couplings() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/rack_and_pinion.toml"))?;
    let mut rows = Vec::new();
    for torque in [1.0, 4.0] {
        let thread = 5e-3 / TAU;
        let turn = torque / (0.25 * 3.0 + 0.02f64.powi(2) * 2000.0 + thread * thread * 8000.0);
        let answer = file.solve(&[("torque", torque)], 1e-11)?;
        rows.push(Row::relative(format!("turn at {torque} N·m"), turn, answer.number("turn"), TOLERANCE));
        rows.push(Row::relative("wheel", -0.5 * turn, answer.number("wheel_turn"), TOLERANCE));
        rows.push(Row::relative("rack", 0.02 * turn, answer.number("rack_travel"), TOLERANCE));
        rows.push(Row::relative("nut", thread * turn, answer.number("nut_travel"), TOLERANCE));
    }
    Ok(rows)
}

fn universal() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/universal_shaft.toml"))?;
    let mut rows = Vec::new();
    for (turning, angle) in [(0.7f64, 0.5f64), (1.4, 0.9), (2.5, 0.9)] {
        let (s, c) = turning.sin_cos();
        let out = (s * angle.cos()).atan2(c);
        // dβ/dα of tan β = tan α cos γ.
        let ratio = angle.cos() / (c * c + s * s * angle.cos().powi(2));
        let answer = file.solve(&[("turning", turning), ("angle", angle)], 1e-11)?;
        let place = format!("turned by {turning}, shafts at {angle}");
        rows.push(Row::absolute(format!("angle, {place}"), out, answer.number("turn_out"), TOLERANCE));
        rows.push(Row::relative("torque", 2.0 * out * ratio, answer.number("torque_in"), TOLERANCE));
    }
    Ok(rows)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn four_bar() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/rigid_four_bar.toml"))?;
    let mut rows = Vec::new();
    for crank in [-0.3f64, 0.7, 1.1] {
        let (b, d) = ([0.04 * crank.sin(), 0.04 * crank.cos()], [0.1, 0.0]);
        // C is 60 mm from D and as far from B as at the start; above the line BD.
        let (long, short) = (0.1f64.hypot(0.02), 0.06);
        let line = minus(d, b);
        let distance = line[0].hypot(line[1]);
        let along = (long * long - short * short + distance * distance) / (2.0 * distance);
        let off = (long * long - along * along).sqrt();
        let e = [line[0] / distance, line[1] / distance];
        let c = [b[0] + along * e[0] - off * e[1], b[1] + along * e[1] + off * e[0]];
        let (u, arm) = (minus(c, b), minus(c, d));
        let rocker = (-arm[0]).atan2(arm[1]);
        // The coupler is a two-force member in the plane: equal speeds of B and C along it.
        let ratio = cross(b, u) / cross(arm, u);
        let torque = 1.5 * rocker * ratio;
        let force = 1.5 * rocker / cross(arm, u);
        let answer = file.solve(&[("crank", crank)], 1e-11)?;
        rows.push(Row::absolute(
            format!("rocker at crank {crank}"),
            rocker,
            answer.number("rocker"),
            TOLERANCE,
        ));
        let scale = (force * long).abs();
        rows.push(Row::scaled("torque", torque, answer.number("torque"), scale * 0.1, TOLERANCE));
        for i in 0..2 {
            rows.push(Row::scaled(
                format!("force in the plane, {i}"),
                force * u[i],
                answer.vector("force_c")[i],
                scale,
                TOLERANCE,
            ));
        }
        let turned = u[1].atan2(u[0]) - 0.02f64.atan2(0.1);
        let (s, cos) = turned.sin_cos();
        let load = [b[0] + 0.03 * cos - 0.01 * s, b[1] + 0.03 * s + 0.01 * cos];
        let wanted = across([[0.0, 0.0], b, c, d], load, 3.0)?;
        let found: Vec<f64> =
            ["a", "b", "c", "d"].iter().flat_map(|name| across_part(&answer, name)).collect();
        let off = worst(wanted.iter().zip(&found).map(|(a, b)| (a - b).abs() / 3.0));
        rows.push(Row::vanishing("forces and moments/L across the plane, by the load", off, TOLERANCE));
    }
    Ok(rows)
}

/// Length by which moments are divided in the norm: of a model without beams, the farthest body's distance.
const NORM_LENGTH: f64 = 0.067_986_926_847_903_8;

fn across_part(answer: &Answer, joint: &str) -> [f64; 3] {
    let (force, moment) =
        (answer.vector(&format!("force_{joint}")), answer.vector(&format!("moment_{joint}")));
    [force[2], moment[0] / NORM_LENGTH, moment[1] / NORM_LENGTH]
}

/// (Fz, Mx/L, My/L) of the four hinges at `points`, in balance with a force across the plane on the coupler.
fn across(points: [[f64; 2]; 4], at: [f64; 2], push: f64) -> Result<Vec<f64>, String> {
    // What each hinge does to crank, coupler and rocker: it acts on its child, and back on its parent.
    let signs = [[1.0, -1.0, 0.0, 0.0], [0.0, 1.0, -1.0, 0.0], [0.0, 0.0, 1.0, 1.0]];
    let (mut rows, mut right) = (Vec::new(), Vec::new());
    for (body, signs) in signs.iter().enumerate() {
        for component in 0..3 {
            let mut row = vec![0.0; 12];
            for (joint, (sign, [x, y])) in signs.iter().zip(points).enumerate() {
                match component {
                    0 => row[3 * joint] = *sign,
                    1 => (row[3 * joint], row[3 * joint + 1]) = (sign * y, sign * NORM_LENGTH),
                    _ => (row[3 * joint], row[3 * joint + 2]) = (-sign * x, sign * NORM_LENGTH),
                }
            }
            rows.push(row);
            let load = [push, at[1] * push, -at[0] * push][component];
            right.push(if body == 1 { -load } else { 0.0 });
        }
    }
    least_norm(&rows, &right).ok_or_else(|| "the balance is singular".to_string())
}

fn bushings() -> Result<Vec<Row>, String> {
    let file = File::new(
        r#"
        format = 1
        [body.a]
        [body.b]
        [body.c]
        [joint.cylinder]
        kind = "cylindrical"
        parent = "ground"
        child = "a"
        axis = [0, 3, 4]
        angle = { stiffness = "2 N*m/rad", rest = "0.1 rad" }
        position = { stiffness = "500 N/m" }
        [joint.plane]
        kind = "planar"
        parent = "ground"
        child = "b"
        axis = [0, 0, 1]
        x = { stiffness = "300 N/m" }
        y = { stiffness = "700 N/m", rest = "5 mm" }
        angle = { stiffness = "3 N*m/rad" }
        [joint.bush]
        kind = "free"
        parent = "ground"
        child = "c"
        x = { stiffness = "1000 N/m" }
        y = { stiffness = "2000 N/m" }
        z = { stiffness = "4000 N/m" }
        rotation = { stiffness = "1.5 N*m/rad" }
        [load.a]
        body = "a"
        force = ["7 N", "9 N", "2 N"]
        moment = ["0.3 N*m", "0.5 N*m", "1 N*m"]
        [load.b]
        body = "b"
        force = ["6 N", "14 N", "2 N"]
        moment = ["0.3 N*m", "0.5 N*m", "1.2 N*m"]
        [load.c]
        body = "c"
        force = ["7 N", "9 N", "2 N"]
        moment = ["0.5 N*m", "1 N*m", "1 N*m"]
        [output]
        turn = "joint.cylinder.angle"
        slide = "joint.cylinder.position"
        x = "joint.plane.x"
        y = "joint.plane.y"
        angle = "joint.plane.angle"
        place = "body.c.position"
        rotation = "body.c.rotation"
        "#,
    )?;
    let answer = file.solve(&[], 1e-11)?;
    let mut rows = vec![
        Row::absolute("cylindrical, angle", 0.1 + (0.6 * 0.5 + 0.8) / 2.0, answer.number("turn"), TOLERANCE),
        Row::absolute("position", (0.6 * 9.0 + 0.8 * 2.0) / 500.0, answer.number("slide"), TOLERANCE),
        Row::absolute("planar, x", 6.0 / 300.0, answer.number("x"), TOLERANCE),
        Row::absolute("y", 5e-3 + 14.0 / 700.0, answer.number("y"), TOLERANCE),
        Row::absolute("angle", 1.2 / 3.0, answer.number("angle"), TOLERANCE),
    ];
    for (i, (force, moment)) in [(7.0 / 1e3, 0.5), (9.0 / 2e3, 1.0), (2.0 / 4e3, 1.0)].into_iter().enumerate()
    {
        rows.push(Row::absolute(format!("free, {i}"), force, answer.vector("place")[i], TOLERANCE));
        let turned = answer.vector("rotation")[i];
        rows.push(Row::absolute(format!("rotation vector, {i}"), moment / 1.5, turned, TOLERANCE));
    }
    Ok(rows)
}

fn polygon() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/cable_polygon.toml");
    let (spring, spacing, height) = (500.0, 0.05f64, 0.04);
    let mut rows = Vec::new();
    for tension in [10.0, 40.0] {
        let answer = File::new(text)?.solve(&[("tension", tension)], 1e-11)?;
        let y = [0.0, answer.number("y1"), answer.number("y2"), answer.number("y3"), 0.0];
        let side: Vec<f64> = (0..4).map(|i| spacing.hypot(y[i + 1] - y[i])).collect();
        for i in 1..4 {
            let pull = tension * ((y[i - 1] - y[i]) / side[i - 1] + (y[i + 1] - y[i]) / side[i]);
            let spring = spring * (height - y[i]);
            rows.push(Row::vanishing(
                format!("balance of eyelet {i}, by the tension {tension} N"),
                ((pull + spring) / tension).abs(),
                TOLERANCE,
            ));
        }
        let length: f64 = side.iter().sum();
        rows.push(Row::relative("length", length, answer.number("length"), TOLERANCE));
        let kept = text.replace("tension = \"tension\"", &format!("length = {length:e}"));
        let kept = kept.replace("[output]", "[output]\nfound = \"cable.rope.tension\"");
        let found = File::new(&kept)?.solve(&[], 1e-11)?.number("found");
        rows.push(Row::relative("tension of the cable of that length", tension, found, 1e-9));
    }
    Ok(rows)
}

fn hinged() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/hinged_beams.toml"))?;
    let (l, bending): (f64, f64) = (0.15, 207e9 * 20e-3 * 0.5e-3f64.powi(3) / 12.0);
    let mut rows = Vec::new();
    for push in [4.0, 16.0] {
        let tip = Elastica::dead(0.5 * push * l * l / bending, FRAC_PI_2).tip();
        let answer = file.solve(&[("push", push)], 1e-11)?;
        let [x, y] = tip.position;
        rows.push(Row::scaled(format!("rise at {push} N"), l * y, answer.number("rise"), l, 1e-9));
        rows.push(Row::scaled("slide", -2.0 * l * (1.0 - x), answer.number("slide"), l, 1e-9));
        rows.push(Row::absolute("slope before the hinge", tip.angle, answer.number("slope_before"), 1e-9));
        rows.push(Row::absolute("slope behind it", -tip.angle, answer.number("slope_behind"), 1e-9));
        let moment = answer.number("hinge_moment");
        rows.push(Row::scaled("moment of the hinge", 0.0, moment, bending / l, 1e-9));
    }
    Ok(rows)
}

fn limits() -> Result<Vec<Row>, String> {
    let file = File::new(
        r#"
        format = 1
        [parameter]
        push = "1 N"
        [body.slider]
        [joint.way]
        kind = "prismatic"
        parent = "ground"
        child = "slider"
        axis = [1, 0, 0]
        effort = "push"
        stiffness = "100 N/m"
        rest = "2 mm"
        limits = { range = ["-10 mm", "15 mm"], stiffness = "1 N/mm" }
        [output]
        x = "joint.way.coordinate"
        "#,
    )?;
    let mut rows = Vec::new();
    for (push, wanted) in
        [(1.0, 12e-3), (2.4, (2.4 + 0.2 + 15.0) / 1100.0), (-3.0, (-3.0 + 0.2 - 10.0) / 1100.0)]
    {
        let found = file.solve(&[("push", push)], 1e-11)?.number("x");
        rows.push(Row::absolute(format!("position at {push} N, m"), wanted, found, TOLERANCE));
    }
    Ok(rows)
}
