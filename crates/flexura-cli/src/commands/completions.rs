//! `flexura completions SHELL`

use crate::arguments::{Arguments, CompletionsArguments};
use crate::failure::Failure;
use crate::screen;
use clap::CommandFactory;

pub fn run(arguments: &CompletionsArguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "flexura", &mut script);
    screen::print_table(&String::from_utf8_lossy(&script))
}
