//! `flexura solve FILE`

use super::{earlier, file_failure, problem_failure, warn_about};
use crate::arguments::SolveArguments;
use crate::failure::Failure;
use crate::progress::Meter;
use crate::table::Table;
use crate::{derivatives, quantity, screen, summary};
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{beams_csv, document, equilibrium_document, model_vtp, shape_svg, to_json};
use flexura::post::{Evaluation, PostError, Scales, evaluate_each, summarise};
use flexura::solution::{Solution, Status};
use flexura::{FileFamily, Options, equilibria, place, solve_family};
use std::fs;
use std::path::Path;

/// Positions that differ by less than this part of the mechanism's size belong to the same equilibrium.
const SAME: f64 = 1e-6;

pub fn run(arguments: &SolveArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let overrides = &arguments.model.overrides;
    let model = file.model(overrides).map_err(|report| file_failure(&report))?;
    let options = options(arguments, &model)?;

    let mut family = FileFamily::new(&file, overrides, &model);
    let mut meter = Meter::new(arguments.model.quiet);
    let solved = solve_family(&model, &mut family, &options, &mut |progress| meter.update(progress));
    meter.finish();
    let (mut solution, model) = solved.map_err(|error| problem_failure(&file, &error))?;
    let warnings = solution.warnings.clone();
    let evaluation = evaluation(&model, &mut solution);
    let others = match arguments.guesses {
        Some(guesses) => other_equilibria(arguments, &file, &model, &solution, &options, guesses)?,
        None => Vec::new(),
    };

    // The document is written out even when the solve did not converge: it says how far that came and why.
    let text = || -> Result<String, Failure> {
        let unwritable = |error: flexura::output::OutputError| unwritable(&solution, &error.to_string());
        let mut document = document(&model, &solution, &evaluation.0).map_err(unwritable)?;
        if arguments.guesses.is_some() {
            let list = others.iter().map(|(other, values)| equilibrium_document(&model, other, values));
            document.equilibria = Some(list.collect::<Result<_, _>>().map_err(unwritable)?);
        }
        to_json(&document).map_err(unwritable)
    };
    if let Some(folder) = &arguments.output {
        write_files(folder, &text()?, &model, &solution, &evaluation.0)?;
    }
    if arguments.model.json {
        screen::print(&text()?)?;
    } else if !arguments.model.quiet {
        let mut text = summary::render(&summarise(&model, &solution, &evaluation.0));
        text += &derivatives::compliances(&model, &solution, &options.compliances);
        text += &derivatives::sensitivities(&model, &solution, &evaluation.0);
        if arguments.guesses.is_some() {
            text += &equilibria_table(&solution, &others);
        }
        screen::print(&text)?;
    }
    if !arguments.model.quiet {
        warn_about(&file, &warnings);
        if let Some(folder) = &arguments.output {
            screen::note(&format!(
                "wrote result.json, beams.csv, model.vtp and shape.svg into {}",
                folder.display()
            ));
        }
    }
    let complaints: Vec<String> = evaluation.1.iter().map(ToString::to_string).collect();
    match solution.status {
        Status::Converged if complaints.is_empty() => Ok(()),
        Status::Converged => Err(Failure::Input(complaints.join("; "))),
        _ => {
            // Outputs of a state that is not the answer may well have no value.
            complaints
                .iter()
                .filter(|_| !arguments.model.quiet)
                .for_each(|complaint| screen::warn(complaint));
            Err(not_converged(&solution))
        }
    }
}

fn options(arguments: &SolveArguments, model: &Model) -> Result<Options, Failure> {
    let mut options = Options { sensitivities: arguments.sensitivity, ..Options::default() };
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }
    for text in &arguments.compliance {
        let place = place(model, text).map_err(|error| Failure::Input(format!("--compliance: {error}")))?;
        if !options.compliances.contains(&place) {
            options.compliances.push(place);
        }
    }
    if let Some(path) = &arguments.from {
        options.from = Some(Box::new(earlier::read(path, model)?));
    }
    Ok(options)
}

/// The outputs that have a value; the others become warnings of the solution and are returned.
fn evaluation(model: &Model, solution: &mut Solution) -> (Evaluation, Vec<PostError>) {
    let (evaluation, without_value) = evaluate_each(model, solution);
    solution.warnings.extend(without_value.iter().map(ToString::to_string));
    (evaluation, without_value)
}

/// All equilibria that are found under the load of the solution, which is the one from rest.
fn other_equilibria(
    arguments: &SolveArguments,
    file: &Document,
    model: &Model,
    solution: &Solution,
    options: &Options,
    guesses: usize,
) -> Result<Vec<(Solution, Evaluation)>, Failure> {
    if !model.unknowns.is_empty() && solution.status != Status::Converged {
        // Under which load is what was to be found.
        return Ok(Vec::new());
    }
    let mut model = model.clone();
    (model.unknowns, model.targets) = (Vec::new(), Vec::new());
    let options = Options { sensitivities: false, compliances: Vec::new(), from: None, ..options.clone() };
    let found = equilibria(&model, &options, guesses, arguments.seed.unwrap_or(0))
        .map_err(|error| problem_failure(file, &error))?;
    let converged = found.into_iter().filter(|other| other.status == Status::Converged);
    Ok(converged
        .map(|other| {
            let evaluation = evaluate_each(&model, &other).0;
            (other, evaluation)
        })
        .collect())
}

fn equilibria_table(solution: &Solution, others: &[(Solution, Evaluation)]) -> String {
    let Some((_, first)) = others.first() else {
        return "\nno equilibrium was found under the full load\n".to_owned();
    };
    let names = first.outputs.iter().map(|output| output.name.as_str());
    let headings: Vec<&str> =
        ["equilibria", "strain energy"].into_iter().chain(names).chain(["stable", ""]).collect();
    let mut table = Table::new(&headings);
    for (i, (other, evaluation)) in others.iter().enumerate() {
        let scales = Scales::of(other);
        let mut row = vec![(i + 1).to_string(), quantity::quantity(other.energy, "J", 6)];
        row.extend(headings[2..headings.len() - 2].iter().map(|name| {
            let output = evaluation.outputs.iter().find(|output| output.name == *name);
            output.map_or_else(|| "-".to_owned(), |output| summary::output_value(output, &scales))
        }));
        row.push(match other.stable {
            Some(true) => "yes".to_owned(),
            Some(false) => "no".to_owned(),
            None => "not decided".to_owned(),
        });
        row.push(if is_same(solution, other, &scales) { "from rest".to_owned() } else { String::new() });
        table.row(row);
    }
    format!("\n{}", table.render())
}

/// Do two solutions of one model lie in the same place?
fn is_same(a: &Solution, b: &Solution, scales: &Scales) -> bool {
    let beams = |solution: &Solution| -> Vec<_> {
        let samples = solution.beams.iter().flat_map(|beam| &beam.samples);
        samples.map(|sample| sample.pose.position).chain(solution.bodies.iter().map(|p| p.position)).collect()
    };
    let (a, b) = (beams(a), beams(b));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).norm() <= SAME * scales.length)
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
