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
use crate::{Family, ModelFamily, Options, Prepared, ProblemError};
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
pub fn buckle(model: &Model, study: &BuckleStudy, options: &Options) -> Result<Buckling, ProblemError> {
    buckle_family(model, &mut ModelFamily::new(model), study, options)
}

/// [`buckle`] where something else than the model's own rules makes the models with other values of its parameters.
///
/// # Errors
/// As [`buckle`].
pub fn buckle_family(
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
    let is_bent = bent(&solution) > BENT;
    if is_bent {
        solution.warnings.push(
            "other loads bend the mechanism already; what linear buckling says of a bent state may be off, so trace the parameter, too"
                .to_string(),
        );
    }
    let width = prepared.difference(family, study, PARTS[0]);
    let found = width.and_then(|width| match width {
        Some(width) => modes(&mut prepared, family, study, width, &solution),
        None => Ok((Vec::new(), 0)),
    });
    if options.interrupt.is_raised() {
        let reason = "interrupted before the critical values were found".to_string();
        (solution.status, solution.reason) = (Status::Interrupted, Some(reason));
        return Ok(Buckling { solution, ..buckling });
    }
    let unsure;
    (buckling.modes, unsure) = found.map_err(failed)?;
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
    solution.warnings.extend(path::compared(model, family, study, (&buckling.modes, is_bent), options));
    Ok(Buckling { solution, ..buckling })
}

fn failed(failure: Failure) -> ProblemError {
    match failure {
        Failure::Problem(error) => error,
        Failure::Critical => wrong(
            "is linearised about an equilibrium that is itself critical".to_string(),
            "choose another value of `at`",
        ),
        Failure::Breakdown => wrong(
            "has no sound numbers beside the equilibrium that it is linearised about".to_string(),
            "trace the load instead",
        ),
    }
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
        joint
            .law
            .coordinates
            .iter()
            .any(|law| law.stiffness != 0.0 || law.limits.is_some_and(|l| l.stiffness.is_some()))
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
    // What the load does about a stretched state is taken as about one that is not.
    let strains = solution.beams.iter().flat_map(|beam| &beam.samples).map(|sample| sample.strain.x.abs());
    let shortened = study.at.abs() * strains.fold(0.0, f64::max);
    for parts in PARTS {
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
            let (value, error) = romberg(&mut coarser, *value);
            let error_estimate = error + shortened;
            if error_estimate > UNSURE * value.abs() {
                unsure += 1;
                continue;
            }
            let (bodies, places) = prepared.problem.motions_of(&pencil.base, x);
            let direction = mode(solution, bodies, &places, prepared.problem.units().0);
            modes.push(BucklingMode { value: study.at + value, error_estimate, direction });
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
