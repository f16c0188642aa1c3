//! What the models of the flexonic mobile node say.

use super::Fact;
use crate::cases::recipe;
use crate::file::File;
use crate::path::{Followed, Path, events, folds};
use flexura_solution::{BranchOrigin, PointKind};

const CORNER: &str = include_str!("../../../../models/node_corner.toml");
const NARROW: &str = include_str!("../../../../models/node_narrow_corner.toml");
const SENSOR: &str = include_str!("../../../../models/node_sensor.toml");
const LAMINATE: &str = include_str!("../../../../models/node_laminate.toml");
const AIM: &str = include_str!("../../../../models/node_camera_aim.toml");
const PRINTED: &str = include_str!("../../../../models/node_camera_printed.toml");
const PORTAL: &str = include_str!("../../../../models/portal_frame.toml");

const L: f64 = 0.1524;
const TOLERANCE: f64 = 1e-9;

pub(super) fn facts() -> Result<Vec<Fact>, String> {
    let mut facts = Vec::new();
    corner(&mut facts)?;
    narrow(&mut facts)?;
    sensor(&mut facts)?;
    laminate(&mut facts)?;
    camera(&mut facts)?;
    for factor in [1.0, 0.5] {
        let iterations = recipe::theirs(factor)?.iterations;
        facts.push((format!("recipe {factor}"), iterations as f64));
    }
    facts.push(("own steps".into(), recipe::ours()?.solution.work.newton_steps as f64));
    let modes = File::new(PORTAL)?.modes(&[], 4, &flexura::Options::default())?;
    for (number, mode) in modes.modes.iter().enumerate() {
        facts.push((format!("portal {}", number + 1), mode.rate / std::f64::consts::TAU));
    }
    Ok(facts)
}

/// Slope of a line through the origin by least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    sum(&|p| p[0] * p[1]) / sum(&|p| p[0] * p[0])
}

/// Slides, /L, at angles in degrees.
fn slides(followed: &Followed, angles: &[f64]) -> Result<Vec<[f64; 2]>, String> {
    let at = |(number, angle): (usize, &f64)| match events(followed.first()?, number)[..] {
        [point, ..] => Ok([*angle, followed.number(point, "u0_over_L")]),
        [] => Err(format!("{angle}° is not reached")),
    };
    angles.iter().enumerate().map(at).collect()
}

fn corner(facts: &mut Vec<Fact>) -> Result<(), String> {
    let angles: Vec<f64> = (1..=9).map(|i| 10.0 * f64::from(i)).collect();
    let wanted: Vec<(&str, f64)> = angles.iter().map(|angle| ("theta", angle.to_radians())).collect();
    let until = Some(("theta", 90.5f64.to_radians()));
    for tilt in [-90.0, -45.0, 0.0, 45.0, 90.0_f64] {
        let path = Path { events: &wanted, until, ..Path::of("u0", [0.0, 0.6 * L]) };
        let followed = File::new(CORNER)?.trace(&[("tilt", tilt.to_radians())], &path, TOLERANCE)?;
        let points = &followed.first()?.points;
        let pushes = || points.iter().map(|point| followed.number(point, "n"));
        facts.push((format!("corner most {tilt}"), pushes().fold(f64::MIN, f64::max)));
        facts.push((format!("corner least {tilt}"), pushes().fold(f64::MAX, f64::min)));
        let grips = points.iter().map(|point| followed.number(point, "grip"));
        facts.push((format!("corner grip {tilt}"), grips.fold(f64::MAX, f64::min)));
        facts.push((format!("corner slope {tilt}"), slope(&slides(&followed, &angles)?)));
    }
    let path = Path { events: &wanted, until, ..Path::of("u0", [0.0, 0.6 * L]) };
    let followed = File::new(CORNER)?.trace(&[("fall", 0.0)], &path, TOLERANCE)?;
    facts.push(("corner slope".into(), slope(&slides(&followed, &angles)?)));
    Ok(())
}

fn narrow(facts: &mut Vec<Fact>) -> Result<(), String> {
    let angles: Vec<f64> = (1..=12).map(|i| 5.0 * f64::from(i)).collect();
    let wanted: Vec<(&str, f64)> = angles.iter().map(|angle| ("theta", angle.to_radians())).collect();
    let path = Path { events: &wanted, folds: Some(1), ..Path::of("u0", [0.0, 0.6 * L]) };
    let followed = File::new(NARROW)?.trace(&[], &path, TOLERANCE)?;
    let found = slides(&followed, &angles)?;
    for [angle, slide] in &found {
        facts.push((format!("narrow {angle}"), *slide));
    }
    facts.push(("narrow slope".into(), slope(&found[..9])));
    let [fold, ..] = folds(followed.first()?)[..] else { return Err("no fold with little room".to_string()) };
    facts.push(("narrow fold".into(), followed.number(fold, "theta").to_degrees()));
    Ok(())
}

fn sensor(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(SENSOR)?;
    let wanted = [("w_over_L", -0.1559)];
    for slope in [0.0, 45.0_f64] {
        let path = Path { events: &wanted, ..Path::of("u1", [1e-3 * L, 0.2 * L]) };
        let followed = file.trace(&[("slope", slope.to_radians())], &path, TOLERANCE)?;
        let [point] = events(followed.first()?, 0)[..] else {
            return Err(format!("no sensor down at {slope}°"));
        };
        facts.push((format!("sensor {slope}"), followed.number(point, "u1_over_L")));
    }
    let path = Path {
        start: Some(0.2 * L),
        imperfection: Some(("slope", 180f64.to_radians())),
        ..Path::of("u1", [2e-4 * L, 0.2 * L])
    };
    let followed = file.trace(&[], &path, TOLERANCE)?;
    let lifted = followed.branch(|origin| origin == BranchOrigin::Imperfection)?;
    let falls =
        lifted.points.iter().find(|point| matches!(point.kind, PointKind::Branch(_) | PointKind::Fold));
    let falls = falls.ok_or("the lifted sensor does not fall")?;
    facts.push(("jump u1".into(), followed.number(falls, "u1_over_L")));
    facts.push(("jump w".into(), followed.number(falls, "w_over_L")));
    Ok(())
}

fn laminate(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(LAMINATE)?;
    for (name, values) in [("holder", [0.03, 0.08]), ("uniform", [20.32e-3, 0.0])] {
        for payload in [0.0, 0.05] {
            let values = [("holder", values[0]), ("holes", values[1]), ("payload", payload)];
            let answer = file.solve(&values, TOLERANCE)?;
            let grams = 1e3 * payload;
            facts.push((format!("laminate {name} {grams}"), answer.number("z_over_L")));
            facts.push((format!("strain {name} {grams}"), 1e6 * answer.number("strain")));
        }
    }
    Ok(())
}

fn camera(facts: &mut Vec<Fact>) -> Result<(), String> {
    for (name, text) in [("camera", AIM), ("printed", PRINTED)] {
        let file = File::new(text)?;
        for yaw in [0.0, 10.0_f64] {
            let answer = file.solve(&[("yaw", yaw.to_radians())], TOLERANCE)?;
            for quantity in ["n", "u0_over_L"] {
                facts.push((format!("{name} {quantity} {yaw}"), answer.number(quantity)));
            }
            if name == "printed" {
                facts.push((format!("printed roll {yaw}"), answer.vector("turning")[0].to_degrees()));
            }
        }
    }
    Ok(())
}
