//! Traces of model texts, and what tests ask of them.

#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::panic,
    reason = "each test uses a part; a test may fail where it stands"
)]

use flexura::model::{Model, StudyKind, TraceStudy};
use flexura::modelfile::Document;
use flexura::solution::{Branch, Crossing, PointKind, Status, Trace, TracePoint};
use flexura::{Options, trace};

/// A model, its first trace, and what came out.
pub struct Run {
    pub model: Model,
    pub study: TraceStudy,
    pub trace: Trace,
}

/// A bundled model with a study put behind it.
pub fn bundled(file: &str, study: &str) -> String {
    let path = format!("{}/../../models/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    // Without its own studies.
    let text = text.split("[study.").next().unwrap_or_default();
    format!("{text}\n[study.path]\nkind = \"trace\"\n{study}\n")
}

/// Follows the first trace of a text, whatever comes out.
pub fn run(text: &str, overrides: &[(&str, &str)], tolerance: f64) -> Run {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}"));
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}"));
    let study = model
        .studies
        .iter()
        .find_map(|study| match &study.kind {
            StudyKind::Trace(trace) => Some(trace.clone()),
            _ => None,
        })
        .unwrap();
    let options = Options { tolerance, ..Options::default() };
    let trace = trace(&model, &study, &options, &mut |_| {}).unwrap_or_else(|e| panic!("{}", e.message));
    Run { model, study, trace }
}

/// The same, which must arrive.
pub fn traced(text: &str, overrides: &[(&str, &str)], tolerance: f64) -> Run {
    let run = run(text, overrides, tolerance);
    assert_eq!(run.trace.status, Status::Converged, "{:?}", run.trace.reason);
    run
}

impl Run {
    /// Position of an output.
    pub fn output(&self, name: &str) -> usize {
        self.model.outputs.iter().position(|output| output.name == name).unwrap()
    }

    /// The first component of an output at a point.
    pub fn value(&self, point: &TracePoint, name: &str) -> f64 {
        point.outputs[self.output(name)].as_ref().unwrap()[0]
    }

    pub fn points(&self) -> impl Iterator<Item = &TracePoint> {
        self.trace.branches.iter().flat_map(|branch| &branch.points)
    }

    /// Folds of a branch.
    pub fn folds(&self, branch: usize) -> Vec<&TracePoint> {
        self.trace.branches[branch].points.iter().filter(|point| point.kind == PointKind::Fold).collect()
    }
}

/// Branch points of a branch, with how they cross.
pub fn crossings(branch: &Branch) -> Vec<(f64, Crossing)> {
    let crossing = |point: &TracePoint| match point.kind {
        PointKind::Branch(crossing) => Some((point.parameter, crossing)),
        _ => None,
    };
    branch.points.iter().filter_map(crossing).collect()
}
