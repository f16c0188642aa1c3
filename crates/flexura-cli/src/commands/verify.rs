//! `flexura verify [NAME ...]`

use crate::arguments::VerifyArguments;
use crate::failure::Failure;
use crate::screen::{self, BAD, GOOD, styled};
use crate::table::Table;
use flexura::expression::nearest;
use flexura_verification::{Case, Outcome, Row, cases, outcomes};
use serde::Serialize;

pub fn run(arguments: &VerifyArguments) -> Result<(), Failure> {
    let chosen = chosen(&arguments.names)?;
    if arguments.list {
        return list(&chosen);
    }
    let is_silent = arguments.quiet || arguments.json;
    let tell = |outcome: &Outcome| {
        if !is_silent && chosen.len() > 1 {
            screen::note(&format!("{}: {}", outcome.case.id, word(outcome.passes())));
        }
    };
    let outcomes = outcomes(&chosen, &tell);
    if arguments.json {
        let document = Document::of(&outcomes);
        let text =
            serde_json::to_string_pretty(&document).map_err(|error| Failure::Machine(error.to_string()))?;
        screen::print_table(&format!("{text}\n"))?;
    } else {
        screen::print(&shown(&outcomes, !arguments.names.is_empty(), arguments.quiet))?;
    }
    let failed: Vec<&str> =
        outcomes.iter().filter(|found| !found.passes()).map(|found| found.case.id).collect();
    match failed.as_slice() {
        [] => Ok(()),
        names => Err(Failure::NotConverged(format!(
            "{} of {} cases failed: {}",
            names.len(),
            outcomes.len(),
            names.join(", ")
        ))),
    }
}

/// The cases whose names hold one of the words; all, if there is none.
fn chosen(words: &[String]) -> Result<Vec<Case>, Failure> {
    let all = cases();
    for word in words {
        if !all.iter().any(|case| case.id.contains(word.as_str())) {
            let hint = match nearest(word, all.iter().map(|case| case.id)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`flexura verify --list` lists them".to_owned(),
            };
            return Err(Failure::Input(format!("no case has `{word}` in its name; {hint}")));
        }
    }
    let is_chosen =
        |case: &Case| words.is_empty() || words.iter().any(|word| case.id.contains(word.as_str()));
    Ok(all.into_iter().filter(is_chosen).collect())
}

fn list(cases: &[Case]) -> Result<(), Failure> {
    let mut table = Table::new(&["cases", "reference", "needed"]);
    for case in cases {
        table.row(vec![case.id.to_owned(), case.citation.to_owned(), case.needed.to_owned()]);
    }
    screen::print(&table.render())
}

fn word(passes: bool) -> String {
    if passes { styled(GOOD, "passed") } else { styled(BAD, "failed") }
}

/// The rows, or of each case the one nearest to what is allowed.
fn shown(outcomes: &[Outcome], is_whole: bool, is_quiet: bool) -> String {
    let mut table =
        Table::new(&["case", "quantity", "reference", "ours", "difference", "allowed", "verdict"]);
    for outcome in outcomes.iter().filter(|outcome| !is_quiet || !outcome.passes()) {
        let id = outcome.case.id;
        match &outcome.rows {
            Err(why) => table.row(vec![
                id.to_owned(),
                why.clone(),
                String::new(),
                String::new(),
                String::new(),
                String::new(),
                "failed".to_owned(),
            ]),
            Ok(rows) if is_whole => {
                for row in rows.iter().filter(|row| !is_quiet || !row.passes()) {
                    table.row(cells(id, row));
                }
            }
            Ok(_) => {
                if let Some(row) = outcome.worst() {
                    table.row(cells(id, row));
                }
            }
        }
    }
    if table.is_empty() {
        return String::new();
    }
    let passed = outcomes.iter().filter(|outcome| outcome.passes()).count();
    let rows: usize = outcomes.iter().filter_map(|outcome| outcome.rows.as_ref().ok()).map(Vec::len).sum();
    format!("{}\n{passed} of {} cases passed, {rows} comparisons\n", table.render(), outcomes.len())
}

fn cells(id: &str, row: &Row) -> Vec<String> {
    vec![
        id.to_owned(),
        screen::shortened(&row.quantity, 60),
        format!("{:.10e}", row.reference),
        format!("{:.10e}", row.ours),
        format!("{:.1e}", row.difference),
        format!("{:.0e}", row.tolerance),
        if row.passes() { "passed" } else { "failed" }.to_owned(),
    ]
}

/// What `--json` prints; numbers that are none are null.
#[derive(Serialize)]
struct Document<'o> {
    flexura: &'static str,
    status: &'static str,
    cases: Vec<CaseDocument<'o>>,
}

#[derive(Serialize)]
struct CaseDocument<'o> {
    case: &'static str,
    title: &'static str,
    reference: &'static str,
    needed: &'static str,
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'o str>,
    rows: Vec<RowDocument<'o>>,
}

#[derive(Serialize)]
struct RowDocument<'o> {
    quantity: &'o str,
    reference: f64,
    ours: f64,
    difference: f64,
    allowed: f64,
    status: &'static str,
}

fn status(passes: bool) -> &'static str {
    if passes { "passed" } else { "failed" }
}

impl<'o> Document<'o> {
    fn of(outcomes: &'o [Outcome]) -> Self {
        let row = |row: &'o Row| RowDocument {
            quantity: &row.quantity,
            reference: row.reference,
            ours: row.ours,
            difference: row.difference,
            allowed: row.tolerance,
            status: status(row.passes()),
        };
        let case = |outcome: &'o Outcome| CaseDocument {
            case: outcome.case.id,
            title: outcome.case.title,
            reference: outcome.case.citation,
            needed: outcome.case.needed,
            status: status(outcome.passes()),
            reason: outcome.rows.as_ref().err().map(String::as_str),
            rows: outcome.rows.iter().flatten().map(row).collect(),
        };
        Self {
            flexura: env!("CARGO_PKG_VERSION"),
            status: status(outcomes.iter().all(Outcome::passes)),
            cases: outcomes.iter().map(case).collect(),
        }
    }
}
