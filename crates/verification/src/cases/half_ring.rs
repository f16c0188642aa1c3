//! The half ring of Example 2.4.2, twisted by its ends.

use crate::file::File;
use crate::{Case, Row};
use flexura_spatial::{Pose, UnitQuaternion, Vector3, Wrench, log};
use flexura_testkit::rod::{Rod, State};
use flexura_testkit::shoot::Shooting;
use flexura_testkit::spring::end_flexibility;
use std::f64::consts::PI;

pub const CASES: [Case; 1] = [Case {
    id: "half_ring",
    title: "Example 2.4.2, Figure 2.11: a half ring whose ends keep their places and turn by ±θ about the line between them \
            (`half_ring.toml`); torque in units of EI2/r for small angles, and at θ = 22.5° and 45°, for b/h = 2, 3, 6, ν = 0.29",
    citation: "Castigliano's theorem along the arc for small angles, b/h = 2: 0.5403796713 per relative angle; single shooting by \
               extrapolation of order 12; b/h = 2 at a relative angle of 45°: 0.474641816",
    needed: "1e-7",
    run,
    closed_form: None,
}];

const FILE: &str = include_str!("../../../../models/half_ring.toml");
const POISSON: f64 = 0.29;

/// J/(b h³) of a rectangle of width b and height h, by Saint-Venant's series.
fn torsion(aspect: f64) -> f64 {
    let term = |n: i32| {
        let odd = f64::from(2 * n + 1);
        (odd * PI * aspect / 2.0).tanh() / odd.powi(5)
    };
    1.0 / 3.0 - 64.0 / (PI.powi(5) * aspect) * (0..60).rev().map(term).sum::<f64>()
}

/// The ring of radius 1 with EI2 = 1; its axis does not stretch.
fn compliance(aspect: f64) -> [f64; 6] {
    let twist = 12.0 * torsion(aspect) / (2.0 * (1.0 + POISSON));
    [0.0, 0.0, 0.0, 1.0 / twist, 1.0, 1.0 / (aspect * aspect)]
}

fn about(axis: Vector3<f64>, angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(axis * angle)
}

/// Torque per relative angle at its start, of unit ring.
fn small(aspect: f64) -> Result<f64, String> {
    let rest = |s: f64| Pose::new(about(Vector3::z(), s), Vector3::new(s.sin(), -s.cos(), 0.0));
    let flexibility = end_flexibility(rest, &compliance(aspect), PI, 32);
    let stiffness = flexibility.try_inverse().ok_or("a rigid ring")?;
    Ok(stiffness[(4, 4)])
}

/// Torque of the unit ring at ±θ.
fn large(aspect: f64, theta: f64) -> Result<f64, String> {
    let rod = Rod::uniform(PI, compliance(aspect), Vector3::z());
    let start = |fraction: f64, x: &[f64; 6]| {
        let pose = Pose::new(about(Vector3::y(), theta * fraction), -Vector3::y());
        State::new(&pose, &Wrench::new(Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5])))
    };
    let misfit = |fraction: f64, _: &[f64; 6], end: &State| {
        let wanted = about(Vector3::y(), -theta * fraction) * about(Vector3::z(), PI);
        let off = log(&(end.pose().rotation * wanted.inverse()));
        let place = end.position - Vector3::y();
        [place.x, place.y, place.z, off.x, off.y, off.z]
    };
    let found = Shooting { rod: &rod, start: &start, misfit: &misfit }.solve(10);
    found.map(|x| x[4].abs()).ok_or_else(|| format!("shooting failed at {theta}"))
}

fn run() -> Result<Vec<Row>, String> {
    let file = File::new(FILE)?;
    let ours = |aspect: f64, theta: f64| -> Result<f64, String> {
        let values = [("aspect", aspect), ("theta", theta), ("poisson", POISSON)];
        Ok(file.solve(&values, 1e-11)?.number("normalised").abs())
    };
    let mut rows = Vec::new();
    for aspect in [2.0, 3.0, 6.0] {
        // A torque is odd in the angle: 4/3 of the response at the small angle, less 1/3 of that at its double.
        let step = 1e-3;
        let per_angle = |theta: f64| -> Result<f64, String> { Ok(ours(aspect, theta)? / (2.0 * theta)) };
        let found = (4.0 * per_angle(step)? - per_angle(2.0 * step)?) / 3.0;
        rows.push(Row::absolute(
            format!("torque per relative angle, b/h = {aspect}"),
            small(aspect)?,
            found,
            1e-7,
        ));
        if aspect == 2.0 {
            rows.push(Row::absolute("the same, by its value", 0.540_379_671_3, found, 1e-7));
        }
        for degrees in [22.5, 45.0_f64] {
            let theta = degrees.to_radians();
            let name = format!("torque at θ = {degrees}°, b/h = {aspect}");
            rows.push(Row::absolute(name, large(aspect, theta)?, ours(aspect, theta)?, 1e-7));
        }
    }
    let found = ours(2.0, 22.5f64.to_radians())?;
    rows.push(Row::absolute("torque at θ = 22.5°, b/h = 2, by its value", 0.474_641_816, found, 1e-7));
    Ok(rows)
}
