//! Springs: their courses, lengths and laws, worked out again.

use super::actions::Action;
use super::answer::{Answer, Check, V};
use flexura::model::{ExponentialForm, Obstacle, Spring, SpringLaw, Turn};
use flexura::spatial::Pose;
use std::f64::consts::TAU;

/// The shortest way from one point to another.
pub struct Course {
    pub length: f64,
    /// Unit vectors from the ends along it.
    pub away: [V; 2],
}

fn straight(from: &V, to: &V) -> Course {
    let span = to - from;
    let u = span / span.norm();
    Course { length: span.norm(), away: [u, -u] }
}

/// Over an obstacle in `frame`, or straight.
pub fn course(from: &V, to: &V, wrap: Option<(&Pose, &Obstacle)>) -> Course {
    let Some((frame, obstacle)) = wrap else { return straight(from, to) };
    let (a, b) = (from - frame.position, to - frame.position);
    match obstacle {
        Obstacle::Sphere { radius } => {
            let normal = a.cross(&b);
            let angle = normal.norm().atan2(a.dot(&b));
            round(from, to, &a, &b, *radius, angle, &normal.normalize(), &V::zeros())
        }
        Obstacle::Cylinder { radius, axis, turn } => {
            let axis = frame.rotation * axis;
            let flat = |v: &V| v - axis * axis.dot(v);
            let (x, y) = (flat(&a), flat(&b));
            let signed = axis.dot(&x.cross(&y)).atan2(x.dot(&y));
            let (angle, normal) = match turn {
                None => (signed.abs(), axis * signed.signum()),
                Some(Turn::Positive) => (signed.rem_euclid(TAU), axis),
                Some(Turn::Negative) => ((-signed).rem_euclid(TAU), -axis),
            };
            let along = axis * axis.dot(&(b - a));
            round(from, to, &x, &y, *radius, angle, &normal, &along)
        }
    }
}

/// Two tangents and an arc in the plane of `a` and `b`, across `normal`, drawn out by `along` beside it.
#[expect(clippy::too_many_arguments, reason = "the numbers of one figure")]
fn round(from: &V, to: &V, a: &V, b: &V, radius: f64, angle: f64, normal: &V, along: &V) -> Course {
    let (alpha, beta) = ((radius / a.norm()).acos(), (radius / b.norm()).acos());
    let arc = angle - alpha - beta;
    if !(arc > 0.0) {
        return straight(from, to);
    }
    let (first, last) = (radius * alpha.tan(), radius * beta.tan());
    let flat = first + radius * arc + last;
    let length = flat.hypot(along.norm());
    // From each end the tangent in the plane, seen towards the arc.
    let tangent = |end: &V, half: f64, sense: f64| {
        let u = end / end.norm();
        let touch = (u * half.cos() + normal.cross(&u) * (sense * half.sin())) * radius;
        (touch - end).normalize()
    };
    let away = [tangent(a, alpha, 1.0), tangent(b, beta, -1.0)];
    Course { length, away: [(away[0] * flat + along) / length, (away[1] * flat - along) / length] }
}

/// Tension at a length.
pub fn tension(spring: &Spring, rest: f64, length: f64) -> f64 {
    let size = spring.size;
    let x = length - rest;
    let strain = x / rest;
    match &spring.law {
        SpringLaw::Linear { stiffness, tension_only } => {
            if *tension_only && x < 0.0 {
                0.0
            } else {
                size * stiffness * x
            }
        }
        _ if !matches!(spring.law, SpringLaw::Table { .. }) && x < 0.0 => 0.0,
        SpringLaw::Exponential { area, exponent, stress, form } => {
            let less = if *form == ExponentialForm::Continuous { 1.0 } else { 0.0 };
            size * size * area / (1.0 + strain) * stress * ((exponent * strain).exp() - less)
        }
        SpringLaw::Toe { axial_stiffness, toe_strain } => {
            let by_strain = if strain < *toe_strain {
                strain * strain / (2.0 * toe_strain)
            } else {
                strain - 0.5 * toe_strain
            };
            size * size * axial_stiffness * by_strain
        }
        SpringLaw::Table { rows } => size * size * table(rows, x / size),
    }
}

/// A monotone cubic through the rows (F. N. Fritsch and J. Butland, *SIAM J. Sci. Stat. Comput.* 5 (1984) 300).
fn table(rows: &[[f64; 2]], x: f64) -> f64 {
    let n = rows.len();
    let chord = |i: usize| (rows[i + 1][1] - rows[i][1]) / (rows[i + 1][0] - rows[i][0]);
    let width = |i: usize| rows[i + 1][0] - rows[i][0];
    let slope = |i: usize| -> f64 {
        if n == 2 {
            return chord(0);
        }
        let end = |near: usize, far: usize| {
            let (h, g) = (width(near), width(far));
            (((2.0 * h + g) * chord(near) - h * chord(far)) / (h + g)).clamp(0.0, 3.0 * chord(near))
        };
        if i == 0 {
            return end(0, 1);
        }
        if i == n - 1 {
            return end(n - 2, n - 3);
        }
        let (c, d) = (chord(i - 1), chord(i));
        if c * d <= 0.0 {
            return 0.0;
        }
        let (u, v) = (2.0 * width(i) + width(i - 1), width(i) + 2.0 * width(i - 1));
        (u + v) / (u / c + v / d)
    };
    if x < rows[0][0] {
        return if rows[0][1] == 0.0 { 0.0 } else { rows[0][1] + slope(0) * (x - rows[0][0]) };
    }
    let Some(i) = (0..n - 1).find(|i| x < rows[i + 1][0]) else {
        return rows[n - 1][1] + slope(n - 1) * (x - rows[n - 1][0]);
    };
    let h = width(i);
    let t = (x - rows[i][0]) / h;
    // Hermite's basis.
    let (t2, t3) = (t * t, t * t * t);
    rows[i][1] * (1.0 - 3.0 * t2 + 2.0 * t3)
        + rows[i + 1][1] * (3.0 * t2 - 2.0 * t3)
        + h * slope(i) * (t - 2.0 * t2 + t3)
        + h * slope(i + 1) * (t3 - t2)
}

/// The course of a spring now or in the undeformed mechanism.
fn course_of(answer: &Answer, spring: &Spring, at_rest: bool) -> Option<Course> {
    let pose = |mount| if at_rest { answer.at_rest(mount, 0) } else { Some(answer.carried(mount)) };
    let from = pose(&spring.from.mount)?.point(&spring.from.point);
    let to = pose(&spring.to.mount)?.point(&spring.to.point);
    match &spring.wrap {
        None => Some(course(&from, &to, None)),
        Some(wrap) => {
            let frame = pose(&wrap.frame.mount)? * wrap.frame.pose;
            Some(course(&from, &to, Some((&frame, &wrap.obstacle))))
        }
    }
}

fn rest_length(answer: &Answer, spring: &Spring) -> Option<f64> {
    match spring.rest_length {
        Some(length) => Some(length * spring.size),
        None => course_of(answer, spring, true).map(|course| course.length),
    }
}

/// What it pulls its ends and what it runs over with: the tension that the document tells, along its course.
pub fn actions(answer: &Answer, index: usize) -> Vec<Action> {
    let spring = &answer.model.springs[index];
    let told = answer.document.springs.get(&spring.name);
    let (Some(told), Some(course)) = (told, course_of(answer, spring, false)) else { return Vec::new() };
    if told.tension == 0.0 {
        return Vec::new();
    }
    let ends = [(&spring.from, course.away[0]), (&spring.to, course.away[1])];
    let mut actions: Vec<Action> = ends
        .into_iter()
        .map(|(end, away)| Action {
            on: end.mount,
            point: answer.point(end),
            force: away * told.tension,
            moment: V::zeros(),
            is_load: false,
        })
        .collect();
    if let Some(wrap) = &spring.wrap {
        let center = answer.frame(&wrap.frame).position;
        let force = -(actions[0].force + actions[1].force);
        let moment = -(actions[0].about(&center) + actions[1].about(&center));
        actions.push(Action { on: wrap.frame.mount, point: center, force, moment, is_load: false });
    }
    actions
}

/// Lengths and tensions.
pub fn checks(answer: &Answer, checks: &mut Vec<Check>) {
    for spring in &answer.model.springs {
        let Some(told) = answer.document.springs.get(&spring.name) else { continue };
        let (Some(course), Some(rest)) = (course_of(answer, spring, false), rest_length(answer, spring))
        else {
            continue;
        };
        let unit = answer.length.max(course.length);
        checks.push(Check {
            what: format!("length of spring.{}", spring.name),
            difference: (course.length - told.length).abs() / unit,
        });
        // What a length that is right to the last digits leaves open of the tension is no fault of it.
        let h = 1e-9 * unit;
        let wanted = tension(spring, rest, told.length);
        let slope = (tension(spring, rest, told.length + h) - wanted).abs() / h;
        let off = (wanted - told.tension).abs() / (answer.force + wanted.abs() + slope * unit);
        checks.push(Check { what: format!("law of spring.{}", spring.name), difference: off });
    }
}

/// What is stored in it: the law from where it vanishes.
pub fn energy(answer: &Answer, spring: &Spring) -> Option<f64> {
    let told = answer.document.springs.get(&spring.name)?;
    let rest = rest_length(answer, spring)?;
    if let SpringLaw::Table { rows } = &spring.law
        && rows[0] != [0.0, 0.0]
    {
        return None;
    }
    // A law that jumps at slack would be met at the jump.
    if tension(spring, rest, told.length) == 0.0 {
        return Some(0.0);
    }
    let parts = 4000;
    let h = (told.length - rest) / f64::from(parts);
    let f = |i: i32| tension(spring, rest, rest + h * f64::from(i));
    Some((0..parts / 2).map(|i| f(2 * i) + 4.0 * f(2 * i + 1) + f(2 * i + 2)).sum::<f64>() * h / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_course_over_a_cylinder_is_the_unrolled_straight_line() {
        // Half way round a cylinder of radius 1 from tangent to tangent, 3 aside.
        let cylinder = Obstacle::Cylinder { radius: 1.0, axis: V::z(), turn: None };
        let (from, to) = (V::new(-2.0, -1.0, 0.0), V::new(-2.0, 1.0, 3.0));
        let way = course(&from, &to, Some((&Pose::identity(), &Obstacle::Sphere { radius: 1.0 })));
        assert!(way.length >= (to - from).norm());
        let turned = Obstacle::Cylinder { radius: 1.0, axis: V::z(), turn: Some(Turn::Positive) };
        let way = course(&from, &to, Some((&Pose::identity(), &turned)));
        assert!((way.length - (4.0 + PI).hypot(3.0)).abs() < 1e-12, "{}", way.length);
        let short = course(&from, &to, Some((&Pose::identity(), &cylinder)));
        assert!((short.length - (to - from).norm()).abs() < 1e-12);
    }

    #[test]
    fn a_course_over_a_sphere_lies_in_a_great_circle() {
        let sphere = Obstacle::Sphere { radius: 1.0 };
        let (from, to) = (V::new(-2.0, 0.1, 0.0), V::new(2.0, 0.1, 0.0));
        let way = course(&from, &to, Some((&Pose::identity(), &sphere)));
        let d = from.norm();
        let arc = 2.0 * (2.0f64 / d).asin() - 2.0 * (1.0 / d).acos();
        assert!((way.length - (2.0 * (d * d - 1.0).sqrt() + arc)).abs() < 1e-12);
    }
}
