//! From an optimisation to its document.

use super::DesignView;
use super::wire::{
    ConditionDocument, DesignDocument, DesignWorkDocument, MultiplierDocument, OptimisationDocument,
    OptimisationHead, RefusedDesignDocument, SearchDocument, StepDocument,
};
use crate::document::{document, finite, parameters};
use crate::{Named, OutputError};
use flexura_model::{Condition, Model, OptimiseStudy, Where};
use flexura_solution::{Bound, Design};

/// The result document of an optimisation.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn optimisation_document(view: &DesignView<'_>) -> Result<OptimisationDocument, OutputError> {
    let (study, result) = (view.study, view.result);
    let optimum = result.best.as_ref().map(|best| design(view, best, "optimum")).transpose()?;
    let starts = result.starts.iter().enumerate().map(|(i, start)| {
        let path = format!("starts[{i}]");
        let history = start.history.iter().enumerate().map(|(k, step)| {
            let path = format!("{path}.history[{k}]");
            Ok(StepDocument {
                parameters: values(view, &step.values, &path)?,
                objective: finite(step.objective, || format!("{path}.objective"))?,
                violation: finite(step.violation, || format!("{path}.violation"))?,
            })
        });
        Ok(SearchDocument {
            from: values(view, &start.from, &path)?,
            status: start.status.word().to_owned(),
            reason: start.reason.clone(),
            end: start.design.as_ref().map(|end| design(view, end, &format!("{path}.end"))).transpose()?,
            history: history.collect::<Result<_, OutputError>>()?,
        })
    });
    let front = result.front.iter().enumerate().map(|(i, point)| design(view, point, &format!("front[{i}]")));
    let left_out = result.left_out.iter().enumerate().map(|(i, left)| {
        let parameters = values(view, &left.values, &format!("left_out[{i}]"))?;
        Ok(RefusedDesignDocument { parameters, reason: left.reason.clone() })
    });
    let work = result.work;
    Ok(OptimisationDocument {
        head: head(view)?,
        method: study.method.word(),
        goal: if study.maximise { "maximise" } else { "minimise" },
        objective: study.objective.output.name.clone(),
        optimum,
        starts: starts.collect::<Result<_, OutputError>>()?,
        front: front.collect::<Result<_, _>>()?,
        left_out: left_out.collect::<Result<_, OutputError>>()?,
        left_out_count: result.left_out_count,
        search_work: DesignWorkDocument {
            iterations: work.iterations,
            evaluations: work.evaluations,
            gradients: work.gradients,
            paths: work.paths,
        },
    })
}

fn head(view: &DesignView<'_>) -> Result<OptimisationHead, OutputError> {
    let (model, result) = (view.model, view.result);
    let (status, reason) = (result.status.word().to_owned(), result.reason.clone());
    let (Some(solution), Some(evaluation)) = (&result.solution, view.evaluation) else {
        return Ok(OptimisationHead::Empty {
            flexura: env!("CARGO_PKG_VERSION").to_owned(),
            model: model.name.clone(),
            study: "optimise",
            status,
            reason,
            warnings: result.warnings.clone(),
            parameters: parameters(model)?,
        });
    };
    let mut state = document(model, solution, evaluation)?;
    state.study = "optimise".to_owned();
    state.status = status;
    state.reason = reason;
    state.warnings.splice(0..0, result.warnings.iter().cloned());
    Ok(OptimisationHead::Solved(Box::new(state)))
}

fn values(view: &DesignView<'_>, values: &[f64], path: &str) -> Result<Named<f64>, OutputError> {
    Named::collect(view.study.vary.iter().zip(values), |(varied, value)| {
        let name = &view.model.parameters[varied.parameter].name;
        Ok((name.clone(), finite(*value, || format!("{path}.parameters.{name}"))?))
    })
}

fn design(view: &DesignView<'_>, found: &Design, path: &str) -> Result<DesignDocument, OutputError> {
    let at = |field: &str| format!("{path}.{field}");
    let multipliers = found.active.iter().map(|active| {
        let bound = bound_name(view.model, view.study, active.what);
        let rate = finite(active.rate, || at(&format!("multipliers.{bound}")))?;
        Ok(MultiplierDocument { bound, rate })
    });
    let conditions = view.study.conditions.iter().zip(&found.conditions);
    Ok(DesignDocument {
        parameters: values(view, &found.values, path)?,
        objective: finite(found.objective, || at("objective"))?,
        other: found.other.map(|other| finite(other, || at("other"))).transpose()?,
        active: found.active.iter().map(|a| bound_name(view.model, view.study, a.what)).collect(),
        multipliers: multipliers.collect::<Result<_, OutputError>>()?,
        constraints: conditions
            .map(|(condition, value)| {
                let value = finite(*value, || at(&format!("constraints.{}", condition.reading.output.name)))?;
                Ok(condition_document(condition, value))
            })
            .collect::<Result<_, OutputError>>()?,
        violation: finite(found.violation, || at("violation"))?,
        stationarity: finite(found.stationarity, || at("stationarity"))?,
        stable: found.stable,
    })
}

fn condition_document(condition: &Condition, value: f64) -> ConditionDocument {
    let (over, point) = match &condition.reading.at {
        Where::Equilibrium => (None, None),
        Where::Path { study, point, .. } => (Some(study.clone()), Some(point.text())),
    };
    ConditionDocument {
        output: condition.reading.output.name.clone(),
        over,
        point,
        value,
        least: condition.least,
        most: condition.most,
        equals: condition.equals,
    }
}

/// What a bound is called: `thickness.lower`, `beam.link.max_stress.most`.
pub fn bound_name(model: &Model, study: &OptimiseStudy, bound: Bound) -> String {
    let varied = |i: usize, end: &str| {
        let position = study.vary.get(i).map_or(usize::MAX, |varied| varied.parameter);
        let name = model.parameters.get(position).map_or("", |parameter| parameter.name.as_str());
        format!("{name}.{end}")
    };
    let condition = |i: usize, end: &str| {
        let name = study.conditions.get(i).map_or("", |condition| condition.reading.output.name.as_str());
        format!("{name}.{end}")
    };
    match bound {
        Bound::Lower(i) => varied(i, "lower"),
        Bound::Upper(i) => varied(i, "upper"),
        Bound::Least(i) => condition(i, "least"),
        Bound::Most(i) => condition(i, "most"),
        Bound::Equals(i) => condition(i, "equals"),
        Bound::Other => "pareto".to_owned(),
    }
}
