//! Steps: announced, run, and on failure named with the command that repeats them.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// What a step comes to: nothing, or what a person must read.
pub type Outcome = Result<(), String>;

/// The folder that holds the workspace.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_path_buf()
}

/// Where cargo puts what it builds.
pub fn target() -> PathBuf {
    let wanted = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    root().join(wanted)
}

/// A command of ours, with the environment that it needs.
pub struct Step<'a> {
    title: &'a str,
    words: Vec<String>,
    environment: Vec<(&'a str, String)>,
    folder: PathBuf,
}

impl<'a> Step<'a> {
    /// `title` is printed; the command is split at spaces.
    pub fn new(title: &'a str, command: &str) -> Self {
        let words = command.split_whitespace().map(str::to_owned).collect();
        Self { title, words, environment: Vec::new(), folder: root() }
    }

    /// One more argument, which may hold spaces.
    pub fn argument(mut self, word: impl AsRef<Path>) -> Self {
        self.words.push(word.as_ref().display().to_string());
        self
    }

    /// A variable of the command's environment.
    pub fn variable(mut self, name: &'a str, value: impl Into<String>) -> Self {
        self.environment.push((name, value.into()));
        self
    }

    /// The folder to run in, in place of the workspace's.
    pub fn folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = folder.into();
        self
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]).current_dir(&self.folder);
        for (name, value) in &self.environment {
            command.env(name, value);
        }
        command
    }

    /// How a person repeats it.
    fn repeat(&self) -> String {
        let variables = self.environment.iter().map(|(name, value)| format!("{name}={}", quoted(value)));
        variables.chain(self.words.iter().map(|word| quoted(word))).collect::<Vec<_>>().join(" ")
    }

    /// Runs it with its output on the terminal.
    pub fn run(&self) -> Outcome {
        println!("\n==> {}: {}", self.title, self.repeat());
        let start = Instant::now();
        let status = self.command().status().map_err(|error| self.failed(&error.to_string()))?;
        if !status.success() {
            return Err(self.failed(&status.to_string()));
        }
        println!("    done in {:.1} s", start.elapsed().as_secs_f64());
        Ok(())
    }

    /// Runs it and keeps what it writes to standard output; standard error goes to the terminal.
    pub fn output(&self) -> Result<String, String> {
        let output = self.command().stderr(Stdio::inherit()).output();
        let output = output.map_err(|error| self.failed(&error.to_string()))?;
        if !output.status.success() {
            return Err(self.failed(&output.status.to_string()));
        }
        String::from_utf8(output.stdout).map_err(|error| self.failed(&error.to_string()))
    }

    fn failed(&self, why: &str) -> String {
        format!("{} failed ({why}); repeat it with\n\n    {}\n", self.title, self.repeat())
    }
}

fn quoted(word: &str) -> String {
    if word.contains(' ') { format!("'{word}'") } else { word.to_owned() }
}

/// A check of our own.
pub fn check(title: &str, verb: &str, check: impl FnOnce() -> Outcome) -> Outcome {
    println!("\n==> {title}");
    check().map_err(|why| format!("{title}: {why}\nrepeat it with\n\n    cargo xtask {verb}\n"))
}

/// Does a command run at all?
pub fn exists(command: &str) -> bool {
    let mut words = command.split_whitespace();
    let Some(program) = words.next() else { return false };
    let silent = Command::new(program).args(words).stdout(Stdio::null()).stderr(Stdio::null()).status();
    silent.is_ok_and(|status| status.success())
}

/// Reads a text file of the workspace.
pub fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The entries of a folder, sorted.
pub fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let list = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = list.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    paths.sort();
    Ok(paths)
}

/// All files below a folder with one of the given endings.
pub fn files(folder: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, String> {
    let mut found = Vec::new();
    for path in entries(folder)? {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if path.is_dir() && ending != "git" && !path.ends_with("target") {
            found.append(&mut files(&path, endings)?);
        } else if endings.contains(&ending) {
            found.push(path);
        }
    }
    Ok(found)
}
