//! From a solution to the result document.

use crate::contact::ContactDocument;
use crate::derivatives::{compliances, elasticities, motions, sensitivities};
use crate::scene::scene;
use crate::thin::shape_of;
use crate::wire::{
    BeamDocument, BodyDocument, CableDocument, CouplingDocument, Document, EquilibriumDocument,
    JointDocument, SpringDocument, StateDocument, TubesDocument, Value, WorkDocument,
};
use crate::{Named, OutputError};
use flexura_model::{Beam, Model, Tubes};
use flexura_post::{BeamStress, Evaluation, OutputValue, PostError};
use flexura_solution::{
    BeamSample, BeamSolution, CableSolution, Solution, SpringSolution, Status, TubesSample, TubesSolution,
    Work,
};
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
    let load_fraction = finite(solution.load_fraction, || "load_fraction".into())?;
    let state = state_document(model, solution, evaluation)?;
    let has_tangents = !solution.tangents.is_empty();
    Ok(Document {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "solve".to_owned(),
        status: solution.status.word().to_owned(),
        reason: solution.reason.clone(),
        load_fraction: (load_fraction != 1.0).then_some(load_fraction),
        residual: residual(solution)?,
        error_estimate: error_estimate(solution)?,
        newton_steps: solution.work.newton_steps,
        warnings: solution.warnings.clone(),
        work: work(&solution.work),
        parameters: parameters(model)?,
        unknowns: unknowns(model, solution)?,
        outputs: outputs(model, evaluation)?,
        output_reasons: output_reasons(evaluation),
        beams: state.beams,
        bodies: state.bodies,
        joints: state.joints,
        springs: state.springs,
        couplings: state.couplings,
        cables: state.cables,
        tubes: state.tubes,
        compliance: has_tangents.then(|| compliances(model, solution)).transpose()?,
        compliance_rows: has_tangents.then(|| ["x", "y", "z", "rx", "ry", "rz"].map(str::to_owned)),
        compliance_columns: has_tangents.then(|| ["fx", "fy", "fz", "mx", "my", "mz"].map(str::to_owned)),
        motion: has_tangents.then(|| motions(model, solution)).transpose()?,
        sensitivities: sensitivities(model, solution, evaluation)?,
        elasticities: elasticities(model, solution, evaluation)?,
        equilibria: None,
        energy: state.energy,
        stable: solution.stable,
        unstable_directions: solution.unstable_directions,
        stability_reason: solution.stability_reason.clone(),
        scene: scene(model, solution)?,
    })
}

/// The whole state of a mechanism.
pub(crate) fn state_document(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<StateDocument, OutputError> {
    let beams = model.beams.iter().zip(&solution.beams).zip(&evaluation.beams);
    let springs = model.springs.iter().zip(&solution.springs);
    Ok(StateDocument {
        beams: Named::collect(beams, |((beam, result), stress)| {
            let path = format!("beams.{}", beam.name);
            Ok((beam.name.clone(), beam_document(&path, beam, result, stress.as_ref())?))
        })?,
        bodies: bodies(model, solution)?,
        joints: joints(model, solution)?,
        springs: Named::collect(springs, |(spring, result)| {
            Ok((spring.name.clone(), spring_document(&format!("springs.{}", spring.name), result)?))
        })?,
        couplings: Named::collect(
            model.couplings.iter().zip(&solution.couplings),
            |(coupling, multiplier)| {
                let multiplier = finite(*multiplier, || format!("couplings.{}.multiplier", coupling.name))?;
                Ok((coupling.name.clone(), CouplingDocument { multiplier }))
            },
        )?,
        cables: Named::collect(model.cables.iter().zip(&solution.cables), |(cable, result)| {
            Ok((cable.name.clone(), cable_document(&format!("cables.{}", cable.name), result)?))
        })?,
        tubes: Named::collect(model.tubes.iter().zip(&solution.tubes), |(tubes, result)| {
            Ok((tubes.name.clone(), tubes_document(tubes, result)?))
        })?,
        energy: finite(solution.energy, || "energy".into())?,
    })
}

/// A study that broke off may stand where nothing can be evaluated, at the end of a boundary for instance.
pub(crate) fn residual(solution: &Solution) -> Result<Option<f64>, OutputError> {
    if solution.status != Status::Converged && !solution.residual.is_finite() {
        return Ok(None);
    }
    finite(solution.residual, || "residual".into()).map(Some)
}

/// One of several equilibria of a model, for [`Document::equilibria`].
///
/// # Errors
/// As [`document`].
pub fn equilibrium_document(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<EquilibriumDocument, OutputError> {
    Ok(EquilibriumDocument {
        energy: finite(solution.energy, || "energy".into())?,
        residual: finite(solution.residual, || "residual".into())?,
        error_estimate: error_estimate(solution)?,
        stable: solution.stable,
        outputs: outputs(model, evaluation)?,
        output_reasons: output_reasons(evaluation),
        bodies: bodies(model, solution)?,
        joints: joints(model, solution)?,
        shape: Some(shape_of(model, solution)?),
    })
}

pub(crate) fn parameters(model: &Model) -> Result<Named<f64>, OutputError> {
    Named::collect(model.parameters.iter(), |parameter| {
        let value = finite(parameter.value, || format!("parameters.{}", parameter.name))?;
        Ok((parameter.name.clone(), value))
    })
}

/// None for a study that broke off before there was one.
pub(crate) fn error_estimate(solution: &Solution) -> Result<Option<f64>, OutputError> {
    if solution.status == Status::Converged || solution.error_estimate.is_finite() {
        finite(solution.error_estimate, || "error_estimate".into()).map(Some)
    } else {
        Ok(None)
    }
}

fn unknowns(model: &Model, solution: &Solution) -> Result<Option<Named<f64>>, OutputError> {
    if solution.found.is_empty() {
        return Ok(None);
    }
    Named::collect(solution.found.iter(), |(position, value)| {
        let name = &model.parameters[*position].name;
        Ok((name.clone(), finite(*value, || format!("unknowns.{name}"))?))
    })
    .map(Some)
}

pub(crate) fn outputs(model: &Model, evaluation: &Evaluation) -> Result<Named<Option<Value>>, OutputError> {
    let mut outputs = Named::collect(evaluation.outputs.iter(), |output| {
        let path = || format!("outputs.{}", output.name);
        let value = match output.value {
            OutputValue::Number(number) => Value::Number(finite(number, path)?),
            OutputValue::Vector(vector) => Value::Vector(all_finite(vector, path)?),
        };
        Ok((output.name.clone(), Some(value)))
    })?;
    outputs.0.extend(evaluation.without_value.iter().map(|error| (error.output().to_owned(), None)));
    // As the model asks for them, whether they have a value or not.
    outputs.0.sort_by_key(|(name, _)| model.outputs.iter().position(|output| output.name == *name));
    Ok(outputs)
}

pub(crate) fn output_reasons(evaluation: &Evaluation) -> Named<String> {
    let reason = |error: &PostError| (error.output().to_owned(), error.to_string());
    Named(evaluation.without_value.iter().map(reason).collect())
}

/// The same of a path's point or of a time, which know outputs by their positions.
pub(crate) fn reasons_by_name<'a>(
    model: &Model,
    reasons: impl Iterator<Item = &'a (usize, String)>,
) -> Named<String> {
    let mut named: Vec<(String, String)> = Vec::new();
    for (position, reason) in reasons {
        if let Some(output) = model.outputs.get(*position)
            && named.iter().all(|(name, _)| *name != output.name)
        {
            named.push((output.name.clone(), reason.clone()));
        }
    }
    Named(named)
}

fn bodies(model: &Model, solution: &Solution) -> Result<Named<BodyDocument>, OutputError> {
    Named::collect(model.bodies.iter().zip(&solution.bodies), |(body, pose)| {
        let path = format!("bodies.{}", body.name);
        Ok((body.name.clone(), body_document(&path, pose)?))
    })
}

fn joints(model: &Model, solution: &Solution) -> Result<Named<JointDocument>, OutputError> {
    Named::collect(model.joints.iter().zip(&solution.joints), |(joint, result)| {
        let path = |field: &str| format!("joints.{}.{field}", joint.name);
        let names = joint.law.kind.coordinate_names();
        let document = JointDocument {
            names: if names.len() > 1 {
                names.iter().map(|name| (*name).to_owned()).collect()
            } else {
                Vec::new()
            },
            coordinates: finite_list(&path("coordinates"), result.coordinates.iter().copied())?,
            efforts: finite_list(&path("efforts"), result.efforts.iter().copied())?,
            force: all_finite(result.wrench.force.into(), || path("force"))?,
            moment: all_finite(result.wrench.moment.into(), || path("moment"))?,
            contact: match &result.contact {
                Some(contact) => Some(ContactDocument::new(&path("contact"), contact)?),
                None => None,
            },
        };
        Ok((joint.name.clone(), document))
    })
}

fn spring_document(path: &str, spring: &SpringSolution) -> Result<SpringDocument, OutputError> {
    let some = |value: Option<f64>, word: &str| {
        value.map(|value| finite(value, || format!("{path}.{word}"))).transpose()
    };
    Ok(SpringDocument {
        length: finite(spring.length, || format!("{path}.length"))?,
        tension: finite(spring.tension, || format!("{path}.tension"))?,
        strain: some(spring.strain, "strain")?,
        slack: spring.is_slack,
        stress: some(spring.stress, "stress")?,
        course: finite_vectors(path, "course", spring.course.iter().map(|point| (*point).into()))?,
    })
}

fn cable_document(path: &str, result: &CableSolution) -> Result<CableDocument, OutputError> {
    Ok(CableDocument {
        length: finite(result.length, || format!("{path}.length"))?,
        tension: finite(result.tension, || format!("{path}.tension"))?,
        course: finite_vectors(path, "course", result.course.iter().map(|point| (*point).into()))?,
    })
}

fn tubes_document(tubes: &Tubes, result: &TubesSolution) -> Result<TubesDocument, OutputError> {
    let path = format!("tubes.{}", tubes.name);
    let samples = || result.samples.iter();
    let vectors = |field: &str, pick: fn(&TubesSample) -> Vector3<f64>| {
        finite_vectors(&path, field, samples().map(|sample| pick(sample).into()))
    };
    // A tube is there from the guide to its end, so its list is the beginning of one over all samples.
    let by_tube = |field: &str, pick: fn(&TubesSample) -> &[(usize, f64)]| {
        let one = |tube: usize| {
            let value =
                |sample| pick(sample).iter().find(|(number, _)| *number == tube).map(|(_, value)| *value);
            finite_list(&format!("{path}.{field}[{tube}]"), samples().map_while(value))
        };
        (0..tubes.tubes.len()).map(one).collect::<Result<Vec<_>, _>>()
    };
    let rotations = section_quaternions(samples().map(|sample| &sample.pose.rotation));
    Ok(TubesDocument {
        s: finite_list(&format!("{path}.s"), samples().map(|sample| sample.s))?,
        position: vectors("position", |sample| sample.pose.position)?,
        rotation: finite_vectors(&path, "rotation", rotations.into_iter())?,
        force: vectors("force", |sample| sample.wrench.force)?,
        moment: vectors("moment", |sample| sample.wrench.moment)?,
        curvature: vectors("curvature", |sample| sample.curvature)?,
        angles: by_tube("angles", |sample| &sample.angles)?,
        torques: by_tube("torques", |sample| &sample.torques)?,
    })
}

pub(crate) fn work(work: &Work) -> WorkDocument {
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
    beam: &Beam,
    result: &BeamSolution,
    stress: Option<&BeamStress>,
) -> Result<BeamDocument, OutputError> {
    let vectors = |field: &str, pick: fn(&BeamSample) -> Vector3<f64>| {
        finite_vectors(path, field, result.samples.iter().map(|sample| pick(sample).into()))
    };
    let list =
        |field: &str, values: &mut dyn Iterator<Item = f64>| finite_list(&format!("{path}.{field}"), values);
    let founded = !beam.foundation.is_empty();
    let rotations = section_quaternions(result.samples.iter().map(|sample| &sample.pose.rotation));
    Ok(BeamDocument {
        s: list("s", &mut result.samples.iter().map(|sample| sample.s))?,
        position: vectors("position", |sample| sample.pose.position)?,
        rotation: finite_vectors(path, "rotation", rotations.into_iter())?,
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
        foundation: founded.then(|| vectors("foundation", |sample| sample.foundation)).transpose()?,
        foundation_force: founded
            .then(|| all_finite(result.foundation_force.into(), || format!("{path}.foundation_force")))
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

/// (w, x, y, z) of the sections along an axis: of the two signs always the one nearer to the section before, so that
/// the components run smoothly along one that turns by more than half a turn.
pub(crate) fn section_quaternions<'a>(
    rotations: impl Iterator<Item = &'a UnitQuaternion<f64>>,
) -> Vec<[f64; 4]> {
    let mut quaternions: Vec<[f64; 4]> = Vec::with_capacity(rotations.size_hint().0);
    for rotation in rotations {
        let mut q = quaternion(rotation);
        if let Some(before) = quaternions.last()
            && before.iter().zip(&q).map(|(a, b)| a * b).sum::<f64>() < 0.0
        {
            q = q.map(|component| 0.0 - component);
        }
        quaternions.push(q);
    }
    quaternions
}

pub(crate) fn finite(value: f64, field: impl FnOnce() -> String) -> Result<f64, OutputError> {
    if value.is_finite() { Ok(value) } else { Err(OutputError::NotFinite { field: field(), value }) }
}

pub(crate) fn all_finite<const N: usize>(
    values: [f64; N],
    field: impl FnOnce() -> String,
) -> Result<[f64; N], OutputError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(OutputError::NotFinite { field: field(), value: *value }),
        None => Ok(values),
    }
}

pub(crate) fn finite_list(path: &str, values: impl Iterator<Item = f64>) -> Result<Vec<f64>, OutputError> {
    values.enumerate().map(|(i, value)| finite(value, || format!("{path}[{i}]"))).collect()
}

pub(crate) fn finite_vectors<const N: usize>(
    path: &str,
    field: &str,
    values: impl Iterator<Item = [f64; N]>,
) -> Result<Vec<[f64; N]>, OutputError> {
    values.enumerate().map(|(i, value)| all_finite(value, || format!("{path}.{field}[{i}]"))).collect()
}
