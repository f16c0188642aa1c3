//! The studies of a model file.
#![allow(clippy::unwrap_used)]

use flexura::solution::{PointKind, Status};
use flexura::{Error, Options, buckle_file, output, trace_file};
use std::path::PathBuf;

const STUDIES: &str = r#"
[study.first]
kind = "trace"
parameter = "push"
range = [0, 45]
branches = true
event = "output.middle = push/200"
[study.second]
kind = "trace"
parameter = "height"
range = ["1 mm", "1.2 mm"]
"#;

/// A copy of the clamped Euler column with these studies in the place of its own.
fn file(name: &str, studies: &str) -> PathBuf {
    let models = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let text = std::fs::read_to_string(models.join("euler_clamped_clamped.toml")).unwrap();
    // Without its own studies.
    let text = text.split("[study.").next().unwrap_or_default();
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.toml"));
    std::fs::write(&path, format!("{text}\n{studies}")).unwrap();
    path
}

#[test]
fn the_first_trace_is_followed_unless_another_is_named() {
    let path = file("the_first_trace", STUDIES);
    let traced = trace_file(&path, &[], None, &Options::default()).unwrap();
    assert_eq!((traced.trace.status, traced.study.range), (Status::Converged, [0.0, 45.0]));
    let points = || traced.trace.branches.iter().flat_map(|branch| &branch.points);
    let critical = points().find(|point| matches!(point.kind, PointKind::Branch(_))).unwrap();
    assert!((critical.parameter - 4.0 * std::f64::consts::PI.powi(2)).abs() < 1e-6);
    // The event is met where the middle has the value that belongs to the push of that point.
    let event = points().find(|point| point.kind == PointKind::Event(0)).unwrap();
    let middle = event.outputs[0].as_ref().unwrap()[0];
    assert!(middle > 0.1 && (middle - event.parameter / 200.0).abs() < 1e-7, "{middle} {}", event.parameter);
    let document = traced.document().unwrap();
    assert_eq!(document.branches.len(), traced.trace.branches.len());
}

#[test]
fn a_thickness_is_traced_with_the_model_that_belongs_to_it() {
    let path = file("a_thickness_is_traced", STUDIES);
    // A constant push in newton, so that the strip is stressed the less the thicker it is.
    let overrides = [("push".to_owned(), "30*(1 mm/height)^3".to_owned())];
    let traced = trace_file(&path, &overrides, Some("second"), &Options::default()).unwrap();
    assert_eq!(traced.trace.status, Status::Converged);
    let document = traced.document().unwrap();
    let points = &document.branches[0].points;
    let axial = |i: usize| {
        let state = points[i].state.as_ref().unwrap();
        state.beams.0[0].1.stress.as_ref().unwrap()[0]
    };
    let ratio = axial(0) / axial(points.len() - 1);
    assert!((ratio - 1.2).abs() < 1e-6, "{ratio}");
}

#[test]
fn a_study_that_is_not_there_is_refused_with_the_nearest_name() {
    let path = file("a_study_that_is_not_there", STUDIES);
    let message = |error: Error| error.to_string();
    let none = message(trace_file(&path, &[], Some("secnd"), &Options::default()).unwrap_err());
    assert!(none.contains("there is no study `secnd`") && none.contains("`second`"), "{none}");
    let none = message(buckle_file(&path, &[], None, &Options::default()).unwrap_err());
    assert!(none.contains("the file has no study of the kind `buckle`"), "{none}");
    let other = message(buckle_file(&path, &[], Some("first"), &Options::default()).unwrap_err());
    assert!(other.contains("the study `first` is not of the kind `buckle`"), "{other}");
}

#[test]
fn pictures_of_a_real_path_hold_no_number_that_is_none() {
    let path = file("pictures_of_a_real_path", STUDIES);
    let traced = trace_file(&path, &[], Some("first"), &Options::default()).unwrap();
    let view = traced.view();
    for text in [output::diagram_svg(&view), output::shapes_svg(&view)] {
        assert!(!text.contains("NaN") && !text.contains("inf") && text.contains("branch point"));
    }
}
