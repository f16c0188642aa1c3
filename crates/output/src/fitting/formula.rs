//! The document of a formula, in the units of its study.

use super::FormulaView;
use crate::document::{finite, finite_list};
use crate::{Named, OutputError};
use serde::Serialize;

/// The result document of a formula.
#[derive(Clone, Debug, Serialize)]
pub struct FormulaDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged", or how else it ended.
    pub status: String,
    /// Why not all was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// The output that it gives.
    pub output: String,
    /// In which unit.
    pub unit: String,
    /// What goes in, in order.
    pub variables: Named<FormulaVariableDocument>,
    /// One after another along the first variable.
    pub pieces: Vec<FormulaPieceDocument>,
    /// 1 - Σ error²/Σ (value - mean)²; null where nothing varies.
    pub r_squared: Option<f64>,
    /// Root mean square error.
    pub deviation: f64,
    /// Largest error.
    pub largest_error: f64,
    /// Where that is.
    pub largest_at: Named<f64>,
    /// The points: what goes in, by name.
    pub points: Named<Vec<f64>>,
    /// The model's values there.
    pub values: Vec<f64>,
    /// The formula's.
    pub formula: Vec<f64>,
    /// Places at which the model gave nothing, and why.
    pub left_out: Vec<(String, String)>,
}

/// What goes into a formula.
#[derive(Clone, Debug, Serialize)]
pub struct FormulaVariableDocument {
    /// Its unit.
    pub unit: String,
    /// Smallest and largest value to which the formula was fitted.
    pub range: [f64; 2],
}

/// One piece of a formula.
#[derive(Clone, Debug, Serialize)]
pub struct FormulaPieceDocument {
    /// From and to, along the first variable.
    pub range: [f64; 2],
    /// Its terms with their coefficients.
    pub terms: Named<f64>,
    /// Points in it.
    pub count: usize,
    /// As of the whole formula.
    pub r_squared: Option<f64>,
    /// Largest error.
    pub largest_error: f64,
}

/// The result document of a formula.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn formula_document(view: &FormulaView<'_>) -> Result<FormulaDocument, OutputError> {
    let found = view.formula;
    let names = view.variables();
    let at = found.points.get(found.largest.1);
    let column = |k: usize| found.points.iter().map(move |point| point.variables[k]);
    Ok(FormulaDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: view.model.name.clone(),
        study: "formula".to_owned(),
        status: found.status.word().to_owned(),
        reason: found.reason.clone(),
        warnings: found.warnings.clone(),
        output: view.output(),
        unit: view.study.unit.text.clone(),
        variables: Named(
            names
                .iter()
                .zip(&view.study.variables)
                .zip(view.ranges())
                .map(|((name, variable), range)| {
                    (name.clone(), FormulaVariableDocument { unit: variable.unit.text.clone(), range })
                })
                .collect(),
        ),
        pieces: found
            .pieces
            .iter()
            .enumerate()
            .map(|(i, piece)| {
                let path = || format!("pieces[{i}]");
                for coefficient in &piece.coefficients {
                    finite(*coefficient, path)?;
                }
                Ok(FormulaPieceDocument {
                    range: piece.range,
                    terms: Named(view.terms(i).into_iter().zip(piece.coefficients.iter().copied()).collect()),
                    count: piece.count,
                    r_squared: piece.r_squared,
                    largest_error: finite(piece.largest, path)?,
                })
            })
            .collect::<Result<_, OutputError>>()?,
        r_squared: found.r_squared,
        deviation: finite(found.deviation, || "deviation".into())?,
        largest_error: finite(found.largest.0, || "largest_error".into())?,
        largest_at: Named(
            names.iter().enumerate().filter_map(|(k, name)| Some((name.clone(), at?.variables[k]))).collect(),
        ),
        points: Named::collect(names.iter().enumerate(), |(k, name)| {
            Ok((name.clone(), finite_list(name, column(k))?))
        })?,
        values: finite_list("values", found.points.iter().map(|point| point.value))?,
        formula: finite_list("formula", found.points.iter().map(|point| point.formula))?,
        left_out: found.left_out.clone(),
    })
}
