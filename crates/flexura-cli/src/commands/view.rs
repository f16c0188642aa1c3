//! `flexura view RESULT.json`

use crate::arguments::ViewArguments;
use crate::failure::Failure;
use crate::{files, page, screen};
use flexura::model::visible;
use flexura::report;
use std::fs;
use std::path::Path;

pub fn run(arguments: &ViewArguments) -> Result<(), Failure> {
    let Some((first, others)) = arguments.results.split_first() else { return Ok(()) };
    if !others.is_empty() && !arguments.live {
        return Err(Failure::Input("one page shows one result; with --live it can hold several".to_owned()));
    }
    let texts = arguments.results.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
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
