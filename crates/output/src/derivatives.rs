//! Compliances and sensitivities of the result document.

use crate::document::{all_finite, finite};
use crate::wire::{Elasticity, Value};
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_post::{Dependence, Evaluation, dependences, place_name};
use flexura_solution::Solution;

/// The compliances of a solution by place.
pub(crate) fn compliances(model: &Model, solution: &Solution) -> Result<Named<[[f64; 6]; 6]>, OutputError> {
    let known =
        solution.tangents.iter().filter_map(|tangent| Some((tangent.target, tangent.compliance.as_ref()?)));
    Named::collect(known, |(target, matrix)| {
        let place = place_name(model, &target);
        let mut rows = [[0.0; 6]; 6];
        for (i, row) in rows.iter_mut().enumerate() {
            *row =
                all_finite(std::array::from_fn(|j| matrix[(i, j)]), || format!("compliance.{place}[{i}]"))?;
        }
        Ok((place, rows))
    })
}

/// The motions under growing loads of a solution by place, shift first.
pub(crate) fn motions(model: &Model, solution: &Solution) -> Result<Named<[f64; 6]>, OutputError> {
    Named::collect(solution.tangents.iter(), |tangent| {
        let place = place_name(model, &tangent.target);
        let (shift, turn) = (tangent.motion.linear, tangent.motion.angular);
        let motion = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
        let motion = all_finite(motion, || format!("motion.{place}"))?;
        Ok((place, motion))
    })
}

pub(crate) fn sensitivities(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<Option<Named<Named<Value>>>, OutputError> {
    by_output(model, solution, evaluation, |dependence| {
        let path = || format!("sensitivities.{}.{}", dependence.output, dependence.parameter);
        Ok(Some(match dependence.derivative[..] {
            [x, y, z] => Value::Vector(all_finite([x, y, z], path)?),
            _ => Value::Number(finite(dependence.derivative.first().copied().unwrap_or(f64::NAN), path)?),
        }))
    })
}

pub(crate) fn elasticities(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<Option<Named<Named<Elasticity>>>, OutputError> {
    by_output(model, solution, evaluation, |dependence| {
        // Two small numbers may have a quotient that is none.
        let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
        Ok(match dependence.elasticity[..] {
            [None, None, None] => None,
            [x, y, z] => Some(Elasticity::Vector([x, y, z].map(finite))),
            _ => finite(dependence.elasticity.first().copied().flatten()).map(Elasticity::Number),
        })
    })
}

/// A table of outputs by parameters; `value` may leave entries out.
fn by_output<T>(
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
    value: impl Fn(&Dependence) -> Result<Option<T>, OutputError>,
) -> Result<Option<Named<Named<T>>>, OutputError> {
    if solution.sensitivities.is_none() {
        return Ok(None);
    }
    let outputs = evaluation.outputs.iter().map(|output| output.name.clone());
    let found = model.unknowns.iter().map(|u| format!("parameter.{}", model.parameters[u.parameter].name));
    let mut table: Vec<(String, Named<T>)> =
        outputs.chain(found).map(|name| (name, Named::default())).collect();
    for dependence in dependences(model, solution, evaluation) {
        let row = table.iter_mut().find(|(name, _)| *name == dependence.output);
        if let (Some((_, row)), Some(value)) = (row, value(&dependence)?) {
            row.0.push((dependence.parameter.clone(), value));
        }
    }
    Ok(Some(Named(table)))
}
