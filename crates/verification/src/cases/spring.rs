//! The helical spring of Example 2.4.1, pushed at its free end.

use crate::build::{Stiffness, UNSHEARABLE, cantilever, load_tip};
use crate::measure::{SAMPLES, Units, apart, root, solve, tip};
use crate::{Case, Row};
use flexura_model::{Curve, LoadFrame, Model};
use flexura_solution::{BeamSample, Solution, Status};
use flexura_spatial::{Pose, Vector3, Vector6, Wrench, log};
use flexura_study::Prepared;
use flexura_testkit::helix::HelixByWrench;
use flexura_testkit::ivp::integrate;
use flexura_testkit::rod::{Rod, State};
use flexura_testkit::spring::{HelicalSpring, end_flexibility, wahl_stiffness};
use std::f64::consts::{PI, TAU};

pub const CASES: [Case; 3] = [
    Case {
        id: "spring_small_load",
        title: "Example 2.4.1: ten-turn spring, axial stiffness at small load, both readings of its pitch",
        citation: "Castigliano's theorem along the wire, and Love's formula (1927, §271) with torsion, bending and \
                   stretch of the wire",
        needed: "1e-6",
        run: small,
        closed_form: None,
    },
    Case {
        id: "spring_wahl",
        title: "Example 2.4.1: ten-turn spring, axial stiffness at small load, 5.715 mm per turn",
        citation: "G d⁴/(8 D³ n), torsion of a flat coil only (A. M. Wahl, *Mechanical Springs*, 2nd ed., 1963)",
        needed: "1 %, the order of the formula",
        run: wahl,
        closed_form: None,
    },
    Case {
        id: "spring_bows",
        title: "Example 2.4.1: axial push on the free wire end until the spring bows sideways",
        citation: "a run in far shorter load steps, to a 1e4 times finer tolerance; and an independent integration from the clamp by \
                   extrapolation of order 12, which must arrive with the applied load",
        needed: "1e-6",
        run: large,
        closed_form: None,
    },
];

const RADIUS: f64 = 7.239e-3;
const WIRE: f64 = 0.6985e-3;
const YOUNG: f64 = 193e9;
const SHEAR: f64 = 80.8e9;
const TURNS: f64 = 10.0;
/// "Pitch 5.715" per turn, which is the physical spring, and per radian.
const PITCHES: [(f64, &str); 2] = [(5.715e-3, "5.715 mm per turn"), (TAU * 5.715e-3, "2π 5.715 mm per turn")];

fn stiffness() -> Stiffness {
    let (area, inertia) = (PI * WIRE * WIRE, PI * WIRE.powi(4) / 4.0);
    let bending = YOUNG * inertia;
    Stiffness { ea: YOUNG * area, ga: f64::INFINITY, gj: SHEAR * 2.0 * inertia, ei2: bending, ei3: bending }
}

/// A spring of the given pitch, its wire clamped along x at the origin, e2 towards the coil's axis.
struct Spring {
    closed: HelicalSpring,
    rest: HelixByWrench,
    /// Direction of the coil's axis.
    axis: Vector3<f64>,
}

impl Spring {
    fn new(pitch: f64) -> Self {
        let rise = pitch / TAU;
        let slant = RADIUS.hypot(rise);
        let (bend, torsion) = (RADIUS / slant.powi(2), rise / slant.powi(2));
        let [ea, ga, _, gj, ei, _] = stiffness().compliance();
        Self {
            closed: HelicalSpring { radius: RADIUS, pitch, turns: TURNS, compliance: [ea, ga, gj, ei] },
            // Its shape only: with this twist e2 keeps pointing to the axis and nothing is stretched.
            rest: HelixByWrench {
                bending_stiffness: 1.0,
                torsion_stiffness: 1.0,
                axial_stiffness: f64::INFINITY,
                bend,
                torsion,
                twist: torsion,
            },
            axis: Vector3::new(torsion, 0.0, bend).normalize(),
        }
    }

    fn model(&self, force: Vector3<f64>, moment: Vector3<f64>) -> Model {
        let curve = Curve::Helix { radius: RADIUS, pitch: self.closed.pitch, turns: TURNS };
        let mut model = cantilever(stiffness().section(), curve, UNSHEARABLE, Pose::identity());
        load_tip(&mut model, force, moment, LoadFrame::Global);
        model
    }

    fn units(&self) -> Units {
        Units { length: self.closed.length(), stiffness: stiffness().softest() }
    }

    /// The wrench on the wire's end of a unit force along the coil's axis.
    fn unit_wrench(&self) -> Vector6<f64> {
        let end = self.rest.pose(self.closed.length()).position;
        let lever = Vector3::new(0.0, RADIUS, 0.0) - end;
        let moment = lever.cross(&self.axis);
        Vector6::new(self.axis.x, self.axis.y, self.axis.z, moment.x, moment.y, moment.z)
    }

    /// Axial displacement per axial force at a vanishing load, m/N: the work of the unit wrench on the end's
    /// displacement, with the even and cubic parts of the response taken out.
    fn measured_flexibility(&self) -> Result<f64, String> {
        let w = self.unit_wrench();
        self.flexibility(Vector3::new(w[0], w[1], w[2]), Vector3::new(w[3], w[4], w[5]))
    }

    /// The same of a force at the wire's end.
    fn force_flexibility(&self) -> Result<f64, String> {
        self.flexibility(self.axis, Vector3::zeros())
    }

    fn flexibility(&self, force: Vector3<f64>, moment: Vector3<f64>) -> Result<f64, String> {
        let odd = |load: f64| -> Result<f64, String> {
            let mut sum = 0.0;
            for sign in [1.0, -1.0] {
                let solution = solve(&self.model(force * load * sign, moment * load * sign), 1e-12)?;
                let end = tip(&solution.beams[0])?;
                let shift = end.pose.position - end.rest_pose.position;
                let turn = log(&(end.pose.rotation * end.rest_pose.rotation.inverse()));
                sum += 0.5 * sign * (force.dot(&shift) + moment.dot(&turn)) / load;
            }
            Ok(sum)
        };
        // 4/3 of the response at the small load, less 1/3 of that at the double.
        let load = 1e-3;
        Ok((4.0 * odd(load)? - odd(2.0 * load)?) / 3.0)
    }
}

fn small() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (pitch, name) in PITCHES {
        let spring = Spring::new(pitch);
        let measured = spring.measured_flexibility()?;
        let pose = |s: f64| spring.rest.pose(s);
        let flexibility = end_flexibility(pose, &stiffness().compliance(), spring.closed.length(), 160);
        let w = spring.unit_wrench();
        let castigliano = w.dot(&(flexibility * w));
        rows.push(Row::relative(
            format!("stiffness (Castigliano), N/m, {name}"),
            1.0 / castigliano,
            1.0 / measured,
            1e-6,
        ));
        let love = spring.closed.axial_flexibility();
        if pitch == PITCHES[0].0 {
            // The force alone at the wire's end, along the coil's axis, without the moment that shifts it there.
            let force = Vector6::new(w[0], w[1], w[2], 0.0, 0.0, 0.0);
            let ours = spring.force_flexibility()?;
            let name = |what: &str| format!("axial flexibility, mm/N, {what}, {name}");
            let castigliano = force.dot(&(flexibility * force));
            rows.push(Row::absolute(name("force at the wire's end"), 1e3 * castigliano, 1e3 * ours, 1e-7));
            rows.push(Row::absolute(name("the same by its value"), 1.522_523_638, 1e3 * ours, 1e-7));
            rows.push(Row::absolute(name("force through the axis"), 0.793_110_676, 1e3 * measured, 1e-7));
        }
        rows.push(Row::relative(format!("stiffness (Love), N/m, {name}"), 1.0 / love, 1.0 / measured, 1e-6));
    }
    Ok(rows)
}

fn wahl() -> Result<Vec<Row>, String> {
    let (pitch, name) = PITCHES[0];
    let wahl = wahl_stiffness(SHEAR, 2.0 * WIRE, 2.0 * RADIUS, TURNS);
    let measured = Spring::new(pitch).measured_flexibility()?;
    Ok(vec![Row::relative(format!("stiffness (Wahl), N/m, {name}"), wahl, 1.0 / measured, 1e-2)])
}

/// Pushes for the two pitches, N, the last ones far into the bowed shape.
const PUSHES: [[f64; 4]; 2] = [[1.0, 2.0, 4.0, 8.0], [0.25, 0.5, 1.0, 2.0]];

fn large() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for ((pitch, name), pushes) in PITCHES.into_iter().zip(PUSHES) {
        let spring = Spring::new(pitch);
        for push in pushes {
            let force = -spring.axis * push;
            let model = spring.model(force, Vector3::zeros());
            let context = |error: String| format!("{push} N, {name}: {error}");
            let usual = solve(&model, 1e-8).map_err(context)?;
            let fine = followed(&model).map_err(context)?;
            let off = apart(&usual.beams[0], &fine.beams[0], &spring.units())?;
            rows.push(
                Row::vanishing(format!("all poses and wrenches, scaled, {push} N, {name}"), off, 1e-6)
                    .with_estimate(usual.error_estimate),
            );
            let sideways = |end: &BeamSample| {
                let shift = end.pose.position - end.rest_pose.position;
                (shift - spring.axis * shift.dot(&spring.axis)).norm()
            };
            let (ours, reference) = (tip(&usual.beams[0])?, tip(&fine.beams[0])?);
            let what = format!("sideways motion of the wire's end, m, {push} N, {name}");
            rows.push(Row::scaled(what, sideways(reference), sideways(ours), spring.units().length, 1e-6));
            let (pose, missing) = arrive(&spring, root(&fine.beams[0])?.wrench, force);
            let distance = (pose.position - reference.pose.position).norm() / spring.units().length;
            let what = format!("{push} N, {name}, integrated from the clamp");
            rows.push(Row::vanishing(format!("end of the wire, /L, {what}"), distance, 1e-6));
            rows.push(Row::vanishing(format!("load not balanced at it, scaled, {what}"), missing, 1e-6));
        }
    }
    Ok(rows)
}

/// The same to 1e-12, led there from rest in load steps that are many times shorter than they need be, so that it
/// is sure to be on the path from rest.
fn followed(model: &Model) -> Result<Solution, String> {
    let mut prepared = Prepared::new(model).map_err(|error| error.to_string())?;
    let path = prepared.path_options();
    path.first_response = 0.02;
    path.largest_correction = 0.03;
    path.largest_contraction = 0.03;
    path.point_tolerance = 1e-8;
    let outcome = prepared.solve(1e-12, &mut |_| {});
    match outcome.status {
        Status::Converged => Ok(prepared.solution(&outcome, SAMPLES)),
        status => Err(format!("{}: {}", status.word(), outcome.reason.unwrap_or_default())),
    }
}

/// Where the wire ends if it leaves the clamp with `wrench`, and by how much its end wrench differs from a
/// `force` alone, scaled.
fn arrive(spring: &Spring, wrench: Wrench, force: Vector3<f64>) -> (Pose, f64) {
    let length = spring.closed.length();
    let rest = Vector3::new(spring.rest.torsion, 0.0, spring.rest.bend);
    let rod = Rod::uniform(length, stiffness().compliance(), rest);
    let start = State::new(&Pose::identity(), &wrench).to_array();
    let path = integrate(|s, y| rod.rates(s, y, 0.0), start, 0.0, length, 400);
    let end = State::from_array(&path[400].1);
    let units = spring.units();
    let missing = ((end.force - force).norm() / units.force()).max(end.moment.norm() / units.moment());
    (end.pose(), missing)
}
