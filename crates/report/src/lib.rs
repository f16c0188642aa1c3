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

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The text is something else.
    #[error("this is no result document: {0}")]
    NoDocument(String),
    /// It could not be packed.
    #[error("the result document cannot be packed: {0}")]
    Packing(#[from] std::io::Error),
}

/// The page of a result document, given as JSON text.
///
/// # Errors
/// The text is no JSON, or not what flexura writes.
pub fn page(document: &str) -> Result<String, ReportError> {
    let wrong = |what: String| ReportError::NoDocument(what);
    let value: Value = serde_json::from_str(document).map_err(|error| wrong(error.to_string()))?;
    for key in ["flexura", "study"] {
        if !value.get(key).is_some_and(Value::is_string) {
            return Err(wrong(format!("it has no key `{key}`")));
        }
    }
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(document.as_bytes())?;
    let packed = base64::encode(&packer.finish()?);
    let Some((before, after)) = PAGE.split_once(SLOT) else {
        return Err(wrong(
            "the page that was built has no place for it; this is a bug in flexura".to_owned(),
        ));
    };
    Ok([before, &packed, after].concat())
}

#[cfg(test)]
mod tests;
