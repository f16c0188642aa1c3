//! Does a specimen agree with the others?
//!
//! Where all specimens share the unknowns, one of them is compared with what the others predict: with S the sum of squares of all
//! and S' the least one of the others, ((S - S')/n)/(S'/f') follows F(n, f') where it is one of them; n are its values, f' what is
//! left of the others' beside the unknowns. S' is that of the linearised problem. Where each has its own value of an unknown, that
//! value is compared with the interval in which the next one lies, given the others: mean ± t s √(1 + 1/m).

use crate::least_squares::{Loss, Minimum};
use crate::problem::Problem;
use crate::statistics::{fisher, student};
use flexura_solution::SpecimenFit;
use nalgebra::{DMatrix, DVector};

pub(crate) fn is_outside(verdict: &SpecimenFit) -> bool {
    verdict.distance.is_some_and(|distance| distance > 1.0)
}

/// One for each specimen.
pub(crate) fn verdicts(
    problem: &Problem<'_>,
    minimum: &Minimum,
    loss: Loss,
    held: &[bool],
) -> Vec<SpecimenFit> {
    let names = &problem.study.data.specimens;
    let of: Vec<usize> =
        problem.places().iter().map(|place| problem.study.data.rows[place.row].specimen).collect();
    let has_own = problem.variables.iter().any(|variable| variable.specimen.is_some());
    let free: Vec<usize> = (0..minimum.x.len()).filter(|k| !held[*k]).collect();
    let verdict = |specimen: usize| {
        let own: Vec<usize> =
            (0..of.len().min(minimum.residuals.len())).filter(|i| of[*i] == specimen).collect();
        let sum: f64 = own.iter().map(|i| minimum.residuals[*i].powi(2)).sum();
        let distance = match (names.len() > 1 && !own.is_empty(), has_own) {
            (false, _) => None,
            (true, true) => among_values(problem, minimum, specimen),
            (true, false) => among_residuals(problem, minimum, loss, &free, &own),
        };
        let scatter = (sum / own.len().max(1) as f64).sqrt();
        SpecimenFit { values: own.len(), scatter, distance, is_rejected: false }
    };
    (0..names.len()).map(verdict).collect()
}

/// By the values of its own unknowns, the farthest of them.
fn among_values(problem: &Problem<'_>, minimum: &Minimum, specimen: usize) -> Option<f64> {
    let mut farthest: Option<f64> = None;
    for (k, variable) in problem.variables.iter().enumerate() {
        if variable.specimen != Some(specimen) {
            continue;
        }
        let others: Vec<f64> = problem
            .variables
            .iter()
            .zip(&minimum.x)
            .filter(|(other, _)| other.parameter == variable.parameter && other.specimen != Some(specimen))
            .map(|(_, x)| *x)
            .collect();
        let m = others.len();
        if m < 2 {
            return None;
        }
        let mean = others.iter().sum::<f64>() / m as f64;
        let deviation = (others.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (m - 1) as f64).sqrt();
        let reach = student(problem.study.confidence, m - 1)? * deviation * (1.0 + 1.0 / m as f64).sqrt();
        let distance = (minimum.x[k] - mean).abs() / reach.max(f64::MIN_POSITIVE);
        farthest = Some(farthest.map_or(distance, |known| known.max(distance)));
    }
    farthest
}

/// By its residuals.
fn among_residuals(
    problem: &Problem<'_>,
    minimum: &Minimum,
    loss: Loss,
    free: &[usize],
    own: &[usize],
) -> Option<f64> {
    // By the weights of the loss, so that outliers of the others do not hide it.
    let root: Vec<f64> = minimum.residuals.iter().map(|r| loss.weight(*r).sqrt()).collect();
    let others: Vec<usize> = (0..minimum.residuals.len()).filter(|i| !own.contains(i)).collect();
    let freedom = others.len().checked_sub(free.len()).filter(|freedom| *freedom > 0)?;
    let part = |rows: &[usize]| {
        let matrix = DMatrix::from_fn(rows.len(), free.len(), |i, k| {
            root[rows[i]] * minimum.jacobian[(rows[i], free[k])]
        });
        let residuals = DVector::from_fn(rows.len(), |i, _| root[rows[i]] * minimum.residuals[rows[i]]);
        (matrix, residuals)
    };
    let (matrix, residuals) = part(&others);
    let (own_matrix, own_residuals) = part(own);
    // The step of the others' minimum from the common one.
    let normal = matrix.tr_mul(&matrix).cholesky()?;
    let step = -normal.solve(&matrix.tr_mul(&residuals));
    let least = (residuals + &matrix * &step).norm_squared();
    // What it is off by, in the metric of its own noise and of that of the prediction.
    let off = own_residuals + &own_matrix * step;
    let spread =
        DMatrix::identity(own.len(), own.len()) + &own_matrix * normal.solve(&own_matrix.transpose());
    let square = off.dot(&spread.cholesky()?.solve(&off));
    let ratio = square / own.len() as f64 / (least / freedom as f64).max(f64::MIN_POSITIVE);
    Some((ratio / fisher(problem.study.confidence, own.len(), freedom)?).sqrt())
}
