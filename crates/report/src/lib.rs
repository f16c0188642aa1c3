//! The page that shows a result document: one HTML file with everything in it, which opens from a disk without a network.
//!
//! The page itself is built from `viewer/` and knows nothing but result documents. Here a document is put into it, packed
//! (gzip) and written as base64: nothing that a model or a name holds ever becomes a part of the page's markup. The page runs
//! under a content security policy of its own, which names its script by its hash and lets it load nothing.

mod base64;

use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::Value;
use std::io::Write;

/// As the viewer's build leaves it.
const PAGE: &str = include_str!("page.html");
/// Where the document goes.
const SLOT: &str = "@flexura-document@";
/// The page that solves, and the solver for it, packed.
const LIVE_PAGE: &str = include_str!("live.html");
const SOLVER: &[u8] = include_bytes!("live.wasm.gz");
/// Where the solver goes.
const SOLVER_SLOT: &str = "@flexura-solver@";

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The text is something else.
    #[error("this is no result document: {0}")]
    NoDocument(String),
    /// Nothing can be solved again.
    #[error(
        "this result does not hold its model file, so its page cannot solve; make it again from the file"
    )]
    NoModel,
    /// It could not be packed.
    #[error("the result document cannot be packed: {0}")]
    Packing(#[from] std::io::Error),
}

/// The page of a result document, given as JSON text.
///
/// # Errors
/// The text is no JSON, or not what flexura writes.
pub fn page(document: &str) -> Result<String, ReportError> {
    checked(document)?;
    filled(PAGE, SLOT, &packed(document)?)
}

/// The page of a result document with the solver in it: what the document's model file describes can be changed there, and is
/// solved again. It holds some three megabytes.
///
/// # Errors
/// As [`page`]; and a document without its model file.
pub fn live_page(document: &str) -> Result<String, ReportError> {
    if !holds_text(&checked(document)?) {
        return Err(ReportError::NoModel);
    }
    let page = filled(LIVE_PAGE, SOLVER_SLOT, &base64::encode(SOLVER))?;
    filled(&page, SLOT, &packed(document)?)
}

/// One live page of several documents, to be chosen from.
///
/// # Errors
/// As [`live_page`].
pub fn live_page_of_many(documents: &[String]) -> Result<String, ReportError> {
    let models = documents.iter().map(|document| checked(document)).collect::<Result<Vec<_>, _>>()?;
    let first = models.first().ok_or_else(|| ReportError::NoDocument("there is none".to_owned()))?;
    let (version, model) = (&first["flexura"], &first["model"]);
    let all = serde_json::json!({
        "flexura": version, "study": "live", "model": model, "status": "converged", "models": models,
    });
    live_page(&all.to_string())
}

/// Does a document, or one that stands in it, hold its model file?
fn holds_text(value: &Value) -> bool {
    let own = |value: &Value| value.pointer("/scene/text").is_some_and(Value::is_string);
    let many = value.get("models").and_then(Value::as_array);
    let inner = value.get("studies").and_then(Value::as_object);
    own(value)
        || many.is_some_and(|list| list.iter().all(own))
        || inner.is_some_and(|list| list.values().any(own))
}

fn checked(document: &str) -> Result<Value, ReportError> {
    let wrong = |what: String| ReportError::NoDocument(what);
    let value: Value = serde_json::from_str(document).map_err(|error| wrong(error.to_string()))?;
    for key in ["flexura", "study"] {
        if !value.get(key).is_some_and(Value::is_string) {
            return Err(wrong(format!("it has no key `{key}`")));
        }
    }
    Ok(value)
}

/// As letters that mean nothing in HTML.
fn packed(document: &str) -> Result<String, ReportError> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(document.as_bytes())?;
    Ok(base64::encode(&packer.finish()?))
}

fn filled(page: &str, slot: &str, content: &str) -> Result<String, ReportError> {
    let Some((before, after)) = page.split_once(slot) else {
        let why = "the page that was built has no place for it; this is a bug in flexura";
        return Err(ReportError::NoDocument(why.to_owned()));
    };
    Ok([before, content, after].concat())
}

#[cfg(test)]
mod tests;
