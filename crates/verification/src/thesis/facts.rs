//! What the models of Chapters II to IV say.

use super::Fact;
use crate::file::File;
use crate::path::{Path, events};
use std::f64::consts::PI;

const RING: &str = include_str!("../../../../models/half_ring.toml");
const CLAVICLE: &str = include_str!("../../../../models/clavicle.toml");
const KEEL: &str = include_str!("../../../../models/coracoid_keel.toml");
const SHOULDER: &str = include_str!("../../../../models/shoulder_joint.toml");
const KNEE: &str = include_str!("../../../../models/knee_ellipse.toml");
const ELLIPSE: &str = include_str!("../../../../models/ellipse_on_circle.toml");

pub(super) fn facts() -> Result<Vec<Fact>, String> {
    let mut facts = Vec::new();
    ring(&mut facts)?;
    radii(&mut facts)?;
    ligament(&mut facts);
    clavicle(&mut facts)?;
    ball(&mut facts)?;
    pinned_knee(&mut facts)?;
    third_ellipse(&mut facts)?;
    // Example 3.1.3, case 2(a): one circle of 1 cm on another.
    let circle = ELLIPSE.replace("semi_axes = [\"2 cm\", \"1 cm\"]", "semi_axes = [\"1 cm\", \"1 cm\"]");
    let circle = File::new(&circle)?.solve(&[("turned", PI / 3.0)], 1e-9)?;
    facts.push(("circles angle".into(), circle.number("angle").to_degrees()));
    facts.push(("circles distance".into(), 100.0 * circle.number("distance")));
    let shoulder = File::new(SHOULDER)?.solve(&[], 1e-9)?;
    facts.push(("shoulder roll".into(), 1e3 * shoulder.number("roll")));
    facts.push(("shoulder slide".into(), 1e3 * shoulder.number("slide")));
    Ok(facts)
}

/// Figure 2.11: torques at θ = 45° for Poisson's ratios of steel, titanium, aluminium and delrin, whose values are lost.
fn ring(facts: &mut Vec<Fact>) -> Result<(), String> {
    let materials = [("steel", 0.29), ("titanium", 0.34), ("aluminium", 0.33), ("delrin", 0.35)];
    let file = File::new(RING)?;
    for aspect in [2.0, 3.0, 6.0] {
        let mut torques = Vec::new();
        for (name, poisson) in materials {
            let values = [("aspect", aspect), ("poisson", poisson), ("theta", PI / 4.0)];
            let torque = file.solve(&values, 1e-9)?.number("normalised").abs();
            facts.push((format!("ring {aspect} {name}"), torque));
            torques.push(torque);
        }
        let largest = torques.iter().map(|torque| (torque / torques[0] - 1.0).abs()).fold(0.0, f64::max);
        facts.push((format!("ring {aspect} spread %"), 100.0 * largest));
    }
    Ok(())
}

/// Figures 3.3 and 3.4: travel of the tangent's first quarter turn, and radii of curvature at its ends, for other ellipses.
fn radii(facts: &mut Vec<Fact>) -> Result<(), String> {
    for (name, minor) in [("0.25", 0.5), ("0.5", 1.0), ("0.75", 1.5), ("1", 2.0)] {
        let text = ELLIPSE
            .replace("semi_axes = [\"2 cm\", \"1 cm\"]", &format!("semi_axes = [\"2 cm\", \"{minor} cm\"]"))
            .replace("at = [0, \"2 cm\", 0]", &format!("at = [0, \"{} cm\", 0]", 1.0 + minor));
        let file = File::new(&text)?;
        let quarter = file.solve(&[("turned", PI / 2.0)], 1e-9)?;
        facts.push((format!("travel {name}"), 100.0 * quarter.number("roll")));
        facts.push((format!("least radius {name}"), 100.0 * quarter.number("radius").abs()));
        let start = file.solve(&[("turned", 0.0)], 1e-9)?;
        facts.push((format!("greatest radius {name}"), 100.0 * start.number("radius").abs()));
    }
    Ok(())
}

/// Table 4.3, twisting: B alone, stretched by 5 mm π/2; and what a bird larger by a tenth moves less.
fn ligament(facts: &mut Vec<Fact>) {
    let length = (7.8f64.powi(2) + 18.09f64.powi(2) + 5.46f64.powi(2)).sqrt();
    let strain = 5.0 * PI / 2.0 / length;
    facts.push(("f_B".into(), 50.68 / (1.0 + strain) * 0.0025 * (9.4377 * strain).exp()));
    facts.push(("less by force %".into(), 100.0 * (1.0 - 1.0 / 1.1)));
    facts.push(("less by moment %".into(), 100.0 * (1.0 - 1.0 / 1.21)));
}

/// The clavicle's tip under the moment as printed, and in the unit that it must have.
fn clavicle(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(CLAVICLE)?;
    for (name, moment) in [("as printed", -0.011e-3), ("in N m", -0.011)] {
        let tip = file.solve(&[("bend", moment)], 1e-9)?.vector("tip");
        facts.push((format!("clavicle {name}"), 1e3 * tip[1]));
    }
    Ok(())
}

/// Figures 4.4 and 4.5: how far a ball joint in the ellipsoid's centre is from the rolling ellipsoids, by the thesis's measure, about the
/// upright position.
fn ball(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(KEEL)?;
    let upright = file.solve(&[("tilt", 0.0)], 1e-9)?;
    for degrees in [5.0, 10.0, 20.0, 30.0_f64] {
        let tilted = file.solve(&[("tilt", degrees.to_radians())], 1e-9)?;
        for axis in ["x", "z"] {
            let (shoulder, ball) = (format!("shoulder_{axis}"), format!("ball_{axis}"));
            let moved = tilted.number(&shoulder) - upright.number(&shoulder);
            let apart = tilted.number(&shoulder) - tilted.number(&ball);
            facts.push((format!("keel {axis} {degrees}"), 1e3 * moved.abs()));
            facts.push((format!("ball {axis} {degrees} %"), 100.0 * (apart / moved).abs()));
        }
    }
    Ok(())
}

/// Figures 3.14 and 3.15: f_r of (3.12a) along the leg while the knee turns evenly by 80°/s, with the centre of mass on its way r(θ) of
/// (3.13) and at a constant distance, as of a pin; and the angle beyond which the pin asks for less.
fn pinned_knee(facts: &mut Vec<Fact>) -> Result<(), String> {
    let (mass, rate) = (2.44 + 1.18, 80f64.to_radians());
    // r and its second derivative by θ, m.
    let r = |q: f64| 1e-3 * (1.078 * q.powi(4) - 11.184 * q.powi(3) + 26.542 * q * q - 0.825 * q + 263.59);
    let bend = |q: f64| 1e-3 * (12.936 * q * q - 67.104 * q + 53.084);
    let weight = |q: f64| mass * 9.81 * q.sin();
    let bio = |q: f64| mass * rate * rate * (bend(q) - r(q)) - weight(q);
    let pin = |q: f64| -mass * rate * rate * r(0.0) - weight(q);
    for degrees in [30.0, 60.0, 90.0, 110.0_f64] {
        let q = degrees.to_radians();
        facts.push((format!("knee bio {degrees}"), bio(q)));
        facts.push((format!("knee pin {degrees}"), pin(q)));
    }
    let (mut low, mut high) = (0.2, 2.0);
    if (bio(low).abs() < pin(low).abs()) == (bio(high).abs() < pin(high).abs()) {
        return Err("pin and bio-joint do not cross".to_string());
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_low = (bio(middle).abs() < pin(middle).abs()) == (bio(low).abs() < pin(low).abs());
        if is_low {
            low = middle;
        } else {
            high = middle;
        }
    }
    facts.push(("knee crossing".into(), low.to_degrees()));
    Ok(())
}

/// Table 3.4's ellipses as the femur that rolls on a plane: the flexion at which the contact has gone 31 mm.
fn third_ellipse(facts: &mut Vec<Fact>) -> Result<(), String> {
    for [major, minor] in [[25.3, 21.1], [33.6, 23.0], [28.8, 18.8]] {
        let text = KNEE
            .replace("[\"25.3 mm\", \"21.1 mm\"]", &format!("[\"{major} mm\", \"{minor} mm\"]"))
            .replace("at = [0, \"21.1 mm\", 0]", &format!("at = [0, \"{minor} mm\", 0]"));
        let path = Path { events: &[("position", 0.0)], ..Path::of("flexion", [0.0, 120f64.to_radians()]) };
        let followed = File::new(&text)?.trace(&[], &path, 1e-9)?;
        let [point, ..] = events(followed.first()?, 0)[..] else {
            return Err("it stays on the plateau".to_string());
        };
        facts.push((format!("plateau {major}"), point.parameter.to_degrees()));
    }
    Ok(())
}
