//! Files on the disk. A file is written beside its place and renamed when it is whole, so that whoever ends the command, or a
//! full disk, leaves the older file as it was. Rows of long studies go into a file of their own that ends in `.partial`.

use crate::failure::Failure;
use crate::screen;
use flexura::model::visible;
use serde::Deserialize;
use std::fs::{self, File, Metadata};
use std::io::{Error, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Names of all files that a study may write into its folder.
const NAMES: [&str; 20] = [
    RESULT,
    "beams.csv",
    "model.vtp",
    "shape.svg",
    "path.csv",
    "critical.csv",
    "diagram.svg",
    "shapes.svg",
    "modes.csv",
    "motion.csv",
    "motion.svg",
    "residuals.csv",
    "fit.svg",
    "fitted.toml",
    "points.csv",
    "formula.svg",
    "formula.toml",
    "formula.h",
    "formula.rs",
    "report.html",
];

/// The document, which also says which files stand beside it.
pub const RESULT: &str = "result.json";

/// Writes a file in place of what stands there.
pub fn replace(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    Beside::write(path, content.as_ref()).and_then(Beside::rename).map_err(|error| unwritable(path, &error))
}

/// Writes the files of a study into a folder, the document last, and takes away what an earlier study has written there
/// and this one does not. When one of them cannot be written all are left as they were.
pub fn replace_all(folder: &Path, result: &str, files: &[(&str, String)]) -> Result<(), Failure> {
    make_folder(folder)?;
    let earlier = earlier(folder);
    let all = files.iter().map(|(name, text)| (*name, text.as_str())).chain([(RESULT, result)]);
    let mut written = Vec::with_capacity(files.len() + 1);
    for (name, text) in all {
        let path = folder.join(name);
        let beside = Beside::write(&path, text.as_bytes()).map_err(|error| unwritable(&path, &error))?;
        written.push((path, beside));
    }
    for name in earlier.iter().filter(|name| files.iter().all(|(new, _)| new != *name)) {
        // One that is gone already is no harm, and neither is one that stays.
        let _ = fs::remove_file(folder.join(name));
    }
    for (path, beside) in written {
        beside.rename().map_err(|error| unwritable(&path, &error))?;
    }
    Ok(())
}

/// Makes a folder where there is none.
pub fn make_folder(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        Failure::Machine(format!("cannot make the folder {}: {error}", visible(&folder.to_string_lossy())))
    })
}

/// Makes a folder where there is none, and tries whether files can be written into it.
pub fn probe(folder: &Path) -> Result<(), Failure> {
    make_folder(folder)?;
    let path = folder.join(format!(".flexura.{}.tmp", std::process::id()));
    let created = File::create(&path).map(drop);
    let _ = fs::remove_file(&path);
    created.map_err(|error| unwritable(&path, &error))
}

/// The files that an earlier study says to have written into a folder, besides its document. Names that flexura never writes
/// are nobody's business.
fn earlier(folder: &Path) -> Vec<String> {
    #[derive(Deserialize)]
    struct Earlier {
        #[serde(rename = "flexura")]
        _version: String,
        files: Vec<String>,
    }
    let Ok(bytes) = fs::read(folder.join(RESULT)) else { return Vec::new() };
    let Ok(earlier) = serde_json::from_slice::<Earlier>(&bytes) else { return Vec::new() };
    let is_ours = |name: &String| name != RESULT && NAMES.contains(&name.as_str());
    earlier.files.into_iter().filter(is_ours).collect()
}

fn unwritable(path: &Path, error: &Error) -> Failure {
    Failure::Machine(format!("cannot write {}: {error}", visible(&path.to_string_lossy())))
}

/// A file that is whole but does not stand in its place yet; taken away again when it never gets there.
enum Beside {
    /// Where it is, and where it belongs.
    Waiting(PathBuf, PathBuf),
    /// A device or a pipe has no place to be exchanged: it is written at once.
    Written,
}

impl Beside {
    fn write(path: &Path, content: &[u8]) -> Result<Self, Error> {
        // A link stays, and what it leads to is exchanged.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let there = there(&path)?;
        if there.as_ref().is_some_and(|there| !there.is_file()) {
            fs::write(&path, content)?;
            return Ok(Beside::Written);
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let beside = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
        let waiting = Beside::Waiting(beside.clone(), path);
        let mut file = File::create(&beside)?;
        file.write_all(content)?;
        // Only now is it sure that the disk has room for it.
        file.sync_all()?;
        if let Some(there) = there {
            fs::set_permissions(&beside, there.permissions())?;
        }
        Ok(waiting)
    }

    fn rename(self) -> Result<(), Error> {
        match &self {
            Beside::Waiting(beside, path) => fs::rename(beside, path),
            Beside::Written => Ok(()),
        }
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        if let Beside::Waiting(beside, _) = self {
            let _ = fs::remove_file(beside);
        }
    }
}

/// What stands at a path, if it may be written over.
fn there(path: &Path) -> Result<Option<Metadata>, Error> {
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => Err(Error::new(ErrorKind::IsADirectory, "this is a directory")),
        Ok(there) if there.is_file() && there.permissions().readonly() => {
            Err(Error::new(ErrorKind::PermissionDenied, "the file is read-only"))
        }
        Ok(there) => Ok(Some(there)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// A table that grows by a row at a time, each on the disk before the next is found; it stands beside the file that will hold
/// all of them, and is taken away when that file is whole.
pub struct Growing {
    path: PathBuf,
    /// None where there is nothing to grow, as of a pipe; or once a row could not be written, which is told.
    file: Option<File>,
}

impl Growing {
    /// Begins the table that will stand at a path. That fails where the file could not be written either.
    pub fn begin(path: &Path, header: &str) -> Result<Self, Failure> {
        let there = there(path).map_err(|error| unwritable(path, &error))?;
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(".partial");
        let mut growing = Self { path: path.with_file_name(name), file: None };
        if there.is_none_or(|there| there.is_file()) {
            growing.file = Some(File::create(&growing.path).map_err(|error| unwritable(path, &error))?);
            growing.add(header);
        }
        Ok(growing)
    }

    /// Writes one more row, or several.
    pub fn add(&mut self, rows: &str) {
        let Some(file) = &mut self.file else { return };
        if let Err(error) = file.write_all(rows.as_bytes()) {
            self.file = None;
            screen::warn(&format!("{}; the study goes on without it", unwritable(&self.path, &error)));
        }
    }

    /// All rows stand in the file that they belong into.
    pub fn finish(mut self) {
        // Some systems do not take away what is open.
        self.file = None;
        let _ = fs::remove_file(&self.path);
    }
}

#[cfg(test)]
mod tests;
