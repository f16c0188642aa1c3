//! The way back: a result document as the solution that a later study starts from.

use crate::Named;
use crate::wire::{BeamDocument, BodyDocument, Document, JointDocument, TubesDocument};
use flexura_model::{Attachment, JointKind, Model, Mount};
use flexura_solution::{
    BeamSample, BeamSolution, CableSolution, JointSolution, Solution, SpringSolution, Status, TubesSample,
    TubesSolution, Work,
};
use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

/// Why a text cannot be used as an earlier result.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It is something else.
    #[error("this is no result document of `flexura solve`: {0}")]
    NoDocument(String),
    /// Its parts are not those of the model.
    #[error("this is the result of another mechanism: {0}")]
    OtherMechanism(String),
    /// It does not hold the model file that it is of.
    #[error(
        "this result does not hold its model file, so it cannot be drawn again; make it anew from the file"
    )]
    NoModel,
    /// Its study has pictures of other things than states.
    #[error("results of `{0}` cannot be drawn again; name --svg or --png when the study is done")]
    NoPicture(String),
    /// It was one, but something in it is not as it was written.
    #[error("this result document is broken: {0}")]
    Broken(String),
}

/// Norms of quaternions may differ from one by this much.
const UNIT: f64 = 1e-6;

/// The document that stands in a JSON text.
///
/// # Errors
/// [`ReadError`] for anything that [`crate::document`] cannot have written.
pub fn read_document(text: &str) -> Result<Document, ReadError> {
    let value: serde_json::Value =
        serde_json::from_str(text).map_err(|error| ReadError::NoDocument(error.to_string()))?;
    let word = |key: &str| value.get(key).and_then(serde_json::Value::as_str);
    if word("flexura").is_none() {
        return Err(ReadError::NoDocument("it has no key `flexura`".into()));
    }
    match word("study") {
        Some("solve") => {}
        Some(study) => return Err(ReadError::NoDocument(format!("its study is `{study}`"))),
        None => return Err(ReadError::NoDocument("it has no key `study`".into())),
    }
    // From the text again: a value would sort the names.
    serde_json::from_str(text).map_err(|error| ReadError::Broken(error.to_string()))
}

/// The solution that a document holds, in the order of a model whose beams, bodies and joints have the same names.
///
/// A document does not hold rest shapes and shear strains: the rest pose and rest curvature of a sample are those of
/// the deformed beam, and its shear strains are zero.
///
/// # Errors
/// [`ReadError::OtherMechanism`] where the names differ, [`ReadError::Broken`] where lists do not fit each other.
pub fn solution_of(document: &Document, model: &Model) -> Result<Solution, ReadError> {
    let beams = in_order(&document.beams, "beam", model.beams.iter().map(|beam| beam.name.as_str()))?;
    let bodies = in_order(&document.bodies, "body", model.bodies.iter().map(|body| body.name.as_str()))?;
    let joints = in_order(&document.joints, "joint", model.joints.iter().map(|joint| joint.name.as_str()))?;
    let mut solution = Solution {
        status: status_of(&document.status)?,
        reason: document.reason.clone(),
        load_fraction: document.load_fraction.unwrap_or(1.0),
        residual: document.residual.unwrap_or(f64::INFINITY),
        error_estimate: document.error_estimate.unwrap_or(f64::NAN),
        warnings: document.warnings.clone(),
        work: Work { newton_steps: document.newton_steps, ..Work::default() },
        beams: beams.into_iter().map(|(name, beam)| beam_solution(name, beam)).collect::<Result<_, _>>()?,
        bodies: bodies
            .into_iter()
            .map(|(name, body)| pose(&format!("bodies.{name}"), body))
            .collect::<Result<_, _>>()?,
        joints: joints
            .into_iter()
            .zip(&model.joints)
            .map(|((name, joint), described)| joint_solution(name, joint, described.law.kind))
            .collect::<Result<_, _>>()?,
        springs: Vec::new(),
        couplings: Vec::new(),
        cables: Vec::new(),
        tubes: Vec::new(),
        tangents: Vec::new(),
        sensitivities: None,
        found: Vec::new(),
        energy: document.energy,
        stable: document.stable,
        unstable_directions: document.unstable_directions,
        stability_reason: document.stability_reason.clone(),
        rates: None,
    };
    // Springs, couplings, cables and tubes follow from the rest; one that the document does not know is no obstacle.
    let springs = model.springs.iter().map(|spring| {
        let known = document.springs.get(&spring.name);
        SpringSolution {
            ends: [end_point(&solution, &spring.from), end_point(&solution, &spring.to)],
            length: known.map_or(0.0, |spring| spring.length),
            tension: known.map_or(0.0, |spring| spring.tension),
            strain: known.and_then(|spring| spring.strain),
            stress: known.and_then(|spring| spring.stress),
            is_slack: known.is_some_and(|spring| spring.slack),
            course: known.map_or_else(Vec::new, |spring| {
                spring.course.iter().map(|point| Vector3::from(*point)).collect()
            }),
        }
    });
    solution.springs = springs.collect();
    let multiplier = |name: &str| document.couplings.get(name).map_or(0.0, |coupling| coupling.multiplier);
    solution.couplings = model.couplings.iter().map(|coupling| multiplier(&coupling.name)).collect();
    let cables = model.cables.iter().map(|cable| match document.cables.get(&cable.name) {
        Some(known) => CableSolution {
            course: known.course.iter().map(|point| Vector3::from(*point)).collect(),
            length: known.length,
            tension: known.tension,
        },
        None => CableSolution { course: Vec::new(), length: 0.0, tension: 0.0 },
    });
    solution.cables = cables.collect();
    let tubes = model.tubes.iter().map(|tubes| match document.tubes.get(&tubes.name) {
        Some(known) => tubes_solution(&tubes.name, known),
        None => Ok(TubesSolution::default()),
    });
    solution.tubes = tubes.collect::<Result<_, _>>()?;
    for (name, value) in document.unknowns.iter().flat_map(|unknowns| &unknowns.0) {
        if let Some(position) = model.parameters.iter().position(|parameter| parameter.name == *name) {
            solution.found.push((position, *value));
        }
    }
    Ok(solution)
}

/// The status of that word.
pub(crate) fn status_of(word: &str) -> Result<Status, ReadError> {
    let status = STATUSES.into_iter().find(|status| status.word() == word);
    status.ok_or_else(|| ReadError::Broken(format!("there is no status `{word}`")))
}

const STATUSES: [Status; 8] = [
    Status::Converged,
    Status::Stalled,
    Status::IterationLimit,
    Status::Singular,
    Status::Inconsistent,
    Status::AccuracyLimit,
    Status::Interrupted,
    Status::Infeasible,
];

/// The document's entries in the order of the model's names, which must be the same ones.
fn in_order<'a, 'b, T>(
    entries: &'a Named<T>,
    kind: &str,
    names: impl Iterator<Item = &'b str>,
) -> Result<Vec<(&'b str, &'a T)>, ReadError> {
    let mut found = Vec::new();
    for name in names {
        match entries.get(name) {
            Some(entry) => found.push((name, entry)),
            None => return Err(ReadError::OtherMechanism(format!("it has no {kind} `{name}`"))),
        }
    }
    match entries.0.iter().find(|(name, _)| found.iter().all(|(known, _)| known != name)) {
        Some((name, _)) => {
            Err(ReadError::OtherMechanism(format!("its {kind} `{name}` is not in the model file")))
        }
        None => Ok(found),
    }
}

fn rotation(path: &str, [w, i, j, k]: [f64; 4]) -> Result<UnitQuaternion<f64>, ReadError> {
    let norm = (w * w + i * i + j * j + k * k).sqrt();
    if (norm - 1.0).abs() > UNIT {
        return Err(ReadError::Broken(format!("{path} is no unit quaternion: its norm is {norm}")));
    }
    Ok(UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
}

fn pose(path: &str, body: &BodyDocument) -> Result<Pose, ReadError> {
    Ok(Pose::new(rotation(&format!("{path}.rotation"), body.rotation)?, body.position.into()))
}

fn beam_solution(name: &str, beam: &BeamDocument) -> Result<BeamSolution, ReadError> {
    let broken = |message: String| ReadError::Broken(format!("beams.{name}: {message}"));
    let count = beam.s.len();
    if count < 2 {
        return Err(broken("it has fewer than two samples".into()));
    }
    let lengths = [
        ("position", beam.position.len()),
        ("rotation", beam.rotation.len()),
        ("force", beam.force.len()),
        ("moment", beam.moment.len()),
        ("curvature", beam.curvature.len()),
        ("stretch", beam.stretch.len()),
        ("foundation", beam.foundation.as_ref().map_or(count, Vec::len)),
    ];
    if let Some((field, length)) = lengths.into_iter().find(|(_, length)| *length != count) {
        return Err(broken(format!("`s` has {count} entries, but `{field}` has {length}")));
    }
    if beam.s[0] != 0.0 || beam.s.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(broken("`s` does not grow from zero".into()));
    }
    let sample = |i: usize| -> Result<BeamSample, ReadError> {
        let rotation = rotation(&format!("beams.{name}.rotation[{i}]"), beam.rotation[i])?;
        let pose = Pose::new(rotation, beam.position[i].into());
        Ok(BeamSample {
            s: beam.s[i],
            pose,
            rest_pose: pose,
            wrench: Wrench::new(beam.force[i].into(), beam.moment[i].into()),
            curvature: beam.curvature[i].into(),
            rest_curvature: beam.curvature[i].into(),
            strain: Vector3::new(beam.stretch[i], 0.0, 0.0),
            foundation: beam.foundation.as_ref().map_or(Vector3::zeros(), |list| list[i].into()),
        })
    };
    let samples = (0..count).map(sample).collect::<Result<_, _>>()?;
    let foundation_force = beam.foundation_force.map_or(Vector3::zeros(), Vector3::from);
    Ok(BeamSolution { samples, length: beam.s[count - 1], foundation_force })
}

fn tubes_solution(name: &str, tubes: &TubesDocument) -> Result<TubesSolution, ReadError> {
    let broken = |message: String| ReadError::Broken(format!("tubes.{name}: {message}"));
    let count = tubes.s.len();
    let lengths = [
        ("position", tubes.position.len()),
        ("rotation", tubes.rotation.len()),
        ("force", tubes.force.len()),
        ("moment", tubes.moment.len()),
        ("curvature", tubes.curvature.len()),
    ];
    if let Some((field, length)) = lengths.into_iter().find(|(_, length)| *length != count) {
        return Err(broken(format!("`s` has {count} entries, but `{field}` has {length}")));
    }
    if tubes.angles.iter().chain(&tubes.torques).any(|list| list.len() > count) {
        return Err(broken("`angles` and `torques` go further than `s`".into()));
    }
    // The tubes that reach a sample, each with its value there.
    let there = |lists: &[Vec<f64>], i: usize| -> Vec<(usize, f64)> {
        let values = lists.iter().enumerate();
        values.filter_map(|(tube, list)| list.get(i).map(|value| (tube, *value))).collect()
    };
    let sample = |i: usize| -> Result<TubesSample, ReadError> {
        let rotation = rotation(&format!("tubes.{name}.rotation[{i}]"), tubes.rotation[i])?;
        Ok(TubesSample {
            s: tubes.s[i],
            pose: Pose::new(rotation, tubes.position[i].into()),
            wrench: Wrench::new(tubes.force[i].into(), tubes.moment[i].into()),
            curvature: tubes.curvature[i].into(),
            angles: there(&tubes.angles, i),
            torques: there(&tubes.torques, i),
        })
    };
    Ok(TubesSolution { samples: (0..count).map(sample).collect::<Result<_, _>>()? })
}

fn joint_solution(name: &str, joint: &JointDocument, kind: JointKind) -> Result<JointSolution, ReadError> {
    if joint.coordinates.len() != joint.efforts.len() {
        return Err(ReadError::Broken(format!("joints.{name} has not as many efforts as coordinates")));
    }
    if joint.coordinates.len() != kind.freedoms() {
        return Err(ReadError::OtherMechanism(format!(
            "its joint `{name}` has {} coordinates, that of the model file has {}",
            joint.coordinates.len(),
            kind.freedoms()
        )));
    }
    Ok(JointSolution {
        coordinates: joint.coordinates.clone(),
        efforts: joint.efforts.clone(),
        wrench: Wrench::new(joint.force.into(), joint.moment.into()),
        contact: joint.contact.map(|contact| contact.solution()),
    })
}

fn end_point(solution: &Solution, end: &Attachment) -> Vector3<f64> {
    let pose = match end.mount {
        Mount::Ground => None,
        Mount::Body(id) => solution.bodies.get(id.0).copied(),
        Mount::Beam(place) => solution.beams.get(place.beam.0).and_then(|beam| {
            let s = place.at.arc_length(beam.length);
            let distance = |sample: &BeamSample| (sample.s - s).abs();
            let nearest = beam.samples.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            Some(nearest.pose)
        }),
    };
    pose.map_or(end.point, |pose| pose.point(&end.point))
}
