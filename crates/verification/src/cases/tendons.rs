//! Tendons in channels along a rod.

use crate::build::{INEXTENSIBLE, SHEARABLE, Stiffness, cantilever, load_tip};
use crate::measure::{root, solve, tip, worst};
use crate::{Case, Estimate, Row};
use flexura_expression::Function;
use flexura_model::{At, BeamId, Cable, CableLaw, Curve, Guide, LoadFrame, Model, Profile, Shape};
use flexura_solution::{BeamSample, Solution};
use flexura_spatial::{Matrix3, Matrix6, Pose, Quaternion, UnitQuaternion, Vector3, Vector6, exp, hat};
use flexura_testkit::ivp::integrate;

pub const CASES: [Case; 3] = [
    Case {
        id: "tendon_arc",
        title: "Straight tendon along a straight rod: an arc of 200° by the pull, and the same by the tendon's length",
        citation: "κ = T d/EI and ℓ = L (1 - κ d), e.g. D. B. Camarillo et al., \"Mechanics modeling of tendon-driven continuum \
                   manipulators\", IEEE Trans. Robotics 24 (2008) 1262-1273",
        needed: "1e-9",
        run: arc,
        closed_form: Some(arc_estimates),
    },
    Case {
        id: "tendon_helix",
        title: "Tendon that winds around a straight rod: the rod becomes a helix",
        citation: "k = C (-d × T u), u along e1 + (k + ω e1) × d, the same at every s in axes that turn with the tendon",
        needed: "1e-9",
        run: helix,
        closed_form: Some(helix_estimates),
    },
    Case {
        id: "tendon_robot",
        title: "Robot of three straight tendons and a winding one, under its weight and a load at its tip",
        citation: "D. C. Rucker and R. J. Webster, IEEE Trans. Robotics 27 (2011) 1033-1044: their equations for v' and u', \
                   integrated from the base by extrapolation of order 12, must arrive with the load and the tendons' pull",
        needed: "1e-8",
        run: robot,
        closed_form: None,
    },
];

fn function(text: &str) -> Result<Profile, String> {
    Function::parse(text, "s").map(Profile::Function).map_err(|error| format!("{error:?}"))
}

/// Adds a tendon along the whole first beam.
fn tendon(model: &mut Model, offset: [Profile; 2], law: CableLaw) {
    model.cables.push(Cable {
        name: format!("tendon_{}", model.cables.len()),
        route: vec![Guide::Channel {
            beam: BeamId(0),
            between: [At::Fraction(0.0), At::Fraction(1.0)],
            offset,
        }],
        law,
    });
}

fn straight_rod(length: f64) -> Model {
    let section = Stiffness::unit().section();
    cantilever(section, Curve::Straight { length }, INEXTENSIBLE, Pose::identity())
}

/// By how much a sample misses a pose, in lengths of one and radians.
fn apart(sample: &BeamSample, pose: &Pose) -> f64 {
    let gap = (sample.pose.position - pose.position).norm();
    worst([gap, sample.pose.rotation.angle_to(&pose.rotation)])
}

fn largest(solution: &Solution, exact: &dyn Fn(f64) -> Pose) -> f64 {
    worst(solution.beams[0].samples.iter().map(|sample| apart(sample, &exact(sample.s))))
}

const ARC_OFFSET: f64 = 0.05;
const ARC_ANGLE: f64 = 200.0;

fn arc_model(law: CableLaw) -> Model {
    let mut model = straight_rod(1.0);
    tendon(&mut model, [Profile::Constant(ARC_OFFSET), Profile::Constant(0.0)], law);
    model
}

fn arc_pose(s: f64) -> Pose {
    let kappa = ARC_ANGLE.to_radians();
    let angle = kappa * s;
    let position = Vector3::new(angle.sin(), 1.0 - angle.cos(), 0.0) / kappa;
    Pose::new(exp(&Vector3::new(0.0, 0.0, angle)), position)
}

fn arc() -> Result<Vec<Row>, String> {
    let kappa = ARC_ANGLE.to_radians();
    let (tension, length) = (kappa / ARC_OFFSET, 1.0 - kappa * ARC_OFFSET);
    let pulled = solve(&arc_model(CableLaw::Tension(tension)), 1e-10)?;
    let kept = solve(&arc_model(CableLaw::Length(length)), 1e-10)?;
    let middle = &pulled.beams[0].samples[20];
    Ok(vec![
        Row::vanishing("pulled: largest deviation of any pose", largest(&pulled, &arc_pose), 1e-9)
            .with_estimate(pulled.error_estimate),
        Row::relative("pulled: length of the tendon", length, pulled.cables[0].length, 1e-9),
        Row::relative("pulled: curvature at mid-length", kappa, middle.curvature.z, 1e-9),
        Row::relative("pulled: moment of the rod itself", kappa, middle.wrench.moment.z, 1e-9),
        Row::relative("pulled: strain energy", 0.5 * kappa * kappa, pulled.energy, 1e-9),
        Row::vanishing("kept at that length: largest deviation of any pose", largest(&kept, &arc_pose), 1e-9)
            .with_estimate(kept.error_estimate),
        Row::relative("kept at that length: tension", tension, kept.cables[0].tension, 1e-9),
    ])
}

fn arc_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let kappa = ARC_ANGLE.to_radians();
    let laws = [
        ("pulled", CableLaw::Tension(kappa / ARC_OFFSET)),
        ("kept", CableLaw::Length(1.0 - kappa * ARC_OFFSET)),
    ];
    let estimate = |(what, law): (&str, CableLaw)| {
        let solution = solve(&arc_model(law), tolerance)?;
        let error = largest(&solution, &arc_pose);
        Ok(Estimate { what: what.to_string(), error, estimate: solution.error_estimate })
    };
    laws.into_iter().map(estimate).collect()
}

const RADIUS: f64 = 0.08;
const WINDING: f64 = 5.0;
const PULL: f64 = 9.0;

fn helix_model() -> Result<Model, String> {
    let mut model = straight_rod(1.0);
    let offset = [function("0.08*cos(5*s)")?, function("0.08*sin(5*s)")?];
    tendon(&mut model, offset, CableLaw::Tension(PULL));
    Ok(model)
}

/// Curvature k + ω e1 in axes that turn with the tendon, and |w|.
fn helix_rates() -> (Vector3<f64>, f64) {
    let d = Vector3::new(0.0, RADIUS, 0.0);
    let soft = Matrix3::from_diagonal(&Vector3::new(1.3, 1.0, 1.0));
    let mut k = Vector3::zeros();
    let advance = |k: &Vector3<f64>| Vector3::x() + (k + Vector3::x() * WINDING).cross(&d);
    for _ in 0..500 {
        k = soft * -d.cross(&advance(&k).normalize()) * PULL;
    }
    (k + Vector3::x() * WINDING, advance(&k).norm())
}

fn helix_pose(s: f64) -> Pose {
    let (whole, _) = helix_rates();
    let (rate, x) = (whole.norm(), Vector3::x());
    let (axis, angle) = (whole / rate, rate * s);
    // ∫ exp(s hat(whole)) e1 ds by Rodrigues' formula.
    let position = x * (angle.sin() / rate)
        + axis.cross(&x) * ((1.0 - angle.cos()) / rate)
        + axis * axis.dot(&x) * (s - angle.sin() / rate);
    Pose::new(exp(&(whole * s)) * exp(&(Vector3::x() * -WINDING * s)), position)
}

fn helix() -> Result<Vec<Row>, String> {
    let solution = solve(&helix_model()?, 1e-10)?;
    let (whole, stretch) = helix_rates();
    let curvature = (whole - Vector3::x() * WINDING).norm();
    let middle = &solution.beams[0].samples[20];
    Ok(vec![
        Row::vanishing("largest deviation of any pose", largest(&solution, &helix_pose), 1e-9)
            .with_estimate(solution.error_estimate),
        Row::relative("curvature and twist at mid-length", curvature, middle.curvature.norm(), 1e-9),
        Row::relative("length of the tendon", stretch, solution.cables[0].length, 1e-9),
    ])
}

fn helix_estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    let solution = solve(&helix_model()?, tolerance)?;
    let error = largest(&solution, &helix_pose);
    Ok(vec![Estimate { what: "winding".to_string(), error, estimate: solution.error_estimate }])
}

const LENGTH: f64 = 0.24;
const DISC: f64 = 8e-3;
const MASS: f64 = 0.05;
const GRAVITY: f64 = 9.81;
const PULLS: [f64; 4] = [6.0, 1.0, 2.0, 4.0];
const TIP_FORCE: [f64; 3] = [0.03, 0.1, -0.05];
const TIP_MOMENT: [f64; 3] = [1e-3, -2e-3, 3e-3];
/// EA, GA, GA; GJ, EI2, EI3 of a rod that is a little wider than it is high.
const STRETCH: [f64; 3] = [3.2e4, 1.1e4, 1.1e4];
const BEND: [f64; 3] = [0.011, 0.012, 0.017];
/// Windings of the fourth tendon, rad/m.
const TURN: f64 = 13.0;

/// Offset of tendon `i` with its first and second derivative.
fn route(i: usize, s: f64) -> [Vector3<f64>; 3] {
    let (sin, cos) = match i {
        3 => (TURN * s).sin_cos(),
        _ => (f64::from(i as u8) * std::f64::consts::TAU / 3.0).sin_cos(),
    };
    let rate = if i == 3 { TURN } else { 0.0 };
    let d = Vector3::new(0.0, DISC * cos, DISC * sin);
    let across = Vector3::new(0.0, -DISC * sin, DISC * cos);
    [d, across * rate, -d * rate * rate]
}

fn robot_model() -> Result<Model, String> {
    let [ea, ga, _] = STRETCH;
    let [gj, ei2, ei3] = BEND;
    let mut section = Stiffness { ea, ga, gj, ei2, ei3 }.section();
    if let Shape::Stiffness { mass_per_length, .. } = &mut section.shape {
        *mass_per_length = Some(MASS.into());
    }
    let mut model = cantilever(section, Curve::Straight { length: LENGTH }, SHEARABLE, Pose::identity());
    model.gravity = Vector3::new(0.0, 0.0, -GRAVITY);
    for (i, pull) in PULLS.into_iter().enumerate() {
        let offset = if i == 3 {
            [function(&format!("{DISC}*cos({TURN}*s)"))?, function(&format!("{DISC}*sin({TURN}*s)"))?]
        } else {
            let [d, ..] = route(i, 0.0);
            [Profile::Constant(d.y), Profile::Constant(d.z)]
        };
        tendon(&mut model, offset, CableLaw::Tension(pull));
    }
    load_tip(&mut model, Vector3::from(TIP_FORCE), Vector3::from(TIP_MOMENT), LoadFrame::Global);
    Ok(model)
}

/// State of Rucker and Webster's equations: position, quaternion, v, u and the lengths of the tendons.
type State = [f64; 17];

fn triple(y: &State, at: usize) -> Vector3<f64> {
    Vector3::new(y[at], y[at + 1], y[at + 2])
}

fn orientation(y: &State) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(y[3], y[4], y[5], y[6]))
}

/// Their eqs. (10)-(17).
fn rate(s: f64, y: &State) -> State {
    let rotation = orientation(y);
    let (v, u) = (triple(y, 7), triple(y, 10));
    let (stretch, bend) = (Matrix3::from_diagonal(&STRETCH.into()), Matrix3::from_diagonal(&BEND.into()));
    let (n, m) = (stretch * (v - Vector3::x()), bend * u);
    let weight = rotation.inverse() * Vector3::new(0.0, 0.0, -MASS * GRAVITY);
    let (mut d, mut c) = (-u.cross(&n) - weight, -u.cross(&m) - v.cross(&n));
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&stretch);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&bend);
    let mut out = [0.0; 17];
    for (i, tension) in PULLS.into_iter().enumerate() {
        let [r, first, second] = route(i, s);
        let along = u.cross(&r) + first + v;
        let a = hat(&along) * hat(&along) * (-tension / along.norm().powi(3));
        let force = a * (u.cross(&along) + u.cross(&first) + second);
        d -= force;
        c -= r.cross(&force);
        let b = hat(&r) * a;
        let mut add = |row: usize, column: usize, part: Matrix3<f64>| {
            let mut view = matrix.fixed_view_mut::<3, 3>(row, column);
            view += part;
        };
        add(0, 0, a);
        add(0, 3, -a * hat(&r));
        add(3, 0, b);
        add(3, 3, -b * hat(&r));
        out[13 + i] = along.norm();
    }
    let change = matrix.lu().solve(&Vector6::new(d.x, d.y, d.z, c.x, c.y, c.z));
    let change = change.unwrap_or_else(|| Vector6::repeat(f64::NAN));
    let q = Quaternion::new(y[3], y[4], y[5], y[6]);
    let turning = q * Quaternion::new(0.0, u.x, u.y, u.z) * 0.5;
    out[..3].copy_from_slice((rotation * v).as_slice());
    out[3..7].copy_from_slice(&[turning.w, turning.i, turning.j, turning.k]);
    out[7..13].copy_from_slice(change.as_slice());
    out
}

fn robot() -> Result<Vec<Row>, String> {
    let solution = solve(&robot_model()?, 1e-10)?;
    let beam = &solution.beams[0];
    let (first, last) = (root(beam)?, tip(beam)?);
    let mut start = [0.0; 17];
    start[3] = 1.0;
    start[7..10].copy_from_slice((Vector3::x() + first.strain).as_slice());
    start[10..13].copy_from_slice(first.curvature.as_slice());
    let path = integrate(rate, start, 0.0, LENGTH, 400);
    let Some((_, end)) = path.last() else { return Err("nothing was integrated".to_string()) };

    // At the tip the rod carries the load and what the tendons' anchors pull.
    let rotation = orientation(end);
    let (v, u) = (triple(end, 7), triple(end, 10));
    let mut force = rotation.inverse() * Vector3::from(TIP_FORCE);
    let mut moment = rotation.inverse() * Vector3::from(TIP_MOMENT);
    for (i, tension) in PULLS.into_iter().enumerate() {
        let [r, slope, _] = route(i, LENGTH);
        let pull = (u.cross(&r) + slope + v).normalize() * tension;
        force -= pull;
        moment -= r.cross(&pull);
    }
    let carried = Matrix3::from_diagonal(&STRETCH.into()) * (v - Vector3::x());
    let bent = Matrix3::from_diagonal(&BEND.into()) * u;
    let (force_unit, moment_unit) = (BEND[0] / LENGTH.powi(2), BEND[0] / LENGTH);
    let estimate = solution.error_estimate;
    let mut rows = vec![
        Row::vanishing(
            "tip position, in lengths",
            (triple(end, 0) - last.pose.position).norm() / LENGTH,
            1e-8,
        )
        .with_estimate(estimate),
        Row::vanishing("tip orientation", rotation.angle_to(&last.pose.rotation), 1e-8),
        Row::vanishing("force at the tip, in GJ/L²", (force - carried).norm() / force_unit, 1e-6),
        Row::vanishing("moment at the tip, in GJ/L", (moment - bent).norm() / moment_unit, 1e-8),
        Row::vanishing("curvature at the tip, times L", (u - last.curvature).norm() * LENGTH, 1e-8),
    ];
    for (i, cable) in solution.cables.iter().enumerate() {
        rows.push(Row::relative(format!("length of tendon {i}"), end[13 + i], cable.length, 1e-9));
    }
    Ok(rows)
}
