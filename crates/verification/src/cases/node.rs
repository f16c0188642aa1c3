//! The flexonic mobile node: round a corner, and looking round.

use crate::file::File;
use crate::path::{Path, events};
use crate::{Case, Row};
use flexura_spatial::{Pose, Vector3, Wrench};
use flexura_testkit::planar::{self, Beam, Body, End, Mechanism};
use flexura_testkit::rod::{Rod, State};
use flexura_testkit::shoot::Shooting;
use std::f64::consts::PI;

pub const CASES: [Case; 3] = [
    Case {
        id: "node_corner",
        title: "5.2.2, the node's front assembly turned about the edge of a corner by the rear (`node_corner.toml`), without gravity, by 30° \
                and 90°: push in π²EI/4L² and slide; the rear pulled over it (`node_corner_rear.toml`), its mirror image",
        citation: "Taylor series along the beam, closed by Newton's method; 2.148958492 and 0.144944987 at 30°, 3.511542752 and \
                   0.459481608 at 90°",
        needed: "1e-7",
        run: corner,
        closed_form: None,
    },
    Case {
        id: "node_camera_printed",
        title: "5.4.2 as its equations are printed, (5.16), (5.18), (5.19) (`node_camera_printed.toml`), at (θ, ψ) = (15°, 10°) and on the \
                way there: internal force in π²EI/4L² and slide",
        citation: "single shooting by extrapolation of order 12; 10.185190203 and 0.086158036",
        needed: "1e-6",
        run: printed,
        closed_form: None,
    },
    Case {
        id: "portal_frame",
        title: "5.3.4, the frame that the node stands on (`portal_frame.toml`), its own weight and the node's: thrust at the feet",
        citation: "3 P a b/(2 l h N) and q l³/(4 l h N), N = 2 h/l + 3 (A. Kleinlogel, *Rahmenformeln*); small deflections, \
                   inextensible",
        needed: "1e-4, the order of what the formulas leave out for weights a thousandth of the real ones",
        run: portal,
        closed_form: None,
    },
];

const CORNER: &str = include_str!("../../../../models/node_corner.toml");
const REAR: &str = include_str!("../../../../models/node_corner_rear.toml");
const PRINTED: &str = include_str!("../../../../models/node_camera_printed.toml");
const PORTAL: &str = include_str!("../../../../models/portal_frame.toml");

/// The strip of `parts/flexonic_node.toml`.
const L: f64 = 0.1524;
const BENDING: f64 = 207e9 * 20.32e-3 * 0.254e-3 * 0.254e-3 * 0.254e-3 / 12.0;
const ASPECT: f64 = 80.0;

/// Turn of the front and slide of the rear, /L, for a push in π²EI/4L², in units of L and EI.
fn turned(push: f64) -> Result<[f64; 2], String> {
    let above = 0.25;
    let at = |fraction: f64| Mechanism {
        beams: vec![Beam {
            length: 1.0,
            bending: 1.0,
            stretch: 0.0,
            curvature: 0.0,
            start: End::clamp(Some(0), [0.0; 3]),
            end: End::clamp(Some(1), [0.0, above, 0.0]),
        }],
        bodies: vec![
            Body {
                rest: [0.0; 3],
                held: [None, Some(0.0), Some(0.0)],
                load: [push * fraction * PI * PI / 4.0, 0.0, 0.0],
            },
            Body { rest: [1.0, -above, 0.0], held: [Some(1.0), Some(-above), None], load: [0.0; 3] },
        ],
    };
    let found = planar::solve(&at, 20).map_err(|error| format!("{error:?}"))?;
    Ok([-found.poses[1][2], found.poses[0][0]])
}

fn corner() -> Result<Vec<Row>, String> {
    let wanted = [("theta", 30f64.to_radians()), ("theta", 90f64.to_radians())];
    let values = [(30.0, 2.148_958_492, 0.144_944_987), (90.0, 3.511_542_752, 0.459_481_608)];
    let path = Path { events: &wanted, ..Path::of("u0", [0.0, 0.5 * L]) };
    let followed = File::new(CORNER)?.trace(&[("fall", 0.0)], &path, 1e-11)?;
    let mut rows = Vec::new();
    for (number, (degrees, push, slide)) in values.into_iter().enumerate() {
        let [point] = events(followed.first()?, number)[..] else {
            return Err(format!("the front does not turn by {degrees}° once"));
        };
        let [n, u0] = ["n", "u0_over_L"].map(|name| followed.number(point, name));
        rows.push(Row::absolute(format!("n at {degrees}°"), push, n, 1e-7));
        rows.push(Row::absolute(format!("u0/L at {degrees}°"), slide, u0, 1e-7));
        let [turn, u0_again] = turned(n)?;
        rows.push(Row::absolute(format!("turn under that push, {degrees}°"), wanted[number].1, turn, 1e-7));
        rows.push(Row::absolute("slide under that push", u0_again, u0, 1e-7));
    }
    // The mirror image: the rear pulled over the edge by the front, from where both lie on the second plane.
    let wanted = [("phi", 60f64.to_radians()), ("phi", 0.0)];
    let path = Path { events: &wanted, ..Path::of("pull", [0.0, 0.5 * L]) };
    let followed = File::new(REAR)?.trace(&[("fall", 0.0)], &path, 1e-11)?;
    for (number, (degrees, push, slide)) in values.into_iter().enumerate() {
        let [point] = events(followed.first()?, number)[..] else {
            return Err(format!("the rear does not turn by {degrees}° once"));
        };
        rows.push(Row::absolute(
            format!("n of the rear, {degrees}°"),
            push,
            followed.number(point, "n"),
            1e-7,
        ));
        rows.push(Row::absolute("its slide", slide, followed.number(point, "u0_over_L"), 1e-7));
    }
    Ok(rows)
}

/// Force in π²EI/4L² and slide, /L, of the printed problem.
fn camera_printed(theta: f64, yaw: f64) -> Result<[f64; 2], String> {
    let (wheel, d1, d3) = (0.25, -21.79e-3 / L, 7.11e-3 / L);
    let magnet = 0.69 * L / BENDING;
    let (stretch, twist) = ((20.32e-3 / ASPECT / L).powi(2) / 12.0, 1.520_299_758_5);
    let rod =
        Rod::uniform(1.0, [stretch, 0.0, 0.0, 1.0 / twist, 1.0, 1.0 / (ASPECT * ASPECT)], Vector3::zeros());
    // Unknown are the slide, the force and the moment at the start.
    let start = |_: f64, x: &[f64; 7]| {
        let wrench = Wrench::new(Vector3::new(x[1], x[2], x[3]), Vector3::new(x[4], x[5], x[6]));
        State::new(&Pose::new(Pose::identity().rotation, Vector3::new(x[0], 0.0, 0.0)), &wrench)
    };
    let misfit = |fraction: f64, x: &[f64; 7], end: &State| {
        // First the pitch, then the yaw.
        let theta = theta * (2.0 * fraction).min(1.0);
        let yaw = yaw * (2.0 * fraction - 1.0).max(0.0);
        let way = wheel * theta + d1 * (theta.cos() - 1.0) + d3 * theta.sin();
        let tangent = end.pose().rotation * Vector3::x();
        let ahead = tangent.x * yaw.cos() + tangent.y * yaw.sin();
        [
            end.position.x - 1.0 - way * yaw.cos(),
            end.position.y - way * yaw.sin(),
            end.position.z - d3 * (theta.cos() - 1.0) + d1 * theta.sin(),
            end.moment.x - magnet * theta * yaw.sin(),
            end.moment.y - x[1] * (wheel + d3) + magnet * theta * yaw.cos(),
            end.moment.z,
            (-tangent.z).atan2(ahead) - theta,
        ]
    };
    let found = Shooting { rod: &rod, start: &start, misfit: &misfit }.solve(40);
    let found = found.ok_or_else(|| format!("shooting failed at {theta}, {yaw}"))?;
    Ok([4.0 * found[1] / (PI * PI), found[0]])
}

fn printed() -> Result<Vec<Row>, String> {
    let file = File::new(PRINTED)?;
    let mut rows = Vec::new();
    for (pitch, yaw) in [(5.0_f64, 0.0_f64), (15.0, 0.0), (15.0, 10.0)] {
        let (theta, psi) = (pitch.to_radians(), yaw.to_radians());
        let [force, slide] = camera_printed(theta, psi)?;
        let answer = file.solve(&[("theta", theta), ("yaw", psi)], 1e-11)?;
        rows.push(Row::absolute(format!("n at ({pitch}°, {yaw}°)"), force, answer.number("n"), 1e-6));
        rows.push(Row::absolute(
            format!("u0/L at ({pitch}°, {yaw}°)"),
            slide,
            answer.number("u0_over_L"),
            1e-6,
        ));
        if yaw > 0.0 {
            rows.push(Row::absolute("n, by its value", 10.185_190_203, answer.number("n"), 1e-6));
            rows.push(Row::absolute("u0/L, by its value", 0.086_158_036, answer.number("u0_over_L"), 1e-6));
        }
    }
    Ok(rows)
}

fn portal() -> Result<Vec<Row>, String> {
    // A thousandth of the real weights: the formulas are of first order.
    let scale = 1e-3;
    let text = PORTAL.replace("-9.80665 m/s^2", &format!("{} m/s^2", -9.80665 * scale));
    let (span, height, gravity) = (2.0, 1.5, 9.80665 * scale);
    let n = 2.0 * height / span + 3.0;
    let point = |a: f64, load: f64| 3.0 * load * a * (span - a) / (2.0 * span * height * n);
    let own = 7700.0 * 0.15 * 6e-3 * gravity * span * span / (4.0 * height * n);
    let node = point(0.5, 0.5 * gravity) + point(0.7, 0.5 * gravity);
    let answer = File::new(&text)?.solve(&[], 1e-11)?;
    // The foot pushes outwards; the force at its start is by the column on the foot, turned round.
    Ok(vec![Row::relative("thrust, N", own + node, answer.number("thrust").abs(), 1e-4)])
}
