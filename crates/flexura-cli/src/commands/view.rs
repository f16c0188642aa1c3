//! `flexura view RESULT.json`

use crate::arguments::ViewArguments;
use crate::failure::Failure;
use crate::shown::Shown;
use crate::{files, page, screen};
use flexura::model::{Model, visible};
use flexura::modelfile::{Document, Report};
use flexura::output::kept_pictures;
use flexura::remake;
use flexura::report;
use std::fs;
use std::path::Path;

pub fn run(arguments: &ViewArguments) -> Result<(), Failure> {
    let Some((first, others)) = arguments.results.split_first() else { return Ok(()) };
    if !others.is_empty() && !arguments.live {
        return Err(Failure::Input("one page shows one result; with --live it can hold several".to_owned()));
    }
    let texts = arguments.results.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
    let shown = Shown::still(arguments.svg.clone(), arguments.png.clone())?;
    if shown.wants_picture() {
        let mut pictures = Vec::new();
        for (path, text) in arguments.results.iter().zip(&texts) {
            let drawn = kept_pictures(text, &mut |text, values| model_of(text, values));
            pictures.extend(
                drawn.map_err(|error| {
                    Failure::Input(format!("{}: {error}", visible(&path.to_string_lossy())))
                })?,
            );
        }
        shown.write(None, &pictures)?;
        shown.tell();
        if arguments.output.is_none() && !arguments.live {
            return Ok(());
        }
    }
    let page = match &texts[..] {
        [only] if arguments.live => report::live_page(only),
        [only] => report::page(only),
        several => report::live_page_of_many(several),
    };
    let named = || arguments.results.iter().map(|path| visible(&path.to_string_lossy()).into_owned());
    let page =
        page.map_err(|error| Failure::Input(format!("{}: {error}", named().collect::<Vec<_>>().join(", "))))?;
    let path = arguments.output.clone().unwrap_or_else(|| first.with_extension("html"));
    files::replace(&path, &page)?;
    screen::note(&format!("wrote {}", visible(&path.to_string_lossy())));
    if !arguments.no_open
        && let Err(why) = page::open(&path)
    {
        screen::warn(&format!("no browser could be started ({why}); open the file yourself"));
    }
    Ok(())
}

/// The model of a text with these values (SI) of its parameters.
fn model_of(text: &str, values: &[(String, f64)]) -> Result<Model, String> {
    let wrong = |report: Report| {
        let message = report.problems().first().map(|problem| problem.message.clone()).unwrap_or_default();
        format!("its model file is refused: {message}")
    };
    let file = Document::parse(text, "the model file in the result").map_err(wrong)?;
    let model = file.model(&[]).map_err(wrong)?;
    let known = values.iter().filter_map(|(name, value)| Some((model.parameter(name)?, *value)));
    let values: Vec<(usize, f64)> = known.collect();
    // What decides of which parts the mechanism is made is read again.
    match model.at(&values) {
        Ok(model) => Ok(model),
        Err(_) => remake(&file, &[], &model)(&values),
    }
}

fn read(path: &Path) -> Result<String, Failure> {
    if path.is_dir() {
        let inside = path.join("result.json");
        let hint = if inside.is_file() {
            format!("; name the result in it: {}", visible(&inside.to_string_lossy()))
        } else {
            "; name a result.json".to_owned()
        };
        return Err(Failure::Input(format!("{} is a folder{hint}", visible(&path.to_string_lossy()))));
    }
    let bytes = fs::read(path).map_err(|error| {
        Failure::Machine(format!("cannot read {}: {error}", visible(&path.to_string_lossy())))
    })?;
    String::from_utf8(bytes).map_err(|_| {
        Failure::Input(format!(
            "{} is no text; name the result.json of a study",
            visible(&path.to_string_lossy())
        ))
    })
}
