//! What a person reads after a fit.

use crate::quantity::{number, quantity};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::output::FitView;
use flexura::solution::{Estimate, Status};

/// Rows of a table of specimens that are shown.
const MOST: usize = 30;

/// The summary as text.
pub fn render(view: &FitView<'_>) -> String {
    let (model, study, fit) = (view.model, view.study, view.fit);
    let state = match fit.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let values: usize = fit.measured.iter().map(|measured| measured.count).sum();
    let work = fit.work;
    let about = format!(
        "{values} values, {} degrees of freedom, {} steps, {} solves",
        fit.freedom, work.iterations, work.solves
    );
    let mut text = format!("{}: {state}\n  {}\n", title(&model.name), styled(DIM, &about));
    let percent = format!("{} % interval", number(100.0 * study.confidence, 4));
    let mut headings = vec!["estimates", "value", "standard error", &percent];
    if study.profile {
        headings.push("by profile");
    }
    let mut table = Table::new(&headings);
    for estimate in &fit.estimates {
        let mut row = cells(view, estimate);
        if study.profile {
            let unit = &model.parameters[estimate.parameter].unit;
            let end = |end: Option<f64>| end.map_or("beyond".to_owned(), |end| quantity(end, unit, 5));
            row.push(
                estimate
                    .profile
                    .map_or("-".to_owned(), |[low, high]| format!("{} to {}", end(low), end(high))),
            );
        }
        table.row(row);
    }
    text += &format!("\n{}", table.shortened(MOST).render());
    for spread in &fit.spread {
        let parameter = &model.parameters[spread.parameter];
        text += &format!(
            "\n{} over {} specimens: {} ± {}\n",
            parameter.name,
            spread.count,
            quantity(spread.mean, &parameter.unit, 5),
            quantity(spread.deviation, &parameter.unit, 3)
        );
    }
    text += &measured(view);
    text += &correlations(view);
    text += &specimens(view);
    text
}

fn cells(view: &FitView<'_>, estimate: &Estimate) -> Vec<String> {
    let parameter = &view.model.parameters[estimate.parameter];
    let name = match estimate.specimen {
        Some(specimen) => format!("{} of {}", parameter.name, view.study.data.specimens[specimen]),
        None => parameter.name.clone(),
    };
    let shown = |value: f64, digits: usize| quantity(value, &parameter.unit, digits);
    let interval = estimate.interval.map(|[low, high]| format!("{} to {}", shown(low, 5), shown(high, 5)));
    let unknown = if estimate.is_at_bound { "at its bound" } else { "not determined" };
    vec![
        name,
        shown(estimate.value, 7),
        estimate.standard_error.map_or(unknown.to_owned(), |error| shown(error, 3)),
        interval.unwrap_or("-".to_owned()),
    ]
}

fn measured(view: &FitView<'_>) -> String {
    let mut table = Table::new(&["measured", "values", "rms residual", "largest", "in line", "R²"]);
    for (column, measured) in view.fit.measured.iter().enumerate() {
        let (output, component) = view.study.data.measured[column];
        let unit = &view.model.outputs[output].unit;
        table.row(vec![
            view.model.output_name(output, component),
            measured.count.to_string(),
            quantity(measured.deviation, unit, 4),
            quantity(measured.largest.0, unit, 4),
            view.study.data.rows.get(measured.largest.1).map_or("-".to_owned(), |row| row.line.to_string()),
            measured.r_squared.map_or("-".to_owned(), |r| format!("{r:.6}")),
        ]);
    }
    let mut text = format!("\n{}", table.render());
    if view.fit.is_relative && view.fit.scatter.is_finite() {
        text += &format!(
            "\nthe residuals scatter {} times as much as the given noise\n",
            number(view.fit.scatter, 3)
        );
    }
    text
}

/// The pairs that hang together most.
fn correlations(view: &FitView<'_>) -> String {
    let fit = view.fit;
    let n = fit.estimates.len();
    let mut pairs: Vec<(usize, usize, f64)> = (0..n)
        .flat_map(|i| (0..i).map(move |k| (k, i)))
        .filter_map(|(k, i)| Some((k, i, fit.correlation[k][i]?)))
        .filter(|(.., c)| c.abs() > 0.5)
        .collect();
    if pairs.is_empty() {
        return String::new();
    }
    pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    let mut table = Table::new(&["correlation", ""]);
    for (k, i, value) in pairs {
        let name = |k: usize| cells(view, &fit.estimates[k]).swap_remove(0);
        table.row(vec![format!("{}, {}", name(k), name(i)), number(value, 4)]);
    }
    format!("\n{}", table.shortened(6).render())
}

/// In standard deviations of the noise, or in the unit of what was measured.
fn scatter(view: &FitView<'_>, scatter: f64) -> String {
    match view.study.data.measured.first() {
        Some((output, _)) if !view.fit.is_relative => quantity(scatter, &view.model.outputs[*output].unit, 3),
        _ => number(scatter, 3),
    }
}

fn specimens(view: &FitView<'_>) -> String {
    let data = &view.study.data;
    if data.specimens == [String::new()] {
        return String::new();
    }
    let mut table = Table::new(&["specimens", "values", "scatter", "distance", ""]);
    for (name, specimen) in data.specimens.iter().zip(&view.fit.specimens) {
        let verdict = match specimen.distance {
            _ if specimen.is_rejected => "left out",
            Some(distance) if distance > 1.0 => "outside",
            _ => "",
        };
        table.row(vec![
            name.clone(),
            specimen.values.to_string(),
            scatter(view, specimen.scatter),
            specimen.distance.map_or("-".to_owned(), |distance| number(distance, 3)),
            verdict.to_owned(),
        ]);
    }
    format!("\n{}", table.shortened(MOST).render())
}
