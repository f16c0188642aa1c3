//! What the rolling models of Chapter III say.

use super::Fact;
use crate::file::File;
use std::f64::consts::FRAC_PI_2;

const RECIPE: &str = include_str!("../../../../models/explicit_recipe.toml");
const SLIDING: &str = include_str!("../../../../models/ellipse_sliding.toml");
const BOWL: &str = include_str!("../../../../models/ellipse_in_bowl.toml");
const KNEE: &str = include_str!("../../../../models/knee_ellipses.toml");
const TOLERANCE: f64 = 1e-10;

pub(super) fn facts() -> Result<Vec<Fact>, String> {
    let mut facts = Vec::new();
    let recipe = File::new(RECIPE)?;
    for step in [0.5, 0.25] {
        let psi = recipe.solve(&[("step", step)], TOLERANCE)?.number("psi_stepped");
        facts.push((format!("recipe of {step} s"), psi.to_degrees()));
    }
    sliding(&mut facts)?;
    bowl(&mut facts)?;
    knee(&mut facts)?;
    Ok(facts)
}

/// Figure 3.6, also for other ellipses: φ when the tangent has turned by 90°, with and without the slide that makes the contact stand still
/// there, ω b²/a.
fn sliding(facts: &mut Vec<Fact>) -> Result<(), String> {
    let own = File::new(SLIDING)?.solve(&[], TOLERANCE)?;
    facts.push(("slide velocity cm/s".into(), 100.0 * own.number("slide_velocity").abs()));
    for (name, minor) in [("0.25", 0.5), ("0.5", 1.0), ("0.75", 1.5), ("1", 2.0_f64)] {
        let text = SLIDING
            .replace("semi_axes = [\"2 cm\", \"1 cm\"]", &format!("semi_axes = [\"2 cm\", \"{minor} cm\"]"))
            .replace("at = [0, \"2 cm\", 0]", &format!("at = [0, \"{} cm\", 0]", 1.0 + minor))
            .replace("slip = \"0.5 cm", &format!("slip = \"part*{} cm", minor * minor / 2.0))
            .replace("[parameter]", "[parameter]\npart = 1");
        let file = File::new(&text)?;
        for (way, part) in [("sliding", 1.0), ("rolling", 0.0)] {
            let answer = file.solve(&[("turned", FRAC_PI_2), ("part", part)], TOLERANCE)?;
            facts.push((format!("phi {way} {name}"), answer.number("phi").to_degrees()));
        }
    }
    Ok(())
}

/// Example 3.1.3 in the half bowl: where the tip of the bowl is as narrow as the child, and where the bowl ends.
fn bowl(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(BOWL)?;
    let answer = |turned: f64| file.solve(&[("turned", turned)], TOLERANCE).ok();
    let fits = |turned: f64| {
        answer(turned)
            .is_some_and(|answer| answer.number("child_radius").abs() < answer.number("parent_radius").abs())
    };
    let ends: [(&str, &dyn Fn(f64) -> bool); 2] =
        [("bowl narrow", &fits), ("bowl ends", &|turned| answer(turned).is_some())];
    for (name, holds) in ends {
        let (mut low, mut high) = (FRAC_PI_2, 3.0);
        if !holds(low) || holds(high) {
            return Err(format!("{name}: not between 90° and 172°"));
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if holds(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        facts.push((name.into(), low.to_degrees()));
    }
    Ok(())
}

/// How far the roll of the femur's ellipse with the slide (3.10b) is from (3.10a), mm.
fn knee(facts: &mut Vec<Fact>) -> Result<(), String> {
    let file = File::new(KNEE)?;
    for most in [90_u32, 120] {
        let mut apart = 0.0_f64;
        for degrees in 1..=most {
            let answer = file.solve(&[("flexion", f64::from(degrees).to_radians())], TOLERANCE)?;
            apart = apart.max((answer.number("roll") - answer.number("measured_roll")).abs());
        }
        facts.push((format!("knee apart {most}"), 1e3 * apart));
    }
    Ok(())
}
