//! Reading the file itself.

use crate::report::{Problem, Report, ReportKind};
use std::io::Read;
use std::path::Path;

/// Largest model file, bytes.
pub(crate) const LARGEST: u64 = 16 << 20;

/// Why the machine refused, in words that are the same everywhere.
pub(crate) fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".into(),
        std::io::ErrorKind::PermissionDenied => "permission denied".into(),
        _ => error.to_string(),
    }
}

/// The text of a model file.
pub(crate) fn read(path: &Path, name: &str) -> Result<String, Report> {
    let io = |error: std::io::Error| {
        Report::one(
            ReportKind::Io,
            Problem::of_file(name, format!("cannot read the model file: {}", reason(&error))),
        )
    };
    let wrong = |problem: Problem| Report::one(ReportKind::Input, problem);
    let metadata = std::fs::metadata(path).map_err(io)?;
    if metadata.is_dir() {
        let problem =
            Problem::of_file(name, "this is a directory, not a model file").hint("name the file in it");
        return Err(wrong(problem));
    }
    let too_large = |bytes: u64| {
        let size = bytes.div_ceil(1 << 20);
        let message =
            format!("the file is {size} MiB large; a model file may have at most {} MiB", LARGEST >> 20);
        wrong(Problem::of_file(name, message).hint("points of a curve belong in a CSV file"))
    };
    if metadata.is_file() && metadata.len() > LARGEST {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::new();
    // A pipe tells no size beforehand.
    std::fs::File::open(path).and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes)).map_err(io)?;
    if bytes.len() as u64 > LARGEST {
        return Err(too_large(bytes.len() as u64));
    }
    text(bytes).map_err(|message| {
        wrong(Problem::of_file(name, message).hint("a model file is a TOML text in UTF-8"))
    })
}

/// The text of a file that a model file includes; why not, in a few words.
pub(crate) fn included(path: &Path) -> Result<String, String> {
    let refused = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::Unsupported => {
            "there are no files here; put its tables into this text".to_string()
        }
        _ => reason(&error),
    };
    if std::fs::metadata(path).map_err(refused)?.is_dir() {
        return Err("it is a directory".to_string());
    }
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        .map_err(refused)?;
    if bytes.len() as u64 > LARGEST {
        return Err(format!("it is larger than {} MiB", LARGEST >> 20));
    }
    text(bytes)
}

fn text(bytes: Vec<u8>) -> Result<String, String> {
    if let Some(zero) = bytes.iter().position(|byte| *byte == 0) {
        return Err(format!("this is a binary file: byte {zero} is zero"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        format!("this is no UTF-8 text: line {line}, byte {at}")
    })
}
