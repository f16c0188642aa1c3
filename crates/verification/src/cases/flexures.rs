//! Flexure mechanisms far out of their small motion, against the planar second method.

use crate::file::File;
use crate::{Case, Row};
use flexura_testkit::planar::{self, Beam, Body, End, Equilibrium, Mechanism};
use std::f64::consts::FRAC_PI_2;

const METHOD: &str = "Taylor series along every leaf, closed and balanced by Newton's method (`testkit/src/planar.rs`; \
                      Corliss and Chang, *ACM Trans. Math. Softw.* 8 (1982) 114)";

const fn case(id: &'static str, title: &'static str, run: crate::Run) -> Case {
    Case { id, title, citation: METHOD, needed: "1e-8 L, EI/L², EI/L, 1", run, closed_form: None }
}

pub const CASES: [Case; 5] = [
    case(
        "parallelogram_far",
        "`parallelogram_stage.toml` pushed up to 0.7 L: travel, shortening, pitch",
        parallelogram,
    ),
    case("cross_spring_far", "`cross_spring_pivot.toml` turned up to 80°: angle, centre shift", cross_spring),
    case("leaf_four_bar_far", "`leaf_four_bar.toml`: travel and turning of the coupler", leaf_four_bar),
    case("cartwheel_far", "`cartwheel_hinge.toml`: turning of stage and hub, centre shift", cartwheel),
    case(
        "bistable_far",
        "`bistable_beam.toml` led through its snap and beyond: force, side force and moment of the guide",
        bistable,
    ),
];

const TOLERANCE: f64 = 1e-8;
const SOLVE: f64 = 1e-10;

/// A straight leaf with a rectangular section.
#[derive(Clone, Copy)]
pub(super) struct Leaf {
    pub length: f64,
    pub bending: f64,
    pub stretch: f64,
}

impl Leaf {
    /// Of Young's modulus `young`, `thickness` in the plane and `width` across it.
    pub(super) fn new(young: f64, thickness: f64, width: f64, length: f64, stretches: bool) -> Self {
        let axial = young * thickness * width;
        Self {
            length,
            bending: axial * thickness * thickness / 12.0,
            stretch: if stretches { 1.0 / axial } else { 0.0 },
        }
    }

    fn beam(&self, start: End, end: End) -> Beam {
        let Leaf { length, bending, stretch } = *self;
        Beam { length, bending, stretch, curvature: 0.0, start, end }
    }

    fn force(&self) -> f64 {
        self.bending / (self.length * self.length)
    }

    fn moment(&self) -> f64 {
        self.bending / self.length
    }
}

/// The steel leaf of three of the files.
pub(super) fn steel(length: f64, stretches: bool) -> Leaf {
    Leaf::new(207e9, 0.2e-3, 10e-3, length, stretches)
}

fn free(rest: [f64; 3], load: [f64; 3]) -> Body {
    Body { rest, held: [None; 3], load }
}

fn follow(at: &dyn Fn(f64) -> Mechanism, steps: usize) -> Result<Equilibrium, String> {
    planar::solve(at, steps).map_err(|error| format!("{error:?}"))
}

fn parallelogram() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/parallelogram_stage.toml"))?;
    let l = 0.06;
    let leaf = Leaf::new(207e9, 0.3e-3, 10e-3, l, true);
    let mut rows = Vec::new();
    for push in [5.0, 20.0, 60.0] {
        let at = |fraction: f64| Mechanism {
            beams: [0.015, -0.015]
                .map(|y| leaf.beam(End::clamp(None, [0.0, y, 0.0]), End::clamp(Some(0), [0.0, y, 0.0])))
                .to_vec(),
            bodies: vec![free([l, 0.0, 0.0], [0.0, push * fraction, 0.0])],
        };
        let [x, y, angle] = follow(&at, 200)?.poses[0];
        let answer = file.solve(&[("push", push)], SOLVE)?;
        rows.push(Row::scaled(format!("travel at {push} N"), y, answer.number("travel"), l, TOLERANCE));
        rows.push(Row::scaled("shortening", l - x, answer.number("comes_nearer"), l, TOLERANCE));
        // The stage moves along z, so that a turn from x to z is one about -y.
        rows.push(Row::absolute("pitch", -angle, answer.number("pitch"), TOLERANCE));
    }
    Ok(rows)
}

fn cross_spring() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/cross_spring_pivot.toml"))?;
    let (l, angle) = (0.05, 45f64.to_radians());
    let leaf = steel(l, false);
    let mut rows = Vec::new();
    for torque in [0.02, 0.08] {
        let side = |angle: f64| {
            let (x, y) = (0.5 * l * angle.cos(), 0.5 * l * angle.sin());
            leaf.beam(End::clamp(None, [-x, -y, angle]), End::clamp(Some(0), [x, y, angle]))
        };
        let at = |fraction: f64| Mechanism {
            beams: vec![side(angle), side(-angle)],
            bodies: vec![free([0.0; 3], [0.0, 0.0, torque * fraction])],
        };
        let [x, y, turning] = follow(&at, 30)?.poses[0];
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let shift = answer.vector("shift");
        rows.push(Row::absolute(
            format!("turning at {torque} N·m"),
            turning,
            answer.number("turning"),
            TOLERANCE,
        ));
        rows.push(Row::scaled("centre shift along the bisector", x, shift[0], l, TOLERANCE));
        rows.push(Row::scaled("centre shift across it", y, shift[1], l, TOLERANCE));
        // A rigid turn by θ that takes the origin to u is one about (u + cot(θ/2) ẑ × u)/2.
        let cot = 1.0 / (0.5 * turning).tan();
        let centre = answer.vector("centre_of_turn");
        rows.push(Row::scaled("centre of the turn, x", 0.5 * (x - cot * y), centre[0], l, TOLERANCE));
        rows.push(Row::scaled("centre of the turn, y", 0.5 * (y + cot * x), centre[1], l, TOLERANCE));
    }
    Ok(rows)
}

fn leaf_four_bar() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/leaf_four_bar.toml"))?;
    let (l, half, lean) = (0.05, 0.03, 15f64.to_radians());
    let leaf = steel(l, false);
    let mut rows = Vec::new();
    for torque in [0.1, 0.4] {
        let side = |sign: f64| {
            let angle = FRAC_PI_2 + sign * lean;
            let foot = sign * half;
            let end = End::clamp(Some(0), [foot - sign * l * lean.sin(), 0.0, angle]);
            leaf.beam(End::clamp(None, [foot, 0.0, angle]), end)
        };
        let height = l * lean.cos();
        let at = |fraction: f64| Mechanism {
            beams: vec![side(-1.0), side(1.0)],
            bodies: vec![free([0.0, height, 0.0], [0.0, 0.0, torque * fraction])],
        };
        let [x, y, turning] = follow(&at, 40)?.poses[0];
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let travel = answer.vector("travel");
        rows.push(Row::absolute(
            format!("turning at {torque} N·m"),
            turning,
            answer.number("turning"),
            TOLERANCE,
        ));
        rows.push(Row::scaled("travel along x", x, travel[0], l, TOLERANCE));
        rows.push(Row::scaled("travel along y", y - height, travel[1], l, TOLERANCE));
    }
    Ok(rows)
}

fn cartwheel() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/cartwheel_hinge.toml"))?;
    let (half, angle) = (0.025, 45f64.to_radians());
    let leaf = steel(half, false);
    let mut rows = Vec::new();
    for torque in [0.02, 0.2] {
        let beams = |angle: f64| {
            let (x, y) = (half * angle.cos(), half * angle.sin());
            let base = leaf.beam(End::clamp(None, [-x, -y, angle]), End::clamp(Some(0), [0.0, 0.0, angle]));
            let stage = leaf.beam(End::clamp(Some(0), [0.0, 0.0, angle]), End::clamp(Some(1), [x, y, angle]));
            [base, stage]
        };
        let at = |fraction: f64| Mechanism {
            beams: [beams(angle), beams(-angle)].concat(),
            bodies: vec![free([0.0; 3], [0.0; 3]), free([0.0; 3], [0.0, 0.0, torque * fraction])],
        };
        let found = follow(&at, 40)?;
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let shift = answer.vector("shift");
        let [x, y, turning] = found.poses[1];
        rows.push(Row::absolute(
            format!("turning at {torque} N·m"),
            turning,
            answer.number("turning"),
            TOLERANCE,
        ));
        rows.push(Row::absolute("hub", found.poses[0][2], answer.number("hub_turning"), TOLERANCE));
        rows.push(Row::scaled("centre shift, x", x, shift[0], half, TOLERANCE));
        rows.push(Row::scaled("centre shift, y", y, shift[1], half, TOLERANCE));
    }
    Ok(rows)
}

/// The inclined beam of the file with its shuttle at `travel` and turned by `tilt`.
fn inclined(travel: f64, tilt: f64) -> Mechanism {
    let (l, slope) = (0.05, 5f64.to_radians());
    let leaf = Leaf::new(1.4e9, 0.6e-3, 8e-3, l, true);
    let (x, y) = (l * slope.cos(), l * slope.sin());
    Mechanism {
        beams: vec![leaf.beam(End::clamp(None, [0.0, 0.0, slope]), End::clamp(Some(0), [0.0, 0.0, slope]))],
        bodies: vec![Body {
            rest: [x, y, 0.0],
            held: [Some(x), Some(y - travel), Some(tilt)],
            load: [0.0; 3],
        }],
    }
}

fn bistable() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/bistable_beam.toml"))?;
    let l = 0.05;
    let leaf = Leaf::new(1.4e9, 0.6e-3, 8e-3, l, true);
    let mut rows = Vec::new();
    for travel in [0.5e-3, 2e-3, 5e-3, 6.7e-3, 8e-3] {
        // The beam first bends into an S; at 4π²EI/L² along it, it buckles to one side or the other. A passing tilt leads
        // the reference to either; they differ in the moment, which guide and clamp exchange.
        let bowed = |tilt: f64| {
            follow(&|fraction| inclined(travel * fraction, 4.0 * tilt * fraction * (1.0 - fraction)), 150)
        };
        let answer = file.solve(&[("travel", travel)], SOLVE)?;
        let found = answer.number("guide_moment");
        let (up, down) = (bowed(0.02)?.reactions[0], bowed(-0.02)?.reactions[0]);
        let [x, y, moment] = if (up[2] - found).abs() < (down[2] - found).abs() { up } else { down };
        let unit = leaf.force();
        rows.push(Row::scaled(format!("force at {travel} m"), -y, answer.number("force"), unit, TOLERANCE));
        rows.push(Row::scaled("side force", x, answer.number("side_force"), unit, TOLERANCE));
        rows.push(Row::scaled("moment", moment, found, leaf.moment(), TOLERANCE));
    }
    Ok(rows)
}
