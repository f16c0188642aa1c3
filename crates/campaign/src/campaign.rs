//! Many files, on several cores, and what came of them.

use crate::command::Bench;
use crate::damage::damaged;
use crate::finding::{Finding, Kind};
use crate::mechanism::{Sort, mechanism};
use crate::random::Random;
use crate::trial::{self, Trial};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// What a campaign is to do.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The built command.
    pub command: PathBuf,
    /// The folder of the bundled models, which are damaged too.
    pub models: PathBuf,
    /// Where files of findings go.
    pub out: PathBuf,
    /// The first seed.
    pub seed: u64,
    /// How many seeds: each is a mechanism and a damaged file.
    pub count: u64,
    /// At a time.
    pub jobs: usize,
    /// Check and solve only.
    pub quick: bool,
}

/// Something that was found, with the seed that makes it again and the file that was written.
#[derive(Clone, Debug)]
pub struct Found {
    /// The seed.
    pub seed: u64,
    /// Is it of the seed's damaged file, or of its mechanism?
    pub is_damaged: bool,
    /// What.
    pub finding: Finding,
    /// Where the file is.
    pub file: PathBuf,
}

/// What came of a campaign.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Mechanisms by how they ended.
    pub mechanisms: BTreeMap<String, usize>,
    /// Damaged files by how they ended.
    pub damages: BTreeMap<String, usize>,
    /// Converged answers that were verified.
    pub verified: usize,
    /// Verified answers by the power of ten that bounds their largest difference.
    pub differences: BTreeMap<i32, usize>,
    /// Verbs that were run.
    pub verbs: usize,
    /// Of the longest verb that ended.
    pub seconds: f64,
    /// Of the largest verb that ended.
    pub bytes: u64,
    /// What was found.
    pub found: Vec<Found>,
}

/// Runs a campaign; `tell` hears of every finding at once, and of every seed that is done.
///
/// # Errors
/// A folder that cannot be written or read.
pub fn run(settings: &Settings, tell: &(dyn Fn(Progress) + Sync)) -> std::io::Result<Summary> {
    std::fs::create_dir_all(&settings.out)?;
    let bundled = bundled(&settings.models)?;
    let next = AtomicU64::new(0);
    let work = |job: usize| -> std::io::Result<Summary> {
        let bench = Bench::new(&settings.command, settings.out.join(format!("work_{job}")))?;
        let mut summary = Summary::default();
        loop {
            let done = next.fetch_add(1, Ordering::Relaxed);
            if done >= settings.count {
                return Ok(summary);
            }
            let seed = settings.seed + done;
            one_seed(settings, &bench, &bundled, seed, &mut summary, tell)?;
            tell(Progress::Seed { seed, done: done + 1 });
        }
    };
    let parts = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..settings.jobs.max(1)).map(|job| scope.spawn(move || work(job))).collect();
        workers.into_iter().map(std::thread::ScopedJoinHandle::join).collect::<Vec<_>>()
    });
    let mut whole = Summary::default();
    for part in parts {
        let part = part.map_err(|_| std::io::Error::other("a thread of the campaign broke off"))??;
        whole.add(part);
    }
    whole.found.sort_by_key(|found| (found.finding.kind, found.seed));
    Ok(whole)
}

/// What a campaign tells while it runs.
#[derive(Clone, Debug)]
pub enum Progress {
    /// Something was found.
    Found(Found),
    /// A seed is done, and so many are.
    Seed {
        /// The seed.
        seed: u64,
        /// How many.
        done: u64,
    },
}

fn bundled(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.sort();
    paths.into_iter().map(std::fs::read_to_string).collect()
}

fn one_seed(
    settings: &Settings,
    bench: &Bench,
    bundled: &[String],
    seed: u64,
    summary: &mut Summary,
    tell: &(dyn Fn(Progress) + Sync),
) -> std::io::Result<()> {
    let drawn = mechanism(seed);
    let file = bench.path("mechanism.toml");
    std::fs::write(&file, &drawn.text)?;
    let trial = trial::of_mechanism(bench, &file, drawn.sort, settings.quick);
    let word = match drawn.sort {
        Sort::Held => "held",
        Sort::Hanging => "hanging",
        Sort::Loose => "loose",
    };
    *summary.mechanisms.entry(format!("{word}: {}", trial.status)).or_default() += 1;
    summary.take(settings, seed, false, drawn.text.as_bytes(), trial, tell)?;

    // Its damages are drawn from another sequence, so that mechanisms stay what they are when damages change.
    let mut random = Random::new(seed ^ 0xdead_beef);
    let source = if random.chance(50) { &drawn.text } else { &bundled[random.below(bundled.len())] };
    let bytes = damaged(source, &mut random);
    let file = bench.path("damaged.toml");
    std::fs::write(&file, &bytes)?;
    let parameter = parameter_of(source);
    let trial = trial::of_damage(bench, &file, random.below(5), parameter.as_deref(), settings.quick);
    *summary.damages.entry(trial.status.clone()).or_default() += 1;
    summary.take(settings, seed, true, &bytes, trial, tell)
}

/// The first parameter of a file.
fn parameter_of(text: &str) -> Option<String> {
    let inside = text.split("[parameter]").nth(1)?;
    let line = inside.lines().find(|line| line.contains('='))?;
    line.split('=').next().map(|name| name.trim().to_owned())
}

impl Summary {
    fn take(
        &mut self,
        settings: &Settings,
        seed: u64,
        is_damaged: bool,
        text: &[u8],
        trial: Trial,
        tell: &(dyn Fn(Progress) + Sync),
    ) -> std::io::Result<()> {
        self.verbs += trial.verbs;
        self.seconds = self.seconds.max(trial.seconds);
        self.bytes = self.bytes.max(trial.bytes);
        if trial.is_verified {
            self.verified += 1;
            let power = trial.worst.max(1e-14).log10().ceil() as i32;
            *self.differences.entry(power).or_default() += 1;
        }
        for finding in trial.findings {
            let damage = if is_damaged { "_damaged" } else { "" };
            let verb = finding.words.split(' ').next().unwrap_or_default();
            let file = settings.out.join(format!("{}_{verb}_{seed}{damage}.toml", finding.kind));
            let mut all = Vec::new();
            if !is_damaged {
                let detail = finding.detail.replace(['\n', '\r'], " ");
                all.extend(format!("# {}: {}\n# {detail}\n", finding.kind, finding.words).bytes());
            }
            all.extend(text);
            std::fs::write(&file, all)?;
            let found = Found { seed, is_damaged, finding, file };
            tell(Progress::Found(found.clone()));
            self.found.push(found);
        }
        Ok(())
    }

    fn add(&mut self, other: Summary) {
        for (mine, theirs) in [(&mut self.mechanisms, other.mechanisms), (&mut self.damages, other.damages)] {
            for (word, count) in theirs {
                *mine.entry(word).or_default() += count;
            }
        }
        for (power, count) in other.differences {
            *self.differences.entry(power).or_default() += count;
        }
        self.verified += other.verified;
        self.verbs += other.verbs;
        self.seconds = self.seconds.max(other.seconds);
        self.bytes = self.bytes.max(other.bytes);
        self.found.extend(other.found);
    }

    /// How many of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.found.iter().filter(|found| found.finding.kind == kind).count()
    }

    /// What a person wants to read at the end.
    pub fn table(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let mut line = |words: String| {
            let _ = writeln!(text, "{words}");
        };
        let total = |map: &BTreeMap<String, usize>| map.values().sum::<usize>();
        line(format!("mechanisms {:>26}", total(&self.mechanisms)));
        for (word, count) in &self.mechanisms {
            line(format!("  {word:<28} {count:>6}"));
        }
        line(format!("damaged files {:>23}", total(&self.damages)));
        for (word, count) in &self.damages {
            line(format!("  {word:<28} {count:>6}"));
        }
        line(format!("verified answers {:>20}", self.verified));
        for (power, count) in &self.differences {
            line(format!("  largest difference < 1e{power:<5} {count:>6}"));
        }
        line(format!("verbs run {:>27}", self.verbs));
        line(format!("  longest {:.1} s, largest {} MiB", self.seconds, self.bytes >> 20));
        line(format!("findings {:>28}", self.found.len()));
        for kind in Kind::ALL.into_iter().filter(|kind| self.count(*kind) > 0) {
            line(format!("  {:<28} {:>6}", kind.word(), self.count(kind)));
        }
        text
    }
}
