//! Tapered cantilevers under loads so small that the linear closed form holds.

use crate::build::{UNSHEARABLE, cantilever, load_tip};
use crate::measure::{solve, tip};
use crate::{Case, Row};
use flexura_model::{At, Curve, LoadFrame, Material, MaterialId, Model, Profile, Section, Shape};
use flexura_spatial::{Pose, Vector3};
use flexura_testkit::taper::{Taper, tapered_cantilever};
use std::f64::consts::PI;

pub const CASES: [Case; 1] = [Case {
    id: "tapered_beam",
    title: "Tapered cantilevers (width, height, cone; tip at 0.3 and 0.6 of the clamp), small tip force and moment",
    citation: "∫(1 - x)ʲ/(1 - cx)ⁿ dx in closed form (compare Young and Budynas, *Roark's Formulas for Stress and \
               Strain*, 7th ed., 2002, table 8.11), the limit of our answers as the load vanishes",
    needed: "1e-8",
    run,
    closed_form: None,
}];

const LENGTH: f64 = 0.2;
const WIDTH: f64 = 20e-3;
const HEIGHT: f64 = 2e-3;
const YOUNG: f64 = 207e9;

fn falling(value: f64, tip: f64) -> Profile {
    Profile::Table { at: vec![At::Fraction(0.0), At::Fraction(1.0)], value: vec![value, value * tip] }
}

/// The shape, and EI0 of bending about e2 at the clamp.
fn section(taper: Taper, tip: f64) -> (Section, f64) {
    let inertia = WIDTH * HEIGHT.powi(3) / 12.0;
    let (shape, inertia) = match taper {
        Taper::Width => (Shape::Rectangle { width: falling(WIDTH, tip), height: HEIGHT.into() }, inertia),
        Taper::Height => (Shape::Rectangle { width: WIDTH.into(), height: falling(HEIGHT, tip) }, inertia),
        Taper::Cone => (Shape::Circle { diameter: falling(HEIGHT, tip) }, PI * HEIGHT.powi(4) / 64.0),
    };
    (Section { name: "tapered".to_string(), shape, plane_strain: false }, YOUNG * inertia)
}

/// Deflection and rotation of the tip, per load in units of EI0/L² and EI0/L, in the limit of no load.
///
/// Both are odd in the load, so that combining two loads takes the cubic part out.
fn limit(taper: Taper, tip_part: f64, force: f64, moment: f64) -> Result<[f64; 2], String> {
    let (shape, stiffness) = section(taper, tip_part);
    let response = |load: f64| -> Result<[f64; 2], String> {
        let straight = Curve::Straight { length: LENGTH };
        let mut model: Model = cantilever(shape.clone(), straight, UNSHEARABLE, Pose::identity());
        model.materials.push(Material {
            name: "steel".to_string(),
            young: YOUNG,
            shear: YOUNG / 2.6,
            density: None,
            yield_strength: None,
        });
        model.beams[0].material = Some(MaterialId(0));
        let f = Vector3::new(0.0, 0.0, force * load * stiffness / LENGTH.powi(2));
        // Lifting the tip is a rotation about -y.
        let m = Vector3::new(0.0, -moment * load * stiffness / LENGTH, 0.0);
        load_tip(&mut model, f, m, LoadFrame::Global);
        let solution = solve(&model, 1e-12)?;
        let pose = tip(&solution.beams[0])?.pose;
        let tangent = pose.rotation * Vector3::x();
        Ok([pose.position.z / LENGTH / load, tangent.z.atan2(tangent.x) / load])
    };
    let load = 1e-3;
    let (one, two) = (response(load)?, response(2.0 * load)?);
    Ok([0, 1].map(|i| (4.0 * one[i] - two[i]) / 3.0))
}

fn run() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (taper, name) in [(Taper::Width, "width"), (Taper::Height, "height"), (Taper::Cone, "cone")] {
        for part in [0.3, 0.6] {
            let exact = tapered_cantilever(taper, part);
            let [deflection, rotation] = limit(taper, part, 1.0, 0.0)?;
            let [by_moment, turn] = limit(taper, part, 0.0, 1.0)?;
            let row = |what: &str, reference, ours| {
                Row::relative(format!("{what}, {name} to {part}"), reference, ours, 1e-8)
            };
            rows.push(row("deflection by a force, FL³/EI0", exact.deflection_by_force, deflection));
            rows.push(row("rotation by a force, FL²/EI0", exact.rotation_by_force, rotation));
            rows.push(row("deflection by a moment, ML²/EI0", exact.rotation_by_force, by_moment));
            rows.push(row("rotation by a moment, ML/EI0", exact.rotation_by_moment, turn));
        }
    }
    Ok(rows)
}
