//! Every bundled model gets an answer about its buckling.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, run, stderr, stdout};

/// Models of rigid parts alone: nothing in them has a stiffness that a load could take away.
const RIGID: &[&str] = &["coracoid_keel.toml", "ellipse_on_circle.toml", "knee_ellipse.toml"];

#[test]
fn what_has_nothing_that_can_buckle_is_said_to_have_none() {
    for file in RIGID {
        let output = run(&["buckle", file]);
        assert_eq!(code(&output), 0, "{file}: {}", stderr(&output));
        assert!(stdout(&output).contains("no critical value was found"), "{file}: {}", stdout(&output));
        assert!(stderr(&output).contains("nothing in it can buckle"), "{file}: {}", stderr(&output));
    }
}

#[test]
fn every_bundled_model_gets_an_answer() {
    let models = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
    let mut count = 0;
    for entry in std::fs::read_dir(models).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let output = run(&["buckle", path.to_str().unwrap()]);
        // Converged, not converged, or refused with a reason; never a crash.
        assert!((0..=2).contains(&code(&output)), "{}: {}", path.display(), stderr(&output));
        assert!(code(&output) == 0 || !stderr(&output).is_empty(), "{}", path.display());
        count += 1;
    }
    assert!(count > 60, "{count}");
}
