//! Springs between nodes: laws at their size, rest lengths, and what they run over.

use super::attachments::{distance, place};
use super::{Carrier, Link, Lowered, Wrapping, length_text};
use crate::error::ProblemError;
use crate::scale::Scale;
use flexura_mechanics::spring::{MonotoneTable, Obstacle, PathError, TensionLaw};
use flexura_model::{Attachment, ExponentialForm, Model, Mount, Spring, SpringLaw, Wrap};

/// A rest length closer to the initial length than this part of it is the same.
const SAME_LENGTH: f64 = 1e-9;

pub(super) fn lower_spring(lowered: &mut Lowered, spring: &Spring) -> Result<(), ProblemError> {
    let link = link(lowered, spring)?;
    if let SpringLaw::Exponential { area, stress, form: ExponentialForm::Printed, .. } = spring.law {
        lowered.warnings.push(format!(
            "spring.{}: the printed law jumps from nothing to {:.4} N where the spring becomes taut; there is no equilibrium in \
             between, and form = \"continuous\" has no jump",
            spring.name,
            area * stress * spring.size.powi(2),
        ));
    }
    lowered.springs.push(link);
    Ok(())
}

/// A spring between nodes that are there.
pub(crate) fn link(lowered: &Lowered, spring: &Spring) -> Result<Link, ProblemError> {
    let scale = lowered.scale;
    let path = format!("spring.{}", spring.name);
    let ends = [place(lowered, &spring.from), place(lowered, &spring.to)];
    let straight = distance(lowered, &ends);
    if straight < 1e-12 {
        return Err(ProblemError::new(
            path,
            "has length zero: its two ends coincide, so it has no direction",
            "move `from` or `to`",
        ));
    }
    let wrap = spring.wrap.as_ref().map(|wrap| lower_wrap(lowered, wrap));
    let initial_length = match &wrap {
        None => straight,
        Some(wrap) => {
            let poses = ends.map(|(node, _)| lowered.initial(node));
            let [a, b] = wrap.local(&lowered.initial(wrap.carrier.node), &poses, &ends);
            match wrap.obstacle.around(&a, &b) {
                Ok(around) => around.map_or(straight, |around| around.length),
                Err(error) => return Err(no_path(&path, &error, wrap.obstacle.radius(), &scale)),
            }
        }
    };
    let law = law_of(&spring.law, spring.size, &scale);
    let relaxed = match &law {
        TensionLaw::Table(table) => table.relaxed().ok_or_else(|| {
            ProblemError::new(
                format!("{path}.rows"),
                "the force of the table vanishes nowhere, so that the spring has no state of rest",
                "begin the table with a row without force",
            )
        })?,
        _ => 0.0,
    };
    let wanted = spring.rest_length.map_or(initial_length, |l| l * spring.size / scale.length);
    let is_loose = wanted > initial_length * (1.0 + SAME_LENGTH);
    Ok(Link { ends, law, rest_length: [initial_length - relaxed, wanted], is_loose, wrap })
}

fn no_path(path: &str, error: &PathError, radius: f64, scale: &Scale) -> ProblemError {
    match error {
        PathError::Inside { end, distance } => {
            let word = ["from", "to"][*end];
            ProblemError::new(
                format!("{path}.{word}"),
                format!(
                    "lies inside what the spring runs over: {} from its middle, whose radius is {}",
                    length_text(distance * scale.length),
                    length_text(radius * scale.length)
                ),
                "move the end, or make `wrap` smaller",
            )
        }
        PathError::Opposite => ProblemError::new(
            format!("{path}.wrap"),
            "its ends are on opposite sides of the sphere, so that every way around is as short",
            "move one end to the side on which it shall run",
        ),
    }
}

fn lower_wrap(lowered: &Lowered, wrap: &Wrap) -> Wrapping {
    let length = lowered.scale.length;
    let carrier =
        Carrier { node: lowered.node_of(wrap.frame.mount), frame: lowered.scale.pose_in(&wrap.frame.pose) };
    let obstacle = match wrap.obstacle {
        flexura_model::Obstacle::Sphere { radius } => Obstacle::Sphere { radius: radius / length },
        flexura_model::Obstacle::Cylinder { radius, axis, turn } => {
            Obstacle::Cylinder { radius: radius / length, axis, turn }
        }
    };
    Wrapping { carrier, obstacle }
}

/// The law at its size: areas and forces s² times, elongations s times; nondimensional.
fn law_of(law: &SpringLaw, size: f64, scale: &Scale) -> TensionLaw {
    let force = size * size / scale.force;
    let length = size / scale.length;
    match law {
        SpringLaw::Linear { stiffness, tension_only } => {
            TensionLaw::Linear { stiffness: stiffness * force / length, tension_only: *tension_only }
        }
        SpringLaw::Exponential { area, exponent, stress, form } => TensionLaw::Exponential {
            force: area * stress * force,
            exponent: *exponent,
            jump: if *form == ExponentialForm::Printed { 1.0 } else { 0.0 },
        },
        SpringLaw::Toe { axial_stiffness, toe_strain } => {
            TensionLaw::Toe { axial_stiffness: axial_stiffness * force, toe_strain: *toe_strain }
        }
        SpringLaw::Table { rows } => {
            let rows: Vec<[f64; 2]> = rows.iter().map(|[x, f]| [x * length, f * force]).collect();
            // Rows that do not rise were refused before; a band that does nothing stands for none.
            let nothing = TensionLaw::Linear { stiffness: 0.0, tension_only: false };
            MonotoneTable::new(&rows).map_or(nothing, |table| TensionLaw::Table(table.into()))
        }
    }
}

/// The greatest initial distance of a spring's ends in a model without beams, m.
pub(super) fn longest(model: &Model) -> f64 {
    let at = |end: &Attachment| match end.mount {
        Mount::Body(body) => model.bodies[body.0].pose.point(&end.point),
        Mount::Ground | Mount::Beam(_) => end.point,
    };
    let distance = |spring: &Spring| (at(&spring.to) - at(&spring.from)).norm();
    model.springs.iter().map(distance).fold(0.0, f64::max)
}

/// The force by which the springs of a model without beams say how large forces are in it, N: the stiffest, stretched by
/// its `length`.
pub(super) fn largest_force(model: &Model, length: f64) -> f64 {
    let force = |spring: &Spring| match &spring.law {
        SpringLaw::Linear { stiffness, .. } => stiffness * spring.size * length,
        SpringLaw::Exponential { area, exponent, stress, .. } => {
            area * stress * exponent * spring.size.powi(2)
        }
        SpringLaw::Toe { axial_stiffness, .. } => axial_stiffness * spring.size.powi(2),
        SpringLaw::Table { rows } => {
            rows.iter().map(|row| row[1].abs()).fold(0.0, f64::max) * spring.size.powi(2)
        }
    };
    model.springs.iter().map(force).fold(0.0, f64::max)
}
