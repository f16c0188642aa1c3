//! From a trace, and from buckling, to the result document.

use super::wire::{
    BranchDocument, BucklingDocument, CriticalDocument, ModeDocument, MotionDocument, MotionsDocument,
    PointDocument, ShapeDocument, TraceDocument, TraceWorkDocument,
};
use super::{TraceView, parameter_of};
use crate::document::{
    all_finite, error_estimate, finite, output_reasons, outputs, parameters, reasons_by_name, residual,
    state_document, work,
};
use crate::scene::{SceneDocument, loads, scene, scene_beside};
use crate::thin::shape_of;
use crate::wire::Value;
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_post::{Evaluation, evaluate_each};
use flexura_solution::{
    Branch, BranchEnd, BranchOrigin, Buckling, CriticalCurve, Direction, PointKind, Solution, Status,
    TracePoint,
};

/// The result document of a trace.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn trace_document(view: &TraceView<'_>) -> Result<TraceDocument, OutputError> {
    let trace = view.trace;
    let first = First::of(view)?;
    let first = first.as_ref();
    let branches = trace.branches.iter().enumerate();
    let branches =
        branches.map(|(i, branch)| branch_document(view, first, i, branch)).collect::<Result<_, _>>()?;
    let critical = trace.critical.as_ref().map(|curve| critical_document(view, first, curve)).transpose()?;
    let counted = trace.work;
    Ok(TraceDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: view.model.name.clone(),
        study: "trace".to_owned(),
        status: trace.status.word().to_owned(),
        reason: trace.reason.clone(),
        warnings: trace.warnings.clone(),
        parameter: view.parameter().0.to_owned(),
        range: all_finite(trace.range, || "range".into())?,
        parameters: parameters(view.model)?,
        stability_reason: trace.stability_reason.clone(),
        branches,
        critical,
        work: TraceWorkDocument {
            points: counted.points,
            refused: counted.refused,
            newton_steps: counted.newton_steps,
            factorisations: counted.factorisations,
            residuals: counted.residuals,
            inertias: counted.inertias,
        },
        scene: first.map(|first| first.scene.clone()),
    })
}

/// The first state that is kept: what is drawn of others is told beside it.
struct First<'v> {
    model: &'v Model,
    scene: SceneDocument,
}

impl<'v> First<'v> {
    fn of(view: &'v TraceView<'_>) -> Result<Option<Self>, OutputError> {
        let Some((model, solution)) = first_state(view) else { return Ok(None) };
        Ok(Some(Self { model, scene: scene(model, solution)? }))
    }
}

/// The first state that is kept, with its model.
fn first_state<'v>(view: &'v TraceView<'_>) -> Option<(&'v Model, &'v Solution)> {
    let branches = view.trace.branches.iter().enumerate();
    let mut states = branches.flat_map(|(b, branch)| {
        let points = branch.points.iter().enumerate();
        points.filter_map(move |(p, point)| Some((view.model_at(b, p), point.solution.as_deref()?)))
    });
    states.next()
}

fn branch_document(
    view: &TraceView<'_>,
    first: Option<&First<'_>>,
    number: usize,
    branch: &Branch,
) -> Result<BranchDocument, OutputError> {
    let (from_branch, from_point) = match branch.origin {
        BranchOrigin::Switched { branch, point } => (Some(branch), Some(point)),
        _ => (None, None),
    };
    let points = branch.points.iter().enumerate().map(|(i, point)| {
        let path = format!("branches[{number}].points[{i}]");
        point_document(view, first, &path, point, view.model_at(number, i))
    });
    Ok(BranchDocument {
        origin: branch.origin.word(),
        from_branch,
        from_point,
        ends: ends(&branch.ends),
        end_reasons: end_reasons(&branch.ends),
        points: points.collect::<Result<_, _>>()?,
    })
}

fn critical_document(
    view: &TraceView<'_>,
    first: Option<&First<'_>>,
    curve: &CriticalCurve,
) -> Result<CriticalDocument, OutputError> {
    let points = curve.points.iter().enumerate().map(|(i, (value, point))| {
        let path = format!("critical.points[{i}]");
        let mut document = point_document(view, first, &path, point, view.critical_model(i))?;
        document.second_parameter = Some(finite(*value, || format!("{path}.second_parameter"))?);
        Ok::<_, OutputError>(document)
    });
    Ok(CriticalDocument {
        parameter: parameter_of(view.model, Some(curve.parameter)).0.to_owned(),
        kind: curve.kind.word(),
        crossing: curve.kind.crossing().map(|crossing| crossing.word()),
        ends: ends(&curve.ends),
        end_reasons: end_reasons(&curve.ends),
        points: points.collect::<Result<_, _>>()?,
    })
}

fn ends(ends: &[BranchEnd; 2]) -> [&'static str; 2] {
    [ends[0].word(), ends[1].word()]
}

fn end_reasons(ends: &[BranchEnd; 2]) -> [Option<String>; 2] {
    [0, 1].map(|i| ends[i].reason().map(str::to_owned))
}

fn point_document(
    view: &TraceView<'_>,
    first: Option<&First<'_>>,
    path: &str,
    point: &TracePoint,
    model: &Model,
) -> Result<PointDocument, OutputError> {
    let within = |error| inside(path, error);
    let estimated = view.trace.status == Status::Converged || point.error_estimate.is_finite();
    let state = point
        .solution
        .as_ref()
        .map(|solution| state_document(model, solution, &evaluate_each(model, solution)));
    let shape = point.shape.as_ref().map(|shape| shape_of(model, shape));
    let shown = point.solution.as_deref().or(point.shape.as_deref());
    let (scene, loads) = match (first, shown) {
        (Some(first), Some(shown)) => match scene_beside(&first.scene, model, shown).map_err(within)? {
            Some(scene) => (Some(scene), Named::default()),
            None => (None, loads(first.model, model).map_err(within)?),
        },
        _ => (None, Named::default()),
    };
    let directions = point.directions.iter().map(|direction| shape_document(model, direction));
    Ok(PointDocument {
        second_parameter: None,
        parameter: finite(point.parameter, || format!("{path}.parameter"))?,
        arc: finite(point.arc, || format!("{path}.arc"))?,
        kind: point.kind.word(),
        crossing: point.kind.crossing().map(|crossing| crossing.word()),
        event: match point.kind {
            PointKind::Event(position) => view.event(position).map(str::to_owned),
            _ => None,
        },
        outputs: point_outputs(view, path, point)?,
        output_reasons: reasons_by_name(view.model, point.output_reasons.iter()),
        stable: point.stable,
        unstable_directions: point.unstable_directions,
        error_estimate: estimated
            .then(|| finite(point.error_estimate, || format!("{path}.error_estimate")))
            .transpose()?,
        state: state.transpose().map_err(within)?,
        shape: shape.transpose().map_err(within)?,
        scene,
        loads,
        directions: directions.collect::<Result<_, _>>().map_err(within)?,
    })
}

fn point_outputs(
    view: &TraceView<'_>,
    path: &str,
    point: &TracePoint,
) -> Result<Named<Option<Value>>, OutputError> {
    Named::collect(view.model.outputs.iter().zip(&point.outputs), |(output, values)| {
        let field = || format!("{path}.outputs.{}", output.name);
        let value = match values.as_deref() {
            Some([x, y, z]) => Some(Value::Vector(all_finite([*x, *y, *z], field)?)),
            Some([number, ..]) => Some(Value::Number(finite(*number, field)?)),
            _ => None,
        };
        Ok((output.name.clone(), value))
    })
}

pub(crate) fn shape_document(model: &Model, direction: &Direction) -> Result<ShapeDocument, OutputError> {
    let beams = model.beams.iter().zip(&direction.beams);
    let bodies = model.bodies.iter().zip(&direction.bodies);
    Ok(ShapeDocument {
        beams: Named::collect(beams, |(beam, twists)| {
            let field = |part: &str| format!("beams.{}.{part}", beam.name);
            let list = |part: &str, vectors: Vec<[f64; 3]>| -> Result<Vec<[f64; 3]>, OutputError> {
                vectors.into_iter().map(|vector| all_finite(vector, || field(part))).collect()
            };
            let motions = MotionsDocument {
                displacement: list("displacement", twists.iter().map(|twist| twist.linear.into()).collect())?,
                turning: list("turning", twists.iter().map(|twist| twist.angular.into()).collect())?,
            };
            Ok((beam.name.clone(), motions))
        })?,
        bodies: Named::collect(bodies, |(body, twist)| {
            let field = |part: &str| format!("bodies.{}.{part}", body.name);
            let motion = MotionDocument {
                displacement: all_finite(twist.linear.into(), || field("displacement"))?,
                turning: all_finite(twist.angular.into(), || field("turning"))?,
            };
            Ok((body.name.clone(), motion))
        })?,
    })
}

/// The result document of buckling; `model` has the parameter's value at the equilibrium.
///
/// # Errors
/// As [`trace_document`].
pub fn buckling_document(
    model: &Model,
    buckling: &Buckling,
    evaluation: &Evaluation,
) -> Result<BucklingDocument, OutputError> {
    let solution = &buckling.solution;
    let modes = buckling.modes.iter().enumerate().map(|(i, mode)| {
        let path = format!("modes[{i}]");
        Ok(ModeDocument {
            value: finite(mode.value, || format!("{path}.value"))?,
            error_estimate: finite(mode.error_estimate, || format!("{path}.error_estimate"))?,
            shape: shape_document(model, &mode.direction).map_err(|error| inside(&path, error))?,
        })
    });
    Ok(BucklingDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "buckle".to_owned(),
        status: solution.status.word().to_owned(),
        reason: solution.reason.clone(),
        warnings: solution.warnings.clone(),
        parameter: buckling.parameter.map(|position| parameter_of(model, Some(position)).0.to_owned()),
        at: finite(buckling.at, || "at".into())?,
        modes: modes.collect::<Result<_, OutputError>>()?,
        residual: residual(solution)?,
        error_estimate: error_estimate(solution)?,
        parameters: parameters(model)?,
        outputs: outputs(model, evaluation)?,
        output_reasons: output_reasons(evaluation),
        state: state_document(model, solution, evaluation)?,
        stable: solution.stable,
        unstable_directions: solution.unstable_directions,
        stability_reason: solution.stability_reason.clone(),
        work: work(&solution.work),
        scene: scene(model, solution)?,
    })
}

/// The same error with the path to the part of the document that it is in.
pub(crate) fn inside(path: &str, error: OutputError) -> OutputError {
    match error {
        OutputError::NotFinite { field, value } => {
            OutputError::NotFinite { field: format!("{path}.{field}"), value }
        }
        other => other,
    }
}
