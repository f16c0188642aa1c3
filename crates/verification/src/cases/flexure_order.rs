//! Flexure mechanisms in small motion, against the formulas that designers use: the difference must fall with the
//! power of the motion that the formula leaves out.

use super::flexures::{Leaf, steel};
use crate::file::File;
use crate::{Case, Row};
use std::f64::consts::SQRT_2;

pub const CASES: [Case; 5] = [
    Case {
        id: "parallelogram_small",
        title: "`parallelogram_stage.toml`, small motion: force, shortening and pitch; the differences fall as the square \
                of the travel",
        citation: "beam constraint model: f = 24 y, x = -0.6 y², θ = 6 y (1/d + y²/700)/w² (S. Awtar, A. H. Slocum and \
                   E. Sevincer, *J. Mech. Des.* 129 (2007) 625)",
        needed: "order 2 to 0.1",
        run: parallelogram,
        closed_form: None,
    },
    Case {
        id: "cross_spring_small",
        title: "`cross_spring_pivot.toml`, small motion: stiffness 2 EI/L, centre shift √2/12 L θ², centre of the turn; \
                the differences fall as θ²",
        citation: "J. A. Haringx, *Appl. Sci. Res.* A1 (1949) 313; W. H. Wittrick, *Aeronaut. Q.* 2 (1951) 272",
        needed: "order 2 to 0.1; stiffness at rest 1e-9",
        run: cross_spring,
        closed_form: None,
    },
    Case {
        id: "leaf_four_bar_small",
        title: "`leaf_four_bar.toml`, small motion: stiffness Σ 4 EI/L (3ρ² + 3ρ + 1), ρL from a leaf's end to where the \
                axes meet, about which the coupler turns; the differences fall as θ² and θ",
        citation: "slope-deflection equations of leaves that turn about a fixed point (W. H. Wittrick, *Aeronaut. Q.* 2 \
                   (1951) 272)",
        needed: "orders 2 and 1 to 0.1; stiffness at rest 1e-9",
        run: leaf_four_bar,
        closed_form: None,
    },
    Case {
        id: "cartwheel_small",
        title: "`cartwheel_hinge.toml`, small motion: stiffness 8 EI/L, four times that of the cross-spring pivot, the hub \
                turning by half; the differences fall as θ²",
        citation: "slope-deflection equations; S. T. Smith, *Flexures: Elements of Elastic Mechanisms*, 2000, ch. 4",
        needed: "order 2 to 0.1; stiffness at rest 1e-9",
        run: cartwheel,
        closed_form: None,
    },
    Case {
        id: "bistable_small",
        title: "`bistable_beam.toml`, small motion: force (12 EI/L³ cos² + EA/L sin²) y; the difference falls as y",
        citation: "matrix of a clamped beam (compare Young and Budynas, *Roark's Formulas for Stress and Strain*, 7th \
                   ed., 2002, table 8.1)",
        needed: "order 1 to 0.1",
        run: bistable,
        closed_form: None,
    },
];

const SOLVE: f64 = 1e-12;

/// What falls with which power: relative differences at a motion and at half of it.
fn order(quantity: &str, power: f64, whole: [f64; 2], half: [f64; 2]) -> Row {
    let off = |[reference, ours]: [f64; 2]| ((ours - reference) / reference).abs();
    Row::absolute(
        format!("order of the difference in {quantity} ({:.1e}, then {:.1e})", off(whole), off(half)),
        power,
        (off(whole) / off(half)).log2(),
        0.1,
    )
}

fn parallelogram() -> Result<Vec<Row>, String> {
    // Without stretch (d without bound), which would leave differences of 1/(w² d) that do not fall.
    let text = include_str!("../../../../models/parallelogram_stage.toml")
        .replace("length = \"60 mm\"", "length = \"60 mm\"\nextension = false");
    let file = File::new(&text)?;
    let leaf = Leaf::new(207e9, 0.3e-3, 10e-3, 0.06, false);
    let (l, w) = (leaf.length, 0.015 / 0.06);
    let at = |y: f64| {
        let push = 24.0 * y * leaf.bending / (l * l);
        let answer = file.solve(&[("push", push)], SOLVE)?;
        let y = answer.number("travel") / l;
        Ok::<_, String>([
            [24.0 * y, push * l * l / leaf.bending],
            [0.6 * y * y, answer.number("comes_nearer") / l],
            [6.0 * y * y * y / 700.0 / (w * w), answer.number("pitch").abs()],
        ])
    };
    let (whole, half): ([[f64; 2]; 3], [[f64; 2]; 3]) = (at(0.04)?, at(0.02)?);
    Ok(["force", "shortening", "pitch"]
        .iter()
        .zip(0..3)
        .map(|(q, i)| order(q, 2.0, whole[i], half[i]))
        .collect())
}

fn cross_spring() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/cross_spring_pivot.toml"))?;
    let leaf = steel(0.05, false);
    let l = leaf.length;
    let stiffness = 2.0 * leaf.bending / l;
    let at = |angle: f64| {
        let torque = stiffness * angle;
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let turning = answer.number("turning");
        Ok::<_, String>([
            [stiffness * turning, torque],
            [SQRT_2 / 12.0 * l * turning.powi(2), answer.vector("shift")[0]],
            [SQRT_2 / 12.0 * l * turning, answer.vector("centre_of_turn")[1]],
        ])
    };
    let (whole, half): ([[f64; 2]; 3], [[f64; 2]; 3]) = (at(0.2)?, at(0.1)?);
    let mut rows: Vec<Row> = ["torque", "centre shift", "centre of the turn"]
        .iter()
        .zip(0..3)
        .map(|(q, i)| order(q, 2.0, whole[i], half[i]))
        .collect();
    let rest = file.solve(&[("torque", 1e-9)], SOLVE)?.number("softness");
    rows.push(Row::relative("stiffness at rest, N·m/rad", stiffness, 1.0 / rest, 1e-9));
    Ok(rows)
}

fn leaf_four_bar() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/leaf_four_bar.toml"))?;
    let leaf = steel(0.05, false);
    let (l, half_base, lean) = (leaf.length, 0.03, 15f64.to_radians());
    let height = half_base / lean.tan();
    let ratio = (half_base / lean.sin() - l) / l;
    let stiffness = 2.0 * 4.0 * leaf.bending / l * (3.0 * ratio * ratio + 3.0 * ratio + 1.0);
    let at = |angle: f64| {
        let torque = stiffness * angle;
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let centre = answer.vector("centre_of_motion");
        let off = (centre[0]).hypot(centre[1] - height);
        Ok::<_, String>([[stiffness * answer.number("turning"), torque], [height, height + off]])
    };
    let (whole, half): ([[f64; 2]; 2], [[f64; 2]; 2]) = (at(0.02)?, at(0.01)?);
    let rest = file.solve(&[("torque", 1e-9)], SOLVE)?.number("softness");
    Ok(vec![
        order("torque", 2.0, whole[0], half[0]),
        order("the centre of motion", 1.0, whole[1], half[1]),
        Row::relative("stiffness at rest, N·m/rad", stiffness, 1.0 / rest, 1e-9),
    ])
}

fn cartwheel() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/cartwheel_hinge.toml"))?;
    let leaf = steel(0.05, false);
    let stiffness = 8.0 * leaf.bending / leaf.length;
    let at = |angle: f64| {
        let torque = stiffness * angle;
        let answer = file.solve(&[("torque", torque)], SOLVE)?;
        let turning = answer.number("turning");
        Ok::<_, String>([[stiffness * turning, torque], [0.5 * turning, answer.number("hub_turning")]])
    };
    let (whole, half): ([[f64; 2]; 2], [[f64; 2]; 2]) = (at(4e-2)?, at(2e-2)?);
    let rest = file.solve(&[("torque", 1e-9)], SOLVE)?.number("softness");
    Ok(vec![
        order("torque", 2.0, whole[0], half[0]),
        Row::relative("the hub's angle", half[1][0], half[1][1], 1e-3),
        Row::relative("stiffness at rest, N·m/rad", stiffness, 1.0 / rest, 1e-9),
    ])
}

fn bistable() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/bistable_beam.toml"))?;
    let leaf = Leaf::new(1.4e9, 0.6e-3, 8e-3, 0.05, true);
    let (s, c) = 5f64.to_radians().sin_cos();
    let l = leaf.length;
    let stiffness = 12.0 * leaf.bending / l.powi(3) * c * c + s * s / (leaf.stretch * l);
    let at = |travel: f64| {
        file.solve(&[("travel", travel)], 1e-10).map(|answer| [stiffness * travel, answer.number("force")])
    };
    Ok(vec![order("force", 1.0, at(2e-6)?, at(1e-6)?)])
}
