//! Curves as rest shapes: an unloaded beam must come back to the curve it was made of.

use crate::build::{Stiffness, UNSHEARABLE, cantilever};
use crate::measure::{Units, largest_distance, root, solve, tip, worst};
use crate::{Case, Estimate, Row};
use flexura_expression::Function;
use flexura_model::{Curve, Model};
use flexura_spatial::{Pose, Vector3};
use flexura_testkit::elliptic::complete_second;
use flexura_testkit::ivp::integrate;
use std::f64::consts::{FRAC_PI_2, TAU};

pub const CASES: [Case; 3] = [
    Case {
        id: "ellipse",
        title: "Example 2.3.1: an ellipse as rest shape; its tangent turns through -E1",
        citation: "the curve's own formula; L = 40 E(m = 3/4) = 48.4422",
        needed: "1e-10 L",
        run: ellipse,
        closed_form: Some(ellipse_estimates),
    },
    Case {
        id: "helix",
        title: "Example 2.3.2: a helix of ten turns as rest shape",
        citation: "the curve's own formula; κ = r/(r² + p²) = 0.0851, τ = p/(r² + p²) = 0.0672 per mm \
                   (approximated curvatures gave an end that is 2.83 % off)",
        needed: "1e-10 L",
        run: helix,
        closed_form: Some(helix_estimates),
    },
    Case {
        id: "space_curve",
        title: "Example 2.3.3: a space curve as rest shape",
        citation: "the curve's own formula; L = 71.978 (71.973 is the sum of 100 chords), e_N = (0, 0.2169, 0.9762)",
        needed: "1e-10 L",
        run: space_curve,
        closed_form: Some(space_curve_estimates),
    },
];

/// A curve with its derivative, from parameter 0 to `range`, that starts at the origin along x, its e2 along y.
struct Formula {
    point: fn(f64) -> Vector3<f64>,
    slope: fn(f64) -> Vector3<f64>,
    range: f64,
}

const ELLIPSE: Formula = Formula {
    point: |t| Vector3::new(10.0 * t.sin(), 10.0 * (0.5 * t).sin().powi(2), 0.0),
    slope: |t| Vector3::new(10.0 * t.cos(), 5.0 * t.sin(), 0.0),
    range: TAU,
};

const SPACE_CURVE: Formula = Formula {
    point: |t| Vector3::new(25.0 * t.sin(), 20.0 * t.sin().powi(2), 40.0 * (1.5 * t).sin().powi(2)),
    slope: |t| Vector3::new(25.0 * t.cos(), 20.0 * (2.0 * t).sin(), 60.0 * (3.0 * t).sin()),
    range: FRAC_PI_2,
};

impl Formula {
    /// ∫|ẋ| dt.
    fn length(&self) -> f64 {
        let path = integrate(|t, _: &[f64; 1]| [(self.slope)(t).norm()], [0.0], 0.0, self.range, 400);
        path[400].1[0]
    }

    /// The parameters at `count` + 1 equal distances along the curve: dt/ds = 1/|ẋ|.
    fn parameters(&self, length: f64, count: usize) -> Vec<f64> {
        let fine = 10 * count;
        let path = integrate(|_, t: &[f64; 1]| [1.0 / (self.slope)(t[0]).norm()], [0.0], 0.0, length, fine);
        path.iter().step_by(10).map(|(_, t)| t[0]).collect()
    }
}

/// An unloaded beam, clamped at the origin.
fn model(curve: Curve) -> Model {
    cantilever(Stiffness::unit().section(), curve, UNSHEARABLE, Pose::identity())
}

fn parametric(position: [&str; 3], to: f64) -> Result<Model, String> {
    let function = |text: &str| Function::parse(text, "t").map_err(|error| error.to_string());
    let [x, y, z] = position;
    Ok(model(Curve::Parametric { position: [function(x)?, function(y)?, function(z)?], range: [0.0, to] }))
}

/// Largest error of position / L and tangent, and of the wrench, which must vanish, with the estimate.
fn deviation(model: &Model, formula: &Formula, tolerance: f64) -> Result<(f64, f64), String> {
    let solution = solve(model, tolerance)?;
    let beam = &solution.beams[0];
    let count = beam.samples.len() - 1;
    let units = Units { length: beam.length, stiffness: Stiffness::unit().softest() };
    let parameters = formula.parameters(formula.length(), count);
    let off = worst(beam.samples.iter().zip(&parameters).map(|(sample, t)| {
        let position = (sample.pose.position - (formula.point)(*t)).norm() / beam.length;
        let tangent = (sample.pose.rotation * Vector3::x() - (formula.slope)(*t).normalize()).norm();
        let force = sample.wrench.force.norm() / units.force();
        worst([position, tangent, force, sample.wrench.moment.norm() / units.moment()])
    }));
    Ok((off, solution.error_estimate))
}

fn ellipse_model() -> Result<Model, String> {
    parametric(["10*sin(t)", "5 - 5*cos(t)", "0"], TAU)
}

fn ellipse() -> Result<Vec<Row>, String> {
    let model = ellipse_model()?;
    let solution = solve(&model, 1e-11)?;
    let length = solution.beams[0].length;
    let exact = 40.0 * complete_second(0.25);
    let (off, estimate) = deviation(&model, &ELLIPSE, 1e-11)?;
    Ok(vec![
        Row::absolute("L as printed", 48.4422, length, 5e-5),
        Row::relative("L", exact, length, 1e-10),
        Row::vanishing("whole shape and tangent, /L", off, 1e-10).with_estimate(estimate),
        Row::vanishing("closes, /L", tip(&solution.beams[0])?.pose.position.norm() / length, 1e-10),
    ])
}

fn ellipse_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let (error, estimate) = deviation(&ellipse_model()?, &ELLIPSE, tolerance)?;
    Ok(vec![Estimate { what: "ellipse".to_string(), error, estimate }])
}

const RADIUS: f64 = 7.239;
const RISE: f64 = 5.715;

fn helix_model() -> Model {
    model(Curve::Helix { radius: RADIUS, pitch: TAU * RISE, turns: 10.0 })
}

/// The helix at arc length s, turned so that it starts along x with its normal along y.
fn helix_point(s: f64) -> Vector3<f64> {
    let slant = RADIUS.hypot(RISE);
    let t = s / slant;
    let own = Vector3::new(RADIUS * t.sin(), 2.0 * RADIUS * (0.5 * t).sin().powi(2), RISE * t);
    let (cosine, sine) = (RADIUS / slant, RISE / slant);
    Vector3::new(cosine * own.x + sine * own.z, own.y, -sine * own.x + cosine * own.z)
}

fn helix() -> Result<Vec<Row>, String> {
    let solution = solve(&helix_model(), 1e-11)?;
    let beam = &solution.beams[0];
    let k = root(beam)?.rest_curvature;
    let below = RADIUS.powi(2) + RISE.powi(2);
    let off = largest_distance(beam, &helix_point);
    Ok(vec![
        Row::absolute("κ as printed, 1/mm", 0.0851, k.z, 5e-5),
        Row::absolute("τ as printed, 1/mm", 0.0672, k.x, 5e-5),
        Row::relative("κ", RADIUS / below, k.y.hypot(k.z), 1e-10),
        Row::relative("τ", RISE / below, k.x, 1e-10),
        Row::relative("L", 10.0 * TAU * below.sqrt(), beam.length, 1e-10),
        Row::vanishing("whole shape, /L", off, 1e-10).with_estimate(solution.error_estimate),
    ])
}

fn helix_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let solution = solve(&helix_model(), tolerance)?;
    let error = largest_distance(&solution.beams[0], &helix_point);
    Ok(vec![Estimate { what: "helix".to_string(), error, estimate: solution.error_estimate }])
}

fn space_curve_model() -> Result<Model, String> {
    parametric(["25*sin(t)", "10 - 10*cos(2*t)", "20 - 20*cos(3*t)"], FRAC_PI_2)
}

fn space_curve() -> Result<Vec<Row>, String> {
    let model = space_curve_model()?;
    let solution = solve(&model, 1e-11)?;
    let beam = &solution.beams[0];
    let start = root(beam)?;
    // e_N points along e1' = k3 e2 - k2 e3.
    let k = start.rest_curvature;
    let normal = (start.rest_pose.rotation * Vector3::new(0.0, k.z, -k.y)).normalize();
    let exact = Vector3::new(0.0, 40.0, 180.0).normalize();
    let (off, estimate) = deviation(&model, &SPACE_CURVE, 1e-11)?;
    Ok(vec![
        Row::absolute("L as printed", 71.978, beam.length, 5e-4),
        Row::relative("L", SPACE_CURVE.length(), beam.length, 1e-10),
        Row::absolute("e_N,y as printed", 0.2169, normal.y, 5e-5),
        Row::absolute("e_N,z as printed", 0.9762, normal.z, 5e-5),
        Row::vanishing("e_N", (normal - exact).norm(), 1e-10),
        Row::vanishing("whole shape and tangent, /L", off, 1e-10).with_estimate(estimate),
    ])
}

fn space_curve_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let (error, estimate) = deviation(&space_curve_model()?, &SPACE_CURVE, tolerance)?;
    Ok(vec![Estimate { what: "space curve".to_string(), error, estimate }])
}
