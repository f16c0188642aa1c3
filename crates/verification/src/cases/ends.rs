//! The ends of Table 5.1: what is known there, and the same with known and unknown exchanged.

use crate::file::{File, asking};
use crate::{Case, Row};
use flexura_testkit::bow::Bow;
use flexura_testkit::elastica::{Elastica, Station};
use flexura_testkit::planar::{self, Beam, Body, End, Mechanism};

pub const CASES: [Case; 5] = [
    Case {
        id: "ends_cantilever",
        title: "Table 5.1, type 1, `ends_cantilever.toml`: loads at a free end known, place wanted; and the loads that \
                reach a given place",
        citation: "elliptic integrals (Love, 1927, §§262-263)",
        needed: "1e-9",
        run: cantilever,
        closed_form: None,
    },
    Case {
        id: "ends_clamped",
        title: "`ends_clamped.toml`: place and angle of a clamp known, force and moment wanted; and the place that gives \
                known ones",
        citation: "part of an elastica of elliptic integrals, whose curvature at rest adds EI κ to the moment",
        needed: "1e-9",
        run: clamped,
        closed_form: None,
    },
    Case {
        id: "ends_pinned",
        title: "Table 5.1, type 2, `ends_pinned.toml`: bow hinged at both ends, pushed; and the push for a known slide",
        citation: "the pendulum's elliptic functions with the bow's rest curvature as slope at the ends",
        needed: "1e-9",
        run: pinned,
        closed_form: None,
    },
    Case {
        id: "ends_slide_fixed",
        title: "Table 5.1, type 3, `ends_slide_fixed.toml`: bow clamped at both ends, one of them sliding; and the push \
                for a known slide",
        citation: "the same with the ends' directions kept",
        needed: "1e-9",
        run: slide_fixed,
        closed_form: None,
    },
    Case {
        id: "ends_slide_offset_pin",
        title: "Table 5.1, type 4, `ends_slide_offset_pin.toml`: slider against a pin beside the strip; and the push for a \
                known turn of the lever",
        citation: "Taylor series along the strip, closed by Newton's method (Corliss and Chang, *ACM Trans. Math. \
                   Softw.* 8 (1982) 114)",
        needed: "1e-9",
        run: offset_pin,
        closed_form: None,
    },
];

const TOLERANCE: f64 = 1e-9;
/// Tolerance asked of the solver.
const SOLVE: f64 = 1e-11;

/// All files hold the same strip.
const L: f64 = 0.15;
const EI: f64 = 207e9 * 20e-3 * 0.5e-3 * 0.5e-3 * 0.5e-3 / 12.0;
const FORCE: f64 = EI / (L * L);
const MOMENT: f64 = EI / L;

/// The first part of an elastica that is longer than the strip: what the rest of it does to the strip's end.
struct Part {
    place: [f64; 3],
    force: [f64; 2],
    /// Divided by EI: the curvature there.
    curvature: f64,
}

fn part(share: f64, load: f64, angle: f64) -> Part {
    let whole = L / share;
    let Station { position, angle: slope, curvature } = Elastica::dead(load, angle).at(share);
    let force = load * EI / (whole * whole);
    Part {
        place: [whole * position[0], whole * position[1], slope],
        force: [force * angle.cos(), force * angle.sin()],
        curvature: curvature / whole,
    }
}

fn cantilever() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/ends_cantilever.toml");
    let mut rows = Vec::new();
    for (share, load, angle) in [(0.8, 3.0, 1.2), (0.6, 8.0, 2.4)] {
        let Part { place: [x, y, slope], force: [fx, fy], curvature } = part(share, load, angle);
        let torque = EI * curvature;
        let answer = File::new(text)?.solve(&[("push_x", fx), ("push_y", fy), ("torque", torque)], SOLVE)?;
        let with = format!("at FL²/EI = {:.2}", load * share * share);
        rows.push(Row::scaled(format!("x {with}"), x, answer.number("x"), L, TOLERANCE));
        rows.push(Row::scaled(format!("y {with}"), y, answer.number("y"), L, TOLERANCE));
        rows.push(Row::absolute(format!("slope {with}"), slope, answer.number("slope"), TOLERANCE));
        let guesses = [("push_x", 0.95 * fx), ("push_y", 0.95 * fy), ("torque", 0.95 * torque)];
        let targets = [("x", x), ("y", y), ("slope", slope)];
        let found = File::new(&asking(text, &guesses, &targets))?.solve(&[], SOLVE)?;
        rows.push(Row::scaled(format!("push_x {with}"), fx, found.parameter("push_x"), FORCE, TOLERANCE));
        rows.push(Row::scaled(format!("push_y {with}"), fy, found.parameter("push_y"), FORCE, TOLERANCE));
        rows.push(Row::scaled(
            format!("torque {with}"),
            torque,
            found.parameter("torque"),
            MOMENT,
            TOLERANCE,
        ));
    }
    Ok(rows)
}

fn clamped() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/ends_clamped.toml");
    let Part { place: [x, y, slope], force: [fx, fy], curvature } = part(0.7, 4.0, 1.8);
    let moment = EI * (curvature - 20f64.to_radians() / L);
    let answer = File::new(text)?.solve(&[("x", x), ("y", y), ("slope", slope)], SOLVE)?;
    // An inextensible strip bears any force where it can be straight: the guess is a place that it reaches.
    let guess = part(0.7, 3.4, 1.8).place;
    let guesses = [("x", guess[0]), ("y", guess[1]), ("slope", guess[2])];
    let targets = [("force_x", fx), ("force_y", fy), ("moment", moment)];
    let found = File::new(&asking(text, &guesses, &targets))?.solve(&[], SOLVE)?;
    Ok(vec![
        Row::scaled("force_x", fx, answer.number("force_x"), FORCE, TOLERANCE),
        Row::scaled("force_y", fy, answer.number("force_y"), FORCE, TOLERANCE),
        Row::scaled("moment", moment, answer.number("moment"), MOMENT, TOLERANCE),
        Row::scaled("x found", x, found.parameter("x"), L, TOLERANCE),
        Row::scaled("y found", y, found.parameter("y"), L, TOLERANCE),
        Row::absolute("slope found", slope, found.parameter("slope"), TOLERANCE),
    ])
}

/// The bow of the files: 10° between chord and tangents.
const BEND: f64 = 10.0 * std::f64::consts::PI / 180.0;

fn slide(bow: &Bow) -> f64 {
    L * BEND.sin() / BEND - bow.chord()
}

fn pinned() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/ends_pinned.toml");
    let mut rows = Vec::new();
    for push in [10.0, 20.0, 30.0] {
        let bow = Bow::hinged(L, 2.0 * BEND / L, push / EI);
        let answer = File::new(text)?.solve(&[("push", push)], SOLVE)?;
        rows.push(Row::scaled(
            format!("slide at {push} N"),
            slide(&bow),
            answer.number("slide"),
            L,
            TOLERANCE,
        ));
        rows.push(Row::scaled(format!("rise at {push} N"), bow.rise(), answer.number("rise"), L, TOLERANCE));
        rows.push(Row::scaled("moment at the hinge", 0.0, answer.number("end_moment"), MOMENT, TOLERANCE));
        let asked = asking(text, &[("push", 0.9 * push)], &[("slide", slide(&bow))]);
        let found = File::new(&asked)?.solve(&[], SOLVE)?.parameter("push");
        rows.push(Row::scaled("push found", push, found, FORCE, TOLERANCE));
    }
    Ok(rows)
}

fn slide_fixed() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/ends_slide_fixed.toml");
    let mut rows = Vec::new();
    for push in [40.0, 100.0] {
        let bow = Bow::clamped(L, 2.0 * BEND / L, push / EI);
        let answer = File::new(text)?.solve(&[("push", push)], SOLVE)?;
        rows.push(Row::scaled(
            format!("slide at {push} N"),
            slide(&bow),
            answer.number("slide"),
            L,
            TOLERANCE,
        ));
        rows.push(Row::scaled(format!("rise at {push} N"), bow.rise(), answer.number("rise"), L, TOLERANCE));
        // By the strip on the wall: the opposite of M/EI = θ' - κ of an arc that bends towards -y.
        let moment = -EI * bow.end_bending();
        rows.push(Row::scaled("wall moment", moment, answer.number("wall_moment"), MOMENT, TOLERANCE));
        rows.push(Row::scaled("side force", 0.0, answer.number("side_force"), FORCE, TOLERANCE));
        let asked = asking(text, &[("push", 0.9 * push)], &[("slide", slide(&bow))]);
        let found = File::new(&asked)?.solve(&[], SOLVE)?.parameter("push");
        rows.push(Row::scaled("push found", push, found, FORCE, TOLERANCE));
    }
    Ok(rows)
}

fn offset_pin() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/ends_slide_offset_pin.toml");
    let offset = 0.03;
    let mut rows = Vec::new();
    for push in [4.0, 12.0] {
        // The lever's origin is put at the pin.
        let at = |fraction: f64| Mechanism {
            beams: vec![Beam {
                length: L,
                bending: EI,
                stretch: 0.0,
                curvature: 0.0,
                start: End::clamp(Some(0), [0.0; 3]),
                end: End::clamp(Some(1), [0.0, offset, 0.0]),
            }],
            bodies: vec![
                Body {
                    rest: [0.0; 3],
                    held: [None, Some(0.0), Some(0.0)],
                    load: [push * fraction, 0.0, 0.0],
                },
                Body { rest: [L, -offset, 0.0], held: [Some(L), Some(-offset), None], load: [0.0; 3] },
            ],
        };
        let wanted = planar::solve(&at, 10).map_err(|error| format!("{error:?}"))?;
        let answer = File::new(text)?.solve(&[("push", push)], SOLVE)?;
        let turn = wanted.poses[1][2];
        rows.push(Row::scaled(
            format!("slide at {push} N"),
            wanted.poses[0][0],
            answer.number("slide"),
            L,
            TOLERANCE,
        ));
        rows.push(Row::absolute(format!("turn at {push} N"), turn, answer.number("turn"), TOLERANCE));
        let wrench = wanted.wrenches[0];
        rows.push(Row::scaled("end moment", wrench[3], answer.number("end_moment"), MOMENT, TOLERANCE));
        let side = wanted.reactions[0][1];
        rows.push(Row::scaled("side force", side, answer.number("side_force"), FORCE, TOLERANCE));
        let asked = asking(text, &[("push", 0.9 * push)], &[("turn", turn)]);
        let found = File::new(&asked)?.solve(&[], SOLVE)?.parameter("push");
        rows.push(Row::scaled("push found", push, found, FORCE, TOLERANCE));
    }
    Ok(rows)
}
