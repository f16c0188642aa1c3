//! Beams on elastic foundations.

use crate::build::{SHEARABLE, Stiffness, cantilever, load_tip};
use crate::file::File;
use crate::measure::{Units, largest_deviation, solve};
use crate::path::{Path, counted, crossings, miscounted};
use crate::{Case, Row};
use flexura_expression::Function;
use flexura_model::{At, BuckleStudy, Curve, Foundation, FoundationLaw, LoadAxes, LoadFrame, Profile};
use flexura_spatial::{Pose, Vector3, exp};
use flexura_testkit::collocation::{self, Mesh, Tip};
use flexura_testkit::foundation::{Cantilever, hinged_column, tip_under_ramp};
use flexura_testkit::rod::Rod;
use std::f64::consts::PI;

pub const CASES: [Case; 3] = [
    Case {
        id: "foundation_cantilever",
        title: "Cantilevers on an elastic foundation under small tip loads, k L⁴/EI from 1 to 640,000, and one under the given \
                load q = -k x: the limit of our answers as all loads vanish, and how they go there",
        citation: "Cantilever on a foundation in closed form (M. Hetényi, *Beams on Elastic Foundation*, 1946); L² (40 FL + 60 M - 11 k \
                   L³)/(120 EI); EI = L = F = k = 1: 0.309101618168 and 0.241666666667",
        needed: "1e-9 of the limit, approached with second order",
        run: small,
        closed_form: None,
    },
    Case {
        id: "foundation_column",
        title: "Hinged columns on an elastic foundation (`column_on_foundation.toml`) that buckle in one, two and four half waves: \
                the first loads, met on the path and by linear buckling; unstable directions at every point",
        citation: "P = m² π² EI/L² + k L²/(m² π²): S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed. \
                   (1961), §2.10",
        needed: "1e-9 on the path, what linear buckling says of its error, 1e-5 at most; every count right",
        run: buckle,
        closed_form: None,
    },
    Case {
        id: "foundation_bend",
        title: "Curved rod that bends, twists, stretches and shears by more than a right angle, on a stiffness that varies along it, \
                one in all directions and a hardening law",
        citation: "collocation at Chebyshev points on the same equations (Ascher, Mattheij and Russell, 1995, ch. 5)",
        needed: "1e-9, every pose and wrench",
        run: bend,
        closed_form: None,
    },
];

/// A unit cantilever under loads that are all `eps` times as large as said.
const UNIT: &str = "format = 1
[parameter]
eps = 1e-2
k = 1
given = 0
force = 1
moment = 0
[section.unit]
shape = \"stiffness\"
EA = inf
GJ = 1
EI2 = 1
EI3 = 1
[beam.link]
section = \"unit\"
length = 1
start = { body = \"ground\", hold = \"clamp\" }
foundation = { stiffness = \"k\", direction = [0, 1, 0] }
distributed = { force = [0, \"-eps*given*s\", 0] }
[load.tip]
beam = \"link\"
at = 1
force = [0, \"eps*force\", 0]
moment = [0, 0, \"eps*moment\"]
[output]
tip = \"beam.link.end.displacement.y/eps\"
middle = \"beam.link[0.5].displacement.y/eps\"
";

/// The outputs in the limit of no load, by Romberg's scheme in eps², and the order with which the first goes there.
fn limit(values: &[(&str, f64)]) -> Result<([f64; 2], f64), String> {
    let file = File::new(UNIT)?;
    let at = |eps: f64| -> Result<[f64; 2], String> {
        let mut all = vec![("eps", eps)];
        all.extend(values);
        let answer = file.solve(&all, 1e-12)?;
        Ok([answer.number("tip"), answer.number("middle")])
    };
    let (a, b, c) = (at(0.08)?, at(0.04)?, at(0.02)?);
    let better = |coarse: f64, fine: f64, factor: f64| fine + (fine - coarse) / (factor - 1.0);
    let best = [0, 1].map(|i| better(better(a[i], b[i], 4.0), better(b[i], c[i], 4.0), 16.0));
    Ok((best, ((a[0] - b[0]) / (b[0] - c[0])).abs().log2()))
}

fn small() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    // bL = 10 and 20 are 40,000 and 640,000: almost all of these beams lies still.
    for (k, force, moment) in
        [(1.0, 1.0, 0.0), (1.0, 0.4, 1.0), (100.0, 1.0, -0.3), (4e4, 1.0, 0.2), (6.4e5, 1.0, 0.0)]
    {
        let exact = Cantilever::new(k, force, moment);
        let ([tip, middle], order) = limit(&[("k", k), ("force", force), ("moment", moment)])?;
        let name = format!("kL⁴/EI = {k}, F = {force}, M = {moment}");
        rows.push(Row::relative(format!("tip, {name}"), exact.deflection(1.0), tip, 1e-9));
        let size = exact.deflection(1.0);
        rows.push(Row::scaled(format!("middle, {name}"), exact.deflection(0.5), middle, size, 1e-9));
        if k < 1e3 {
            rows.push(Row::absolute(format!("order of approach, {name}"), 2.0, order, 0.02));
        }
    }
    let ([tip, _], order) = limit(&[("k", 0.0), ("given", 1.0)])?;
    rows.push(Row::relative("tip under q = -x, F = 1", tip_under_ramp(1.0, 1.0, 0.0), tip, 1e-9));
    rows.push(Row::absolute("order of approach, q = -x", 2.0, order, 0.02));
    Ok(rows)
}

fn buckle() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/column_on_foundation.toml"))?;
    let mut rows = Vec::new();
    for (bed, waves) in [(1.0, 1), (16.0, 2), (200.0, 4)] {
        // In π² EI/L² and π⁴ EI/L⁴.
        let wanted: Vec<(f64, usize)> =
            hinged_column(bed * PI.powi(4), 3).into_iter().map(|(load, m)| (load / (PI * PI), m)).collect();
        if wanted[0].1 != waves {
            return Err(format!("{} half waves at {bed}", wanted[0].1));
        }
        let path = Path::of("push", [0.5 * wanted[0].0, 0.5 * (wanted[1].0 + wanted[2].0)]);
        let followed = file.trace(&[("bed", bed)], &path, 1e-10)?;
        let branch = followed.first()?;
        let found = crossings(branch);
        if found.len() != 2 {
            return Err(format!("{} branch points at {bed}", found.len()));
        }
        for (i, (point, (load, m))) in found.iter().zip(&wanted).enumerate() {
            let what = format!("load {} on the path, kL⁴/π⁴EI = {bed}, {m} half waves", i + 1);
            rows.push(Row::relative(what, *load, point.parameter, 1e-9));
        }
        let unstable = |load: f64| wanted.iter().filter(|(critical, _)| *critical < load).count();
        rows.push(miscounted(branch, unstable));
        rows.push(counted(branch, &[0, 1, 2]));
        let linear = file.buckle(&[("bed", bed), ("push", 0.0)], "push", 2)?;
        for (i, ((load, m), (ours, estimate))) in wanted.iter().zip(&linear).enumerate() {
            let what = format!("load {} by linear buckling, kL⁴/π⁴EI = {bed}, {m} half waves", i + 1);
            // The study's own estimate is to hold.
            rows.push(Row::relative(what, *load, *ours, (estimate / load).min(1e-5)));
        }
    }
    Ok(rows)
}

impl File {
    /// The first critical values of a parameter about its value of zero, with their estimated errors.
    fn buckle(
        &self,
        values: &[(&str, f64)],
        parameter: &str,
        count: usize,
    ) -> Result<Vec<(f64, f64)>, String> {
        let overrides = Self::overrides(values);
        let model = self.document.model(&overrides).map_err(|report| report.render(false))?;
        let position = model.parameters.iter().position(|p| p.name == parameter);
        let study = BuckleStudy { parameter: position, at: 0.0, count };
        let options = flexura::Options { tolerance: 1e-10, ..flexura::Options::default() };
        let found = flexura::buckle(&model, &study, &options).map_err(|error| error.to_string())?;
        if found.modes.len() < count {
            return Err(format!("{} critical values", found.modes.len()));
        }
        Ok(found.modes.iter().map(|mode| (mode.value, mode.error_estimate)).collect())
    }
}

/// The rest shape's curvature, the place that the rod starts from, and its length.
const REST: [f64; 3] = [0.3, -0.4, 0.9];
const LENGTH: f64 = 1.3;

fn bend() -> Result<Vec<Row>, String> {
    let stiffness = Stiffness { ea: 200.0, ga: 90.0, gj: 0.8, ei2: 1.0, ei3: 1.6 };
    let start = Pose::new(exp(&Vector3::new(0.4, -1.1, 0.3)), Vector3::new(0.2, 0.5, -0.7));
    let along = Vector3::new(0.3, -0.5, 0.8).normalize();
    let hardening = "3*u + 400*u^3";
    let force = Vector3::new(-4.0, 5.0, 3.0);
    let moment = Vector3::new(0.6, -1.5, 0.8);
    let place = start;
    let rest = Vector3::from(REST);
    // The rest shape is a helix: the exponential of a constant twist.
    let shape = move |s: f64| {
        place * Pose::exp(&flexura_spatial::Twist { angular: rest * s, linear: Vector3::x() * s })
    };
    let law = Function::parse(hardening, "u").map_err(|error| format!("{error:?}"))?;
    let varying = Function::parse("2 + 3*s^2", "s").map_err(|error| format!("{error:?}"))?;

    let curve = Curve::Curvature { curvature: REST.map(Profile::from), length: LENGTH };
    let mut model = cantilever(stiffness.section(), curve, SHEARABLE, start);
    load_tip(&mut model, force, moment, LoadFrame::Global);
    let whole = [At::Fraction(0.0), At::Fraction(1.0)];
    let foundation = |law, direction, axes| Foundation { law, direction, axes, between: whole };
    model.beams[0].foundation = vec![
        foundation(FoundationLaw::Linear(Profile::from(4.0)), None, LoadAxes::Global),
        foundation(FoundationLaw::Force(law.clone()), Some(along), LoadAxes::Global),
        foundation(FoundationLaw::Linear(Profile::Function(varying)), Some(Vector3::y()), LoadAxes::Section),
    ];
    let solution = solve(&model, 1e-11)?;

    let reaction = move |s: f64, p: &Vector3<f64>| {
        let pose = shape(s);
        let w = p - pose.position;
        let e2 = pose.rotation * Vector3::y();
        -w * 4.0 - along * law.value(along.dot(&w)) - e2 * ((2.0 + 3.0 * s * s) * e2.dot(&w))
    };
    let rod =
        Rod { reaction: Some(Box::new(reaction)), ..Rod::uniform(LENGTH, stiffness.compliance(), rest) };
    let dead = |part: f64| Tip::Dead(flexura_spatial::Wrench::new(force, moment) * part);
    let mesh = Mesh { elements: 3, degree: 20 };
    let exact = collocation::solve(&rod, &start, &dead, 10, mesh).map_err(|error| format!("{error:?}"))?;
    let units = Units { length: LENGTH, stiffness: stiffness.softest() };
    let off = largest_deviation(&solution.beams[0], &units, &|s| (exact.at(s).pose(), exact.at(s).wrench()));
    let turned = solution.beams[0]
        .samples
        .last()
        .map_or(0.0, |tip| tip.pose.rotation.angle_to(&tip.rest_pose.rotation));
    if turned < 1.2 {
        return Err(format!("turned by {turned} rad only"));
    }
    // F(L) - F(0) is minus the whole force of the foundation.
    let total = exact.root().force - exact.tip().force;
    let apart = (solution.beams[0].foundation_force - total).norm() / total.norm();
    Ok(vec![
        Row::vanishing("all poses and wrenches, scaled", off, 1e-9).with_estimate(solution.error_estimate),
        Row::vanishing("whole force of the foundations, relative", apart, 1e-9),
    ])
}
