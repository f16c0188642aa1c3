//! Solves one after another, each from where the last one ended: for loops of control.

use crate::model::{Issue, Model};
use crate::modelfile::suggestion;
use crate::solution::Status;
use crate::{
    Equilibrium, Family, Interrupt, Law, ModelFamily, Outcome, Prepared, ProblemError, SampleStatus,
};

/// What a step writes.
enum Wanted {
    /// Components of outputs, by position of the output.
    Outputs(Vec<usize>),
    /// The unknown parameters.
    Unknowns,
}

/// A mechanism that stands at its last equilibrium, and is led from there.
///
/// Numbers go in (values of parameters, or the wanted values of the targets) and come out (outputs, or the unknown
/// parameters), all in SI units. A step that does not converge is no error: its status says so.
///
/// ```
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// let model = flexura::modelfile::Document::read("models/lee_frame.toml")?.model(&[])?;
/// let mut stepper = flexura::Stepper::new(&model, &["load"], &["down"], 1e-8)?;
/// let mut down = [0.0];
/// assert!(stepper.step(&[1.0], &mut down).is_converged() && down[0] > 0.0);
/// assert!(stepper.step(&[1.1], &mut down).is_converged());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Stepper {
    /// As it was led last.
    model: Model,
    prepared: Prepared,
    /// Inputs with their last values; empty: the targets are led.
    values: Vec<(usize, f64)>,
    wanted: Wanted,
    tolerance: f64,
    stands: bool,
    reason: Option<String>,
}

impl Stepper {
    /// Makes a model ready. No `inputs`: the wanted values of the targets are led. No `outputs`: the unknown parameters are
    /// wanted.
    ///
    /// # Errors
    /// The model is wrong, there is no such name, or nothing to lead or to find.
    pub fn new(
        model: &Model,
        inputs: &[&str],
        outputs: &[&str],
        tolerance: f64,
    ) -> Result<Self, ProblemError> {
        let wrong = |path: &str, message: &str, hint: &str| ProblemError::new(path, message, hint);
        if inputs.is_empty() && model.targets.is_empty() {
            return Err(wrong(
                "target",
                "there is nothing to lead",
                "name parameters, or write a table [target]",
            ));
        }
        if outputs.is_empty() && model.unknowns.is_empty() {
            return Err(wrong(
                "unknown",
                "there is nothing to find",
                "name outputs, or write a table [unknown]",
            ));
        }
        let find = |kind: &str, names: &[&str], name: &str| {
            names.iter().position(|known| *known == name).ok_or_else(|| {
                let hint = suggestion(name, names, kind);
                wrong(&format!("{kind}.{name}"), &format!("there is no {kind} `{name}`"), &hint)
            })
        };
        let parameters: Vec<&str> =
            model.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let known: Vec<&str> = model.outputs.iter().map(|output| output.name.as_str()).collect();
        let mut values = Vec::with_capacity(inputs.len());
        for input in inputs {
            let position = find("parameter", &parameters, input)?;
            if model.unknowns.iter().any(|unknown| unknown.parameter == position) {
                return Err(wrong(
                    &format!("unknown.{input}"),
                    "is found by every step",
                    "lead another parameter",
                ));
            }
            values.push((position, model.parameters[position].value));
        }
        let places: Result<Vec<usize>, ProblemError> =
            outputs.iter().map(|output| find("output", &known, output)).collect();
        let places = places?;
        let wanted = if places.is_empty() { Wanted::Unknowns } else { Wanted::Outputs(places) };
        let prepared = Prepared::new(model)?;
        let model = model.clone();
        Ok(Self { model, prepared, values, wanted, tolerance, stands: false, reason: None })
    }

    /// How many numbers go in.
    pub fn inputs(&self) -> usize {
        if self.values.is_empty() { self.model.targets.len() } else { self.values.len() }
    }

    /// How many numbers come out.
    pub fn outputs(&self) -> usize {
        match &self.wanted {
            Wanted::Unknowns => self.model.unknowns.len(),
            Wanted::Outputs(outputs) => {
                outputs.iter().map(|output| self.model.outputs[*output].formulas.len()).sum()
            }
        }
    }

    /// Why the last step did not converge.
    pub fn reason(&self) -> Option<&str> {
        self.reason.as_deref()
    }

    /// The next step begins at rest.
    pub fn reset(&mut self) {
        self.stands = false;
    }

    /// Ends every step early once this flag is raised.
    pub fn heed(&mut self, interrupt: &Interrupt) {
        self.prepared.heed(interrupt);
    }

    /// Goes to the equilibrium for these inputs and writes what is wanted: NaN where there is no equilibrium, or where an
    /// output has no value. Numbers beyond those that go in or come out are left alone.
    pub fn step(&mut self, values: &[f64], out: &mut [f64]) -> SampleStatus {
        let status = match self.outcome(values) {
            Ok(outcome) => {
                self.reason = outcome.reason;
                SampleStatus::Solved(outcome.status)
            }
            Err(error) => {
                self.reason = Some(format!("{}: {}", error.path, error.message));
                SampleStatus::InputError
            }
        };
        self.stands = status.is_converged();
        if self.stands {
            self.write(out)
        } else {
            out.fill(f64::NAN)
        }
        status
    }

    fn outcome(&mut self, values: &[f64]) -> Result<Outcome, ProblemError> {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(ProblemError::new("parameter", format!("{value} is no finite number"), ""));
        }
        if self.values.is_empty() {
            return Ok(self.meet(values));
        }
        self.values.iter_mut().zip(values).for_each(|(kept, value)| kept.1 = *value);
        let unsound =
            |issue: Issue| ProblemError::new(issue.path, issue.message, issue.hint.unwrap_or_default());
        self.model.set(&self.values).map_err(unsound)?;
        if let Some(issue) = self.model.validate_mechanism().into_iter().next() {
            return Err(unsound(issue));
        }
        self.prepared.adopt(&self.model)?;
        let mut family = ModelFamily::new(&self.model);
        Ok(match (self.stands, self.model.unknowns.is_empty()) {
            (true, true) => self.prepared.solve_from_here(self.tolerance, &mut |_| {}),
            (false, true) => self.prepared.solve(self.tolerance, &mut |_| {}),
            (true, false) => self.prepared.solve_inverse_from_here(&mut family, self.tolerance),
            (false, false) => self.prepared.solve_inverse(&mut family, self.tolerance, &mut |_| {}),
        })
    }

    /// To other targets; from rest where that is not near.
    fn meet(&mut self, targets: &[f64]) -> Outcome {
        let mut family = Retargeted { family: ModelFamily::new(&self.model), targets };
        if self.stands {
            let outcome = self.prepared.solve_inverse_from_here(&mut family, self.tolerance);
            if outcome.status == Status::Converged {
                return outcome;
            }
        }
        if let Ok(model) = family.model(&[]) {
            // What fails here fails in the solve, which says why.
            let _ = self.prepared.adopt(&model);
        }
        self.prepared.solve_inverse(&mut family, self.tolerance, &mut |_| {})
    }

    fn write(&mut self, out: &mut [f64]) {
        let mut places = out.iter_mut();
        let mut put = |numbers: &[f64]| {
            for number in numbers {
                if let Some(place) = places.next() {
                    *place = *number;
                }
            }
        };
        let Wanted::Outputs(outputs) = &self.wanted else {
            let model = self.prepared.model();
            model.unknowns.iter().for_each(|unknown| put(&[model.parameters[unknown.parameter].value]));
            return;
        };
        let values = self.prepared.outputs().unwrap_or_default();
        for output in outputs {
            let before: usize =
                self.model.outputs[..*output].iter().map(|output| output.formulas.len()).sum();
            for component in 0..self.model.outputs[*output].formulas.len() {
                put(&[values.get(before + component).copied().flatten().unwrap_or(f64::NAN)]);
            }
        }
    }
}

/// The family of a model in which the targets want other values.
struct Retargeted<'a> {
    family: ModelFamily<'a>,
    targets: &'a [f64],
}

impl Family for Retargeted<'_> {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        let mut model = self.family.model(values)?;
        for (target, value) in model.targets.iter_mut().zip(self.targets) {
            target.value = *value;
        }
        Ok(model)
    }

    fn law(&mut self, problem: &Equilibrium, values: &[(usize, f64)]) -> Result<Law, ProblemError> {
        let model = self.family.made(values)?;
        for (target, value) in model.targets.iter_mut().zip(self.targets) {
            target.value = *value;
        }
        problem.neighbour(model)
    }

    fn depends_on(&mut self, parameter: usize) -> bool {
        self.family.depends_on(parameter)
    }

    fn is_line(&mut self, parameter: usize) -> bool {
        self.family.is_line(parameter)
    }
}
