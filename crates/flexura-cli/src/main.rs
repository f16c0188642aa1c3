//! The `flexura` command: one file for each sub-command, and the only place in flexura that prints.
//!
//! Standard output carries results, standard error everything else. Exit codes: 0 converged, 1 the solver
//! did not converge, 2 the input is wrong, 3 the machine failed, 130 somebody ended it.

mod answer;
mod arguments;
mod buckling_summary;
mod commands;
mod derivatives;
mod design_summary;
mod failure;
mod files;
mod fit_summary;
mod formula_summary;
mod frequencies_summary;
mod interrupt;
mod modes_summary;
mod motion_summary;
mod page;
mod progress;
mod quantity;
mod screen;
mod shown;
mod summary;
mod table;
mod trace_summary;

use arguments::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        report(panic);
        screen::complain(
            "this is a bug in flexura; please report it with the model file and the lines above",
        );
    }));
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(help) => return screen::help(&help),
    };
    let result = match arguments.command {
        Command::Solve(arguments) => commands::solve::run(&arguments),
        Command::Trace(arguments) => commands::trace::run(&arguments),
        Command::Buckle(arguments) => commands::buckle::run(&arguments),
        Command::Fit(arguments) => commands::fit::run(&arguments),
        Command::Formula(arguments) => commands::formula::run(&arguments),
        Command::Optimise(arguments) => commands::optimise::run(&arguments),
        Command::Modes(arguments) => commands::modes::run(&arguments),
        Command::Run(arguments) => commands::run::run(&arguments),
        Command::Sweep(arguments) => commands::sweep::run(&arguments),
        Command::Check(arguments) => commands::check::run(&arguments),
        Command::Examples(arguments) => commands::examples::run(&arguments),
        Command::Verify(arguments) => commands::verify::run(&arguments),
        Command::View(arguments) => commands::view::run(&arguments),
        Command::Materials(arguments) => commands::materials::run(&arguments),
        Command::Schema => commands::schema::run(),
        Command::Completions(arguments) => commands::completions::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            screen::complain(&failure.to_string());
            failure.exit_code()
        }
    }
}
