//! Shafts and a ring that buckle under torsion.

use crate::file::File;
use crate::path::{Path, crossings, miscounted};
use crate::{Case, Row};
use flexura_solution::{Crossing, PointKind};
use flexura_testkit::torsion::{greenhill, hockling, michell_twist, universal};
use std::f64::consts::PI;

pub const CASES: [Case; 3] = [
    Case {
        id: "hockling_shaft",
        title: "Shaft with both ends blocked but for the twist and the slide of one, L = 240, E = 71240, G = 27190, I = 0.0833, \
                J = 2.16 (`hockling_shaft.toml`): torque at which it gives way in two directions at once, 222.21; \
                unstable directions on both sides",
        citation: "T = 2x EI/L with tan x = x, 8.986819 (A. G. Greenhill, *Proc. Inst. Mech. Eng.* 34 (1883) 182; J. C. Simo and L. \
                   Vu-Quoc, *Comput. Methods Appl. Mech. Eng.* 58 (1986) 79)",
        needed: "1e-8; the digits printed",
        run: hockle,
        closed_form: None,
    },
    Case {
        id: "greenhill_shaft",
        title: "Shaft between two universal joints with parallel forks (`greenhill_shaft.toml`): first critical torque π EI/L, \
                second 2π EI/L. Greenhill's 2π EI/L belongs to ends under moments that keep the axis' direction, which are \
                not conservative and which no joint transmits; here it comes second",
        citation: "Ziegler's quasi-tangential torque: small motions of the straight shaft between crosses \
                   (`testkit/src/torsion.rs`; H. Ziegler, *Principles of Structural Stability* (1968)); 2π: A. G. Greenhill, \
                   *Proc. Inst. Mech. Eng.* 34 (1883) 182",
        needed: "1e-8; every count right",
        run: hooked,
        closed_form: None,
    },
    Case {
        id: "michell_ring",
        title: "Ring bent from a straight round wire whose ends were turned against each other (`michell_ring.toml`): angle \
                at which it leaves its plane, 2π√3 EI/GJ (2.2517 turns at Poisson's ratio 0.3), and the torsional moment \
                √3 EI/R then",
        citation: "J. H. Michell, *Messenger of Mathematics* 11 (1889) 181; E. E. Zajac, *J. Appl. Mech.* 29 (1962) 136",
        needed: "1e-8; the digits printed",
        run: twist,
        closed_form: None,
    },
];

fn hockle() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/hockling_shaft.toml"))?;
    let followed = file.trace(&[], &Path::of("torque", [0.0, 0.3]), 1e-10)?;
    let found = crossings(followed.first()?);
    let [point] = found[..] else { return Err(format!("{} branch points", found.len())) };
    let ratio = followed.number(point, "torque_ratio");
    let twofold = if point.kind == PointKind::Branch(Crossing::Multiple(2)) { 2.0 } else { f64::NAN };
    Ok(vec![
        Row::relative("torque, EI/L", hockling(), ratio, 1e-8),
        Row::absolute("torque, EI/L, as printed", 8.986819, ratio, 5e-7),
        Row::absolute("torque, N·mm, as printed", 222.21, 1e3 * point.parameter, 5e-3),
        Row::absolute("directions that give way", 2.0, twofold, 0.0),
        Row::absolute("those that are reported", 2.0, point.directions.len() as f64, 0.0),
        miscounted(followed.first()?, |torque| if torque < point.parameter { 0 } else { 2 }),
    ])
}

fn hooked() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/greenhill_shaft.toml"))?;
    let followed = file.trace(&[], &Path::of("torque", [0.0, 7.0]), 1e-10)?;
    let found = crossings(followed.first()?);
    let [first, second] = found[..] else { return Err(format!("{} branch points", found.len())) };
    let exact = universal(0.0).ok_or("no critical torque")?;
    Ok(vec![
        Row::relative("first critical torque, EI/L", exact, first.parameter, 1e-8),
        Row::relative("which is π", PI, first.parameter, 1e-8),
        Row::relative("second, Greenhill's, EI/L", greenhill(), second.parameter, 1e-8),
        Row::absolute("directions that give way", 1.0, first.directions.len() as f64, 0.0),
        miscounted(followed.first()?, |torque| usize::from(torque > PI) + usize::from(torque > greenhill())),
    ])
}

fn twist() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/michell_ring.toml"))?;
    let followed = file.trace(&[], &Path::of("twist", [0.0, 16.0]), 1e-10)?;
    let found = crossings(followed.first()?);
    let [point] = found[..] else { return Err(format!("{} branch points", found.len())) };
    let exact = michell_twist(1.3, 1.0);
    Ok(vec![
        Row::relative("angle, rad", exact, point.parameter, 1e-8),
        Row::absolute("turns, as printed", 2.2517, point.parameter / (2.0 * PI), 5e-5),
        Row::absolute("torsional moment, EI/R", 3f64.sqrt(), followed.number(point, "torque_ratio"), 1e-8),
        Row::vanishing("out of plane until then, R", followed.number(point, "height"), 1e-8),
        miscounted(followed.first()?, |angle| usize::from(angle > exact)),
    ])
}
