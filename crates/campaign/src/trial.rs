//! One file, put to every verb.

use crate::command::{Bench, End, Ran};
use crate::compare;
use crate::finding::{Finding, Kind};
use crate::mechanism::Sort;
use crate::verify::verify;
use flexura::modelfile;
use flexura::output::{Document, read_document};
use std::path::Path;

/// Differences beyond this are wrong: the wanted accuracy is 1e-8.
const WRONG: f64 = 1e-5;
/// A true error may be so many times the estimate.
const HONEST: f64 = 10.0;
/// The accuracy that is promised; what lies below breaks no promise.
const PROMISED: f64 = 1e-8;
/// Energies hang on errors in the square, but are integrated with less care.
const ENERGY: f64 = 1e-5;

/// The status of a solve that came to no end of its own.
const LOST: &str = "lost";

/// What came of a file.
#[derive(Clone, Debug, Default)]
pub struct Trial {
    /// Status of the solve, or `refused`.
    pub status: String,
    /// Was a converged answer verified?
    pub is_verified: bool,
    /// The largest difference that was found in it.
    pub worst: f64,
    /// Verbs that were run.
    pub verbs: usize,
    /// Of the longest verb.
    pub seconds: f64,
    /// Of the largest verb.
    pub bytes: u64,
    /// What should not be.
    pub findings: Vec<Finding>,
}

impl Trial {
    fn find(&mut self, kind: Kind, words: &str, detail: impl Into<String>) {
        self.findings.push(Finding { kind, words: words.to_owned(), detail: detail.into() });
    }

    /// Runs a verb and judges how it ended.
    fn ask(&mut self, bench: &Bench, verb: &str, file: &Path, flags: &[&str]) -> Ran {
        let ran = bench.run(verb, file, flags);
        self.verbs += 1;
        self.seconds = self.seconds.max(ran.seconds);
        self.bytes = self.bytes.max(ran.bytes);
        let first = ran.err.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().to_owned();
        match ran.end {
            End::Exit(101 | 134) | End::Signal => {
                let line =
                    ran.err.lines().find(|line| line.contains("panicked")).unwrap_or(&first).to_owned();
                self.find(Kind::Crash, &ran.words, line);
            }
            End::Time => self.find(Kind::Slow, &ran.words, format!("stopped after {:.0} s", ran.seconds)),
            End::Memory => self.find(Kind::Large, &ran.words, format!("stopped at {} MiB", ran.bytes >> 20)),
            End::Exit(2) if !ran.err.contains("error") => {
                self.find(Kind::Silent, &ran.words, "exit code 2 without an error")
            }
            End::Exit(1) if ran.out.trim().is_empty() && ran.err.trim().is_empty() => {
                self.find(Kind::Silent, &ran.words, "exit code 1 without a word");
            }
            End::Exit(0..=2) => {}
            End::Exit(code) => self.find(Kind::Code, &ran.words, format!("exit code {code}: {first}")),
            End::Missing => self.find(Kind::Code, &ran.words, first),
        }
        ran
    }

    /// Solves, and verifies what converged.
    fn solve(&mut self, bench: &Bench, file: &Path) -> Option<Document> {
        let ran = self.ask(bench, "solve", file, &["--json"]);
        match ran.end {
            End::Exit(2) => {
                self.status = "refused".to_owned();
                return None;
            }
            End::Exit(0 | 1) => {}
            _ => {
                self.status = LOST.to_owned();
                return None;
            }
        }
        let document = match read_document(&ran.out) {
            Ok(document) => document,
            Err(error) => {
                self.status = "unreadable".to_owned();
                self.find(Kind::Code, &ran.words, error.to_string());
                return None;
            }
        };
        self.status = document.status.clone();
        let converged = document.status == "converged";
        if converged != (ran.end == End::Exit(0)) {
            self.find(Kind::Code, &ran.words, format!("status {} with {:?}", document.status, ran.end));
        }
        if !converged && document.reason.is_none() {
            self.find(Kind::Silent, &ran.words, format!("{} without a reason", document.status));
        }
        if converged {
            self.weigh(file, &document, &ran.words);
        }
        Some(document)
    }

    /// Is a converged answer right, and its error estimate honest?
    fn weigh(&mut self, file: &Path, document: &Document, words: &str) {
        let model = modelfile::Document::read(file).and_then(|file| file.model(&[]));
        let Ok(mut model) = model else {
            return self.find(Kind::Unverified, words, "the file reads otherwise here");
        };
        // An inverse problem is verified at the parameters that it found.
        if !model.unknowns.is_empty() {
            let found =
                document.parameters.0.iter().map(|(name, value)| (name.clone(), format!("{value:e}")));
            let found: Vec<_> = found.collect();
            match modelfile::Document::read(file).and_then(|file| file.model(&found)) {
                Ok(solved) => model = solved,
                Err(_) => return,
            }
        }
        let verdict = match verify(&model, document) {
            Ok(verdict) => verdict,
            Err(why) => return self.find(Kind::Unverified, words, why),
        };
        self.is_verified = true;
        let estimate = document.error_estimate.unwrap_or(0.0);
        let (energies, states): (Vec<_>, Vec<_>) =
            verdict.checks.iter().partition(|check| check.what == "strain energy");
        for check in &energies {
            if !(check.difference < ENERGY) {
                self.find(Kind::Wrong, words, format!("{}: off by {:.1e}", check.what, check.difference));
            }
        }
        let size = |difference: f64| if difference.is_finite() { difference } else { f64::INFINITY };
        let Some(worst) = states.iter().max_by(|a, b| size(a.difference).total_cmp(&size(b.difference)))
        else {
            return;
        };
        let off = size(worst.difference);
        self.worst = off;
        let detail = format!("{}: off by {off:.1e}, estimate {estimate:.1e}", worst.what);
        if off > WRONG {
            self.find(Kind::Wrong, words, detail);
        } else if off > (HONEST * estimate).max(PROMISED) {
            self.find(Kind::Estimate, words, detail);
        }
    }
}

/// A mechanism that is meant to be sound, or to be refused. Where it is to be `quick`, it is checked and solved only.
pub fn of_mechanism(bench: &Bench, file: &Path, sort: Sort, quick: bool) -> Trial {
    let mut trial = Trial::default();
    let check = trial.ask(bench, "check", file, &[]);
    let document = trial.solve(bench, file);
    let first = |text: &str| text.lines().next().unwrap_or_default().to_owned();
    let refused = trial.status == "refused";
    match sort {
        Sort::Held if refused => trial.find(Kind::Refused, "check", first(&check.err)),
        Sort::Hanging if trial.status != "converged" => {
            let said = document.as_ref().and_then(|document| document.reason.clone());
            let said = said.unwrap_or_else(|| first(&check.err));
            let status = trial.status.clone();
            trial.find(Kind::HangingLost, "solve", format!("{status}: {said}"));
        }
        // A free motion that carries no load does not keep a mechanism from being solved, but it must be named.
        Sort::Loose if !(refused && check.err.contains("can move")) => {
            let status = trial.status.clone();
            let said = document.as_ref().and_then(|document| document.reason.clone()).unwrap_or_default();
            trial.find(Kind::LooseUnnamed, "solve", format!("{status}: {said}"));
        }
        _ => {}
    }
    // What a solve does not come through with takes the other verbs no less.
    if quick || refused || trial.status == LOST {
        return trial;
    }
    let trace = trial.ask(
        bench,
        "trace",
        file,
        &["--parameter", "factor", "--range", "0:1", "--steps", "12", "--json", "--quiet"],
    );
    if let Some(document) = &document
        && matches!(trace.end, End::Exit(0 | 1))
    {
        trial.findings.extend(compare::with_trace(document, &trace));
    }
    let sweep = trial.ask(bench, "sweep", file, &["--vary", "factor=0.5:1:2", "--jobs", "1"]);
    if let Some(document) = &document
        && matches!(sweep.end, End::Exit(0 | 1))
    {
        trial.findings.extend(compare::with_sweep(document, &sweep));
    }
    trial.ask(bench, "buckle", file, &["--count", "2", "--json"]);
    trial.ask(bench, "run", file, &["-o", "studies"]);
    trial
}

/// A damaged file: it may mean anything, but it ends, says what is wrong, or is right. `other` chooses a further verb.
pub fn of_damage(bench: &Bench, file: &Path, other: usize, parameter: Option<&str>, quick: bool) -> Trial {
    let mut trial = Trial::default();
    trial.ask(bench, "check", file, &[]);
    trial.solve(bench, file);
    if quick || trial.status == LOST {
        return trial;
    }
    let vary = parameter.map(|name| format!("{name}=0.9,1"));
    match (other % 5, parameter, &vary) {
        (0, Some(name), _) => {
            trial.ask(bench, "trace", file, &["--parameter", name, "--range", "0:1", "--steps", "6"]);
        }
        (1, _, Some(vary)) => {
            trial.ask(bench, "sweep", file, &["--vary", vary, "--jobs", "1"]);
        }
        (2, _, _) => {
            trial.ask(bench, "buckle", file, &["--json"]);
        }
        (3, _, _) => {
            trial.ask(bench, "solve", file, &["-o", "answer", "--sensitivity"]);
        }
        (_, _, _) => {
            trial.ask(bench, "run", file, &[]);
        }
    }
    trial
}
