//! The designs of an optimisation as tables.

use super::DesignView;
use crate::trace::{cell, headed};
use crate::{OutputError, csv_line};

/// One row for each design on the way of each search: number of the search and of the step, parameters, objective, violation.
///
/// # Errors
/// [`OutputError`] where a number is none.
pub fn history_csv(view: &DesignView<'_>) -> Result<String, OutputError> {
    let mut header = vec!["start".to_owned(), "step".to_owned()];
    header.extend(names(view));
    header.extend([objective(view), "violation".to_owned()]);
    let mut text = csv_line(&header);
    for (i, start) in view.result.starts.iter().enumerate() {
        for (k, step) in start.history.iter().enumerate() {
            let mut row = vec![i.to_string(), k.to_string()];
            let numbers = step.values.iter().chain([&step.objective, &step.violation]);
            row.extend(cells(numbers, || format!("starts[{i}].history[{k}]"))?);
            text += &csv_line(&row);
        }
    }
    Ok(text)
}

/// One row for each point of the front: parameters, both objectives, the values of what is bounded. None without a front.
///
/// # Errors
/// [`OutputError`] where a number is none.
pub fn front_csv(view: &DesignView<'_>) -> Result<Option<String>, OutputError> {
    let Some(front) = view.study.front.as_ref().filter(|_| !view.result.front.is_empty()) else {
        return Ok(None);
    };
    let conditions = || view.study.conditions.iter().map(|condition| &condition.reading.output);
    let mut header = names(view);
    header.push(objective(view));
    header.push(headed(&front.other.output.name, &front.other.output.unit));
    header.extend(conditions().map(|output| headed(&output.name, &output.unit)));
    let mut text = csv_line(&header);
    for (i, point) in view.result.front.iter().enumerate() {
        let other = point.other.unwrap_or(f64::NAN);
        let numbers = point.values.iter().chain([&point.objective, &other]).chain(&point.conditions);
        text += &csv_line(&cells(numbers, || format!("front[{i}]"))?);
    }
    Ok(Some(text))
}

fn names(view: &DesignView<'_>) -> Vec<String> {
    let parameters = view.study.vary.iter().map(|varied| &view.model.parameters[varied.parameter]);
    parameters.map(|parameter| headed(&parameter.name, &parameter.unit)).collect()
}

fn objective(view: &DesignView<'_>) -> String {
    let output = &view.study.objective.output;
    headed(&output.name, &output.unit)
}

fn cells<'n>(
    numbers: impl Iterator<Item = &'n f64>,
    path: impl Fn() -> String,
) -> Result<Vec<String>, OutputError> {
    numbers.map(|number| cell(*number, &path)).collect()
}
