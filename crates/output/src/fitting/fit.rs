//! The document of a fit. SI units.

use super::FitView;
use crate::document::{finite, parameters};
use crate::{Named, OutputError};
use flexura_solution::{Estimate, Unseen};
use serde::Serialize;

/// The result document of a fit.
#[derive(Clone, Debug, Serialize)]
pub struct FitDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged", or how else it ended.
    pub status: String,
    /// Why it did not come to a minimum, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// Probability that an interval holds the true value.
    pub confidence: f64,
    /// Estimates that are the same for all specimens.
    pub estimates: Named<EstimateDocument>,
    /// The specimens, where the data tell some apart.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub specimens: Named<SpecimenDocument>,
    /// Over the specimens that count, what each has its own value of.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub spread: Named<SpreadDocument>,
    /// What the rows and columns of `correlation` are.
    pub correlated: Vec<String>,
    /// Correlations between the estimates; null of those that the data do not determine.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Combinations of estimates that the data see hardly or not at all.
    pub unseen: Vec<UnseenDocument>,
    /// Lines of the table of measurements to which `residuals` belong.
    pub lines: Vec<usize>,
    /// Measured less computed, by output; null where there is nothing to compare.
    pub residuals: Named<Vec<Option<f64>>>,
    /// How well each measured output is met.
    pub measured: Named<MeasuredDocument>,
    /// Rows that could not be used.
    pub left_out: Vec<LeftOutDocument>,
    /// Standard deviation of the residuals: SI, or in standard deviations of the noise where that is given.
    pub scatter: Option<f64>,
    /// Is `scatter` in standard deviations of a given noise?
    pub scatter_is_relative: bool,
    /// Measured values less estimates.
    pub freedom: usize,
    /// All parameters, those that were found with their estimates.
    pub parameters: Named<f64>,
    /// What it took.
    pub work: FitWorkDocument,
}

/// A parameter that was found.
#[derive(Clone, Debug, Serialize)]
pub struct EstimateDocument {
    /// What was found.
    pub value: f64,
    /// SI unit.
    pub unit: String,
    /// Standard error; null where the data do not determine it.
    pub standard_error: Option<f64>,
    /// Confidence interval of the linearised problem.
    pub interval: Option<[f64; 2]>,
    /// The same by profile likelihood; an end is null that lies beyond the bounds or all measure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<[Option<f64>; 2]>,
    /// Where the search began.
    pub guess: f64,
    /// Does it stand at one of its bounds?
    pub is_at_bound: bool,
}

/// A specimen.
#[derive(Clone, Debug, Serialize)]
pub struct SpecimenDocument {
    /// Measured values.
    pub values: usize,
    /// Root mean square of its residuals, as `scatter`.
    pub scatter: f64,
    /// Its distance from what the others predict; more than 1 is outside. Null where they predict nothing.
    pub distance: Option<f64>,
    /// Was it left out for that?
    pub is_rejected: bool,
    /// Its own estimates.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub estimates: Named<EstimateDocument>,
}

/// Values over specimens.
#[derive(Clone, Debug, Serialize)]
pub struct SpreadDocument {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// How many.
    pub count: usize,
}

/// A combination of estimates.
#[derive(Clone, Debug, Serialize)]
pub struct UnseenDocument {
    /// Relative changes that go together, the largest of them 1.
    pub changes: Named<f64>,
    /// How far it may go within the confidence; null: without end.
    pub reach: Option<f64>,
}

/// How well an output is met.
#[derive(Clone, Debug, Serialize)]
pub struct MeasuredDocument {
    /// SI unit.
    pub unit: String,
    /// Values that count.
    pub count: usize,
    /// Root mean square of the residuals.
    pub deviation: f64,
    /// The largest residual.
    pub largest: f64,
    /// Its line.
    pub line: usize,
    /// 1 - Σ residual²/Σ (measured - mean)²; null where nothing varies.
    pub r_squared: Option<f64>,
}

/// A row that could not be used.
#[derive(Clone, Debug, Serialize)]
pub struct LeftOutDocument {
    /// Its line in the table.
    pub line: usize,
    /// Why.
    pub reason: String,
}

/// Counts of work.
#[derive(Clone, Debug, Serialize)]
pub struct FitWorkDocument {
    /// Steps of the search.
    pub iterations: usize,
    /// Equilibria that were found.
    pub solves: usize,
    /// Equilibria whose derivatives were worked out.
    pub derivatives: usize,
}

/// The result document of a fit.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn fit_document(view: &FitView<'_>) -> Result<FitDocument, OutputError> {
    let (model, data, fit) = (view.model, &view.study.data, view.fit);
    let columns = 0..data.measured.len();
    let has_specimens = data.specimens != [String::new()];
    let specimens = data.specimens.iter().enumerate().filter(|_| has_specimens);
    let residuals = |column: usize| (0..data.rows.len()).map(|row| view.residual(row, column)).collect();
    Ok(FitDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "fit".to_owned(),
        status: fit.status.word().to_owned(),
        reason: fit.reason.clone(),
        warnings: fit.warnings.clone(),
        confidence: view.study.confidence,
        estimates: estimates(view, None)?,
        specimens: Named::collect(specimens, |(i, name)| {
            let own = &fit.specimens[i];
            let document = SpecimenDocument {
                values: own.values,
                scatter: finite(own.scatter, || format!("specimens.{name}.scatter"))?,
                distance: own.distance.filter(|distance| distance.is_finite()),
                is_rejected: own.is_rejected,
                estimates: estimates(view, Some(i))?,
            };
            Ok((name.clone(), document))
        })?,
        spread: Named::collect(fit.spread.iter(), |spread| {
            let document =
                SpreadDocument { mean: spread.mean, deviation: spread.deviation, count: spread.count };
            Ok((model.parameters[spread.parameter].name.clone(), document))
        })?,
        correlated: fit.estimates.iter().map(|estimate| name(view, estimate)).collect(),
        correlation: fit.correlation.clone(),
        unseen: fit.unseen.iter().map(|unseen| combination(view, unseen)).collect(),
        lines: data.rows.iter().map(|row| row.line).collect(),
        residuals: Named(
            columns.clone().map(|column| (view.measured(column).0, residuals(column))).collect(),
        ),
        measured: Named::collect(columns.zip(&fit.measured), |(column, measured)| {
            let (name, unit) = view.measured(column);
            let document = MeasuredDocument {
                unit: unit.to_owned(),
                count: measured.count,
                deviation: finite(measured.deviation, || format!("measured.{name}.deviation"))?,
                largest: measured.largest.0,
                line: data.rows.get(measured.largest.1).map_or(0, |row| row.line),
                r_squared: measured.r_squared,
            };
            Ok((name, document))
        })?,
        left_out: fit
            .left_out
            .iter()
            .map(|(row, reason)| LeftOutDocument { line: data.rows[*row].line, reason: reason.clone() })
            .collect(),
        scatter: Some(fit.scatter).filter(|scatter| scatter.is_finite()),
        scatter_is_relative: fit.is_relative,
        freedom: fit.freedom,
        parameters: parameters(view.fitted)?,
        work: FitWorkDocument {
            iterations: fit.work.iterations,
            solves: fit.work.solves,
            derivatives: fit.work.derivatives,
        },
    })
}

/// A name of an estimate among all: that of its parameter, with its specimen's.
pub(super) fn name(view: &FitView<'_>, estimate: &Estimate) -> String {
    let name = &view.model.parameters[estimate.parameter].name;
    match estimate.specimen {
        Some(specimen) => format!("{name} of {}", view.study.data.specimens[specimen]),
        None => name.clone(),
    }
}

fn estimates(view: &FitView<'_>, specimen: Option<usize>) -> Result<Named<EstimateDocument>, OutputError> {
    let own = view.fit.estimates.iter().filter(|estimate| estimate.specimen == specimen);
    Named::collect(own, |estimate| {
        let parameter = &view.model.parameters[estimate.parameter];
        let document = EstimateDocument {
            value: finite(estimate.value, || format!("estimates.{}.value", parameter.name))?,
            unit: parameter.unit.clone(),
            standard_error: estimate.standard_error,
            interval: estimate.interval,
            profile: estimate.profile,
            guess: estimate.guess,
            is_at_bound: estimate.is_at_bound,
        };
        Ok((parameter.name.clone(), document))
    })
}

fn combination(view: &FitView<'_>, unseen: &Unseen) -> UnseenDocument {
    let part = |(k, change): &(usize, f64)| (name(view, &view.fit.estimates[*k]), *change);
    UnseenDocument { changes: Named(unseen.parts.iter().map(part).collect()), reach: unseen.reach }
}
