//! The symbols: supports, joints, bodies, springs, loads.

use super::axis::shown;
use super::canvas::{Canvas, Style};
use super::layout::Panel;
use super::scene::{BodyMark, CableMark, JointMark, LoadMark, MassMark, Scene, SpringMark, Support};
use super::{CABLE, FAINT, INK, LOAD, SPRING, shortened};
use flexura_model::JointKind;
use flexura_spatial::Vector3;

/// Arrows of loads have this length in the view that shows them unforeshortened, px.
const ARROW: f64 = 36.0;

/// A beam's end on the ground.
pub fn support(canvas: &mut Canvas, panel: &Panel, support: &Support) {
    let at = panel.point(&support.point);
    if support.kind != JointKind::Weld {
        let hold =
            JointMark { point: support.point, axis: support.axis, kind: support.kind, is_grounded: true };
        joint(canvas, panel, &hold);
        return;
    }
    let outward = panel.direction(&support.outward);
    let length = outward[0].hypot(outward[1]);
    if length > 0.35 {
        clamp(canvas, at, [outward[0] / length, outward[1] / length], 11.0);
    } else {
        wall(canvas, at);
    }
}

/// A wall across `outward` with hatching behind it.
pub fn clamp(canvas: &mut Canvas, at: [f64; 2], outward: [f64; 2], half: f64) {
    let along = [-outward[1], outward[0]];
    let place =
        |a: f64, o: f64| [at[0] + a * along[0] + o * outward[0], at[1] + a * along[1] + o * outward[1]];
    canvas.line(place(-half, 0.0), place(half, 0.0), &Style::line(INK, 1.8));
    let hatch = Style::line(INK, 0.9);
    let count = (half / 2.2).round() as i32;
    for i in 0..=count {
        let a = half * (2.0 * f64::from(i) / f64::from(count) - 1.0);
        canvas.line(place(a, 0.0), place(a - 4.0, 6.0), &hatch);
    }
}

/// A wall that is seen from the front.
fn wall(canvas: &mut Canvas, at: [f64; 2]) {
    const HALF: f64 = 8.0;
    let corner = |x: f64, y: f64| [at[0] + x * HALF, at[1] + y * HALF];
    let outline = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    canvas.polygon(&outline, "none", &Style::line(INK, 1.1));
    let hatch = Style::line(INK, 0.7);
    for i in -2..=2 {
        // The diagonal x + y = c, cut at the square's edges.
        let c = 0.7 * f64::from(i);
        let (low, high) = ((c - 1.0f64).max(-1.0), (c + 1.0f64).min(1.0));
        canvas.line(corner(low, c - low), corner(high, c - high), &hatch);
    }
}

/// The triangle below a pin on the ground.
fn stand(canvas: &mut Canvas, at: [f64; 2]) {
    let below = |x: f64, y: f64| [at[0] + x, at[1] + y];
    canvas.polygon(&[at, below(-7.0, 12.0), below(7.0, 12.0)], "#ffffff", &Style::line(INK, 1.1));
    clamp(canvas, below(0.0, 12.0), [0.0, 1.0], 10.0);
}

/// A joint between two bodies, or one of them and the ground.
pub fn joint(canvas: &mut Canvas, panel: &Panel, joint: &JointMark) {
    let at = panel.point(&joint.point);
    let axis = panel.direction(&joint.axis);
    let length = axis[0].hypot(axis[1]);
    // Seen along its axis a joint has no direction on the sheet.
    let along = (length > 0.35).then(|| [axis[0] / length, axis[1] / length]);
    let outline = Style::line(INK, 1.3);
    let is_standing = matches!(joint.kind, JointKind::Revolute | JointKind::Universal | JointKind::Spherical);
    if joint.is_grounded && is_standing {
        stand(canvas, at);
    }
    match (joint.kind, along) {
        (JointKind::Weld, _) => {}
        // The boundaries themselves are drawn; this is where they touch.
        (JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling, _) => {
            canvas.circle(at, 2.6, LOAD, &Style::line("#ffffff", 0.8))
        }
        // It holds nothing, but what it measures and what springs it may carry is measured from here.
        (JointKind::Free, _) => canvas.circle(at, 9.0, "none", &Style::line(FAINT, 1.1).dashed("2 3")),
        (JointKind::Prismatic, Some(u)) => rails(canvas, at, u, 6.0, joint.is_grounded),
        (JointKind::Cylindrical, Some(u)) => {
            rails(canvas, at, u, 6.0, joint.is_grounded);
            canvas.circle(at, 3.6, "#ffffff", &outline);
        }
        (JointKind::Prismatic, None) => canvas.polygon(&square(at, 6.0), "none", &outline),
        (JointKind::Cylindrical, None) => {
            canvas.circle(at, 6.0, "none", &outline);
            canvas.circle(at, 3.0, "#ffffff", &outline);
        }
        (JointKind::Planar, Some(u)) => {
            // The plane from its side.
            rails(canvas, at, [-u[1], u[0]], 3.0, joint.is_grounded);
            canvas.circle(at, 1.6, INK, &Style::line(INK, 0.5));
        }
        (JointKind::Planar, None) => {
            canvas.polygon(&square(at, 8.0), "none", &outline);
            canvas.circle(at, 3.6, "#ffffff", &outline);
        }
        (JointKind::Revolute, Some(u)) if panel.depth(&joint.axis).abs() < 0.5 => {
            let place = across(at, u);
            let pin = [place(-7.0, -3.0), place(7.0, -3.0), place(7.0, 3.0), place(-7.0, 3.0)];
            canvas.polygon(&pin, "#ffffff", &outline);
        }
        (JointKind::Revolute, _) => canvas.circle(at, 4.2, "#ffffff", &outline),
        (JointKind::Universal, _) => {
            canvas.circle(at, 5.0, "#ffffff", &outline);
            let place = across(at, along.unwrap_or([1.0, 0.0]));
            canvas.line(place(-5.0, 0.0), place(5.0, 0.0), &Style::line(INK, 1.1));
            canvas.line(place(0.0, -5.0), place(0.0, 5.0), &Style::line(INK, 1.1));
        }
        (JointKind::Spherical, _) => {
            canvas.circle(at, 4.2, "#ffffff", &outline);
            canvas.circle(at, 1.4, INK, &Style::line(INK, 0.5));
        }
    }
}

/// Places by their distance along a direction and to its side.
fn across(at: [f64; 2], u: [f64; 2]) -> impl Fn(f64, f64) -> [f64; 2] {
    move |a, b| [at[0] + a * u[0] - b * u[1], at[1] + a * u[1] + b * u[0]]
}

fn square(at: [f64; 2], half: f64) -> [[f64; 2]; 4] {
    [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, y]| [at[0] + x, at[1] + y])
}

/// Two rails along a direction, hatched outside where they stand on the ground.
fn rails(canvas: &mut Canvas, at: [f64; 2], u: [f64; 2], gap: f64, is_grounded: bool) {
    let place = across(at, u);
    for side in [-gap, gap] {
        canvas.line(place(-17.0, side), place(17.0, side), &Style::line(INK, 1.3));
        for i in 0..if is_grounded { 6 } else { 0 } {
            let a = -15.0 + 6.0 * f64::from(i);
            let end = place(a - 3.0, side + 4.0 * f64::signum(side));
            canvas.line(place(a, side), end, &Style::line(INK, 0.8));
        }
    }
}

/// A cable: a thin line through its eyelets.
pub fn cable(canvas: &mut Canvas, panel: &Panel, cable: &CableMark) {
    let course = cable.course.iter().map(|point| panel.point(point));
    canvas.polyline(course, &Style::line(CABLE, 1.2));
    name_course(canvas, panel, &cable.course, &cable.name, CABLE);
    for guide in &cable.guides {
        eyelet(canvas, panel.point(guide));
    }
}

/// What a cable runs through.
pub fn eyelet(canvas: &mut Canvas, at: [f64; 2]) {
    canvas.circle(at, 2.4, "#ffffff", &Style::line(CABLE, 1.0));
}

/// A body's origin: hollow where it was, filled where it is, with its name. Where a joint's own mark sits, that is
/// left to be seen.
pub fn body(
    canvas: &mut Canvas,
    panel: &Panel,
    body: &BodyMark,
    joints: &[JointMark],
    labels: &mut Vec<[f64; 2]>,
) {
    let (before, now) = (panel.point(&body.initial), panel.point(&body.deformed));
    if (before[0] - now[0]).hypot(before[1] - now[1]) > 2.0 {
        diamond(canvas, before, false);
    }
    let is_covered = joints.iter().any(|joint| {
        let at = panel.point(&joint.point);
        let bare = matches!(joint.kind, JointKind::Weld | JointKind::Free | JointKind::Prismatic);
        !bare
            && !matches!(joint.kind, JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling)
            && (at[0] - now[0]).hypot(at[1] - now[1]) < 4.0
    });
    if !is_covered {
        diamond(canvas, now, true);
    }
    let name = super::shortened(&body.name, super::BODY_NAME);
    let width = 6.2 * name.chars().count() as f64;
    let is_near_the_edge = now[0] + 9.0 + width > panel.frame[0] + panel.frame[2];
    let (anchor, x) = if is_near_the_edge { ("end", now[0] - 6.0) } else { ("start", now[0] + 6.0) };
    // Labels of bodies that lie behind each other go one above the other.
    let mut label = [x, now[1] - 13.0];
    while labels.iter().any(|other| (other[1] - label[1]).abs() < 12.0 && (other[0] - label[0]).abs() < 60.0)
    {
        label[1] -= 12.0;
    }
    labels.push(label);
    canvas.text(label, &name, anchor, 11.0, INK);
}

/// The marker of a body.
pub fn diamond(canvas: &mut Canvas, at: [f64; 2], is_filled: bool) {
    const HALF: f64 = 5.5;
    let corners =
        [[at[0] - HALF, at[1]], [at[0], at[1] - HALF], [at[0] + HALF, at[1]], [at[0], at[1] + HALF]];
    if is_filled {
        canvas.polygon(&corners, INK, &Style::line("#ffffff", 1.0));
    } else {
        canvas.polygon(&corners, "#ffffff", &Style::line(FAINT, 1.1));
    }
}

/// A spring as a zigzag line with its name; one that runs over something as its course.
pub fn spring(canvas: &mut Canvas, panel: &Panel, spring: &SpringMark) {
    match spring.course[..] {
        [from, to] => zigzag(canvas, panel.point(&from), panel.point(&to)),
        _ => {
            let course = spring.course.iter().map(|point| panel.point(point));
            canvas.polyline(course, &Style::line(SPRING, 1.2));
        }
    }
    name_course(canvas, panel, &spring.course, &spring.name, SPRING);
}

/// A mass, with its name and size.
pub fn mass(canvas: &mut Canvas, panel: &Panel, mass: &MassMark) {
    let [x, y] = panel.point(&mass.point);
    canvas.circle([x, y], 3.4, INK, &Style::line("#ffffff", 0.8));
    let name = shortened(&mass.name, super::BODY_NAME);
    let text = format!("{name} {}", shown(mass.mass, "kg", 3));
    canvas.text([x + 7.0, y + 12.0], text.trim_start(), "start", 10.5, INK);
}

/// Names of the springs and cables of a scene that are drawn as lines.
pub fn names_of_strings(canvas: &mut Canvas, panel: &Panel, scene: &Scene) {
    for spring in &scene.springs {
        name_course(canvas, panel, &spring.course, &spring.name, SPRING);
    }
    for cable in &scene.cables {
        name_course(canvas, panel, &cable.course, &cable.name, CABLE);
    }
}

/// The name of something long and thin, beside its middle; none where it is seen from its end.
fn name_course(
    canvas: &mut Canvas,
    panel: &Panel,
    course: &[Vector3<f64>],
    name: &str,
    colour: &'static str,
) {
    let (Some(first), Some(last)) = (course.first(), course.last()) else { return };
    let middle = match course.len() {
        2 => (first + last) * 0.5,
        count => course[count / 2],
    };
    let ([x, y], [a, b], [c, d]) = (panel.point(&middle), panel.point(first), panel.point(last));
    if (a - c).hypot(b - d) > 30.0 {
        canvas.text([x + 7.0, y - 7.0], &shortened(name, 20), "start", 10.5, colour);
    }
}

/// Zigzag between two places; a line where these are close together.
pub fn zigzag(canvas: &mut Canvas, from: [f64; 2], to: [f64; 2]) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    let style = Style::line(SPRING, 1.2);
    if length < 24.0 {
        canvas.line(from, to, &style);
        return;
    }
    let (u, v) = ([dx / length, dy / length], [-dy / length, dx / length]);
    let place = |a: f64, b: f64| [from[0] + a * u[0] + b * v[0], from[1] + a * u[1] + b * v[1]];
    const TURNS: i32 = 6;
    let coil = 0.7 * length;
    let mut points = vec![from, place(0.5 * (length - coil), 0.0)];
    for i in 0..2 * TURNS {
        let a = 0.5 * (length - coil) + coil * (f64::from(i) + 0.5) / f64::from(2 * TURNS);
        points.push(place(a, if i % 2 == 0 { 5.0 } else { -5.0 }));
    }
    points.push(place(0.5 * (length + coil), 0.0));
    points.push(to);
    canvas.polyline(points.into_iter(), &style);
}

/// Force and moment of a point load.
pub fn load(canvas: &mut Canvas, panel: &Panel, load: &LoadMark) {
    let at = panel.point(&load.point);
    let force = panel.direction(&load.force);
    if force[0].hypot(force[1]) > 0.2 {
        let ahead = [at[0] + ARROW * force[0], at[1] + ARROW * force[1]];
        let behind = [at[0] - ARROW * force[0], at[1] - ARROW * force[1]];
        // The force pulls at its point, unless the arrow would leave the view: then it pushes.
        let (from, to) = if panel.holds(ahead) { (at, ahead) } else { (behind, at) };
        arrow(canvas, from, to, LOAD);
        // Beside the end that is away from the mechanism.
        let [x, y] = if panel.holds(ahead) { to } else { from };
        canvas.text([x + 6.0, y + 4.0], &shown(load.sizes[0], "N", 4), "start", 10.5, LOAD);
    }
    let depth = panel.depth(&load.moment);
    let moment = panel.direction(&load.moment);
    if depth.abs() > 0.5 {
        turn(canvas, at, depth > 0.0);
        canvas.text([at[0] + 19.0, at[1] - 8.0], &shown(load.sizes[1], "N*m", 4), "start", 10.5, LOAD);
    } else if moment[0].hypot(moment[1]) > 0.2 {
        // A moment's vector carries two heads.
        let tip = |length: f64| [at[0] + length * moment[0], at[1] + length * moment[1]];
        arrow(canvas, at, tip(ARROW), LOAD);
        arrow(canvas, at, tip(ARROW - 8.0), LOAD);
        let [x, y] = tip(ARROW);
        canvas.text([x + 6.0, y + 4.0], &shown(load.sizes[1], "N*m", 4), "start", 10.5, LOAD);
    }
}

/// A straight arrow.
pub fn arrow(canvas: &mut Canvas, from: [f64; 2], to: [f64; 2], colour: &'static str) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    let (u, v) = ([dx / length, dy / length], [-dy / length, dx / length]);
    let place = |a: f64, b: f64| [to[0] - a * u[0] + b * v[0], to[1] - a * u[1] + b * v[1]];
    canvas.line(from, place(4.0, 0.0), &Style::line(colour, 1.8));
    canvas.polygon(&[to, place(8.0, 3.4), place(8.0, -3.4)], colour, &Style::line(colour, 0.6));
}

/// Three quarters of a turn about a point, counter-clockwise or clockwise as seen.
fn turn(canvas: &mut Canvas, at: [f64; 2], is_counter_clockwise: bool) {
    const RADIUS: f64 = 15.0;
    let sense = if is_counter_clockwise { -1.0 } else { 1.0 };
    let place = |angle: f64| {
        let angle = sense * angle.to_radians();
        [at[0] + RADIUS * angle.cos(), at[1] + RADIUS * angle.sin()]
    };
    canvas.polyline((0..=24).map(|i| place(10.0 * f64::from(i))), &Style::line(LOAD, 1.8));
    arrow(canvas, place(236.0), place(262.0), LOAD);
}
