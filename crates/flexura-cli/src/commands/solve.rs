//! `flexura solve FILE`

use super::{earlier, file_failure, problem_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::SolveArguments;
use crate::failure::Failure;
use crate::progress::Meter;
use crate::table::Table;
use crate::{derivatives, quantity, summary};
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{
    OutputError, beams_csv, document as document_of, equilibrium_document, model_vtp, shape_svg,
};
use flexura::post::{Evaluation, Scales, evaluate_each, large_strain, summarise};
use flexura::solution::{Solution, Status};
use flexura::{Options, equilibria, place, solve_model};

/// Positions that differ by less than this part of the mechanism's size belong to the same equilibrium.
const SAME: f64 = 1e-6;

pub fn run(arguments: &SolveArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let mut task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    add_options(arguments, &mut task)?;
    let guesses = arguments.guesses.map(|guesses| (guesses, arguments.seed.unwrap_or(0)));
    let answer = study(&task, guesses)?;
    task.deliver(answer)
}

/// The equilibrium of a file's model, and others if they are looked for: how many random states, and their seed.
pub fn study(task: &Task, guesses: Option<(usize, u64)>) -> Result<Answer, Failure> {
    let (file, options) = (&task.file, &task.options);
    let mut meter = Meter::new(task.is_quiet);
    let solved = solve_model(&task.model, options, &mut |progress| meter.update(progress));
    meter.finish();
    let (mut solution, model) = solved.map_err(|error| problem_failure(file, &error))?;
    let evaluation = evaluate_each(&model, &solution);
    if solution.status == Status::Converged {
        solution.warnings.extend(large_strain(&model, &solution, &evaluation));
    }
    let warnings = solution.warnings.clone();
    // The document's warnings tell of outputs without a value too; a person is shown where they stand.
    solution.warnings.extend(evaluation.without_value.iter().map(ToString::to_string));
    let others = match guesses {
        Some(guesses) => other_equilibria(file, &model, &solution, options, guesses)?,
        None => Vec::new(),
    };
    let failed = || not_converged(&solution);

    // The document is written out even when the solve did not converge: it says how far that came and why.
    let refused = |error: OutputError| unwritable(failed(), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        let mut whole = document_of(&model, &solution, &evaluation).map_err(refused)?;
        if guesses.is_some() {
            let list = others.iter().map(|(other, values)| equilibrium_document(&model, other, values));
            whole.equilibria = Some(list.collect::<Result<_, _>>().map_err(refused)?);
        }
        document = Some(StudyDocument::Solve(Box::new(whole)));
    }
    if task.wants_files() {
        files = vec![
            ("beams.csv", beams_csv(&model, &solution, &evaluation).map_err(refused)?),
            ("model.vtp", model_vtp(&model, &solution, &evaluation)),
            ("shape.svg", shape_svg(&model, &solution)),
        ];
    }
    let mut summary = summary::render(&summarise(&model, &solution, &evaluation));
    summary += &derivatives::compliances(&model, &solution, &options.compliances);
    summary += &derivatives::sensitivities(&model, &solution, &evaluation);
    if guesses.is_some() {
        summary += &equilibria_table(&solution, &others);
    }
    let failure = failed();
    let without_value = evaluation.without_value;
    Ok(Answer { document, files, summary, without_value, warnings, failure, growing: None })
}

fn add_options(arguments: &SolveArguments, task: &mut Task) -> Result<(), Failure> {
    let options = &mut task.options;
    options.sensitivities = arguments.sensitivity;
    for text in &arguments.compliance {
        let place =
            place(&task.model, text).map_err(|error| Failure::Input(format!("--compliance: {error}")))?;
        if !options.compliances.contains(&place) {
            options.compliances.push(place);
        }
    }
    if let Some(path) = &arguments.from {
        options.from = Some(Box::new(earlier::read(path, &task.model)?));
    }
    Ok(())
}

/// All equilibria that are found under the load of the solution, which is the one from rest.
fn other_equilibria(
    file: &Document,
    model: &Model,
    solution: &Solution,
    options: &Options,
    (guesses, seed): (usize, u64),
) -> Result<Vec<(Solution, Evaluation)>, Failure> {
    if !model.unknowns.is_empty() && solution.status != Status::Converged {
        // Under which load is what was to be found.
        return Ok(Vec::new());
    }
    let mut model = model.clone();
    (model.unknowns, model.targets) = (Vec::new(), Vec::new());
    let options = Options { sensitivities: false, compliances: Vec::new(), from: None, ..options.clone() };
    let found = equilibria(&model, &options, guesses, seed).map_err(|error| problem_failure(file, &error))?;
    let converged = found.into_iter().filter(|other| other.status == Status::Converged);
    Ok(converged
        .map(|other| {
            let evaluation = evaluate_each(&model, &other);
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

fn not_converged(solution: &Solution) -> Option<Failure> {
    let reason = solution.reason.as_deref().unwrap_or_else(|| advice(solution.status));
    if matches!(solution.status, Status::Converged | Status::Interrupted) {
        return Failure::of(solution.status, Some(reason));
    }
    let standstill = summary::standstill(solution.status, solution.load_fraction);
    Some(Failure::NotConverged(format!("not converged, {standstill}: {reason}")))
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
        Status::Interrupted => "it was ended before the equilibrium was found",
        Status::Infeasible => "no design meets what is asked; loosen a constraint",
    }
}
