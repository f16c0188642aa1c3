//! Tables of a trace and of buckling: a row for every point, and for every critical value. Branches and points are counted
//! from 1.

use super::{TraceView, parameter_of};
use crate::OutputError;
use crate::csv::quoted;
use flexura_model::Model;
use flexura_solution::{Buckling, PointKind, Status, TracePoint};

/// `path.csv`: every point of every branch.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn path_csv(view: &TraceView<'_>) -> Result<String, OutputError> {
    let (name, unit) = view.parameter();
    let mut header: Vec<String> = ["branch", "point", "kind"].map(str::to_owned).to_vec();
    header.push(headed(name, unit));
    header.extend(output_headings(view.model));
    header.extend(LAST.map(str::to_owned));
    let mut text = line(header);
    for (b, branch) in view.trace.branches.iter().enumerate() {
        for (p, point) in branch.points.iter().enumerate() {
            let path = format!("branches[{b}].points[{p}]");
            let mut row = vec![(b + 1).to_string(), (p + 1).to_string(), point.kind.word().to_owned()];
            row.push(cell(point.parameter, || format!("{path}.parameter"))?);
            row.extend(rest_of_row(view, &path, point)?);
            text += &line(row);
        }
    }
    Ok(text)
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
        row.extend(rest_of_row(view, &path, point)?);
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
const LAST: [&str; 5] = ["stable", "unstable_directions", "arc", "error_estimate", "detail"];

fn rest_of_row(view: &TraceView<'_>, path: &str, point: &TracePoint) -> Result<Vec<String>, OutputError> {
    let mut row = Vec::new();
    for (i, output) in view.model.outputs.iter().enumerate() {
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
    row.push(if view.trace.status == Status::Converged || point.error_estimate.is_finite() {
        cell(point.error_estimate, || format!("{path}.error_estimate"))?
    } else {
        String::new()
    });
    row.push(match point.kind {
        PointKind::Branch(crossing) => crossing.word().to_owned(),
        PointKind::Event(position) => view.event(position).unwrap_or_default().to_owned(),
        _ => String::new(),
    });
    Ok(row)
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
    cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n"
}
