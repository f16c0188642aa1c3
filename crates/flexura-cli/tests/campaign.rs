//! A short campaign, the same every time: random mechanisms and damaged files for every verb, every converged answer verified.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{folder, models};
use flexura_campaign::{Found, Kind, Settings, run};

const FIRST_SEED: u64 = 1;
const SEEDS: u64 = 120;

/// What is known to be wrong and not yet mended: none of it is an answer that is not true.
const KNOWN: &[(u64, Kind)] = &[
    // A printed law that jumps where its spring becomes taut: a solve steps over the jump, a path ends there.
    (24, Kind::TraceLost),
    // Stands under its load only: the trace from no load has no start.
    (98, Kind::TraceLost),
    (105, Kind::TraceLost),
    (113, Kind::TraceLost),
    (25, Kind::Accuracy),
    // The trace goes through where the solve needs more load steps than it may take.
    (63, Kind::WrongCause),
];

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
    // Ten seconds are the bound of a release build, to which `cargo xtask campaign` holds; this one is several times slower.
    let unknown = |found: &&Found| {
        let of = |(seed, kind): &(u64, Kind)| *seed == found.seed && *kind == found.finding.kind;
        found.finding.kind != Kind::Slow && (found.is_damaged || !KNOWN.iter().any(of))
    };
    let all: Vec<String> = summary.found.iter().filter(unknown).map(told).collect();
    assert!(all.is_empty(), "{}\n\n{}", all.join("\n"), summary.table());
}
