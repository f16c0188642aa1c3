//! The thesis's own multiple shooting on its own example, the laminate of 5.3.1 with 50 g at its tip.

use crate::file::{Answer, File};
use crate::{Case, Row};
use flexura_spatial::Vector3;
use flexura_testkit::recipe::{Outcome, Recipe};

pub const CASES: [Case; 1] = [Case {
    id: "recipe",
    title: "5.3.1, the uniform laminate with its own weight and 60 g at the tip (`node_laminate.toml`), by the thesis's own multiple \
            shooting: tip and the clamp's moment",
    citation: "the thesis, Appendix B: three segments, 13 numbers at each of four nodes, (R11, R12, R13, φ) for the orientation, Newton's method on \
               all at once (`testkit/src/recipe.rs`)",
    needed: "1e-7 of L and EI/L",
    run,
    closed_form: None,
}];

const FILE: &str = include_str!("../../../../models/node_laminate.toml");
const L: f64 = 0.1524;
const BENDING: f64 = 207e9 * 20.32e-3 * 0.254e-3 * 0.254e-3 * 0.254e-3 / 12.0;

/// The recipe's answer with a step factor, in units of L and EI2.
pub(crate) fn theirs(factor: f64) -> Result<Outcome, String> {
    let weight = |mass: f64| mass * 9.80665 * L * L / BENDING;
    let own = 7630.0 * 20.32e-3 * 0.254e-3 * L;
    let recipe = Recipe {
        compliance: [1.0 / 1.52, 1.0, 1.0 / 6400.0],
        load: Vector3::new(0.0, 0.0, -weight(own)),
        steps: 50,
        factor,
    };
    let force = Vector3::new(0.0, 0.0, -weight(0.06));
    recipe.cantilever(force, Vector3::zeros(), 1e-9, 200).ok_or_else(|| "the recipe fails".to_string())
}

/// Ours.
pub(crate) fn ours() -> Result<Answer, String> {
    File::new(FILE)?.solve(&[("holder", 20.32e-3), ("holes", 0.0), ("u_arm", 0.0)], 1e-9)
}

fn run() -> Result<Vec<Row>, String> {
    let (theirs, ours) = (theirs(1.0)?, ours()?);
    let (Some(first), Some(last)) = (theirs.nodes.first(), theirs.nodes.last()) else {
        return Err("no nodes".to_string());
    };
    let clamp = ours.solution.beams[0].samples.first().ok_or("no samples")?;
    Ok(vec![
        Row::absolute("x of the tip, /L", last[0], ours.number("x_over_L"), 1e-7),
        Row::absolute("z of the tip, /L", last[2], ours.number("z_over_L"), 1e-7),
        Row::absolute("moment at the clamp, EI/L", first[11], clamp.wrench.moment.y * L / BENDING, 1e-7),
    ])
}
