//! Why a path ends, in words; and warnings along it told apart.

use super::problem::Traced;
use crate::way::AT_EDGE;
use flexura_continuation::{Place, Refusal, Stall};
use flexura_solution::BranchEnd;

/// What a path ran into whose steps became too short: the end of a boundary, a joint that locks, a corner of a law at which it turns back,
/// or values beyond that make no model.
pub(super) fn why_short(traced: &mut Traced<'_>, here: &Place) -> Option<String> {
    let mut ends = traced.problem().contact_ends();
    ends.extend(traced.problem().locked_joints());
    if !ends.is_empty() {
        return Some(ends.join(", and "));
    }
    let edges = traced.problem().edges(AT_EDGE);
    if !edges.is_empty() {
        let turns = edges.iter().any(|edge| traced.problem().turns_back_at(edge));
        let edges: Vec<String> = edges.iter().map(ToString::to_string).collect();
        let what = if turns {
            "the path turns back at that corner"
        } else {
            "the path could not be led round that corner"
        };
        return Some(format!("{}, and {what}", edges.join(", and ")));
    }
    let limit = if here.tangent.parameter > 0.0 { 1.0 } else { 0.0 };
    match traced.model_at([limit, here.point.parameters[1]]) {
        Err(Refusal::Parameter(why)) => Some(format!(
            "the steps became too short on the way to {:.6e} (SI): {why}",
            traced.axes[0].value(limit)
        )),
        _ => None,
    }
}

pub(crate) fn stalled(stall: &Stall) -> BranchEnd {
    BranchEnd::Stalled(match stall {
        Stall::Short => {
            "the steps along the path became too short: something jumps there, or many critical points lie close together"
                .to_string()
        }
        Stall::Parameter(why) => why.clone(),
    })
}

/// A warning without its numbers.
pub(super) fn kind(warning: &str) -> String {
    warning.split([' ', ',']).filter(|word| !starts_as_number(word)).collect()
}

fn starts_as_number(word: &str) -> bool {
    word.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit())
}
