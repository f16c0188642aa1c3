//! `--from`: an earlier result to start from.

use crate::failure::Failure;
use flexura::model::Model;
use flexura::output::{read_document, solution_of};
use flexura::solution::Solution;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Larger files are no results.
const LARGEST: u64 = 1 << 30;

/// The solution in a result document, in the order of the model at hand.
pub fn read(path: &Path, model: &Model) -> Result<Solution, Failure> {
    let name = path.display();
    let wrong = |why: &str| Failure::Input(format!("--from {name}: {why}"));
    if path.is_dir() {
        return Err(wrong("this is a directory; name the result.json in it"));
    }
    let mut text = String::new();
    match File::open(path).and_then(|file| file.take(LARGEST).read_to_string(&mut text)) {
        Ok(_) => {}
        Err(error) if error.kind() == ErrorKind::InvalidData => {
            return Err(wrong("this is no text, and so no result document"));
        }
        Err(error) if error.kind() == ErrorKind::NotFound => return Err(wrong("there is no such file")),
        Err(error) => return Err(Failure::Machine(format!("--from {name}: cannot read it: {error}"))),
    }
    let document = read_document(&text).map_err(|error| wrong(&error.to_string()))?;
    solution_of(&document, model).map_err(|error| wrong(&error.to_string()))
}
