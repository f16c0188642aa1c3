//! Why the way from rest to the full load ends before it.

use flexura_equilibrium::{Edge, ProblemError};
use flexura_solution::Status;
use std::fmt;

/// What ended the way, and where; loads as fractions of the full load.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// A fold: beyond it there is no equilibrium on this path.
    Fold {
        /// Where.
        load: f64,
        /// Is the mechanism driven by a coordinate, and not by loads alone?
        driven: bool,
    },
    /// A law changes its form, and no equilibrium lies beyond.
    Corner {
        /// Where.
        load: f64,
        /// Which laws.
        edges: Vec<Edge>,
    },
    /// Rolling contacts stand at the end of their boundaries.
    Boundary {
        /// Where.
        load: f64,
        /// Which contacts, and where they stand.
        ends: Vec<String>,
    },
    /// All stiffness against some motion is lost.
    Loss {
        /// Where.
        load: f64,
        /// What can move.
        what: String,
    },
    /// Forces grow beyond all bounds: what is driven or asked for cannot be reached.
    Unreachable {
        /// Where.
        load: f64,
        /// The largest force of a beam there, in EI/L².
        force: f64,
    },
    /// The load is out of all proportion, or a beam would want more integration steps than are made: which, and why.
    Excessive(String),
    /// More work than a solve may do.
    Work {
        /// Where.
        load: f64,
        /// Load steps taken and refused.
        steps: usize,
        /// Branch points that were passed.
        crossings: usize,
    },
    /// Steps became too short, and neither a fold nor anything else that ends a path was found.
    Short {
        /// Where.
        load: f64,
    },
    /// Somebody asked for the end.
    Interrupted {
        /// Where.
        load: f64,
    },
    /// The unloaded mechanism has no stiffness, and under its loads no equilibrium was found.
    NoStart(ProblemError),
}

impl Ending {
    /// The word for it in a result.
    pub fn status(&self) -> Status {
        match self {
            Ending::Excessive(_) | Ending::Work { .. } => Status::IterationLimit,
            Ending::NoStart(_) => Status::Singular,
            Ending::Interrupted { .. } => Status::Interrupted,
            _ => Status::Stalled,
        }
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |load: &f64| format!("the path from rest ends at {:.4} % of the load", 100.0 * load);
        match self {
            Ending::Fold { load, driven: false } => write!(
                f,
                "{}, at a fold (limit point) where the mechanism snaps; reduce the load, or drive the motion by a joint \
                 coordinate instead of a force",
                part(load)
            ),
            Ending::Fold { load, driven: true } => write!(
                f,
                "{}, at a fold (limit point) where the mechanism snaps though it is driven; drive it less far, or follow the \
                 path past the fold with `flexura trace`",
                part(load)
            ),
            Ending::Corner { load, edges } => {
                let edges: Vec<String> = edges.iter().map(Edge::to_string).collect();
                write!(
                    f,
                    "{}: {}, and beyond that there is no equilibrium near; reduce the load, or add what carries it then",
                    part(load),
                    edges.join(", and ")
                )
            }
            Ending::Boundary { load, ends } => {
                write!(
                    f,
                    "{}: {}; reduce the load, or give longer boundaries",
                    part(load),
                    ends.join(", and ")
                )
            }
            Ending::Loss { load, what } => {
                write!(
                    f,
                    "{}: all stiffness is lost there, {what}; hold it by something else too",
                    part(load)
                )
            }
            Ending::Unreachable { load, force } => write!(
                f,
                "{}: forces grow beyond all bounds there, to {force:.1e} EI/L²; what is driven or held further than the parts \
                 reach cannot be reached: check lengths and places, or let the beams stretch",
                part(load)
            ),
            Ending::Excessive(reason) => f.write_str(reason),
            Ending::Work { load, steps, crossings: 0 | 1 } => write!(
                f,
                "all the work that a solve may do, {steps} load steps, led to {:.4} % of the load only; look for loads or \
                 stiffnesses that are many orders of magnitude apart, or reduce the load",
                100.0 * load
            ),
            Ending::Work { load, steps, crossings } => write!(
                f,
                "all the work that a solve may do, {steps} load steps, led to {:.4} % of the load only, past {crossings} branch \
                 points, at each of which the mechanism would rather leave this symmetric path; add a small load that breaks \
                 the symmetry",
                100.0 * load
            ),
            Ending::Short { load } => write!(
                f,
                "{}: steps became too short there, and no fold, branch point or end of a boundary was found that would say \
                 why; follow the path with `flexura trace`, or reduce the load",
                part(load)
            ),
            Ending::Interrupted { load } => write!(f, "interrupted at {:.4} % of the load", 100.0 * load),
            Ending::NoStart(error) => write!(f, "{error}; {}", error.hint),
        }
    }
}
