//! What a campaign finds.

use std::fmt;

/// Kinds of findings, the gravest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A panic, an abort, or another signal.
    Crash,
    /// `converged`, and it is wrong.
    Wrong,
    /// More than ten seconds of the processor.
    Slow,
    /// More than 1 GiB.
    Large,
    /// The second integration could not follow a converged answer.
    Unverified,
    /// The error estimate is far less than the error.
    Estimate,
    /// `solve` converged on a path on which the trace has a fold.
    PastAFold,
    /// `solve` and `trace` end in different places.
    PathDiffers,
    /// `solve` and `sweep` give different numbers.
    SweepDiffers,
    /// A stall says a fold where the trace passes or has none.
    WrongCause,
    /// `solve` converged, and the trace does not start or does not come through.
    TraceLost,
    /// The wanted accuracy was not reached.
    Accuracy,
    /// Held by its beams, joints and springs, and refused.
    Refused,
    /// Held by its loads, and refused or stalled.
    HangingLost,
    /// Something loose in it is not named.
    LooseUnnamed,
    /// It ended with another exit code than 0, 1 or 2, or with one that does not fit what it says.
    Code,
    /// It failed without a word.
    Silent,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 17] = [
        Kind::Crash,
        Kind::Wrong,
        Kind::Slow,
        Kind::Large,
        Kind::Unverified,
        Kind::Estimate,
        Kind::PastAFold,
        Kind::PathDiffers,
        Kind::SweepDiffers,
        Kind::WrongCause,
        Kind::TraceLost,
        Kind::Accuracy,
        Kind::Refused,
        Kind::HangingLost,
        Kind::LooseUnnamed,
        Kind::Code,
        Kind::Silent,
    ];

    /// A word for tables and names of files.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Crash => "crash",
            Kind::Wrong => "wrong",
            Kind::Slow => "slow",
            Kind::Large => "large",
            Kind::Unverified => "unverified",
            Kind::Estimate => "estimate",
            Kind::PastAFold => "past_a_fold",
            Kind::PathDiffers => "path_differs",
            Kind::SweepDiffers => "sweep_differs",
            Kind::WrongCause => "wrong_cause",
            Kind::TraceLost => "trace_lost",
            Kind::Accuracy => "accuracy",
            Kind::Refused => "refused",
            Kind::HangingLost => "hanging_lost",
            Kind::LooseUnnamed => "loose_unnamed",
            Kind::Code => "code",
            Kind::Silent => "silent",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.word())
    }
}

/// Something that should not be.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What kind of thing.
    pub kind: Kind,
    /// Verb and flags after which it was seen.
    pub words: String,
    /// What was seen.
    pub detail: String,
}
