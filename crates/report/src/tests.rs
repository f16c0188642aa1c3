// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use super::{LIVE_PAGE, PAGE, ReportError, SLOT, SOLVER_SLOT, live_page, live_page_of_many, page};
use flate2::read::GzDecoder;
use std::io::Read;

/// The document that a page holds.
fn unpacked(page: &str) -> String {
    let (before, after) = PAGE.split_once(SLOT).unwrap();
    text_of(page.strip_prefix(before).unwrap().strip_suffix(after).unwrap())
}

/// What was packed.
fn text_of(packed: &str) -> String {
    let mut bits = 0u32;
    let mut bytes = Vec::new();
    for (i, letter) in packed.bytes().filter(|letter| *letter != b'=').enumerate() {
        let six = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            other => panic!("{other} is no letter of base64"),
        };
        bits = bits << 6 | u32::from(six);
        if i % 4 != 0 {
            bytes.push((bits >> (6 - 2 * (i % 4))) as u8);
        }
    }
    let mut text = String::new();
    GzDecoder::new(&bytes[..]).read_to_string(&mut text).unwrap();
    text
}

#[test]
fn a_page_holds_its_document_letter_for_letter() {
    let document = "{\"flexura\": \"0\", \"study\": \"solve\", \"model\": \"Bügel √2 ≤ 1\", \"z\": 1, \"a\": [0.1, 2e-30]}\n";
    assert_eq!(unpacked(&page(document).unwrap()), document);
}

#[test]
fn no_name_becomes_markup() {
    let name = "</script><script>alert(1)</script>\" onload='x' <!-- ]]> & \u{2028}".repeat(200);
    let document = serde_json::json!({ "flexura": "0", "study": "solve", "model": name }).to_string();
    let page = page(&document).unwrap();
    assert_eq!(unpacked(&page), document);
    assert_eq!(page.matches("<script").count(), PAGE.matches("<script").count());
    assert!(!page.contains("alert(1)") && !page.contains("onload='x'"));
}

#[test]
fn what_is_no_result_document_is_refused() {
    for text in ["", "[]", "{}", "not json", "{\"flexura\": 1, \"study\": \"solve\"}", "{\"flexura\": \"0\"}"]
    {
        assert!(matches!(page(text), Err(ReportError::NoDocument(_))), "{text}");
    }
}

#[test]
fn the_page_fetches_nothing_and_allows_its_own_script_alone() {
    let (_, rest) = PAGE.split_once("Content-Security-Policy").unwrap();
    let (policy, _) = rest.split_once('>').unwrap();
    assert!(policy.contains("default-src 'none'") && policy.contains("script-src 'sha256-"), "{policy}");
    assert!(policy.contains("worker-src blob:") && !policy.contains("unsafe"), "{policy}");
    assert!(!PAGE.contains("src=\"http") && !PAGE.contains("href=\"http"));
}

#[test]
fn the_page_stays_below_a_megabyte() {
    assert!(PAGE.len() < 1_000_000, "{} bytes", PAGE.len());
}

/// A result that can be solved again.
fn with_text(model: &str) -> String {
    let scene = serde_json::json!({ "text": "format = 1" });
    serde_json::json!({ "flexura": "0", "study": "solve", "model": model, "scene": scene }).to_string()
}

#[test]
fn a_live_page_holds_a_document_and_a_solver_in_less_than_four_megabytes() {
    let document = with_text("strip");
    let page = live_page(&document).unwrap();
    let content = |id: &str| {
        let (_, rest) =
            page.split_once(&format!("<script id=\"{id}\" type=\"application/octet-stream\">")).unwrap();
        rest.split_once("</script>").unwrap().0
    };
    assert_eq!(text_of(content("document")), document);
    // A packed file begins with 1f 8b 08.
    assert!(content("solver").starts_with("H4sI"), "{}", &content("solver")[..8]);
    assert!(page.len() < 4_000_000, "{} bytes", page.len());
}

#[test]
fn the_live_page_may_run_its_solver_and_nothing_else_besides() {
    let policy = |page: &str| {
        let (_, rest) = page.split_once("Content-Security-Policy").unwrap();
        rest.split_once('>').unwrap().0.to_owned()
    };
    let live = policy(LIVE_PAGE);
    assert!(live.contains("'wasm-unsafe-eval'") && !live.contains("'unsafe-"), "{live}");
    assert!(live.contains("default-src 'none'") && live.contains("worker-src blob:"), "{live}");
    assert_eq!((LIVE_PAGE.matches(SLOT).count(), LIVE_PAGE.matches(SOLVER_SLOT).count()), (1, 1));
}

#[test]
fn a_result_without_its_model_file_cannot_be_live() {
    let document = serde_json::json!({ "flexura": "0", "study": "solve", "model": "strip" }).to_string();
    assert!(matches!(live_page(&document), Err(ReportError::NoModel)));
    assert!(matches!(live_page_of_many(&[with_text("a"), document]), Err(ReportError::NoModel)));
    assert!(matches!(live_page_of_many(&[]), Err(ReportError::NoDocument(_))));
    assert!(live_page_of_many(&[with_text("a"), with_text("b")]).is_ok());
}
