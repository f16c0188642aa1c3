//! A model file that was read, and what can be asked of it.

use crate::errors::{Place, Wrong, dictionary, of_report, study};
use crate::guard::released;
use crate::solved::{Request, Solved};
use crate::studies::Study;
use flexura::model::{Model, ModesStudy};
use flexura::modelfile::{Document, Report};
use flexura::output::{response_svg, state_space_document, state_space_mat, to_json};
use flexura::post::each_output;
use flexura::solution::Status;
use flexura::{
    Interrupt, Options, StateSpaceRequest, equilibria, place, solve_model, state_space, study_named,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::sync::Arc;

/// A value of a parameter as it is given: a number in SI units, or a text as behind `--set`.
#[derive(FromPyObject)]
pub enum Given {
    /// Before numbers: a text is none, but what looks like a number should not be read twice.
    Text(String),
    Number(f64),
}

/// Names of parameters with their values.
pub type Values = Vec<(String, Given)>;

/// A text, understood as a model file, with the model that it makes as it stands.
#[pyclass(frozen, module = "flexura._native")]
pub struct Mechanism {
    pub file: Arc<Document>,
    pub model: Arc<Model>,
    pub place: Place,
}

/// What one sample of a sweep comes to: status, reason, numbers.
type Sample = (String, Option<String>, Option<Vec<f64>>);

#[pymethods]
impl Mechanism {
    /// Understands a text. `name` is shown in messages, and files that the text names are looked for beside it; `lines` says
    /// whether the text has lines that the user has seen.
    #[new]
    fn new(py: Python<'_>, text: &str, name: &str, lines: bool) -> PyResult<Self> {
        let place = if lines { Place::Lines } else { Place::Words };
        let made = released(py, |_| {
            let file = Document::parse(text, name)?;
            let model = file.model(&[])?;
            Ok((file, model))
        })?;
        Self::of(py, made, place)
    }

    /// Reads a file.
    #[staticmethod]
    fn read(py: Python<'_>, path: &str) -> PyResult<Self> {
        let made = released(py, |_| {
            let file = Document::read(path)?;
            let model = file.model(&[])?;
            Ok((file, model))
        })?;
        Self::of(py, made, Place::Lines)
    }

    /// The text of the file, with what it includes.
    #[getter]
    fn text(&self) -> String {
        self.file.whole_text().into_owned()
    }

    /// What it is made of, with values in SI units.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let model = &self.model;
        let whole = PyDict::new(py);
        whole.set_item("name", &model.name)?;
        let parameters: Vec<_> = model.parameters.iter().map(|p| (&p.name, p.value, &p.unit)).collect();
        whole.set_item("parameters", parameters)?;
        let outputs: Vec<_> = model.outputs.iter().map(|o| (&o.name, &o.unit, o.formulas.len())).collect();
        whole.set_item("outputs", outputs)?;
        let unknowns = model.unknowns.iter().map(|unknown| &model.parameters[unknown.parameter].name);
        whole.set_item("unknowns", unknowns.collect::<Vec<_>>())?;
        let targets = model.targets.iter().map(|target| (&target.output.name, target.value));
        whole.set_item("targets", targets.collect::<Vec<_>>())?;
        let studies = model.studies.iter().map(|study| (&study.name, study.kind.word()));
        whole.set_item("studies", studies.collect::<Vec<_>>())?;
        macro_rules! names {
            ($($list:ident),*) => {$(
                whole.set_item(stringify!($list), model.$list.iter().map(|it| &it.name).collect::<Vec<_>>())?;
            )*};
        }
        names!(materials, sections, beams, bodies, joints, springs, couplings, cables, tubes);
        Ok(whole)
    }

    /// The value in SI units that a text gives a parameter.
    fn value(&self, py: Python<'_>, name: &str, text: &str) -> PyResult<f64> {
        let overrides = [(name.to_owned(), text.to_owned())];
        let model = released(py, |_| self.file.model(&overrides))?;
        let model = model.map_err(|report| of_report(py, &report, self.place))?;
        let found = model.parameters.iter().find(|parameter| parameter.name == name);
        found.map(|parameter| parameter.value).ok_or_else(|| study(format!("there is no parameter `{name}`")))
    }

    /// What looks unintended, as problems.
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let found = released(py, |_| self.file.warnings())?;
        let list = PyList::empty(py);
        for problem in found {
            list.append(dictionary(py, &problem, self.place)?)?;
        }
        Ok(list)
    }

    /// Unknowns against equations: two lists of what and how many, and warnings.
    #[allow(clippy::type_complexity, reason = "three lists, read once")]
    fn check(
        &self,
        py: Python<'_>,
        values: Values,
    ) -> PyResult<(Vec<(String, usize)>, Vec<(String, usize)>, Vec<String>)> {
        let given = self.given(py, values)?;
        let census = released(py, |_| Ok(flexura::check(&self.at(&given)?)?))?;
        let census = census.map_err(|wrong: Wrong| wrong.raise(py, &self.file, self.place))?;
        Ok((census.unknowns, census.equations, census.warnings))
    }

    /// The equilibrium.
    #[allow(clippy::too_many_arguments, reason = "the options of a solve, each given by the package")]
    fn solve(
        &self,
        py: Python<'_>,
        values: Values,
        tolerance: f64,
        samples: usize,
        sensitivities: bool,
        compliances: Vec<String>,
        start: Option<PyRef<'_, Solved>>,
    ) -> PyResult<Solved> {
        let given = self.given(py, values)?;
        let from = start.map(|start| Box::new(start.solution.clone()));
        let mut options = Options { tolerance, samples, sensitivities, from, ..Options::default() };
        for text in &compliances {
            options.compliances.push(place(&self.model, text).map_err(study)?);
        }
        self.solved(py, &given, options)
    }

    /// Equilibria that are found under the full load from random states, by their energy.
    fn equilibria(
        &self,
        py: Python<'_>,
        values: Values,
        tolerance: f64,
        guesses: usize,
        seed: u64,
    ) -> PyResult<Vec<Solved>> {
        let given = self.given(py, values)?;
        let found = released(py, |interrupt| -> Result<_, Wrong> {
            let mut model = self.at(&given)?;
            (model.unknowns, model.targets) = (Vec::new(), Vec::new());
            let options = Options { tolerance, interrupt: interrupt.clone(), ..Options::default() };
            let found = equilibria(&model, &options, guesses, seed)?;
            let found = found.into_iter().filter(|solution| solution.status == Status::Converged);
            let request = Request { file: self.file.clone(), place: self.place, tolerance };
            Ok(found.map(|solution| Solved::new(&request, model.clone(), solution)).collect())
        })?;
        found.map_err(|wrong| wrong.raise(py, &self.file, self.place))
    }

    /// One sample of a sweep: from rest, and of the outputs nothing but the numbers wanted, one after another; a vector as
    /// three. Wrong values come back as a status too.
    fn sample(
        &self,
        py: Python<'_>,
        values: Values,
        tolerance: f64,
        outputs: Vec<usize>,
    ) -> PyResult<Sample> {
        let given = self.given(py, values)?;
        released(py, |interrupt| self.one_sample(&given, tolerance, &outputs, interrupt))
    }

    /// The linear model about an equilibrium as JSON, and the same as the text of a MATLAB file.
    #[allow(clippy::too_many_arguments, reason = "the options of a linear model, each given by the package")]
    fn state_space(
        &self,
        py: Python<'_>,
        values: Values,
        tolerance: f64,
        modes: (usize, bool),
        inputs: Vec<String>,
        outputs: Vec<String>,
        damping_ratio: f64,
        residual_vectors: Option<usize>,
    ) -> PyResult<(String, Vec<u8>, String)> {
        let given = self.given(py, values)?;
        let made = released(py, |interrupt| -> Result<_, Wrong> {
            let options = Options { tolerance, interrupt: interrupt.clone(), ..Options::default() };
            let model = self.at(&given)?;
            let request = StateSpaceRequest { inputs, outputs, damping_ratio, residual_vectors };
            let (count, at_rest) = modes;
            let study = ModesStudy { count, at_rest, path: None };
            let space = state_space(&model, &study, &request, &options, &mut |_| {})?;
            let written = state_space_document(&model, &space)
                .and_then(|document| Ok((to_json(&document)?, state_space_mat(&space)?)));
            let (text, mat) = written.map_err(|error| Wrong::Told(error.to_string()))?;
            Ok((text, mat, response_svg(&model, &space)))
        })?;
        made.map_err(|wrong| wrong.raise(py, &self.file, self.place))
    }

    /// A study of the file.
    fn run(
        &self,
        py: Python<'_>,
        name: &str,
        values: Values,
        tolerance: f64,
        shapes: usize,
    ) -> PyResult<Study> {
        let given = self.given(py, values)?;
        let done = released(py, |interrupt| {
            let options = Options { tolerance, shapes, interrupt: interrupt.clone(), ..Options::default() };
            let model = self.at(&given)?;
            let study = study_named(&self.file, &model, name)?.clone();
            let request = Request { file: self.file.clone(), place: self.place, tolerance };
            Study::run(&request, model, &study, &options)
        })?;
        done.map_err(|wrong| wrong.raise(py, &self.file, self.place))
    }
}

impl Mechanism {
    fn of(py: Python<'_>, made: Result<(Document, Model), Report>, place: Place) -> PyResult<Self> {
        let (file, model) = made.map_err(|report| of_report(py, &report, place))?;
        Ok(Self { file: Arc::new(file), model: Arc::new(model), place })
    }

    /// Values, checked so far that a number is one.
    fn given(&self, py: Python<'_>, values: Values) -> PyResult<Values> {
        for (name, value) in &values {
            if let Given::Number(value) = value
                && !value.is_finite()
            {
                let path = format!("parameter.{name}");
                let problem = self.file.problem(&path, &format!("{value} is no finite number"), None);
                return Err(of_report(py, &self.file.report(vec![problem]), Place::Words));
            }
        }
        Ok(values)
    }

    /// The model with these values: where all are numbers by its own rules; else, and where those refuse, from its text,
    /// which also says what is wrong.
    fn at(&self, values: &Values) -> Result<Model, Report> {
        if values.is_empty() {
            return Ok((*self.model).clone());
        }
        let number = |(name, value): &(String, Given)| match value {
            Given::Number(value) => {
                let position = self.model.parameters.iter().position(|known| known.name == *name);
                position.map(|position| (position, *value))
            }
            Given::Text(_) => None,
        };
        if let Some(numbers) = values.iter().map(number).collect::<Option<Vec<_>>>()
            && let Ok(model) = self.model.at(&numbers)
            && model.validate_mechanism().is_empty()
        {
            return Ok(model);
        }
        let text = |(name, value): &(String, Given)| {
            let text = match value {
                Given::Text(text) => text.clone(),
                // The shortest text that reads back as the same number, with the SI unit.
                Given::Number(value) => {
                    let unit = self.model.parameters.iter().find(|known| known.name == *name);
                    format!("{value:e} {}", unit.map_or("", |parameter| parameter.unit.as_str()))
                }
            };
            (name.clone(), text)
        };
        self.file.model(&values.iter().map(text).collect::<Vec<_>>())
    }

    fn solved(&self, py: Python<'_>, given: &Values, mut options: Options) -> PyResult<Solved> {
        let done = released(py, |interrupt| -> Result<_, Wrong> {
            options.interrupt = interrupt.clone();
            let model = self.at(given)?;
            let (solution, model) = solve_model(&model, &options, &mut |_| {})?;
            let tolerance = options.tolerance;
            let request = Request { file: self.file.clone(), place: self.place, tolerance };
            Ok(Solved::new(&request, model, solution))
        })?;
        done.map_err(|wrong| wrong.raise(py, &self.file, self.place))
    }

    fn one_sample(&self, given: &Values, tolerance: f64, outputs: &[usize], interrupt: &Interrupt) -> Sample {
        let wrong = |path: &str, message: &str| {
            let reason = if path.is_empty() { message.to_owned() } else { format!("{path}: {message}") };
            ("input_error".to_owned(), Some(reason), None)
        };
        let model = match self.at(given) {
            Ok(model) => model,
            Err(report) => {
                let first = report.problems().first();
                return first.map_or_else(|| wrong("", ""), |first| wrong(&first.path, &first.message));
            }
        };
        let options = Options { tolerance, samples: 2, interrupt: interrupt.clone(), ..Options::default() };
        let (solution, model) = match solve_model(&model, &options, &mut |_| {}) {
            Ok(solved) => solved,
            Err(error) => return wrong(&error.path, &error.message),
        };
        let status = solution.status.word().to_owned();
        if solution.status != Status::Converged {
            return (status, solution.reason, None);
        }
        let mut reason = None;
        let mut numbers = Vec::new();
        let results = each_output(&model, &solution);
        for position in outputs {
            match results.get(*position) {
                Some(Ok(result)) => numbers.extend(crate::solved::components(result)),
                Some(Err(error)) => {
                    reason.get_or_insert(error.to_string());
                    let count = model.outputs.get(*position).map_or(1, |output| output.formulas.len());
                    numbers.extend(std::iter::repeat_n(f64::NAN, count));
                }
                None => numbers.push(f64::NAN),
            }
        }
        (status, reason, Some(numbers))
    }
}
