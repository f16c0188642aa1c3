//! Surfaces that roll on each other in space.

use crate::file::File;
use crate::measure::worst;
use crate::{Case, Row};
use flexura_testkit::elliptic::second;
use flexura_testkit::roots::root;

pub const CASES: [Case; 1] = [Case {
    id: "rolling_ellipsoids",
    title: "An ellipsoid (9.2, 3.1, 2.3 mm) rolls on one of (10.2, 4.1, 1.9 mm) about y (`coracoid_keel.toml`): its centre",
    citation: "in the plane of symmetry two ellipses: arc lengths as elliptic integrals, both contact angles by bracketing; \
               printed values at 15°",
    needed: "1e-8",
    run: ellipsoids,
    closed_form: None,
}];

/// Arc from the end of the minor axis to the eccentric angle ψ.
fn arc((a, b): (f64, f64), psi: f64) -> f64 {
    a * second(psi, (b / a).powi(2))
}

fn turning((a, b): (f64, f64), psi: f64) -> f64 {
    (b * psi.sin()).atan2(a * psi.cos())
}

/// Centre (x, z), mm, of the upper section ellipse that has turned by `angle` about y.
fn centre(angle: f64) -> Option<[f64; 2]> {
    let (child, parent) = ((9.2, 2.3), (10.2, 1.9));
    let psi_of = |travel: f64, ellipse| root(|psi| arc(ellipse, psi) - travel, -1.57, 1.57);
    let travel = root(
        |s| match (psi_of(s, child), psi_of(s, parent)) {
            (Some(p), Some(q)) => turning(child, p) + turning(parent, q) - angle,
            _ => f64::NAN,
        },
        -9.7,
        9.7,
    )?;
    let (p, q) = (psi_of(travel, child)?, psi_of(travel, parent)?);
    let (sin, cos) = angle.sin_cos();
    // The child is touched from below, ahead of its centre.
    let [u, w] = [child.0 * p.sin(), -child.1 * p.cos()];
    Some([parent.0 * q.sin() - (cos * u + sin * w), parent.1 * q.cos() - (cos * w - sin * u)])
}

fn ellipsoids() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/coracoid_keel.toml"))?;
    let at = |degrees: f64| -> Result<[f64; 3], String> {
        let answer = file.solve(&[("tilt", degrees.to_radians())], 1e-12)?;
        Ok(answer.vector("center").map(|metres| 1e3 * metres))
    };
    let [x, y, z] = at(15.0)?;
    let mut differences = Vec::new();
    for degrees in [-30.0, -10.0, 5.0, 25.0, 40.0] {
        let ours = at(degrees)?;
        let [x, z] = centre(f64::to_radians(degrees)).ok_or("no contact")?;
        differences.extend([(ours[0] - x).abs(), ours[1].abs(), (ours[2] - z).abs()]);
    }
    Ok(vec![
        Row::absolute("x at 15° / mm", 0.680_657_917_2, x, 1e-8),
        Row::absolute("y at 15° / mm", 0.0, y, 1e-8),
        Row::absolute("z at 15° / mm", 4.814_013_338_0, z, 1e-8),
        Row::vanishing("centre at five angles / mm, largest difference", worst(differences), 1e-9),
    ])
}
