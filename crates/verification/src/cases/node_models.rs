//! Every beam of the models of the mobile node, integrated again from its start, and the balance of what hangs on it.

use crate::file::{Answer, File, asking};
use crate::{Case, Row};
use flexura_spatial::Vector3;
use flexura_testkit::ivp::integrate;
use flexura_testkit::rod::{Rod, State};
use std::f64::consts::PI;

pub const CASES: [Case; 2] = [
    Case {
        id: "node_models",
        title: "All models of the node and the frame that it stands on: every beam integrated again from its start arrives with the pose and \
                wrench of its end, and with the strain energy",
        citation: "extrapolation of order 12",
        needed: "1e-9 of L, 1, EI/L², EI/L and EI/L",
        run: arrivals,
        closed_form: None,
    },
    Case {
        id: "node_balance",
        title: "Balance of the node's bodies: the front at the edge, the slider of the sensor, the laminate's U, the \
                assemblies moved together, the corners and feet of the frame",
        citation: "forces and moments sum to zero",
        needed: "1e-9 of EI/L² and EI/L",
        run: balance,
        closed_form: None,
    },
];

const CORNER: &str = include_str!("../../../../models/node_corner.toml");
const REAR: &str = include_str!("../../../../models/node_corner_rear.toml");
const TOGETHER: &str = include_str!("../../../../models/node_corner_together.toml");
const CAMERA: &str = include_str!("../../../../models/node_camera.toml");
const PRINTED: &str = include_str!("../../../../models/node_camera_printed.toml");
const NARROW: &str = include_str!("../../../../models/node_narrow_corner.toml");
const SENSOR: &str = include_str!("../../../../models/node_sensor.toml");
const LAMINATE: &str = include_str!("../../../../models/node_laminate.toml");
const PORTAL: &str = include_str!("../../../../models/portal_frame.toml");

/// The strip of `parts/flexonic_node.toml`.
const L: f64 = 0.1524;
const WIDTH: f64 = 20.32e-3;
const HEIGHT: f64 = 0.254e-3;
const YOUNG: f64 = 207e9;
const BENDING: f64 = YOUNG * WIDTH * HEIGHT * HEIGHT * HEIGHT / 12.0;
const GRAVITY: f64 = 9.80665;
const TOLERANCE: f64 = 1e-12;

/// Saint-Venant's torsion constant of a rectangle of `width` and `height`, by its series.
fn torsion(width: f64, height: f64) -> f64 {
    let aspect = width / height;
    let term = |n: i32| {
        let odd = f64::from(2 * n + 1);
        (odd * PI * aspect / 2.0).tanh() / odd.powi(5)
    };
    let series = (0..60).rev().map(term).sum::<f64>();
    width * height.powi(3) * (1.0 / 3.0 - 64.0 / (PI.powi(5) * aspect) * series)
}

/// Compliance of a rectangle without shear.
fn rectangle(young: f64, shear: f64, width: f64, height: f64, stretches: bool) -> [f64; 6] {
    let stretch = if stretches { 1.0 / (young * width * height) } else { 0.0 };
    let bending = |a: f64, b: f64| 12.0 / (young * a * b.powi(3));
    [
        stretch,
        0.0,
        0.0,
        1.0 / (shear * torsion(width, height)),
        bending(width, height),
        bending(height, width),
    ]
}

/// Forces at places between the ends of a beam.
type Points<'a> = &'a [(f64, Vector3<f64>)];

/// What a beam is made of and carries.
struct Course<'a> {
    compliance: &'a dyn Fn(f64) -> [f64; 6],
    /// Force per length.
    load: &'a dyn Fn(f64) -> Vector3<f64>,
    points: Points<'a>,
}

/// The end of beam `number` that leaves its start as the answer says, and the energy on the way: how far the end is from the answer's,
/// and the energy.
fn arrives(answer: &Answer, number: usize, course: &Course, units: [f64; 2]) -> Result<[f64; 2], String> {
    let beam = answer.solution.beams.get(number).ok_or("no such beam")?;
    let (Some(first), Some(last)) = (beam.samples.first(), beam.samples.last()) else {
        return Err("no samples".to_string());
    };
    let rate = |s: f64, y: &[f64; 14]| {
        let state: [f64; 13] = std::array::from_fn(|i| y[i]);
        let back = State::from_array(&state).pose().rotation.inverse();
        let State { force, moment, .. } = State::from_array(&state);
        let (force, moment) = (back * force, back * moment);
        let parts = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
        let compliance = (course.compliance)(s);
        let density: f64 = parts.iter().zip(&compliance).map(|(part, c)| 0.5 * c * part * part).sum();
        let load = (course.load)(s);
        let rod =
            Rod { load: Box::new(move |_| load), ..Rod::uniform(beam.length, compliance, Vector3::zeros()) };
        let rates = rod.rates(s, &state, 1.0);
        std::array::from_fn(|i| if i < 13 { rates[i] } else { density })
    };
    let start = State::new(&first.pose, &first.wrench).to_array();
    let mut now: [f64; 14] = std::array::from_fn(|i| if i < 13 { start[i] } else { 0.0 });
    let mut from = 0.0;
    let ends = [(beam.length, Vector3::zeros())];
    for (to, force) in course.points.iter().chain(&ends) {
        let path = integrate(rate, now, from, *to, 512);
        now = path[512].1;
        // The part beyond carries that much less.
        (0..3).for_each(|i| now[7 + i] -= force[i]);
        from = *to;
    }
    let end = State::from_array(&std::array::from_fn(|i| now[i]));
    let [force, moment] = units;
    let off = [
        (end.position - last.pose.position).norm() / beam.length,
        end.pose().rotation.angle_to(&last.pose.rotation),
        (end.force - last.wrench.force).norm() / force,
        (end.moment - last.wrench.moment).norm() / moment,
    ];
    Ok([off.into_iter().fold(0.0, f64::max), now[13]])
}

fn rows(what: &str, answer: &Answer, off: f64, energy: f64, unit: f64) -> [Row; 2] {
    [
        Row::vanishing(format!("end of every beam, {what}"), off, 1e-9),
        Row::scaled(format!("strain energy, J, {what}"), energy, answer.solution.energy, unit, 1e-9),
    ]
}

const UNITS: [f64; 2] = [BENDING / (L * L), BENDING / L];

fn arrivals() -> Result<Vec<Row>, String> {
    let strip = rectangle(YOUNG, 79.3e9, WIDTH, HEIGHT, false);
    let stretching = rectangle(YOUNG, 79.3e9, WIDTH, HEIGHT, true);
    let leaf =
        [stretching[0], 0.0, 0.0, 1.0 / (1.520_299_758_5 * BENDING), 1.0 / BENDING, 1.0 / (6400.0 * BENDING)];
    let aim = asking(CAMERA, &[("u0", 2e-3)], &[("pitch", 15f64.to_radians())]);
    let sensor = [(0.5 * L, Vector3::new(0.0, 0.0, -0.05 * GRAVITY))];
    let cases: [(&str, &str, [f64; 6], Points); 7] = [
        ("a corner, with gravity", CORNER, strip, &[]),
        ("the rear over it", REAR, strip, &[]),
        ("both together", TOGETHER, strip, &[]),
        ("little room", NARROW, strip, &[]),
        ("looking round", &aim, leaf, &[]),
        ("as printed", PRINTED, leaf, &[]),
        ("the sensor set down", SENSOR, stretching, &sensor),
    ];
    let mut found = Vec::new();
    for (what, text, compliance, points) in cases {
        let answer = File::new(text)?.solve(&[], TOLERANCE)?;
        let course = Course { compliance: &|_| compliance, load: &|_| Vector3::zeros(), points };
        let [off, energy] = arrives(&answer, 0, &course, UNITS)?;
        // The magnets that hold the front assembly level store energy too.
        let pitch = if text == aim { answer.number("pitch") } else { 0.0 };
        found.extend(rows(what, &answer, off, energy + 0.5 * 0.69 * pitch * pitch, UNITS[1]));
    }
    found.extend(laminate()?);
    found.extend(portal()?);
    Ok(found)
}

fn laminate() -> Result<[Row; 2], String> {
    let answer = File::new(LAMINATE)?.solve(&[], TOLERANCE)?;
    let width = |s: f64| {
        let step = |at: f64| ((s - at * L) / (0.01 * L)).tanh();
        WIDTH + 0.5 * (0.03 * (1.0 - 0.08) - WIDTH) * (step(0.4) - step(0.6))
    };
    let course = Course {
        compliance: &|s| rectangle(YOUNG, 79.3e9, width(s), HEIGHT, false),
        load: &|s| Vector3::new(0.0, 0.0, -7630.0 * width(s) * HEIGHT * GRAVITY),
        points: &[],
    };
    let [off, energy] = arrives(&answer, 0, &course, UNITS)?;
    Ok(rows("the laminate", &answer, off, energy, UNITS[1]))
}

/// Flat steel of the frame, and its span.
const FLAT: [f64; 2] = [0.15, 6e-3];
const SPAN: f64 = 2.0;

fn portal_units() -> [f64; 2] {
    let bending = 210e9 * FLAT[0] * FLAT[1].powi(3) / 12.0;
    [bending / (SPAN * SPAN), bending / SPAN]
}

fn portal() -> Result<[Row; 2], String> {
    let answer = File::new(PORTAL)?.solve(&[("push", 5.0)], TOLERANCE)?;
    let compliance = rectangle(210e9, 82e9, FLAT[0], FLAT[1], true);
    let own = Vector3::new(0.0, 0.0, -7700.0 * FLAT[0] * FLAT[1] * GRAVITY);
    let axle = Vector3::new(0.0, 0.0, -0.5 * GRAVITY);
    let axles = [(0.5, axle), (0.7, axle)];
    let (mut worst, mut energy) = (0.0_f64, 0.0);
    for (number, beam) in answer.model.beams.iter().enumerate() {
        let points: Points = if beam.name == "beam" { &axles } else { &[] };
        let course = Course { compliance: &|_| compliance, load: &|_| own, points };
        let [off, stored] = arrives(&answer, number, &course, portal_units())?;
        worst = worst.max(off);
        energy += stored;
    }
    Ok(rows("the frame under its weight and a push", &answer, worst, energy, portal_units()[1]))
}

fn balance() -> Result<Vec<Row>, String> {
    let end = |answer: &Answer, beam: usize| {
        answer.solution.beams.get(beam).and_then(|beam| beam.samples.last()).copied().ok_or("no samples")
    };
    let start = |answer: &Answer, beam: usize| {
        answer.solution.beams.get(beam).and_then(|beam| beam.samples.first()).copied().ok_or("no samples")
    };
    let [force, moment] = UNITS;
    let mut rows = Vec::new();
    // Nothing but its weight, the beam and the edge act on the front assembly.
    let answer = File::new(CORNER)?.solve(&[], TOLERANCE)?;
    let theta = answer.number("theta");
    let tip = end(&answer, 0)?;
    let weight = Vector3::new(0.0, 0.0, -0.5 * GRAVITY);
    let axle = Vector3::new(38.1e-3 * theta.sin(), 0.0, 38.1e-3 * theta.cos());
    let about = axle.cross(&weight) - tip.wrench.moment - tip.pose.position.cross(&tip.wrench.force);
    rows.push(Row::vanishing("moment about the edge, EI/L", about.y.abs() / moment, 1e-9));
    // The slider's effort is the strip's push, which is the same at both ends: the sensor weighs down only.
    let answer = File::new(SENSOR)?.solve(&[], TOLERANCE)?;
    let (first, last) = (start(&answer, 0)?.wrench, end(&answer, 0)?.wrench);
    let unit = PI * PI * BENDING / (4.0 * L * L);
    let apart = (answer.number("n") * unit + last.force.x).abs();
    rows.push(Row::vanishing(
        "push of the sensor's slider and that of the strip, EI/L²",
        apart / force,
        1e-9,
    ));
    rows.push(Row::vanishing(
        "the strip's push at its ends, EI/L²",
        (first.force.x - last.force.x).abs() / force,
        1e-9,
    ));
    let lost = last.force.z - first.force.z - 0.05 * GRAVITY;
    rows.push(Row::vanishing("the sensor's weight between them, EI/L²", lost.abs() / force, 1e-9));
    // The U and the payload hang on the laminate's end.
    let answer = File::new(LAMINATE)?.solve(&[], TOLERANCE)?;
    let tip = end(&answer, 0)?;
    let hanging = Vector3::new(0.0, 0.0, -0.01 * GRAVITY);
    let arm = tip.pose.rotation * Vector3::new(10.1e-3, 0.0, 0.0);
    let off = (tip.wrench.force - hanging - Vector3::new(0.0, 0.0, -0.05 * GRAVITY)).norm() / force;
    rows.push(Row::vanishing("force at the laminate's tip, EI/L²", off, 1e-9));
    let off = (tip.wrench.moment - arm.cross(&hanging)).norm() / moment;
    rows.push(Row::vanishing("moment at the laminate's tip, EI/L", off, 1e-9));
    // Both assemblies hold the strip between them: it carries nothing else.
    let answer = File::new(TOGETHER)?.solve(&[("down", 0.1 * L)], TOLERANCE)?;
    let (first, last) = (start(&answer, 0)?, end(&answer, 0)?);
    rows.push(Row::vanishing(
        "force along the strip moved by both, EI/L²",
        (first.wrench.force - last.wrench.force).norm() / force,
        1e-9,
    ));
    let turn = first.wrench.moment - last.wrench.moment
        + (first.pose.position - last.pose.position).cross(&last.wrench.force);
    rows.push(Row::vanishing("moment of it, EI/L", turn.norm() / moment, 1e-9));
    rows.push(Row::vanishing(
        "effort of the rear and the strip's force, EI/L²",
        (answer.number("rear_force") * unit + first.wrench.force.x).abs() / force,
        1e-9,
    ));
    rows.extend(frame()?);
    Ok(rows)
}

/// The frame's corners, which nothing else acts on but the push, and its feet.
fn frame() -> Result<Vec<Row>, String> {
    let answer = File::new(PORTAL)?.solve(&[("push", 5.0)], TOLERANCE)?;
    let beam = |name: &str| {
        let number = answer.model.beams.iter().position(|beam| beam.name == name);
        let samples = number.and_then(|number| answer.solution.beams.get(number)).map(|beam| &beam.samples);
        samples.and_then(|samples| Some((*samples.first()?, *samples.last()?))).ok_or("no samples")
    };
    let (left, right, top) = (beam("left_column")?, beam("right_column")?, beam("beam")?);
    let [force, moment] = portal_units();
    let push = Vector3::new(5.0, 0.0, 0.0);
    // A section's wrench is by what is beyond it on what is before.
    let corners = [
        (push - left.1.wrench.force + top.0.wrench.force, top.0.wrench.moment - left.1.wrench.moment),
        (-right.1.wrench.force - top.1.wrench.force, -right.1.wrench.moment - top.1.wrench.moment),
    ];
    let forces = corners.iter().map(|(f, _)| f.norm() / force).fold(0.0, f64::max);
    let moments = corners.iter().map(|(_, m)| m.norm() / moment).fold(0.0, f64::max);
    let own = 7700.0 * FLAT[0] * FLAT[1] * GRAVITY * (SPAN + 2.0 * 1.5) + GRAVITY;
    let all = left.0.wrench.force + right.0.wrench.force - push + Vector3::new(0.0, 0.0, own);
    let hinges = left.0.wrench.moment.y.abs().max(right.0.wrench.moment.y.abs());
    Ok(vec![
        Row::vanishing("forces on the frame's corners, EI/L²", forces, 1e-9),
        Row::vanishing("moments on the frame's corners, EI/L", moments, 1e-9),
        Row::vanishing("feet, weight and push of the frame, EI/L²", all.norm() / force, 1e-9),
        Row::vanishing("moments at its feet's hinges, EI/L", hinges / moment, 1e-9),
    ])
}
