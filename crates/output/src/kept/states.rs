//! Single states: of a solve, and of buckling with its modes.

use super::{Make, list, model_of, number, text, vector};
use crate::read::{ReadError, solution_of, status_of};
use crate::scene::{BeamScene, SceneDocument};
use crate::wire::Document;
use crate::{modes_svg, shape_svg, vibration_svg};
use flexura_model::Model;
use flexura_solution::{Buckling, BucklingMode, Direction, Mode, ModeKind, Modes, Solution, Status};
use flexura_spatial::{Pose, Quaternion, Twist, UnitQuaternion, Vector3};
use serde_json::{Map, Value};

/// What a state has in every document.
const STATE: [&str; 9] =
    ["beams", "bodies", "joints", "springs", "couplings", "cables", "tubes", "energy", "stability_reason"];

pub fn solve(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let model = model_of(document, &[], make)?;
    let mut solution = solution(document, scene_of(document)?, &model)?;
    solution.status = status_of(text(document, "status"))?;
    solution.load_fraction = document.get("load_fraction").and_then(Value::as_f64).unwrap_or(1.0);
    Ok(vec![shape_svg(&model, &solution)])
}

pub fn buckle(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let model = model_of(document, &[], make)?;
    let mut solution = solution(document, scene_of(document)?, &model)?;
    solution.status = status_of(text(document, "status"))?;
    let modes = list(document, "modes").iter().map(|mode| BucklingMode {
        value: number(mode, "value"),
        error_estimate: number(mode, "error_estimate"),
        direction: direction(&mode["shape"], &model),
    });
    let name = document.get("parameter").and_then(Value::as_str);
    let parameter = name.and_then(|name| model.parameters.iter().position(|own| own.name == name));
    let buckling = Buckling { parameter, at: number(document, "at"), modes: modes.collect(), solution };
    Ok(vec![modes_svg(&model, &buckling)])
}

pub fn modes(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let model = model_of(document, &[], make)?;
    let mut solution = solution(document, scene_of(document)?, &model)?;
    solution.status = status_of(text(document, "status"))?;
    let kinds =
        [ModeKind::Rigid, ModeKind::Diverging, ModeKind::Flutter, ModeKind::Decaying, ModeKind::Creeping];
    let modes = list(document, "modes").iter().map(|mode| Mode {
        growth: number(mode, "growth"),
        rate: number(mode, "rate"),
        kind: kinds.into_iter().find(|kind| kind.word() == text(mode, "kind")).unwrap_or(ModeKind::Swinging),
        error_estimate: number(mode, "error_estimate"),
        damping_ratio: mode.get("damping_ratio").and_then(Value::as_f64),
        generalised_mass: number(mode, "generalised_mass"),
        shares: None,
        direction: direction(&mode["shape"], &model),
        quadrature: None,
        nodes: Vec::new(),
    });
    let modes = Modes {
        modes: modes.collect(),
        solution,
        at_rest: document.get("at_rest").and_then(Value::as_bool).unwrap_or(false),
        mass: [0.0; 3],
        inertia: [0.0; 3],
        elements: [0; 2],
    };
    Ok(vec![vibration_svg(&model, &modes)])
}

/// The scene that a document or a point of one holds.
pub fn scene_of(value: &Value) -> Result<SceneDocument, ReadError> {
    let scene = value.get("scene").cloned().unwrap_or_default();
    if scene.is_null() {
        return Ok(SceneDocument::default());
    }
    serde_json::from_value(scene).map_err(|error| ReadError::Broken(format!("scene: {error}")))
}

/// The state that stands in a document, a point of a path or a shape.
pub fn solution(state: &Value, scene: SceneDocument, model: &Model) -> Result<Solution, ReadError> {
    let mut whole = Map::new();
    for key in STATE {
        if let Some(value) = state.get(key) {
            whole.insert(key.to_owned(), value.clone());
        }
    }
    for (key, value) in
        [("flexura", ""), ("model", ""), ("study", "solve"), ("status", Status::Converged.word())]
    {
        whole.insert(key.to_owned(), value.into());
    }
    whole.insert("newton_steps".to_owned(), 0.into());
    let document: Document =
        serde_json::from_value(Value::Object(whole)).map_err(|error| ReadError::Broken(error.to_string()))?;
    let mut solution = solution_of(&document, model)?;
    for (beam, described) in solution.beams.iter_mut().zip(&model.beams) {
        let Some(rest) = scene.beams.get(&described.name) else { continue };
        for sample in &mut beam.samples {
            sample.rest_pose = rest_pose(rest, sample.s).unwrap_or(sample.rest_pose);
        }
    }
    Ok(solution)
}

/// Where a beam lies at rest, by a cubic between two places of its rest shape.
fn rest_pose(beam: &BeamScene, s: f64) -> Option<Pose> {
    let at = |i: usize| -> Option<(f64, Pose)> {
        let [w, x, y, z] = *beam.rotation.get(i)?;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        Some((*beam.s.get(i)?, Pose::new(rotation, Vector3::from(*beam.position.get(i)?))))
    };
    let next = beam.s.partition_point(|known| *known < s).min(beam.s.len().checked_sub(1)?);
    let ((a, before), (b, after)) = (at(next.saturating_sub(1))?, at(next)?);
    let width = b - a;
    if width.is_nan() || width <= 0.0 {
        return Some(after);
    }
    let t = ((s - a) / width).clamp(0.0, 1.0);
    let along = |pose: &Pose| pose.rotation * Vector3::x() * width;
    let (squared, cubed) = (t * t, t * t * t);
    let position = before.position * (2.0 * cubed - 3.0 * squared + 1.0)
        + along(&before) * (cubed - 2.0 * squared + t)
        + after.position * (3.0 * squared - 2.0 * cubed)
        + along(&after) * (cubed - squared);
    Some(Pose::new(before.rotation.slerp(&after.rotation, t), position))
}

/// A small motion.
pub fn direction(shape: &Value, model: &Model) -> Direction {
    let twist = |displacement: &Value, turning: &Value| {
        let of = |value: &Value| Vector3::from(vector(value).unwrap_or_default());
        Twist { angular: of(turning), linear: of(displacement) }
    };
    let beams = model.beams.iter().map(|beam| {
        let own = &shape["beams"][beam.name.as_str()];
        list(own, "displacement").iter().zip(list(own, "turning")).map(|(d, t)| twist(d, t)).collect()
    });
    let bodies = model.bodies.iter().map(|body| {
        let own = &shape["bodies"][body.name.as_str()];
        twist(&own["displacement"], &own["turning"])
    });
    Direction { beams: beams.collect(), bodies: bodies.collect() }
}
