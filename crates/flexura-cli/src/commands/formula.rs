//! `flexura formula FILE [STUDY] --write law.h`

use super::{file_failure, study_failure};
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::arguments::FormulaArguments;
use crate::failure::Failure;
use crate::{files, formula_summary, screen};
use flexura::model::{FormulaStudy, StudyKind, visible};
use flexura::modelfile::Document;
use flexura::output::{
    FormulaView, OutputError, formula_c, formula_csv, formula_document, formula_rust, formula_svg,
    formula_toml, points_csv,
};
use flexura::solution::ResponseFormula;
use flexura::{Error, study_named};
use std::path::Path;

/// Makes the text of a formula.
type Writer = fn(&FormulaView<'_>) -> String;

/// How a formula is written, by the ending of the file.
const WRITERS: [(&str, Writer); 4] =
    [("toml", formula_toml), ("csv", formula_csv), ("h", formula_c), ("rs", formula_rust)];

pub fn run(arguments: &FormulaArguments) -> Result<(), Failure> {
    let writers = arguments.write.iter().map(|path| Ok((path, writer(path)?)));
    let writers: Vec<_> = writers.collect::<Result<_, Failure>>()?;
    let file = Document::read(&arguments.model.file).map_err(|report| file_failure(&report))?;
    let places = (arguments.output.as_deref(), &arguments.shown);
    let task = Task::new(&arguments.model, file, places, arguments.tolerance)?;
    task.without_page()?;
    let found = match &arguments.study {
        Some(name) => Some(study_named(&task.file, &task.model, name).map_err(|error| match error {
            Error::File(report) => file_failure(&report),
            Error::Model(error) => Failure::Input(error.to_string()),
        })?),
        None => task.model.studies.iter().find(|study| matches!(study.kind, StudyKind::Formula(_))),
    };
    match found.map(|study| (&study.name, &study.kind)) {
        Some((name, StudyKind::Formula(study))) => {
            let (answer, formula) = asked(&task, name, study)?;
            task.deliver(answer)?;
            let view = FormulaView { name, model: &task.model, study, formula: &formula };
            for (path, write) in writers {
                files::replace(path, write(&view))?;
                if !task.is_quiet {
                    screen::note(&format!("wrote {}", visible(&path.to_string_lossy())));
                }
            }
            Ok(())
        }
        Some((name, other)) => Err(Failure::Input(format!(
            "the study `{name}` is of the kind \"{}\", not \"formula\"",
            other.word()
        ))),
        None => Err(Failure::Input(
            "the file has no study of the kind \"formula\"; write one, for example\n  [study.law]\n  kind = \"formula\"\n  output = \"slide [mm]\"\n  \
             of = [\"push [N]\"]\n  trace = \"path\"\n  degree = 3"
                .to_owned(),
        )),
    }
}

fn writer(path: &Path) -> Result<Writer, Failure> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    WRITERS.iter().find(|(known, _)| *known == ending).map(|(_, write)| *write).ok_or_else(|| {
        let message = format!("cannot tell how to write {}", visible(&path.to_string_lossy()));
        Failure::Input(format!("{message}: name a file that ends in .toml, .csv, .h (C) or .rs (Rust)"))
    })
}

/// A formula of a file's model.
pub fn study(task: &Task, name: &str, study: &FormulaStudy) -> Result<Answer, Failure> {
    asked(task, name, study).map(|(answer, _)| answer)
}

fn asked(task: &Task, name: &str, study: &FormulaStudy) -> Result<(Answer, ResponseFormula), Failure> {
    let model = &task.model;
    let formula = flexura::formula(model, study, &task.options, &mut |_| {})
        .map_err(|error| study_failure(&task.file, name, &error))?;
    let view = FormulaView { name, model, study, formula: &formula };
    let refused = |error: OutputError| unwritable(failure(&formula), &error.to_string());
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::Formula(Box::new(formula_document(&view).map_err(refused)?)));
        if task.wants_files() {
            files.push(("points.csv", points_csv(&view)));
            files.push(("formula.svg", formula_svg(&view)));
            files.push(("formula.toml", formula_toml(&view)));
            files.push(("formula.h", formula_c(&view)));
            files.push(("formula.rs", formula_rust(&view)));
        }
    }
    let answer = Answer {
        document,
        files,
        summary: formula_summary::render(&view),
        without_value: Vec::new(),
        warnings: formula.warnings.clone(),
        failure: failure(&formula),
        growing: None,
    };
    Ok((answer, formula))
}

fn failure(formula: &ResponseFormula) -> Option<Failure> {
    let reason = formula.reason.as_deref().unwrap_or("the model could not be asked everywhere");
    Failure::of(formula.status, Some(reason))
}
