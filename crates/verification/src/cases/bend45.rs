//! The 45 degree bend of Bathe and Bolourchi.

use crate::build::{SHEARABLE, Stiffness, cantilever, load_tip};
use crate::measure::{Units, largest_deviation, parts, solve, tip};
use crate::{Case, Row};
use flexura_model::{Curve, LoadFrame, Model};
use flexura_spatial::{Vector3, Wrench};
use flexura_testkit::bend45::{REFERENCES, clamp, rod, tip as rest_tip};
use flexura_testkit::collocation::{self, Mesh, Tip};

pub const CASES: [Case; 2] = [
    Case {
        id: "bend_45_polar",
        title: "45° bend, R = 100, P = 600, with stretch and shear, GJ = EI",
        citation: "tip displacement (-13.6045, -23.5602, 53.4749) of the true arc, clamped at the origin along +y, \
                   centre (100, 0, 0), also by collocation. (u_x is negative in this frame; it is often \
                   printed without its sign. The often quoted tip (15.79, 47.23, 53.37) of Simo and Vu-Quoc, 1986, \
                   is eight straight elements, 2.7e-3 off.)",
        needed: "all printed digits",
        run: polar,
        closed_form: None,
    },
    Case {
        id: "bend_45",
        title: "45° bend, R = 100, P = 600, with stretch and shear, J = 0.141",
        citation: "tip displacement (-13.7290, -23.8139, 53.6049) of the true arc, same frame, also by \
                   collocation",
        needed: "all printed digits",
        run: saint_venant,
        closed_form: None,
    },
];

fn model(torsion_constant: f64, force: f64) -> Model {
    let bending = 1e7 / 12.0;
    let stiffness = Stiffness { ea: 1e7, ga: 5e6, gj: 5e6 * torsion_constant, ei2: bending, ei3: bending };
    let curve = Curve::Arc { radius: 100.0, angle: std::f64::consts::FRAC_PI_4 };
    let mut model = cantilever(stiffness.section(), curve, SHEARABLE, clamp());
    load_tip(&mut model, Vector3::new(0.0, 0.0, force), Vector3::zeros(), LoadFrame::Global);
    model
}

fn polar() -> Result<Vec<Row>, String> {
    rows(0)
}

fn saint_venant() -> Result<Vec<Row>, String> {
    rows(1)
}

fn rows(which: usize) -> Result<Vec<Row>, String> {
    let reference = REFERENCES[which];
    // The printed digits, with the default tolerance.
    let model = model(reference.torsion_constant, reference.load);
    let solution = solve(&model, 1e-8)?;
    let displacement = tip(&solution.beams[0])?.pose.position - rest_tip();
    let mut rows: Vec<Row> = ["u_x", "u_y", "u_z"]
        .iter()
        .enumerate()
        .map(|(i, name)| {
            // Half a unit of the fourth decimal.
            Row::absolute(*name, reference.displacement[i], displacement[i], 5e-5)
                .with_estimate(solution.error_estimate)
        })
        .collect();
    // The whole state, against the other method.
    let rod = rod(reference.torsion_constant);
    let dead = |fraction: f64| {
        Tip::Dead(Wrench::new(Vector3::new(0.0, 0.0, reference.load * fraction), Vector3::zeros()))
    };
    let mesh = Mesh { elements: 2, degree: 20 };
    let exact = collocation::solve(&rod, &clamp(), &dead, 6, mesh).map_err(|error| format!("{error:?}"))?;
    let units = Units { length: rod.length, stiffness: 5e6 * reference.torsion_constant.min(1.0 / 6.0) };
    let off = largest_deviation(&solution.beams[0], &units, &|s| parts(&exact.at(s)));
    rows.push(
        Row::vanishing("all poses and wrenches against collocation, scaled", off, 1e-8)
            .with_estimate(solution.error_estimate),
    );
    Ok(rows)
}
