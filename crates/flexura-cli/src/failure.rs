//! Why a command ends otherwise than well, and the exit code that says so.

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
}

impl Failure {
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Failure::NotConverged(_) => ExitCode::from(1),
            Failure::Input(_) => ExitCode::from(2),
            Failure::Machine(_) => ExitCode::from(3),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Failure::NotConverged(message) | Failure::Input(message) | Failure::Machine(message)) = self;
        formatter.write_str(message)
    }
}
