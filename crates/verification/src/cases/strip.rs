//! A steel strip that a weight of 50 g bends down.

use crate::build::{INEXTENSIBLE, cantilever};
use crate::measure::{Units, largest_deviation, solve, tip};
use crate::{Case, Estimate, Row};
use flexura_model::{At, BeamId, BeamPoint, Curve, Material, MaterialId, Model, PointMass, Section, Shape};
use flexura_spatial::{Pose, Vector3, Wrench, exp};
use flexura_testkit::elastica::Elastica;
use std::f64::consts::FRAC_PI_2;

pub const CASES: [Case; 1] = [Case {
    id: "strip_50_g",
    title: "Steel strip 20.32 x 0.254 x 152.4 mm, E = 207 GPa, 50 g at its tip, g = 9.81 m/s², own weight off",
    citation: "elliptic integrals at FL²/EI = 1.983330054: tip x/L = 0.841075234472, z/L = -0.491069989323, slope \
               44.5483841°, surface strain at mid-length 621.664 µε",
    needed: "1e-9; slope and strain all digits",
    run,
    closed_form: Some(estimates),
}];

const WIDTH: f64 = 20.32e-3;
const HEIGHT: f64 = 0.254e-3;
const LENGTH: f64 = 152.4e-3;
const YOUNG: f64 = 207e9;
const SHEAR: f64 = 79.3e9;
const MASS: f64 = 0.05;
const GRAVITY: f64 = 9.81;

fn bending() -> f64 {
    YOUNG * WIDTH * HEIGHT.powi(3) / 12.0
}

fn model() -> Model {
    let strip = Section {
        name: "strip".to_string(),
        shape: Shape::Rectangle { width: WIDTH.into(), height: HEIGHT.into() },
        plane_strain: false,
    };
    let mut model = cantilever(strip, Curve::Straight { length: LENGTH }, INEXTENSIBLE, Pose::identity());
    model.gravity = Vector3::new(0.0, 0.0, -GRAVITY);
    model.materials.push(Material {
        name: "spring_steel".to_string(),
        young: YOUNG,
        shear: SHEAR,
        density: None,
        yield_strength: None,
    });
    model.beams[0].material = Some(MaterialId(0));
    model.masses.push(PointMass {
        name: "payload".to_string(),
        point: BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) },
        mass: MASS,
        inertia: flexura_spatial::Matrix3::zeros(),
    });
    model
}

fn exact(shape: &Elastica, s: f64) -> (Pose, Wrench) {
    let station = shape.at(s / LENGTH);
    let [x, y] = station.position;
    // The closed form bends towards +y; here it is down, a rotation about +y.
    let pose =
        Pose::new(exp(&Vector3::new(0.0, station.angle, 0.0)), Vector3::new(x * LENGTH, 0.0, -y * LENGTH));
    let moment = Vector3::new(0.0, bending() * station.curvature / LENGTH, 0.0);
    (pose, Wrench::new(Vector3::new(0.0, 0.0, -MASS * GRAVITY), moment))
}

fn run() -> Result<Vec<Row>, String> {
    let model = model();
    let solution = solve(&model, 1e-10)?;
    let beam = &solution.beams[0];
    let end = tip(beam)?;
    let load = MASS * GRAVITY * LENGTH.powi(2) / bending();
    let shape = Elastica::dead(load, FRAC_PI_2);
    let tangent = end.pose.rotation * Vector3::x();
    let slope = (-tangent.z).atan2(tangent.x).to_degrees();
    let stress = flexura_post::beam_stress(&model, &model.beams[0], beam).ok_or("the strip has no stress")?;
    let middle = beam.samples.iter().position(|sample| (sample.s - 0.5 * LENGTH).abs() < 1e-9 * LENGTH);
    let middle = middle.ok_or("no sample at mid-length")?;
    let strain = stress.samples[middle].strain;
    let estimate = solution.error_estimate;
    Ok(vec![
        Row::absolute("FL²/EI", 1.983330054, load, 5e-10),
        Row::absolute("tip x/L", 0.841075234472, end.pose.position.x / LENGTH, 1e-9).with_estimate(estimate),
        Row::absolute("tip z/L", -0.491069989323, end.pose.position.z / LENGTH, 1e-9).with_estimate(estimate),
        Row::absolute("slope, degrees", 44.5483841, slope, 5e-8).with_estimate(estimate),
        Row::absolute("surface strain at mid-length, µε", 621.664, strain * 1e6, 5e-4),
        Row::relative(
            "surface strain at mid-length against the closed form",
            shape.at(0.5).curvature / LENGTH * 0.5 * HEIGHT,
            strain,
            1e-9,
        ),
    ])
}

fn estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let solution = solve(&model(), tolerance)?;
    let load = MASS * GRAVITY * LENGTH.powi(2) / bending();
    let shape = Elastica::dead(load, FRAC_PI_2);
    // Torsion is stiffer than bending about the wide side.
    let units = Units { length: LENGTH, stiffness: bending() };
    let error = largest_deviation(&solution.beams[0], &units, &|s| exact(&shape, s));
    Ok(vec![Estimate { what: "50 g".to_string(), error, estimate: solution.error_estimate }])
}
