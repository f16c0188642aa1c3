//! What a fit has to tell besides its estimates.

use crate::least_squares::{Loss, Minimum};
use crate::problem::Problem;
use crate::statistics::{Knowledge, student};
use flexura_model::{FitStudy, Model};
use flexura_solution::{Estimate, Fit, FittedRow, MeasuredFit, SpecimenFit, Spread, Unseen};
use std::collections::BTreeMap;

/// Relative change of an estimate within the confidence that is told as hardly determined.
const FAR: f64 = 1.0;
/// Part of a direction's largest component below which others are left out of words.
const SMALL: f64 = 1e-4;
/// Rows that a warning names.
const TOLD: usize = 3;

pub(crate) fn correlation(
    estimates: &[Estimate],
    known: Option<&Knowledge>,
    problem: &Problem<'_>,
) -> Vec<Vec<Option<f64>>> {
    let n = problem.variables.len();
    let is_known = |k: usize| estimates.get(k).is_some_and(|estimate| estimate.standard_error.is_some());
    let value = |i: usize, k: usize| {
        let known = known.filter(|_| is_known(i) && is_known(k))?;
        let size = (known.covariance[(i, i)] * known.covariance[(k, k)]).sqrt();
        (size > 0.0).then(|| (known.covariance[(i, k)] / size).clamp(-1.0, 1.0))
    };
    (0..n).map(|i| (0..n).map(|k| value(i, k)).collect()).collect()
}

/// Directions without end, and those that may go farther than the values themselves.
pub(crate) fn unseen(problem: &Problem<'_>, minimum: &Minimum, known: &Knowledge) -> Vec<Unseen> {
    let relative = |direction: &nalgebra::DVector<f64>| {
        let change = |k: usize| {
            let x = minimum.x[k];
            if x == 0.0 { direction[k] } else { direction[k] / x.abs() }
        };
        let all: Vec<f64> = (0..direction.len()).map(change).collect();
        let largest =
            all.iter().fold(0.0_f64, |largest, v| if v.abs() > largest.abs() { *v } else { largest });
        let parts = all.iter().enumerate().filter(|(_, v)| v.abs() > SMALL * largest.abs());
        (parts.map(|(k, v)| (k, v / largest)).collect::<Vec<_>>(), largest.abs())
    };
    let mut found: Vec<Unseen> =
        known.unseen.iter().map(|direction| Unseen { parts: relative(direction).0, reach: None }).collect();
    let Some(t) = student(problem.study.confidence, known.freedom) else { return found };
    for (direction, deviation) in &known.weak {
        let (parts, largest) = relative(direction);
        let reach = t * deviation * largest;
        if reach > FAR {
            found.push(Unseen { parts, reach: Some(reach) });
        }
    }
    found.retain(|unseen| !unseen.parts.is_empty());
    found
}

/// What the model says in every row at the estimates, and how well each output is met by those that count.
pub(crate) fn rows(
    problem: &mut Problem<'_>,
    minimum: &Minimum,
    loss: Loss,
) -> (Vec<FittedRow>, Vec<MeasuredFit>) {
    let data = &problem.study.data;
    let count = data.measured.len();
    let mut known: Vec<Option<Vec<Option<f64>>>> = vec![None; data.rows.len()];
    // Rows of which everything was measured are known by their residuals.
    for (place, residual) in problem.places().iter().zip(&minimum.residuals) {
        let measured = &data.rows[place.row].measured;
        if let Some(value) = measured[place.column].filter(|_| measured.iter().all(Option::is_some)) {
            let computed = known[place.row].get_or_insert_with(|| vec![None; count]);
            computed[place.column] = Some(value + residual * problem.unit_of(*place));
        }
    }
    let others: Vec<usize> = (0..known.len()).filter(|row| known[*row].is_none()).collect();
    if !minimum.residuals.is_empty() {
        let answers = problem.answers(&minimum.x, &others, false);
        for (row, answer) in others.iter().zip(answers) {
            known[*row] = answer.ok().map(|answer| problem.computed(&answer));
        }
    }
    let mut rows = Vec::with_capacity(known.len());
    let mut pairs: Vec<Vec<(usize, f64, f64)>> = vec![Vec::new(); count];
    for (row, computed) in known.into_iter().enumerate() {
        let computed = computed.unwrap_or_default();
        let mut weights = vec![1.0; count];
        for (column, computed) in computed.iter().enumerate() {
            let (Some(measured), Some(computed)) = (data.rows[row].measured[column], computed) else {
                continue;
            };
            let unit = problem.unit_of(crate::problem::Place { row, column });
            weights[column] = if unit.is_finite() { loss.weight((computed - measured) / unit) } else { 0.0 };
            if problem.is_active[row] {
                pairs[column].push((row, measured, *computed));
            }
        }
        rows.push(FittedRow { computed, weights });
    }
    let measured = pairs.into_iter().map(|pairs| {
        let n = pairs.len().max(1) as f64;
        let mean = pairs.iter().map(|(_, y, _)| y).sum::<f64>() / n;
        let squares: f64 = pairs.iter().map(|(_, y, f)| (y - f).powi(2)).sum();
        let total: f64 = pairs.iter().map(|(_, y, _)| (y - mean).powi(2)).sum();
        let largest = pairs.iter().map(|(row, y, f)| (y - f, *row));
        MeasuredFit {
            count: pairs.len(),
            deviation: (squares / n).sqrt(),
            largest: largest.fold((0.0, 0), |a: (f64, usize), b| if b.0.abs() > a.0.abs() { b } else { a }),
            r_squared: (total > 0.0).then(|| 1.0 - squares / total),
        }
    });
    (rows, measured.collect())
}

pub(crate) fn spread(estimates: &[Estimate], specimens: &[SpecimenFit]) -> Vec<Spread> {
    let mut values: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for estimate in estimates {
        let Some(specimen) = estimate.specimen else { continue };
        if specimens[specimen].values > 0 && !specimens[specimen].is_rejected {
            values.entry(estimate.parameter).or_default().push(estimate.value);
        }
    }
    let spread = |(parameter, values): (usize, Vec<f64>)| {
        let n = values.len();
        let mean = values.iter().sum::<f64>() / n as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let deviation = if n > 1 { (squares / (n - 1) as f64).sqrt() } else { 0.0 };
        Spread { parameter, mean, deviation, count: n }
    };
    values.into_iter().map(spread).collect()
}

pub(crate) fn warnings(model: &Model, study: &FitStudy, fit: &Fit) -> Vec<String> {
    let mut warnings = Vec::new();
    let name = |estimate: usize| {
        let estimate = &fit.estimates[estimate];
        let name = &model.parameters[estimate.parameter].name;
        match estimate.specimen {
            Some(specimen) => format!("`{name}` of {}", study.data.specimens[specimen]),
            None => format!("`{name}`"),
        }
    };
    for unseen in &fit.unseen {
        let moves: Vec<String> = unseen
            .parts
            .iter()
            .map(|(k, change)| {
                let verb = if *change > 0.0 { "raising" } else { "lowering" };
                format!("{verb} {} by {:.3} %", name(*k), change.abs())
            })
            .collect();
        let both = if moves.len() > 1 { " at once" } else { "" };
        warnings.push(match unseen.reach {
            None => format!(
                "the data do not see one combination of the unknowns: {}{both} changes nothing that was measured; \
                 fix one of them, or measure something else",
                moves.join(", ")
            ),
            Some(reach) => format!(
                "the data hardly see one combination of the unknowns: {}{both} may go on to {:.0} % within the confidence; \
                 measure more, or something else",
                moves.join(", "),
                100.0 * reach
            ),
        });
    }
    let mut reasons: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (row, reason) in &fit.left_out {
        reasons.entry(reason).or_default().push(study.data.rows[*row].line);
    }
    for (reason, lines) in reasons {
        let shown: Vec<String> = lines.iter().take(TOLD).map(usize::to_string).collect();
        let more = lines.len().saturating_sub(TOLD);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let word = if lines.len() == 1 { "line" } else { "lines" };
        warnings.push(format!("{word} {}{more} left out: {reason}", shown.join(", ")));
    }
    for (specimen, verdict) in fit.specimens.iter().enumerate() {
        let Some(distance) = verdict.distance.filter(|distance| *distance > 1.0) else { continue };
        let what =
            if verdict.is_rejected { "is left out" } else { "counts nevertheless; `reject` leaves it out" };
        warnings.push(format!(
            "specimen `{}` lies outside what the others predict, at {distance:.2} times the limit at {} %; it {what}",
            study.data.specimens[specimen],
            100.0 * study.confidence
        ));
    }
    for (k, estimate) in fit.estimates.iter().enumerate() {
        let is_rejected = estimate.specimen.is_some_and(|specimen| fit.specimens[specimen].is_rejected);
        if estimate.is_at_bound && !is_rejected {
            warnings.push(format!("{} stands at one of its bounds, and has no interval there", name(k)));
        }
    }
    if fit.freedom == 0 && fit.status == flexura_solution::Status::Converged {
        warnings
            .push("there are as many values as unknowns, so that nothing is known of the noise".to_string());
    }
    warnings
}
