//! Natural frequencies of mechanisms of rods and bodies.

use super::modes::{compared, found, found_near};
use super::modes_curved::{TWO_METHODS, round};
use crate::file::File;
use crate::{Case, Row};
use flexura::geometry::properties;
use flexura_model::{Section, Shape};
use std::f64::consts::TAU;
use std::fmt::Write;

pub const CASES: [Case; 3] = [
    Case {
        id: "modes_of_flexures",
        title: "Modes of a cross-spring pivot that carries a body, of a parallelogram stage, of a right-angle cantilever",
        citation: TWO_METHODS,
        needed: "1e-8",
        run: flexures,
        closed_form: None,
    },
    Case {
        id: "modes_of_a_platform",
        title: "Modes of a platform on six rods, bent by their lengths and a load: with and without shear and stretch",
        citation: TWO_METHODS,
        needed: "2e-8, to which the references are known to agree",
        run: platform,
        closed_form: None,
    },
    Case {
        id: "modes_with_tendons",
        title: "Modes of an inextensible cantilever with tendons in channels: one of given tension along the axis changes nothing; one of given \
                length beside it keeps the tip from turning; two of given tension on both sides of the axis change nothing either",
        citation: "the length of a tendon is L + d θ(L) where the axis does not stretch: clamped-free and clamped-guided bars of Blevins \
                   (1979), table 8-1",
        needed: "1e-8",
        run: tendons,
        closed_form: None,
    },
];

/// A leaf 10 mm wide out of the plane, e2 across it in the plane; 5/6 G A in shear.
fn leaf(thickness: f64) -> Result<String, String> {
    let (width, young, modulus, density) = (10e-3, 210e9, 80e9, 7850.0);
    let shape = Shape::Rectangle { width: thickness.into(), height: width.into() };
    let section = Section { name: "leaf".to_string(), shape, plane_strain: false };
    let p = properties(&section, 0.0, 1.0, 0.0).map_err(|error| error.to_string())?.ok_or("no dimensions")?;
    let ga = 5.0 / 6.0 * modulus * p.area;
    Ok(format!(
        "[section.leaf]\nshape = \"stiffness\"\nEA = {:?}\nGA2 = {ga:?}\nGA3 = {ga:?}\nGJ = {:?}\nEI2 = {:?}\nEI3 = {:?}\n\
         mass_per_length = {:?}\nrotary_inertia = [{:?}, {:?}, {:?}]\n",
        young * p.area,
        modulus * p.j,
        young * p.i2,
        young * p.i3,
        density * p.area,
        density * (p.i2 + p.i3),
        density * p.i2,
        density * p.i3
    ))
}

/// A leaf from a place on the ground, turned about z, to a body.
fn clamped_leaf(name: &str, length: f64, at: [f64; 3], degrees: f64, body: &str) -> String {
    format!(
        "[beam.{name}]\nsection = \"leaf\"\nlength = {length:?}\nshear = true\n\
         start = {{ body = \"ground\", hold = \"clamp\", at = {at:?}, rotation = {{ axis = [0, 0, 1], angle = \"{degrees} deg\" }} }}\n\
         end = {{ body = \"{body}\", hold = \"clamp\" }}\n"
    )
}

fn flexures() -> Result<Vec<Row>, String> {
    let length = 0.04;
    let foot = length / 8.0_f64.sqrt();
    let pivot = format!(
        "{}[body.arm]\nat = [0, {:?}, 0]\nmass = 0.03\ninertia = [4e-6, 5e-6, 6e-6]\n{}{}",
        leaf(0.4e-3)?,
        2.0 * foot,
        clamped_leaf("left", length, [-foot, 0.0, -6e-3], 45.0, "arm"),
        clamped_leaf("right", length, [foot, 0.0, 6e-3], 135.0, "arm")
    );
    let wanted = [34.093842129, 603.29665057, 838.92218176, 1331.2251433, 1333.688684, 2176.8684194];
    let mut rows = compared("cross-spring pivot", &found(&pivot, 6)?, &wanted, TAU);
    let stage = format!(
        "{}[body.stage]\nat = [0, 0.055, 0]\nmass = 0.05\ninertia = [1.2e-5, 8e-6, 1.5e-5]\n{}{}",
        leaf(0.3e-3)?,
        clamped_leaf("left", 0.05, [-0.015, 0.0, 0.0], 90.0, "stage"),
        clamped_leaf("right", 0.05, [0.015, 0.0, 0.0], 90.0, "stage")
    );
    let wanted = [21.250207591, 281.61054725, 637.83128392, 640.30101054, 789.17559082, 1569.4446274];
    rows.extend(compared("parallelogram stage", &found(&stage, 6)?, &wanted, TAU));
    let rod = "section = \"rod\"\nlength = 10\nshear = true\n";
    let angle = format!(
        "[section.rod]\nshape = \"stiffness\"\nEA = 1e6\nGA2 = 1e6\nGA3 = 1e6\nGJ = 1e3\nEI2 = 1e3\nEI3 = 1e3\nmass_per_length = 1\n\
         rotary_inertia = [20, 10, 10]\n[body.elbow]\nat = [10, 0, 0]\n[beam.first]\n{rod}\
         start = {{ body = \"ground\", hold = \"clamp\" }}\nend = {{ body = \"elbow\", hold = \"clamp\" }}\n[beam.second]\n{rod}\
         start = {{ body = \"elbow\", hold = \"clamp\", at = [0, 0, 0], rotation = {{ axis = [0, 0, 1], angle = \"90 deg\" }} }}\n"
    );
    let wanted = [0.32837003708, 0.33692183646, 0.55492046907, 0.90426086553, 1.1183905784, 1.7637642597];
    rows.extend(compared("right-angle cantilever", &found(&angle, 6)?, &wanted, 1.0));
    Ok(rows)
}

fn platform() -> Result<Vec<Row>, String> {
    let young = 207e9;
    let section = format!("[section.rod]\n{}", round(1.3e-3, [young, young / 2.61], 7850.0, 1.0));
    let mut text = format!(
        "{section}[body.plate]\nat = [0, 0, 0.41]\nmass = 0.2\ninertia = [4e-4, 4e-4, 7.5e-4]\n\
         [load.hand]\nbody = \"plate\"\nforce = [0.5, -0.3, -2]\nmoment = [0.02, -0.01, 0.03]\n"
    );
    for (i, extra) in [0.0, 0.03, 0.02, -0.01, 0.01, 0.04].iter().enumerate() {
        let next = (i + 1 - (i + 1) % 2) as f64;
        let own = (i - i % 2) as f64;
        let angles = [(20.0, 100.0), (100.0, 20.0)].map(|(a, b)| 0.5 * (-a + next * a + own * b));
        let place = |degrees: f64| {
            let angle = degrees.to_radians();
            format!(
                "at = [{:?}, {:?}, 0], rotation = {{ axis = [0, 1, 0], angle = \"-90 deg\" }}",
                0.087 * angle.cos(),
                0.087 * angle.sin()
            )
        };
        let _ = write!(
            text,
            "[beam.rod_{i}]\nsection = \"rod\"\nlength = {:?}\nTHEORY\nstart = {{ body = \"ground\", hold = \"clamp\", {} }}\n\
             end = {{ body = \"plate\", hold = \"clamp\", {} }}\n",
            0.4 + extra,
            place(angles[0]),
            place(angles[1])
        );
    }
    let mut rows = Vec::new();
    for (name, theory, wanted, place) in [
        (
            "with shear and stretch",
            "shear = true",
            [3.2431866587, 4.7398845353, 9.8872205334, 17.652385792, 19.293044549, 20.406288031],
            [0.05950589055, 0.082450734244, 0.39173292632],
        ),
        (
            "without",
            "extension = false",
            [3.2443430459, 4.7448246072, 9.9104112964, 17.649295754, 19.291137095, 20.403945478],
            [0.059521901918, 0.082473983157, 0.39172329079],
        ),
    ] {
        let text = text.replace("THEORY", theory);
        let unloaded =
            text.replace("force = [0.5, -0.3, -2]\nmoment = [0.02, -0.01, 0.03]", "force = [0, 0, 0]");
        let unloaded =
            File::new(&format!("format = 1\nname = \"platform\"\n{unloaded}"))?.solve(&[], 1e-8)?;
        let modes = found_near(&text, 6, unloaded.solution)?;
        // The references agree with each other to 7e-9 and 1e-8.
        let loose = |row: Row| Row { tolerance: 2e-8, ..row };
        rows.extend(compared(name, &modes, &wanted, TAU).into_iter().map(loose));
        for (axis, wanted) in place.iter().enumerate() {
            let ours = modes.solution.bodies[0].position[axis];
            rows.push(Row::absolute(format!("place {}, {name}", ["x", "y", "z"][axis]), *wanted, ours, 1e-8));
        }
    }
    Ok(rows)
}

fn tendons() -> Result<Vec<Row>, String> {
    let rod = "[section.rod]\nshape = \"stiffness\"\nGJ = 1e4\nEI2 = 1e4\nEI3 = 1\nmass_per_length = 1\n[beam.rod]\nsection = \"rod\"\n\
               length = 1\nextension = false\nstart = { body = \"ground\", hold = \"clamp\" }\n";
    let cable = |name: &str, law: &str, offset: f64| {
        format!(
            "[cable.{name}]\n{law}\nroute = [{{ beam = \"rod\", from = 0, to = 1, offset = [{offset:?}, 0] }}]\n"
        )
    };
    let free = [3.5160152685, 22.034491565, 61.697214414];
    let guided = [5.593321362, 30.225847932, 74.638883825];
    let along = found(&format!("{rod}{}", cable("axis", "tension = 5", 0.0)), 3)?;
    let mut rows = compared("tension along the axis", &along, &free, 1.0);
    let sides = [cable("up", "tension = 5", 0.05), cable("down", "tension = 5", -0.05)].concat();
    rows.extend(compared("tension on both sides", &found(&format!("{rod}{sides}"), 3)?, &free, 1.0));
    let held = found(&format!("{rod}{}", cable("side", "length = 1", 0.05)), 3)?;
    rows.extend(compared("length beside the axis", &held, &guided, 1.0));
    Ok(rows)
}
