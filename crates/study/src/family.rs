//! A model for every value of its parameters.

use flexura_equilibrium::ProblemError;
use flexura_model::Model;

/// Makes the model again with other values of some parameters: position in [`Model::parameters`] and value (SI).
/// Parameters that are not mentioned keep the value that they have in the model at hand.
pub trait Family {
    /// The model with these values.
    ///
    /// # Errors
    /// The values make no sound model: a length that is negative, say.
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError>;
}

impl<F: FnMut(&[(usize, f64)]) -> Result<Model, ProblemError>> Family for F {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        self(values)
    }
}

/// How large a change of a parameter is: its own size, or where it is zero what its unit has for one in
/// this model: the longest beam for a length, EI/L² for a force.
pub(crate) fn size_of(model: &Model, parameter: usize, length: f64, force: f64) -> f64 {
    let parameter = &model.parameters[parameter];
    if parameter.value != 0.0 {
        return parameter.value.abs();
    }
    match parameter.unit.as_str() {
        "m" => length,
        "N" => force,
        "N*m" => force * length,
        "N/m" => force / length,
        _ => 1.0,
    }
}
