//! `docs/verification.md`.

use crate::{Outcome, Row, cases, outcomes};
use std::fmt::Write;

const HEAD: &str = "\
# Verification

What flexura answers beside what is known. Every line is a test of `crates/verification`, which fails when a
difference exceeds what is needed; this page is generated from the same cases
(`UPDATE_DOCS=1 cargo test -p flexura-verification --test documentation`). The references are computed in
`crates/testkit`, by closed forms and by methods that share nothing with the solver.

Differences are magnitudes, relative to the beam's length L, to one radian, to EI/L² for forces and to EI/L for
moments (EI the softest of bending and torsion) unless the quantity says otherwise. They are printed as powers of
ten that bound them, no smaller than 1e-12, so that this page does not change with round-off.

";

const TAIL: &str = "
Besides, `cargo test` holds that

- the error estimate that every solution reports is honest: in every case above that is marked `*`, which has a
  closed form, the true error of all poses and wrenches is within ten times the estimate, at the tolerances 1e-4,
  1e-6, 1e-8 and 1e-10 (`crates/verification/tests/estimates.rs`);
- the answer is the same to 1e-9 when the whole model is turned and moved, when units change, when a beam is
  described from its other end, when a beam is split in two by a massless body, and when things are named
  and ordered differently (`crates/verification/tests/invariance.rs`);
- every tangent is exact: the whole system's, on a model with one of everything, to 2e-10 against differences of
  order six, as far as these go (`crates/equilibrium/src/tests.rs`), and those of each law where the law is.

## A campaign

Cases are chosen by people. `cargo xtask campaign --seed S --count N` draws N mechanisms from the seeds S, S + 1, ...
and damages as many files; the same seed always makes the same files. A mechanism has beams of every section and rest
shape, joints and holds of every kind, rolling and contact joints, springs and ligaments over spheres and cylinders,
cables, tendons, foundations, couplings, concentric tubes, loops, loads with jumps and flanks, drives, and lengths
from 0.1 mm to 10 m with moduli from 0.1 MPa to 1 TPa, so that forces lie tens of decades apart. `check`, `solve`,
`trace`, `sweep`, `buckle` and `run` each read it as a child process, which may take 10 s of the processor and 1 GiB.
Every converged answer is verified from its document and the model's own numbers (`crates/campaign/src/verify`):

- every beam is integrated again from station to station by the pair of Dormand and Prince (*J. Comput. Appl. Math.* 6
  (1980) 19), with all that acts in between, and so are concentric tubes;
- every body and the whole mechanism are in balance, joints and ends of beams fit, drives are met, efforts obey the
  laws of their coordinates;
- lengths and laws of springs, their courses over obstacles, cables and couplings are worked out again;
- contacts lie on both surfaces with opposite normals, travels and slides add up, nothing acts across a smooth
  contact;
- the strain energy is the integral of what is stored.

What differs by more than 1e-5 is wrong; what differs by more than ten times the estimate and more than 1e-8 makes the
estimate dishonest. `solve`, `sweep` and the end of a trace must agree, no trace may have a fold before a converged
answer, and a stall that says a fold must lie at a fold of the trace. Every finding is written to `target/campaign`
with its seed. A short campaign is a test (`crates/flexura-cli/tests/campaign.rs`).

The seeds 1 to 300, by `cargo xtask campaign --seed 1 --count 300` on two cores in 283 s (2,668 runs of a verb):

| | |
|---|---|
| verified answers | 286; the largest difference is below 1e-8 in all, below 1e-9 in 275, below 1e-12 in 117 |
| wrong answers, panics | none |
| memory | 255 MiB at most |
| damaged files | 300, of which 267 are refused |
| longer than 10 s | 14: twelve traces and a sweep of uneven beams, whose law is made anew at every value of the parameter, and one solve |
| traces that end where a solve does not | 11: at corners of printed laws, or without a start where a mechanism stands under its load only |
| other findings | 7: a state that broke off and has numbers that are none (2), a tolerance that double precision does not reach, a refusal, a slack band of 8 µN (1 each), solves that end before the path does (2) |
";

/// No difference is printed as less: below lies round-off, which is not the same on every machine.
const FLOOR: i32 = -12;

/// The page: one line for each case, from running them all.
pub fn markdown() -> String {
    let mut text = HEAD.to_string();
    text.push_str("| case | what | reference | needed | largest difference |\n|---|---|---|---|---|\n");
    let cases = cases();
    for outcome in outcomes(&cases, &|_| {}) {
        let (case, found) = (outcome.case, summary(&outcome));
        let mark = if case.closed_form.is_some() { " *" } else { "" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| `{}`{mark} | {} | {} | {} | {found} |",
            case.id, case.title, case.citation, case.needed
        );
    }
    text.push_str(TAIL);
    text
}

/// The bounds of the rows, those of one tolerance together.
fn summary(outcome: &Outcome) -> String {
    let rows = match &outcome.rows {
        Ok(rows) => rows,
        Err(error) => return format!("failed: {error}"),
    };
    if let Some(row) = rows.iter().find(|row| !row.passes()) {
        return format!("failed: {}, off by {:.1e}", row.quantity, row.difference);
    }
    let mut tolerances: Vec<f64> = rows.iter().map(|row| row.tolerance).collect();
    tolerances.sort_by(f64::total_cmp);
    tolerances.dedup();
    let parts: Vec<String> = tolerances
        .iter()
        .map(|&tolerance| {
            let group: Vec<&Row> = rows.iter().filter(|row| row.tolerance == tolerance).collect();
            let largest = group.iter().map(|row| row.difference).fold(0.0, f64::max);
            let bound = bound(largest).min(tolerance);
            if tolerance == 0.0 {
                "counts right".to_string()
            } else if tolerances.len() == 1 {
                format!("< {bound:.0e}")
            } else {
                format!("< {bound:.0e} of {tolerance:.0e} allowed")
            }
        })
        .collect();
    parts.join("; ")
}

/// The power of ten above a magnitude.
fn bound(difference: f64) -> f64 {
    let exponent = if difference > 0.0 { difference.log10().ceil() as i32 } else { FLOOR };
    10f64.powi(exponent.max(FLOOR))
}

/// Does a page say the same as [`markdown`] does now? Bounds may differ by one power of ten, since a difference
/// that is made of round-off may lie on either side of one; everything else must be the same.
///
/// # Errors
/// The first words that differ.
pub fn is_current(page: &str, now: &str) -> Result<(), String> {
    let (old, new): (Vec<&str>, Vec<&str>) =
        (page.split_whitespace().collect(), now.split_whitespace().collect());
    for (a, b) in old.iter().zip(&new) {
        let near = match (a.trim_end_matches(';').parse::<f64>(), b.trim_end_matches(';').parse::<f64>()) {
            (Ok(a), Ok(b)) => (a / b).log10().abs() < 1.001,
            _ => false,
        };
        if a != b && !near {
            return Err(format!("the page has `{a}` where it should have `{b}`"));
        }
    }
    if old.len() == new.len() {
        Ok(())
    } else {
        Err("the page is longer or shorter than it should be".to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_powers_of_ten_that_are_not_smaller() {
        assert_eq!(format!("{:.0e}", bound(3e-10)), "1e-9");
        assert_eq!(format!("{:.0e}", bound(0.0)), "1e-12");
        assert_eq!(format!("{:.0e}", bound(2e-17)), "1e-12");
    }

    #[test]
    fn a_page_may_differ_by_one_power_of_ten_and_no_more() {
        assert!(is_current("x < 1e-9 |", "x < 1e-10 |").is_ok());
        assert!(is_current("x < 1e-8 |", "x < 1e-10 |").is_err());
        assert!(is_current("x < 1e-9 |", "y < 1e-9 |").is_err());
        assert!(is_current("x", "x y").is_err());
    }
}
