//! Moves models for the tests of motions in time.
#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::panic,
    reason = "each test uses a part; a test may fail where it stands"
)]

use flexura::model::StudyKind;
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Moved, Options, ProblemError, inverse_dynamics};

/// The text of a bundled model.
pub fn text(name: &str) -> String {
    let path = format!("{}/../../models/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

/// The motion of a bundled model, which must go through to its end.
pub fn bundled(name: &str, overrides: &[(&str, &str)], study: &str) -> Moved {
    moved(&text(name), overrides, study)
}

/// The motion of a model, which must go through to its end.
pub fn moved(text: &str, overrides: &[(&str, &str)], study: &str) -> Moved {
    let moved = tried(text, overrides, study).unwrap_or_else(|error| panic!("{}", error.message));
    assert_eq!(moved.motion.status, Status::Converged, "{:?}", moved.motion.reason);
    moved
}

/// The same, which may be refused or end early.
pub fn tried(text: &str, overrides: &[(&str, &str)], study: &str) -> Result<Moved, ProblemError> {
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}"));
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}"));
    let named = model.studies.iter().find(|s| s.name == study).unwrap();
    let StudyKind::InverseDynamics(study) = named.kind.clone() else { panic!("no motion") };
    let motion = inverse_dynamics(&model, &study, &Options::default(), &mut |_| {})?;
    Ok(Moved { model, study, motion })
}
