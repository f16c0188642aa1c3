//! A model for every value of its parameters.
//!
//! A model makes the others itself. A study takes another family where numbers change in a way that no formula says.

use flexura_equilibrium::{Equilibrium, Law, ProblemError};
use flexura_model::{Binding, Issue, Model, Part};

/// Makes the model again with other values of some parameters: position in [`Model::parameters`] and value (SI).
/// Parameters that are not mentioned keep the value that they have in the model at hand.
pub trait Family {
    /// The model with these values.
    ///
    /// # Errors
    /// The values make no sound model: a length that is negative, say.
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError>;

    /// The law of the model with these values, to be put under the state of a problem.
    ///
    /// # Errors
    /// As [`Family::model`], and where the model is made of other parts.
    fn law(&mut self, problem: &Equilibrium, values: &[(usize, f64)]) -> Result<Law, ProblemError> {
        problem.neighbour(&self.model(values)?)
    }

    /// The same where something may happen along beams where nothing did; see [`Equilibrium::neighbour_anew`].
    ///
    /// # Errors
    /// As [`Family::law`].
    fn law_anew(&mut self, problem: &Equilibrium, values: &[(usize, f64)]) -> Result<Law, ProblemError> {
        problem.neighbour_anew(&self.model(values)?)
    }

    /// Is it certain that only loads and drives of joints hang on this parameter, and these linearly?
    fn is_line(&mut self, _parameter: usize) -> bool {
        false
    }

    /// May the model depend on this parameter? Where it does not for certain, nothing has to be tried out.
    fn depends_on(&mut self, _parameter: usize) -> bool {
        true
    }
}

impl<F: FnMut(&[(usize, f64)]) -> Result<Model, ProblemError>> Family for F {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        self(values)
    }
}

/// The models that a model's own parameters make, by [`Model::at`]: exact, without a text.
pub struct ModelFamily<'m> {
    model: &'m Model,
    /// The model made last, in which the next one is made.
    last: Option<Model>,
}

impl<'m> ModelFamily<'m> {
    /// The family of a model.
    pub fn new(model: &'m Model) -> Self {
        Self { model, last: None }
    }
}

impl ModelFamily<'_> {
    /// The model with these values, made where the last one was.
    ///
    /// # Errors
    /// As [`Family::model`].
    pub fn made(&mut self, values: &[(usize, f64)]) -> Result<&mut Model, ProblemError> {
        let given = |(position, _): &(usize, f64)| self.model.parameters.get(*position);
        if let Some(parameter) = values.iter().filter_map(given).find(|parameter| parameter.is_structural) {
            return Err(ProblemError::new(
                format!("parameter.{}", parameter.name),
                "decides of which parts the mechanism is made, so that nothing leads from one value to the next",
                "solve at each value, as `flexura sweep` does",
            ));
        }
        let unsound = |issue: Issue| {
            let first = values.first().and_then(given);
            ProblemError::new(
                format!("parameter.{}", first.map_or("", |parameter| parameter.name.as_str())),
                format!("other values make no sound model: {}", issue.message),
                "choose another guess or a range",
            )
        };
        let model = self.last.get_or_insert_with(|| self.model.clone());
        // Values that the last model had and this one has not go back to their own.
        for (parameter, own) in model.parameters.iter_mut().zip(&self.model.parameters) {
            parameter.value = own.value;
            parameter.formula.clone_from(&own.formula);
        }
        model.set(values).map_err(unsound)?;
        match model.validate_beside(self.model).into_iter().next() {
            Some(issue) => Err(unsound(issue)),
            None => Ok(model),
        }
    }
}

impl Family for ModelFamily<'_> {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        self.made(values).cloned()
    }

    fn law(&mut self, problem: &Equilibrium, values: &[(usize, f64)]) -> Result<Law, ProblemError> {
        problem.neighbour(self.made(values)?)
    }

    fn law_anew(&mut self, problem: &Equilibrium, values: &[(usize, f64)]) -> Result<Law, ProblemError> {
        problem.neighbour_anew(self.made(values)?)
    }

    fn is_line(&mut self, parameter: usize) -> bool {
        let loads = |binding: &&Binding| matches!(binding.part, Part::Load | Part::Drive);
        let moved = self.model.moved_by(parameter);
        moved.is_some_and(|moved| moved.iter().all(loads)) && self.model.is_linear_in(parameter)
    }

    fn depends_on(&mut self, parameter: usize) -> bool {
        self.model.depends_on(parameter)
    }
}

/// How large a change of a parameter is: its own size, but at least the given part of what its unit has for one in
/// this model: the longest beam for a length, EI/L² for a force. A parameter may be zero, or become so.
pub(crate) fn size_of(model: &Model, parameter: usize, (length, force): (f64, f64), part: f64) -> f64 {
    let parameter = &model.parameters[parameter];
    let one = match parameter.unit.as_str() {
        "m" => length,
        "N" => force,
        "N*m" => force * length,
        "N/m" => force / length,
        "" | "rad" => 1.0,
        _ if parameter.value != 0.0 => 0.0,
        _ => 1.0,
    };
    parameter.value.abs().max(part * one)
}

/// Part of a unit below which the size of a parameter does not matter.
pub(crate) const SMALL: f64 = 1e-3;
