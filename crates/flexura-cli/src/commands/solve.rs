//! `flexura solve FILE`

use super::{file_failure, problem_failure, warn_about};
use crate::arguments::SolveArguments;
use crate::failure::Failure;
use crate::progress::Meter;
use crate::{screen, summary};
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{beams_csv, document, model_vtp, shape_svg, to_json};
use flexura::post::{Evaluation, evaluate, summarise};
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};
use std::fs;
use std::path::Path;

pub fn run(arguments: &SolveArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let mut model = file.model(&arguments.model.overrides).map_err(|report| file_failure(&report))?;
    let mut options = Options::default();
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }

    let mut meter = Meter::new(arguments.model.quiet);
    let solved = solve(&model, &options, &mut |progress| meter.update(progress));
    meter.finish();
    let solution = solved.map_err(|error| problem_failure(&file, &error))?;
    let evaluation = evaluation(&mut model, &solution)?;

    // The document is written out even when the solve did not converge: it says how far that came and why.
    let text = || -> Result<String, Failure> {
        document(&model, &solution, &evaluation)
            .and_then(|document| to_json(&document))
            .map_err(|error| unwritable(&solution, &error.to_string()))
    };
    if let Some(folder) = &arguments.output {
        write_files(folder, &text()?, &model, &solution, &evaluation)?;
    }
    if arguments.model.json {
        screen::print(&text()?)?;
    } else if !arguments.model.quiet {
        screen::print(&summary::render(&summarise(&model, &solution, &evaluation)))?;
    }
    if !arguments.model.quiet {
        warn_about(&file, &solution.warnings);
        if let Some(folder) = &arguments.output {
            screen::note(&format!(
                "wrote result.json, beams.csv, model.vtp and shape.svg into {}",
                folder.display()
            ));
        }
    }
    match solution.status {
        Status::Converged => Ok(()),
        _ => Err(not_converged(&solution)),
    }
}

/// Outputs of a state that is not the answer may have no value; they are then left out with a warning.
fn evaluation(model: &mut Model, solution: &Solution) -> Result<Evaluation, Failure> {
    match evaluate(model, solution) {
        Ok(evaluation) => Ok(evaluation),
        Err(error) if solution.status == Status::Converged => Err(Failure::Input(error.to_string())),
        Err(error) => {
            screen::warn(&format!("no outputs: {error}"));
            model.outputs.clear();
            evaluate(model, solution).map_err(|error| unwritable(solution, &error.to_string()))
        }
    }
}

fn write_files(
    folder: &Path,
    document: &str,
    model: &Model,
    solution: &Solution,
    evaluation: &Evaluation,
) -> Result<(), Failure> {
    fs::create_dir_all(folder)
        .map_err(|error| Failure::Machine(format!("cannot make the folder {}: {error}", folder.display())))?;
    let table =
        beams_csv(model, solution, evaluation).map_err(|error| unwritable(solution, &error.to_string()))?;
    let files = [
        ("result.json", document),
        ("beams.csv", &table),
        ("model.vtp", &model_vtp(model, solution, evaluation)),
        ("shape.svg", &shape_svg(model, solution)),
    ];
    for (name, text) in files {
        let path = folder.join(name);
        fs::write(&path, text)
            .map_err(|error| Failure::Machine(format!("cannot write {}: {error}", path.display())))?;
    }
    Ok(())
}

/// A result that holds a number which is none can only be one that did not converge, or a bug.
fn unwritable(solution: &Solution, message: &str) -> Failure {
    match solution.status {
        Status::Converged => {
            Failure::Machine(format!("{message}; this is a bug in flexura, please report it"))
        }
        _ => not_converged(solution),
    }
}

fn not_converged(solution: &Solution) -> Failure {
    let standstill = summary::standstill(solution.status, solution.load_fraction);
    let reason = solution.reason.as_deref().unwrap_or_else(|| advice(solution.status));
    Failure::NotConverged(format!("not converged, {standstill}: {reason}"))
}

fn advice(status: Status) -> &'static str {
    match status {
        Status::Converged => "",
        Status::Stalled => {
            "the load cannot grow further on this path; try a smaller load, or drive a joint's coordinate in its place"
        }
        Status::IterationLimit => "the work limit was reached; try a smaller load or a larger --tolerance",
        Status::Singular => "something can move without resistance here; see `flexura check`",
        Status::Inconsistent => "its joints cannot all be kept; free one, or correct their places and axes",
        Status::AccuracyLimit => "double precision gives no more here; try a larger --tolerance",
    }
}
