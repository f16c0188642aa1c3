//! The page that shows a result: into a folder, a file, or the browser.

use crate::failure::Failure;
use flexura::model::visible;
use flexura::report;
use std::path::Path;
use std::process::{Command, Stdio};

/// Name of the page in a folder of results.
pub const NAME: &str = "report.html";

/// The page of a result document, with the solver in it if that is wanted.
pub fn of_text(text: &str, is_live: bool) -> Result<String, Failure> {
    let page = if is_live { report::live_page } else { report::page };
    page(text).map_err(|error| Failure::Machine(error.to_string()))
}

/// Hours of work should not end at a folder that is not there.
pub fn begin(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let seen = |path: &Path| visible(&path.to_string_lossy()).into_owned();
    match folder {
        Some(folder) if !folder.is_dir() => {
            Err(Failure::Machine(format!("cannot write {}: there is no folder {}", seen(path), seen(folder))))
        }
        _ if path.is_dir() => Err(Failure::Machine(format!(
            "cannot write {}: this is a directory; name a file in it",
            seen(path)
        ))),
        _ => Ok(()),
    }
}

/// Asks the desktop to open a file in the browser, without waiting for it.
pub fn open(path: &Path) -> Result<(), String> {
    let program = match std::env::consts::OS {
        "windows" => "explorer",
        "macos" => "open",
        _ => "xdg-open",
    };
    let mut command = Command::new(program);
    command.arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().map(|_| ()).map_err(|error| format!("{program}: {error}"))
}
