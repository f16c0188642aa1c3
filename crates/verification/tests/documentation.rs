//! `docs/verification.md` says what the cases say.

use flexura_verification::{is_current, markdown};
use std::path::Path;

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
