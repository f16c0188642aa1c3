//! `docs/verification.md` and `docs/thesis.md` say what the cases and the models say.

use flexura_verification::{is_current, markdown, thesis};
use std::path::Path;

#[test]
fn the_page_on_the_thesis_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/thesis.md");
    let now = thesis().expect("every number of the page is computed");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, &now).expect("docs/thesis.md can be written");
    }
    let page = std::fs::read_to_string(&path).expect("docs/thesis.md can be read");
    // Counts of work hang on the last bit of a processor's arithmetic.
    let is_count = |line: &str| line.contains("Newton steps");
    let stale = page.lines().zip(now.lines()).find(|(page, now)| page != now && !is_count(now));
    if let Some((page, now)) = stale {
        panic!("docs/thesis.md holds\n{page}\nwhere it should hold\n{now}\nrun with UPDATE_DOCS=1");
    }
    assert_eq!(page.lines().count(), now.lines().count(), "run with UPDATE_DOCS=1");
}

#[test]
fn the_verification_page_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/verification.md");
    let now = markdown();
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, &now).expect("docs/verification.md can be written");
    }
    let page = std::fs::read_to_string(&path).expect("docs/verification.md can be read");
    if let Err(what) = is_current(&page, &now) {
        panic!("docs/verification.md is out of date: {what}; run with UPDATE_DOCS=1");
    }
    assert!(!now.contains("failed:"), "a case fails:\n{now}");
}
