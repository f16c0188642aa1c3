//! The studies of a file, each as its document.

use crate::errors::{Wrong, bug};
use crate::solved::{Request, Solved};
use flexura::model::{Model, ModesPath, Study as Described, StudyKind};
use flexura::modelfile::to_toml;
use flexura::output::{
    FitView, FormulaView, OptimisationHead, TraceView, critical_csv, diagram_svg, fit_csv, fit_document,
    fit_svg, formula_c, formula_csv, formula_document, formula_rust, formula_svg, formula_toml,
    frequencies_csv, frequencies_document, frequencies_svg, front_csv, history_csv, modes_csv, modes_svg,
    motion_csv, motion_document, motion_svg, path_csv, shape_svg, shapes_svg, to_json, trace_document,
    vibration_csv, vibration_svg,
};
use flexura::solution::Status;
use flexura::{Buckled, Optimised, Options, Vibrated, motion_view, solve_model};
use pyo3::prelude::*;

/// What a study came to.
#[pyclass(frozen, module = "flexura._native")]
pub struct Study {
    /// The word of its kind: `trace`, `fit`.
    #[pyo3(get)]
    kind: String,
    /// How it ended.
    #[pyo3(get)]
    status: String,
    /// Why it did not do what was asked.
    #[pyo3(get)]
    reason: Option<String>,
    /// The result document as JSON; None where it would hold a number that is none.
    #[pyo3(get)]
    document: Option<String>,
    /// Pictures and tables by name.
    #[pyo3(get)]
    files: Vec<(String, String)>,
    /// The equilibrium, of a study that is a solve.
    solved: Option<Py<Solved>>,
}

#[pymethods]
impl Study {
    /// The equilibrium, of a study that is a solve.
    #[getter]
    fn solved(&self, py: Python<'_>) -> Option<Py<Solved>> {
        self.solved.as_ref().map(|solved| solved.clone_ref(py))
    }
}

impl Study {
    /// Does a study of a file's model, without the interpreter's lock.
    pub fn run(request: &Request, model: Model, study: &Described, options: &Options) -> Result<Self, Wrong> {
        let refused = |error| Wrong::of_study(&request.file, &study.name, &error);
        let text = || Some(request.file.whole_text().into_owned());
        let mut done = match &study.kind {
            StudyKind::Solve => {
                let (solution, model) = solve_model(&model, options, &mut |_| {})?;
                let (status, reason) = (solution.status, solution.reason.clone());
                let solved = Solved::new(request, model, solution);
                let solved = Python::attach(|py| Py::new(py, solved));
                let solved = solved.map_err(|error| Wrong::Told(error.to_string()))?;
                Self { solved: Some(solved), ..Self::ended("solve", status, reason) }
            }
            StudyKind::Trace(trace) => {
                let traced = flexura::trace(&model, trace, options, &mut |_| {});
                let traced = traced.map_err(refused)?;
                let view = TraceView::new(&model, trace, &traced);
                let document = trace_document(&view).map(|mut document| {
                    document.scene.iter_mut().for_each(|scene| scene.text = text());
                    document
                });
                let document = document.and_then(|document| to_json(&document)).ok();
                let mut files = vec![("diagram.svg", diagram_svg(&view)), ("shapes.svg", shapes_svg(&view))];
                files.extend(path_csv(&view).map(|table| ("path.csv", table)));
                files.extend(critical_csv(&view).ok().flatten().map(|table| ("critical.csv", table)));
                let ended = Self::ended("trace", traced.status, traced.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Buckle(buckle) => {
                let buckled = Buckled::new(&model, buckle, options).map_err(refused)?;
                let solution = &buckled.buckling.solution;
                let document = buckled.document().map(|mut document| {
                    document.scene.text = text();
                    document
                });
                let document = document.and_then(|document| to_json(&document)).ok();
                let mut files = vec![("modes.svg", modes_svg(&buckled.model, &buckled.buckling))];
                files.extend(modes_csv(&model, &buckled.buckling).map(|table| ("modes.csv", table)));
                let ended = Self::ended("buckle", solution.status, solution.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Modes(modes) if modes.path.is_some() => {
                let path = modes.path.unwrap_or(ModesPath { parameter: 0, range: [0.0, 1.0], steps: 1 });
                let along =
                    flexura::modes_along(&model, modes, path, options, &mut |_| {}).map_err(refused)?;
                let document = frequencies_document(&model, &along);
                let document = document.and_then(|document| to_json(&document)).ok();
                let mut files = vec![("frequencies.svg", frequencies_svg(&model, &along))];
                files.extend(frequencies_csv(&model, &along).map(|table| ("frequencies.csv", table)));
                let ended = Self::ended("frequencies", along.trace.status, along.trace.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Modes(modes) => {
                let vibrated = Vibrated::new(&model, modes, options, &mut |_| {}).map_err(refused)?;
                let solution = &vibrated.modes.solution;
                let document = vibrated.document().map(|mut document| {
                    document.scene.text = text();
                    document
                });
                let document = document.and_then(|document| to_json(&document)).ok();
                let mut files = vec![("shapes.svg", vibration_svg(&vibrated.model, &vibrated.modes))];
                files.extend(
                    vibration_csv(&vibrated.model, &vibrated.modes).map(|table| ("modes.csv", table)),
                );
                let ended = Self::ended("modes", solution.status, solution.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::InverseDynamics(motion) => {
                let moved = flexura::inverse_dynamics(&model, motion, options, &mut |_| {});
                let moved = moved.map_err(refused)?;
                let view = motion_view(&model, &moved);
                let document = motion_document(&view).map(|mut document| {
                    document.scene.iter_mut().for_each(|scene| scene.text = text());
                    document
                });
                let document = document.and_then(|document| to_json(&document)).ok();
                let mut files = vec![("motion.svg", motion_svg(&view))];
                files.extend(motion_csv(&view).map(|table| ("motion.csv", table)));
                let ended = Self::ended("inverse_dynamics", moved.status, moved.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Fit(fit) => {
                let (found, fitted) = flexura::fit(&model, fit, options).map_err(refused)?;
                let view = FitView { model: &model, study: fit, fit: &found, fitted: &fitted };
                let document = fit_document(&view).and_then(|document| to_json(&document)).ok();
                let files = vec![("fit.svg", fit_svg(&view)), ("residuals.csv", fit_csv(&view))];
                let ended = Self::ended("fit", found.status, found.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Formula(formula) => {
                let found = flexura::formula(&model, formula, options, &mut |_| {}).map_err(refused)?;
                let view = FormulaView { name: &study.name, model: &model, study: formula, formula: &found };
                let document = formula_document(&view).and_then(|document| to_json(&document)).ok();
                let files = vec![
                    ("formula.svg", formula_svg(&view)),
                    ("formula.toml", formula_toml(&view)),
                    ("formula.csv", formula_csv(&view)),
                    ("formula.h", formula_c(&view)),
                    ("formula.rs", formula_rust(&view)),
                ];
                let ended = Self::ended("formula", found.status, found.reason.clone());
                Self { document, files: named(files), ..ended }
            }
            StudyKind::Optimise(design) => {
                let optimised = Optimised::new(&model, design, options, &mut |_| {}).map_err(refused)?;
                let result = &optimised.result;
                let document = optimised.document().map(|mut document| {
                    if let OptimisationHead::Solved(state) = &mut document.head {
                        state.scene.text = text();
                    }
                    document
                });
                let document = document.and_then(|document| to_json(&document)).ok();
                let view = optimised.view();
                let mut files = Vec::new();
                files.extend(result.solution.as_ref().map(|s| ("shape.svg", shape_svg(&optimised.model, s))));
                files.extend(history_csv(&view).map(|table| ("history.csv", table)));
                files.extend(front_csv(&view).ok().flatten().map(|table| ("front.csv", table)));
                files.extend(to_toml(&optimised.model).map(|text| ("optimum.toml", text)));
                let ended = Self::ended("optimise", result.status, result.reason.clone());
                Self { document, files: named(files), ..ended }
            }
        };
        if done.document.is_none() && done.solved.is_none() && done.status == Status::Converged.word() {
            done.reason = Some(bug("the result holds a number that is none").to_string());
        }
        Ok(done)
    }

    fn ended(kind: &str, status: Status, reason: Option<String>) -> Self {
        let (kind, status) = (kind.to_owned(), status.word().to_owned());
        Self { kind, status, reason, document: None, files: Vec::new(), solved: None }
    }
}

fn named(files: Vec<(&str, String)>) -> Vec<(String, String)> {
    files.into_iter().map(|(name, text)| (name.to_owned(), text)).collect()
}
