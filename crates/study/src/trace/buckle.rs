//! Critical loads of the problem linearised about an equilibrium.
//!
//! Classical linear buckling: what happens before does not bend the mechanism, so its shape stays and its wrenches grow with the
//! parameter, at the rate that they have at the equilibrium. The second variation is then H0 + (p - p0) H1 and becomes singular where
//! H0 φ = -μ H1 φ, at p = p0 + μ. H1 is a central difference along the wrenches' rate; the rest curvature gives way to the change of the
//! moments, so that the shape stays. Beams are cut into short stretches, each with its exact transfer map, so that only the
//! dependence on the load is linearised; the error goes with even powers of their length, of which three approximations take away
//! two (Romberg).

use super::record::normalise;
use super::ritz;
use crate::family::{SMALL, size_of};
use crate::{Family, Options, Prepared, ProblemError};
use flexura_equilibrium::{Rate, Variation};
use flexura_model::{BuckleStudy, Joint, Model, StudyKind};
use flexura_nonlinear::{Breakdown, NewtonEnd, NewtonOptions, System, converge};
use flexura_solution::{BeamSample, Buckling, BucklingMode, Direction, Solution, Status};
use flexura_spatial::{Twist, Vector3};

/// Stretches that a smooth part of a beam is cut into, for three approximations.
const PARTS: [usize; 3] = [12, 24, 48];
/// Size of the change of the state along which the second variation is differenced.
const CHANGE: f64 = 1e-2;
/// By how much more the wrenches change where the shape is kept: the second variation is all but linear in them, and round-off in
/// stiff directions would tell in a small difference.
const STRESS: f64 = 30.0;
/// Estimated error, as a part of the value, beyond which a value is none.
const UNSURE: f64 = 0.1;
/// Change of curvature times length beyond which a state counts as bent.
const BENT: f64 = 1e-4;
/// Steps of the load to a fraction of it.
const LOAD_STEPS: usize = 20;

/// Critical loads of the linearised problem, nearest to the equilibrium's own first: those beyond it in the direction of growing
/// values, or below it where there are none beyond.
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
    let wrong = |why: String, hint: &str| ProblemError::new("study", why, hint);
    let base = match study.parameter {
        Some(parameter) => family.model(&[(parameter, study.at)]).map_err(|error| ProblemError {
            hint: "choose `at` (`--at`): the value about which the problem is linearised".to_string(),
            ..error
        })?,
        None => model.clone(),
    };
    let mut prepared = Prepared::new(&base)?;
    prepared.heed(&options.interrupt);
    let outcome = match study.parameter {
        Some(_) => prepared.solve(options.tolerance, &mut |_| {}),
        None => prepared.part_of_load(study.at, options.tolerance)?,
    };
    let mut solution = prepared.solution(&outcome, options.samples);
    if outcome.status != Status::Converged {
        return Ok(Buckling { parameter: study.parameter, at: study.at, solution, modes: Vec::new() });
    }
    // A load may be nothing here and follow as soon as it is something.
    let beside = match study.parameter {
        Some(parameter) => {
            let size = size_of(prepared.problem.model(), parameter, prepared.problem.units(), 1.0);
            family
                .model(&[(parameter, study.at + 1e-3 * size)])
                .ok()
                .and_then(|model| Prepared::new(&model).ok())
                .and_then(|beside| beside.problem.without_energy())
        }
        None => None,
    };
    if let Some(why) = prepared.problem.without_energy().or(beside) {
        return Err(wrong(
            format!("has no linear buckling: {why}"),
            "apply the moment through a joint to the ground, or use loads that keep their direction",
        ));
    }
    // The change of the moments along a bent beam is known between its stretches' ends only; that is too coarse beside a stiff axis.
    if bent(&solution) > BENT {
        if study.at != 0.0 {
            return Err(wrong(
                "is linearised about a bent state, for which this version has no sound answer".to_string(),
                "leave out `at`, or trace the parameter",
            ));
        }
        solution.warnings.push(
            "other loads bend the mechanism already; what linear buckling says of a bent state may be off, so trace the parameter, too"
                .to_string(),
        );
    }
    if let Some(cable) = model
        .cables
        .iter()
        .find(|cable| cable.route.iter().any(|guide| matches!(guide, flexura_model::Guide::Channel { .. })))
    {
        return Err(wrong(
            format!(
                "has no linear buckling in this version: cable.{} runs in channels along beams",
                cable.name
            ),
            "trace the load instead",
        ));
    }
    let critical = |_| {
        wrong(
            "is linearised about an equilibrium that is itself critical".to_string(),
            "choose another value of `at`",
        )
    };
    let wanted = study.count.max(1);
    let mut levels: Vec<Vec<f64>> = Vec::with_capacity(PARTS.len());
    let mut modes = Vec::new();
    let mut unsure = 0;
    for parts in PARTS {
        let mut pencil = match prepared.pencil(family, study, parts) {
            Ok(pencil) => pencil,
            Err(_) if options.interrupt.is_raised() => {
                let reason = "interrupted before the critical values were found".to_string();
                (solution.status, solution.reason) = (Status::Interrupted, Some(reason));
                return Ok(Buckling {
                    parameter: study.parameter,
                    at: study.at,
                    solution,
                    modes: Vec::new(),
                });
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
        }
        levels.push(found.into_iter().map(|(value, _)| value).collect());
    }
    if unsure > 0 {
        solution.warnings.push(format!(
            "{unsure} critical values are left out, for they change by more than a tenth when beams are cut into more stretches; trace the \
             parameter instead"
        ));
    } else if modes.is_empty() {
        solution.warnings.push(nothing(model));
    } else if modes.len() < wanted {
        solution.warnings.push(format!("only {} critical values were found", modes.len()));
    }
    Ok(Buckling { parameter: study.parameter, at: study.at, solution, modes })
}

/// Why a mechanism has no critical value.
fn nothing(model: &Model) -> String {
    let sprung = |joint: &Joint| {
        let mut laws = joint.law.coordinates.iter();
        laws.any(|law| law.stiffness != 0.0 || law.limits.is_some_and(|limits| limits.stiffness.is_some()))
    };
    if model.beams.is_empty() && model.springs.is_empty() && !model.joints.iter().any(sprung) {
        "nothing in it can buckle: it has no beam, no spring and no joint with a stiffness".to_string()
    } else {
        "no critical value was found: along the load as it is linearised no stiffness was seen to change"
            .to_string()
    }
}

/// How far beams are bent: the largest change of curvature times length.
fn bent(solution: &Solution) -> f64 {
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

/// The value for stretches of no length, from those at two coarser levels and the finest, and its estimated error.
fn romberg(levels: &[Vec<f64>], i: usize, finest: f64) -> (f64, f64) {
    let at = |level: usize| levels.get(level).and_then(|list| list.get(i)).copied();
    let (Some(first), Some(second)) = (at(0), at(1)) else { return (finest, finest.abs()) };
    let (a, b) = (second + (second - first) / 3.0, finest + (finest - second) / 3.0);
    let better = (b - a) / 15.0;
    // Where stretches of no compliance stiffen the matrix, round-off has its part in it.
    (b + better, 4.0 * better.abs() + 1e-6 * b.abs())
}

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
