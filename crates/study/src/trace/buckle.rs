//! Critical loads of the problem linearised about an equilibrium.
//!
//! Classical linear buckling: what happens before does not bend the mechanism, so its shape stays and its wrenches grow with the
//! parameter, at the rate that they have at the equilibrium. The second variation is then H0 + (p - p0) H1 and becomes singular where
//! H0 φ = -μ H1 φ, at p = p0 + μ. H1 is a central difference along the wrenches' rate; the rest curvature gives way to the change of the
//! moments, so that the shape stays. Beams are cut into short stretches, each with its exact transfer map, so that only the
//! dependence on the load is linearised; the error goes with even powers of their length, of which three approximations take away
//! two (Romberg).

use super::path;
use super::pencil::Failure;
use super::record::normalise;
use crate::family::size_of;
use crate::{Family, Options, Prepared, ProblemError};
use flexura_model::{BuckleStudy, Guide, Joint, Model, StudyKind};
use flexura_solution::{BeamSample, Buckling, BucklingMode, Direction, Solution, Status};
use flexura_spatial::{Twist, Vector3};

/// Stretches that a smooth part of a beam is cut into, for three approximations.
const PARTS: [usize; 3] = [12, 24, 48];
/// Estimated error, as a part of the value, beyond which a value is none.
const UNSURE: f64 = 0.1;
/// Change of curvature times length beyond which a state counts as bent.
const BENT: f64 = 1e-4;
/// Part by which the distances of two values may differ that lie equally far away on either side.
const TIED: f64 = 1e-6;

/// Critical loads of the linearised problem on either side of the equilibrium's own, nearest first.
///
/// # Errors
/// A model that describes no solvable mechanism, or one without an energy.
pub fn buckle(
    model: &Model,
    family: &mut dyn Family,
    study: &BuckleStudy,
    options: &Options,
) -> Result<Buckling, ProblemError> {
    super::check_study(model, StudyKind::Buckle(*study))?;
    let base = model_at(model, family, study)?;
    let mut prepared = Prepared::new(&base)?;
    prepared.heed(&options.interrupt);
    let outcome = match study.parameter {
        Some(_) => prepared.solve(options.tolerance, &mut |_| {}),
        None => prepared.part_of_load(study.at, options.tolerance)?,
    };
    let mut solution = prepared.solution(&outcome, options.samples);
    let mut buckling =
        Buckling { parameter: study.parameter, at: study.at, solution: solution.clone(), modes: Vec::new() };
    if outcome.status != Status::Converged {
        return Ok(buckling);
    }
    prepared.add_tangents(&mut solution, &[]);
    refuse(&prepared, model, family, study, &solution)?;
    if bent(&solution) > BENT {
        solution.warnings.push(
            "other loads bend the mechanism already; what linear buckling says of a bent state may be off, so trace the parameter, too"
                .to_string(),
        );
    }
    let failed = |failure| match failure {
        Failure::Problem(error) => error,
        Failure::Critical => wrong(
            "is linearised about an equilibrium that is itself critical".to_string(),
            "choose another value of `at`",
        ),
        Failure::Breakdown => wrong(
            "has no sound numbers beside the equilibrium that it is linearised about".to_string(),
            "trace the load instead",
        ),
    };
    let width = prepared.difference(family, study, PARTS[0]).map_err(failed)?;
    let mut unsure = 0;
    if let Some(width) = width {
        (buckling.modes, unsure) =
            modes(&mut prepared, family, study, width, &solution).map_err(failed)?;
    }
    if unsure > 0 {
        solution.warnings.push(format!(
            "{unsure} critical values are left out, for they change by more than a tenth when beams are cut into more stretches; trace the \
             parameter instead"
        ));
    } else if buckling.modes.is_empty() {
        solution.warnings.push(nothing(model));
    } else if buckling.modes.len() < study.count.max(1) {
        solution.warnings.push(format!("only {} critical values were found", buckling.modes.len()));
    }
    solution.warnings.extend(path::compared(model, family, study, &buckling.modes, options));
    Ok(Buckling { solution, ..buckling })
}

fn wrong(why: String, hint: &str) -> ProblemError {
    ProblemError::new("study", why, hint)
}

/// The model at the equilibrium about which the problem is linearised.
fn model_at(model: &Model, family: &mut dyn Family, study: &BuckleStudy) -> Result<Model, ProblemError> {
    match study.parameter {
        Some(parameter) => family.model(&[(parameter, study.at)]).map_err(|error| ProblemError {
            hint: "choose `at` (`--at`): the value about which the problem is linearised".to_string(),
            ..error
        }),
        None => Ok(model.clone()),
    }
}

/// What linear buckling has no sound answer for.
fn refuse(
    prepared: &Prepared,
    model: &Model,
    family: &mut dyn Family,
    study: &BuckleStudy,
    solution: &Solution,
) -> Result<(), ProblemError> {
    // A load may be nothing here and follow as soon as it is something.
    let beside = study.parameter.and_then(|parameter| {
        let size = size_of(prepared.problem.model(), parameter, prepared.problem.units(), 1.0);
        let model = family.model(&[(parameter, study.at + 1e-3 * size)]).ok()?;
        Prepared::new(&model).ok()?.problem.without_energy()
    });
    if let Some(why) = prepared.problem.without_energy().or(beside) {
        return Err(wrong(
            format!("has no linear buckling: {why}"),
            "apply the moment through a joint to the ground, or use loads that keep their direction",
        ));
    }
    // The change of the moments along a bent beam is known between its stretches' ends only; that is too coarse beside a stiff axis.
    if bent(solution) > BENT && study.at != 0.0 {
        return Err(wrong(
            "is linearised about a bent state, for which this version has no sound answer".to_string(),
            "leave out `at`, or trace the parameter",
        ));
    }
    let in_channels = |guide: &Guide| matches!(guide, Guide::Channel { .. });
    match model.cables.iter().find(|cable| cable.route.iter().any(in_channels)) {
        Some(cable) => Err(wrong(
            format!(
                "has no linear buckling in this version: cable.{} runs in channels along beams",
                cable.name
            ),
            "trace the load instead",
        )),
        None => Ok(()),
    }
}

/// Why a mechanism has no critical value.
fn nothing(model: &Model) -> String {
    let sprung = |joint: &Joint| {
        joint.law.coordinates.iter().any(|law| law.stiffness != 0.0 || law.limits.is_some_and(|l| l.stiffness.is_some()))
    };
    if model.beams.is_empty() && model.springs.is_empty() && !model.joints.iter().any(sprung) {
        "nothing in it can buckle: it has no beam, no spring and no joint with a stiffness".to_string()
    } else {
        "no value is critical: along the load as it is linearised no stiffness changes".to_string()
    }
}

/// The critical values with their modes, nearest first, and how many are left out because they are unsure.
fn modes(
    prepared: &mut Prepared,
    family: &mut dyn Family,
    study: &BuckleStudy,
    width: f64,
    solution: &Solution,
) -> Result<(Vec<BucklingMode>, usize), Failure> {
    let wanted = study.count.max(1);
    let mut coarser: Vec<Vec<f64>> = Vec::with_capacity(PARTS.len());
    let (mut modes, mut unsure) = (Vec::new(), 0);
    for parts in PARTS {
<<<<<<< HEAD
        let mut pencil = match prepared.pencil(family, study, parts) {
            Ok(pencil) => pencil,
            Err(_) if options.interrupt.is_raised() => {
                let reason = "interrupted before the critical values were found".to_string();
                (solution.status, solution.reason) = (Status::Interrupted, Some(reason));
                return Ok(Buckling { parameter: study.parameter, at: study.at, solution, modes: Vec::new() });
            }
            Err(Failure::Breakdown(breakdown)) => return Err(critical(breakdown)),
            Err(Failure::Problem(error)) => return Err(error),
        };
        let size = pencil.base.size();
        let found = ritz::smallest(&mut |x| pencil.apply(x), size, 2 * wanted + 4);
        let beyond = found.iter().any(|(value, _)| *value > 0.0);
        let mut found: Vec<_> = found.into_iter().filter(|(value, _)| (*value > 0.0) == beyond).collect();
        found.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        found.truncate(wanted);
        if levels.len() + 1 == PARTS.len() {
            for (i, (value, x)) in found.iter().enumerate() {
                let (value, error_estimate) = romberg(&levels, i, *value);
                if error_estimate > UNSURE * value.abs() {
                    unsure += 1;
                    continue;
                }
                let (bodies, places) = prepared.problem.motions_of(&pencil.base, x);
                let direction = mode(&solution, bodies, &places, prepared.problem.units().0);
                modes.push(BucklingMode { value: study.at + value, error_estimate, direction });
            }
=======
        let mut pencil = prepared.pencil(family, study, parts, width)?;
        let mut found = pencil.nearest(2 * wanted + 4);
        // Of a pair on either side the one beyond comes first.
        found.sort_by(|a, b| {
            let apart = a.0.abs() - b.0.abs();
            let tied = apart.abs() <= TIED * a.0.abs().max(b.0.abs());
            if tied { b.0.total_cmp(&a.0) } else { apart.total_cmp(&0.0) }
        });
        if coarser.len() + 1 < PARTS.len() {
            coarser.push(found.into_iter().map(|(value, _)| value).collect());
            continue;
        }
        for (value, x) in found.iter().take(wanted) {
            let (value, error_estimate) = romberg(&mut coarser, *value);
            if error_estimate > UNSURE * value.abs() {
                unsure += 1;
                continue;
            }
            let (bodies, places) = prepared.problem.motions_of(&pencil.base, x);
            let direction = mode(solution, bodies, &places, prepared.problem.units().0);
            modes.push(BucklingMode { value: study.at + value, error_estimate, direction });
>>>>>>> ad557ea (Find critical values on either side, count turning on, and follow branches where several directions give way)
        }
    }
    Ok((modes, unsure))
}

/// How far beams are bent: the largest change of curvature times length.
pub(super) fn bent(solution: &Solution) -> f64 {
    let each = solution.beams.iter().flat_map(|beam| {
        beam.samples.iter().map(|sample| {
            // Twist alone leaves a beam straight.
            let change = sample.curvature - sample.rest_curvature;
            change.y.hypot(change.z) * beam.length
        })
    });
    each.fold(0.0, f64::max)
}

/// A mode at the samples of the equilibrium: between the places where beams were cut turnings go in straight lines, and displacements by
/// cubics whose slope is that of the turned axis.
fn mode(solution: &Solution, bodies: Vec<Twist>, places: &[Vec<(f64, Twist)>], length: f64) -> Direction {
    let beams = solution.beams.iter().zip(places).map(|(beam, places)| {
        let at = |sample: &BeamSample| -> Twist {
            let after = places.partition_point(|(s, _)| *s < sample.s).clamp(1, places.len().max(2) - 1);
            let (Some((a, first)), Some((b, last))) = (places.get(after - 1), places.get(after)) else {
                return Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
            };
            let (width, t) = (b - a, ((sample.s - a) / (b - a)).clamp(0.0, 1.0));
            let axis = sample.pose.rotation * Vector3::x();
            let slope = |twist: &Twist| twist.angular.cross(&axis) * width;
            let (u, v) = (t * t * (3.0 - 2.0 * t), t * (1.0 - t));
            Twist {
                angular: first.angular * (1.0 - t) + last.angular * t,
                linear: first.linear * (1.0 - u)
                    + last.linear * u
                    + (slope(first) * (1.0 - t) - slope(last) * t) * v,
            }
        };
        beam.samples.iter().map(at).collect()
    });
    let mut direction = Direction { beams: beams.collect(), bodies };
    normalise(&mut direction, length);
    direction
}

/// The value for stretches of no length, from those at two coarser levels that are nearest to the finest, and its estimated error. Values
/// that are used are taken away.
fn romberg(coarser: &mut [Vec<f64>], finest: f64) -> (f64, f64) {
    let mut take = |level: usize| -> Option<f64> {
        let list = coarser.get_mut(level)?;
        let apart = |value: &f64| (value - finest).abs();
        let nearest = (0..list.len()).min_by(|a, b| apart(&list[*a]).total_cmp(&apart(&list[*b])))?;
        Some(list.swap_remove(nearest))
    };
    let (Some(first), Some(second)) = (take(0), take(1)) else { return (finest, finest.abs()) };
    let (a, b) = (second + (second - first) / 3.0, finest + (finest - second) / 3.0);
    let better = (b - a) / 15.0;
    // Where stretches of no compliance stiffen the matrix, round-off has its part in it.
    (b + better, 4.0 * better.abs() + 1e-6 * b.abs())
}
<<<<<<< HEAD

enum Failure {
    Breakdown(Breakdown),
    Problem(ProblemError),
}

impl From<Breakdown> for Failure {
    fn from(breakdown: Breakdown) -> Self {
        Failure::Breakdown(breakdown)
    }
}

/// H0 factorised, and the two sides of the difference.
struct Pencil {
    base: Variation,
    sides: [Variation; 2],
    width: f64,
    work: Vec<f64>,
}

impl Pencil {
    /// `x ← -H0⁻¹ H1 x`, whose eigenvalues are 1/μ.
    fn apply(&mut self, x: &mut [f64]) {
        self.work.clear();
        self.work.resize(x.len(), 0.0);
        let factor = -0.5 / self.width;
        self.sides[0].multiply(-factor, x, &mut self.work);
        self.sides[1].multiply(factor, x, &mut self.work);
        x.copy_from_slice(&self.work);
        self.base.solve(x);
    }
}

impl Prepared {
    /// The equilibrium under a fraction of all loads and drives.
    fn part_of_load(&mut self, fraction: f64, tolerance: f64) -> Result<crate::Outcome, ProblemError> {
        self.problem.rest();
        let newton = NewtonOptions { tolerance: 1e-9, iterations: 30, nearest: f64::INFINITY };
        for i in 1..=LOAD_STEPS {
            self.problem.set_load(fraction * i as f64 / LOAD_STEPS as f64);
            self.problem.renew();
            if !matches!(converge(&mut self.problem, &newton), NewtonEnd::Converged { .. }) {
                if self.problem.is_interrupted() {
                    return Ok(self.interrupted(flexura_nonlinear::PathWork::default()));
                }
                return Err(ProblemError::new(
                    "study",
                    format!("finds no equilibrium under {fraction} of the load"),
                    "choose a smaller value of `at`",
                ));
            }
        }
        Ok(self.finish(tolerance, flexura_nonlinear::PathWork::default(), f64::INFINITY))
    }

    fn pencil(
        &mut self,
        family: &mut dyn Family,
        study: &BuckleStudy,
        parts: usize,
    ) -> Result<Pencil, Failure> {
        self.problem.linearise()?;
        let along = match study.parameter {
            Some(parameter) => {
                let size = size_of(self.problem.model(), parameter, self.problem.units(), SMALL);
                self.state_slope(family, parameter, study.at, 1e-3 * size).map_err(|error| match error {
                    crate::SensitivityError::Model(error) => Failure::Problem(error),
                    crate::SensitivityError::Tangent(breakdown) => Failure::Breakdown(breakdown),
                    crate::SensitivityError::Output(_) => Failure::Breakdown(Breakdown::NotFinite),
                })?
            }
            None => self.problem.response()?,
        };
        let size = self.problem.size(&along);
        // Where all forces are known the state does not show them.
        let one = match study.parameter {
            Some(parameter) => size_of(self.problem.model(), parameter, self.problem.units(), 1.0),
            None => 1.0,
        };
        let width = if size > 0.0 { (CHANGE / size).min(one) } else { CHANGE * one };
        let mut base = self.problem.variation(parts)?;
        let misfit = Failure::Breakdown(Breakdown::Singular);
        let mut sides =
            |prepared: &mut Self, step: &[f64], width: f64, stressed: Option<&Rate>| -> Result<_, Failure> {
                let minus = prepared.beside(family, study, parts, step, -width, stressed)?;
                let plus = prepared.beside(family, study, parts, step, width, stressed)?;
                Ok([minus, plus])
            };
        // How section moments change on the way, then the same wrenches with the shape as it is.
        let moved = sides(self, &along, width, None)?;
        if !moved.iter().all(|side| side.fits(&base)) {
            return Err(misfit);
        }
        let rate = Variation::rate(&moved[0], &moved[1], width);
        let width = STRESS * width;
        let sides = sides(self, &self.problem.wrench_part(&along), width, Some(&rate))?;
        if !sides.iter().all(|side| side.fits(&base)) {
            return Err(misfit);
        }
        base.factorise()?;
        Ok(Pencil { base, sides, width, work: Vec::new() })
    }

    /// The second variation beside the present state: `by` times the step away, at a parameter that differs by `by`. With the rate
    /// of the section moments the shape is kept.
    fn beside(
        &mut self,
        family: &mut dyn Family,
        study: &BuckleStudy,
        parts: usize,
        step: &[f64],
        by: f64,
        stressed: Option<&Rate>,
    ) -> Result<Variation, Failure> {
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        let load = self.problem.load_fraction();
        let own = match study.parameter {
            Some(parameter) => {
                let model =
                    family.model(&self.values_with(parameter, study.at + by)).map_err(Failure::Problem)?;
                let law = self.problem.neighbour(&model).map_err(Failure::Problem)?;
                Some(self.problem.exchange(law))
            }
            None => {
                self.problem.set_load(load + by);
                None
            }
        };
        if stressed.is_some() {
            // Drives stay where they are, too.
            self.problem.restore(&kept);
        }
        let step: Vec<f64> = step.iter().map(|s| s * by).collect();
        self.problem.retract(&step);
        let side = match stressed {
            Some(rate) => self.problem.stressed_variation(parts, rate, by),
            None => self.problem.variation(parts),
        };
        match own {
            Some(own) => {
                self.problem.exchange(own);
            }
            None => self.problem.set_load(load),
        }
        self.problem.restore(&kept);
        Ok(side?)
    }
}
=======
>>>>>>> ad557ea (Find critical values on either side, count turning on, and follow branches where several directions give way)
