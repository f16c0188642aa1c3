//! The words by which documents and tables call what a trace returns.

use crate::{BranchEnd, BranchOrigin, Crossing, PointKind};

impl PointKind {
    /// The word that stands in the result document.
    pub fn word(&self) -> &'static str {
        match self {
            PointKind::Regular => "regular",
            PointKind::Fold => "fold",
            PointKind::Branch(_) => "branch",
            PointKind::Event(_) => "event",
            PointKind::End => "end",
        }
    }

    /// Is it one that was looked for: a fold, a branch point or an event?
    pub fn is_special(&self) -> bool {
        !matches!(self, PointKind::Regular | PointKind::End)
    }

    /// Does the mechanism give way without resistance there?
    pub fn is_critical(&self) -> bool {
        matches!(self, PointKind::Fold | PointKind::Branch(_))
    }

    /// How branches cross there, if they do.
    pub fn crossing(&self) -> Option<Crossing> {
        match self {
            PointKind::Branch(crossing) => Some(*crossing),
            _ => None,
        }
    }
}

impl Crossing {
    /// The word that stands in the result document.
    pub fn word(self) -> &'static str {
        match self {
            Crossing::SupercriticalPitchfork => "supercritical_pitchfork",
            Crossing::SubcriticalPitchfork => "subcritical_pitchfork",
            Crossing::Pitchfork => "pitchfork",
            Crossing::Transcritical => "transcritical",
            Crossing::Multiple(_) => "multiple",
        }
    }
}

impl BranchOrigin {
    /// The word that stands in the result document.
    pub fn word(self) -> &'static str {
        match self {
            BranchOrigin::Rest => "rest",
            BranchOrigin::Switched { .. } => "branch_point",
            BranchOrigin::Search => "search",
            BranchOrigin::Imperfection => "imperfection",
        }
    }
}

impl BranchEnd {
    /// The word that stands in the result document.
    pub fn word(&self) -> &'static str {
        match self {
            BranchEnd::Range => "range",
            BranchEnd::Stop => "stop",
            BranchEnd::Closed => "closed",
            BranchEnd::Start => "start",
            BranchEnd::PointLimit => "point_limit",
            BranchEnd::Stalled(_) => "stalled",
            BranchEnd::Interrupted => "interrupted",
        }
    }

    /// Why it cannot be followed further, where that is so.
    pub fn reason(&self) -> Option<&str> {
        match self {
            BranchEnd::Stalled(reason) => Some(reason),
            _ => None,
        }
    }
}
