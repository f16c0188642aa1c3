//! `flexura run FILE [STUDY]`

use super::{
    buckle, file_failure, fit, formula, modes, motion, optimise, solve, trace, warn_about, warn_of_outputs,
};
use crate::answer::{Answer, StudyDocument, Task, json};
use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::screen::{self, BOLD, styled};
use flexura::model::{Study, StudyKind};
use flexura::modelfile::Document;
use flexura::output::Named;
use flexura::{Error, study_named};
use serde::Serialize;
use std::path::Path;

pub fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    let studies = chosen(&task, arguments.study.as_deref())?;
    if !task.is_quiet {
        warn_about(&task.file, &[]);
    }
    let mut documents = Vec::new();
    let mut pictures = Vec::new();
    let mut failed = Vec::new();
    for study in &studies {
        if task.options.interrupt.is_raised() {
            failed
                .push((study.name.as_str(), Failure::Interrupted("interrupted before it began".to_owned())));
            continue;
        }
        let folder = task.folder.as_ref().map(|folder| folder.join(&study.name));
        let mut answer = task.with_text(answer(&task, study, folder.as_deref())?);
        let written = task.write(&mut answer, folder.as_deref()).map(drop);
        if !task.is_quiet && !task.is_json {
            let heading = styled(BOLD, &format!("study {}", study.name));
            let gap = if study.name == studies[0].name { "" } else { "\n" };
            screen::print(&format!("{gap}{heading}\n{}", answer.summary))?;
        }
        if !task.is_quiet {
            answer.warnings.iter().for_each(|warning| screen::warn(&format!("{}: {warning}", study.name)));
            warn_of_outputs(&task.file, &answer.without_value);
            if written.is_ok() {
                task.tell_files(&answer, folder.as_deref());
            }
        }
        pictures.extend(answer.pictures());
        let failure = written.err().or(answer.failure);
        failed.extend(failure.map(|failure| (study.name.as_str(), failure)));
        documents.extend(answer.document.map(|document| (study.name.clone(), document)));
    }
    let status = match () {
        () if task.options.interrupt.is_raised() => "interrupted",
        () if failed.is_empty() => "converged",
        () => "incomplete",
    };
    let is_one = arguments.study.is_some();
    let text = task.is_json.then(|| text_of(&task, documents.iter(), is_one, status)).transpose()?;
    let mut page = None;
    if task.shown.wants_page() {
        let shown = documents.iter().filter(|(_, document)| document.has_page());
        if shown.clone().next().is_none() && !documents.is_empty() {
            task.without_page()?;
        }
        page = Some(text_of(&task, shown, is_one, status)?);
    }
    task.shown.write(page.as_deref(), &pictures)?;
    if let (Some(text), true) = (&text, task.is_json) {
        screen::print_table(text)?;
    }
    if !task.is_quiet {
        task.shown.tell();
    }
    end(failed, studies.len())
}

/// One study's document by itself, or all of them in one.
fn text_of<'d>(
    task: &Task,
    mut documents: impl Iterator<Item = &'d (String, StudyDocument)>,
    is_one: bool,
    status: &'static str,
) -> Result<String, Failure> {
    if is_one && let Some((_, only)) = documents.next() {
        return json(only);
    }
    json(&RunDocument {
        flexura: env!("CARGO_PKG_VERSION"),
        model: &task.model.name,
        study: "run",
        status,
        studies: Named(documents.map(|(name, document)| (name.clone(), document)).collect()),
    })
}

/// The study of that name, or all of them.
fn chosen<'t>(task: &'t Task, name: Option<&str>) -> Result<Vec<&'t Study>, Failure> {
    let Some(name) = name else {
        if task.model.studies.is_empty() {
            let hint = "write a table such as [study.path] with `kind = \"trace\"`, or use `flexura solve`, `trace` or `buckle`";
            let problem = task.file.problem("study", "the file has no studies", Some(hint));
            return Err(Failure::Input(problem.render(true)));
        }
        return Ok(task.model.studies.iter().collect());
    };
    let study = study_named(&task.file, &task.model, name).map_err(|error| match error {
        Error::File(report) => file_failure(&report),
        Error::Model(error) => super::problem_failure(&task.file, &error),
    })?;
    Ok(vec![study])
}

fn answer(task: &Task, study: &Study, folder: Option<&Path>) -> Result<Answer, Failure> {
    match &study.kind {
        StudyKind::Solve => solve::study(task, None),
        StudyKind::Trace(trace) => trace::study(task, &study.name, trace, folder),
        StudyKind::Buckle(buckle) => buckle::study(task, &study.name, buckle),
        StudyKind::Modes(modes) => modes::study(task, &study.name, modes),
        StudyKind::InverseDynamics(motion) => motion::study(task, &study.name, motion),
        StudyKind::Fit(fit) => fit::study(task, &study.name, fit),
        StudyKind::Formula(formula) => formula::study(task, &study.name, formula),
        StudyKind::Optimise(design) => optimise::study(task, &study.name, design),
    }
}

/// The end of all of them: the worst of theirs, which names the studies that failed.
fn end(mut failed: Vec<(&str, Failure)>, count: usize) -> Result<(), Failure> {
    let worst = failed.iter().position(|(_, failure)| !matches!(failure, Failure::NotConverged(_)));
    match failed.len() {
        0 => Ok(()),
        1 if count == 1 => Err(failed.swap_remove(0).1),
        _ => {
            let list: Vec<String> =
                failed.iter().map(|(name, failure)| format!("{name}: {failure}")).collect();
            let text = format!("{} of {count} studies failed; {}", failed.len(), list.join("; "));
            Err(match worst.map(|position| failed.swap_remove(position).1) {
                Some(Failure::Input(_)) => Failure::Input(text),
                Some(Failure::Machine(_)) => Failure::Machine(text),
                Some(Failure::Interrupted(_)) => Failure::Interrupted(text),
                _ => Failure::NotConverged(text),
            })
        }
    }
}

#[derive(Serialize)]
struct RunDocument<'a> {
    flexura: &'static str,
    model: &'a str,
    study: &'static str,
    status: &'static str,
    studies: Named<&'a StudyDocument>,
}
