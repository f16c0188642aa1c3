//! What came of cases.

use crate::{Case, Row};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What came of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Which case.
    pub case: Case,
    /// What it compared, or why it could not.
    pub rows: Result<Vec<Row>, String>,
}

impl Outcome {
    /// Runs a case.
    pub fn of(case: Case) -> Self {
        Self { case, rows: (case.run)() }
    }

    /// Is every row within its tolerance? A case that compares nothing does not pass.
    pub fn passes(&self) -> bool {
        self.rows.as_ref().is_ok_and(|rows| !rows.is_empty() && rows.iter().all(Row::passes))
    }

    /// The row that is nearest to its tolerance, or farthest beyond it.
    pub fn worst(&self) -> Option<&Row> {
        let part = |row: &Row| {
            if row.passes() && row.tolerance > 0.0 {
                row.difference / row.tolerance
            } else if row.passes() {
                0.0
            } else {
                f64::INFINITY
            }
        };
        let rows = self.rows.as_ref().ok()?;
        rows.iter().max_by(|a, b| part(a).total_cmp(&part(b)))
    }
}

/// Runs cases on all cores; `told` hears of each as it ends.
pub fn outcomes(cases: &[Case], told: &(dyn Fn(&Outcome) + Sync)) -> Vec<Outcome> {
    let next = AtomicUsize::new(0);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let work = || {
        let mut done = Vec::new();
        loop {
            let position = next.fetch_add(1, Ordering::Relaxed);
            let Some(case) = cases.get(position) else { return done };
            let outcome = Outcome::of(*case);
            told(&outcome);
            done.push((position, outcome));
        }
    };
    let mut all = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap_or_default()).collect::<Vec<_>>()
    });
    all.sort_by_key(|(position, _)| *position);
    // A case that panicked took others of its worker with it: what is missing has failed.
    let mut found = all.into_iter().peekable();
    let mut outcome = |(position, case): (usize, &Case)| match found.next_if(|(other, _)| *other == position)
    {
        Some((_, outcome)) => outcome,
        None => Outcome { case: *case, rows: Err("it did not come to an end".to_string()) },
    };
    cases.iter().enumerate().map(&mut outcome).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(run: crate::Run) -> Case {
        Case { id: "a", title: "", citation: "", needed: "", run, closed_form: None }
    }

    #[test]
    fn the_worst_row_is_the_one_that_fails() {
        let rows = || Ok(vec![Row::absolute("near", 1.0, 1.5, 0.1), Row::absolute("exact", 1.0, 1.0, 0.1)]);
        let outcome = Outcome::of(case(rows));
        assert!(!outcome.passes());
        assert_eq!(outcome.worst().map(|row| row.quantity.as_str()), Some("near"));
    }

    #[test]
    fn a_case_that_compares_nothing_does_not_pass() {
        assert!(!Outcome::of(case(|| Ok(Vec::new()))).passes());
        assert!(!Outcome::of(case(|| Err("no".to_string()))).passes());
    }

    #[test]
    fn outcomes_come_in_the_order_of_their_cases() {
        let cases = [case(|| Ok(Vec::new())), Case { id: "b", ..case(|| Err("no".to_string())) }];
        let ids: Vec<&str> = outcomes(&cases, &|_| {}).iter().map(|outcome| outcome.case.id).collect();
        assert_eq!(ids, ["a", "b"]);
    }
}
