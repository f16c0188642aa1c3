//! What is written of frequencies along a path: document and table.

use crate::document::{finite, parameters};
use crate::trace::{cell, headed, inside, line, parameter_of};
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_solution::{Followed, ModesAlong, Onset};
use serde::Serialize;
use std::f64::consts::TAU;

/// Frequencies along a path of equilibria.
#[derive(Clone, Debug, Serialize)]
pub struct FrequenciesDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// "converged", or how else the path ended.
    pub status: String,
    /// Why it did not end where it was to, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// The parameter that changes.
    pub parameter: String,
    /// Values between which it does.
    pub range: [f64; 2],
    /// The other parameters.
    pub parameters: Named<f64>,
    /// The branches of the path.
    pub branches: Vec<FrequencyBranch>,
}

/// A branch of the path.
#[derive(Clone, Debug, Serialize)]
pub struct FrequencyBranch {
    /// Its points in order.
    pub points: Vec<FrequencyPoint>,
    /// Where along it modes begin to grow, or end, in order.
    pub onsets: Vec<OnsetDocument>,
}

/// Where the number of modes that grow changes.
#[derive(Clone, Debug, Serialize)]
pub struct OnsetDocument {
    /// Value of the parameter.
    pub parameter: f64,
    /// "flutter" (what grows swings) or "divergence" (it does not).
    pub kind: String,
    /// Do more grow beyond, along the branch?
    pub begins: bool,
    /// Circular frequency there, rad/s; zero of a divergence.
    pub rate: f64,
    /// Estimated relative error of the value.
    pub error_estimate: f64,
}

/// A point of the path.
#[derive(Clone, Debug, Serialize)]
pub struct FrequencyPoint {
    /// Value of the parameter.
    pub parameter: f64,
    /// Way along the branch.
    pub arc: f64,
    /// "regular", "fold", "branch", "event" or "end".
    pub kind: String,
    /// Is the equilibrium stable? Null where that is not decided.
    pub stable: Option<bool>,
    /// Number of unstable directions; null where that is not decided.
    pub unstable_directions: Option<usize>,
    /// The modes, each in the place of the one whose shape it has at the point before; null where it is not among the lowest. Empty
    /// where the point is critical.
    pub modes: Vec<Option<FrequencyDocument>>,
}

/// A mode at a point of the path.
#[derive(Clone, Debug, Serialize)]
pub struct FrequencyDocument {
    /// "swinging", "rigid", "diverging", "flutter", "decaying" or "creeping".
    pub kind: String,
    /// Circular frequency, rad/s.
    pub rate: f64,
    /// 1/s; positive where it grows.
    pub growth: f64,
    /// Estimated relative error of both.
    pub error_estimate: f64,
}

/// The result document of frequencies along a path.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn frequencies_document(model: &Model, along: &ModesAlong) -> Result<FrequenciesDocument, OutputError> {
    let trace = &along.trace;
    let mode = |own: &Followed| -> Result<FrequencyDocument, OutputError> {
        Ok(FrequencyDocument {
            kind: own.kind.word().to_owned(),
            rate: finite(own.rate, || "rate".into())?,
            growth: finite(own.growth, || "growth".into())?,
            error_estimate: finite(own.error_estimate, || "error_estimate".into())?,
        })
    };
    let mut branches = Vec::with_capacity(trace.branches.len());
    let met = along.onsets.iter().map(Vec::as_slice).chain(std::iter::repeat(&[][..]));
    for (b, ((branch, rows), met)) in trace.branches.iter().zip(&along.followed).zip(met).enumerate() {
        let mut points = Vec::with_capacity(branch.points.len());
        for (p, (point, row)) in branch.points.iter().zip(rows).enumerate() {
            let path = format!("branches[{b}].points[{p}]");
            let modes = row.iter().map(|own| own.as_ref().map(mode).transpose());
            let modes = modes.collect::<Result<_, _>>().map_err(|error| inside(&path, error))?;
            points.push(FrequencyPoint {
                parameter: finite(point.parameter, || format!("{path}.parameter"))?,
                arc: finite(point.arc, || format!("{path}.arc"))?,
                kind: point.kind.word().to_owned(),
                stable: point.stable,
                unstable_directions: point.unstable_directions,
                modes,
            });
        }
        let onsets =
            met.iter().map(|own| onset(own).map_err(|error| inside(&format!("branches[{b}]"), error)));
        branches.push(FrequencyBranch { points, onsets: onsets.collect::<Result<_, _>>()? });
    }
    Ok(FrequenciesDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "modes".to_owned(),
        status: trace.status.word().to_owned(),
        reason: trace.reason.clone(),
        warnings: trace.warnings.clone(),
        parameter: parameter_of(model, Some(trace.parameter)).0.to_owned(),
        range: trace.range,
        parameters: parameters(model)?,
        branches,
    })
}

fn onset(own: &Onset) -> Result<OnsetDocument, OutputError> {
    Ok(OnsetDocument {
        parameter: finite(own.parameter, || "onset".into())?,
        kind: own.kind.word().to_owned(),
        begins: own.begins,
        rate: finite(own.rate, || "onset.rate".into())?,
        error_estimate: finite(own.error_estimate, || "onset.error_estimate".into())?,
    })
}

/// `frequencies.csv`: a row for every point, with frequency (Hz) and growth (1/s) of every mode.
///
/// # Errors
/// As [`frequencies_document`].
pub fn frequencies_csv(model: &Model, along: &ModesAlong) -> Result<String, OutputError> {
    let trace = &along.trace;
    let (name, unit) = parameter_of(model, Some(trace.parameter));
    let most = along.followed.iter().flatten().map(Vec::len).max().unwrap_or(0);
    let mut heading = vec!["branch".to_owned(), "point".to_owned(), "kind".to_owned(), headed(name, unit)];
    for mode in 1..=most {
        heading.extend([format!("frequency_{mode} [Hz]"), format!("growth_{mode} [1/s]")]);
    }
    let mut text = line(heading);
    for (b, (branch, rows)) in trace.branches.iter().zip(&along.followed).enumerate() {
        for (p, (point, row)) in branch.points.iter().zip(rows).enumerate() {
            let path = || format!("branches[{b}].points[{p}]");
            let mut cells = vec![(b + 1).to_string(), (p + 1).to_string(), point.kind.word().to_owned()];
            cells.push(cell(point.parameter, path)?);
            for mode in 0..most {
                match row.get(mode).and_then(Option::as_ref) {
                    Some(own) => cells.extend([cell(own.rate / TAU, path)?, cell(own.growth, path)?]),
                    None => cells.extend([String::new(), String::new()]),
                }
            }
            text += &line(cells);
        }
    }
    Ok(text)
}
