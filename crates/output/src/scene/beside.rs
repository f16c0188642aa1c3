//! Scenes of other states of a study, where a parameter changes the mechanism and not only its loads.

use super::{BeamScene, PlaceDocument, SceneDocument, scene};
use crate::OutputError;
use crate::thin::round;
use flexura_model::Model;
use flexura_solution::Solution;

/// Places of rest shapes that differ by less than this part of the beam's length are the same.
const SAME: f64 = 1e-9;

/// The scene of another state, rounded for pictures; None where it is drawn as `first` is, but for the loads at hand.
///
/// # Errors
/// As [`scene`].
pub fn scene_beside(
    first: &SceneDocument,
    model: &Model,
    solution: &Solution,
) -> Result<Option<SceneDocument>, OutputError> {
    let mut own = scene(model, solution)?;
    if is_same(first, &own) {
        return Ok(None);
    }
    // What the whole study has in common is said once.
    own.units = Default::default();
    for (_, beam) in &mut own.beams.0 {
        beam.s.iter_mut().for_each(round);
        beam.position.iter_mut().flatten().for_each(round);
        beam.rotation.iter_mut().flatten().for_each(round);
    }
    Ok(Some(own))
}

fn is_same(first: &SceneDocument, other: &SceneDocument) -> bool {
    let beams = first.beams.0.iter().zip(&other.beams.0);
    first.beams.0.len() == other.beams.0.len()
        && beams.into_iter().all(|((_, a), (_, b))| is_same_beam(a, b))
        && first.gravity == other.gravity
        && first.bodies == other.bodies
        && first.joints == other.joints
        && first.springs == other.springs
        && first.cables == other.cables
        && first.tubes == other.tubes
        && first.masses == other.masses
        && loads_aside(first) == loads_aside(other)
}

/// Where loads act, without how large they are.
fn loads_aside(scene: &SceneDocument) -> Vec<(&PlaceDocument, &str)> {
    scene.loads.0.iter().map(|(_, load)| (&load.place, load.frame.as_str())).collect()
}

/// Rest shapes may be sampled at other places; those that both have are compared.
fn is_same_beam(a: &BeamScene, b: &BeamScene) -> bool {
    let (Some(length), Some(other)) = (a.s.last(), b.s.last()) else { return a.s.len() == b.s.len() };
    let near = SAME * length;
    let mut places = b.s.iter().zip(&b.position).peekable();
    let is_rest_same = (length - other).abs() <= near
        && a.s.iter().zip(&a.position).all(|(s, p)| {
            while places.next_if(|(t, _)| **t < s - near).is_some() {}
            let same = places.peek().filter(|(t, _)| (**t - s).abs() <= near);
            same.is_none_or(|(_, q)| (0..3).all(|k| (p[k] - q[k]).abs() <= near))
        });
    let bare = |beam: &BeamScene| BeamScene {
        s: Vec::new(),
        position: Vec::new(),
        rotation: Vec::new(),
        ..beam.clone()
    };
    is_rest_same && bare(a) == bare(b)
}
