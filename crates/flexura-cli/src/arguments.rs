//! What can be typed behind `flexura`.

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Large-deflection compliant mechanisms: beams, bodies, joints and springs in equilibrium.
#[derive(Parser)]
#[command(
    name = "flexura",
    version,
    after_help = "Start with:\n  flexura examples                        the bundled models\n  flexura examples cantilever_strip       write one of them here\n  flexura solve cantilever_strip.toml     solve it\n  flexura sweep cantilever_strip.toml --vary payload=\"10 g:50 g:5\"\n  flexura trace sensor_clamp.toml --parameter push --range \"0 N:20 N\"\n\nExit codes: 0 converged, 1 not converged, 2 wrong input, 3 the machine failed, 130 interrupted: what was found is kept."
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand)]
pub enum Command {
    /// Find the equilibrium and print outputs, stresses and poses
    Solve(SolveArguments),
    /// Follow the equilibria as one parameter changes: folds, branch points, stability
    Trace(TraceArguments),
    /// Find critical loads and the shapes in which the mechanism buckles
    Buckle(BuckleArguments),
    /// Find unknown parameters from measurements, with their intervals and what the data do not tell
    Fit(FitArguments),
    /// Find the formula of a study that repeats an output, and write it for a controller
    Formula(FormulaArguments),
    /// Choose parameters so that an objective is least or greatest under constraints
    Optimise(OptimiseArguments),
    /// Find natural frequencies and the shapes in which the mechanism swings
    Modes(ModesArguments),
    /// Do the studies that are written in the file
    Run(RunArguments),
    /// Solve over a grid of parameters, on all cores, into one table
    Sweep(SweepArguments),
    /// Say what a model is, unknowns against equations, without solving it
    Check(CheckArguments),
    /// List the bundled models, or write one of them here
    Examples(ExamplesArguments),
    /// List the library of materials, with their sources, or tell one of them
    Materials(MaterialsArguments),
    /// Compare answers with what is known: closed forms, published numbers, other methods
    Verify(VerifyArguments),
    /// Write the page that shows a result, and open it in the browser
    View(ViewArguments),
    /// Print the JSON Schema of model files, for editors
    Schema,
    /// Print a completion script for a shell
    Completions(CompletionsArguments),
}

/// Which model.
#[derive(Args)]
pub struct ModelArguments {
    /// The model file (TOML)
    pub file: PathBuf,
    /// Override a parameter, e.g. --set push="3.2 N"; may be repeated
    #[arg(long = "set", value_name = "P=VALUE", value_parser = parameter_override)]
    pub overrides: Vec<(String, String)>,
    /// Print the result document (JSON) on standard output and nothing else
    #[arg(long)]
    pub json: bool,
    /// Print no summary, no warnings and no progress, only errors
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Args, Clone)]
pub struct ShownArguments {
    /// Write one HTML page that shows the result, with all that it needs
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Put the solver into the page too: it solves again as values are moved, things dragged or the file changed in it
    #[arg(long)]
    pub live: bool,
    /// Write a still picture of the result
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write the same picture as pixels
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
}

#[derive(Args)]
pub struct SolveArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Write result.json, beams.csv, model.vtp, shape.svg and report.html into this folder
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Print how every output depends on every parameter: derivative, and per cent per per cent in brackets
    #[arg(long)]
    pub sensitivity: bool,
    /// Print how a place moves under small loads there: body.NAME, beam.NAME.start, beam.NAME.end, "beam.NAME[0.5]",
    /// "beam.NAME[30 mm]"; may be repeated
    #[arg(long, value_name = "PLACE")]
    pub compliance: Vec<String>,
    /// Start from an earlier result (result.json) of the same beams, bodies and joints, in place of the rest state
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    /// Look for other equilibria under the same load from this many random states
    #[arg(long, value_name = "N")]
    pub guesses: Option<usize>,
    /// Seed of the random states; the same seed finds the same equilibria [default: 0]
    #[arg(long, value_name = "S", requires = "guesses")]
    pub seed: Option<u64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct TraceArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The parameter that changes
    #[arg(long, value_name = "P")]
    pub parameter: String,
    /// Values between which the path is followed, with units: "0 N:40 N"; the first may be the larger
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    pub range: String,
    /// Where the path starts, from rest; inside the range it is followed both ways [default: A]
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    pub start: Option<String>,
    /// About how many points a path has at least that goes straight from A to B [default: 40]
    #[arg(long, value_name = "N")]
    pub steps: Option<String>,
    /// Most points of one branch [default: 2000]
    #[arg(long, value_name = "N")]
    pub most_points: Option<String>,
    /// Follow the branches that are met at branch points, at most N, 20 unless given [default: none]
    #[arg(long, value_name = "N", num_args = 0..=1)]
    pub branches: Option<Option<String>>,
    /// Find where a result has a value: "output.w = 10 mm", "joint.way.effort = 0"; may be repeated
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    pub event: Vec<String>,
    /// End branches at an event, or at the n-th fold, branch point or event: "output.w = 30 mm", fold, "fold 2",
    /// "branch 1", "event 3"; may be repeated
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub stop: Vec<String>,
    /// Look for branches that hang together with no other by this many random pushes at both ends [default: 0]
    #[arg(long, value_name = "N")]
    pub guesses: Option<String>,
    /// Look for such a branch by leading another parameter from a value that breaks a symmetry to its own
    #[arg(long, value_name = "P=V")]
    pub imperfection: Option<String>,
    /// Follow a fold or branch point as a second parameter changes
    #[arg(long, value_name = "P=A:B")]
    pub critical: Option<String>,
    /// Which of the folds and branch points found, counted from 1 [default: 1]
    #[arg(long, value_name = "N", requires = "critical")]
    pub critical_number: Option<String>,
    /// Write result.json, path.csv, diagram.svg, shapes.svg and report.html into this folder, and critical.csv with --critical
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct BuckleArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The parameter whose critical values are wanted [default: all loads and drives in proportion]
    #[arg(long, value_name = "P")]
    pub parameter: Option<String>,
    /// Its value at the equilibrium about which the problem is linearised; without a parameter, the fraction of the load
    /// [default: 0]
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// How many critical values, those nearest to V first [default: 3]
    #[arg(long, value_name = "N")]
    pub count: Option<String>,
    /// Write result.json, modes.csv, shapes.svg and report.html into this folder
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct FitArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The study [default: what the flags say, or the first fit of the file]
    pub study: Option<String>,
    /// The measurements (CSV): columns bear the names of parameters, which are set for the row, and of outputs, which were
    /// measured, with their units: `pull [N], tip [mm]`; `specimen` and `weight` may stand beside them
    #[arg(long, value_name = "FILE")]
    pub data: Option<PathBuf>,
    /// A parameter to be found; may be repeated
    #[arg(long, value_name = "P")]
    pub unknown: Vec<String>,
    /// A parameter to be found for each specimen; may be repeated
    #[arg(long, value_name = "P")]
    pub per_specimen: Vec<String>,
    /// Values between which a parameter is looked for, e.g. --bounds young="1 GPa:10 GPa"; may be repeated
    #[arg(long, value_name = "P=A:B")]
    pub bounds: Vec<String>,
    /// Standard deviation of a measured output, e.g. --noise tip="0.1 mm"; may be repeated
    #[arg(long, value_name = "O=V")]
    pub noise: Vec<String>,
    /// What a residual costs: squares, huber, soft_l1 or cauchy [default: squares]
    #[arg(long, value_name = "L")]
    pub loss: Option<String>,
    /// What intervals are found by: linear, or profile besides [default: linear]
    #[arg(long, value_name = "I")]
    pub intervals: Option<String>,
    /// Probability that an interval holds the true value [default: 0.95]
    #[arg(long, value_name = "C")]
    pub confidence: Option<String>,
    /// Leave out specimens that lie outside what the others predict
    #[arg(long)]
    pub reject: bool,
    /// Write the model with the estimates as its parameters
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
    /// Write result.json, residuals.csv, fit.svg and fitted.toml into this folder
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy of each equilibrium, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct FormulaArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The study [default: the first formula of the file]
    pub study: Option<String>,
    /// Write the formula: as .toml, .csv, .h (C) or .rs (Rust); may be repeated
    #[arg(long, value_name = "FILE")]
    pub write: Vec<PathBuf>,
    /// Write result.json, points.csv, formula.svg and the formula as .toml, .h and .rs into this folder
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy of each equilibrium, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct OptimiseArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The study of the kind `optimise` [default: the first of the file]
    pub study: Option<String>,
    /// Write the model with the values of the optimum into this file
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
    /// Write result.json, history.csv, shape.svg and report.html into this folder, and front.csv with two objectives
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct ModesArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// How many modes, the lowest first [default: 6]
    #[arg(long, value_name = "N")]
    pub count: Option<String>,
    /// About the state at rest without any load, in place of the equilibrium
    #[arg(long)]
    pub at_rest: bool,
    /// Follow the frequencies along the path of equilibria as this parameter changes
    #[arg(long, value_name = "P", requires = "range")]
    pub parameter: Option<String>,
    /// Values between which it changes, with units: "0 N:40 N"; the first may be the larger
    #[arg(long, value_name = "A:B", requires = "parameter", allow_hyphen_values = true)]
    pub range: Option<String>,
    /// About how many points the path has at least [default: 40]
    #[arg(long, value_name = "N", requires = "parameter")]
    pub steps: Option<String>,
    /// Write result.json, modes.csv, shapes.svg and report.html into this folder; along a path frequencies.csv and frequencies.svg
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// About the equilibrium of an earlier result (result.json) of the same beams, bodies and joints, or the one next to it
    #[arg(long, value_name = "RESULT", conflicts_with_all = ["at_rest", "parameter"])]
    pub from: Option<PathBuf>,
    /// Write the linear model about the equilibrium for control: A, B, C, D as .json, .csv or .mat, or its frequency response as .svg;
    /// may be repeated
    #[arg(long, value_name = "FILE", conflicts_with = "parameter")]
    pub state_space: Vec<PathBuf>,
    /// An input of it: load.NAME, load.NAME.force.x, load.NAME.moment.z or ground.acceleration.y; may be repeated [default: the
    /// components of all loads]
    #[arg(long, value_name = "I", requires = "state_space")]
    pub input: Vec<String>,
    /// An output of it: NAME, NAME.x, NAME.velocity or NAME.x.acceleration; may be repeated [default: all outputs]
    #[arg(long, value_name = "O", requires = "state_space")]
    pub measure: Vec<String>,
    /// Damping of every mode in it beside the model's own, as a part of critical damping [default: 0]
    #[arg(long, value_name = "Z", requires = "state_space", allow_negative_numbers = true)]
    pub damping_ratio: Option<f64>,
    /// Residual vectors for each of its inputs, which join the modes where static correction is not enough [default: as few as bring
    /// the response within 1e-6, up to 3]
    #[arg(long, value_name = "N", requires = "state_space")]
    pub residual_vectors: Option<usize>,
    /// Wanted accuracy of the equilibrium, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct RunArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// The study [default: all of the file, in their order]
    pub study: Option<String>,
    /// Write the files of every study into a folder of its name in this one
    #[arg(long, short = 'o', value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct SweepArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Vary a parameter: from, to and how many (push="0 N:10 N:11"), or a list (push="1 N,2 N,5 N"); repeated, every
    /// combination is solved, the last one's values next to each other
    #[arg(long, value_name = "P=A:B:N", required = true)]
    pub vary: Vec<String>,
    /// Write the table (CSV) into this file and not on standard output
    #[arg(long, short = 'o', value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Solve so many samples at a time [default: as many as there are cores]
    #[arg(long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Wanted accuracy, relative to the beam's length, 1 rad, EI/L² and EI/L [default: 1e-8]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub shown: ShownArguments,
}

#[derive(Args)]
pub struct CheckArguments {
    #[command(flatten)]
    pub model: ModelArguments,
}

#[derive(Args)]
pub struct ExamplesArguments {
    /// The model to write into the current folder
    pub name: Option<String>,
    /// Overwrite a file of that name
    #[arg(long, requires = "name")]
    pub force: bool,
}

#[derive(Args)]
pub struct MaterialsArguments {
    /// Only this one
    pub name: Option<String>,
    /// As JSON, SI units
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub struct VerifyArguments {
    /// Parts of the names of cases, each shown with all that it compares [default: all cases, a line for each]
    pub names: Vec<String>,
    /// List the cases and where their references come from, and run none
    #[arg(long)]
    pub list: bool,
    /// Print a document (JSON) on standard output and nothing else
    #[arg(long)]
    pub json: bool,
    /// Print failures only
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Args)]
pub struct ViewArguments {
    /// The result document (result.json) of any study; several with --live, to be chosen from in the page
    #[arg(required = true)]
    pub results: Vec<PathBuf>,
    /// Write the page into this file [default: beside the result, with the ending .html]
    #[arg(long, short = 'o', value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Put the solver into the page too, which then solves again as things are moved, dragged or rewritten in it
    #[arg(long)]
    pub live: bool,
    /// Write a still picture of the result; without -o nothing but pictures is written
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write the same picture as pixels
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
    /// Only write the page
    #[arg(long)]
    pub no_open: bool,
}

#[derive(Args)]
pub struct CompletionsArguments {
    /// For which shell
    pub shell: Shell,
}

fn parameter_override(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write a parameter's name, an equals sign and its value: push=3.2 or push=\"3.2 N\"".into()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text.parse().map_err(|_| "a plain number is wanted, such as 1e-8".to_owned())?;
    if tolerance.is_nan() || tolerance > 1e-1 {
        return Err("above 0.1 a result says nothing; choose between 1e-13 and 0.1".into());
    }
    if tolerance < 1e-13 {
        return Err("double precision cannot reach less than 1e-13; choose between 1e-13 and 0.1".into());
    }
    Ok(tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn an_override_keeps_its_unit_and_further_equals_signs() {
        assert_eq!(parameter_override("push = 3 N"), Ok(("push".into(), "3 N".into())));
        assert_eq!(parameter_override("a=b=c"), Ok(("a".into(), "b=c".into())));
        assert!(parameter_override("push").is_err() && parameter_override("=3").is_err());
    }

    #[test]
    fn tolerances_beyond_reason_are_refused() {
        for text in ["0", "-1", "1e-14", "0.2", "nan", "inf", "small"] {
            assert!(tolerance(text).is_err(), "{text}");
        }
        assert_eq!(tolerance("1e-10"), Ok(1e-10));
    }
}
