//! From a solution to the result document.

use crate::wire::{BeamDocument, BodyDocument, Document, JointDocument, SpringDocument, Value, WorkDocument};
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_post::{BeamStress, Evaluation, OutputValue};
use flexura_solution::{BeamSample, BeamSolution, Solution, Status, Work};
use flexura_spatial::{Pose, UnitQuaternion, Vector3};

/// The result document of a solve.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn document(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<Document, OutputError> {
    let converged = solution.status == Status::Converged;
    let error_estimate = if converged || solution.error_estimate.is_finite() {
        Some(finite(solution.error_estimate, || "error_estimate".into())?)
    } else {
        None
    };
    let load_fraction = finite(solution.load_fraction, || "load_fraction".into())?;
    let beams = model.beams.iter().zip(&solution.beams).zip(&evaluation.beams);
    let bodies = model.bodies.iter().zip(&solution.bodies);
    let joints = model.joints.iter().zip(&solution.joints);
    let springs = model.springs.iter().zip(&solution.springs);
    Ok(Document {
        flexura: env!("CARGO_PKG_VERSION"),
        model: model.name.clone(),
        study: "solve",
        status: solution.status.word(),
        reason: solution.reason.clone(),
        load_fraction: (load_fraction != 1.0).then_some(load_fraction),
        residual: finite(solution.residual, || "residual".into())?,
        error_estimate,
        newton_steps: solution.work.newton_steps,
        warnings: solution.warnings.clone(),
        work: work(&solution.work),
        parameters: Named::collect(model.parameters.iter(), |parameter| {
            let value = finite(parameter.value, || format!("parameters.{}", parameter.name))?;
            Ok((parameter.name.clone(), value))
        })?,
        outputs: Named::collect(evaluation.outputs.iter(), |output| {
            let path = || format!("outputs.{}", output.name);
            let value = match output.value {
                OutputValue::Number(number) => Value::Number(finite(number, path)?),
                OutputValue::Vector(vector) => Value::Vector(all_finite(vector, path)?),
            };
            Ok((output.name.clone(), value))
        })?,
        beams: Named::collect(beams, |((beam, result), stress)| {
            let path = format!("beams.{}", beam.name);
            Ok((beam.name.clone(), beam_document(&path, result, stress.as_ref())?))
        })?,
        bodies: Named::collect(bodies, |(body, pose)| {
            let path = format!("bodies.{}", body.name);
            Ok((body.name.clone(), body_document(&path, pose)?))
        })?,
        joints: Named::collect(joints, |(joint, result)| {
            let path = |field: &str| format!("joints.{}.{field}", joint.name);
            let document = JointDocument {
                coordinates: finite_list(&path("coordinates"), result.coordinates.iter().copied())?,
                efforts: finite_list(&path("efforts"), result.efforts.iter().copied())?,
                force: all_finite(result.wrench.force.into(), || path("force"))?,
                moment: all_finite(result.wrench.moment.into(), || path("moment"))?,
            };
            Ok((joint.name.clone(), document))
        })?,
        springs: Named::collect(springs, |(spring, result)| {
            let document = SpringDocument {
                length: finite(result.length, || format!("springs.{}.length", spring.name))?,
                tension: finite(result.tension, || format!("springs.{}.tension", spring.name))?,
            };
            Ok((spring.name.clone(), document))
        })?,
        energy: finite(solution.energy, || "energy".into())?,
        stable: solution.stable,
        unstable_directions: solution.unstable_directions,
        stability_reason: solution.stability_reason.clone(),
    })
}

fn work(work: &Work) -> WorkDocument {
    WorkDocument {
        newton_steps: work.newton_steps,
        factorisations: work.factorisations,
        residuals: work.residuals,
        load_steps: work.load_steps,
        rejected_steps: work.rejected_steps,
        integration_steps: work.integration_steps,
        segments: work.segments,
    }
}

fn beam_document(
    path: &str,
    result: &BeamSolution,
    stress: Option<&BeamStress>,
) -> Result<BeamDocument, OutputError> {
    let vectors = |field: &str, pick: fn(&BeamSample) -> Vector3<f64>| {
        finite_vectors(path, field, result.samples.iter().map(|sample| pick(sample).into()))
    };
    let list =
        |field: &str, values: &mut dyn Iterator<Item = f64>| finite_list(&format!("{path}.{field}"), values);
    Ok(BeamDocument {
        s: list("s", &mut result.samples.iter().map(|sample| sample.s))?,
        position: vectors("position", |sample| sample.pose.position)?,
        rotation: finite_vectors(path, "rotation", section_quaternions(&result.samples).into_iter())?,
        force: vectors("force", |sample| sample.wrench.force)?,
        moment: vectors("moment", |sample| sample.wrench.moment)?,
        curvature: vectors("curvature", |sample| sample.curvature)?,
        stretch: list("stretch", &mut result.samples.iter().map(|sample| sample.strain.x))?,
        stress: stress
            .map(|stress| list("stress", &mut stress.samples.iter().map(|section| section.von_mises)))
            .transpose()?,
        strain: stress
            .map(|stress| list("strain", &mut stress.samples.iter().map(|section| section.strain)))
            .transpose()?,
    })
}

fn body_document(path: &str, pose: &Pose) -> Result<BodyDocument, OutputError> {
    Ok(BodyDocument {
        position: all_finite(pose.position.into(), || format!("{path}.position"))?,
        rotation: all_finite(quaternion(&pose.rotation), || format!("{path}.rotation"))?,
    })
}

/// (w, x, y, z), of the two signs the one with w >= 0 that stands for the same rotation.
pub(crate) fn quaternion(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = rotation.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    // Adding zero turns -0 into 0.
    [sign * q.w, sign * q.i, sign * q.j, sign * q.k].map(|component| component + 0.0)
}

/// (w, x, y, z) of a beam's sections: of the two signs always the one nearer to the section before, so that
/// the components run smoothly along a beam that turns by more than half a turn.
pub(crate) fn section_quaternions(samples: &[BeamSample]) -> Vec<[f64; 4]> {
    let mut quaternions: Vec<[f64; 4]> = Vec::with_capacity(samples.len());
    for sample in samples {
        let mut q = quaternion(&sample.pose.rotation);
        if let Some(before) = quaternions.last()
            && before.iter().zip(&q).map(|(a, b)| a * b).sum::<f64>() < 0.0
        {
            q = q.map(|component| 0.0 - component);
        }
        quaternions.push(q);
    }
    quaternions
}

fn finite(value: f64, field: impl FnOnce() -> String) -> Result<f64, OutputError> {
    if value.is_finite() { Ok(value) } else { Err(OutputError::NotFinite { field: field(), value }) }
}

fn all_finite<const N: usize>(
    values: [f64; N],
    field: impl FnOnce() -> String,
) -> Result<[f64; N], OutputError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(OutputError::NotFinite { field: field(), value: *value }),
        None => Ok(values),
    }
}

fn finite_list(path: &str, values: impl Iterator<Item = f64>) -> Result<Vec<f64>, OutputError> {
    values.enumerate().map(|(i, value)| finite(value, || format!("{path}[{i}]"))).collect()
}

fn finite_vectors<const N: usize>(
    path: &str,
    field: &str,
    values: impl Iterator<Item = [f64; N]>,
) -> Result<Vec<[f64; N]>, OutputError> {
    values.enumerate().map(|(i, value)| all_finite(value, || format!("{path}.{field}[{i}]"))).collect()
}
