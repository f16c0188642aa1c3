//! Shapes for pictures: states whose numbers keep as many digits as a picture can show.

use crate::OutputError;
use crate::document::state_document;
use crate::wire::{BeamDocument, CableDocument, JointDocument, SpringDocument, StateDocument, TubesDocument};
use flexura_model::Model;
use flexura_post::evaluate_each;
use flexura_solution::Solution;

/// A state for pictures.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn shape_of(model: &Model, solution: &Solution) -> Result<StateDocument, OutputError> {
    state_document(model, solution, &evaluate_each(model, solution)).map(rounded)
}

/// Digits that are kept of every number.
const DIGITS: usize = 7;

/// The state with rounded numbers, which makes its text about half as long.
fn rounded(mut state: StateDocument) -> StateDocument {
    state.beams.0.iter_mut().for_each(|(_, beam)| of_beam(beam));
    for (_, body) in &mut state.bodies.0 {
        body.position.iter_mut().chain(&mut body.rotation).for_each(round);
    }
    state.joints.0.iter_mut().for_each(|(_, joint)| of_joint(joint));
    state.springs.0.iter_mut().for_each(|(_, spring)| of_spring(spring));
    state.cables.0.iter_mut().for_each(|(_, cable)| of_cable(cable));
    state.tubes.0.iter_mut().for_each(|(_, tubes)| of_tubes(tubes));
    state.couplings.0.iter_mut().for_each(|(_, coupling)| round(&mut coupling.multiplier));
    round(&mut state.energy);
    state
}

fn of_beam(beam: &mut BeamDocument) {
    let vectors = [&mut beam.position, &mut beam.force, &mut beam.moment, &mut beam.curvature];
    vectors.into_iter().for_each(|list| of_list(list));
    beam.rotation.iter_mut().flatten().for_each(round);
    beam.s.iter_mut().chain(&mut beam.stretch).for_each(round);
    beam.stress.iter_mut().chain(&mut beam.strain).flatten().for_each(round);
    beam.foundation.iter_mut().for_each(|list| of_list(list));
    beam.foundation_force.iter_mut().flatten().for_each(round);
}

fn of_joint(joint: &mut JointDocument) {
    joint.coordinates.iter_mut().chain(&mut joint.efforts).for_each(round);
    joint.force.iter_mut().chain(&mut joint.moment).for_each(round);
}

fn of_spring(spring: &mut SpringDocument) {
    [&mut spring.length, &mut spring.tension].into_iter().for_each(round);
    spring.strain.iter_mut().chain(&mut spring.stress).for_each(round);
    of_list(&mut spring.course);
}

fn of_cable(cable: &mut CableDocument) {
    [&mut cable.length, &mut cable.tension].into_iter().for_each(round);
    of_list(&mut cable.course);
}

fn of_tubes(tubes: &mut TubesDocument) {
    let vectors = [&mut tubes.position, &mut tubes.force, &mut tubes.moment, &mut tubes.curvature];
    vectors.into_iter().for_each(|list| of_list(list));
    tubes.rotation.iter_mut().flatten().for_each(round);
    tubes.s.iter_mut().for_each(round);
    tubes.angles.iter_mut().chain(&mut tubes.torques).flatten().for_each(round);
}

fn of_list(list: &mut [[f64; 3]]) {
    list.iter_mut().flatten().for_each(round);
}

/// To so many digits, by way of the text, so that the shortest text of the result is as short.
pub(crate) fn round(value: &mut f64) {
    if let Ok(short) = format!("{value:.*e}", DIGITS - 1).parse() {
        *value = short;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_seven_digits_whatever_their_size() {
        for (given, wanted) in [
            (2.345678901, 2.345679),
            (-2.345678901e-20, -2.345679e-20),
            (123456789.0, 123456800.0),
            (0.0, 0.0),
            (1.0, 1.0),
        ] {
            let mut value: f64 = given;
            round(&mut value);
            assert_eq!(value, wanted);
        }
    }
}
