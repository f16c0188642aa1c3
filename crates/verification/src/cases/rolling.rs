//! Joints that roll and slide: the thesis's ellipses, its knee, and a beam on a wheel.

use crate::file::{Answer, File};
use crate::measure::worst;
use crate::{Case, Row};
use flexura_testkit::elastica::Elastica;
use flexura_testkit::elliptic::second;
use flexura_testkit::roots::root;
use std::f64::consts::{FRAC_PI_2, PI};

pub const CASES: [Case; 7] = [
    Case {
        id: "ellipse_on_circle",
        title: "Example 3.1.1: an ellipse (2, 1 cm) rolls on a circle (1 cm) without slip (`ellipse_on_circle.toml`)",
        citation: "arc lengths as elliptic integrals of the second kind, tan ψ = (a/b) tan γ; printed values at γ = 90°",
        needed: "1e-8",
        run: on_circle,
        closed_form: None,
    },
    Case {
        id: "ellipse_sliding",
        title: "Example 3.1.2: the same with a sliding velocity of ω b²/a (`ellipse_sliding.toml`); the contact stands still where ψ = 90°",
        citation: "elliptic integrals, s_B = s_A - v_r t; printed values at γ = 30°",
        needed: "1e-8",
        run: sliding,
        closed_form: None,
    },
    Case {
        id: "ellipse_on_ellipse",
        title: "Example 3.1.3, case 1(a): an ellipse (2, 1) on one of (2.5, 1) (`ellipse_on_ellipse.toml`)",
        citation: "elliptic integrals; the parent's angle by bracketing",
        needed: "1e-8",
        run: on_ellipse,
        closed_form: None,
    },
    Case {
        id: "ellipse_in_bowl",
        title: "Example 3.1.3, case 1(b): the same in a half bowl (`ellipse_in_bowl.toml`), and where its motion ends",
        citation: "elliptic integrals; at the end the child's arc is a quarter of the bowl's ellipse",
        needed: "1e-8",
        run: in_bowl,
        closed_form: None,
    },
    Case {
        id: "explicit_recipe",
        title: "Table 3.1's explicit steps beside the exact travel (`explicit_recipe.toml`): ψ after 6 s in steps of 1 s, and the order",
        citation: "ψ = 98.532°; the error of Euler's method falls with the first power of the step",
        needed: "1e-3 degrees; the order to 2 %",
        run: recipe,
        closed_form: None,
    },
    Case {
        id: "knee_slide",
        title: "The knee's roll and slide (3.10a, b) (`knee_ellipses.toml`): where the femur slides forwards, and the slope of roll on slide over 0 to 90°",
        citation: "roots of the derivative of (3.10b); least squares of the two polynomials, the integrals worked out as sums",
        needed: "1e-4",
        run: knee,
        closed_form: None,
    },
    Case {
        id: "rolling_beam",
        title: "A cantilever clamped to a wheel that rolls on a plane against a spring, its tip loaded (`rolling_beam.toml`)",
        citation: "elastica by elliptic functions; moments about the contact, their root by bracketing",
        needed: "1e-8",
        run: beam,
        closed_form: None,
    },
];

/// Arc of an ellipse (a >= b) from the end of its minor axis to the eccentric angle ψ from there: a E(ψ, 1 - b²/a²).
fn arc(a: f64, b: f64, psi: f64) -> f64 {
    a * second(psi, (b / a).powi(2))
}

/// Eccentric angle from the minor axis's end at which the tangent has turned by γ, between 0 and 180 degrees.
fn eccentric(a: f64, b: f64, gamma: f64) -> f64 {
    (a * gamma.sin()).atan2(b * gamma.cos())
}

/// The tangent's turning at an eccentric angle.
fn turning(a: f64, b: f64, psi: f64) -> f64 {
    let whole = (psi / PI).round();
    whole * PI + (b * (psi - whole * PI).sin()).atan2(a * (psi - whole * PI).cos())
}

const ELLIPSE: (f64, f64) = (2.0, 1.0);

/// ψ and φ of the ellipse (2, 1) that has turned by γ on another one, having slid by `slide`.
fn contact(parent: (f64, f64), gamma: f64, slide: f64) -> Result<[f64; 2], String> {
    let (a, b) = ELLIPSE;
    let psi = eccentric(a, b, gamma);
    let travel = arc(a, b, psi) - slide;
    let phi =
        root(|phi| arc(parent.0, parent.1, phi) - travel, 0.0, 10.0).ok_or("no contact on the parent")?;
    Ok([psi, phi])
}

fn file(text: &str) -> Result<File, String> {
    File::new(text)
}

fn degrees(answer: &Answer, name: &str) -> f64 {
    answer.number(name).to_degrees()
}

fn angle(quantity: &str, reference: f64, ours: f64) -> Row {
    Row::scaled(quantity, reference, ours, 1.0, 1e-8)
}

fn on_circle() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/ellipse_on_circle.toml"))?;
    let at = |turned: f64| file.solve(&[("turned", turned)], 1e-12);
    let answer = at(FRAC_PI_2)?;
    let mut differences = Vec::new();
    for gamma in [0.2, 0.9, 1.4, 2.0, 2.9] {
        let [psi, phi] = contact((1.0, 1.0), gamma, 0.0)?;
        let ours = at(gamma)?;
        differences.push((ours.number("psi") - psi).abs());
        differences.push((ours.number("phi") - phi).abs());
        let turned = ours.number("angle") - (gamma + phi);
        differences.push((turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round()).abs());
    }
    Ok(vec![
        angle("ψ at γ = 90° / °", 90.0, degrees(&answer, "psi")),
        angle("s at γ = 90° / cm", 2.422_112_055_1, 100.0 * answer.number("roll")),
        angle("φ at γ = 90° / °", 138.776_798_267, degrees(&answer, "phi")),
        angle("α at γ = 90° / °", 228.776_798_267, degrees(&answer, "angle").rem_euclid(360.0)),
        angle("centre distance at γ = 90° / cm", 3.0, 100.0 * answer.number("distance")),
        Row::vanishing("ψ, φ and α at five γ, largest difference", worst(differences), 1e-10),
    ])
}

fn sliding() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/ellipse_sliding.toml"))?;
    let at = |turned: f64| file.solve(&[("turned", turned)], 1e-12);
    let answer = at(PI / 6.0)?;
    let mut differences = Vec::new();
    for gamma in [0.2, 0.9, 1.4, 2.0] {
        let [psi, phi] = contact((1.0, 1.0), gamma, 0.5 * gamma)?;
        let ours = at(gamma)?;
        differences.push((ours.number("psi") - psi).abs());
        differences.push((ours.number("phi") - phi).abs());
    }
    let still = at(FRAC_PI_2)?;
    Ok(vec![
        angle("s_B at γ = 30° / cm", 1.305_506_584_7, 100.0 * answer.number("roll")),
        angle("φ at γ = 30° / °", 74.800_017_434, degrees(&answer, "phi")),
        angle("α at γ = 30° / °", 104.800_017_434, degrees(&answer, "angle")),
        angle(
            "φ at γ = 90° / °",
            (arc(2.0, 1.0, FRAC_PI_2) - 0.5 * FRAC_PI_2).to_degrees(),
            degrees(&still, "phi"),
        ),
        angle("velocity of the contact on B at γ = 90° / (cm/s)", 0.0, 100.0 * still.number("roll_velocity")),
        Row::vanishing("ψ and φ at four γ, largest difference", worst(differences), 1e-10),
    ])
}

fn on_ellipse() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/ellipse_on_ellipse.toml"))?;
    let at = |turned: f64| file.solve(&[("turned", turned)], 1e-12);
    let answer = at(FRAC_PI_2)?;
    let mut differences = Vec::new();
    for gamma in [0.2, 0.9, 1.4, 2.0, 2.9] {
        let [_, phi] = contact((2.5, 1.0), gamma, 0.0)?;
        let ours = at(gamma)?;
        differences.push((ours.number("phi") - phi).abs());
        let turned = ours.number("angle") - (gamma + turning(2.5, 1.0, phi));
        differences.push((turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round()).abs());
    }
    Ok(vec![
        angle("φ at γ = 90° / °", 66.848_561_540, degrees(&answer, "phi")),
        angle("α at γ = 90° / °", 133.090_082_098, degrees(&answer, "angle")),
        angle("centre distance at γ = 90° / cm", 4.107_100_566_7, 100.0 * answer.number("distance")),
        Row::vanishing("φ and α at five γ, largest difference", worst(differences), 1e-10),
    ])
}

fn in_bowl() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/ellipse_in_bowl.toml"))?;
    let at = |turned: f64| file.solve(&[("turned", turned)], 1e-12);
    let answer = at(FRAC_PI_2)?;
    let mut differences = Vec::new();
    for gamma in [0.2, 0.9, 1.4, 2.0] {
        let [_, phi] = contact((2.5, 1.0), gamma, 0.0)?;
        differences.push((at(gamma)?.number("angle") - (gamma - turning(2.5, 1.0, phi))).abs());
    }
    // The child's arc is a quarter of the bowl's ellipse where the motion ends.
    let quarter = arc(2.5, 1.0, FRAC_PI_2);
    let psi = root(|psi| arc(2.0, 1.0, psi) - quarter, 1.0, 3.0).ok_or("no end")?;
    let end = turning(2.0, 1.0, psi);
    let inside = at(end - 1e-8).is_ok();
    let outside = at(end + 1e-8).is_err();
    Ok(vec![
        angle("α at γ = 90° / °", 46.909_917_902, degrees(&answer, "angle")),
        angle("centre distance at γ = 90° / cm", 1.417_274_499_3, 100.0 * answer.number("distance")),
        Row::vanishing("α at four γ, largest difference", worst(differences), 1e-10),
        Row::scaled(
            "motion ends within 1e-8 of the end of the arcs",
            1.0,
            f64::from(u8::from(inside && outside)),
            1.0,
            0.0,
        ),
    ])
}

fn recipe() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/explicit_recipe.toml"))?;
    let psi = |step: f64| -> Result<f64, String> {
        Ok(degrees(&file.solve(&[("step", step)], 1e-12)?, "psi_stepped"))
    };
    let (coarse, fine) = (psi(0.05)? - 90.0, psi(0.025)? - 90.0);
    Ok(vec![
        Row::scaled("ψ after 6 s in steps of 1 s / °", 98.532, psi(1.0)?, 1.0, 1e-3),
        Row::scaled("error in steps of 0.05 s over that in half of them", 2.0, coarse / fine, 2.0, 0.02),
    ])
}

fn roll(t: f64) -> f64 {
    ((((0.093 * t - 0.409) * t + 0.57) * t - 0.448) * t + 0.926) * t
}

fn slide(t: f64) -> f64 {
    ((((0.334 * t - 1.518) * t + 2.12) * t - 0.996) * t + 0.513) * t
}

fn slide_rate(t: f64) -> f64 {
    (((5.0 * 0.334 * t - 4.0 * 1.518) * t + 3.0 * 2.12) * t - 2.0 * 0.996) * t + 0.513
}

fn knee() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/knee_ellipses.toml"))?;
    let at = |flexion: f64| file.solve(&[("flexion", flexion)], 1e-11);
    // Our own slide velocity changes its sign there.
    let zero = |from: f64, to: f64| {
        root(|q| at(q).map_or(f64::NAN, |answer| answer.number("slide_velocity")), from, to)
            .ok_or("the slide velocity keeps its sign")
    };
    let theirs = |from: f64, to: f64| root(slide_rate, from, to).ok_or("(3.10b) has no such root");
    let (first, second) = (zero(1.2, 1.5)?, zero(1.8, 2.1)?);
    let mut differences = Vec::new();
    for i in 0..=90 {
        let q = f64::from(i).to_radians();
        let answer = at(q)?;
        differences.push((answer.number("measured_roll") / 0.0253 - roll(q)).abs());
        differences.push((answer.number("slide") / 0.0253 - slide(q)).abs());
    }
    let line = fit(|q| (slide(q), roll(q)), 0.0, FRAC_PI_2);
    let mean = {
        let n = 200_000;
        (1..=n)
            .map(|i| 120f64.to_radians() * f64::from(i) / f64::from(n))
            .map(|q| roll(q) / slide(q))
            .sum::<f64>()
            / f64::from(n)
    };
    Ok(vec![
        Row::absolute("slides forwards from / °", 78.161, first.to_degrees(), 1e-3),
        Row::absolute("to / °", 112.855, second.to_degrees(), 1e-3),
        Row::vanishing(
            "the same from (3.10b), largest difference",
            worst([first - theirs(1.2, 1.5)?, second - theirs(1.8, 2.1)?].map(f64::abs)),
            1e-9,
        ),
        Row::vanishing("roll and slide at 91 angles in r_maj, largest difference", worst(differences), 1e-12),
        Row::absolute("least-squares slope of roll on slide, 0 to 90°", 1.6897, line, 1e-4),
        Row::absolute("mean ratio of roll to slide over (0, 120°]", 1.979, mean, 1e-3),
    ])
}

/// Slope of the least-squares line through the origin and many points (x, y)(q).
fn fit(point: impl Fn(f64) -> (f64, f64), from: f64, to: f64) -> f64 {
    let n = 20_000;
    let points = (0..=n).map(|i| point(from + (to - from) * f64::from(i) / f64::from(n)));
    let (top, bottom) = points.fold((0.0, 0.0), |sum, p| (sum.0 + p.0 * p.1, sum.1 + p.0 * p.0));
    top / bottom
}

/// The wheel's angle under a tip load P (EI = L = 1): the spring holds the moment of the load about the contact.
fn wheel(load: f64, spring: f64) -> Option<f64> {
    let off = |q: f64| {
        let tip = Elastica::dead(load, -FRAC_PI_2 - q).tip();
        let [x, y] = tip.position;
        -load * (q.cos() * x - q.sin() * y) - spring * q
    };
    root(off, -1.5, 0.0)
}

fn beam() -> Result<Vec<Row>, String> {
    let file = file(include_str!("../../../../models/rolling_beam.toml"))?;
    let mut rows = Vec::new();
    for load in [0.5, 2.0, 6.0] {
        let answer = file.solve(&[("load", load)], 1e-11)?;
        let q = wheel(load, 1.5).ok_or("no root")?;
        let [x, y] = Elastica::dead(load, -FRAC_PI_2 - q).tip().position;
        let tip = [-0.2 * q + q.cos() * x - q.sin() * y, 0.2 + q.sin() * x + q.cos() * y];
        rows.push(Row::scaled(
            format!("angle of the wheel under P = {load}"),
            q,
            answer.number("angle"),
            1.0,
            1e-8,
        ));
        rows.push(Row::scaled(
            format!("x of the tip under P = {load}"),
            tip[0],
            answer.number("x"),
            1.0,
            1e-8,
        ));
        rows.push(Row::scaled(
            format!("y of the tip under P = {load}"),
            tip[1],
            answer.number("y"),
            1.0,
            1e-8,
        ));
    }
    Ok(rows)
}
