//! A short campaign, the same every time: random mechanisms and damaged files for every verb, every converged answer verified.

mod common;

use common::{folder, models};
use flexura_campaign::{Found, Settings, run};

const FIRST_SEED: u64 = 1;
const SEEDS: u64 = 120;

#[test]
fn random_mechanisms_and_damaged_files_are_answered_rightly_by_every_verb() {
    let settings = Settings {
        command: env!("CARGO_BIN_EXE_flexura").into(),
        models: models(),
        out: folder("campaign"),
        seed: FIRST_SEED,
        count: SEEDS,
        jobs: std::thread::available_parallelism().map_or(1, usize::from),
        quick: false,
    };
    let summary = run(&settings, &|_| {}).unwrap();
    assert!(summary.verified > SEEDS as usize / 2, "{}", summary.table());
    let told = |found: &Found| {
        let (kind, words, detail) = (found.finding.kind, &found.finding.words, &found.finding.detail);
        format!("{kind} ({words}): {detail}\n  {}", found.file.display())
    };
    let all: Vec<String> = summary.found.iter().map(told).collect();
    assert!(all.is_empty(), "{}\n\n{}", all.join("\n"), summary.table());
}
