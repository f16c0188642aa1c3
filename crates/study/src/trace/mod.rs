//! Paths of equilibria in one parameter: `problem` is the mechanism as the path's follower sees it, `leg` follows one branch one
//! way, `record` makes points of states, `branches` follows what is met, `search` finds what hangs together with nothing,
//! `critical` follows critical points in a second parameter.

mod branches;
mod buckle;
mod critical;
mod ends;
mod leg;
mod line;
mod path;
mod pencil;
mod problem;
mod record;
mod ritz;
mod search;

use flexura_solution::TracePoint;

pub use branches::{trace, trace_family};
pub use buckle::{buckle, buckle_family};
pub(crate) use record::normalise;

/// How far a trace has come.
#[derive(Clone, Copy, Debug)]
pub struct TraceProgress<'a> {
    /// Number of the branch that is being followed.
    pub branch: usize,
    /// Points on it so far.
    pub points: usize,
    /// Value of the parameter at the last of them, SI.
    pub parameter: f64,
    /// Points of the branch that were not told before, in the order in which they were found; of a critical curve none.
    pub found: &'a [TracePoint],
}

/// Does a study fit its model?
///
/// # Errors
/// The first thing that is wrong with it, under the path `study`.
pub fn check_study(
    model: &flexura_model::Model,
    kind: flexura_model::StudyKind,
) -> Result<(), crate::ProblemError> {
    let study = flexura_model::Study { name: "study".to_string(), kind };
    match model.study_issues(&study).into_iter().next() {
        Some(issue) => Err(crate::ProblemError::new("study", issue.message, issue.hint.unwrap_or_default())),
        None => Ok(()),
    }
}
