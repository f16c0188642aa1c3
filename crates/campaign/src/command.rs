//! The built command as a child, with bounds on its time and memory.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Seconds of the processor that one verb may take.
pub const MOST_SECONDS: f64 = 10.0;
/// Memory that it may take.
pub const MOST_BYTES: u64 = 1 << 30;
/// However busy the machine is, after so long it is stopped.
const LONGEST: Duration = Duration::from_secs(600);

/// How a child came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By itself, with this exit code.
    Exit(i32),
    /// By a signal that we did not send.
    Signal,
    /// Stopped: too long.
    Time,
    /// Stopped: too large.
    Memory,
    /// It did not start.
    Missing,
}

/// What a verb said.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Verb and flags, the file left out.
    pub words: String,
    /// How it ended.
    pub end: End,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
    /// Of the processor, where that can be told; else of the clock.
    pub seconds: f64,
    /// Largest memory, where that can be told.
    pub bytes: u64,
}

/// The command in a folder of its own, in which it writes.
pub struct Bench {
    program: PathBuf,
    folder: PathBuf,
}

impl Bench {
    /// # Errors
    /// The folder cannot be made.
    pub fn new(program: &Path, folder: PathBuf) -> std::io::Result<Self> {
        std::fs::create_dir_all(&folder)?;
        Ok(Self { program: program.to_path_buf(), folder })
    }

    /// A file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Runs a verb on a file with flags.
    pub fn run(&self, verb: &str, file: &Path, flags: &[&str]) -> Ran {
        let words = std::iter::once(verb).chain(flags.iter().copied()).collect::<Vec<_>>().join(" ");
        let missing = |why: String| Ran {
            words: words.clone(),
            end: End::Missing,
            out: String::new(),
            err: why,
            seconds: 0.0,
            bytes: 0,
        };
        let (out, err) = (self.path("out.txt"), self.path("err.txt"));
        let (Ok(to_out), Ok(to_err)) = (File::create(&out), File::create(&err)) else {
            return missing("the folder cannot be written".to_owned());
        };
        let mut command = Command::new(&self.program);
        command.arg(verb).arg(file).args(flags).current_dir(&self.folder).env("NO_COLOR", "1");
        command.stdin(Stdio::null()).stdout(to_out).stderr(to_err);
        let start = Instant::now();
        let child = match command.spawn() {
            Ok(child) => child,
            Err(error) => return missing(error.to_string()),
        };
        let (end, seconds, bytes) = watch(child, start);
        let text = |path: &Path| {
            std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
        };
        Ran { words, end, out: text(&out), err: text(&err), seconds, bytes }
    }
}

fn watch(mut child: Child, start: Instant) -> (End, f64, u64) {
    let (mut used, mut bytes) = (None, 0);
    let mut pause = Duration::from_micros(200);
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return (ended(status), used.unwrap_or(start.elapsed().as_secs_f64()), bytes),
            Ok(None) => {}
            Err(_) => return (End::Missing, 0.0, bytes),
        }
        if let Some((seconds, now)) = usage(child.id()) {
            used = Some(seconds);
            bytes = bytes.max(now);
        }
        let seconds = used.unwrap_or(start.elapsed().as_secs_f64());
        let too_long = seconds > MOST_SECONDS || start.elapsed() > LONGEST;
        if too_long || bytes > MOST_BYTES {
            // It may have ended by now; either is well.
            let _ = child.kill();
            let _ = child.wait();
            return (if too_long { End::Time } else { End::Memory }, seconds, bytes);
        }
        std::thread::sleep(pause);
        pause = (pause * 3 / 2).min(Duration::from_millis(10));
    }
}

fn ended(status: ExitStatus) -> End {
    status.code().map_or(End::Signal, End::Exit)
}

/// Seconds of the processor and largest memory of a child that runs, from the files of Linux; elsewhere nothing.
fn usage(process: u32) -> Option<(f64, u64)> {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // Behind the name in parentheses, which may hold anything: state, then numbers; user and system time are the 12th and 13th.
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |i: usize| fields.get(i)?.parse::<f64>().ok();
    let seconds = (ticks(11)? + ticks(12)?) / 100.0;
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some((seconds, kibibytes * 1024))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_usage_can_be_read_where_there_is_a_proc() {
        if Path::new("/proc/self/stat").exists() {
            let (seconds, bytes) = usage(std::process::id()).expect("this process runs");
            assert!(seconds >= 0.0 && bytes > 1 << 16);
        }
    }
}
