//! Why a command ends otherwise than well, and the exit code that says so.

use flexura::solution::Status;
use std::fmt;
use std::process::ExitCode;

/// The end of a command that did not do what was asked.
#[derive(Debug)]
pub enum Failure {
    /// The solver did not converge; what it reached has been printed and written.
    NotConverged(String),
    /// The input is wrong.
    Input(String),
    /// Reading or writing failed.
    Machine(String),
    /// Somebody asked for the end; what was found until then has been printed and written.
    Interrupted(String),
}

/// The exit code of a command that somebody ended.
pub const INTERRUPTED: u8 = 130;

impl Failure {
    /// The end of a study with that status; None where it converged. `reason` says why, and what to try.
    pub fn of(status: Status, reason: Option<&str>) -> Option<Self> {
        let word = status.word().replace('_', " ");
        let message = match (status, reason) {
            (Status::Converged, _) => return None,
            (Status::Interrupted, reason) => {
                return Some(Failure::Interrupted(reason.unwrap_or("interrupted").to_owned()));
            }
            (_, Some(reason)) => format!("not converged, {word}: {reason}"),
            (_, None) => format!("not converged, {word}"),
        };
        Some(Failure::NotConverged(message))
    }

    pub fn exit_code(&self) -> ExitCode {
        match self {
            Failure::NotConverged(_) => ExitCode::from(1),
            Failure::Input(_) => ExitCode::from(2),
            Failure::Machine(_) => ExitCode::from(3),
            Failure::Interrupted(_) => ExitCode::from(INTERRUPTED),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Failure::NotConverged(message)
        | Failure::Input(message)
        | Failure::Machine(message)
        | Failure::Interrupted(message)) = self;
        formatter.write_str(message)
    }
}
