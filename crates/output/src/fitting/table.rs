//! Tables of fits and formulas.

use super::{FitView, FormulaView};
use crate::csv::csv_line;

/// `residuals.csv`: a row for each row of the measurements: its line, what it sets, and of each output the measured value, the computed
/// one and their difference, SI. Empty where there is nothing.
pub fn fit_csv(view: &FitView<'_>) -> String {
    let data = &view.study.data;
    let headed = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name}[{unit}]"),
    };
    let has_specimens = data.specimens != [String::new()];
    let mut cells = vec!["line".to_owned()];
    if has_specimens {
        cells.push("specimen".to_owned());
    }
    for position in &data.set {
        let parameter = &view.model.parameters[*position];
        cells.push(headed(&parameter.name, &parameter.unit));
    }
    for column in 0..data.measured.len() {
        let (name, unit) = view.measured(column);
        for word in ["measured", "computed", "residual"] {
            cells.push(headed(&format!("{name} {word}"), unit));
        }
    }
    let mut text = csv_line(&cells);
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
    for (i, row) in data.rows.iter().enumerate() {
        let mut cells = vec![row.line.to_string()];
        if has_specimens {
            cells.push(data.specimens[row.specimen].clone());
        }
        cells.extend(row.set.iter().map(|value| format!("{value:?}")));
        for column in 0..data.measured.len() {
            let computed = view.fit.rows.get(i).and_then(|row| row.computed.get(column).copied().flatten());
            cells.extend([cell(row.measured[column]), cell(computed), cell(view.residual(i, column))]);
        }
        text += &csv_line(&cells);
    }
    text
}

/// `points.csv`: what went into the formula, the model's value and the formula's.
pub fn points_csv(view: &FormulaView<'_>) -> String {
    super::code::points(view)
}
