//! Tables of a trace and of buckling: a row for every point, and for every critical value. Branches and points are counted
//! from 1.

use super::{TraceView, event_of, parameter_of};
use crate::OutputError;
use crate::csv::csv_line;
use flexura_model::{Model, TraceStudy};
use flexura_solution::{Buckling, PointKind, Status, TracePoint};

/// `path.csv`: every point of every branch.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn path_csv(view: &TraceView<'_>) -> Result<String, OutputError> {
    let mut text = path_header(view.model, view.study);
    for (b, branch) in view.trace.branches.iter().enumerate() {
        for (p, point) in branch.points.iter().enumerate() {
            estimated(view, point, || format!("branches[{b}].points[{p}]"))?;
            text += &path_row(view.model, view.study, [b, p], point)?;
        }
    }
    Ok(text)
}

/// The first line of `path.csv`.
pub fn path_header(model: &Model, study: &TraceStudy) -> String {
    let (name, unit) = parameter_of(model, Some(study.parameter));
    let mut header: Vec<String> = ["branch", "point", "kind"].map(str::to_owned).to_vec();
    header.push(headed(name, unit));
    header.extend(output_headings(model));
    header.extend(LAST.map(str::to_owned));
    line(header)
}

/// A line of `path.csv`: of the point with these numbers of its branch and in its branch, from 0.
///
/// # Errors
/// As [`path_csv`].
pub fn path_row(
    model: &Model,
    study: &TraceStudy,
    [b, p]: [usize; 2],
    point: &TracePoint,
) -> Result<String, OutputError> {
    let path = format!("branches[{b}].points[{p}]");
    let mut row = vec![(b + 1).to_string(), (p + 1).to_string(), point.kind.word().to_owned()];
    row.push(cell(point.parameter, || format!("{path}.parameter"))?);
    row.extend(rest_of_row(model, study, &path, point)?);
    Ok(line(row))
}

/// A path that converged has an error at every point.
fn estimated(view: &TraceView<'_>, point: &TracePoint, path: impl Fn() -> String) -> Result<(), OutputError> {
    if view.trace.status == Status::Converged {
        cell(point.error_estimate, || format!("{}.error_estimate", path()))?;
    }
    Ok(())
}

/// `critical.csv`: every point of the critical curve; None where none was followed.
///
/// # Errors
/// As [`path_csv`].
pub fn critical_csv(view: &TraceView<'_>) -> Result<Option<String>, OutputError> {
    let Some(curve) = &view.trace.critical else { return Ok(None) };
    let (name, unit) = view.parameter();
    let (second, second_unit) = parameter_of(view.model, Some(curve.parameter));
    let mut header = vec!["point".to_owned(), headed(second, second_unit), headed(name, unit)];
    header.extend(output_headings(view.model));
    header.extend(LAST.map(str::to_owned));
    let mut text = line(header);
    for (p, (value, point)) in curve.points.iter().enumerate() {
        let path = format!("critical.points[{p}]");
        let mut row = vec![(p + 1).to_string()];
        row.push(cell(*value, || format!("{path}.second_parameter"))?);
        row.push(cell(point.parameter, || format!("{path}.parameter"))?);
        estimated(view, point, || path.clone())?;
        row.extend(rest_of_row(view.model, view.study, &path, point)?);
        text += &line(row);
    }
    Ok(Some(text))
}

/// `modes.csv`: every critical value of buckling.
///
/// # Errors
/// As [`path_csv`].
pub fn modes_csv(model: &Model, buckling: &Buckling) -> Result<String, OutputError> {
    let (name, unit) = parameter_of(model, buckling.parameter);
    let error = headed("error_estimate", unit);
    let mut text = line(vec!["mode".to_owned(), headed(name, unit), error]);
    for (i, mode) in buckling.modes.iter().enumerate() {
        let field = |part: &str| format!("modes[{i}].{part}");
        let value = cell(mode.value, || field("value"))?;
        let error = cell(mode.error_estimate, || field("error_estimate"))?;
        text += &line(vec![(i + 1).to_string(), value, error]);
    }
    Ok(text)
}

/// What stands behind the outputs.
const LAST: [&str; 6] = ["stable", "unstable_directions", "arc", "error_estimate", "detail", "reason"];

fn rest_of_row(
    model: &Model,
    study: &TraceStudy,
    path: &str,
    point: &TracePoint,
) -> Result<Vec<String>, OutputError> {
    let mut row = Vec::new();
    for (i, output) in model.outputs.iter().enumerate() {
        let values = point.outputs.get(i).and_then(Option::as_ref);
        for component in 0..output.formulas.len() {
            row.push(match values.and_then(|values| values.get(component)) {
                Some(value) => cell(*value, || format!("{path}.outputs.{}", output.name))?,
                None => String::new(),
            });
        }
    }
    row.push(point.stable.map_or_else(String::new, |stable| stable.to_string()));
    row.push(point.unstable_directions.map_or_else(String::new, |count| count.to_string()));
    row.push(cell(point.arc, || format!("{path}.arc"))?);
    row.push(if point.error_estimate.is_finite() {
        cell(point.error_estimate, || format!("{path}.error_estimate"))?
    } else {
        String::new()
    });
    row.push(match point.kind {
        PointKind::Branch(crossing) => crossing.word().to_owned(),
        PointKind::Event(position) => event_of(study, position).unwrap_or_default().to_owned(),
        _ => String::new(),
    });
    row.push(reasons(&point.output_reasons));
    Ok(row)
}

/// Why cells of outputs are empty.
pub(crate) fn reasons(reasons: &[(usize, String)]) -> String {
    reasons.iter().map(|(_, reason)| reason.as_str()).collect::<Vec<_>>().join("; ")
}

pub(crate) fn output_headings(model: &Model) -> Vec<String> {
    let mut headings = Vec::new();
    for output in &model.outputs {
        match output.formulas.len() {
            3 => headings
                .extend(["x", "y", "z"].map(|c| headed(&format!("{}.{c}", output.name), &output.unit))),
            _ => headings.push(headed(&output.name, &output.unit)),
        }
    }
    headings
}

pub(crate) fn headed(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// The shortest text that reads back as the same number.
pub(crate) fn cell(value: f64, field: impl FnOnce() -> String) -> Result<String, OutputError> {
    if !value.is_finite() {
        return Err(OutputError::NotFinite { field: field(), value });
    }
    Ok(format!("{value:?}"))
}

pub(crate) fn line(cells: Vec<String>) -> String {
    csv_line(&cells)
}
