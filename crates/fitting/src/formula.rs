//! Formulas that repeat an output over a trace or a grid.
//!
//! The sum of squared errors is least. Along a trace a point counts for the part of the range that it stands for (half the way to both
//! neighbours), so that the formula does not depend on where the path was looked at; on a grid all count alike.

use crate::conditions::Conditions;
use flexura_model::{FormulaPiece, FormulaQuantity, FormulaSource, FormulaStudy, Model, StudyKind};
use flexura_solution::{ResponseFormula, ResponsePiece, ResponsePoint, Status};
use flexura_spatial::singular_values;
use flexura_study::{Options, ProblemError, TraceProgress, check_study, trace};
use nalgebra::{DMatrix, DVector};

/// Singular values below this part of the largest tell terms apart no longer.
const RANK: f64 = 1e-12;
/// Values of the first variable within this part of its range are at a piece's end.
const NEAR: f64 = 1e-12;

/// Points before there is a formula.
struct Asked {
    points: Vec<ResponsePoint>,
    left_out: Vec<(String, String)>,
    status: Status,
    reason: Option<String>,
    warnings: Vec<String>,
}

/// Asks the model and fits the formula.
///
/// # Errors
/// The study or the model makes no sense; there are fewer points than terms, or terms that they do not tell apart.
pub fn formula(
    model: &Model,
    study: &FormulaStudy,
    options: &Options,
    progress: &mut dyn FnMut(TraceProgress<'_>),
) -> Result<ResponseFormula, ProblemError> {
    check_study(model, StudyKind::Formula(study.clone()))?;
    let mut asked = match &study.source {
        FormulaSource::Trace(position) => along(model, study, *position, options, progress)?,
        FormulaSource::Grid(axes) => over(model, study, axes, options)?,
    };
    let within = |point: &ResponsePoint| {
        study.variables.iter().zip(&point.variables).all(|(variable, value)| {
            let si = value * variable.unit.factor;
            variable.range.is_none_or(|[low, high]| {
                let slack = NEAR * (high - low);
                si >= low - slack && si <= high + slack
            })
        })
    };
    asked.points.retain(within);
    if asked.points.is_empty() {
        let reason = asked.reason.or_else(|| asked.left_out.first().map(|(_, reason)| reason.clone()));
        let message = match reason {
            Some(reason) => format!("the model gives no point to go by: {reason}"),
            None => "no point lies in the range".to_string(),
        };
        return Err(ProblemError::new("study", message, "widen `range`, or ask the model elsewhere"));
    }
    if let (FormulaSource::Trace(_), [_]) = (&study.source, &study.variables[..]) {
        weigh(&mut asked.points);
    }
    let pieces = pieces(study, &mut asked.points)?;
    let (r_squared, deviation, largest) = quality(asked.points.iter().enumerate());
    Ok(ResponseFormula {
        status: asked.status,
        reason: asked.reason,
        warnings: asked.warnings,
        pieces,
        points: asked.points,
        left_out: asked.left_out,
        r_squared,
        deviation,
        largest,
    })
}

/// Position of a component among those of all outputs.
fn component(model: &Model, (output, component): (usize, usize)) -> usize {
    model.outputs[..output].iter().map(|output| output.formulas.len()).sum::<usize>() + component
}

/// A point in the units of the study; None where something has no value.
fn point(
    model: &Model,
    study: &FormulaStudy,
    values: &[Option<f64>],
    parameter: impl Fn(usize) -> f64,
) -> Option<ResponsePoint> {
    let of = |of: &FormulaQuantity| match of {
        FormulaQuantity::Parameter(position) => Some(parameter(*position)),
        FormulaQuantity::Output(output, part) => values.get(component(model, (*output, *part))).copied()?,
    };
    let variables: Option<Vec<f64>> =
        study.variables.iter().map(|variable| of(&variable.of).map(|v| v / variable.unit.factor)).collect();
    let value = values.get(component(model, study.output)).copied()?? / study.unit.factor;
    Some(ResponsePoint { variables: variables?, value, formula: f64::NAN, weight: 1.0 })
}

fn along(
    model: &Model,
    study: &FormulaStudy,
    position: usize,
    options: &Options,
    progress: &mut dyn FnMut(TraceProgress<'_>),
) -> Result<Asked, ProblemError> {
    let Some(StudyKind::Trace(followed)) = model.studies.get(position).map(|study| &study.kind) else {
        return Err(ProblemError::new("study", "refers to a trace that does not exist", ""));
    };
    let traced = trace(model, followed, options, progress)?;
    let mut asked = Asked {
        points: Vec::new(),
        left_out: Vec::new(),
        status: traced.status,
        reason: traced.reason.clone(),
        warnings: Vec::new(),
    };
    let name = &model.parameters[followed.parameter].name;
    for found in traced.branches.first().map_or(&[][..], |branch| &branch.points) {
        let values: Vec<Option<f64>> = found
            .outputs
            .iter()
            .zip(&model.outputs)
            .flat_map(|(values, output)| match values {
                Some(values) => values.iter().copied().map(Some).collect(),
                None => vec![None; output.formulas.len()],
            })
            .collect();
        match point(model, study, &values, |_| found.parameter) {
            Some(point) => asked.points.push(point),
            None => asked
                .left_out
                .push((format!("{name} = {}", found.parameter), "an output has no value there".to_string())),
        }
    }
    if turns(&asked.points) {
        asked.warnings.push(
            "the trace passes the same values twice; the formula stands for all of it, so give a `range` in which it does not"
                .to_string(),
        );
    }
    Ok(asked)
}

/// Does the first variable turn back?
fn turns(points: &[ResponsePoint]) -> bool {
    let steps = points.windows(2).map(|pair| pair[1].variables[0] - pair[0].variables[0]);
    let (mut up, mut down) = (false, false);
    for step in steps {
        up |= step > 0.0;
        down |= step < 0.0;
    }
    up && down
}

fn over(
    model: &Model,
    study: &FormulaStudy,
    axes: &[(usize, Vec<f64>)],
    options: &Options,
) -> Result<Asked, ProblemError> {
    let mut grid: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
    for (parameter, values) in axes {
        let longer = |values_before: &Vec<(usize, f64)>| {
            let with = |value: &f64| [&values_before[..], &[(*parameter, *value)]].concat();
            values.iter().map(with).collect::<Vec<_>>()
        };
        grid = grid.iter().flat_map(longer).collect();
    }
    let mut conditions = Conditions::new(model, &[], grid.len(), options.tolerance, &options.interrupt)?;
    let places: Vec<(usize, Vec<(usize, f64)>)> = grid.into_iter().enumerate().collect();
    let answers = conditions.answers(&places, false);
    let mut asked = Asked {
        points: Vec::new(),
        left_out: Vec::new(),
        status: Status::Converged,
        reason: None,
        warnings: Vec::new(),
    };
    for ((_, values), answer) in places.iter().zip(answers) {
        let of = |position: usize| {
            values.iter().find(|(own, _)| *own == position).map_or(f64::NAN, |(_, value)| *value)
        };
        let found = answer.and_then(|answer| {
            point(model, study, &answer.values, of).ok_or_else(|| "an output has no value there".to_string())
        });
        match found {
            Ok(point) => asked.points.push(point),
            Err(reason) => {
                let place = values.iter().map(|(p, v)| format!("{} = {v}", model.parameters[*p].name));
                asked.left_out.push((place.collect::<Vec<_>>().join(", "), reason));
            }
        }
    }
    if options.interrupt.is_raised() {
        asked.status = Status::Interrupted;
        asked.reason = Some("interrupted".to_string());
    }
    let (count, all) = (asked.left_out.len(), places.len());
    if let Some((place, reason)) = asked.left_out.first() {
        asked
            .warnings
            .push(format!("{count} of {all} points of the grid left out, the first at {place}: {reason}"));
    }
    Ok(asked)
}

/// What each point of a path stands for.
fn weigh(points: &mut [ResponsePoint]) {
    let x: Vec<f64> = points.iter().map(|point| point.variables[0]).collect();
    let n = x.len();
    let part = |i: usize| {
        let before = if i > 0 { (x[i] - x[i - 1]).abs() } else { 0.0 };
        let after = if i + 1 < n { (x[i + 1] - x[i]).abs() } else { 0.0 };
        0.5 * (before + after)
    };
    let whole: f64 = (0..n).map(part).sum();
    for (i, point) in points.iter_mut().enumerate() {
        point.weight = if whole > 0.0 { part(i) * n as f64 / whole } else { 1.0 };
    }
}

fn pieces(study: &FormulaStudy, points: &mut [ResponsePoint]) -> Result<Vec<ResponsePiece>, ProblemError> {
    let unit = study.variables[0].unit.factor;
    let x = || points.iter().map(|point| point.variables[0]);
    let ends = [x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max)];
    let mut found = Vec::with_capacity(study.pieces.len());
    let mut from = ends[0];
    for (i, piece) in study.pieces.iter().enumerate() {
        let to = piece.to.map_or(ends[1], |to| to / unit);
        let last = i + 1 == study.pieces.len();
        // A point at an end belongs to the piece before it.
        let is_in = |x: f64| (i == 0 || x > from) && (last || x <= to);
        let own: Vec<usize> = (0..points.len()).filter(|k| is_in(points[*k].variables[0])).collect();
        found.push(fitted(piece, points, &own, (i, [from, to]))?);
        from = to;
    }
    Ok(found)
}

fn fitted(
    piece: &FormulaPiece,
    points: &mut [ResponsePoint],
    own: &[usize],
    (i, range): (usize, [f64; 2]),
) -> Result<ResponsePiece, ProblemError> {
    let (n, p) = (own.len(), piece.terms.len());
    let path = format!("study.pieces[{i}]");
    if n < p {
        let message = format!("{n} points are too few for {p} terms");
        return Err(ProblemError::new(path, message, "ask the model at more points, or take fewer terms"));
    }
    let root: Vec<f64> = own.iter().map(|k| points[*k].weight.sqrt()).collect();
    let mut matrix = DMatrix::from_fn(n, p, |r, k| root[r] * piece.terms[k].value(&points[own[r]].variables));
    let right = DVector::from_fn(n, |r, _| root[r] * points[own[r]].value);
    // Powers of small numbers are smaller still: columns of one size.
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    for (mut column, size) in matrix.column_iter_mut().zip(&sizes) {
        column /= if *size > 0.0 { *size } else { 1.0 };
    }
    let svd = singular_values(matrix, true, true);
    let largest = svd.as_ref().map_or(0.0, |svd| svd.singular_values.max());
    let svd = svd.filter(|svd| svd.singular_values.min() > RANK * largest);
    let Some(solved) = svd.and_then(|svd| svd.solve(&right, 0.0).ok()) else {
        let message = "its terms cannot be told apart at the points that there are";
        return Err(ProblemError::new(path, message, "ask the model at other points, or take fewer terms"));
    };
    let coefficients: Vec<f64> = solved.iter().zip(&sizes).map(|(c, size)| c / size).collect();
    for k in own {
        let point = &mut points[*k];
        let values = piece.terms.iter().zip(&coefficients);
        point.formula = values.map(|(term, c)| c * term.value(&point.variables)).sum();
    }
    let (r_squared, _, largest) = quality(own.iter().map(|k| (*k, &points[*k])));
    Ok(ResponsePiece { range, coefficients, count: n, r_squared, largest: largest.0 })
}

/// R², root mean square error, and the largest error with its place.
fn quality<'p>(
    points: impl Iterator<Item = (usize, &'p ResponsePoint)> + Clone,
) -> (Option<f64>, f64, (f64, usize)) {
    let all = || points.clone().map(|(_, point)| point);
    let whole: f64 = all().map(|point| point.weight).sum();
    let mean = all().map(|point| point.weight * point.value).sum::<f64>() / whole;
    let squares: f64 = all().map(|point| point.weight * (point.value - point.formula).powi(2)).sum();
    let total: f64 = all().map(|point| point.weight * (point.value - mean).powi(2)).sum();
    let mut largest = (0.0_f64, 0);
    for (k, point) in points {
        let error = (point.formula - point.value).abs();
        if error > largest.0 {
            largest = (error, k);
        }
    }
    ((total > 0.0).then(|| 1.0 - squares / total), (squares / whole).sqrt(), largest)
}
